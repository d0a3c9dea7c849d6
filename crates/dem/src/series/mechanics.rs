//! The laws of mechanics that every series must obey, whichever code made it.
//!
//! Each law compares two sides in every row, from the second row to the last before the floor slips. A side that needs
//! a velocity takes it from five equally spaced rows where there are such. Elsewhere the velocity is bounded by what
//! the speed of the wall can cause. The bounds follow from the contact law, the time step and the rounding of
//! positions (docs/theory.md, section 8.6).

use super::differences::{FiveRows, RINGING_TIME, Rates};
use super::digits::Rounding;
use super::estimate::sticking_rows;
use super::oscillator::Oscillator;
use super::pair_contact::PairContact;
use super::reported::{of_pair, reports};
use super::sample::Sample;
use super::samples::Series;
use crate::model::{Case, ContactLaw, Power, Preparation, Schedule, Stack as Groups};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// A law of mechanics.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MechanicalLaw {
    /// The floor carries the wall force and three weights. Cylinders 2 and 3 carry cylinder 1 and are not pushed
    /// aside, with the normal forces of their overlaps and the shear that makes them turn as they do.
    ForceBalance,
    /// The right half of the stack mirrors the left one.
    MirrorSymmetry,
    /// The wall force is that of the overlap of cylinder 1 with the wall.
    WallOverlap,
    /// The normal force of the floor is that of the overlap of cylinders 2 and 3 with it.
    FloorOverlap,
}

impl MechanicalLaw {
    /// Every law.
    pub const ALL: [Self; 4] = [
        Self::ForceBalance,
        Self::MirrorSymmetry,
        Self::WallOverlap,
        Self::FloorOverlap,
    ];

    /// The name in messages.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::ForceBalance => "the balance of forces",
            Self::MirrorSymmetry => "the mirror symmetry",
            Self::WallOverlap => "wall force against overlap",
            Self::FloorOverlap => "floor force against overlap",
        }
    }
}

/// The deviation of a series from a law, in the row where it is largest in units of its bound. Forces in m g.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Deviation {
    /// Steps since the wall began to move.
    pub step: u64,
    /// Difference of the two sides, to two digits.
    pub size: f64,
    /// Largest difference that the law allows in that row, to two digits.
    pub bound: f64,
    /// The side found in the series, if the law does not hold.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub found: Option<f64>,
    /// The side expected by the law, if it does not hold.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub expected: Option<f64>,
    /// Whether the law does not hold, but would in every row if the bodies were moved by the forces of the step before,
    /// which take damping away.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub is_of_late_forces: bool,
}

impl Deviation {
    /// Whether the law holds.
    pub fn is_allowed(&self) -> bool {
        self.found.is_none()
    }
}

/// The laws that could be checked in a series, each with the largest deviation from it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Mechanics(pub BTreeMap<MechanicalLaw, Deviation>);

impl Mechanics {
    /// Checks `series` against every law, up to the row at which the floor begins to slide.
    pub fn read(series: &Series, case: &Case) -> Self {
        Self::of_stack(&Stack::of(case, series.samples()), series)
    }

    /// Checks a series whose beginning is unknown: when the wall touched, where it was, and how the stack came to
    /// rest. The wall force is therefore not compared with an overlap, and only the rows themselves tell how far floor
    /// and wall may be out of balance.
    pub fn read_without_beginning(series: &Series, case: &Case) -> Self {
        let stack = Stack {
            oscillator: None,
            ..Stack::of(case, series.samples())
        };
        let mut mechanics = Self::of_stack(&stack, series);
        mechanics.0.remove(&MechanicalLaw::WallOverlap);
        mechanics
    }

    fn of_stack(stack: &Stack<'_>, series: &Series) -> Self {
        let mut found = Self::under(stack, series);
        if found.violations().next().is_none() {
            return found;
        }
        let late = Self::under(&stack.with_late_forces(), series);
        for (law, deviation) in &mut found.0 {
            let holds = late.0.get(law).is_some_and(Deviation::is_allowed);
            deviation.is_of_late_forces = holds && !deviation.is_allowed();
        }
        found
    }

