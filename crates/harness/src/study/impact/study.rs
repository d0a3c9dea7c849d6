//! The evaluation of an impact: its measured number, compared with the exact one.

use super::extrapolate::{DIVISIONS, extrapolate, orders, weights};
use super::plan::{ImpactQuantity, ImpactStudy, Reference};
use crate::code::{Code, ConventionKey, SettledCode, Unknown};
use crate::model::ImpactTarget;
use crate::runs::{ImpactReading, ImpactRun, Workload};
use crate::series::Rebound;
use crate::study::{
    Evaluation, Ground, Grounds, Judged, MAX_TOLERANCE, ROUNDING, Study, tolerance,
};
use crate::theory::{damping_exponent, sliding_change};

/// The largest coordinate of a body that touches, in r.
const LARGEST_COORDINATE: f64 = 4.0;
/// Significant digits that reproduce a number of double precision exactly.
const ALL_DIGITS: u32 = 17;

/// A measured number of an impact.
#[derive(Debug, Clone, PartialEq)]
pub struct ImpactFinding {
    /// Extrapolated to vanishing time step.
    pub measured: f64,
    /// The exact value.
    pub exact: f64,
    /// Measured minus exact, over exact. Where a twin is the reference, the runs are compared at each time step
    /// before the difference is extrapolated.
    pub error: f64,
    /// The parts of its uncertainty.
    pub budget: ImpactBudget,
}

/// The parts of the uncertainty of a number, relative to its exact value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImpactBudget {
    /// Change by the last order that the extrapolation removes.
    pub time_step: f64,
    /// Kink of the limit μ |N| where a normal force begins to pull; it may lie anywhere in a step.
    pub sign_change: f64,
    /// Rounding of positions and velocities in every step, a random walk.
    pub round_off: f64,
    /// Half a unit in the last printed place.
    pub print_precision: f64,
    /// Uncertainty of the exact value where inertia or arm of the code were measured, not declared.
    pub convention: f64,
}

impl ImpactBudget {
    /// Returns the sum of the parts.
    pub fn total(&self) -> f64 {
        self.time_step + self.sign_change + self.round_off + self.print_precision + self.convention
    }
}

/// A judged impact.
pub type ImpactJudgement = Judged<ImpactStudy, Option<ImpactFinding>>;

impl ImpactJudgement {
    /// Returns the result, unless its reference belongs to another convention.
    pub fn judged(&self) -> Option<&ImpactFinding> {
        let finding = self.finding.as_ref()?.as_ref();
        finding.filter(|_| self.grounds.is_judged())
    }

    /// Returns the largest relative error that agrees.
    pub fn tolerance(&self) -> Option<f64> {
        Some(tolerance(self.judged()?.budget.total(), MAX_TOLERANCE))
    }
}

impl Study for ImpactStudy {
    type Reading = ImpactReading;
    /// Absent if bodies do not touch and part, or the reference fails.
    type Finding = Option<ImpactFinding>;

    fn code(&self) -> SettledCode {
        self.code.clone()
    }

    fn depends_on(&self, unknown: &Unknown) -> bool {
        let (torque_arm, kinematic_arm) = match self.impact.target {
            ImpactTarget::Pair => (
                ConventionKey::PairTorqueArm,
                ConventionKey::PairKinematicArm,
            ),
            ImpactTarget::Floor => (
                ConventionKey::FloorTorqueArm,
                ConventionKey::FloorKinematicArm,
            ),
        };
        let oblique = self.quantity.is_oblique();
        match unknown.key {
            ConventionKey::TensileForce => self.is_damped(),
            ConventionKey::CoulombOperand => self.is_damped() && oblique,
            ConventionKey::SlidingSpring => self.reference() == Reference::Twin,
            ConventionKey::MomentOfInertia => oblique,
            key if key == torque_arm => oblique,
            key if key == kinematic_arm => self.reference() == Reference::Twin,
            _ => false,
        }
    }

    fn workloads(&self) -> Vec<Workload<ImpactRun>> {
        let own = Workload {
            code: self.code.name().clone(),
            tasks: self.runs.to_vec(),
        };
        let twin = (self.reference() == Reference::Twin).then(|| Workload {
            code: Code::native(),
            tasks: self.twin(),
        });
        std::iter::once(own).chain(twin).collect()
    }

    fn evaluate(&self, runs: Vec<Vec<ImpactReading>>) -> Evaluation<Option<ImpactFinding>> {
        let mut runs = runs.into_iter().map(|own| rebounds(&own));
        let (own, twin) = (runs.next().flatten(), runs.next());
        let mut grounds = Grounds::new();
        let Some(own) = own else {
            let note = "the bodies do not touch, or still touch after one and a half times the exact duration";
            grounds.add(Ground::Violation(note.to_owned()));
            return Evaluation {
                finding: None,
                grounds,
            };
        };
        let finding = self.finding(&own, twin.flatten().as_ref());
        match &finding {
            Some(finding) => {
                let uncertainty = finding.budget.total();
                let (quantity, exact) = (self.quantity.as_str(), finding.exact);
                let note = format!(
                    "{quantity} is {:.9}, and must be {exact:.9} {}",
                    finding.measured,
                    self.quantity.unit()
                );
                let allowed = tolerance(uncertainty, MAX_TOLERANCE);
                grounds.compare(finding.error, uncertainty, allowed, Some(note));
            }
            None => grounds.add(Ground::Undecidable(
                "the exact value could not be computed".to_owned(),
            )),
        }
        Evaluation { finding, grounds }
    }
}

