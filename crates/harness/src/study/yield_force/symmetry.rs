//! Whether a ring of spheres keeps its symmetry until it yields.

use crate::dem::compress_stack;
use crate::model::{Arrangement, Case, PAPER_BODIES};
use crate::series::{Law, Mechanics};

/// Distance by which one sphere is displaced, small enough for its effect to stay linear.
const DISTURBANCE: f64 = 1e-9;
/// Largest growth of a disturbance that leaves a run symmetric: rounding disturbs a run by some 1e-15 r, and a symmetric
/// one is held to 1e-10 r and more ([`Mechanics`]).
const MOST_GROWTH: f64 = 1e4;

/// Why the limit of the symmetric stack cannot be reached by the run of `case`: its symmetry is lost before the floor slips, from
/// whatever rounding leaves, in the native code under the same convention. `None` where it can.
///
/// A ring whose spheres roll along it, and the top sphere against them, moves without stretching a spring. Torque arms that end
/// inside the overlap make the load drive that motion, the faster the larger load and overlap are.
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
    let asymmetry = mechanics.0.get(&Law::MirrorSymmetry)?;
    Some(asymmetry.size * case.stack.epsilon() / DISTURBANCE)
}
