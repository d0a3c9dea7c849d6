//! The exact quasi-static limit of the paper's DEM (arms 0), in closed form.
//!
//! Equilibrium of cylinders 1 and 2 with c = 0 gives b = e = a T, 2a = f + m g and d = (f + 3 m g)/2 for
//! every deformed geometry. With the springs of both tangential contacts added, the overlap G of the
//! contact 1–2 obeys a linear differential equation in T = tan(ψ/2),
//!
//! dG/dT = [4/(1+T²) − G (2/(1+T²) + κ(1+T²))] / (T [1 + κ(1+T²)]),  G(μ_c) = 0,
//!
//! which an integrating factor M(s), s = T², turns into one quadrature. The floor slips where
//! G (T − μ) = ε μ, and then F = 2 G/ε − 1 (docs/theory.md, Eqs. 11 to 14, 17 to 19 and 23).

use super::events::{Path, PathPoint};
use super::limit::Limit;
use super::root::bracketed_root;
use crate::stack::{CRITICAL_FRICTION, Stack};
use gauss_quad::GaussLegendre;
use std::num::NonZeroUsize;
use std::sync::LazyLock;

/// The integrand is analytic within ±iπ of an interval no longer than 2 ln(1/μ_c) ≈ 2.6, so that the
/// error of n nodes is below 5⁻²ⁿ: 20 nodes leave nothing but round-off.
static QUADRATURE: LazyLock<GaussLegendre> =
    LazyLock::new(|| GaussLegendre::new(NonZeroUsize::new(20).expect("20 is not zero")));

/// At T = 1 the centre of cylinder 1 has sunk to the level of the other two.
const HIGHEST_TANGENT: f64 = 1.0;
const WIDEST: f64 = HIGHEST_TANGENT - CRITICAL_FRICTION;
const STATIONS: usize = 256;
const EARLY_STATIONS: i32 = 24;

/// G(T), the overlap of the contact 1–2, at T = μ_c + `beyond`.
///
/// G M(T²) = ∫ 2 M(s)/[s(1+s)(1+κ+κs)] ds from μ_c² to T², with M(s) = s^p (1+s)⁻¹ (1+κ+κs)^q,
/// p = (2+κ)/(2(1+κ)), q = (2κ+1)/(2(1+κ)); integrated over ln s (docs/theory.md, Eqs. 18 and 19).
pub fn pair_overlap(beyond: f64, stiffness_ratio: f64) -> f64 {
    let length = 2.0 * libm::log1p(beyond / CRITICAL_FRICTION);
    overlap_grown(CRITICAL_FRICTION + beyond, length, stiffness_ratio)
}

/// The same at `tangent` on a path that was free of force where ln T² was smaller by `length`.
pub(super) fn overlap_grown(tangent: f64, length: f64, stiffness_ratio: f64) -> f64 {
    let kappa = stiffness_ratio;
    let p = (2.0 + kappa) / (2.0 * (1.0 + kappa));
    let q = (2.0 * kappa + 1.0) / (2.0 * (1.0 + kappa));
    let end = tangent * tangent;
    let compliance = |s: f64| 1.0 + kappa + kappa * s;
    let integrand = |back: f64| {
        let s = end * libm::exp(-back);
        let factor_ratio = libm::exp(-p * back) * (1.0 + end) / (1.0 + s)
            * libm::pow(compliance(s) / compliance(end), q);
        2.0 * factor_ratio / ((1.0 + s) * compliance(s))
    };
    QUADRATURE.integrate(0.0, length, integrand)
}

/// The path of equilibria with the parameter T − μ_c (docs/theory.md, Eqs. 14 and 31; on the gravity ramp
/// Eq. 10).
pub(super) struct ClosedForm {
    epsilon: f64,
    stiffness_ratio: f64,
    end: f64,
}

impl ClosedForm {
    /// The whole path, up to T = 1.
    pub(super) fn whole(stack: &Stack) -> Self {
        Self::new(stack, WIDEST)
    }

    fn new(stack: &Stack, end: f64) -> Self {
        Self {
            epsilon: stack.epsilon(),
            stiffness_ratio: stack.stiffness_ratio,
            end,
        }
    }
}

