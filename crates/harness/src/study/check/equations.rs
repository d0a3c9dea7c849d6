//! The equations of motion, tested with a code's own numbers row by row: which of them fails, where, and by which
//! terms.
//!
//! The law is evaluated at the positions and velocities that the code has written. So a mistake in one equation does
//! not spread to the next, and the residual is the mistake itself. One or two terms that explain the whole residual
//! name the mistake.

use super::evidence::test_under;
use super::factor::of_factor;
use super::table::MOST_CAUSES;
use super::terms::{
    FORCE, KICK, MOVE, Moment, START, TO_THE_LIMIT, TORQUE, Term, Touch, WALL_FORCE, WHERE, rate,
};
use super::twin::{FLOOR, Twin, WALL};
use crate::model::{ContactConvention, ContactTest};
use crate::runs::Answer;
use crate::series::{BodyRow, MotionRow};
use crate::study::convention::fit_rows;
use std::cell::LazyCell;

/// Largest residual of a quantity that fits its equation, in units of its largest value: rounding, which one row does
/// not amplify.
const HOLDS: f64 = 1e-9;
/// The same for numbers of 32 bits: positions of up to four radii are rounded by up to 2.4e-7 r, which is 1e-5 of the overlaps in
/// micro-tests, and a step later or earlier at Coulomb's limit is a few times that.
const HOLDS_IN_SINGLE: f64 = 1e-4;
/// Largest rounding of forces whose distances have 32 bits, with stiffnesses of 1 and distances of up to four radii.
const OF_SINGLE: f64 = 2.4e-7;
/// Correlation of neighbouring residuals from which they are no roundings: of those it is 0 but for one over the root of
/// their number, hundreds in micro-tests, and of what changes smoothly nearly 1.
const CORRELATED: f64 = 0.5;
/// Fraction of a residual that may remain where terms explain it.
const EXPLAINED: f64 = 1e-6;
/// A factor that differs from 1 by less than this comes from rounding.
const ROUNDED: f64 = 1e-3;
/// Number of digits from which they are no longer few.
const FEW_DIGITS: usize = 15;
/// Fraction of the numbers under a condition that must be wrong if the condition is to be named.
const MOST: f64 = 0.8;
/// Fraction of all wrong numbers that terms fitted to the first ones must explain.
const MOST_OF_ALL: f64 = 0.5;
const BEGINNING: usize = 12;
/// Bound on the period, in steps, of something that is not done in every step.
const MOST_STEPS: u64 = 101;
/// Fewer numbers do not tell terms apart.
const FEWEST: usize = 4;
/// Widest gap between surfaces that count as neighbours.
const NEAR: f64 = 0.2;
/// The kinds of contact.
const PLACES: [&str; 3] = ["between cylinders", "at the floor", "at the top wall"];
const APART: [&str; 3] = [
    "between cylinders that do not touch",
    "above the floor, without a contact",
    "below the top wall, without a contact",
];
const ALONE: &str = "of a cylinder that touches nothing";
const SLIDING: &str = ", while the contact slides";
const AFTERWARDS: &str = ", when the contact sticks again after it has slid";
const VELOCITIES: [&str; 3] = [
    "the horizontal velocity",
    "the vertical velocity",
    "the spin",
];

/// One number of a row in its equation. Its terms are summed over three axes, with the weights `along`.
struct Line {
    along: [f64; 3],
    found: f64,
    expected: f64,
    moment: Moment,
}

/// An equation with all its numbers.
struct Equation {
    /// Quantity, place, body, and when.
    name: [&'static str; 4],
    terms: &'static [Term],
    lines: Vec<Line>,
}

/// A mistake in an equation: what is added or left out.
struct Relation {
    /// Where it shows. Equations that fail in the same way are told together.
    condition: String,
    text: String,
    is_explained: bool,
}

impl Line {
    fn left(&self) -> f64 {
        self.found - self.expected
    }

