//! Whoever turns a case into a time series: the native DEM, and the external codes behind one runner.

mod batch;
mod capture;
mod deck;
mod external;
mod failure;
mod guard;
mod installation;
mod lammps;
mod liggghts;
mod native;
mod process;
mod provenance;
mod pyramid_log;
mod task;
mod tasks;
mod thermo_log;
mod written;
mod yade;

pub use batch::time_limit;
pub use deck::{
    DeckParameters, PreparationParameters, ProbeParameters, PyramidParameters, placed_cylinders,
};
pub use failure::{Failure, FailureKind};
pub use guard::{COMMAND as GUARD_COMMAND, end_like, guard, guard_foreign_programs};
pub use installation::version_in_answer;
pub use process::Interrupt;
pub use provenance::{Identity, Provenance, Run, machine};
pub use pyramid_log::pyramid_in_log;
pub use task::{ParameterFile, Task};
pub use tasks::Tasks;
pub use thermo_log::{motion_in_log, series_in_log};
pub use written::keep_evidence;

use crate::model::{Case, ContactConvention, ContactTest, InvalidValue, Preparation, sha256_hex};
use serde::{Deserialize, Serialize};
use std::path::Path;
use std::time::Duration;

/// Variables for the environment of a program.
type Environment = &'static [(&'static str, &'static str)];

/// Without these variables Open MPI spends 0.3 s a start on looking for a network.
const QUICK_OPEN_MPI: Environment = &[
    ("OMPI_MCA_ess_singleton_isolated", "1"),
    ("OMPI_MCA_pml", "ob1"),
];

/// The codes that tristack knows.
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
#[serde(rename_all = "kebab-case")]
pub enum Code {
    /// The DEM of this program.
    Native,
    /// LIGGGHTS 3.8, gran hooke/stiffness with tangential history.
    Liggghts,
    /// YADE 2023.02a, ViscElPhys_Basic on a box floor.
    Yade,
    /// The same on a floor of facets.
    YadeFacet,
    /// The same on a floor that is a YADE wall, where the floor arm is another one.
    YadeWall,
    /// LAMMPS 29 Sep 2021, gran/hooke/history.
    Lammps,
}

/// What the adapter of a code declares, and the probe measures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Declaration {
    /// What a contact is.
    pub convention: ContactConvention,
    /// Steps by which reported velocities lag behind reported positions.
    pub velocity_lag: f64,
}

impl Code {
    /// Every code.
    pub const ALL: [Self; 6] = [
        Self::Native,
        Self::Liggghts,
        Self::Yade,
        Self::YadeFacet,
        Self::YadeWall,
        Self::Lammps,
    ];

