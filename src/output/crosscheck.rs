//! The rows of a crosscheck in every format.

use super::number::{friction, or_dash, relative, significant};
use super::table::{Columns, DataTable};
use crate::model::{ContactConvention, Stack};
use crate::study::yield_force::{
    Budget, ConvergenceOrder, Evidence, Extrapolation, Judgement, Row,
};
use crate::study::{MAX_TOLERANCE, MIN_TOLERANCE};

fn stack_of(row: &Row) -> Stack {
    Stack {
        floor_friction: row.mu,
        cylinder_friction: row.mu_d,
        stiffness: row.stiffness,
        stiffness_ratio: row.kappa,
    }
}

fn convention_of(row: &Row) -> ContactConvention {
    ContactConvention {
        pair_arm: row.pair_arm,
        floor_arm: row.floor_arm,
        ..ContactConvention::PAPER
    }
}

/// The rows.
pub fn crosscheck(judgements: &[Judgement]) -> DataTable<'_> {
    Columns::<&Judgement>::new(
        "crosscheck",
        "A row is the yield force of one stack by one code at vanishing wall speed, and the verdict on it.",
        "`tristack crosscheck` (crosscheck.csv, crosscheck.json), `tristack sweep` (sweep.csv, sweep.json), \
         `tristack report` (tables/yield_curves.csv, tables/scaling.csv, tables/literal.csv)",
    )
    .stack(|judgement| stack_of(&judgement.row))
    .text("code", "the code that was measured", |judgement| {
        judgement.row.code.as_str()
    })
    .shown("code")
    .text("version", "its version", |judgement| {
        judgement.row.version.clone()
    })
    .text(
        "source",
        "`live` if it ran on this machine, `recorded` if recorded runs stand in for it",
        |judgement| judgement.row.source.as_str(),
    )
    .shown("source")
    .arms(|judgement| convention_of(&judgement.row))
    .number(
        "yield_force",
        "m g",
        "yield force F at vanishing wall speed, read at the onset of slip",
        |judgement| judgement.row.yield_force,
    )
    .shown("yield force")
    .digits(|force| significant(force, 9))
    .number(
        "uncertainty",
        "m g",
        "its numerical uncertainty, the sum of the parts of the error budget",
        |judgement| judgement.row.uncertainty,
    )
    .shown("±")
    .digits(|uncertainty| format!("{uncertainty:.0e}"))
    .text("reference", "the theory that it is compared with", |judgement| {
        judgement.row.reference.clone()
    })
    .number(
        "reference_force",
        "m g",
        "F by that theory, under the contact convention of the code",
        |judgement| judgement.row.reference_force,
    )
    .shown("exact limit")
    .digits(|force| significant(force, 9))
    .number(
        "error",
        "1",
        "(yield_force − reference_force)/(reference_force + 3)",
        |judgement| judgement.row.error,
    )
    .shown("error")
    .digits(relative)
    .number(
        "tolerance",
        "1",
        "largest error that agrees, relative to reference_force + 3",
        |judgement| judgement.row.tolerance,
    )
    .shown("tolerance")
    .digits(|tolerance| format!("{tolerance:.1e}"))
    .number(
        "model_form",
        "1",
        "distance of the limit under the code's convention from the one under the paper's, relative to F + 3",
        |judgement| judgement.row.model_form,
    )
    .shown("model form")
    .digits(relative)
    .text("verdict", "`agrees`, `differs`, `inconclusive`, `no-yield`, `failed` or `missing`", |judgement| {
        judgement.row.verdict.as_str()
    })
    .shown("verdict")
    .rows(judgements)
}

fn part(value: f64) -> String {
    format!("{value:.0e}")
}

