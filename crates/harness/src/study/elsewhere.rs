//! Plans of the runs of a code that are made elsewhere, in rounds where later runs depend on earlier results.

use super::convention::{ROUNDS, converged, settled_by_files};
use super::yield_force::{Measurement, Method, planned};
use super::{MAX_TOLERANCE, RESOLUTIONS};
use crate::code::{Code, FailureKind, PlannedRun, PreparedRun, ResultFiles, SettledCode, TaskKind};
use crate::files::{FileError, Links, parse_json, read_bounded};
use crate::model::{ContactTest, InvalidValue, Stack, exact, readable};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// The file that holds a plan.
pub const PLAN: &str = "plan.json";
const SCHEMA: &str = "tristack/plan/1";
/// Largest plan that is read, in bytes: some hundred thousand runs.
const LARGEST_PLAN: u64 = 1 << 28;

/// A row of a crosscheck that is to be judged.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlannedRow {
    /// The stack.
    pub stack: Stack,
    /// How its yield force is read.
    pub method: Method,
    /// The largest uncertainty with which the force agrees, in units of the load on the floor; the usual one if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub resolution: Option<f64>,
}

/// Everything that one code is to run elsewhere.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    schema: String,
    /// The command that made it.
    pub command: String,
    /// Version of tristack that made it.
    pub tristack: String,
    /// Name of the code.
    pub code: String,
    /// The folder that describes the code; absent for the codes that are part of tristack.
    pub folder: Option<PathBuf>,
    /// Version of the program, in plans of earlier versions of tristack: planning starts no program.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub version: Option<String>,
    /// The rows that are to be judged.
    pub rows: Vec<PlannedRow>,
    /// Whether more runs can be planned once the planned micro-tests have results: further micro-tests, and the runs
    /// of a code that leaves something out of its convention.
    pub continues: bool,
    /// Steps of all runs.
    pub steps: u64,
    /// Duration of all runs on one core in seconds, by the forecast of the manifest.
    pub seconds: f64,
    /// The runs, micro-tests first.
    pub runs: Vec<PlannedRun>,
}

impl Plan {
    /// Reads the plan in `directory`; `None` if there is none.
    ///
    /// # Errors
    /// If a plan exists that this version cannot read.
    pub fn read(directory: &Path) -> Result<Option<Self>, FileError> {
        let path = directory.join(PLAN);
        let content = match read_bounded(&path, LARGEST_PLAN, Links::Refused) {
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            content => content.map_err(FileError::reading(&path))?,
        };
        let plan: Self = parse_json(&content, &path)?;
        if plan.schema != SCHEMA {
            let message = format!("`schema` is {}; accepted is {SCHEMA}", plan.schema);
            return Err(FileError::content(&path, message));
        }
        let checked = plan.check();
        checked.map_err(|message| FileError::content(&path, message))?;
        Ok(Some(plan))
    }

    /// Refuses invalid stacks and runs, and those that stand there twice: somebody may have edited the file.
    fn check(&self) -> Result<(), String> {
        for row in &self.rows {
            row.stack.validate().map_err(|error| error.to_string())?;
            if let Some(own) = row.resolution.filter(|own| !RESOLUTIONS.contains(own)) {
                let (least, most) = RESOLUTIONS.into_inner();
                return Err(format!(
                    "`resolution` is {own}; accepted is {least:e} to {most}"
                ));
            }
        }
        let mut rows = self.rows.iter().enumerate();
        if let Some((index, row)) = rows.find(|(index, row)| self.rows[..*index].contains(row)) {
            let (mu, stiffness) = (row.stack.floor_friction, row.stack.stiffness);
            return Err(format!(
                "`rows` has the row of mu {mu}, stiffness {stiffness} twice (number {}); accepted is each row once",
                index + 1
            ));
        }
        let mut known = BTreeSet::new();
        let mut runs = self.runs.iter();
        if let Some(run) = runs.find(|run| !known.insert(&run.deck_hash)) {
            return Err(format!(
                "`runs` has the run with the deck_hash {} twice; accepted is each run once",
                readable(&run.deck_hash)
            ));
        }
        self.runs.iter().try_for_each(PlannedRun::check)
    }

    /// Plans `rows` for `code`, whose results are expected below `root`. Reads the results that are already there:
    /// those of the first round of micro-tests determine the second, and both determine what the manifest leaves out
    /// of the convention.
    ///
    /// # Errors
    /// If the code cannot run a task.
    pub fn new(
        code: &Code,
        rows: Vec<PlannedRow>,
        root: &Path,
        command: &str,
    ) -> Result<(Self, Vec<PreparedRun>), InvalidValue> {
        let (mut prepared, further) = micro_tests(code, root)?;
        // What single precision resolves, the micro-tests show.
        let declared = code.as_declared().filter(|_| !accepts_resolution(&rows));
        let settled = declared.or_else(|| {
            let runs: Vec<PlannedRun> = prepared.iter().map(|one| one.run.clone()).collect();
            settled_by_files(&ResultFiles::new(code.clone(), "", root, &runs))
        });
        // Without micro-tests nothing will settle the convention.
        let is_open = settled.is_none() && !prepared.is_empty();
        if !is_open {
            let settled = settled.unwrap_or_else(|| code.unmeasured("it has not been measured"));
            for row in &rows {
                prepared.extend(row.runs(&settled)?);
            }
        }
        let mut known = BTreeSet::new();
        prepared.retain(|one| known.insert(one.run.deck_hash.clone()));
        let runs: Vec<PlannedRun> = prepared.iter().map(|one| one.run.clone()).collect();
        let plan = Self {
            schema: SCHEMA.to_owned(),
            command: command.to_owned(),
            tristack: env!("CARGO_PKG_VERSION").to_owned(),
            code: code.as_str().to_owned(),
            folder: code.folder().map(Path::to_owned),
            version: None,
            rows,
            continues: further || is_open,
            steps: runs.iter().map(|run| run.steps).sum(),
            seconds: runs.iter().map(|run| run.seconds).sum(),
            runs,
        };
        Ok((plan, prepared))
    }