    /// The name on the command line and in tables.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Native => "native",
            Self::Liggghts => "liggghts",
            Self::Yade => "yade",
            Self::YadeFacet => "yade-facet",
            Self::YadeWall => "yade-wall",
            Self::Lammps => "lammps",
        }
    }

    /// What a contact is to this code, unless a case may choose (native).
    pub fn convention(self) -> ContactConvention {
        match self {
            Self::Native => ContactConvention::PAPER,
            Self::Liggghts => liggghts::CONVENTION,
            Self::Yade | Self::YadeFacet => yade::CONVENTION,
            Self::YadeWall => yade::ON_WALL,
            Self::Lammps => lammps::CONVENTION,
        }
    }

    /// What its adapter declares.
    pub fn declaration(self) -> Declaration {
        let velocity_lag = match self {
            // Leapfrog.
            Self::Native | Self::Yade | Self::YadeFacet | Self::YadeWall => 0.5,
            // Velocity Verlet.
            Self::Liggghts | Self::Lammps => 0.0,
        };
        Declaration {
            convention: self.convention(),
            velocity_lag,
        }
    }

    /// Whether the convention is part of the case rather than of the code.
    pub fn accepts_any_convention(self) -> bool {
        self == Self::Native
    }

    /// Refuses a convention that is not that of the code; the restitution is a parameter of every code.
    ///
    /// # Errors
    /// It names the key, the value and what the code can do.
    pub fn check_convention(self, asked: &ContactConvention) -> Result<(), InvalidValue> {
        if self.accepts_any_convention() {
            return Ok(());
        }
        let is_yade = self
            .adapter()
            .is_some_and(|adapter| adapter.program == "yade");
        if is_yade && asked.restitution == 1.0 {
            let accepted = "below 1 for yade, which ignores a damping of zero";
            return Err(InvalidValue::new("convention.restitution", 1.0, accepted));
        }
        let own = ContactConvention {
            restitution: asked.restitution,
            ..self.convention()
        };
        asked.difference(&own).map_or(Ok(()), |(key, value, own)| {
            Err(InvalidValue {
                key: format!("convention.{key}"),
                value,
                accepted: format!("{own} for {self}"),
            })
        })
    }

    /// Refuses a preparation for which the code has no deck.
    ///
    /// # Errors
    /// It names the key, the value and what the code can do.
    pub fn check_preparation(self, asked: &Preparation) -> Result<(), InvalidValue> {
        let adapter = self.adapter();
        if adapter.is_none_or(|adapter| adapter.deck(asked).is_some()) {
            return Ok(());
        }
        Err(self.unknown_preparation(asked))
    }

    /// Whether it has a deck for pyramids.
    pub fn builds_pyramids(self) -> bool {
        let adapter = self.adapter();
        adapter.is_none_or(|adapter| adapter.pyramid.is_some())
    }

    fn unknown_pyramid(self) -> InvalidValue {
        let builders = Self::ALL.into_iter().filter(|name| name.builds_pyramids());
        let builders: Vec<&str> = builders.map(Self::as_str).collect();
        InvalidValue {
            key: "code".to_owned(),
            value: self.as_str().to_owned(),
            accepted: format!("one of {} for a pyramid", builders.join(", ")),
        }
    }

    /// Whether it can make a run shorter.
    pub fn takes_shortcuts(self) -> bool {
        self == Self::Native
    }

    /// Refuses shortcuts, if they are `asked` for, where the code knows none.
    ///
    /// # Errors
    /// It names the key, the value and what the code can do.
    pub fn check_shortcuts(self, asked: bool) -> Result<(), InvalidValue> {
        if !asked || self.takes_shortcuts() {
            return Ok(());
        }
        Err(InvalidValue {
            key: "protocol.shortcuts".to_owned(),
            value: "given".to_owned(),
            accepted: format!("none for {self}; native takes them"),
        })
    }

    fn unknown_preparation(self, asked: &Preparation) -> InvalidValue {
        InvalidValue {
            key: "protocol.preparation.kind".to_owned(),
            value: asked.as_str().to_owned(),
            accepted: format!("gravity-ramp for {self}"),
        }
    }

    /// Hash of everything that this version of tristack would give the code for `case`: deck, parameters,
    /// arguments and environment. For the native code its sources take the place of the deck.
    pub fn deck_hash(self, case: &Case) -> String {
        let (static_hash, told) = match self.adapter() {
            None => (
                crate::dem::SOURCE_DIGEST.clone(),
                ParameterFile::Json.content(&case.parameters()),
            ),
            Some(adapter) => {
                // A case without a deck is refused when it is run.
                let deck = adapter.deck(&case.protocol.preparation);
                let deck = deck.unwrap_or(&adapter.stack);
                (adapter.static_hash(deck), adapter.told(deck, case))
            }
        };
        sha256_hex(format!("{static_hash}\n{told}").as_bytes())
    }

    /// Hash of the deck for the gravity ramp alone, or of the sources of the native code.
    pub fn static_deck_hash(self) -> String {
        match self.adapter() {
            None => crate::dem::SOURCE_DIGEST.clone(),
            Some(adapter) => adapter.static_hash(&adapter.stack),
        }
    }

    /// Hash of the deck of the micro-tests alone, or of the sources of the native code.
    pub fn static_probe_hash(self) -> String {
        match self.adapter() {
            None => crate::dem::SOURCE_DIGEST.clone(),
            Some(adapter) => adapter.static_hash(&adapter.probe),
        }
    }

    /// Hash of everything that this version of tristack would give the code for `test`, as
    /// [`Self::deck_hash`] for a case.
    pub fn probe_hash(self, test: &ContactTest) -> String {
        let told = match self.adapter() {
            None => ParameterFile::Json.content(&test.parameters()),
            Some(adapter) => adapter.told(&adapter.probe, test),
        };
        sha256_hex(format!("{}\n{told}", self.static_probe_hash()).as_bytes())
    }

    /// The code as it is installed here; `None` if it is not.
    pub fn find(self) -> Option<Box<dyn InstalledCode>> {
        match self.adapter() {
            None => Some(Box::new(native::Native::new())),
            Some(adapter) => external::ExternalCode::find(adapter),
        }
    }

    /// The same code computing with more digits, if there is one here: native in double-double
    /// arithmetic, YADE in long double. What is between the two is round-off.
    pub fn find_precise(self) -> Option<Box<dyn InstalledCode>> {
        let Some(adapter) = self.adapter() else {
            return Some(Box::new(native::Native::precise()));
        };
        let program = adapter.precise_program?;
        external::ExternalCode::find_program(adapter, program)
    }

    fn adapter(self) -> Option<&'static external::Adapter> {
        match self {
            Self::Native => None,
            Self::Liggghts => Some(&liggghts::LIGGGHTS),
            Self::Yade => Some(&yade::BOX),
            Self::YadeFacet => Some(&yade::FACET),
            Self::YadeWall => Some(&yade::WALL),
            Self::Lammps => Some(&lammps::LAMMPS),
        }
    }

    /// What a step of the stack takes, about, in seconds: for forecasts of the time that is left.
    pub fn seconds_per_step(self) -> f64 {
        match self {
            Self::Native => 1e-8,
            Self::Liggghts | Self::Lammps => 2.5e-6,
            Self::Yade | Self::YadeFacet | Self::YadeWall => 5e-6,
        }
    }

    /// How to install it.
    pub fn installation_hint(self) -> &'static str {
        match self {
            Self::Native => "part of tristack",
            Self::Liggghts => "apt-get install --no-install-recommends liggghts",
            Self::Yade | Self::YadeFacet | Self::YadeWall => {
                "apt-get install --no-install-recommends yade"
            }
            Self::Lammps => "apt-get install --no-install-recommends lammps",
        }
    }
}

