//! Trajectories of the native DEM at one finite wall speed.

use super::file::{
    LICENCE, Provenance, digits_of_agreement, folder, kept, layout, schema, second_route, updating,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;
use tristack::code::Code;
use tristack::dem::compress_stack;
use tristack::model::{
    Arms, Case, ContactArms, ContactConvention, CoulombOperand, HistoryUpdate, PreparationSteps,
    Problem, Protocol, Sampling, SlidingSpring, Stack, TensileForce,
};
use tristack::series::Series;
use tristack::study::yield_force::protocol_at_speed;
use tristack::theory::quasistatic_limit;

const SCHEMA: &str = "tristack/trajectory-vector/1";
/// A double has no more.
const MOST_DIGITS: u32 = 15;
const LEAST_DIGITS: u32 = 9;
const WALL_SPEED: f64 = 1e-3;
const TIME_STEP: f64 = 0.1;
/// Time between rows, far from the yield and near it: some fifty rows a run.
const COARSE_INTERVAL: f64 = 20.0;
const FINE_INTERVAL: f64 = 4.0;

/// One compression of a three-cylinder stack at a finite wall speed.
#[derive(Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Trajectory {
    /// The JSON Schema of this file.
    #[serde(rename = "$schema")]
    json_schema: String,
    /// Name and version of the format; the version is raised when a key goes or changes its meaning.
    schema: String,
    /// SPDX identifier of the licence.
    licence: String,
    provenance: Provenance,
    /// Name of the vector.
    id: String,
    /// What is special about it.
    what: String,
    /// The case: stack, contact convention, protocol. `tristack simulate --code native --case` takes it as a file.
    case: Value,
    /// The coefficients of the contact law, in k_n and √(m k_n).
    law: Value,
    /// The protocol in time steps.
    steps: Steps,
    /// The columns of the rows, in their order.
    columns: Vec<Column>,
    /// Rows by the program, each number in the shortest form that a double reads back.
    rows: Vec<Vec<f64>>,
    /// The same rows by the second route, computed with 30 digits, as doubles.
    second: Vec<Vec<f64>>,
}

/// The protocol in time steps: step 0 of the rows is the one in which the wall is put onto the stack.
#[derive(Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Steps {
    /// Steps during which gravity rises as x³ (10 − 15 x + 6 x²).
    ramp: u64,
    /// Steps at rest after that.
    rest: u64,
    /// Steps of the compression.
    compression: u64,
    /// Steps between rows at first.
    coarse_every: u64,
    /// Step of the compression from which rows are fine.
    fine_from: u64,
    /// Steps between rows from there on.
    fine_every: u64,
}

/// A column of the rows.
#[derive(Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Column {
    name: String,
    /// Digits to which the two routes agree, relative to the largest value of the column.
    digits: u32,
    /// The largest value.
    largest: f64,
    /// Largest change of a row when the time step is halved: a code with another integrator of the same order, but
    /// the same contact law, may be as far away as this.
    effect_of_time_step: f64,
}

/// A trajectory.
struct Chosen {
    id: &'static str,
    /// What is special about it.
    what: &'static str,
    stack: Stack,
    convention: ContactConvention,
    /// How far the wall moves beyond the slip onset, in r. In the collapse after the peak a rounding grows a
    /// thousandfold, and so it does while the floor sticks and slips with c > 0.
    beyond: f64,
}

