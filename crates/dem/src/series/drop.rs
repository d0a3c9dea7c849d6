//! The drop of the wall force after its peak.

/// Least number of rows after the largest force, to distinguish a peak from a wiggle.
const ROWS_SINCE_PEAK: usize = 5;

/// Watches the wall force row by row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DropWatch {
    part: f64,
    highest: f64,
    rows_since: usize,
}

impl DropWatch {
    /// A watch for a drop by `part` of the largest force; 0 for none.
    pub fn new(part: f64) -> Self {
        Self {
            part,
            highest: f64::NEG_INFINITY,
            rows_since: 0,
        }
    }

    /// Adds the force of the next row; returns true once the force has dropped.
    pub(crate) fn has_dropped(&mut self, force: f64) -> bool {
        if force > self.highest {
            self.highest = force;
            self.rows_since = 0;
        }
        self.rows_since += 1;
        let enough_rows = self.rows_since > ROWS_SINCE_PEAK;
        self.part > 0.0 && enough_rows && force < (1.0 - self.part) * self.highest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows_until_drop(part: f64, forces: &[f64]) -> Option<usize> {
        let mut watch = DropWatch::new(part);
        forces.iter().position(|&force| watch.has_dropped(force))
    }

    #[test]
    fn a_drop_counts_once_the_peak_lies_some_rows_back() {
        let forces = [1.0, 2.0, 3.0, 2.0, 2.9, 2.9, 2.9, 2.9, 2.8, 1.0];
        assert_eq!(rows_until_drop(0.05, &forces), Some(8));
        assert_eq!(rows_until_drop(0.02, &forces), Some(7));
        assert_eq!(rows_until_drop(0.0, &forces), None);
    }
}
