//! The native DEM with a mistake.

use super::rows::{Row, rows_of};
use crate::dem::{
    Contact, ContactForce, ContactModel, Counterpart, Spring, SpringDashpot, compress_stack_with,
};
use crate::model::Case;

/// Steps of the golden section.
const REFINEMENTS: usize = 30;

/// Factors on the coefficients of one kind of contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Change {
    pub normal_stiffness: f64,
    pub tangential_stiffness: f64,
    pub normal_damping: f64,
    pub tangential_damping: f64,
    pub friction: f64,
    /// On the spins in the surface velocity.
    pub spin: f64,
    /// On the torque.
    pub torque: f64,
}

impl Change {
    pub const NONE: Self = Self {
        normal_stiffness: 1.0,
        tangential_stiffness: 1.0,
        normal_damping: 1.0,
        tangential_damping: 1.0,
        friction: 1.0,
        spin: 1.0,
        torque: 1.0,
    };
}

/// The law of a case with mistakes.
#[derive(Debug, Clone, Copy)]
pub(super) struct MistakenLaw {
    law: SpringDashpot<f64>,
    pub pair: Change,
    pub floor: Change,
    pub wall: Change,
}

impl MistakenLaw {
    fn of(case: &Case) -> Self {
        Self {
            law: SpringDashpot::like(0.0, &case.convention, case.stack.stiffness_ratio),
            pair: Change::NONE,
            floor: Change::NONE,
            wall: Change::NONE,
        }
    }

    /// Changes every kind of contact.
    pub fn everywhere(&mut self, change: impl Fn(&mut Change)) {
        [&mut self.pair, &mut self.floor, &mut self.wall]
            .into_iter()
            .for_each(change);
    }
}

impl ContactModel<f64> for MistakenLaw {
    type Memory = Spring<f64>;

    fn initial(&self, number: f64) -> Spring<f64> {
        self.law.initial(number)
    }

    fn evaluate(&self, contact: &Contact<f64>, memory: &mut Spring<f64>) -> ContactForce<f64> {
        let change = match contact.counterpart {
            Counterpart::Cylinder => &self.pair,
            Counterpart::Wall if contact.normal[1] > 0.0 => &self.floor,
            Counterpart::Wall => &self.wall,
        };
        let mut law = self.law;
        law.law.tangential_stiffness *= change.tangential_stiffness;
        law.law.damping_normal *= change.normal_damping;
        law.law.damping_tangential *= change.tangential_damping;
        let altered = Contact {
            overlap: contact.overlap * change.normal_stiffness,
            friction: contact.friction * change.friction,
            spin: contact.spin * change.spin,
            ..*contact
        };
        let force = law.evaluate(&altered, memory);
        ContactForce {
            arm: force.arm * change.torque,
            ..force
        }
    }
}

/// A mistake, as the native DEM makes it.
pub(super) struct Mistake {
    pub text: String,
    pub case: Case,
    pub law: MistakenLaw,
}

impl Mistake {
    pub fn new(case: &Case, text: &str) -> Self {
        let (text, law) = (text.to_owned(), MistakenLaw::of(case));
        Self {
            text,
            case: *case,
            law,
        }
    }

    /// The series that it gives, if that stays finite.
    pub fn rows(&self) -> Option<Vec<Row>> {
        let series = compress_stack_with(&self.case, self.law, || true).ok()?;
        Some(rows_of(&series))
    }
}

/// The series of the native DEM in every step.
pub(super) fn every_step(case: &Case) -> Vec<Row> {
    let mut dense = Mistake::new(case, "");
    let protocol = &mut dense.case.protocol;
    protocol.sampling.fine_interval = protocol.time_step;
    protocol.sampling.coarse_interval = protocol.time_step;
    dense.rows().unwrap_or_default()
}

/// Where `value` is smallest between two places, by the golden section.
pub(super) fn minimum(value: &dyn Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    let (mut left, mut right) = (high - golden * (high - low), low + golden * (high - low));
    let (mut of_left, mut of_right) = (value(left), value(right));
    for _ in 0..REFINEMENTS {
        if of_left < of_right {
            (high, right, of_right) = (right, left, of_left);
            left = high - golden * (high - low);
            of_left = value(left);
        } else {
            (low, left, of_left) = (left, right, of_right);
            right = low + golden * (high - low);
            of_right = value(right);
        }
    }
    0.5 * (low + high)
}
