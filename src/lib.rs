//! A validation harness for DEM codes: the yield force of a three-cylinder stack (arXiv:2511.06807).

pub mod archive;
pub mod bench;
pub mod claims;
pub mod cli;
pub mod crosscheck;
pub mod dem;
pub mod engine;
pub mod experiment;
pub mod probe;
pub mod report;
pub mod reproduction;
pub mod stack;
pub mod store;
pub mod theory;
pub mod trace;
pub mod verdict;
