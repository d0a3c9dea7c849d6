//! The figure of the three regime maps: the end of a stack over floor friction and one more parameter.

use super::axis::Axis as Ruler;
use super::panel::{Anchor, Panel, Point, Sample, Stroke};
use super::sheet::Sheet;
use super::style::{
    BOUNDARY, BOUNDARY_OF_ENDINGS, CONFIRMED, FALLS, NO_PEAK, NOT_CONFIRMED, SATURATES, UNKNOWN,
    YIELDS,
};
use crate::model::{Stack, exact};
use crate::study::Verdict;
use crate::study::regimes::Survey;
use crate::theory::{
    Axis, Boundary, Event, FailureMode, LoadingOutcome, RegimeMap, released_frictions,
};

/// Number of points on a curve between two lines that cut the axis.
const SAMPLES: usize = 61;
/// The largest part of the axis that is too narrow for the words of a region.
const NARROW: f64 = 0.25;
/// Overlap of a region with the next strip, as a factor on the axis.
const OVERLAP: f64 = 1.004;
/// Half the width of a name, as a part of the axis.
const HALF_NAME: f64 = 0.14;
/// Distance of two lines of text, in units of μ.
const LINE_HEIGHT: f64 = 0.042;

/// The end of a stack, by which the figure is divided into regions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Ending {
    Falls,
    Yields,
    Saturates,
    NoPeak,
    Unknown,
}

/// An ending, and whether contact 2–3 closes before it.
type Region = (Ending, bool);

/// Draws the maps with the verdicts of the native DEM.
pub fn regimes(maps: &[RegimeMap], survey: &Survey) -> super::Figure {
    let caption = "Not in the paper: how a stack ends, over the floor friction $\\mu$ and (a) the stiffness $k_n r/(mg)$, \
                   (b) the friction $\\mu_d$ between cylinders, (c) the stiffness ratio $\\kappa = k_n/k_t$; the others are 100, \
                   0.7 and 2.5. Nothing turns the tangential springs. Regions and lines: the follower of equilibria; solid: another event comes first \
                   beyond it, dashed: the same event, another end. Dots: native runs on both sides agree with \
                   the boundary; crosses: they do not.";
    super::Figure::of_sheet("regimes", caption, &sheet(maps, survey))
}

/// Draws the figure as SVG.
pub fn regimes_svg(maps: &[RegimeMap], survey: &Survey) -> String {
    sheet(maps, survey).wide().svg()
}

fn sheet(maps: &[RegimeMap], survey: &Survey) -> Sheet {
    let panels: Vec<Panel> = maps.iter().map(|map| panel(map, survey)).collect();
    Sheet::of_halves(panels).with_key(key(maps))
}

/// Returns the key: what marks and lines mean, and the parameters that are the same in all of a map.
fn key(maps: &[RegimeMap]) -> Vec<(Sample, String)> {
    let entries = [
        (
            Sample::Line(BOUNDARY),
            "beyond it another event comes first",
        ),
        (
            Sample::Line(BOUNDARY_OF_ENDINGS),
            "the same event first, another end",
        ),
        (Sample::Mark(CONFIRMED), "native runs on both sides agree"),
        (Sample::Mark(NOT_CONFIRMED), "native runs do not agree"),
        (
            Sample::Heading,
            "2–3 touch: the bottom cylinders meet before the end",
        ),
        (
            Sample::Heading,
            "saturated: the largest force, whatever μ is",
        ),
    ];
    let entries = entries.map(|(sample, words)| (sample, words.to_owned()));
    let fixed = ('a'..).zip(maps).map(|(letter, map)| {
        let stack = &map.base;
        let stiffness = format!("kₙ r/(m g) = {}", exact(stack.stiffness));
        let friction = format!("μ_{{d}} = {}", exact(stack.cylinder_friction));
        let ratio = format!("κ = {}", exact(stack.stiffness_ratio));
        let [one, other] = match map.axis {
            Axis::Stiffness => [friction, ratio],
            Axis::CylinderFriction => [stiffness, ratio],
            Axis::StiffnessRatio => [stiffness, friction],
        };
        (Sample::Heading, format!("({letter}) at {one}, {other}"))
    });
    entries.into_iter().chain(fixed).collect()
}

