//! The balance of forces along the path of equilibria, for any arms and contact law.
//!
//! With the torque arms R_c = r + r₁ G and R_f = r + r₁ z, equilibrium reads (forces in k_n r, lengths in r)
//!
//! b R_c = e R_f,  −a sin ψ + b cos ψ + e = 0,  n (a cos ψ + b sin ψ) = L,
//!
//! where n bodies carry cylinder 1 (2 cylinders, or 3 to 5 spheres) and L is the load on it: its growing weight along the
//! gravity ramp, f + m g under the wall. The springs accumulate ρ dψ − R̃_c dθ and dx₂ + R̃_f dθ, with the kinematic arms R̃
//! of the same form. Differentiated with respect to ψ this is a linear 3×3 system for (ρ′, θ′, L′), regular also
//! where L has a maximum (docs/theory.md, Eqs. 10, 15 and 36 to 40).
//!
//! A spring that remembers its displacement gains force as its overlap grows: b′ and e′ have the further parts
//! b (ln k_c)′ and e (ln k_f)′ then (Eq. 81).
//!
//! Contact 2–3 can be ignored (c = 0, the paper's assumption) or followed. Where it is closed, y < 0, it
//! carries c = N(−2y/x₀), and nothing tangential: by mirror symmetry its surfaces do not move against each
//! other. The horizontal balance becomes −a sin ψ + b cos ψ + e − c = 0 and the torques stay as they are. A sphere has
//! two such neighbours, which press it outwards by 2c sin(π/n) (Eqs. 98 and 99).

use super::super::events::{PathPoint, half_angle_tangent, outward_displacement};
use super::super::root::bracketed_root;
use crate::model::{Arms, ContactArms, ContactConvention, ContactLaw, Ring, Stack};
use nalgebra::{Matrix3, Vector3};

/// The state that is integrated.
#[derive(Debug, Clone, Copy)]
pub(super) struct State {
    /// ψ − ψ₀.
    pub(super) turned: f64,
    /// L, load carried by cylinder 1.
    pub(super) load: f64,
    /// G = 2r − ρ.
    pair_overlap: f64,
    /// θ, rotation of cylinder 2.
    rotation: f64,
    /// b, tangential force of the contact 1–2.
    pair_shear: f64,
    /// e, tangential force of the floor contact.
    floor_shear: f64,
}

impl State {
    pub(super) fn from_array(state: [f64; 6]) -> Self {
        let [
            turned,
            load,
            pair_overlap,
            rotation,
            pair_shear,
            floor_shear,
        ] = state;
        Self {
            turned,
            load,
            pair_overlap,
            rotation,
            pair_shear,
            floor_shear,
        }
    }

    pub(super) fn to_array(self) -> [f64; 6] {
        [
            self.turned,
            self.load,
            self.pair_overlap,
            self.rotation,
            self.pair_shear,
            self.floor_shear,
        ]
    }

    /// y = x₂ − x₀.
    pub(super) fn outward(&self, ring: &Ring) -> f64 {
        outward_displacement(ring, self.turned, self.pair_overlap)
    }
}

/// The two legs of the path, which differ in how the floor load d grows with L.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Leg {
    /// Gravity grows until L = ε: d = L/n + L. The parameter is the angle turned, in units of `first_turn`.
    GravityRamp,
    /// The wall presses: d = L/n + ε. The parameter grows with the logarithm of the angle turned.
    Wall,
}

impl Leg {
    fn floor_force(self, load: f64, epsilon: f64, ring: &Ring) -> f64 {
        let borne = self.floor_force_slope(ring) * load;
        match self {
            Self::GravityRamp => borne,
            Self::Wall => borne + epsilon,
        }
    }

    fn floor_force_slope(self, ring: &Ring) -> f64 {
        let share = ring.bodies.recip();
        match self {
            Self::GravityRamp => share + 1.0,
            Self::Wall => share,
        }
    }
}

/// Treatment of the contact between the bottom cylinders.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BottomContact {
    /// It carries nothing, c = 0, even where the cylinders would overlap.
    Ignored,
    /// It closes where y < 0 and opens where y > 0.
    Followed,
}

/// Where a path begins.
pub(super) struct Beginning {
    /// The angle turned under gravity, to first order in ε.
    pub(super) first_turn: f64,
    /// The state from which the path is followed.
    pub(super) state: State,
    /// Whether contact 2–3 is closed from there on.
    pub(super) closed: bool,
}

/// Constants of the contacts along a path.
#[derive(Debug, Clone, Copy)]
pub(super) struct Contacts {
    pub(super) ring: Ring,
    law: ContactLaw,
    wall: ContactLaw,
    arms: Arms,
    pub(super) epsilon: f64,
    pub(super) bottom: BottomContact,
}

