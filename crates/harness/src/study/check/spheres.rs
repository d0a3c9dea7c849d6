//! Items on a stack of spheres: the laws of mechanics, the slip onset of the native code, and the onset of the same
//! stack in other arrangements.

use super::report::{Grade, Item};
use super::stack::rings_longer;
use crate::dem::compress_stack;
use crate::model::{Arrangement, Case, ContactConvention, Problem, Stack};
use crate::series::{Mechanics, Series, YieldEstimates};
use crate::study::MAX_TOLERANCE;
use crate::study::yield_force::planned_protocol;
use crate::theory::quasistatic_limit;

/// Friction and stiffness: soft, so that every convention shows, and below the friction at which symmetry is lost.
const FRICTION: f64 = 0.2;
const STIFFNESS: f64 = 100.0;
/// Wall speed in the unit of planned measurements ([`planned_protocol`]).
const SPEED: f64 = 4e-3;
const TIME_STEP: f64 = 0.1;

/// Returns the case of a sphere on three under this `convention`, in this `arrangement`; `None` where it does not
/// yield.
pub(super) fn case(convention: ContactConvention, arrangement: Arrangement) -> Option<Case> {
    let stack = Stack {
        stiffness_ratio: Stack::usual_stiffness_ratio(convention.law.power),
        bodies: 3,
        arrangement,
        ..Stack::paper(FRICTION, STIFFNESS)
    };
    let convention = convention.of_bodies(&stack);
    let limit = quasistatic_limit(&Problem::new(stack, convention).ok()?);
    let protocol = planned_protocol(&limit, &stack, &convention, SPEED, TIME_STEP)?;
    Some(Case {
        stack,
        convention,
        protocol,
    })
}

/// Other arrangements of the same stack, each with the name of its item: turned by an irrational fraction of a
/// circle, mirrored, and renumbered so that the sphere on top is neither first nor last.
pub(super) const OTHERS: [(&str, Arrangement); 3] = [
    (
        "spheres turned by 1 rad",
        Arrangement { turn: 1.0, ..USUAL },
    ),
    (
        "spheres mirrored",
        Arrangement {
            mirrored: true,
            ..USUAL
        },
    ),
    (
        "spheres numbered otherwise",
        Arrangement {
            renumbered: 2,
            ..USUAL
        },
    ),
];

const USUAL: Arrangement = Arrangement {
    turn: 0.0,
    mirrored: false,
    renumbered: 0,
    displacement: 0.0,
};

const MECHANICS: &str = "spheres: mechanics";
const TWIN: &str = "spheres: slip onset";

/// Returns the items on the `series` of `case`. `is_declared` says whether the manifest declares the whole
/// convention, and `is_late` whether the forces that move the bodies are known to be late.
pub(super) fn items(series: &Series, case: &Case, is_declared: bool, is_late: bool) -> [Item; 2] {
    let grade = Grade::Consistency;
    let mechanics = Mechanics::read(series, case);
    let broken = mechanics.violations().next();
    let mechanics = match broken {
        None => Item::passed(
            grade,
            MECHANICS,
            "balance of forces, symmetry of the ring, overlaps",
        ),
        Some((_, deviation)) if is_late && deviation.is_of_late_forces => {
            Item::remark(grade, MECHANICS, rings_longer(deviation))
        }
        Some((law, deviation)) => Item::failed(
            grade,
            MECHANICS,
            format!("{} to {:.1e} m g", law.as_str(), deviation.bound),
            format!(
                "off by {:.1e} m g at step {}",
                deviation.size, deviation.step
            ),
            usual("a component of a force, a spin or a torque that has the wrong sign or axis"),
        ),
    };
    [mechanics, beside_twin(series, case, is_declared)]
}

