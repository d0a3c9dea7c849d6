//! A micro-test: one contact, set in motion and left alone.

use super::ContactConvention;
use serde::{Deserialize, Serialize};

/// State of a cylinder when a micro-test begins. Lengths in r, speeds in r √(k_n/m).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct InitialMotion {
    /// Horizontal position of the centre.
    pub x: f64,
    /// Height of the centre above the floor.
    pub y: f64,
    /// Horizontal velocity.
    pub vx: f64,
    /// Vertical velocity.
    pub vy: f64,
    /// Angular velocity, counter-clockwise.
    pub spin: f64,
}

/// Two cylinders above the floor and below the top wall, without gravity, moving freely for some steps.
/// They are placed so that one contact is closed: with the floor, with the wall, or with each other.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ContactTest {
    /// Contact law.
    pub convention: ContactConvention,
    /// Stiffness ratio κ = k_n/k_t.
    pub stiffness_ratio: f64,
    /// Friction coefficient of the floor.
    pub floor_friction: f64,
    /// Friction coefficient between cylinders.
    pub cylinder_friction: f64,
    /// Time step.
    pub time_step: f64,
    /// Number of steps.
    pub steps: u64,
    /// Height of the top wall at step 0.
    pub wall_height: f64,
    /// Speed of the top wall, downwards.
    pub wall_speed: f64,
    /// How the two cylinders start.
    pub initial_motions: [InitialMotion; 2],
}

impl ContactTest {
    /// Height of the top wall at a step.
    pub(crate) fn wall_height_at(&self, step: u64) -> f64 {
        self.wall_height - self.wall_speed * (step as f64 * self.time_step)
    }
}

impl std::fmt::Display for ContactTest {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [first, second] = self.initial_motions;
        write!(
            formatter,
            "a micro-test with cylinders at ({}, {}) and ({}, {})",
            first.x, first.y, second.x, second.y
        )
    }
}

impl InitialMotion {
    /// A cylinder at rest at the given place.
    pub fn at(x: f64, y: f64) -> Self {
        Self {
            x,
            y,
            vx: 0.0,
            vy: 0.0,
            spin: 0.0,
        }
    }
}