/// One of the two contacts with friction, in one state.
struct Pressed {
    /// Torque arm R.
    lever: f64,
    /// Kinematic arm R̃.
    radius: f64,
    /// dN/dδ.
    stiffness: f64,
    /// k_t.
    tangential: f64,
    /// Change of the tangential force with the overlap while the surfaces do not move.
    memory: f64,
}

impl Pressed {
    fn new(law: &ContactLaw, arms: ContactArms, overlap: f64, shear: f64, unloads: bool) -> Self {
        let kept = match law.history.keeps_force() {
            true => 0.0,
            false => shear * law.tangential_steepening(overlap),
        };
        let lost = match law.history.is_rescaled() && unloads {
            true => 0.5 * shear / overlap,
            false => 0.0,
        };
        Self {
            lever: 1.0 + arms.torque * overlap,
            radius: 1.0 + arms.kinematic * overlap,
            stiffness: law.stiffness(overlap),
            tangential: law.at(overlap).tangential_stiffness,
            memory: kept + lost,
        }
    }
}

impl Contacts {
    pub(super) fn new(
        stack: &Stack,
        convention: &ContactConvention,
        bottom: BottomContact,
    ) -> Self {
        Self {
            ring: stack.ring(),
            law: convention.law(stack.stiffness_ratio),
            wall: convention.wall_law(stack.stiffness_ratio),
            arms: convention.arms,
            epsilon: stack.epsilon(),
            bottom,
        }
    }

    /// The beginning of the path, at `fraction` of the angle turned under gravity: on the ray along which all lengths are
    /// proportional to that angle, and all forces to its power p (docs/theory.md, Eqs. 82, 83 and 104).
    pub(super) fn beginning(&self, fraction: f64) -> Beginning {
        let ray = Ray::of(self);
        let [upper_stretch, _] = ray.stretch(self);
        let first_turn = self.law.overlap(self.epsilon / ray.load);
        let turned = fraction * first_turn;
        let force = self.law.force(turned);
        Beginning {
            first_turn,
            closed: ray.bottom_force > 0.0,
            state: State {
                turned,
                load: ray.load * force,
                pair_overlap: ray.pair_overlap * turned,
                rotation: (2.0 - upper_stretch) * turned,
                pair_shear: ray.shear * force,
                floor_shear: ray.shear * force,
            },
        }
    }

    /// Derivative of the state with respect to ψ, with contact 2–3 closed or open (docs/theory.md,
    /// Eqs. 37 to 39, 52 and 81).
    pub(super) fn derivative(&self, state: &State, leg: Leg, closed: bool) -> State {
        let (slope, loads) = self.slope(state, leg, closed, [false; 2]);
        let unloads = loads.map(|loads| !loads);
        match self.law.history.is_rescaled() && unloads != [false; 2] {
            true => self.slope(state, leg, closed, unloads).0,
            false => slope,
        }
    }

    /// The derivative if pair and floor `unload` as given, and whether their overlaps grow along it.
    fn slope(
        &self,
        state: &State,
        leg: Leg,
        closed: bool,
        unload: [bool; 2],
    ) -> (State, [bool; 2]) {
        let ring = &self.ring;
        let (sin, cos) = libm::sincos(ring.angle + state.turned);
        let distance = 2.0 - state.pair_overlap;
        let floor_overlap = self
            .wall
            .overlap(leg.floor_force(state.load, self.epsilon, ring));
        let (b, e) = (state.pair_shear, state.floor_shear);
        let Arms { pair, floor } = self.arms;
        let upper = Pressed::new(&self.law, pair, state.pair_overlap, b, unload[0]);
        let lower = Pressed::new(&self.wall, floor, floor_overlap, e, unload[1]);
        let a = self.law.force(state.pair_overlap);
        // What the neighbours push less per distance that the body moves outwards.
        let bottom_stiffness = match closed {
            true => {
                let overlap = ring.neighbour_overlap(state.outward(ring));
                -ring.push * ring.neighbour_overlap(1.0) * self.law.stiffness(overlap)
            }
            false => 0.0,
        };
        let sinking = leg.floor_force_slope(ring) / lower.stiffness;

        // Rows: torque on 2, horizontal force on 2, vertical force on 1. Columns: ρ′, θ′, L′.
        let system = Matrix3::new(
            -(b * pair.torque + upper.lever * upper.memory) - lower.tangential * lower.lever * sin,
            -upper.tangential * upper.lever * upper.radius
                - lower.tangential * lower.lever * lower.radius,
            -(e * floor.torque + lower.lever * lower.memory) * sinking,
            (upper.stiffness + lower.tangential + bottom_stiffness) * sin - upper.memory * cos,
            -upper.tangential * upper.radius * cos + lower.tangential * lower.radius,
            lower.memory * sinking,
            -ring.bodies * upper.stiffness * cos - ring.bodies * upper.memory * sin,
            -ring.bodies * upper.tangential * upper.radius * sin,
            -1.0,
        );
        let known = Vector3::new(
            (upper.tangential * upper.lever - lower.tangential * lower.lever * cos) * distance,
            (upper.tangential + lower.tangential + bottom_stiffness) * distance * cos
                - a * cos
                - b * sin,
            ring.bodies * (upper.tangential * distance * sin - a * sin + b * cos),
        );
        let solution = system
            .lu()
            .solve(&-known)
            .unwrap_or(Vector3::repeat(f64::NAN));
        let (distance_slope, rotation_slope, load_slope) = (solution.x, solution.y, solution.z);
        let floor_overlap_slope = sinking * load_slope;
        let slope = State {
            turned: 1.0,
            load: load_slope,
            pair_overlap: -distance_slope,
            rotation: rotation_slope,
            pair_shear: upper.tangential * (distance - upper.radius * rotation_slope)
                - upper.memory * distance_slope,
            floor_shear: lower.tangential
                * (distance_slope * sin + distance * cos + lower.radius * rotation_slope)
                + lower.memory * floor_overlap_slope,
        };
        (slope, [distance_slope <= 0.0, floor_overlap_slope >= 0.0])
    }

