//! The check of a code with rigid bodies. Its forces are known while the stack slides, and so is its motion where nothing holds
//! it, which needs no springs and no micro-tests.

use super::Check;
use super::factor::of_friction;
use super::information::same_bits;
use super::report::{Grade, Item};
use crate::code::{InstalledCode, Run};
use crate::model::{Case, Stack};
use crate::series::{RigidReading, Summary};
use crate::study::MAX_TOLERANCE;
use crate::study::yield_force::{FELL, JAMMED, ROLLS, STOOD, rigid_case};

/// Floor friction of the stack that slides under the wall.
const FRICTION: f64 = 0.2;
/// Floor friction with which rigid bodies jam.
const JAMS: f64 = 0.3;
/// Floor friction with which the stack falls under its own weight.
const FALLS: f64 = 0.05;
/// Part of its way by which a falling stack may be off: the time step is a thousandth of the time, and schemes of first order are
/// off by about that.
const SAME_FALL: f64 = 0.01;
/// Steps of the integration of a fall.
const STEPS_OF_FALL: u32 = 1000;

const SLIDES: &str = "force while it slides";
const BALANCE: &str = "balance of forces";
const SYMMETRY: &str = "mirror symmetry";
const FLOOR: &str = "friction of the floor";
const ROLLING: &str = "rolling";
const FALL: &str = "fall under its own weight";
const JAM: &str = "jam";
const PAIRS: &str = "friction between cylinders";

impl Check<'_> {
    /// Adds the items of a code whose bodies are rigid; returns `None` if a failure makes the rest pointless.
    pub(super) fn rigid(&mut self, installed: &dyn InstalledCode) -> Option<()> {
        let of = |floor_friction, cylinder_friction| {
            rigid_case(&Stack {
                cylinder_friction,
                ..Stack::paper(floor_friction, 1.0)
            })
        };
        let usual = Stack::paper(FRICTION, 1.0).cylinder_friction;
        let case = of(FRICTION, usual);
        let run = self.stack(installed, &case)?;
        let items = match Summary::read(&run.series, &case).rigid {
            Some(reading) => while_it_slides(&reading, &case),
            None => vec![Item::not_tested(
                Grade::Consistency,
                SLIDES,
                "there are too few rows",
            )],
        };
        self.report.items.extend(items);
        // Below the friction that rolling takes, cylinders slip on each other, and nothing holds the stack.
        let below = 0.5 * case.stack.ring().critical_friction;
        for (name, case, judged) in [
            (FALL, of(FALLS, usual), fall as fn(&Run, &Case) -> Item),
            (JAM, of(JAMS, usual), jam),
            (PAIRS, of(FRICTION, below), slips_on_each_other),
        ] {
            match self.try_run(installed, &case, name) {
                Ok(run) => self.add(judged(&run, &case)),
                Err(failure) => self.fail(name, failure.as_deref(), Some(&case)),
            }
        }
        let again = self.run(installed, &case, "again");
        self.add(same_bits(
            &run.series,
            again.as_ref().map(|run| &run.series),
        ));
        Some(())
    }
}

fn passed(name: &'static str, found: String) -> Item {
    Item::passed(Grade::Consistency, name, found)
}

fn failed(name: &'static str, expected: String, found: String, causes: &[&str]) -> Item {
    let causes = causes.iter().map(|cause| (*cause).to_owned()).collect();
    Item::failed(Grade::Consistency, name, expected, found, causes)
}

