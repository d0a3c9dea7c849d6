//! Linear least squares with standard errors.

use nalgebra::{DMatrix, DVector};

/// Uncertainty in units of the standard error.
const COVERAGE: f64 = 3.0;
/// Smallest ratio of singular values of the scaled columns at which the coefficients are resolved.
const RANK_TOLERANCE: f64 = 1e-9;

/// A number with an uncertainty of three standard errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// The number.
    pub value: f64,
    /// Its uncertainty.
    pub uncertainty: f64,
}

impl Measured {
    /// The result of a failed measurement.
    pub const UNKNOWN: Self = Self {
        value: f64::NAN,
        uncertainty: f64::INFINITY,
    };

    /// A number with an uncertainty.
    pub fn new(value: f64, uncertainty: f64) -> Self {
        Self { value, uncertainty }
    }

    /// The ratio to another number.
    pub fn over(self, other: Self) -> Self {
        let value = self.value / other.value;
        let (own, theirs) = (self.uncertainty, value * other.uncertainty);
        let uncertainty = own.hypot(theirs) / other.value.abs();
        Self { value, uncertainty }
    }

    /// The reciprocal.
    pub fn inverse(self) -> Self {
        Self::new(1.0, 0.0).over(self)
    }
}

/// Coefficients c with rows · c ≈ targets, all rows with the same weight. [`Measured::UNKNOWN`] if there are too few
/// rows, or the coefficients are not resolved.
pub fn fit<const N: usize>(rows: &[([f64; N], f64)]) -> [Measured; N] {
    let general = rows.iter().map(|(row, target)| (row.to_vec(), *target));
    let coefficients = fit_rows(&general.collect::<Vec<_>>(), N);
    std::array::from_fn(|index| coefficients[index])
}

/// The same for rows of `columns` entries.
pub fn fit_rows(rows: &[(Vec<f64>, f64)], columns: usize) -> Vec<Measured> {
    solve(rows, columns).unwrap_or_else(|| vec![Measured::UNKNOWN; columns])
}

/// Mean squared deviation per degree of freedom that such a fit leaves, and the number of degrees of freedom; `None`
/// if the coefficients are not resolved.
pub fn deviations(rows: &[(Vec<f64>, f64)], columns: usize) -> Option<(f64, f64)> {
    let coefficients = solve(rows, columns)?;
    let left = rows.iter().map(|(terms, target)| {
        let terms = terms.iter().zip(&coefficients);
        let fitted: f64 = terms.map(|(term, own)| term * own.value).sum();
        (target - fitted) * (target - fitted)
    });
    let freedom = (rows.len() - columns) as f64;
    Some((left.sum::<f64>() / freedom, freedom))
}

fn solve(rows: &[(Vec<f64>, f64)], columns: usize) -> Option<Vec<Measured>> {
    let freedom = rows.len().checked_sub(columns)?;
    if freedom == 0 || columns == 0 {
        return None;
    }
    let mut matrix = DMatrix::from_fn(rows.len(), columns, |row, column| rows[row].0[column]);
    let target = DVector::from_fn(rows.len(), |row, _| rows[row].1);
    let scales: Vec<f64> = matrix.column_iter().map(|column| column.norm()).collect();
    let mut normal = scales.iter().map(|&scale| scale > 0.0 && scale.is_finite());
    if !normal.all(|normal| normal) {
        return None;
    }
    for (mut column, scale) in matrix.column_iter_mut().zip(&scales) {
        column /= *scale;
    }
    let decomposition = matrix.clone().svd(true, true);
    if decomposition.singular_values.min() < RANK_TOLERANCE * decomposition.singular_values.max() {
        return None;
    }
    let solution = decomposition.solve(&target, 0.0).ok()?;
    let residual = (matrix * &solution - target).norm_squared() / freedom as f64;
    let directions = decomposition.v_t?;
    let coefficients = (0..columns).map(|column| {
        let variance: f64 = (0..columns)
            .map(|index| {
                let share = directions[(index, column)] / decomposition.singular_values[index];
                share * share * residual
            })
            .sum();
        Measured::new(
            solution[column] / scales[column],
            COVERAGE * variance.sqrt() / scales[column],
        )
    });
    Some(coefficients.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_line_is_found_with_its_scatter() {
        let points = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0];
        let rows: Vec<([f64; 2], f64)> = points
            .iter()
            .map(|&x| {
                let wiggle = if x as i32 % 2 == 0 { 1e-6 } else { -1e-6 };
                ([1.0, x], 2.0 - 3.0 * x + wiggle)
            })
            .collect();
        let [offset, slope] = fit(&rows);
        assert!((offset.value - 2.0).abs() < offset.uncertainty);
        assert!((slope.value + 3.0).abs() < slope.uncertainty);
        assert!((1e-7..1e-5).contains(&slope.uncertainty));
    }

    #[test]
    fn what_the_rows_do_not_tell_apart_is_unknown() {
        let rows: Vec<([f64; 2], f64)> = (0..5)
            .map(|index| ([f64::from(index), 2.0 * f64::from(index)], 1.0))
            .collect();
        assert!(fit(&rows).iter().all(|found| found.value.is_nan()));
    }

    #[test]
    fn a_ratio_carries_both_uncertainties() {
        let ratio = Measured::new(2.0, 0.06).over(Measured::new(4.0, 0.16));
        assert_eq!(ratio.value, 0.5);
        assert!((ratio.uncertainty - 0.025).abs() < 1e-15);
    }
}
