//! Who is timed, and how.

use super::memory::{Processes, with_peak};
use crate::archive::{ArchiveError, Run};
use crate::engine::{Engine, EngineName, Failure, Workplace};
use crate::stack::{Case, Convention};
use std::time::{Duration, Instant};
use thiserror::Error;

/// Who is timed: an external code, or native in one of its two ways.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Contestant {
    /// Native, a run at a time.
    NativeScalar,
    /// Native, a run in each lane of the machine's vectors; what all are compared with.
    NativeLanes,
    /// An external code, all runs in one process where it can.
    External(EngineName),
}

/// Why nothing was measured.
#[derive(Debug, Error)]
pub enum BenchError {
    /// An engine is not installed.
    #[error("{engine} is not installed; to install it: {}", engine.installation_hint())]
    Missing {
        /// Which one.
        engine: EngineName,
    },
    /// A run failed.
    #[error(transparent)]
    Failed(#[from] Box<Failure>),
    /// There is no place for the files of the runs.
    #[error(transparent)]
    Files(#[from] ArchiveError),
}

impl Contestant {
    /// The contestants of `engine`.
    pub fn of(engine: EngineName) -> Vec<Self> {
        match engine {
            EngineName::Native => vec![Self::NativeScalar, Self::NativeLanes],
            external => vec![Self::External(external)],
        }
    }

    /// The name in tables.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::NativeScalar => "native-scalar",
            Self::NativeLanes => "native-lanes",
            Self::External(engine) => engine.as_str(),
        }
    }

    /// Whose runs they are.
    pub fn engine(self) -> EngineName {
        match self {
            Self::NativeScalar | Self::NativeLanes => EngineName::Native,
            Self::External(engine) => engine,
        }
    }
}

/// A contestant that can run.
pub(super) struct Competitor {
    pub(super) who: Contestant,
    pub(super) engine: Box<dyn Engine>,
}

/// Runs that were timed together.
pub(super) struct TimedRuns {
    pub(super) duration: Duration,
    /// Largest resident memory of the processes that made them, in bytes, where the system tells.
    pub(super) peak_bytes: Option<u64>,
    /// In the order of the cases.
    pub(super) runs: Vec<Run>,
}

impl Competitor {
    pub(super) fn find(who: Contestant) -> Result<Self, BenchError> {
        let engine = who.engine();
        let found = engine.find().ok_or(BenchError::Missing { engine })?;
        Ok(Self { who, engine: found })
    }

    /// Runs `cases`, from the start of the first process to the end of the last, on one core.
    pub(super) fn time(
        &self,
        cases: &[Case],
        workplace: &Workplace,
    ) -> Result<TimedRuns, BenchError> {
        let directory = tempfile::tempdir_in(workplace.directory)
            .map_err(ArchiveError::writing(workplace.directory))?;
        let workplace = Workplace {
            directory: directory.path(),
            ..*workplace
        };
        let processes = match self.who {
            Contestant::External(_) => Processes::Children,
            _ => Processes::Own,
        };
        let timed = || {
            let start = Instant::now();
            let runs = self.run(cases, &workplace);
            (start.elapsed(), runs)
        };
        let ((duration, runs), peak_bytes) = with_peak(processes, timed);
        Ok(TimedRuns {
            duration,
            peak_bytes,
            runs: runs?,
        })
    }

    fn run(&self, cases: &[Case], workplace: &Workplace) -> Result<Vec<Run>, Box<Failure>> {
        let cases_a_call = match self.who {
            Contestant::NativeScalar => 1,
            _ => cases.len(),
        };
        let mut results: Vec<Option<Result<Run, Failure>>> = cases.iter().map(|_| None).collect();
        for (call, together) in cases.chunks(cases_a_call).enumerate() {
            let first = call * cases_a_call;
            self.engine.run(together, workplace, &mut |index, result| {
                results[first + index] = Some(result);
            });
        }
        let results = results.into_iter().flatten();
        results.map(|result| result.map_err(Box::new)).collect()
    }
}

/// What a contact is to `engine`. Native takes the convention of LAMMPS, so that the two compute the same thing.
pub(super) fn convention(engine: EngineName) -> Convention {
    match engine {
        EngineName::Native => EngineName::Lammps.convention(),
        other => other.convention(),
    }
}
