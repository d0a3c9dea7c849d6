//! Cylinders and spheres, the load on them, and where they touch.

use super::geometry::{Geometry, Plane, Space};
use super::real::{Composite, Real};

/// A cylinder or sphere of unit mass and radius. Velocities belong to the half step before the positions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body<R: Real = f64, G: Geometry<R> = Plane> {
    /// Centre.
    pub position: G::Vector,
    /// Rotation, counter-clockwise; in space the time integral of the angular velocity.
    pub angle: G::Rotation,
    /// Velocity of the centre.
    pub velocity: G::Vector,
    /// Angular velocity, counter-clockwise.
    pub spin: G::Rotation,
}

/// A body in the plane.
pub type Cylinder<R = f64> = Body<R, Plane>;

/// A body in space.
pub type Sphere<R = f64> = Body<R, Space>;

impl<R: Real, G: Geometry<R>> Composite<R> for Body<R, G> {
    #[inline(always)]
    fn visit(&mut self, other: &Self, visit: &mut impl FnMut(&mut R, &R)) {
        self.position.visit(&other.position, visit);
        self.angle.visit(&other.angle, visit);
        self.velocity.visit(&other.velocity, visit);
        self.spin.visit(&other.spin, visit);
    }
}

impl<R: Real> Cylinder<R> {
    /// A cylinder at rest.
    pub fn at(x: R, y: R) -> Self {
        Self::resting([x, y])
    }
}

impl<R: Real, G: Geometry<R>> Body<R, G> {
    /// A body at rest.
    pub fn resting(position: G::Vector) -> Self {
        let zero = [G::components(position)[0].like(0.0); 3];
        Self {
            position,
            angle: G::rotation(zero),
            velocity: G::vector(zero),
            spin: G::rotation(zero),
        }
    }
}

/// Force and torque on a cylinder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Load<R: Real = f64, G: Geometry<R> = Plane> {
    /// Force.
    pub force: G::Vector,
    /// Torque about the centre, counter-clockwise.
    pub torque: G::Rotation,
}

impl<R: Real, G: Geometry<R>> Composite<R> for Load<R, G> {
    #[inline(always)]
    fn visit(&mut self, other: &Self, visit: &mut impl FnMut(&mut R, &R)) {
        self.force.visit(&other.force, visit);
        self.torque.visit(&other.torque, visit);
    }
}

/// The lanes in which two bodies touch.
#[derive(Clone, Copy)]
pub(super) enum Touch<R: Real> {
    Everywhere,
    Where(R::Mask),
}

impl<R: Real> Touch<R> {
    #[inline(always)]
    pub(super) fn choose<C: Composite<R>>(self, yes: C, no: C) -> C {
        match self {
            Self::Everywhere => yes,
            Self::Where(mask) => yes.or_where_not(mask, &no),
        }
    }
}
