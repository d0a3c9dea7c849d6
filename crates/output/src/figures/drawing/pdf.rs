//! A drawing as a PDF page of its size, with letters as outlines, so that every machine writes the same bytes.

use super::font::Font;
use super::markup::spans;
use super::{Anchor, Drawing, Element, Paint, Place, Setting, Stroke, TINT, Text};
use crate::figures::style::INK;
use pdf_writer::writers::ExtGraphicsState;
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref};

/// Points in a pixel: an SVG has 96 pixels to the inch, a PDF 72 points.
const POINTS: f32 = 0.75;
/// Distance of the control points of a quarter of a circle from its ends, in radii.
const QUARTER: f64 = 0.552_284_75;
const CATALOGUE: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const PAGE: Ref = Ref::new(3);
const CONTENT: Ref = Ref::new(4);
/// The graphics state for tints.
const TINTED: Name = Name(b"Tinted");

impl Drawing {
    /// Returns the drawing as a PDF: the same bytes for the same drawing on every machine.
    pub fn pdf(&self) -> Vec<u8> {
        let (width, height) = (self.width as f32 * POINTS, self.height as f32 * POINTS);
        let mut content = Content::new();
        content.transform([POINTS, 0.0, 0.0, -POINTS, 0.0, height]);
        for element in &self.elements {
            draw(&mut content, element);
        }
        document(content, Rect::new(0.0, 0.0, width, height))
    }
}

/// Returns a PDF of one page.
fn document(content: Content, size: Rect) -> Vec<u8> {
    let mut pdf = Pdf::new();
    pdf.catalog(CATALOGUE).pages(PAGES);
    pdf.pages(PAGES).kids([PAGE]).count(1);
    let mut page = pdf.page(PAGE);
    page.media_box(size).parent(PAGES).contents(CONTENT);
    let mut resources = page.resources();
    let mut states = resources.ext_g_states();
    let mut tinted = states.insert(TINTED).start::<ExtGraphicsState>();
    tinted.non_stroking_alpha(TINT as f32);
    tinted.finish();
    states.finish();
    resources.finish();
    page.finish();
    let content = miniz_oxide::deflate::compress_to_vec_zlib(&content.finish(), 6);
    pdf.stream(CONTENT, &content).filter(Filter::FlateDecode);
    pdf.finish()
}

fn draw(content: &mut Content, element: &Element) {
    match element {
        Element::Path(points, closed, paint) => {
            draw_shape(content, *paint, |content| trace(content, points, *closed));
        }
        Element::Circle(centre, radius, paint) => {
            draw_shape(content, *paint, |content| {
                trace_circle(content, *centre, *radius);
            });
        }
        Element::Text(text) => draw_text(content, text),
    }
}

fn draw_shape(content: &mut Content, paint: Paint, trace: impl Fn(&mut Content)) {
    content.save_state();
    if let Some((colour, opacity)) = paint.fill() {
        if opacity < 1.0 {
            content.set_parameters(TINTED);
        }
        let [red, green, blue] = parts(colour);
        content.set_fill_rgb(red, green, blue);
        trace(content);
        content.fill_nonzero();
    }
    if let Some(stroke) = paint.stroke() {
        set_stroke(content, stroke);
        trace(content);
        content.stroke();
    }
    content.restore_state();
}

fn draw_text(content: &mut Content, text: &Text) {
    let bold = text.setting == Setting::Bold;
    let words = spans(&text.words).into_iter().map(|(style, words)| {
        let (scale, drop) = style.size_and_drop();
        (
            Font::new(style, bold),
            scale * text.size,
            drop as f32,
            words,
        )
    });
    let words: Vec<_> = words.collect();
    let widths = words
        .iter()
        .map(|(font, size, _, words)| size * font.width(words));
    let [red, green, blue] = parts(INK);
    content.save_state();
    content.set_fill_rgb(red, green, blue);
    content.transform(matrix(text, widths.sum()));
    for (font, size, drop, words) in words {
        content.transform([1.0, 0.0, 0.0, 1.0, 0.0, -drop]);
        font.draw(content, &words, size);
        content.transform([1.0, 0.0, 0.0, 1.0, 0.0, drop]);
    }
    content.restore_state();
}

/// Returns the coordinate system of a text of some width: its directions along and up and its start, in pixels to the
/// right and down.
fn matrix(text: &Text, width: f64) -> [f32; 6] {
    let before = match text.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => 0.5 * width,
        Anchor::End => width,
    };
    let [x, y] = text.place;
    match text.setting {
        Setting::Upwards => [0.0, -1.0, -1.0, 0.0, x as f32, (y + before) as f32],
        Setting::Normal | Setting::Bold => [1.0, 0.0, 0.0, -1.0, (x - before) as f32, y as f32],
    }
}

fn trace(content: &mut Content, points: &[Place], closed: bool) {
    for (index, &[x, y]) in points.iter().enumerate() {
        let (x, y) = (x as f32, y as f32);
        if index == 0 {
            content.move_to(x, y);
        } else {
            content.line_to(x, y);
        }
    }
    if closed {
        content.close_path();
    }
}

/// Traces a circle of four Bézier curves, at most 3e-4 of its radius off.
fn trace_circle(content: &mut Content, [x, y]: Place, radius: f64) {
    let at = |right: f64, down: f64| ((x + radius * right) as f32, (y + radius * down) as f32);
    let (from_x, from_y) = at(1.0, 0.0);
    content.move_to(from_x, from_y);
    for (right, down) in [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)] {
        let (x1, y1) = at(right - QUARTER * down, down + QUARTER * right);
        let (x2, y2) = at(QUARTER * right - down, QUARTER * down + right);
        let (x3, y3) = at(-down, right);
        content.cubic_to(x1, y1, x2, y2, x3, y3);
    }
    content.close_path();
}

fn set_stroke(content: &mut Content, stroke: Stroke) {
    let [red, green, blue] = parts(stroke.colour);
    let dashes = stroke.dashes.iter().map(|&length| length as f32);
    content
        .set_stroke_rgb(red, green, blue)
        .set_line_width(stroke.width as f32)
        .set_dash_pattern(dashes, 0.0);
}

/// Returns red, green and blue of `#rrggbb` as fractions of one.
fn parts(colour: &str) -> [f32; 3] {
    let part = |at: usize| u8::from_str_radix(colour.get(at..at + 2).unwrap_or("00"), 16);
    [1, 3, 5].map(|at| f32::from(part(at).unwrap_or(0)) / 255.0)
}
