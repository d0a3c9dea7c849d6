//! The paper: what it says, claim by claim, and what it did, done again.

pub mod claims;
pub mod published;
pub mod reproduction;
