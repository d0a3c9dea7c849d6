//! The report as Markdown, its figures in files beside it.

use super::document::{Block, Claims, Document, NumberedFigure, PageTable};
use crate::text::markdown_text;

pub(super) fn markdown(document: &Document) -> String {
    let mut page = format!("# {}\n", document.title);
    for line in &document.lead {
        page += &format!("\n{}\n", markdown_text(line));
    }
    for section in &document.sections {
        let (id, title) = (section.id, markdown_text(section.title));
        page += &format!("\n<a id=\"{id}\"></a>\n\n## {title}\n");
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
        Block::Table(data) | Block::Claims(Claims { table: data, .. }) => table(data),
        Block::Figure(figure) => pictured(figure),
    }
}

fn table(data: &PageTable) -> String {
    let PageTable { name, number, .. } = data;
    format!(
        "\n<a id=\"table-{name}\"></a>\n\n**Table {number}.** {} [CSV](tables/{name}.csv)\n\n{}",
        markdown_text(&data.caption),
        data.table.markdown()
    )
}

fn pictured(figure: &NumberedFigure) -> String {
    let (name, number) = (figure.figure.name, figure.number);
    format!(
        "\n<a id=\"figure-{name}\"></a>\n\n![{name}](figures/{name}.svg)\n\n**Figure {number}.** {} \
         [SVG](figures/{name}.svg), [PDF](figures/{name}.pdf)\n",
        markdown_text(&figure.caption)
    )
}
