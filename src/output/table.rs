//! A table of text cells and its views.

use comfy_table::{CellAlignment, ContentArrangement, TableStyle, presets};
use serde::Serialize;

/// Named columns and rows of cells.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Table {
    columns: Vec<&'static str>,
    rows: Vec<Vec<String>>,
    numeric: Vec<bool>,
}

impl Table {
    /// An empty table; the columns whose name is followed by `>` are numbers and aligned to the right.
    pub fn new(columns: &[&'static str]) -> Self {
        Self {
            columns: columns
                .iter()
                .map(|name| name.trim_end_matches('>'))
                .collect(),
            numeric: columns.iter().map(|name| name.ends_with('>')).collect(),
            rows: Vec::new(),
        }
    }

    /// Adds a row of as many cells as there are columns.
    pub fn push(&mut self, cells: Vec<String>) {
        debug_assert_eq!(cells.len(), self.columns.len());
        self.rows.push(cells);
    }

    /// The names of the columns.
    pub fn columns(&self) -> &[&'static str] {
        &self.columns
    }

    /// Which columns are numbers.
    pub fn numeric(&self) -> &[bool] {
        &self.numeric
    }

    /// The cells, row by row.
    pub fn rows(&self) -> &[Vec<String>] {
        &self.rows
    }

    /// For a spreadsheet.
    pub fn csv(&self) -> Vec<u8> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let lines = std::iter::once(self.columns.iter().map(|&name| name.to_owned()).collect());
        for line in lines.chain(self.rows.iter().cloned()) {
            writer
                .write_record(&line)
                .expect("plain cells are written to memory");
        }
        writer.into_inner().expect("memory is flushed")
    }

    /// For a terminal.
    pub fn terminal(&self) -> String {
        self.render(presets::UTF8_FULL_CONDENSED)
    }

    /// For Markdown.
    pub fn markdown(&self) -> String {
        self.render(presets::ASCII_MARKDOWN)
    }

    fn render(&self, style: TableStyle) -> String {
        let mut table = comfy_table::Table::new();
        table
            .load_style(style)
            .set_content_arrangement(ContentArrangement::Disabled)
            .set_header(&self.columns)
            .add_rows(&self.rows);
        for (column, numeric) in table.column_iter_mut().zip(&self.numeric) {
            if *numeric {
                column.set_cell_alignment(CellAlignment::Right);
            }
        }
        let lines: Vec<String> = table
            .lines()
            .map(|line| line.trim_end().to_owned())
            .collect();
        lines.join("\n") + "\n"
    }
}
