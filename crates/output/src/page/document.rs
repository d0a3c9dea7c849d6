//! The report as a document, from which every format is made.

use super::references::Numbers;
use crate::{DataTable, Figure, Table};
use serde::Serialize;

/// The whole report.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Document {
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

/// A piece of a section. Texts have the notation of [`crate::text`]; in them `[](#figure-scaling)` is a link to
/// that figure with its number.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub(super) enum Block {
    Paragraph { text: String },
    List { items: Vec<String> },
    Table(PageTable),
    Figure(NumberedFigure),
    Claims(Claims),
}

impl Block {
    pub fn paragraph(text: impl Into<String>) -> Self {
        Self::Paragraph { text: text.into() }
    }

    pub fn figure(figure: Figure) -> Self {
        Self::Figure(NumberedFigure {
            number: 0,
            caption: figure.caption.clone(),
            figure,
        })
    }

    /// Creates a table of `data` with the name `name`.
    pub fn table(name: &'static str, caption: impl Into<String>, data: &DataTable) -> Self {
        Self::Table(PageTable::new(name, caption, data, data.titled()))
    }

    /// Creates a table that is folded if `long`.
    pub fn long_table(
        long: bool,
        name: &'static str,
        caption: impl Into<String>,
        data: &DataTable,
    ) -> Self {
        Self::Table(PageTable {
            long,
            ..PageTable::new(name, caption, data, data.titled())
        })
    }

    /// Returns the texts in the block, which may have references.
    fn texts(&mut self) -> Vec<&mut String> {
        match self {
            Self::Paragraph { text } => vec![text],
            Self::List { items } => items.iter_mut().collect(),
            Self::Table(table) => vec![&mut table.caption],
            Self::Figure(figure) => vec![&mut figure.caption],
            Self::Claims(claims) => {
                let texts = claims.list.iter_mut();
                let texts = texts.flat_map(|own| own.sources.iter_mut().chain(&mut own.erratum));
                texts.chain([&mut claims.table.caption]).collect()
            }
        }
    }
}

/// A table of the page, which is also written to files of its own.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct PageTable {
    /// Name of its files, without extension.
    pub name: &'static str,
    /// Its place among the tables, from 1.
    pub number: usize,
    pub caption: String,
    #[serde(skip)]
    pub table: Table,
    /// The same rows with every digit.
    #[serde(skip)]
    pub csv: String,
    /// Whether it is folded on the page until it is opened, and not printed.
    pub long: bool,
    /// Number of rows shown.
    pub rows: usize,
}

impl PageTable {
    /// Creates a table of `data` with the name `name`, shown as `table`.
    pub fn new(
        name: &'static str,
        caption: impl Into<String>,
        data: &DataTable,
        table: Table,
    ) -> Self {
        Self {
            name,
            number: 0,
            caption: caption.into(),
            csv: data.csv(),
            long: false,
            rows: table.len(),
            table,
        }
    }
}

/// A figure with its place among the figures.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct NumberedFigure {
    #[serde(flatten)]
    pub figure: Figure,
    /// Its place among the figures, from 1.
    pub number: usize,
    /// The caption with its references filled in.
    #[serde(rename = "text")]
    pub caption: String,
}

/// The claims of the paper: a list on the page, a table in files.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Claims {
    pub table: PageTable,
    /// Counts by verdict; claims that do not hold come first.
    pub counts: Vec<VerdictCount>,
    /// The claims in the order of the counts, and within one verdict in that of the paper.
    pub list: Vec<PageClaim>,
    /// The displayed equations, in the order of the paper.
    pub equations: Vec<PageEquation>,
}

/// How many claims have one verdict.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct VerdictCount {
    /// The verdict in files, and as a class on the page.
    pub verdict: String,
    pub words: &'static str,
    pub count: usize,
}

/// A claim on the page.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct PageClaim {
    pub id: String,
    /// Its place in the paper, from 1.
    pub number: usize,
    pub place: String,
    pub statement: String,
    pub verdict: String,
    pub words: &'static str,
    pub evidence: String,
    /// The verdict by the published data, and its evidence.
    pub as_published: Option<String>,
    pub erratum: Option<String>,
    /// Numbers of the displayed equations that it covers.
    pub equations: Vec<String>,
    /// Links to the figures and tables with its numbers.
    pub sources: Vec<String>,
}

/// A displayed equation and the claim that covers it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct PageEquation {
    pub number: String,
    pub claim: String,
    pub verdict: String,
}

impl Document {
    /// Numbers figures and tables, and puts these numbers into the references to them.
    pub fn numbered(mut self) -> Self {
        let (mut figures, mut tables) = (0, 0);
        let mut numbers = Numbers::default();
        for block in self.blocks_mut() {
            match block {
                Block::Figure(own) => {
                    figures += 1;
                    own.number = figures;
                    numbers.add("figure", own.figure.name, figures);
                }
                Block::Table(table) | Block::Claims(Claims { table, .. }) => {
                    tables += 1;
                    table.number = tables;
                    numbers.add("table", table.name, tables);
                }
                Block::Paragraph { .. } | Block::List { .. } => {}
            }
        }
        for (number, claim) in self.claims().enumerate() {
            debug_assert!(claim.number > 0, "claim {number} has its number");
            numbers.add("claim", &claim.id, claim.number);
        }
        let lead: Vec<String> = self
            .lead
            .iter()
            .map(|text| numbers.put_into(text))
            .collect();
        self.lead = lead;
        for text in self.blocks_mut().flat_map(Block::texts) {
            *text = numbers.put_into(text);
        }
        self
    }

    fn blocks(&self) -> impl Iterator<Item = &Block> {
        self.sections.iter().flat_map(|section| &section.blocks)
    }

    fn blocks_mut(&mut self) -> impl Iterator<Item = &mut Block> {
        let sections = self.sections.iter_mut();
        sections.flat_map(|section| &mut section.blocks)
    }

    /// Returns all tables, in order.
    pub fn tables(&self) -> impl Iterator<Item = &PageTable> {
        self.blocks().filter_map(|block| match block {
            Block::Table(table) | Block::Claims(Claims { table, .. }) => Some(table),
            _ => None,
        })
    }

    /// Returns all figures, in order.
    pub fn figures(&self) -> impl Iterator<Item = &Figure> {
        self.numbered_figures().map(|own| &own.figure)
    }

    /// Returns all figures with their numbers, in order.
    pub fn numbered_figures(&self) -> impl Iterator<Item = &NumberedFigure> {
        self.blocks().filter_map(|block| match block {
            Block::Figure(own) => Some(own),
            _ => None,
        })
    }

    fn claims(&self) -> impl Iterator<Item = &PageClaim> {
        let lists = self.blocks().filter_map(|block| match block {
            Block::Claims(claims) => Some(&claims.list),
            _ => None,
        });
        lists.flatten()
    }
}
