//! The stack with its contact forces, from rest into collapse.

use super::SCALING_FRICTIONS;
use crate::code::Interrupt;
use crate::dem::compress_stack_into_frames;
use crate::model::{Case, ContactConvention, Problem, Stack};
use crate::series::{Frames, SeriesError};
use crate::study::yield_force::planned_protocol;
use crate::theory::quasistatic_limit;

/// Wall speed in units of the predicted displacement.
const SPEED: f64 = 1e-3;
const TIME_STEP: f64 = 0.1;

/// A native run, frame by frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshots {
    /// The case of the run.
    pub case: Case,
    /// The sampled moments.
    pub frames: Frames,
}

/// Runs the native DEM on the softest stack of the paper above the critical friction, where displacements are
/// large enough to be seen; `None` after an interrupt.
///
/// # Errors
/// If the series is invalid, which would be an error of the native DEM.
pub fn snapshots(interrupt: &Interrupt) -> Result<Option<Snapshots>, SeriesError> {
    let stack = Stack::paper(SCALING_FRICTIONS[2], 1e2);
    let convention = ContactConvention::PAPER;
    let problem = Problem::new(stack, convention);
    let limit = quasistatic_limit(&problem.expect("a stack of the paper is in range"));
    let protocol = planned_protocol(&limit, &stack, &convention, SPEED, TIME_STEP);
    let protocol = protocol.expect("a stack that yields is planned");
    let case = Case {
        stack,
        convention,
        protocol,
    };
    let run = compress_stack_into_frames(&case, || !interrupt.requested());
    if interrupt.requested() {
        return Ok(None);
    }
    let (_, frames) = run?;
    Ok(Some(Snapshots { case, frames }))
}
