//! The parts of the numerical uncertainty of a yield force.

use super::runs::{Method, RunRoles};

/// The parts of the numerical uncertainty, u_num of ASME V&V 20; each is an expected largest error in m g.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Budget {
    /// Distance between the extrapolations of second and first order in the wall speed. At one speed: the
    /// second-order part of what theory expects the speed to add, plus what is left of the touch of the wall.
    pub wall_speed: f64,
    /// Change of the middle run when the time step is doubled: the error at the single step if it is of first order,
    /// three times that error if it is of second. Springs that remember forces are summed with their stiffness at the
    /// end of each step, which gives an error proportional to the wall's displacement in a step. For them this is the
    /// change of the straight line through the two faster runs, from which that error has vanished with the speed. A
    /// bound, or absent, if there is no such run.
    pub time_step: Option<f64>,
    /// Change of the middle run with the gravity ramp halved. Damping along the ramp shifts the settled
    /// state by an amount inversely proportional to its duration, so that this is the shift itself.
    /// A bound, or absent, if there is no such run.
    pub preparation: Option<f64>,
    /// Distance between two interpolations of different order between the rows, as the extrapolation amplifies it.
    pub sampling: f64,
    /// Rounding of positions in every step, accumulated as a random walk and amplified by the estimator of the force
    /// and by the extrapolation. Contacts restore positions, so that twins of higher precision find ten times less
    /// (tests/physics/round_off.rs).
    pub round_off: f64,
    /// Half a unit of the last digit that the code prints, amplified in the same way: the seventeenth digit, unless
    /// the series has fewer.
    pub print_precision: f64,
    /// Change of the straight line through the two faster runs when these take no shortcuts; 0 if no run takes any.
    /// The error of shortcuts is mostly linear in the wall speed, and vanishes with it.
    pub shortcuts: f64,
    /// Change of the exact limit within the uncertainty of measured arms; absent if all are declared.
    pub convention: Option<f64>,
}

/// One part of a [`Budget`], as tables and explanations give it.
#[derive(Debug, Clone, Copy)]
pub struct BudgetPart {
    /// Name of its column in files.
    pub name: &'static str,
    /// Name in explanations.
    pub heading: &'static str,
    /// Its formula, in words.
    pub how: &'static str,
    /// The further run that makes it known; empty if none is needed.
    pub known_by: &'static str,
    /// Its value in m g; absent if it is not known, or does not apply.
    pub value: fn(&Budget) -> Option<f64>,
}

impl BudgetPart {
    /// Its formula in words, for any set of runs.
    pub fn meaning(&self) -> &'static str {
        match self.name {
            TIME_STEP => {
                "run 4 minus run 2 (time step doubled); of springs that remember forces the line through runs 6 and 4 minus that \
                 through 1 and 2"
            }
            _ => self.how,
        }
    }

    /// Its formula in words, for a force read by this `method` from runs with these `roles`.
    pub fn how(&self, method: Method, roles: &RunRoles) -> &'static str {
        match (self.name, method) {
            (WALL_SPEED, Method::AtOneSpeed) => {
                "what is left of the touch, and the second order of what theory expects of the speed"
            }
            (WALL_SPEED, Method::Literal) => {
                "change with the wall twice as fast, less what theory expects of it"
            }
            (ROUND_OFF, Method::Literal) => "rounding of each step of the wall",
            (ROUND_OFF, Method::AtOneSpeed) => {
                "rounding of each step of the wall, and of all as a random walk"
            }
            (TIME_STEP, _) if roles.coarse_and_fast.is_some() => {
                "line through runs 6 and 4 minus line through 1 and 2 (time step doubled)"
            }
            (TIME_STEP, _) if roles.coarse_time_step.is_none() => {
                "at most: what two steps of the wall load"
            }
            (PREPARATION, _) if roles.short_ramp.is_none() => {
                "at most: distance of the start from rest, amplified"
            }
            (TIME_STEP, Method::AtOneSpeed) => "change with the time step doubled",
            (PREPARATION, Method::AtOneSpeed) => "change with the gravity ramp halved",
            _ => self.how,
        }
    }

    /// Whether the run that shows it exists, if it needs one.
    fn has_run(&self, roles: &RunRoles) -> bool {
        match self.name {
            TIME_STEP => roles.coarse_time_step.is_some(),
            PREPARATION => roles.short_ramp.is_some(),
            _ => true,
        }
    }
}

/// Name of the part of the wall speed.
const WALL_SPEED: &str = "wall_speed";
/// Name of the part of the time step.
const TIME_STEP: &str = "time_step";
/// Name of the part of the preparation.
const PREPARATION: &str = "preparation";
/// Name of the part of rounding.
const ROUND_OFF: &str = "round_off";

