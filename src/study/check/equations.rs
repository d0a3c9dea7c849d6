//! The equations of motion, held to a code's own numbers row by row: which of them fails, and what is added or left out.
//!
//! The law is evaluated at the positions and velocities that the code has written, so that a mistake in one equation
//! does not spread to the next, and what is left over in it is the mistake itself.

use super::factor::of_factor;
use super::table::MOST_CAUSES;
use super::twin::{FLOOR, Twin, WALL, cells};
use crate::model::{ContactConvention, ContactTest, InitialMotion};
use crate::runs::Answer;
use crate::series::{BodyRow, MotionRow};
use crate::study::convention::fit_rows;

/// Largest part of its largest value by which a quantity may miss its equation: rounding, which one row does not amplify.
const HOLDS: f64 = 1e-9;
/// Part of what was left over that may remain where terms explain it.
const EXPLAINED: f64 = 1e-6;
/// A factor that is nearer to 1 than this comes from rounding.
const ROUNDED: f64 = 1e-3;
/// So many digits are no longer few.
const FEW_DIGITS: usize = 15;
/// The kinds of contact.
const PLACES: [&str; 3] = ["between cylinders", "at the floor", "at the top wall"];
const NOWHERE: &str = "of a cylinder that touches nothing";
const SLIDING: &str = ", while the contact slides";
const AFTERWARDS: &str = ", when the contact sticks again after it has slid";

/// A number in an equation.
#[derive(Debug, Clone, Copy)]
struct Term {
    name: &'static str,
    /// Whether the law has it.
    is_part: bool,
    /// What it is called where it does not belong.
    called: &'static str,
    value: fn(&Moment, usize) -> f64,
}

const fn part(name: &'static str, value: fn(&Moment, usize) -> f64) -> Term {
    Term {
        name,
        is_part: true,
        called: "",
        value,
    }
}

const fn extra(name: &'static str, called: &'static str, value: fn(&Moment, usize) -> f64) -> Term {
    Term {
        name,
        is_part: false,
        called,
        value,
    }
}

/// One body at one step, with what the law gives there. Axes are 0 and 1, and 2 for what turns.
#[derive(Clone, Copy)]
struct Moment {
    now: BodyRow,
    before: Option<BodyRow>,
    asked: InitialMotion,
    time: f64,
    time_step: f64,
    inertia: [f64; 3],
    /// 1 for the first body of a contact, −1 for the second.
    sign: f64,
    /// Radius of the torque.
    arm: f64,
    touch: Touch,
}

/// The contact of a micro-test at one step, by the law.
#[derive(Clone, Copy, Default)]
struct Touch {
    /// That of the first body.
    normal: [f64; 2],
    pressing: f64,
    tangential: f64,
    /// The springs' parts of both.
    elastic: f64,
    sheared: f64,
    overlap: f64,
    separation: f64,
    sliding: f64,
    /// Angles by which both surfaces have turned, and the way of the centres along the tangent, since the beginning.
    ways: [f64; 3],
    /// Normal and tangential force of the step before, less those of this one.
    late: [f64; 2],
}

impl Moment {
    fn along(&self, axis: usize) -> f64 {
        self.sign * self.touch.normal[axis]
    }

    fn across(&self, axis: usize) -> f64 {
        let [x, y] = self.touch.normal;
        self.sign * [-y, x][axis]
    }

    /// Displacement towards `side` of one axis, 0 along the other.
    fn moved(&self, axis: usize, along: usize, side: f64) -> f64 {
        let start = [self.asked.x, self.asked.y][along];
        on(axis, along) * (side * (self.now.position[along] - start)).max(0.0)
    }
}

impl Touch {
    fn damping(&self) -> f64 {
        self.pressing - self.elastic
    }

    fn tangential_damping(&self) -> f64 {
        self.tangential - self.sheared
    }
}

fn rate(body: &BodyRow, axis: usize) -> f64 {
    [body.velocity[0], body.velocity[1], body.spin][axis]
}

