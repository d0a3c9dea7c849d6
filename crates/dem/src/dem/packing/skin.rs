//! The motion after which a neighbour list is no longer complete.

use crate::dem::body::Body;
use crate::dem::geometry::{Geometry, Plane};
use crate::dem::wall::PlaneWall;

/// A list of everything within a skin is complete until a body has moved by half the skin since the list was built.
///
/// The largest speeds are summed step by step, which needs no memory access of its own. Only when their sum reaches
/// the limit are the actual distances computed, so vibrations do not require a new list.
#[derive(Debug, Clone)]
pub(super) struct Skin<G: Geometry<f64> = Plane> {
    /// Half of the skin, minus a margin for rounding.
    limit: f64,
    /// Upper bound of the distance that any body has moved.
    travelled: f64,
    /// Upper bound of the distance that any wall has moved.
    wall_travel: f64,
    /// Positions of the bodies when the list was made.
    anchors: Vec<Body<f64, G>>,
}

impl<G: Geometry<f64>> Skin<G> {
    /// A skin of `width` around the present positions.
    pub fn new(width: f64, cylinders: &[Body<f64, G>]) -> Self {
        Self {
            limit: 0.499 * width,
            travelled: 0.0,
            wall_travel: 0.0,
            anchors: cylinders.to_vec(),
        }
    }

    /// Counts a step at whose end the squared speed of the bodies is at most `fastest_square`. Returns whether lists
    /// must be rebuilt, and if so starts over at the present positions.
    pub fn is_used_up(
        &mut self,
        fastest_square: f64,
        walls: &[PlaneWall],
        time_step: f64,
        cylinders: &[Body<f64, G>],
    ) -> bool {
        let wall_speed = walls.iter().map(|wall| wall.speed.abs());
        self.wall_travel += wall_speed.fold(0.0, f64::max) * time_step;
        self.travelled += fastest_square.sqrt() * time_step;
        if self.travelled.max(self.wall_travel) < self.limit {
            return false;
        }
        let moved = self.anchors.iter().zip(cylinders);
        let farthest = moved
            .map(|(anchor, cylinder)| Body::apart([anchor, cylinder]).1)
            .fold(0.0, f64::max);
        self.travelled = farthest.sqrt();
        if self.travelled.max(self.wall_travel) < 0.5 * self.limit {
            return false;
        }
        *self = Self {
            limit: self.limit,
            ..Self::new(0.0, cylinders)
        };
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::{Cylinder, Facing};

    #[test]
    fn what_trembles_needs_no_new_list_and_what_travels_does() {
        let mut cylinders = vec![Cylinder::at(0.0, 0.0), Cylinder::at(5.0, 0.0)];
        let mut skin = Skin::new(0.5, &cylinders);
        let (speed, time_step) = (0.1, 0.1);
        for step in 0..1000 {
            cylinders[1].position[0] = 5.0 + f64::from(step % 2) * speed * time_step;
            assert!(!skin.is_used_up(speed * speed, &[], time_step, &cylinders));
        }
        // Half the skin corresponds to 25 steps.
        let start = cylinders[1].position[0];
        let steps = (1..).find(|step| {
            cylinders[1].position[0] = start + f64::from(*step) * speed * time_step;
            skin.is_used_up(speed * speed, &[], time_step, &cylinders)
        });
        assert!((12..=25).contains(&steps.expect("at some time")));
    }

    #[test]
    fn a_wall_that_moves_uses_up_the_skin_as_well() {
        let cylinders = [Cylinder::at(0.0, 0.0)];
        let wall = PlaneWall {
            facing: Facing::Down,
            offset: -9.0,
            speed: -0.1,
            friction: 0.0,
        };
        let mut skin = Skin::new(0.5, &cylinders);
        let steps = (1..).find(|_: &u32| skin.is_used_up(0.0, &[wall], 0.1, &cylinders));
        assert_eq!(steps, Some(25));
    }
}