    /// Checks the series against the bounds of `stack`.
    fn under(stack: &Stack<'_>, series: &Series) -> Self {
        let case = stack.case;
        let samples = sticking_rows(series.samples(), &case.stack);
        let mut worst: BTreeMap<MechanicalLaw, (f64, Sides)> = BTreeMap::new();
        for row in 1..samples.len() {
            for (law, sides) in stack.sides(samples, row) {
                let ratio = sides.excess();
                let known = worst.get(&law).map_or(f64::NEG_INFINITY, |known| known.0);
                if ratio > known || ratio.is_nan() {
                    worst.insert(law, (ratio, sides));
                }
            }
        }
        let stiffness = case.stack.stiffness;
        let deviations = worst.into_iter();
        Self(
            deviations
                .map(|(law, (_, sides))| (law, sides.deviation(stiffness)))
                .collect(),
        )
    }

    /// The laws that do not hold.
    pub fn violations(&self) -> impl Iterator<Item = (MechanicalLaw, &Deviation)> {
        let deviations = self.0.iter().map(|(law, deviation)| (*law, deviation));
        deviations.filter(|(_, deviation)| !deviation.is_allowed())
    }
}

/// Both sides of a law in one row, in k_n r.
#[derive(Debug, Clone, Copy)]
struct Sides {
    step: u64,
    found: f64,
    expected: f64,
    bound: f64,
}

impl Sides {
    fn excess(&self) -> f64 {
        (self.found - self.expected).abs() / self.bound
    }

    fn deviation(&self, stiffness: f64) -> Deviation {
        let holds = self.excess() <= 1.0;
        let shown = |side: f64| (!holds).then_some(side * stiffness);
        Deviation {
            step: self.step,
            size: two_digits((self.found - self.expected).abs() * stiffness),
            bound: two_digits(self.bound * stiffness),
            found: shown(self.found),
            expected: shown(self.expected),
            is_of_late_forces: false,
        }
    }
}

fn two_digits(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}

/// Largest phase between two rows at which five rows resolve an oscillation: three rows per period.
const SHOWN_PHASE: f64 = 2.0 * PI / 3.0;

/// Number of steps after which the wall has touched, even where it begins to move a step late and forces belong to the
/// step before.
const LATE_TOUCH: u64 = 2;

/// The positions and angles that a series reports.
#[derive(Debug, Clone, Copy)]
struct Reported {
    /// The height of cylinder 1.
    top: bool,
    /// The heights of the bodies on the floor.
    bottom: bool,
    /// All that the balances of cylinders 1 and 2 need.
    pair: bool,
}

impl Reported {
    fn of(samples: &[Sample], stack: &Groups) -> Self {
        let heights = |row: &Sample| -> Vec<f64> {
            let contacts = row.floor_contacts(stack);
            contacts.map(|contact| contact.height).collect()
        };
        Self {
            top: reports(samples, |row| vec![row.top(stack)[1]]),
            bottom: reports(samples, heights),
            pair: reports(samples, |row| {
                [of_pair(row, stack), vec![row.neighbour_distance(stack)]].concat()
            }),
        }
    }

    /// Whether all heights are reported, and hence their sum is known.
    fn heights(self) -> bool {
        self.top && self.bottom
    }
}

/// What the laws need to know about a case.
#[derive(Clone)]
struct Stack<'a> {
    case: &'a Case,
    law: ContactLaw,
    wall_law: ContactLaw,
    /// Height of the centre of cylinder 1 in the first row, where the wall touches it.
    start: f64,
    /// Largest frequency of the stack with all its contacts.
    frequency: f64,
    /// k_n over the stiffness of contacts at rest, at least 1: the rounding of a force moves soft contacts by this
    /// factor more.
    softness: f64,
    schedule: Schedule,
    /// Time by which the forces that move the bodies lag behind the positions.
    force_lag: f64,
    rounding: Rounding,
    reported: Reported,
    /// The oscillator of the sum of the heights, where there is one; valid while every wall presses.
    oscillator: Option<Oscillator>,
    /// Step of the first row in which floor or wall has let go of a body.
    lets_go: u64,
    /// Time by which the wall has surely touched, according to the rows.
    touched: f64,
    /// Whether nothing slides or opens before the onset. Side walls leave contacts at their limits.
    is_smooth: bool,
}

