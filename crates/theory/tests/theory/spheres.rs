//! The quasi-static limit of n spheres in a ring with one on top, against routes that share nothing with `src/theory`:
//! closed forms, a scalar equation where c = 0 and arms are 0, the balances of all n + 1 spheres in three dimensions, and
//! the largest force of any sliding state. Parameters are chosen here, and no number is taken from elsewhere.

mod closed;
mod march;
mod peaks;
mod scalar;
mod unreduced;

use tristack_theory::model::{
    Arms, ContactArms, ContactConvention, Law, Power, Stack, TangentialHistory,
};
use tristack_theory::theory::{Limit, quasistatic_limit};

/// A stack and its contacts, as plain numbers.
#[derive(Debug, Clone, Copy)]
struct Problem {
    bodies: u8,
    mu: f64,
    stiffness: f64,
    kappa: f64,
    power: Power,
    history: TangentialHistory,
    floor_ratio: f64,
    /// Torque and kinematic arm of pairs, then of the floor.
    arms: [f64; 4],
}

impl Problem {
    const LINEAR: Self = Self {
        bodies: 3,
        mu: 0.23,
        stiffness: 170.0,
        kappa: 3.1,
        power: Power::Linear,
        history: TangentialHistory::Displacement,
        floor_ratio: 1.0,
        arms: [0.0; 4],
    };

    const HERTZ: Self = Self {
        kappa: 4.4,
        power: Power::Hertz,
        floor_ratio: 1.31,
        ..Self::LINEAR
    };

    fn limit(&self) -> Limit {
        let [pair, floor] = [[0, 1], [2, 3]].map(|[torque, kinematic]: [usize; 2]| ContactArms {
            torque: self.arms[torque],
            kinematic: self.arms[kinematic],
        });
        let convention = ContactConvention {
            arms: Arms { pair, floor },
            ..ContactConvention::with_law(Law {
                history: self.history,
                floor_ratio: self.floor_ratio,
                ..Law::of_power(self.power)
            })
        };
        let stack = Stack {
            stiffness_ratio: self.kappa,
            // Spheres that slip on each other are for closed.rs.
            cylinder_friction: 9.0,
            bodies: self.bodies,
            ..Stack::paper(self.mu, self.stiffness)
        };
        let problem = tristack_theory::model::Problem::new(stack, convention);
        quasistatic_limit(&problem.expect("values in range"))
    }

    /// n.
    fn count(&self) -> f64 {
        f64::from(self.bodies)
    }

    /// ε.
    fn weight(&self) -> f64 {
        1.0 / self.stiffness
    }

    /// Distance of the bottom spheres from the axis.
    fn radius(&self) -> f64 {
        1.0 / (std::f64::consts::PI / self.count()).sin()
    }

    /// T where all just touch, by the tangent of half the angle.
    fn start(&self) -> f64 {
        (0.5 * (0.5 * self.radius()).asin()).tan()
    }

    fn keeps_force(&self) -> bool {
        self.history == TangentialHistory::Force
    }

    /// (F − expected)/(expected + n + 1).
    fn deviation(&self, force: f64, expected: f64) -> f64 {
        ((force - expected) / (expected + self.count() + 1.0)).abs()
    }
}

/// A root of `function` between two arguments at which it has different signs, by halving.
fn root(function: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let sign = function(low);
    assert!(sign * function(high) <= 0.0, "{low} to {high}");
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if function(middle) * sign > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}