impl Path for ClosedForm {
    /// Evenly spaced, and ever closer towards the start: near κ = (2 + √3)/(2√3) the bottom cylinders touch
    /// for a short while before they part.
    fn stations(&self) -> Vec<f64> {
        let spacing = self.end / STATIONS as f64;
        let early = (1..=EARLY_STATIONS)
            .rev()
            .map(|halvings| spacing * 0.5f64.powi(halvings));
        let even = (1..=STATIONS).map(|index| spacing * index as f64);
        early.chain(even).collect()
    }

    fn settled(&self) -> f64 {
        let excess = |beyond| 2.0 * pair_overlap(beyond, self.stiffness_ratio) - self.epsilon;
        bracketed_root(excess, 0.0, WIDEST).unwrap_or(WIDEST)
    }

    fn point(&self, parameter: f64) -> PathPoint {
        let tangent = CRITICAL_FRICTION + parameter;
        let overlap = pair_overlap(parameter, self.stiffness_ratio);
        let wall_force = (2.0 * overlap - self.epsilon).max(0.0);
        let floor_overlap = (3.0 * overlap).min(overlap + self.epsilon);
        let geometric = parameter * (CRITICAL_FRICTION.recip() - tangent);
        PathPoint {
            tangent,
            pair_overlap: overlap,
            floor_overlap,
            outward: (geometric - 2.0 * overlap * tangent) / (1.0 + tangent * tangent),
            pair_ratio: tangent,
            floor_ratio: overlap * tangent / floor_overlap,
            wall_force,
        }
    }
}

/// The exact limit of `stack` with both torque arms 0.
pub fn closed_form_limit(stack: &Stack) -> Limit {
    let slip = floor_slip(stack);
    let path = ClosedForm::new(stack, slip.unwrap_or(WIDEST));
    Limit::of(&path, slip, stack, 0.0, 0.0)
}

/// T − μ_c at which the floor slips: the root of G (T − μ) = ε μ. Its left side grows with T for every
/// G < 2, so the root is unique (docs/theory.md, Eqs. 23 and 24); it is measured from max(μ, μ_c) to keep
/// its digits.
fn floor_slip(stack: &Stack) -> Option<f64> {
    let mu = stack.floor_friction;
    let above_critical = (mu - CRITICAL_FRICTION).max(0.0);
    let above_friction = (CRITICAL_FRICTION - mu).max(0.0);
    let target = stack.epsilon() * mu;
    let excess = |offset: f64| {
        let overlap = pair_overlap(above_critical + offset, stack.stiffness_ratio);
        overlap * (above_friction + offset) / target - 1.0
    };
    let widest = HIGHEST_TANGENT - mu.max(CRITICAL_FRICTION);
    if widest <= 0.0 {
        return None;
    }
    bracketed_root(excess, 0.0, widest).map(|offset| above_critical + offset)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overlap_obeys_its_differential_equation() {
        for kappa in [0.5, 2.5, 10.0] {
            for tangent in [0.3, 0.5, 0.9] {
                let at = |t: f64| pair_overlap(t - CRITICAL_FRICTION, kappa);
                let step = 1e-4;
                let slope = (8.0 * (at(tangent + step) - at(tangent - step))
                    - (at(tangent + 2.0 * step) - at(tangent - 2.0 * step)))
                    / (12.0 * step);
                let square = 1.0 + tangent * tangent;
                let right = (4.0 / square - at(tangent) * (2.0 / square + kappa * square))
                    / (tangent * (1.0 + kappa * square));
                assert!((slope - right).abs() < 1e-11, "{slope} {right}");
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
    fn bottom_cylinders_part_only_above_a_stiffness_ratio() {
        // dx₂/dT at T = μ_c vanishes for κ = (2 + √3)/(2√3) (docs/theory.md, Eqs. 53 and 54).
        let threshold = (2.0 + 3f64.sqrt()) / (2.0 * 3f64.sqrt());
        let outward = |kappa| {
            let stack = Stack {
                stiffness_ratio: kappa,
                ..Stack::paper(0.3, 1e6)
            };
            ClosedForm::new(&stack, WIDEST).point(1e-9).outward
        };
        assert!(outward(threshold * 1.001) > 0.0);
        assert!(outward(threshold * 0.999) < 0.0);
    }
}
