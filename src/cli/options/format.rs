//! `--format`.

use crate::cli::{ExitStatus, print};
use crate::output::{DataTable, json, wrapped_to_screen};
use clap::ValueEnum;

/// The format of printed results.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum Format {
    /// A table for a terminal.
    Table,
    /// JSON with units and command.
    Json,
    /// CSV for spreadsheets.
    Csv,
}

impl Format {
    /// Prints `tables`, the results of `command`. The text for a terminal comes from `people`, unless all tables are
    /// empty. CSV has the first table only.
    pub fn print(
        self,
        tables: &[DataTable],
        command: &str,
        people: impl FnOnce() -> String,
    ) -> ExitStatus {
        print(&match self {
            Self::Table if tables.iter().all(DataTable::is_empty) => String::new(),
            Self::Table => wrapped_to_screen(people()),
            Self::Json => json(tables, command),
            Self::Csv => tables.first().map_or_else(String::new, DataTable::csv),
        })
    }
}
