//! `tristack crosscheck --profile published`.

use super::crosscheck::Arguments;
use super::out::Out;
use super::progress::Reporter;
use super::{CliError, ExitStatus, complain, tell};
use crate::code::Code;
use crate::files::Layout;
use crate::model::{InvalidValue, shown};
use crate::output::{
    json, published_markdown, published_summary, published_tables, published_text,
};
use crate::paper::published::{Checkout, Fit, Published};
use crate::runs::SelectedCode;
use crate::study::Campaign;
use std::path::Path;

const TABLES: [&str; 4] = [
    "published.csv",
    "published_series.csv",
    "contradictions.csv",
    "published_files.csv",
];
const PAGE: &str = "published.md";

/// Reproduces everything that was published, prints and writes it.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    let directory = arguments.published.as_deref();
    let directory = directory.ok_or_else(|| InvalidValue {
        key: "--profile".to_owned(),
        value: "published".to_owned(),
        accepted: "this together with --published DIR, a checkout of the authors' repository"
            .to_owned(),
    })?;
    let named = arguments.codes.named();
    if let Some(other) = named.iter().find(|code| !code.is_native()) {
        return Err(InvalidValue {
            key: "--codes".to_owned(),
            value: other.to_string(),
            accepted: "native: no other code does what the authors' program does".to_owned(),
        }
        .into());
    }
    let checkout = checkout(directory)?;
    let mut files = TABLES.to_vec();
    files.push(PAGE);
    let out = Out::claim(
        arguments.out.as_deref(),
        &Layout::tables("published.json", &files),
    )?;
    let settings = arguments.run.settings()?;
    let native = [SelectedCode::find(Code::native())];
    let reporter = Reporter::new();
    let campaign = Campaign::new(&native, &settings, &reporter);
    let Some(published) = Published::repeat(&checkout, &campaign) else {
        complain!("interrupted: nothing is printed or written; every finished run is kept");
        return Ok(ExitStatus::Interrupted);
    };
    let tables = published_tables(&published);
    let people = || published_text(&published);
    let printed = arguments.format.print(&tables, command, people);
    let written = out.write(|| {
        let csv = TABLES
            .into_iter()
            .zip(tables.iter().map(|table| table.csv()));
        csv.chain([
            ("published.json", json(&tables, command)),
            (PAGE, published_markdown(&published, command)),
        ])
        .collect()
    });
    tell!("{}", published_summary(&published));
    Ok(status(&published).max(printed).max(written))
}

/// Reads the checkout that --published names.
pub(super) fn checkout(directory: &Path) -> Result<Checkout, CliError> {
    if !Checkout::is_in(directory) {
        return Err(InvalidValue {
            key: "--published".to_owned(),
            value: shown(directory),
            accepted: "a checkout of github.com/Ryudo-Suzuki/arXiv-2511.06807, a directory with fig2a/data or figures/fig2a/data"
                .to_owned(),
        }
        .into());
    }
    Ok(Checkout::read(directory)?)
}

/// Returns the exit status. A number that no known run gives is a result, not an error.
pub(super) fn status(published: &Published) -> ExitStatus {
    let statuses = published.fits().map(|fit| match fit {
        Fit::EveryDigit | Fit::Alike | Fit::Unknown => ExitStatus::Success,
        Fit::Differs => ExitStatus::Disagreement,
        Fit::Failed => ExitStatus::CodeFailed,
    });
    statuses.max().unwrap_or(ExitStatus::Success)
}
