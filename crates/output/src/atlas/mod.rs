//! The atlas as a static site that compares contact conventions across codes, versions and styles. It is built from
//! files alone.

mod pages;
mod view;

pub use pages::{Problem, atlas_files};
pub(crate) use view::atlas_table;
