//! Effect of the contact law on the yield force: the styles of all codes side by side, for one material.

use super::crosscheck::shown_arms;
use super::number::{digits, friction_in_tex, rounded, small};
use super::table::{Columns, DataTable, Table};
use super::text::markdown_code;
use crate::model::TangentialStiffening;
use crate::study::Verdict;
use crate::study::yield_force::Judgement;

/// Title of the page and of the section of the report.
pub const LAWS_TITLE: &str = "What your contact law does to the yield force";

/// Explanation of the conventions in a table of laws.
pub const LAWS_EXPLAINED: &str = "An arm $r_1$ is that of the torque, in $R = r + r_1 \\times$ overlap, with that of the surface velocity \
    where it is another one. Springs that remember a displacement have the force of the present stiffness; those that \
    remember a force grow by the present stiffness alone. A spring that is rescaled is reduced while the contact opens, and has \
    the limit of one that is not where every contact is loaded all the way, as here.";

/// Explanation of the forces in a table of laws.
pub const FORCES_EXPLAINED: &str = "Exact quasi-static limits $F = f/(mg)$ at the onset of slip / at the largest force, one number where \
    both are the same; none where the top wall reaches the bottom cylinders before the floor slips. The stiffness is $K r\\sqrt{r}/(mg)$.";

/// Returns the lead of the page: why the forces differ, and what that means.
pub fn laws_lead(judgements: &[Judgement]) -> String {
    let ratio = judgements
        .first()
        .map_or(f64::NAN, |row| row.study.stack.stiffness_ratio);
    format!(
        "Every code calls it Hertz or Mindlin, and the same stack of the same material ({}) begins to slip \
         at other forces in each: by what its tangential spring remembers, by how stiff its floor is beside a pair, and \
         where forces act. Here are the exact quasi-static limits of all of them side by side, and how well each code \
         was measured to have its own. A code that agrees does what its row says, and two rows that differ are two \
         models, not an error of either.",
        material(ratio)
    )
}

/// Describes the material behind Mindlin's ratio of stiffnesses κ = (2 − ν)/(2 (1 − ν)) by ν, or by κ where ν would
/// be outside 0 to 0.5.
fn material(ratio: f64) -> String {
    let poisson = (2.0 * ratio - 2.0) / (2.0 * ratio - 1.0);
    match (0.0..=0.5).contains(&poisson) {
        true => format!("Poisson’s ratio {}", rounded(poisson)),
        false => format!("stiffness ratio {}", rounded(ratio)),
    }
}

/// Returns the first row of each code, in order.
fn styles(judgements: &[Judgement]) -> Vec<&Judgement> {
    let mut styles: Vec<&Judgement> = Vec::new();
    for row in judgements {
        if !styles.iter().any(|known| known.code == row.code) {
            styles.push(row);
        }
    }
    styles
}

/// Returns the table of contact conventions, one row per style.
pub fn law_conventions(judgements: &[Judgement]) -> DataTable<'_> {
    let law = |row: &&Judgement| row.known_law();
    Columns::<&Judgement>::new(
        "laws",
        "A row is what one style of a code means by a contact.",
        "`tristack report` (tables/laws.csv)",
    )
    .code(|row| &row.code)
    .text("style", |row| row.code.label())
    .means("the style in words")
    .shown("style")
    .law(law)
    .again("history")
    .shown("springs remember")
    .again("floor_ratio")
    .shown_as("floor $K$ / pair $K$", digits::<4>)
    .again("tangential_stiffening")
    .shown("$k_t$ times 2/(2 − overlap)")
    .cell(
        move |row| match law(row).map(|law| law.tangential_stiffening) {
            None | Some(TangentialStiffening::None) => "-".to_owned(),
            Some(contacts) => contacts.as_str().to_owned(),
        },
    )
    .convention(|row| Some(row.known_convention()))
    .right("pair arm", |row| {
        shown_arms(row.known_convention().arms.pair)
    })
    .right("floor arm", |row| {
        shown_arms(row.known_convention().arms.floor)
    })
    .rows(styles(judgements))
}

