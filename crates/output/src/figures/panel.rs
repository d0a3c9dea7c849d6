//! A panel: axes and everything drawn between them.

use super::axis::{Axis, Scale};
use super::drawing::{Drawing, Paint, Place, Setting};
use super::style::{
    FRAME, HALF_LETTER, KEY_LINE, KEY_SAMPLE, KEY_SPACE, LABEL_SIZE, LETTER_SIZE, MARGINS, Mark,
    PADDING, Shape, TEXT_SIZE, TICK,
};

pub(super) use super::drawing::{Anchor, Stroke};

/// A point, in units of the axes.
pub(super) type Point = (f64, f64);

/// A panel and its content.
pub(super) struct Panel {
    x: Axis,
    y: Axis,
    areas: Vec<(&'static str, Vec<Point>)>,
    lines: Vec<(Stroke, Vec<Point>)>,
    marks: Vec<(Mark, Point)>,
    /// Words, their places in parts of the panel from its upper left corner.
    words: Vec<(String, Point, Anchor, Setting)>,
    key: Vec<(Sample, String)>,
    key_place: Point,
}

/// The sample beside the words of a key.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Sample {
    Line(Stroke),
    Mark(Mark),
    /// No sample: the words are a heading.
    Heading,
}

impl Panel {
    pub fn new(x: Axis, y: Axis) -> Self {
        Self {
            x,
            y,
            areas: Vec::new(),
            lines: Vec::new(),
            marks: Vec::new(),
            words: Vec::new(),
            key: Vec::new(),
            key_place: (0.04, 0.04),
        }
    }

    /// Adds a line through `points`, interrupted at missing values and, on a logarithmic axis, at values up to 0.
    pub fn line<Y: Into<Option<f64>>>(
        &mut self,
        stroke: Stroke,
        points: impl IntoIterator<Item = (f64, Y)>,
    ) {
        let mut part = Vec::new();
        for (x, y) in points {
            match y.into().filter(|&y| self.y.scale != Scale::Log || y > 0.0) {
                Some(y) => part.push((x, y)),
                None => self.lines.push((stroke, std::mem::take(&mut part))),
            }
        }
        self.lines.push((stroke, part));
        self.lines.retain(|(_, points)| points.len() > 1);
    }

    /// Adds a coloured area with its corners at `points`, behind everything else and limited to the axes.
    pub fn area(&mut self, colour: &'static str, points: impl IntoIterator<Item = Point>) {
        let points = points.into_iter();
        let points = points.map(|(x, y)| (self.x.clamp(x), self.y.clamp(y)));
        self.areas.push((colour, points.collect()));
    }

    /// Adds words at the right end of the line at `y`, a little above it.
    pub fn words_on(&mut self, text: &str, y: f64) {
        let above = self.y.at(self.y.part(y) + 0.015);
        self.words(text, (self.x.at(0.98), above), Anchor::End);
    }

    /// Adds a horizontal line across the panel.
    pub fn level(&mut self, stroke: Stroke, y: f64) {
        let (from, to) = self.x.range;
        self.line(stroke, [(from, y), (to, y)]);
    }

    /// Adds a vertical line across the panel.
    pub fn upright(&mut self, stroke: Stroke, x: f64) {
        let (from, to) = self.y.range;
        self.line(stroke, [(x, from), (x, to)]);
    }

    /// Returns `x` moved to the right by a `part` of the panel.
    pub fn beside(&self, x: f64, part: f64) -> f64 {
        self.x.at(self.x.part(x) + part)
    }

    /// Adds a vertical band across the panel, as wide as a `part` of it, with its middle at `x`.
    pub fn band(&mut self, colour: &'static str, x: f64, part: f64) {
        let (low, high) = self.y.range;
        let [left, right] = [-0.5, 0.5].map(|side| self.beside(x, side * part));
        self.area(
            colour,
            [(left, low), (left, high), (right, high), (right, low)],
        );
    }

    /// Adds a mark at each of `points`. Those above or below the axis are drawn at its end, those beside it not at all.
    pub fn marks(&mut self, mark: Mark, points: impl IntoIterator<Item = Point>) {
        let points = points.into_iter();
        let points = points.filter(|point| self.x.contains(point.0) && !point.1.is_nan());
        self.marks
            .extend(points.map(|(x, y)| (mark, (x, self.y.clamp(y)))));
    }

    /// Adds words at `place`, in units of the axes.
    pub fn words(&mut self, text: impl Into<String>, place: Point, anchor: Anchor) {
        self.set(text, place, anchor, Setting::Normal);
    }

    /// Adds words set upwards, with their middle at `place` in units of the axes.
    pub fn words_upwards(&mut self, text: impl Into<String>, place: Point) {
        self.set(text, place, Anchor::Middle, Setting::Upwards);
    }

