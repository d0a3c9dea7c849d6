//! The balance of forces along the path of equilibria, for any arms and contact law.
//!
//! With the torque arms R_c = r + r₁ G and R_f = r + r₁ z, equilibrium reads (forces in k_n r, lengths in r)
//!
//! b R_c = e R_f,  −a sin ψ + b cos ψ + e = 0,  n (a cos ψ + b sin ψ) = L,
//!
//! where n bodies carry cylinder 1 (2 cylinders, or 3 to 5 spheres) and L is the load on it: its growing weight along
//! the gravity ramp, f + m g under the wall. The springs accumulate ρ dψ − R̃_c dθ and dx₂ + R̃_f dθ, with the
//! kinematic arms R̃ of the same form. Differentiated with respect to ψ, this is a linear 3×3 system for (ρ′, θ′, L′),
//! which is regular also where L has a maximum (docs/theory.md, Eqs. 10, 15 and 36 to 40).
//!
//! A spring that remembers its displacement gains force as its overlap grows: b′ and e′ then have the additional terms
//! b (ln k_c)′ and e (ln k_f)′ (Eq. 81).
//!
//! A spring that does not turn with its contact is a vector q = b t + p n, which grows along the present t alone. When
//! n and t turn by dψ, b gains p dψ and p loses b dψ, and a + p replaces a in both balances of forces (Eqs. 109 to
//! 111).
//!
//! Contact 2–3 can be ignored (c = 0, the paper's assumption) or followed. Where it is closed, y < 0, it carries the
//! normal force c = N(−2y/x₀) and no tangential force: by mirror symmetry its surfaces do not move relative to each
//! other. The horizontal balance becomes −a sin ψ + b cos ψ + e − c = 0, and the torques do not change. A sphere has
//! two such neighbours, which press it outwards by 2c sin(π/n) (Eqs. 98 and 99).

use super::super::events::{PathPoint, half_angle_tangent, outward_displacement};
use super::super::root::bracketed_root;
use crate::model::{Arms, ContactArms, ContactConvention, ContactLaw, Ring, Stack};
use nalgebra::{Matrix3, Matrix4, Vector3, Vector4};

/// The integrated state.
#[derive(Debug, Clone, Copy)]
pub(super) struct State {
    /// ψ − ψ₀.
    pub(super) turned: f64,
    /// L, load carried by cylinder 1.
    pub(super) load: f64,
    /// G = 2r − ρ.
    pub(super) pair_overlap: f64,
    /// θ, rotation of cylinder 2.
    pub(super) rotation: f64,
    /// b, tangential force of the contact 1–2.
    pub(super) pair_shear: f64,
    /// e, tangential force of the floor contact.
    pub(super) floor_shear: f64,
    /// p, component of the force of the tangential spring 1–2 along the normal; 0 for a spring that turns with its
    /// contact.
    pub(super) pair_lift: f64,
}

/// Size of a state if springs turn with their contacts.
pub(super) const TURNING: usize = 6;
/// Size of a state if springs do not turn.
pub(super) const FIXED: usize = 7;

impl State {
    /// Builds a state from numbers in the order of the fields; missing ones are 0.
    pub(super) fn from_array<const N: usize>(numbers: [f64; N]) -> Self {
        let number = |index: usize| numbers.get(index).copied().unwrap_or(0.0);
        Self {
            turned: number(0),
            load: number(1),
            pair_overlap: number(2),
            rotation: number(3),
            pair_shear: number(4),
            floor_shear: number(5),
            pair_lift: number(6),
        }
    }

    /// Returns the first N numbers of the state, padded with 0.
    pub(super) fn to_array<const N: usize>(self) -> [f64; N] {
        let numbers: [f64; FIXED] = [
            self.turned,
            self.load,
            self.pair_overlap,
            self.rotation,
            self.pair_shear,
            self.floor_shear,
            self.pair_lift,
        ];
        std::array::from_fn(|index| numbers.get(index).copied().unwrap_or(0.0))
    }