impl<'a> Stack<'a> {
    fn of(case: &'a Case, samples: &[Sample]) -> Self {
        let (convention, ratio) = (&case.convention, case.stack.stiffness_ratio);
        let (law, wall_law) = (convention.law(ratio), convention.wall_law(ratio));
        let schedule = case.protocol.schedule();
        let mut later = samples.iter().skip(1);
        let touching = later.find(|sample| sample.wall_force > 0.0);
        Self {
            case,
            law,
            wall_law,
            oscillator: Oscillator::of(case, [&law, &wall_law], &schedule, 0.0),
            lets_go: lets_go(samples, &case.stack),
            touched: touching.map_or(0.0, |sample| sample.time),
            start: samples
                .first()
                .map_or(0.0, |first| first.top(&case.stack)[1]),
            frequency: case.stack.highest_frequency(convention),
            softness: case.stack.time_scale(convention).powi(2),
            schedule,
            force_lag: 0.0,
            rounding: Rounding::read(samples),
            reported: Reported::of(samples, &case.stack),
            is_smooth: matches!(case.protocol.preparation, Preparation::GravityRamp { .. }),
        }
    }

    /// The same stack in a code that moves the bodies by the forces of the step before.
    fn with_late_forces(&self) -> Self {
        let (case, force_lag) = (self.case, self.case.protocol.time_step);
        let oscillator = self.oscillator.as_ref().and_then(|_| {
            let laws = [&self.law, &self.wall_law];
            Oscillator::of(case, laws, &self.schedule, force_lag)
        });
        Self {
            oscillator,
            force_lag,
            ..self.clone()
        }
    }

    /// Returns both sides of every law that can be checked in `row` of `samples`.
    fn sides(&self, samples: &[Sample], row: usize) -> Vec<(MechanicalLaw, Sides)> {
        let sample = &samples[row];
        let five = FiveRows::around(samples, row, self.rounding)
            .filter(|five| self.is_smooth && self.has_its_speed(five));
        let reported = self.reported;
        let heights = five.filter(|_| reported.heights());
        let mut sides = vec![
            (MechanicalLaw::ForceBalance, self.vertical(sample, heights)),
            (MechanicalLaw::MirrorSymmetry, self.mirror(sample)),
        ];
        if reported.top {
            sides.push((MechanicalLaw::WallOverlap, self.wall(sample, five)));
        }
        if reported.bottom {
            let places = 0..usize::from(self.case.stack.bodies);
            sides.extend(
                places.map(|place| (MechanicalLaw::FloorOverlap, self.floor(sample, five, place))),
            );
        }
        if let Some(five) = five.filter(|five| reported.pair && self.keeps_its_contacts(five)) {
            let cylinders = self.cylinders(sample, five);
            let balances = cylinders.into_iter();
            sides.extend(balances.map(|balance| (MechanicalLaw::ForceBalance, balance)));
        }
        sides
    }

    /// Whether the wall has reached its final speed in these rows. While it slows down, differences of rows are not
    /// rates.
    fn has_its_speed(&self, five: &FiveRows<'_>) -> bool {
        five.rows[0].step >= self.schedule.fast_steps + self.schedule.slowing_steps
    }

    /// Upper bound of the rounding error of a position that is advanced in every step.
    fn rounded(&self, sample: &Sample) -> f64 {
        (self.schedule.preparation.total() + sample.step) as f64 * self.rounding.step
    }

    /// Largest force on a body whose position is rounded to 32 bits in every step: each rounding rings like a touch. In double
    /// precision it is far below every other bound.
    fn noise_of_single_precision(&self) -> f64 {
        let ringing = (RINGING_TIME / self.case.protocol.time_step).max(1.0);
        let position = (self.rounding.step - Rounding::DOUBLE.step) * ringing.sqrt();
        position * self.frequency * self.frequency
    }

    /// Error of a force and of the overlap behind it from printed digits.
    fn printed(&self) -> f64 {
        self.rounding.force + 2.0 * self.rounding.coordinate
    }

    /// Returns the force of a wall at an overlap that grows at a speed, and the factor by which errors of the overlap
    /// enter the force.
    fn of_wall(&self, overlap: f64, speed: f64) -> (f64, f64) {
        let force = self.wall_law.at(overlap).normal_force(overlap, speed);
        (force, self.wall_law.stiffness(overlap).max(1.0))
    }

