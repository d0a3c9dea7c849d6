//! The contact of cylinders 1 and 2, whose forces no code reports: from positions and the torque of the floor.

use super::differences::{FiveRows, Rates};
use crate::model::{Case, ContactLaw, CoulombOperand};

/// Safety factor of an error that is the distance of two orders (ASME V&V 20, section 2-4.1).
const TWO_ORDERS: f64 = 3.0;

/// The contact in the middle of five rows. Forces in k_n r.
pub(super) struct PairContact {
    /// Rates of x₂, y₁ and y₂.
    pub(super) rates: [Rates; 3],
    /// Unit vector from cylinder 1 to 2: to the right, and downwards.
    pub(super) direction: [f64; 2],
    /// a, normal force of overlap and damping.
    pub(super) normal: f64,
    /// η_n at its overlap, which is larger than that of cylinders 2 and 3.
    pub(super) damping: f64,
    /// b, the tangential force with which cylinder 2 turns as it does.
    pub(super) shear: f64,
    /// Error of the accelerations behind the balances of its forces.
    pub(super) acceleration_error: f64,
    /// Damping on top of the limit, as a part of a.
    on_top: f64,
    /// Error of |b|/a by differences.
    ratio_error: f64,
}

impl PairContact {
    pub(super) fn of(case: &Case, law: &ContactLaw, five: FiveRows<'_>) -> Self {
        let convention = &case.convention;
        let stack = &case.stack;
        let sample = five.rows[2].first(stack);
        let (x1, x2) = (
            five.rates(|row| row.top_outwards(stack)),
            five.rates(|row| row.first(stack).outwards),
        );
        let (y1, y2) = (
            five.rates(|row| row.top(stack)[1]),
            five.rates(|row| row.first(stack).height),
        );
        let turn = five.rates(|row| row.first(stack).turn);
        let (across, down) = (
            sample.outwards - five.rows[2].top_outwards(stack),
            five.rows[2].top(stack)[1] - sample.height,
        );
        let distance = libm::hypot(across, down);
        let [sine, cosine] = [across / distance, down / distance];
        let (apart, sinking) = (x2.velocity - x1.velocity, y1.velocity - y2.velocity);
        let overlap = 2.0 - distance;
        let approach = -(sine * apart + cosine * sinking);
        let own = law.at(overlap);
        let normal = own.secant * overlap + own.damping_normal * approach;
        let arms = convention.arms;
        let pair_lever = 1.0 + arms.pair.torque * overlap;
        let floor_lever = 1.0 + arms.floor.torque * (1.0 - sample.height);
        let inertia = convention.moment_of_inertia;
        let shear = (inertia * turn.acceleration - floor_lever * sample.tangential) / pair_lever;
        // Where the limit is compared with the spring alone, damping comes on top of it.
        let sliding =
            cosine * apart - sine * sinking - (1.0 + arms.pair.kinematic * overlap) * turn.velocity;
        let on_top = match convention.coulomb_operand {
            CoulombOperand::Spring => own.damping_tangential * sliding.abs(),
            CoulombOperand::SpringAndDamping => 0.0,
        };
        let turning = turn.acceleration_error + 6.0 * five.unit() / five.interval().powi(2);
        let shear_error = inertia * turning / pair_lever;
        // Damping may belong to a moment up to a step away.
        let known_to = |rates: Rates| {
            rates.velocity_error
                + case.protocol.time_step * rates.acceleration.abs()
                + 2.0 * five.unit() / five.interval()
        };
        let velocity_errors: f64 = [x1, x2, y1, y2].map(known_to).iter().sum();
        let normal_error =
            own.damping_normal * velocity_errors + 4.0 * law.stiffness(overlap) * five.unit();
        let accelerations = [x2, y1, y2, turn].map(|rates| rates.acceleration_error);
        Self {
            rates: [x2, y1, y2],
            acceleration_error: accelerations.iter().sum(),
            direction: [sine, cosine],
            normal,
            damping: own.damping_normal,
            shear,
            on_top: on_top / normal,
            ratio_error: (shear_error + (shear / normal).abs() * normal_error) / normal,
        }
    }

    /// |b|/a, less its largest error: so much friction there is between the cylinders.
    pub(super) fn carried_ratio(&self) -> f64 {
        (self.shear / self.normal).abs() - TWO_ORDERS * self.ratio_error - self.on_top
    }
}
