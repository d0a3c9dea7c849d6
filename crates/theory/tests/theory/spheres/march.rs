//! The balances of all n + 1 spheres in three dimensions: six for each, with its displacement and its rotation as unknowns,
//! contact springs that are vectors and turn with their contacts, in small implicit steps. Nothing of it knows of a
//! meridian plane.

use super::Problem;
use nalgebra::{DMatrix, DVector, Vector3};

type Vector = Vector3<f64>;

/// Turns the whole stack about the vertical, so that no sphere lies on a coordinate axis.
const AZIMUTH: f64 = 0.37;

/// The spheres: the top one, then the ring, each with its displacement and the sum of its small rotations.
type Moved = Vec<[Vector; 2]>;

/// Two bodies that may touch; the floor is none.
#[derive(Clone, Copy)]
pub struct Contact {
    body: usize,
    other: Option<usize>,
}

/// A contact in one state: normal towards `body`, overlap, and what its spring remembers, displacement or force.
#[derive(Clone, Copy)]
struct Spring {
    normal: Vector,
    overlap: f64,
    memory: Vector,
}

/// The stack in one state of its march.
#[derive(Clone)]
pub struct State {
    moved: Moved,
    springs: Vec<Spring>,
}

/// Weight of each sphere, and force of the wall on the top one.
#[derive(Clone, Copy)]
struct Loaded {
    weight: f64,
    wall: f64,
}

/// A problem with its undeformed places and its contacts: of the top sphere, of the floor, and of neighbours.
#[derive(Clone)]
pub struct Stack {
    own: Problem,
    /// Whether neighbours press each other, as they do in a whole leg of the march or not at all: so no force has a kink
    /// within it. That overlaps agree is asked in the end.
    pressing: bool,
    places: Vec<Vector>,
    pub contacts: Vec<Contact>,
}

impl Stack {
    pub fn new(own: Problem, pressing: bool) -> Self {
        let (count, radius) = (usize::from(own.bodies), own.radius());
        let height = (4.0 - radius * radius).sqrt();
        let ring = (0..count).map(|index| {
            let angle = AZIMUTH + 2.0 * std::f64::consts::PI * index as f64 / count as f64;
            Vector::new(radius * angle.cos(), radius * angle.sin(), 0.0)
        });
        let with = |body, other| Contact { body, other };
        let top = (1..=count).map(|index| with(0, Some(index)));
        let floor = (1..=count).map(|index| with(index, None));
        let neighbours = (1..=count).map(|index| with(index, Some(index % count + 1)));
        Self {
            own,
            pressing,
            places: std::iter::once(Vector::new(0.0, 0.0, height))
                .chain(ring)
                .collect(),
            contacts: top.chain(floor).chain(neighbours).collect(),
        }
    }

    fn at_rest_without_weight(&self) -> State {
        let moved = vec![[Vector::zeros(); 2]; self.places.len()];
        let memory = Vector::zeros();
        let springs = self.contacts.iter().map(|contact| {
            let (normal, overlap) = self.touch(contact, &moved);
            Spring {
                normal,
                overlap,
                memory,
            }
        });
        State {
            springs: springs.collect(),
            moved,
        }
    }

    /// Normal and overlap of a contact; spheres just touch where nothing has moved.
    fn touch(&self, contact: &Contact, moved: &Moved) -> (Vector, f64) {
        let Some(other) = contact.other else {
            return (Vector::z(), -moved[contact.body][0].z);
        };
        let apart = self.places[contact.body] - self.places[other];
        let change = moved[contact.body][0] - moved[other][0];
        let distance = (apart + change).norm();
        // 4 − distance², without the difference of the places.
        let nearer = -(2.0 * apart + change).dot(&change);
        ((apart + change) / distance, nearer / (2.0 + distance))
    }

    /// Scale of the force and arms of torque and kinematics.
    fn law(&self, contact: &Contact) -> (f64, [f64; 2]) {
        let [pair_torque, pair_kinematic, floor_torque, floor_kinematic] = self.own.arms;
        match contact.other {
            Some(_) => (1.0, [pair_torque, pair_kinematic]),
            None => (self.own.floor_ratio, [floor_torque, floor_kinematic]),
        }
    }

