//! A table on a terminal, fitted to its width and with coloured verdicts.

use super::Table;
use super::look::{Limits, TerminalLook};
use super::screen::{Screen, coloured, wrapped};
use crate::model::readable_lines;
use comfy_table::presets;
use console::measure_text_width;

/// Number of columns that the text of a cell needs to be readable in broken lines.
const NARROWEST_TEXT: usize = 16;
/// Number of columns that a cell needs beside its content: two blanks and a border.
const BESIDE_CONTENT: usize = 3;
/// The borders between cells.
const BORDERS: [char; 2] = ['│', '┆'];

/// The widths of the contents of a column.
struct Content {
    heading: usize,
    longest_word_of_heading: usize,
    cells: usize,
    is_text: bool,
}

impl Content {
    fn of(table: &Table, column: usize) -> Self {
        let width = |text: &str| {
            let lines = readable_lines(text);
            let lines = lines.lines().map(measure_text_width);
            lines.max().unwrap_or(0)
        };
        let heading = &table.headings[column];
        let words = heading.split_whitespace().map(measure_text_width);
        let cells = table.rows.iter().map(|row| width(&row[column]));
        Self {
            heading: width(heading),
            longest_word_of_heading: words.max().unwrap_or(0),
            cells: cells.max().unwrap_or(0),
            is_text: !table.numeric[column],
        }
    }

    /// Returns the width if nothing is broken.
    fn whole(&self) -> usize {
        self.heading.max(self.cells)
    }

    /// Returns the width if headings are broken between words, and texts into lines of width `texts`.
    fn least(&self, texts: usize) -> usize {
        let cells = match self.is_text {
            true => self.cells.min(texts),
            false => self.cells,
        };
        cells.max(self.longest_word_of_heading)
    }
}

/// Returns the width of a table with contents of these widths.
fn needed(contents: impl Iterator<Item = usize>) -> usize {
    let cells = contents.map(|content| content + BESIDE_CONTENT);
    1 + cells.sum::<usize>()
}

impl Table {
    /// Formats the table for standard output. A file or a pipe takes any width; on a terminal, or where `COLUMNS` is
    /// set, the table is fitted to the width. Verdicts are coloured on a terminal.
    pub fn terminal(&self) -> String {
        self.on(Screen::of_standard_output())
    }

    fn on(&self, screen: Screen) -> String {
        match screen.width {
            Some(width) => self.fitted(width, screen.has_colours),
            None => self.framed(None, screen.has_colours),
        }
    }

    /// Draws the table in frames, within `limits` if there are any.
    fn framed(&self, limits: Option<&Limits>, has_colours: bool) -> String {
        let text = self.drawn(presets::UTF8_FULL_CONDENSED, readable_lines, limits);
        match has_colours {
            true => self.with_coloured_verdicts(&text),
            false => text,
        }
    }

    /// Draws the table at most `width` wide: with broken headings and without dispensable columns; if that is too
    /// wide, with broken texts as well; or else row by row.
    fn fitted(&self, width: usize, has_colours: bool) -> String {
        let contents: Vec<Content> = (0..self.headings.len())
            .map(|column| Content::of(self, column))
            .collect();
        let whole = needed(contents.iter().map(Content::whole));
        if whole <= width {
            return self.framed(None, has_colours);
        }
        let kept = self.kept(&contents, width);
        for texts in [usize::MAX, NARROWEST_TEXT] {
            let least = kept.iter().map(|&column| contents[column].least(texts));
            if needed(least.clone()) <= width {
                let limits = Limits {
                    width,
                    least: least.collect(),
                };
                let table = self.with_columns(&kept).framed(Some(&limits), has_colours);
                return table + &self.left_out(&kept, width, whole);
            }
        }
        self.stacked(width, has_colours)
    }

    /// Returns the columns that stay: those that are not dispensable, and as many of the others as there is room for,
    /// from the last to leave to the first.
    fn kept(&self, contents: &[Content], width: usize) -> Vec<usize> {
        let place = |column: &usize| self.look.dispensable.get(*column).copied().flatten();
        let all = 0..self.headings.len();
        let mut kept: Vec<usize> = all.clone().filter(|own| place(own).is_none()).collect();
        let mut others: Vec<usize> = all.filter(|own| place(own).is_some()).collect();
        others.sort_by_key(|column| std::cmp::Reverse(place(column)));
        for column in others {
            let with_it = kept.iter().chain([&column]);
            let least = with_it.map(|&column| contents[column].least(usize::MAX));
            if needed(least) <= width {
                kept.push(column);
            }
        }
        kept.sort_unstable();
        kept
    }

    /// Returns the table with the `kept` columns only.
    fn with_columns(&self, kept: &[usize]) -> Self {
        let texts = |cells: &[String]| kept.iter().map(|&column| cells[column].clone()).collect();
        Self {
            headings: texts(&self.headings),
            numeric: kept.iter().map(|&column| self.numeric[column]).collect(),
            rows: self.rows.iter().map(|row| texts(row)).collect(),
            from_outside: Vec::new(),
            anchors: Vec::new(),
            look: TerminalLook {
                dispensable: Vec::new(),
                with_verdicts: kept
                    .iter()
                    .map(|&column| self.look.has_verdicts(column))
                    .collect(),
                in_files: self.look.in_files,
            },
        }
    }

