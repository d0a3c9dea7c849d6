//! The rows of a crosscheck in every format.

use super::number::{friction, optional, relative, significant};
use super::table::Table;
use crate::code::Code;
use crate::study::yield_force::{ConvergenceOrder, Evidence, Judgement};
use crate::study::{MAX_TOLERANCE, MIN_TOLERANCE, Source, Verdict};
use serde::Serialize;

/// The rows with every digit.
pub fn crosscheck_csv(judgements: &[Judgement]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for judgement in judgements {
        writer
            .serialize(Row::new(judgement))
            .expect("plain rows are written to memory");
    }
    writer.into_inner().expect("memory is flushed")
}

#[derive(Serialize)]
struct Row<'a> {
    code: Code,
    version: &'a str,
    source: Source,
    mu: f64,
    stiffness: f64,
    kappa: f64,
    pair_torque_arm: f64,
    pair_kinematic_arm: f64,
    floor_torque_arm: f64,
    floor_kinematic_arm: f64,
    yield_force: Option<f64>,
    uncertainty: Option<f64>,
    reference: &'static str,
    reference_force: Option<f64>,
    error: Option<f64>,
    tolerance: Option<f64>,
    model_form: Option<f64>,
    verdict: Verdict,
}

impl<'a> Row<'a> {
    fn new(judgement: &'a Judgement) -> Self {
        Self {
            code: judgement.code,
            version: &judgement.version,
            source: judgement.source,
            mu: judgement.mu(),
            stiffness: judgement.stiffness(),
            kappa: judgement.study.stack.stiffness_ratio,
            pair_torque_arm: judgement.study.convention.arms.pair.torque,
            pair_kinematic_arm: judgement.study.convention.arms.pair.kinematic,
            floor_torque_arm: judgement.study.convention.arms.floor.torque,
            floor_kinematic_arm: judgement.study.convention.arms.floor.kinematic,
            yield_force: judgement.yield_force(),
            uncertainty: judgement.uncertainty(),
            reference: "quasistatic",
            reference_force: judgement.reference_force(),
            error: judgement.error(),
            tolerance: judgement.tolerance(),
            model_form: judgement.model_form(),
            verdict: judgement.verdict(),
        }
    }
}

/// What the uncertainty of a row consists of, in m g, and how its runs converge.
#[derive(Serialize)]
struct BudgetRow<'a> {
    code: &'a str,
    mu: f64,
    stiffness: f64,
    model_form: Option<f64>,
    wall_speed: f64,
    time_step: f64,
    preparation: f64,
    sampling: f64,
    round_off: f64,
    print_precision: f64,
    shortcuts: f64,
    uncertainty: f64,
    observed_order: Option<f64>,
    expected_order: f64,
}

impl<'a> BudgetRow<'a> {
    fn new(judgement: &'a Judgement) -> Option<Self> {
        let slip = judgement.slip()?;
        let budget = &slip.budget;
        let row = judgement;
        Some(Self {
            code: row.code.as_str(),
            mu: row.mu(),
            stiffness: row.stiffness(),
            model_form: row.model_form(),
            wall_speed: budget.wall_speed,
            time_step: budget.time_step,
            preparation: budget.preparation,
            sampling: budget.sampling,
            round_off: budget.round_off,
            print_precision: budget.print_precision,
            shortcuts: budget.shortcuts,
            uncertainty: budget.total(),
            observed_order: slip.order.observed,
            expected_order: ConvergenceOrder::EXPECTED,
        })
    }
}

/// The error budget of every row that has one, with every digit.
pub fn budget_csv(judgements: &[Judgement]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in judgements.iter().filter_map(BudgetRow::new) {
        writer
            .serialize(row)
            .expect("plain rows are written to memory");
    }
    writer.into_inner().expect("memory is flushed")
}

