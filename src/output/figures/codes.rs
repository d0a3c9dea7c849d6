//! What the codes measured, as marks.

use super::axis::Axis;
use super::panel::{Panel, Point, Sample};
use super::style::{GUIDE, Mark};
use crate::code::Code;
use crate::study::MAX_TOLERANCE;
use crate::study::yield_force::Judgement;

/// Errors below the lower end stand at it.
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

/// F + 3 of every row that has a yield force. Variants of a code that repeat the contacts of another are left out.
pub(super) fn loads(panel: &mut Panel, judgements: &[Judgement], x: impl Fn(&Judgement) -> f64) {
    mark(panel, judgements, Mark::small, |row| {
        let shown = !row.code.repeats_another();
        Some((x(row), row.yield_force().filter(|_| shown)? + 3.0))
    });
}

/// |error| of every row that has one, and the bar.
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

/// The marks of the codes, in the key of `panel`.
pub(super) fn key(panel: &mut Panel, judgements: &[Judgement], (right, down): Point) {
    panel.key_at(right, down);
    for code in present(judgements) {
        panel.key(Sample::Mark(Mark::of(code)), &code.label());
    }
}

/// The sentence on the codes of `judgements` that [`loads`] leaves out, if there are any.
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
