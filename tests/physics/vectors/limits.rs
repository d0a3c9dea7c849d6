//! Exact limits: rest, slip onset and peak.

use super::file::{
    LICENCE, Provenance, digits_of_agreement, kept, layout, schema, second_route, sources_hash,
    updating,
};
use super::inputs::{Input, inputs};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;
use tristack::model::{Arms, ContactConvention, HistoryUpdate, Problem, Stack};
use tristack::theory::{Event, Limit, LoadingOutcome, quasistatic_limit};

const SCHEMA: &str = "tristack/limit-vectors/2";
/// The program promises no more of any number (`crates/theory/tests/theory/closed_form.rs`); the last digits may differ between machines.
const MOST_DIGITS: u32 = 12;
/// A vector with fewer is no test.
const LEAST_DIGITS: u32 = 8;

/// Exact quasi-static limits of three-cylinder stacks.
#[derive(Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Limits {
    /// The JSON Schema of this file.
    #[serde(rename = "$schema")]
    json_schema: String,
    /// Name and version of the format; the version is raised when a key goes or changes its meaning.
    schema: String,
    /// SPDX identifier of the licence.
    licence: String,
    provenance: Provenance,
    /// Units of the quantities.
    units: BTreeMap<String, String>,
    vectors: Vec<Vector<Number>>,
}

/// A stack, and what becomes of it.
#[derive(Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Vector<N> {
    /// Name of the vector.
    id: String,
    input: Input,
    /// What comes first on the path of equilibria: `floor-slip`, `own-weight` (the floor slips before gravity is
    /// complete), `contact-closes` (the bottom cylinders touch), `cylinder-slip` (|q| = mu_d a, see `pair_ratio`),
    /// `wall-contact` (the top wall reaches the bottom cylinders).
    first_event: String,
    /// Why there is no peak.
    reason: Option<String>,
    /// The stack under its own weight; absent where it does not stand without sliding.
    rest: Option<Rest<N>>,
    /// Where the floor begins to slip under the wall.
    slip_onset: Option<SlipOnset<N>>,
    /// The largest force: at the slip onset where c = 0 there, later otherwise.
    peak: Option<Peak<N>>,
    /// Where the cylinders slip on each other, if that comes first.
    cylinder_slip: Option<CylinderSlip<N>>,
}

#[derive(Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Rest<N> {
    /// Horizontal position of the right cylinder, in r; the middle is at 0.
    x2: N,
    /// Height of the top cylinder's centre above the floor, in r.
    y1: N,
    /// Height of the bottom cylinders' centres, in r.
    y2: N,
}

#[derive(Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct SlipOnset<N> {
    /// Force of the wall, in m g.
    #[serde(rename = "F")]
    force: N,
    /// T = tan(ψ/2), ψ the angle of the line from the right cylinder to the top one against the vertical.
    #[serde(rename = "T")]
    tangent: N,
    /// x₂ − r, in r.
    y: N,
    /// Overlap of a bottom cylinder and the floor, in r.
    z: N,
    /// Force between the bottom cylinders, in m g.
    c: N,
    /// b/a between the cylinders: a is the force of the normal spring, b the part of that of the tangential spring, q,
    /// along the tangent. Of a spring that turns that is all of it, and b = |q|.
    pair_ratio: N,
    /// Distance that the wall has moved since it touched the stack at rest, in r.
    wall_travel: N,
}

#[derive(Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Peak<N> {
    /// Force of the wall, in m g.
    #[serde(rename = "F")]
    force: N,
    /// Overlap of a bottom cylinder and the floor, in r.
    z: N,
    /// Distance that the wall has moved since it touched the stack at rest, in r.
    wall_travel: N,
}

#[derive(Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct CylinderSlip<N> {
    /// Force of the wall, in m g: the largest, whatever mu is.
    #[serde(rename = "F")]
    force: N,
    /// T = tan(ψ/2).
    #[serde(rename = "T")]
    tangent: N,
}

/// A number by two routes.
#[derive(Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Number {
    /// The number to test against, rounded to the digits below.
    value: f64,
    /// Significant digits on which the two routes agree, at most 12: a result is right if it is within
    /// 10^(1 − digits) of the value, relative to it.
    digits: u32,
    /// The number by the program.
    program: f64,
    /// The number by the second route, to 20 digits.
    second: String,
}

