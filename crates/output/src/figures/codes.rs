//! Marks for the measurements of the codes.

use super::axis::Axis;
use super::panel::{Panel, Point, Sample, Stroke};
use super::style::{DIFFERS, GUIDE, INCONCLUSIVE, Mark, PUBLISHED};
use crate::code::Code;
use crate::number::power_of_ten;
use crate::paper::published::{Published, PublishedForce};
use crate::study::yield_force::Judgement;
use crate::study::{MAX_TOLERANCE, Verdict};

/// Range of errors shown; errors outside of it are drawn at its ends.
const ERRORS: (f64, f64) = (1e-10, 1e-4);

/// The axis of F + 3.
pub(super) fn load_axis(range: (f64, f64)) -> Axis {
    Axis::log("load at yield F + 3 = (f + 3 m g)/(m g)", range)
}

/// Returns the codes that have at least one row, in the order of tables.
pub(super) fn present(judgements: &[Judgement]) -> Vec<Code> {
    Code::distinct(judgements.iter().map(|row| &row.code))
}

/// Draws a mark at F + 3 of every row with a yield force, except for variants with the contacts of another variant.
pub(super) fn loads(panel: &mut Panel, judgements: &[Judgement], x: impl Fn(&Judgement) -> f64) {
    mark(panel, judgements, Mark::small, |row| {
        let shown = !row.code.repeats_another();
        Some((x(row), row.yield_force().filter(|_| shown)? + 3.0))
    });
}

/// Draws the published points of a figure, each where `place` puts it.
pub(super) fn published(
    panel: &mut Panel,
    published: Option<&Published>,
    figure: &str,
    place: impl Fn(&PublishedForce) -> Option<Point>,
) {
    let Some(published) = published else { return };
    panel.marks(PUBLISHED, published.of_figure(figure).filter_map(place));
    panel.key(Sample::Mark(PUBLISHED), "published");
}

/// Says what the published data in a figure are, for its caption.
pub(super) fn published_words(published: Option<&Published>, what: &str) -> String {
    published.map_or_else(String::new, |_| {
        format!(" Published: the authors' {what} ([](#table-published)).")
    })
}

/// Returns a panel with |error| of every row, rings around inconclusive and differing rows, and the largest tolerance.
pub(super) fn error_panel<'a>(
    axis: Axis,
    judgements: impl Iterator<Item = &'a Judgement>,
    x: impl Fn(&Judgement) -> f64,
) -> Panel {
    let label = "|F − F_{limit}|/(F_{limit} + 3)";
    let mut panel = Panel::new(axis, Axis::log(label, ERRORS));
    panel.level(GUIDE, MAX_TOLERANCE);
    panel.words_on("largest that agrees", MAX_TOLERANCE);
    let judgements: Vec<Judgement> = judgements.cloned().collect();
    mark(
        &mut panel,
        &judgements,
        |mark| mark,
        |row| Some((x(row), row.error()?.abs())),
    );
    panel
}

/// Says for a caption where errors outside of the range of an [`error_panel`] are drawn.
pub(super) fn errors_at_edges() -> String {
    format!(
        "errors below {} stand at the lower edge, those above {} at the upper one",
        power_of_ten(ERRORS.0),
        power_of_ten(ERRORS.1)
    )
}

/// Writes above the errors of a panel what they have in common.
pub(super) fn name_errors(panel: &mut Panel, words: &str) {
    panel.key(Sample::Heading, words);
}

/// Returns the key: the marks of the codes of `judgements`, and the rings that occur around their points.
pub(super) fn key(judgements: &[Judgement]) -> Vec<(Sample, String)> {
    let codes = present(judgements).into_iter();
    let codes = codes.map(|code| (Mark::of(&code), code.label()));
    let rings = RINGS.into_iter().filter(|(verdict, ..)| {
        let mut shown = judgements.iter().filter(|row| row.yield_force().is_some());
        shown.any(|row| row.verdict() == *verdict)
    });
    let rings = rings.map(|(_, ring, words)| (ring, words.to_owned()));
    let entries = codes.chain(rings);
    entries
        .map(|(mark, words)| (Sample::Mark(mark), words))
        .collect()
}

/// The verdicts that have a ring, with their words in the key.
const RINGS: [(Verdict, Mark, &str); 2] = [
    (Verdict::Inconclusive, INCONCLUSIVE, "inconclusive"),
    (Verdict::Differs, DIFFERS, "differs"),
];

/// Returns a sentence on the codes that [`loads`] leaves out, or nothing if there are none.
pub(super) fn left_out(judgements: &[Judgement]) -> String {
    let repeating = present(judgements).into_iter();
    let repeating = repeating.filter(|code| code.repeats_another());
    let names: Vec<String> = repeating.map(|code| code.label()).collect();
    if names.is_empty() {
        return String::new();
    }
    format!(
        " Left out of (a), because another variant of the code has the same contacts: {}.",
        names.join("; ")
    )
}

/// Adds `code` to the key of `panel`.
pub(super) fn name(panel: &mut Panel, code: &Code) {
    panel.key(Sample::Mark(Mark::of(code)), &code.label());
}

/// Draws the runs of `code` as marks, joined by a line for the native DEM.
pub(super) fn runs(panel: &mut Panel, stroke: Stroke, code: &Code, points: &[(f64, Option<f64>)]) {
    let points = points.iter().copied();
    if code.is_native() {
        panel.line(stroke, points.clone());
    }
    panel.marks(Mark::of(code), points.filter_map(|(x, y)| Some((x, y?))));
}

/// Draws a mark at the `point` of every judgement, and a ring around it if that is inconclusive or differs.
pub(super) fn mark(
    panel: &mut Panel,
    judgements: &[Judgement],
    size: impl Fn(Mark) -> Mark,
    point: impl Fn(&Judgement) -> Option<Point>,
) {
    for code in present(judgements) {
        let own = judgements.iter();
        let own = own.filter(|row| row.code == code);
        panel.marks(size(Mark::of(&code)), own.filter_map(&point));
    }
    for (verdict, ring, _) in RINGS {
        let own = judgements.iter();
        let own = own.filter(|row| row.verdict() == verdict);
        panel.marks(ring, own.filter_map(&point));
    }
}