    fn set(&mut self, text: impl Into<String>, place: Point, anchor: Anchor, setting: Setting) {
        let place = (self.x.part(place.0), 1.0 - self.y.part(place.1));
        self.words.push((text.into(), place, anchor, setting));
    }

    /// Sets the upper left corner of the key, in parts of the panel from the panel's upper left corner.
    pub fn key_at(&mut self, right: f64, down: f64) {
        self.key_place = (right, down);
    }

    /// Adds a line to the key.
    pub fn key(&mut self, sample: Sample, words: &str) {
        self.key.push((sample, words.to_owned()));
    }
}

/// Draws a panel alone, without a letter, of the given size in pixels.
pub(super) fn draw_alone(panel: &Panel, (width, height): (f64, f64)) -> Drawing {
    let mut drawing = Drawing::new(2.0 * PADDING + width, 2.0 * PADDING + height);
    draw_panel(&mut drawing, panel, [PADDING; 2], (width, height), None);
    drawing
}

/// Draws a panel with its margins at `corner`, of this `size` in pixels, with the letter that names it.
pub(super) fn draw_panel(
    drawing: &mut Drawing,
    panel: &Panel,
    corner: Place,
    size: (f64, f64),
    letter: Option<char>,
) {
    View::new(panel, corner, size).draw(drawing, letter);
}

/// Draws an entry of a key: the sample from `[x, y]` on, and the words beside it.
pub(super) fn draw_entry(drawing: &mut Drawing, sample: Sample, words: &str, [x, y]: Place) {
    let mut indent = KEY_SAMPLE + KEY_SPACE;
    match sample {
        Sample::Line(stroke) => drawing.line([[x, y], [x + KEY_SAMPLE, y]], stroke),
        Sample::Mark(mark) => draw_mark(drawing, mark, [x + 0.5 * KEY_SAMPLE, y]),
        Sample::Heading => indent = 0.0,
    }
    let beside = [x + indent, y + HALF_LETTER];
    drawing.text(words, beside, TEXT_SIZE, Anchor::Start);
}

/// A panel with the rectangle between its axes, in pixels.
struct View<'a> {
    panel: &'a Panel,
    left: f64,
    top: f64,
    width: f64,
    height: f64,
}

impl<'a> View<'a> {
    /// Places the panel with its margins at `corner`, of this `size` in pixels.
    fn new(panel: &'a Panel, corner: Place, size: (f64, f64)) -> Self {
        Self {
            panel,
            left: corner[0] + MARGINS.0,
            top: corner[1] + MARGINS.2,
            width: size.0 - MARGINS.0 - MARGINS.1,
            height: size.1 - MARGINS.2 - MARGINS.3,
        }
    }

    fn draw(&self, drawing: &mut Drawing, letter: Option<char>) {
        let panel = self.panel;
        for (colour, points) in &panel.areas {
            drawing.polygon(self.places(points), Paint::Filled(colour));
        }
        let corners = [self.at((0.0, 0.0)), self.at((1.0, 1.0))];
        for (stroke, points) in &panel.lines {
            for part in visible_parts(&self.places(points), corners) {
                drawing.line(part, *stroke);
            }
        }
        self.axes(drawing, letter);
        for &(mark, point) in &panel.marks {
            draw_mark(drawing, mark, self.place(point));
        }
        for (words, place, anchor, setting) in &panel.words {
            let [x, y] = self.at(*place);
            let base = match setting {
                Setting::Upwards => [x + HALF_LETTER, y],
                Setting::Normal | Setting::Bold => [x, y],
            };
            drawing.set(words, base, TEXT_SIZE, *anchor, *setting);
        }
        self.key(drawing);
    }

    /// Draws frame, ticks, labels, and the letter that names the panel.
    fn axes(&self, drawing: &mut Drawing, letter: Option<char>) {
        let ([left, top], [right, bottom]) = (self.at((0.0, 0.0)), self.at((1.0, 1.0)));
        let frame = rectangle([left, top], [right, bottom]);
        drawing.polygon(frame, Paint::Outlined(FRAME));
        for (value, printed) in self.panel.x.ticks() {
            let x = left + self.panel.x.part(value) * self.width;
            drawing.line([[x, bottom], [x, bottom + TICK]], FRAME);
            let below = [x, bottom + TICK + 10.2];
            drawing.text(printed, below, TEXT_SIZE, Anchor::Middle);
        }
        for (value, printed) in self.panel.y.ticks() {
            let y = bottom - self.panel.y.part(value) * self.height;
            drawing.line([[left - TICK, y], [left, y]], FRAME);
            let beside = [left - TICK - 4.5, y + HALF_LETTER];
            drawing.text(printed, beside, TEXT_SIZE, Anchor::End);
        }
        let below = [0.5 * (left + right), bottom + MARGINS.3 - 6.5];
        drawing.text(&self.panel.x.label, below, LABEL_SIZE, Anchor::Middle);
        let beside = [left - MARGINS.0 + 15.8, 0.5 * (top + bottom)];
        let label = &self.panel.y.label;
        drawing.set(label, beside, LABEL_SIZE, Anchor::Middle, Setting::Upwards);
        if let Some(letter) = letter {
            let corner = [left - MARGINS.0 + 8.0, top - 7.0];
            drawing.set(letter, corner, LETTER_SIZE, Anchor::Start, Setting::Bold);
        }
    }