impl Number {
    fn agreed(program: f64, second: &str) -> Self {
        let other: f64 = second.parse().expect("a number");
        let digits = digits_of_agreement(program, other, other, MOST_DIGITS);
        let rounded = format!("{other:.*e}", digits.max(1) as usize - 1);
        Self {
            value: rounded.parse().expect("a number"),
            digits,
            program,
            second: second.to_owned(),
        }
    }
}

/// What the program says of `input`.
fn by_the_program(input: &Input) -> Vector<f64> {
    let (stack, convention) = (input.stack(), input.convention());
    let limit = quasistatic_limit(&Problem::new(stack, convention).expect("values in range"));
    let slid_at_rest = limit.event == Event::FloorSlip && limit.slip_onset.is_none();
    Vector {
        id: input.id(),
        input: input.clone(),
        first_event: match slid_at_rest {
            true => "own-weight".to_owned(),
            false => limit.event.to_string(),
        },
        rest: limit.rest.map(|[x2, y1, y2]| Rest { x2, y1, y2 }),
        slip_onset: slip_onset(&limit),
        peak: peak(&limit),
        cylinder_slip: cylinder_slip(&limit, &stack, &convention),
        reason: limit.reason,
    }
}

fn slip_onset(limit: &Limit) -> Option<SlipOnset<f64>> {
    Some(SlipOnset {
        force: limit.slip_onset?,
        tangent: limit.tangent?,
        y: limit.y?,
        z: limit.z?,
        c: limit.bottom_force?,
        pair_ratio: limit.pair_ratio?,
        wall_travel: limit.wall_travel?,
    })
}

fn peak(limit: &Limit) -> Option<Peak<f64>> {
    Some(Peak {
        force: limit.peak_force?,
        z: limit.peak_z?,
        wall_travel: limit.peak_travel?,
    })
}

/// Known for the paper's arms alone.
fn cylinder_slip(
    limit: &Limit,
    stack: &Stack,
    convention: &ContactConvention,
) -> Option<CylinderSlip<f64>> {
    let slips = limit.event == Event::CylinderSlip && convention.arms == Arms::PAPER;
    let first = LoadingOutcome::of(stack, convention.history_update)
        .filter(|_| slips)?
        .first;
    Some(CylinderSlip {
        force: first.force,
        tangent: first.tangent,
    })
}

const SECTIONS: [&str; 4] = ["rest", "slip_onset", "peak", "cylinder_slip"];

/// `program` with each number beside that of the second route. The two must have the same numbers, and the same event.
fn beside(program: &Vector<f64>, second: &BTreeMap<String, String>) -> Vector<Number> {
    let id = &program.id;
    assert_eq!(second["first_event"], program.first_event, "{id}");
    let mut both = serde_json::to_value(program).expect("plain values");
    let paper = program.input.convention().arms == Arms::PAPER;
    for section in SECTIONS {
        // Of the slip of cylinders with other arms the program has no number.
        if section == "cylinder_slip" && !paper {
            continue;
        }
        let prefix = format!("{section}_");
        let own = second.iter().filter(|(key, _)| key.starts_with(&prefix));
        for (key, second) in own {
            let number = &mut both[section][key.trim_start_matches(&prefix)];
            assert_eq!(number.is_null(), second.is_empty(), "{id}: {key} {second}");
            if let Some(program) = number.as_f64() {
                let agreed = Number::agreed(program, second);
                assert!(agreed.digits >= LEAST_DIGITS, "{id}: {key} {agreed:?}");
                *number = serde_json::to_value(agreed).expect("plain values");
            }
        }
        // Reading a number of a section that is not there has made an object of it.
        let object = both[section].as_object();
        if object.is_some_and(|object| object.values().all(Value::is_null)) {
            both[section] = Value::Null;
        }
    }
    serde_json::from_value(both).expect("the second route has every number of the program")
}

fn document(vectors: Vec<Vector<Number>>) -> Limits {
    let units = [
        ("F", "m g"),
        ("c", "m g"),
        ("T", "1"),
        ("pair_ratio", "1"),
        ("stiffness", "m g/r"),
    ];
    let lengths = ["x2", "y1", "y2", "y", "z", "wall_travel"].map(|name| (name, "r"));
    let units = units.into_iter().chain(lengths);
    Limits {
        json_schema: "limits.schema.json".to_owned(),
        schema: SCHEMA.to_owned(),
        licence: LICENCE.to_owned(),
        provenance: Provenance::of(sources_hash(&["crates/theory/src"])),
        units: units
            .map(|(name, unit)| (name.to_owned(), unit.to_owned()))
            .collect(),
        vectors,
    }
}

