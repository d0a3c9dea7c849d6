//! Tables of the authors' published numbers: their reproduction, and numbers that contradict one another.

use super::number::{digits, relative, rounded};
use super::table::{Columns, DataTable};
use super::text::markdown_code;
use crate::paper::claims::scientific;
use crate::paper::published::{
    Contradiction, DataFile, Fit, GivenOutcome, Published, RepeatedForce, RepeatedSeries,
};

const FOUND_IN: &str = "`tristack crosscheck --profile published` (published.csv, published.json), `tristack report --published` (tables/published.csv)";

/// The repository of the authors.
pub(crate) const REPOSITORY: &str = "github.com/Ryudo-Suzuki/arXiv-2511.06807";

/// Explanation of how the native runs are made.
pub(crate) const PROTOCOL: &str = "The native DEM does in them what the authors' program does: order of force and spring in a step, sliding \
    friction and cut of the spring, restitution 0.3, a given start, gravity at once, a wall that waits at 2 + √3, and for the yield \
    force the one before the first decrease. The start is one of the states on file, wall speed and time step are as a rule powers of ten, \
    one choice for a run of neighbouring rows (reference/published.toml); nothing is fitted.";

/// Returns the table of the published yield forces.
pub fn published_forces(forces: &[RepeatedForce]) -> DataTable<'_> {
    let origin = |row: &&RepeatedForce| row.published.origin.clone();
    Columns::<&RepeatedForce>::new(
        "published",
        "A row is a yield force that the authors have published, what gives it, and the same by a native run of their program.",
        FOUND_IN,
    )
    .text("file", |row| row.published.file.clone())
    .means("the file, below the checkout")
    .shown("file")
    .cell(|row| in_words(&row.published.file))
    .number("line", "", |row| row.published.line)
    .means("the line in it")
    .shown("line")
    .dispensable(1)
    .stack(|row| row.published.stack)
    .number("published_force", "m g", |row| row.published.value.value)
    .means("F as it is printed")
    .shown("published F")
    .cell(|row| {
        let value = row.published.value;
        format!("{:.*}", value.decimals, value.value)
    })
    .number("limit_force", "m g", |row| row.published.limit)
    .means("exact quasi-static limit of the stack, with springs that nothing turns; absent where nothing yields")
    .shown_as("exact limit", digits::<8>)
    .number("excess", "1", |row| row.excess())
    .means("published F less the limit, relative to F + 3")
    .shown_as("published − limit", relative)
    .text("start", move |row| origin(row).map(|own| own.start))
    .means("the start that gives it: A in the name of the file with the state")
    .shown("start")
    .number("wall_speed", "√(g r)", move |row| {
        origin(row).map(|own| own.wall_speed)
    })
    .means("the wall speed that gives it, in the unit of the program")
    .shown_as("wall speed, √(g r)", rounded)
    .number("wall_speed_in_paper_units", "r √(k_n/m)", move |row| {
        origin(row).map(|own| own.run.wall_speed)
    })
    .means("the same in the unit of the paper")
    .number("time_step", "√(r/g)", move |row| {
        origin(row).map(|own| own.time_step)
    })
    .means("the time step that gives it, in the unit of the program")
    .shown_as("time step, √(r/g)", rounded)
    .dispensable(2)
    .number("end_time", "√(r/g)", move |row| {
        origin(row).and_then(|own| own.end_time)
    })
    .means("time at which the run was stopped while its force rose, so that it is no yield force; absent where it ended with the first decrease")
    .shown_as("stopped at, √(r/g)", rounded)
    .dispensable(4)
    .number("repeated_force", "m g", |row| row.force())
    .means("F by the native run with these")
    .shown_as("reproduced", digits::<9>)
    .dispensable(3)
    .number("remainder", "1", |row| row.remainder())
    .means("repeated F less the published one, relative to F + 3")
    .shown_as("what remains", relative)
    .word("fit", |row| row.fit())
    .means(
        "`every-digit`, `alike` (to 3e-6 of F + 3), `differs`, `unknown` (nothing is known that gives it) or `failed`",
    )
    .shown("fit")
    .rows(forces)
}

