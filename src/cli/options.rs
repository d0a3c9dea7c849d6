//! Options that several commands share.

pub(super) use super::code_names::CodeParser;
use super::{CliError, ExitStatus, INTERRUPT, print, tell};
use crate::code::Code;
use crate::model::{
    Arms, CRITICAL_FRICTION, ContactArms, ContactConvention, InvalidValue, Law, Material,
    PAPER_CYLINDER_FRICTION, Power, Stack, TangentialHistory, TangentialStiffening,
};
use crate::output::{DataTable, json};
use crate::runs::{Recorded, SelectedCode, Settings, Sharing, Store, in_parallel};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Most stacks of one command: a thousand frictions by a thousand stiffnesses.
const MOST_STACKS: usize = 1_000_000;

/// The environment variable with the directory of recorded runs.
const REFERENCE: &str = "TRISTACK_REFERENCE";

/// The format of printed results.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Format {
    /// A table for a terminal.
    Table,
    /// JSON with units and command.
    Json,
    /// CSV for spreadsheets.
    Csv,
}

impl Format {
    /// Prints `tables`, the results of `command`. The text for a terminal comes from `people`, unless all tables are
    /// empty; CSV is that of the first table alone.
    pub fn print(
        self,
        tables: &[DataTable],
        command: &str,
        people: impl FnOnce() -> String,
    ) -> ExitStatus {
        print(&match self {
            Self::Table if tables.iter().all(DataTable::is_empty) => String::new(),
            Self::Table => people(),
            Self::Json => json(tables, command),
            Self::Csv => tables.first().map_or_else(String::new, DataTable::csv),
        })
    }
}

/// `--codes`: the codes that a command runs.
#[derive(Debug, Clone, Args)]
pub(super) struct CodeOptions {
    /// Codes to run, separated by commas; each must be installed [default: all, recorded if necessary]
    #[arg(id = "codes", long = "codes", value_parser = CodeParser, value_delimiter = ',', value_name = "C1,C2")]
    pub named: Vec<Code>,
}

impl CodeOptions {
    /// The codes that are named, each of which must have a law of this power.
    pub fn of_power(&self, power: Power) -> Result<Vec<Code>, InvalidValue> {
        let mut named = self.named.iter();
        let Some(other) = named.find(|code| !code.has_power(power)) else {
            return Ok(self.named.clone());
        };
        let names: Vec<&str> = Code::of_power(power)
            .into_iter()
            .map(Code::as_str)
            .collect();
        Err(InvalidValue {
            key: "--codes".to_owned(),
            value: other.to_string(),
            accepted: format!(
                "codes of the same power as --law, among them {}: the {} of {other}",
                names.join(", "),
                other.convention().law
            ),
        })
    }
}

/// The parameters of a stack other than floor friction and stiffness.
#[derive(Debug, Clone, Args)]
pub(super) struct StackOptions {
    /// Stiffness ratio k_n/k_t [default: 2.5; of laws that are not linear 17/14, that of Poisson's ratio 0.3]
    #[arg(long, value_name = "K", allow_negative_numbers = true)]
    kappa: Option<f64>,
    /// Friction between cylinders
    #[arg(long, value_name = "D", allow_negative_numbers = true, default_value_t = PAPER_CYLINDER_FRICTION)]
    pub mu_d: f64,
}

impl StackOptions {
    /// The stiffness ratio of pairs, in a law of this power.
    pub fn kappa(&self, power: Power) -> f64 {
        self.kappa
            .unwrap_or_else(|| Stack::usual_stiffness_ratio(power))
    }

    /// The checked stack with floor friction `mu` and this stiffness, in a law of this power.
    pub fn stack(&self, mu: f64, stiffness: f64, power: Power) -> Result<Stack, InvalidValue> {
        let stack = Stack {
            floor_friction: mu,
            cylinder_friction: self.mu_d,
            stiffness,
            stiffness_ratio: self.kappa(power),
        };
        stack.validate().map_err(as_flag)?;
        Ok(stack)
    }
}

/// The material of Hertz contacts, from which stiffness and stiffness ratio follow.
#[derive(Debug, Clone, Args)]
pub(super) struct MaterialOptions {
    /// Young's modulus in m g/r^2 of equal bodies in Hertz's theory, in place of --stiffness
    #[arg(
        long,
        value_name = "E",
        group = "hardness",
        requires = "poisson",
        conflicts_with = "stiffness",
        allow_negative_numbers = true
    )]
    youngs: Option<f64>,
    /// Their Poisson's ratio, from 0 to 0.5, in place of --kappa
    #[arg(
        long,
        value_name = "NU",
        conflicts_with = "kappa",
        allow_negative_numbers = true
    )]
    poisson: Option<f64>,
}

