//! Plane walls.

use super::contact::ContactForce;
use super::real::{Real, composite};

/// Direction of the normal n of a wall, towards the cylinders.
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
}

impl Facing {
    /// n, in numbers like `number`.
    #[inline(always)]
    pub fn normal<R: Real>(self, number: R) -> [R; 2] {
        let normal = match self {
            Self::Up => [0.0, 1.0],
            Self::Down => [0.0, -1.0],
            Self::Left => [-1.0, 0.0],
            Self::Right => [1.0, 0.0],
        };
        [number.like(normal[0]), number.like(normal[1])]
    }

    /// Component of a vector along n.
    #[inline(always)]
    pub(super) fn along<R: Real>(self, [x, y]: [R; 2]) -> R {
        match self {
            Self::Up => y,
            Self::Down => -y,
            Self::Left => -x,
            Self::Right => x,
        }
    }

    /// Component of a vector along t = (−n_y, n_x).
    #[inline(always)]
    pub(super) fn tangential<R: Real>(self, [x, y]: [R; 2]) -> R {
        match self {
            Self::Up => -x,
            Self::Down => x,
            Self::Left => -y,
            Self::Right => y,
        }
    }

    /// A contact force as a vector.
    #[inline(always)]
    pub(super) fn in_the_plane<R: Real>(self, force: &ContactForce<R>) -> [R; 2] {
        let (normal, tangential) = (force.normal, force.tangential);
        match self {
            Self::Up => [-tangential, normal],
            Self::Down => [tangential, -normal],
            Self::Left => [-normal, -tangential],
            Self::Right => [normal, tangential],
        }
    }
}

/// A plane wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneWall<R = f64> {
    /// Direction of its unit normal n.
    pub facing: Facing,
    /// Offset: the plane is n · x = offset.
    pub offset: R,
    /// Velocity of the plane along its normal.
    pub speed: R,
    /// Friction coefficient against cylinders.
    pub friction: R,
}

impl<R: Real> PlaneWall<R> {
    /// Overlap with a cylinder at `position`; negative where it does not touch.
    #[inline(always)]
    pub(super) fn overlap(&self, position: [R; 2]) -> R {
        let distance = self.facing.along(position) - self.offset;
        distance.like(1.0) - distance
    }
}

composite!(PlaneWall {
    offset,
    speed,
    friction
});

#[cfg(test)]
mod tests {
    use super::super::contact::{along, tangential};
    use super::*;

    #[test]
    fn shortcuts_for_each_side_are_products_with_its_normal() {
        let force = ContactForce {
            normal: 2.0,
            tangential: 5.0,
            arm: 1.0,
        };
        let normals = [
            (Facing::Up, [0.0, 1.0]),
            (Facing::Down, [0.0, -1.0]),
            (Facing::Left, [-1.0, 0.0]),
            (Facing::Right, [1.0, 0.0]),
        ];
        for (facing, normal) in normals {
            assert_eq!(facing.normal(1.0), normal);
            let vector = [3.0, 7.0];
            assert_eq!(facing.along(vector), along(normal, vector));
            assert_eq!(facing.tangential(vector), tangential(normal, vector));
            assert_eq!(facing.in_the_plane(&force), force.in_the_plane(normal));
        }
    }
}
