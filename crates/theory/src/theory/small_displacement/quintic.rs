//! The root of the elastic equation from the quintic (paper, Eq. 11), by the eigenvalues of its companion matrix.

#![cfg(test)]

use crate::model::{CRITICAL_FRICTION, Stack};
use nalgebra::SMatrix;

/// Imaginary part, relative to the modulus, below which a computed eigenvalue counts as real.
const REAL_ENOUGH: f64 = 1e-6;
const POLISHING_STEPS: usize = 4;

/// Returns the largest real root z ≥ 3 ε r/2 of the quintic, in r.
///
/// Below μ_c the wanted root is of order ε while another one is of order 1, so it would lose its digits. There the
/// eigenvalues are computed for the reversed polynomial, in α = ε/z. A few Newton steps remove the rounding errors of
/// the eigenvalue iteration.
pub fn quintic_displacement(stack: &Stack) -> Option<f64> {
    let epsilon = stack.epsilon();
    let in_z = quintic_coefficients(stack);
    if stack.floor_friction >= CRITICAL_FRICTION {
        let candidates = real_roots(&in_z).filter(|&z| z >= 1.5 * epsilon);
        return candidates.fold(None, |best: Option<f64>, z| {
            Some(best.map_or(z, |b| b.max(z)))
        });
    }
    let in_alpha = std::array::from_fn(|power| {
        let power_of_z = 5 - power as i32;
        in_z[power_of_z as usize] * epsilon.powi(power_of_z - 4)
    });
    let candidates = real_roots(&in_alpha).filter(|&alpha| alpha > 0.0 && alpha <= 2.0 / 3.0);
    let smallest = candidates.fold(None, |best: Option<f64>, a| {
        Some(best.map_or(a, |b| b.min(a)))
    });
    smallest.map(|alpha| epsilon / alpha)
}

/// Coefficients of z⁰ … z⁵ of
/// μ z ((z−ε)² + μ² z²)((1+κ)(z−ε)² + κ μ² z²) − (μ² z² + 2√3 μ z (z−ε) − (z−ε)²)(z−ε)² = 0,
/// which is the elastic equation with its denominators multiplied out.
fn quintic_coefficients(stack: &Stack) -> [f64; 6] {
    let mu = stack.floor_friction;
    let kappa = stack.stiffness_ratio;
    let epsilon = stack.epsilon();
    let square = [epsilon * epsilon, -2.0 * epsilon, 1.0];
    let first = [square[0], square[1], square[2] + mu * mu];
    let second = [
        (1.0 + kappa) * square[0],
        (1.0 + kappa) * square[1],
        (1.0 + kappa) * square[2] + kappa * mu * mu,
    ];
    let numerator = [
        -square[0],
        -2.0 * 3f64.sqrt() * mu * epsilon - square[1],
        mu * mu + 2.0 * 3f64.sqrt() * mu - square[2],
    ];
    let left = product(first, second);
    let right = product(numerator, square);
    std::array::from_fn(|power| {
        let from_left = if power > 0 { mu * left[power - 1] } else { 0.0 };
        let from_right = if power < 5 { right[power] } else { 0.0 };
        from_left - from_right
    })
}

fn product(left: [f64; 3], right: [f64; 3]) -> [f64; 5] {
    let mut result = [0.0; 5];
    for (i, a) in left.iter().enumerate() {
        for (j, b) in right.iter().enumerate() {
            result[i + j] += a * b;
        }
    }
    result
}

/// Returns the real roots of the polynomial with the given coefficients, lowest power first.
///
/// The variable is scaled so that the monic polynomial has coefficients of at most 1: near μ_c all roots are small,
/// and without scaling they would be lost in the rounding errors of the companion matrix.
fn real_roots(coefficients: &[f64; 6]) -> impl Iterator<Item = f64> {
    let leading = coefficients[5];
    let sizes = (1..=5).map(|back| {
        let ratio = (coefficients[5 - back] / leading).abs();
        libm::pow(ratio, 1.0 / back as f64)
    });
    let scale = sizes.fold(f64::MIN_POSITIVE, f64::max);
    let companion = SMatrix::<f64, 5, 5>::from_fn(|row, column| {
        let below_diagonal = if row == column + 1 { 1.0 } else { 0.0 };
        let scaled = -coefficients[row] / leading / scale.powi(5 - row as i32);
        below_diagonal + if column == 4 { scaled } else { 0.0 }
    });
    let eigenvalues = companion.complex_eigenvalues();
    let real: Vec<f64> = eigenvalues
        .iter()
        .filter(|root| root.im.abs() <= REAL_ENOUGH * root.norm())
        .map(|root| polished(coefficients, scale * root.re))
        .collect();
    real.into_iter()
}

