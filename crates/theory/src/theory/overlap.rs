//! The overlap G along the path of equilibria with arms 0 and c = 0, in closed form.
//!
//! Equilibrium of cylinders 1 and 2 with c = 0 gives b = e = a T, 2a = f + m g and d = (f + 3 m g)/2 for
//! every deformed geometry. With the springs of both tangential contacts added, the overlap G of the
//! contact 1–2 obeys a linear differential equation in T = tan(ψ/2), which an integrating factor turns into
//! one quadrature (docs/theory.md, Eqs. 11 to 14, 17 to 19 and 71).

use crate::model::{CRITICAL_FRICTION, Stack};
use gauss_quad::GaussLegendre;
use std::num::NonZeroUsize;
use std::sync::LazyLock;

/// At T = 1 the centre of cylinder 1 has sunk to the level of the other two.
pub(super) const HIGHEST_TANGENT: f64 = 1.0;

/// Over √t from √μ_c to 1 the integrand is analytic within an ellipse whose semi-axes add up to 6 half lengths. The
/// error of n nodes is therefore below 6⁻²ⁿ, and 12 nodes leave only round-off.
static QUADRATURE: LazyLock<GaussLegendre> =
    LazyLock::new(|| GaussLegendre::new(NonZeroUsize::new(12).expect("12 is not zero")));

/// Returns G(T), the overlap of the contact 1–2 of three cylinders in r, at T = μ_c + `beyond`.
pub fn pair_overlap(beyond: f64, stiffness_ratio: f64) -> f64 {
    let curve = OverlapCurve {
        start: CRITICAL_FRICTION,
        stiffness_ratio,
    };
    curve.overlap(beyond)
}

/// G(T) of all stacks that have the stiffness ratio κ and were free of force at the same T.
#[derive(Debug, Clone, Copy)]
pub(super) struct OverlapCurve {
    /// T where all contacts are free of force.
    pub(super) start: f64,
    /// κ.
    pub(super) stiffness_ratio: f64,
}

impl OverlapCurve {
    /// The curve of stacks whose bodies just touch at first, for gravity ramp and compression alike.
    pub(super) fn from_just_touching(stack: &Stack) -> Self {
        Self {
            start: stack.ring().critical_friction,
            stiffness_ratio: stack.stiffness_ratio,
        }
    }

    /// G at T = start + `beyond`, in r (docs/theory.md, Eq. 71):
    ///
    /// G(T) = (1+T²)/(T C) ∫ 4/(1+t²)² [t² C/(c T²)]ʰ dt from the start to T, with c = 1 + κ (1+t²), C the
    /// same at T, and h = 1/(2(1+κ)); integrated over √t.
    pub(super) fn overlap(&self, beyond: f64) -> f64 {
        let kappa = self.stiffness_ratio;
        let exponent = 0.5 / (1.0 + kappa);
        let compliance = |tangent: f64| 1.0 + kappa * (1.0 + tangent * tangent);
        let factor_base = |tangent: f64| tangent * tangent / compliance(tangent);
        let end = self.start + beyond;
        let base_at_end = factor_base(end);
        let lowest_root = self.start.sqrt();
        let integrand = |advance: f64| {
            let root = lowest_root + advance;
            let tangent = root * root;
            let square = 1.0 + tangent * tangent;
            let logarithm = libm::log(factor_base(tangent) / base_at_end);
            8.0 * root / (square * square) * libm::exp(exponent * logarithm)
        };
        let integral = QUADRATURE.integrate(0.0, beyond / (lowest_root + end.sqrt()), integrand);
        (1.0 + end * end) / (end * compliance(end)) * integral
    }

