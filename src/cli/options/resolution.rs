//! How coarse a yield force may be that is judged.

use super::numbers::number;
use crate::study::RESOLUTIONS;
use crate::study::yield_force::Measurement;
use clap::Args;

/// The largest uncertainty that is accepted.
#[derive(Debug, Clone, Copy, Args)]
pub(in crate::cli) struct ResolutionOptions {
    /// Accept yield forces that are known to this much of the load on the floor, F + 3 for cylinders, instead of 1e-5: codes
    /// in single precision, that print few digits or whose steps depend on the motion are judged to what they resolve. Walls of codes with positions in single
    /// precision move as fast as these need
    #[arg(long, value_name = "SHARE", value_parser = resolution)]
    resolution: Option<f64>,
}

impl ResolutionOptions {
    /// Whether more than the usual uncertainty is accepted.
    pub fn is_given(&self) -> bool {
        self.resolution.is_some()
    }

    /// Returns the measurement with what is accepted.
    pub fn accepted(&self, measurement: Measurement) -> Measurement {
        match self.resolution {
            Some(resolution) => measurement.accepting(resolution),
            None => measurement,
        }
    }
}

/// Reads a resolution.
fn resolution(text: &str) -> Result<f64, String> {
    let share = number(text)?;
    let (least, most) = RESOLUTIONS.into_inner();
    match RESOLUTIONS.contains(&share) {
        true => Ok(share),
        false => Err(format!("accepted is {least:e} to {most}")),
    }
}