fn panel(map: &RegimeMap, survey: &Survey) -> Panel {
    let frictions = Ruler::linear("floor friction μ", (0.0, map.frictions.1), 0.2, 1);
    let mut panel = Panel::new(ruler(map), frictions);
    let strips = strips(map);
    for strip in &strips {
        for band in &strip.bands {
            panel.area(look(band.region).0, band.outline(strip));
        }
        for (stroke, frictions) in &strip.curves {
            let points = strip.values.iter().zip(frictions);
            let shown = |friction: f64| (friction < map.frictions.1).then_some(friction);
            panel.line(
                *stroke,
                points.map(|(&value, &friction)| (value, shown(friction))),
            );
        }
    }
    for line in map.lines() {
        let lowest = map.lowest_friction_of(line);
        if lowest < map.frictions.1 {
            let ends = [lowest, map.frictions.1];
            panel.line(BOUNDARY, ends.map(|friction| (line.value(), friction)));
        }
    }
    mark(&mut panel, map, survey);
    label(&mut panel, map, &strips);
    panel
}

fn ruler(map: &RegimeMap) -> Ruler {
    match map.axis {
        Axis::Stiffness => Ruler::log("stiffness kₙ r/(m g)", map.range),
        Axis::CylinderFriction => Ruler::linear("cylinder friction μ_{d}", map.range, 0.2, 1),
        Axis::StiffnessRatio => Ruler::log("stiffness ratio κ = kₙ/kₜ", map.range),
    }
}

/// A part of the axis between two lines, along which the order of the regions is the same.
struct Strip {
    values: Vec<f64>,
    bands: Vec<Band>,
    /// The boundaries between the bands.
    curves: Vec<(Stroke, Vec<f64>)>,
}

/// A region on a strip.
struct Band {
    region: Region,
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl Strip {
    fn visible(&self, region: Region) -> Option<&Band> {
        let bands = self.bands.iter().filter(|band| band.region == region);
        let highest = bands.max_by(|one, other| one.height().total_cmp(&other.height()));
        highest.filter(|band| band.is_visible())
    }
}

impl Band {
    /// Returns its height in its middle, in units of μ.
    fn height(&self) -> f64 {
        self.upper[SAMPLES / 2] - self.lower[SAMPLES / 2]
    }

    /// Whether it is high enough for a line of text.
    fn is_visible(&self) -> bool {
        self.height() > LINE_HEIGHT
    }