    /// Scale of the force where there is one.
    fn bears(&self, contact: &Contact, overlap: f64) -> f64 {
        let touches = match contact.body > 0 && contact.other.is_some() {
            true => self.pressing,
            false => overlap > 0.0,
        };
        if touches { self.law(contact).0 } else { 0.0 }
    }

    pub fn normal_force(&self, contact: &Contact, overlap: f64) -> f64 {
        self.bears(contact, overlap) * overlap.signum() * overlap.abs().powf(self.own.power.value())
    }

    fn tangential_stiffness(&self, contact: &Contact, overlap: f64) -> f64 {
        let p = self.own.power.value();
        p * self.bears(contact, overlap) * overlap.abs().powf(p - 1.0) / self.own.kappa
    }

    /// The springs after the step from `old`: what they remember turns with the normal by the shortest way, half of the turn
    /// before and half of it after they collect what the surfaces have moved.
    fn springs(&self, old: &State, moved: &Moved) -> Vec<Spring> {
        let pairs = self.contacts.iter().zip(&old.springs);
        let springs = pairs.map(|(contact, before)| {
            let (normal, overlap) = self.touch(contact, moved);
            let middle = (before.normal + normal).normalize();
            let change = |body: usize| {
                let [place, turn] = moved[body];
                let [old_place, old_turn] = old.moved[body];
                [place - old_place, turn - old_turn]
            };
            let [mut shift, mut turn] = change(contact.body);
            if let Some(other) = contact.other {
                let [other_shift, other_turn] = change(other);
                shift -= other_shift;
                turn += other_turn;
            }
            let (_, [_, kinematic]) = self.law(contact);
            let arm = 1.0 + kinematic * 0.5 * (before.overlap + overlap);
            let slid = shift - middle * middle.dot(&shift) - arm * turn.cross(&middle);
            let stiffness = |overlap| self.tangential_stiffness(contact, overlap);
            let collected = match self.own.keeps_force() {
                true => 0.5 * (stiffness(before.overlap) + stiffness(overlap)) * slid,
                false => slid,
            };
            let halfway = turned(before.normal, middle, before.memory) + collected;
            Spring {
                normal,
                overlap,
                memory: turned(middle, normal, halfway),
            }
        });
        springs.collect()
    }

    /// Normal and tangential force on the body of a contact.
    fn forces(&self, contact: &Contact, spring: &Spring) -> [Vector; 2] {
        let stiffness = match self.own.keeps_force() {
            true => f64::from(self.bears(contact, spring.overlap) > 0.0),
            false => self.tangential_stiffness(contact, spring.overlap),
        };
        [
            self.normal_force(contact, spring.overlap) * spring.normal,
            -stiffness * spring.memory,
        ]
    }

    /// Force and torque that each sphere lacks.
    fn lacks(&self, old: &State, moved: &Moved, loaded: Loaded) -> DVector<f64> {
        // A bottom sphere can spin about the line through its two contacts at no cost. A spring holds it, and stays empty:
        // it acts on rotations about axes in the plane of that line and the vertical alone.
        const HOLD: f64 = 0.1;
        let mut lacks: Vec<[Vector; 2]> = moved
            .iter()
            .zip(&self.places)
            .map(|([_, turn], place)| {
                let axis = Vector::z().cross(place);
                let own = turn - axis * axis.dot(turn) / axis.norm_squared().max(1e-300);
                [-loaded.weight * Vector::z(), -HOLD * own]
            })
            .collect();
        lacks[0][0].z -= loaded.wall;
        lacks[0][1] = Vector::zeros();
        for (contact, spring) in self.contacts.iter().zip(self.springs(old, moved)) {
            let [normal, shear] = self.forces(contact, &spring);
            let (_, [torque, _]) = self.law(contact);
            let arm = 1.0 + torque * spring.overlap;
            let turning = -arm * spring.normal.cross(&shear);
            let [force, moment] = &mut lacks[contact.body];
            *force += normal + shear;
            *moment += turning;
            if let Some(other) = contact.other {
                let [force, moment] = &mut lacks[other];
                *force -= normal + shear;
                *moment += turning;
            }
        }
        let each = lacks
            .iter()
            .flatten()
            .flat_map(|vector| vector.iter().copied());
        DVector::from_iterator(6 * moved.len(), each)
    }

