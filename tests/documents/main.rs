//! What people read, and what a checkout holds: pages, formats, schemas, manifests and decks.

#[path = "../common/mod.rs"]
mod common;

mod architecture;
mod decks;
mod formats;
mod manifests;
mod no_shell;
mod readme;
mod reliability;
mod schema;
mod supply_chain;