fn chosen() -> [Chosen; 7] {
    let chosen = |id, what, stack, convention| Chosen {
        id,
        what,
        stack,
        convention,
        beyond: 0.03,
    };
    let turning = ContactConvention::TURNING;
    let other = ContactConvention {
        arms: Arms::reciprocal(-0.5, -1.0),
        restitution: 0.5,
        coulomb_operand: CoulombOperand::Spring,
        sliding_spring: SlidingSpring::FollowsLimit,
        history_update: HistoryUpdate::Projected,
        tensile_force: TensileForce::NeverPulls,
        ..turning
    };
    let separate = ContactConvention {
        arms: Arms {
            pair: ContactArms {
                torque: -0.5,
                kinematic: 0.0,
            },
            floor: ContactArms {
                torque: 0.0,
                kinematic: -0.5,
            },
        },
        history_update: HistoryUpdate::Linearised,
        ..turning
    };
    let other_fixed = ContactConvention {
        history_update: HistoryUpdate::Fixed,
        ..other
    };
    let soft = |mu| Stack::paper(mu, 1e2);
    let slippery = Stack {
        cylinder_friction: 0.35,
        ..soft(0.3)
    };
    let touching = Stack {
        stiffness_ratio: 0.6,
        ..soft(0.3)
    };
    [
        chosen("below", "mu below 2 - sqrt 3", soft(0.2), turning),
        chosen("above", "mu above 2 - sqrt 3", soft(0.3), turning),
        chosen(
            "fixed",
            "mu above 2 - sqrt 3, and the paper's spring, which nothing turns",
            soft(0.3),
            ContactConvention::PAPER,
        ),
        chosen(
            "fixed-slipping",
            "the same spring with other words, and the cylinders slip on each other in the collapse",
            slippery,
            other_fixed,
        ),
        Chosen {
            beyond: 0.2,
            ..chosen(
                "touching",
                "the bottom cylinders touch: the force rises on after the slip onset",
                touching,
                turning,
            )
        },
        chosen(
            "other-convention",
            "every word of the convention is another than the paper's",
            soft(0.3),
            other,
        ),
        chosen(
            "separate-arms",
            "torque arms and kinematic arms differ",
            soft(0.25),
            separate,
        ),
    ]
}

impl Chosen {
    fn case(&self) -> Case {
        let problem = Problem::new(self.stack, self.convention).expect("values in range");
        let limit = quasistatic_limit(&problem);
        let planned = protocol_at_speed(&limit, WALL_SPEED, TIME_STEP).expect("the stack yields");
        let travel = limit.wall_travel.expect("the floor slips") + self.beyond;
        let case = Case {
            stack: self.stack,
            convention: self.convention,
            protocol: Protocol {
                wall_travel: format!("{travel:.3}").parse().expect("a number"),
                sampling: Sampling {
                    coarse_interval: COARSE_INTERVAL,
                    fine_interval: FINE_INTERVAL,
                    ..planned.sampling
                },
                ..planned
            },
        };
        case.validate().expect("a case");
        case
    }
}

fn rows(case: &Case) -> Vec<Vec<f64>> {
    let series = compress_stack(case, || true).expect("a finite series");
    let table = series.to_csv();
    let mut reader = csv::Reader::from_reader(table.as_slice());
    let rows = reader.deserialize().map(|row| row.expect("numbers"));
    rows.collect()
}

/// The rows of a run with half the time step, at the same times.
fn rows_of_half_a_step(case: &Case) -> Vec<Vec<f64>> {
    let mut halved = *case;
    halved.protocol.time_step *= 0.5;
    rows(&halved)
}

fn law(case: &Case) -> Value {
    let law = case.convention.law(case.stack.stiffness_ratio);
    serde_json::to_value(law).expect("numbers")
}

fn steps(case: &Case) -> Steps {
    let schedule = case.protocol.schedule();
    let PreparationSteps::GravityRamp { ramp, rest } = schedule.preparation else {
        panic!("a gravity ramp");
    };
    Steps {
        ramp,
        rest,
        compression: schedule.compression_steps,
        coarse_every: schedule.coarse_every,
        fine_from: schedule.fine_from_step,
        fine_every: schedule.fine_every,
    }
}

/// Largest absolute value of `number` over the rows.
fn largest(rows: usize, number: impl Fn(usize) -> f64) -> f64 {
    (0..rows).map(|row| number(row).abs()).fold(0.0, f64::max)
}

