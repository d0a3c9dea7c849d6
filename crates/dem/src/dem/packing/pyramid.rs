//! A pyramid as a packing.

use super::bodies::{Material, Packing};
use crate::dem::body::Cylinder;
use crate::dem::geometry::Facing;
use crate::dem::wall::PlaneWall;
use crate::model::Pyramid;
use crate::series::{PyramidRun, SeriesError};
use std::time::Instant;

/// Index of the floor among the walls of a pyramid.
pub const PYRAMID_FLOOR: usize = 0;

/// Steps between two calls of `wanted`, which take some tenths of a second for the largest pyramid.
const STEPS_BETWEEN_QUESTIONS: u64 = 1 << 4;

impl Packing {
    /// `pyramid` before gravity acts, with floor, left wall and right wall.
    pub fn pyramid(pyramid: &Pyramid) -> Self {
        let cylinders = pyramid.centres().into_iter();
        let wall = |facing, offset, friction| PlaneWall {
            facing,
            offset,
            speed: 0.0,
            friction,
        };
        let aside = -pyramid.half_width();
        let walls = vec![
            wall(Facing::Up, 0.0, pyramid.groups.floor_friction),
            wall(Facing::Right, aside, 0.0),
            wall(Facing::Left, aside, 0.0),
        ];
        Self::new(
            cylinders.map(|[x, y]| Cylinder::at(x, y)).collect(),
            walls,
            Material::new(&pyramid.groups, &pyramid.convention),
            pyramid.time_step,
        )
    }
}

/// Runs `pyramid` to its end, or gives up once `wanted` is false.
///
/// # Errors
/// If the motion leaves the finite numbers, or the run is given up.
pub fn run_pyramid(
    pyramid: &Pyramid,
    wanted: impl Fn() -> bool,
) -> Result<PyramidRun, SeriesError> {
    let mut packing = Packing::pyramid(pyramid);
    let before = pyramid.ramp_steps + pyramid.rest_steps;
    let mut start = Instant::now();
    for step in 0..pyramid.total_steps() {
        if step.is_multiple_of(STEPS_BETWEEN_QUESTIONS) && !wanted() {
            return PyramidRun::new(Vec::new(), 0.0, pyramid.cylinder_count());
        }
        if step == before {
            start = Instant::now();
        }
        packing.gravity = pyramid.gravity_at(step);
        packing.evaluate_forces();
        packing.advance();
    }
    let seconds = start.elapsed().as_secs_f64();
    let centres = packing.cylinders().iter();
    let centres = centres.map(|cylinder| cylinder.position).collect();
    PyramidRun::new(centres, seconds, pyramid.cylinder_count())
}
