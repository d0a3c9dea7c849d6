//! What the codes measured, as marks.

use super::axis::Axis;
use super::panel::{Panel, Point, Sample};
use super::style::{GUIDE, Mark, engine_label};
use crate::crosscheck::{BAR, Judgement, Row};
use crate::engine::EngineName;

/// Errors below the lower end stand at it.
const ERRORS: (f64, f64) = (1e-10, 3e-2);

/// The axis of F + 3.
pub(super) fn load_axis(range: (f64, f64)) -> Axis {
    Axis::log("load at yield F + 3 = (f + 3 m g)/(m g)", range)
}

/// The codes that have at least one row, in the order of [`EngineName::ALL`].
pub(super) fn present(judgements: &[Judgement]) -> Vec<EngineName> {
    let has_row = |engine: &EngineName| judgements.iter().any(|own| own.row.engine == *engine);
    EngineName::ALL.into_iter().filter(has_row).collect()
}

/// F + 3 of every row that has a yield force. YADE's facets are left out: they do what its box does.
pub(super) fn loads(panel: &mut Panel, judgements: &[Judgement], x: impl Fn(&Row) -> f64) {
    mark(panel, judgements, Mark::small, |row| {
        let shown = row.engine != EngineName::YadeFacet;
        Some((x(row), row.yield_force.filter(|_| shown)? + 3.0))
    });
}

/// |error| of every row that has one, and the bar.
pub(super) fn error_panel(axis: Axis, judgements: &[Judgement], x: impl Fn(&Row) -> f64) -> Panel {
    let label = "|F − F_{limit}|/(F_{limit} + 3)";
    let mut panel = Panel::new(axis, Axis::log(label, ERRORS));
    panel.level(GUIDE, BAR);
    panel.words_on("largest that agrees", BAR);
    mark(
        &mut panel,
        judgements,
        |mark| mark,
        |row| Some((x(row), row.error?.abs())),
    );
    panel
}

/// The marks of the codes, in the key of `panel`.
pub(super) fn key(panel: &mut Panel, judgements: &[Judgement], (right, down): Point) {
    panel.key_at(right, down);
    for engine in present(judgements) {
        panel.key(Sample::Mark(Mark::of(engine)), engine_label(engine));
    }
}

fn mark(
    panel: &mut Panel,
    judgements: &[Judgement],
    size: impl Fn(Mark) -> Mark,
    point: impl Fn(&Row) -> Option<Point>,
) {
    for engine in present(judgements) {
        let own = judgements.iter().map(|judgement| &judgement.row);
        let own = own.filter(|row| row.engine == engine);
        panel.marks(size(Mark::of(engine)), own.filter_map(&point));
    }
}
