//! The three maps as a figure: how a stack ends, over floor friction and one more property.

use super::axis::power_of_ten;
use super::panel::{FONT, written};
use super::style::INK;
use crate::model::Stack;
use crate::study::Verdict;
use crate::study::regimes::{Confirmation, Survey};
use crate::theory::{
    Axis, Boundary, EquilibriumPath, Event, FailureMode, LoadingOutcome, RegimeMap,
    released_frictions,
};
use kuva::plot::scatter::MarkerShape;
use kuva::plot::{BandPlot, LinePlot, ScatterPlot};
use kuva::render::annotations::TextAnnotation;
use kuva::render::figure::Figure;
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;
use std::sync::Arc;

/// Points on a curve, between two lines that cut the axis.
const SAMPLES: usize = 61;
/// Size of a panel in pixels, axes and labels included.
const PANEL: (f64, f64) = (350.0, 330.0);
const TEXT_SIZE: u32 = 11;
/// How far a region reaches into the next strip, as a factor on the axis.
const OVERLAP: f64 = 1.004;
/// Distance of two lines of text, in units of μ.
const LINE_HEIGHT: f64 = 0.042;

/// How a stack ends: what the regions of the figure are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Ending {
    Falls,
    Yields,
    Saturates,
    NoPeak,
}

/// An ending, and whether contact 2–3 closes before.
type Region = (Ending, bool);

/// The maps with the verdicts of the native DEM.
pub(super) fn regimes(maps: &[RegimeMap], survey: &Survey) -> super::Figure {
    let caption = "Not in the paper: how a stack ends, over the floor friction μ and (a) the stiffness kₙ r/(m g), \
                   (b) the friction μ_d between cylinders, (c) the stiffness ratio κ = kₙ/kₜ; the others are 100, \
                   0.7 and 2.5. Regions and lines: the follower of equilibria; solid: another event comes first \
                   beyond it, dashed: the same event, another end. Dots: native runs on both sides agree with \
                   the boundary; crosses: they do not.";
    super::Figure::new("regimes", caption, regimes_svg(maps, survey))
}

/// The figure as SVG.
pub fn regimes_svg(maps: &[RegimeMap], survey: &Survey) -> String {
    let panels: Vec<(Vec<Plot>, Layout)> = maps.iter().map(|map| panel(map, survey)).collect();
    let (plots, layouts) = panels.into_iter().unzip();
    let scene = Figure::new(1, maps.len())
        .with_plots(plots)
        .with_layouts(layouts)
        .with_cell_size(PANEL.0, PANEL.1)
        .with_spacing(8.0)
        .with_padding(6.0)
        .with_labels_lowercase()
        .render();
    written(&scene)
}

fn panel(map: &RegimeMap, survey: &Survey) -> (Vec<Plot>, Layout) {
    let strips = strips(map);
    let mut plots: Vec<Plot> = Vec::new();
    for strip in &strips {
        plots.extend(
            strip
                .bands
                .iter()
                .map(|band| Plot::Band(band.filled(strip))),
        );
    }
    for strip in &strips {
        plots.extend(
            strip
                .curves
                .iter()
                .map(|curve| Plot::Line(curve.drawn(strip))),
        );
    }
    for line in map.lines() {
        let ends = [map.lowest_friction_of(line), map.frictions.1];
        let points = ends.map(|friction| (line.value(), friction));
        plots.push(Plot::Line(ink(points.to_vec())));
    }
    plots.extend(markers(map, survey));
    let mut layout = layout(map, &plots);
    for annotation in labels(map, &strips) {
        layout = layout.with_annotation(annotation);
    }
    (plots, layout)
}

fn layout(map: &RegimeMap, plots: &[Plot]) -> Layout {
    let layout = Layout::auto_from_plots(plots)
        .with_x_axis_min(map.range.0)
        .with_x_axis_max(map.range.1)
        .with_y_axis_min(0.0)
        .with_y_axis_max(map.frictions.1)
        .with_y_tick_step(0.2)
        .with_y_tick_format(TickFormat::Fixed(1))
        .with_clamp_axis()
        .with_show_grid(false)
        .with_box_axes()
        .with_font_family(FONT)
        .with_label_size(13)
        .with_tick_size(11)
        .with_y_label("floor friction μ");
    match map.axis {
        Axis::Stiffness => layout
            .with_log_x()
            .with_x_tick_format(TickFormat::Custom(Arc::new(power_of_ten)))
            .with_x_label("stiffness kₙ r/(m g)"),
        Axis::CylinderFriction => layout
            .with_x_tick_step(0.2)
            .with_x_tick_format(TickFormat::Fixed(1))
            .with_x_label("cylinder friction μ_{d}"),
        Axis::StiffnessRatio => layout
            .with_log_x()
            .with_x_tick_format(TickFormat::Custom(Arc::new(|value| value.to_string())))
            .with_x_label("stiffness ratio κ = kₙ/kₜ"),
    }
}

/// A part of the axis between two lines, on which the regions follow each other in the same order.
struct Strip {
    values: Vec<f64>,
    bands: Vec<Band>,
    curves: Vec<Curve>,
}

