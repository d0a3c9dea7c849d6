//! Many equal cylinders in the plane, or spheres in space, between plane walls, at a cost proportional to their number.
//!
//! Contact law, leapfrog and order of every sum are those of [`Scene`](super::Scene), which visits every pair of
//! bodies: for the same bodies the two give the same bits. A packing adds a Verlet list of the pairs that may
//! touch, made from a cell list whenever something has moved by half of its skin. A new list costs as much as some
//! ten steps.

mod bodies;
mod cells;
mod forces;
mod pairs;
mod pyramid;
mod skin;
mod walls;

pub use bodies::{Material, Packing};
pub use pyramid::{PYRAMID_FLOOR, run_pyramid};
