//! Reference for the printed formulas, derived anew from Newton's laws and the two springs.
//!
//! Lengths, stiffnesses and weights keep their dimensions here, so that a missing factor r shows.

use crate::model::{CRITICAL_FRICTION, ContactConvention, Problem, Stack};
use crate::study::yield_force::PAPER_STIFFNESSES;
use crate::theory::{Limit, elastic_root, quasistatic_limit};
use nalgebra::{Matrix4, SMatrix, SVector, Vector2, Vector4};
use std::sync::LazyLock;

/// A radius that is not 1.
pub(crate) const RADIUS: f64 = 1.7;
/// A normal stiffness that is not 1.
pub(crate) const NORMAL_STIFFNESS: f64 = 2.3;
/// Frictions of the yield states: below, at and above the critical one.
pub(crate) const FRICTIONS: [f64; 10] = [
    0.1,
    0.15,
    0.2,
    0.25,
    CRITICAL_FRICTION,
    0.28,
    0.3,
    0.4,
    0.5,
    0.7,
];
/// Stiffness ratios κ: the paper's, a smaller and a larger one.
pub(crate) const RATIOS: [f64; 3] = [1.0, 2.5, 10.0];

const NEWTON_STEPS: usize = 12;
/// Residual of the equilibrium, relative to the floor force, at which Newton's method has converged.
const CONVERGED: f64 = 1e-11;

/// Returns the z-component of the cross product in the plane.
fn cross(left: Vector2<f64>, right: Vector2<f64>) -> f64 {
    left.x * right.y - left.y * right.x
}

/// Returns `normal` turned by −90°.
pub(crate) fn turned(normal: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(normal.y, -normal.x)
}

/// Contact forces of the right half of the stack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Forces {
    /// Normal force between 1 and 2.
    pub(crate) a: f64,
    /// Tangential force between 1 and 2.
    pub(crate) b: f64,
    /// Normal force of the floor.
    pub(crate) d: f64,
    /// Tangential force of the floor.
    pub(crate) e: f64,
}

impl From<Vector4<f64>> for Forces {
    fn from(forces: Vector4<f64>) -> Self {
        let [a, b, d, e] = forces.into();
        Self { a, b, d, e }
    }
}

/// Returns force and torque on cylinder 2, and the vertical force on 1, for c = 0 and torque arms r.
fn imbalance(forces: &Forces, normal: Vector2<f64>, f: f64, weight: f64) -> Vector4<f64> {
    let on_upper = normal * forces.a + turned(normal) * forces.b;
    let floor = Vector2::new(-forces.e, forces.d);
    let on_lower = floor - on_upper - Vector2::new(0.0, weight);
    let torque = cross(normal * RADIUS, -on_upper) + cross(Vector2::new(0.0, -RADIUS), floor);
    let upper = 2.0 * on_upper.y - f - weight;
    Vector4::new(on_lower.x, on_lower.y, torque / RADIUS, upper)
}

/// A stack in equilibrium.
pub(crate) struct Balanced {
    /// Force of the wall.
    pub(crate) f: f64,
    pub(crate) weight: f64,
    /// Direction from cylinder 2 to 1.
    pub(crate) normal: Vector2<f64>,
    pub(crate) forces: Forces,
}

/// Solves for the equilibrium under `f` when cylinder 1 lies in the direction `normal` from cylinder 2; returns
/// `None` if there are no such forces.
pub(crate) fn equilibrium(normal: Vector2<f64>, f: f64, weight: f64) -> Option<Balanced> {
    let under = |forces: Vector4<f64>| imbalance(&forces.into(), normal, f, weight);
    let loads = under(Vector4::zeros());
    let columns = [0, 1, 2, 3].map(|index| under(Vector4::ith(index, 1.0)) - loads);
    let solution = Matrix4::from_columns(&columns).lu().solve(&-loads)?;
    Some(Balanced {
        f,
        weight,
        normal,
        forces: solution.into(),
    })
}

/// Displacements of the stack.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Displacements {
    /// δ₁₁, by which 1 has sunk.
    pub(crate) delta_11: f64,
    /// δ₂₁, by which 2 has sunk.
    pub(crate) delta_21: f64,
    /// δ₂₂, by which 2 has moved outwards.
    pub(crate) delta_22: f64,
    /// θ, by which 2 has turned counter-clockwise.
    pub(crate) theta: f64,
}

impl Displacements {
    /// Returns the centre of cylinder 1; without displacements the cylinders just touch.
    pub(crate) fn upper(&self) -> Vector2<f64> {
        let rise = (4.0 * RADIUS * RADIUS - RADIUS * RADIUS).sqrt();
        Vector2::new(0.0, RADIUS + rise - self.delta_11)
    }