fn load(body: &BodyRow, axis: usize) -> f64 {
    [body.force[0], body.force[1], body.torque][axis]
}

const fn on(axis: usize, along: usize) -> f64 {
    if axis == along { 1.0 } else { 0.0 }
}

/// What a force on a body consists of, or should not.
const FORCE: [Term; 29] = [
    part("the normal force", |m, axis| {
        m.touch.pressing * m.along(axis)
    }),
    part("the spring's part of the normal force", |m, axis| {
        m.touch.elastic * m.along(axis)
    }),
    part("the damping of the normal force", |m, axis| {
        m.touch.damping() * m.along(axis)
    }),
    part("the tangential force", |m, axis| {
        m.touch.tangential * m.across(axis)
    }),
    part("the spring's part of the tangential force", |m, axis| {
        m.touch.sheared * m.across(axis)
    }),
    part("the damping of the tangential force", |m, axis| {
        m.touch.tangential_damping() * m.across(axis)
    }),
    part("the horizontal component of the normal force", |m, axis| {
        m.touch.pressing * m.along(0) * on(axis, 0)
    }),
    part("the vertical component of the normal force", |m, axis| {
        m.touch.pressing * m.along(1) * on(axis, 1)
    }),
    part(
        "the horizontal component of the tangential force (its direction is not the tangent)",
        |m, axis| m.touch.tangential * m.across(0) * on(axis, 0),
    ),
    part(
        "the vertical component of the tangential force (its direction is not the tangent)",
        |m, axis| m.touch.tangential * m.across(1) * on(axis, 1),
    ),
    extra(
        "the difference to the normal force of the step before",
        "the force of the step before, where this is 1",
        |m, axis| m.touch.late[0] * m.along(axis),
    ),
    extra(
        "the difference to the tangential force of the step before",
        "the force of the step before, where this is 1",
        |m, axis| m.touch.late[1] * m.across(axis),
    ),
    extra(
        "a constant force along the normal",
        "adhesion or a preload",
        |m, axis| m.along(axis),
    ),
    extra(
        "the square of the overlap",
        "no linear spring",
        |m, axis| m.touch.overlap * m.touch.overlap * m.along(axis),
    ),
    extra(
        "the overlap times the normal velocity",
        "damping that grows with the overlap",
        |m, axis| m.touch.overlap * m.touch.separation * m.along(axis),
    ),
    extra(
        "the angle by which the first surface has turned",
        "its spin counts otherwise in the tangential spring",
        |m, axis| m.touch.ways[0] * m.across(axis),
    ),
    extra(
        "the angle by which the second surface has turned",
        "its spin counts otherwise in the tangential spring",
        |m, axis| m.touch.ways[1] * m.across(axis),
    ),
    extra(
        "the way of the centres along the tangent",
        "it counts otherwise in the tangential spring",
        |m, axis| m.touch.ways[2] * m.across(axis),
    ),
    extra(
        "the spin",
        "it counts otherwise in the tangential damping",
        |m, axis| m.now.spin * m.across(axis),
    ),
    extra("the tangential velocity", "a further damping", |m, axis| {
        m.touch.sliding * m.across(axis)
    }),
    extra(
        "the normal force against the tangential velocity",
        "a friction by velocity",
        |m, axis| m.touch.pressing * sign_of(m.touch.sliding) * m.across(axis),
    ),
    extra(
        "the velocity of the cylinder",
        "a drag, a damping besides that of the contacts",
        |m, axis| rate(&m.now, axis),
    ),
    extra(
        "its displacement to the right since the beginning",
        "something holds it there: a side wall, a boundary",
        |m, axis| m.moved(axis, 0, 1.0),
    ),
    extra(
        "its displacement to the left since the beginning",
        "something holds it there: a side wall, a boundary",
        |m, axis| m.moved(axis, 0, -1.0),
    ),
    extra(
        "its displacement upwards since the beginning",
        "something holds it there",
        |m, axis| m.moved(axis, 1, 1.0),
    ),
    extra(
        "its displacement downwards since the beginning",
        "something holds it there",
        |m, axis| m.moved(axis, 1, -1.0),
    ),
    extra(
        "a constant horizontal force",
        "a field: wind, tilted gravity",
        |_, axis| on(axis, 0),
    ),
    extra(
        "a constant vertical force",
        "a weight, in a motion without gravity",
        |_, axis| on(axis, 1),
    ),
    extra("the time", "a force that grows by itself", |m, axis| {
        m.time * m.along(axis)
    }),
];