/// Returns the rebounds of all runs; `None` if one is missing.
fn rebounds(runs: &[ImpactReading]) -> Option<[Rebound; 4]> {
    let all: Option<Vec<Rebound>> = runs.iter().map(|run| run.rebound).collect();
    all?.try_into().ok()
}

impl ImpactQuantity {
    fn of(self, rebound: &Rebound) -> f64 {
        match self {
            Self::GreatestOverlap => rebound.greatest_overlap,
            Self::Duration => rebound.duration,
            Self::Restitution => rebound.restitution,
            Self::TangentialVelocity => rebound.tangential_velocity,
            Self::Spin => rebound.spin,
        }
    }
}

impl ImpactStudy {
    fn finding(&self, own: &[Rebound; 4], twin: Option<&[Rebound; 4]>) -> Option<ImpactFinding> {
        let law = self.impact.law();
        let damping = self.is_damped().then(|| damping_exponent(&law));
        let orders = orders(law.power.value(), damping);
        let values = own.map(|rebound| self.quantity.of(&rebound));
        let measured = extrapolate(values, orders);
        let twin = twin.map(|twin| twin.map(|rebound| self.quantity.of(&rebound)));
        let (exact, difference) = match twin {
            Some(twin) => {
                let differences = std::array::from_fn(|run| values[run] - twin[run]);
                let exact = extrapolate(twin, orders).value;
                (exact, extrapolate(differences, orders))
            }
            None => {
                let exact = self.exact()?;
                let differences = values.map(|value| value - exact);
                (exact, extrapolate(differences, orders))
            }
        };
        Some(ImpactFinding {
            measured: measured.value,
            exact,
            error: difference.value / exact,
            budget: ImpactBudget {
                time_step: (difference.last_change / exact).abs(),
                sign_change: match twin {
                    // Code and twin have the same kink.
                    Some(_) => 0.0,
                    None => self.sign_change(weights(orders)),
                },
                round_off: self.round_off(weights(orders), exact),
                print_precision: self.print_precision(own, weights(orders), exact),
                convention: self.convention(),
            },
        })
    }

    /// Returns the exact value; `None` if the equations cannot be integrated.
    pub fn exact(&self) -> Option<f64> {
        let normal = &self.normal;
        Some(match self.quantity {
            ImpactQuantity::GreatestOverlap => normal.greatest_overlap,
            ImpactQuantity::Duration => normal.duration,
            ImpactQuantity::Restitution => normal.restitution,
            ImpactQuantity::TangentialVelocity => sliding_change(&self.impact)?.tangential_velocity,
            ImpactQuantity::Spin => sliding_change(&self.impact)?.spin,
        })
    }

    /// Bounds the effect of the kink of |N|. In the step of length h that contains it, the midpoint rule is wrong by
    /// up to h² |dN/dt|/6, beyond what depends smoothly on h: the factor of h² |dN/dt| is (1/2 − u)² − 1/12 for a
    /// kink at the distance u h from the middle of the step, at most 1/4 − 1/12.
    fn sign_change(&self, weights: [f64; 4]) -> f64 {
        if !self.quantity.is_oblique() {
            return 0.0;
        }
        let mass = self.impact.target.effective_mass();
        let in_units = self.normal.slope_at_sign_change / (6.0 * mass * self.normal.total_impulse);
        let squares = self
            .runs
            .iter()
            .map(|run| run.test.time_step * run.test.time_step);
        let amplified = weights.iter().zip(squares);
        in_units
            * amplified
                .map(|(own, square)| own.abs() * square)
                .sum::<f64>()
    }

    /// Returns the factor by which the number amplifies a relative error of coordinates or velocities.
    fn amplification(&self, exact: f64) -> f64 {
        let of_overlap = 2.0 * LARGEST_COORDINATE / self.normal.greatest_overlap;
        match self.quantity.is_oblique() {
            true => of_overlap.max(2.0 * self.impact.sliding_speed / exact.abs()),
            false => of_overlap,
        }
    }

    /// Returns the uncertainty from measured arms and inertia. A torque with the arm R = r + r₁ δ changes the spin in
    /// proportion to R over the inertia.
    fn convention(&self) -> f64 {
        if self.quantity != ImpactQuantity::Spin {
            return 0.0;
        }
        let settled = self.code.settled();
        let arms = settled.arm_uncertainty;
        let arm = match self.impact.target {
            ImpactTarget::Pair => arms.pair.torque,
            ImpactTarget::Floor => arms.floor.torque,
        };
        let inertia = settled.inertia_uncertainty / self.impact.convention.moment_of_inertia;
        arm * self.normal.greatest_overlap + inertia
    }

    fn round_off(&self, weights: [f64; 4], exact: f64) -> f64 {
        let per_step = ROUNDING * f64::EPSILON * self.amplification(exact);
        let walks = DIVISIONS.map(|division| f64::from(division).sqrt());
        let walks = weights.iter().zip(walks);
        per_step * walks.map(|(own, walk)| own.abs() * walk).sum::<f64>()
    }

    fn print_precision(&self, own: &[Rebound; 4], weights: [f64; 4], exact: f64) -> f64 {
        let printed = weights.iter().zip(own).map(|(weight, rebound)| {
            let last_place = libm::exp10(1.0 - f64::from(rebound.digits.min(ALL_DIGITS)));
            weight.abs() * 0.5 * last_place
        });
        printed.sum::<f64>() * self.amplification(exact)
    }
}