impl MaterialOptions {
    /// The material; without a modulus, its stiffness means nothing.
    fn material(&self) -> Option<Material> {
        Some(Material {
            youngs_modulus: self.youngs.unwrap_or(1.0),
            poisson_ratio: self.poisson?,
        })
    }

    /// The stiffness that the modulus gives; `None` without one.
    fn stiffness(&self) -> Option<f64> {
        self.youngs
            .and(self.material())
            .map(|own| own.pair_stiffness())
    }

    /// `others` with the stiffness ratio of the material, if there is one, in a law of this power.
    fn over(&self, others: &StackOptions, power: Power) -> Result<StackOptions, InvalidValue> {
        let Some(material) = self.material() else {
            return Ok(others.clone());
        };
        let (modulus, poisson_ratio) = (material.youngs_modulus, material.poisson_ratio);
        let refused = |flag, value, accepted| Err(InvalidValue::new(flag, value, accepted));
        if power != Power::Hertz {
            let accepted = "left out, unless --law is hertz";
            return refused("--poisson", poisson_ratio, accepted);
        }
        if !(0.0..=0.5).contains(&poisson_ratio) {
            return refused("--poisson", poisson_ratio, "a number from 0 to 0.5");
        }
        if !(modulus > 0.0 && modulus.is_finite()) {
            return refused("--youngs", modulus, "a number above 0");
        }
        Ok(StackOptions {
            kappa: Some(material.stiffness_ratio()),
            ..others.clone()
        })
    }
}

/// The parameters of one stack.
#[derive(Debug, Clone, Args)]
pub(super) struct OneStackOptions {
    /// Floor friction; a number or the word `critical`
    #[arg(long, value_parser = friction, requires = "hardness", allow_negative_numbers = true)]
    mu: Option<f64>,
    /// Stiffness k_n r/(m g), of a law of power p K r^p/(m g)
    #[arg(
        long,
        value_name = "S",
        group = "hardness",
        requires = "mu",
        allow_negative_numbers = true
    )]
    stiffness: Option<f64>,
    #[command(flatten)]
    others: StackOptions,
    #[command(flatten)]
    material: MaterialOptions,
}

impl OneStackOptions {
    /// The checked stack, in a law of this power.
    pub fn stack(&self, power: Power) -> Result<Stack, InvalidValue> {
        let others = self.material.over(&self.others, power)?;
        let stiffness = self.stiffness.or_else(|| self.material.stiffness());
        let [mu, stiffness] = [self.mu, stiffness].map(|value| value.unwrap_or(f64::NAN));
        others.stack(mu, stiffness, power)
    }
}

/// The parameters of several stacks other than floor friction.
#[derive(Debug, Clone, Args)]
pub(super) struct StackListOptions {
    /// Stiffness k_n r/(m g), of a law of power p K r^p/(m g); one or several, separated by commas
    #[arg(
        id = "stiffness",
        long = "stiffness",
        required_unless_present = "youngs",
        value_name = "S1,S2",
        value_delimiter = ',',
        allow_negative_numbers = true
    )]
    stiffnesses: Vec<f64>,
    #[command(flatten)]
    others: StackOptions,
    #[command(flatten)]
    material: MaterialOptions,
}

impl StackListOptions {
    /// The checked stacks of every combination of friction and stiffness, in a law of this power; the friction varies
    /// fastest.
    pub fn stacks(&self, frictions: &[f64], power: Power) -> Result<Vec<Stack>, InvalidValue> {
        let others = self.material.over(&self.others, power)?;
        let material = self.material.stiffness();
        let stiffnesses: Vec<f64> = self.stiffnesses.iter().copied().chain(material).collect();
        let count = frictions.len().saturating_mul(stiffnesses.len());
        if count > MOST_STACKS {
            return Err(InvalidValue {
                key: "--mu, --stiffness".to_owned(),
                value: format!("{count} combinations"),
                accepted: format!("at most {MOST_STACKS} combinations"),
            });
        }
        let stacks = stiffnesses.iter().flat_map(|&stiffness| {
            let frictions = frictions.iter();
            let others = &others;
            frictions.map(move |&mu| others.stack(mu, stiffness, power))
        });
        stacks.collect()
    }
}

/// Parts of the contact convention that replace those of the code.
#[derive(Debug, Clone, Args)]
pub(super) struct ConventionOptions {
    /// Arm coefficient r1 of cylinder-cylinder contacts, in R = r + r1 overlap [default: that of the code]
    #[arg(long, value_name = "R1", allow_negative_numbers = true)]
    pub pair_arm: Option<f64>,
    /// Arm coefficient r1 of the surface velocity at these contacts [default: as --pair-arm]
    #[arg(long, value_name = "R1", allow_negative_numbers = true)]
    pub pair_kinematic_arm: Option<f64>,
    /// Arm coefficient r1 of floor contacts [default: that of the code]
    #[arg(long, value_name = "R1", allow_negative_numbers = true)]
    pub floor_arm: Option<f64>,
    /// Arm coefficient r1 of the surface velocity at these contacts [default: as --floor-arm]
    #[arg(long, value_name = "R1", allow_negative_numbers = true)]
    pub floor_kinematic_arm: Option<f64>,
    #[command(flatten)]
    pub law: LawOptions,
}

