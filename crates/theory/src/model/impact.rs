//! An impact: a cylinder strikes another one, or the floor, without gravity.

use super::{ContactArms, ContactConvention, ContactLaw, ContactTest, InitialMotion};
use serde::{Deserialize, Serialize};

/// What a cylinder strikes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ImpactTarget {
    /// An equal cylinder, which moves towards it.
    Pair,
    /// The floor.
    Floor,
}

impl ImpactTarget {
    /// Every target.
    pub const ALL: [Self; 2] = [Self::Pair, Self::Floor];

    /// The name in tables.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Pair => "pair",
            Self::Floor => "floor",
        }
    }

    /// Mass in the equation of the relative motion: that of one cylinder at the floor, half of it in a pair.
    pub fn effective_mass(self) -> f64 {
        match self {
            Self::Pair => 0.5,
            Self::Floor => 1.0,
        }
    }

    /// Returns the law of the contact under `convention`, where κ is the stiffness ratio of pairs.
    pub fn law(self, convention: &ContactConvention, stiffness_ratio: f64) -> ContactLaw {
        match self {
            Self::Pair => convention.law(stiffness_ratio),
            Self::Floor => convention.wall_law(stiffness_ratio),
        }
    }

    /// Returns the arms of the contact under `convention`.
    pub fn arms(self, convention: &ContactConvention) -> ContactArms {
        match self {
            Self::Pair => convention.arms.pair,
            Self::Floor => convention.arms.floor,
        }
    }
}

/// Direction of the line between the cylinders of a pair, not along an axis.
const PAIR_ANGLE: f64 = 0.4;
/// Midpoint of a pair, far above the floor.
const PAIR_CENTRE: [f64; 2] = [0.0, 2.3];
/// Height of the top wall, which no cylinder reaches.
const WALL_HEIGHT: f64 = 4.5;
/// Where the second cylinder rests while the first strikes the floor.
const BESIDE: [f64; 2] = [-6.0, 2.0];

/// An impact. Lengths in r, speeds in r √(k_n/m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impact {
    /// What the first cylinder strikes.
    pub target: ImpactTarget,
    /// The contact convention.
    pub convention: ContactConvention,
    /// Stiffness ratio κ = k_n/k_t of pairs.
    pub stiffness_ratio: f64,
    /// Friction coefficient of the contact.
    pub friction: f64,
    /// Speed at which the bodies approach each other.
    pub approach_speed: f64,
    /// Speed at which the surfaces slide on each other: that of the cylinder along the floor, or the sum of the two
    /// equal surface speeds of a spinning pair.
    pub sliding_speed: f64,
}

impl Impact {
    /// The law of the contact.
    pub fn law(&self) -> ContactLaw {
        self.target.law(&self.convention, self.stiffness_ratio)
    }

    /// Returns the impact as a micro-test of `steps` steps, under a `convention` that a code accepts. The bodies touch
    /// half a step after its start.
    pub fn test(&self, convention: ContactConvention, time_step: f64, steps: u64) -> ContactTest {
        let gap = 0.5 * time_step * self.approach_speed;
        let initial_motions = match self.target {
            ImpactTarget::Floor => self.above_the_floor(gap),
            ImpactTarget::Pair => self.apart(gap),
        };
        ContactTest {
            convention,
            stiffness_ratio: self.stiffness_ratio,
            floor_friction: self.friction,
            cylinder_friction: self.friction,
            time_step,
            steps,
            wall_height: WALL_HEIGHT,
            wall_speed: 0.0,
            initial_motions,
            drive: None,
            space: None,
        }
    }

    fn above_the_floor(&self, gap: f64) -> [InitialMotion; 2] {
        let striking = InitialMotion {
            vx: self.sliding_speed,
            vy: -self.approach_speed,
            ..InitialMotion::at(0.0, 1.0 + gap)
        };
        [striking, InitialMotion::at(BESIDE[0], BESIDE[1])]
    }

    fn apart(&self, gap: f64) -> [InitialMotion; 2] {
        let normal = [libm::sin(PAIR_ANGLE), libm::cos(PAIR_ANGLE)];
        let (distance, speed) = (1.0 + 0.5 * gap, 0.5 * self.approach_speed);
        [1.0, -1.0].map(|side| InitialMotion {
            x: PAIR_CENTRE[0] + side * distance * normal[0],
            y: PAIR_CENTRE[1] + side * distance * normal[1],
            vx: -side * speed * normal[0],
            vy: -side * speed * normal[1],
            spin: 0.5 * self.sliding_speed,
        })
    }
}
