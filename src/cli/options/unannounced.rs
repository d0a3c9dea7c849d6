//! Stacks that no code can know before.

use super::numbers::whole;
use crate::study::yield_force::new_seed;
use clap::Args;

/// How many stacks are drawn, and how.
#[derive(Debug, Clone, Copy, Args)]
pub(in crate::cli) struct UnannouncedOptions {
    /// Judge this many stacks that are drawn at random between those of the profile once the programs of all codes are
    /// identified, in place of the profile's: a code that is right at known stacks alone shows
    #[arg(long, value_name = "N", value_parser = whole::<usize>(1..=1000), conflicts_with_all = ["mu", "stiffness"])]
    unannounced: Option<usize>,
    /// Draw the stacks of an earlier crosscheck with --unannounced, which has printed this seed
    #[arg(long, value_name = "SEED", value_parser = seed, requires = "unannounced")]
    seed: Option<u32>,
}

fn seed(text: &str) -> Result<u32, String> {
    let seed = text.trim().parse();
    seed.map_err(|_| format!("accepted is a whole number from 0 to {}", u32::MAX))
}

/// Stacks to be drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::cli) struct Draw {
    pub count: usize,
    pub seed: u32,
    /// Whether the seed is not one that was given.
    pub is_new: bool,
}

impl UnannouncedOptions {
    /// Returns what is to be drawn, if anything, with a new seed unless one is given.
    pub fn draw(&self) -> Option<Draw> {
        let count = self.unannounced?;
        Some(Draw {
            count,
            seed: self.seed.unwrap_or_else(new_seed),
            is_new: self.seed.is_none(),
        })
    }
}
