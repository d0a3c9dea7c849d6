//! Plane walls.

use super::geometry::{Facing, Geometry};
use super::real::{Real, composite};

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
    pub(super) fn overlap<G: Geometry<R>>(&self, position: G::Vector) -> R {
        let distance = G::along_wall(self.facing, position) - self.offset;
        distance.like(1.0) - distance
    }
}

composite!(PlaneWall { offset, speed, friction } beside { facing });

#[cfg(test)]
mod tests {
    use super::super::geometry::{Plane, Space};
    use super::*;

    const SIDES: [Facing; 6] = [
        Facing::Up,
        Facing::Down,
        Facing::Left,
        Facing::Right,
        Facing::Front,
        Facing::Back,
    ];

    #[test]
    fn shortcuts_for_each_side_are_products_with_its_normal() {
        for facing in SIDES {
            let normal = facing.normal::<f64, Plane>(1.0);
            let vector = [3.0, 7.0];
            assert_eq!(
                Plane::along_wall(facing, vector),
                Plane::along(normal, vector)
            );
            let tangential = Plane::tangential(normal, vector);
            assert_eq!(Plane::tangential_to_wall(facing, vector), tangential);
            assert_eq!(
                Plane::put_together_at_wall(facing, 2.0, 5.0),
                Plane::put_together(normal, 2.0, 5.0)
            );
        }
    }

    #[test]
    fn a_cylinder_overlaps_a_wall_by_what_is_missing_to_its_radius() {
        let overlap = |facing, offset, height| {
            let wall = PlaneWall {
                facing,
                offset,
                speed: 0.0,
                friction: 0.0,
            };
            wall.overlap::<Plane>([3.0, height])
        };
        assert_eq!(overlap(Facing::Up, 0.5, 1.25), 0.25);
        assert_eq!(overlap(Facing::Up, 0.5, 1.75), -0.25);
        assert_eq!(overlap(Facing::Down, -4.0, 3.25), 0.25);
    }

    #[test]
    fn the_same_holds_in_space() {
        for facing in SIDES {
            let normal = facing.normal::<f64, Space>(1.0);
            let vector = [3.0, 7.0, 11.0];
            assert_eq!(
                Space::along_wall(facing, vector),
                Space::along(normal, vector)
            );
            let tangential = Space::tangential(normal, vector);
            assert_eq!(Space::tangential_to_wall(facing, vector), tangential);
            assert_eq!(
                Space::put_together_at_wall(facing, 2.0, tangential),
                Space::put_together(normal, 2.0, tangential)
            );
        }
    }
}
