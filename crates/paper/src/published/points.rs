//! The published yield forces, and the runs that give them.

use super::checkout::{Checkout, DataFile, Printed, Subject};
use crate::dem::{ForceSampling, GivenStart, PublishedRun};
use crate::model::{ContactConvention, Problem, Stack};
use crate::theory::quasistatic_limit;
use serde::Deserialize;

const SETTINGS: &str = include_str!("../../reference/published.toml");
/// Stack of the figures on time step and wall speed (paper, caption of Fig. S3).
const FIGURE_S3: (f64, f64) = (0.2, 1e4);
/// Wall speed of the figure on the time step, and time step of the one on wall speed (paper, caption of Fig. S3).
const OTHER: f64 = 1e-3;
/// Wall speed in r √(k_n/m) and time step in √(m/k_n) of all yield forces, as the supplement gives them (Sec. I C).
pub(super) const PAPER_SETTINGS: [f64; 2] = [1e-6, 1e-3];
/// Time for which the wall stands still at first, in √(r/g).
pub const WALL_STARTS: f64 = 1.0;
/// Restitution of the program.
pub(super) const RESTITUTION: f64 = 0.3;

/// Settings that give the rows of a file within a range of their first number.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Rows {
    file: String,
    #[serde(default = "lowest")]
    from: f64,
    #[serde(default = "highest")]
    to: f64,
    friction: Option<f64>,
    start: String,
    wall_speed: Option<f64>,
    time_step: Option<f64>,
    time_step_per_root: Option<f64>,
    end_time: Option<f64>,
}

/// Settings that give a series of forces.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Series {
    file: String,
    friction: f64,
    stiffness: f64,
    start: String,
    wall_speed: f64,
    time_step: f64,
}

fn lowest() -> f64 {
    f64::NEG_INFINITY
}

fn highest() -> f64 {
    f64::INFINITY
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Settings {
    rows: Vec<Rows>,
    series: Vec<Series>,
}

impl Settings {
    fn read() -> Self {
        toml::from_str(SETTINGS).expect("it is checked by a test")
    }
}

/// A published yield force.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedForce {
    /// The file, below the checkout.
    pub file: String,
    /// The line in the file.
    pub line: usize,
    /// The stack, as file and figure say.
    pub stack: Stack,
    /// The force as it is printed, in m g.
    pub value: Printed,
    /// Wall speed and time step as figure and supplement give them, in r √(k_n/m) and √(m/k_n).
    pub labelled: [f64; 2],
    /// The exact limit of the stack with springs that do not turn with the contact, in m g; `None` if it has none.
    pub limit: Option<f64>,
    /// The run that gives the force; `None` if it is not known or cannot be made, as without its start in the
    /// checkout.
    pub origin: Option<ForceOrigin>,
}

impl PublishedForce {
    /// Returns the folder of its figure, such as `fig2a`.
    pub fn figure(&self) -> &str {
        self.file.rsplit('/').nth(2).unwrap_or_default()
    }

    /// Returns F + 3, as the figures show it.
    pub fn load(&self) -> f64 {
        self.value.value + 3.0
    }
}

/// Start, wall speed and time step of a published force, in the units of the program, √(g r) and √(r/g).
#[derive(Debug, Clone, PartialEq)]
pub struct ForceOrigin {
    /// The push of the side walls in the name of the start.
    pub start: String,
    /// Wall speed, in √(g r).
    pub wall_speed: f64,
    /// Time step, in √(r/g).
    pub time_step: f64,
    /// Time at which the run ended before its force fell, in √(r/g); `None` where it ended with the first decrease.
    pub end_time: Option<f64>,
    /// The native run.
    pub run: PublishedRun,
}

/// Returns the yield forces of a checkout, file by file.
pub fn published_forces(checkout: &Checkout) -> Vec<PublishedForce> {
    let settings = Settings::read();
    let files = checkout.files.iter();
    let forces = files.flat_map(|file| {
        let settings = &settings.rows;
        file.rows
            .iter()
            .filter_map(move |(line, numbers)| force(checkout, settings, file, (*line, *numbers)))
    });
    forces.collect()
}

