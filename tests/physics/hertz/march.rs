//! The bodies themselves, with positions and rotation as unknowns, in small implicit steps from balance to balance:
//! neither angle, self-similar start nor differential equation of the path follower enters.

use super::{Problem, root};

/// Displacements from the stress-free stack: of cylinder 1 towards cylinder 2, downwards; of cylinder 2 outwards and
/// downwards; and the rotation of cylinder 2.
pub type Moved = [f64; 4];

/// The stack in one state of its march.
#[derive(Debug, Clone, Copy)]
pub struct State {
    pub moved: Moved,
    /// What the springs of pair and floor remember: displacement or force.
    pub springs: [f64; 2],
}

impl State {
    /// The stack before anything presses on it.
    pub const STRESS_FREE: Self = Self {
        moved: [0.0; 4],
        springs: [0.0; 2],
    };

    /// The overlap of the lower cylinders, which is negative where they are apart.
    pub fn bottom(&self) -> f64 {
        Geometry::of(self.moved).overlaps[2]
    }
}

/// Geometry of displaced cylinders, free of cancellation.
#[derive(Clone, Copy)]
struct Geometry {
    /// Overlaps of 1 and 2, of 2 and the floor, and of 2 and 3.
    overlaps: [f64; 3],
    turned: f64,
    sine: f64,
    cosine: f64,
    outward: f64,
    rotation: f64,
}

impl Geometry {
    fn of([approached, outward, indented, rotation]: Moved) -> Self {
        let root = 3f64.sqrt();
        let lower = -approached;
        let (across, rise) = (1.0 + outward, root + lower);
        let distance = across.hypot(rise);
        let nearer = -(2.0 * outward + outward * outward + 2.0 * root * lower + lower * lower);
        Self {
            overlaps: [nearer / (2.0 + distance), indented, -2.0 * outward],
            turned: (0.5 * (root * outward - lower)).atan2(0.5 * (across + root * rise)),
            sine: across / distance,
            cosine: rise / distance,
            outward,
            rotation,
        }
    }
}

/// What presses on the bodies, in units of the pair's K.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loads {
    /// On cylinder 1: its weight and the force of the wall, which are one load.
    pub upper: f64,
    /// The weight of each lower cylinder.
    pub lower: f64,
}

impl Loads {
    pub const NONE: Self = Self::of(0.0, 0.0);

    pub const fn of(upper: f64, lower: f64) -> Self {
        Self { upper, lower }
    }

    /// The loads on the way to others. Where a load begins at none, lengths grow like the fourth power of the part, so
    /// that every spring is an analytic function of it; otherwise its logarithm grows evenly.
    fn towards(self, to: Self, part: f64, power: f64) -> Self {
        let between = |from: f64, to: f64| match from {
            0.0 => to * part.powf(4.0 * power),
            _ => from * (to / from).powf(part),
        };
        Self::of(between(self.upper, to.upper), between(self.lower, to.lower))
    }
}

struct Forces {
    normal: [f64; 2],
    shear: [f64; 2],
    bottom: f64,
    springs: [f64; 2],
    levers: [f64; 2],
}

impl Problem {
    fn pressed(&self, scale: f64, overlap: f64) -> f64 {
        scale * overlap.max(0.0).powf(self.power.value())
    }

    /// k_t of pair (0) or floor (1).
    fn tangential_stiffness(&self, contact: usize, overlap: f64) -> f64 {
        let p = self.power.value();
        let floor_kappa = self.floor_kappa.unwrap_or(self.kappa);
        let (scale, kappa) = [(1.0, self.kappa), (self.floor_ratio, floor_kappa)][contact];
        let stiffening = if self.stiffening {
            2.0 / (2.0 - overlap)
        } else {
            1.0
        };
        p * scale * overlap.max(0.0).powf(p - 1.0) / kappa * stiffening
    }

    /// The part of what is remembered that is left after a step between two overlaps.
    fn left_over(&self, before: f64, now: f64) -> f64 {
        match self.history.is_rescaled() && now < before {
            true => (now / before).sqrt(),
            false => 1.0,
        }
    }

    /// The forces after the step from `old`, whose springs collect by the trapezium rule.
    fn forces(&self, old: &State, moved: Moved) -> Forces {
        let (before, now) = (Geometry::of(old.moved), Geometry::of(moved));
        let [_, pair_kinematic, _, floor_kinematic] = self.arms;
        let mean = |of: &dyn Fn(&Geometry) -> f64| 0.5 * (of(&before) + of(&now));
        let turn = now.rotation - before.rotation;
        let along = mean(&|at| 2.0 - at.overlaps[0]) * (now.turned - before.turned);
        let grown = [
            along - mean(&|at| 1.0 + pair_kinematic * at.overlaps[0]) * turn,
            now.outward - before.outward
                + mean(&|at| 1.0 + floor_kinematic * at.overlaps[1]) * turn,
        ];
        let mut springs = [0.0; 2];
        let mut shear = [0.0; 2];
        for contact in 0..2 {
            let [earlier, later] = [&before, &now].map(|at| at.overlaps[contact]);
            let left = self.left_over(earlier, later);
            let stiffness = |overlap| self.tangential_stiffness(contact, overlap);
            let gain = match self.keeps_force() {
                true => 0.5 * (left * stiffness(earlier) + stiffness(later)),
                false => 0.5 * (left + 1.0),
            };
            springs[contact] = left * old.springs[contact] + gain * grown[contact];
            shear[contact] = springs[contact]
                * match self.keeps_force() {
                    true => 1.0,
                    false => stiffness(later),
                };
        }
        let [pair, floor, bottom] = now.overlaps;
        Forces {
            normal: [
                self.pressed(1.0, pair),
                self.pressed(self.floor_ratio, floor),
            ],
            shear,
            bottom: self.pressed(1.0, bottom),
            springs,
            levers: [1.0 + self.arms[0] * pair, 1.0 + self.arms[2] * floor],
        }
    }

