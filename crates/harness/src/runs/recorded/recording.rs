//! The recorded runs of one code: a table of all runs, and an archive of the series and micro-tests that are kept.

use super::MAX_FILE;
use super::archive::{Members, is_archive, pack, unpack};
use super::table::{from_csv, has_title, to_csv};
use crate::code::{Code, Run};
use crate::files::{FileError, Links, read_bounded, write_atomically};
use crate::model::Case;
use crate::runs::entry::parse_series;
use crate::runs::{ProbeRecord, RunSummary};
use crate::series::Series;
use serde_json::{Value, from_value};
use std::cmp::Ordering;
use std::collections::HashSet;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// The file in the archive that holds the micro-tests.
pub(super) const PROBE: &str = "probe.json";
/// The column that names a series in the archive.
const SERIES: &str = "series";
/// The first columns of the table.
const FIRST_COLUMNS: [&str; 6] = [
    "case.stack",
    "case.protocol",
    "case.convention",
    "estimates",
    "last_force",
    "contact_force",
];

/// A run of the table.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    pub(super) summary: RunSummary,
    /// Name of its series in the archive, if that is kept.
    pub(super) series: Option<String>,
}

/// A run as it is recorded.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordedRun {
    /// Its summary.
    pub summary: RunSummary,
    /// Its series, if that is kept.
    pub series: Option<Series>,
}

impl RecordedRun {
    /// Keeps `run` with its series.
    pub fn with_series(run: Run) -> Self {
        let series = Some(run.series.clone());
        let summary = RunSummary::new(run);
        Self { summary, series }
    }

    /// Keeps only the summary of a run.
    pub fn without_series(summary: RunSummary) -> Self {
        let series = None;
        Self { summary, series }
    }
}

/// The recorded runs of one code.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Recording {
    /// The runs, each case once.
    pub runs: Vec<RecordedRun>,
    /// The micro-tests of `tristack probe`.
    pub probe: Option<ProbeRecord>,
}

impl Recording {
    /// Adds `run`, replacing an older one of the same case.
    pub fn put(&mut self, run: RecordedRun) {
        let mut known = self.runs.iter_mut();
        match known.find(|known| known.summary.case == run.summary.case) {
            Some(known) => *known = run,
            None => self.runs.push(run),
        }
    }

    /// Refuses a `directory` in which anything but a recording has the name of the table or the archive of `code`.
    ///
    /// # Errors
    /// If there is a file of one of these names that is no recording, or anything but a file.
    pub fn check_place(directory: &Path, code: &Code) -> Result<(), FileError> {
        let is_table = |content: &[u8]| has_title(content, &title(code));
        check_own(&table_path(directory, code), is_table)?;
        check_own(&archive_path(directory, code), is_archive)
    }

    /// Writes the table and the archive of `code` in `directory`, replacing older ones and nothing else.
    pub fn save(&self, directory: &Path, code: &Code) -> Result<(), FileError> {
        Self::check_place(directory, code)?;
        let (table, archive) = self.to_files(code);
        write_atomically(&archive_path(directory, code), &archive)?;
        write_atomically(&table_path(directory, code), table.as_bytes())
    }

    /// Returns the content of the table and of the archive.
    pub fn to_files(&self, code: &Code) -> (String, Vec<u8>) {
        let mut runs: Vec<&RecordedRun> = self.runs.iter().collect();
        runs.sort_by(|left, right| compare(&left.summary.case, &right.summary.case));
        let mut members = Members::new();
        let rows = runs.into_iter().map(|run| {
            let series = run.series.as_ref().map(|series| {
                let name = series_name(&run.summary.case, &members);
                members.insert(name.clone(), series.to_csv());
                name
            });
            let mut row = serde_json::to_value(&run.summary).expect("plain data has a JSON form");
            row[SERIES] = series.into();
            row
        });
        let rows: Vec<Value> = rows.collect();
        if let Some(probe) = &self.probe {
            members.insert(PROBE.to_owned(), probe.to_json().into_bytes());
        }
        let text = to_csv(&rows, &title(code), &FIRST_COLUMNS);
        (text, pack(&members))
    }

    /// Reads the content of the table and the archive of `code`, which come from `directory`.
    pub fn from_files(
        table: &str,
        archive: &[u8],
        directory: &Path,
        code: &Code,
    ) -> Result<Self, FileError> {
        let path = archive_path(directory, code);
        let members = unpack(archive, &path)?;
        let rows = parse_table(table, &table_path(directory, code), code)?;
        let runs = rows.into_iter().map(|row| {
            let Row { summary, series } = row;
            let series = series.map(|name| series_in(&members, &name, &summary.case, &path));
            let series = series.transpose()?;
            Ok(RecordedRun { summary, series })
        });
        Ok(Self {
            runs: runs.collect::<Result<_, FileError>>()?,
            probe: probe_in(&members, &path)?,
        })
    }
}