/// The contact law, or parts of it that replace those of the code.
#[derive(Debug, Clone, Args)]
pub(super) struct LawOptions {
    /// Normal force K overlap^p: `linear` (p = 1), `hertz` (p = 1.5), 1.25, 1.75 or 2 [default: that of the code]
    #[arg(long, value_parser = power, value_name = "LAW")]
    law: Option<Power>,
    /// What tangential springs remember: the displacement or the force, perhaps rescaled by the contact radius while that
    /// shrinks [default: displacement]
    #[arg(long, value_parser = history(), value_name = "WHAT")]
    history: Option<TangentialHistory>,
    /// K of the floor and other walls over K of cylinders [default: root of 2 for Hertz, else 1]
    #[arg(long, value_name = "W", allow_negative_numbers = true)]
    floor_ratio: Option<f64>,
    /// Stiffness ratio k_n/k_t of the floor [default: as --kappa]
    #[arg(long, value_name = "K", allow_negative_numbers = true)]
    floor_kappa: Option<f64>,
    /// Multiply the tangential stiffness of these contacts by 2/(2 - overlap); every contact, if none are named
    #[arg(long, value_parser = stiffening(), value_name = "CONTACTS", num_args = 0..=1, require_equals = true,
        default_missing_value = "every")]
    tangential_stiffening: Option<TangentialStiffening>,
}

/// Reads `--law`.
pub(super) fn power(text: &str) -> Result<Power, String> {
    let named = match text {
        "linear" => Ok(Power::Linear),
        "hertz" => Ok(Power::Hertz),
        number => number
            .parse()
            .map_err(|_| String::new())
            .and_then(|value: f64| Power::try_from(value)),
    };
    named.map_err(|_| {
        "accepted are `linear`, `hertz`, and the powers 1, 1.25, 1.5, 1.75 and 2".to_owned()
    })
}

/// Reads `--history`.
fn history() -> impl TypedValueParser<Value = TangentialHistory> {
    one_of(TangentialHistory::ALL, TangentialHistory::as_str)
}

/// Reads `--tangential-stiffening`.
fn stiffening() -> impl TypedValueParser<Value = TangentialStiffening> {
    one_of(TangentialStiffening::ALL, TangentialStiffening::as_str)
}

/// Reads one of `all` by its word.
fn one_of<T: Copy + Send + Sync + 'static, const N: usize>(
    all: [T; N],
    word: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(all.map(word)).map(move |given| {
        let named = all.into_iter().find(|value| word(*value) == given);
        named.expect("one of the possible values")
    })
}

impl LawOptions {
    /// The power, if it is given.
    pub fn power(&self) -> Option<Power> {
        self.law
    }

    /// `own` with the given parts; another power brings the other parts that are usual with it.
    fn over(&self, own: Law) -> Law {
        let other = self.law.filter(|power| *power != own.power);
        let base = other.map_or(own, Law::of_power);
        Law {
            power: base.power,
            history: self.history.unwrap_or(base.history),
            floor_ratio: self.floor_ratio.unwrap_or(base.floor_ratio),
            floor_kappa: self.floor_kappa.or(base.floor_kappa),
            tangential_stiffening: self
                .tangential_stiffening
                .unwrap_or(base.tangential_stiffening),
            damping: base.damping,
        }
    }
}

impl ConventionOptions {
    /// Refuses options that leave an arm to be guessed.
    pub fn check_named_arms(&self) -> Result<(), InvalidValue> {
        let arms = [
            ("--pair-arm", self.pair_arm),
            ("--floor-arm", self.floor_arm),
        ];
        let missing = arms.into_iter().find(|(_, arm)| arm.is_none());
        missing.map_or(Ok(()), |(flag, _)| {
            Err(InvalidValue {
                key: flag.to_owned(),
                value: "left out".to_owned(),
                accepted:
                    "the arm of the code, which moves the limit, or --passport FILE of a probe"
                        .to_owned(),
            })
        })
    }

