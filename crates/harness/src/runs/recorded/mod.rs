//! Recorded runs, which stand in for codes that are not installed.

mod archive;
mod embedded;
mod recording;
mod table;

pub use recording::{RecordedRun, Recording};

use crate::code::{Code, Run};
use crate::files::{FileError, Links, read_bounded};
use crate::model::{Case, shown};
use crate::runs::{ProbeRecord, RunSummary};
use archive::{Members, unpack};
use recording::{PROBE, Row, archive_path, parse_table, probe_in, series_in, table_path};
use std::borrow::Cow;
use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use thiserror::Error;

/// Stands in messages for the directory of the embedded files.
const IN_THE_PROGRAM: &str = "tristack:recorded";
/// Size limit for files of recorded runs, in bytes.
const MAX_FILE: u64 = 1 << 24;

/// The recorded runs of all codes, in the program or in a directory. The files of a code are read once, when
/// something of it is first asked for.
#[derive(Debug, Clone, Default)]
pub struct Recorded {
    /// Their directory; absent if they are in the program.
    directory: Option<PathBuf>,
    codes: Arc<Mutex<BTreeMap<Code, Arc<Files>>>>,
}

/// The content of the files of one code, or why they cannot be read.
#[derive(Debug, Default)]
struct Files {
    table: OnceLock<Result<Table, Arc<FileError>>>,
    members: OnceLock<Result<Members, Arc<FileError>>>,
}

/// Rows by the content hash of their cases.
type Table = HashMap<String, Row>;

/// The reason why a recorded run cannot stand in.
#[derive(Debug, Error)]
pub enum RecordedError {
    #[error("{code} is not installed, and there is no recorded {what} in {}; install it ({}), record it where it is installed (tristack record --codes {code}), or let TRISTACK_REFERENCE name the directory of recorded runs", shown(path), code.installation_hint())]
    Absent {
        code: Code,
        what: &'static str,
        path: PathBuf,
    },
    /// The `recorded` and the `current` hash of its inputs differ.
    #[error(
        "the recorded run in {} was made with another deck (hash {recorded}, now {current}); refresh it with: tristack record --codes {code}",
        shown(path)
    )]
    OtherDeck {
        code: Code,
        path: PathBuf,
        recorded: String,
        current: String,
    },
    #[error(transparent)]
    Damaged(#[from] Arc<FileError>),
}

impl From<FileError> for RecordedError {
    fn from(error: FileError) -> Self {
        Self::Damaged(Arc::new(error))
    }
}

impl Recorded {
    /// The recorded runs inside this program.
    pub fn embedded() -> Self {
        Self::default()
    }

    /// The recorded runs in `directory`.
    pub fn new(directory: &Path) -> Self {
        Self {
            directory: Some(directory.to_owned()),
            ..Self::default()
        }
    }

    /// Returns the recorded run of `case` by `code`, if its series is kept.
    ///
    /// # Errors
    /// If there is none, its series is not kept, it is damaged, or it was made with another deck.
    pub fn run(&self, code: &Code, case: &Case) -> Result<Run, RecordedError> {
        let files = self.files(code);
        let row = self.row(&files, code, case)?;
        let path = archive_path(self.directory(), code);
        let Some(name) = &row.series else {
            return Err(self.absent(code, "series of this case"));
        };
        let series = series_in(self.members(&files, code)?, name, case, &path)?;
        Ok(Run {
            case: *case,
            series,
            provenance: row.summary.provenance.clone(),
        })
    }

    /// Returns the summary of the recorded run of `case` by `code`.
    ///
    /// # Errors
    /// If there is none, or the table is damaged, or the run was made with another deck.
    pub fn summary(&self, code: &Code, case: &Case) -> Result<RunSummary, RecordedError> {
        let files = self.files(code);
        Ok(self.row(&files, code, case)?.summary.clone())
    }

