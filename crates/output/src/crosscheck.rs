//! Tables and pages of a crosscheck.

use super::number::{digits, friction, one_digit, relative, small};
use super::table::{Columns, DataTable};
use super::text::{markdown_code, markdown_notes};
use crate::code::Code;
use crate::model::{ContactArms, PAPER_BODIES};
use crate::study::yield_force::{Budget, ConvergenceOrder, Evidence, Extrapolation, Judgement};
use crate::study::{MAX_TOLERANCE, MIN_TOLERANCE, Source, Verdict};

const MODEL_FORM: &str = "distance of the limit with arms and spring of the code from the paper's, relative to F + n + 1";

/// Returns the table of a crosscheck, one row per stack and code.
pub fn crosscheck(judgements: &[Judgement]) -> DataTable<'_> {
    Columns::<&Judgement>::new(
        "crosscheck",
        "A row is the yield force of one stack by one code at vanishing wall speed, and the \
         verdict on it.",
        "`tristack crosscheck` (crosscheck.csv, crosscheck.json), `tristack sweep` (sweep.csv, \
         sweep.json), `tristack report` (tables/yield_curves.csv, tables/scaling.csv, \
         tables/literal.csv, tables/law_forces.csv, tables/law_scaling.csv)",
    )
    .stack(|row| row.study.stack)
    .code(|row| &row.code)
    .version(|row| &row.version)
    .source(|row| row.source)
    .shown("source")
    .dispensable(1)
    .convention(|row| Some(row.known_convention()))
    .law(|row| row.known_law())
    .number("yield_force", "m g", |row| row.yield_force())
    .means(
        "yield force F at vanishing wall speed: the slip onset, or the peak where the force rises \
         beyond that",
    )
    .shown_as("yield force", digits::<9>)
    .number("uncertainty", "m g", |row| row.uncertainty())
    .means("its numerical uncertainty (see `budget`)")
    .shown_as("±", one_digit)
    .dispensable(4)
    .text("reference", |_| "quasistatic")
    .means("the theory that it is compared with")
    .number("reference_force", "m g", |row| row.reference_force())
    .means("F by that theory, with the arms of the code")
    .shown_as("exact limit", digits::<9>)
    .dispensable(5)
    .number("slip_onset", "m g", |row| Some(row.slip()?.force))
    .means("F at which the floor begins to slip, at vanishing wall speed")
    .number("slip_onset_uncertainty", "m g", |row| {
        Some(row.slip()?.budget.total())
    })
    .means("its numerical uncertainty")
    .number("reference_onset", "m g", |row| row.reference_onset())
    .means("the onset by theory; below reference_force where contact 2–3 is closed then")
    .number("peak_force", "m g", |row| Some(row.peak()?.0))
    .means("the largest F, at vanishing wall speed")
    .number("peak_uncertainty", "m g", |row| Some(row.peak()?.1))
    .means("its numerical uncertainty")
    .number("error", "1", |row| row.error())
    .means(
        "(slip_onset − reference_onset)/(reference_onset + n + 1), by which the row is judged; of the peak \
         where there is no onset",
    )
    .shown_as("error", relative)
    .number("tolerance", "1", |row| row.tolerance())
    .means("largest error that agrees")
    .shown_as("tolerance", small)
    .dispensable(3)
    .number("model_form", "1", |row| row.model_form())
    .means(MODEL_FORM)
    .shown_as("model form", relative)
    .dispensable(2)
    .cause(|row| row.grounds.cause())
    .verdict(|row| row.verdict())
    .rows(judgements)
}

/// Returns the table that counts the verdicts on the rows of each code.
pub fn crosscheck_summary(judgements: &[Judgement]) -> DataTable<'_> {
    let mut codes: Vec<Code> = Vec::new();
    for row in judgements {
        if !codes.contains(&row.code) {
            codes.push(row.code.clone());
        }
    }
    let of_code = |code: &Code| {
        let code = code.clone();
        judgements.iter().filter(move |row| row.code == code)
    };
    let count = move |code: &Code, verdict: Verdict| {
        let rows = of_code(code).filter(|row| row.verdict() == verdict);
        rows.count()
    };
    let worst = move |code: &Code| {
        let judged = of_code(code).filter(|row| row.error().is_some());
        let size = |row: &Judgement| row.error().unwrap_or_default().abs();
        judged.max_by(|one, other| size(one).total_cmp(&size(other)))
    };
    let mut columns = Columns::<Code>::new(
        "crosscheck-summary",
        "A row is how many rows of one code have which verdict.",
        "`tristack crosscheck --summary`, `tristack sweep --summary`, `tristack judge --summary`",
    )
    .code(|code| code)
    .number("rows", "1", move |code| of_code(code).count())
    .means("number of rows")
    .shown("rows")
    .number("recorded", "1", move |code| {
        of_code(code).filter(|row| row.is_recorded()).count()
    })
    .means("number of those that are recorded, not live")
    .shown("recorded")
    .dispensable(3);
    for (name, meaning, verdict) in VERDICTS {
        columns = columns
            .number(name, "1", move |code| count(code, verdict))
            .means(meaning);
        let has_any =
            verdict == Verdict::Agrees || codes.iter().any(|code| count(code, verdict) > 0);
        // Tables for people show a verdict only if some row has it; `agrees` is always shown.
        if has_any {
            columns = columns.shown(verdict.as_str());
        }
    }
    columns
        .number("largest_error", "1", move |code| worst(code)?.error())
        .means("error of the largest size")
        .shown_as("largest error", relative)
        .number("largest_error_mu", "1", move |code| Some(worst(code)?.mu()))
        .means("floor friction μ of the row that has it")
        .shown_as("at mu", friction)
        .dispensable(2)
        .number("largest_error_stiffness", "m g/r", move |code| {
            Some(worst(code)?.stiffness())
        })
        .means("stiffness of the row that has it")
        .shown("stiffness")
        .dispensable(1)
        .rows(codes.clone())
}

