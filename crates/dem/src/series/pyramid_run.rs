//! The result of a pyramid run.

use super::SeriesError;

/// Final positions of the cylinders of a pyramid, and the run time of the timed steps.
#[derive(Debug, Clone, PartialEq)]
pub struct PyramidRun {
    centres: Vec<[f64; 2]>,
    timed_seconds: f64,
}

impl PyramidRun {
    /// A run with the final `centres` (in r, in the order of [`Pyramid::centres`](crate::model::Pyramid::centres)),
    /// whose last steps took `timed_seconds` of wall-clock time.
    ///
    /// # Errors
    /// If there are not `count` cylinders, something is not finite, or the time is negative.
    pub fn new(
        centres: Vec<[f64; 2]>,
        timed_seconds: f64,
        count: usize,
    ) -> Result<Self, SeriesError> {
        let (found, expected) = (centres.len(), count);
        if found != expected {
            return Err(SeriesError::Truncated { found, expected });
        }
        let finite = |centre: &[f64; 2]| centre.iter().all(|coordinate| coordinate.is_finite());
        if let Some(index) = centres.iter().position(|centre| !finite(centre)) {
            let message = format!("the centre is {:?}", centres[index]);
            return Err(SeriesError::garbled(index + 1, message));
        }
        if !(timed_seconds.is_finite() && timed_seconds >= 0.0) {
            let message = format!("the timed steps took {timed_seconds} seconds");
            return Err(SeriesError::absent(message));
        }
        Ok(Self {
            centres,
            timed_seconds,
        })
    }

    /// Centres of the cylinders, in r.
    pub fn centres(&self) -> &[[f64; 2]] {
        &self.centres
    }

    /// Wall-clock time of the timed steps alone, in seconds.
    pub fn timed_seconds(&self) -> f64 {
        self.timed_seconds
    }
}
