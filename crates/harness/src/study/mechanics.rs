//! Holds series to the laws of mechanics before anything is concluded from them.

use super::verdict::{Ground, Grounds};
use crate::series::{Deviation, MechanicalLaw, Mechanics, not_tested};

impl Grounds {
    /// Adds the violations that the `mechanics` of each run shows, one for each law that is broken, and a doubt where a
    /// run was recorded without it.
    pub(super) fn hold_to_mechanics<'a>(
        &mut self,
        mechanics: impl IntoIterator<Item = Option<&'a Mechanics>>,
    ) {
        let mut broken: Vec<Broken> = Vec::new();
        for (run, mechanics) in (1..).zip(mechanics) {
            let Some(mechanics) = mechanics else {
                self.add(Ground::Doubt(format!(
                    "run {run} was recorded before series were held to mechanics"
                )));
                continue;
            };
            for (law, deviation) in mechanics.violations() {
                let is_late = deviation.is_of_late_forces;
                let mut known = broken.iter_mut();
                match known.find(|own| own.law == law && own.first.is_of_late_forces == is_late) {
                    Some(own) => own.runs.push(run),
                    None => broken.push(Broken {
                        law,
                        first: deviation,
                        runs: vec![run],
                    }),
                }
            }
        }
        for own in broken {
            self.add(match own.first.is_of_late_forces {
                true => Ground::LateForces(own.in_words()),
                false => Ground::Violation(own.in_words()),
            });
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

/// A law that some runs break.
struct Broken<'a> {
    law: MechanicalLaw,
    /// The deviation in the first of them.
    first: &'a Deviation,
    runs: Vec<usize>,
}

impl Broken<'_> {
    fn in_words(&self) -> String {
        let side = |side: Option<f64>| side.unwrap_or(f64::NAN);
        let others: Vec<String> = self.runs[1..].iter().map(usize::to_string).collect();
        let others = match others.len() {
            0 => String::new(),
            1 => format!("; run {} breaks it too", others[0]),
            _ => format!("; runs {} break it too", others.join(", ")),
        };
        format!(
            "run {} breaks {}: at step {} it is {:.9}, and must be {:.9} m g; {:.1e} apart where {:.1e} is allowed{others}",
            self.runs[0],
            self.law.as_str(),
            self.first.step,
            side(self.first.found),
            side(self.first.expected),
            self.first.size,
            self.first.bound
        )
    }
}
