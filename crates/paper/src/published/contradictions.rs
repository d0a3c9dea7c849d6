//! Compares what data files, their heads, the program and the paper say about the same quantity.

use super::checkout::{Checkout, DataFile, Subject};
use super::points::{PAPER_SETTINGS, PublishedForce};
use crate::model::{CRITICAL_FRICTION, PAPER_STIFFNESS_RATIO};

/// A number, and where it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct Quotation {
    /// File and line, or place in the paper.
    pub source: String,
    /// The number.
    pub value: f64,
    /// The number as it is printed there; with three digits if it is computed.
    pub printed: String,
}

/// Two numbers for the same quantity that do not agree.
#[derive(Debug, Clone, PartialEq)]
pub struct Contradiction {
    /// The quantity, with its unit.
    pub what: String,
    /// The two numbers.
    pub quoted: [Quotation; 2],
    /// Why they differ, where that is known.
    pub because: String,
    /// Added to both numbers before they are compared: the weight of the stack, 3 m g, for forces, else 0.
    lift: f64,
}

impl Contradiction {
    /// Returns the second number less the first, relative to the first; for forces, relative to F + 3.
    pub fn size(&self) -> f64 {
        let [first, second] = self.quoted.each_ref().map(|own| own.value);
        (second - first) / (first + self.lift)
    }
}

/// A number that one source gives for a quantity.
struct Statement {
    what: String,
    quoted: Quotation,
    /// Half a unit of its last printed digit.
    half_unit: f64,
    /// How it was made, where that is known.
    made: String,
    /// As in a [`Contradiction`].
    lift: f64,
}

/// What the supplement gives for all runs (Secs. I A and I C).
const SUPPLEMENT: [(&str, f64); 5] = [
    (RESTITUTION, 0.7),
    (RATIO, PAPER_STIFFNESS_RATIO),
    (CYLINDER_FRICTION, 0.7),
    (SPEED, PAPER_SETTINGS[0]),
    (STEP, PAPER_SETTINGS[1]),
];
const RESTITUTION: &str = "restitution";
const RATIO: &str = "ratio κ of normal to tangential stiffness";
const CYLINDER_FRICTION: &str = "friction of the cylinders";
const SPEED: &str = "wall speed of the yield forces, in the unit of the paper";
const STEP: &str = "time step of the yield forces, in the unit of the paper";

/// Returns the numbers for one quantity that differ by more than their printed digits allow: each number that differs
/// from the first of its quantity, paired with that one.
pub(super) fn contradictions(checkout: &Checkout, forces: &[PublishedForce]) -> Vec<Contradiction> {
    let mut statements = of_supplement();
    statements.extend(of_program(checkout));
    statements.extend(checkout.files.iter().flat_map(of_head));
    statements.extend(of_settings(forces));
    statements.extend(forces.iter().map(of_force));
    let mut found: Vec<Contradiction> = Vec::new();
    for (index, second) in statements.iter().enumerate() {
        let mut earlier = statements[..index].iter();
        let Some(first) = earlier.find(|first| first.what == second.what) else {
            continue;
        };
        let apart = (second.quoted.value - first.quoted.value).abs();
        let rounding = f64::EPSILON * first.quoted.value.abs();
        if apart <= (first.half_unit + second.half_unit).max(4.0 * rounding) {
            continue;
        }
        found.push(Contradiction {
            what: second.what.clone(),
            quoted: [first.quoted.clone(), second.quoted.clone()],
            because: because(first, second),
            lift: second.lift,
        });
    }
    found
}

fn because(first: &Statement, second: &Statement) -> String {
    match (first.made.as_str(), second.made.as_str()) {
        ("", "") => String::new(),
        ("", made) | (made, "") => made.to_owned(),
        (first, second) if first == second => format!("both {first}"),
        (first, second) => format!("{first}; {second}"),
    }
}

fn statement(what: impl Into<String>, source: impl Into<String>, value: f64) -> Statement {
    Statement {
        what: what.into(),
        quoted: Quotation {
            source: source.into(),
            value,
            printed: short(value),
        },
        half_unit: 0.0,
        made: String::new(),
        lift: 0.0,
    }
}

fn of_supplement() -> Vec<Statement> {
    let all = SUPPLEMENT.into_iter();
    all.map(|(what, value)| statement(what, "supplement, Sec. I", value))
        .collect()
}

