//! Estimates of k_n, the stiffness of the contact between two cylinders, which no table lists.

use super::Cylinder;
use std::f64::consts::PI;
use std::fmt;

/// An estimate of k_n from the elasticity of a cylinder.
///
/// The paper leaves k_n open and only says that ε is of the order L ρ g/E. Contact mechanics says more, for
/// two cylinders of radius r and length l side by side, with E* = E/(2(1 − ν²)) and a force P per length.
/// The contact has the half-width a, a² = 2 P r/(π E*) (Hertz; K. L. Johnson, *Contact Mechanics*, 1985,
/// section 4.2), and the centres approach each other by twice the compression of a half cylinder,
/// (P/(2 π E*)) (2 ln(4 r/a) − 1) (there Eq. 5.57). The logarithm makes k_n depend on the load, but weakly.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContactEstimate {
    /// The paper's ε = L ρ g/E with L = r, that is k_n = π E l: an order of magnitude, on the stiff side.
    PaperScaling,
    /// k_n = (π/4) E* l, the straight line through Hertz's law (V. L. Popov, *Contact Mechanics and Friction*, section
    /// 5.6). DEM codes use it in two dimensions. It depends neither on the radius nor on the load.
    LineContact,
    /// The secant of Hertz's law, logarithm included, at the overlap at which the stack yields.
    Hertz,
}

impl ContactEstimate {
    /// All estimates, from stiff to soft.
    pub const ALL: [Self; 3] = [Self::PaperScaling, Self::LineContact, Self::Hertz];

    /// The name on the command line and in files.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::PaperScaling => "paper-scaling",
            Self::LineContact => "line-contact",
            Self::Hertz => "hertz",
        }
    }

    /// The formula, in ASCII.
    pub fn formula(self) -> &'static str {
        match self {
            Self::PaperScaling => "epsilon = L rho g/E, L = r (k_n = pi E l)",
            Self::LineContact => "k_n = (pi/4) E* l, E* = E/(2 (1 - nu^2))",
            Self::Hertz => "Hertz line contact with its logarithm, secant at yield",
        }
    }

    /// Returns k_n in N/m when the contact has the overlap G, in r.
    pub fn normal_stiffness(self, cylinder: &Cylinder, overlap: f64) -> f64 {
        let effective = cylinder.effective_modulus() * cylinder.length;
        match self {
            Self::PaperScaling => PI * cylinder.youngs_modulus * cylinder.length,
            Self::LineContact => 0.25 * PI * effective,
            Self::Hertz => effective * hertz_force(overlap) / overlap,
        }
    }
}

impl fmt::Display for ContactEstimate {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.as_str())
    }
}

/// An overlap in r far beyond the range of the law and of any stack.
const LARGEST_OVERLAP: f64 = 1.0;
const ITERATIONS: usize = 200;

/// Returns p = P/(E* r) for two equal cylinders whose centres have approached by G in r. It solves G = (p/π)(ln(8π/p)
/// − 1), which is twice Johnson's Eq. 5.57 with a² = 2 p r²/π.
fn hertz_force(overlap: f64) -> f64 {
    let overlap = overlap.min(LARGEST_OVERLAP);
    // p ← π G/(ln(8π/p) − 1) contracts by 1/(ln(8π/p) − 1) < 0.7 for all such G.
    let mut force = overlap;
    for _ in 0..ITERATIONS {
        let next = PI * overlap / (libm::log(8.0 * PI / force) - 1.0);
        if next == force {
            break;
        }
        force = next;
    }
    force
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn overlap_of(force: f64) -> f64 {
        force / PI * (libm::log(8.0 * PI / force) - 1.0)
    }

    #[test]
    fn hertz_force_inverts_its_law() {
        for overlap in [1e-9, 1e-4, 0.03, 0.3, 1.0] {
            assert_relative_eq!(
                overlap_of(hertz_force(overlap)),
                overlap,
                max_relative = 1e-13
            );
        }
    }

    /// The strain on the axis of a disc between two opposite contacts (plane strain), from the surface to the
    /// centre: Hertz's stresses below the near contact, a point load opposite, and the uniform tension
    /// P/(π r) that frees the rim.
    #[test]
    fn compression_of_a_half_cylinder_is_the_strain_along_its_axis() {
        let (force, poisson, modulus) = (1e-4, 0.3, 1.0f64);
        let effective = modulus / (2.0 * (1.0 - poisson * poisson));
        let half_width = (2.0 * force / (PI * effective)).sqrt();
        let strain = |depth: f64| {
            let root = (half_width * half_width + depth * depth).sqrt();
            let below = half_width * half_width / (root + depth);
            let axial = -2.0 * force / PI * (1.0 / root + 1.0 / (2.0 - depth) - 0.5);
            // [(a² + 2 z²)/√(a² + z²) − 2 z] = (√(a² + z²) − z)²/√(a² + z²)
            let spread = below * below / root / (half_width * half_width);
            let lateral = force / PI - 2.0 * force / PI * spread;
            ((1.0 - poisson * poisson) * axial - poisson * (1.0 + poisson) * lateral) / modulus
        };
        let nodes = 200_000;
        let at = |index: usize| (index as f64 / f64::from(nodes)).powi(3);
        let compression: f64 = (0..nodes as usize)
            .map(|index| (at(index), at(index + 1)))
            .map(|(from, to)| -strain(0.5 * (from + to)) * (to - from))
            .sum();
        let both = 2.0 * compression;
        let law = force / (PI * effective) * (2.0 * libm::log(4.0 / half_width) - 1.0);
        assert_relative_eq!(both, law, max_relative = 1e-4);
        assert_relative_eq!(overlap_of(force / effective), law, max_relative = 1e-12);
    }

    #[test]
    fn straight_line_is_close_to_hertz_where_stacks_yield_above_the_critical_friction() {
        for (overlap, ratio) in [(0.3, 1.127), (0.15, 0.894), (0.01, 0.517), (1e-4, 0.3115)] {
            let line = 0.25 * PI * overlap;
            assert_relative_eq!(hertz_force(overlap) / line, ratio, max_relative = 1e-3);
        }
    }
}
