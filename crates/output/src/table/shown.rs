//! A table of text cells for people, in every format.

use super::look::{Limits, TerminalLook};
use crate::text::{html_attribute, html_text, markdown_cell, without_mathematics};
use comfy_table::{
    CellAlignment, ColumnConstraint, ContentArrangement, TableStyle, Width, presets,
};
use std::borrow::Cow;

/// Blanks on both sides of the content of a cell.
const PADDING: usize = 2;

/// Number of letters beyond which a text is long for a column.
const LONG_TEXT: usize = 60;

/// Named columns and rows of cells. In a cell, text between backticks is code.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    pub(super) headings: Vec<String>,
    /// Whether a column holds numbers, aligned to the right.
    pub(super) numeric: Vec<bool>,
    pub(super) rows: Vec<Vec<String>>,
    /// Whether the texts of a column come from outside, so that they have no notation: empty, or one for each column.
    pub(super) from_outside: Vec<bool>,
    /// Anchors of the rows on a page: empty, or one for each row.
    pub(super) anchors: Vec<String>,
    pub(super) look: TerminalLook,
}

impl Table {
    /// Creates an empty table from headings, each with whether its column holds numbers.
    pub(crate) fn new(columns: impl IntoIterator<Item = (String, bool)>) -> Self {
        let (headings, numeric) = columns.into_iter().unzip();
        Self {
            headings,
            numeric,
            rows: Vec::new(),
            from_outside: Vec::new(),
            anchors: Vec::new(),
            look: TerminalLook::default(),
        }
    }

    /// Gives each row an anchor.
    pub(crate) fn anchored(mut self, anchors: impl IntoIterator<Item = String>) -> Self {
        self.anchors = anchors.into_iter().collect();
        debug_assert_eq!(self.anchors.len(), self.rows.len());
        self
    }

    /// Sets the look on terminals.
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

    /// Formats the table as Markdown.
    pub(crate) fn markdown(&self) -> String {
        self.plain_outside()
            .drawn(presets::ASCII_MARKDOWN, markdown_cell, None)
    }

    /// Returns the table with the marks of mathematics and code escaped in texts from outside.
    fn plain_outside(&self) -> Cow<'_, Self> {
        if !self.from_outside.contains(&true) {
            return Cow::Borrowed(self);
        }
        let mut table = self.clone();
        for row in &mut table.rows {
            let cells = row.iter_mut().zip(&self.from_outside);
            for (cell, _) in cells.filter(|(_, from_outside)| **from_outside) {
                *cell = without_mathematics(cell);
            }
        }
        Cow::Owned(table)
    }

    /// Draws the table in a style, within `limits` if there are any. Of the tables drawn so, only those for Markdown
    /// have anchors.
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
        let rows = self.rows.iter().enumerate().map(|(index, row)| {
            let mut row = cells(row);
            if let (Some(anchor), Some(first)) = (self.anchors.get(index), row.first_mut()) {
                first.insert_str(0, &format!("<a id=\"{anchor}\"></a>"));
            }
            row
        });
        let mut table = comfy_table::Table::new();
        table
            .load_style(style)
            .set_content_arrangement(ContentArrangement::Disabled)
            .set_header(cells(&self.headings))
            .add_rows(rows);
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

    /// Formats the table as HTML. If it has long texts, each row becomes a block of lines on a narrow screen.
    pub(crate) fn html(&self) -> String {
        let class = if self.has_long_texts() {
            " class=\"stacked\""
        } else {
            ""
        };
        let plain = self.plain_outside();
        let headings = self.headings.iter().zip(&self.numeric);
        let head = headings.map(|(heading, &numeric)| {
            format!(
                "<th{} scope=\"col\">{}</th>",
                number_class(numeric),
                html_text(heading)
            )
        });
        let rows = plain.rows.iter().enumerate().map(|(index, row)| {
            let anchor = self.anchors.get(index);
            let anchor = anchor.map_or(String::new(), |anchor| format!(" id=\"{anchor}\""));
            format!("<tr{anchor}>{}</tr>\n", self.html_cells(row))
        });
        format!(
            "<div class=\"scroll\"><table{class}>\n<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody></table></div>",
            head.collect::<String>(),
            rows.collect::<String>()
        )
    }

    fn html_cells(&self, row: &[String]) -> String {
        let is_stacked = self.has_long_texts();
        let columns = self.headings.iter().zip(&self.numeric);
        let cells = row.iter().zip(columns).map(|(cell, (heading, &numeric))| {
            let heading = match is_stacked {
                true => format!(" data-heading=\"{}\"", html_attribute(heading)),
                false => String::new(),
            };
            let cell = if numeric {
                html_number(cell)
            } else {
                html_text(cell)
            };
            format!("<td{}{heading}>{cell}</td>", number_class(numeric))
        });
        cells.collect()
    }

    fn has_long_texts(&self) -> bool {
        let cells = self.rows.iter().flatten();
        cells
            .into_iter()
            .any(|cell| cell.chars().count() > LONG_TEXT)
    }
}

fn number_class(numeric: bool) -> &'static str {
    if numeric { " class=\"number\"" } else { "" }
}

/// Formats a number in HTML with a minus sign and a power of ten, or with its percent sign; other text as it is.
fn html_number(cell: &str) -> String {
    let number = cell.strip_suffix(" %").unwrap_or(cell);
    if number.parse::<f64>().is_err() {
        return html_text(cell);
    }
    let cell = cell.replace('-', "−");
    match cell.split_once('e') {
        Some((digits, exponent)) => {
            let exponent = exponent.trim_start_matches('+');
            format!("{digits}\u{2009}×\u{2009}10<sup>{exponent}</sup>")
        }
        None => cell,
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
    fn a_bar_in_a_cell_does_not_end_it_in_markdown() {
        let line = table().markdown().lines().nth(2).map(str::to_owned);
        let expected = "| z⋆ & `a_b` \\|x\\| < 1 |  ±5 % |";
        assert_eq!(line.as_deref(), Some(expected));
    }

    #[test]
    fn what_comes_from_outside_is_no_mathematics_on_pages() {
        let mut table = table();
        table.rows[0][0] = "7 $\\input{/etc/passwd}$ & % # _ {} <b>".to_owned();
        table.from_outside = vec![true, false];
        let html = table.html();
        let plain = "<td>7 $\\input{/etc/passwd}$ &amp; % # _ {} &lt;b&gt;</td>";
        assert!(html.contains(plain), "{html}");
        let markdown = table.markdown();
        let plain = "7 \\$\\input{/etc/passwd}\\$ & % # _ {} &lt;b>";
        assert!(markdown.contains(plain), "{markdown}");
        let columns = [("a", false)].map(|(name, numeric)| (name.to_owned(), numeric));
        let mut own = Table::new(columns);
        own.push(vec!["$a$".to_owned()]);
        assert!(own.html().contains("<math"));
    }

    #[test]
    fn html_escapes_cells_and_marks_numbers_and_code() {
        let html = table().html();
        assert!(
            html.contains("<td>z⋆ &amp; <code>a_b</code> |x| &lt; 1</td>"),
            "{html}"
        );
        assert!(html.contains("<td class=\"number\">±5 %</td>"), "{html}");
        assert_eq!(
            html_number("-1.5e-8"),
            "−1.5\u{2009}×\u{2009}10<sup>−8</sup>"
        );
        assert_eq!(html_number("0.25"), "0.25");
    }
}