/// The same of a torque, about the centre.
const TORQUE: [Term; 11] = [
    part("the tangential force", |m, _| -m.arm * m.touch.tangential),
    part("the spring's part of the tangential force", |m, _| {
        -m.arm * m.touch.sheared
    }),
    part("the damping of the tangential force", |m, _| {
        -m.arm * m.touch.tangential_damping()
    }),
    extra(
        "the normal force against the spin",
        "rolling friction",
        |m, _| -m.touch.pressing * sign_of(m.now.spin),
    ),
    extra(
        "the normal force times the spin",
        "rolling resistance",
        |m, _| m.touch.pressing * m.now.spin,
    ),
    extra(
        "the spin",
        "a rolling resistance, a damping of the spin",
        |m, _| m.now.spin,
    ),
    extra(
        "the angle by which it has turned",
        "a spring against rolling",
        |m, _| m.touch.ways[if m.sign > 0.0 { 0 } else { 1 }],
    ),
    extra(
        "the difference to the tangential force of the step before",
        "the force of the step before",
        |m, _| -m.arm * m.touch.late[1],
    ),
    extra(
        "the normal force",
        "the force does not act on the line of the centres",
        |m, _| m.touch.pressing,
    ),
    extra(
        "the tangential force times the overlap",
        "it acts at another radius than declared: a convention of arms",
        |m, _| m.touch.tangential * m.touch.overlap,
    ),
    extra("a constant", "a torque that is always there", |_, _| 1.0),
];

/// The same of the change of a velocity in a step.
const KICK: [Term; 6] = [
    part("the force (torque) in it", |m, axis| {
        load(&m.now, axis) / m.inertia[axis] * m.time_step
    }),
    extra(
        "the difference to the force (torque) of the step before, over mass times time step",
        "the force of the step before, where this is 1",
        |m, axis| {
            m.before.map_or(0.0, |before| {
                (load(&before, axis) - load(&m.now, axis)) / m.inertia[axis] * m.time_step
            })
        },
    ),
    extra(
        "the velocity before",
        "damping, in every step",
        |m, axis| rate(&m.now, axis),
    ),
    extra(
        "the velocity before times time step",
        "damping, in a unit of time",
        |m, axis| rate(&m.now, axis) * m.time_step,
    ),
    extra(
        "the size of the force against the velocity",
        "Cundall's local damping",
        |m, axis| {
            -load(&m.now, axis).abs() * sign_of(rate(&m.now, axis)) / m.inertia[axis] * m.time_step
        },
    ),
    extra(
        "the time step",
        "an acceleration that is always there",
        |m, _| m.time_step,
    ),
];

/// The same of the change of a position in a step.
const MOVE: [Term; 3] = [
    part("the new velocity in it", |m, axis| {
        rate(&m.now, axis) * m.time_step
    }),
    extra(
        "the difference to the old velocity, times time step",
        "positions move on with the old velocity, where this is 1",
        |m, axis| {
            m.before.map_or(0.0, |before| {
                (before.velocity[axis] - m.now.velocity[axis]) * m.time_step
            })
        },
    ),
    extra(
        "the square of the time step",
        "an acceleration that is always there",
        |m, _| m.time_step * m.time_step,
    ),
];

/// The same of the force that is written for the top wall.
const WALL_FORCE: [Term; 4] = [
    part("the whole", |m, _| m.touch.pressing),
    part("the damping", |m, _| m.touch.damping()),
    extra(
        "the difference to that of the step before",
        "the force of the step before, where this is 1",
        |m, _| m.touch.late[0],
    ),
    extra("a constant", "", |_, _| 1.0),
];