    fn term(&self, term: &Term) -> f64 {
        let axes = (0..3).filter(|axis| self.along[*axis] != 0.0);
        axes.map(|axis| self.along[axis] * (term.value)(&self.moment, axis))
            .sum()
    }
}

fn largest(lines: &[&Line], value: impl Fn(&Line) -> f64) -> f64 {
    lines
        .iter()
        .fold(0.0, |largest, line| f64::max(largest, value(line).abs()))
}

/// Whether what is left over in a line tells nothing of the next ones, as in roundings, and unlike in any law. Lines of two
/// cylinders take turns.
fn is_noise(lines: &[&Line]) -> bool {
    let squares: f64 = lines.iter().map(|line| line.left() * line.left()).sum();
    (1..=2).all(|apart| {
        let later = lines.iter().skip(apart);
        let pairs = lines.iter().zip(later);
        let products: f64 = pairs.map(|(one, two)| one.left() * two.left()).sum();
        products.abs() < CORRELATED * squares
    })
}

impl Equation {
    /// Returns what is added or left out; `None` if the equation `holds` to that share of its largest number.
    fn relation(&self, holds: f64) -> Option<Relation> {
        let all: Vec<&Line> = self.lines.iter().collect();
        let rounding = holds * largest(&all, |line| line.expected.abs().max(line.found.abs()));
        let off: Vec<&Line> = all
            .iter()
            .copied()
            .filter(|line| line.left().abs() > rounding)
            .collect();
        let first = off.first()?;
        let explained = |condition: String, text| {
            Some(Relation {
                condition,
                text,
                is_explained: true,
            })
        };
        if let Some(digits) = self.digits() {
            let text = format!(
                "rounded to {digits} digits: the numbers of the task are not read as they are"
            );
            return explained(String::new(), text);
        }
        if let Some(told) = self
            .told(&all, &all, rounding)
            .or_else(|| self.in_stairs(&all, rounding))
        {
            return explained(String::new(), told);
        }
        let place = self.place(&off, rounding);
        // Terms that fit the first wrong numbers mostly explain the others too.
        let beginning = &off[..off.len().min(BEGINNING)];
        if let Some(told) = self
            .told(&off, &off, rounding)
            .or_else(|| self.told(beginning, &off, rounding))
        {
            return explained(place, told);
        }
        let scatter = largest(&all, Line::left);
        if scatter <= OF_SINGLE && is_noise(&all) {
            let text = format!(
                "it scatters by up to {scatter:.0e} about the law, as if a number from which it is computed had 32 bits (single \
                 precision)"
            );
            return explained(place, text);
        }
        let text = format!(
            "it is another one than the law gives: {:.9} at step {} of a micro-test, where {:.9} is expected at the \
             positions and velocities of that step",
            first.found, first.moment.step, first.expected
        );
        Some(Relation {
            condition: place,
            text,
            is_explained: false,
        })
    }

    /// Detects what is updated only every so many steps, before or after the forces are computed.
    fn in_stairs(&self, lines: &[&Line], rounding: f64) -> Option<String> {
        let allowed = rounding.max(EXPLAINED * largest(lines, Line::left));
        let mut rhythms = (2..MOST_STEPS).flat_map(|every| [(every, 0), (every, 1)]);
        rhythms.find_map(|(every, first)| {
            let late = |line: &Line| ((line.moment.step + every - first) % every + first) as f64 * line.moment.time_step;
            let second = lines.iter().find(|line| line.moment.step == 1)?;
            let speed = second.left() / late(second);
            let fits = lines.iter().filter(|line| (line.left() - speed * late(line)).abs() <= allowed);
            (speed.abs() > rounding && fits.count() as f64 >= MOST * lines.len() as f64).then(|| {
                format!(
                    "it is right every {every} steps and goes wrong in between, by {speed:+.6} in a unit of time: something \
                     moves, or is computed, in every {every}th step only"
                )
            })
        })
    }

    /// Names one or two terms that explain `lines`, and at least the fraction [`MOST_OF_ALL`] of `all`.
    fn told(&self, lines: &[&Line], all: &[&Line], rounding: f64) -> Option<String> {
        let allowed = rounding.max(EXPLAINED * largest(lines, Line::left));
        let all_terms = 0..self.terms.len();
        let (last, known): (Vec<usize>, Vec<usize>) =
            all_terms.partition(|term| self.terms[*term].name == TO_THE_LIMIT);
        let single = known.iter().map(|one| vec![*one]);
        let pairs_with = |(place, one): (usize, &usize)| {
            let (one, others) = (*one, known[place + 1..].iter());
            others.map(move |two| vec![one, *two]).collect::<Vec<_>>()
        };
        let double = known.iter().enumerate().flat_map(pairs_with);
        // Whatever makes a contact slide fits this one, and most have a name of their own.
        let last = last.into_iter().map(|own| vec![own]);
        let explained = |terms: &[usize], own: &[f64]| {
            let is_told = |line: &&&Line| {
                let each = terms.iter().zip(own);
                let told: f64 = each
                    .map(|(term, own)| own * line.term(&self.terms[*term]))
                    .sum();
                (line.left() - told).abs() <= allowed
            };
            all.iter().filter(is_told).count()
        };
        let (coefficients, terms, count) = single.chain(double).chain(last).find_map(|terms| {
            let own = self.fit(&terms, lines, allowed)?;
            let count = explained(&terms, &own);
            (count as f64 >= MOST_OF_ALL * all.len() as f64).then_some((own, terms, count))
        })?;
        let told = terms
            .iter()
            .zip(coefficients)
            .map(|(term, own)| told(&self.terms[*term], own));
        let told = told.collect::<Vec<_>>().join(", and ");
        Some(match count == all.len() {
            true => told,
            false => format!(
                "{told}; that explains {count} of the {} numbers that are wrong",
                all.len()
            ),
        })
    }

