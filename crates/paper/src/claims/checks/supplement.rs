//! Section II of the supplement: displacements and spring forces, compared with rigid-body kinematics.

use super::Check;
use crate::claims::finding::{Finding, imbalance, relative, worst};
use crate::claims::printed::PaperTheory;
use crate::claims::truth::{
    Balanced, Displacements, Forces, NORMAL_STIFFNESS, RADIUS, arbitrary_displacements, turned,
    yield_states,
};
use nalgebra::Matrix4x5;

pub(crate) const CHECKS: &[Check] = &[
    Check::theory("displacement-vectors", |paper| {
        let at_rest = Displacements::default();
        kinematics(|moved| {
            let [upper, lower] = paper.displacement_vectors(moved);
            let upper_moved = moved.upper() - at_rest.upper();
            let lower_moved = moved.lower() - at_rest.lower();
            worst([(upper - upper_moved).norm(), (lower - lower_moved).norm()])
        })
    }),
    Check::theory("positions", |paper| {
        kinematics(|moved| {
            let [upper, lower] = paper.positions(moved);
            worst([
                (upper - moved.upper()).norm(),
                (lower - moved.lower()).norm(),
            ])
        })
    }),
    Check::theory("separation", |paper| {
        kinematics(|moved| (paper.separation(moved) - (moved.upper() - moved.lower())).norm())
    }),
    Check::theory("explicit-normal", |paper| {
        kinematics(|moved| (paper.normal(moved) - moved.normal()).norm())
    }),
    Check::theory("explicit-tangent", |paper| {
        kinematics(|moved| (paper.explicit_tangent(moved) - turned(moved.normal())).norm())
    }),
    // δ₁₂ is the motion of the centre of 2 relative to that of 1.
    Check::theory("relative-displacement", |paper| {
        let at_rest = Displacements::default();
        kinematics(|moved| {
            let seen = |moved: &Displacements| moved.lower() - moved.upper();
            (paper.relative_displacement_vector(moved) - (seen(moved) - seen(&at_rest))).norm()
        })
    }),
    Check::theory("normal-component", |paper| {
        kinematics(|moved| {
            let gap = moved.surface_gap().dot(&moved.normal());
            (paper.normal_component(moved) - gap).abs()
        })
    }),
    Check::theory("tangential-component", |paper| {
        kinematics(|moved| {
            let gap = moved.surface_gap().dot(&turned(moved.normal()));
            (paper.tangential_component(moved) - gap).abs()
        })
    }),
    Check::theory("floor-shear", |paper| {
        kinematics(|moved| (paper.floor_shear(moved) - moved.floor_point().x).abs())
    }),
    Check::theory("floor-sinking", |paper| {
        kinematics(|moved| (paper.floor_sinking(moved) - moved.floor_point().y).abs())
    }),
    Check::theory("spring-a", |paper| implicit(paper, |forces| forces.a)),
    Check::theory("spring-b", |paper| implicit(paper, |forces| forces.b)),
    Check::theory("spring-d", |paper| implicit(paper, |forces| forces.d)),
    Check::theory("spring-e", |paper| implicit(paper, |forces| forces.e)),
    Check::theory("explicit-a", |paper| explicit(paper, |forces| forces.a)),
    Check::theory("explicit-b", |paper| explicit(paper, |forces| forces.b)),
    Check::theory("explicit-d", |paper| explicit(paper, |forces| forces.d)),
    Check::theory("explicit-e", |paper| explicit(paper, |forces| forces.e)),
    // (S21) to (S23) with the supplement's own forces, at solutions of the unreduced equations.
    Check::theory("supplement-balances", |paper| {
        let deviations = yield_states().iter().map(|state| {
            let forces = paper.forces(&state.displacements, state.ratio);
            let balanced = Balanced {
                f: state.force,
                weight: state.weight(),
                normal: state.displacements.normal(),
                forces,
            };
            worst([
                imbalance(&paper.torque_terms(&balanced)),
                imbalance(&paper.horizontal_terms(&balanced)),
                imbalance(&paper.vertical_terms(&balanced)),
                relative(forces.e, state.friction * forces.d),
            ])
        });
        let compared = r"the supplement's $a$, $b$, $d$ and $e$ in solutions of the unreduced equations, and $e = \mu d$";
        Finding::identity(deviations, compared)
    }),
    // Without c = 0: torque and horizontal balance of 2, vertical balance of 1 and of the stack, for a, b, c, d, e.
    Check::theory("indeterminate-c", |paper| {
        let normal = paper.rigid_normal();
        let tangent = turned(normal);
        let matrix = Matrix4x5::new(
            0.0, 1.0, 0.0, 0.0, -1.0, -normal.x, -tangent.x, 1.0, 0.0, -1.0, normal.y, tangent.y,
            0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0,
        );
        let decomposition = matrix.transpose().svd(true, false);
        let rank = decomposition.rank(1e-12);
        // The free direction is the one that the four columns of the transposed matrix do not span.
        let spanned = decomposition.u.unwrap_or_default();
        let along_c = (0..4).map(|index| spanned[(2, index)].powi(2)).sum::<f64>();
        let freedom = 1.0 - along_c;
        let evidence = format!(
            "four balances for the five contact forces of the symmetric stack: rank {rank}; the free direction changes $c$ \
             (its share is {:.3})",
            freedom.sqrt()
        );
        Finding::exceptions(4 - rank + usize::from(freedom <= 1e-3), evidence)
    }),
];

const RATIO: f64 = 2.5;

fn kinematics(deviation: impl Fn(&Displacements) -> f64) -> Finding {
    let deviations = arbitrary_displacements().map(|moved| deviation(&moved) / RADIUS);
    let compared = "the printed formula against positions and motions of rigid cylinders at arbitrary displacements, $r$ not 1";
    Finding::identity(deviations, compared)
}

/// Checks the equation for this `component` of the forces, one of (S11), (S12), (S15) and (S16).
fn implicit(paper: &PaperTheory, component: fn(Forces) -> f64) -> Finding {
    springs(component, |moved| paper.forces(moved, RATIO))
}

/// Checks the equation for this `component` of the forces, one of (S17) to (S20).
fn explicit(paper: &PaperTheory, component: fn(Forces) -> f64) -> Finding {
    springs(component, |moved| paper.explicit_forces(moved, RATIO))
}

fn springs(component: fn(Forces) -> f64, printed: impl Fn(&Displacements) -> Forces) -> Finding {
    let deviations = arbitrary_displacements().map(|moved| {
        let truth = component(moved.spring_forces(RATIO));
        ((component(printed(&moved)) - truth) / NORMAL_STIFFNESS / RADIUS).abs()
    });
    let compared = "the printed formula against springs stretched by the displacements of the two surfaces, along the present tangent, $r$ and $k_n$ not 1 (deviations in $k_n r$)";
    Finding::identity(deviations, compared)
}
