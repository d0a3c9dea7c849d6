//! The paper, arXiv:2511.06807: what it says, claim by claim, what it did, done again, and what its authors published.

pub mod claims;
pub mod published;
pub mod reproduction;

use tristack_dem::{dem, model, series};
use tristack_harness::{code, files, runs, study};
use tristack_theory::theory;