    /// The state after a step to a load, by Newton's method with differences for derivatives.
    fn step(&self, old: &State, guess: Moved, loaded: Loaded) -> State {
        const MOST: usize = 60;
        const ANEW_EVERY: usize = 8;
        let flat = |moved: &Moved| -> Vec<f64> {
            moved
                .iter()
                .flatten()
                .flat_map(|vector| vector.iter().copied())
                .collect()
        };
        let mut unknowns = flat(&guess);
        let size = unknowns.len();
        let as_moved = |unknowns: &[f64]| -> Moved {
            let vector = |part: &[f64]| Vector::new(part[0], part[1], part[2]);
            unknowns
                .chunks(6)
                .map(|own| [vector(&own[..3]), vector(&own[3..])])
                .collect()
        };
        let scale = unknowns
            .iter()
            .fold(0.0, |most: f64, part| most.max(part.abs()));
        let mut derivative = None;
        let mut last = f64::INFINITY;
        for round in 0..MOST {
            let lacks = self.lacks(old, &as_moved(&unknowns), loaded);
            if round % ANEW_EVERY == 0 {
                let width = 1e-5 * scale;
                let mut matrix = DMatrix::zeros(size, size);
                for column in 0..size {
                    let shifted = |by: f64| {
                        let mut shifted = unknowns.clone();
                        shifted[column] += by;
                        self.lacks(old, &as_moved(&shifted), loaded)
                    };
                    let slope = (shifted(width) - shifted(-width)) / (2.0 * width);
                    matrix.set_column(column, &slope);
                }
                derivative = Some(matrix.lu());
            }
            let change = derivative.as_ref().and_then(|own| own.solve(&lacks));
            let change = change.unwrap_or_else(|| panic!("{:?}", self.own));
            for (unknown, change) in unknowns.iter_mut().zip(&change) {
                *unknown -= change;
            }
            let moved = change.amax() / scale;
            if moved < 1e-15 || (moved < 1e-11 && moved >= last) {
                let moved = as_moved(&unknowns);
                let springs = self.springs(old, &moved);
                return State { moved, springs };
            }
            last = moved;
        }
        panic!("no balance: {:?}", self.own);
    }

    /// The stack at rest after a gravity ramp, whose steps are even in the fourth root of the lengths.
    fn settled(&self, steps: usize) -> State {
        let mut old = self.at_rest_without_weight();
        for step in 1..=steps {
            let part = (step as f64 / steps as f64).powi(4);
            let weight = self.own.weight() * part.powf(self.own.power.value());
            let loaded = Loaded { weight, wall: 0.0 };
            let guess = match step {
                1 => self.first_guess(weight),
                _ => {
                    let ratio = (step as f64 / (step as f64 - 1.0)).powi(4);
                    old.moved
                        .iter()
                        .map(|own| own.map(|part| ratio * part))
                        .collect()
                }
            };
            old = self.step(&old, guess, loaded);
        }
        old
    }

    /// Some displacements of a load: overlaps that about bear it, and steps outwards with the rotation that goes with them.
    fn first_guess(&self, weight: f64) -> Moved {
        let inverse = self.own.power.value().recip();
        let count = self.own.count();
        let pair = (weight / count).powf(inverse);
        let floor = (weight * (1.0 + 1.0 / count)).powf(inverse);
        let ring = self.places[1..].iter().map(|place| {
            let outward = 0.3 * pair * place.normalize();
            [outward - floor * Vector::z(), Vector::z().cross(&outward)]
        });
        let top = [-(floor + 2.0 * pair) * Vector::z(), Vector::zeros()];
        std::iter::once(top).chain(ring).collect()
    }

