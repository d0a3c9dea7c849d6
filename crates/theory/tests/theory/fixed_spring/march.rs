//! The bodies themselves, moved in small implicit steps: places and rotation as unknowns, the tangential spring of the pair
//! as a vector in the plane that nothing turns, Newton's method with differences for derivatives, and several numbers of
//! steps extrapolated to none. Nothing here knows of the angle ψ, of the path follower, or of a sliding branch.

use super::Problem;
use nalgebra::{Matrix5, Vector2, Vector5};

type Vector = Vector2<f64>;

/// x₂, y₂ and y₁ less their places without weight, the rotation of body 2, and the force of the wall.
type Unknowns = Vector5<f64>;

/// What drives a step.
#[derive(Debug, Clone, Copy)]
pub enum Drive {
    /// Weight of every body and force of the wall.
    Loads { weight: f64, wall: f64 },
    /// How far the bottom bodies are from just touching, at full weight.
    Outward(f64),
}

/// The bodies and what their springs remember.
#[derive(Debug, Clone, Copy)]
pub struct State {
    pub unknowns: Unknowns,
    /// Displacement or force of the spring of the pair, a vector on body 1.
    pair: Vector,
    /// The same of the floor's, along x on body 2.
    floor: f64,
}

/// Forces in one state.
#[derive(Debug, Clone, Copy)]
pub struct Forces {
    pub normal: f64,
    pub spring: Vector,
    pub floor_normal: f64,
    pub floor_shear: f64,
    pub neighbours: f64,
}

pub struct Bodies {
    own: Problem,
    /// Whether the bottom bodies press each other in this leg.
    pressing: bool,
    /// Whether they slide on the floor, outwards.
    sliding: bool,
}

impl Bodies {
    pub fn new(own: Problem, pressing: bool, sliding: bool) -> Self {
        Self {
            own,
            pressing,
            sliding,
        }
    }

    pub fn at_rest_without_weight() -> State {
        State {
            unknowns: Unknowns::zeros(),
            pair: Vector::zeros(),
            floor: 0.0,
        }
    }

    /// From body 2 to body 1, and how much nearer than 2 they are, without a difference of large numbers.
    fn pair(&self, unknowns: &Unknowns) -> (Vector, f64) {
        let (radius, rise) = self.own.ring();
        let apart = Vector::new(-radius, rise);
        let change = Vector::new(-unknowns[0], unknowns[2] - unknowns[1]);
        let distance = (apart + change).norm();
        let nearer = -(2.0 * apart + change).dot(&change) / (2.0 + distance);
        ((apart + change) / distance, nearer)
    }

    fn stiffness(&self, scale: f64, overlap: f64) -> f64 {
        let p = self.own.power.value();
        p * scale * overlap.powf(p - 1.0) / self.own.kappa
    }

    /// The springs after a step.
    fn springs(&self, old: &State, unknowns: &Unknowns) -> (Vector, f64) {
        let [_, pair_arm, _, floor_arm] = self.own.arms;
        let change = unknowns - old.unknowns;
        let ((before, old_overlap), (after, overlap)) =
            (self.pair(&old.unknowns), self.pair(unknowns));
        let middle = (before + after).normalize();
        let tangent = Vector::new(middle.y, -middle.x);
        // Surface of body 2 over that of body 1 along the tangent; body 1 does not turn.
        let shift = Vector::new(change[0], change[1] - change[2]);
        let arm = 1.0 + 0.5 * pair_arm * (old_overlap + overlap);
        let slid = shift.dot(&tangent) - arm * change[3];
        let depth = -0.5 * (old.unknowns[1] + unknowns[1]);
        let floor_slid = change[0] + (1.0 + floor_arm * depth) * change[3];
        let between = |scale: f64, one: f64, other: f64| match self.own.keeps_force {
            true => 0.5 * (self.stiffness(scale, one) + self.stiffness(scale, other)),
            false => 1.0,
        };
        let floor_stiffness = between(self.own.floor_ratio, -old.unknowns[1], -unknowns[1]);
        (
            old.pair + tangent * slid * between(1.0, old_overlap, overlap),
            old.floor + floor_slid * floor_stiffness,
        )
    }