    /// dG/dT at T = start + `beyond`, where G is `overlap` (docs/theory.md, Eq. 17).
    pub(super) fn slope(&self, beyond: f64, overlap: f64) -> f64 {
        let tangent = self.start + beyond;
        let square = 1.0 + tangent * tangent;
        let stiffening = self.stiffness_ratio * square;
        (4.0 / square - overlap * (2.0 / square + stiffening)) / (tangent * (1.0 + stiffening))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(stiffness_ratio: f64) -> OverlapCurve {
        OverlapCurve::from_just_touching(&Stack {
            stiffness_ratio,
            ..Stack::paper(0.3, 1e2)
        })
    }

    const RATIOS: [f64; 7] = [1e-3, 0.1, 0.5, 2.5, 10.0, 1e3, 1e6];

    #[test]
    fn overlap_obeys_its_differential_equation() {
        for kappa in [0.5, 2.5, 10.0] {
            let curve = curve(kappa);
            for tangent in [0.3, 0.5, 0.9] {
                let beyond = tangent - CRITICAL_FRICTION;
                let at = |shift: f64| curve.overlap(beyond + shift);
                let step = 1e-4;
                let slope = (8.0 * (at(step) - at(-step)) - (at(2.0 * step) - at(-2.0 * step)))
                    / (12.0 * step);
                let right = curve.slope(beyond, at(0.0));
                assert!((slope - right).abs() < 1e-11, "{slope} {right}");
            }
        }
    }

    #[test]
    fn twelve_nodes_are_as_good_as_forty() {
        let more = GaussLegendre::new(NonZeroUsize::new(40).unwrap());
        for kappa in RATIOS {
            // Eqs. 18 and 19 as written, integrated over ln s.
            let (p, q) = (
                (2.0 + kappa) / (2.0 * (1.0 + kappa)),
                (1.0 + 2.0 * kappa) / (2.0 * (1.0 + kappa)),
            );
            let factor = |s: f64| s.powf(p) * (1.0 + kappa + kappa * s).powf(q) / (1.0 + s);
            for beyond in [1e-9, 1e-3, 0.1, 0.4, HIGHEST_TANGENT - CRITICAL_FRICTION] {
                let end = (CRITICAL_FRICTION + beyond).powi(2);
                let length = 2.0 * (beyond / CRITICAL_FRICTION).ln_1p();
                let integrand = |back: f64| {
                    let s = end * (-back).exp();
                    2.0 * factor(s) / factor(end) / ((1.0 + s) * (1.0 + kappa + kappa * s))
                };
                let expected = more.integrate(0.0, length, integrand);
                let overlap = pair_overlap(beyond, kappa);
                assert!((overlap / expected - 1.0).abs() < 4e-15, "{kappa} {beyond}");
            }
        }
    }

    #[test]
    fn initial_slope_gives_the_square_root_law_of_the_paper() {
        let kappa = 2.5;
        let slope = pair_overlap(1e-9, kappa) / 1e-9;
        let mu_c = CRITICAL_FRICTION;
        let exact = 1.0 / (mu_c * mu_c * (1.0 + 4.0 * kappa * mu_c));
        assert!((slope / exact - 1.0).abs() < 1e-7);
    }

    #[test]
    fn curve_is_concave_and_nowhere_sharply_bent() {
        const INTERVALS: u32 = 500;
        let width = (HIGHEST_TANGENT - CRITICAL_FRICTION) / f64::from(INTERVALS);
        for kappa in RATIOS {
            let curve = curve(kappa);
            for beyond in (0..INTERVALS).map(|index| width * f64::from(index)) {
                let overlap = curve.overlap(beyond);
                let slope = curve.slope(beyond, overlap);
                let next_slope = curve.slope(beyond + width, curve.overlap(beyond + width));
                assert!(next_slope < slope, "{kappa} {beyond}");
                // The bound of docs/theory.md, section 5.4, at its largest t = T - μ.
                let tangent = CRITICAL_FRICTION + beyond;
                let bend = (slope - next_slope) / width * tangent * tangent;
                assert!(bend < 3.0 * (overlap + slope * tangent), "{kappa} {beyond}");
            }
        }
    }
}
