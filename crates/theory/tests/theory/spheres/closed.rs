//! What has a closed form: rigid spheres, their own weight, the conditions of events, and where the contact of neighbours
//! closes.

use super::{Problem, root};
use tristack_theory::model::{ContactConvention, Stack};
use tristack_theory::theory::{Event, Predictions, rigid_yield};

fn stack(bodies: u8, mu: f64, stiffness: f64) -> Stack {
    Stack {
        bodies,
        ..Stack::paper(mu, stiffness)
    }
}

fn predictions(stack: Stack) -> Predictions {
    let problem = tristack_theory::model::Problem::new(stack, ContactConvention::TURNING);
    Predictions::new(&problem.expect("values in range"))
}

#[test]
fn rigid_spheres_yield_at_the_force_of_their_pyramid() {
    // sin ψ₀ over a pentagon: 1/(2 sin 36°).
    let sine_of_five = 2.0 / (10.0 - 2.0 * 5f64.sqrt()).sqrt();
    let critical = [
        (3, 3f64.sqrt() - 2f64.sqrt()),
        (4, 2f64.sqrt() - 1.0),
        (5, (0.5 * sine_of_five.asin()).tan()),
    ];
    for (bodies, critical) in critical {
        let weight = f64::from(bodies) + 1.0;
        assert!((stack(bodies, 0.3, 1e2).ring().critical_friction - critical).abs() < 1e-15);
        let mu = 0.61 * critical;
        let force = rigid_yield(&stack(bodies, mu, 1e4)).yield_force.unwrap();
        let expected = (weight * mu - critical) / (critical - mu);
        assert!((force - expected).abs() < 1e-12, "{bodies}");
        // Almost rigid ones: the first correction is of the order of 1/stiffness.
        let stiff = predictions(stack(bodies, mu, 1e8));
        let limit = stiff.quasistatic.yield_force.unwrap();
        assert!(
            (limit - expected).abs() < 1e-6,
            "{bodies} {limit} {expected}"
        );
        for theory in [stiff.naive, stiff.perturbation, stiff.elastic] {
            assert!((theory.yield_force.unwrap() - expected).abs() < 1e-6);
        }
        assert!(rigid_yield(&stack(bodies, critical + 1e-15, 1e4)).diverges);
    }
}

/// The problem of four balls, and of more: they stand on a floor of at least the friction μ_c/(n + 1).
#[test]
fn stiff_spheres_slide_under_their_own_weight_below_the_critical_friction_over_their_number() {
    for bodies in 3..=5 {
        let threshold =
            stack(bodies, 0.3, 1e2).ring().critical_friction / (f64::from(bodies) + 1.0);
        let at = |factor: f64| {
            let stack = stack(bodies, factor * threshold, 1e8);
            predictions(stack).quasistatic
        };
        let (sliding, standing) = (at(1.0 - 1e-6), at(1.0 + 1e-6));
        assert!(sliding.rest.is_none() && sliding.reason.unwrap().contains("own weight"));
        assert!(standing.yield_force.unwrap() < 1e-5);
        let [outward, top, bottom] = standing.rest.unwrap();
        let distance = outward.hypot(top - bottom);
        assert!((distance - 2.0).abs() < 1e-7 && (bottom - 1.0).abs() < 1e-7);
    }
}

/// Arms 0 and c = 0: F = ((n + 1) μ − T)/(T − μ), and y of the geometry.
#[test]
fn state_at_yield_is_that_of_the_balances() {
    for bodies in 3..=5 {
        for (mu, stiffness) in [(0.21, 90.0), (0.33, 2.2e3)] {
            let own = Problem {
                bodies,
                mu,
                stiffness,
                ..Problem::LINEAR
            };
            let limit = own.limit();
            let (tangent, force) = (limit.tangent.unwrap(), limit.yield_force.unwrap());
            let balanced = ((own.count() + 1.0) * mu - tangent) / (tangent - mu);
            assert!(own.deviation(force, balanced) < 1e-12);
            let overlap = own.weight() * (force + 1.0) / own.count();
            let sine = (2.0 * tangent.atan()).sin();
            let outward = (2.0 - overlap) * sine - own.radius();
            assert!((limit.y.unwrap() - outward).abs() < 1e-14);
            assert!((limit.z.unwrap() - overlap - own.weight()).abs() < 1e-14);
        }
    }
}

#[test]
fn the_first_event_is_the_one_whose_condition_is_met_first() {
    for bodies in 3..=5 {
        let limit = |mu: f64, mu_d: f64| {
            let stack = Stack {
                cylinder_friction: mu_d,
                ..stack(bodies, mu, 1e2)
            };
            predictions(stack).quasistatic
        };
        // Spheres slip on each other at T = μ_d.
        let slippery = stack(bodies, 0.3, 1e2).ring().critical_friction + 0.04;
        let slips = |mu: f64| limit(mu, slippery).event == Event::CylinderSlip;
        let sides = |mu: f64| if slips(mu) { 1.0 } else { -1.0 };
        let tangent = limit(root(sides, 0.3, 0.9), slippery).tangent.unwrap();
        assert!((tangent - slippery).abs() < 1e-12, "{bodies} {tangent}");
        // The wall comes to the top of the bottom spheres where ρ cos ψ = f.
        let touches = |mu: f64| limit(mu, 9.0).event == Event::WallContact;
        let sides = |mu: f64| if touches(mu) { 1.0 } else { -1.0 };
        let touching = limit(root(sides, 0.3, 0.9), 9.0);
        let (tangent, force) = (
            touching.tangent.unwrap(),
            touching.floor_slip_force.unwrap(),
        );
        let overlap = 0.01 * (force + 1.0) / f64::from(bodies);
        let rise = (2.0 - overlap) * (2.0 * tangent.atan()).cos();
        assert!((rise / (0.01 * force) - 1.0).abs() < 1e-12, "{bodies}");
    }
}

/// Neighbours close at once where κ c_l/m < 2/(1 − μ_c²), c_l = 1 + w^(−1/p) (n + 1)^(−(p−1)/p), m = 1 or p.
#[test]
fn neighbours_close_below_a_stiffness_ratio() {
    for bodies in 3..=5 {
        for base in [
            Problem::LINEAR,
            Problem::HERTZ,
            Problem {
                history: tristack_theory::model::TangentialHistory::Force,
                ..Problem::HERTZ
            },
        ] {
            let own = Problem {
                bodies,
                mu: 0.12,
                stiffness: 1e6,
                ..base
            };
            let p = own.power.value();
            let compliance =
                1.0 + own.floor_ratio.powf(-1.0 / p) * (own.count() + 1.0).powf(-(p - 1.0) / p);
            let growth = if own.keeps_force() { 1.0 } else { p };
            let threshold = 2.0 * growth / (1.0 - own.start() * own.start()) / compliance;
            let closes = |factor: f64| {
                let kappa = factor * threshold;
                Problem { kappa, ..own }.limit().event == Event::ContactCloses
            };
            assert!(closes(0.999) && !closes(1.001), "{own:?}");
        }
    }
}
