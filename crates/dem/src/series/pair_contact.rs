//! The contact of cylinders 1 and 2, whose forces no code reports, computed from positions and the torque of the
//! floor.

use super::differences::{FiveRows, Rates};
use super::sample::Sample;
use crate::model::{Case, ContactLaw, CoulombOperand, Stack};

/// Safety factor for an error that is estimated by the difference of two orders (ASME V&V 20, section 2-4.1).
const TWO_ORDERS: f64 = 3.0;

/// The contact in the middle of five rows. Forces in k_n r.
pub(super) struct PairContact {
    /// Rates of x₂, y₁ and y₂.
    pub(super) rates: [Rates; 3],
    /// Unit vector from cylinder 1 to cylinder 2: components to the right and downwards.
    pub(super) direction: [f64; 2],
    /// a, the normal force from overlap and damping.
    pub(super) normal: f64,
    /// η_n at its overlap, which is larger than that of cylinders 2 and 3.
    pub(super) damping: f64,
    /// b, the tangential force that makes cylinder 2 turn as it does.
    pub(super) shear: f64,
    /// Error of the accelerations in the balances of the contact forces.
    pub(super) acceleration_error: f64,
    /// |q|, the whole tangential force: b together with the component along the normal of a spring that does not turn.
    whole: f64,
    /// Damping beyond Coulomb's limit, as a fraction of a.
    on_top: f64,
    /// Error of |q|/a from the differences.
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
        let [across, down] = from_top(&five.rows[2], stack);
        let distance = libm::hypot(across, down);
        let [sine, cosine] = [across / distance, down / distance];
        let (apart, sinking) = (x2.velocity - x1.velocity, y1.velocity - y2.velocity);
        let overlap = 2.0 - distance;
        let approach = -(sine * apart + cosine * sinking);
        let own = law.at(overlap);
        let normal = own.normal_force(overlap, approach);
        let arms = convention.arms;
        let pair_lever = 1.0 + arms.pair.torque * overlap;
        let floor_lever = 1.0 + arms.floor.torque * (1.0 - sample.height);
        let inertia = convention.moment_of_inertia;
        let shear = (inertia * turn.acceleration - floor_lever * sample.tangential) / pair_lever;
        // Where Coulomb's limit applies to the spring alone, damping is added to it.
        let sliding =
            cosine * apart - sine * sinking - (1.0 + arms.pair.kinematic * overlap) * turn.velocity;
        let on_top = match convention.coulomb_operand {
            CoulombOperand::Spring => own.damping_tangential * sliding.abs(),
            CoulombOperand::SpringAndDamping => 0.0,
        };
        let turning = turn.acceleration_error + 6.0 * five.unit() / five.interval().powi(2);
        let shear_error = inertia * turning / pair_lever;
        // The damping may belong to a moment up to one step away.
        let known_to = |rates: Rates| {
            rates.velocity_error
                + case.protocol.time_step * rates.acceleration.abs()
                + 2.0 * five.unit() / five.interval()
        };
        let velocity_errors: f64 = [x1, x2, y1, y2].map(known_to).iter().sum();
        let normal_error =
            own.damping_normal * velocity_errors + 4.0 * law.stiffness(overlap) * five.unit();
        let accelerations = [x2, y1, y2, turn].map(|rates| rates.acceleration_error);
        let acceleration_error: f64 = accelerations.iter().sum();
        let (whole, ratio_error) = if convention.history_update.turns() {
            let ratio = (shear / normal).abs();
            (shear.abs(), (shear_error + ratio * normal_error) / normal)
        } else {
            // The forces along normals and tangents carry the top cylinder. The part along the normal in excess of a
            // belongs to q.
            let pressing = five.rows[2].wall_force + stack.epsilon() + y1.acceleration;
            let along = (pressing / f64::from(stack.bodies) - sine * shear) / cosine;
            let along_error =
                (acceleration_error + sine * shear_error + 4.0 * five.unit()) / cosine;
            let lift = along - normal;
            let whole = libm::hypot(shear, lift);
            let overlaps = five.rates(|row| pair_overlap(row, stack));
            let normal_error = own.damping_normal * known_to(overlaps)
                + 4.0 * law.stiffness(overlap) * five.unit();
            let errors = (shear * shear_error).abs() + (lift * along_error).abs();
            // An error of a changes the lift and the ratio in the same sense.
            let both = (whole / normal + lift / whole).abs();
            (whole, (errors / whole + both * normal_error) / normal)
        };
        Self {
            rates: [x2, y1, y2],
            acceleration_error,
            direction: [sine, cosine],
            normal,
            damping: own.damping_normal,
            shear,
            whole,
            on_top: on_top / normal,
            ratio_error,
        }
    }

    /// |q|/a minus its largest error: the friction between the cylinders is at least this.
    pub(super) fn carried_ratio(&self) -> f64 {
        self.whole / self.normal - TWO_ORDERS * self.ratio_error - self.on_top
    }
}

/// How far cylinder 2 is to the right of cylinder 1, and how far below it.
fn from_top(row: &Sample, stack: &Stack) -> [f64; 2] {
    let sample = row.first(stack);
    [
        sample.outwards - row.top_outwards(stack),
        row.top(stack)[1] - sample.height,
    ]
}

fn pair_overlap(row: &Sample, stack: &Stack) -> f64 {
    let [across, down] = from_top(row, stack);
    2.0 - libm::hypot(across, down)
}
