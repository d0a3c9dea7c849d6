//! The elastic equation z = r 𝒟(μ, α) ℰ(μ, α) (paper, Eqs. 8 to 10) and the state behind its root.

use super::vanishing_alpha;
use crate::model::{Ring, Stack};
use crate::theory::root::bracketed_root;

const SCAN_POINTS: usize = 512;

/// The state at yield according to the elastic equation; lengths in r, angle in radians.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElasticRoot {
    /// F + n + 1, the load on the floor in m g.
    pub load: f64,
    /// x = δ₁₁ − δ₂₁, how far cylinder 1 sinks between the bottom ones.
    pub x: f64,
    /// y = δ₂₂, how far cylinder 2 moves outwards.
    pub y: f64,
    /// z = δ₂₁, how far cylinder 2 sinks into the floor.
    pub z: f64,
    /// θ, how far cylinder 2 turns.
    pub theta: f64,
}

impl ElasticRoot {
    /// A caution if the root contradicts the assumption c = 0 behind the equation.
    pub fn caution(&self) -> Option<&'static str> {
        let caution = "y < 0: the root contradicts the assumption c = 0 behind the equation";
        (self.y < 0.0).then_some(caution)
    }
}

/// Returns the largest root z ≥ (n + 1) ε r/n of the elastic equation, with x, y and θ computed from it; `None` if
/// there is none.
///
/// The equation is solved as h(α) = α 𝒟 ℰ = ε for the smallest α, measured from the point where 𝒟 vanishes so that
/// stiff stacks keep all their digits. With T = μ/u the relations of appendix A become y = μ z (κ(1 − T²) − 1) and x =
/// (1 + y/x₀) z u (1 + T²)(1 + κ(1 + T²))/2 − y cot ψ₀. A root with y ≤ −x₀ is an artefact of the elimination: it
/// would put cylinder 2 on the other side, and violates equilibrium.
pub fn elastic_root(stack: &Stack) -> Option<ElasticRoot> {
    let root = eliminated_root(stack)?;
    (root.y > -stack.ring().radius).then_some(root)
}

fn eliminated_root(stack: &Stack) -> Option<ElasticRoot> {
    let mu = stack.floor_friction;
    let kappa = stack.stiffness_ratio;
    let epsilon = stack.epsilon();
    let ring = &stack.ring();
    let start = vanishing_alpha(ring, mu).max(0.0);
    let excess = |offset: f64| displacement_ratio(ring, mu, kappa, offset) - epsilon;
    // α at F = 0; at a root beyond it the wall would have to pull.
    let highest = ring.bodies / stack.own_weight();
    let offset = first_crossing(excess, highest - start)?;
    let alpha = start + offset;
    let u = coefficient_u(ring, mu, offset);
    let z = epsilon / alpha;
    let tangent_squared = (mu / u) * (mu / u);
    let y = mu * z * (kappa * (1.0 - tangent_squared) - 1.0);
    let sinking = z * u * (1.0 + tangent_squared) * (1.0 + kappa * (1.0 + tangent_squared)) / 2.0;
    Some(ElasticRoot {
        load: ring.bodies / alpha,
        x: (1.0 + y / ring.radius) * sinking - ring.rise / ring.radius * y,
        y,
        z,
        theta: mu * kappa * z - y,
    })
}

/// u = 1 − α at α = max(0, α₀) + `offset`, without forming 1 − α₀ by subtraction.
fn coefficient_u(ring: &Ring, mu: f64, offset: f64) -> f64 {
    (mu / ring.critical_friction).min(1.0) - offset
}

/// h(α) = α 𝒟(μ, α) ℰ(μ, α) at α = max(0, α₀) + `offset`, with the numerator of 𝒟 factored as
/// x₀ (α − α₀)(u + μ μ_c).
fn displacement_ratio(ring: &Ring, mu: f64, kappa: f64, offset: f64) -> f64 {
    let vanishing = vanishing_alpha(ring, mu);
    let alpha = vanishing.max(0.0) + offset;
    let beyond = offset + (-vanishing).max(0.0);
    let u = coefficient_u(ring, mu, offset);
    let u_squared = u * u;
    let sum = u_squared + mu * mu;
    ring.radius * alpha * beyond * (u + mu * ring.critical_friction) * u_squared
        / (mu * sum * (u_squared + kappa * sum))
}

