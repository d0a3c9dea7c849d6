//! The three maps as a figure: how a stack ends, over floor friction and one more property.

use crate::crosscheck::{Confirmation, Survey, Verdict};
use crate::stack::Stack;
use crate::theory::{
    Axis, Boundary, Consequence, Course, Event, Outcome, RegimeMap, released_frictions,
};
use kuva::backend::svg::SvgBackend;
use kuva::plot::scatter::MarkerShape;
use kuva::plot::{BandPlot, LinePlot, ScatterPlot};
use kuva::render::annotations::TextAnnotation;
use kuva::render::figure::Figure;
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;

/// Points on a curve, between two lines that cut the axis.
const SAMPLES: usize = 61;
/// Size of a panel in pixels, axes and labels included.
const PANEL: (f64, f64) = (350.0, 330.0);
const FONT: &str = "Helvetica, Arial, DejaVu Sans, sans-serif";
const TEXT_SIZE: u32 = 11;
const INK: &str = "#222222";
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
    SvgBackend.render_scene(&scene)
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
            .with_x_label("stiffness k_n r/(m g)".replace("k_n", "kₙ")),
        Axis::CylinderFriction => layout
            .with_x_tick_step(0.2)
            .with_x_tick_format(TickFormat::Fixed(1))
            .with_x_label("cylinder friction μ_d".replace("μ_d", "μ₍d₎")),
        Axis::StiffnessRatio => layout
            .with_log_x()
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

impl Band {
    fn filled(&self, strip: &Strip) -> BandPlot {
        let (x, lower, upper) = (strip.values.clone(), self.lower.clone(), self.upper.clone());
        BandPlot::new(x, lower, upper)
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

fn ink(points: Vec<(f64, f64)>) -> LinePlot {
    LinePlot::new()
        .with_data(points)
        .with_color(INK)
        .with_stroke_width(1.2)
}

fn strips(map: &RegimeMap) -> Vec<Strip> {
    let mut cuts: Vec<f64> = map.lines().iter().map(|line| line.value()).collect();
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
    let course = Course::new(&stack);
    let events = Boundary::in_friction(&course, &stack).into_iter();
    let mut levels: Vec<(f64, bool)> = events
        .map(|boundary| (boundary.floor_friction, true))
        .collect();
    if course.closes()
        && let Some((low, high)) = released_frictions(&stack)
    {
        levels.extend([(low, false), (high, false)]);
    }
    levels.sort_by(|left, right| left.0.total_cmp(&right.0));
    levels
}

fn region(stack: &Stack) -> Option<Region> {
    let outcome = Outcome::of(stack)?;
    let ending = match (outcome.end.map(|end| end.event), outcome.consequence) {
        (Some(Event::CylinderSlip), _) => Ending::Saturates,
        (Some(_), _) => Ending::Yields,
        (None, Consequence::Collapses) => Ending::Falls,
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
        (Ending::Yields, true) => &["contact 2–3 closed,", "floor slips:", "yield force"],
        (Ending::Saturates, false) => &["cylinders slip:", "saturated"],
        (Ending::Saturates, true) => &["contact 2–3 closed,", "cylinders slip"],
        (Ending::NoPeak, false) => &["wall contact:", "no peak"],
        (Ending::NoPeak, true) => &["contact 2–3 closed,", "wall contact:", "no peak"],
    }
}

/// Each region is named once, where it is largest.
fn labels(map: &RegimeMap, strips: &[Strip]) -> Vec<TextAnnotation> {
    let mut largest: Vec<(Region, f64, (f64, f64))> = Vec::new();
    for strip in strips {
        let middle = SAMPLES / 2;
        let (first, last) = (strip.values[0], strip.values[SAMPLES - 1]);
        let width = if map.axis.is_logarithmic() {
            libm::log(last / first)
        } else {
            last - first
        };
        for band in &strip.bands {
            let height = band.upper[middle] - band.lower[middle];
            let centre = 0.5 * (band.upper[middle] + band.lower[middle]);
            let candidate = (band.region, height * width, (strip.values[middle], centre));
            match largest.iter_mut().find(|known| known.0 == band.region) {
                Some(known) if known.1 < candidate.1 => *known = candidate,
                Some(_) => {}
                None => largest.push(candidate),
            }
        }
    }
    let places = largest.into_iter();
    places
        .flat_map(|(region, _, place)| label(region, place))
        .collect()
}

fn label(region: Region, (x, y): (f64, f64)) -> Vec<TextAnnotation> {
    let words = words(region);
    let top = y + 0.5 * LINE_HEIGHT * (words.len() as f64 - 1.0) - 0.25 * LINE_HEIGHT;
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
    let marked = |confirmations: Vec<&Confirmation>, colour: &str, shape: MarkerShape| {
        let places: Vec<(f64, f64)> = confirmations.into_iter().map(place).collect();
        (!places.is_empty()).then(|| {
            let markers = ScatterPlot::new().with_data(places).with_color(colour);
            Plot::Scatter(markers.with_size(2.4).with_marker(shape))
        })
    };
    let agreeing = marked(agreeing, INK, MarkerShape::Circle);
    let others = marked(others, "#c00000", MarkerShape::Cross);
    agreeing.into_iter().chain(others).collect()
}