    /// Fits the coefficients of `terms`; `None` if `lines` are too few, or if more than `allowed` is left in one of
    /// them.
    fn fit(&self, terms: &[usize], lines: &[&Line], allowed: f64) -> Option<Vec<f64>> {
        if lines.len() < FEWEST.max(3 * terms.len()) {
            return None;
        }
        let values = |line: &Line| {
            terms
                .iter()
                .map(|term| line.term(&self.terms[*term]))
                .collect::<Vec<f64>>()
        };
        let rows: Vec<(Vec<f64>, f64)> = lines
            .iter()
            .map(|line| (values(line), line.left()))
            .collect();
        let found: Vec<f64> = fit_rows(&rows, terms.len())
            .iter()
            .map(|own| own.value)
            .collect();
        let rest = |(values, left): &(Vec<f64>, f64)| {
            let fitted: f64 = values
                .iter()
                .zip(&found)
                .map(|(value, own)| value * own)
                .sum();
            (left - fitted).abs() <= allowed
        };
        (found.iter().all(|own| own.is_finite()) && rows.iter().all(rest)).then_some(found)
    }

    /// Says under which condition, above which overlap or in which steps the lines in `off` lie; empty if most lines
    /// do.
    fn place(&self, off: &[&Line], rounding: f64) -> String {
        let count = |meets: &dyn Fn(&Moment) -> bool| {
            self.lines.iter().filter(|line| meets(&line.moment)).count()
        };
        let fitting = WHERE.iter().find(|(_, meets)| {
            off.iter().all(|line| meets(&line.moment))
                && off.len() as f64 >= MOST * count(meets) as f64
        });
        if off.len() as f64 >= MOST * self.lines.len() as f64 {
            return String::new();
        }
        if let Some((condition, _)) = fitting {
            return format!("{condition}, and only then, ");
        }
        let overlap = |line: &&Line| line.moment.touch.overlap;
        let least = off.iter().map(overlap).fold(f64::INFINITY, f64::min);
        let right = self
            .lines
            .iter()
            .filter(|line| line.left().abs() <= rounding);
        if right.clone().count() > FEWEST
            && right
                .map(|line| line.moment.touch.overlap)
                .all(|own| own < least)
        {
            return format!("where the overlap exceeds {least:.4}, and only there, ");
        }
        let mut steps: Vec<u64> = off.iter().map(|line| line.moment.step).collect();
        steps.dedup();
        let period = steps
            .windows(2)
            .map(|two| two[1].abs_diff(two[0]))
            .min()
            .filter(|own| *own > 1);
        match period {
            Some(period) if steps.iter().all(|step| step % period == steps[0] % period) => {
                format!(
                    "every {period} steps (first in step {}), and only then, ",
                    steps[0]
                )
            }
            _ => format!("in {} of {} numbers, ", off.len(), self.lines.len()),
        }
    }