    /// A state of NaN, for where there is no equilibrium.
    pub(super) fn lost() -> Self {
        Self::from_array([f64::NAN; FIXED])
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
    pub(super) fn floor_force(self, load: f64, epsilon: f64, ring: &Ring) -> f64 {
        let borne = self.floor_force_slope(ring) * load;
        match self {
            Self::GravityRamp => borne,
            Self::Wall => borne + epsilon,
        }
    }

    pub(super) fn floor_force_slope(self, ring: &Ring) -> f64 {
        let share = ring.bodies.recip();
        match self {
            Self::GravityRamp => share + 1.0,
            Self::Wall => share,
        }
    }
}

/// The parameter of a sliding branch.
#[derive(Debug, Clone, Copy)]
pub(super) enum Progress {
    /// The logarithm of the load L.
    Load,
    /// The direction u of the state, at its given value.
    Direction(f64),
}

/// Treatment of the contact between the bottom cylinders.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BottomContact {
    /// The contact carries nothing, c = 0, even where the cylinders would overlap.
    Ignored,
    /// The contact closes where y < 0 and opens where y > 0.
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
    pub(super) law: ContactLaw,
    pub(super) wall: ContactLaw,
    pub(super) arms: Arms,
    pub(super) epsilon: f64,
    pub(super) bottom: BottomContact,
    /// Rotation of the tangential spring 1–2 relative to its contact, per rotation of the contact (up to sign): 0 if
    /// the spring turns with the contact, 1 if it does not turn.
    pub(super) left_behind: f64,
}

/// One of the two frictional contacts, in one state.
struct Pressed {
    /// Torque arm R.
    lever: f64,
    /// Kinematic arm R̃.
    radius: f64,
    /// dN/dδ.
    stiffness: f64,
    /// k_t.
    tangential: f64,
    /// Relative change of the force of the tangential spring per change of the overlap, while the surfaces do not
    /// move.
    memory_rate: f64,
    /// Absolute change of the tangential force per change of the overlap, while the surfaces do not move.
    memory: f64,
}

impl Pressed {
    fn new(law: &ContactLaw, arms: ContactArms, overlap: f64, shear: f64, unloads: bool) -> Self {
        let kept = match law.history.keeps_force() {
            true => 0.0,
            false => law.tangential_steepening(overlap),
        };
        let lost = match law.history.is_rescaled() && unloads {
            true => 0.5 / overlap,
            false => 0.0,
        };
        Self {
            lever: 1.0 + arms.torque * overlap,
            radius: 1.0 + arms.kinematic * overlap,
            stiffness: law.stiffness(overlap),
            tangential: law.at(overlap).tangential_stiffness,
            memory_rate: kept + lost,
            memory: shear * kept + shear * lost,
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
            left_behind: f64::from(u8::from(!convention.history_update.turns())),
        }
    }

    /// Replaces the ring: the bodies start in one other than that in which they just touch.
    pub(super) fn in_ring(self, ring: Ring) -> Self {
        Self { ring, ..self }
    }

    /// Whether springs turn with their contacts.
    pub(super) fn springs_turn(&self) -> bool {
        self.left_behind == 0.0
    }

