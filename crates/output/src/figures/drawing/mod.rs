//! Drawings of lines, areas, circles and text in pixels, written as SVG or as PDF.

mod font;
mod markup;
mod pdf;
mod svg;

pub(super) use font::text_width;

/// A place in pixels, to the right of and below the upper left corner.
pub(super) type Place = [f64; 2];

/// The style of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stroke {
    /// As `#rrggbb`.
    pub colour: &'static str,
    pub width: f64,
    /// Lengths of dashes and gaps in pixels; solid if empty.
    pub dashes: &'static [f64],
}

impl Stroke {
    /// A line of `width` pixels.
    pub const fn new(colour: &'static str, width: f64, dashes: &'static [f64]) -> Self {
        Self {
            colour,
            width,
            dashes,
        }
    }
}

/// The inside and the outline of a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Paint {
    /// An opaque inside, as `#rrggbb`.
    Filled(&'static str),
    /// An outline alone.
    Outlined(Stroke),
    /// An outline, and a translucent inside of this colour.
    Tinted(Stroke, &'static str),
}

impl Paint {
    /// Returns colour and opacity of the inside.
    fn fill(self) -> Option<(&'static str, f64)> {
        match self {
            Self::Filled(colour) => Some((colour, 1.0)),
            Self::Outlined(_) => None,
            Self::Tinted(_, colour) => Some((colour, TINT)),
        }
    }

    fn stroke(self) -> Option<Stroke> {
        match self {
            Self::Filled(_) => None,
            Self::Outlined(stroke) | Self::Tinted(stroke, _) => Some(stroke),
        }
    }
}

/// Opacity of a tint.
const TINT: f64 = 0.22;

/// The part of a text that is at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// Weight and direction of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Setting {
    Normal,
    Bold,
    /// Turned, to be read upwards.
    Upwards,
}

#[derive(Debug, Clone, PartialEq)]
struct Text {
    words: String,
    place: Place,
    size: f64,
    anchor: Anchor,
    setting: Setting,
}

#[derive(Debug, Clone, PartialEq)]
enum Element {
    /// A line or, if it is closed, a polygon.
    Path(Vec<Place>, bool, Paint),
    /// A circle: centre and radius.
    Circle(Place, f64, Paint),
    Text(Text),
}

/// A drawing on white. In its texts `_x_` is one letter in italics and `_{…}` a subscript.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Drawing {
    width: f64,
    height: f64,
    elements: Vec<Element>,
}

impl Drawing {
    pub fn new(width: f64, height: f64) -> Self {
        Self {
            width: width.ceil(),
            height: height.ceil(),
            elements: Vec::new(),
        }
    }

    /// Adds a line through `points`.
    pub fn line(&mut self, points: impl Into<Vec<Place>>, stroke: Stroke) {
        let path = Element::Path(points.into(), false, Paint::Outlined(stroke));
        self.elements.push(path);
    }

    /// Adds a polygon with its corners at `points`.
    pub fn polygon(&mut self, points: impl Into<Vec<Place>>, paint: Paint) {
        let path = Element::Path(points.into(), true, paint);
        self.elements.push(path);
    }

    pub fn circle(&mut self, centre: Place, radius: f64, paint: Paint) {
        self.elements.push(Element::Circle(centre, radius, paint));
    }

    /// Adds a line of text.
    pub fn text(&mut self, words: impl ToString, place: Place, size: f64, anchor: Anchor) {
        self.set(words, place, size, anchor, Setting::Normal);
    }

    /// Adds a line of text, set in bold print or upwards.
    pub fn set(
        &mut self,
        words: impl ToString,
        place: Place,
        size: f64,
        anchor: Anchor,
        setting: Setting,
    ) {
        self.elements.push(Element::Text(Text {
            words: words.to_string(),
            place,
            size,
            anchor,
            setting,
        }));
    }
}