    /// Returns the uncertainty of a force with this damping: its velocity may belong to a moment up to one step away,
    /// it is computed from differences of rows, and it has rounding errors.
    fn damping_error(&self, damping: f64, rates: &[Rates], five: FiveRows<'_>) -> f64 {
        let of_one = |rates: &Rates| {
            self.case.protocol.time_step * rates.acceleration.abs() + rates.velocity_error
        };
        let lags: f64 = rates.iter().map(of_one).sum();
        damping
            * (lags
                + rates.len() as f64 * five.rounding() * (self.frequency + five.interval().recip()))
    }

    /// Returns the largest force by which floor and wall are, or may unseen be, out of balance in `five` rows.
    fn ringing(&self, five: FiveRows<'_>) -> f64 {
        let unbalanced = five.rows.iter().map(|sample| self.unbalanced(sample).abs());
        unbalanced.fold(self.unseen(five), f64::max)
    }

    fn unbalanced(&self, sample: &Sample) -> f64 {
        sample.borne(&self.case.stack) - self.case.stack.floor_force(sample.wall_force)
    }

    /// The largest force by which floor and wall are out of balance if bodies move as fast as a sudden touch of the
    /// wall permits, each in an oscillation of the highest frequency.
    fn of_sudden_touch(&self) -> f64 {
        self.case.stack.own_weight() * self.frequency * self.case.protocol.fast_speed()
    }

    /// The oscillator at `sample`, if every wall has pressed until then.
    fn oscillator_at(&self, sample: &Sample) -> Option<&Oscillator> {
        self.oscillator
            .as_ref()
            .filter(|_| sample.step < self.lets_go)
    }

    /// Returns the largest force by which floor and wall, or a body, may be out of balance without any row of `five`
    /// showing it. With linear springs, rows that resolve the frequency √w of floor and wall are taken to show
    /// everything. Otherwise rows show the motions that have at least three rows per period. Faster motions have
    /// decayed since the wall touched or reached its final speed; with linear springs, the decay rate used holds for
    /// every motion.
    fn unseen(&self, five: FiveRows<'_>) -> f64 {
        let first = &five.rows[0];
        let shown = SHOWN_PHASE / five.interval();
        let is_linear = self.wall_law.power == Power::Linear;
        if is_linear && self.wall_law.normal_stiffness.sqrt() <= shown {
            return 0.0;
        }
        let changing = self.schedule.fast_steps + self.schedule.slowing_steps;
        let constant = changing as f64 * self.case.protocol.time_step;
        let (rate, touched) = match &self.oscillator {
            Some(oscillator) => (oscillator.slowest_decay(), oscillator.touched()),
            None => (self.slowest_decay(first, shown), self.touched),
        };
        let age = first.time - touched.max(constant);
        self.of_sudden_touch() * libm::exp(-rate * age.max(0.0))
    }

    /// Lower bound of the decay rate of every motion that is faster than `shown` and than a single contact: a motion
    /// of frequency ω, damped by dashpots η beside springs k, decays at ω² η/(2k). Contacts become stiffer under load,
    /// and none carries more than the whole floor. Forces that lag by a time take that from every η/k.
    fn slowest_decay(&self, sample: &Sample, shown: f64) -> f64 {
        let stack = &self.case.stack;
        let at_rest = stack.epsilon() / f64::from(stack.bodies);
        let bears = sample.borne(stack).max(at_rest);
        let rates = [&self.law, &self.wall_law].map(|law| {
            let lag = |force: f64| (law.damping_time(force) - self.force_lag).max(0.0);
            let own = lag(at_rest) * law.stiffness(law.overlap(at_rest));
            0.5 * own.min(lag(bears) * shown * shown)
        });
        rates[0].min(rates[1])
    }

