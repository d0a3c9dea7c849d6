//! Marks for the measurements of the codes.

use super::axis::Axis;
use super::panel::{Panel, Point, Sample, Stroke};
use super::style::{GUIDE, Mark};
use crate::code::Code;
use crate::study::MAX_TOLERANCE;
use crate::study::yield_force::Judgement;

/// Range of shown errors; those below are drawn at its lower end.
const ERRORS: (f64, f64) = (1e-10, 3e-2);

/// The axis of F + 3.
pub(super) fn load_axis(range: (f64, f64)) -> Axis {
    Axis::log("load at yield F + 3 = (f + 3 m g)/(m g)", range)
}

/// The codes that have at least one row, in the order of [`Code::all`].
pub(super) fn present(judgements: &[Judgement]) -> Vec<Code> {
    let has_row = |code: &Code| judgements.iter().any(|own| own.code == *code);
    Code::all().into_iter().filter(has_row).collect()
}

/// Marks at F + 3 of every row with a yield force, except for variants of a code with the contacts of another.
pub(super) fn loads(panel: &mut Panel, judgements: &[Judgement], x: impl Fn(&Judgement) -> f64) {
    mark(panel, judgements, Mark::small, |row| {
        let shown = !row.code.repeats_another();
        Some((x(row), row.yield_force().filter(|_| shown)? + 3.0))
    });
}

/// A panel with |error| of every row and the largest tolerance.
pub(super) fn error_panel(
    axis: Axis,
    judgements: &[Judgement],
    x: impl Fn(&Judgement) -> f64,
) -> Panel {
    let label = "|F − F_{limit}|/(F_{limit} + 3)";
    let mut panel = Panel::new(axis, Axis::log(label, ERRORS));
    panel.level(GUIDE, MAX_TOLERANCE);
    panel.words_on("largest that agrees", MAX_TOLERANCE);
    mark(
        &mut panel,
        judgements,
        |mark| mark,
        |row| Some((x(row), row.error()?.abs())),
    );
    panel
}

/// Lists the codes of `judgements` in the key of `panel`.
pub(super) fn key(panel: &mut Panel, judgements: &[Judgement], (right, down): Point) {
    panel.key_at(right, down);
    for code in present(judgements) {
        name(panel, code);
    }
}

/// A sentence on the codes that [`loads`] leaves out, if there are any.
pub(super) fn left_out(judgements: &[Judgement]) -> String {
    let repeating = present(judgements).into_iter();
    let repeating = repeating.filter(|code| code.repeats_another());
    let names: Vec<String> = repeating.map(Code::label).collect();
    if names.is_empty() {
        return String::new();
    }
    format!(
        " Left out of (a), because another variant of the code has the same contacts: {}.",
        names.join("; ")
    )
}

/// Adds `code` to the key of `panel`.
pub(super) fn name(panel: &mut Panel, code: Code) {
    panel.key(Sample::Mark(Mark::of(code)), &code.label());
}

/// The runs of `code` as marks, joined by a line for the native DEM.
pub(super) fn runs(panel: &mut Panel, stroke: Stroke, code: Code, points: &[(f64, Option<f64>)]) {
    let points = points.iter().copied();
    if code == Code::NATIVE {
        panel.line(stroke, points.clone());
    }
    panel.marks(Mark::of(code), points.filter_map(|(x, y)| Some((x, y?))));
}

fn mark(
    panel: &mut Panel,
    judgements: &[Judgement],
    size: impl Fn(Mark) -> Mark,
    point: impl Fn(&Judgement) -> Option<Point>,
) {
    for code in present(judgements) {
        let own = judgements.iter();
        let own = own.filter(|row| row.code == code);
        panel.marks(size(Mark::of(code)), own.filter_map(&point));
    }
}
