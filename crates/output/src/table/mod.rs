//! Tables: every column is declared once, and every format is derived from the declaration.

mod columns;
mod data;
mod look;
mod screen;
mod shown;
mod terminal;
mod units;
mod value;

pub(crate) use columns::Columns;
pub use data::{DataTable, json};
pub use screen::wrapped_to_screen;
pub use shown::Table;
pub(crate) use value::Value;
