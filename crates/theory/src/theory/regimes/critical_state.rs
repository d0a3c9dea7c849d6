//! State of the stack at an event on its path of equilibria.

use super::super::events::Event;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Leg of the path on which an event occurs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LoadingPhase {
    /// Gravity grows; the wall does not touch yet.
    OwnWeight,
    /// The wall presses.
    Wall,
}

impl fmt::Display for LoadingPhase {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::OwnWeight => "own weight",
            Self::Wall => "wall",
        })
    }
}

/// An event on the path, and the state in which it happens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CriticalState {
    /// The event.
    pub event: Event,
    /// The leg of the path.
    pub stage: LoadingPhase,
    /// F = f/(m g); 0 under own weight.
    pub force: f64,
    /// T = tan(ψ/2).
    pub tangent: f64,
    /// z, overlap of the floor contacts, in r.
    pub floor_overlap: f64,
    /// c, force between the bottom cylinders, in k_n r.
    pub bottom_force: f64,
    /// Wall travel, in r.
    pub wall_travel: f64,
}