/// Returns a table for people: slip onset and largest force of each style and stiffness, with a column per friction.
pub fn law_forces(judgements: &[Judgement]) -> Table {
    let sorted = |value: fn(&Judgement) -> f64| {
        let mut all: Vec<f64> = judgements.iter().map(value).collect();
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    };
    let frictions = sorted(Judgement::mu);
    let first = [("stiffness".to_owned(), true), ("code".to_owned(), false)];
    let headings = frictions
        .iter()
        .map(|&mu| (format!("$\\mu = {}$", friction_in_tex(mu)), true));
    let mut table = Table::new(first.into_iter().chain(headings));
    for stiffness in sorted(Judgement::stiffness) {
        for style in styles(judgements) {
            let own = judgements.iter();
            let own = own.filter(|row| row.code == style.code && row.stiffness() == stiffness);
            let own: Vec<&Judgement> = own.collect();
            let forces = frictions.iter().map(|&mu| {
                let row = own.iter().find(|row| row.mu() == mu);
                row.map_or_else(|| "-".to_owned(), |row| exact_forces(row))
            });
            let mut cells = vec![stiffness.to_string(), style.code.to_string()];
            cells.extend(forces);
            table.push(cells);
        }
    }
    table
}

/// Formats the onset and the peak, or the peak alone unless the onset is below it.
fn exact_forces(row: &Judgement) -> String {
    let shown = digits::<5>;
    let limit = &row.study.limit;
    match (limit.slip_onset, limit.yield_force) {
        (Some(onset), Some(peak)) if onset < peak => format!("{} / {}", shown(onset), shown(peak)),
        (_, Some(peak)) => shown(peak),
        _ => "-".to_owned(),
    }
}

/// Returns a table for people that shows how well the runs of each style agree with its own limit.
fn agreement(judgements: &[Judgement]) -> DataTable<'_> {
    let rows_of = move |own: &Judgement| {
        let code = own.code.clone();
        judgements.iter().filter(move |row| row.code == code)
    };
    Columns::<&Judgement>::for_people()
        .left("code", |row| row.code.to_string())
        .left("version", |row| row.version.clone())
        .of_outside()
        .left("runs", |row| row.source.as_str().to_owned())
        .right("rows that agree", move |row| {
            let agreeing = rows_of(row).filter(|own| own.verdict() == Verdict::Agrees);
            let yielding = rows_of(row).filter(|own| own.reference_force().is_some());
            format!("{} of {}", agreeing.count(), yielding.count())
        })
        .right("largest error", move |row| {
            let errors = rows_of(row).filter_map(|own| own.error());
            let largest = errors.map(f64::abs).reduce(f64::max);
            largest.map_or_else(|| "-".to_owned(), small)
        })
        .rows(styles(judgements))
}

/// Formats the page on the styles, their forces and how well they were measured; `figure` is its picture's file name.
pub fn laws_markdown(judgements: &[Judgement], figure: &str, command: &str) -> String {
    format!(
        "# {LAWS_TITLE}\n\n{}\n\n\
         Made by tristack {} with {}. The equations are in docs/theory.md, section 11.\n\n\
         ![Load at the onset of slip over the floor friction]({figure})\n\n\
         ## What each style means by a contact\n\n{}\n{LAWS_EXPLAINED}\n\n\
         ## Onset of slip / largest force\n\n{FORCES_EXPLAINED}\n\n{}\n\
         ## Measured\n\n\
         The error is the distance of the measured slip onset from the exact one, relative to $F + 3$.\n\n{}",
        laws_lead(judgements),
        env!("CARGO_PKG_VERSION"),
        markdown_code(command),
        law_conventions(judgements).shown().markdown(),
        law_forces(judgements).markdown(),
        agreement(judgements).shown().markdown()
    )
}
