//! The peak after a slip with c > 0: the largest force of any state in which the forces on a bottom sphere and on the top
//! one balance with e = μ d, found without a branch that is followed.

use super::{Problem, root};
use tristack_theory::model::Power;

impl Problem {
    /// d and the lack of the horizontal balance, where neighbours overlap by `bottom` and the top sphere by `overlap`.
    fn sliding(&self, bottom: f64, overlap: f64) -> [f64; 2] {
        let p = self.power.value();
        let [pair_arm, _, floor_arm, _] = self.arms;
        let (distance, normal) = (2.0 - overlap, overlap.max(0.0).powf(p));
        // Centres of neighbours are 2 − bottom apart, on a circle about the axis.
        let sine = (1.0 - 0.5 * bottom) * self.radius() / distance;
        let cosine = (1.0 - sine * sine).sqrt();
        let mut floor = self.weight();
        for _ in 0..200 {
            let sunk = (floor / self.floor_ratio).powf(1.0 / p);
            let shear = self.mu * floor * (1.0 + floor_arm * sunk) / (1.0 + pair_arm * overlap);
            floor = self.weight() + normal * cosine + shear * sine;
        }
        let shear = (floor - self.weight() - normal * cosine) / sine;
        // Both neighbours push by c along chords, whose half angle at the axis is π/n.
        let neighbours = 2.0 * bottom.powf(p) / self.radius();
        [
            floor,
            normal * sine - shear * cosine - self.mu * floor + neighbours,
        ]
    }

    /// F of the balanced state at an overlap of the neighbours.
    fn sliding_force(&self, bottom: f64) -> f64 {
        let lack = |overlap: f64| self.sliding(bottom, overlap)[1];
        // The geometry needs an overlap from which on sin ψ < 1, and the balance is met once in this range.
        let mut high = 1e-6;
        while lack(high) < 0.0 {
            high *= 1.1;
        }
        let overlap = root(lack, high / 1.1, high);
        self.count() * self.sliding(bottom, overlap)[0] * self.stiffness - self.count() - 1.0
    }

    /// The largest F over the overlaps of neighbours, from where they part.
    fn largest_force(&self) -> f64 {
        let golden = 0.5 * (5f64.sqrt() - 1.0);
        let force = |bottom: f64| self.sliding_force(bottom);
        let mut high = 1e-9;
        while force(2.0 * high) > force(high) {
            high *= 2.0;
        }
        let (mut low, mut high) = (0.0, 2.0 * high);
        for _ in 0..60 {
            let width = golden * (high - low);
            if force(high - width) > force(low + width) {
                high = low + width;
            } else {
                low = high - width;
            }
        }
        force(0.5 * (low + high)).max(force(0.0))
    }
}

#[test]
fn peak_is_the_largest_force_of_sliding_spheres() {
    for (bodies, mu, stiffness) in [(3, 0.24, 140.0), (4, 0.33, 3e3), (5, 0.41, 210.0)] {
        for (power, floor_ratio, kappa) in [
            (Power::Linear, 1.0, 0.8),
            (Power::Hertz, 1.31, 1.2),
            (Power::Square, 0.9, 1.1),
        ] {
            for arms in [[0.0; 4], [-0.5, 0.0, 0.1, -0.2], [-0.5, -0.5, -1.0, -0.5]] {
                let own = Problem {
                    bodies,
                    mu,
                    stiffness,
                    kappa,
                    power,
                    floor_ratio,
                    arms,
                    ..Problem::LINEAR
                };
                let limit = own.limit();
                let [onset, peak] = [limit.slip_onset, limit.peak_force]
                    .map(|force| force.unwrap_or_else(|| panic!("{own:?} {limit:?}")));
                assert!(limit.bottom_force.unwrap() > 0.0 && onset < peak, "{own:?}");
                let largest = own.largest_force();
                let deviation = own.deviation(peak, largest);
                println!("{own:?}: {onset} {peak} {largest} {deviation:.1e}");
                assert!(deviation < 1e-10, "{own:?} {peak} {largest}");
            }
        }
    }
}

/// Arms 0 and linear springs: the peak is where neighbours part, x₀ (T − μ_c)(1/μ_c − T)(T − μ) = 2 ε μ T.
#[test]
fn peak_of_linear_springs_is_that_of_the_rational_equation() {
    for bodies in 3..=5 {
        let own = Problem {
            bodies,
            mu: 0.28,
            kappa: 0.7,
            ..Problem::LINEAR
        };
        let (start, mu) = (own.start(), own.mu);
        let excess = |tangent: f64| {
            let touching = own.radius() * (tangent - start) * (1.0 / start - tangent);
            touching * (tangent - mu) - 2.0 * own.weight() * mu * tangent
        };
        let tangent = root(excess, start.max(mu), 1.0);
        let force = ((own.count() + 1.0) * mu - tangent) / (tangent - mu);
        let peak = own.limit().peak_force.unwrap();
        assert!(own.deviation(peak, force) < 1e-11, "{peak} {force}");
    }
}