/// The same of what a body has at step 0.
const START: [Term; 2] = [
    part("the number of the task", |m, axis| {
        [m.asked.x, m.asked.y, m.asked.vx, m.asked.vy, m.asked.spin][axis]
    }),
    extra("a constant", "another origin", |_, _| 1.0),
];

fn sign_of(number: f64) -> f64 {
    if number == 0.0 { 0.0 } else { number.signum() }
}

/// One number of a row in its equation.
struct Line {
    step: u64,
    found: f64,
    expected: f64,
    terms: Vec<f64>,
}

/// An equation with all its numbers.
struct Equation {
    /// What it gives, where, and of which body or when.
    quantity: &'static str,
    place: &'static str,
    of: &'static str,
    when: &'static str,
    terms: &'static [Term],
    lines: Vec<Line>,
}

/// What an equation turned out to be.
struct Relation {
    text: String,
    is_explained: bool,
}

impl Equation {
    fn left(&self, fitted: impl Fn(&Line) -> f64) -> f64 {
        self.lines.iter().fold(0.0, |worst, line| {
            f64::max(worst, (line.found - line.expected - fitted(line)).abs())
        })
    }

    /// What is added or left out; `None` if the equation holds.
    fn relation(&self) -> Option<Relation> {
        let scale = self.lines.iter().fold(0.0, |largest, line| {
            f64::max(largest, line.expected.abs().max(line.found.abs()))
        });
        let left = self.left(|_| 0.0);
        if left <= HOLDS * scale {
            return None;
        }
        let allowed = (HOLDS * scale).max(EXPLAINED * left);
        let count = self.terms.len();
        let single = (0..count).map(|one| vec![one]);
        let double = (0..count).flat_map(|one| (one + 1..count).map(move |two| vec![one, two]));
        let digits = self.digits();
        let explained = single
            .chain(double)
            .filter(|_| digits.is_none())
            .find_map(|terms| Some((self.fit(&terms, allowed)?, terms)));
        let text = match &explained {
            Some((coefficients, terms)) => {
                let told = terms.iter().zip(coefficients);
                let told: Vec<String> = told
                    .map(|(term, own)| self.terms[*term].told(*own))
                    .collect();
                told.join(", and ")
            }
            None if digits.is_some() => format!(
                "rounded to {} digits: the numbers of the task are not read as they are",
                digits?
            ),
            None => {
                let off = |line: &&Line| (line.found - line.expected).abs() > HOLDS * scale;
                let line = self.lines.iter().find(off)?;
                format!(
                    "another one than the law gives: {:.9} at step {} of a micro-test, where {:.9} is expected at the \
                     positions and velocities of that step",
                    line.found, line.step, line.expected
                )
            }
        };
        Some(Relation {
            text,
            is_explained: explained.is_some() || digits.is_some(),
        })
    }

    /// The digits to which the numbers of a task are rounded, if they are.
    fn digits(&self) -> Option<usize> {
        let rounds = |digits: &usize| {
            let is = |line: &Line| {
                format!("{:.*e}", digits - 1, line.expected).parse() == Ok(line.found)
            };
            self.lines.iter().all(is)
        };
        (1..FEW_DIGITS).find(rounds)
    }

    /// Coefficients of some terms that leave no more than is allowed.
    fn fit(&self, terms: &[usize], allowed: f64) -> Option<Vec<f64>> {
        let rows = self.lines.iter().map(|line| {
            let own = terms.iter().map(|term| line.terms[*term]).collect();
            (own, line.found - line.expected)
        });
        let found = fit_rows(&rows.collect::<Vec<_>>(), terms.len());
        let own: Vec<f64> = found.iter().map(|own| own.value).collect();
        let fitted = |line: &Line| {
            let each = terms.iter().zip(&own);
            each.map(|(term, factor)| factor * line.terms[*term]).sum()
        };
        (own.iter().all(|own| own.is_finite()) && self.left(fitted) <= allowed).then_some(own)
    }
}