/// The second route by the names of the vectors.
fn second() -> BTreeMap<String, BTreeMap<String, String>> {
    let rows = second_route("vector_limits.csv").into_iter();
    rows.map(|row| (row["id"].clone(), row)).collect()
}

/// A vector without an answer, from which the second route takes its input.
fn unanswered(input: &Input) -> Vector<Number> {
    Vector {
        id: input.id(),
        input: input.clone(),
        first_event: String::new(),
        reason: None,
        rest: None,
        slip_onset: None,
        peak: None,
        cylinder_slip: None,
    }
}

#[test]
fn limits_are_those_of_two_routes() {
    let second = second();
    let inputs = inputs();
    let answers: Vec<Option<Vector<Number>>> = inputs
        .iter()
        .map(|input| Some(beside(&by_the_program(input), second.get(&input.id())?)))
        .collect();
    let open: Vec<String> = inputs
        .iter()
        .map(Input::id)
        .filter(|id| !second.contains_key(id))
        .collect();
    let vectors = answers.into_iter().zip(&inputs);
    let vectors = vectors.map(|(answer, input)| answer.unwrap_or_else(|| unanswered(input)));
    let now = document(vectors.collect());
    let written = kept("limits.json", &layout(&now, &["vectors"]));
    assert!(
        open.is_empty(),
        "run python3 reference/golden/vectors.py, then this again, for {open:?}"
    );
    let written: Limits = serde_json::from_str(&written).expect("limits");
    assert_eq!(
        (written.schema.as_str(), written.licence.as_str()),
        (SCHEMA, LICENCE)
    );
    assert_eq!(written.units, now.units);
    assert_eq!(written.vectors.len(), now.vectors.len());
    for (written, now) in written.vectors.iter().zip(&now.vectors) {
        assert_eq!((&written.id, &written.input), (&now.id, &now.input));
        assert_eq!(
            (&written.first_event, &written.reason),
            (&now.first_event, &now.reason)
        );
        compare(written, now);
    }
}

/// The numbers that are written, against those of today: what is said of their digits holds.
fn compare(written: &Vector<Number>, now: &Vector<Number>) {
    let [old, new] = [written, now].map(|vector| serde_json::to_value(vector).expect("values"));
    for section in SECTIONS {
        assert_eq!(
            old[section].is_null(),
            new[section].is_null(),
            "{}: {section}",
            now.id
        );
        let entries = old[section].as_object().into_iter().flatten();
        for (key, number) in entries {
            let name = format!("{}: {section}.{key}", now.id);
            let number: Number = serde_json::from_value(number.clone()).expect("a number");
            let new: Number = serde_json::from_value(new[section][key].clone()).expect("a number");
            assert_eq!(number.second, new.second, "{name}");
            let second: f64 = new.second.parse().expect("a number");
            let close = 10f64.powi(-(number.digits as i32)) * second.abs();
            assert!((new.program - second).abs() <= close, "{name}: {new:?}");
            assert!(
                (number.program - second).abs() <= close,
                "{name}: {number:?}"
            );
            assert!(
                (number.value - second).abs() <= 5.0 * close,
                "{name}: {number:?}"
            );
            assert!(
                (LEAST_DIGITS..=MOST_DIGITS).contains(&number.digits),
                "{name}: {number:?}"
            );
        }
    }
}

#[test]
fn the_schema_of_limits_is_the_one_of_their_types() {
    let now = schema::<Limits>();
    assert_eq!(kept("limits.schema.json", &now), now);
}

#[test]
fn vectors_of_either_spring_cover_every_event_and_an_onset_apart_from_its_peak() {
    if updating() {
        return;
    }
    let written: Limits = serde_json::from_str(&kept("limits.json", "")).expect("limits");
    for (spring, least_apart) in [(HistoryUpdate::Rotated, 10), (HistoryUpdate::Fixed, 5)] {
        let vectors = written
            .vectors
            .iter()
            .filter(|vector| vector.input.history_update == spring);
        for event in [
            "floor-slip",
            "own-weight",
            "contact-closes",
            "cylinder-slip",
            "wall-contact",
        ] {
            let mut events = vectors.clone().map(|vector| &vector.first_event);
            assert!(events.any(|first| first == event), "{spring:?}: {event}");
        }
        let apart = vectors.filter(|vector| match (&vector.slip_onset, &vector.peak) {
            (Some(onset), Some(peak)) => {
                onset.force.value < peak.force.value && onset.c.value > 0.0
            }
            _ => false,
        });
        assert!(apart.count() >= least_apart, "{spring:?}");
    }
}