    /// What the balances lack: vertical force on 1, horizontal and vertical force on 2, torque on 2.
    fn lacks(&self, old: &State, moved: Moved, loads: Loads) -> [f64; 4] {
        let at = Geometry::of(moved);
        let forces = self.forces(old, moved);
        let ([a, d], [b, e]) = (forces.normal, forces.shear);
        let bearing = a * at.cosine + b * at.sine;
        [
            2.0 * bearing - loads.upper,
            a * at.sine - b * at.cosine - e + forces.bottom,
            d - bearing - loads.lower,
            b * forces.levers[0] - e * forces.levers[1],
        ]
    }

    /// The state after a step to some loads, by Newton's method with differences for derivatives.
    fn step(&self, old: &State, guess: Moved, loads: Loads) -> State {
        const MOST: usize = 40;
        let mut moved = guess;
        let mut last = f64::INFINITY;
        for _ in 0..MOST {
            let lacks = self.lacks(old, moved, loads);
            let [approached, outward, indented, rotation] = moved.map(f64::abs);
            // The floor may be pressed long before cylinder 1 is.
            let pair = approached.max(outward).max(rotation);
            let scales = [pair, pair, indented, pair];
            let mut system = [[0.0; 5]; 4];
            for column in 0..4 {
                let width = 1e-5 * scales[column];
                let shifted = |by: f64| {
                    let mut shifted = moved;
                    shifted[column] += by;
                    self.lacks(old, shifted, loads)
                };
                let (above, below) = (shifted(width), shifted(-width));
                for row in 0..4 {
                    system[row][column] = (above[row] - below[row]) / (2.0 * width);
                    system[row][4] = -lacks[row];
                }
            }
            let change = solved(system);
            // Overlaps must stay overlaps.
            let mut part = 1.0;
            let next = |part: f64| std::array::from_fn(|index| moved[index] + part * change[index]);
            while Geometry::of(next(part)).overlaps[..2]
                .iter()
                .any(|&overlap| overlap <= 0.0)
            {
                part *= 0.5;
            }
            moved = next(part);
            let sizes = change
                .iter()
                .zip(scales)
                .map(|(change, of)| change.abs() / of);
            let size = sizes.fold(0.0, f64::max);
            if size < 1e-15 || (size < 1e-11 && size >= last) {
                break;
            }
            last = size;
        }
        let springs = self.forces(old, moved).springs;
        State { moved, springs }
    }

    /// Some displacements of loads: overlaps that bear them at 30°, and a turn as large.
    fn first_guess(&self, loads: Loads) -> Moved {
        let inverse = self.power.value().recip();
        let pair = (0.5 * loads.upper).powf(inverse);
        let floor = ((0.5 * loads.upper + loads.lower) / self.floor_ratio).powf(inverse);
        [2.0 * pair, 0.3 * pair, floor, 0.3 * pair]
    }

    /// The states before and after each of so many steps from some loads to others.
    fn march(&self, start: &State, [from, to]: [Loads; 2], steps: usize) -> Vec<State> {
        let begins = from.upper == 0.0;
        let mut states = vec![*start];
        for step in 1..=steps {
            let loads = from.towards(to, step as f64 / steps as f64, self.power.value());
            let guess = match step {
                1 if begins => self.first_guess(loads),
                1 => start.moved,
                // Lengths grow like the fourth power of the steps, or evenly.
                _ if begins => {
                    let ratio = (step as f64 / (step as f64 - 1.0)).powi(4);
                    stretched(start.moved, states[step - 1].moved, ratio)
                }
                _ => stretched(states[step - 2].moved, states[step - 1].moved, 2.0),
            };
            states.push(self.step(&states[step - 1], guess, loads));
        }
        states
    }

    fn end(&self, start: &State, leg: [Loads; 2], steps: usize) -> State {
        self.march(start, leg, steps)[steps]
    }

    /// The part of a leg at which the lower cylinders first part or touch.
    fn first_change(&self, start: &State, leg: [Loads; 2], steps: usize) -> Option<f64> {
        let [from, to] = leg;
        let states = self.march(start, leg, steps);
        let changes = |step: &usize| states[*step].bottom() * states[step + 1].bottom() < 0.0;
        // A leg begins where they just touch, but for rounding; in the first steps from no load, after which lengths are
        // below 1e-4 of those at its end, the sign is an error of the rule.
        let first = if from.upper == 0.0 { steps / 10 } else { 1 };
        let step = (first..steps).find(changes)? as f64;
        let bottom = |part: f64| {
            let there = from.towards(to, part, self.power.value());
            self.end(start, [from, there], steps).bottom()
        };
        let [low, high] = [step - 0.5, step + 1.5].map(|step| (step / steps as f64).min(1.0));
        Some(root(bottom, low, high))
    }