fn budgets(judgements: &[Judgement]) -> Table {
    let mut table = Table::new(&[
        "stiffness>",
        "mu>",
        "code",
        "wall speed>",
        "time step>",
        "preparation>",
        "sampling>",
        "round-off>",
        "print precision>",
        "shortcuts>",
        "total>",
        "observed order>",
        "expected>",
    ]);
    for row in judgements.iter().filter_map(BudgetRow::new) {
        let part = |value: f64| format!("{value:.0e}");
        table.push(vec![
            row.stiffness.to_string(),
            friction(row.mu),
            row.code.to_owned(),
            part(row.wall_speed),
            part(row.time_step),
            part(row.preparation),
            part(row.sampling),
            part(row.round_off),
            part(row.print_precision),
            part(row.shortcuts),
            part(row.uncertainty),
            optional(row.observed_order, |order| format!("{order:.3}")),
            row.expected_order.to_string(),
        ]);
    }
    table
}

fn evidence() -> String {
    let tiers = Evidence::ALL.map(|tier| {
        let (name, limit) = (tier.as_str(), tier.does_not_prove());
        format!("1. **{name}**: does not prove {limit}.\n")
    });
    format!("\n## Evidence, strongest first\n\n{}", tiers.concat())
}

/// The rows as a list of objects.
pub fn crosscheck_json(judgements: &[Judgement]) -> String {
    let rows: Vec<Row> = judgements.iter().map(Row::new).collect();
    serde_json::to_string_pretty(&rows).expect("plain rows have a JSON form") + "\n"
}

/// The codes and the rows for a terminal.
pub fn crosscheck_table(judgements: &[Judgement]) -> String {
    codes(judgements).terminal() + &crosscheck_rows(judgements).terminal()
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
    page += &codes(judgements).markdown();
    page += "\n";
    page += &crosscheck_rows(judgements).markdown();
    page += "\n## Error budget\n\nThe parts of the numerical uncertainty in m g (ASME V&V 20), whose sum is ±, and \
             the order with which the runs converge in the wall speed. How each part is computed, and all \
             runs behind a row: `tristack crosscheck --explain CODE/MU/STIFFNESS`.\n\n";
    page += &budgets(judgements).markdown();
    page += &evidence();
    let explained = judgements
        .iter()
        .filter(|judgement| !judgement.notes().is_empty());
    for (index, judgement) in explained.enumerate() {
        if index == 0 {
            page += "\n## Remarks\n\n";
        }
        page += &remark(judgement);
    }
    page
}

fn remark(judgement: &Judgement) -> String {
    let row = judgement;
    let subject = format!(
        "{}, mu = {}, stiffness = {}: {}",
        row.code,
        friction(row.mu()),
        row.stiffness(),
        row.verdict()
    );
    let notes = judgement.notes().join("\n").replace('\n', "\n  ");
    format!("- **{subject}**\n\n  {notes}\n")
}

/// The codes in the order of their first rows, with what all their rows share.
fn codes(judgements: &[Judgement]) -> Table {
    let mut table = Table::new(&[
        "code",
        "version",
        "source",
        "pair arm>",
        "floor arm>",
        "evidence",
    ]);
    let mut seen = Vec::new();
    for row in judgements {
        let version = if row.version.is_empty() {
            "-"
        } else {
            &row.version
        };
        let cells = vec![
            row.code.to_string(),
            version.to_owned(),
            row.source.as_str().to_owned(),
            row.study.convention.arms.pair.to_string(),
            row.study.convention.arms.floor.to_string(),
            Evidence::of(row).as_str().to_owned(),
        ];
        if !seen.contains(&cells) {
            table.push(cells.clone());
            seen.push(cells);
        }
    }
    table
}

/// The rows, with the digits that people want.
pub fn crosscheck_rows(judgements: &[Judgement]) -> Table {
    let mut table = Table::new(&[
        "stiffness>",
        "mu>",
        "code",
        "source",
        "yield force>",
        "±>",
        "exact limit>",
        "error>",
        "tolerance>",
        "model form>",
        "verdict",
    ]);
    for row in judgements {
        table.push(vec![
            row.stiffness().to_string(),
            friction(row.mu()),
            row.code.to_string(),
            row.source.as_str().to_owned(),
            optional(row.yield_force(), |force| significant(force, 9)),
            optional(row.uncertainty(), |uncertainty| {
                format!("{uncertainty:.0e}")
            }),
            optional(row.reference_force(), |force| significant(force, 9)),
            optional(row.error(), relative),
            optional(row.tolerance(), |tolerance| format!("{tolerance:.1e}")),
            optional(row.model_form(), relative),
            row.verdict().to_string(),
        ]);
    }
    table
}