/// Returns the constants of the program, where the checkout has it.
fn of_program(checkout: &Checkout) -> Vec<Statement> {
    let mut statements = Vec::new();
    for (path, text) in &checkout.programs {
        let defined = |name: &str| {
            let mut lines = text.lines().enumerate();
            lines.find_map(|(index, line)| {
                let mut words = line.strip_prefix("#define ")?.split_whitespace();
                let value = (words.next()? == name).then(|| words.next())??;
                Some((
                    value.parse::<f64>().ok()?,
                    format!("{path}, line {}", index + 1),
                ))
            })
        };
        for (what, name) in [(RESTITUTION, "e"), (CYLINDER_FRICTION, "mu")] {
            if let Some((value, source)) = defined(name) {
                statements.push(statement(what, source, value));
            }
        }
        if let (Some((normal, _)), Some((tangential, source))) = (defined("kn"), defined("kt")) {
            statements.push(statement(RATIO, source, normal / tangential));
        }
    }
    statements
}

/// Returns the parameter in the name of a file and the one in its head.
fn of_head(file: &DataFile) -> Vec<Statement> {
    let what = match file.subject {
        Subject::Stiffnesses { .. } => format!("floor friction in {}", file.path),
        Subject::Frictions { .. } => format!("stiffness in {}, in m g/r", file.path),
        _ => return Vec::new(),
    };
    let (Subject::Stiffnesses { friction: named } | Subject::Frictions { stiffness: named }) =
        file.subject
    else {
        return Vec::new();
    };
    let mut parameters = file
        .head
        .iter()
        .filter(|line| line.starts_with("Parameter"));
    let said = parameters.find_map(|line| {
        let value = line.rsplit_once('=')?.1.trim();
        match value {
            "2 - sqrt(3)" => Some(CRITICAL_FRICTION),
            _ => value.parse().ok(),
        }
    });
    let named = statement(&*what, format!("name of {}", file.path), named);
    let said = said.map(|said| statement(&*what, format!("head of {}", file.path), said));
    std::iter::once(named).chain(said).collect()
}

/// Returns the wall speed and the time step that give the forces of each file, in the paper's units. If a file has
/// several, the one farthest from the supplement's value stands for it.
fn of_settings(forces: &[PublishedForce]) -> Vec<Statement> {
    let mut statements: Vec<Statement> = Vec::new();
    for own in forces {
        let (Some(origin), PAPER_SETTINGS) = (&own.origin, own.labelled) else {
            continue;
        };
        let [speed, step] = PAPER_SETTINGS;
        let made = [
            (
                SPEED,
                speed,
                origin.run.wall_speed,
                format!("{} √(g r)", short(origin.wall_speed)),
            ),
            (
                STEP,
                step,
                origin.run.time_step,
                format!("{} √(r/g)", short(origin.time_step)),
            ),
        ];
        for (what, said, value, made) in made {
            let source = format!("run that gives {}", own.file);
            let farthest = Statement {
                made,
                ..statement(what, &*source, value)
            };
            let mut known = statements.iter_mut();
            let known = known.find(|known| known.what == what && known.quoted.source == source);
            let distance = |value: f64| libm::log(value / said).abs();
            match known {
                None => statements.push(farthest),
                Some(known) if distance(value) > distance(known.quoted.value) => *known = farthest,
                Some(_) => {}
            }
        }
    }
    statements
}

/// Writes a number with at most three digits.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    match (1e-2..1e3).contains(&rounded.abs()) {
        true => rounded.to_string(),
        false => format!("{rounded:e}"),
    }
}

fn of_force(published: &PublishedForce) -> Statement {
    let stack = &published.stack;
    let [speed, step] = published.labelled;
    // Rounded to the digits that the files give.
    let friction = libm::round(1e6 * stack.floor_friction) / 1e6;
    let settings = match published.labelled {
        PAPER_SETTINGS => String::new(),
        _ => format!(", wall speed {speed:e}, time step {step:e}"),
    };
    let value = published.value;
    let of_force = statement(
        format!(
            "F in m g at μ = {friction}, stiffness {}{settings}",
            stack.stiffness
        ),
        format!("{}, line {}", published.file, published.line),
        value.value,
    );
    Statement {
        quoted: Quotation {
            printed: format!("{:.*}", value.decimals, value.value),
            ..of_force.quoted
        },
        what: of_force.what,
        lift: 3.0,
        half_unit: value.half_unit(),
        made: match &published.origin {
            Some(origin) => {
                let stopped = origin.end_time.map_or_else(String::new, |time| {
                    format!(", stopped at t = {time} √(r/g) while the force rose")
                });
                format!(
                    "start A = {}, wall speed {} √(g r), time step {} √(r/g){stopped}",
                    origin.start,
                    short(origin.wall_speed),
                    short(origin.time_step)
                )
            }
            None => "not reproduced".to_owned(),
        },
    }
}
