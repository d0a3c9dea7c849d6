//! The micro-tests of one kind of contact, and the laws that follow from their motions.

use super::clock::Clock;
use super::contact_frame::{ContactRow, contact_rows};
use super::experiments::{self, ContactKind};
use super::finding::{LIMIT_DAMPING_SHARE, Property, ROLLING_COUPLE, TANGENTIAL_STIFFNESS};
use super::linear_form::sticking;
use super::normal::{self, LinearNormalLaw, pull};
use super::other_model::{has_no_spring, rolling_couple};
use super::power::NormalPowerLaw;
use super::properties::{growing_properties, power_properties};
use super::properties::{growth, normal_properties, sliding_properties, tangential_properties};
use super::regression::{Measured, fit};
use super::sliding::{MARGIN, SlidingLaw, is_at_limit, is_limited_by, largest_operand};
use super::tangential::TangentialLaw;
use crate::model::{ContactConvention, ContactTest};
use crate::series::Motion;

/// Spin of the gentle motion, from which the spins of the motions to the slip threshold are scaled.
const GENTLE_SPIN: f64 = 1e-4;

/// Shares of the damping in the Coulomb operand that are tried.
const SHARES: [f64; 2] = [0.0, 1.0];

/// A micro-test and its motion.
pub type TestedMotion<'a> = (&'a ContactTest, &'a Motion);

/// The micro-tests of one kind.
pub struct MicroTests {
    kind: ContactKind,
    convention: ContactConvention,
    tests: Vec<ContactTest>,
}

/// Indices of the tests in a plan.
const STICKING: std::ops::Range<usize> = 0..3;
const REFINED: std::ops::Range<usize> = 3..6;
const SEPARATING: usize = 6;
const SLIDING: usize = 7;
const GENTLE: usize = 8;

impl MicroTests {
    /// The tests of `kind` for a code with the given convention.
    pub fn new(kind: ContactKind, convention: &ContactConvention) -> Self {
        let mut tests = experiments::common(kind, convention);
        if kind != ContactKind::Wall {
            tests.push(experiments::near_slip(kind, convention, GENTLE_SPIN));
        }
        Self {
            kind,
            convention: *convention,
            tests,
        }
    }

    /// The tests, in order.
    pub fn tests(&self) -> &[ContactTest] {
        &self.tests
    }

    /// Fits the laws to the motions of the tests; `turning` is the motion of a pair that turns.
    pub fn read(self, motions: &[TestedMotion], turning: &[ContactRow], clock: &Clock) -> Laws {
        let rows: Vec<Vec<ContactRow>> = motions
            .iter()
            .map(|(test, motion)| contact_rows(self.kind, test, motion, clock))
            .collect();
        let turning = (self.kind == ContactKind::Pair).then_some(turning);
        let (sticking, refined) = (&rows[STICKING], &rows[REFINED]);
        let normal = self.read_normal(sticking, refined, clock);
        let tangential = match &normal {
            Normal::Linear(_) => {
                let test = &self.tests[0];
                let declared = test.convention.law(test.stiffness_ratio);
                let stiffness = declared.tangential_stiffness;
                TangentialLaw::read(sticking, refined, turning, stiffness)
            }
            Normal::Power(law) => {
                TangentialLaw::read_growing(sticking, refined, turning, law.stiffening())
            }
        };
        let lifted = tangential
            .lifts()
            .then(|| self.without_lift(&tangential, &rows, clock))
            .filter(|(lifted, _, sticks)| lifted.left(sticks) < normal.left(&reported(sticks)));
        let (normal, tangential, rows) = match lifted {
            Some((lifted, rows, _)) => (lifted, tangential, rows),
            None => (normal, tangential.without_lift(), rows),
        };
        // Nothing slides on the wall.
        let limited_by_spring = rows
            .get(SLIDING)
            .is_some_and(|sliding| is_limited_by(&normal.limited_by_spring(sliding), sliding));
        let rows = match limited_by_spring {
            true => rows
                .iter()
                .map(|own| normal.limited_by_spring(own))
                .collect(),
            false => rows,
        };
        Laws {
            limited_by_spring,
            pull: match &normal {
                Normal::Linear(law) => pull(&rows[SEPARATING], law),
                Normal::Power(law) => law.pull(&rows[SEPARATING]),
            },
            tangential,
            normal,
            rows,
            plan: self,
        }
    }