/// A region on a strip.
struct Band {
    region: Region,
    lower: Vec<f64>,
    upper: Vec<f64>,
}

/// A boundary on a strip: of events, or of endings alone.
struct Curve {
    frictions: Vec<f64>,
    of_events: bool,
}

impl Strip {
    fn visible(&self, region: Region) -> Option<&Band> {
        let bands = self.bands.iter().filter(|band| band.region == region);
        let highest = bands.max_by(|one, other| one.height().total_cmp(&other.height()));
        highest.filter(|band| band.is_visible())
    }
}

impl Band {
    /// Height in its middle, in units of μ.
    fn height(&self) -> f64 {
        self.upper[SAMPLES / 2] - self.lower[SAMPLES / 2]
    }

    /// High enough for a line of text.
    fn is_visible(&self) -> bool {
        self.height() > LINE_HEIGHT
    }

    fn filled(&self, strip: &Strip) -> BandPlot {
        // A little into the next strip, which is drawn over it: adjoining edges would let the paper through.
        let end = strip.values[SAMPLES - 1] * OVERLAP;
        let values = strip.values.iter().copied().chain([end]);
        let prolonged = |edge: &[f64]| [edge, &edge[SAMPLES - 1..]].concat();
        BandPlot::new(values, prolonged(&self.lower), prolonged(&self.upper))
            .with_color(colour(self.region))
            .with_opacity(1.0)
    }
}

impl Curve {
    fn drawn(&self, strip: &Strip) -> LinePlot {
        let values = strip.values.iter().copied();
        let line = ink(values.zip(self.frictions.iter().copied()).collect());
        if self.of_events {
            line
        } else {
            line.with_dashed()
        }
    }
}

fn ink(points: Places) -> LinePlot {
    LinePlot::new()
        .with_data(points)
        .with_color(INK)
        .with_stroke_width(1.2)
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
    // Off the lines themselves, on which the order of the events is not decided.
    let part = RegimeMap {
        range: (from * (1.0 + 1e-9), to * (1.0 - 1e-9)),
        ..*map
    };
    let values = part.axis_values(SAMPLES);
    let levels: Vec<Vec<(f64, bool)>> = values.iter().map(|&value| levels(map, value)).collect();
    let count = levels.iter().map(Vec::len).min().unwrap_or(0);
    let (lowest, highest) = (0.0, map.frictions.1);
    let edge = |level: usize, index: usize| match level {
        0 => lowest,
        level if level > count => highest,
        level => levels[index][level - 1].0.clamp(lowest, highest),
    };
    let curve = |level: usize| (0..SAMPLES).map(|index| edge(level, index)).collect();
    let middle = SAMPLES / 2;
    let bands = (0..=count).filter_map(|level| {
        let friction = 0.5 * (edge(level, middle) + edge(level + 1, middle));
        Some(Band {
            region: region(&map.stack(values[middle], friction))?,
            lower: curve(level),
            upper: curve(level + 1),
        })
    });
    let bands: Vec<Band> = bands.collect();
    let curves = (1..=count).map(|level| Curve {
        frictions: curve(level),
        of_events: levels[middle][level - 1].1,
    });
    Strip {
        curves: curves.collect(),
        bands,
        values,
    }
}

/// The boundaries at a value on the axis, lowest first, and whether another event comes first beyond them.
fn levels(map: &RegimeMap, value: f64) -> Vec<(f64, bool)> {
    let stack = map.axis.set(&map.base, value);
    let path = EquilibriumPath::new(&stack);
    let events = Boundary::in_friction(&path, &stack).into_iter();
    let mut levels: Vec<(f64, bool)> = events
        .map(|boundary| (boundary.floor_friction, true))
        .collect();
    if let Some((low, high)) = released_frictions(&stack) {
        let closed_at_wall = path.wall_contact_outward().is_some_and(|y| y < 0.0);
        levels.extend((path.settled_outward() < 0.0).then_some((low, false)));
        levels.extend(closed_at_wall.then_some((high, false)));
    }
    levels.sort_by(|left, right| left.0.total_cmp(&right.0));
    levels
}

fn region(stack: &Stack) -> Option<Region> {
    let outcome = LoadingOutcome::of(stack)?;
    let ending = match (outcome.end.map(|end| end.event), outcome.failure_mode) {
        (Some(Event::CylinderSlip), _) => Ending::Saturates,
        (Some(_), _) => Ending::Yields,
        (None, FailureMode::Collapses) => Ending::Falls,
        (None, _) => Ending::NoPeak,
    };
    let shares = outcome.first.event == Event::ContactCloses;
    Some((ending, shares))
}

/// Light enough for black print on them, and of different lightness.
fn colour((ending, shares): Region) -> &'static str {
    match (ending, shares) {
        (Ending::Falls, _) => "#bdbdbd",
        (Ending::Yields, false) => "#fdf6dc",
        (Ending::Yields, true) => "#e3f1dc",
        (Ending::Saturates, false) => "#d3e3f3",
        (Ending::Saturates, true) => "#c3d9df",
        (Ending::NoPeak, false) => "#f0cdb4",
        (Ending::NoPeak, true) => "#bfd9b4",
    }
}

