//! Holds series to the laws of mechanics before anything is concluded from them.

use super::verdict::{Ground, Grounds};
use crate::series::{Deviation, MechanicalLaw, Mechanics, not_tested};

impl Grounds {
    /// Adds the violations that the `mechanics` of each run shows, in order, and a doubt where a run was recorded
    /// without it.
    pub(super) fn hold_to_mechanics<'a>(
        &mut self,
        mechanics: impl IntoIterator<Item = Option<&'a Mechanics>>,
    ) {
        for (run, mechanics) in (1..).zip(mechanics) {
            match mechanics {
                Some(mechanics) => {
                    let violations = mechanics.violations();
                    for (law, deviation) in violations {
                        let note = violation(run, law, deviation);
                        self.add(match deviation.is_of_late_forces {
                            true => Ground::LateForces(note),
                            false => Ground::Violation(note),
                        });
                    }
                }
                None => self.add(Ground::Doubt(format!(
                    "run {run} was recorded before series were held to mechanics"
                ))),
            }
        }
    }

    /// Adds a doubt about the checks that could not be made because the code does not report the columns `absent`.
    pub(super) fn doubt_what_is_not_tested(&mut self, absent: &[String]) {
        if absent.is_empty() {
            return;
        }
        let checks: Vec<&str> = not_tested(absent).collect();
        self.add(Ground::Doubt(format!(
            "not tested, because the code does not report {}: {}",
            absent.join(", "),
            checks.join("; ")
        )));
    }
}

fn violation(run: usize, law: MechanicalLaw, deviation: &Deviation) -> String {
    let side = |side: Option<f64>| side.unwrap_or(f64::NAN);
    format!(
        "run {run} breaks {}: at step {} it is {:.9}, and must be {:.9} m g; {:.1e} apart where {:.1e} is allowed",
        law.as_str(),
        deviation.step,
        side(deviation.found),
        side(deviation.expected),
        deviation.size,
        deviation.bound
    )
}