impl Term {
    /// What a coefficient of the term means.
    fn told(&self, coefficient: f64) -> String {
        let name = self.name;
        if !self.is_part {
            let called = match self.called {
                "" => String::new(),
                called => format!(" ({called})"),
            };
            return format!("{coefficient:+.6} times {name} is added{called}");
        }
        let factor = 1.0 + coefficient;
        if factor.abs() < EXPLAINED {
            return format!("{name} is left out");
        }
        let meanings = match coefficient.abs() < ROUNDED {
            true => vec!["rounded to few digits".to_owned()],
            false => of_factor(factor, f64::NAN),
        };
        let meaning = meanings
            .first()
            .map_or_else(String::new, |meaning| format!(" ({meaning})"));
        format!("{name} is {factor:.6} times what it must be{meaning}")
    }
}

/// The equations that fail in `answers` of a code with this `convention`, and what is added or left out there; nothing if
/// all hold, or too few do to say that its integrator is one whose equations are known. Where velocities lag by half a step
/// it `leaps`, and the integration is looked at too.
pub(super) fn explanations(
    answers: &[Answer],
    convention: ContactConvention,
    leaps: bool,
) -> Vec<String> {
    let mut own = Equations {
        all: Vec::new(),
        leaps,
    };
    answers
        .iter()
        .for_each(|answer| own.read(answer, convention));
    let mut failing: Vec<(&Equation, Relation)> = Vec::new();
    for equation in &own.all {
        let follows = |(other, _): &(&Equation, Relation)| {
            (other.quantity, other.place, other.of)
                == (equation.quantity, equation.place, equation.of)
        };
        if let Some(relation) = equation.relation().filter(|_| !failing.iter().any(follows)) {
            failing.push((equation, relation));
        }
    }
    if 2 * failing.len() > own.all.len() {
        failing.retain(|(_, relation)| relation.is_explained);
    }
    failing.sort_by_key(|(_, relation)| !relation.is_explained);
    let mut told: Vec<(Vec<&Equation>, String)> = Vec::new();
    for (equation, relation) in failing {
        let is_same = |(others, text): &&mut (Vec<&Equation>, String)| {
            *text == relation.text && others[0].when == equation.when
        };
        match told.iter_mut().find(is_same) {
            Some((others, _)) => others.push(equation),
            None => told.push((vec![equation], relation.text)),
        }
    }
    told.truncate(MOST_CAUSES);
    told.into_iter()
        .map(|(equations, text)| format!("{}{}: {text}", subject(&equations), equations[0].when))
        .collect()
}

/// What some equations give, in words.
fn subject(equations: &[&Equation]) -> String {
    let listed = |word: fn(&Equation) -> &'static str| {
        let mut words: Vec<&str> = Vec::new();
        for word in equations.iter().map(|own| word(own)) {
            if !words.contains(&word) && !word.is_empty() {
                words.push(word);
            }
        }
        words
    };
    let bodies = match listed(|own| own.of)[..] {
        [one] => one,
        _ => "",
    };
    let [quantities, places] =
        [listed(|own| own.quantity), listed(|own| own.place)].map(|words| words.join(" and "));
    format!("{quantities}{bodies} {places}")
        .trim_end()
        .to_owned()
}

/// The floor, or the wall.
const STILL: BodyRow = BodyRow {
    position: [0.0; 2],
    velocity: [0.0; 2],
    spin: 0.0,
    force: [0.0; 2],
    torque: 0.0,
};

/// The way of a contact through a micro-test.
#[derive(Default)]
struct Walk {
    touch: Touch,
    when: &'static str,
    last: [Option<Moment>; 2],
}

