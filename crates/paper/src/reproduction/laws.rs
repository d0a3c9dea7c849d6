//! The paper's stack under other contact laws than its own.

use super::scaling::{Exponent, SCALING_STIFFNESSES, fitted_exponents};
use super::{is_same, judged};
use crate::code::SettledCode;
use crate::model::{CRITICAL_FRICTION, PAPER_BODIES, Power, Problem, Stack};
use crate::study::Campaign;
use crate::study::yield_force::{Judgement, Measurement, Profile, plan};
use crate::theory::quasistatic_limit;

/// The law that is studied beside the paper's.
const POWER: Power = Power::Hertz;
/// Intervals of the curve over the stiffness, in every decade.
const INTERVALS: u32 = 8;

/// The stack with Hertz contacts.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Laws {
    /// Yield forces of every style of every code, at the stacks of the profile that yield.
    pub yield_curves: Vec<Judgement>,
    /// Yield forces at μ_c, of one style per code.
    pub scaling: Vec<Judgement>,
    /// Their exponents.
    pub exponents: Vec<Exponent>,
    /// Stiffness and exact yield force at μ_c under the paper's arms.
    pub critical: Vec<(f64, Option<f64>)>,
}

impl Laws {
    /// Measures the yield forces with the codes of `campaign`.
    pub(super) fn new(campaign: &Campaign) -> Self {
        let [curves, scaling] = measurements(&campaign.settled());
        let mut all = curves.clone();
        let further = scaling.iter();
        all.extend(
            further
                .filter(|own| !curves.iter().any(|known| is_same(known, own)))
                .cloned(),
        );
        let judgements = campaign.carry_out(all);
        let scaling = judged(&scaling, &judgements);
        Self {
            yield_curves: judged(&curves, &judgements),
            exponents: fitted_exponents(&scaling, CRITICAL_FRICTION),
            scaling,
            critical: critical(),
        }
    }
}

/// Returns the measurements of the yield curves, and those at μ_c, of every stack that yields.
pub(super) fn measurements(codes: &[SettledCode]) -> [Vec<Measurement>; 2] {
    let curves =
        Profile::Quick.measurements_of(&Profile::Quick.stacks(POWER, PAPER_BODIES), codes, POWER);
    let stacks = SCALING_STIFFNESSES.map(critical_stack);
    let one_a_code = codes.iter().filter(|code| code.name().is_first_variant());
    let scaling = one_a_code.flat_map(|code| {
        let convention = code.stack_convention(POWER, PAPER_BODIES);
        stacks.map(|stack| plan(code, &stack, convention))
    });
    [curves, scaling.collect()].map(|mut part: Vec<Measurement>| {
        part.retain(|measurement| !measurement.cases.is_empty());
        part
    })
}

fn critical_stack(stiffness: f64) -> Stack {
    Stack {
        stiffness_ratio: Stack::usual_stiffness_ratio(POWER),
        ..Stack::paper(CRITICAL_FRICTION, stiffness)
    }
}

fn critical() -> Vec<(f64, Option<f64>)> {
    let convention = SettledCode::native().stack_convention(POWER, PAPER_BODIES);
    let (first, last) = (
        SCALING_STIFFNESSES[0],
        SCALING_STIFFNESSES[SCALING_STIFFNESSES.len() - 1],
    );
    let decades = libm::log10(last / first);
    let intervals = INTERVALS * decades as u32;
    let points = (0..=intervals).map(|index| {
        let part = f64::from(index) / f64::from(intervals);
        let stiffness = first * libm::exp10(part * decades);
        let problem = Problem::new(critical_stack(stiffness), convention).ok();
        let force = problem.and_then(|own| quasistatic_limit(&own).yield_force);
        (stiffness, force)
    });
    points.collect()
}