    /// Whether a row accepts what the code resolves, for which its micro-tests are read first.
    pub fn accepts_resolution(&self) -> bool {
        accepts_resolution(&self.rows)
    }

    /// The measurements of the rows by `code`.
    pub fn measurements(&self, code: &SettledCode) -> Vec<Measurement> {
        let rows = self.rows.iter();
        rows.map(|row| row.measurement(code)).collect()
    }

    /// The results of `code` below `root`, attributed to this `version`.
    pub fn results(&self, code: Code, version: &str, root: &Path) -> ResultFiles {
        ResultFiles::new(code, version, root, &self.runs)
    }

    /// What is wrong with the result of each run; `None` where it exists and is usable.
    pub fn troubles(&self, code: &Code, root: &Path) -> Vec<Option<FailureKind>> {
        let runs = self.runs.iter();
        runs.map(|run| run.trouble(code, root)).collect()
    }

    /// What the first run without a result has written last to standard error; runs that have written nothing are
    /// skipped.
    pub fn first_complaint(&self, troubles: &[Option<FailureKind>], root: &Path) -> Option<String> {
        let mut runs = self.runs.iter().zip(troubles);
        runs.find_map(|(run, trouble)| match trouble {
            Some(FailureKind::Awaited(_)) => run.complaint(root),
            _ => None,
        })
    }

    /// Indented JSON with a final newline.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("plain data has a JSON form") + "\n"
    }
}

impl PlannedRow {
    /// The row of `measurement`.
    pub fn of(measurement: &Measurement) -> Self {
        Self {
            stack: measurement.stack,
            method: measurement.method,
            resolution: Some(measurement.resolution).filter(|own| *own > MAX_TOLERANCE),
        }
    }

    fn measurement(&self, code: &SettledCode) -> Measurement {
        let power = code.name().law().power;
        let convention = code.stack_convention(power, self.stack.bodies);
        let measurement = planned(code, &self.stack, convention, self.method);
        match self.resolution {
            Some(resolution) => measurement.accepting(resolution),
            None => measurement,
        }
    }

    /// The runs of the row, in directories named after the stack and the number of the run in its measurement.
    fn runs(&self, code: &SettledCode) -> Result<Vec<PreparedRun>, InvalidValue> {
        let (mu, stiffness) = (self.stack.floor_friction, self.stack.stiffness);
        let (mu, stiffness) = (exact(mu), exact(stiffness));
        let cases = self.measurement(code).cases;
        let runs = (1..).zip(&cases).map(|(run, case)| {
            let place = format!("runs/mu-{mu}-stiffness-{stiffness}/{run}");
            code.name().prepare_elsewhere(case, &place)
        });
        runs.collect()
    }
}

fn accepts_resolution(rows: &[PlannedRow]) -> bool {
    rows.iter().any(|row| row.resolution.is_some())
}

/// The micro-tests of all rounds that can be planned already, and whether further rounds follow: the results of a
/// round determine the tests of the next. Those of the last round with one time step may show that shorter ones are
/// needed.
fn micro_tests(code: &Code, root: &Path) -> Result<(Vec<PreparedRun>, bool), InvalidValue> {
    if code.check_task(TaskKind::Motion).is_err() {
        return Ok((Vec::new(), false));
    }
    let mut planned = Vec::new();
    let mut round: usize = 0;
    let run = |tests: &[ContactTest]| {
        round += 1;
        let mut motions = Vec::new();
        for (index, test) in (1..).zip(tests) {
            let place = format!("probe/{round}-{index:02}");
            let prepared = code.prepare_elsewhere(test, &place).map_err(Some)?;
            // The first of the shorter time steps is that of the first round, with many of its tests.
            let hash = &prepared.run.deck_hash;
            let mut others = planned.iter();
            let same = others.find(|one: &&PreparedRun| one.run.deck_hash == *hash);
            match same {
                Some(same) => motions.push(same.run.outcome(code, test, root)),
                None => {
                    motions.push(prepared.run.outcome(code, test, root));
                    planned.push(prepared);
                }
            }
        }
        let motions: Result<_, _> = motions.into_iter().collect();
        motions.map_err(|_| None)
    };
    match converged(&code.declaration(), run, |_| false) {
        Err(Some(refusal)) => Err(refusal),
        Err(None) => Ok((planned, !round.is_multiple_of(ROUNDS))),
        Ok(_) => Ok((planned, false)),
    }
}
