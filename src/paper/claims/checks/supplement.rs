//! Section II of the supplement: displacements and spring forces, compared with rigid-body kinematics.

use super::Check;
use crate::paper::claims::finding::{Finding, imbalance, relative, worst};
use crate::paper::claims::printed::PaperTheory;
use crate::paper::claims::truth::{
    Displacements, Forces, NORMAL_STIFFNESS, RADIUS, arbitrary_displacements, turned, yield_states,
};
use nalgebra::{Matrix4x5, Vector2};

pub(crate) const CHECKS: &[Check] = &[
    Check::theory("displacement-vectors", displacement_vectors),
    Check::theory("positions", positions),
    Check::theory("separation", separation),
    Check::theory("explicit-normal", |paper| {
        kinematics(|moved| (paper.normal(moved, RADIUS) - moved.normal(RADIUS)).norm())
    }),
    Check::theory("explicit-tangent", |paper| {
        kinematics(|moved| {
            (paper.explicit_tangent(moved, RADIUS) - turned(moved.normal(RADIUS))).norm()
        })
    }),
    Check::theory("relative-displacement", relative_displacement),
    Check::theory("normal-component", normal_component),
    Check::theory("tangential-component", tangential_component),
    Check::theory("floor-shear", |paper| {
        kinematics(|moved| (paper.floor_shear(moved, RADIUS) - floor_point(moved).x).abs())
    }),
    Check::theory("floor-sinking", |paper| {
        kinematics(|moved| (paper.floor_sinking(moved) - floor_point(moved).y).abs())
    }),
    Check::theory("spring-a", |paper| implicit(paper, |forces| forces.a)),
    Check::theory("spring-b", |paper| implicit(paper, |forces| forces.b)),
    Check::theory("spring-d", |paper| implicit(paper, |forces| forces.d)),
    Check::theory("spring-e", |paper| implicit(paper, |forces| forces.e)),
    Check::theory("explicit-a", |paper| explicit(paper, |forces| forces.a)),
    Check::theory("explicit-b", |paper| explicit(paper, |forces| forces.b)),
    Check::theory("explicit-d", |paper| explicit(paper, |forces| forces.d)),
    Check::theory("explicit-e", |paper| explicit(paper, |forces| forces.e)),
    Check::theory("supplement-balances", supplement_balances),
    Check::theory("indeterminate-c", indeterminate_c),
];

const RATIO: f64 = 2.5;

fn kinematics(deviation: impl Fn(&Displacements) -> f64) -> Finding {
    let deviations = arbitrary_displacements()
        .into_iter()
        .map(|moved| deviation(&moved) / RADIUS);
    let compared = "positions and motions of rigid cylinders at arbitrary displacements, r not 1";
    Finding::identity(deviations, compared)
}

/// Motion of the point of cylinder 2 on the floor.
fn floor_point(moved: &Displacements) -> Vector2<f64> {
    moved.lower_surface(Vector2::new(0.0, -RADIUS))
}

/// Eqs. (S11), (S12), (S15) or (S16), by the `component` of the forces.
fn implicit(paper: &PaperTheory, component: impl Fn(&Forces) -> f64) -> Finding {
    springs(
        |moved| component(&paper.forces(moved, RADIUS, NORMAL_STIFFNESS, RATIO)),
        &component,
    )
}

/// Eqs. (S17) to (S20), by the `component` of the forces.
fn explicit(paper: &PaperTheory, component: impl Fn(&Forces) -> f64) -> Finding {
    springs(
        |moved| component(&paper.explicit_forces(moved, RADIUS, NORMAL_STIFFNESS, RATIO)),
        &component,
    )
}

fn springs(printed: impl Fn(&Displacements) -> f64, component: impl Fn(&Forces) -> f64) -> Finding {
    let deviations = arbitrary_displacements().into_iter().map(|moved| {
        let truth = component(&moved.spring_forces(RADIUS, NORMAL_STIFFNESS, RATIO));
        ((printed(&moved) - truth) / NORMAL_STIFFNESS / RADIUS).abs()
    });
    let compared = "springs on the motion of the two surfaces at arbitrary displacements, r and k_n not 1 (deviations in k_n r)";
    Finding::identity(deviations, compared)
}

