//! Arrows, numbers and a legend, for pictures of cylinders and of spheres.

use crate::figures::drawing::{Anchor, Drawing, Paint, Place, Stroke, text_width};
use crate::figures::style::{KEY_SPACE, NORMAL_FORCE, TANGENTIAL_FORCE};
use crate::series::{ContactPoint, Partner};
use crate::significant;

/// Length of the arrow of the largest force of a panel, in r.
pub(super) const LONGEST_ARROW: f64 = 1.0;
/// Forces below this part of the largest are not drawn.
pub(super) const SMALLEST_SHARE: f64 = 0.02;
pub(super) const TITLE_HEIGHT: f64 = 44.0;
pub(super) const FOOT_HEIGHT: f64 = 62.0;
pub(super) const CAPTION_LINE: f64 = 15.0;
/// Length of the head of an arrow, in pixels.
const HEAD: f64 = 8.0;
pub(super) const SMALL: f64 = 11.0;
pub(super) const MEDIUM: f64 = 12.0;
pub(super) const LARGE: f64 = 14.0;

pub(super) fn largest_force<'a>(contacts: impl IntoIterator<Item = &'a ContactPoint>) -> f64 {
    let contacts = contacts.into_iter();
    let forces = contacts.flat_map(|own| [own.normal_force.abs(), own.tangential_force.abs()]);
    forces.fold(0.0, f64::max)
}

/// The left edge of a legend, and the length of its arrows.
const LEGEND: (f64, f64) = (12.0, 28.0);

/// Returns the entries of the legend for a body of this name: the stroke of the arrow, its words, and its x where all
/// entries stand on one line.
fn legend_entries(body: &str) -> [(Stroke, String, f64); 2] {
    let tangential =
        format!("tangential force on each {body}, from the contact inwards; numbers in _m_ _g_");
    [
        (NORMAL_FORCE, "normal force".to_owned(), LEGEND.0),
        (TANGENTIAL_FORCE, tangential, 130.0),
    ]
}

/// Returns the number of lines of a legend on a drawing of some width: its entries share one line if there is room,
/// else the words of the second entry take two.
pub(super) fn legend_lines(body: &str, width: f64) -> usize {
    let [_, (_, words, left)] = legend_entries(body);
    let end = left + LEGEND.1 + KEY_SPACE + text_width(&words, SMALL);
    if end <= width { 1 } else { 3 }
}

/// Draws samples of both kinds of arrows, for a body of this name.
pub(super) fn legend(drawing: &mut Drawing, body: &str, y: f64, width: f64) {
    let one_line = legend_lines(body, width) == 1;
    let mut line = y;
    for (stroke, words, left) in legend_entries(body) {
        let left = if one_line { left } else { LEGEND.0 };
        let middle = line - 3.5;
        arrow(drawing, [[left, middle], [left + LEGEND.1, middle]], stroke);
        let beside = left + LEGEND.1 + KEY_SPACE;
        let pieces: Vec<&str> = match one_line {
            true => vec![words.as_str()],
            false => words.split_inclusive(", ").collect(),
        };
        for piece in pieces {
            drawing.text(piece, [beside, line], SMALL, Anchor::Start);
            line += if one_line { 0.0 } else { CAPTION_LINE };
        }
    }
}

/// Draws an arrow with a filled head for a normal force, an open one for a tangential force. The head of a short
/// arrow shrinks with it.
pub(super) fn arrow(drawing: &mut Drawing, [from, to]: [Place; 2], stroke: Stroke) {
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let length = (dx * dx + dy * dy).sqrt();
    if length == 0.0 {
        return;
    }
    let head = HEAD.min(0.6 * length);
    let along = [dx / length, dy / length];
    let across = [-along[1], along[0]];
    let foot = shifted(to, along, -head);
    let [left, right] = [0.42, -0.42].map(|share| shifted(foot, across, share * head));
    if stroke == NORMAL_FORCE {
        drawing.line([from, foot], stroke);
        drawing.polygon([left, to, right], Paint::Filled(stroke.colour));
    } else {
        drawing.line([from, to], stroke);
        let thinner = Stroke {
            width: 1.6,
            ..stroke
        };
        drawing.line([left, to, right], thinner);
    }
}

/// Returns the letters of normal and tangential force in the paper's figure; `top` is the index of the body on top.
pub(super) fn letters(partner: Partner, top: usize) -> (&'static str, &'static str) {
    match partner {
        Partner::Body(index) if index == top => ("a", "b"),
        Partner::Body(_) => ("c", ""),
        Partner::Floor => ("d", "e"),
        Partner::TopWall => ("f", ""),
    }
}

pub(super) fn shifted(from: Place, direction: Place, by: f64) -> Place {
    [from[0] + by * direction[0], from[1] + by * direction[1]]
}

/// Returns the largest of 1, 2, 5 times a power of ten that is not above `value`.
pub(super) fn round_below(value: f64) -> f64 {
    let power = libm::exp10(libm::floor(libm::log10(value)));
    let round = [5.0, 2.0, 1.0]
        .into_iter()
        .find(|digit| digit * power <= value * (1.0 + 1e-12));
    // A power of ten below 1 is not exact; formatting and parsing it gives the nearest double.
    let exact = format!("{:.0e}", round.unwrap_or(1.0) * power);
    exact.parse().unwrap_or(value)
}

/// Formats a force in m g with three or four digits, as zero where it is round-off.
pub(super) fn number(weights: f64) -> String {
    if weights.abs() < 5e-4 {
        return "0".to_owned();
    }
    significant(weights, if weights.abs() < 1.0 { 3 } else { 4 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scale_bars_are_round() {
        for (value, round) in [
            (15.6, 10.0),
            (0.58, 0.5),
            (2.0, 2.0),
            (1e3, 1e3),
            (0.0299, 0.02),
        ] {
            assert_eq!(round_below(value), round);
        }
    }
}
