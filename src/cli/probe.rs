//! `tristack probe`.

use super::options::{CodeOptions, Format, RunOptions, selected_codes};
use super::progress::Reporter;
use super::{CliError, ExitStatus, INTERRUPT, tell};
use crate::output::{probe, probe_by_code};
use crate::runs::SelectedCode;
use crate::study::Verdict;
use crate::study::convention::{Finding, Probed, probe_all};
use clap::Args;

/// Measure the contact convention of each code, and compare it with the declared one
///
/// Runs micro-tests of a single contact (cylinder on cylinder, on the floor, on the top wall) and determines
/// stiffness, damping, torque arm, kinematic arm, friction, Coulomb operand and the treatment of the
/// tangential spring from the reported motion and forces. Recorded answers stand in for codes that are not
/// installed.
#[derive(Debug, Args)]
#[command(after_help = "Example: tristack probe --codes native,lammps --format json")]
pub(super) struct Arguments {
    #[command(flatten)]
    codes: CodeOptions,
    #[command(flatten)]
    run: RunOptions,
    /// Format of the findings
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// Probes the codes and prints the findings.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    let codes = selected_codes(&arguments.codes.named)?;
    let settings = arguments.run.settings()?;
    let probed = probe_all(&codes, &settings, &Reporter::new());
    let findings: Vec<Finding> = probed
        .iter()
        .flatten()
        .flat_map(|probe| probe.findings.clone())
        .collect();
    let people = || probe_by_code(&findings).terminal();
    let tables = [probe(&findings)];
    let printed = arguments.format.print(&tables, command, people);
    Ok(conclude(&codes, &probed, &findings).max(printed))
}

/// Summarizes the findings on standard error, and returns the exit status.
fn conclude(codes: &[SelectedCode], probed: &[Probed], findings: &[Finding]) -> ExitStatus {
    for (selected, result) in codes.iter().zip(probed) {
        if let Err(error) = result
            && !INTERRUPT.requested()
        {
            tell!("{} was not probed: {error}", selected.name);
        } else if selected.code.is_none() {
            let name = selected.name;
            tell!("{name} is not installed: its recorded answers stand in for it");
        }
    }
    for (selected, result) in codes.iter().zip(probed) {
        if let Ok(probe) = result
            && let Some(digits) = probe.few_digits
        {
            let name = selected.name;
            tell!("{name}: its motions are printed with {digits} digits, too few to contradict it");
        }
    }
    let count = |verdict| findings.iter().filter(|own| own.verdict == verdict).count();
    let (agreeing, differing) = (count(Verdict::Agrees), count(Verdict::Differs));
    tell!(
        "{agreeing} of {} properties are as declared, {differing} differ, {} are inconclusive",
        findings.len(),
        findings.len() - agreeing - differing
    );
    if INTERRUPT.requested() {
        ExitStatus::Interrupted
    } else if differing > 0 {
        ExitStatus::Disagreement
    } else if probed.iter().any(Result::is_err) {
        ExitStatus::CodeFailed
    } else if agreeing < findings.len() {
        ExitStatus::Inconclusive
    } else {
        ExitStatus::Success
    }
}
