//! Profiles: the stacks that a crosscheck covers, and how each is measured.

use super::plan::{Measurement, plan, plan_literal};
use super::rigid::plan_rigid;
use super::runs::Method;
use crate::code::{Code, SettledCode};
use crate::model::{CRITICAL_FRICTION, PAPER_BODIES, Power, Stack};

/// Stiffnesses 1/ε of the paper (supplement I.A).
pub const PAPER_STIFFNESSES: [f64; 3] = [1e2, 1e3, 1e4];

/// Frictions of the quick profile.
const QUICK_FRICTIONS: [f64; 6] = [0.12, 0.2, 0.25, CRITICAL_FRICTION, 0.3, 0.4];

/// Frictions of spheres in units of the critical one: from well above what the own weight of a stack of three needs,
/// to below those at which that stack loses its symmetry before it yields with the arms of most codes.
const SPHERE_FRICTIONS: [f64; 6] = [0.45, 0.6, 0.75, 0.93, 1.0, 1.1];

/// Frictions of the paper's Fig. 2(a), from a little above what the stack's own weight needs to a little below wall
/// contact, closer around the critical one.
const FIGURE_FRICTIONS: [f64; 25] = [
    0.1,
    0.12,
    0.14,
    0.16,
    0.18,
    0.2,
    0.21,
    0.22,
    0.23,
    0.24,
    0.25,
    0.26,
    CRITICAL_FRICTION,
    0.275,
    0.28,
    0.29,
    0.3,
    0.32,
    0.34,
    0.36,
    0.38,
    0.4,
    0.43,
    0.46,
    0.5,
];

/// Floor friction and stiffness at which codes other than native run the paper's literal settings: those of its own
/// convergence figure (supplement I.C).
const LITERAL_STACK: (f64, f64) = (0.2, 1e4);

/// The stacks that a crosscheck covers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Profile {
    /// Six frictions around the critical one at three stiffnesses.
    Quick,
    /// The paper's figure 2(a): 25 frictions at its three stiffnesses.
    Standard,
    /// The same stacks, measured as the paper did, by the peak at wall speed 1e-6 and time step 1e-3; external codes
    /// at mu = 0.2, stiffness 1e4 alone.
    Paper,
    /// The same with all stacks for every code: days of one core for an external one (docs/cluster.md).
    Literal,
}

/// A seed that nobody can know before.
pub fn new_seed() -> u32 {
    fastrand::u32(..)
}

impl Profile {
    /// The stacks with this many bodies on the floor, stiffness by stiffness. Laws other than the paper's have those
    /// of the quick profile, and spheres its frictions in units of the critical one.
    pub fn stacks(self, power: Power, bodies: u8) -> Vec<Stack> {
        let of = |floor_friction, stiffness| Stack {
            stiffness_ratio: Stack::usual_stiffness_ratio(power),
            bodies,
            ..Stack::paper(floor_friction, stiffness)
        };
        let critical = of(f64::NAN, f64::NAN).ring().critical_friction;
        let frictions: Vec<f64> = match (self, power, bodies) {
            (Self::Standard | Self::Paper | Self::Literal, Power::Linear, PAPER_BODIES) => {
                FIGURE_FRICTIONS.to_vec()
            }
            (.., PAPER_BODIES) => QUICK_FRICTIONS.to_vec(),
            _ => SPHERE_FRICTIONS.map(|part| critical * part).to_vec(),
        };
        let rows = PAPER_STIFFNESSES.into_iter();
        rows.flat_map(|stiffness| frictions.iter().map(move |&mu| of(mu, stiffness)))
            .collect()
    }

