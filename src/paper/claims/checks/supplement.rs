//! Section II of the supplement: displacements and spring forces, compared with rigid-body kinematics.

use super::Check;
use crate::paper::claims::finding::{Finding, imbalance, relative, worst};
use crate::paper::claims::printed::PaperTheory;
use crate::paper::claims::truth::{
    Displacements, Forces, NORMAL_STIFFNESS, RADIUS, arbitrary_displacements, turned, yield_states,
};
use nalgebra::Matrix4x5;

pub(crate) const CHECKS: &[Check] = &[
    Check::theory("displacement-vectors", displacement_vectors),
    Check::theory("positions", positions),
    Check::theory("separation", separation),
    Check::theory("explicit-normal", |paper| {
        kinematics(|moved| (paper.normal(moved) - moved.normal()).norm())
    }),
    Check::theory("explicit-tangent", |paper| {
        kinematics(|moved| (paper.explicit_tangent(moved) - turned(moved.normal())).norm())
    }),
    Check::theory("relative-displacement", relative_displacement),
    Check::theory("normal-component", normal_component),
    Check::theory("tangential-component", tangential_component),
    Check::theory("floor-shear", |paper| {
        kinematics(|moved| (paper.floor_shear(moved) - moved.floor_point().x).abs())
    }),
    Check::theory("floor-sinking", |paper| {
        kinematics(|moved| (paper.floor_sinking(moved) - moved.floor_point().y).abs())
    }),
    Check::theory("spring-a", |paper| {
        springs(paper, PaperTheory::forces, |forces| forces.a)
    }),
    Check::theory("spring-b", |paper| {
        springs(paper, PaperTheory::forces, |forces| forces.b)
    }),
    Check::theory("spring-d", |paper| {
        springs(paper, PaperTheory::forces, |forces| forces.d)
    }),
    Check::theory("spring-e", |paper| {
        springs(paper, PaperTheory::forces, |forces| forces.e)
    }),
    Check::theory("explicit-a", |paper| {
        springs(paper, PaperTheory::explicit_forces, |forces| forces.a)
    }),
    Check::theory("explicit-b", |paper| {
        springs(paper, PaperTheory::explicit_forces, |forces| forces.b)
    }),
    Check::theory("explicit-d", |paper| {
        springs(paper, PaperTheory::explicit_forces, |forces| forces.d)
    }),
    Check::theory("explicit-e", |paper| {
        springs(paper, PaperTheory::explicit_forces, |forces| forces.e)
    }),
    Check::theory("supplement-balances", supplement_balances),
    Check::theory("indeterminate-c", indeterminate_c),
];

const RATIO: f64 = 2.5;

fn kinematics(deviation: impl Fn(&Displacements) -> f64) -> Finding {
    let deviations = arbitrary_displacements().map(|moved| deviation(&moved) / RADIUS);
    let compared = "positions and motions of rigid cylinders at arbitrary displacements, r not 1";
    Finding::identity(deviations, compared)
}

/// Spring forces as printed: by Eqs. (S11), (S12), (S15) and (S16), or by Eqs. (S17) to (S20).
type Springs = fn(&PaperTheory, &Displacements, f64) -> Forces;

/// One `component` of the `printed` spring forces.
fn springs(paper: &PaperTheory, printed: Springs, component: fn(&Forces) -> f64) -> Finding {
    let deviations = arbitrary_displacements().map(|moved| {
        let truth = component(&moved.spring_forces(RATIO));
        let printed = component(&printed(paper, &moved, RATIO));
        ((printed - truth) / NORMAL_STIFFNESS / RADIUS).abs()
    });
    let compared = "springs on the motion of the two surfaces at arbitrary displacements, r and k_n not 1 (deviations in k_n r)";
    Finding::identity(deviations, compared)
}

fn displacement_vectors(paper: &PaperTheory) -> Finding {
    let at_rest = Displacements::default();
    kinematics(|moved| {
        let [upper, lower] = paper.displacement_vectors(moved);
        let upper_moved = moved.upper() - at_rest.upper();
        let lower_moved = moved.lower() - at_rest.lower();
        worst([(upper - upper_moved).norm(), (lower - lower_moved).norm()])
    })
}

fn positions(paper: &PaperTheory) -> Finding {
    kinematics(|moved| {
        let [upper, lower] = paper.positions(moved);
        worst([
            (upper - moved.upper()).norm(),
            (lower - moved.lower()).norm(),
        ])
    })
}

fn separation(paper: &PaperTheory) -> Finding {
    kinematics(|moved| (paper.separation(moved) - (moved.upper() - moved.lower())).norm())
}

/// δ₁₂ is the motion of the centre of 2 relative to that of 1.
fn relative_displacement(paper: &PaperTheory) -> Finding {
    let at_rest = Displacements::default();
    kinematics(|moved| {
        let seen = |moved: &Displacements| moved.lower() - moved.upper();
        (paper.relative_displacement_vector(moved) - (seen(moved) - seen(&at_rest))).norm()
    })
}

fn normal_component(paper: &PaperTheory) -> Finding {
    kinematics(|moved| {
        let gap = moved.surface_gap().dot(&moved.normal());
        (paper.normal_component(moved) - gap).abs()
    })
}

fn tangential_component(paper: &PaperTheory) -> Finding {
    kinematics(|moved| {
        let gap = moved.surface_gap().dot(&turned(moved.normal()));
        (paper.tangential_component(moved) - gap).abs()
    })
}

/// (S21) to (S23) with the supplement's own forces, at solutions of the unreduced equations.
fn supplement_balances(paper: &PaperTheory) -> Finding {
    let deviations = yield_states().iter().map(|state| {
        let moved = &state.displacements;
        let forces = paper.forces(moved, state.ratio);
        let normal = moved.normal();
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
