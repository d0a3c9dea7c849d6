//! DejaVu Sans, of which a PDF embeds the glyphs that it uses.

use super::markup::Style;
use pdf_writer::types::{CidFontType, FontFlags, SystemInfo, UnicodeCmap};
use pdf_writer::{Filter, Finish, Name, Pdf, Rect, Ref, Str};
use std::collections::BTreeMap;
use subsetter::GlyphRemapper;
use ttf_parser::{Face, GlyphId};

const IDENTITY: SystemInfo = SystemInfo {
    registry: Str(b"Adobe"),
    ordering: Str(b"Identity"),
    supplement: 0,
};
/// Number of PDF objects of a font.
pub(super) const OBJECTS: usize = 5;
/// Thickness of the stems of DejaVu Sans, in thousandths of its size.
const STEM: f32 = 90.0;

/// One face of the font, and its glyphs in use.
pub(super) struct Font {
    /// Its name in the PDF, with the prefix of six letters that marks a subset.
    name: &'static str,
    data: &'static [u8],
    face: Face<'static>,
    glyphs: GlyphRemapper,
    /// The characters of the glyphs, by number in the embedded font.
    used: BTreeMap<u16, char>,
}

/// The faces in use.
pub(super) struct Fonts([Font; 3]);

impl Fonts {
    pub fn new() -> Self {
        Self([
            Font::new("GLYPHS+DejaVuSans", dejavu::sans::regular()),
            Font::new("GLYPHS+DejaVuSans-Oblique", dejavu::sans::oblique()),
            Font::new("GLYPHS+DejaVuSans-Bold", dejavu::sans::bold()),
        ])
    }

    /// The number of the face for `style`.
    pub fn index(style: Style, bold: bool) -> usize {
        match (style, bold) {
            (_, true) => 2,
            (Style::Italic, false) => 1,
            (Style::Plain | Style::Subscript, false) => 0,
        }
    }

    pub fn get(&mut self, index: usize) -> &mut Font {
        &mut self.0[index]
    }

    /// The faces that were used, with their numbers.
    pub fn used(&self) -> impl Iterator<Item = (usize, &Font)> {
        let fonts = self.0.iter().enumerate();
        fonts.filter(|(_, font)| !font.used.is_empty())
    }
}

impl Font {
    fn new(name: &'static str, data: &'static [u8]) -> Self {
        Self {
            name,
            data,
            face: Face::parse(data, 0).expect("the font is part of the program"),
            glyphs: GlyphRemapper::new(),
            used: BTreeMap::new(),
        }
    }

    /// `text` as glyph numbers of the embedded font, and its width in multiples of the font size. A character that the
    /// font lacks becomes an empty box.
    pub fn encode(&mut self, text: &str) -> (Vec<u8>, f64) {
        let (mut numbers, mut width) = (Vec::new(), 0.0);
        for character in text.chars() {
            let glyph = self.face.glyph_index(character).unwrap_or_default();
            let number = self.glyphs.remap(glyph.0);
            self.used.entry(number).or_insert(character);
            numbers.extend(number.to_be_bytes());
            width += f64::from(self.advance(glyph.0)) / 1000.0;
        }
        (numbers, width)
    }

    /// Writes the font as the objects from `first` on; pages refer to the first of them.
    pub fn write(&self, pdf: &mut Pdf, first: i32) {
        let objects: [Ref; OBJECTS] = std::array::from_fn(|index| Ref::new(first + index as i32));
        let [composite, glyphs, descriptor, file, unicode] = objects;
        let name = Name(self.name.as_bytes());
        pdf.type0_font(composite)
            .base_font(name)
            .encoding_predefined(Name(b"Identity-H"))
            .descendant_font(glyphs)
            .to_unicode(unicode);
        let mut glyph_font = pdf.cid_font(glyphs);
        glyph_font
            .subtype(CidFontType::Type2)
            .base_font(name)
            .system_info(IDENTITY)
            .font_descriptor(descriptor)
            .cid_to_gid_map_predefined(Name(b"Identity"));
        glyph_font.widths().consecutive(
            0,
            self.glyphs.remapped_gids().map(|glyph| self.advance(glyph)),
        );
        glyph_font.finish();
        self.describe(pdf, descriptor, name, file);
        let subset = subsetter::subset(self.data, 0, &self.glyphs)
            .expect("the font is part of the program, and the glyphs are its own");
        pdf.stream(file, &compressed(&subset))
            .filter(Filter::FlateDecode);
        let mut map = UnicodeCmap::new(Name(b"Custom"), IDENTITY);
        for (&number, &character) in &self.used {
            map.pair(number, character);
        }
        pdf.cmap(unicode, &map.finish());
    }

    fn describe(&self, pdf: &mut Pdf, place: Ref, name: Name, file: Ref) {
        let face = &self.face;
        let part = |length: i16| f32::from(length) * 1000.0 / f32::from(face.units_per_em());
        let bounds = face.global_bounding_box();
        let (left, bottom) = (part(bounds.x_min), part(bounds.y_min));
        let (right, top) = (part(bounds.x_max), part(bounds.y_max));
        let mut flags = FontFlags::SYMBOLIC;
        flags.set(FontFlags::ITALIC, face.is_oblique());
        pdf.font_descriptor(place)
            .name(name)
            .flags(flags)
            .bbox(Rect::new(left, bottom, right, top))
            .italic_angle(face.italic_angle())
            .ascent(part(face.ascender()))
            .descent(part(face.descender()))
            .cap_height(part(face.capital_height().unwrap_or(face.ascender())))
            .stem_v(STEM)
            .font_file2(file);
    }

    /// The width of a glyph in thousandths of the font size.
    fn advance(&self, glyph: u16) -> f32 {
        let advance = self.face.glyph_hor_advance(GlyphId(glyph)).unwrap_or(0);
        f32::from(advance) * 1000.0 / f32::from(self.face.units_per_em())
    }
}

/// `data` as a zlib stream, the same on every machine.
pub(super) fn compressed(data: &[u8]) -> Vec<u8> {
    miniz_oxide::deflate::compress_to_vec_zlib(data, 6)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_letters_of_the_figures_are_in_the_font() {
        let [mut regular, ..] = Fonts::new().0;
        regular.encode("aµμκεβθΔℓ₀ₙₜ₁₂⁰¹²³⁴⁵⁶⁷⁸⁹⁻−–√→½∝·’…|*");
        assert!(!regular.used.contains_key(&0));
        let (lacking, _) = regular.encode("\u{10ffff}");
        assert_eq!(lacking, [0, 0]);
    }

    #[test]
    fn widths_are_those_of_the_font() {
        let [mut regular, ..] = Fonts::new().0;
        let (numbers, width) = regular.encode("if");
        assert_eq!(numbers, [0, 1, 0, 2]);
        // Of 2048 units, i is 569 wide and f 721.
        assert!((width - (569.0 + 721.0) / 2048.0).abs() < 1e-6);
    }
}
