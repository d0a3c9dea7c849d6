//! Arms 0 and c = 0: a differential equation for T(G) (docs/theory.md, Eq. 84), of which the overlap is the argument.

use super::{Problem, at_vanishing_step, root};
use tristack::model::{Power, TangentialHistory};
use tristack::theory::Event;

/// Where the stack stands: on the gravity ramp or under the wall.
#[derive(Clone, Copy, PartialEq)]
enum Phase {
    Ramp,
    Wall,
}

/// dT/dG, from u₁₂ + u_f = ∫ρ dψ + x₂ − 1 with the tangential forces b = e = Gᵖ T.
fn slope(own: &Problem, phase: Phase, tangent: f64, overlap: f64) -> f64 {
    let p = own.power.value();
    let square = 1.0 + tangent * tangent;
    let normal = overlap.powf(p);
    let (floor, floor_slope) = match phase {
        Phase::Ramp => (3.0 * normal, 3.0),
        Phase::Wall => (normal + own.epsilon(), 1.0),
    };
    let floor_kappa = own.floor_kappa.unwrap_or(own.kappa);
    let sunk = (floor / own.floor_ratio).powf((p - 1.0) / p) * own.floor_ratio;
    // (1/k_c + 1/k_f) a.
    let stretch = own.kappa / p * overlap + floor_kappa / p * normal / sunk;
    let turning = 4.0 * (2.0 - overlap) / (square * square);
    let widening = 2.0 * tangent / square;
    match own.keeps_force() {
        // k du = db: every increment of b at the stiffness there.
        true => {
            let growth = own.kappa + floor_kappa * normal / overlap / sunk;
            (widening + tangent * growth) / (turning - stretch)
        }
        false => {
            let sinking = floor_slope * p * normal / overlap / floor;
            let floor_part = floor_kappa / p * normal / sunk;
            let growth = floor_part * (p / overlap - (p - 1.0) / p * sinking);
            (widening + tangent * (own.kappa / p + growth)) / (turning - stretch)
        }
    }
}

/// T after `steps` of Runge's and Kutta's method, in the overlap on the ramp and in its logarithm under the wall.
fn advance(own: &Problem, phase: Phase, from: [f64; 2], to: f64, steps: usize) -> f64 {
    let [mut tangent, start] = from;
    let [start, end] = [start, to].map(|overlap: f64| match phase {
        Phase::Ramp => overlap,
        Phase::Wall => overlap.ln(),
    });
    let width = (end - start) / steps as f64;
    let at = |tangent: f64, argument: f64| match phase {
        // At overlap 0 the slope is a limit: so small an overlap gives it.
        Phase::Ramp => slope(own, phase, tangent, argument.max(1e-30 * to)),
        Phase::Wall => argument.exp() * slope(own, phase, tangent, argument.exp()),
    };
    for step in 0..steps {
        let argument = start + width * step as f64;
        let first = at(tangent, argument);
        let second = at(tangent + 0.5 * width * first, argument + 0.5 * width);
        let third = at(tangent + 0.5 * width * second, argument + 0.5 * width);
        let fourth = at(tangent + width * third, argument + width);
        tangent += width * (first + 2.0 * (second + third) + fourth) / 6.0;
    }
    tangent
}

/// F at the slip of the floor in so many steps a phase.
fn stepped_onset(own: &Problem, steps: usize) -> f64 {
    let (p, epsilon) = (own.power.value(), own.epsilon());
    let settled = (0.5 * epsilon).powf(1.0 / p);
    let start = [2.0 - 3f64.sqrt(), 0.0];
    let tangent = advance(own, Phase::Ramp, start, settled, steps);
    let excess = |overlap: f64| {
        let tangent = advance(own, Phase::Wall, [tangent, settled], overlap, steps);
        overlap.powf(p) * (tangent - own.mu) - own.mu * epsilon
    };
    let mut high = 1.01 * settled;
    while excess(high) < 0.0 {
        high *= 1.05;
    }
    let overlap = root(excess, settled, high);
    2.0 * overlap.powf(p) / epsilon - 1.0
}

/// F at the slip of the floor. The error of the method is of fourth order: two orders are taken off it.
fn onset(own: &Problem) -> f64 {
    let [coarse, fine] = [400, 800].map(|steps| stepped_onset(own, steps));
    fine + (fine - coarse) / 15.0
}

#[test]
fn onset_is_that_of_the_scalar_equation_where_no_contact_closes() {
    let mut compared = 0;
    for power in Power::ALL {
        for history in [TangentialHistory::Displacement, TangentialHistory::Force] {
            for (mu, stiffness, kappa) in
                [(0.21, 137.0, 6.3), (0.2655, 2.3e4, 5.1), (0.34, 870.0, 4.4)]
            {
                for (floor_ratio, floor_kappa) in [(1.23, None), (0.83, Some(7.9))] {
                    let own = Problem {
                        mu,
                        stiffness,
                        kappa,
                        power,
                        history,
                        floor_ratio,
                        floor_kappa,
                        ..Problem::HERTZ
                    };
                    let limit = own.limit();
                    assert_eq!(limit.event, Event::FloorSlip, "{own:?}");
                    let (found, expected) = (limit.slip_onset.unwrap(), onset(&own));
                    assert_eq!(limit.peak_force, limit.slip_onset);
                    // Of F + 3, of which the limit is guaranteed; it shows 1e-12.
                    let deviation = (found - expected) / (expected + 3.0);
                    assert!(
                        deviation.abs() < 1e-10,
                        "{own:?}: {found} {expected} {deviation:e}"
                    );
                    compared += 1;
                }
            }
        }
    }
    assert_eq!(compared, 60);
}

#[test]
fn rescaling_changes_nothing_on_a_path_that_only_loads() {
    for (rescaled, plain) in [
        (
            TangentialHistory::DisplacementRescaled,
            TangentialHistory::Displacement,
        ),
        (TangentialHistory::ForceRescaled, TangentialHistory::Force),
    ] {
        let onset = |history| {
            let own = Problem {
                history,
                ..Problem::HERTZ
            };
            own.limit().slip_onset.unwrap()
        };
        assert_eq!(onset(rescaled), onset(plain));
    }
}

#[test]
fn linear_springs_take_the_path_of_the_closed_form() {
    use tristack::theory::closed_form_limit;
    for history in [TangentialHistory::Displacement, TangentialHistory::Force] {
        let own = Problem {
            power: Power::Linear,
            floor_ratio: 1.0,
            history,
            ..Problem::HERTZ
        };
        let closed = closed_form_limit(&own.stack()).yield_force.unwrap();
        assert!((onset(&own) / closed - 1.0).abs() < 1e-12);
        assert!((own.limit().yield_force.unwrap() / closed - 1.0).abs() < 1e-12);
    }
}

#[test]
fn at_vanishing_step_removes_even_powers() {
    let value = |h: f64| 3.0 + h * h - 2.0 * h.powi(4);
    let found = at_vanishing_step([0.4, 0.2, 0.1].map(value).to_vec());
    assert!((found - 3.0).abs() < 1e-14);
}
