//! `tristack report`.

use super::convention::settle;
use super::options::{
    CodeList, CodeListParser, RunOptions, check_compress, find_all, selected_codes,
};
use super::out::Out;
use super::progress::Reporter;
use super::published::{checkout, status as published_status};
use super::{CliError, ExitStatus, INTERRUPT, complain, tell};
use crate::code::Code;
use crate::files::Layout;
use crate::model::{PAPER_BODIES, Power, shown};
use crate::output::{Origin, friction, published_summary, report_files};
use crate::paper::claims::{ClaimJudgement, ClaimVerdict, PaperTheory, Register, judge};
use crate::paper::reproduction::{Reproduction, Scope, reproduce};
use crate::runs::SelectedCode;
use crate::study::yield_force::Judgement;
use clap::Args;
use std::path::PathBuf;

/// Largest number of rows that are named when the exit status is explained.
const MOST_ROWS: usize = 10;

/// Write the reproducibility report for the paper
///
/// Runs everything behind the paper's figures and some further ones, tests every statement of the paper, and
/// writes report.html, gallery.html (all figures), report.md, claims.json, junit.xml, tables/ and
/// figures/. Finished runs are reused, and recorded runs stand in for codes that are not installed.
#[derive(Debug, Args)]
#[command(after_help = "Example: tristack report --out report")]
pub(super) struct Arguments {
    /// Codes to run besides native, separated by commas; each must be installed [default: all, recorded if
    /// necessary]
    #[arg(long, alias = "code", value_parser = CodeListParser, value_name = "C1,C2")]
    codes: Vec<CodeList>,
    /// Also run all of figure 2(a) at the paper's literal wall speed and time step, for some ten minutes
    #[arg(long)]
    literal: bool,
    /// Checkout of the authors' repository, github.com/Ryudo-Suzuki/arXiv-2511.06807: reproduce its numbers, and show them
    /// beside the others
    #[arg(long, value_name = "DIR")]
    published: Option<PathBuf>,
    /// Directory of the report
    #[arg(long, value_name = "DIR", default_value = "report")]
    out: PathBuf,
    #[command(flatten)]
    run: RunOptions,
}

/// Reproduces the paper and writes the report.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    let named = CodeList::all(&arguments.codes);
    check_compress(&named, PAPER_BODIES)?;
    let [codes, hertz_codes] = [Power::Linear, Power::Hertz].map(|power| codes_of(&named, power));
    let (codes, hertz_codes) = (codes?, hertz_codes?);
    let register = Register::paper()?;
    let checkout = arguments.published.as_deref().map(checkout);
    let checkout = checkout.transpose()?;
    let out = Out::claim(Some(&arguments.out), &layout())?;
    let settings = arguments.run.settings()?;
    settle(&codes, &arguments.run)?;
    settle(&hertz_codes, &arguments.run)?;
    let scope = Scope {
        codes: &codes,
        hertz_codes: &hertz_codes,
        settings: &settings,
        literal: arguments.literal,
        published: checkout.as_ref(),
    };
    let outcome = reproduce(&scope, &Reporter::new());
    let reproduced = match outcome {
        Ok(Some(reproduced)) => reproduced,
        Err(error) if !INTERRUPT.requested() => return Err(error.into()),
        _ => {
            complain!(
                "interrupted: no report is written; every finished run is kept, and the same command goes on from here"
            );
            return Ok(ExitStatus::Interrupted);
        }
    };
    let claims = judge(&register, &PaperTheory::printed(), Some(&reproduced));
    let all = codes.iter().chain(&hertz_codes);
    let absent = all.filter(|selected| selected.code.is_none());
    let origin = Origin {
        command: command.to_owned(),
        recorded: absent.map(|selected| selected.name.clone()).collect(),
        literal: arguments.literal,
        lock_file: include_bytes!("../../Cargo.lock"),
    };
    let found = conclude(&reproduced, &claims);
    let written = out.write(|| {
        let files = report_files(&reproduced, &claims, &origin).into_iter();
        files.map(|file| (file.name, file.content)).collect()
    });
    if written == ExitStatus::Success {
        tell!("{}", shown(&arguments.out.join("report.html")));
    }
    Ok(found.max(written))
}

/// Returns the codes with a law of this `power` among those that were `named`, and the native one; all such codes if
/// none was named.
fn codes_of(named: &[Code], power: Power) -> Result<Vec<SelectedCode>, CliError> {
    if named.is_empty() {
        return Ok(find_all(&Code::with_power(power)));
    }
    let mut own = vec![Code::native()];
    own.extend(named.iter().filter(|code| code.has_power(power)).cloned());
    selected_codes(&own)
}

/// Returns the files of a report.
fn layout() -> Layout {
    let files = [
        "report.html",
        "gallery.html",
        "report.md",
        "junit.xml",
        "tables/*.csv",
        "figures/*.svg",
        "figures/*.pdf",
    ];
    Layout::tables("claims.json", &files)
}

/// Summarizes the claims on standard error, and returns the exit status of the runs alone: a claim that does not
/// hold is a result.
fn conclude(reproduction: &Reproduction, claims: &[ClaimJudgement]) -> ExitStatus {
    let count = |verdict| claims.iter().filter(|own| own.verdict == verdict).count();
    tell!(
        "{} claims: {} hold, {} hold approximately, {} do not hold as stated, {} cannot be tested",
        claims.len(),
        count(ClaimVerdict::Holds),
        count(ClaimVerdict::Approximately),
        count(ClaimVerdict::Fails),
        count(ClaimVerdict::Untestable)
    );
    let rows: Vec<&Judgement> = reproduction.judged_rows().collect();
    let statuses = rows.iter().map(|row| ExitStatus::of_row(row));
    let published = reproduction.published.as_ref();
    if let Some(published) = published {
        tell!("{}", published_summary(published));
    }
    let statuses = statuses.chain(published.map(published_status));
    let status = statuses.max().unwrap_or(ExitStatus::Success);
    let open: Vec<&Judgement> = rows.iter().copied().filter(|row| !row.passes()).collect();
    tell!(
        "exit status {}: {} of {} rows agree or have no yield where none is expected{}",
        status.code(),
        rows.len() - open.len(),
        rows.len(),
        if open.is_empty() { "" } else { "; all but" }
    );
    for row in open.iter().take(MOST_ROWS) {
        tell!("  {}", said_of(row));
    }
    if open.len() > MOST_ROWS {
        tell!(
            "  and {} more: section \"What was not tested\" and the tables",
            open.len() - MOST_ROWS
        );
    }
    status
}

/// Describes a row, its verdict and the reason.
fn said_of(row: &Judgement) -> String {
    format!(
        "{} at mu = {}, stiffness {}: {}: {}",
        row.code,
        friction(row.mu()),
        row.stiffness(),
        row.verdict(),
        row.reason()
    )
}