    /// Returns a note on the columns that are not `kept` and where they are shown; empty if all are kept.
    fn left_out(&self, kept: &[usize], width: usize, whole: usize) -> String {
        let columns = self.headings.iter().enumerate();
        let missing = columns.filter(|(column, _)| !kept.contains(column));
        let missing: Vec<&str> = missing.map(|(_, heading)| heading.as_str()).collect();
        if missing.is_empty() {
            return String::new();
        }
        let in_files = match self.look.in_files {
            true => ", or with --format csv",
            false => "",
        };
        let note = format!(
            "left out here: {}; shown in {whole} columns{in_files}\n",
            missing.join(", ")
        );
        wrapped(&note, width)
    }

    /// Draws a frame for each row, with a line for each column.
    fn stacked(&self, width: usize, has_colours: bool) -> String {
        let limits = Limits {
            width,
            least: Vec::new(),
        };
        let frames = self.rows.iter().map(|row| {
            let mut frame = Self::new([(String::new(), false), (String::new(), false)]);
            for (heading, cell) in self.headings.iter().zip(row) {
                frame.push(vec![heading.clone(), cell.clone()]);
            }
            frame.headings.clear();
            frame.look.with_verdicts = vec![false, self.look.with_verdicts.contains(&true)];
            frame.framed(Some(&limits), has_colours)
        });
        frames.collect()
    }

    /// Colours the verdicts in `text`, the drawn table, in the columns that have verdicts.
    fn with_coloured_verdicts(&self, text: &str) -> String {
        let lines = text.split_inclusive('\n').map(|line| {
            if !line.starts_with(BORDERS) {
                return line.to_owned();
            }
            // The first part is the left border.
            let parts = line.split_inclusive(BORDERS).enumerate();
            let parts = parts.map(|(index, part)| match index.checked_sub(1) {
                Some(column) if self.look.has_verdicts(column) => coloured(part),
                _ => part.to_owned(),
            });
            parts.collect::<String>()
        });
        lines.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::Columns;

    type Row = (&'static str, f64, &'static str, &'static str);

    fn table(rows: &[Row]) -> Table {
        Columns::<&Row>::new("test", "A row.", "nowhere")
            .text("name", |row| row.0)
            .means("a name")
            .shown("name")
            .number("force", "m g", |row| row.1)
            .means("a force")
            .shown("force")
            .dispensable(2)
            .text("origin", |row| row.2)
            .means("an origin")
            .shown("where it comes from")
            .dispensable(1)
            .text("verdict", |row| row.3)
            .means("a verdict")
            .shown("verdict")
            .with_verdicts()
            .rows(rows)
            .shown()
    }

    fn on(table: &Table, width: usize) -> String {
        table.on(Screen {
            width: Some(width),
            has_colours: false,
        })
    }

    fn widest(text: &str) -> usize {
        text.lines().map(measure_text_width).max().unwrap_or(0)
    }

    #[test]
    fn columns_leave_in_their_order_and_are_named() {
        let table = table(&[("one", 1.5, "a paper", "agrees")]);
        let whole = table.on(Screen {
            width: None,
            has_colours: false,
        });
        assert_eq!(on(&table, widest(&whole)), whole);
        let broken = on(&table, widest(&whole) - 1);
        assert!(broken.contains("force ┆ where it comes ┆"), "{broken}");
        assert!(!broken.contains("left out"), "{broken}");
        // The widest words of all headings and cells need 36.
        let narrower = on(&table, 35);
        assert!(narrower.contains("force ┆ verdict"), "{narrower}");
        assert!(
            narrower.contains("left out here: where it comes from;"),
            "{narrower}"
        );
        assert!(narrower.contains("┆   1.5 ┆"), "{narrower}");
        let narrow = on(&table, 20);
        assert!(narrow.contains("name ┆ verdict"), "{narrow}");
        assert!(widest(&narrow) <= 20, "{narrow}");
        assert!(narrow.contains("--format csv"), "{narrow}");
    }

    #[test]
    fn texts_are_broken_before_rows_are_stacked() {
        let long = "a name that is much longer than the others are";
        let table = table(&[(long, 1.5, "a paper", "agrees")]);
        let broken = on(&table, 40);
        assert!(widest(&broken) <= 40, "{broken}");
        assert!(broken.contains("┆ agrees "), "{broken}");
        let stacked = on(&table, 26);
        assert!(widest(&stacked) <= 26, "{stacked}");
        assert!(stacked.contains("│ force "), "{stacked}");
        assert!(!stacked.contains("left out"), "{stacked}");
    }

    #[test]
    fn a_verdict_is_coloured_in_its_column_alone() {
        let rows = [("differs", 1.5, "failed", "differs")];
        let text = table(&rows).on(Screen {
            width: None,
            has_colours: true,
        });
        assert_eq!(text.matches("\u{1b}[31m").count(), 1, "{text}");
        assert!(text.contains("\u{1b}[31mdiffers\u{1b}[0m │"), "{text}");
        assert!(!text.contains("\u{1b}[35m"), "{text}");
    }
}
