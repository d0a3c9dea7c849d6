//! The keys of a manifest.

use super::columns::{Written, read_columns};
use super::convention::ConventionKey;
use super::format::{ParameterFormat, ResultFormat};
use super::manifest_error::Place;
use crate::model::ContactConvention;
use crate::series::ColumnSources;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::{Spanned, Table};

/// One code, as the manifest describes it.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Definition {
    /// Version of the keys: 1.
    #[serde(rename = "schema")]
    _schema: i64,
    /// Name of the code: lower-case letters, digits and hyphens.
    pub(super) name: String,
    /// The code whose keys and files are taken where these are absent: the name of a built-in one, or the path of a folder.
    #[serde(rename = "extends")]
    _extends: Option<String>,
    /// Name in prose and figures; the variants of a folder share it.
    #[serde(default)]
    pub(super) title: String,
    /// Distinguishes the variant from others in figures.
    pub(super) label: Option<String>,
    /// The program, whose versions and styles share it in the atlas; the title where it is absent.
    #[serde(default)]
    pub(super) software: String,
    /// The contact style as the program names it, the same in all its versions; the label where it is absent.
    #[serde(default)]
    pub(super) style: String,
    /// How to install the program.
    #[serde(default)]
    pub(super) install: String,
    /// Mark of the code in figures.
    pub(super) mark: Option<Mark>,
    /// Durations for forecasts; a multiple is the time limit.
    #[serde(default)]
    pub(super) seconds: Seconds,
    /// Absent for the native code alone.
    pub(super) program: Option<Program>,
    /// The file that holds the parameters of a task.
    #[serde(default)]
    pub(super) parameters: ParameterFile,
    /// The file that holds the result of a task.
    #[serde(default)]
    pub(super) result: ResultFile,
    /// The files of each kind of task; a kind that is missing is refused by the code.
    #[serde(default)]
    pub(super) tasks: BTreeMap<TaskKind, TaskFiles>,
    /// Kinds of tasks that are not inherited from the code that is extended.
    #[serde(default)]
    pub(super) without: Vec<TaskKind>,
    /// Whether contacts have springs.
    #[serde(default)]
    pub(super) contact: Contact,
    /// The contact convention of the code; a key that is left out is measured by the probe.
    #[serde(default)]
    pub(super) convention: ContactConvention,
    /// The keys of the convention that are left out, which the probe measures.
    #[serde(skip)]
    pub(super) left_out: Vec<ConventionKey>,
    /// Properties of its time integration.
    #[serde(default)]
    pub(super) integration: Integration,
    /// Parameter values that the code cannot take.
    #[serde(default)]
    pub(super) refused: Refused,
    /// Placeholders of the command.
    #[serde(default)]
    pub(super) set: BTreeMap<String, String>,
    /// Further codes, by name, with the keys in which they differ.
    #[serde(default, rename = "variants")]
    #[schemars(with = "BTreeMap<String, BTreeMap<String, serde_json::Value>>")]
    _variants: BTreeMap<String, Table>,
    /// Name in the manifest, which variants share.
    #[serde(skip)]
    pub(super) family: String,
    /// Where its name stands.
    #[serde(skip)]
    pub(super) place: Place,
}

/// What the contacts of a code are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Contact {
    /// Springs and dashpots.
    #[default]
    Elastic,
    /// Bodies are rigid, as in contact dynamics and in physics engines. The task `stack` has no stiffness then, and the code
    /// has no other task and no convention.
    Rigid,
}

/// The kinds of tasks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum TaskKind {
    /// Compress a stack after a gravity ramp.
    Stack,
    /// Compress a stack that was prepared between side walls.
    SideWalls,
    /// Move two cylinders for a few steps.
    Motion,
    /// Carry a pyramid.
    Pyramid,
    /// Compress a stack of spheres in space.
    Spheres,
    /// Move two spheres in space for a few steps.
    SpheresMotion,
    /// Compress a stack of rigid cylinders: the task `stack` of a code whose `contact` is rigid.
    #[serde(skip)]
    Rigid,
}

impl TaskKind {
    /// All kinds.
    pub const ALL: [Self; 7] = [
        Self::Stack,
        Self::SideWalls,
        Self::Motion,
        Self::Pyramid,
        Self::Spheres,
        Self::SpheresMotion,
        Self::Rigid,
    ];

    /// Its name in manifests.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Stack => "stack",
            Self::SideWalls => "side-walls",
            Self::Motion => "motion",
            Self::Pyramid => "pyramid",
            Self::Spheres => "spheres",
            Self::SpheresMotion => "spheres-motion",
            Self::Rigid => "rigid",
        }
    }
}

/// Mark of a code in figures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mark {
    /// Its outline.
    pub shape: Shape,
    /// Its colour.
    pub colour: Colour,
}

/// Outlines, so that marks at the same place do not hide each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[allow(missing_docs)] // The names say what each is.
pub enum Shape {
    Dot,
    Circle,
    Square,
    Diamond,
    Cross,
    Plus,
}

/// Colours that the colour-blind tell apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[allow(missing_docs)] // The names say what each is.
pub enum Colour {
    Ink,
    Blue,
    Vermilion,
    Purple,
    Orange,
    Green,
}