impl std::fmt::Display for Code {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.as_str())
    }
}

/// Is told how many steps of a case, by its index, are done.
pub type Advanced<'a> = &'a (dyn Fn(usize, u64) + Sync);

/// Where and how runs are made.
#[derive(Clone, Copy)]
pub struct RunContext<'a> {
    /// Directory in which every case gets a run directory of its own.
    pub directory: &'a Path,
    /// Directory that keeps runs which are under way, if they are to be taken up after an interruption.
    pub checkpoints: Option<&'a Path>,
    /// Longest time without a finished case; the code's own estimate if absent.
    pub time_limit: Option<Duration>,
    /// Set when the user wants to stop.
    pub interrupt: &'a Interrupt,
    /// Told now and then how far long runs are.
    pub advanced: Advanced<'a>,
}

impl<'a> RunContext<'a> {
    /// Runs in `directory` until they end or the user wants to stop; nothing is kept, and nobody is told.
    pub fn new(directory: &'a Path, interrupt: &'a Interrupt) -> Self {
        Self {
            directory,
            checkpoints: None,
            time_limit: None,
            interrupt,
            advanced: &|_, _| (),
        }
    }
}

/// How an code is fastest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Batching {
    /// With a call for each case.
    OneCallACase,
    /// With as few calls as there are cores for it, because starting takes longer than running.
    FewCalls,
    /// With a call on each core, because cases in one call share every instruction.
    OneCallACore,
}

/// Receives results, each with its index, as soon as they are there.
pub type Finished<'a, T> = &'a mut dyn FnMut(usize, Result<T, Failure>);

/// A code that carries out tasks here.
pub trait InstalledCode: Send + Sync {
    /// Which one it is.
    fn name(&self) -> Code;

    /// What decides its numbers.
    fn identity(&self) -> &Identity;

    /// How many cases one call should have.
    fn batching(&self) -> Batching;

    /// Carries out `tasks`, and hands each outcome to their receiver.
    fn carry_out(&self, tasks: Tasks, context: &RunContext);
}