    fn outline(&self, strip: &Strip) -> impl Iterator<Item = Point> {
        // The band overlaps the next strip, which is drawn over it: between adjoining edges a gap would show.
        let end = strip.values[SAMPLES - 1] * OVERLAP;
        let values: Vec<f64> = strip.values.iter().copied().chain([end]).collect();
        let edge = |heights: &[f64]| -> Vec<Point> {
            let heights = heights.iter().chain(heights.last()).copied();
            values.iter().copied().zip(heights).collect()
        };
        let back = edge(&self.upper).into_iter().rev();
        edge(&self.lower).into_iter().chain(back)
    }
}

fn strips(map: &RegimeMap) -> Vec<Strip> {
    let mut cuts: Vec<f64> = map.lines().iter().map(|line| line.value()).collect();
    cuts.extend(map.reopenings());
    cuts.push(map.range.0);
    cuts.push(map.range.1);
    cuts.sort_by(f64::total_cmp);
    let pairs = cuts.windows(2);
    pairs.map(|pair| strip(map, (pair[0], pair[1]))).collect()
}

fn strip(map: &RegimeMap, (from, to): (f64, f64)) -> Strip {
    // The strip ends before the lines themselves, where the order of the events is undecided.
    let part = RegimeMap {
        range: (from * (1.0 + 1e-9), to * (1.0 - 1e-9)),
        ..*map
    };
    let values = part.axis_values(SAMPLES);
    let levels: Vec<Vec<(f64, Stroke)>> = values.iter().map(|&value| levels(map, value)).collect();
    let count = levels.iter().map(Vec::len).min().unwrap_or(0);
    let highest = map.frictions.1;
    let edge = |level: usize, index: usize| match level {
        0 => 0.0,
        level if level > count => highest,
        level => levels[index][level - 1].0.clamp(0.0, highest),
    };
    let curve = |level: usize| (0..SAMPLES).map(|index| edge(level, index)).collect();
    let middle = SAMPLES / 2;
    let bands = (0..=count).filter_map(|level| {
        let friction = 0.5 * (edge(level, middle) + edge(level + 1, middle));
        Some(Band {
            region: region(map, values[middle], friction)?,
            lower: curve(level),
            upper: curve(level + 1),
        })
    });
    let bands = bands.collect();
    let curves = (1..=count).map(|level| (levels[middle][level - 1].1, curve(level)));
    let curves = curves.collect();
    Strip {
        values,
        bands,
        curves,
    }
}

/// Returns the floor frictions of the boundaries at a value on the axis, lowest first, with their strokes.
fn levels(map: &RegimeMap, value: f64) -> Vec<(f64, Stroke)> {
    let stack = map.axis.set(&map.base, value);
    let path = map.path(value);
    let events = Boundary::in_friction(&path, &stack).into_iter();
    let mut levels: Vec<(f64, Stroke)> = events
        .map(|boundary| (boundary.floor_friction, BOUNDARY))
        .collect();
    if let Some((low, high)) = released_frictions(&path, &stack) {
        let closed_at_wall = path.wall_contact_outward().is_some_and(|y| y < 0.0);
        levels.extend((path.settled_outward() < 0.0).then_some((low, BOUNDARY_OF_ENDINGS)));
        levels.extend(closed_at_wall.then_some((high, BOUNDARY_OF_ENDINGS)));
    }
    levels.sort_by(|left, right| left.0.total_cmp(&right.0));
    levels
}

fn region(map: &RegimeMap, value: f64, friction: f64) -> Option<Region> {
    let outcome = LoadingOutcome::of(&map.stack(value, friction), map.history_update)?;
    let ending = match (outcome.end.map(|end| end.event), outcome.failure_mode) {
        (Some(Event::CylinderSlip), _) => Ending::Saturates,
        (Some(_), _) => Ending::Yields,
        (None, _) if !outcome.is_end_known => Ending::Unknown,
        (None, FailureMode::Collapses) => Ending::Falls,
        (None, _) => Ending::NoPeak,
    };
    let shares = outcome.first.event == Event::ContactCloses;
    Some((ending, shares))
}

/// Returns colour and words of a region.
fn look((ending, shares): Region) -> (&'static str, Vec<&'static str>) {
    let (colours, words) = match ending {
        Ending::Falls => (FALLS, vec!["falls under own weight"]),
        Ending::Yields => (YIELDS, vec!["floor slips:", "yield force"]),
        Ending::Saturates => (SATURATES, vec!["cylinders slip:", "saturated"]),
        Ending::Unknown => (UNKNOWN, vec!["cylinders slip:", "end unknown"]),
        Ending::NoPeak => (NO_PEAK, vec!["wall contact:", "no peak"]),
    };
    let touch = (shares && ending != Ending::Falls).then_some("2–3 touch,");
    let words = touch.into_iter().chain(words).collect();
    (colours[usize::from(shares)], words)
}

/// Names each region once, in the widest part of the axis that it spans without a gap.
fn label(panel: &mut Panel, map: &RegimeMap, strips: &[Strip]) {
    let mut named: Vec<(Region, (f64, f64))> = Vec::new();
    for (index, strip) in strips.iter().enumerate() {
        for band in strip.bands.iter().filter(|band| band.is_visible()) {
            let span = span(strips, index, band.region);
            match named.iter_mut().find(|known| known.0 == band.region) {
                Some(known) if map.width(known.1) < map.width(span) => known.1 = span,
                Some(_) => {}
                None => named.push((band.region, span)),
            }
        }
    }
    for (region, span) in named {
        let x = roomiest(map, strips, region, span);
        if let Some([lower, upper]) = edges_at(strips, region, x) {
            name(panel, region, (x, 0.5 * (lower + upper)));
        }
    }
    label_narrow(panel, map, strips);
}

/// Writes upwards the name of each region that fills a narrow strip from the lower to the upper edge: its name
/// elsewhere does not tell what goes on there.
fn label_narrow(panel: &mut Panel, map: &RegimeMap, strips: &[Strip]) {
    let whole = map.width(map.range);
    for strip in strips {
        let span = (strip.values[0], strip.values[SAMPLES - 1]);
        let [band] = strip.bands.as_slice() else {
            continue;
        };
        if map.width(span) < NARROW * whole {
            let (_, words) = look(band.region);
            let middle = (map.middle(span), 0.5 * map.frictions.1);
            panel.words_upwards(words.join(" "), middle);
        }
    }
}

/// Returns the part of the axis around the strip `index` that `region` spans without a gap.
fn span(strips: &[Strip], index: usize, region: Region) -> (f64, f64) {
    let has = |strip: &&Strip| strip.visible(region).is_some();
    let before = strips[..index].iter().rev().take_while(has).last();
    let after = strips[index..].iter().take_while(has).last();
    (
        before.unwrap_or(&strips[index]).values[0],
        after.unwrap_or(&strips[index]).values[SAMPLES - 1],
    )
}

/// Returns the place in `span` where the words of `region` have the room that they need, or most of it, as near to
/// the middle as possible.
fn roomiest(map: &RegimeMap, strips: &[Strip], region: Region, span: (f64, f64)) -> f64 {
    let ruler = ruler(map);
    let [from, to] = [span.0, span.1].map(|value| ruler.part(value));
    let middle = ruler.part(map.middle(span));
    let (_, words) = look(region);
    let needed = LINE_HEIGHT * (words.len() as f64 + 1.0);
    let height = |part: f64| {
        let x = ruler.at(part.clamp(from, to));
        edges_at(strips, region, x).map_or(0.0, |[lower, upper]| upper - lower)
    };
    let room = |part: f64| {
        let least = [-HALF_NAME, 0.0, HALF_NAME].map(|aside| height(part + aside));
        let least = least.into_iter().fold(needed, f64::min);
        least - LINE_HEIGHT * (part - middle).abs()
    };
    let parts = (0..SAMPLES).map(|index| {
        let share = index as f64 / (SAMPLES - 1) as f64;
        from + share * (to - from)
    });
    let best = parts.max_by(|one, other| room(*one).total_cmp(&room(*other)));
    ruler.at(best.unwrap_or(middle))
}

/// Returns the lower and the upper edge of `region` at `x`.
fn edges_at(strips: &[Strip], region: Region, x: f64) -> Option<[f64; 2]> {
    let strip = strips.iter().find(|strip| x <= strip.values[SAMPLES - 1])?;
    let band = strip.visible(region)?;
    let index = strip.values.partition_point(|&value| value < x);
    Some([band.lower[index], band.upper[index]])
}

/// Writes the words of `region` in lines around a point.
fn name(panel: &mut Panel, region: Region, (x, y): Point) {
    let (_, words) = look(region);
    let top = y + 0.5 * LINE_HEIGHT * (words.len() as f64 - 2.0);
    for (index, line) in words.into_iter().enumerate() {
        let place = (x, top - LINE_HEIGHT * index as f64);
        panel.words(line, place, Anchor::Middle);
    }
}

/// Draws a dot where native runs agree on both sides, a cross where they do not.
fn mark(panel: &mut Panel, map: &RegimeMap, survey: &Survey) {
    let confirmations = survey.confirmations.iter();
    let of_map = confirmations.filter(|own| own.point.map == map.axis);
    let of_map = of_map.map(|own| {
        let stack = &own.point.stack;
        let place = (map.axis.get(stack), stack.floor_friction);
        (place, own.verdict() == Verdict::Agrees)
    });
    let all = of_map.chain(released_places(map, survey));
    let all = all.filter(|((_, friction), _)| *friction <= map.frictions.1);
    let (agreeing, others): (Vec<_>, Vec<_>) = all.partition(|(_, agrees)| *agrees);
    for (mark, places) in [(CONFIRMED, agreeing), (NOT_CONFIRMED, others)] {
        panel.marks(mark, places.into_iter().map(|(place, _)| place));
    }
}

/// Returns the examined points on the dashed lines, and whether both neighbours agree with theory.
fn released_places(map: &RegimeMap, survey: &Survey) -> impl Iterator<Item = (Point, bool)> {
    survey.examinations.windows(2).filter_map(|pair| {
        let [below, above] = [&pair[0], &pair[1]];
        let value = map.axis.get(&below.stack);
        let friction = 0.5 * (below.stack.floor_friction + above.stack.floor_friction);
        let beside = Stack {
            floor_friction: below.stack.floor_friction,
            ..above.stack
        };
        let close = above.stack.floor_friction - below.stack.floor_friction < 0.01 * friction;
        let on_map = map.stack(value, below.stack.floor_friction) == below.stack;
        let agree = [below, above].map(|side| side.verdict) == [Verdict::Agrees; 2];
        (beside == below.stack && close && on_map).then_some(((value, friction), agree))
    })
}