/// The title of the table of `code`.
fn title(code: &Code) -> String {
    format!("Runs of {code}, recorded by `tristack record`; see reference/README.md")
}

/// Refuses to replace the file at `path`, if there is one, unless its content `is_own`.
fn check_own(path: &Path, is_own: impl FnOnce(&[u8]) -> bool) -> Result<(), FileError> {
    match read_bounded(path, MAX_FILE, Links::Refused) {
        Ok(content) if is_own(&content) => Ok(()),
        Ok(_) => Err(FileError::content(
            path,
            "it is no recording of tristack, and is not replaced; move it away, or let TRISTACK_REFERENCE name another \
             directory",
        )),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(()),
        Err(error) => Err(FileError::writing(path)(error)),
    }
}

/// Compares cases in the order of the table: by stack, then by protocol.
fn compare(left: &Case, right: &Case) -> Ordering {
    let numbers = |case: &Case| {
        let (stack, protocol) = (&case.stack, &case.protocol);
        let (mu, stiffness) = (stack.floor_friction, stack.stiffness);
        [mu, stiffness, -protocol.wall_speed, protocol.time_step]
    };
    let ordered = numbers(left).partial_cmp(&numbers(right));
    let ordered = ordered.filter(|order| order.is_ne());
    ordered.unwrap_or_else(|| left.content_hash().cmp(&right.content_hash()))
}

/// Chooses a name for the series of `case`, readable and not yet among `members`.
fn series_name(case: &Case, members: &Members) -> String {
    let (stack, protocol) = (&case.stack, &case.protocol);
    let name = format!(
        "mu-{}_stiffness-{}/speed-{:e}_dt-{}",
        stack.floor_friction, stack.stiffness, protocol.wall_speed, protocol.time_step
    );
    let plain = format!("{name}.csv");
    let numbered = (2..).map(|number| format!("{name}_{number}.csv"));
    let mut names = std::iter::once(plain).chain(numbered);
    let free = names.find(|name| !members.contains_key(name));
    free.unwrap_or(name)
}

/// Returns the path of the table of `code` in `directory`.
pub(super) fn table_path(directory: &Path, code: &Code) -> PathBuf {
    directory.join(format!("{code}.csv"))
}

/// Returns the path of the archive of `code` in `directory`.
pub(super) fn archive_path(directory: &Path, code: &Code) -> PathBuf {
    directory.join(format!("{code}.tar.gz"))
}

/// Reads the runs of `code` from the `text` of the table at `path`.
///
/// # Errors
/// If the table is damaged, or holds an invalid case, the same case twice, or a run of another code.
pub(super) fn parse_table(text: &str, path: &Path, code: &Code) -> Result<Vec<Row>, FileError> {
    let rows = from_csv(text).and_then(|rows| {
        let mut known = HashSet::new();
        let rows = rows.into_iter().map(|row| {
            let row = parse_row(row, code)?;
            let case = &row.summary.case;
            match known.insert(case.content_hash()) {
                true => Ok(row),
                false => Err(format!("{case} is there twice")),
            }
        });
        rows.collect()
    });
    rows.map_err(|message| FileError::content(path, message))
}

fn parse_row(mut row: Value, code: &Code) -> Result<Row, String> {
    let series = row.as_object_mut().and_then(|row| row.remove(SERIES));
    let series = from_value(series.unwrap_or_default()).map_err(|error| error.to_string())?;
    let summary: RunSummary = from_value(row).map_err(|error| error.to_string())?;
    let case = &summary.case;
    case.validate()
        .map_err(|invalid| format!("{case}: {invalid}"))?;
    let own = &summary.provenance.identity.code;
    if own != code.as_str() {
        return Err(format!(
            "{case}: `provenance.identity.code` is {own}, but must be {code}"
        ));
    }
    Ok(Row { summary, series })
}

/// Reads the series `name` of `case`, one of the `members` of the archive at `path`.
pub(super) fn series_in(
    members: &Members,
    name: &str,
    case: &Case,
    path: &Path,
) -> Result<Series, FileError> {
    let path = path.join(name);
    let Some(content) = members.get(name) else {
        let absent = std::io::Error::other("the table names it, but the archive lacks it");
        return Err(FileError::reading(&path)(absent));
    };
    parse_series(&path, content, case)
}

/// Reads the micro-tests among the `members` of the archive at `path`.
pub(super) fn probe_in(members: &Members, path: &Path) -> Result<Option<ProbeRecord>, FileError> {
    let probe = members.get(PROBE);
    let probe = probe.map(|text| ProbeRecord::parse(text, &path.join(PROBE)));
    probe.transpose()
}