    /// Vertical balance of the whole stack. Any imbalance accelerates the cylinders. Where the sum of their heights is
    /// an oscillator with a known beginning, its excitation bounds the imbalance. Elsewhere the rows bound it: an
    /// oscillation of frequency ω that bends by b between rows at a distance h has the acceleration ω² b/(4 sin²
    /// (ωh/2)). This is less than (π²/4) b/h² if there are three rows per period, and rows that are further apart show
    /// only slower motions. The factor for damping restores what damping takes from ω².
    fn vertical(&self, sample: &Sample, five: Option<FiveRows<'_>>) -> Sides {
        let own_weight = self.case.stack.own_weight();
        let bodies = usize::from(self.case.stack.bodies) + 1;
        let height = |sample: &Sample| -> f64 {
            let bodies = sample.bodies[..bodies].iter();
            bodies.map(|body| body.position[1]).sum()
        };
        let bend = |three: &[Sample]| {
            (height(&three[0]) - 2.0 * height(&three[1]) + height(&three[2])).abs()
        };
        let inertia = match (self.oscillator_at(sample), five) {
            (Some(oscillator), _) => oscillator.bound(sample.time),
            (None, Some(five)) => {
                let bends = five.rows.windows(3).map(bend);
                let most = bends.fold(4.0 * five.rounding(), f64::max);
                let logarithm = libm::log(self.case.convention.restitution);
                let damped = 1.0 + (logarithm / PI).powi(2);
                let shown = 0.25 * damped * (PI / five.interval()).powi(2) * most;
                shown + self.unseen(five)
            }
            (None, None) => self.of_sudden_touch(),
        };
        let rounded = 2.0 * self.rounding.step * self.wall_law.normal_stiffness.max(1.0);
        let noise = bodies as f64 * self.noise_of_single_precision();
        Sides {
            step: sample.step,
            found: sample.borne(&self.case.stack),
            expected: self.case.stack.floor_force(sample.wall_force),
            bound: inertia + noise + own_weight * (rounded + self.rounding.force),
        }
    }

    /// Mirror symmetry, by the pair of reported values that mirror each other worst.
    fn mirror(&self, sample: &Sample) -> Sides {
        let top = &sample.bodies[self.case.stack.top()];
        let [x, _, z] = top.position;
        let mut pairs: Vec<(f64, f64)> = [[x, z], [top.rotation[0], top.rotation[2]]]
            .into_iter()
            .flatten()
            .chain([top.rotation[1]])
            .map(|coordinate| (coordinate, -coordinate))
            .collect();
        let first = sample.first(&self.case.stack);
        for contact in sample.floor_contacts(&self.case.stack) {
            pairs.extend([
                (first.outwards, contact.outwards),
                (first.height, contact.height),
                (first.turn, contact.turn),
                (first.normal, contact.normal),
                (first.tangential, contact.tangential),
                (contact.sideways, -contact.sideways),
                (contact.across, -contact.across),
            ]);
        }
        let distance = |pair: &(f64, f64)| (pair.0 - pair.1).abs();
        let worst = pairs
            .into_iter()
            .filter(|pair| !pair.0.is_nan() && !pair.1.is_nan())
            .max_by(|left, right| distance(left).total_cmp(&distance(right)));
        let (found, expected) = worst.unwrap_or_default();
        Sides {
            step: sample.step,
            found,
            expected,
            bound: 4.0 * self.softness * self.rounded(sample) + 2.0 * self.printed(),
        }
    }

    fn wall(&self, sample: &Sample, five: Option<FiveRows<'_>>) -> Sides {
        let protocol = &self.case.protocol;
        let height = |sample: &Sample| sample.top(&self.case.stack)[1];
        let overlap = height(sample) - self.start + protocol.travel_at(&self.schedule, sample.step);
        let damping = self.wall_law.at(overlap).damping_normal;
        let (speed, error) = match five {
            Some(five) => {
                let rates = five.rates(height);
                let error = self.damping_error(damping, &[rates], five) + self.ringing(five);
                let wall_speed = protocol.speed_at(&self.schedule, sample.step);
                (rates.velocity + wall_speed, error)
            }
            None => (0.0, 2.0 * damping * protocol.fast_speed()),
        };
        let (expected, stiffness) = self.of_wall(overlap, speed);
        Sides {
            step: sample.step,
            found: sample.wall_force,
            expected,
            bound: error + stiffness * (self.rounded(sample) + self.printed()),
        }
    }