impl Walk {
    /// Goes on to the next row, where a contact of the first body is closed.
    fn go(&mut self, twin: &Twin, cells: [f64; 6], contact: usize, bodies: &[BodyRow; 2]) {
        let [pressing, tangential, elastic, overlap, spring, trial] = cells;
        let old = self.touch;
        let slides = tangential != trial && contact < WALL.start;
        self.when = match (slides, self.when) {
            (true, _) => SLIDING,
            (false, "") => "",
            (false, _) => AFTERWARDS,
        };
        let [one, two] = bodies;
        let (normal, other) = match contact {
            0 => {
                let apart = [0, 1].map(|axis| one.position[axis] - two.position[axis]);
                let distance = apart[0].hypot(apart[1]);
                (apart.map(|own| own / distance), *two)
            }
            _ if FLOOR.contains(&contact) => ([0.0, 1.0], STILL),
            _ => ([0.0, -1.0], STILL),
        };
        let relative = [0, 1].map(|axis| one.velocity[axis] - other.velocity[axis]);
        let across = normal[0] * relative[1] - normal[1] * relative[0];
        let time_step = twin.run.time_step;
        let grown = [one.spin, other.spin, across].map(|rate| rate * time_step);
        self.touch = Touch {
            normal,
            pressing,
            tangential,
            elastic,
            sheared: -twin.contacts[contact].tangential_stiffness * spring,
            overlap,
            separation: normal[0] * relative[0] + normal[1] * relative[1],
            sliding: across - one.spin - other.spin,
            ways: std::array::from_fn(|index| old.ways[index] + grown[index]),
            late: match old.overlap {
                0.0 => [0.0; 2],
                _ => [old.pressing - pressing, old.tangential - tangential],
            },
        };
    }
}

/// The equations of a code, whose velocities lag by half a step where it `leaps`.
struct Equations {
    all: Vec<Equation>,
    leaps: bool,
}

