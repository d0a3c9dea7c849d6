//! Figures of the atlas.

use super::axis::Axis;
use super::panel::{Anchor, Panel, Sample, draw_alone};
use super::style::{BODIES_STROKES, GUIDE, INK, Mark, POINT, STIFFNESS_STROKES, Shape, Stroke};
use crate::model::CRITICAL_FRICTION;
use crate::study::atlas::{ArmCurve, Spread, StiffnessLaw};

/// Size in pixels of the only panel of a figure.
const WIDE: (f64, f64) = (620.0, 380.0);
/// Size in pixels of the only panel of a figure that compares two versions.
const NARROW: (f64, f64) = (420.0, 280.0);

/// Strokes of conventions, in turn.
const STROKES: [Stroke; 6] = [
    BODIES_STROKES[0],
    BODIES_STROKES[1],
    BODIES_STROKES[2],
    BODIES_STROKES[3],
    Stroke::new("#9c4f86", 1.5, &[3.0, 2.0]),
    Stroke::new("#c98500", 1.5, &[6.0, 2.0, 1.5, 2.0, 1.5, 2.0]),
];

/// Draws the change of the yield force of one material under the arms of every code.
pub(crate) fn spread_svg(spread: &[Spread]) -> String {
    let forces = spread.iter().flat_map(|own| &own.points);
    let forces = forces.filter_map(|(_, change)| *change);
    let (low, high) = range(forces);
    let mut panel = Panel::new(
        Axis::friction(),
        Axis::around("change of the yield force in %", (low, high)),
    );
    panel.upright(GUIDE, CRITICAL_FRICTION);
    panel.key_at(0.03, 0.03);
    for (own, stroke) in spread.iter().zip(STROKES.iter().cycle()) {
        panel.line(*stroke, own.points.iter().copied());
        let arms = own.arms.map(|arm| arm.to_string().replace('-', "−"));
        panel.key(Sample::Line(*stroke), &arms.join(", "));
    }
    draw_alone(&panel, WIDE).svg()
}

/// Draws what one arm alone does to the yield force, with the codes on the curves.
pub(crate) fn arm_svg(key: &str, curves: &[ArmCurve]) -> String {
    let forces = curves.iter().flat_map(|own| &own.points);
    let forces = forces.map(|(_, change)| *change);
    let (low, high) = range(forces);
    let mut panel = Panel::new(
        Axis::linear(key, (-1.05, 0.05), 0.25, 2),
        Axis::around("change of the yield force in %", (low, high)),
    );
    panel.key_at(0.6, 0.03);
    for (own, stroke) in curves.iter().zip(STIFFNESS_STROKES) {
        panel.line(stroke, own.points.iter().copied());
        let mark = Mark {
            colour: stroke.colour,
            ..POINT
        };
        panel.marks(mark, own.codes.iter().copied());
        let words = format!(
            "μ = {}, stiffness {}",
            own.stack.floor_friction, own.stack.stiffness
        );
        panel.key(Sample::Line(stroke), &words);
    }
    draw_alone(&panel, WIDE).svg()
}

/// Draws a stiffness over the overlap, as the micro-tests of two versions have measured it.
pub(crate) fn stiffness_svg(name: &str, before: &StiffnessLaw, after: &StiffnessLaw) -> String {
    let laws = [before, after];
    let overlaps = (1..=60).map(|step| 0.3 * f64::from(step) / 60.0);
    let curves = laws.map(|law| -> Vec<(f64, f64)> {
        let points = overlaps.clone().map(|overlap| (overlap, law.at(overlap)));
        points.collect()
    });
    let values = curves.iter().flatten().map(|(_, stiffness)| *stiffness);
    let highest = values.fold(0.0, f64::max);
    let mut panel = Panel::new(
        Axis::linear("overlap/r", (0.0, 0.3), 0.1, 1),
        Axis::around(&format!("{name}/kₙ"), (0.0, 1.25 * highest)),
    );
    panel.key_at(0.05, 0.03);
    let strokes = [STIFFNESS_STROKES[0], STIFFNESS_STROKES[1]];
    for ((law, points), stroke) in laws.iter().zip(&curves).zip(strokes) {
        panel.line(stroke, points.iter().copied());
        panel.key(Sample::Line(stroke), &law.version);
    }
    draw_alone(&panel, NARROW).svg()
}

/// Draws values, printed beside their marks, in a row for each code or version.
pub(crate) fn values_svg(rows: &[(String, Vec<f64>)]) -> String {
    let (low, high) = range(rows.iter().flat_map(|(_, values)| values.iter().copied()));
    let (span, count) = (high - low, rows.len() as f64);
    // The words stand left of all values.
    let left = low - 1.1 * span;
    let mut panel = Panel::new(
        Axis::bare((left, high + 0.12 * span)),
        Axis::bare((-count - 0.6, -0.4)),
    );
    panel.upright(GUIDE, 0.0);
    let mark = Mark {
        shape: Shape::Circle,
        colour: INK,
        size: 3.2,
    };
    for (index, (words, values)) in rows.iter().enumerate() {
        let y = -(index as f64 + 1.0);
        // An underscore would begin a subscript.
        panel.words(
            words.replace('_', " "),
            (left + 0.02 * span, y - 0.2),
            Anchor::Start,
        );
        panel.marks(mark, values.iter().map(|value| (*value, y)));
        let mut printed = f64::NEG_INFINITY;
        let mut values = values.clone();
        values.sort_by(f64::total_cmp);
        for value in values {
            if value - printed > 0.2 * span {
                let rounded = (value * 1e4).round() / 1e4 + 0.0;
                let number = rounded.to_string().replace('-', "−");
                panel.words(number, (value + 0.025 * span, y - 0.2), Anchor::Start);
                printed = value;
            }
        }
    }
    draw_alone(&panel, (WIDE.0, 74.0 + 17.0 * count)).svg()
}

/// Returns the range of `values` and 0, with a margin.
fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = values.fold((0.0, 0.0), |(low, high): (f64, f64), value| {
        (low.min(value), high.max(value))
    });
    // A wide margin hides the rounding of values that are otherwise 0.
    let margin = match high - low {
        span if span < 1e-6 => 1.0,
        span => 0.25 * span,
    };
    (low - margin, high + margin)
}
