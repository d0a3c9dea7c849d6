//! Every theory for one stack, side by side.

use super::{
    ElasticRoot, Limit, RigidYield, elastic_root, naive_load, perturbation_load, quasistatic_limit,
    rigid_yield,
};
use crate::model::{ContactConvention, Stack};

/// The yield force according to one theory, or the reason why it has none.
#[derive(Debug, Clone, PartialEq)]
pub struct Prediction {
    /// F = f/(m g).
    pub yield_force: Option<f64>,
    /// Why there is none.
    pub reason: Option<&'static str>,
}

impl Prediction {
    fn from_load(load: Option<f64>, reason: &'static str) -> Self {
        Self {
            yield_force: load.map(|load| load - 3.0),
            reason: load.is_none().then_some(reason),
        }
    }
}

/// The elastic equation's answer.
#[derive(Debug, Clone, PartialEq)]
pub struct ElasticPrediction {
    /// F = f/(m g).
    pub yield_force: Option<f64>,
    /// x = δ₁₁ − δ₂₁ in r.
    pub x: Option<f64>,
    /// y = δ₂₂ in r.
    pub y: Option<f64>,
    /// z = δ₂₁ in r.
    pub z: Option<f64>,
    /// θ in radians.
    pub theta: Option<f64>,
    /// Why there is no yield force.
    pub reason: Option<&'static str>,
    /// An assumption that the number contradicts.
    pub caution: Option<&'static str>,
}

impl ElasticPrediction {
    fn new(root: Option<ElasticRoot>) -> Self {
        Self {
            yield_force: root.map(|root| root.load - 3.0),
            x: root.map(|root| root.x),
            y: root.map(|root| root.y),
            z: root.map(|root| root.z),
            theta: root.map(|root| root.theta),
            reason: root
                .is_none()
                .then_some("the equation has no root z >= 3 epsilon r/2"),
            caution: root
                .filter(|root| root.y < 0.0)
                .map(|_| "y < 0: the root contradicts the assumption c = 0 behind the equation"),
        }
    }
}

/// The yield force of one stack by every theory.
#[derive(Debug, Clone, PartialEq)]
pub struct Predictions {
    /// The stack.
    pub stack: Stack,
    /// Its contacts, which concern the quasi-static limit alone.
    pub convention: ContactConvention,
    /// Rigid cylinders.
    pub rigid: RigidYield,
    /// Naive expansion.
    pub naive: Prediction,
    /// Singular perturbation.
    pub perturbation: Prediction,
    /// Elastic equation.
    pub elastic: ElasticPrediction,
    /// Exact quasi-static limit of the DEM.
    pub quasistatic: Limit,
}

impl Predictions {
    /// Every theory for `stack` under `convention`.
    pub fn new(stack: &Stack, convention: &ContactConvention) -> Self {
        Self {
            stack: *stack,
            convention: *convention,
            rigid: rigid_yield(stack.floor_friction),
            naive: Prediction::from_load(naive_load(stack), "the expansion gives F < 0"),
            perturbation: Prediction::from_load(
                perturbation_load(stack),
                "the solution is not real or gives F < 0",
            ),
            elastic: ElasticPrediction::new(elastic_root(stack)),
            quasistatic: quasistatic_limit(stack, convention),
        }
    }
}