/// The columns of the summary that count verdicts: name, meaning, verdict.
const VERDICTS: [(&str, &str, Verdict); 6] = [
    ("agrees", "number of rows that agree", Verdict::Agrees),
    ("differs", "number of rows that differ", Verdict::Differs),
    (
        "inconclusive",
        "number of inconclusive rows",
        Verdict::Inconclusive,
    ),
    ("no_yield", "number of rows without yield", Verdict::NoYield),
    (
        "failed",
        "number of rows whose code failed",
        Verdict::Failed,
    ),
    (
        "missing",
        "number of rows whose code is neither installed nor recorded",
        Verdict::Missing,
    ),
];

/// Returns the table of the parts of the uncertainty of every row with a slip onset, and the convergence of its runs.
pub fn budget(judgements: &[Judgement]) -> DataTable<'_> {
    let mut columns = Columns::<(&Judgement, &Extrapolation)>::new(
        "budget",
        "A row is what the numerical uncertainty (ASME V&V 20) of one row of `crosscheck` \
         consists of, and how its runs converge.",
        "`tristack crosscheck` (budget.csv)",
    )
    .stack(|(row, _)| row.study.stack)
    .code(|(row, _)| &row.code)
    .number("model_form", "1", |(row, _)| row.model_form())
    .means(MODEL_FORM);
    for part in Budget::PARTS {
        columns = columns
            .number(part.name, "m g", move |(_, slip)| {
                (part.value)(&slip.budget)
            })
            .means(part.meaning());
        let absent = |slip: &Extrapolation| (part.value)(&slip.budget).is_none();
        let mut slips = judgements.iter().filter_map(Judgement::slip).peekable();
        // Tables for people leave out a part that no row has.
        if slips.peek().is_none() || !slips.all(absent) {
            columns = columns.shown_as(part.heading, one_digit);
        }
    }
    columns
        .number("uncertainty", "m g", |(_, slip)| slip.budget.total())
        .means("sum of the parts")
        .shown_as("total", one_digit)
        .number("observed_order", "1", |(_, slip)| slip.order.observed)
        .means("order of convergence in the wall speed, if above the noise")
        .shown_as("observed order", |order| format!("{order:.3}"))
        .number("expected_order", "1", |(row, _)| {
            let (lowest, highest) = row.study.expected_orders();
            (lowest == highest).then_some(lowest)
        })
        .means("what it must be; absent where it may be from 0.5 to 2, since gravity must be applied slowly (springs that remember forces or are rescaled, viscoelastic damping)")
        .shown("expected")
        .cell(|(row, _)| ConvergenceOrder::range(row.study.expected_orders()))
        .rows(judgements.iter().filter_map(|row| Some((row, row.slip()?))))
}

fn evidence() -> String {
    let tiers = Evidence::ALL.map(|tier| {
        let (name, limit) = (tier.as_str(), tier.does_not_prove());
        format!("1. **{name}**: does not prove {limit}.\n")
    });
    format!("\n## Evidence, strongest first\n\n{}", tiers.concat())
}

/// Formats the codes and the rows for a terminal.
pub fn crosscheck_text(judgements: &[Judgement]) -> String {
    let rows = crosscheck(judgements);
    codes(judgements).shown().terminal()
        + &rows.shown().terminal()
        + &rows.units()
        + beyond_onset(judgements)
}

/// Returns a note if the force of any row rises beyond the onset of slip.
fn beyond_onset(judgements: &[Judgement]) -> &'static str {
    let rises = |row: &Judgement| row.judged_reference() != row.reference_force();
    match judgements.iter().any(rises) {
        true => {
            "where the force rises beyond the onset of slip, yield force, ± and exact limit are those of the peak; error, tolerance \
             and verdict are those of the onset (slip_onset and reference_onset in --format csv)\n"
        }
        false => "",
    }
}

