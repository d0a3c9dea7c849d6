//! How runs are carried out, and where they are kept.

use super::duration::duration;
use super::numbers::{seconds, whole};
use crate::cli::interrupt::end_within;
use crate::cli::{CliError, INTERRUPT};
use crate::model::InvalidValue;
use crate::runs::{Recorded, Settings, Sharing, Store};
use clap::Args;
use std::path::PathBuf;
use std::time::Duration;

/// The environment variable with the directory of recorded runs.
const REFERENCE: &str = "TRISTACK_REFERENCE";
/// Largest number of runs at the same time, more than any machine has cores.
const MOST_JOBS: u16 = 4096;

/// The store of runs.
#[derive(Debug, Clone, Default, Args)]
pub(in crate::cli) struct StoreOptions {
    /// Store of finished runs: a new or empty directory, or a store of yours [default: $TRISTACK_STORE, else tristack in the user's cache directory]
    #[arg(long, value_name = "DIR")]
    pub store: Option<PathBuf>,
    /// Accept a store that other users may write to, and believe what is in it
    #[arg(long)]
    pub shared_store: bool,
}

/// The store of runs, and how runs are carried out.
#[derive(Debug, Clone, Default, Args)]
pub(in crate::cli) struct RunOptions {
    #[command(flatten)]
    pub store: StoreOptions,
    /// Run everything again instead of reusing runs from the store
    #[arg(long)]
    pub fresh: bool,
    /// Number of runs at the same time [default: the number of cores]
    #[arg(long, value_name = "N", value_parser = whole::<usize>(1..=MOST_JOBS))]
    pub jobs: Option<usize>,
    /// Longest time without a finished run, in seconds [default: 30 s plus 100 us per step for external
    /// codes, none for native]
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub time_limit: Option<f64>,
    /// Time that this command may take: 90s, 1h 30min, or as Slurm writes it, [D-][HH:]MM:SS. No run is begun that would
    /// not end in time, what native runs have done is kept, and the exit status is 6; the same command goes on from there
    #[arg(long, value_name = "DURATION", value_parser = duration, allow_hyphen_values = true)]
    pub time_left: Option<Duration>,
}

impl RunOptions {
    /// Converts these options to settings of the schedule, and starts the time that is left.
    pub fn settings(&self) -> Result<Settings<'static>, CliError> {
        let cores = || std::thread::available_parallelism().map_or(1, usize::from);
        if let Some(time) = self.time_left {
            end_within(time);
        }
        Ok(Settings {
            store: self.store.opened()?,
            recorded: recorded(),
            fresh: self.fresh,
            threads: self.jobs.unwrap_or_else(cores),
            time_limit: time_limit(self.time_limit)?,
            interrupt: &INTERRUPT,
        })
    }
}

impl StoreOptions {
    /// Opens the store, and creates it if there is none.
    pub fn opened(&self) -> Result<Store, CliError> {
        Ok(Store::open_as(&self.directory()?, self.sharing())?)
    }

    /// Returns who may write to the store.
    pub fn sharing(&self) -> Sharing {
        match self.shared_store {
            true => Sharing::Shared,
            false => Sharing::Private,
        }
    }

    /// Returns the directory of the store, which may not exist.
    pub fn directory(&self) -> Result<PathBuf, InvalidValue> {
        let from_environment = || directory_from("TRISTACK_STORE");
        let from_cache = || dirs::cache_dir().map(|cache| cache.join("tristack"));
        let chosen = self.store.clone().or_else(from_environment);
        chosen.or_else(from_cache).ok_or_else(|| InvalidValue {
            key: "--store".to_owned(),
            value: "absent".to_owned(),
            accepted: "a directory: there is no cache directory here".to_owned(),
        })
    }
}

/// Checks the value of `--time-limit`.
pub(in crate::cli) fn time_limit(seconds: Option<f64>) -> Result<Option<Duration>, InvalidValue> {
    let checked = seconds.map(|seconds| {
        let limit = Duration::try_from_secs_f64(seconds).ok();
        let limit = limit.filter(|limit| !limit.is_zero());
        let accepted = "a number of seconds above 0";
        limit.ok_or_else(|| InvalidValue::new("--time-limit", seconds, accepted))
    });
    checked.transpose()
}

/// Returns the recorded runs in the directory that `TRISTACK_REFERENCE` names, or else those inside the program.
fn recorded() -> Recorded {
    let directory = directory_from(REFERENCE);
    directory.map_or_else(Recorded::embedded, |directory| Recorded::new(&directory))
}

/// Returns the directory that `record` writes to: the one that `TRISTACK_REFERENCE` names, or else that of the
/// checkout in which the program is run. The program does not know where it was built, so that it can be passed on.
pub(in crate::cli) fn recording_directory() -> Result<PathBuf, InvalidValue> {
    let recorded = PathBuf::from("reference/recorded");
    let of_checkout = || recorded.is_dir().then_some(recorded);
    let directory = directory_from(REFERENCE).or_else(of_checkout);
    directory.ok_or_else(|| InvalidValue {
        key: REFERENCE.to_owned(),
        value: "absent".to_owned(),
        accepted: "a directory: the current directory is no checkout of tristack, which has reference/recorded"
            .to_owned(),
    })
}

/// Returns the directory that an environment variable names; `None` if the variable is unset or empty.
fn directory_from(variable: &str) -> Option<PathBuf> {
    let value = std::env::var_os(variable).filter(|value| !value.is_empty());
    value.map(PathBuf::from)
}