    pub fn forces(&self, state: &State) -> Forces {
        let (_, overlap) = self.pair(&state.unknowns);
        let depth = -state.unknowns[1];
        let p = self.own.power.value();
        let exerted = |scale: f64, overlap: f64| match self.own.keeps_force {
            true => 1.0,
            false => self.stiffness(scale, overlap),
        };
        let (radius, _) = self.own.ring();
        let nearer = -2.0 * state.unknowns[0] / radius;
        let floor_normal = self.own.floor_ratio * depth.powf(p);
        Forces {
            normal: overlap.powf(p),
            spring: state.pair * exerted(1.0, overlap),
            floor_normal,
            floor_shear: match self.sliding {
                true => self.own.mu * floor_normal,
                false => state.floor * exerted(self.own.floor_ratio, depth),
            },
            neighbours: match self.pressing {
                true => nearer.signum() * nearer.abs().powf(p),
                false => 0.0,
            },
        }
    }

    fn moved(&self, old: &State, unknowns: Unknowns) -> State {
        let (pair, floor) = self.springs(old, &unknowns);
        State {
            unknowns,
            pair,
            floor,
        }
    }

    fn lacks(&self, old: &State, unknowns: Unknowns, drive: Drive) -> Vector5<f64> {
        let weight = match drive {
            Drive::Loads { weight, .. } => weight,
            Drive::Outward(_) => self.own.weight(),
        };
        let state = self.moved(old, unknowns);
        let forces = self.forces(&state);
        let (normal, overlap) = self.pair(&unknowns);
        let [pair_arm, _, floor_arm, _] = self.own.arms;
        let on_top = forces.normal * normal + forces.spring;
        let tangent = Vector::new(normal.y, -normal.x);
        let count = self.own.count();
        Vector5::new(
            forces.spring.dot(&tangent) * (1.0 + pair_arm * overlap)
                - forces.floor_shear * (1.0 - floor_arm * unknowns[1]),
            -on_top.x - forces.floor_shear + self.own.push() * forces.neighbours,
            forces.floor_normal - on_top.y - weight,
            count * on_top.y - weight - unknowns[4],
            match drive {
                Drive::Loads { wall, .. } => unknowns[4] - wall,
                Drive::Outward(outward) => unknowns[0] - outward,
            },
        )
    }

    pub fn step(&self, old: &State, guess: Unknowns, drive: Drive) -> State {
        let scale = guess.amax();
        let mut unknowns = guess;
        let mut last = f64::INFINITY;
        for _ in 0..80 {
            let width = 1e-6 * scale;
            let mut slope = Matrix5::zeros();
            for column in 0..5 {
                let shifted = |by: f64| {
                    let mut shifted = unknowns;
                    shifted[column] += by;
                    self.lacks(old, shifted, drive)
                };
                let by = (shifted(width) - shifted(-width)) / (2.0 * width);
                slope.set_column(column, &by);
            }
            let change = slope.lu().solve(&self.lacks(old, unknowns, drive));
            let change = change.unwrap_or_else(|| panic!("no slope: {:?} {drive:?}", self.own));
            unknowns -= change;
            let moved = change.amax() / scale;
            if moved < 1e-15 || (moved < 1e-10 && moved >= last) {
                return self.moved(old, unknowns);
            }
            last = moved;
        }
        panic!("no balance: {:?} {drive:?}", self.own);
    }

    /// The stack at full weight.
    pub fn settled(&self, steps: usize) -> State {
        self.loaded(1.0, steps)
    }

    /// The stack at this part of its weight, in steps that are even in the fourth root of the lengths.
    pub fn loaded(&self, full: f64, steps: usize) -> State {
        let mut old = Self::at_rest_without_weight();
        let power = self.own.power.value();
        for step in 1..=steps {
            let part = (step as f64 / steps as f64).powi(4);
            let weight = self.own.weight() * full * part.powf(power);
            let guess = match step {
                1 => {
                    let depth = (1.5 * weight).powf(power.recip());
                    Unknowns::new(0.3 * depth, -depth, -2.0 * depth, 0.3 * depth, 0.0)
                }
                _ => old.unknowns * (step as f64 / (step as f64 - 1.0)).powi(4),
            };
            old = self.step(&old, guess, Drive::Loads { weight, wall: 0.0 });
        }
        old
    }

