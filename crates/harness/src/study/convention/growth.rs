//! The exponent of a stiffness that grows with the overlap, unlike that of a linear law.

use super::regression::Measured;

/// Range of exponents that are searched, from a stiffness that falls to one that grows with the square.
const RANGE: (f64, f64) = (-1.5, 2.0);
const GRID: usize = 14;
/// Smallest exponent that is reported: a stiffness that changes by a fortieth over the overlaps of the micro-tests.
const SMALLEST: f64 = 0.01;
/// A further term of a law counts as found if it leaves at most this fraction of the squared deviations.
pub const EXPLAINED: f64 = 1e-2;
/// Width of the interval to which the search narrows the exponent.
const RESOLUTION: f64 = 1e-6;
/// Step for the curvature of the squared deviations.
const STEP: f64 = 1e-3;

/// The exponent p at which a stiffness k δᵖ fits best, if it fits much better than a constant one. `deviations` gives
/// the mean squared deviation per degree of freedom that the best law with an exponent leaves, and the number of
/// degrees of freedom.
pub fn exponent(deviations: impl Fn(f64) -> Option<(f64, f64)>) -> Option<Measured> {
    let left = |p: f64| deviations(p).map_or(f64::INFINITY, |(mean, _)| mean);
    let constant = Some(left(0.0)).filter(|left| left.is_finite())?;
    let (low, high) = RANGE;
    let spacing = (high - low) / GRID as f64;
    let grid = (0..=GRID).map(|index| low + spacing * index as f64);
    let coarse = grid.min_by(|one, other| left(*one).total_cmp(&left(*other)))?;
    let best = narrowed(coarse - spacing, coarse + spacing, &left);
    let (mean, freedom) = deviations(best)?;
    if best.abs() < SMALLEST || mean > EXPLAINED * constant {
        return None;
    }
    let curvature = (left(best + STEP) + left(best - STEP) - 2.0 * mean) / (STEP * STEP);
    // Near the minimum the sum of squares, freedom × mean, rises by half its curvature times the distance squared.
    let error = (2.0 * mean / (freedom * curvature)).sqrt();
    Some(Measured::new(best, 3.0 * error + RESOLUTION))
}

/// The minimum of `value` between `low` and `high`, by golden-section search.
fn narrowed(mut low: f64, mut high: f64, value: &impl Fn(f64) -> f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    while high - low > RESOLUTION {
        let width = GOLDEN * (high - low);
        match value(high - width) < value(low + width) {
            true => high = low + width,
            false => low = high - width,
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The exponent that is found from forces δᵖ at some overlaps, with a little noise, if the best k is taken at
    /// every exponent tried.
    fn found(p: f64) -> Option<Measured> {
        let overlaps = [0.02, 0.05, 0.1, 0.2, 0.3];
        let noise = [1e-9, -1e-9, 1e-9, 1e-9, -1e-9];
        let forces = [0, 1, 2, 3, 4].map(|index| libm::pow(overlaps[index], p) + noise[index]);
        exponent(|tried| {
            let terms = overlaps.map(|overlap| libm::pow(overlap, tried));
            let sum = |of: &dyn Fn(usize) -> f64| (0..5).map(of).sum::<f64>();
            let k = sum(&|at| terms[at] * forces[at]) / sum(&|at| terms[at] * terms[at]);
            let left = sum(&|at| (forces[at] - k * terms[at]) * (forces[at] - k * terms[at]));
            Some((left / 4.0, 4.0))
        })
    }

    #[test]
    fn the_exponent_of_a_stiffness_that_grows_is_found_and_a_constant_one_has_none() {
        for p in [0.5, -1.0, 1.0 / 3.0] {
            let Measured { value, uncertainty } = found(p).unwrap();
            assert!(
                (value - p).abs() <= uncertainty && uncertainty < 1e-5,
                "{uncertainty}"
            );
        }
        assert_eq!(found(0.0), None);
    }
}
