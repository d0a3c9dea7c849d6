//! DejaVu Sans, whose outlines a PDF draws.

use super::markup::{Style, spans};
use pdf_writer::Content;
use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// One face of the font.
pub(super) struct Font(Face<'static>);

impl Font {
    /// The face for `style`.
    pub fn new(style: Style, bold: bool) -> Self {
        let data = match (style, bold) {
            (_, true) => dejavu::sans::bold(),
            (Style::Italic, false) => dejavu::sans::oblique(),
            (_, false) => dejavu::sans::regular(),
        };
        Self(Face::parse(data, 0).expect("the font is part of the program"))
    }

    /// Returns one glyph per character; a character that the font lacks becomes an empty box.
    fn glyphs(&self, text: &str) -> impl Iterator<Item = GlyphId> {
        let glyphs = text.chars().map(|character| self.0.glyph_index(character));
        glyphs.map(Option::unwrap_or_default)
    }

    /// Returns the width of a glyph in multiples of the font size.
    fn advance(&self, glyph: GlyphId) -> f64 {
        let advance = self.0.glyph_hor_advance(glyph).unwrap_or(0);
        f64::from(advance) / f64::from(self.0.units_per_em())
    }

    /// Returns the width of `text` in multiples of the font size.
    pub fn width(&self, text: &str) -> f64 {
        self.glyphs(text).map(|glyph| self.advance(glyph)).sum()
    }

    /// Draws `text` from the origin to the right, `size` high, and moves the origin behind it.
    pub fn draw(&self, content: &mut Content, text: &str, size: f64) {
        let scale = (size / f64::from(self.0.units_per_em())) as f32;
        for glyph in self.glyphs(text) {
            content.save_state();
            content.transform([scale, 0.0, 0.0, scale, 0.0, 0.0]);
            let mut pen = Pen {
                content,
                place: (0.0, 0.0),
            };
            if self.0.outline_glyph(glyph, &mut pen).is_some() {
                content.fill_nonzero();
            }
            content.restore_state();
            let step = (size * self.advance(glyph)) as f32;
            content.transform([1.0, 0.0, 0.0, 1.0, step, 0.0]);
        }
    }
}

/// Returns the width in pixels of a line of text of `size`, whose marks set its styles.
pub(in crate::figures) fn text_width(text: &str, size: f64) -> f64 {
    let parts = spans(text).into_iter();
    let widths = parts.map(|(style, words)| {
        let (scale, _) = style.size_and_drop();
        scale * size * Font::new(style, false).width(&words)
    });
    widths.sum()
}

/// Traces an outline on a page.
struct Pen<'a> {
    content: &'a mut Content,
    place: (f32, f32),
}

impl OutlineBuilder for Pen<'_> {
    fn move_to(&mut self, x: f32, y: f32) {
        self.content.move_to(x, y);
        self.place = (x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.content.line_to(x, y);
        self.place = (x, y);
    }

    /// Draws the same curve as one of the third order, the only kind that a PDF has.
    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let towards = |end: f32, control: f32| end + (control - end) * 2.0 / 3.0;
        let (from_x, from_y) = self.place;
        let (x1, y1, x2, y2) = (
            towards(from_x, x1),
            towards(from_y, y1),
            towards(x, x1),
            towards(y, y1),
        );
        self.curve_to(x1, y1, x2, y2, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.content.cubic_to(x1, y1, x2, y2, x, y);
        self.place = (x, y);
    }

    fn close(&mut self) {
        self.content.close_path();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_letters_of_the_figures_are_in_the_font() {
        let regular = Font::new(Style::Plain, false);
        let letters = "aµμκεβθΔℓ₀ₙₜ₁₂⁰¹²³⁴⁵⁶⁷⁸⁹⁻−–√→½∝·’…|*";
        assert!(regular.glyphs(letters).all(|glyph| glyph.0 != 0));
        assert!(regular.glyphs("\u{10ffff}").eq([GlyphId(0)]));
    }

    #[test]
    fn widths_are_those_of_the_font() {
        // Of 2048 units, i is 569 wide and f 721.
        let width = Font::new(Style::Plain, false).width("if");
        assert!((width - (569.0 + 721.0) / 2048.0).abs() < 1e-6);
    }
}