    /// The state at the second force of the wall.
    pub fn pressed(&self, start: &State, [from, to]: [f64; 2], steps: usize) -> State {
        let weight = self.own.weight();
        self.driven(start, [1.0 + from, 1.0 + to], steps, |load| Drive::Loads {
            weight,
            wall: weight * (load - 1.0),
        })
    }

    /// The stack at full weight, from the state at this part of it on.
    pub fn heavier(&self, start: &State, from: f64, steps: usize) -> State {
        let weight = self.own.weight();
        self.driven(start, [from, 1.0], steps, |load| Drive::Loads {
            weight: weight * load,
            wall: 0.0,
        })
    }

    /// The state at the second load, in even steps of its logarithm.
    fn driven(
        &self,
        start: &State,
        [from, to]: [f64; 2],
        steps: usize,
        drive: impl Fn(f64) -> Drive,
    ) -> State {
        let [mut before, mut old] = [*start; 2];
        for step in 1..=steps {
            let load = from * (to / from).powf(step as f64 / steps as f64);
            let guess = 2.0 * old.unknowns - before.unknowns;
            let next = self.step(&old, guess, drive(load));
            before = std::mem::replace(&mut old, next);
        }
        old
    }

    /// The state in which the bottom bodies are this far outward.
    pub fn spread(&self, start: &State, outward: f64, steps: usize) -> State {
        let from = start.unknowns[0];
        let [mut before, mut old] = [*start; 2];
        for step in 1..=steps {
            let to = from + (outward - from) * step as f64 / steps as f64;
            let mut guess = 2.0 * old.unknowns - before.unknowns;
            guess[0] = to;
            let next = self.step(&old, guess, Drive::Outward(to));
            before = std::mem::replace(&mut old, next);
        }
        old
    }

    /// The force of the wall in m g at which `value` vanishes beyond `start`, and the state there; by secants from `near`.
    pub fn force_where(
        &self,
        (from, start): (f64, &State),
        near: f64,
        steps: usize,
        value: impl Fn(&State) -> f64,
    ) -> (f64, State) {
        let at = |force: f64| self.pressed(start, [from, force], steps);
        let force = secant([near, near + 1e-4 * (near + 1.0)], |force| {
            value(&at(force))
        });
        (force, at(force))
    }

    /// e/d − μ.
    pub fn floor_excess(&self, state: &State) -> f64 {
        let forces = self.forces(state);
        forces.floor_shear / forces.floor_normal - self.own.mu
    }

    /// |q|/a − μ_d.
    pub fn pair_excess(&self, state: &State) -> f64 {
        let forces = self.forces(state);
        forces.spring.norm() / forces.normal - self.own.mu_d
    }
}

/// Where `value` vanishes, by secants from two places.
pub fn secant([mut old, mut next]: [f64; 2], value: impl Fn(f64) -> f64) -> f64 {
    let mut old_value = value(old);
    for _ in 0..30 {
        let next_value = value(next);
        let change = next_value * (next - old) / (next_value - old_value);
        (old, old_value) = (next, next_value);
        next -= change;
        if change.abs() < 1e-12 * (next + 1.0) {
            break;
        }
    }
    next
}

/// What values in n, 2n, 4n and 8n steps, with errors of the second and fourth order, come to without an error.
pub fn extrapolated(of: impl Fn(usize) -> f64, steps: usize) -> f64 {
    let mut column: Vec<f64> = (0..4).map(|doublings| of(steps << doublings)).collect();
    for order in 1..=3 {
        let factor = 4f64.powi(order);
        column = column
            .windows(2)
            .map(|two| two[1] + (two[1] - two[0]) / (factor - 1.0))
            .collect();
    }
    column[0]
}