/// Compares what the rows of `case` show in the mean.
fn while_it_slides(reading: &RigidReading, case: &Case) -> Vec<Item> {
    let stack = &case.stack;
    let reference = crate::theory::rigid_limit(stack)
        .yield_force
        .unwrap_or_default();
    let load = stack.floor_load(reference);
    let allowed = MAX_TOLERANCE * load;
    if let Some(slid) = reading.slid.filter(|slid| *slid > FELL) {
        return vec![failed(
            SLIDES,
            format!("{reference:.6} m g where the wall begins; without the wall the stack stands"),
            format!(
                "it falls under its own weight: cylinders 2 and 3 go {slid:.1} times as far as the wall makes them go"
            ),
            &[
                "`cylinder_friction` is not that between cylinders",
                "`floor_friction` is not that of the floor, or friction does not turn the cylinders",
            ],
        )];
    }
    let mut items = Vec::new();
    items.push(match reading.unbalanced {
        off if off.abs() <= allowed => passed(BALANCE, "3 m g and the force of the wall".to_owned()),
        off => failed(
            BALANCE,
            "floor_n2 + floor_n3 = wall_force + 3 m g, in the mean over the rows".to_owned(),
            format!("{off:.6} m g more"),
            &[
                "gravity does not act on all cylinders, or is not `gravity` downwards",
                "a force is that of another step, or an impulse that is not divided by the time step",
            ],
        ),
    });
    items.push(match reading.asymmetry {
        off if off.abs() <= allowed => passed(SYMMETRY, "both sides alike".to_owned()),
        off => failed(
            SYMMETRY,
            "floor_n2 = floor_n3, in the mean over the rows".to_owned(),
            format!("they differ by {off:.6} m g"),
            &["one of the cylinders at the floor has another contact, mass or place"],
        ),
    });
    let asked = stack.floor_friction;
    items.push(
        match (reading.friction / asked - 1.0).abs() <= MAX_TOLERANCE {
            true => passed(FLOOR, format!("it slides at |t|/n = {asked}")),
            false => Item::failed(
                Grade::Consistency,
                FLOOR,
                format!("|t|/n = {asked} while it slides"),
                format!("{:.9}", reading.friction),
                of_friction(reading.friction, asked, stack.cylinder_friction),
            ),
        },
    );
    items.push(match reading.turned {
        None => Item::not_tested(Grade::Consistency, ROLLING, "rotations are not reported"),
        Some(turned) if (turned - 1.0).abs() <= ROLLS => {
            passed(ROLLING, "cylinders 2 and 3 roll on cylinder 1".to_owned())
        }
        Some(turned) => failed(
            ROLLING,
            "cylinders 2 and 3 roll on cylinder 1, counter-clockwise on the right".to_owned(),
            format!("they turn by {turned:.4} times as much"),
            &[
                "`theta` is an angle in radians, counter-clockwise",
                "surfaces move with another radius than that of the cylinder, or slip on each other",
            ],
        ),
    });
    items.push(match reading.excess {
        None => Item::not_tested(Grade::Consistency, SLIDES, "no exact force is known"),
        Some(off) if off.abs() <= allowed + reading.scatter => passed(
            SLIDES,
            format!(
                "{:.6} m g where the wall begins, exact {reference:.6}",
                reference + off
            ),
        ),
        Some(off) => {
            // From F = (3 mu - T)/(T - mu).
            let tangent = stack.ring().critical_friction;
            let force = reference + off;
            let friction = tangent * (force + 1.0) / (force + 3.0);
            failed(
                SLIDES,
                format!("{reference:.6} m g where the wall begins"),
                format!("{force:.6} m g, as with the floor friction {friction:.6}"),
                &["the radius with which friction turns a cylinder, the places of the contacts, or a friction"],
            )
        }
    });
    items
}

/// Compares the way of a stack that nothing holds with that of the equation of motion.
fn fall(run: &Run, case: &Case) -> Item {
    let rows = run.series.samples();
    let apart = |place: Option<&crate::series::Sample>| {
        place.map_or(f64::NAN, |row| 0.5 * row.neighbour_distance(&case.stack))
    };
    let time = rows.last().map_or(0.0, |last| last.time);
    let expected = way_of_fall(case, time);
    let found = apart(rows.last()) - apart(rows.first());
    if (found / expected - 1.0).abs() <= SAME_FALL {
        return passed(FALL, format!("cylinders 2 and 3 go {found:.4} r outwards"));
    }
    failed(
        FALL,
        format!(
            "cylinders 2 and 3 go {expected:.4} r outwards with the floor friction {}, from step 0 to the last",
            case.stack.floor_friction
        ),
        format!("{found:.4} r"),
        &[
            "a mass or a moment of inertia other than in `bodies`",
            "gravity is not `gravity` from the first step on",
            "the wall holds cylinder 1, or a contact pulls",
        ],
    )
}

