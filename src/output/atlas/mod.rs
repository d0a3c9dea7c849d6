//! The atlas as a static site: what every code, version and style means by a contact, made from passports alone.

mod meanings;
mod pages;
mod view;

pub use meanings::{Meaning, base_name, meanings};
pub(crate) use pages::{Problem, atlas_files};
pub(crate) use view::atlas_table;