impl Budget {
    /// The parts, in order; the uncertainty is their sum.
    pub const PARTS: [BudgetPart; 8] = [
        BudgetPart {
            name: WALL_SPEED,
            heading: "wall speed",
            how: "parabola minus straight line",
            known_by: "",
            value: |budget| Some(budget.wall_speed),
        },
        BudgetPart {
            name: TIME_STEP,
            heading: "time step",
            how: "run 4 minus run 2 (time step doubled)",
            known_by: "a further run with twice the time step (--coarse-step)",
            value: |budget| budget.time_step,
        },
        BudgetPart {
            name: PREPARATION,
            heading: "preparation",
            how: "run 5 minus run 2 (gravity ramp halved)",
            known_by: "a further run with half the gravity ramp (--short-ramp)",
            value: |budget| budget.preparation,
        },
        BudgetPart {
            name: "sampling",
            heading: "sampling",
            how: "distance between interpolations, weighted",
            known_by: "",
            value: |budget| Some(budget.sampling),
        },
        BudgetPart {
            name: ROUND_OFF,
            heading: "round-off",
            how: "random walk of rounding, amplified, weighted",
            known_by: "",
            value: |budget| Some(budget.round_off),
        },
        BudgetPart {
            name: "print_precision",
            heading: "print precision",
            how: "half a unit of the last digit printed, amplified, weighted",
            known_by: "",
            value: |budget| Some(budget.print_precision),
        },
        BudgetPart {
            name: "shortcuts",
            heading: "shortcuts",
            how: "straight line through the last two runs (without shortcuts) minus that through 1 and 2",
            known_by: "",
            value: |budget| Some(budget.shortcuts),
        },
        BudgetPart {
            name: "convention",
            heading: "convention",
            how: "slopes of the limit times the uncertainty of measured arms, if any",
            known_by: "",
            value: |budget| budget.convention,
        },
    ];

    /// The expanded uncertainty: the sum of the known parts. It is never below their root sum of squares, with which
    /// V&V 20 combines independent parts.
    pub fn total(&self) -> f64 {
        let parts = Self::PARTS.iter();
        parts.filter_map(|part| (part.value)(self)).sum()
    }

    /// The parts of which only a bound is known if the runs have these `roles`, with their bounds.
    pub(crate) fn bounded(&self, roles: &RunRoles) -> impl Iterator<Item = (BudgetPart, f64)> {
        let parts = Self::PARTS.into_iter();
        let bounded = parts.filter(|part| !part.has_run(roles));
        bounded.filter_map(|part| Some((part, (part.value)(self)?)))
    }

    /// The parts that are not known.
    pub fn unknown(&self) -> impl Iterator<Item = BudgetPart> {
        let parts = Self::PARTS.into_iter();
        parts.filter(|part| !part.known_by.is_empty() && (part.value)(self).is_none())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A part that no run shows is only bounded, whatever the method.
    #[test]
    fn a_part_says_how_it_is_known() {
        let alone = RunRoles {
            coarse_time_step: None,
            short_ramp: None,
            ..RunRoles::PLANNED
        };
        let how = |name: &str, method: Method, roles: &RunRoles| {
            let part = Budget::PARTS.into_iter().find(|part| part.name == name);
            part.expect("a part").how(method, roles)
        };
        for method in [Method::Extrapolated, Method::AtOneSpeed] {
            for name in [TIME_STEP, PREPARATION] {
                assert!(how(name, method, &alone).starts_with("at most: "), "{name}");
                assert!(!how(name, method, &RunRoles::PLANNED).contains("at most"));
            }
        }
        let touch = how(WALL_SPEED, Method::AtOneSpeed, &alone);
        assert!(touch.contains("touch") && touch.contains("second order"));
        let literal = how(WALL_SPEED, Method::Literal, &RunRoles::PLANNED);
        assert!(literal.contains("twice as fast"));
        let planned = how(WALL_SPEED, Method::Extrapolated, &RunRoles::PLANNED);
        assert_eq!(planned, "parabola minus straight line");
    }

    #[test]
    fn the_budget_lists_its_parts_in_order_and_adds_them_up() {
        let budget = Budget {
            wall_speed: 1.0,
            time_step: Some(2.0),
            preparation: Some(4.0),
            sampling: 8.0,
            round_off: 16.0,
            print_precision: 32.0,
            shortcuts: 64.0,
            convention: None,
        };
        let parts = [
            ("wall speed", 1.0),
            ("time step", 2.0),
            ("preparation", 4.0),
            ("sampling", 8.0),
            ("round-off", 16.0),
            ("print precision", 32.0),
            ("shortcuts", 64.0),
        ];
        let named = |budget: &Budget| {
            let parts = Budget::PARTS.into_iter();
            let named = parts.filter_map(|part| Some((part.heading, (part.value)(budget)?)));
            named.collect::<Vec<_>>()
        };
        assert_eq!(named(&budget), parts);
        assert_eq!(budget.total(), 127.0);
        let measured = Budget {
            convention: Some(128.0),
            ..budget
        };
        assert_eq!(named(&measured).last(), Some(&("convention", 128.0)));
        assert_eq!(measured.total(), 255.0);
        assert_eq!(budget.unknown().count(), 0);
        let unknown = Budget {
            time_step: None,
            ..budget
        };
        assert_eq!(unknown.total(), 125.0);
        let names: Vec<&str> = unknown.unknown().map(|part| part.heading).collect();
        assert_eq!(names, ["time step"]);
    }
}