/// How far cylinders 2 and 3 go outwards in this time, while they roll on cylinder 1 and slide on the floor.
///
/// With the angle ψ between the vertical and the line of centres, s = sin ψ and c = cos ψ, virtual work gives
/// (4s² + 8c² + 8I − 4μs(1 + c)) ψ̈ = 2s − 6μ(1 + c) + (4sc + 4μc(1 + c)) ψ̇², in units of r, m and g: the inertia of
/// cylinder 1 going down, of two going outwards and turning by 2ψ, and friction under a load that is less by m ÿ₁.
fn way_of_fall(case: &Case, time: f64) -> f64 {
    let (mu, inertia) = (case.stack.floor_friction, case.convention.moment_of_inertia);
    let rate = |[angle, speed]: [f64; 2]| {
        let (s, c) = (libm::sin(angle), libm::cos(angle));
        let mass = 4.0 * s * s + 8.0 * c * c + 8.0 * inertia - 4.0 * mu * s * (1.0 + c);
        let driving = 2.0 * s - 6.0 * mu * (1.0 + c);
        let of_speed = 4.0 * s * c + 4.0 * mu * c * (1.0 + c);
        [speed, (driving + of_speed * speed * speed) / mass]
    };
    let start = case.stack.ring().angle;
    let step = time / f64::from(STEPS_OF_FALL);
    let mut state = [start, 0.0];
    for _ in 0..STEPS_OF_FALL {
        let after = |rate: [f64; 2], part: f64| {
            [0, 1].map(|index| state[index] + part * step * rate[index])
        };
        let one = rate(state);
        let two = rate(after(one, 0.5));
        let three = rate(after(two, 0.5));
        let four = rate(after(three, 1.0));
        state = [0, 1].map(|index| {
            let sum = one[index] + 2.0 * (two[index] + three[index]) + four[index];
            state[index] + step / 6.0 * sum
        });
    }
    2.0 * (libm::sin(state[0]) - libm::sin(start))
}

/// Says whether the bodies stand, however strong the wall.
fn jam(run: &Run, case: &Case) -> Item {
    let read = Summary::read(&run.series, case);
    let slid = read.rigid.and_then(|reading| reading.slid);
    match slid {
        Some(slid) if slid.abs() < STOOD && read.last_force >= JAMMED => passed(
            JAM,
            format!(
                "with mu = {JAMS} the stack stands under {:.3e} m g",
                read.last_force
            ),
        ),
        Some(slid) => failed(
            JAM,
            format!(
                "with mu = {JAMS} the stack stands, and the wall force grows to {JAMMED} m g and more"
            ),
            format!(
                "cylinders 2 and 3 go {:.1} % of the way of the wall, whose force ends at {:.6} m g",
                100.0 * slid,
                read.last_force
            ),
            &["contacts give way elastically, or a force has an upper limit"],
        ),
        None => Item::not_tested(Grade::Consistency, JAM, "places are not reported"),
    }
}

/// Says whether the stack gives way where the friction between its cylinders is too low for them to roll.
fn slips_on_each_other(run: &Run, case: &Case) -> Item {
    let slid = Summary::read(&run.series, case)
        .rigid
        .and_then(|reading| reading.slid);
    let friction = case.stack.cylinder_friction;
    match slid {
        Some(slid) if slid > FELL => passed(
            PAIRS,
            format!("with {friction:.4} they slip, and the stack falls"),
        ),
        Some(_) => failed(
            PAIRS,
            format!(
                "with a friction of {friction:.4} between cylinders these slip, and the stack falls"
            ),
            "it stands until the wall presses".to_owned(),
            &["`cylinder_friction` is not that between cylinders"],
        ),
        None => Item::not_tested(Grade::Consistency, PAIRS, "places are not reported"),
    }
}
