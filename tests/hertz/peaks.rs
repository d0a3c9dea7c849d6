//! The peak after a slip with c > 0: the largest force of any state in which forces and torques of the bodies balance
//! with e = μ d, found without a branch that is followed.

use super::unreduced::solved;
use super::{Problem, TangentialHistory};
use tristack::model::Power;

impl Problem {
    /// What the balances of a sliding stack lack at an angle turned: vertical and horizontal force on 2, and the same
    /// vertically on 1.
    fn sliding_lacks(&self, turned: f64, [overlap, sunk, load]: [f64; 3]) -> [f64; 3] {
        let p = self.power.value();
        let angle = std::f64::consts::FRAC_PI_6 + turned;
        let outward = (2.0 - overlap) * angle.sin() - 1.0;
        let [pair_arm, _, floor_arm, _] = self.arms;
        let normal = overlap.powf(p);
        let floor = self.floor_ratio * sunk.powf(p);
        let shear = self.mu * floor * (1.0 + floor_arm * sunk) / (1.0 + pair_arm * overlap);
        let bottom = (-2.0 * outward).max(0.0).powf(p);
        let bearing = normal * angle.cos() + shear * angle.sin();
        [
            floor - bearing - self.epsilon(),
            normal * angle.sin() - shear * angle.cos() - self.mu * floor + bottom,
            2.0 * bearing - load,
        ]
    }

    /// Load of cylinder 1 in the sliding state at an angle turned, by Newton's method from `guess`, which it replaces.
    fn sliding_load(&self, turned: f64, guess: &mut [f64; 3]) -> f64 {
        for _ in 0..60 {
            let lacks = self.sliding_lacks(turned, *guess);
            let mut system = [[0.0; 4]; 3];
            for column in 0..3 {
                let width = 1e-6 * guess[column];
                let shifted = |by: f64| {
                    let mut shifted = *guess;
                    shifted[column] += by;
                    self.sliding_lacks(turned, shifted)
                };
                let (above, below) = (shifted(width), shifted(-width));
                for row in 0..3 {
                    system[row][column] = (above[row] - below[row]) / (2.0 * width);
                    system[row][3] = -lacks[row];
                }
            }
            let change = solved(system);
            let positive =
                |part: f64| (0..3).all(|index| guess[index] + part * change[index] > 0.0);
            let mut part = 1.0;
            while !positive(part) {
                part *= 0.5;
            }
            let moved: [f64; 3] = std::array::from_fn(|index| guess[index] + part * change[index]);
            let settled = (0..3).all(|index| (moved[index] / guess[index] - 1.0).abs() < 1e-14);
            *guess = moved;
            if settled {
                break;
            }
        }
        guess[2]
    }

    /// The first maximum of F along the sliding states: passed by growing steps, then enclosed by golden sections.
    fn largest_force(&self) -> f64 {
        let inverse = self.power.value().recip();
        let small = self.epsilon().powf(inverse);
        let floor = (1.5 * self.epsilon() / self.floor_ratio).powf(inverse);
        let mut guess = [small, floor, self.epsilon()];
        let [mut before, mut turned] = [0.0, 1e-3 * small];
        let mut load = self.sliding_load(turned, &mut guess);
        let mut next = guess;
        loop {
            let further = turned + 0.1 * turned;
            let grown = self.sliding_load(further, &mut next);
            if grown < load {
                let [mut low, mut high] = [before, further];
                let golden = 0.5 * (5f64.sqrt() - 1.0);
                for _ in 0..45 {
                    let width = golden * (high - low);
                    let [left, right] = [high - width, low + width]
                        .map(|turned| self.sliding_load(turned, &mut guess.clone()));
                    if left < right {
                        low = high - width;
                    } else {
                        high = low + width;
                    }
                }
                return self.sliding_load(0.5 * (low + high), &mut guess) * self.stiffness - 1.0;
            }
            (before, turned, load, guess) = (turned, further, grown, next);
        }
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
                let (onset, peak) = (limit.slip_onset.unwrap(), limit.peak_force.unwrap());
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
