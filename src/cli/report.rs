//! `tristack report`.

use super::options::{CodeParser, RunOptions, selected_codes, writable};
use super::progress::Reporter;
use super::tell;
use super::{CliError, ExitStatus, INTERRUPT};
use crate::code::Code;
use crate::files::{FileError, write_atomically};
use crate::model::shown;
use crate::output::{Origin, ReportFile, report_files};
use crate::paper::claims::{ClaimJudgement, ClaimVerdict, PaperTheory, Register, judge};
use crate::paper::reproduction::{Reproduction, Scope, reproduce};
use crate::runs::SelectedCode;
use clap::Args;
use std::path::{Path, PathBuf};

/// Name of the directory that is written if none is given.
const DEFAULT_DIRECTORY: &str = "report";

/// The reproducibility report for the paper
///
/// Carries out everything behind the paper's figures, and some that it lacks, tests every statement of the
/// paper, and writes report.html, report.md, claims.json, junit.xml, ro-crate-metadata.json, tables/ and
/// figures/. Finished runs are reused, and codes that are not installed are represented by recorded runs.
#[derive(Debug, Args)]
#[command(after_help = "Example: tristack report --out report")]
pub struct Arguments {
    /// Which codes, separated by commas, native among them; each must be installed [default: all, recorded
    /// if necessary]
    #[arg(long, value_parser = CodeParser, value_delimiter = ',', value_name = "C1,C2")]
    codes: Vec<Code>,
    /// Also run all of figure 2(a) at the paper's literal wall speed and time step: some ten minutes
    #[arg(long)]
    literal: bool,
    /// Directory of the report
    #[arg(long, value_name = "DIR", default_value = DEFAULT_DIRECTORY)]
    out: PathBuf,
    #[command(flatten)]
    run: RunOptions,
}

/// Reproduces the paper and writes the report.
pub fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    let mut codes = arguments.codes.clone();
    if !codes.is_empty() && !codes.contains(&Code::NATIVE) {
        codes.push(Code::NATIVE);
    }
    let codes = selected_codes(&codes)?;
    let register = Register::paper()?;
    writable(&arguments.out)?;
    let settings = arguments.run.settings()?;
    let scope = Scope {
        codes: &codes,
        settings: &settings,
        literal: arguments.literal,
    };
    let reporter = Reporter::new();
    let reproduced = reproduce(&scope, &reporter);
    drop(reporter);
    let reproduced = match reproduced {
        Ok(Some(reproduced)) => reproduced,
        _ if INTERRUPT.requested() => return Ok(interrupted()),
        Ok(None) => return Ok(interrupted()),
        Err(error) => return Err(error.into()),
    };
    let claims = judge(&register, &PaperTheory::printed(), &reproduced);
    let origin = origin(arguments, command, &codes);
    let files = report_files(&reproduced, &claims, &origin);
    write(&arguments.out, &files)?;
    Ok(conclude(&arguments.out, &reproduced, &claims))
}

fn interrupted() -> ExitStatus {
    tell!(
        "interrupted: no report is written; every finished run is kept, and the same command goes on from here"
    );
    ExitStatus::Interrupted
}

/// How the report came about.
fn origin(arguments: &Arguments, command: &str, codes: &[SelectedCode]) -> Origin {
    let absent = codes.iter().filter(|who| who.code.is_none());
    Origin {
        command: command.to_owned(),
        recorded: absent.map(|who| who.name).collect(),
        literal: arguments.literal,
    }
}

fn write(directory: &Path, files: &[ReportFile]) -> Result<(), FileError> {
    for file in files {
        let path = directory.join(&file.name);
        write_atomically(&path, &file.content)?;
    }
    Ok(())
}

/// Says what was found, and returns the exit status of the runs: a claim that does not hold is a result.
fn conclude(
    directory: &Path,
    reproduction: &Reproduction,
    claims: &[ClaimJudgement],
) -> ExitStatus {
    let count = |verdict| {
        claims
            .iter()
            .filter(|claim| claim.verdict == verdict)
            .count()
    };
    tell!(
        "{} claims: {} hold, {} hold approximately, {} do not hold as stated, {} cannot be tested",
        claims.len(),
        count(ClaimVerdict::Holds),
        count(ClaimVerdict::Approximately),
        count(ClaimVerdict::Fails),
        count(ClaimVerdict::Untestable)
    );
    tell!("{}", shown(&directory.join("report.html")));
    let curves = ExitStatus::of(&reproduction.yield_curves);
    curves.max(ExitStatus::of(&reproduction.scaling))
}