    /// The state at the second force of the wall from one at the first, in even steps of the logarithm of the load of the top
    /// sphere.
    fn pressed(&self, start: &State, [from, to]: [f64; 2], steps: usize) -> State {
        let weight = self.own.weight();
        let [mut before, mut old] = [start.clone(), start.clone()];
        for step in 1..=steps {
            let part = step as f64 / steps as f64;
            let load = weight * (1.0 + from) * ((1.0 + to) / (1.0 + from)).powf(part);
            let wall = load - weight;
            let pairs = old.moved.iter().zip(&before.moved);
            let guess = pairs.map(|(now, then)| [2.0 * now[0] - then[0], 2.0 * now[1] - then[1]]);
            let next = self.step(&old, guess.collect(), Loaded { weight, wall });
            before = std::mem::replace(&mut old, next);
        }
        old
    }

    /// e/d − μ of the floor contact of a bottom sphere.
    fn excess(&self, state: &State, sphere: usize) -> f64 {
        let place = usize::from(self.own.bodies) + sphere;
        let [normal, shear] = self.forces(&self.contacts[place], &state.springs[place]);
        shear.norm() / normal.norm() - self.own.mu
    }

    /// The force at which `value` vanishes beyond the state `start` at a force, and the state there; by secants from `near`.
    fn force_where(
        &self,
        (from, start): (f64, &State),
        near: f64,
        steps: usize,
        value: impl Fn(&State) -> f64,
    ) -> (f64, State) {
        let at = |force: f64| self.pressed(start, [from, force], steps);
        let [mut force, mut next] = [near, near + 1e-4 * (near + 1.0)];
        let mut old_value = value(&at(force));
        for _ in 0..20 {
            let next_value = value(&at(next));
            let change = next_value * (next - force) / (next_value - old_value);
            (force, old_value) = (next, next_value);
            next -= change;
            if change.abs() < 1e-9 * (next + 1.0) {
                break;
            }
        }
        (next, at(next))
    }

    /// F at the slip of the floor in so many steps a leg, from `near`, and the state there.
    pub fn stepped_onset(&self, steps: usize, near: f64) -> (f64, State) {
        let settled = self.settled(steps);
        assert_eq!(self.neighbour_overlap(&settled) > 0.0, self.pressing);
        let excess = |state: &State| self.excess(state, 0);
        let (force, end) = self.force_where((0.0, &settled), near, steps, excess);
        if (self.neighbour_overlap(&end) > 0.0) == self.pressing {
            return (force, end);
        }
        let overlap = |state: &State| self.neighbour_overlap(state);
        let (parting, state) = self.force_where((0.0, &settled), 0.5 * near, steps, overlap);
        let parted = Self {
            pressing: false,
            ..self.clone()
        };
        let (force, end) = parted.force_where((parting, &state), near, steps, excess);
        assert!(self.neighbour_overlap(&end) < 0.0);
        (force, end)
    }

    /// Largest distance of the state from symmetry: other floor ratios of other spheres, rotations about other axes than
    /// across the meridian, a top sphere that moves sidewards or turns, and neighbours that shear each other.
    pub fn asymmetry(&self, state: &State) -> f64 {
        let count = usize::from(self.own.bodies);
        let scale = state.moved[0][0].norm();
        let floor = (0..count).map(|sphere| self.excess(state, sphere) - self.excess(state, 0));
        let ring = self.places[1..].iter().zip(&state.moved[1..]);
        let turns = ring.map(|(place, [_, turn])| {
            let axis = Vector::z().cross(place).normalize();
            (turn - axis * axis.dot(turn)).norm() / scale
        });
        let [shift, turn] = state.moved[0];
        let top = [shift.xy().norm() / scale, turn.norm() / scale];
        let sheared = state.springs[2 * count..]
            .iter()
            .map(|spring| spring.memory.norm() / scale);
        let all = floor.chain(turns).chain(top).chain(sheared);
        all.fold(0.0, |most, part| most.max(part.abs()))
    }

    /// Overlap of the first pair of neighbours.
    pub fn neighbour_overlap(&self, state: &State) -> f64 {
        state.springs[2 * usize::from(self.own.bodies)].overlap
    }
}

/// `vector` after the turn that takes the direction `from` to `to` by the shortest way.
fn turned(from: Vector, to: Vector, vector: Vector) -> Vector {
    let sum = from + to;
    vector - sum * sum.dot(&vector) / (1.0 + from.dot(&to)) + 2.0 * to * from.dot(&vector)
}
