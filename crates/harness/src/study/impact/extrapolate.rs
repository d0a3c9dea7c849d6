//! Extrapolation to vanishing time step, from four time steps, each half the one before.

/// Numbers of time steps in an impact, coarsest first. At the finest, the error of first order in the time step is
/// some 1e-4, and what the extrapolation leaves is below 1e-7.
pub const DIVISIONS: [u32; 4] = [512, 1024, 2048, 4096];

/// Returns the powers of the time step in the error of a leapfrog, lowest first.
///
/// Contact begins and ends in the middle of a step, so that forces are sampled as by the midpoint rule. Without
/// damping its error is of second order, and of order p + 1 from either end, where the force grows as the overlap to
/// the power p. Damping is computed from velocities half a step old, which is of first order; it grows as the overlap
/// to some power, which adds the order of that power plus 1.
pub(super) fn orders(power: f64, damping_exponent: Option<f64>) -> [f64; 3] {
    match damping_exponent {
        None if power == 1.0 => [2.0, 4.0, 6.0],
        None => [2.0, power + 1.0, 4.0],
        Some(exponent) if exponent > 0.0 && exponent < 1.0 => [1.0, exponent + 1.0, 2.0],
        Some(_) => [1.0, 2.0, 3.0],
    }
}

/// A number at vanishing time step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Extrapolated {
    /// The value without any of the orders.
    pub value: f64,
    /// Size of the change by the last order.
    pub last_change: f64,
}

/// Removes the `orders` from `values`, one after the other (Richardson).
pub(super) fn extrapolate(values: [f64; 4], orders: [f64; 3]) -> Extrapolated {
    let mut values = values.to_vec();
    let mut last_change = 0.0;
    for order in orders {
        let factor = libm::exp2(order);
        let finest = values[values.len() - 1];
        let pairs = values.windows(2);
        values = pairs
            .map(|pair| pair[1] + (pair[1] - pair[0]) / (factor - 1.0))
            .collect();
        last_change = values[values.len() - 1] - finest;
    }
    Extrapolated {
        value: values[0],
        last_change: last_change.abs(),
    }
}

/// Returns the weights of the four values in the extrapolated one.
pub(super) fn weights(orders: [f64; 3]) -> [f64; 4] {
    std::array::from_fn(|index| {
        let unit = std::array::from_fn(|other| f64::from(u8::from(other == index)));
        extrapolate(unit, orders).value
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_grows_with_the_three_orders_is_removed() {
        let orders = orders(1.5, Some(0.25));
        let value = |step: f64| {
            let terms = orders.iter().zip([0.3, -0.7, 1.1]);
            let terms = terms.map(|(order, factor)| factor * libm::pow(step, *order));
            2.0 + terms.sum::<f64>()
        };
        let values = [0.8, 0.4, 0.2, 0.1].map(value);
        let found = extrapolate(values, orders);
        assert!((found.value - 2.0).abs() < 1e-14);
        let last = 1.1 * 0.1f64.powi(2);
        assert!((0.5 * last..20.0 * last).contains(&found.last_change));
        let weights = weights(orders);
        assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-14);
        let weighted = weights.iter().zip(values).map(|(own, value)| own * value);
        assert!((weighted.sum::<f64>() - 2.0).abs() < 1e-14);
    }
}
