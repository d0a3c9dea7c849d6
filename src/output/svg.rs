//! The few shapes of SVG that a drawing of the stack needs, with numbers rounded to hundredths of a pixel.

use std::fmt::Write;

/// Colour of lines and text.
pub const INK: &str = "#222222";
const FONT: &str = "Helvetica, Arial, DejaVu Sans, sans-serif";
const HEAD: f64 = 8.0;

/// Which part of a text is at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Align {
    /// Its beginning.
    Start,
    /// Its middle.
    Middle,
}

/// A drawing on white, in pixels from the upper left corner.
pub struct Drawing {
    text: String,
}

impl Drawing {
    /// An empty drawing.
    pub fn new(width: f64, height: f64) -> Self {
        let (width, height) = (width.ceil(), height.ceil());
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"{FONT}\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n"
        );
        Self { text }
    }

    /// A straight line.
    pub fn line(&mut self, from: [f64; 2], to: [f64; 2], colour: &str, width: f64) {
        let (x1, y1, x2, y2) = (px(from[0]), px(from[1]), px(to[0]), px(to[1]));
        self.push(&format!(
            "<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\" stroke=\"{colour}\" stroke-width=\"{width}\"/>"
        ));
    }

    /// A circle, outlined in ink and filled so that what is behind shows through.
    pub fn circle(&mut self, centre: [f64; 2], radius: f64, colour: &str, opacity: f64) {
        let (x, y, radius) = (px(centre[0]), px(centre[1]), px(radius));
        self.push(&format!(
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" fill=\"{colour}\" fill-opacity=\"{opacity}\" \
             stroke=\"{INK}\" stroke-width=\"1.1\"/>"
        ));
    }

    /// An arrow with a filled or an open head; the head of a short arrow shrinks with it.
    pub fn arrow(&mut self, from: [f64; 2], to: [f64; 2], colour: &str, filled: bool) {
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let length = (dx * dx + dy * dy).sqrt();
        if length == 0.0 {
            return;
        }
        let (ux, uy) = (dx / length, dy / length);
        let head = HEAD.min(0.6 * length);
        let foot = [to[0] - head * ux, to[1] - head * uy];
        let half = 0.42 * head;
        let left = [foot[0] - half * uy, foot[1] + half * ux];
        let right = [foot[0] + half * uy, foot[1] - half * ux];
        self.line(from, if filled { foot } else { to }, colour, 2.0);
        let points = [left, to, right].map(|[x, y]| format!("{},{}", px(x), px(y)));
        let points = points.join(" ");
        self.push(&if filled {
            format!("<polygon points=\"{points}\" fill=\"{colour}\"/>")
        } else {
            format!("<polyline points=\"{points}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.6\"/>")
        });
    }

    /// A text, in which `_italics_` and `[subscripts]` are marked.
    pub fn text(&mut self, place: [f64; 2], align: Align, size: f64, text: &str) {
        let anchor = match align {
            Align::Start => "start",
            Align::Middle => "middle",
        };
        let (x, y) = (px(place[0]), px(place[1]));
        self.push(&format!(
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" text-anchor=\"{anchor}\" fill=\"{INK}\">{}</text>",
            marked_up(text)
        ));
    }

    /// The whole document.
    pub fn finish(mut self) -> String {
        self.push("</svg>");
        self.text
    }

    fn push(&mut self, element: &str) {
        writeln!(self.text, "{element}").expect("text is written to memory");
    }
}

/// Hundredths of a pixel, without a trailing zero or a negative one.
fn px(value: f64) -> String {
    let rounded = (value * 100.0).round() / 100.0 + 0.0;
    rounded.to_string()
}

fn marked_up(text: &str) -> String {
    let mut italic = false;
    let mut result = String::new();
    for character in text.chars() {
        match character {
            '_' => {
                italic = !italic;
                result += if italic {
                    "<tspan font-style=\"italic\">"
                } else {
                    "</tspan>"
                };
            }
            // What follows a subscript goes up again.
            '[' => result += "<tspan font-size=\"75%\" dy=\"3\">",
            ']' => result += "</tspan><tspan dy=\"-3\">\u{200b}</tspan>",
            '&' => result += "&amp;",
            '<' => result += "&lt;",
            '>' => result += "&gt;",
            other => result.push(other),
        }
    }
    if italic {
        result += "</tspan>";
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_stable() {
        assert_eq!(px(1.005_000_1), "1.01");
        assert_eq!(px(-0.001), "0");
        assert_eq!(px(12.0), "12");
    }

    #[test]
    fn text_is_escaped_and_its_marks_are_closed() {
        assert_eq!(marked_up("a < b & c"), "a &lt; b &amp; c");
        assert_eq!(marked_up("_f"), "<tspan font-style=\"italic\">f</tspan>");
    }
}
