//! A validation harness for DEM codes: the yield force of a three-cylinder stack (arXiv:2511.06807).

pub mod cli;
pub mod code;
pub mod dem;
pub mod experiment;
pub mod files;
pub mod model;
pub mod output;
pub mod paper;
pub mod runs;
pub mod series;
pub mod study;
pub mod theory;
