//! What is kept of a run whose series is not kept.

use super::{Mechanics, RigidReading, Series, YieldEstimates};
use crate::model::{Case, Preparation};

/// The yield force of a run by both estimators, with further data for a verdict.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// The yield force by both estimators.
    pub estimates: YieldEstimates,
    /// Wall force at the end, in m g.
    pub last_force: f64,
    /// c between the bottom cylinders at the start of the compression, without damping, in m g.
    pub contact_force: Option<f64>,
    /// x₂, y₁ and y₂ at the start of the compression, in r.
    pub start: Option<[f64; 3]>,
    /// The largest deviation from each law of mechanics; empty where bodies are rigid.
    pub mechanics: Mechanics,
    /// What the series of a rigid stack shows.
    pub rigid: Option<RigidReading>,
}

impl Summary {
    /// Reads the summary from the `series` of `case`.
    pub fn read(series: &Series, case: &Case) -> Self {
        let stack = &case.stack;
        let law = case.convention.law(stack.stiffness_ratio);
        let samples = series.samples();
        let (first, last) = (samples.first(), samples.last());
        Self {
            estimates: YieldEstimates::read(series, case),
            last_force: last.map_or(0.0, |sample| sample.wall_force * stack.stiffness),
            contact_force: first
                .map(|sample| law.force(sample.bottom_overlap(stack)) * stack.stiffness)
                .filter(|force| !force.is_nan()),
            start: first
                .map(|sample| {
                    let contact = sample.first(stack);
                    [contact.outwards, sample.top(stack)[1], contact.height]
                })
                .filter(|start| !start.iter().any(|place| place.is_nan())),
            mechanics: match case.protocol.preparation {
                Preparation::Rigid => Mechanics::default(),
                _ => Mechanics::read(series, case),
            },
            rigid: RigidReading::read(series, case),
        }
    }
}
