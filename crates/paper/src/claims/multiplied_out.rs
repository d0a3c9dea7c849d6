//! The elastic equation as a polynomial in z and ε.

/// Multiplies out the elastic equation, with r = 1. Returns the coefficient of ε^j z^k at `[k][j]`; that of z⁵ is 1.
///
/// Follows from T = tan(ψ/2) = μ z/(z − ε) and z − ε = G(T) with the small-displacement path
/// G = (T² + 2√3 T − 1)/(T (1 + T²)(1 + κ(1 + T²))) (docs/theory.md, Eqs. 12, 14 and 67).
pub(crate) fn multiplied_out(friction: f64, ratio: f64) -> [[f64; 6]; 6] {
    let rest: Polynomial = vec![(1, 0, 1.0), (0, 1, -1.0)];
    let slip: Polynomial = vec![(1, 0, friction)];
    let square = product(&rest, &rest);
    let slip_square = product(&slip, &slip);
    let length = sum(&square, &slip_square);
    let compliance = sum(&square, &scaled(&length, ratio));
    let mixed = scaled(&product(&slip, &rest), 2.0 * 3f64.sqrt());
    let numerator = sum(&sum(&slip_square, &mixed), &scaled(&square, -1.0));
    // (z − ε) T (1 + T²)(1 + κ(1 + T²)) = T² + 2√3 T − 1, times (z − ε)⁴.
    let left = product(&product(&slip, &length), &compliance);
    let all = sum(&left, &scaled(&product(&numerator, &square), -1.0));
    let mut table = [[0.0; 6]; 6];
    for (z_power, epsilon_power, coefficient) in all {
        table[z_power][epsilon_power] += coefficient;
    }
    let leading = table[5][0];
    table.map(|row| row.map(|coefficient| coefficient / leading))
}

/// Terms ε^j z^k as tuples of k, j and coefficient.
type Polynomial = Vec<(usize, usize, f64)>;

fn product(left: &Polynomial, right: &Polynomial) -> Polynomial {
    let pairs = left.iter().flat_map(|l| right.iter().map(move |r| (l, r)));
    pairs
        .map(|(l, r)| (l.0 + r.0, l.1 + r.1, l.2 * r.2))
        .collect()
}

fn sum(left: &Polynomial, right: &Polynomial) -> Polynomial {
    left.iter().chain(right).copied().collect()
}

fn scaled(polynomial: &Polynomial, factor: f64) -> Polynomial {
    polynomial
        .iter()
        .map(|&(k, j, value)| (k, j, factor * value))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::finding::imbalance;
    use crate::claims::truth::{RADIUS, YieldState};

    #[test]
    fn multiplied_out_vanishes_at_the_root() {
        for (friction, ratio, epsilon) in [(0.2, 2.5, 1e-2), (0.4, 1.0, 1e-3)] {
            let state = YieldState::solve(friction, ratio, epsilon).unwrap();
            let z = state.z() / RADIUS;
            let table = multiplied_out(friction, ratio);
            let terms: Vec<f64> = (0..6)
                .flat_map(|k| (0..6).map(move |j| (k, j)))
                .map(|(k, j)| table[k][j] * z.powi(k as i32) * epsilon.powi(j as i32))
                .collect();
            assert!(imbalance(&terms) < 1e-11);
        }
    }
}
