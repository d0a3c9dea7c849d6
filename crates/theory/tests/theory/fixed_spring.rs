//! The exact limit where nothing turns the tangential spring, against the bodies themselves moved in small steps. Parameters
//! are chosen here; no number is taken from elsewhere, but for those of one table that another program gave.

mod march;

use march::{Bodies, State, extrapolated, secant};
use tristack_theory::model::{
    Arms, ContactArms, ContactConvention, HistoryUpdate, Law, Power, Stack, TangentialHistory,
};
use tristack_theory::theory::{Event, Limit, quasistatic_limit};

/// A stack and its contacts, as plain numbers.
#[derive(Debug, Clone, Copy)]
pub struct Problem {
    bodies: u8,
    mu: f64,
    mu_d: f64,
    stiffness: f64,
    kappa: f64,
    power: Power,
    keeps_force: bool,
    floor_ratio: f64,
    /// Torque and kinematic arm of pairs, then of the floor.
    arms: [f64; 4],
}

const PLAIN: Problem = Problem {
    bodies: 2,
    mu: 0.31,
    mu_d: 0.7,
    stiffness: 137.0,
    kappa: 2.3,
    power: Power::Linear,
    keeps_force: false,
    floor_ratio: 1.0,
    arms: [0.0; 4],
};

impl Problem {
    fn count(&self) -> f64 {
        f64::from(self.bodies)
    }

    fn weight(&self) -> f64 {
        self.stiffness.recip()
    }

    /// Distance of a bottom body from the axis, and height of the top one over it, without weight.
    fn ring(&self) -> (f64, f64) {
        let radius = (std::f64::consts::PI / self.count()).sin().recip();
        (radius, (4.0 - radius * radius).sqrt())
    }

    /// Outward part of the forces of all neighbours on a body, over that of one.
    fn push(&self) -> f64 {
        match self.bodies {
            2 => 1.0,
            _ => 2.0 * (std::f64::consts::PI / self.count()).sin(),
        }
    }

    fn stack(&self) -> Stack {
        Stack {
            bodies: self.bodies,
            stiffness_ratio: self.kappa,
            cylinder_friction: self.mu_d,
            ..Stack::paper(self.mu, self.stiffness)
        }
    }

    fn convention(&self) -> ContactConvention {
        let arms = |[torque, kinematic]: [f64; 2]| ContactArms { torque, kinematic };
        let [pair_torque, pair_kinematic, floor_torque, floor_kinematic] = self.arms;
        ContactConvention {
            arms: Arms {
                pair: arms([pair_torque, pair_kinematic]),
                floor: arms([floor_torque, floor_kinematic]),
            },
            law: Law {
                floor_ratio: self.floor_ratio,
                history: match self.keeps_force {
                    true => TangentialHistory::Force,
                    false => TangentialHistory::Displacement,
                },
                ..Law::of_power(self.power)
            },
            history_update: HistoryUpdate::Fixed,
            ..ContactConvention::PAPER
        }
    }

    fn limit(&self) -> Limit {
        quasistatic_limit(&checked(self.stack(), self.convention()))
    }

    /// Distance of two forces, in F + n + 1.
    fn apart(&self, one: f64, other: f64) -> f64 {
        (one - other).abs() / (other + self.count() + 1.0)
    }
}

fn checked(stack: Stack, convention: ContactConvention) -> tristack_theory::model::Problem {
    tristack_theory::model::Problem::new(stack, convention).expect("values in range")
}

const ARMS: [f64; 4] = [-0.5, -0.2, -0.8, 0.3];

#[test]
fn onset_is_that_of_the_bodies_where_the_bottom_is_open() {
    let hertz = Problem {
        power: Power::Hertz,
        floor_ratio: 1.3,
        kappa: 4.3,
        ..PLAIN
    };
    let problems = [
        PLAIN,
        Problem { mu: 0.21, ..PLAIN },
        Problem {
            arms: ARMS,
            ..PLAIN
        },
        Problem {
            floor_ratio: 1.7,
            mu: 0.44,
            ..PLAIN
        },
        hertz,
        Problem {
            keeps_force: true,
            arms: ARMS,
            ..hertz
        },
        Problem {
            bodies: 3,
            mu: 0.37,
            arms: ARMS,
            ..PLAIN
        },
        Problem {
            bodies: 5,
            mu: 0.61,
            ..PLAIN
        },
    ];
    for own in problems {
        let limit = own.limit();
        assert_eq!(limit.event, Event::FloorSlip, "{own:?}");
        let exact = limit.yield_force.unwrap();
        let bodies = Bodies::new(own, false, false);
        let stepped = |steps| {
            let settled = bodies.settled(steps);
            let excess = |state: &State| bodies.floor_excess(state);
            bodies.force_where((0.0, &settled), exact, steps, excess).0
        };
        let force = extrapolated(stepped, 40);
        let apart = own.apart(force, exact);
        println!("{own:?}: {force} {exact} {apart:e}");
        assert!(apart < 1e-10, "{own:?}: {force} {exact} {apart:e}");
    }
}

