//! A panel: axes by kuva; lines, marks, words and key by us, since kuva neither clips lines nor leaves marks open.

use super::axis::{Axis, Scale};
use super::style::{INK, Mark, Shape, Stroke};
use kuva::backend::svg::SvgBackend;
use kuva::plot::LinePlot;
use kuva::render::color::Color;
use kuva::render::figure::Figure;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use kuva::render::render::{PathData, Primitive, Scene, TextAnchor};

/// Lines of a legend are this far apart, in pixels.
const KEY_LINE: f64 = 15.0;
/// Length of a line in a legend.
const KEY_SAMPLE: f64 = 26.0;
const TEXT_SIZE: u32 = 11;
/// Half the height of a small letter.
const HALF_LETTER: f64 = 3.8;
/// Around the axes of a panel: left, right, top, bottom.
const MARGINS: (f64, f64, f64, f64) = (62.0, 12.0, 24.0, 44.0);
/// A distance of ticks so large that none is on the axis.
const TICKLESS: f64 = 1e9;
const SPACING: f64 = 10.0;
const PADDING: f64 = 4.0;
pub(super) const FONT: &str = "Helvetica, Arial, DejaVu Sans, sans-serif";

/// A point, in units of the axes.
pub(super) type Point = (f64, f64);

/// What is in a panel.
pub(super) struct Panel {
    x: Axis,
    y: Axis,
    lines: Vec<(Stroke, Vec<Point>)>,
    marks: Vec<(Mark, Point)>,
    words: Vec<Words>,
    key: Vec<(Sample, String)>,
    key_place: Point,
}

struct Words {
    text: String,
    place: Point,
    anchor: Anchor,
}

/// Which end of a text is at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// What stands in a key beside its words.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Sample {
    Line(Stroke),
    Mark(Mark),
    /// Nothing: the words are a heading.
    Heading,
}

impl Panel {
    pub fn new(x: Axis, y: Axis) -> Self {
        Self {
            x,
            y,
            lines: Vec::new(),
            marks: Vec::new(),
            words: Vec::new(),
            key: Vec::new(),
            key_place: (0.04, 0.04),
        }
    }

    /// A line through `points`, interrupted where there is no value.
    pub fn line(&mut self, stroke: Stroke, points: impl IntoIterator<Item = (f64, Option<f64>)>) {
        let mut part = Vec::new();
        for (x, y) in points {
            match y.filter(|&y| self.y.scale != Scale::Log || y > 0.0) {
                Some(y) => part.push((x, y)),
                None => self.lines.push((stroke, std::mem::take(&mut part))),
            }
        }
        self.lines.push((stroke, part));
        self.lines.retain(|(_, points)| points.len() > 1);
    }

    /// Words at the right end of the line at `y`, a little above it.
    pub fn words_on(&mut self, text: &str, y: f64) {
        let above = self.y.at(self.y.part(y) + 0.015);
        self.words(text, (self.x.at(0.98), above), Anchor::End);
    }

    /// A horizontal line across the panel.
    pub fn level(&mut self, stroke: Stroke, y: f64) {
        let (from, to) = self.x.range;
        self.line(stroke, [(from, Some(y)), (to, Some(y))]);
    }

    /// A vertical line across the panel.
    pub fn upright(&mut self, stroke: Stroke, x: f64) {
        let (from, to) = self.y.range;
        self.line(stroke, [(x, Some(from)), (x, Some(to))]);
    }

    /// A mark at each of `points`. Those beyond the upper or lower end of the axis stand at that end.
    pub fn marks(&mut self, mark: Mark, points: impl IntoIterator<Item = Point>) {
        let (low, high) = self.y.range;
        let points = points.into_iter();
        let points = points.filter(|point| self.x.contains(point.0) && !point.1.is_nan());
        self.marks
            .extend(points.map(|(x, y)| (mark, (x, y.clamp(low, high)))));
    }

    /// Words at `place`, in units of the axes.
    pub fn words(&mut self, text: impl Into<String>, place: Point, anchor: Anchor) {
        let text = text.into();
        let place = (self.x.part(place.0), 1.0 - self.y.part(place.1));
        self.words.push(Words {
            text,
            place,
            anchor,
        });
    }

    /// Where the key stands: its upper left corner, in parts of the panel from its own upper left corner.
    pub fn key_at(&mut self, right: f64, down: f64) {
        self.key_place = (right, down);
    }

