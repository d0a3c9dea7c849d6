//! `tristack probe`.

use super::options::{CodeParser, Format, RunOptions, selected_codes};
use super::progress::Reporter;
use super::tell;
use super::{CliError, ExitStatus, INTERRUPT};
use crate::code::Code;
use crate::output::{probe, probe_by_code};
use crate::runs::SelectedCode;
use crate::study::Verdict;
use crate::study::convention::Finding;
use crate::study::convention::{Probed, probe_all};
use clap::Args;

/// Measure what each code means by a contact, and compare it with what its adapter declares
///
/// Runs micro-tests of a single contact (cylinder on cylinder, on the floor, on the top wall) and reads
/// stiffness, damping, torque arm, kinematic arm, friction, Coulomb operand and the treatment of the
/// tangential spring off the reported motion and forces. Codes that are not installed are represented by
/// their recorded answers.
#[derive(Debug, Args)]
#[command(after_help = "Example: tristack probe --codes native,lammps --format json")]
pub struct Arguments {
    /// Which codes, separated by commas; each must be installed [default: all, recorded if necessary]
    #[arg(long, value_parser = CodeParser, value_delimiter = ',', value_name = "C1,C2")]
    codes: Vec<Code>,
    #[command(flatten)]
    run: RunOptions,
    /// How to print the findings
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// Probes, and prints the findings.
pub fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    let codes = selected_codes(&arguments.codes)?;
    let settings = arguments.run.settings()?;
    let reporter = Reporter::new();
    let probed = probe_all(&codes, &settings, &reporter);
    drop(reporter);
    let findings: Vec<Finding> = probed
        .iter()
        .flatten()
        .flat_map(|probe| probe.findings.clone())
        .collect();
    let people = || probe_by_code(&findings).terminal();
    super::print(
        &arguments
            .format
            .render(&[probe(&findings)], command, people),
    )?;
    Ok(conclude(&codes, &probed, &findings))
}

/// Says on standard error what the findings amount to, and returns the exit status.
fn conclude(codes: &[SelectedCode], probed: &[Probed], findings: &[Finding]) -> ExitStatus {
    for (who, result) in codes.iter().zip(probed) {
        if let Err(error) = result
            && !INTERRUPT.requested()
        {
            tell!("{} was not probed: {error}", who.name);
        } else if who.code.is_none() {
            tell!(
                "{} is not installed: its recorded answers stand in for it",
                who.name
            );
        }
    }
    let count = |verdict: Verdict| {
        let alike = findings.iter().filter(|finding| finding.verdict == verdict);
        alike.count()
    };
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
        ExitStatus::EngineFailed
    } else if agreeing < findings.len() {
        ExitStatus::Inconclusive
    } else {
        ExitStatus::Success
    }
}