    /// Returns the centre of cylinder 2.
    pub(crate) fn lower(&self) -> Vector2<f64> {
        Vector2::new(RADIUS + self.delta_22, RADIUS - self.delta_21)
    }

    /// Returns the direction from 2 to 1.
    pub(crate) fn normal(&self) -> Vector2<f64> {
        (self.upper() - self.lower()).normalize()
    }

    /// Returns the motion of the surface of 1 relative to that of 2 at their contact.
    pub(crate) fn surface_gap(&self) -> Vector2<f64> {
        let arm = self.normal() * RADIUS;
        let upper = Vector2::new(0.0, -self.delta_11);
        upper - self.lower_surface(arm)
    }

    /// Returns the motion of the point of 2 at `arm` from its centre.
    fn lower_surface(&self, arm: Vector2<f64>) -> Vector2<f64> {
        let centre = Vector2::new(self.delta_22, -self.delta_21);
        centre + Vector2::new(-arm.y, arm.x) * self.theta
    }

    /// Returns the motion of the point of 2 on the floor.
    pub(crate) fn floor_point(&self) -> Vector2<f64> {
        self.lower_surface(Vector2::new(0.0, -RADIUS))
    }

    /// Returns the forces of linear springs on these displacements.
    pub(crate) fn spring_forces(&self, ratio: f64) -> Forces {
        let normal = self.normal();
        let gap = self.surface_gap();
        let floor = self.floor_point();
        let tangential_stiffness = NORMAL_STIFFNESS / ratio;
        Forces {
            a: -NORMAL_STIFFNESS * gap.dot(&normal),
            b: -tangential_stiffness * gap.dot(&turned(normal)),
            d: -NORMAL_STIFFNESS * floor.y,
            e: tangential_stiffness * floor.x,
        }
    }
}

/// The stack when the floor slips, for springs on the total displacements: a solution of the paper's five
/// equations, found without eliminating anything.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct YieldState {
    /// μ.
    pub(crate) friction: f64,
    /// κ.
    pub(crate) ratio: f64,
    /// ε.
    pub(crate) epsilon: f64,
    pub(crate) displacements: Displacements,
    /// Force of the wall.
    pub(crate) force: f64,
}

impl YieldState {
    /// Solves the five equations by Newton's method; `None` without a solution.
    pub(crate) fn solve(friction: f64, ratio: f64, epsilon: f64) -> Option<Self> {
        let guess = elastic_root(&stack(friction, ratio, epsilon))?;
        let scale = RADIUS * NORMAL_STIFFNESS;
        let mut unknowns = SVector::<f64, 5>::from([
            (guess.x + guess.z) * RADIUS,
            guess.z * RADIUS,
            guess.y * RADIUS,
            guess.theta,
            (guess.load - 3.0) * epsilon * scale,
        ]);
        let state = |unknowns: &SVector<f64, 5>| Self {
            friction,
            ratio,
            epsilon,
            displacements: Displacements {
                delta_11: unknowns[0],
                delta_21: unknowns[1],
                delta_22: unknowns[2],
                theta: unknowns[3],
            },
            force: unknowns[4],
        };
        for _ in 0..NEWTON_STEPS {
            let residual = state(&unknowns).residual();
            let jacobian = SMatrix::<f64, 5, 5>::from_columns(&[0, 1, 2, 3, 4].map(|index| {
                let step = 1e-7 * unknowns[1].max(1e-12);
                let mut moved = unknowns;
                moved[index] += step;
                (state(&moved).residual() - residual) / step
            }));
            unknowns -= jacobian.lu().solve(&residual)?;
        }
        let solved = state(&unknowns);
        let left = solved.residual().amax() / solved.forces().d;
        (left < CONVERGED).then_some(solved)
    }

    fn residual(&self) -> SVector<f64, 5> {
        let forces = self.forces();
        let normal = self.displacements.normal();
        let balance = imbalance(&forces, normal, self.force, self.weight());
        let slip = forces.e - self.friction * forces.d;
        SVector::from([balance[0], balance[1], balance[2], balance[3], slip])
    }

    /// Returns the weight of a cylinder.
    pub(crate) fn weight(&self) -> f64 {
        self.epsilon * RADIUS * NORMAL_STIFFNESS
    }

    pub(crate) fn forces(&self) -> Forces {
        self.displacements.spring_forces(self.ratio)
    }

