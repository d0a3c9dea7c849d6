//! `tristack atlas`.

use super::out::Out;
use super::passport_files::{read_passports, read_verdicts};
use super::{CliError, ExitStatus, tell};
use crate::files::{FileError, Layout};
use crate::model::shown;
use crate::output::atlas_files;
use crate::study::atlas::Atlas;
use clap::Args;
use std::path::PathBuf;

/// Build a static site that compares contact conventions across codes and versions
///
/// The site is made from passports and fetches nothing: a matrix of codes and properties, one page per program with its
/// changes between versions, one page per property, and a page and a badge per passport. No code is run.
#[derive(Debug, Args)]
#[command(after_help = "Example: tristack atlas --out atlas, then open atlas/index.html")]
pub(super) struct Arguments {
    /// Directories with passports, as `probe --passports` files them, separated by commas [default: reference/passports]
    #[arg(long, value_name = "DIR1,DIR2", value_delimiter = ',')]
    passports: Vec<PathBuf>,
    /// Directory with verdicts, each the crosscheck.json of `crosscheck --out` under the name of its problem [default:
    /// reference/verdicts, or none if passports are named]
    #[arg(long, value_name = "DIR")]
    verdicts: Option<PathBuf>,
    /// Directory of the site
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// Where the passports and verdicts of a checkout are.
const PASSPORTS: &str = "reference/passports";
const VERDICTS: &str = "reference/verdicts";

/// Writes the site.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    let out = Out::claim(Some(&arguments.out), &layout())?;
    let (directories, verdicts) = match &arguments.passports[..] {
        [] => (
            vec![PathBuf::from(PASSPORTS)],
            Some(PathBuf::from(VERDICTS)),
        ),
        named => (named.to_owned(), None),
    };
    let mut passports = Vec::new();
    for directory in &directories {
        if arguments.passports.is_empty() && !directory.is_dir() {
            let message = "it is not here; accepted is a checkout of tristack, or --passports DIR";
            return Err(FileError::content(directory, message).into());
        }
        passports.extend(read_passports(directory)?);
    }
    let verdicts = arguments.verdicts.clone().or(verdicts);
    let problems = verdicts.as_deref().map(read_verdicts).transpose()?;
    let problems = problems.unwrap_or_default();
    let atlas = Atlas::new(passports);
    let written = out.write(|| atlas_files(&atlas, &problems, command));
    let count = atlas.passports.len();
    let edges = atlas.edges().len();
    tell!("{count} passports, {edges} changes from one version to the next");
    if written == ExitStatus::Success {
        tell!("{}", shown(&arguments.out.join("index.html")));
    }
    Ok(written)
}

/// Returns the files of a site.
fn layout() -> Layout {
    let files = [
        "atlas.csv",
        "*.html",
        "passports/*.json",
        "badges/*.svg",
        "verdicts/*.json",
    ];
    Layout::tables("atlas.json", &files)
}
