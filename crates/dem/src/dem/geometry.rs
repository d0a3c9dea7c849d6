//! The plane, for cylinders, and space, for spheres.

use super::real::{Composite, Real};
use crate::model::HistoryUpdate;
use std::fmt::Debug;

/// A number, or several that are added and scaled component by component.
pub trait Linear<R: Real>: Copy + Debug + Composite<R> {
    /// Applies `of` to the corresponding components of both.
    fn with(self, other: Self, of: impl Fn(R, R) -> R) -> Self;

    /// Returns the sum.
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self.with(other, |one, other| one + other)
    }

    /// Returns the difference.
    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        self.with(other, |one, other| one - other)
    }

    /// Returns the product with a number.
    #[inline(always)]
    fn times(self, factor: R) -> Self {
        self.with(self, |part, _| part * factor)
    }

    /// Returns the quotient by a number.
    #[inline(always)]
    fn over(self, divisor: R) -> Self {
        self.with(self, |part, _| part / divisor)
    }

    /// Returns the negated value.
    #[inline(always)]
    fn negated(self) -> Self {
        self.with(self, |part, _| -part)
    }
}

impl<R: Real> Linear<R> for R {
    #[inline(always)]
    fn with(self, other: Self, of: impl Fn(R, R) -> R) -> Self {
        of(self, other)
    }
}

impl<R: Real, const N: usize> Linear<R> for [R; N] {
    #[inline(always)]
    fn with(mut self, other: Self, of: impl Fn(R, R) -> R) -> Self {
        for axis in 0..N {
            self[axis] = of(self[axis], other[axis]);
        }
        self
    }
}

/// A vector in the tangent plane of a contact.
pub trait Tangential<R: Real>: Linear<R> {
    /// Whether the vector is shorter than `limit`.
    fn is_below(self, limit: R) -> R::Mask;
    /// Returns a vector of length `limit` in the same direction.
    fn of_length(self, limit: R) -> Self;
}

impl<R: Real> Tangential<R> for R {
    #[inline(always)]
    fn is_below(self, limit: R) -> R::Mask {
        self.abs().less(limit)
    }

    #[inline(always)]
    fn of_length(self, limit: R) -> Self {
        R::select(self.less(self.like(0.0)), -limit, limit)
    }
}

impl<R: Real, const N: usize> Tangential<R> for [R; N] {
    #[inline(always)]
    fn is_below(self, limit: R) -> R::Mask {
        square(self).less(limit * limit)
    }

    #[inline(always)]
    fn of_length(self, limit: R) -> Self {
        let length = square(self).sqrt();
        let (zero, one) = (limit.like(0.0), limit.like(1.0));
        // A zero vector has no direction.
        let is_there = zero.less(length);
        let factor = limit / R::select(is_there, length, one);
        self.times(R::select(is_there, factor, zero))
    }
}

/// Direction of the normal n of a wall, towards the cylinders or spheres.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Facing {
    /// n = (0, 1), a floor.
    Up,
    /// n = (0, −1).
    Down,
    /// n = (−1, 0).
    Left,
    /// n = (1, 0).
    Right,
    /// n = (0, 0, 1), in space; in the plane, where n vanishes, such a wall exerts nothing.
    Front,
    /// n = (0, 0, −1), in space.
    Back,
}

impl Facing {
    /// n, in numbers like `number`.
    #[inline(always)]
    pub fn normal<R: Real, G: Geometry<R>>(self, number: R) -> G::Vector {
        let normal = match self {
            Self::Up => [0.0, 1.0, 0.0],
            Self::Down => [0.0, -1.0, 0.0],
            Self::Left => [-1.0, 0.0, 0.0],
            Self::Right => [1.0, 0.0, 0.0],
            Self::Front => [0.0, 0.0, 1.0],
            Self::Back => [0.0, 0.0, -1.0],
        };
        G::vector(normal.map(|component| number.like(component)))
    }
}

/// The geometry in which bodies move: the types of their vectors, and operations on contacts.
pub trait Geometry<R: Real>: Copy + Debug {
    /// A position, velocity or force.
    type Vector: Tangential<R>;
    /// A rotation, angular velocity or torque.
    type Rotation: Linear<R>;
    /// A vector in the tangent plane of a contact; in the plane, its component along t = (−n_y, n_x).
    type Tangent: Tangential<R>;

    /// Number of axes.
    const AXES: usize;
    /// Whether there are so few bodies that a loop over them is best unrolled.
    const IS_SMALL: bool;

    /// The vector with these components, except those along axes that do not exist.
    fn vector(components: [R; 3]) -> Self::Vector;
    /// The components of a vector.
    fn components(vector: Self::Vector) -> [R; 3];
    /// The rotation with these components, except those about axes that do not exist.
    fn rotation(components: [R; 3]) -> Self::Rotation;
    /// The components of a rotation.
    fn rotation_components(rotation: Self::Rotation) -> [R; 3];
    /// The zero vector of the tangent plane, in numbers like `number`.
    fn no_tangent(number: R) -> Self::Tangent;

