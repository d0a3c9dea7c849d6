//! The report as a document, from which every format is made.

use crate::output::{DataTable, Figure, Table};
use serde::Serialize;

/// The whole report.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Document {
    pub title: String,
    /// Paragraphs below the title.
    pub lead: Vec<String>,
    pub sections: Vec<Section>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Section {
    /// Anchor in the page.
    pub id: &'static str,
    pub title: &'static str,
    pub blocks: Vec<Block>,
}

impl Section {
    pub fn new(id: &'static str, title: &'static str, blocks: Vec<Block>) -> Self {
        Self { id, title, blocks }
    }
}

/// A piece of a section. In texts `…` between backticks is code.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub(super) enum Block {
    Paragraph { text: String },
    List { items: Vec<String> },
    Table(PageTable),
    Figure(Figure),
}

impl Block {
    pub fn paragraph(text: impl Into<String>) -> Self {
        Self::Paragraph { text: text.into() }
    }

    /// `data` under the name `name`.
    pub fn table(name: &'static str, caption: impl Into<String>, data: &DataTable) -> Self {
        Self::Table(PageTable::new(name, caption, data, data.shown()))
    }

    /// A table that is folded if `long`.
    pub fn long_table(
        long: bool,
        name: &'static str,
        caption: impl Into<String>,
        data: &DataTable,
    ) -> Self {
        Self::Table(PageTable {
            long,
            ..PageTable::new(name, caption, data, data.shown())
        })
    }
}

/// A table of the page, which is also written to files of its own.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct PageTable {
    /// Name of its files, without extension.
    pub name: &'static str,
    pub caption: String,
    #[serde(skip)]
    pub table: Table,
    /// The same rows with every digit.
    #[serde(skip)]
    pub csv: String,
    /// Whether it is folded on the page until it is opened or printed.
    pub long: bool,
    /// Number of rows shown.
    pub rows: usize,
}

impl PageTable {
    /// `data` under the name `name`, shown as `table`.
    pub fn new(
        name: &'static str,
        caption: impl Into<String>,
        data: &DataTable,
        table: Table,
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
}

impl Document {
    fn blocks(&self) -> impl Iterator<Item = &Block> {
        self.sections.iter().flat_map(|section| &section.blocks)
    }

    /// All tables, in order.
    pub fn tables(&self) -> impl Iterator<Item = &PageTable> {
        self.blocks().filter_map(|block| match block {
            Block::Table(table) => Some(table),
            _ => None,
        })
    }

    /// All figures, in order.
    pub fn figures(&self) -> impl Iterator<Item = &Figure> {
        self.blocks().filter_map(|block| match block {
            Block::Figure(figure) => Some(figure),
            _ => None,
        })
    }
}
