//! A drawing as SVG, with numbers rounded to hundredths of a pixel.

use super::markup::{Style, spans};
use super::{Anchor, Drawing, Element, Paint, Place, Setting, Text};
use crate::figures::style::{FONT_FAMILY, INK};

impl Drawing {
    /// Returns the drawing as SVG: the same bytes for the same drawing.
    pub fn svg(&self) -> String {
        let (width, height) = (self.width, self.height);
        let elements: Vec<String> = self.elements.iter().map(element).collect();
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"{FONT_FAMILY}\" fill=\"{INK}\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n{}\n</svg>\n",
            elements.join("\n")
        )
    }
}

fn element(element: &Element) -> String {
    match element {
        Element::Path(points, closed, paint) => {
            let name = if *closed { "polygon" } else { "polyline" };
            format!("<{name} points=\"{}\"{}/>", path(points), painted(*paint))
        }
        Element::Circle([x, y], radius, paint) => {
            let (x, y, radius) = (px(*x), px(*y), px(*radius));
            let painted = painted(*paint);
            format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"{painted}/>")
        }
        Element::Text(text) => text_element(text),
    }
}

fn path(points: &[Place]) -> String {
    let points = points.iter().map(|&[x, y]| format!("{},{}", px(x), px(y)));
    points.collect::<Vec<_>>().join(" ")
}

/// Returns the attributes of fill and stroke.
fn painted(paint: Paint) -> String {
    let mut attributes = match paint.fill() {
        None => " fill=\"none\"".to_owned(),
        Some((colour, 1.0)) => format!(" fill=\"{colour}\""),
        Some((colour, opacity)) => format!(" fill=\"{colour}\" fill-opacity=\"{opacity}\""),
    };
    if let Some(stroke) = paint.stroke() {
        let (colour, width) = (stroke.colour, stroke.width);
        attributes += &format!(" stroke=\"{colour}\" stroke-width=\"{width}\"");
        if !stroke.dashes.is_empty() {
            let dashes: Vec<String> = stroke.dashes.iter().map(f64::to_string).collect();
            attributes += &format!(" stroke-dasharray=\"{}\"", dashes.join(" "));
        }
    }
    attributes
}

fn text_element(text: &Text) -> String {
    let anchor = match text.anchor {
        Anchor::Start => "start",
        Anchor::Middle => "middle",
        Anchor::End => "end",
    };
    let (x, y, size) = (px(text.place[0]), px(text.place[1]), text.size);
    let setting = match text.setting {
        Setting::Normal => String::new(),
        Setting::Bold => " font-weight=\"bold\"".to_owned(),
        Setting::Upwards => format!(" transform=\"rotate(-90,{x},{y})\""),
    };
    let content = content(&text.words);
    format!(
        "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" text-anchor=\"{anchor}\"{setting}>{content}</text>"
    )
}

fn content(text: &str) -> String {
    let mut lowered = 0.0;
    let mut content = String::new();
    for (style, words) in spans(text) {
        let (size, drop) = style.size_and_drop();
        let mut attributes = String::new();
        if drop != lowered {
            attributes += &format!(" dy=\"{}\"", drop - lowered);
        }
        lowered = drop;
        if style == Style::Italic {
            attributes += " font-style=\"italic\"";
        }
        if size != 1.0 {
            attributes += &format!(" font-size=\"{}%\"", 100.0 * size);
        }
        let words = escaped(&words);
        content += &if attributes.is_empty() {
            words
        } else {
            format!("<tspan{attributes}>{words}</tspan>")
        };
    }
    content
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

/// Rounds a number of pixels to hundredths, without trailing zeros or a negative zero.
fn px(value: f64) -> String {
    let rounded = (value * 100.0).round() / 100.0 + 0.0;
    rounded.to_string()
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
    fn text_is_escaped_and_what_follows_a_subscript_goes_up_again() {
        assert_eq!(content("a < b & c"), "a &lt; b &amp; c");
        assert_eq!(
            content("|F_{limit}| _f_"),
            "|F<tspan dy=\"3\" font-size=\"75%\">limit</tspan><tspan dy=\"-3\">| </tspan>\
             <tspan font-style=\"italic\">f</tspan>"
        );
    }
}