/// Returns the table of the published series of forces.
pub fn published_series(series: &[RepeatedSeries]) -> DataTable<'_> {
    let origin = |row: &&RepeatedSeries| row.published.origin.clone();
    Columns::<&RepeatedSeries>::new(
        "published_series",
        "A row is a series of the wall force that the authors have published, and the same by a native run of their program.",
        "`tristack crosscheck --profile published` (published_series.csv, published.json), `tristack report --published` (tables/published_series.csv)",
    )
    .text("file", |row| row.published.file.clone())
    .means("the file, below the checkout")
    .shown("file")
    .cell(|row| in_words(&row.published.file))
    .stack(|row| row.published.stack)
    .text("start", move |row| origin(row).map(|own| own.start))
    .means("the start that gives it: A in the name of the file with the state")
    .shown("start")
    .number("wall_speed", "√(g r)", move |row| {
        origin(row).map(|own| own.wall_speed)
    })
    .means("the wall speed that gives it, in the unit of the program")
    .shown_as("wall speed, √(g r)", rounded)
    .number("time_step", "√(r/g)", move |row| {
        origin(row).map(|own| own.time_step)
    })
    .means("the time step that gives it, in the unit of the program")
    .shown_as("time step, √(r/g)", rounded)
    .number("rows", "", |row| row.published.rows.len())
    .means("rows of the series")
    .shown("rows")
    .number("rows_in_every_digit", "", |row| row.rows_in_every_digit())
    .means("rows whose force is reproduced in every printed digit")
    .shown("in every digit")
    .number("largest_remainder", "1", |row| row.largest_remainder())
    .means("largest difference of a force, relative to f + 3")
    .shown_as("largest remainder", relative)
    .word("fit", |row| row.fit())
    .means("as in `published`")
    .shown("fit")
    .rows(series)
}

/// Returns the table of runs from a given start.
pub fn given_runs(runs: &[GivenOutcome]) -> DataTable<'_> {
    Columns::<&GivenOutcome>::new(
        "given_runs",
        "A row is a compression from a given start, as the authors' program makes it.",
        "`tristack simulate --case` with a start (summary.json)",
    )
    .stack(|row| row.stack)
    .number("wall_speed", "√(g r)", |row| row.case.wall_speed)
    .means("speed of the top wall")
    .shown_as("wall speed", rounded)
    .number("time_step", "√(r/g)", |row| row.case.time_step)
    .means("time step of the integrator")
    .shown_as("time step", rounded)
    .number("yield_force", "m g", |row| row.yield_force)
    .means("wall force before its first decrease; absent if it does not fall before the end")
    .shown_as("force before its first decrease", digits::<9>)
    .number("limit_force", "m g", |row| row.limit)
    .means("exact quasi-static limit of the stack, with springs that nothing turns; absent where nothing yields")
    .shown_as("exact limit", digits::<9>)
    .number("excess", "1", |row| {
        let limit = row.limit?;
        Some((row.yield_force? - limit) / (limit + 3.0))
    })
    .means("force less the limit, relative to F + 3")
    .shown_as("force − limit", relative)
    .rows(runs)
}

/// Returns the table of the wall force over time, in a run from a given start.
pub fn given_series(run: &[(f64, f64)]) -> DataTable<'_> {
    Columns::<&(f64, f64)>::new(
        "given_series",
        "A row is one moment of a compression from a given start.",
        "`tristack simulate --case` with a start and an interval (series.csv, summary.json)",
    )
    .number("time", "√(r/g)", |row| row.0)
    .means("time since the start")
    .shown("time")
    .number("wall_force", "m g", |row| row.1)
    .means("force of the top wall, its damping included")
    .shown_as("wall force", digits::<9>)
    .rows(run)
}

/// Returns the table of different numbers for the same thing.
pub fn contradictions(found: &[Contradiction]) -> DataTable<'_> {
    Columns::<&Contradiction>::new(
        "contradictions",
        "A row is two numbers that the authors give for one thing, and that do not fit together.",
        "`tristack crosscheck --profile published` (contradictions.csv, published.json), `tristack report --published` (tables/contradictions.csv)",
    )
    .text("what", |row| row.what.clone())
    .means("the quantity, with its unit")
    .shown("quantity")
    .number("first", "", |row| row.quoted[0].value)
    .means("the first number")
    .shown("first number")
    .cell(|row| row.quoted[0].printed.clone())
    .text("first_source", |row| row.quoted[0].source.clone())
    .means("where it stands")
    .shown("source")
    .cell(|row| in_words(&row.quoted[0].source))
    .number("second", "", |row| row.quoted[1].value)
    .means("the second number")
    .shown("second number")
    .cell(|row| row.quoted[1].printed.clone())
    .text("second_source", |row| row.quoted[1].source.clone())
    .means("where it stands")
    .shown("source")
    .cell(|row| in_words(&row.quoted[1].source))
    .number("size", "1", |row| row.size())
    .means("the second number less the first, relative to the first; of forces, to F + 3")
    .shown_as("difference", relative)
    .text("because", |row| row.because.clone())
    .means("the settings that give them, where they are known; of two different ones first those of the first number")
    .shown("given by")
    .rows(found)
}