    pub(super) fn point(&self, state: &State, leg: Leg) -> PathPoint {
        let (law, ring) = (&self.law, &self.ring);
        let outward = state.outward(ring);
        let floor_force = leg.floor_force(state.load, self.epsilon, ring);
        let wall_force = match leg {
            Leg::GravityRamp => 0.0,
            Leg::Wall => state.load - self.epsilon,
        };
        PathPoint {
            tangent: half_angle_tangent(ring, state.turned),
            pair_overlap: state.pair_overlap,
            floor_overlap: self.wall.overlap(floor_force),
            floor_force,
            outward,
            pair_ratio: state.pair_shear / law.force(state.pair_overlap),
            floor_ratio: state.floor_shear / floor_force,
            bottom_force: match self.bottom {
                BottomContact::Ignored => 0.0,
                BottomContact::Followed => law.force(ring.neighbour_overlap(outward).max(0.0)),
            },
            wall_force,
            wall_overlap: self.wall.overlap(wall_force),
        }
    }
}

/// The direction in which a path leaves the stress-free state: lengths over the angle turned, forces over its power p.
struct Ray {
    pair_overlap: f64,
    shear: f64,
    bottom_force: f64,
    load: f64,
}

impl Ray {
    /// The ray on which the springs of both contacts collect what the geometry demands (docs/theory.md, Eqs. 83 and 104).
    fn of(contacts: &Contacts) -> Self {
        let ring = &contacts.ring;
        let (widening, sine) = (2.0 + ring.rise, 0.5 * ring.radius);
        let excess = |pair_overlap: f64| {
            let ray = Self::along(contacts, pair_overlap);
            ray.stretch(contacts).iter().sum::<f64>() + sine * pair_overlap - widening
        };
        // Overlaps of 0 have no stiffness.
        let pair_overlap = bracketed_root(excess, 1e-100, 2.0 * widening).unwrap_or(f64::NAN);
        Self::along(contacts, pair_overlap)
    }

    /// Forces of the balances at ψ₀ and an overlap of the pair.
    fn along(contacts: &Contacts, pair_overlap: f64) -> Self {
        let (law, ring) = (&contacts.law, &contacts.ring);
        let (sine, cosine) = (0.5 * ring.radius, 0.5 * ring.rise);
        let normal = law.force(pair_overlap);
        let bottom_force = match contacts.bottom {
            BottomContact::Ignored => 0.0,
            BottomContact::Followed => {
                law.force((pair_overlap - 2.0 * ring.rise / ring.radius).max(0.0))
            }
        };
        let shear = (sine * normal + ring.push * bottom_force) / (1.0 + cosine);
        Self {
            pair_overlap,
            shear,
            bottom_force,
            load: ring.bodies * (cosine * normal + sine * shear),
        }
    }

    /// How far the springs of pair and floor are stretched.
    fn stretch(&self, contacts: &Contacts) -> [f64; 2] {
        let floor_force = Leg::GravityRamp.floor_force(self.load, 0.0, &contacts.ring);
        let floor_overlap = contacts.wall.overlap(floor_force);
        let contacts = [
            (&contacts.law, self.pair_overlap),
            (&contacts.wall, floor_overlap),
        ];
        contacts.map(|(law, overlap)| {
            // A force that grows with the power p of a length is p of itself per relative growth of it.
            let growth = match law.history.keeps_force() {
                true => law.power.value(),
                false => 1.0,
            };
            growth * self.shear / law.unstiffened(overlap)
        })
    }
}
