//! Runs DEM codes that are described by a folder, and judges their yield forces by exact limits.
//!
//! [`code`] turns a task into a series by any code, [`runs`] keeps what is finished, and [`study`] asks: each study names
//! its runs, computes a finding, and derives a verdict. [`files`] opens every file.

pub mod code;
pub mod files;
pub mod runs;
pub mod study;

pub use tristack_dem::model;
use tristack_dem::{dem, series};
use tristack_theory::theory;
