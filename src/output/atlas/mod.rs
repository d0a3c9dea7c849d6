//! The atlas as a static site: what every code, version and style means by a contact, made from what is on file alone.

mod pages;
mod view;

pub(crate) use pages::{Problem, atlas_files};
pub(crate) use view::atlas_table;