    fn floor(&self, sample: &Sample, five: Option<FiveRows<'_>>, place: usize) -> Sides {
        let contact = |sample: &Sample| {
            let mut contacts = sample.floor_contacts(&self.case.stack);
            contacts.nth(place)
        };
        let height = |sample: &Sample| contact(sample).map_or(f64::NAN, |contact| contact.height);
        let force = contact(sample).map_or(f64::NAN, |contact| contact.normal);
        let overlap = 1.0 - height(sample);
        let damping = self.wall_law.at(overlap).damping_normal;
        let (speed, error) = match five {
            Some(five) => {
                let rates = five.rates(height);
                let error = self.damping_error(damping, &[rates], five) + self.ringing(five);
                (-rates.velocity, error)
            }
            None => (0.0, damping * self.case.protocol.fast_speed()),
        };
        let (expected, stiffness) = self.of_wall(overlap, speed);
        Sides {
            step: sample.step,
            found: force,
            expected,
            bound: error + stiffness * (4.0 * self.rounding.step + self.printed()),
        }
    }

    /// Outward component of the forces of the neighbours, including damping.
    fn bottom_force(&self, sample: &Sample, five: FiveRows<'_>) -> f64 {
        let stack = &self.case.stack;
        let overlap = 2.0 - sample.neighbour_distance(stack);
        let parting = five.rates(|row| row.neighbour_distance(stack)).velocity;
        if overlap > 0.0 {
            stack.ring().push * self.law.at(overlap).normal_force(overlap, -parting)
        } else {
            0.0
        }
    }

    /// The balances of cylinders 1 and 2. Their contact carries the normal force of its overlap, and the shear that
    /// makes cylinder 2 turn as it does under the shear of the floor. With a spring that does not turn, the two
    /// balances are combined into one.
    fn cylinders(&self, sample: &Sample, five: FiveRows<'_>) -> Vec<Sides> {
        let pair = PairContact::of(self.case, &self.law, five);
        let [x2, y1, y2] = pair.rates;
        let (sine, cosine) = (pair.direction[0], pair.direction[1]);
        let second_difference = 16.0 * five.rounding() / five.interval().powi(2);
        let known_to = self.damping_error(pair.damping, &[x2, y1, y2], five)
            + second_difference
            + pair.acceleration_error
            + 8.0 * self.rounding.step
            + 4.0 * self.printed();
        let bottom = self.bottom_force(sample, five);
        let bodies = f64::from(self.case.stack.bodies);
        let pressing = sample.wall_force + self.case.stack.epsilon() + y1.acceleration;
        let unbalanced = bottom + sample.first(&self.case.stack).tangential - x2.acceleration;
        if !self.case.convention.history_update.turns() {
            // The force along the normal of a spring that does not turn depends on the past and is not reported, so it
            // is eliminated from the two balances.
            let across = Sides {
                step: sample.step,
                found: pair.shear,
                expected: pressing / bodies * sine + unbalanced * cosine,
                bound: 2.0 * known_to + 4.0 * self.ringing(five),
            };
            return vec![across];
        }
        let top = Sides {
            step: sample.step,
            found: bodies * (pair.normal * cosine + pair.shear * sine),
            expected: pressing,
            bound: bodies * known_to + 2.0 * bodies * self.ringing(five),
        };
        let side = Sides {
            step: sample.step,
            found: pair.normal * sine + bottom,
            expected: pair.shear * cosine - sample.first(&self.case.stack).tangential
                + x2.acceleration,
            bound: known_to + 2.0 * self.ringing(five),
        };
        vec![top, side]
    }

    /// Whether no contact between neighbours on the floor opens or closes in these rows.
    fn keeps_its_contacts(&self, five: &FiveRows<'_>) -> bool {
        let is_open = |sample: &Sample| sample.neighbour_distance(&self.case.stack) > 2.0;
        five.rows
            .iter()
            .all(|sample| is_open(sample) == is_open(&five.rows[0]))
    }
}

/// Returns the step of the first row in which the floor or the wall has let go of a body after the wall has surely
/// touched.
fn lets_go(samples: &[Sample], stack: &Groups) -> u64 {
    let touches = |sample: &&Sample| sample.step > LATE_TOUCH;
    let mut later = samples.iter().filter(touches);
    let open = later.find(|sample| {
        let mut floor = sample.floor_contacts(stack);
        sample.wall_force <= 0.0 || floor.any(|contact| contact.normal <= 0.0)
    });
    open.map_or(u64::MAX, |sample| sample.step)
}
