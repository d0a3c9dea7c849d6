//! Whether a ring of spheres keeps its symmetry until it yields.

use crate::dem::compress_stack;
use crate::model::{Arrangement, Case, PAPER_BODIES};
use crate::series::{MechanicalLaw, Mechanics};

/// Distance by which one sphere is displaced, small enough for its effect to stay linear.
const DISTURBANCE: f64 = 1e-9;
/// Largest growth of a disturbance that leaves a run symmetric. Rounding disturbs a run by some 1e-15 r, and a
/// symmetric run is held to 1e-10 r or more ([`Mechanics`]).
const MOST_GROWTH: f64 = 1e4;

/// Says why the run of `case` cannot reach the limit of the symmetric stack: in the native code under the same
/// convention, its symmetry is lost before the floor slips, from whatever rounding leaves. `None` if it can.
///
/// If the spheres of a ring roll along it, and the top sphere against them, they move without stretching a spring.
/// With torque arms that end inside the overlap, the load drives that motion, the faster the larger load and overlap
/// are.
pub(super) fn lost_before_yield(case: &Case) -> Option<String> {
    if case.stack.bodies == PAPER_BODIES {
        return None;
    }
    let growth = growth(case)?;
    (growth > MOST_GROWTH).then(|| {
        format!(
            "the symmetric stack is unstable: of one sphere displaced by {DISTURBANCE:e} r an asymmetry is left that grows to {growth:.0e} \
             times that before the floor slips, so that rounding decides how the stack yields"
        )
    })
}

fn growth(case: &Case) -> Option<f64> {
    let mut disturbed = *case;
    disturbed.stack.arrangement = Arrangement {
        displacement: DISTURBANCE,
        ..case.stack.arrangement
    };
    let series = compress_stack(&disturbed, || true).ok()?;
    let mechanics = Mechanics::read(&series, case);
    let asymmetry = mechanics.0.get(&MechanicalLaw::MirrorSymmetry)?;
    Some(asymmetry.size * case.stack.epsilon() / DISTURBANCE)
}