    /// Fits the normal law to motions with two time steps.
    fn read_normal(
        &self,
        coarse: &[Vec<ContactRow>],
        fine: &[Vec<ContactRow>],
        clock: &Clock,
    ) -> Normal {
        let (coarse, fine) = (coarse.concat(), fine.concat());
        let mass = self.kind.effective_mass(clock.mass.value);
        match self.convention.law.is_linear() {
            true => Normal::Linear(LinearNormalLaw::read(&coarse, &fine, mass)),
            false => Normal::Power(NormalPowerLaw::read(&[coarse, fine].concat(), mass)),
        }
    }

    /// Returns the normal law beside a spring with a component along the normal, the rows of all motions without that
    /// component, and the rows from which the law was fitted. As long as a contact sticks, the component follows from
    /// the spring; in the motion that slides, it follows from the normal law.
    fn without_lift(
        &self,
        tangential: &TangentialLaw,
        rows: &[Vec<ContactRow>],
        clock: &Clock,
    ) -> (Normal, Vec<Vec<ContactRow>>, Vec<ContactRow>) {
        let mut lifted: Vec<Vec<ContactRow>> =
            rows.iter().map(|own| tangential.with_lift(own)).collect();
        let [coarse, fine] = [STICKING, REFINED].map(|range| {
            let motions = lifted[range].iter();
            motions
                .map(|own| sticking(own).to_vec())
                .collect::<Vec<_>>()
        });
        let normal = self.read_normal(&coarse, &fine, clock);
        for row in &mut lifted[SLIDING] {
            let reported = row.normal_force + row.lift;
            *row = row.lifted_by(reported - normal.force(row));
        }
        (normal, lifted, [coarse, fine].concat().concat())
    }
}

/// `rows` with the normal force that was reported.
fn reported(rows: &[ContactRow]) -> Vec<ContactRow> {
    rows.iter().map(|row| row.lifted_by(0.0)).collect()
}

/// `spin` to eleven digits, so that recorded motions are found on machines whose last digits differ. This shifts it by
/// at most a twentieth of [`MARGIN`].
fn rounded(spin: f64) -> f64 {
    format!("{spin:.10e}").parse().unwrap_or(spin)
}

/// The normal law of one kind, in the form that the declaration asks for.
enum Normal {
    /// Linear; any other law shows as a deviation.
    Linear(LinearNormalLaw),
    /// Any power of the overlap.
    Power(NormalPowerLaw),
}

impl Normal {
    /// The normal force that the law gives in a row, however much of the reported force is lift.
    fn force(&self, row: &ContactRow) -> f64 {
        match self {
            Self::Linear(law) => law.force(row),
            Self::Power(law) => law.force(row),
        }
    }

    /// The spring's part of that force.
    fn spring_part(&self, row: &ContactRow) -> f64 {
        match self {
            Self::Linear(law) => law.spring_part(row),
            Self::Power(law) => law.spring_part(row),
        }
    }

    /// `rows` whose Coulomb limit counts that part alone.
    fn limited_by_spring(&self, rows: &[ContactRow]) -> Vec<ContactRow> {
        let limited = rows.iter().map(|row| ContactRow {
            limiting_part: Some(self.spring_part(row)),
            ..*row
        });
        limited.collect()
    }

    /// Sum of the squared deviations of the normal forces from the law.
    fn left(&self, rows: &[ContactRow]) -> f64 {
        let off = rows.iter().map(|row| row.normal_force - self.force(row));
        off.map(|off| off * off).sum()
    }
}

/// The laws of one kind.
pub struct Laws {
    plan: MicroTests,
    normal: Normal,
    pull: Measured,
    tangential: TangentialLaw,
    rows: Vec<Vec<ContactRow>>,
    /// Whether Coulomb's limit counts the spring's part of the normal force alone.
    limited_by_spring: bool,
}

impl Laws {
    /// Motions to just below and just above Coulomb's limit, for every share of the damping that may count in
    /// its operand. Sticking is linear in the spin: the gentle motion determines how fast they must be.
    pub fn threshold_tests(&self) -> Vec<ContactTest> {
        let Some(gentle) = self.rows.get(GENTLE) else {
            return Vec::new();
        };
        let spins = SHARES.iter().flat_map(|&share| {
            let largest = largest_operand(gentle, &self.tangential, share);
            let at_limit = GENTLE_SPIN / largest.map_or(f64::NAN, |(_, ratio)| ratio);
            [at_limit * (1.0 - MARGIN), at_limit * (1.0 + MARGIN)]
        });
        let tests = spins.map(|spin| {
            // A contact without friction or damping has no threshold: any motion will do.
            let spin = if spin.is_finite() { spin } else { GENTLE_SPIN };
            experiments::near_slip(self.plan.kind, &self.plan.convention, rounded(spin))
        });
        tests.collect()
    }

