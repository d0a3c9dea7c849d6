//! "Theoretical results", Eqs. (6) to (17), and appendix B.

use super::PaperTheory;

impl PaperTheory {
    /// ε = m g/(k_n r), Eq. (6).
    pub(crate) fn epsilon(&self, weight: f64, stiffness: f64, radius: f64) -> f64 {
        self.epsilon_factor * weight / (stiffness * radius)
    }

    /// (f + 3 m g)/(m g) = 2 z/(ε r), Eq. (7).
    pub(crate) fn floor_load(&self, z: f64, epsilon: f64, radius: f64) -> f64 {
        self.load_factor * z / (epsilon * radius)
    }

    /// 𝒟(μ, α), Eq. (9).
    pub(crate) fn geometry(&self, mu: f64, alpha: f64) -> f64 {
        let u = 1.0 - alpha;
        (mu * mu + self.cross_coefficient * u * mu - u * u) / (mu * (u * u + mu * mu))
    }

    /// ℰ(μ, α), Eq. (10).
    pub(crate) fn compliance(&self, mu: f64, kappa: f64, alpha: f64) -> f64 {
        let u = 1.0 - alpha;
        u * u / (u * u + self.compliance_factor * kappa * (u * u + mu * mu))
    }

    /// z⋆, Eq. (12).
    pub(crate) fn stiff_displacement(&self, mu: f64, kappa: f64, radius: f64) -> f64 {
        let critical = self.critical_friction;
        let square = 1.0 + mu * mu;
        radius * (mu - critical) * (mu + critical.powf(self.stiff_offset_power))
            / (mu * square)
            / (1.0 + kappa * square)
    }

    /// Constant term of the quintic, Eq. (11): ε⁴, or c₀ ε⁴ with c₀ = r⁵/[μ (1 + μ²)(1 + κ(1 + μ²))].
    pub(crate) fn quintic_constant(&self, mu: f64, kappa: f64, epsilon: f64, radius: f64) -> f64 {
        let square = 1.0 + mu * mu;
        let coefficient = radius.powi(5) / (mu * square * (1.0 + kappa * square));
        epsilon.powf(self.quintic_constant_order) * coefficient.powf(self.quintic_constant_scaled)
    }

    /// r √(ε/(μ_c (1 + 4κμ_c))), in Eq. (13) at μ_c and in the text above it.
    pub(crate) fn critical_displacement(&self, kappa: f64, epsilon: f64, radius: f64) -> f64 {
        let critical = self.critical_friction;
        let compliance = critical * (1.0 + self.critical_compliance * kappa * critical);
        radius * (epsilon / compliance).powf(self.larger_exponent)
    }

    /// z = μ_c ε r/(μ_c − μ) of the naive expansion below μ_c, Eq. (13).
    pub(crate) fn displacement_below(&self, mu: f64, epsilon: f64, radius: f64) -> f64 {
        let critical = self.critical_friction;
        critical * self.naive_factor * epsilon * radius / (critical - mu)
    }

    /// F(μ, α) = ℰ(μ, 0) D + 𝒟(μ, 0) E + α D E, Eq. (16).
    pub(crate) fn product_quotient(&self, mu: f64, kappa: f64, alpha: f64) -> f64 {
        let (d0, e0) = (self.geometry(mu, 0.0), self.compliance(mu, kappa, 0.0));
        let d = self.quotient(alpha, |alpha| self.geometry(mu, alpha));
        let e = self.quotient(alpha, |alpha| self.compliance(mu, kappa, alpha));
        e0 * d + d0 * e + self.cross_term * alpha * d * e
    }

    /// Returns D from 𝒟(μ, α) = 𝒟(μ, 0) + α D(μ, α), or the same for ℰ. At small α it takes central differences,
    /// which are exact to α² there.
    fn quotient(&self, alpha: f64, function: impl Fn(f64) -> f64) -> f64 {
        const STEP: f64 = 1e-3;
        if alpha.abs() > STEP {
            return (function(alpha) - function(0.0)) / alpha;
        }
        let first = |h: f64| (function(h) - function(-h)) / (2.0 * h);
        let second = |h: f64| (function(h) - 2.0 * function(0.0) + function(-h)) / (h * h);
        let slope = (4.0 * first(STEP) - first(2.0 * STEP)) / 3.0;
        slope + 0.5 * alpha * second(STEP)
    }

    /// Φ(μ), Eq. (15).
    pub(crate) fn coefficient(&self, mu: f64, kappa: f64) -> f64 {
        let critical = self.critical_friction;
        let alpha = if mu < critical {
            1.0 - self.branch_slope * mu / critical
        } else {
            0.0
        };
        self.product_quotient(mu, kappa, alpha)
    }

    /// (f_ε + 3 m g)/(m g), Eq. (17).
    pub(crate) fn perturbative_load(&self, mu: f64, kappa: f64, epsilon: f64) -> f64 {
        let stiff = self.stiff_displacement(mu, kappa, 1.0);
        let shift = self.discriminant_factor * epsilon * self.coefficient(mu, kappa);
        let root = (stiff * stiff + shift).sqrt();
        // A sum of opposite signs is written as a quotient, which does not lose digits for stiff stacks.
        let sum = if stiff < 0.0 {
            shift / (root - stiff)
        } else {
            stiff + root
        };
        sum / epsilon
    }

    /// lim α for ε → 0, Eq. (E12).
    pub(crate) fn limiting_alpha(&self, mu: f64) -> f64 {
        let critical = self.critical_friction;
        if mu <= critical {
            1.0 - self.limit_slope * mu / critical
        } else {
            0.0
        }
    }
}