    fn key(&self, drawing: &mut Drawing) {
        let [x, top] = self.at(self.panel.key_place);
        for (line, (sample, words)) in self.panel.key.iter().enumerate() {
            let y = top + KEY_LINE * (line as f64 + 0.5);
            draw_entry(drawing, *sample, words, [x, y]);
        }
    }

    /// Converts a place in parts of the panel, from its upper left corner, to pixels.
    fn at(&self, (right, down): Point) -> Place {
        [
            self.left + right * self.width,
            self.top + down * self.height,
        ]
    }

    fn place(&self, (x, y): Point) -> Place {
        self.at((self.panel.x.part(x), 1.0 - self.panel.y.part(y)))
    }

    fn places(&self, points: &[Point]) -> Vec<Place> {
        points.iter().map(|&point| self.place(point)).collect()
    }
}

fn rectangle([left, top]: Place, [right, bottom]: Place) -> [Place; 4] {
    [[left, top], [right, top], [right, bottom], [left, bottom]]
}

fn draw_mark(drawing: &mut Drawing, mark: Mark, [x, y]: Place) {
    let stroke = Stroke::new(mark.colour, 1.0, &[]);
    let (left, right, top, bottom) = (x - mark.size, x + mark.size, y - mark.size, y + mark.size);
    let outline = Paint::Outlined(stroke);
    match mark.shape {
        Shape::Dot => drawing.circle([x, y], mark.size, Paint::Filled(mark.colour)),
        Shape::Circle => drawing.circle([x, y], mark.size, outline),
        Shape::Square => {
            drawing.polygon(rectangle([left, top], [right, bottom]), outline);
        }
        Shape::Diamond => {
            drawing.polygon([[left, y], [x, top], [right, y], [x, bottom]], outline);
        }
        Shape::Cross => {
            drawing.line([[left, top], [right, bottom]], stroke);
            drawing.line([[left, bottom], [right, top]], stroke);
        }
        Shape::Plus => {
            drawing.line([[left, y], [right, y]], stroke);
            drawing.line([[x, top], [x, bottom]], stroke);
        }
    }
}

/// Returns the parts of the line through `points` that are between the corners of a rectangle.
fn visible_parts(points: &[Place], corners: [Place; 2]) -> Vec<Vec<Place>> {
    let mut parts: Vec<Vec<Place>> = Vec::new();
    for pair in points.windows(2) {
        let Some([from, to]) = visible_part([pair[0], pair[1]], corners) else {
            continue;
        };
        match parts.last_mut() {
            Some(part) if part.last() == Some(&from) => part.push(to),
            _ => parts.push(vec![from, to]),
        }
    }
    parts
}

/// Returns the part of a straight line that is between the corners, by Liang and Barsky: each side of the rectangle
/// bounds the share of the line at which it enters, or at which it leaves.
fn visible_part([from, to]: [Place; 2], corners: [Place; 2]) -> Option<[Place; 2]> {
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let step = to[axis] - from[axis];
        let [low, high] = corners.map(|corner| corner[axis] - from[axis]);
        if step == 0.0 && (low > 0.0 || high < 0.0) {
            return None;
        }
        if step != 0.0 {
            enters = enters.max((low / step).min(high / step));
            leaves = leaves.min((low / step).max(high / step));
        }
    }
    let at = |share: f64| [0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis]));
    let start = if enters > 0.0 { at(enters) } else { from };
    let end = if leaves < 1.0 { at(leaves) } else { to };
    (enters < leaves).then_some([start, end])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_at_the_frame() {
        let corners = [[0.0, 0.0], [10.0, 10.0]];
        let inside = [[1.0, 1.0], [5.0, 5.0], [9.0, 1.0]];
        assert_eq!(visible_parts(&inside, corners), [inside.to_vec()]);
        let across = [
            [-5.0, 5.0],
            [5.0, 5.0],
            [5.0, 20.0],
            [8.0, 20.0],
            [8.0, 0.0],
        ];
        assert_eq!(
            visible_parts(&across, corners),
            [
                vec![[0.0, 5.0], [5.0, 5.0], [5.0, 10.0]],
                vec![[8.0, 10.0], [8.0, 0.0]]
            ]
        );
        assert!(visible_parts(&[[-1.0, 3.0], [-1.0, 8.0]], corners).is_empty());
    }
}