fn words((ending, shares): Region) -> &'static [&'static str] {
    match (ending, shares) {
        (Ending::Falls, _) => &["falls under own weight"],
        (Ending::Yields, false) => &["floor slips:", "yield force"],
        (Ending::Yields, true) => &["2–3 touch,", "floor slips:", "yield force"],
        (Ending::Saturates, false) => &["cylinders slip:", "saturated"],
        (Ending::Saturates, true) => &["2–3 touch,", "cylinders slip:", "saturated"],
        (Ending::NoPeak, false) => &["wall contact:", "no peak"],
        (Ending::NoPeak, true) => &["2–3 touch,", "wall contact:", "no peak"],
    }
}

/// Each region is named once, in the middle of the widest part of the axis that it spans without a gap.
fn labels(map: &RegimeMap, strips: &[Strip]) -> Vec<TextAnnotation> {
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
    let places = named.into_iter().filter_map(|(region, span)| {
        let x = map.middle(span);
        Some((region, (x, height_at(strips, region, x)?)))
    });
    places
        .flat_map(|(region, place)| label(region, place))
        .collect()
}

/// The part of the axis around the strip `index` on which `region` goes on.
fn span(strips: &[Strip], index: usize, region: Region) -> (f64, f64) {
    let has = |strip: &&Strip| strip.visible(region).is_some();
    let before = strips[..index].iter().rev().take_while(has).last();
    let after = strips[index..].iter().take_while(has).last();
    (
        before.unwrap_or(&strips[index]).values[0],
        after.unwrap_or(&strips[index]).values[SAMPLES - 1],
    )
}

/// Half-way between the lower and the upper edge of `region` at `x`.
fn height_at(strips: &[Strip], region: Region, x: f64) -> Option<f64> {
    let strip = strips.iter().find(|strip| x <= strip.values[SAMPLES - 1])?;
    let band = strip.visible(region)?;
    let index = strip.values.partition_point(|&value| value < x);
    Some(0.5 * (band.lower[index] + band.upper[index]))
}

fn label(region: Region, (x, y): (f64, f64)) -> Vec<TextAnnotation> {
    let words = words(region);
    let top = y + 0.5 * LINE_HEIGHT * (words.len() as f64 - 1.0) - 0.5 * LINE_HEIGHT;
    let lines = words.iter().enumerate();
    lines
        .map(|(index, text)| {
            TextAnnotation::new(*text, x, top - LINE_HEIGHT * index as f64)
                .with_font_size(TEXT_SIZE)
                .with_color(INK)
        })
        .collect()
}

/// Filled where the DEM agrees on both sides, crossed where it does not.
fn markers(map: &RegimeMap, survey: &Survey) -> Vec<Plot> {
    let place = |confirmation: &Confirmation| {
        let stack = &confirmation.point.stack;
        (map.axis.get(stack), stack.floor_friction)
    };
    let of_map = survey.confirmations.iter();
    let of_map = of_map.filter(|confirmation| confirmation.point.map == map.axis);
    let (agreeing, others): (Vec<&Confirmation>, Vec<&Confirmation>) =
        of_map.partition(|confirmation| confirmation.verdict() == Verdict::Agrees);
    let marked = |places: Places, colour: &str, shape: MarkerShape| {
        (!places.is_empty()).then(|| {
            let markers = ScatterPlot::new().with_data(places).with_color(colour);
            Plot::Scatter(markers.with_size(2.2).with_marker(shape))
        })
    };
    let agreeing: Places = agreeing.into_iter().map(place).collect();
    let others: Places = others.into_iter().map(place).collect();
    let (released, contradicted) = released_places(map, survey);
    let agreeing = marked([agreeing, released].concat(), INK, MarkerShape::Circle);
    let others = marked(
        [others, contradicted].concat(),
        "#c00000",
        MarkerShape::Cross,
    );
    agreeing.into_iter().chain(others).collect()
}

/// Points of a panel: value on the axis and floor friction.
type Places = Vec<(f64, f64)>;

/// The places on the dashed lines whose neighbours were examined: those where both end as they should, and
/// the others.
fn released_places(map: &RegimeMap, survey: &Survey) -> (Places, Places) {
    let (mut agreeing, mut others) = (Vec::new(), Vec::new());
    for pair in survey.examinations.windows(2) {
        let [below, above] = [&pair[0], &pair[1]];
        let value = map.axis.get(&below.stack);
        let friction = 0.5 * (below.stack.floor_friction + above.stack.floor_friction);
        let beside = Stack {
            floor_friction: below.stack.floor_friction,
            ..above.stack
        };
        let close = above.stack.floor_friction - below.stack.floor_friction < 0.01 * friction;
        let on_map = map.stack(value, below.stack.floor_friction) == below.stack;
        if beside != below.stack || !close || !on_map {
            continue;
        }
        if [below, above]
            .iter()
            .all(|side| side.verdict == Verdict::Agrees)
        {
            agreeing.push((value, friction));
        } else {
            others.push((value, friction));
        }
    }
    (agreeing, others)
}
