//! Least squares with a few nonlinear parameters, beside linear coefficients that every round solves for (variable
//! projection).

use super::regression::{Measured, deviations, fit_rows};

/// Terms and target of every row.
pub type Rows = Vec<(Vec<f64>, f64)>;

/// Effect of a parameter, relative to the targets, below which it counts as rounding.
const NEGLIGIBLE: f64 = 1e-9;
/// Growth of the squared deviations from which a step is too long.
const WORSE: f64 = 4.0;
/// Largest number of times that such a step is halved.
const HALVINGS: usize = 8;

/// The best fit.
pub struct Beside<const N: usize> {
    /// The nonlinear parameters; unknown where they have no effect.
    pub others: [Measured; N],
    /// Their values in the best fit; those of the start where they have no effect.
    pub at: [f64; N],
    /// The linear coefficients.
    pub coefficients: Vec<Measured>,
}

/// Fits the nonlinear parameters by Gauss–Newton from `start`, beside the `columns` linear coefficients of the
/// `terms` that they give. Slopes are differences over one `step`. Uncertainties are those of the joint fit.
pub fn fit_beside<const N: usize>(
    start: [f64; N],
    step: f64,
    rounds: usize,
    columns: usize,
    terms: impl Fn([f64; N]) -> Rows,
) -> Beside<N> {
    let mut found = Beside {
        others: [Measured::UNKNOWN; N],
        at: start,
        coefficients: vec![Measured::UNKNOWN; columns],
    };
    for _ in 0..rounds {
        let mut rows = terms(found.at);
        let before = left(&rows, columns);
        let slopes = slopes(&rows, columns, found.at, step, &terms);
        for slope in slopes.iter().flatten() {
            for ((terms, _), slope) in rows.iter_mut().zip(slope) {
                terms.push(*slope);
            }
        }
        let added = slopes.iter().flatten().count();
        let fitted = fit_rows(&rows, columns + added);
        let (coefficients, changes) = fitted.split_at(columns);
        let mut changes = changes.iter().copied();
        let changes = slopes.map(|slope| slope.and_then(|_| changes.next()));
        let share = shortened(found.at, &changes, before, |at| left(&terms(at), columns));
        found.coefficients = coefficients.to_vec();
        for (index, change) in changes.iter().enumerate() {
            let Some(change) = change else {
                found.others[index] = Measured::UNKNOWN;
                continue;
            };
            found.at[index] += share * change.value;
            found.others[index] = Measured::new(found.at[index], change.uncertainty);
        }
    }
    found
}

/// The slope of the fitted forces in each parameter; `None` where it has no effect.
fn slopes<const N: usize>(
    rows: &Rows,
    columns: usize,
    at: [f64; N],
    step: f64,
    terms: &impl Fn([f64; N]) -> Rows,
) -> [Option<Vec<f64>>; N] {
    let coefficients = fit_rows(rows, columns);
    let targets: f64 = rows.iter().map(|(_, target)| target * target).sum();
    std::array::from_fn(|index| {
        let mut moved = at;
        moved[index] += step;
        let moved = terms(moved);
        let slope = rows.iter().zip(&moved).map(|((own, _), (moved, _))| {
            let changes = moved.iter().zip(own).zip(&coefficients);
            let change: f64 = changes
                .map(|((moved, own), found)| (moved - own) * found.value)
                .sum();
            change / step
        });
        let slope: Vec<f64> = slope.collect();
        let size: f64 = slope.iter().map(|own| own * own).sum();
        (size > NEGLIGIBLE * NEGLIGIBLE * targets).then_some(slope)
    })
}

/// The share of the changes that is applied: all, or so little that the deviations do not grow much beyond those
/// `before`.
fn shortened<const N: usize>(
    at: [f64; N],
    changes: &[Option<Measured>; N],
    before: f64,
    left: impl Fn([f64; N]) -> f64,
) -> f64 {
    let mut share = 1.0;
    for _ in 0..HALVINGS {
        let moved = std::array::from_fn(|index| {
            at[index] + changes[index].map_or(0.0, |change| share * change.value)
        });
        if left(moved) < WORSE * before {
            break;
        }
        share *= 0.5;
    }
    share
}

/// Mean squared deviation that the best linear fit leaves.
fn left(rows: &Rows, columns: usize) -> f64 {
    deviations(rows, columns).map_or(f64::INFINITY, |(mean, _)| mean)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_found_beside_its_coefficient_and_one_without_effect_is_unknown() {
        let points = [0.02, 0.05, 0.1, 0.2, 0.3];
        let noise = [1e-9, -1e-9, 1e-9, 1e-9, -1e-9];
        let terms = |[exponent, _]: [f64; 2]| -> Rows {
            let rows = points.iter().zip(noise).map(|(&x, noise)| {
                let force = 3.0 * libm::pow(x, 1.5) + noise;
                (vec![libm::pow(x, exponent)], force)
            });
            rows.collect()
        };
        let found = fit_beside([1.0, 0.7], 1e-4, 8, 1, terms);
        let [exponent, idle] = found.others;
        assert!((exponent.value - 1.5).abs() <= exponent.uncertainty);
        assert!(exponent.uncertainty < 1e-6);
        let coefficient = found.coefficients[0];
        assert!((coefficient.value - 3.0).abs() <= coefficient.uncertainty);
        assert_eq!(found.at[1].to_bits(), 0.7f64.to_bits());
        assert!(idle.value.is_nan());
    }

    #[test]
    fn without_rows_nothing_is_known() {
        let found = fit_beside([1.0], 1e-4, 2, 3, |_| Rows::new());
        assert_eq!(found.coefficients.len(), 3);
        let all = found.coefficients.iter().chain(&found.others);
        assert!(all.map(|own| own.value).all(f64::is_nan));
    }
}
