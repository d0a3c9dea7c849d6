//! The report as Markdown, its figures in files beside it.

use super::document::{Block, Document};
use crate::output::table::markdown_text;

pub(super) fn markdown(document: &Document) -> String {
    let mut page = format!("# {}\n", document.title);
    for line in &document.lead {
        page += &format!("\n{}\n", markdown_text(line));
    }
    for section in &document.sections {
        page += &format!("\n## {}\n", section.title);
        for block in &section.blocks {
            page += &markdown_block(block);
        }
    }
    page
}

fn markdown_block(block: &Block) -> String {
    match block {
        Block::Paragraph { text } => format!("\n{}\n", markdown_text(text)),
        Block::List { items } => {
            let items = items
                .iter()
                .map(|item| format!("- {}\n", markdown_text(item)));
            format!("\n{}", items.collect::<String>())
        }
        Block::Table(data) => {
            let name = data.name;
            format!(
                "\n{} Also as [CSV](tables/{name}.csv) and [LaTeX](tables/{name}.tex).\n\n{}",
                data.caption,
                data.table.markdown()
            )
        }
        Block::Figure(figure) => {
            let name = figure.name;
            format!("\n![{name}](figures/{name}.svg)\n\n{}\n", figure.caption)
        }
    }
}