/// Formats a page with the rows, their meaning, and their notes.
pub fn crosscheck_markdown(judgements: &[Judgement], command: &str) -> String {
    let command = markdown_code(command);
    let resolutions = judgements.iter().map(|row| row.study.resolution);
    let largest = resolutions.fold(MAX_TOLERANCE, f64::max);
    let mut page = format!(
        "# Crosscheck of {}\n\n\
         Made by tristack {} with {command}.\n\n\
         Yield force F = f/(m g) at vanishing wall speed, against the exact quasi-static limit under the \
         same contact convention. The uncertainty ± is in m g like F; error, tolerance and model form are relative to F + n + 1, \
         the load on the floor under n bodies and the one on top. Where the force rises beyond the onset of slip, F is that of the \
         peak, and error, tolerance and verdict are those of the onset. The tolerance \
         is the uncertainty, but at least {MIN_TOLERANCE:e} and at most {largest:e}. Model form is the distance of the \
         limit under the code's convention from the one under the paper's.\n\n",
        title(judgements),
        env!("CARGO_PKG_VERSION")
    );
    page += &codes(judgements).shown().markdown();
    page += "\n";
    page += &crosscheck(judgements).shown().markdown();
    page += "\n## Error budget\n\nThe parts of the numerical uncertainty in m g (ASME V&V 20), whose sum is ±, and \
             the order with which the runs converge in the wall speed.";
    page += &explaining(judgements);
    page += "\n\n";
    page += &budget(judgements).shown().markdown();
    page += &evidence();
    let noted = judgements.iter().filter(|row| !row.notes().is_empty());
    let remarks: String = noted.map(remark).collect();
    if !remarks.is_empty() {
        page += "\n## Remarks\n\n";
    }
    page + &remarks
}

/// Returns the words for the crosschecked stack in the title.
fn title(judgements: &[Judgement]) -> &'static str {
    match judgements.first().map(|row| row.study.stack.bodies) {
        Some(3) => "a sphere on three",
        Some(4) => "a sphere on four",
        Some(5) => "a sphere on five",
        _ => "the three-cylinder stack",
    }
}

/// Returns a sentence on the command that explains a row from the same runs. It is empty if any row comes from result
/// files, since such runs are not made here.
fn explaining(judgements: &[Judgement]) -> String {
    if judgements.iter().any(|row| row.source == Source::Files) {
        return String::new();
    }
    let mut cases = judgements.iter().flat_map(|row| &row.study.cases);
    let shortcuts = match cases.any(|case| case.protocol.shortcuts.is_some()) {
        true => " --shortcuts",
        false => "",
    };
    let bodies = judgements.first().map(|row| row.study.stack.bodies);
    let bodies = bodies.filter(|&bodies| bodies != PAPER_BODIES);
    let bodies = bodies.map_or(String::new(), |bodies| format!(" --bodies {bodies}"));
    format!(
        " How each part is computed, and all runs behind a row: `tristack crosscheck{bodies}{shortcuts} --explain \
         CODE/MU/STIFFNESS`."
    )
}

fn remark(row: &Judgement) -> String {
    let (mu, stiffness) = (friction(row.mu()), row.stiffness());
    let (code, verdict) = (row.code.clone(), row.grounds.in_words());
    let notes = markdown_notes(&row.notes().join("\n"));
    format!("- **{code}, mu = {mu}, stiffness = {stiffness}: {verdict}**\n\n  {notes}\n")
}

/// Returns a table for people, one row per code with the version, source and arms that its rows share.
fn codes(judgements: &[Judgement]) -> DataTable<'_> {
    let shared = |row: &Judgement| {
        let arms = row.study.convention.arms;
        (row.code.clone(), row.version.clone(), row.source, arms)
    };
    let mut rows: Vec<&Judgement> = Vec::new();
    for row in judgements {
        if !rows.iter().any(|other| shared(other) == shared(row)) {
            rows.push(row);
        }
    }
    Columns::<&Judgement>::for_people()
        .code(|row| &row.code)
        .version(|row| &row.version)
        .shown("version")
        .source(|row| row.source)
        .shown("source")
        .right("pair arm", |row| {
            arms_or_dash(row, row.known_convention().arms.pair)
        })
        .right("floor arm", |row| {
            arms_or_dash(row, row.known_convention().arms.floor)
        })
        .left("evidence", |row| Evidence::of(row).as_str().to_owned())
        .dispensable(1)
        .rows(rows)
}

/// Formats the arms of one kind of contact; those of rigid bodies are no question.
fn arms_or_dash(row: &Judgement, arms: ContactArms<Option<f64>>) -> String {
    match row.code.is_rigid() {
        true => "-".to_owned(),
        false => shown_arms(arms),
    }
}

/// Formats the arms of one kind of contact, as far as they are known.
pub(super) fn shown_arms(arms: ContactArms<Option<f64>>) -> String {
    if let (Some(torque), Some(kinematic)) = (arms.torque, arms.kinematic) {
        return ContactArms { torque, kinematic }.to_string();
    }
    let [torque, kinematic] = [arms.torque, arms.kinematic]
        .map(|arm| arm.map_or_else(|| "unknown".to_owned(), |arm| arm.to_string()));
    match torque == kinematic {
        true => torque,
        false => format!("{torque} (kinematic {kinematic})"),
    }
}