/// Returns the table of the files that were read.
pub fn published_files(files: &[DataFile]) -> DataTable<'_> {
    Columns::<&DataFile>::new(
        "published_files",
        "A row is a data file of the authors that was read.",
        "`tristack crosscheck --profile published` (published_files.csv, published.json), `tristack report --published` (tables/published_files.csv)",
    )
    .text("file", |file| file.path.clone())
    .means("the file, below the checkout")
    .shown("file")
    .cell(|file| in_words(&file.path))
    .number("rows", "", |file| file.rows.len())
    .means("its rows of numbers")
    .shown("rows")
    .text("sha256", |file| file.digest.clone())
    .means("SHA-256 of its content")
    .shown("SHA-256 begins")
    .cell(|file| file.digest.chars().take(SHOWN_DIGITS).collect())
    .rows(files)
}

/// Digits of a digest in tables for people.
const SHOWN_DIGITS: usize = 16;

/// Formats a path for people: `/data/` becomes `: `, after which a line may end.
fn in_words(path: &str) -> String {
    path.replace("/data/", ": ")
}

/// Returns all tables of the published numbers.
pub fn published_tables(published: &Published) -> [DataTable<'_>; 4] {
    [
        published_forces(&published.forces),
        published_series(&published.series),
        contradictions(&published.contradictions),
        published_files(&published.files),
    ]
}

/// States in a sentence how much is reproduced.
pub fn published_summary(published: &Published) -> String {
    summary_with(published, |largest| format!("{largest:.1e} of F + 3"))
}

/// States how much is reproduced, with mathematics in TeX.
pub fn published_summary_in_tex(published: &Published) -> String {
    summary_with(published, |largest| {
        format!("${}$ of $F + 3$", scientific(largest, 1))
    })
}

fn summary_with(published: &Published, in_words: impl Fn(f64) -> String) -> String {
    let count = |wanted: Fit| published.fits().filter(|&fit| fit == wanted).count();
    let (all, every_digit) = (published.fits().count(), count(Fit::EveryDigit));
    let mut text = format!(
        "{every_digit} of {all} published numbers and series are reproduced in every printed digit"
    );
    let forces = published
        .forces
        .iter()
        .map(|own| (own.fit(), own.remainder()));
    let series = published
        .series
        .iter()
        .map(|own| (own.fit(), own.largest_remainder()));
    let alike = forces.chain(series).filter(|own| own.0 == Fit::Alike);
    let largest = alike.filter_map(|own| own.1).map(f64::abs).reduce(f64::max);
    if let Some(largest) = largest {
        text += &format!(", {} to within {}", count(Fit::Alike), in_words(largest));
    }
    for (fit, said) in [
        (Fit::Differs, "differ"),
        (Fit::Failed, "failed"),
        (
            Fit::Unknown,
            "have no start, speed and time step that are known to give them",
        ),
    ] {
        match count(fit) {
            0 => {}
            some => text += &format!(", {some} {said}"),
        }
    }
    text
}

/// Formats the tables for a terminal, without that of the files.
pub fn published_text(published: &Published) -> String {
    let [forces, series, contradictions, _] =
        published_tables(published).map(|table| table.shown().terminal());
    format!(
        "Published yield forces, and the same by native runs of the program that made them\n{forces}\n\
         Published series of the wall force\n{series}\n\
         Numbers for one thing that do not fit together\n{contradictions}"
    )
}

/// The beginning of the page.
pub(crate) const PUBLISHED_TITLE: &str = "# The published numbers, reproduced\n\nMade by tristack";

/// Formats a page with all tables.
pub fn published_markdown(published: &Published, command: &str) -> String {
    let [forces, series, contradictions, files] =
        published_tables(published).map(|table| table.shown().markdown());
    format!(
        "{PUBLISHED_TITLE} {} with {}.\n\n\
         {}.\n\n\
         ## Yield forces\n\nThe data of {REPOSITORY}. {PROTOCOL}\n\n{forces}\n\
         ## Series\n\n{series}\n\
         ## What does not fit together\n\n{contradictions}\n\
         ## Files\n\n{files}",
        env!("CARGO_PKG_VERSION"),
        markdown_code(command),
        published_summary(published)
    )
}