fn displacement_vectors(paper: &PaperTheory) -> Finding {
    let at_rest = Displacements::default();
    kinematics(|moved| {
        let [upper, lower] = paper.displacement_vectors(moved);
        let upper_moved = moved.upper(RADIUS) - at_rest.upper(RADIUS);
        let lower_moved = moved.lower(RADIUS) - at_rest.lower(RADIUS);
        worst([(upper - upper_moved).norm(), (lower - lower_moved).norm()])
    })
}

fn positions(paper: &PaperTheory) -> Finding {
    kinematics(|moved| {
        let [upper, lower] = paper.positions(moved, RADIUS);
        worst([
            (upper - moved.upper(RADIUS)).norm(),
            (lower - moved.lower(RADIUS)).norm(),
        ])
    })
}

fn separation(paper: &PaperTheory) -> Finding {
    kinematics(|moved| {
        (paper.separation(moved, RADIUS) - (moved.upper(RADIUS) - moved.lower(RADIUS))).norm()
    })
}

/// δ₁₂ is the motion of the centre of 2 relative to that of 1.
fn relative_displacement(paper: &PaperTheory) -> Finding {
    let at_rest = Displacements::default();
    kinematics(|moved| {
        let seen = |moved: &Displacements| moved.lower(RADIUS) - moved.upper(RADIUS);
        (paper.relative_displacement_vector(moved) - (seen(moved) - seen(&at_rest))).norm()
    })
}

fn normal_component(paper: &PaperTheory) -> Finding {
    kinematics(|moved| {
        let gap = moved.surface_gap(RADIUS).dot(&moved.normal(RADIUS));
        (paper.normal_component(moved, RADIUS) - gap).abs()
    })
}

fn tangential_component(paper: &PaperTheory) -> Finding {
    kinematics(|moved| {
        let gap = moved.surface_gap(RADIUS).dot(&turned(moved.normal(RADIUS)));
        (paper.tangential_component(moved, RADIUS) - gap).abs()
    })
}

/// (S21) to (S23) with the supplement's own forces, at solutions of the unreduced equations.
fn supplement_balances(paper: &PaperTheory) -> Finding {
    let deviations = yield_states().iter().map(|state| {
        let moved = &state.displacements;
        let forces = paper.forces(moved, RADIUS, NORMAL_STIFFNESS, state.ratio);
        let normal = moved.normal(RADIUS);
        worst([
            imbalance(&paper.torque_terms(&forces)),
            imbalance(&paper.horizontal_terms(&forces, normal)),
            imbalance(&paper.vertical_terms(&forces, normal, state.force, state.weight())),
            relative(forces.e, state.friction * forces.d),
        ])
    });
    let compared =
        "the supplement's a, b, d, e in solutions of the unreduced equations, and e = mu d";
    Finding::identity(deviations, compared)
}

/// Without c = 0: torque and horizontal balance of 2, vertical balance of 1 and of the stack, for a, b, c, d, e.
fn indeterminate_c(paper: &PaperTheory) -> Finding {
    let normal = paper.rigid_normal();
    let tangent = turned(normal);
    let matrix = Matrix4x5::new(
        0.0, 1.0, 0.0, 0.0, -1.0, -normal.x, -tangent.x, 1.0, 0.0, -1.0, normal.y, tangent.y, 0.0,
        0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0,
    );
    let decomposition = matrix.transpose().svd(true, false);
    let rank = decomposition.rank(1e-12);
    // The free direction is the one that the four columns of the transposed matrix do not span.
    let spanned = decomposition.u.unwrap_or_default();
    let along_c = (0..4).map(|index| spanned[(2, index)].powi(2)).sum::<f64>();
    let freedom = 1.0 - along_c;
    let evidence = format!(
        "four balances for the five contact forces of the symmetric stack: rank {rank}; the free direction changes c \
         (its share is {:.3})",
        freedom.sqrt()
    );
    Finding::exceptions(4 - rank + usize::from(freedom <= 1e-3), evidence)
}
