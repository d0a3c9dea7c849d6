//! `tristack probe`.

use super::options::{Format, RunOptions, participants};
use super::progress::Reporter;
use super::tell;
use super::{CliError, ExitStatus, INTERRUPT};
use crate::crosscheck::{Participant, Probed, probe_all};
use crate::engine::EngineName;
use crate::probe::Finding;
use crate::report::{probe_csv, probe_json, probe_table};
use crate::verdict::Verdict;
use clap::Args;

/// Measure what each engine means by a contact, and compare it with what its adapter declares
///
/// Runs micro-tests of a single contact (cylinder on cylinder, on the floor, on the top wall) and reads
/// stiffness, damping, torque arm, kinematic arm, friction, Coulomb operand and the treatment of the
/// tangential spring off the reported motion and forces. Engines that are not installed are represented by
/// their recorded answers.
#[derive(Debug, Args)]
#[command(after_help = "Example: tristack probe --engines native,lammps --format json")]
pub struct Arguments {
    /// Which engines, separated by commas; each must be installed [default: all, recorded if necessary]
    #[arg(long, value_enum, value_delimiter = ',', value_name = "E1,E2")]
    engines: Vec<EngineName>,
    #[command(flatten)]
    run: RunOptions,
    /// How to print the findings
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// Probes, and prints the findings.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let participants = participants(&arguments.engines)?;
    let settings = arguments.run.settings()?;
    let reporter = Reporter::new();
    let probed = probe_all(&participants, &settings, &reporter);
    drop(reporter);
    let findings: Vec<Finding> = probed
        .iter()
        .flatten()
        .flat_map(|probe| probe.findings.clone())
        .collect();
    super::print(&match arguments.format {
        Format::Table => probe_table(&findings).into_bytes(),
        Format::Json => probe_json(&findings).into_bytes(),
        Format::Csv => probe_csv(&findings),
    })?;
    Ok(conclude(&participants, &probed, &findings))
}

/// Says on standard error what the findings amount to, and returns the exit status.
fn conclude(participants: &[Participant], probed: &[Probed], findings: &[Finding]) -> ExitStatus {
    for (who, result) in participants.iter().zip(probed) {
        if let Err(error) = result
            && !INTERRUPT.requested()
        {
            tell!("{} was not probed: {error}", who.name);
        } else if who.engine.is_none() {
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