fn polished(coefficients: &[f64; 6], start: f64) -> f64 {
    let mut root = start;
    for _ in 0..POLISHING_STEPS {
        let (mut value, mut slope) = (0.0, 0.0);
        for &coefficient in coefficients.iter().rev() {
            slope = slope * root + value;
            value = value * root + coefficient;
        }
        let next = root - value / slope;
        if !next.is_finite() {
            break;
        }
        root = next;
    }
    root
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Coefficients of `leading` (z² − a)(z² − b)(z − c), lowest power first.
    fn with_squares(leading: f64, [a, b, c]: [f64; 3]) -> [f64; 6] {
        [-c * a * b, a * b, c * (a + b), -(a + b), -c, 1.0].map(|one| leading * one)
    }

    fn sorted(coefficients: [f64; 6]) -> Vec<f64> {
        let mut roots: Vec<f64> = real_roots(&coefficients).collect();
        roots.sort_by(f64::total_cmp);
        roots
    }

    fn assert_roots(coefficients: [f64; 6], expected: &[f64]) {
        let found = sorted(coefficients);
        assert_eq!(found.len(), expected.len(), "{found:?}");
        for (found, expected) in found.into_iter().zip(expected) {
            let deviation = (found - expected).abs() / expected.abs();
            assert!(deviation < 4e-15, "{found} {expected}");
        }
    }

    #[test]
    fn a_product_of_polynomials_has_their_sums_of_products() {
        let product = product([1.0, 2.0, 3.0], [4.0, 5.0, 6.0]);
        assert_eq!(product, [4.0, 13.0, 28.0, 27.0, 18.0]);
    }

    #[test]
    fn a_polished_root_has_lost_its_error() {
        let coefficients = with_squares(1.0, [4.0, -1.0, 0.5]);
        for root in [0.5, 2.0, -2.0] {
            let polished = polished(&coefficients, root * (1.0 + 1e-3));
            assert!((polished - root).abs() < 4e-16 * root.abs(), "{polished}");
        }
    }

    #[test]
    fn roots_of_any_size_are_found_whatever_the_leading_coefficient() {
        for (size, leading) in [
            (1.0, 1.0),
            (1e-6, 0.3),
            (1e-3, 7e-4),
            (1e4, 1e-3),
            (1e-4, 40.0),
        ] {
            let roots = [-2.0, -1.0, 0.3, 1.0, 2.0].map(|root| size * root);
            let square = size * size;
            let coefficients = with_squares(leading, [square, 4.0 * square, 0.3 * size]);
            assert_roots(coefficients, &roots);
        }
        let whole = with_squares(1.0, [1.0, 4.0, 3.0]);
        assert_roots(whole, &[-2.0, -1.0, 1.0, 2.0, 3.0]);
    }

    #[test]
    fn a_pair_that_is_nearly_real_is_no_root_however_small_it_is() {
        // z² + 1e-10 beside roots of the order of 1.
        assert_roots(with_squares(1.0, [-1e-10, 1.0, 0.5]), &[-1.0, 0.5, 1.0]);
        // (z − s)² + (s/1000)² with s = 1e-4, times (z² − 1)(z − 2).
        let small = [1e-8 * (1.0 + 1e-6), -2e-4, 1.0];
        let quartic = product(small, [-1.0, 0.0, 1.0]);
        let quintic = std::array::from_fn(|power| {
            let lower = if power > 0 { quartic[power - 1] } else { 0.0 };
            lower - 2.0 * quartic.get(power).copied().unwrap_or(0.0)
        });
        assert_roots(quintic, &[-1.0, 1.0, 2.0]);
    }
}
