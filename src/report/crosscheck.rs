//! The rows of a crosscheck in every format.

use super::number::{friction, optional, relative, significant};
use super::table::Table;
use crate::crosscheck::{BAR, FLOOR, Judgement, Row};

/// The rows with every digit.
pub fn crosscheck_csv(judgements: &[Judgement]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for judgement in judgements {
        writer
            .serialize(&judgement.row)
            .expect("plain rows are written to memory");
    }
    writer.into_inner().expect("memory is flushed")
}

/// The rows as a list of objects.
pub fn crosscheck_json(judgements: &[Judgement]) -> String {
    let rows: Vec<&Row> = judgements.iter().map(|judgement| &judgement.row).collect();
    serde_json::to_string_pretty(&rows).expect("plain rows have a JSON form") + "\n"
}

/// The rows for a terminal.
pub fn crosscheck_table(judgements: &[Judgement]) -> String {
    table(judgements).terminal()
}

/// A page with the rows, what they mean, and what explains every verdict that is not `agrees`.
pub fn crosscheck_markdown(judgements: &[Judgement], command: &str) -> String {
    let mut page = format!(
        "# Crosscheck of the three-cylinder stack\n\n\
         Made by tristack {} with `{command}`.\n\n\
         Yield force F = f/(m g) at vanishing wall speed, against the exact quasi-static limit under the \
         same contact convention. `error`, `tolerance` and `model form` are relative to F + 3; the \
         uncertainty (wall speed, time step, preparation, sampling, round-off) is in m g. The tolerance is the \
         uncertainty, but at least {FLOOR:e} and at most {BAR:e}.\n\n",
        env!("CARGO_PKG_VERSION")
    );
    page += &table(judgements).markdown();
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
        row.engine,
        friction(row.mu),
        row.stiffness,
        row.verdict
    );
    let notes = judgement.notes.join("\n").replace('\n', "\n  ");
    format!("- **{subject}**\n\n  {notes}\n")
}

fn table(judgements: &[Judgement]) -> Table {
    let mut table = Table::new(&[
        "stiffness>",
        "mu>",
        "engine",
        "version",
        "source",
        "arms>",
        "yield force>",
        "uncertainty>",
        "exact limit>",
        "error>",
        "tolerance>",
        "model form>",
        "verdict",
    ]);
    for Judgement { row, .. } in judgements {
        table.push(vec![
            row.stiffness.to_string(),
            friction(row.mu),
            row.engine.to_string(),
            row.version.clone(),
            row.source.as_str().to_owned(),
            format!("{}, {}", row.pair_arm, row.floor_arm),
            optional(row.yield_force, |force| significant(force, 9)),
            optional(row.uncertainty, |uncertainty| format!("{uncertainty:.0e}")),
            optional(row.reference_force, |force| significant(force, 9)),
            optional(row.error, relative),
            optional(row.tolerance, |tolerance| format!("{tolerance:.1e}")),
            optional(row.model_form, relative),
            row.verdict.to_string(),
        ]);
    }
    table
}
