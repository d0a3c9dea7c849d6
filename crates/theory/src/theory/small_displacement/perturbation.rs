//! The singular perturbation result of the paper, which expands the equation instead of its solution.

use super::{displacement_of_stiff_cylinders, vanishing_alpha};
use crate::model::Stack;

/// F + n + 1 = (n/2)(z⋆ + √(z⋆² + 4 ε Φ))/ε (paper, Eq. 17). `None` where it is not real or contradicts F ≥ 0.
pub(crate) fn perturbation_load(stack: &Stack) -> Option<f64> {
    let epsilon = stack.epsilon();
    let stiff = displacement_of_stiff_cylinders(stack);
    let shift = 4.0 * epsilon * first_order_coefficient(stack);
    let discriminant = stiff * stiff + shift;
    let root = discriminant.sqrt();
    let sum = if stiff >= 0.0 {
        stiff + root
    } else {
        shift / (root - stiff)
    };
    let load = 0.5 * f64::from(stack.bodies) * sum / epsilon;
    (load >= stack.own_weight()).then_some(load)
}

/// Φ(μ) = F(μ, max(0, 1 − μ/μ_c)) with F = ℰ(0) D + 𝒟(0) E + α D E (paper, Eqs. 15 and 16).
///
/// The difference quotients D and E of 𝒟 and ℰ between α and 0 are written out with the factor α cancelled
/// analytically, so that no digits are lost as α → 0.
fn first_order_coefficient(stack: &Stack) -> f64 {
    let (mu, kappa) = (stack.floor_friction, stack.stiffness_ratio);
    let ring = stack.ring();
    let cotangent = ring.rise / ring.radius;
    let alpha = vanishing_alpha(&ring, mu).max(0.0);
    let u = 1.0 - alpha;
    let numerator_at_0 = mu * mu + 2.0 * cotangent * mu - 1.0;
    let denominator_at_0 = mu * (1.0 + mu * mu);
    let denominator = mu * (u * u + mu * mu);
    let quotient_d = ((1.0 + u - 2.0 * cotangent * mu) * denominator_at_0
        + numerator_at_0 * mu * (1.0 + u))
        / (denominator * denominator_at_0);
    let compliance_at_0 = 1.0 + kappa * (1.0 + mu * mu);
    let compliance = u * u + kappa * (u * u + mu * mu);
    let quotient_e = -kappa * mu * mu * (1.0 + u) / (compliance * compliance_at_0);
    let script_d_at_0 = numerator_at_0 / denominator_at_0;
    let script_e_at_0 = 1.0 / compliance_at_0;
    ring.radius
        * (script_e_at_0 * quotient_d
            + script_d_at_0 * quotient_e
            + alpha * quotient_d * quotient_e)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{CRITICAL_FRICTION, Ring};

    fn script_d(ring: &Ring, mu: f64, alpha: f64) -> f64 {
        let u = 1.0 - alpha;
        let cotangent = ring.angle.tan().recip();
        ring.radius * (mu * mu + 2.0 * cotangent * u * mu - u * u) / (mu * (u * u + mu * mu))
    }

    fn script_e(mu: f64, kappa: f64, alpha: f64) -> f64 {
        let u = 1.0 - alpha;
        u * u / (u * u + kappa * (u * u + mu * mu))
    }

    #[test]
    fn coefficient_is_the_difference_quotient_of_the_product() {
        // F(μ, α) = (𝒟ℰ(α) − 𝒟ℰ(0))/α, which can be formed directly where α is not small.
        for (mu, kappa) in [(0.1, 0.5), (0.15, 2.5), (0.2, 10.0)] {
            for bodies in 2..=5 {
                let stack = Stack {
                    stiffness_ratio: kappa,
                    bodies,
                    ..Stack::paper(mu, 1e2)
                };
                let ring = stack.ring();
                let alpha = vanishing_alpha(&ring, mu);
                let product = |alpha| script_d(&ring, mu, alpha) * script_e(mu, kappa, alpha);
                let quotient = (product(alpha) - product(0.0)) / alpha;
                let coefficient = first_order_coefficient(&stack);
                assert!((coefficient - quotient).abs() < 1e-13 * quotient.abs());
            }
        }
    }

    #[test]
    fn at_the_critical_friction_it_gives_the_square_root_law() {
        let coefficient = first_order_coefficient(&Stack::paper(CRITICAL_FRICTION, 1e2));
        let exact = 1.0 / (CRITICAL_FRICTION * (1.0 + 10.0 * CRITICAL_FRICTION));
        assert!((coefficient - exact).abs() < 1e-14 * exact);
    }
}
