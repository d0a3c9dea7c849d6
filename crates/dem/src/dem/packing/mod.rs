//! Many equal cylinders in the plane, or spheres in space, between plane walls, at a cost proportional to their number.
//!
//! Contact law, leapfrog and order of every sum are those of [`Scene`](super::Scene), which visits every pair of
//! bodies: for the same bodies both give the same bits. A packing adds a Verlet list of the pairs that may touch,
//! rebuilt from a cell list whenever a body has moved by half the skin. Rebuilding costs as much as some ten steps.

mod bodies;
mod cells;
mod forces;
mod pairs;
mod pyramid;
mod skin;
mod walls;

pub use bodies::{Material, Packing};
pub use pyramid::{PYRAMID_FLOOR, run_pyramid};