/// Durations for forecasts; a multiple is the time limit.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(super) struct Seconds {
    /// Wall time of a start, in seconds.
    pub(super) start: f64,
    /// Wall time of a step of a stack, in seconds.
    pub(super) step: f64,
}

impl Default for Seconds {
    fn default() -> Self {
        Self {
            start: 1.0,
            step: 5e-6,
        }
    }
}

/// Variables for the environment of a program.
pub(super) type Environment = BTreeMap<String, String>;

/// How a code is started.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Program {
    /// Words with placeholders, never a line for a shell.
    pub(super) command: Vec<String>,
    /// Directories in which the first word is looked for: `{folder}` is the folder of the manifest, `$NAME` an environment
    /// variable; a directory with one that is not set is left out. The search path is one of them only as `$PATH`, or if
    /// there are none.
    #[serde(default)]
    #[schemars(with = "Vec<String>")]
    pub(super) search: Vec<Spanned<String>>,
    /// A build of the program that computes with more digits.
    pub(super) higher_precision: Option<String>,
    /// How the version of the program is found.
    #[serde(default)]
    pub(super) version: VersionQuestion,
    /// Variables for its environment.
    #[serde(default)]
    pub(super) environment: Environment,
    /// Files in the working directory that say why a run failed, and are quoted then.
    #[serde(default)]
    pub(super) logs: Vec<String>,
}

/// How the version of a program is found.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(super) struct VersionQuestion {
    /// Whether the version of its package, which is found faster, will do.
    pub(super) package: bool,
    /// Arguments with which it prints its version; without any, the version is unknown.
    pub(super) arguments: Vec<String>,
    /// Text before the version in the first line it prints.
    pub(super) before: String,
}

/// The file that holds the parameters of a task.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(super) struct ParameterFile {
    /// Its name in the run directory.
    pub(super) file: String,
    /// How it is written.
    pub(super) format: ParameterFormat,
    /// How many of them there are.
    pub(super) content: ParameterContent,
}

/// The parameters that a deck is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(super) enum ParameterContent {
    /// Everything that a deck needs (docs/formats.md, `task`).
    Task,
    /// What the decks that come with tristack read, which know the units, the bodies and where these start.
    Deck,
}

impl Default for ParameterFile {
    fn default() -> Self {
        Self {
            file: "task.json".to_owned(),
            format: ParameterFormat::Json,
            content: ParameterContent::Task,
        }
    }
}

/// The file that holds the result of a task.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ResultFile {
    /// Its name in the run directory.
    pub(super) file: String,
    /// How it is written.
    pub(super) format: ResultFormat,
    /// Columns under other names, in other units or directions: the name that tristack gives them, and the name in the
    /// result, with a factor if there is one.
    #[serde(deserialize_with = "read_columns")]
    #[schemars(with = "BTreeMap<String, Written>")]
    pub(super) columns: ColumnSources,
}

impl Default for ResultFile {
    fn default() -> Self {
        Self {
            file: "result.csv".to_owned(),
            format: ResultFormat::Csv,
            columns: ColumnSources::new(),
        }
    }
}

/// The files of a task.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct TaskFiles {
    /// The first one is the deck; none if the program needs nothing but its parameters.
    #[serde(default)]
    pub(super) files: Vec<String>,
    /// Its result file, if not the common one.
    pub(super) result: Option<String>,
    /// Its columns, where they are not the common ones.
    #[serde(default, deserialize_with = "read_columns")]
    #[schemars(with = "BTreeMap<String, Written>")]
    pub(super) columns: ColumnSources,
    #[serde(skip)]
    pub(super) contents: Vec<Vec<u8>>,
}

/// Properties of a code's time integration that show in a comparison with its native twin.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct Integration {
    /// Steps by which reported velocities lag behind reported positions.
    pub velocity_lag: f64,
    /// The origin of its angles.
    pub angle: Angle,
    /// Whether two surfaces that just touch are a contact.
    pub touches_at_zero_overlap: bool,
}

impl Default for Integration {
    fn default() -> Self {
        Self {
            velocity_lag: 0.5,
            angle: Angle::Exact,
            touches_at_zero_overlap: false,
        }
    }
}

/// The origin of the angles of a code.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Angle {
    /// The integrator turns the body by spin × time step.
    Exact,
    /// The deck sums the spin by the trapezoidal rule.
    SummedSpin,
    /// The integrator turns a dipole by arctan(spin × time step).
    Dipole,
}

/// Parameter values that the code cannot take.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Refused {
    /// Coefficients of restitution.
    pub(super) restitution: Option<RefusedValues>,
    /// Stiffness ratios k_n/k_t.
    pub(super) stiffness_ratio: Option<RefusedOutside>,
}

/// The values that are accepted, and the reason.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct RefusedOutside {
    /// The lowest and the highest value that is accepted.
    pub(super) outside: [f64; 2],
    /// Why it cannot take others.
    pub(super) because: String,
}

/// The values, and the reason.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct RefusedValues {
    /// The values.
    pub(super) values: Vec<f64>,
    /// Why it cannot take them.
    pub(super) because: String,
}
