//! A table of text cells for people, in every format.

use super::escape::{html_text, latex_text, markdown_cell};
use super::look::{Limits, TerminalLook};
use comfy_table::{
    CellAlignment, ColumnConstraint, ContentArrangement, TableStyle, Width, presets,
};

/// Blanks on both sides of the content of a cell.
const PADDING: usize = 2;

/// Named columns and rows of cells. In a cell `…` between backticks is code.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    pub(super) headings: Vec<String>,
    /// Whether a column holds numbers, aligned to the right.
    pub(super) numeric: Vec<bool>,
    pub(super) rows: Vec<Vec<String>>,
    pub(super) look: TerminalLook,
}

impl Table {
    /// An empty table; each column has a heading and may hold numbers.
    pub(crate) fn new(columns: impl IntoIterator<Item = (String, bool)>) -> Self {
        let (headings, numeric) = columns.into_iter().unzip();
        Self {
            headings,
            numeric,
            rows: Vec::new(),
            look: TerminalLook::default(),
        }
    }

    /// The table with this look on terminals.
    pub(super) fn on_terminals(self, look: TerminalLook) -> Self {
        Self { look, ..self }
    }

    /// Adds a row of as many cells as there are columns.
    pub(crate) fn push(&mut self, cells: Vec<String>) {
        debug_assert_eq!(cells.len(), self.headings.len());
        self.rows.push(cells);
    }

    pub(crate) fn len(&self) -> usize {
        self.rows.len()
    }

    /// The table in Markdown.
    pub(crate) fn markdown(&self) -> String {
        self.drawn(presets::ASCII_MARKDOWN, markdown_cell, None)
    }

    /// The table in this style, within `limits` if there are any.
    pub(super) fn drawn(
        &self,
        style: TableStyle,
        escaped: fn(&str) -> String,
        limits: Option<&Limits>,
    ) -> String {
        let cells = |cells: &[String]| -> Vec<String> {
            let cells = cells.iter().map(|cell| escaped(cell));
            cells.collect()
        };
        let mut table = comfy_table::Table::new();
        table
            .load_style(style)
            .set_content_arrangement(ContentArrangement::Disabled)
            .set_header(cells(&self.headings))
            .add_rows(self.rows.iter().map(|row| cells(row)));
        for (column, numeric) in table.column_iter_mut().zip(&self.numeric) {
            if *numeric {
                column.set_cell_alignment(CellAlignment::Right);
            }
        }
        if let Some(limits) = limits {
            let columns = |number: usize| u16::try_from(number).unwrap_or(u16::MAX);
            table.set_content_arrangement(ContentArrangement::Dynamic);
            table.set_width(columns(limits.width));
            for (column, least) in table.column_iter_mut().zip(&limits.least) {
                let padded = columns(least + PADDING);
                column.set_constraint(ColumnConstraint::LowerBoundary(Width::Fixed(padded)));
            }
        }
        let lines: Vec<String> = table
            .lines()
            .map(|line| line.trim_end().to_owned())
            .collect();
        lines.join("\n") + "\n"
    }

    /// LaTeX for a paper, in ASCII: booktabs, for `long` tables longtable, the caption as a comment.
    pub(crate) fn latex(&self, caption: &str, long: bool) -> String {
        let numeric = self.numeric.iter();
        let alignment: String = numeric
            .map(|&number| if number { 'r' } else { 'l' })
            .collect();
        let line = |cells: &[String]| {
            let cells: Vec<String> = cells.iter().map(|cell| latex_text(cell)).collect();
            cells.join(" & ") + " \\\\\n"
        };
        let (environment, head) = match long {
            true => ("longtable", "\\endhead\n"),
            false => ("tabular", ""),
        };
        let rows: String = self.rows.iter().map(|row| line(row)).collect();
        format!(
            "% {}\n\\begin{{{environment}}}{{{alignment}}}\n\\toprule\n{}\\midrule\n{head}{rows}\
             \\bottomrule\n\\end{{{environment}}}\n",
            caption.replace('\n', " "),
            line(&self.headings)
        )
    }

    /// The table in HTML.
    pub(crate) fn html(&self) -> String {
        let line = |cells: &[String], tag: &str, scope: &str| {
            let cells = cells.iter().zip(&self.numeric).map(|(cell, numeric)| {
                let class = if *numeric { " class=\"number\"" } else { "" };
                format!("<{tag}{class}{scope}>{}</{tag}>", html_text(cell))
            });
            format!("<tr>{}</tr>", cells.collect::<String>())
        };
        let head = line(&self.headings, "th", " scope=\"col\"");
        let rows = self.rows.iter().map(|row| line(row, "td", "") + "\n");
        format!(
            "<div class=\"scroll\"><table>\n<thead>{head}</thead>\n<tbody>\n{}</tbody></table></div>",
            rows.collect::<String>()
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let columns = [("theory", false), ("error", true)];
        let mut table = Table::new(columns.map(|(name, numeric)| (name.to_owned(), numeric)));
        table.push(vec!["z⋆ & `a_b` |x| < 1".to_owned(), "±5 %".to_owned()]);
        table
    }

    #[test]
    fn latex_is_ready_for_a_paper() {
        let expected = "% Errors.\n\\begin{tabular}{lr}\n\\toprule\ntheory & error \\\\\n\\midrule\n\
                        z$\\star$ \\& \\texttt{a\\_b} \\textbar{}x\\textbar{} $<$ 1 & $\\pm$5 \\% \\\\\n\
                        \\bottomrule\n\\end{tabular}\n";
        assert_eq!(table().latex("Errors.", false), expected);
    }

    #[test]
    fn a_bar_in_a_cell_does_not_end_it_in_markdown() {
        let line = table().markdown().lines().nth(2).map(str::to_owned);
        let expected = "| z⋆ & `a_b` \\|x\\| < 1 |  ±5 % |";
        assert_eq!(line.as_deref(), Some(expected));
    }

    #[test]
    fn html_escapes_cells_and_marks_numbers_and_code() {
        let html = table().html();
        assert!(
            html.contains("<td>z⋆ &amp; <code>a_b</code> |x| &lt; 1</td>"),
            "{html}"
        );
        assert!(html.contains("<td class=\"number\">±5 %</td>"), "{html}");
    }
}