    /// A further line in the key.
    pub fn key(&mut self, sample: Sample, words: &str) {
        self.key.push((sample, words.to_owned()));
    }

    fn layout(&self) -> Layout {
        let (left, right, top, bottom) = MARGINS;
        let layout = Layout::new(self.x.range, self.y.range)
            .with_x_axis_min(self.x.range.0)
            .with_x_axis_max(self.x.range.1)
            .with_y_axis_min(self.y.range.0)
            .with_y_axis_max(self.y.range.1)
            .with_clamp_axis()
            .with_show_grid(false)
            .with_box_axes()
            .with_font_family(FONT)
            .with_label_size(13)
            .with_tick_size(11)
            .with_x_label(&self.x.label)
            .with_y_label(&self.y.label)
            .with_x_tick_format(self.x.ticks())
            .with_y_tick_format(self.y.ticks())
            .with_force_margins(left, right)
            .with_force_margins_y(top, bottom);
        let layout = match self.x.scale {
            Scale::Linear(step, _) => layout.with_x_tick_step(step),
            Scale::Log => layout.with_log_x(),
            Scale::Bare => layout.with_x_tick_step(TICKLESS),
        };
        match self.y.scale {
            Scale::Linear(step, _) => layout.with_y_tick_step(step),
            Scale::Log => layout.with_log_y(),
            Scale::Bare => layout.with_y_tick_step(TICKLESS),
        }
    }
}

/// Panels side by side, row by row, each of a size in pixels.
pub(super) fn draw(panels: &[Panel], columns: usize, (width, height): (f64, f64)) -> String {
    let rows = panels.len().div_ceil(columns);
    let empty = || vec![Plot::Line(LinePlot::new())];
    let mut scene = Figure::new(rows, columns)
        .with_plots(panels.iter().map(|_| empty()).collect())
        .with_layouts(panels.iter().map(Panel::layout).collect())
        .with_cell_size(width, height)
        .with_spacing(SPACING)
        .with_padding(PADDING)
        .with_labels_lowercase()
        .render();
    for (index, panel) in panels.iter().enumerate() {
        let (row, column) = (index / columns, index % columns);
        let (left, right, top, bottom) = MARGINS;
        let frame = Frame {
            left: PADDING + column as f64 * (width + SPACING) + left,
            top: PADDING + row as f64 * (height + SPACING) + top,
            width: width - left - right,
            height: height - top - bottom,
        };
        frame.fill(panel, index, &mut scene);
    }
    written(&scene)
}

/// `scene` as SVG, the same whatever was drawn before.
pub(super) fn written(scene: &Scene) -> String {
    lowered(&renumbered(&SvgBackend::new().render_scene(scene)))
}

/// `svg` with kuva's clip paths numbered by their order in it; kuva goes on counting from figure to figure.
fn renumbered(svg: &str) -> String {
    const CLIP: &str = "kuva-clip-";
    let mut parts = svg.split(CLIP);
    let mut renumbered = parts.next().unwrap_or_default().to_owned();
    let mut known = Vec::new();
    for part in parts {
        let end = part.find(|letter: char| !letter.is_ascii_digit());
        let (number, rest) = part.split_at(end.unwrap_or(part.len()));
        let index = known.iter().position(|&other| other == number);
        let index = index.unwrap_or_else(|| {
            known.push(number);
            known.len() - 1
        });
        renumbered += &format!("{CLIP}{index}{rest}");
    }
    renumbered
}

/// `svg` with every `_{…}` in its texts as a subscript, for which there are no letters.
pub(super) fn lowered(svg: &str) -> String {
    let mut parts = svg.split("_{");
    let mut lowered = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (subscript, rest) = part.split_once('}').unwrap_or((part, ""));
        let (after, rest) = rest.split_at(rest.find("</text>").unwrap_or(rest.len()));
        lowered += &format!("<tspan font-size=\"75%\" dy=\"3\">{subscript}</tspan>");
        if !after.is_empty() {
            lowered += &format!("<tspan dy=\"-3\">{after}</tspan>");
        }
        lowered += rest;
    }
    lowered
}

/// The rectangle between the axes, in pixels.
struct Frame {
    left: f64,
    top: f64,
    width: f64,
    height: f64,
}

