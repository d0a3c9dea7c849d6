//! The report as a document, from which every format is made.

use crate::output::{DataTable, Figure, Table};
use serde::Serialize;

/// The whole report.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Document {
    /// Its title.
    pub title: String,
    /// Lines below the title.
    pub lead: Vec<String>,
    /// Its sections, in order.
    pub sections: Vec<Section>,
}

/// A section.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Section {
    /// Its anchor.
    pub id: &'static str,
    /// Its title.
    pub title: &'static str,
    /// Its content, in order.
    pub blocks: Vec<Block>,
}

/// A piece of a section. In texts `…` between backticks is code.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Block {
    /// A paragraph.
    Paragraph {
        /// Its text.
        text: String,
    },
    /// A list.
    List {
        /// Its items.
        items: Vec<String>,
    },
    /// A table, which is also a file of its own.
    Table(PageTable),
    /// A figure, which is also a file of its own.
    Figure(Figure),
}

impl Block {
    /// A paragraph.
    pub fn paragraph(text: impl Into<String>) -> Self {
        Self::Paragraph { text: text.into() }
    }
}

/// A table with a name.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PageTable {
    /// Name of its files, without ending.
    pub name: &'static str,
    /// What it shows.
    pub caption: String,
    /// Its cells, as they are shown.
    #[serde(skip)]
    pub table: Table,
    /// The same rows with every digit.
    #[serde(skip)]
    pub csv: Vec<u8>,
    /// Whether it is long, and stands folded on the page until it is opened or printed.
    pub long: bool,
    /// How many rows are shown.
    pub rows: usize,
}

impl PageTable {
    /// `data` under the name `name`.
    pub fn new(name: &'static str, caption: impl Into<String>, data: &DataTable) -> Self {
        Self::showing(data.shown(), name, caption, data)
    }

    /// `data` under the name `name`, shown as `table`.
    pub fn showing(
        table: Table,
        name: &'static str,
        caption: impl Into<String>,
        data: &DataTable,
    ) -> Self {
        Self {
            name,
            caption: caption.into(),
            csv: data.csv(),
            long: false,
            rows: table.len(),
            table,
        }
    }

    /// The same, folded if `long`.
    pub fn folded(self, long: bool) -> Self {
        Self { long, ..self }
    }
}

impl Document {
    /// All its blocks, in order.
    fn blocks(&self) -> impl Iterator<Item = &Block> {
        self.sections.iter().flat_map(|section| &section.blocks)
    }

    /// All its tables, in order.
    pub fn tables(&self) -> impl Iterator<Item = &PageTable> {
        self.blocks().filter_map(|block| match block {
            Block::Table(table) => Some(table),
            _ => None,
        })
    }

    /// All its figures, in order.
    pub fn figures(&self) -> impl Iterator<Item = &Figure> {
        self.blocks().filter_map(|block| match block {
            Block::Figure(figure) => Some(figure),
            _ => None,
        })
    }
}
