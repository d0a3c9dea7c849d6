//! Yield curves of spheres beside those of cylinders.

use crate::model::{ContactConvention, PAPER_BODIES, Problem, Ring, Stack};
use crate::theory::{Event, Limit, quasistatic_limit, rigid_yield};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

/// Numbers n of bodies on the floor: cylinders, and every ring of spheres that can carry another one.
const BODIES: [u8; 4] = [PAPER_BODIES, 3, 4, 5];
/// Stiffnesses 1/ε of the curves.
pub const SPHERES_STIFFNESSES: [f64; 2] = [1e2, 1e4];
/// Floor frictions μ/μ_c of the table of forces: below, at and above the rigid critical one, where every stack yields.
const TABLE_FRICTIONS: [f64; 3] = [0.5, 1.0, 1.1];
/// Number of intervals of a curve.
const INTERVALS: u32 = 120;
/// Decades of the load (F + n + 1)/n that the rigid curve spans, and its points per decade.
const RIGID_DECADES: (u32, u32) = (5, 20);

/// Spheres beside cylinders, by theory under the paper's convention.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Spheres {
    /// One curve for every stiffness and number of bodies.
    pub curves: Vec<BodiesCurve>,
    /// μ/μ_c, and the load (F + n + 1)/n of rigid bodies: the same curve for every n. It begins where the stack with
    /// the most bodies carries its own weight.
    pub rigid: Vec<(f64, Option<f64>)>,
}

/// The exact yield force over the floor friction, for a number of bodies on the floor and a stiffness.
#[derive(Debug, Clone, PartialEq)]
pub struct BodiesCurve {
    /// The stack at its rigid critical friction μ_c.
    pub stack: Stack,
    /// Lowest and highest floor friction μ at which it yields under the wall. Below, it slides under its own weight.
    pub frictions: (f64, f64),
    /// Event that comes before floor slip above the highest friction.
    pub ends_by: Event,
    /// μ/μ_c and F, from the lowest to the highest friction.
    pub points: Vec<(f64, Option<f64>)>,
    /// F at μ_c/2, at μ_c and at 1.1 μ_c.
    pub forces: [Option<f64>; 3],
}

impl Spheres {
    /// Computes every curve.
    pub fn new() -> Self {
        let curves = SPHERES_STIFFNESSES.into_iter().flat_map(|stiffness| {
            BODIES.map(|bodies| Stack {
                bodies,
                ..Stack::paper(1.0, stiffness)
            })
        });
        let curves: Vec<Stack> = curves.collect();
        Self {
            curves: curves.into_par_iter().map(BodiesCurve::new).collect(),
            rigid: rigid(),
        }
    }
}

impl BodiesCurve {
    fn new(mut stack: Stack) -> Self {
        let ring = stack.ring();
        stack.floor_friction = ring.critical_friction;
        let yields = |mu: f64| limit(&stack, mu).yield_force.is_some();
        // At half the rigid critical friction every stack yields. At half the friction that rigid bodies need to
        // carry their weight it slides, and at μ = 1 it never does, since T stays below 1.
        let known = 0.5 * ring.critical_friction;
        let (lowest, _) = last_that(yields, known, 0.5 * own_weight_friction(&ring));
        let (highest, beyond) = last_that(yields, known, 1.0);
        let force = |relative: f64| {
            let mu = relative * ring.critical_friction;
            limit(&stack, mu).yield_force
        };
        let points = (0..=INTERVALS).map(|index| {
            let part = f64::from(index) / f64::from(INTERVALS);
            let mu = if index < INTERVALS {
                lowest + part * (highest - lowest)
            } else {
                highest
            };
            (mu / ring.critical_friction, limit(&stack, mu).yield_force)
        });
        Self {
            stack,
            frictions: (lowest, highest),
            ends_by: limit(&stack, beyond).event,
            points: points.collect(),
            forces: TABLE_FRICTIONS.map(force),
        }
    }

    /// Returns (F + n + 1)/n, the load of one bottom body on the floor under the wall force F, both in m g.
    pub fn load(&self, force: f64) -> f64 {
        load(&self.stack, force)
    }

    /// Returns μ_c/(n + 1), the friction below which rigid bodies slide under their own weight.
    pub fn own_weight_friction(&self) -> f64 {
        own_weight_friction(&self.stack.ring())
    }
}

fn load(stack: &Stack, force: f64) -> f64 {
    stack.floor_load(force) / f64::from(stack.bodies)
}

fn own_weight_friction(ring: &Ring) -> f64 {
    ring.critical_friction / (ring.bodies + 1.0)
}

fn limit(stack: &Stack, mu: f64) -> Limit {
    let stack = Stack {
        floor_friction: mu,
        ..*stack
    };
    let problem = Problem::new(stack, ContactConvention::TURNING);
    quasistatic_limit(&problem.expect("the frictions of a curve are above 0 and below 2"))
}

