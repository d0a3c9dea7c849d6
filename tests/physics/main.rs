//! Theory and native code, by second routes.

#[path = "../common/mod.rs"]
mod common;

mod at_rest;
mod claims;
mod determinism;
mod hertz;
mod impacts;
mod instructions;
mod native_dem;
mod onset_and_peak;
mod packing;
mod published;
mod pyramid;
mod regimes;
mod round_off;
mod side_walls;
mod space;
mod vectors;