/// Returns the smallest root of `excess`, which is negative at 0, within (0, `end`].
fn first_crossing(excess: impl Fn(f64) -> f64, end: f64) -> Option<f64> {
    if end <= 0.0 {
        return None;
    }
    let grid = |index: usize| end * index as f64 / SCAN_POINTS as f64;
    let above = (1..=SCAN_POINTS).find(|&index| excess(grid(index)) >= 0.0)?;
    bracketed_root(excess, grid(above - 1), grid(above))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::CRITICAL_FRICTION;
    use crate::theory::small_displacement::quintic_displacement;

    /// Torque balance of cylinder 2, horizontal balance of 2, vertical balance of 1 (paper, Eqs. 1 to 3)
    /// and the slip condition, from the springs of the supplement (Eqs. S11, S12, S15 and S16), relative to d.
    fn residuals(stack: &Stack, root: &ElasticRoot) -> [f64; 4] {
        let ElasticRoot {
            x,
            y,
            z,
            theta,
            load,
        } = *root;
        let ring = stack.ring();
        let (nx, ny) = (-(ring.radius + y), ring.rise - x);
        let length = nx.hypot(ny);
        let (nx, ny) = (nx / length, ny / length);
        let (tx, ty) = (ny, -nx);
        let a = y * nx + x * ny;
        let b = (y * tx + x * ty - theta) / stack.stiffness_ratio;
        let d = z;
        let e = (y + theta) / stack.stiffness_ratio;
        let f_plus_weight = (load - ring.bodies) * stack.epsilon();
        [
            (b - e) / d,
            (a * nx + b * (tx + 1.0)) / d,
            (ring.bodies * (a * ny + b * ty) - f_plus_weight) / d,
            (e - stack.floor_friction * d) / d,
        ]
    }

    #[test]
    fn only_a_root_of_cylinders_that_have_moved_inwards_carries_a_caution() {
        let inwards = elastic_root(&Stack::paper(0.85, 1e4)).unwrap();
        assert!(inwards.caution().unwrap().starts_with("y < 0"));
        let outwards = elastic_root(&Stack::paper(0.3, 1e4)).unwrap();
        for y in [outwards.y, 0.0] {
            assert_eq!(ElasticRoot { y, ..outwards }.caution(), None);
        }
    }

    fn grid() -> impl Iterator<Item = Stack> {
        let frictions = [
            0.1,
            0.15,
            0.2,
            0.25,
            CRITICAL_FRICTION,
            0.28,
            0.3,
            0.5,
            0.7,
            1.5,
        ];
        let stiffnesses = [1.0, 10.0, 1e2, 1e4, 1e6, 1e8];
        let ratios = [0.5, 1.0, 2.5, 10.0];
        frictions.into_iter().flat_map(move |mu| {
            stiffnesses.into_iter().flat_map(move |stiffness| {
                ratios.into_iter().map(move |stiffness_ratio| Stack {
                    stiffness_ratio,
                    ..Stack::paper(mu, stiffness)
                })
            })
        })
    }

    #[test]
    fn equilibrium_holds_to_round_off() {
        // Some hundred rounding errors of numbers up to ten times the load d.
        let round_off = 400.0 * f64::EPSILON;
        let stacks = grid().flat_map(|stack| (2..=5).map(move |bodies| Stack { bodies, ..stack }));
        for stack in stacks {
            let Some(root) = elastic_root(&stack) else {
                continue;
            };
            for residual in residuals(&stack, &root) {
                assert!(residual.abs() < round_off, "{residual:e} for {stack:?}");
            }
        }
    }

    #[test]
    fn the_quintic_has_the_same_largest_root() {
        let mut compared = 0;
        for stack in grid() {
            let root = eliminated_root(&stack).map(|root| root.z);
            let quintic = quintic_displacement(&stack);
            assert_eq!(root.is_some(), quintic.is_some(), "{stack:?}");
            if let (Some(root), Some(quintic)) = (root, quintic) {
                assert!(
                    (root - quintic).abs() < 1e-10 * root,
                    "{root} {quintic} {stack:?}"
                );
                compared += 1;
            }
        }
        assert!(compared > 150);
    }
}