    /// x = δ₁₁ − δ₂₁.
    pub(crate) fn x(&self) -> f64 {
        self.displacements.delta_11 - self.displacements.delta_21
    }

    /// y = δ₂₂.
    pub(crate) fn y(&self) -> f64 {
        self.displacements.delta_22
    }

    /// z = δ₂₁.
    pub(crate) fn z(&self) -> f64 {
        self.displacements.delta_21
    }

    /// α = ε r/z.
    pub(crate) fn alpha(&self) -> f64 {
        self.epsilon * RADIUS / self.z()
    }

    /// T, the tangent of half the angle between the line 2–1 and the vertical.
    pub(crate) fn half_angle_tangent(&self) -> f64 {
        let normal = self.displacements.normal();
        -normal.x / (1.0 + normal.y)
    }
}

/// Returns yield states over the paper's range of μ and ε, and beyond it in κ. They do not depend on the printed
/// constants.
pub(crate) fn yield_states() -> &'static [YieldState] {
    static STATES: LazyLock<Vec<YieldState>> = LazyLock::new(solve_everywhere);
    &STATES
}

fn solve_everywhere() -> Vec<YieldState> {
    let mut states = Vec::new();
    for friction in FRICTIONS {
        for (stiffness, ratio) in pairs(PAPER_STIFFNESSES, RATIOS) {
            states.extend(YieldState::solve(friction, ratio, 1.0 / stiffness));
        }
    }
    states
}

/// Pairs every value of `left` with every one of `right`.
pub(crate) fn pairs<const M: usize, const N: usize>(
    left: [f64; M],
    right: [f64; N],
) -> impl Iterator<Item = (f64, f64)> {
    left.into_iter()
        .flat_map(move |left| right.into_iter().map(move |right| (left, right)))
}

/// Returns a stack of any stiffness ratio κ.
pub(crate) fn stack(friction: f64, ratio: f64, epsilon: f64) -> Stack {
    Stack {
        stiffness_ratio: ratio,
        ..Stack::paper(friction, 1.0 / epsilon)
    }
}

/// Returns z of the elastic equation, in r, or NaN if it has no solution.
pub(crate) fn elastic_displacement(stack: &Stack) -> f64 {
    elastic_root(stack).map_or(f64::NAN, |root| root.z)
}

/// Returns the exact quasi-static limit of the paper's DEM; `None` if a value of the stack is out of range.
pub(crate) fn paper_limit(stack: &Stack) -> Option<Limit> {
    let problem = Problem::new(*stack, ContactConvention::PAPER).ok()?;
    Some(quasistatic_limit(&problem))
}

/// Returns F of the DEM's exact quasi-static limit, or NaN if the stack does not yield.
pub(crate) fn yield_force(stack: &Stack) -> f64 {
    let limit = paper_limit(stack);
    limit
        .and_then(|limit| limit.yield_force)
        .unwrap_or(f64::NAN)
}

/// Returns the stacks of Fig. 2(a) between μ = 0.1 and 0.5, each with F + 3 of the DEM's exact quasi-static limit.
pub(crate) fn figure_loads() -> &'static [(Stack, f64)] {
    static LOADS: LazyLock<Vec<(Stack, f64)>> = LazyLock::new(|| {
        let stacks = PAPER_STIFFNESSES.into_iter().flat_map(|stiffness| {
            (0..=20).map(move |step| Stack::paper(0.1 + 0.02 * f64::from(step), stiffness))
        });
        let with_load = |stack: Stack| Some((stack, paper_limit(&stack)?.yield_force? + 3.0));
        stacks.filter_map(with_load).collect()
    });
    &LOADS
}

/// Displacements out of equilibrium, for which statements on springs must hold too.
pub(crate) fn arbitrary_displacements() -> impl Iterator<Item = Displacements> {
    (1..=12).map(|index| {
        let wave = |frequency: f64| (f64::from(index) * frequency).sin();
        Displacements {
            delta_11: 0.3 * wave(1.1),
            delta_21: 0.2 * wave(2.3),
            delta_22: 0.25 * wave(3.7),
            theta: 0.4 * wave(5.3),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn five_equations_have_the_root_of_the_elastic_equation() {
        let states = yield_states();
        assert!(states.len() > 80, "{}", states.len());
        for state in states {
            let stack = stack(state.friction, state.ratio, state.epsilon);
            let root = elastic_root(&stack).unwrap();
            assert!((state.z() / RADIUS - root.z).abs() < 1e-10 * root.z);
            assert!((state.y() / RADIUS - root.y).abs() < 1e-9);
        }
    }
}