    /// The share of the damping in the Coulomb operand: the one with which the contact sticks just below the
    /// limit and slides just above it.
    fn operand_damping(&self, outcomes: &[TestedMotion], clock: &Clock) -> Measured {
        let gentle = self.rows.get(GENTLE).map_or(&[][..], Vec::as_slice);
        let candidates = SHARES.iter().zip(outcomes.chunks(2));
        let mut found = candidates.filter_map(|(&share, motions)| {
            let (row, ratio) = largest_operand(gentle, &self.tangential, share)?;
            let slides = |(test, motion): &TestedMotion| {
                let rows = contact_rows(self.plan.kind, test, motion, clock);
                let rows = match self.limited_by_spring {
                    true => self.normal.limited_by_spring(&rows),
                    false => rows,
                };
                let rows = self.tangential.with_lift(&rows);
                rows.get(row).map(is_at_limit)
            };
            let [below, above] = [motions.first()?, motions.get(1)?].map(slides);
            let found = below == Some(false) && above == Some(true);
            found.then(|| Measured::new(share, MARGIN * self.limit_over_damping(row, ratio)))
        });
        found.next().unwrap_or(Measured::UNKNOWN)
    }

    /// The limit in units of the damping force, at the slip threshold.
    fn limit_over_damping(&self, row: usize, ratio: f64) -> f64 {
        let row = &self.rows[GENTLE][row];
        let damping = self.tangential.damping_at(row) * self.tangential.surface_speed(row);
        row.friction * row.limiting_force() * ratio / damping.abs()
    }

    /// All properties of the kind; `near_slip` are the motions to the slip threshold.
    pub fn properties(&self, near_slip: &[TestedMotion], clock: &Clock) -> Vec<Property> {
        let kind = self.plan.kind;
        let test = &self.plan.tests[0];
        let mut properties = match &self.normal {
            Normal::Linear(law) => {
                let mut own = normal_properties(kind, law, self.pull, test);
                let growing = || normal::growth(&self.rows[STICKING].concat());
                own.extend(growth(&own[0], growing));
                own
            }
            Normal::Power(law) => power_properties(kind, law, self.pull, test),
        };
        if kind == ContactKind::Wall {
            properties.extend(self.wall_properties());
            return properties;
        }
        if kind == ContactKind::Pair {
            let couple = rolling_couple(&self.rows[STICKING]);
            properties.extend(couple.map(|own| Property::at(kind, ROLLING_COUPLE, own, 0.0)));
        }
        let share = self.operand_damping(near_slip, clock);
        let sliding = SlidingLaw::read(&self.rows[SLIDING], &self.tangential, share.value);
        properties.extend(match &self.normal {
            Normal::Linear(_) => tangential_properties(kind, &self.tangential, test),
            Normal::Power(law) => growing_properties(kind, &self.tangential, law, test),
        });
        let stiffness = properties
            .iter_mut()
            .find(|own| own.name.ends_with(&format!("_{TANGENTIAL_STIFFNESS}")));
        if let Some(own) = stiffness
            && !own.measured.uncertainty.is_finite()
            && has_no_spring(&self.rows[STICKING])
        {
            own.measured = Measured::new(0.0, 0.0);
        }
        let test = &self.plan.tests[SLIDING];
        properties.extend(sliding_properties(kind, &sliding, share, test));
        if self.limited_by_spring {
            let none = Measured::new(0.0, 0.0);
            properties.push(Property::at(kind, LIMIT_DAMPING_SHARE, none, 1.0));
        }
        properties
    }

    /// The tangential law.
    pub fn tangential(&self) -> &TangentialLaw {
        &self.tangential
    }

    /// The normal stiffness at an overlap of r, if the law is any power.
    pub fn power_stiffness(&self) -> Option<Measured> {
        match &self.normal {
            Normal::Linear(_) => None,
            Normal::Power(law) => Some(law.stiffness),
        }
    }

    /// Friction and reported force of the top wall, which should be frictionless and report the force that it exerts.
    fn wall_properties(&self) -> [Property; 2] {
        let rows = self.rows[STICKING].iter().flatten();
        let against_normal = |value: fn(&ContactRow) -> f64| {
            let terms = rows.clone().map(|row| ([row.normal_force], value(row)));
            let [ratio] = fit(&terms.collect::<Vec<_>>());
            ratio
        };
        let friction = against_normal(|row| row.tangential_force.abs());
        let reported = against_normal(|row| row.wall_force);
        [
            Property::at(ContactKind::Wall, "friction", friction, 0.0),
            Property::at(ContactKind::Wall, "reported_force", reported, 1.0),
        ]
    }
}
