//! Native DEM of stacked cylinders and spheres.
//!
//! [`model`] has the cases, [`dem`] the stepping, and [`series`] the time series with the yield force that is read off
//! it. [`dem::SOURCE_DIGEST`] says which sources made a number.

pub mod dem;
pub mod model;
pub mod series;

pub use tristack_theory::theory;
