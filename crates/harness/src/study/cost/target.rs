//! The codes that are timed, and the timing of runs.

use super::memory::{Processes, with_peak};
use crate::code::{Code, Failure, InstalledCode, Run, RunContext, SettledCode};
use crate::files::FileError;
use crate::model::{Case, ContactConvention, Power};
use std::time::{Duration, Instant};
use thiserror::Error;

/// A code that is timed: external, or native in one of its two modes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum BenchTarget {
    /// Native, a run at a time.
    NativeScalar,
    /// Native, a run in each lane of the machine's vectors; the reference for the others.
    NativeLanes,
    /// An external code, all runs in one process where it can.
    External(Code),
}

/// Why a measurement failed.
#[derive(Debug, Error)]
pub enum BenchError {
    /// A code is not installed.
    #[error("{code} is not installed; to install it: {}", code.installation_hint())]
    Missing {
        /// The code.
        code: Code,
    },
    /// A run failed.
    #[error(transparent)]
    Failed(#[from] Box<Failure>),
    /// The files of the runs could not be written.
    #[error(transparent)]
    Files(#[from] FileError),
}

impl BenchTarget {
    /// The targets of `code`.
    pub fn of(code: Code) -> Vec<Self> {
        match code.is_native() {
            true => vec![Self::NativeScalar, Self::NativeLanes],
            false => vec![Self::External(code)],
        }
    }

    /// The name in tables.
    pub fn as_str(&self) -> &str {
        match self {
            Self::NativeScalar => "native-scalar",
            Self::NativeLanes => "native-lanes",
            Self::External(code) => code.as_str(),
        }
    }

    /// The code behind it.
    pub fn code(&self) -> Code {
        match self {
            Self::NativeScalar | Self::NativeLanes => Code::native(),
            Self::External(code) => code.clone(),
        }
    }
}

/// A target whose code is installed.
pub(super) struct InstalledTarget {
    pub(super) target: BenchTarget,
    pub(super) code: Box<dyn InstalledCode>,
    /// Its code under the convention of the runs that are timed.
    pub(super) settled: SettledCode,
}

/// Runs that were timed together.
pub(super) struct TimedRuns {
    pub(super) duration: Duration,
    /// Largest resident memory of the processes that made them, in bytes, where the system reports it.
    pub(super) peak_bytes: Option<u64>,
    /// In the order of the cases.
    pub(super) runs: Vec<Run>,
}

impl InstalledTarget {
    /// Finds the installed code of `target`, whose convention is `settled`.
    pub(super) fn find(target: BenchTarget, settled: &SettledCode) -> Result<Self, BenchError> {
        let code = target.code();
        let found = code.find().ok_or(BenchError::Missing { code })?;
        Ok(Self {
            target,
            code: found,
            settled: settled.clone(),
        })
    }

    /// Times `cases` on one core, from the start of the first process to the end of the last.
    pub(super) fn time(
        &self,
        cases: &[Case],
        context: &RunContext,
    ) -> Result<TimedRuns, BenchError> {
        let directory = tempfile::tempdir_in(context.directory)
            .map_err(FileError::writing(context.directory))?;
        let context = RunContext {
            directory: directory.path(),
            ..*context
        };
        let processes = match self.target {
            BenchTarget::External(_) => Processes::Children,
            _ => Processes::Own,
        };
        let timed = || {
            let start = Instant::now();
            let runs = self.run(cases, &context);
            (start.elapsed(), runs)
        };
        let ((duration, runs), peak_bytes) = with_peak(processes, timed);
        Ok(TimedRuns {
            duration,
            peak_bytes,
            runs: runs?,
        })
    }

    fn run(&self, cases: &[Case], context: &RunContext) -> Result<Vec<Run>, Box<Failure>> {
        let cases_a_call = match self.target {
            BenchTarget::NativeScalar => 1,
            _ => cases.len(),
        };
        let mut results: Vec<Option<Result<Run, Failure>>> = cases.iter().map(|_| None).collect();
        for (call, together) in cases.chunks(cases_a_call).enumerate() {
            let first = call * cases_a_call;
            self.code.run(together, context, &mut |index, result| {
                results[first + index] = Some(result);
            });
        }
        let results = results.into_iter().flatten();
        results.map(|result| result.map_err(Box::new)).collect()
    }
}

/// Returns the contact convention of `code`. Native takes the convention of the first external code with the paper's
/// arms, so that the two compute the same thing.
pub(super) fn convention(code: &SettledCode) -> ContactConvention {
    let own = code.convention();
    if !code.name().is_native() {
        return own;
    }
    let others = Code::with_power(Power::Linear).into_iter().skip(1);
    let others = others.filter_map(|other| Some(other.as_declared()?.convention()));
    let mut others = others.filter(|other| other.arms == own.arms);
    others.next().unwrap_or(own)
}