    /// The vector divided by its length.
    fn direction(vector: Self::Vector, length: R) -> Self::Vector;
    /// Change of the angular velocity in a time step.
    fn kick(torque: Self::Rotation, moment_of_inertia: R, time_step: R) -> Self::Rotation;
    /// Scalar product.
    fn along(normal: Self::Vector, vector: Self::Vector) -> R;
    /// The component of a vector in the tangent plane.
    fn tangential(normal: Self::Vector, vector: Self::Vector) -> Self::Tangent;
    /// ω × n.
    fn rolling(normal: Self::Vector, spin: Self::Rotation) -> Self::Tangent;
    /// The vector with this component along the normal and this one in the tangent plane.
    fn put_together(normal: Self::Vector, along: R, tangential: Self::Tangent) -> Self::Vector;
    /// n × f for a force f in the tangent plane.
    fn torque(normal: Self::Vector, force: Self::Tangent) -> Self::Rotation;

    /// Returns the spring of a contact after its normal has turned while the bodies turned by `turned`, twice the mean
    /// of both angles. In the plane, springs are numbers along the tangent, so this does not cover a spring that does
    /// not turn.
    fn transport(
        update: HistoryUpdate,
        spring: Self::Tangent,
        normals: [Self::Vector; 2],
        turned: Self::Rotation,
    ) -> Self::Tangent;

    /// Component of a vector along the normal of a wall.
    fn along_wall(facing: Facing, vector: Self::Vector) -> R;
    /// The part of a vector in the tangent plane of a wall.
    fn tangential_to_wall(facing: Facing, vector: Self::Vector) -> Self::Tangent;
    /// The force of a wall as a vector, from its two components.
    fn put_together_at_wall(facing: Facing, along: R, tangential: Self::Tangent) -> Self::Vector;
}

/// The plane with x to the right and y upwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane;

/// Space with y upwards; x, y and z are right-handed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Space;

impl<R: Real> Geometry<R> for Plane {
    type Vector = [R; 2];
    type Rotation = R;
    type Tangent = R;

    const AXES: usize = 2;
    const IS_SMALL: bool = true;

    #[inline(always)]
    fn vector([x, y, _]: [R; 3]) -> [R; 2] {
        [x, y]
    }

    #[inline(always)]
    fn components([x, y]: [R; 2]) -> [R; 3] {
        [x, y, x.like(0.0)]
    }

    #[inline(always)]
    fn rotation([_, _, z]: [R; 3]) -> R {
        z
    }

    #[inline(always)]
    fn rotation_components(angle: R) -> [R; 3] {
        [angle.like(0.0), angle.like(0.0), angle]
    }

    #[inline(always)]
    fn no_tangent(number: R) -> R {
        number.like(0.0)
    }

    #[inline(always)]
    fn direction(vector: [R; 2], length: R) -> [R; 2] {
        vector.over(length)
    }

    #[inline(always)]
    fn kick(torque: R, moment_of_inertia: R, time_step: R) -> R {
        torque / moment_of_inertia * time_step
    }

    #[inline(always)]
    fn along(normal: [R; 2], vector: [R; 2]) -> R {
        normal[0] * vector[0] + normal[1] * vector[1]
    }

    #[inline(always)]
    fn tangential(normal: [R; 2], vector: [R; 2]) -> R {
        normal[0] * vector[1] - normal[1] * vector[0]
    }

    #[inline(always)]
    fn rolling(_: [R; 2], spin: R) -> R {
        spin
    }

    #[inline(always)]
    fn put_together(normal: [R; 2], along: R, tangential: R) -> [R; 2] {
        [
            along * normal[0] - tangential * normal[1],
            along * normal[1] + tangential * normal[0],
        ]
    }

    #[inline(always)]
    fn torque(_: [R; 2], force: R) -> R {
        force
    }

    #[inline(always)]
    fn transport(update: HistoryUpdate, spring: R, [from, to]: [[R; 2]; 2], _: R) -> R {
        let cosine = Self::along(from, to);
        match update {
            HistoryUpdate::Rotated | HistoryUpdate::Fixed => spring,
            HistoryUpdate::Projected => spring * cosine,
            HistoryUpdate::Linearised => {
                let sine = Self::tangential(from, to);
                spring * (cosine + sine * sine)
            }
        }
    }

    #[inline(always)]
    fn along_wall(facing: Facing, [x, y]: [R; 2]) -> R {
        match facing {
            Facing::Up => y,
            Facing::Down => -y,
            Facing::Left => -x,
            Facing::Right => x,
            Facing::Front | Facing::Back => x.like(0.0),
        }
    }

    #[inline(always)]
    fn tangential_to_wall(facing: Facing, [x, y]: [R; 2]) -> R {
        match facing {
            Facing::Up => -x,
            Facing::Down => x,
            Facing::Left => -y,
            Facing::Right => y,
            Facing::Front | Facing::Back => x.like(0.0),
        }
    }

    #[inline(always)]
    fn put_together_at_wall(facing: Facing, normal: R, tangential: R) -> [R; 2] {
        match facing {
            Facing::Up => [-tangential, normal],
            Facing::Down => [tangential, -normal],
            Facing::Left => [-normal, -tangential],
            Facing::Right => [normal, tangential],
            Facing::Front | Facing::Back => [normal.like(0.0); 2],
        }
    }
}

