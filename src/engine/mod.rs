//! Whoever turns a case into a time series: the native DEM, and the external codes behind one runner.

mod deck;
mod external;
mod failure;
mod installation;
mod liggghts;
mod native;
mod process;
mod yade;

pub use deck::DeckParameters;
pub use external::time_limit;
pub use failure::{Failure, FailureKind};
pub use process::Interrupt;

use crate::archive::{Identity, Run};
use crate::stack::{Case, Convention, InvalidValue};
use serde::{Deserialize, Serialize};
use std::path::Path;
use std::time::Duration;

/// The engines that tristack knows.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    Hash,
    Serialize,
    Deserialize,
    clap::ValueEnum,
)]
#[serde(rename_all = "lowercase")]
pub enum EngineName {
    /// The DEM of this program.
    Native,
    /// LIGGGHTS 3.8, gran hooke/stiffness with tangential history.
    Liggghts,
    /// YADE 2023.02a, ViscElPhys_Basic on a box floor.
    Yade,
}

impl EngineName {
    /// Every engine.
    pub const ALL: [Self; 3] = [Self::Native, Self::Liggghts, Self::Yade];

    /// The name on the command line and in tables.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Native => "native",
            Self::Liggghts => "liggghts",
            Self::Yade => "yade",
        }
    }

    /// What a contact is to this engine, unless a case may choose (native).
    pub fn convention(self) -> Convention {
        match self {
            Self::Native => Convention::PAPER,
            Self::Liggghts => liggghts::CONVENTION,
            Self::Yade => yade::CONVENTION,
        }
    }

    /// Whether the torque arms are part of the case rather than of the code.
    pub fn accepts_any_arms(self) -> bool {
        self == Self::Native
    }

    /// Refuses arms that are not those of the code.
    ///
    /// # Errors
    /// If an arm differs; it names the key, the value and the code's own.
    pub fn check_convention(self, asked: &Convention) -> Result<(), InvalidValue> {
        let own = self.convention();
        let arms = [
            ("convention.pair_arm", asked.pair_arm, own.pair_arm),
            ("convention.floor_arm", asked.floor_arm, own.floor_arm),
        ];
        let differing = arms.into_iter().find(|(_, asked, own)| asked != own);
        match differing {
            Some((key, asked, own)) if !self.accepts_any_arms() => {
                Err(InvalidValue::new(key, asked, format!("{own} for {self}")))
            }
            _ => Ok(()),
        }
    }

    /// Hash of the deck or sources that this version of tristack would run.
    pub fn deck_hash(self) -> String {
        match self {
            Self::Native => crate::dem::SOURCE_DIGEST.clone(),
            Self::Liggghts => liggghts::deck_hash(),
            Self::Yade => yade::deck_hash(),
        }
    }

    /// The engine as it is installed here; `None` if it is not.
    pub fn find(self) -> Option<Box<dyn Engine>> {
        match self {
            Self::Native => Some(Box::new(native::Native::new())),
            Self::Liggghts => external::ExternalEngine::find(&liggghts::LIGGGHTS),
            Self::Yade => external::ExternalEngine::find(&yade::YADE),
        }
    }

    /// How to install it.
    pub fn installation_hint(self) -> &'static str {
        match self {
            Self::Native => "part of tristack",
            Self::Liggghts => "apt-get install --no-install-recommends liggghts",
            Self::Yade => "apt-get install --no-install-recommends yade",
        }
    }
}

impl std::fmt::Display for EngineName {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.as_str())
    }
}

/// Where and how runs are made.
#[derive(Debug, Clone, Copy)]
pub struct Workplace<'a> {
    /// Directory in which every case gets a run directory of its own.
    pub directory: &'a Path,
    /// Longest time without a finished case; the engine's own estimate if absent.
    pub time_limit: Option<Duration>,
    /// Set when the user wants to stop.
    pub interrupt: &'a Interrupt,
}

/// A code that runs cases.
pub trait Engine: Send + Sync {
    /// Which one it is.
    fn name(&self) -> EngineName;

    /// What decides its numbers.
    fn identity(&self) -> &Identity;

    /// Whether one call with many cases is faster than many calls.
    fn prefers_many_cases(&self) -> bool;

    /// Runs `cases` in order and hands each result, with its index, to `finished` as soon as it is there.
    fn run(
        &self,
        cases: &[Case],
        workplace: &Workplace,
        finished: &mut dyn FnMut(usize, Result<Run, Failure>),
    );
}