    /// The convention of `code` with the given parts in place of its own.
    pub fn of(&self, code: Code) -> Result<ContactConvention, InvalidValue> {
        let own = code.convention();
        let convention = ContactConvention {
            arms: Arms {
                pair: replaced(own.arms.pair, self.pair_arm, self.pair_kinematic_arm),
                floor: replaced(own.arms.floor, self.floor_arm, self.floor_kinematic_arm),
            },
            law: self.law.over(own.law),
            ..own
        };
        convention.validate().map_err(as_flag)?;
        code.check_convention(&convention).map_err(as_flag)?;
        Ok(convention)
    }
}

/// `own` with the given coefficients; a given torque arm is the kinematic arm too, unless that is given as well.
fn replaced(own: ContactArms, torque: Option<f64>, kinematic: Option<f64>) -> ContactArms {
    // Adding zero turns -0 into 0, which is the same arm and must be the same case.
    ContactArms {
        torque: torque.unwrap_or(own.torque) + 0.0,
        kinematic: kinematic.or(torque).unwrap_or(own.kinematic) + 0.0,
    }
}

/// The options of `T`, each by its name.
pub(super) fn options_of<T: Args>() -> Vec<clap::Id> {
    let command = T::augment_args(clap::Command::default());
    let options = command.get_arguments();
    options.map(|option| option.get_id().clone()).collect()
}

/// The store of runs, and how runs are carried out.
#[derive(Debug, Clone, Default, Args)]
pub(super) struct RunOptions {
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
}

impl RunOptions {
    /// These options as settings of the schedule.
    pub fn settings(&self) -> Result<Settings<'static>, CliError> {
        let sharing = match self.shared_store {
            true => Sharing::Shared,
            false => Sharing::Private,
        };
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
pub(super) fn time_limit(seconds: Option<f64>) -> Result<Option<Duration>, InvalidValue> {
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
pub(super) fn recording_directory() -> Result<PathBuf, InvalidValue> {
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

/// The codes named, each of which must be installed; every code with the paper's law if none is named.
pub(super) fn selected_codes(named: &[Code]) -> Result<Vec<SelectedCode>, CliError> {
    if named.is_empty() {
        return Ok(find_all(&Code::of_power(Power::Linear)));
    }
    let mut names = named.to_vec();
    names.sort();
    names.dedup();
    let found = find_all(&names).into_iter().map(|selected| {
        let missing = CliError::MissingCode(selected.name);
        selected.code.is_some().then_some(selected).ok_or(missing)
    });
    found.collect()
}

/// The codes `names` as they are installed here, looked up at the same time.
pub(super) fn find_all(names: &[Code]) -> Vec<SelectedCode> {
    in_parallel(names, names.len(), |name| SelectedCode::find(*name))
}

/// Reports the codes that are not installed, and whether recorded runs stand in for them.
pub(super) fn tell_stand_ins(codes: &[SelectedCode], is_recorded: impl Fn(Code) -> bool) {
    for selected in codes.iter().filter(|selected| selected.code.is_none()) {
        let instead = match is_recorded(selected.name) {
            true => "recorded runs stand in for it",
            false => "no recorded run stands in for it",
        };
        tell!(
            "{} is not installed: {instead} (to run it live: {})",
            selected.name,
            selected.name.installation_hint()
        );
    }
}

/// Reads `--mu`: a number, or the word `critical`.
pub(super) fn friction(text: &str) -> Result<f64, String> {
    if text == "critical" {
        return Ok(CRITICAL_FRICTION);
    }
    text.parse().map_err(|_| {
        "accepted are a number above 0 and the word `critical` (2 - sqrt 3)".to_owned()
    })
}

/// `error` with the flag in place of the key of a case file.
pub(super) fn as_flag(error: InvalidValue) -> InvalidValue {
    let flag = match error.key.as_str() {
        "stack.floor_friction" => "--mu",
        "stack.cylinder_friction" => "--mu-d",
        "stack.stiffness" => "--stiffness",
        "stack.stiffness_ratio" => "--kappa",
        "convention.pair" | "convention.pair.torque_arm" => "--pair-arm",
        "convention.pair.kinematic_arm" => "--pair-kinematic-arm",
        "convention.floor" | "convention.floor.torque_arm" => "--floor-arm",
        "convention.floor.kinematic_arm" => "--floor-kinematic-arm",
        "convention.law" => "--law",
        "convention.law.floor_ratio" => "--floor-ratio",
        "convention.law.floor_kappa" => "--floor-kappa",
        "cylinder.density" => "--density",
        "cylinder.poisson_ratio" => "--poisson",
        "mu_uncertainty" => "--mu-uncertainty",
        "protocol.wall_speed" => "--speed",
        "protocol.time_step" => "--dt",
        "protocol.preparation.kind" => "--preparation",
        "protocol.preparation.push" => "--push",
        "protocol.shortcuts" => "--shortcuts",
        other => other,
    };
    InvalidValue {
        key: flag.to_owned(),
        ..error
    }
}