impl<R: Real> Geometry<R> for Space {
    type Vector = [R; 3];
    type Rotation = [R; 3];
    type Tangent = [R; 3];

    const AXES: usize = 3;
    const IS_SMALL: bool = false;

    #[inline(always)]
    fn vector(components: [R; 3]) -> [R; 3] {
        components
    }

    #[inline(always)]
    fn components(vector: [R; 3]) -> [R; 3] {
        vector
    }

    #[inline(always)]
    fn rotation(components: [R; 3]) -> [R; 3] {
        components
    }

    #[inline(always)]
    fn rotation_components(rotation: [R; 3]) -> [R; 3] {
        rotation
    }

    #[inline(always)]
    fn no_tangent(number: R) -> [R; 3] {
        [number.like(0.0); 3]
    }

    #[inline(always)]
    fn direction(vector: [R; 3], length: R) -> [R; 3] {
        // One division instead of three.
        vector.times(length.like(1.0) / length)
    }

    #[inline(always)]
    fn kick(torque: [R; 3], moment_of_inertia: R, time_step: R) -> [R; 3] {
        // The quotient is the same for all bodies, so that one division serves them all.
        torque.times(time_step / moment_of_inertia)
    }

    #[inline(always)]
    fn along(normal: [R; 3], vector: [R; 3]) -> R {
        dot(normal, vector)
    }

    #[inline(always)]
    fn tangential(normal: [R; 3], vector: [R; 3]) -> [R; 3] {
        let along = dot(normal, vector);
        vector.with(normal, |part, normal| part - along * normal)
    }

    #[inline(always)]
    fn rolling(normal: [R; 3], spin: [R; 3]) -> [R; 3] {
        cross(spin, normal)
    }

    #[inline(always)]
    fn put_together(normal: [R; 3], along: R, tangential: [R; 3]) -> [R; 3] {
        normal.with(tangential, |normal, part| along * normal + part)
    }

    #[inline(always)]
    fn torque(normal: [R; 3], force: [R; 3]) -> [R; 3] {
        cross(normal, force)
    }

    #[inline(always)]
    fn transport(
        update: HistoryUpdate,
        spring: [R; 3],
        [from, to]: [[R; 3]; 2],
        turned: [R; 3],
    ) -> [R; 3] {
        match update {
            HistoryUpdate::Fixed => spring,
            HistoryUpdate::Projected => Self::tangential(to, spring),
            HistoryUpdate::Rotated => {
                let projected = Self::tangential(to, spring);
                let [before, after] = [spring, projected].map(|spring| dot(spring, spring));
                let (zero, one) = (after.like(0.0), after.like(1.0));
                let is_there = zero.less(after);
                let ratio = before / R::select(is_there, after, one);
                projected.times(R::select(is_there, ratio, one).sqrt())
            }
            HistoryUpdate::Linearised => {
                let turned_over = spring.minus(cross(spring, cross(from, to)));
                let half = turned[0].like(0.5);
                let twist = from.times(half * dot(from, turned));
                turned_over.minus(cross(turned_over, twist))
            }
        }
    }

    #[inline(always)]
    fn along_wall(facing: Facing, [x, y, z]: [R; 3]) -> R {
        match facing {
            Facing::Front => z,
            Facing::Back => -z,
            _ => Plane::along_wall(facing, [x, y]),
        }
    }

    #[inline(always)]
    fn tangential_to_wall(facing: Facing, [x, y, z]: [R; 3]) -> [R; 3] {
        let zero = x.like(0.0);
        match facing {
            Facing::Up | Facing::Down => [x, zero, z],
            Facing::Left | Facing::Right => [zero, y, z],
            Facing::Front | Facing::Back => [x, y, zero],
        }
    }

    #[inline(always)]
    fn put_together_at_wall(facing: Facing, normal: R, tangential: [R; 3]) -> [R; 3] {
        let [x, y, z] = tangential;
        match facing {
            Facing::Up => [x, y + normal, z],
            Facing::Down => [x, y - normal, z],
            Facing::Left => [x - normal, y, z],
            Facing::Right => [x + normal, y, z],
            Facing::Front => [x, y, z + normal],
            Facing::Back => [x, y, z - normal],
        }
    }
}

#[inline(always)]
fn square<R: Real, const N: usize>(vector: [R; N]) -> R {
    let mut sum = vector[0] * vector[0];
    for part in &vector[1..] {
        sum += *part * *part;
    }
    sum
}

#[inline(always)]
fn dot<R: Real>(one: [R; 3], other: [R; 3]) -> R {
    one[0] * other[0] + one[1] * other[1] + one[2] * other[2]
}

#[inline(always)]
fn cross<R: Real>(one: [R; 3], other: [R; 3]) -> [R; 3] {
    [
        one[1] * other[2] - one[2] * other[1],
        one[2] * other[0] - one[0] * other[2],
        one[0] * other[1] - one[1] * other[0],
    ]
}
