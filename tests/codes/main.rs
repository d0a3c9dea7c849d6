//! Codes in folders: real ones, changed ones, and those that misbehave.

#[path = "../common/mod.rs"]
mod common;

mod check;
mod examples;
mod faults;
mod guard;
mod lies;
mod live;
mod mutations;
mod probe_laws;
mod resolution;
mod rigid;
mod schemes;
mod twins;
mod variants;