fn columns(rows: &[Vec<f64>], second: &[Vec<f64>], halved: &[Vec<f64>]) -> Vec<Column> {
    let counts = [rows, halved].map(<[_]>::len);
    assert_eq!(counts[0], counts[1]);
    let column = |(index, name): (usize, &&str)| {
        let scale = largest(rows.len(), |row| rows[row][index]);
        let apart = largest(second.len(), |row| rows[row][index] - second[row][index]);
        Column {
            name: (*name).to_owned(),
            digits: digits_of_agreement(apart, 0.0, scale, MOST_DIGITS),
            largest: scale,
            effect_of_time_step: match index {
                // The steps of half a time step are twice as many.
                0 => 0.0,
                _ => largest(rows.len(), |row| rows[row][index] - halved[row][index]),
            },
        }
    };
    Series::COLUMNS.iter().enumerate().map(column).collect()
}

/// The rows of the second route by the names of the vectors.
fn second() -> BTreeMap<String, Vec<Vec<f64>>> {
    let mut all: BTreeMap<String, Vec<Vec<f64>>> = BTreeMap::new();
    for row in second_route("vector_trajectories.csv") {
        let number = |name: &&str| row[*name].parse().expect("a number");
        let numbers = Series::COLUMNS.iter().map(number).collect();
        all.entry(row["id"].clone()).or_default().push(numbers);
    }
    all
}

fn file(id: &str) -> String {
    format!("trajectory-{id}.json")
}

#[test]
fn trajectories_are_those_of_two_routes() {
    let second = second();
    let mut open = Vec::new();
    for chosen in chosen() {
        let Chosen { id, what, .. } = chosen;
        let case = chosen.case();
        let rows = rows(&case);
        let second = second.get(id).filter(|second| second.len() == rows.len());
        if second.is_none() {
            open.push(id);
        }
        let second = second.cloned().unwrap_or_default();
        let now = Trajectory {
            json_schema: "trajectory.schema.json".to_owned(),
            schema: SCHEMA.to_owned(),
            licence: LICENCE.to_owned(),
            provenance: Provenance::of(Code::native().deck_hash(&case)),
            id: id.to_owned(),
            what: what.to_owned(),
            case: serde_json::to_value(case).expect("plain values"),
            law: law(&case),
            steps: steps(&case),
            columns: columns(&rows, &second, &rows_of_half_a_step(&case)),
            rows,
            second,
        };
        let written = kept(&file(id), &layout(&now, &["columns", "rows", "second"]));
        compare(&serde_json::from_str(&written).expect("a trajectory"), &now);
    }
    assert!(
        open.is_empty(),
        "run python3 reference/golden/vectors.py, then this again, for {open:?}"
    );
}

/// The native DEM gives the same bits on every machine; the second route agrees to the digits that are said.
fn compare(written: &Trajectory, now: &Trajectory) {
    let id = &now.id;
    let keys = |one: &Trajectory| (one.schema.clone(), one.case.clone(), one.law.clone());
    assert_eq!(keys(written), keys(now), "{id}");
    assert_eq!(written.steps, now.steps, "{id}");
    assert_eq!(written.rows, now.rows, "{id}");
    assert_eq!(written.second, now.second, "{id}");
    assert_eq!(written.columns, now.columns, "{id}");
    for column in &now.columns {
        let enough = now.second.is_empty() || column.digits >= LEAST_DIGITS;
        assert!(enough, "{id}: {column:?}");
    }
}

#[test]
fn there_is_no_trajectory_but_those_that_are_chosen() {
    let files = std::fs::read_dir(folder()).expect("a folder");
    let names = files.map(|entry| {
        entry
            .expect("an entry")
            .file_name()
            .into_string()
            .expect("a name")
    });
    let mut names: Vec<String> = names
        .filter(|name| name.starts_with("trajectory-"))
        .collect();
    let mut expected: Vec<String> = chosen().iter().map(|one| file(one.id)).collect();
    names.sort();
    expected.sort();
    assert!(updating() || names == expected, "{names:?}");
}

#[test]
fn the_schema_of_trajectories_is_the_one_of_their_types() {
    let now = schema::<Trajectory>();
    assert_eq!(kept("trajectory.schema.json", &now), now);
}