impl Equations {
    fn add(
        &mut self,
        [quantity, place, of, when]: [&'static str; 4],
        terms: &'static [Term],
        moment: &Moment,
        (step, axis, found, expected): (u64, usize, f64, f64),
    ) {
        let is_own = |own: &Equation| {
            (own.quantity, own.place, own.of, own.when) == (quantity, place, of, when)
        };
        let index = self.all.iter().position(is_own).unwrap_or_else(|| {
            self.all.push(Equation {
                quantity,
                place,
                of,
                when,
                terms,
                lines: Vec::new(),
            });
            self.all.len() - 1
        });
        let terms = terms
            .iter()
            .map(|term| (term.value)(moment, axis))
            .collect();
        self.all[index].lines.push(Line {
            step,
            found,
            expected,
            terms,
        });
    }

    /// All numbers of a micro-test.
    fn read(&mut self, answer: &Answer, convention: ContactConvention) {
        let restitution = answer.test.convention.restitution;
        let test = ContactTest {
            convention: ContactConvention {
                restitution,
                ..convention
            },
            ..answer.test
        };
        let mut twin = Twin::of_motion(&test);
        let mut walk = Walk::default();
        for row in answer.motion.rows() {
            let bodies = row.bodies();
            let states = bodies.map(|own| {
                let ([x, y], [vx, vy]) = (own.position, own.velocity);
                [x, y, vx, vy, own.spin]
            });
            let forces = twin.forces_at(&states, test.wall_height_at(row.step));
            for index in 0..bodies.len() {
                let all = [0, FLOOR.start + index, WALL.start + index];
                let closed: Vec<usize> = (0..all.len())
                    .filter(|kind| cells(&forces, all[*kind])[3] > 0.0)
                    .collect();
                if let (0, [kind]) = (index, &closed[..]) {
                    walk.go(&twin, cells(&forces, all[*kind]), all[*kind], &bodies);
                }
                let moment =
                    Self::moment(&walk, &twin, &test, (row, index), closed.first().copied());
                self.integration(row.step, &moment, walk.last[index].as_ref());
                match closed[..] {
                    [] => self.forces(row, &moment, [NOWHERE, "", ""]),
                    [kind] if index == 0 || kind == 0 => {
                        let of = match (kind, index) {
                            (0, 0) => " on the first cylinder",
                            (0, _) => " on the second cylinder",
                            _ => "",
                        };
                        self.forces(row, &moment, [PLACES[kind], of, walk.when]);
                    }
                    _ => {}
                }
                walk.last[index] = Some(moment);
            }
        }
    }

    /// One body of a row, in the contact of that kind.
    fn moment(
        walk: &Walk,
        twin: &Twin,
        test: &ContactTest,
        (row, index): (&MotionRow, usize),
        kind: Option<usize>,
    ) -> Moment {
        let arms = &test.convention.arms;
        let arm = if kind == Some(0) {
            arms.pair
        } else {
            arms.floor
        };
        Moment {
            now: row.bodies()[index],
            before: walk.last[index].map(|last| last.now),
            asked: test.initial_motions[index],
            time: row.step as f64 * test.time_step,
            time_step: test.time_step,
            inertia: [1.0, 1.0, twin.run.moment_of_inertia],
            sign: if index == 0 { 1.0 } else { -1.0 },
            arm: 1.0 + arm.torque * walk.touch.overlap,
            touch: walk.touch,
        }
    }

    /// Force and torque on a body.
    fn forces(&mut self, row: &MotionRow, moment: &Moment, [place, of, when]: [&'static str; 3]) {
        let touch = if place == NOWHERE {
            Touch::default()
        } else {
            moment.touch
        };
        let moment = Moment { touch, ..*moment };
        for axis in 0..2 {
            let expected =
                touch.pressing * moment.along(axis) + touch.tangential * moment.across(axis);
            let line = (row.step, axis, moment.now.force[axis], expected);
            self.add(["the force", place, of, when], &FORCE, &moment, line);
        }
        let line = (
            row.step,
            2,
            moment.now.torque,
            -moment.arm * touch.tangential,
        );
        self.add(["the torque", place, of, when], &TORQUE, &moment, line);
        if place == PLACES[2] {
            let line = (row.step, 0, row.wall_force, touch.pressing);
            self.add(["wall_force", "", "", ""], &WALL_FORCE, &moment, line);
        }
    }

    /// The change of positions and velocities since the step before.
    fn integration(&mut self, step: u64, moment: &Moment, last: Option<&Moment>) {
        let Some(last) = last else {
            for axis in 0..5 {
                let asked = [
                    moment.asked.x,
                    moment.asked.y,
                    moment.asked.vx,
                    moment.asked.vy,
                    moment.asked.spin,
                ][axis];
                let now = &moment.now;
                let found = [
                    now.position[0],
                    now.position[1],
                    now.velocity[0],
                    now.velocity[1],
                    now.spin,
                ][axis];
                if axis < 2 || self.leaps {
                    let quantity = if axis < 2 {
                        "the position"
                    } else {
                        "the velocity"
                    };
                    self.add(
                        [quantity, "at step 0", "", ""],
                        &START,
                        moment,
                        (step, axis, found, asked),
                    );
                }
            }
            return;
        };
        if !self.leaps {
            return;
        }
        const VELOCITIES: [&str; 3] = [
            "the horizontal velocity",
            "the vertical velocity",
            "the spin",
        ];
        for axis in 0..3 {
            let expected = load(&last.now, axis) / last.inertia[axis] * last.time_step;
            let line = (
                step,
                axis,
                rate(&moment.now, axis) - rate(&last.now, axis),
                expected,
            );
            self.add(
                ["the change in a step of", VELOCITIES[axis], "", ""],
                &KICK,
                last,
                line,
            );
        }
        for axis in 0..2 {
            let found = moment.now.position[axis] - last.now.position[axis];
            let line = (
                step,
                axis,
                found,
                rate(&moment.now, axis) * moment.time_step,
            );
            self.add(
                ["the change in a step of", ["x", "y"][axis], "", ""],
                &MOVE,
                moment,
                line,
            );
        }
    }
}
