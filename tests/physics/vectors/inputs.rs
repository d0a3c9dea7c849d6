//! The stacks whose limits are test vectors.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tristack::model::{
    Arms, CRITICAL_FRICTION, ContactArms, ContactConvention, HistoryUpdate, Stack,
};

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
    /// What becomes of the tangential spring 1–2 as its contact turns: it turns with it (`rotated`), or it is a vector
    /// that nothing turns (`fixed`).
    pub history_update: HistoryUpdate,
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
/// The same where both are half the overlap, or all of it at the floor.
const RECIPROCAL: [[(f64, f64); 2]; 4] = [
    [(-0.5, -0.5), (-0.5, -0.5)],
    [(-0.5, -0.5), (-1.0, -1.0)],
    [(0.0, 0.0), (-0.5, -0.5)],
    [(-1.0, -1.0), (0.0, 0.0)],
];
/// The same where torque arms and kinematic arms differ.
const SEPARATE: [[(f64, f64); 2]; 5] = [
    [(-0.5, 0.0), (0.0, 0.0)],
    [(0.0, -0.5), (0.0, 0.0)],
    [(0.0, 0.0), (-0.5, 0.0)],
    [(0.0, 0.0), (0.0, -0.5)],
    [(-0.5, 0.25), (-1.0, -0.5)],
];

impl Input {
    /// (torque arm, kinematic arm) of pairs and of the floor; the spring turns.
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
            history_update: HistoryUpdate::Rotated,
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
        ContactConvention {
            history_update: self.history_update,
            ..ContactConvention::with_arms(Arms { pair, floor })
        }
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
        if self.history_update == HistoryUpdate::Fixed {
            id += ", fixed";
        }
        id
    }
}

/// All stacks of some κ, stiffnesses, arms and μ.
fn over(kappas: &[f64], stiffnesses: &[f64], arms: &[[(f64, f64); 2]], mus: &[f64]) -> Vec<Input> {
    let mut inputs = Vec::new();
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
    inputs
}

/// The stacks, with springs that turn and with springs that nothing turns.
pub fn inputs() -> Vec<Input> {
    let fixed = not_turned().into_iter().map(|input| Input {
        history_update: HistoryUpdate::Fixed,
        ..input
    });
    turned().into_iter().chain(fixed).collect()
}

const MUS: [f64; 7] = [0.12, 0.2, 0.25, CRITICAL_FRICTION, 0.3, 0.4, 0.5];

/// Over μ, stiffness, κ (below 1.077 the bottom cylinders touch), μ_d, and arms.
fn turned() -> Vec<Input> {
    let [both, all_of_floor, ..] = RECIPROCAL;
    let mut inputs = [
        over(&[2.5], &[10.0, 1e2, 1e3, 1e4, 1e6], &[PAPER], &MUS),
        over(
            &[1.1, 1.5, 5.0, 10.0],
            &[1e2, 1e4],
            &[PAPER],
            &[0.2, 0.3, 0.5],
        ),
        over(
            &[0.3, 0.6, 1.0],
            &[1e2, 1e4],
            &[PAPER],
            &[0.2, 0.25, 0.3, 0.35],
        ),
        over(
            &[2.5],
            &[1e2, 1e4],
            &RECIPROCAL,
            &[0.2, CRITICAL_FRICTION, 0.3, 0.5],
        ),
        over(&[2.5], &[1e2], &SEPARATE, &[0.2, 0.3]),
        over(
            &[0.6],
            &[1e2],
            &[both, all_of_floor, SEPARATE[0]],
            &[0.2, 0.3],
        ),
    ]
    .concat();
    inputs.extend(special());
    inputs
}

/// A part of these: nothing but the contact 1–2 differs, and that the more the further it turns.
fn not_turned() -> Vec<Input> {
    let [both, all_of_floor, ..] = RECIPROCAL;
    let mut inputs = [
        over(&[2.5], &[1e2, 1e3, 1e4, 1e6], &[PAPER], &MUS),
        over(&[1.5, 5.0], &[1e2, 1e4], &[PAPER], &[0.2, 0.3]),
        over(&[0.6], &[1e2, 1e4], &[PAPER], &[0.2, 0.3, 0.35]),
        over(&[1.0], &[1e2], &[PAPER], &[0.25]),
        over(&[2.5], &[1e2], &[both, all_of_floor], &[0.2, 0.3]),
        over(&[2.5], &[1e2], &SEPARATE, &[0.3]),
        over(&[0.6], &[1e2], &[both, SEPARATE[4]], &[0.3]),
    ]
    .concat();
    inputs.extend(special());
    inputs
}

/// Stacks with other events and ends.
fn special() -> Vec<Input> {
    let stacks = [
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
    ];
    let input = |(mu, stiffness, kappa, mu_d)| Input::new(mu, stiffness, kappa, mu_d, PAPER);
    stacks.map(input).to_vec()
}