    /// Returns the number of digits to which the numbers of a task are rounded, if they are.
    fn digits(&self) -> Option<usize> {
        let is = |line: &Line, digits| {
            format!("{:.*e}", digits - 1, line.expected).parse() == Ok(line.found)
        };
        (1..FEW_DIGITS).find(|digits| self.lines.iter().all(|line| is(line, *digits)))
    }
}

impl Relation {
    fn is_told_with(&self, other: &Self) -> bool {
        let is_same = self.condition == other.condition && self.is_explained == other.is_explained;
        is_same && (self.text == other.text || !self.is_explained)
    }
}

/// Says what the coefficient of a term means.
fn told(term: &Term, coefficient: f64) -> String {
    let name = term.name;
    if !term.is_part {
        return format!("{coefficient:+.6} times {name} is added ({})", term.called);
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

/// The failing equations in words. Those whose mistake is known come first.
pub(super) struct Failing {
    pub texts: Vec<String>,
    /// Whether the mistake in the first one is known.
    pub is_explained: bool,
    /// Whether the mistakes in all of them are known.
    pub are_explained: bool,
}

/// Returns the equations that fail in `answers` of a code with this `convention`, and what is added or left out in
/// them. If most of them fail, the integrator may be a different one, and only those whose mistake is known are
/// returned. A code whose velocities lag by half a step `leaps`; then its integration is tested too. What single precision
/// rounds, where the numbers have it, counts as right.
pub(super) fn failing(
    answers: &[&Answer],
    convention: ContactConvention,
    leaps: bool,
    is_single: bool,
) -> Failing {
    let holds = if is_single { HOLDS_IN_SINGLE } else { HOLDS };
    let read = |follows| {
        let mut own = Equations {
            all: Vec::new(),
            leaps,
            follows,
        };
        answers
            .iter()
            .for_each(|answer| own.read(answer, convention));
        own.all
    };
    let (all, following) = (read(false), LazyCell::new(|| read(true)));
    let mut failing: Vec<(&Equation, Relation)> = Vec::new();
    for equation in &all {
        let follows = |(other, _): &(&Equation, Relation)| other.name[..3] == equation.name[..3];
        if let Some(relation) = equation
            .relation(holds)
            .filter(|_| !failing.iter().any(follows))
        {
            // Otherwise the tangential spring is taken from the code's own force in the step before.
            let relation = match relation.is_explained {
                true => relation,
                false => {
                    let mut others = following.iter();
                    let own = others
                        .find(|own| own.name == equation.name)
                        .and_then(|own| own.relation(holds));
                    own.filter(|own| own.is_explained).unwrap_or(relation)
                }
            };
            failing.push((equation, relation));
        }
    }
    if 2 * failing.len() > all.len() {
        failing.retain(|(_, relation)| relation.is_explained);
    }
    failing.sort_by_key(|(_, relation)| !relation.is_explained);
    let is_explained = failing
        .first()
        .is_some_and(|(_, relation)| relation.is_explained);
    let mut told: Vec<(Vec<&Equation>, Relation)> = Vec::new();
    for (equation, relation) in failing {
        let mut others = told.iter_mut();
        match others.find(|(others, own)| {
            own.is_told_with(&relation) && others[0].name[3] == equation.name[3]
        }) {
            Some((others, _)) => others.push(equation),
            None => told.push((vec![equation], relation)),
        }
    }
    told.truncate(MOST_CAUSES);
    let are_explained = told.iter().all(|(_, own)| own.is_explained);
    let texts = told
        .into_iter()
        .map(|(equations, own)| format!("{}: {}{}", subject(&equations), own.condition, own.text));
    Failing {
        texts: texts.collect(),
        is_explained,
        are_explained,
    }
}

/// Names the quantities of some equations, with their bodies and places.
fn subject(equations: &[&Equation]) -> String {
    let listed = |word: usize| {
        let mut words: Vec<&str> = Vec::new();
        for word in equations.iter().map(|own| own.name[word]) {
            if !words.contains(&word) && !word.is_empty() {
                words.push(word);
            }
        }
        words
    };
    let body = match listed(2)[..] {
        [one] => one,
        _ => "",
    };
    let [quantities, places] = [0, 1].map(|word| listed(word).join(" and "));
    format!("{quantities}{body} {places}{}", equations[0].name[3])
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

/// The history of a contact in a micro-test.
#[derive(Default)]
struct Walk {
    touch: Touch,
    /// The contact of the first body.
    contact: usize,
    when: &'static str,
    last: [Option<Moment>; 2],
}

impl Walk {
    /// Advances to the next row, in which the first body has this contact, open or closed.
    fn go(&mut self, twin: &Twin, (contact, overlap): (usize, f64), [one, two]: [BodyRow; 2]) {
        self.contact = contact;
        let state = &twin.states[contact];
        let ([normal_force, tangential], old) = (state.force, self.touch);
        let [sheared, pulled] = state.sheared;
        let slides = tangential != state.trial && contact < WALL.start;
        self.when = match (slides, self.when) {
            (true, _) => SLIDING,
            (false, "") => "",
            (false, _) => AFTERWARDS,
        };
        let other = match contact {
            0 => two,
            contact if WALL.contains(&contact) => BodyRow {
                velocity: [0.0, -twin.run.wall_speed],
                ..STILL
            },
            _ => STILL,
        };
        let normal = normal(contact, one, two);
        let relative = [0, 1].map(|axis| one.velocity[axis] - other.velocity[axis]);
        let across = normal[0] * relative[1] - normal[1] * relative[0];
        let separation = normal[0] * relative[0] + normal[1] * relative[1];
        let memory = state.memory;
        let grown =
            [one.spin, other.spin, across, -separation].map(|rate| rate * twin.run.time_step);
        let pressing = normal_force - pulled;
        let sliding = across - one.spin - other.spin;
        let law = &twin.contacts[contact];
        let began = old.overlap > 0.0;
        self.touch = Touch {
            normal,
            pressing,
            tangential,
            elastic: state.elastic,
            sheared,
            limit: law.friction * pressing.abs(),
            damped: -law.damping_tangential * memory.damping * sliding,
            pulled,
            overlap,
            separation,
            sliding,
            ways: std::array::from_fn(|index| old.ways[index] + grown[index]),
            stretches: std::array::from_fn(|index| {
                memory.kept * old.stretches[index] + memory.unit * grown[index]
            }),
            stiffness: memory.growth / memory.unit,
            damping_growth: memory.damping,
            late: if began {
                [old.pressing - pressing, old.tangential - tangential]
            } else {
                [0.0; 2]
            },
            sheared_before: if began {
                state.sheared_before
            } else {
                [0.0; 2]
            },
            first_overlap: if began { old.first_overlap } else { overlap },
            largest_overlap: old.largest_overlap.max(overlap),
        };
    }
}

/// Returns the normal of a contact, towards the first body.
fn normal(contact: usize, one: BodyRow, two: BodyRow) -> [f64; 2] {
    match contact {
        0 => {
            let apart = [0, 1].map(|axis| one.position[axis] - two.position[axis]);
            apart.map(|own| own / apart[0].hypot(apart[1]))
        }
        _ if FLOOR.contains(&contact) => [0.0, 1.0],
        _ => [0.0, -1.0],
    }
}

/// Returns the overlaps of a body with the other one, the floor and the wall; a gap is negative.
fn overlaps(index: usize, [one, two]: [BodyRow; 2], wall: f64) -> [f64; 3] {
    let apart = [0, 1].map(|axis| one.position[axis] - two.position[axis]);
    let y = [one, two][index].position[1];
    [2.0 - apart[0].hypot(apart[1]), 1.0 - y, y + 1.0 - wall]
}

/// The equations of a code.
struct Equations {
    all: Vec<Equation>,
    leaps: bool,
    /// Whether the tangential spring is taken from the force that the code has written for the step before.
    follows: bool,
}

impl Equations {
    fn add(
        &mut self,
        (name, terms): ([&'static str; 4], &'static [Term]),
        moment: &Moment,
        along: [f64; 3],
        [found, expected]: [f64; 2],
    ) {
        let known = self.all.iter().position(|own| own.name == name);
        let index = known.unwrap_or_else(|| {
            self.all.push(Equation {
                name,
                terms,
                lines: Vec::new(),
            });
            self.all.len() - 1
        });
        let moment = *moment;
        self.all[index].lines.push(Line {
            along,
            found,
            expected,
            moment,
        });
    }

    /// Adds all numbers of a micro-test.
    fn read(&mut self, answer: &Answer, convention: ContactConvention) {
        let test = test_under(answer, convention);
        let mut twin = Twin::of_motion(&test);
        let mut walk = Walk::default();
        for row in answer.motion.rows() {
            let bodies = row.bodies();
            let wall = test.wall_height_at(row.step);
            twin.compute_forces_at(&bodies, wall);
            for index in 0..bodies.len() {
                let overlaps = overlaps(index, bodies, wall);
                let nearest = (0..3)
                    .max_by(|one, two| overlaps[*one].total_cmp(&overlaps[*two]))
                    .unwrap_or(0);
                let contact = [0, FLOOR.start + index, WALL.start + index][nearest];
                if index == 0 {
                    walk.go(&twin, (contact, overlaps[nearest]), bodies);
                }
                let moment = moment(&walk, &twin, &test, (row, index), nearest);
                if test.drive.is_none() {
                    self.integration(&moment, walk.last[index].as_ref());
                }
                let closed = overlaps.iter().filter(|own| **own > 0.0).count();
                // What the second body has in a pair is known where it is the contact of the first one too.
                if index == 0 || nearest != 0 || walk.contact == 0 {
                    self.forces(row, moment, (closed, nearest), walk.when);
                }
                walk.last[index] = Some(moment);
            }
            if self.follows {
                twin.follow(&bodies[0]);
            }
        }
    }

    /// Adds the force and torque on a body, and the force that is written for the wall.
    fn forces(
        &mut self,
        row: &MotionRow,
        moment: Moment,
        (closed, kind): (usize, usize),
        when: &'static str,
    ) {
        let is_first = moment.sign > 0.0;
        let has_contact = closed == 1 && (is_first || kind == 0);
        if closed > 0 && !has_contact {
            return;
        }
        let is_near = is_first && moment.touch.overlap > -NEAR || has_contact;
        let moment = if is_near {
            moment
        } else {
            Moment {
                touch: Touch::default(),
                ..moment
            }
        };
        let (touch, now) = (moment.touch, moment.now);
        let of = match (has_contact, kind, is_first) {
            (true, 0, true) => " on the first cylinder",
            (true, 0, false) => " on the second cylinder",
            _ => "",
        };
        let place = match (has_contact, is_near) {
            (true, _) => PLACES[kind],
            (false, true) => APART[kind],
            (false, false) => ALONE,
        };
        let when = if has_contact { when } else { "" };
        let [x, y] = touch.normal;
        let directions = match is_near {
            true => [
                ("the normal force", [x, y, 0.0]),
                ("the tangential force", [-y, x, 0.0]),
            ],
            false => [
                ("the force", [1.0, 0.0, 0.0]),
                ("the force", [0.0, 1.0, 0.0]),
            ],
        };
        for (quantity, along) in directions {
            let law = |axis: usize| {
                (touch.pressing + touch.pulled) * moment.along(axis)
                    + touch.tangential * moment.across(axis)
            };
            let found = along[0] * now.force[0] + along[1] * now.force[1];
            let expected = along[0] * law(0) + along[1] * law(1);
            let name = [quantity, place, of, when];
            self.add((name, &FORCE), &moment, along, [found, expected]);
        }
        let torques = [now.torque, -moment.arm * touch.tangential];
        self.add(
            (["the torque", place, of, when], &TORQUE),
            &moment,
            axis_only(2),
            torques,
        );
        if place == PLACES[2] {
            let forces = [row.wall_force, touch.pressing];
            self.add(
                (["wall_force", "", "", ""], &WALL_FORCE),
                &moment,
                axis_only(0),
                forces,
            );
        }
    }

    /// Adds the position at step 0. If the code leaps, also adds the velocity at step 0, and the changes of positions
    /// and velocities in a step.
    fn integration(&mut self, moment: &Moment, last: Option<&Moment>) {
        const POSITIONS: [&str; 2] = ["x", "y"];
        let now = &moment.now;
        for axis in 0..3 {
            let along = axis_only(axis);
            let Some(last) = last else {
                if axis < 2 {
                    let name = (["the position", "at step 0", "", ""], &START[..2]);
                    self.add(
                        name,
                        moment,
                        along,
                        [now.position[axis], moment.place(axis)],
                    );
                }
                if self.leaps {
                    let name = (["the velocity", "at step 0", "", ""], &START[1..]);
                    self.add(
                        name,
                        moment,
                        along,
                        [rate(now, axis), moment.asked_rate(axis)],
                    );
                }
                continue;
            };
            if self.leaps {
                let name = ["the change in a step of", VELOCITIES[axis], "", ""];
                let change = rate(now, axis) - rate(&last.now, axis);
                self.add((name, &KICK), last, along, [change, last.kick(axis)]);
            }
            if self.leaps && axis < 2 {
                let name = ["the change in a step of", POSITIONS[axis], "", ""];
                let way = now.position[axis] - last.now.position[axis];
                self.add(
                    (name, &MOVE),
                    moment,
                    along,
                    [way, rate(now, axis) * moment.time_step],
                );
            }
        }
    }
}

/// Returns the unit vector of an axis, 2 being that of rotation.
fn axis_only(axis: usize) -> [f64; 3] {
    std::array::from_fn(|own| f64::from(u8::from(own == axis)))
}

/// Returns the moment of one body of a row, in its contact of that `kind`.
fn moment(
    walk: &Walk,
    twin: &Twin,
    test: &ContactTest,
    (row, index): (&MotionRow, usize),
    kind: usize,
) -> Moment {
    let arms = &test.convention.arms;
    let arm = if kind == 0 { arms.pair } else { arms.floor };
    Moment {
        now: row.bodies()[index],
        before: walk.last[index].map(|last| last.now),
        asked: test.initial_motions[index],
        step: row.step,
        time_step: test.time_step,
        inertia: [1.0, 1.0, twin.run.moment_of_inertia],
        sign: if index == 0 { 1.0 } else { -1.0 },
        arm: 1.0 + arm.torque * walk.touch.overlap,
        touch: walk.touch,
    }
}

#[cfg(test)]
mod tests {
    use super::super::{ask_native, conventions};
    use super::*;
    use crate::model::Law;
    use crate::series::Motion;

    /// Returns what is told of the native DEM under a convention after a `change` of its rows.
    fn told_after(
        convention: ContactConvention,
        change: impl Fn(&ContactTest, &mut MotionRow),
    ) -> Vec<String> {
        let mut answers = ask_native(convention);
        for answer in &mut answers {
            let mut rows = answer.motion.rows().to_vec();
            rows.iter_mut().for_each(|row| change(&answer.test, row));
            answer.motion = Motion::new(rows, answer.test.steps).expect("as many rows as before");
        }
        failing(&answers.iter().collect::<Vec<_>>(), convention, true, false).texts
    }

    #[test]
    fn all_equations_hold_for_the_native_dem() {
        for convention in conventions() {
            let told = told_after(convention, |_, _| ());
            assert_eq!(told, Vec::<String>::new(), "{convention:?}");
        }
    }

    #[test]
    fn what_is_added_to_a_force_is_named_with_its_size_and_place() {
        for convention in [
            ContactConvention::TURNING,
            ContactConvention::PAPER,
            ContactConvention::with_law(Law::HERTZ),
        ] {
            let told_after =
                |change: &dyn Fn(&mut MotionRow)| told_after(convention, |_, row| change(row));
            let told = told_after(&|row| row.fx1 += 0.125 * row.vx1).join(" ");
            assert!(
                told.contains("+0.125000 times the velocity of the cylinder"),
                "{told}"
            );
            let told = told_after(&|row| row.torque2 *= 3.0).join(" ");
            let expected = "the torque on the second cylinder between cylinders: the tangential force is 3.000000 times";
            assert!(told.contains(expected), "{told}");
            let told = told_after(&|row| row.y1 = (row.y1 * 1e4).round() / 1e4).join(" ");
            assert!(told.contains("the change in a step of y"), "{told}");
        }
    }

    /// Whether cylinder 1 touches the floor and nothing else.
    fn rests_alone(row: &MotionRow) -> bool {
        let [one, two] = row.bodies().map(|own| own.position);
        one[1] < 1.0 && (one[0] - two[0]).hypot(one[1] - two[1]) > 2.0
    }

    #[test]
    fn a_force_at_the_limit_and_roundings_are_told_where_no_term_fits() {
        let convention = ContactConvention::TURNING;
        // The tangent of the floor points to the left, and the arm is r.
        let told = told_after(convention, |test, row| {
            if rests_alone(row) && row.wall_force == 0.0 {
                row.fx1 =
                    test.floor_friction * row.fy1.abs() * if row.fx1 < 0.0 { -1.0 } else { 1.0 };
                row.torque1 = row.fx1;
            }
        });
        let told = told.join(" ");
        assert!(
            told.contains("at the floor: +1.000000 times what is missing"),
            "{told}"
        );
        let told = told_after(convention, |_, row| {
            if rests_alone(row) {
                row.fy1 = f64::from(row.fy1 as f32);
            }
        });
        assert!(told.join(" ").contains("had 32 bits"), "{told:?}");
        // As small, but smooth.
        let told = told_after(convention, |_, row| {
            if rests_alone(row) {
                row.fy1 += 1e-7 * libm::sin(0.1 * row.step as f64);
            }
        });
        assert!(
            !told.is_empty() && !told.join(" ").contains("32 bits"),
            "{told:?}"
        );
    }
}