/// Bisects to two neighbouring doubles between `inside` and `outside`: the first `holds`, the second does not.
fn last_that(holds: impl Fn(f64) -> bool, mut inside: f64, mut outside: f64) -> (f64, f64) {
    loop {
        let middle = 0.5 * (inside + outside);
        if middle == inside || middle == outside {
            return (inside, outside);
        }
        match holds(middle) {
            true => inside = middle,
            false => outside = middle,
        }
    }
}

/// Returns the curve of rigid bodies for the largest number of them, whose curve begins first; its points are evenly
/// spaced on a logarithmic axis of loads.
fn rigid() -> Vec<(f64, Option<f64>)> {
    let stack = Stack {
        bodies: BODIES[BODIES.len() - 1],
        ..Stack::paper(1.0, SPHERES_STIFFNESSES[0])
    };
    let ring = stack.ring();
    let first = own_weight_friction(&ring) / ring.critical_friction;
    let (decades, per_decade) = RIGID_DECADES;
    let points = (0..=decades * per_decade).map(|index| {
        let exponent = f64::from(index) / f64::from(per_decade);
        let relative = 1.0 - (1.0 - first) * libm::exp10(-exponent);
        let stack = Stack {
            floor_friction: relative * ring.critical_friction,
            ..stack
        };
        let force = rigid_yield(&stack).yield_force;
        (relative, force.map(|force| load(&stack, force)))
    });
    points.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::CRITICAL_FRICTION;

    fn curve(bodies: u8, stiffness: f64) -> BodiesCurve {
        BodiesCurve::new(Stack {
            bodies,
            ..Stack::paper(1.0, stiffness)
        })
    }

    #[test]
    fn rigid_bodies_of_every_number_have_one_curve_of_the_load_of_each() {
        for bodies in BODIES {
            let stack = |relative: f64| {
                let stack = curve(bodies, 1e2).stack;
                Stack {
                    floor_friction: relative * stack.floor_friction,
                    ..stack
                }
            };
            for relative in [0.4, 0.5, 0.9, 0.99] {
                let stack = stack(relative);
                let force = rigid_yield(&stack).yield_force.unwrap();
                let exact = (1.0 - relative).recip();
                assert!((load(&stack, force) / exact - 1.0).abs() < 1e-13);
            }
        }
        let drawn = rigid();
        assert!((drawn[0].0 - 1.0 / 6.0).abs() < 1e-15);
        assert!((drawn[0].1.unwrap() - 1.2).abs() < 1e-14);
        for (relative, load) in drawn {
            let loss = (1.0 - relative) * load.unwrap() - 1.0;
            // The difference from μ_c loses digits.
            assert!(loss.abs() < 1e-15 / (1.0 - relative), "{relative}: {loss}");
        }
    }

    #[test]
    fn a_curve_ends_where_the_floor_is_not_the_first_to_slip() {
        for stiffness in SPHERES_STIFFNESSES {
            for bodies in BODIES {
                let curve = curve(bodies, stiffness);
                let (lowest, highest) = curve.frictions;
                let of = |mu: f64| limit(&curve.stack, mu);
                let reason = of(0.999_999 * lowest).reason.unwrap();
                assert!(reason.contains("own weight"), "{reason}");
                assert!(of(lowest).yield_force.unwrap() < 1e-9);
                assert!(lowest > curve.own_weight_friction());
                assert!(of(highest).yield_force.is_some());
                let softest_five = (bodies, stiffness) == (5, 1e2);
                let expected = match softest_five {
                    true => Event::CylinderSlip,
                    false => Event::WallContact,
                };
                assert_eq!(curve.ends_by, expected);
                assert_eq!(of(1.000_001 * highest).event, expected);
                assert!(curve.points.iter().all(|(_, force)| force.is_some()));
                assert!(curve.forces.iter().all(Option::is_some));
            }
        }
    }

    #[test]
    fn stiff_bodies_come_close_to_rigid_ones_and_two_are_the_cylinders_of_the_paper() {
        for bodies in BODIES {
            // Rigid bodies have F = n − 1 at half their critical friction.
            let rigid = f64::from(bodies) - 1.0;
            let [soft, stiff] = SPHERES_STIFFNESSES.map(|stiffness| curve(bodies, stiffness));
            let below = |curve: &BodiesCurve| rigid - curve.forces[0].unwrap();
            assert!(below(&stiff) > 0.0 && 50.0 * below(&stiff) < below(&soft));
        }
        let cylinders = Stack::paper(CRITICAL_FRICTION, 1e4);
        let force = limit(&cylinders, CRITICAL_FRICTION).yield_force;
        assert_eq!(curve(2, 1e4).forces[1], force);
    }
}
