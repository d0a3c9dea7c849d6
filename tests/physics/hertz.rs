//! The quasi-static limit under laws whose force is a power of the overlap, against two routes that share nothing with
//! the path follower: a scalar equation in the angle where c = 0 and arms are 0, and the unreduced balances of bodies
//! that are moved in small steps. Parameters are chosen here, and no number is taken from elsewhere.

mod asymptotics;
mod exponent;
mod march;
mod native;
mod peaks;
mod preparation;
mod scalar;
mod unreduced;

use tristack::model::{
    Arms, ContactArms, ContactConvention, DampingGrowth, Law, Power, Stack, TangentialHistory,
    TangentialStiffening,
};

/// A stack and its contacts, as plain numbers.
#[derive(Debug, Clone, Copy)]
struct Problem {
    mu: f64,
    stiffness: f64,
    kappa: f64,
    power: Power,
    history: TangentialHistory,
    floor_ratio: f64,
    floor_kappa: Option<f64>,
    stiffening: bool,
    /// Torque and kinematic arm of pairs, then of the floor.
    arms: [f64; 4],
}

impl Problem {
    const HERTZ: Self = Self {
        mu: 0.21,
        stiffness: 137.0,
        kappa: 4.1,
        power: Power::Hertz,
        history: TangentialHistory::Displacement,
        floor_ratio: 1.23,
        floor_kappa: None,
        stiffening: false,
        arms: [0.0; 4],
    };

    fn stack(&self) -> Stack {
        Stack {
            stiffness_ratio: self.kappa,
            ..Stack::paper(self.mu, self.stiffness)
        }
    }

    fn convention(&self) -> ContactConvention {
        let [pair_torque, pair_kinematic, floor_torque, floor_kinematic] = self.arms;
        ContactConvention {
            arms: Arms {
                pair: ContactArms {
                    torque: pair_torque,
                    kinematic: pair_kinematic,
                },
                floor: ContactArms {
                    torque: floor_torque,
                    kinematic: floor_kinematic,
                },
            },
            ..ContactConvention::with_law(Law {
                power: self.power,
                history: self.history,
                floor_ratio: self.floor_ratio,
                floor_kappa: self.floor_kappa,
                tangential_stiffening: match self.stiffening {
                    true => TangentialStiffening::Every,
                    false => TangentialStiffening::None,
                },
                damping: DampingGrowth::ConstantRatio,
            })
        }
    }

    fn limit(&self) -> tristack::theory::Limit {
        let problem = tristack::model::Problem::new(self.stack(), self.convention());
        tristack::theory::quasistatic_limit(&problem.expect("values in range"))
    }

    fn epsilon(&self) -> f64 {
        1.0 / self.stiffness
    }

    fn keeps_force(&self) -> bool {
        self.history.keeps_force()
    }
}

/// A root of `function` between two arguments at which it has different signs, by the Illinois method.
fn root(mut function: impl FnMut(f64) -> f64, low: f64, high: f64) -> f64 {
    let (mut a, mut b) = (low, high);
    let (mut fa, mut fb) = (function(a), function(b));
    assert!(
        fa * fb <= 0.0,
        "no change of sign: {fa} at {a}, {fb} at {b}"
    );
    for _ in 0..200 {
        let x = (a * fb - b * fa) / (fb - fa);
        if fb == fa || (b - a).abs() <= 4.0 * f64::EPSILON * b.abs() {
            break;
        }
        let f = function(x);
        if f * fb < 0.0 {
            (a, fa) = (b, fb);
        } else {
            fa *= 0.5;
        }
        (b, fb) = (x, f);
        if f == 0.0 {
            break;
        }
    }
    b
}

/// The value at step 0 of one that is known at steps h, h/2, h/4, …, with an error in even powers of h.
fn at_vanishing_step(mut values: Vec<f64>) -> f64 {
    let mut factor = 4.0;
    while values.len() > 1 {
        let pairs = values.windows(2);
        values = pairs
            .map(|pair| pair[1] + (pair[1] - pair[0]) / (factor - 1.0))
            .collect();
        factor *= 4.0;
    }
    values[0]
}
