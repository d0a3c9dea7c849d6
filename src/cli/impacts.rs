//! `tristack impacts`.

use super::convention::settle;
use super::interrupt::interrupted_after;
use super::options::{
    CodeOptions, ConventionOptions, Format, RunOptions, check_springs, find_all, selected_codes,
    tell_stand_ins,
};
use super::out::Out;
use super::progress::Reporter;
use super::{CliError, ExitStatus, tell, tell_grounds};
use crate::code::Code;
use crate::files::Layout;
use crate::output::{impacts, impacts_markdown, impacts_text, json};
use crate::runs::SelectedCode;
use crate::study::impact::{ImpactJudgement, ImpactStudy, plan_impacts};
use crate::study::{Campaign, Verdict};
use clap::Args;
use std::path::PathBuf;

/// Compare impacts of two cylinders, or of one on the floor, with their exact values
///
/// Lets every code carry out head-on and sliding impacts at four time steps, reads greatest overlap, duration,
/// restitution and the changes of tangential velocity and spin off the motions, extrapolates them to
/// vanishing time step, and compares them with the exact values under the code's own contact convention.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples: tristack impacts --codes liggghts,lammps --out impacts\n          \
    tristack impacts --codes native --law hertz --pair-arm -0.5"
)]
pub(super) struct Arguments {
    #[command(flatten)]
    codes: CodeOptions,
    #[command(flatten)]
    convention: ConventionOptions,
    /// Directory for impacts.csv, impacts.json and impacts.md
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    run: RunOptions,
    /// Format of the rows
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

impl Arguments {
    /// Returns the named codes, or else every code with the law that is asked for, by default the paper's.
    fn codes(&self) -> Result<Vec<SelectedCode>, CliError> {
        check_springs(&self.codes.named())?;
        let Some(power) = self.convention.law.power() else {
            return selected_codes(&self.codes.named());
        };
        let named = self.codes.of_power(power)?;
        match named.is_empty() {
            true => Ok(find_all(&Code::with_power(power))),
            false => selected_codes(&named),
        }
    }
}

/// Carries out and compares the impacts, and prints and writes the rows.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    let mut codes = arguments.codes()?;
    let layout = Layout::tables("impacts.json", &["impacts.csv", "impacts.md"]);
    let out = Out::claim(arguments.out.as_deref(), &layout)?;
    let settled = settle(&codes, &arguments.run)?;
    let mut studies: Vec<ImpactStudy> = Vec::new();
    for code in &settled {
        let convention = arguments.convention.of_contacts(code)?;
        studies.extend(plan_impacts(code, convention));
    }
    if codes.iter().all(|selected| !selected.name.is_native()) {
        // Some impacts are compared with native twins.
        codes.push(SelectedCode::find(Code::native()));
    }
    let settings = arguments.run.settings()?;
    let planned = studies.len();
    let judgements = Campaign::new(&codes, &settings, &Reporter::new()).carry_out(studies);
    let tables = [impacts(&judgements)];
    let people = || impacts_text(&judgements);
    let printed = arguments.format.print(&tables, command, people);
    let written = out.write_whole(judgements.len() == planned, || {
        vec![
            ("impacts.csv", tables[0].csv()),
            ("impacts.json", json(&tables, command)),
            ("impacts.md", impacts_markdown(&judgements, command)),
        ]
    });
    let found = conclude(&judgements, planned, &codes);
    Ok(found.max(printed).max(written))
}

/// Summarizes the rows on standard error, and returns the exit status.
fn conclude(judgements: &[ImpactJudgement], planned: usize, codes: &[SelectedCode]) -> ExitStatus {
    judgements.iter().for_each(tell_notes);
    tell_stand_ins(codes, |code| {
        let mut own = judgements.iter().filter(|one| one.code == *code);
        own.any(ImpactJudgement::is_recorded)
    });
    let agreeing = judgements
        .iter()
        .filter(|one| one.verdict() == Verdict::Agrees);
    let (agreeing, all) = (agreeing.count(), judgements.len());
    tell!("{agreeing} of {all} numbers agree");
    if all < planned {
        return interrupted_after(all, planned, "numbers");
    }
    let each = judgements
        .iter()
        .map(|row| match row.grounds.is_contradicted() {
            true => ExitStatus::Disagreement,
            false => ExitStatus::of_verdict(row.verdict()),
        });
    each.max().unwrap_or(ExitStatus::Success)
}

fn tell_notes(row: &ImpactJudgement) {
    let impact = &row.study.impact;
    let (target, quantity) = (impact.target.as_str(), row.study.quantity.as_str());
    let place = format!(
        "{}, {target}, speed {}, e_r {}, {quantity}",
        row.code, impact.approach_speed, impact.convention.restitution
    );
    tell_grounds(&row.grounds, &place);
}
