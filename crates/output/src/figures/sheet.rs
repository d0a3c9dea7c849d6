//! Panels in rows with a shared key and table, in a layout for wide pages and one for narrow ones.

use super::drawing::{Anchor, Drawing, Place, text_width};
use super::panel::{Panel, Sample, draw_entry, draw_panel};
use super::style::{
    FRAME, KEY_COLUMNS, KEY_LINE, KEY_SAMPLE, KEY_SPACE, MARGINS, PADDING, SPACING, TEXT_SIZE,
};

/// Size in pixels of a panel that shares the width of a page with another one.
const HALF_PAGE: (f64, f64) = (350.0, 320.0);
/// Size in pixels of a panel that shares the width of a page with two others.
const THIRD_OF_PAGE: (f64, f64) = (262.0, 250.0);
/// Width in pixels of the panels of a narrow page, which stand one below the other.
const NARROW: f64 = 350.0;
/// Distance of a key or a table from what stands above it.
const ABOVE: f64 = 12.0;
/// Distance of two columns of a table.
const COLUMN_SPACE: f64 = 18.0;

/// The panels of a figure, named by letters, with a key and a table below them.
pub(super) struct Sheet {
    panels: Vec<Panel>,
    columns: usize,
    size: (f64, f64),
    key: Vec<(Sample, String)>,
    /// The rows of the table, of which the first one has the column headings.
    table: Vec<Vec<String>>,
}

impl Sheet {
    fn new(panels: impl Into<Vec<Panel>>, columns: usize, size: (f64, f64)) -> Self {
        Self {
            panels: panels.into(),
            columns,
            size,
            key: Vec::new(),
            table: Vec::new(),
        }
    }

    /// Arranges panels two side by side.
    pub fn of_halves(panels: impl Into<Vec<Panel>>) -> Self {
        Self::new(panels, 2, HALF_PAGE)
    }

    /// Arranges panels three side by side.
    pub fn of_thirds(panels: impl Into<Vec<Panel>>) -> Self {
        Self::new(panels, 3, THIRD_OF_PAGE)
    }

    /// Adds a key, in the free place of the last row if there is one, else below all panels.
    pub fn with_key(mut self, key: impl IntoIterator<Item = (Sample, String)>) -> Self {
        self.key.extend(key);
        self
    }

    /// Adds a table below everything.
    pub fn with_table(mut self, rows: Vec<Vec<String>>) -> Self {
        self.table = rows;
        self
    }

    /// Draws the panels side by side.
    pub fn wide(&self) -> Drawing {
        self.drawn(self.columns, self.size.0)
    }

    /// Draws one panel below the other, for screens on which the letters of the wide layout would be too small.
    pub fn narrow(&self) -> Drawing {
        self.drawn(1, NARROW)
    }

    fn drawn(&self, columns: usize, panel_width: f64) -> Drawing {
        let whole = |count: usize, size: f64| {
            2.0 * PADDING + count as f64 * size + count.saturating_sub(1) as f64 * SPACING
        };
        let (count, panel_height) = (self.panels.len(), self.size.1);
        let width = whole(columns, panel_width);
        let panels_end = whole(count.div_ceil(columns), panel_height);
        let corner = |index: usize| -> Place {
            [
                PADDING + (index % columns) as f64 * (panel_width + SPACING),
                PADDING + (index / columns) as f64 * (panel_height + SPACING),
            ]
        };
        let left = if columns == 1 { ABOVE } else { MARGINS.0 };
        let key = KeyBlock::new(&self.key, width - left);
        let is_free = !count.is_multiple_of(columns);
        let key_end = match is_free {
            true => panels_end,
            false => panels_end + key.height(),
        };
        let table = TableBlock::new(&self.table);
        let width = width.max(left + table.width() + PADDING);
        let mut drawing = Drawing::new(width, key_end + table.height());
        for (index, panel) in self.panels.iter().enumerate() {
            let letter = char::from(b'a' + (index % 26) as u8);
            let size = (panel_width, panel_height);
            draw_panel(&mut drawing, panel, corner(index), size, Some(letter));
        }
        if is_free {
            let [x, y] = corner(count);
            let free = KeyBlock::new(&self.key, panel_width);
            free.draw(&mut drawing, [x + ABOVE, y + MARGINS.2 - ABOVE]);
        } else {
            key.draw(&mut drawing, [left, panels_end]);
        }
        table.draw(&mut drawing, [left, key_end]);
        drawing
    }
}

/// A key in as many columns as there is room for.
struct KeyBlock<'a> {
    entries: &'a [(Sample, String)],
    column_width: f64,
    rows: usize,
}

impl<'a> KeyBlock<'a> {
    fn new(entries: &'a [(Sample, String)], width: f64) -> Self {
        let widths = entries
            .iter()
            .map(|(_, words)| text_width(words, TEXT_SIZE));
        let column_width = KEY_SAMPLE + KEY_SPACE + KEY_COLUMNS + widths.fold(0.0, f64::max);
        let columns = ((width + KEY_COLUMNS) / column_width).floor().max(1.0);
        Self {
            entries,
            column_width,
            rows: entries.len().div_ceil(columns as usize),
        }
    }

    /// Returns its height, with the distance from what stands above it.
    fn height(&self) -> f64 {
        match self.rows {
            0 => 0.0,
            rows => ABOVE + KEY_LINE * rows as f64,
        }
    }

    fn draw(&self, drawing: &mut Drawing, [left, top]: Place) {
        for (index, (sample, words)) in self.entries.iter().enumerate() {
            let (column, row) = (index / self.rows, index % self.rows);
            let x = left + column as f64 * self.column_width;
            let y = top + ABOVE + KEY_LINE * (row as f64 + 0.5);
            draw_entry(drawing, *sample, words, [x, y]);
        }
    }
}

/// A table with a line below its headings. Its first column is aligned to the left, the others to the right.
struct TableBlock<'a> {
    rows: &'a [Vec<String>],
    widths: Vec<f64>,
}

impl<'a> TableBlock<'a> {
    fn new(rows: &'a [Vec<String>]) -> Self {
        let columns = rows.first().map_or(0, Vec::len);
        let widths = (0..columns).map(|column| {
            let cells = rows.iter().filter_map(|row| row.get(column));
            let widths = cells.map(|words| text_width(words, TEXT_SIZE));
            widths.fold(0.0, f64::max)
        });
        Self {
            rows,
            widths: widths.collect(),
        }
    }

    /// Returns its height, with the distances from what stands above and below it.
    fn height(&self) -> f64 {
        match self.rows.len() {
            0 => 0.0,
            rows => ABOVE + KEY_LINE * rows as f64 + PADDING,
        }
    }

    fn width(&self) -> f64 {
        let spaces = self.widths.len().saturating_sub(1) as f64;
        self.widths.iter().sum::<f64>() + spaces * COLUMN_SPACE
    }

    fn draw(&self, drawing: &mut Drawing, [left, top]: Place) {
        for (line, row) in self.rows.iter().enumerate() {
            let y = top + ABOVE + KEY_LINE * (line as f64 + 0.75);
            let mut x = left;
            for (column, (words, width)) in row.iter().zip(&self.widths).enumerate() {
                match column {
                    0 => drawing.text(words, [x, y], TEXT_SIZE, Anchor::Start),
                    _ => drawing.text(words, [x + width, y], TEXT_SIZE, Anchor::End),
                }
                x += width + COLUMN_SPACE;
            }
            if line == 0 {
                let rule = top + ABOVE + KEY_LINE;
                drawing.line([[left, rule], [x - COLUMN_SPACE, rule]], FRAME);
            }
        }
    }
}
