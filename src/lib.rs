//! A validation harness for DEM codes: the yield force of a three-cylinder stack (arXiv:2511.06807).

pub mod cli;

pub use tristack_dem::{dem, model, series};
pub use tristack_harness::{code, files, runs, study};
pub use tristack_output as output;
pub use tristack_paper as paper;
pub use tristack_theory::{experiment, theory};
