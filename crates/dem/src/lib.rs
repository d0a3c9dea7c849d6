//! Native DEM of stacked cylinders and spheres.
//!
//! [`model`] holds the cases, [`dem`] the time stepping, and [`series`] the time series with the yield force derived
//! from them. [`dem::SOURCE_DIGEST`] identifies the sources that produced a number.

pub mod dem;
pub mod model;
pub mod series;

pub use tristack_theory::theory;
