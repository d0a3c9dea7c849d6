//! The stacks whose limits are test vectors.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tristack::model::{Arms, CRITICAL_FRICTION, ContactArms, ContactConvention, Stack};

/// The stack.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Input {
    /// Friction of the floor.
    mu: f64,
    /// 1/ε = k_n r/(m g).
    stiffness: f64,
    /// k_n/k_t.
    kappa: f64,
    /// Friction between the cylinders.
    mu_d: f64,
    /// Contacts of two cylinders.
    pair: OneArm,
    /// Contacts with the floor.
    floor: OneArm,
}

/// Arm coefficients r₁ of a contact: arms are r + r₁ δ at the overlap δ.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OneArm {
    /// r₁ of the torque of the tangential force.
    torque_arm: f64,
    /// r₁ of the surface velocity, which stretches the tangential spring.
    kinematic_arm: f64,
}

/// (torque arm, kinematic arm) of pairs and of the floor in the paper.
const PAPER: [(f64, f64); 2] = [(0.0, 0.0); 2];

impl Input {
    /// (torque arm, kinematic arm) of pairs and of the floor.
    fn new(mu: f64, stiffness: f64, kappa: f64, mu_d: f64, arms: [(f64, f64); 2]) -> Self {
        let [pair, floor] = arms.map(|(torque_arm, kinematic_arm)| OneArm {
            torque_arm,
            kinematic_arm,
        });
        Self {
            mu,
            stiffness,
            kappa,
            mu_d,
            pair,
            floor,
        }
    }

    pub fn stack(&self) -> Stack {
        Stack {
            cylinder_friction: self.mu_d,
            stiffness_ratio: self.kappa,
            ..Stack::paper(self.mu, self.stiffness)
        }
    }

    pub fn convention(&self) -> ContactConvention {
        let [pair, floor] = [&self.pair, &self.floor].map(|arms| ContactArms {
            torque: arms.torque_arm,
            kinematic: arms.kinematic_arm,
        });
        ContactConvention::with_arms(Arms { pair, floor })
    }

    pub fn id(&self) -> String {
        let mut id = format!("mu {}, stiffness {}", self.mu, self.stiffness);
        let paper = Stack::paper(self.mu, self.stiffness);
        if self.kappa != paper.stiffness_ratio {
            id += &format!(", kappa {}", self.kappa);
        }
        if self.mu_d != paper.cylinder_friction {
            id += &format!(", mu_d {}", self.mu_d);
        }
        for (name, arms) in [("pair", &self.pair), ("floor", &self.floor)] {
            if (arms.torque_arm, arms.kinematic_arm) != (0.0, 0.0) {
                id += &format!(", {name} {}/{}", arms.torque_arm, arms.kinematic_arm);
            }
        }
        id
    }
}

/// The stacks: over μ, stiffness, κ (below 1.077 the bottom cylinders touch), μ_d, and arms.
pub fn inputs() -> Vec<Input> {
    let mut inputs = Vec::new();
    let mut over = |kappas: &[f64], stiffnesses: &[f64], arms: &[[(f64, f64); 2]], mus: &[f64]| {
        for &kappa in kappas {
            for &stiffness in stiffnesses {
                for &arms in arms {
                    let stacks = mus
                        .iter()
                        .map(|&mu| Input::new(mu, stiffness, kappa, 0.7, arms));
                    inputs.extend(stacks);
                }
            }
        }
    };
    let mus = [0.12, 0.2, 0.25, CRITICAL_FRICTION, 0.3, 0.4, 0.5];
    over(&[2.5], &[10.0, 1e2, 1e3, 1e4, 1e6], &[PAPER], &mus);
    over(
        &[1.1, 1.5, 5.0, 10.0],
        &[1e2, 1e4],
        &[PAPER],
        &[0.2, 0.3, 0.5],
    );
    over(
        &[0.3, 0.6, 1.0],
        &[1e2, 1e4],
        &[PAPER],
        &[0.2, 0.25, 0.3, 0.35],
    );
    let reciprocal = [(-0.5, -0.5), (-0.5, -1.0), (0.0, -0.5), (-1.0, 0.0)];
    let reciprocal = reciprocal.map(|(pair, floor)| [(pair, pair), (floor, floor)]);
    over(
        &[2.5],
        &[1e2, 1e4],
        &reciprocal,
        &[0.2, CRITICAL_FRICTION, 0.3, 0.5],
    );
    let separate = [
        [(-0.5, 0.0), (0.0, 0.0)],
        [(0.0, -0.5), (0.0, 0.0)],
        [(0.0, 0.0), (-0.5, 0.0)],
        [(0.0, 0.0), (0.0, -0.5)],
        [(-0.5, 0.25), (-1.0, -0.5)],
    ];
    over(&[2.5], &[1e2], &separate, &[0.2, 0.3]);
    over(
        &[0.6],
        &[1e2],
        &[reciprocal[0], reciprocal[1], separate[0]],
        &[0.2, 0.3],
    );
    for (mu, stiffness, kappa, mu_d) in [
        // Friction between the cylinders: enough, and not.
        (0.3, 1e2, 2.5, 1.0),
        (0.3, 1e2, 2.5, 0.3),
        (0.5, 1e2, 2.5, 0.4),
        (0.5, 1e4, 2.5, 0.4),
        // The stack slides under its own weight, or the wall arrives first.
        (0.05, 1e2, 2.5, 0.7),
        (0.6, 1e2, 2.5, 0.7),
        // It slides under its own weight and stands all the same; it has an onset, but no peak.
        (0.12, 1e2, 0.3, 0.7),
        (0.4, 1e2, 0.6, 0.7),
    ] {
        inputs.push(Input::new(mu, stiffness, kappa, mu_d, PAPER));
    }
    inputs
}
