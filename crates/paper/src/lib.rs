//! The paper, arXiv:2511.06807: its claims, a reproduction of its runs, and the data that its authors published.

pub mod claims;
pub mod published;
pub mod reproduction;

use tristack_dem::{dem, model, series};
use tristack_harness::{code, files, runs, study};
use tristack_theory::theory;