/// With so much friction between the cylinders their contact slides when the whole spring is too long for it, not its
/// part along the tangent.
#[test]
fn cylinders_slip_where_the_whole_spring_reaches_the_limit() {
    for own in [
        Problem {
            mu: 0.9,
            mu_d: 0.38,
            ..PLAIN
        },
        Problem {
            mu: 0.9,
            mu_d: 0.35,
            arms: ARMS,
            ..PLAIN
        },
    ] {
        let limit = own.limit();
        assert_eq!(limit.event, Event::CylinderSlip, "{own:?}");
        let bodies = Bodies::new(own, false, false);
        let stepped = |steps| {
            let settled = bodies.settled(steps);
            let excess = |state: &State| bodies.pair_excess(state);
            let near = Problem {
                mu: 0.9 * own.mu_d,
                ..own
            };
            let near = near.limit().yield_force.unwrap();
            let (_, state) = bodies.force_where((0.0, &settled), near, steps, excess);
            let forces = bodies.forces(&state);
            forces.floor_shear / forces.floor_normal
        };
        // With so much friction at the floor it would slip at once with the cylinders.
        let mu = extrapolated(stepped, 16);
        for (factor, event) in [
            (1.0 - 1e-9, Event::FloorSlip),
            (1.0 + 1e-9, Event::CylinderSlip),
        ] {
            let near = Problem {
                mu: mu * factor,
                ..own
            };
            assert_eq!(near.limit().event, event, "{own:?}: {mu}");
        }
    }
}

#[test]
fn onset_and_peak_are_those_of_the_bodies_where_the_bottom_is_closed() {
    let soft = Problem {
        kappa: 0.62,
        mu: 0.23,
        ..PLAIN
    };
    let hertz = Problem {
        power: Power::Hertz,
        floor_ratio: 1.3,
        kappa: 1.25,
        ..soft
    };
    for own in [
        soft,
        Problem { arms: ARMS, ..soft },
        Problem {
            bodies: 3,
            kappa: 0.5,
            mu: 0.25,
            ..soft
        },
        hertz,
        Problem {
            keeps_force: true,
            kappa: 0.9,
            ..hertz
        },
    ] {
        let limit = own.limit();
        assert_eq!(limit.event, Event::ContactCloses, "{own:?}");
        let (onset, peak) = (limit.slip_onset.unwrap(), limit.peak_force.unwrap());
        assert!(peak > onset, "{own:?}");
        let sticking = Bodies::new(own, true, false);
        let sliding = Bodies::new(own, true, true);
        let slipped = |steps| {
            let settled = sticking.settled(steps);
            let excess = |state: &State| sticking.floor_excess(state);
            sticking.force_where((0.0, &settled), onset, steps, excess)
        };
        let force = extrapolated(|steps| slipped(steps).0, 16);
        let apart = own.apart(force, onset);
        println!("{own:?}: onset {force} {onset} {apart:e}");
        assert!(apart < 1e-8, "{own:?}: onset {force} {onset} {apart:e}");
        let highest = |steps| highest(&sliding, &slipped(steps).1, steps) * own.stiffness;
        let force = extrapolated(highest, 16);
        let apart = own.apart(force, peak);
        println!("{own:?}: peak {force} {peak} {apart:e}");
        assert!(apart < 1e-8, "{own:?}: peak {force} {peak} {apart:e}");
    }
}

/// With contact 2–3 closed a stack can slide under its own weight and stand: here from the start, and from about half its weight
/// on.
#[test]
fn peak_is_that_of_the_bodies_where_they_slide_under_their_own_weight() {
    let soft = Problem {
        stiffness: 20.0,
        kappa: 0.3,
        ..PLAIN
    };
    for (own, slides_from_the_start) in [
        (Problem { mu: 0.12, ..soft }, true),
        (Problem { mu: 0.1325, ..soft }, false),
    ] {
        let limit = own.limit();
        assert_eq!(limit.event, Event::ContactCloses, "{own:?}");
        assert_eq!(limit.slip_onset, None, "{own:?}");
        let peak = limit.peak_force.unwrap();
        let sticking = Bodies::new(own, true, false);
        let sliding = Bodies::new(own, true, true);
        let lightest = sticking.loaded(1e-6, 16);
        assert_eq!(
            sticking.floor_excess(&lightest) > 0.0,
            slides_from_the_start
        );
        let settled = |steps| match slides_from_the_start {
            true => sliding.settled(steps),
            false => {
                let excess = |part: f64| sticking.floor_excess(&sticking.loaded(part, steps));
                let part = secant([0.4, 0.5], excess);
                assert!(part > 0.1 && part < 0.9, "{own:?}: {part}");
                sliding.heavier(&sticking.loaded(part, steps), part, steps)
            }
        };
        let highest = |steps| highest(&sliding, &settled(steps), steps) * own.stiffness;
        let force = extrapolated(highest, 16);
        let apart = own.apart(force, peak);
        println!("{own:?}: peak {force} {peak} {apart:e}");
        assert!(apart < 1e-11, "{own:?}: peak {force} {peak} {apart:e}");
    }
}

/// The largest force of the wall while the bottom bodies part, in so many steps to wherever it is: where they part, or before.
fn highest(sliding: &Bodies, start: &State, steps: usize) -> f64 {
    let at = |outward: f64| sliding.spread(start, outward, steps).unknowns[4];
    let (mut low, mut high) = (start.unknowns[0], 0.0);
    // Half as many digits of the place give all of the force.
    for _ in 0..45 {
        let third = (high - low) / 3.0;
        match at(low + third) < at(high - third) {
            true => low += third,
            false => high -= third,
        }
    }
    at(0.0).max(at(0.5 * (low + high)))
}

/// Of springs that turn, the rule by which they do does not show in the limit.
#[test]
fn every_rule_but_the_fixed_spring_has_one_limit() {
    let stack = Stack::paper(0.3, 100.0);
    let force = |history_update| {
        let convention = ContactConvention {
            history_update,
            ..ContactConvention::PAPER
        };
        let limit = quasistatic_limit(&checked(stack, convention));
        limit.yield_force.unwrap()
    };
    use HistoryUpdate::{Fixed, Linearised, Projected, Rotated};
    assert_eq!([Projected, Linearised].map(force), [force(Rotated); 2]);
    assert!((force(Rotated) - 30.227_048_117).abs() < 1e-9);
    assert!((force(Fixed) - 30.112_860_110).abs() < 1e-9);
}