/// What the uncertainty of every row that has one consists of, and how its runs converge.
pub fn budget(judgements: &[Judgement]) -> DataTable<'_> {
    let rows = judgements.iter().filter_map(|judgement| {
        let slip = judgement.slip.as_ref()?;
        Some((judgement, slip))
    });
    let mut columns = Columns::<(&Judgement, &Extrapolation)>::new(
        "budget",
        "A row says what the numerical uncertainty (ASME V&V 20) of one row of `crosscheck` consists of, and \
         how its runs converge.",
        "`tristack crosscheck` (budget.csv)",
    )
    .stack(|(judgement, _)| stack_of(&judgement.row))
    .text("code", "the code that was measured", |(judgement, _)| {
        judgement.row.code.as_str()
    })
    .shown("code")
    .number(
        "model_form",
        "1",
        "distance of the limit under the code's convention from the one under the paper's, relative to F + 3",
        |(judgement, _)| judgement.row.model_form,
    );
    for own in Budget::PARTS {
        columns = columns
            .number(own.name, "m g", own.how, move |(_, slip)| {
                (own.value)(&slip.budget)
            })
            .shown(own.heading)
            .digits(part);
    }
    columns
        .number("uncertainty", "m g", "sum of the parts", |(_, slip)| {
            slip.budget.total()
        })
        .shown("total")
        .digits(part)
        .number(
            "observed_order",
            "1",
            "order with which the runs converge in the wall speed; absent below the noise",
            |(_, slip)| slip.order.observed,
        )
        .shown("observed order")
        .digits(|order| format!("{order:.3}"))
        .number(
            "expected_order",
            "1",
            "order with which they must converge",
            |_| ConvergenceOrder::EXPECTED,
        )
        .shown("expected")
        .rows(rows)
}

fn evidence() -> String {
    let tiers = Evidence::ALL.map(|tier| {
        let (name, limit) = (tier.as_str(), tier.does_not_prove());
        format!("1. **{name}**: does not prove {limit}.\n")
    });
    format!("\n## Evidence, strongest first\n\n{}", tiers.concat())
}

/// The codes and the rows for a terminal.
pub fn crosscheck_text(judgements: &[Judgement]) -> String {
    codes(judgements).shown().terminal() + &crosscheck(judgements).shown().terminal()
}

/// A page with the rows, what they mean, and what explains every verdict that is not `agrees`.
pub fn crosscheck_markdown(judgements: &[Judgement], command: &str) -> String {
    let mut page = format!(
        "# Crosscheck of the three-cylinder stack\n\n\
         Made by tristack {} with `{command}`.\n\n\
         Yield force F = f/(m g) at vanishing wall speed, against the exact quasi-static limit under the \
         same contact convention. The uncertainty ± is in m g like F; error, tolerance and model form are relative to F + 3. The tolerance \
         is the uncertainty, but at least {MIN_TOLERANCE:e} and at most {MAX_TOLERANCE:e}. Model form is the distance of the \
         limit under the code's convention from the one under the paper's.\n\n",
        env!("CARGO_PKG_VERSION")
    );
    page += &codes(judgements).shown().markdown();
    page += "\n";
    page += &crosscheck(judgements).shown().markdown();
    page += "\n## Error budget\n\nThe parts of the numerical uncertainty in m g (ASME V&V 20), whose sum is ±, and \
             the order with which the runs converge in the wall speed. How each part is computed, and all \
             runs behind a row: `tristack crosscheck --explain CODE/MU/STIFFNESS`.\n\n";
    page += &budget(judgements).shown().markdown();
    page += &evidence();
    let explained = judgements
        .iter()
        .filter(|judgement| !judgement.notes.is_empty());
    for (index, judgement) in explained.enumerate() {
        if index == 0 {
            page += "\n## Remarks\n\n";
        }
        page += &remark(judgement);
    }
    page
}

fn remark(judgement: &Judgement) -> String {
    let row = &judgement.row;
    let subject = format!(
        "{}, mu = {}, stiffness = {}: {}",
        row.code,
        friction(row.mu),
        row.stiffness,
        row.verdict
    );
    let notes = judgement.notes.join("\n").replace('\n', "\n  ");
    format!("- **{subject}**\n\n  {notes}\n")
}

/// The codes in the order of their first rows, with what all their rows share.
fn codes(judgements: &[Judgement]) -> DataTable<'_> {
    let mut rows: Vec<&Row> = Vec::new();
    for Judgement { row, .. } in judgements {
        let shared = |row: &Row| {
            let arms = [row.pair_arm, row.floor_arm];
            (row.code, row.version.clone(), row.source, arms)
        };
        if !rows.iter().any(|other| shared(other) == shared(row)) {
            rows.push(row);
        }
    }
    Columns::<&Row>::for_people()
        .left("code", |row| row.code.to_string())
        .left("version", |row| or_dash(&row.version))
        .left("source", |row| row.source.as_str().to_owned())
        .right("pair arm", |row| row.pair_arm.to_string())
        .right("floor arm", |row| row.floor_arm.to_string())
        .left("evidence", |row| Evidence::of(row).as_str().to_owned())
        .rows(rows)
}
