//! Extrapolation of a few values to argument 0 by the polynomial through them.

/// Returns the Lagrange weights of the values at `arguments` in the value of their polynomial at 0.
pub fn weights_at_zero(arguments: &[f64]) -> Vec<f64> {
    let weight = |i: usize| {
        let others = arguments.iter().enumerate().filter(|&(j, _)| j != i);
        others
            .map(|(_, other)| other / (other - arguments[i]))
            .product()
    };
    (0..arguments.len()).map(weight).collect()
}

/// Returns the value at 0 of the polynomial through the given points.
pub fn value_at_zero(arguments: &[f64], values: &[f64]) -> f64 {
    let weights = weights_at_zero(arguments);
    weights
        .iter()
        .zip(values)
        .map(|(weight, value)| weight * value)
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halved_twice_gives_the_weights_of_richardson() {
        let weights = weights_at_zero(&[4.0, 2.0, 1.0]);
        for (weight, exact) in weights.iter().zip([1.0 / 3.0, -2.0, 8.0 / 3.0]) {
            assert!((weight - exact).abs() < 1e-15);
        }
    }

    #[test]
    fn a_parabola_is_continued_exactly() {
        let parabola = |x: f64| 3.0 - 2.0 * x + 0.5 * x * x;
        let arguments = [0.3, 0.7, 1.1];
        let value = value_at_zero(&arguments, &arguments.map(parabola));
        assert!((value - 3.0).abs() < 1e-14);
    }
}