    /// The stack whose lower cylinders alone have a weight: nothing but the floor is pressed.
    fn floor_pressed(&self, weight: f64) -> State {
        let indented = (weight / self.floor_ratio).powf(self.power.value().recip());
        State {
            moved: [0.0, 0.0, indented, 0.0],
            ..State::STRESS_FREE
        }
    }

    /// The state at the end of a leg on which the lower cylinders neither part nor touch, and the floor does not slip.
    fn stuck(&self, start: &State, leg: [Loads; 2], steps: usize) -> State {
        let states = self.march(start, leg, steps);
        let slips = states[1..].iter().any(|state| self.excess(state) >= 0.0);
        assert!(!slips, "{self:?} slips between {leg:?}");
        states[steps]
    }

    /// The state at the end of a way through several loads, in so many steps a leg. The path has a kink where the lower
    /// cylinders part or touch: a leg ends there.
    fn led(&self, through: &[Loads], steps: usize) -> State {
        let mut state = State::STRESS_FREE;
        for leg in through.windows(2) {
            let [mut from, to] = [leg[0], leg[1]];
            if to.upper == 0.0 {
                state = self.floor_pressed(to.lower);
                continue;
            }
            while let Some(part) = self.first_change(&state, [from, to], steps) {
                let kink = from.towards(to, part, self.power.value());
                state = self.stuck(&state, [from, kink], steps);
                from = kink;
            }
            state = self.stuck(&state, [from, to], steps);
        }
        state
    }

    /// Shear of pair and floor.
    pub fn shear(&self, state: &State) -> [f64; 2] {
        let overlaps = Geometry::of(state.moved).overlaps;
        [0, 1].map(|contact| match self.keeps_force() {
            true => state.springs[contact],
            false => self.tangential_stiffness(contact, overlaps[contact]) * state.springs[contact],
        })
    }

    /// e − μ d of a state.
    fn excess(&self, state: &State) -> f64 {
        let [_, floor, _] = Geometry::of(state.moved).overlaps;
        self.shear(state)[1] - self.mu * self.pressed(self.floor_ratio, floor)
    }

    /// The load of cylinder 1 at which the floor slips, while the weight of the lower ones stays, if the lower cylinders
    /// neither part nor touch on the way.
    fn slip_load(&self, start: &State, from: Loads, steps: usize) -> f64 {
        let at = |upper: f64| {
            let to = Loads { upper, ..from };
            self.excess(&self.end(start, [from, to], steps))
        };
        assert!(self.excess(start) < 0.0, "{self:?} slips at once");
        let (mut low, mut high) = (from.upper, 1.1 * from.upper);
        while at(high) < 0.0 {
            low = high;
            high *= 1.1;
            assert!(high < 1e9 * from.lower, "{self:?}");
        }
        root(at, low, high)
    }

    /// The state at the end of a way through several loads, the last of which are the weights, and F at the slip of the
    /// floor on the way from there, in so many steps a leg.
    pub fn arrival(&self, through: &[Loads], steps: usize) -> (State, f64) {
        let arrived = self.led(through, steps);
        let (mut state, mut from) = (arrived, *through.last().expect("loads"));
        loop {
            let upper = self.slip_load(&state, from, steps);
            let leg = [from, Loads { upper, ..from }];
            let Some(part) = self.first_change(&state, leg, steps) else {
                return (arrived, upper * self.stiffness - 1.0);
            };
            let kink = from.towards(leg[1], part, self.power.value());
            state = self.end(&state, [from, kink], steps);
            from = kink;
        }
    }
}

/// The place so many times as far from one as another.
fn stretched(from: Moved, to: Moved, ratio: f64) -> Moved {
    std::array::from_fn(|at| from[at] + ratio * (to[at] - from[at]))
}

/// The solution of linear equations, each with its right side last, by elimination.
pub fn solved<const N: usize, const M: usize>(mut system: [[f64; M]; N]) -> [f64; N] {
    for column in 0..N {
        let pivot = (column..N).max_by(|&i, &j| {
            let size = |row: usize| system[row][column].abs();
            size(i).total_cmp(&size(j))
        });
        system.swap(column, pivot.expect("a row"));
        let (above, below) = system.split_at_mut(column + 1);
        let above = above[column];
        for row in below {
            let factor = row[column] / above[column];
            for (entry, above) in row.iter_mut().zip(above).skip(column) {
                *entry -= factor * above;
            }
        }
    }
    let mut solution = [0.0; N];
    for row in (0..N).rev() {
        let known: f64 = (row + 1..N)
            .map(|entry| system[row][entry] * solution[entry])
            .sum();
        solution[row] = (system[row][M - 1] - known) / system[row][row];
    }
    solution
}