/// Compares the slip onset with that of the native code under the same convention.
fn beside_twin(series: &Series, case: &Case, is_declared: bool) -> Item {
    let grade = Grade::Consistency;
    if !is_declared {
        let reason = "code.toml leaves a part of the convention out; `tristack crosscheck --bodies 3` measures it first";
        return Item::not_tested(grade, TWIN, reason);
    }
    let twin = compress_stack(case, || true).ok();
    let expected = twin.and_then(|twin| onset(&twin, case));
    let (Some(expected), found) = (expected, onset(series, case)) else {
        return Item::not_tested(grade, TWIN, "the native code shows no onset");
    };
    let Some(found) = found else {
        let expected = format!("{expected:.9} m g");
        return Item::failed(
            grade,
            TWIN,
            expected,
            "none",
            usual("the floor does not slide"),
        );
    };
    let error = (found - expected) / case.stack.floor_load(expected);
    match error.abs() <= MAX_TOLERANCE {
        true => Item::passed(
            grade,
            TWIN,
            format!("{found:.9} m g, {error:+.1e} from the native code"),
        ),
        false => Item::failed(
            grade,
            TWIN,
            format!(
                "{expected:.9} m g, as the native code has under the same convention, to {MAX_TOLERANCE:e} of the load"
            ),
            format!("{found:.9} m g ({error:+.1e})"),
            usual("arms, stiffness or friction of spheres are others than those of cylinders"),
        ),
    }
}

/// Returns the item `name`, which compares the onset in `series` with that in `usual_series`: both belong to the same
/// stack, in different arrangements.
pub(super) fn seen_from_elsewhere(
    name: &'static str,
    (series, case): (&Series, &Case),
    (usual_series, usual_case): (&Series, &Case),
) -> Item {
    let grade = Grade::Consistency;
    let onsets = (onset(series, case), onset(usual_series, usual_case));
    let (Some(found), Some(expected)) = onsets else {
        return Item::not_tested(grade, name, "a run shows no onset");
    };
    // In both runs every step may round a coordinate between 2 and 4 to the same side. That changes the load by the
    // stiffness against the wall and the floor, and by the slope at which the onset is read.
    let steps = case.protocol.schedule().total_steps() as f64;
    let rounding =
        2.0 * 2.0 * f64::EPSILON * steps * case.stack.stiffness * sensitivity(series, case);
    let apart = (found - expected).abs();
    match apart <= rounding {
        true => Item::passed(grade, name, format!("the same onset to {apart:.1e} m g")),
        false => Item::failed(
            grade,
            name,
            format!("{expected:.12} m g, the same onset to rounding ({rounding:.0e})"),
            format!("{found:.12} m g, {apart:.1e} away"),
            usual(
                "a rotation, a frame or a sum that depends on the axes or on the order of bodies; a wall of triangles with an edge below",
            ),
        ),
    }
}

fn usual(cause: &str) -> Vec<String> {
    vec![cause.to_owned()]
}

fn onset(series: &Series, case: &Case) -> Option<f64> {
    Some(YieldEstimates::read(series, case).slip?.force)
}

fn sensitivity(series: &Series, case: &Case) -> f64 {
    let slip = YieldEstimates::read(series, case).slip;
    slip.map_or(1.0, |slip| slip.sensitivity)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::HistoryUpdate;
    use crate::study::check::Outcome;

    #[test]
    fn the_native_code_has_the_same_onset_however_its_spheres_lie_and_are_numbered() {
        for history_update in [
            HistoryUpdate::Rotated,
            HistoryUpdate::Projected,
            HistoryUpdate::Linearised,
        ] {
            let convention = ContactConvention {
                history_update,
                ..ContactConvention::TURNING
            };
            let run = |arrangement| {
                let case = case(convention, arrangement).unwrap();
                (compress_stack(&case, || true).unwrap(), case)
            };
            let (usual, usual_case) = run(USUAL);
            for item in items(&usual, &usual_case, true, false) {
                assert_eq!(item.outcome, Outcome::Passed, "{item:?}");
            }
            for (name, arrangement) in OTHERS {
                let (series, case) = run(arrangement);
                let item = seen_from_elsewhere(name, (&series, &case), (&usual, &usual_case));
                assert_eq!(item.outcome, Outcome::Passed, "{item:?}");
            }
        }
    }

    #[test]
    fn another_friction_is_no_view_of_the_same_stack() {
        let case = case(ContactConvention::TURNING, USUAL).unwrap();
        let mut other = case;
        other.stack.floor_friction *= 1.0 + 1e-6;
        let run = |case: &Case| compress_stack(case, || true).unwrap();
        let (series, usual) = (run(&other), run(&case));
        let item = seen_from_elsewhere("turned", (&series, &other), (&usual, &case));
        assert_eq!(item.outcome, Outcome::Failed, "{item:?}");
    }
}