    /// Returns the beginning of the path, at `fraction` of the angle turned under gravity. It lies on the ray along
    /// which all lengths are proportional to that angle, and all forces to its power p (docs/theory.md, Eqs. 82, 83
    /// and 104).
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
                pair_lift: self.lift_on_ray(ray.shear * force, turned),
            },
        }
    }

    /// p = −∫b dψ, where b has grown with the power p of the angle turned (the exponent of the law).
    fn lift_on_ray(&self, shear: f64, turned: f64) -> f64 {
        -self.left_behind * shear * turned / (1.0 + self.law.power.value())
    }

    /// Derivative of the state with respect to ψ, with contact 2–3 closed or open (docs/theory.md,
    /// Eqs. 37 to 39, 52, 81 and 111).
    pub(super) fn derivative(&self, state: &State, leg: Leg, closed: bool) -> State {
        let (slope, loads) = self.slope(state, leg, closed, [false; 2]);
        let unloads = loads.map(|loads| !loads);
        match self.law.history.is_rescaled() && unloads != [false; 2] {
            true => self.slope(state, leg, closed, unloads).0,
            false => slope,
        }
    }

    /// The derivative if pair and floor `unload` as given, and whether each overlap grows along it.
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
        let (b, e, p) = (state.pair_shear, state.floor_shear, state.pair_lift);
        let left_behind = self.left_behind;
        let Arms { pair, floor } = self.arms;
        let upper = Pressed::new(&self.law, pair, state.pair_overlap, b, unload[0]);
        let lower = Pressed::new(&self.wall, floor, floor_overlap, e, unload[1]);
        let a = self.law.force(state.pair_overlap);
        let lift_memory = p * upper.memory_rate;
        let bottom_stiffness = match closed {
            true => self.bottom_stiffness(state),
            false => 0.0,
        };
        let sinking = leg.floor_force_slope(ring) / lower.stiffness;

        // Rows: torque on 2, horizontal force on 2, vertical force on 1. Columns: ρ′, θ′, L′.
        let system = Matrix3::new(
            -(b * pair.torque + upper.lever * upper.memory) - lower.tangential * lower.lever * sin,
            -upper.tangential * upper.lever * upper.radius
                - lower.tangential * lower.lever * lower.radius,
            -(e * floor.torque + lower.lever * lower.memory) * sinking,
            (upper.stiffness + lower.tangential + bottom_stiffness + lift_memory) * sin
                - upper.memory * cos,
            -upper.tangential * upper.radius * cos + lower.tangential * lower.radius,
            lower.memory * sinking,
            -ring.bodies * (upper.stiffness + lift_memory) * cos - ring.bodies * upper.memory * sin,
            -ring.bodies * upper.tangential * upper.radius * sin,
            -1.0,
        );
        // Forces that turn with the contact change the balances by turning. For a spring that turns this is b, as it
        // has no component p along the normal.
        let turning_shear = b * (1.0 - left_behind);
        let known = Vector3::new(
            (upper.tangential * upper.lever - lower.tangential * lower.lever * cos) * distance
                + left_behind * p * upper.lever,
            (upper.tangential + lower.tangential + bottom_stiffness) * distance * cos
                - a * cos
                - turning_shear * sin,
            ring.bodies * (upper.tangential * distance * sin - a * sin + turning_shear * cos),
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
                - upper.memory * distance_slope
                + left_behind * p,
            floor_shear: lower.tangential
                * (distance_slope * sin + distance * cos + lower.radius * rotation_slope)
                + lower.memory * floor_overlap_slope,
            pair_lift: -left_behind * b - lift_memory * distance_slope,
        };
        (slope, [distance_slope <= 0.0, floor_overlap_slope >= 0.0])
    }

    /// |q|/a, the friction that the contact 1–2 needs; b/a for a spring that turns.
    fn pair_friction(&self, state: &State) -> f64 {
        let shear = match self.springs_turn() {
            true => state.pair_shear,
            false => libm::hypot(state.pair_shear, state.pair_lift),
        };
        shear / self.law.force(state.pair_overlap)
    }

    /// T − μ_c of a state, free of cancellation.
    fn beyond(&self, state: &State) -> f64 {
        let (critical, half) = (self.ring.critical_friction, libm::tan(0.5 * state.turned));
        half * (1.0 + critical * critical) / (1.0 - critical * half)
    }

    /// u of a state: (T − μ_c) : (−2y/x₀) = u : 1 − u.
    pub(super) fn direction(&self, state: &State) -> f64 {
        let beyond = self.beyond(state);
        beyond / (beyond + self.ring.neighbour_overlap(state.outward(&self.ring)))
    }

    /// The state at T = μ_c + `beyond`, given as `point`, of a stack whose floor has slid from the start.
    pub(super) fn sliding_state(&self, beyond: f64, point: &PathPoint) -> State {
        let critical = self.ring.critical_friction;
        let turned = 2.0 * libm::atan(beyond / (1.0 + critical * (critical + beyond)));
        let shear = point.pair_ratio * self.law.force(point.pair_overlap);
        State {
            turned,
            load: point.floor_force / Leg::GravityRamp.floor_force_slope(&self.ring),
            pair_overlap: point.pair_overlap,
            rotation: 0.0,
            pair_shear: shear,
            floor_shear: point.floor_ratio * point.floor_force,
            pair_lift: self.lift_on_ray(shear, turned),
        }
    }

    /// Derivative of the state while the floor slides outwards with e = μ d and contact 2–3 is closed (docs/theory.md,
    /// Eq. 112). The rotation is not followed, as the floor no longer holds it.
    pub(super) fn sliding_derivative(
        &self,
        state: &State,
        leg: Leg,
        floor_friction: f64,
        progress: Progress,
    ) -> State {
        let (slope, unloads) = self.sliding_slope(state, leg, floor_friction, progress, false);
        match self.law.history.is_rescaled() && unloads {
            true => {
                self.sliding_slope(state, leg, floor_friction, progress, true)
                    .0
            }
            false => slope,
        }
    }

    /// The derivative if the pair `unloads` or not, and whether its overlap falls along it.
    fn sliding_slope(
        &self,
        state: &State,
        leg: Leg,
        floor_friction: f64,
        progress: Progress,
        unloads: bool,
    ) -> (State, bool) {
        let ring = &self.ring;
        let (sin, cos) = libm::sincos(ring.angle + state.turned);
        let distance = 2.0 - state.pair_overlap;
        let (b, p) = (state.pair_shear, state.pair_lift);
        let floor_force = leg.floor_force(state.load, self.epsilon, ring);
        let floor_overlap = self.wall.overlap(floor_force);
        let Arms { pair, floor } = self.arms;
        let upper = Pressed::new(&self.law, pair, state.pair_overlap, b, unloads);
        let lower = Pressed::new(&self.wall, floor, floor_overlap, state.floor_shear, false);
        let pressing = self.law.force(state.pair_overlap) + p;
        let stiffness = upper.stiffness + p * upper.memory_rate;
        let bottom_stiffness = self.bottom_stiffness(state);
        let shear_slope = floor_friction * leg.floor_force_slope(ring);
        let left_shear = b * (1.0 - self.left_behind);

        // Columns: ψ′, ρ′, b′, L′. Rows: torque on 2, horizontal force on 2, vertical force on 1, and the advance of
        // the parameter.
        let torque = [
            0.0,
            -b * pair.torque,
            upper.lever,
            -shear_slope * (lower.lever + floor_force * floor.torque / lower.stiffness),
        ];
        let horizontal = [
            bottom_stiffness * distance * cos - pressing * cos - left_shear * sin,
            (stiffness + bottom_stiffness) * sin,
            cos,
            shear_slope,
        ];
        let vertical = [
            ring.bodies * (left_shear * cos - pressing * sin),
            -ring.bodies * stiffness * cos,
            ring.bodies * sin,
            -1.0,
        ];
        let (advance, amount) = match progress {
            Progress::Load => ([0.0, 0.0, 0.0, 1.0], state.load),
            Progress::Direction(direction) => {
                let tangent = ring.critical_friction + self.beyond(state);
                let closing = direction * ring.neighbour_overlap(1.0);
                let turn = 0.5 * (1.0 + tangent * tangent) * (1.0 - direction);
                let advance = [turn - closing * distance * cos, -closing * sin, 0.0, 0.0];
                let overlap = ring.neighbour_overlap(state.outward(ring));
                (advance, overlap + self.beyond(state))
            }
        };
        let system = Matrix4::from_row_slice(&[torque, horizontal, vertical, advance].concat());
        let solution = system
            .lu()
            .solve(&Vector4::new(0.0, 0.0, 0.0, amount))
            .unwrap_or(Vector4::repeat(f64::NAN));
        let (turn, distance_slope, shear, load) = (solution.x, solution.y, solution.z, solution.w);
        let slope = State {
            turned: turn,
            load,
            pair_overlap: -distance_slope,
            rotation: 0.0,
            pair_shear: shear,
            floor_shear: shear_slope * load,
            pair_lift: -self.left_behind * b * turn - p * upper.memory_rate * distance_slope,
        };
        (slope, distance_slope > 0.0)
    }

    /// Decrease of the push of the neighbours per distance that the body moves outwards.
    fn bottom_stiffness(&self, state: &State) -> f64 {
        let ring = &self.ring;
        let overlap = ring.neighbour_overlap(state.outward(ring));
        -ring.push * ring.neighbour_overlap(1.0) * self.law.stiffness(overlap)
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
            pair_friction: self.pair_friction(state),
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

/// The direction in which a path leaves the stress-free state: lengths divided by the angle turned, forces by its
/// power p.
struct Ray {
    pair_overlap: f64,
    shear: f64,
    bottom_force: f64,
    load: f64,
}

impl Ray {
    /// The ray on which the springs of both contacts take up the stretch that the geometry demands (docs/theory.md,
    /// Eqs. 83 and 104).
    fn of(contacts: &Contacts) -> Self {
        let ring = &contacts.ring;
        let (widening, sine) = (2.0 + ring.rise, 0.5 * ring.radius);
        let excess = |pair_overlap: f64| {
            let ray = Self::along(contacts, pair_overlap);
            ray.stretch(contacts).iter().sum::<f64>() + sine * pair_overlap - widening
        };
        // An overlap of 0 has no stiffness.
        let pair_overlap = bracketed_root(excess, 1e-100, 2.0 * widening).unwrap_or(f64::NAN);
        Self::along(contacts, pair_overlap)
    }

    /// The forces that balance at ψ₀ and a given overlap of the pair.
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

    /// Stretch of the springs of pair and floor.
    fn stretch(&self, contacts: &Contacts) -> [f64; 2] {
        let floor_force = Leg::GravityRamp.floor_force(self.load, 0.0, &contacts.ring);
        let floor_overlap = contacts.wall.overlap(floor_force);
        let contacts = [
            (&contacts.law, self.pair_overlap),
            (&contacts.wall, floor_overlap),
        ];
        contacts.map(|(law, overlap)| {
            // In an incremental law, a force that grows as the power p of a length takes a stretch of p times force
            // over stiffness.
            let growth = match law.history.keeps_force() {
                true => law.power.value(),
                false => 1.0,
            };
            growth * self.shear / law.unstiffened(overlap)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{HistoryUpdate, Law, TangentialHistory};
    use crate::theory::events::Path;
    use crate::theory::path::{FollowedPath, followed_path};

    fn convention(law: Law, history_update: HistoryUpdate) -> ContactConvention {
        ContactConvention {
            law,
            history_update,
            ..ContactConvention::PAPER
        }
    }

    fn contacts(law: Law, history_update: HistoryUpdate) -> Contacts {
        let convention = convention(law, history_update);
        Contacts::new(&Stack::paper(0.3, 1e2), &convention, BottomContact::Ignored)
    }

    #[test]
    fn the_floor_spring_is_stretched_by_way_and_rotation() {
        let stack = Stack::paper(0.3, 1e2);
        let convention = convention(Law::LINEAR, HistoryUpdate::Fixed);
        let path = followed_path(&stack, &convention, BottomContact::Ignored);
        for parameter in [0.5 * path.settled, path.settled, path.settled + 0.3] {
            let state = path.state(parameter);
            let stretch = state.outward(&path.contacts.ring) + state.rotation;
            let off = state.floor_shear * stack.stiffness_ratio - stretch;
            assert!(off.abs() < 1e-12, "{off:e}");
        }
    }

    #[test]
    fn a_spring_that_nothing_turns_is_left_behind_from_the_beginning() {
        for law in [Law::LINEAR, Law::HERTZ] {
            let contacts = contacts(law, HistoryUpdate::Fixed);
            let end = contacts.beginning(1.0).state;
            let parts = 1000;
            let width = 1.0 / f64::from(parts);
            let middles = (0..parts).map(|part| (f64::from(part) + 0.5) * width);
            let shears = middles.map(|at| contacts.beginning(at).state.pair_shear);
            let expected = -shears.sum::<f64>() * width * end.turned;
            let off = end.pair_lift / expected - 1.0;
            assert!(off.abs() < 1e-5, "{law:?} {off:e}");
        }
    }

    #[test]
    fn the_beginning_of_bodies_that_touch_is_in_balance() {
        for bodies in [2, 3, 5] {
            let stack = Stack {
                bodies,
                stiffness_ratio: 0.3,
                ..Stack::paper(0.3, 1e2)
            };
            let contacts =
                Contacts::new(&stack, &ContactConvention::TURNING, BottomContact::Followed);
            let beginning = contacts.beginning(1e-5);
            assert!(beginning.closed);
            let (state, ring) = (beginning.state, &contacts.ring);
            let (sine, cosine) = (0.5 * ring.radius, 0.5 * ring.rise);
            let neighbours = ring.push * ring.neighbour_overlap(state.outward(ring));
            let normal = state.pair_overlap;
            let lack = normal * sine - state.pair_shear * (1.0 + cosine) + neighbours;
            assert!(neighbours > 0.01 * normal);
            assert!(lack.abs() < 1e-4 * normal, "{bodies} {}", lack / normal);
        }
    }

    #[test]
    fn a_sliding_state_lies_where_it_was_asked_for() {
        let contacts = contacts(Law::LINEAR, HistoryUpdate::Fixed);
        let path = FollowedPath::new(contacts);
        let point = path.point(path.settled);
        for beyond in [1e-3, 0.02, 0.2] {
            let state = contacts.sliding_state(beyond, &point);
            assert!((contacts.beyond(&state) - beyond).abs() < 1e-15);
            assert!(
                (state.floor_shear / state.pair_shear - 1.0).abs() < 1e-9,
                "arms 0"
            );
        }
    }

    /// A spring of stiffness √G keeps its length while the overlap G grows; a rescaled one shortens as √G while G
    /// falls.
    #[test]
    fn only_springs_of_contacts_that_unload_are_rescaled() {
        let rescaled = Law {
            history: TangentialHistory::DisplacementRescaled,
            ..Law::HERTZ
        };
        let contacts = contacts(rescaled, HistoryUpdate::Rotated);
        let plain = self::contacts(Law::HERTZ, HistoryUpdate::Rotated);
        let start = FollowedPath::new(contacts);
        let start = start.state(start.settled + 0.3);
        let memory = |contacts: &Contacts, state: &State| {
            let slope = contacts.derivative(state, Leg::Wall, false);
            let (sin, cos) = libm::sincos(contacts.ring.angle + state.turned);
            let distance = 2.0 - state.pair_overlap;
            let floor_force = Leg::Wall.floor_force(state.load, contacts.epsilon, &contacts.ring);
            let floor_overlap = contacts.wall.overlap(floor_force);
            let sinking = Leg::Wall.floor_force_slope(&contacts.ring) * slope.load
                / contacts.wall.stiffness(floor_overlap);
            let pair = contacts.law.at(state.pair_overlap).tangential_stiffness;
            let floor = contacts.wall.at(floor_overlap).tangential_stiffness;
            let kept = [
                slope.pair_shear - pair * (distance - slope.rotation),
                slope.floor_shear
                    - floor * (distance * cos - slope.pair_overlap * sin + slope.rotation),
            ];
            let growth = [
                state.pair_shear * slope.pair_overlap / state.pair_overlap,
                state.floor_shear * sinking / floor_overlap,
            ];
            let loads = [slope.pair_overlap >= 0.0, sinking >= 0.0];
            let powers = [kept[0] / growth[0], kept[1] / growth[1]];
            (loads, powers)
        };
        let mut seen = [false; 4];
        for (pair, floor) in [
            (1.0, 1.0),
            (-8.0, 1.0),
            (8.0, 1.0),
            (1.0, -8.0),
            (1.0, 8.0),
            (-8.0, -8.0),
            (8.0, 8.0),
        ] {
            let state = State {
                pair_shear: pair * start.pair_shear,
                floor_shear: floor * start.floor_shear,
                ..start
            };
            let (loads, powers) = memory(&contacts, &state);
            seen[usize::from(loads[0]) + 2 * usize::from(loads[1])] = true;
            for (loads, power) in loads.into_iter().zip(powers) {
                let expected = if loads { 0.5 } else { 1.0 };
                assert!((power - expected).abs() < 1e-6, "{loads} {power}");
            }
            let (_, powers) = memory(&plain, &state);
            assert!(powers.iter().all(|power| (power - 0.5).abs() < 1e-6));
        }
        assert!(seen[0] && seen[3], "{seen:?}");
    }

    /// Torque and horizontal force on body 2 and vertical force on body 1, while the floor slides.
    fn balances(contacts: &Contacts, state: &State, friction: f64) -> [f64; 3] {
        let ring = &contacts.ring;
        let (sin, cos) = libm::sincos(ring.angle + state.turned);
        let floor_force = Leg::Wall.floor_force(state.load, contacts.epsilon, ring);
        let floor_overlap = contacts.wall.overlap(floor_force);
        let normal = contacts.law.force(state.pair_overlap) + state.pair_lift;
        let overlap = ring.neighbour_overlap(state.outward(ring));
        let (b, e) = (state.pair_shear, friction * floor_force);
        let arms = &contacts.arms;
        [
            b * (1.0 + arms.pair.torque * state.pair_overlap)
                - e * (1.0 + arms.floor.torque * floor_overlap),
            normal * sin - b * cos - e + ring.push * contacts.law.force(overlap),
            ring.bodies * (normal * cos + b * sin) - state.load,
        ]
    }

    #[test]
    fn a_sliding_stack_stays_in_balance_and_its_spring_is_left_behind() {
        const FRICTION: f64 = 0.3;
        let rescaled = Law {
            history: TangentialHistory::DisplacementRescaled,
            ..Law::HERTZ
        };
        let mut unloading = 0;
        for law in [Law::LINEAR, Law::HERTZ, rescaled] {
            let convention = ContactConvention {
                arms: Arms::reciprocal(-0.5, 0.7),
                ..convention(law, HistoryUpdate::Fixed)
            };
            let stack = Stack {
                stiffness_ratio: 0.5,
                ..Stack::paper(FRICTION, 1e2)
            };
            let contacts = Contacts::new(&stack, &convention, BottomContact::Followed);
            let path = FollowedPath::new(contacts);
            let start = path.state(path.settled + 0.1);
            let lifts = [1.0, -30.0, 30.0, -300.0, 300.0, -3000.0, 3000.0];
            let progresses = [Progress::Load, Progress::Direction(0.4)];
            let all = lifts
                .into_iter()
                .flat_map(|lift| progresses.map(|own| (lift, own)));
            for (lift, progress) in all {
                let state = State {
                    pair_lift: lift * start.pair_lift,
                    ..start
                };
                let slope = contacts.sliding_derivative(&state, Leg::Wall, FRICTION, progress);
                let scale = 1e-6 / slope.load.abs().max(slope.turned.abs());
                let moved = |step: f64| {
                    let numbers = state.to_array::<FIXED>().into_iter();
                    let numbers = numbers.zip(slope.to_array::<FIXED>());
                    let mut moved = numbers.map(|(number, rate)| number + step * rate);
                    State::from_array::<FIXED>(std::array::from_fn(|_| moved.next().unwrap()))
                };
                let [after, before] =
                    [scale, -scale].map(|step| balances(&contacts, &moved(step), FRICTION));
                for (after, before) in after.into_iter().zip(before) {
                    assert!(
                        (after - before).abs() < 1e-12,
                        "{law:?} {lift} {after} {before}"
                    );
                }
                let slope_of_floor = Leg::Wall.floor_force_slope(&contacts.ring);
                assert_eq!(slope.floor_shear, FRICTION * slope_of_floor * slope.load);
                let kept = slope.pair_lift + state.pair_shear * slope.turned;
                let growth = state.pair_lift * slope.pair_overlap / state.pair_overlap;
                let unloads = slope.pair_overlap < 0.0 && law == rescaled;
                unloading += usize::from(unloads);
                let expected = match (law == Law::LINEAR, unloads) {
                    (true, _) => 0.0,
                    (_, true) => 1.0,
                    (_, false) => 0.5,
                };
                assert!(
                    (kept - expected * growth).abs() < 1e-9 * growth.abs(),
                    "{law:?} {lift}"
                );
            }
        }
        assert!(unloading > 0);
    }
}