fn force(
    checkout: &Checkout,
    settings: &[Rows],
    file: &DataFile,
    (line, [first, value]): (usize, [Printed; 2]),
) -> Option<PublishedForce> {
    let (friction, stiffness) = match file.subject {
        Subject::Frictions { stiffness } => (first.value, stiffness),
        Subject::Stiffnesses { friction } => (friction, first.value),
        Subject::TimeSteps | Subject::WallSpeeds => FIGURE_S3,
        Subject::Force => return None,
    };
    let stack = Stack::paper(friction, stiffness);
    let own = settings.iter().find(|rows| {
        file.path.ends_with(&rows.file) && rows.from <= first.value && first.value <= rows.to
    });
    let origin = own.and_then(|rows| {
        let root = stiffness.sqrt();
        let wall_speed = match file.subject {
            Subject::WallSpeeds => first.value,
            _ => rows.wall_speed.unwrap_or(OTHER),
        };
        let time_step = match (file.subject, rows.time_step_per_root) {
            (Subject::TimeSteps, _) => first.value,
            (_, Some(per_root)) => per_root * root,
            _ => rows.time_step.unwrap_or(OTHER),
        };
        let start = checkout.starts.get(&rows.start)?;
        let stack = Stack::paper(rows.friction.unwrap_or(friction), stiffness);
        let can_be_run =
            stack.validate().is_ok() && [wall_speed, time_step].iter().all(|&own| own > 0.0);
        can_be_run.then(|| ForceOrigin {
            start: rows.start.clone(),
            wall_speed,
            time_step,
            end_time: rows.end_time,
            run: PublishedRun {
                sampling: rows
                    .end_time
                    .map(|time| ForceSampling::at((time / time_step).round() as u64)),
                ..run(start, &stack, wall_speed, time_step)
            },
        })
    });
    Some(PublishedForce {
        file: file.path.clone(),
        line,
        stack,
        value,
        labelled: match file.subject {
            Subject::TimeSteps => [OTHER, first.value],
            Subject::WallSpeeds => [first.value, OTHER],
            _ => PAPER_SETTINGS,
        },
        limit: limit(&stack),
        origin,
    })
}

pub(super) fn limit(stack: &Stack) -> Option<f64> {
    let problem = Problem::new(*stack, ContactConvention::PAPER).ok()?;
    quasistatic_limit(&problem).yield_force
}

/// Returns the height of the wall at first, in r: that of three cylinders that just touch.
pub(super) fn wall_height() -> f64 {
    2.0 + 3f64.sqrt()
}

/// Returns the run of a stack from a `start`, at a speed and time step in the program's units.
pub(super) fn run(
    start: &GivenStart,
    stack: &Stack,
    wall_speed: f64,
    time_step: f64,
) -> PublishedRun {
    let root = stack.stiffness.sqrt();
    PublishedRun {
        start: GivenStart {
            velocities: start.velocities.map(|own| own.map(|rate| rate / root)),
            ..*start
        },
        stack: *stack,
        restitution: RESTITUTION,
        wall_height: wall_height(),
        wall_starts: WALL_STARTS * root,
        wall_speed: wall_speed / root,
        time_step: time_step * root,
        sampling: None,
    }
}

/// A published series of the force of the wall.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedSeries {
    /// The file, below the checkout.
    pub file: String,
    /// The stack.
    pub stack: Stack,
    /// The exact limit of the stack with springs that do not turn with the contact, in m g; `None` if it has none.
    pub limit: Option<f64>,
    /// Time in √(r/g) and force as they are printed, each row with its line.
    pub rows: Vec<(usize, [Printed; 2])>,
    /// The run that gives them; `None` if its start is not in the checkout.
    pub origin: Option<ForceOrigin>,
}

impl PublishedSeries {
    /// Returns the wall speed that gives it, in √(g r).
    pub fn wall_speed(&self) -> Option<f64> {
        self.origin.as_ref().map(|origin| origin.wall_speed)
    }
}

/// Returns the series of a checkout.
pub fn published_series(checkout: &Checkout) -> Vec<PublishedSeries> {
    let settings = Settings::read().series;
    let series = settings.iter().filter_map(|own| {
        let mut files = checkout.files.iter();
        let file = files.find(|file| file.path.ends_with(&own.file))?;
        let stack = Stack::paper(own.friction, own.stiffness);
        let steps =
            |row: usize| Some((file.rows.get(row)?.1[0].value / own.time_step).round() as u64);
        let first = steps(0)?;
        let sampling = ForceSampling {
            first,
            every: steps(1).map_or(1, |second| second.saturating_sub(first).max(1)),
            count: file.rows.len() as u64,
        };
        let start = checkout.starts.get(&own.start);
        Some(PublishedSeries {
            file: file.path.clone(),
            stack,
            limit: limit(&stack),
            rows: file.rows.clone(),
            origin: start.map(|start| ForceOrigin {
                start: own.start.clone(),
                wall_speed: own.wall_speed,
                time_step: own.time_step,
                end_time: None,
                run: PublishedRun {
                    sampling: Some(sampling),
                    ..run(start, &stack, own.wall_speed, own.time_step)
                },
            }),
        })
    });
    series.collect()
}
