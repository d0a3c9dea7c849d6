//! The peak after a slip with c > 0: the largest force of any state in which forces and torques of the bodies balance
//! with e = μ d, found without a branch that is followed.

use super::march::solved;
use super::{Problem, TangentialHistory, root};
use tristack::model::Power;

impl Problem {
    /// What the balances of a sliding stack lack whose bottom cylinders overlap by `bottom`: vertical and horizontal
    /// force on 2, and vertical force on 1. The unknowns are the overlaps of pair and floor and the load of cylinder 1.
    fn sliding_lacks(&self, bottom: f64, [overlap, sunk, load]: [f64; 3]) -> [f64; 3] {
        let p = self.power.value();
        let (sine, distance) = (1.0 - 0.5 * bottom, 2.0 - overlap);
        let [sine, cosine] =
            [sine, (distance * distance - sine * sine).sqrt()].map(|x| x / distance);
        let [pair_arm, _, floor_arm, _] = self.arms;
        let normal = overlap.powf(p);
        let floor = self.floor_ratio * sunk.powf(p);
        let shear = self.mu * floor * (1.0 + floor_arm * sunk) / (1.0 + pair_arm * overlap);
        let bearing = normal * cosine + shear * sine;
        [
            floor - bearing - self.epsilon(),
            normal * sine - shear * cosine - self.mu * floor + bottom.powf(p),
            2.0 * bearing - load,
        ]
    }

    /// The sliding state at an overlap of the bottom cylinders, by Newton's method with differences for derivatives.
    fn sliding_state(&self, bottom: f64, mut state: [f64; 3]) -> [f64; 3] {
        for _ in 0..20 {
            let lacks = self.sliding_lacks(bottom, state);
            let mut system = [[0.0; 4]; 3];
            for column in 0..3 {
                let width = 1e-6 * state[column];
                let shifted = |by: f64| {
                    let mut shifted = state;
                    shifted[column] += by;
                    self.sliding_lacks(bottom, shifted)
                };
                let (above, below) = (shifted(width), shifted(-width));
                for row in 0..3 {
                    system[row][column] = (above[row] - below[row]) / (2.0 * width);
                    system[row][3] = -lacks[row];
                }
            }
            let change = solved(system);
            state = std::array::from_fn(|index| state[index] + change[index]);
        }
        state
    }

    /// The sliding state in which the bottom cylinders just touch, with arms 0: there G₀ᵖ (T − μ) = ε μ,
    /// G₀ = 2 − 1/sin ψ.
    fn touching_state(&self) -> [f64; 3] {
        let (p, epsilon) = (self.power.value(), self.epsilon());
        let overlap = |tangent: f64| 2.0 - 0.5 * (1.0 + tangent * tangent) / tangent;
        let lowest = f64::max(self.mu, 2.0 - 3f64.sqrt());
        let excess = |tangent: f64| {
            overlap(tangent).max(0.0).powf(p) * (tangent - self.mu) - self.mu * epsilon
        };
        let overlap = overlap(root(excess, lowest, 0.9));
        let normal = overlap.powf(p);
        let sunk = ((normal + epsilon) / self.floor_ratio).powf(1.0 / p);
        [overlap, sunk, 2.0 * normal]
    }

    /// The maximum of F next to the state in which the bottom cylinders part: passed by growing steps, then enclosed by
    /// golden sections.
    fn largest_force(&self) -> f64 {
        let mut state = self.touching_state();
        // The arms come little by little, so that every state is close to the last.
        for part in 1..=40 {
            let part = f64::from(part) / 40.0;
            let arms = self.arms.map(|arm| part * arm);
            state = Problem { arms, ..*self }.sliding_state(0.0, state);
        }
        let [mut before, mut bottom] = [0.0, 0.0];
        let mut width = 1e-6 * state[0];
        loop {
            let further = bottom + width;
            let next = self.sliding_state(further, state);
            assert!(next[2].is_finite(), "{self:?}");
            if next[2] < state[2] {
                return self.largest_between(before, further, state);
            }
            (before, bottom, state) = (bottom, further, next);
            width *= 1.3;
        }
    }

    fn largest_between(&self, mut low: f64, mut high: f64, state: [f64; 3]) -> f64 {
        let golden = 0.5 * (5f64.sqrt() - 1.0);
        let load = |bottom: f64| self.sliding_state(bottom, state)[2];
        for _ in 0..40 {
            let width = golden * (high - low);
            if load(high - width) > load(low + width) {
                high = low + width;
            } else {
                low = high - width;
            }
        }
        load(0.5 * (low + high)) * self.stiffness - 1.0
    }
}

#[test]
fn peak_is_the_largest_force_of_a_sliding_stack() {
    let mut rising = 0;
    for (mu, stiffness, kappa) in [(0.21, 137.0, 1.3), (0.25, 4.1e3, 1.05), (0.29, 900.0, 0.9)] {
        for (power, floor_ratio) in [
            (Power::Hertz, 1.3),
            (Power::FiveQuarters, 0.9),
            (Power::Square, 1.7),
        ] {
            for arms in [[0.0; 4], [-0.5, 0.0, 0.1, -0.2], [-0.5, -0.5, -1.0, -0.5]] {
                let own = Problem {
                    mu,
                    stiffness,
                    kappa,
                    power,
                    floor_ratio,
                    arms,
                    ..Problem::HERTZ
                };
                let limit = own.limit();
                let (onset, peak) = (
                    limit.slip_onset.unwrap(),
                    limit
                        .peak_force
                        .unwrap_or_else(|| panic!("{own:?} {limit:?}")),
                );
                assert!(limit.bottom_force.unwrap() > 0.0 && onset < peak, "{own:?}");
                let largest = own.largest_force();
                let deviation = (peak - largest) / (largest + 3.0);
                assert!(
                    deviation.abs() < 1e-10,
                    "{own:?} {peak} {largest} {deviation:e}"
                );
                rising += 1;
            }
        }
    }
    assert_eq!(rising, 27);
}

/// The sliding stack remembers neither springs nor preparation.
#[test]
fn peak_depends_on_neither_history_nor_stiffness_ratio() {
    let peak = |history, kappa| {
        let own = Problem {
            mu: 0.22,
            history,
            kappa,
            ..Problem::HERTZ
        };
        let limit = own.limit();
        assert!(limit.bottom_force.unwrap() > 0.0);
        limit.peak_force.unwrap()
    };
    let first = peak(TangentialHistory::Displacement, 1.3);
    for (history, kappa) in [
        (TangentialHistory::Displacement, 0.7),
        (TangentialHistory::Force, 0.9),
    ] {
        assert!((peak(history, kappa) / first - 1.0).abs() < 1e-12);
    }
}