    /// Returns the recorded probe of `code`.
    ///
    /// # Errors
    /// If there is none, or it is damaged, or a micro-test was made with another deck, other parameters or
    /// arguments.
    pub fn probe(&self, code: &Code) -> Result<ProbeRecord, RecordedError> {
        let files = self.files(code);
        let path = archive_path(self.directory(), code);
        let record = probe_in(self.members(&files, code)?, &path)?;
        let own = |record: &ProbeRecord| record.provenance.identity.code == code.as_str();
        let Some(record) = record.filter(own) else {
            return Err(self.absent(code, "probe"));
        };
        if let Some(answer) = record.outdated(|test| code.deck_hash(test)) {
            return Err(RecordedError::OtherDeck {
                code: code.clone(),
                path: path.join(PROBE),
                recorded: answer.input_hash.clone(),
                current: code.deck_hash(&answer.test),
            });
        }
        Ok(record)
    }

    /// Reads the recorded runs of `code`, whatever the deck they were made with.
    pub fn recording(&self, code: &Code) -> Result<Recording, FileError> {
        let directory = self.directory();
        let table = self.read(&table_path(directory, code))?;
        let archive = self.read(&archive_path(directory, code))?;
        let (Some(table), Some(archive)) = (table, archive) else {
            return Ok(Recording::default());
        };
        let table = String::from_utf8_lossy(&table);
        Recording::from_files(&table, &archive, directory, code)
    }

    /// Returns the error that nothing of the kind `what` is recorded for `code`.
    pub(crate) fn absent(&self, code: &Code, what: &'static str) -> RecordedError {
        let path = archive_path(self.directory(), code);
        RecordedError::Absent {
            code: code.clone(),
            what,
            path,
        }
    }

    fn files(&self, code: &Code) -> Arc<Files> {
        let mut codes = self.codes.lock().unwrap_or_else(PoisonError::into_inner);
        Arc::clone(codes.entry(code.clone()).or_default())
    }

    fn row<'a>(
        &self,
        files: &'a Files,
        code: &Code,
        case: &Case,
    ) -> Result<&'a Row, RecordedError> {
        let path = table_path(self.directory(), code);
        let Some(row) = self.table(files, code)?.get(&case.content_hash()) else {
            let what = "run of this case";
            return Err(RecordedError::Absent {
                code: code.clone(),
                what,
                path,
            });
        };
        let recorded = row.summary.provenance.deck_hash.clone();
        let current = code.deck_hash(case);
        if recorded == current {
            return Ok(row);
        }
        Err(RecordedError::OtherDeck {
            code: code.clone(),
            path,
            recorded,
            current,
        })
    }

    fn table<'a>(&self, files: &'a Files, code: &Code) -> Result<&'a Table, RecordedError> {
        let table = files.table.get_or_init(|| {
            let path = table_path(self.directory(), code);
            let Some(content) = self.read(&path)? else {
                return Ok(Table::new());
            };
            let rows = parse_table(&String::from_utf8_lossy(&content), &path, code)?;
            let keyed = rows.into_iter();
            let keyed = keyed.map(|row| (row.summary.case.content_hash(), row));
            Ok(keyed.collect())
        });
        table.as_ref().map_err(|error| Arc::clone(error).into())
    }

    fn members<'a>(&self, files: &'a Files, code: &Code) -> Result<&'a Members, RecordedError> {
        let members = files.members.get_or_init(|| {
            let path = archive_path(self.directory(), code);
            let packed = self.read(&path)?;
            Ok(packed.map_or(Ok(Members::new()), |packed| unpack(&packed, &path))?)
        });
        members.as_ref().map_err(|error| Arc::clone(error).into())
    }

    /// Reads the file at `path`, in the program or in the directory; returns `None` if there is none.
    fn read(&self, path: &Path) -> Result<Option<Cow<'static, [u8]>>, FileError> {
        if self.directory.is_none() {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            return Ok(embedded::file(&name).map(Cow::Borrowed));
        }
        match read_bounded(path, MAX_FILE, Links::Followed) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
            read => Ok(Some(Cow::Owned(read.map_err(FileError::reading(path))?))),
        }
    }

    fn directory(&self) -> &Path {
        let directory = self.directory.as_deref();
        directory.unwrap_or(Path::new(IN_THE_PROGRAM))
    }
}
