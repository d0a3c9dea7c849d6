//! A micro-test: one contact, set in motion and left alone.

use super::ContactConvention;
use serde::{Deserialize, Serialize};

/// State of a cylinder at the start of a micro-test. Lengths in r, speeds in r √(k_n/m).
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

/// Further initial values of a sphere in a micro-test in space, beyond those of a cylinder.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MotionInSpace {
    /// Position of the centre along z; x, y and z are right-handed.
    pub z: f64,
    /// Velocity along z.
    pub vz: f64,
    /// Angular velocity about x.
    pub spinx: f64,
    /// Angular velocity about y.
    pub spiny: f64,
}

/// Prescribed motion of cylinder 1: four legs with the same number of steps, without rotation. The other cylinder is
/// held.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Drive {
    /// Number of steps of a leg.
    pub leg_steps: u64,
    /// Velocity of each leg.
    pub legs: [[f64; 2]; 4],
}

/// Two cylinders above the floor and below the top wall, without gravity, for a number of steps. They move freely
/// unless they are driven. They are placed so that one contact is closed: with the floor, with the wall, or with each
/// other.
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
    /// Initial state of each cylinder.
    pub initial_motions: [InitialMotion; 2],
    /// Prescribed motion of cylinder 1; without it, both move freely.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drive: Option<Drive>,
    /// Further initial values of spheres, which move in space; without them, cylinders move in the plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub space: Option<[MotionInSpace; 2]>,
}

impl Drive {
    /// Returns the distance from the start at a step, and the velocity in the step that leads to it (zero at step 0).
    pub fn motion_at(&self, step: u64, time_step: f64) -> [[f64; 2]; 2] {
        let (mut distance, mut velocity) = ([0.0; 2], [0.0; 2]);
        for (leg, own) in (0..).zip(&self.legs) {
            let before = leg * self.leg_steps;
            let made = step.saturating_sub(before).min(self.leg_steps) as f64;
            let is_on_it = (before + 1..=before + self.leg_steps).contains(&step);
            for axis in 0..2 {
                distance[axis] += made * own[axis] * time_step;
                if is_on_it {
                    velocity[axis] = own[axis];
                }
            }
        }
        [distance, velocity]
    }
}

impl ContactTest {
    /// Height of the top wall at a step.
    pub fn wall_height_at(&self, step: u64) -> f64 {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drive_makes_one_leg_after_the_other_and_rests_before_and_after() {
        let drive = Drive {
            leg_steps: 2,
            legs: [[1.0, 0.5], [0.0, -2.0], [-1.0, 0.0], [0.0, 4.0]],
        };
        let at = |step: u64| drive.motion_at(step, 0.5);
        assert_eq!(at(0), [[0.0; 2]; 2]);
        assert_eq!(at(1), [[0.5, 0.25], [1.0, 0.5]]);
        assert_eq!(at(2), [[1.0, 0.5], [1.0, 0.5]]);
        assert_eq!(at(3), [[1.0, -0.5], [0.0, -2.0]]);
        assert_eq!(at(5), [[0.5, -1.5], [-1.0, 0.0]]);
        assert_eq!(at(8), [[0.0, 2.5], [0.0, 4.0]]);
        assert_eq!(at(9), [[0.0, 2.5], [0.0; 2]]);
    }
}