impl Frame {
    fn fill(&self, panel: &Panel, index: usize, scene: &mut Scene) {
        self.clip(index, scene);
        for (stroke, points) in &panel.lines {
            let places = points.iter().map(|&point| self.place(panel, point));
            scene.add(polyline(*stroke, places.collect()));
        }
        scene.add(Primitive::ClipEnd);
        for &(mark, point) in &panel.marks {
            draw_mark(mark, self.place(panel, point), scene);
        }
        for words in &panel.words {
            let (x, y) = self.at(words.place);
            scene.add(text(&words.text, (x, y), words.anchor));
        }
        let (x, y) = self.at(panel.key_place);
        for (line, (sample, words)) in panel.key.iter().enumerate() {
            let y = y + KEY_LINE * (line as f64 + 0.5);
            match sample {
                Sample::Line(stroke) => {
                    scene.add(polyline(*stroke, vec![(x, y), (x + KEY_SAMPLE, y)]));
                }
                Sample::Mark(mark) => draw_mark(*mark, (x + 0.5 * KEY_SAMPLE, y), scene),
                Sample::Heading => {}
            }
            let indent = match sample {
                Sample::Heading => 0.0,
                _ => KEY_SAMPLE + 6.0,
            };
            let place = (x + indent, y + HALF_LETTER);
            scene.add(text(words, place, Anchor::Start));
        }
    }

    fn clip(&self, index: usize, scene: &mut Scene) {
        let Self {
            left,
            top,
            width,
            height,
        } = *self;
        let id = format!("panel{index}");
        scene.defs.push(format!(
            "<clipPath id=\"{id}\"><rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\"/></clipPath>"
        ));
        scene.add(Primitive::ClipStart {
            x: left,
            y: top,
            width,
            height,
            id,
        });
    }

    fn at(&self, (right, down): Point) -> Point {
        (
            self.left + right * self.width,
            self.top + down * self.height,
        )
    }

    fn place(&self, panel: &Panel, (x, y): Point) -> Point {
        self.at((panel.x.part(x), 1.0 - panel.y.part(y)))
    }
}

fn polyline(stroke: Stroke, points: Vec<Point>) -> Primitive {
    Primitive::PolyLine {
        points,
        stroke: Color::from(stroke.colour),
        stroke_width: stroke.width,
        stroke_dasharray: (!stroke.dashes.is_empty()).then(|| stroke.dashes.to_owned()),
    }
}

fn text(content: &str, (x, y): Point, anchor: Anchor) -> Primitive {
    Primitive::Text {
        x,
        y,
        content: content.to_owned(),
        size: TEXT_SIZE,
        anchor: match anchor {
            Anchor::Start => TextAnchor::Start,
            Anchor::Middle => TextAnchor::Middle,
            Anchor::End => TextAnchor::End,
        },
        rotate: None,
        bold: false,
        color: Some(Color::from(INK)),
    }
}

fn draw_mark(mark: Mark, (x, y): Point, scene: &mut Scene) {
    let (size, colour) = (mark.size, Color::from(mark.colour));
    if matches!(mark.shape, Shape::Dot | Shape::Circle) {
        let filled = mark.shape == Shape::Dot;
        scene.add(Primitive::Circle {
            cx: x,
            cy: y,
            r: size,
            fill: if filled { colour.clone() } else { Color::None },
            fill_opacity: None,
            stroke: (!filled).then_some(colour),
            stroke_width: (!filled).then_some(1.0),
        });
        return;
    }
    let (left, right, top, bottom) = (x - size, x + size, y - size, y + size);
    let d = match mark.shape {
        Shape::Square => {
            format!("M{left:.2} {top:.2}H{right:.2}V{bottom:.2}H{left:.2}Z")
        }
        Shape::Diamond => {
            format!("M{left:.2} {y:.2}L{x:.2} {top:.2}L{right:.2} {y:.2}L{x:.2} {bottom:.2}Z")
        }
        Shape::Cross => {
            format!(
                "M{left:.2} {top:.2}L{right:.2} {bottom:.2}M{left:.2} {bottom:.2}L{right:.2} {top:.2}"
            )
        }
        _ => format!("M{left:.2} {y:.2}H{right:.2}M{x:.2} {top:.2}V{bottom:.2}"),
    };
    scene.add(Primitive::Path(Box::new(PathData {
        d,
        fill: None,
        stroke: colour,
        stroke_width: 1.0,
        opacity: None,
        stroke_dasharray: None,
    })));
}
