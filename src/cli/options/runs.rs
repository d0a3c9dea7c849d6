//! How runs are carried out, and where they are kept.

use super::duration::duration;
use crate::cli::interrupt::end_within;
use crate::cli::{CliError, INTERRUPT};
use crate::model::InvalidValue;
use crate::runs::{Recorded, Settings, Sharing, Store};
use clap::Args;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The environment variable with the directory of recorded runs.
const REFERENCE: &str = "TRISTACK_REFERENCE";

/// The store of runs, and how runs are carried out.
#[derive(Debug, Clone, Default, Args)]
pub(in crate::cli) struct RunOptions {
    /// Store of finished runs: a new or empty directory, or a store of yours [default: $TRISTACK_STORE, else tristack in the user's cache directory]
    #[arg(long, value_name = "DIR")]
    pub store: Option<PathBuf>,
    /// Accept a store that other users may write to, and believe what is in it
    #[arg(long)]
    pub shared_store: bool,
    /// Run everything again instead of reusing runs from the store
    #[arg(long)]
    pub fresh: bool,
    /// Number of runs at the same time [default: the number of cores]
    #[arg(long, value_name = "N")]
    pub jobs: Option<NonZeroUsize>,
    /// Longest time without a finished run, in seconds [default: 30 s plus 100 us per step for external
    /// codes, none for native]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    pub time_limit: Option<f64>,
    /// Time that this command may take: 90s, 1h 30min, or as Slurm writes it, [D-][HH:]MM:SS. No run is begun that would
    /// not end in time, what native runs have done is kept, and the exit status is 6; the same command goes on from there
    #[arg(long, value_name = "DURATION", value_parser = duration)]
    pub time_left: Option<Duration>,
}

impl RunOptions {
    /// These options as settings of the schedule.
    pub fn settings(&self) -> Result<Settings<'static>, CliError> {
        let sharing = match self.shared_store {
            true => Sharing::Shared,
            false => Sharing::Private,
        };
        self.time_left.map(end_within);
        let jobs = self.jobs.or(std::thread::available_parallelism().ok());
        Ok(Settings {
            store: Store::open_as(&self.store_directory()?, sharing)?,
            recorded: recorded(),
            fresh: self.fresh,
            threads: jobs.map_or(1, usize::from),
            time_limit: time_limit(self.time_limit)?,
            interrupt: &INTERRUPT,
        })
    }

    fn store_directory(&self) -> Result<PathBuf, InvalidValue> {
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

/// The checked value of `--time-limit`.
pub(in crate::cli) fn time_limit(seconds: Option<f64>) -> Result<Option<Duration>, InvalidValue> {
    let checked = seconds.map(|seconds| {
        let limit = Duration::try_from_secs_f64(seconds).ok();
        let limit = limit.filter(|limit| !limit.is_zero());
        let accepted = "a number of seconds above 0";
        limit.ok_or_else(|| InvalidValue::new("--time-limit", seconds, accepted))
    });
    checked.transpose()
}

/// The recorded runs in the directory that `TRISTACK_REFERENCE` names, or else those inside the program.
fn recorded() -> Recorded {
    let directory = directory_from(REFERENCE);
    directory.map_or_else(Recorded::embedded, |directory| Recorded::new(&directory))
}

/// The directory that `record` writes to: the one that `TRISTACK_REFERENCE` names, or else that of the checkout
/// from which the program was built.
pub(in crate::cli) fn recording_directory() -> Result<PathBuf, InvalidValue> {
    let of_checkout = || {
        let reference = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference");
        reference.is_dir().then(|| reference.join("recorded"))
    };
    let directory = directory_from(REFERENCE).or_else(of_checkout);
    directory.ok_or_else(|| InvalidValue {
        key: REFERENCE.to_owned(),
        value: "absent".to_owned(),
        accepted: "a directory: the checkout that tristack was built from is not here".to_owned(),
    })
}

/// The directory that an environment variable names, unless the variable is empty.
fn directory_from(variable: &str) -> Option<PathBuf> {
    let value = std::env::var_os(variable).filter(|value| !value.is_empty());
    value.map(PathBuf::from)
}
