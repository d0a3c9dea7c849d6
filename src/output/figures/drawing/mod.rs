//! The one drawing layer: lines, areas, circles and text in pixels, written as SVG or as PDF.

mod font;
mod markup;
mod pdf;
mod svg;

/// A place in pixels, to the right of and below the upper left corner.
pub(super) type Place = [f64; 2];

/// A colour of the screen: red, green and blue.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Colour([u8; 3]);

impl Colour {
    /// The colour written as `#rrggbb`.
    pub const fn new(text: &str) -> Self {
        let text = text.as_bytes();
        let mut parts = [0; 3];
        let mut index = 1;
        while index < text.len() && index < 7 {
            let digit = match (text[index] as char).to_digit(16) {
                Some(digit) => digit as u8,
                None => 0,
            };
            let part = (index - 1) / 2;
            parts[part] = 16 * parts[part] + digit;
            index += 1;
        }
        Self(parts)
    }
}

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stroke {
    pub colour: Colour,
    pub width: f64,
    /// Lengths of dashes and gaps in pixels; solid if empty.
    pub dashes: &'static [f64],
}

impl Stroke {
    /// A line of `width` pixels.
    pub const fn new(colour: &str, width: f64, dashes: &'static [f64]) -> Self {
        Self {
            colour: Colour::new(colour),
            width,
            dashes,
        }
    }
}

/// Inside and outline of a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Paint {
    /// Colour of the inside, and how much it hides of what is behind it.
    fill: Option<(Colour, f64)>,
    stroke: Option<Stroke>,
}

impl Paint {
    /// An opaque inside without an outline.
    pub const fn filled(colour: Colour) -> Self {
        Self {
            fill: Some((colour, 1.0)),
            stroke: None,
        }
    }

    /// An outline alone.
    pub const fn outlined(stroke: Stroke) -> Self {
        Self {
            fill: None,
            stroke: Some(stroke),
        }
    }

    /// The same with an inside that hides only the part `opacity` of what is behind it.
    pub const fn with_tint(self, colour: Colour, opacity: f64) -> Self {
        Self {
            fill: Some((colour, opacity)),
            ..self
        }
    }
}

/// Which part of a text is at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// A line of text. In it `_x_` is one letter in italics and `_{…}` a subscript.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Text {
    words: String,
    place: Place,
    size: f64,
    anchor: Anchor,
    bold: bool,
    upwards: bool,
}

impl Text {
    /// Words that begin at `place`.
    pub fn new(words: impl Into<String>, place: impl Into<Place>, size: f64) -> Self {
        Self {
            words: words.into(),
            place: place.into(),
            size,
            anchor: Anchor::Start,
            bold: false,
            upwards: false,
        }
    }

    /// The same with another part at its place.
    pub fn at(self, anchor: Anchor) -> Self {
        Self { anchor, ..self }
    }

    /// The same in bold print.
    pub fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    /// The same, running from below upwards.
    pub fn upwards(self) -> Self {
        Self {
            upwards: true,
            ..self
        }
    }
}

#[derive(Debug, Clone, PartialEq)]
enum Element {
    Path {
        points: Vec<Place>,
        closed: bool,
        paint: Paint,
    },
    Circle {
        centre: Place,
        radius: f64,
        paint: Paint,
    },
    Text(Text),
}

/// A drawing on white.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Drawing {
    width: f64,
    height: f64,
    elements: Vec<Element>,
}

impl Drawing {
    /// An empty drawing.
    pub fn new(width: f64, height: f64) -> Self {
        Self {
            width: width.ceil(),
            height: height.ceil(),
            elements: Vec::new(),
        }
    }

    /// A line through `points`.
    pub fn line(&mut self, points: impl Into<Vec<Place>>, stroke: Stroke) {
        self.elements.push(Element::Path {
            points: points.into(),
            closed: false,
            paint: Paint::outlined(stroke),
        });
    }

    /// A polygon with its corners at `points`.
    pub fn polygon(&mut self, points: impl Into<Vec<Place>>, paint: Paint) {
        self.elements.push(Element::Path {
            points: points.into(),
            closed: true,
            paint,
        });
    }

    /// A circle.
    pub fn circle(&mut self, centre: Place, radius: f64, paint: Paint) {
        self.elements.push(Element::Circle {
            centre,
            radius,
            paint,
        });
    }

    /// A line of text.
    pub fn text(&mut self, text: Text) {
        self.elements.push(Element::Text(text));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_read_as_they_are_written_in_svg() {
        assert_eq!(Colour::new("#0072b2"), Colour([0x00, 0x72, 0xb2]));
        assert_eq!(Colour::new("#C98500"), Colour([0xc9, 0x85, 0x00]));
    }
}