    /// Stacks between those of the profile, drawn at random, the same for the same `seed`: frictions evenly, to four
    /// decimals, and stiffnesses by their logarithms, to three digits, as people type them.
    pub fn drawn(self, (count, seed): (usize, u32), power: Power, bodies: u8) -> Vec<Stack> {
        let stacks = self.stacks(power, bodies);
        let bounds = |value: fn(&Stack) -> f64| {
            let values = stacks.iter().map(value);
            values.fold((f64::INFINITY, 0.0), |(least, most): (f64, f64), own| {
                (least.min(own), most.max(own))
            })
        };
        let frictions = bounds(|stack| stack.floor_friction);
        let stiffnesses = bounds(|stack| stack.stiffness);
        let mut random = fastrand::Rng::with_seed(seed.into());
        let mut between = |(least, most): (f64, f64)| least + (most - least) * random.f64();
        let typed = |text: String| text.parse().unwrap_or(f64::NAN);
        let draw = |_| Stack {
            floor_friction: typed(format!("{:.4}", between(frictions))),
            stiffness: {
                let (least, most) = stiffnesses;
                let power = between((libm::log10(least), libm::log10(most)));
                typed(format!("{:.2e}", libm::exp10(power)))
            },
            ..stacks[0]
        };
        (0..count).map(draw).collect()
    }

    /// The measurements of all stacks of the profile by each of the `codes`, stack by stack.
    pub fn measurements(self, codes: &[SettledCode]) -> Vec<Measurement> {
        let power = Power::Linear;
        self.measurements_of(&self.stacks(power, PAPER_BODIES), codes, power)
    }

    /// The measurement of `stack` by `code` with the method of the profile, under a law of this power.
    pub fn measurement(self, code: &SettledCode, stack: &Stack, power: Power) -> Measurement {
        if code.name().is_rigid() {
            return plan_rigid(code, stack);
        }
        let convention = code.stack_convention(power, stack.bodies);
        match self {
            Self::Quick | Self::Standard => plan(code, stack, convention),
            Self::Paper | Self::Literal => plan_literal(code, stack, convention),
        }
    }

    /// The measurements of other `stacks` with the method of the profile, under a law of this power.
    pub fn measurements_of(
        self,
        stacks: &[Stack],
        codes: &[SettledCode],
        power: Power,
    ) -> Vec<Measurement> {
        let mut measurements: Vec<Measurement> = Vec::new();
        for &stack in stacks {
            for code in codes {
                // Rigid stacks of any stiffness are the same.
                let is_known = |own: &Measurement| {
                    let frictions = |of: &Stack| [of.floor_friction, of.cylinder_friction];
                    own.method == Method::Rigid
                        && own.code.name() == code.name()
                        && frictions(&own.stack) == frictions(&stack)
                };
                if code.name().is_rigid() && measurements.iter().any(is_known) {
                    continue;
                }
                if self != Self::Paper || is_run_literally(code.name(), &stack) {
                    measurements.push(self.measurement(code, &stack, power));
                }
            }
        }
        measurements
    }
}

fn is_run_literally(code: &Code, stack: &Stack) -> bool {
    code.is_native() || (stack.floor_friction, stack.stiffness) == LITERAL_STACK
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_stack_of_the_figure_yields_for_every_code_and_every_case_is_valid() {
        for profile in [Profile::Standard, Profile::Paper, Profile::Literal] {
            for measurement in profile.measurements(&SettledCode::with_power(Power::Linear)) {
                assert!(!measurement.cases.is_empty(), "{:?}", measurement.stack);
                for case in &measurement.cases {
                    case.validate().unwrap();
                }
            }
        }
    }

    #[test]
    fn the_paper_profile_has_one_literal_point_for_every_external_code() {
        let measurements = Profile::Paper.measurements(&SettledCode::with_power(Power::Linear));
        let literal = |code| {
            let own = measurements
                .iter()
                .filter(move |row| *row.code.name() == code);
            own.filter(|row| row.method == Method::Literal).count()
        };
        assert_eq!(literal(Code::native()), 75);
        assert_eq!(literal(Code::named("lammps").unwrap()), 1);
        assert_eq!(
            measurements.len(),
            75 + Code::with_power(Power::Linear).len() - 1
        );
    }
}
