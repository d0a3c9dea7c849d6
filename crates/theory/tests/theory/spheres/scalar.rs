//! Arms 0 and c = 0: with b = e = a T both springs together are a scalar equation for T, of which the overlap is the
//! argument.

use super::{Problem, root};
use tristack_theory::model::{Power, TangentialHistory};
use tristack_theory::theory::Event;

/// d/a = n + 1 on the ramp, and d = a + ε under the wall.
#[derive(Clone, Copy, PartialEq)]
enum Phase {
    Ramp,
    Wall,
}

/// dT/dG from d(u_pair + u_floor) = ρ dψ + d(ρ sin ψ).
fn slope(own: &Problem, phase: Phase, tangent: f64, overlap: f64) -> f64 {
    let p = own.power.value();
    let normal = overlap.powf(p);
    let (floor, growth) = match phase {
        Phase::Ramp => ((own.count() + 1.0) * normal, p / overlap),
        Phase::Wall => {
            let floor = normal + own.weight();
            (floor, p * normal / overlap / floor)
        }
    };
    let sunk = (floor / own.floor_ratio).powf(1.0 / p);
    let pair_part = own.kappa * overlap / p;
    let floor_part = own.kappa * normal / (p * own.floor_ratio * sunk.powf(p - 1.0));
    let stiffening = if own.keeps_force() {
        (pair_part + floor_part) * p / overlap
    } else {
        pair_part / overlap + floor_part * (p / overlap - (p - 1.0) / p * growth)
    };
    let square = 1.0 + tangent * tangent;
    (2.0 * tangent / square + tangent * stiffening)
        / (4.0 * (2.0 - overlap) / (square * square) - pair_part - floor_part)
}

/// T at an overlap, by Runge's and Kutta's method: in the overlap on the ramp, in its logarithm under the wall.
fn advance(own: &Problem, phase: Phase, from: [f64; 2], to: f64, steps: usize) -> f64 {
    let [mut tangent, start] = from;
    let argument = |overlap: f64| match phase {
        Phase::Ramp => overlap,
        Phase::Wall => overlap.ln(),
    };
    let width = (argument(to) - argument(start)) / steps as f64;
    let at = |tangent: f64, argument: f64| match phase {
        // At overlap 0 the slope is a limit: so small an overlap gives it.
        Phase::Ramp => slope(own, phase, tangent, argument.max(1e-30 * to)),
        Phase::Wall => argument.exp() * slope(own, phase, tangent, argument.exp()),
    };
    for step in 0..steps {
        let here = argument(start) + width * step as f64;
        let first = at(tangent, here);
        let second = at(tangent + 0.5 * width * first, here + 0.5 * width);
        let third = at(tangent + 0.5 * width * second, here + 0.5 * width);
        let fourth = at(tangent + width * third, here + width);
        tangent += width * (first + 2.0 * (second + third) + fourth) / 6.0;
    }
    tangent
}

/// F where G^p (T − μ) = ε μ, in so many steps a phase.
fn stepped_onset(own: &Problem, steps: usize) -> f64 {
    let (p, weight) = (own.power.value(), own.weight());
    let settled = (weight / own.count()).powf(1.0 / p);
    let tangent = advance(own, Phase::Ramp, [own.start(), 0.0], settled, steps);
    let excess = |overlap: f64| {
        let tangent = advance(own, Phase::Wall, [tangent, settled], overlap, steps);
        overlap.powf(p) * (tangent - own.mu) - own.mu * weight
    };
    let mut high = 1.01 * settled;
    while excess(high) < 0.0 {
        high *= 1.05;
    }
    let overlap = root(excess, high / 1.05, high);
    own.count() * overlap.powf(p) / weight - 1.0
}

/// F at the slip of the floor. The error of the method is of fourth order, which is taken off it.
fn onset(own: &Problem) -> f64 {
    let [coarse, fine] = [200, 400].map(|steps| stepped_onset(own, steps));
    fine + (fine - coarse) / 15.0
}

#[test]
fn onset_is_that_of_the_scalar_equation_where_neighbours_do_not_touch() {
    let mut compared = 0;
    for (bodies, mu, stiffness) in [
        (3, 0.22, 130.0),
        (3, 0.34, 7e3),
        (4, 0.25, 2.1e3),
        (4, 0.43, 310.0),
        (5, 0.31, 88.0),
        (5, 0.57, 4e3),
    ] {
        for (power, floor_ratio) in [
            (Power::Linear, 1.0),
            (Power::Linear, 1.4),
            (Power::Hertz, 1.31),
            (Power::SevenQuarters, 0.8),
        ] {
            for history in [TangentialHistory::Displacement, TangentialHistory::Force] {
                let own = Problem {
                    bodies,
                    mu,
                    stiffness,
                    kappa: 5.7,
                    power,
                    history,
                    floor_ratio,
                    arms: [0.0; 4],
                };
                let limit = own.limit();
                assert_eq!(limit.event, Event::FloorSlip, "{own:?}");
                let (found, expected) = (limit.slip_onset.unwrap(), onset(&own));
                assert_eq!(limit.peak_force, limit.slip_onset);
                let deviation = own.deviation(found, expected);
                println!("{own:?}: {found} {expected} {deviation:.1e}");
                assert!(deviation < 1e-10, "{own:?}: {found} {expected}");
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 48);
}
