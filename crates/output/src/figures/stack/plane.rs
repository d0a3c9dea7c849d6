//! Cylinders, drawn to scale in their plane.

use super::moments::StackPanel;
use super::parts::{
    CAPTION_LINE, FOOT_HEIGHT, LARGE, LONGEST_ARROW, MEDIUM, SMALL, SMALLEST_SHARE, TITLE_HEIGHT,
    arrow, largest_force, legend, legend_lines, letters, number, round_below, shifted,
};
use crate::figures::drawing::{Anchor, Drawing, Paint, Place, Stroke};
use crate::figures::style::{
    BODY, BODY_OUTLINE, HATCH, NORMAL_FORCE, ORIENTATION, ORIENTATION_AT_START, PLANE,
    TANGENTIAL_FORCE,
};
use crate::series::{ContactPoint, Frame, Partner, PlacedBody};

/// Index of the cylinder on top.
const TOP: usize = 0;
/// Pixels per r.
const SCALE: f64 = 60.0;
/// Distance between the arrows of action and reaction, in r.
const SIDESTEP: f64 = 0.055;
/// Distance from the tip of an arrow to its letter, in r.
const LETTER_DISTANCE: f64 = 0.13;
/// Smallest half-width of a panel, in r.
const NARROWEST: f64 = 2.35;
/// Largest half-width of a panel, in r. A wider stack has exploded, and its cylinders are far outside.
const WIDEST: f64 = 20.0;
const ABOVE_WALL: f64 = 0.3;
const BELOW_FLOOR: f64 = 0.3;

/// Draws `panels` with forces in m g, `columns` side by side, above lines of caption. `epsilon` is m g in k_n r.
///
/// The forces are those on each cylinder, from the contact inwards. Where two cylinders touch, each has its own arrows.
pub(super) fn drawn(
    panels: &[StackPanel],
    columns: usize,
    epsilon: f64,
    caption: &[String],
) -> Drawing {
    let widths = panels.iter().map(|panel| reach(panel.frame) + 0.25);
    let half_width = widths.fold(NARROWEST, f64::max).min(WIDEST);
    let heights = panels.iter().map(|panel| top(panel.frame));
    let highest = heights.fold(2.0, f64::max).min(2.0 * WIDEST);
    let panel_width = 2.0 * half_width * SCALE;
    let floor = TITLE_HEIGHT + (highest + ABOVE_WALL) * SCALE;
    let panel_height = floor + BELOW_FLOOR * SCALE + FOOT_HEIGHT;
    let below = panel_height * panels.len().div_ceil(columns) as f64;
    let width = panel_width * columns as f64;
    let legend_lines = legend_lines("cylinder", width) as f64;
    let height = below + CAPTION_LINE * (caption.len() as f64 + legend_lines) + 8.0;
    let mut drawing = Drawing::new(width, height);
    for (index, panel) in panels.iter().enumerate() {
        let view = View {
            middle: panel_width * ((index % columns) as f64 + 0.5),
            top: panel_height * (index / columns) as f64,
            floor: floor + panel_height * (index / columns) as f64,
            half_width,
            epsilon,
            largest: largest_force(&panel.frame.contacts),
        };
        view.draw(&mut drawing, panel, char::from(b'a' + (index % 26) as u8));
    }
    let mut line = below + 6.0;
    legend(&mut drawing, "cylinder", line, width);
    line += CAPTION_LINE * (legend_lines - 1.0);
    for text in caption {
        line += CAPTION_LINE;
        drawing.text(text, [12.0, line], SMALL, Anchor::Start);
    }
    drawing
}

/// Returns the largest horizontal distance of a cylinder's edge from the middle.
fn reach(frame: &Frame) -> f64 {
    let cylinders = frame.bodies.iter();
    let sides = cylinders.map(|cylinder| cylinder.position[0].abs() + 1.0);
    sides.fold(0.0, f64::max)
}

fn top(frame: &Frame) -> f64 {
    let cylinders = frame.bodies.iter();
    let tops = cylinders.map(|cylinder| cylinder.position[1] + 1.0);
    tops.fold(frame.wall_height, f64::max)
}

/// The place of a panel on the drawing.
struct View {
    middle: f64,
    top: f64,
    floor: f64,
    half_width: f64,
    epsilon: f64,
    /// The largest force, in k_n r.
    largest: f64,
}

impl View {
    fn at(&self, [x, y]: [f64; 2]) -> Place {
        [self.middle + SCALE * x, self.floor - SCALE * y]
    }

    fn draw(&self, drawing: &mut Drawing, panel: &StackPanel, letter: char) {
        let frame = panel.frame;
        let force = frame.wall_force / self.epsilon;
        let title = format!("({letter}) {}", panel.title);
        self.centred(drawing, title, self.top + 18.0, LARGE);
        let wall = format!("_f_ = {} _m_ _g_", number(force));
        self.centred(drawing, wall, self.top + 36.0, MEDIUM);
        self.planes(drawing, frame);
        for (index, cylinder) in frame.bodies.iter().enumerate() {
            self.cylinder(drawing, index, cylinder);
        }
        if self.largest > 0.0 {
            for contact in &frame.contacts {
                self.contact(drawing, contact);
            }
            self.scale_bar(drawing);
        }
        self.values(drawing, panel);
    }

    fn centred(&self, drawing: &mut Drawing, words: String, y: f64, size: f64) {
        drawing.text(words, [self.middle, y], size, Anchor::Middle);
    }

    /// Draws floor and top wall, hatched on their far side.
    fn planes(&self, drawing: &mut Drawing, frame: &Frame) {
        let side = self.half_width - 0.15;
        for (height, up) in [(0.0, -1.0), (frame.wall_height, 1.0)] {
            let from = self.at([-side, height]);
            let to = self.at([side, height]);
            let hatches = (2.0 * side / 0.17) as usize;
            for index in 0..hatches {
                let start = -side + 0.17 * (index as f64 + 0.4);
                let foot = self.at([start, height]);
                let end = self.at([start + 0.12 * up, height + 0.12 * up]);
                drawing.line([foot, end], HATCH);
            }
            drawing.line([from, to], PLANE);
        }
    }

    /// Draws a cylinder: the undeformed circle, its number, and its orientation now and at the start.
    fn cylinder(&self, drawing: &mut Drawing, index: usize, cylinder: &PlacedBody) {
        let [x, y, _] = cylinder.position;
        drawing.circle(self.at([x, y]), SCALE, Paint::Tinted(BODY_OUTLINE, BODY));
        // Directions in which there is no contact at rest.
        let rest = [0.0, 0.8, std::f64::consts::PI - 0.8][index % 3];
        for (angle, stroke) in [
            (rest, ORIENTATION_AT_START),
            (rest + cylinder.rotation[2], ORIENTATION),
        ] {
            let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
            let from = self.at([x + 0.84 * cosine, y + 0.84 * sine]);
            let to = self.at([x + cosine, y + sine]);
            drawing.line([from, to], stroke);
        }
        let mut place = self.at([x + [-0.5, 0.45, -0.45][index % 3], y]);
        place[1] += 5.0;
        drawing.text(index + 1, place, LARGE, Anchor::Middle);
    }

    /// Writes the values of the forces, with the letters of the paper's figure.
    fn values(&self, drawing: &mut Drawing, panel: &StackPanel) {
        let pairs = [(1, Partner::Body(TOP)), (2, Partner::Body(1))];
        let known = pairs.into_iter().filter(|_| panel.pair_forces_known);
        let parts = known.chain([(1, Partner::Floor)]).flat_map(|contact| {
            let mut all = panel.frame.contacts.iter();
            let found = all.find(|one| (one.body, one.partner) == contact);
            let (normal, tangential) = letters(contact.1, TOP);
            [
                (normal, found.map_or(0.0, |one| one.normal_force)),
                (
                    tangential,
                    found.map_or(0.0, |one| one.tangential_force.abs()),
                ),
            ]
        });
        let parts = parts.filter(|(letter, _)| !letter.is_empty());
        let parts = parts.map(|(letter, force)| (letter, number(force / self.epsilon)));
        let parts = parts.map(|(letter, force)| format!("_{letter}_ = {force}"));
        let words = parts.collect::<Vec<_>>().join(",  ");
        let below = self.floor + BELOW_FLOOR * SCALE;
        self.centred(drawing, words, below + 10.0, SMALL);
    }

    /// Draws the force on the cylinder, and the opposite one on its partner if that is a cylinder too.
    fn contact(&self, drawing: &mut Drawing, contact: &ContactPoint) {
        let partners = matches!(contact.partner, Partner::Body(_));
        let sides: &[f64] = if partners { &[1.0, -1.0] } else { &[1.0] };
        for &side in sides {
            let towards = |[x, y, _]: [f64; 3]| [x, y].map(|component| side * component);
            let inwards = towards(contact.normal);
            let [x, y, _] = contact.position;
            let place = [x, y];
            let (along, across) = (contact.normal_vector(), contact.tangential_vector());
            let named = match is_named(contact, side) {
                true => letters(contact.partner, TOP),
                false => ("", ""),
            };
            let start = if partners { SIDESTEP } else { 0.0 };
            let start = shifted(place, inwards, start);
            self.arrow(drawing, start, towards(along), NORMAL_FORCE, named.0);
            let start = shifted(place, inwards, 1.6 * SIDESTEP);
            self.arrow(drawing, start, towards(across), TANGENTIAL_FORCE, named.1);
        }
    }

    fn arrow(
        &self,
        drawing: &mut Drawing,
        start: Place,
        force: Place,
        stroke: Stroke,
        letter: &str,
    ) {
        let size = (force[0] * force[0] + force[1] * force[1]).sqrt();
        if size < SMALLEST_SHARE * self.largest {
            return;
        }
        let end = shifted(start, force, LONGEST_ARROW / self.largest);
        arrow(drawing, [self.at(start), self.at(end)], stroke);
        if !letter.is_empty() {
            let [x, y] = self.at(shifted(end, force, LETTER_DISTANCE / size));
            let letter = format!("_{letter}_");
            drawing.text(letter, [x, y + 4.0], MEDIUM, Anchor::Middle);
        }
    }

    /// Draws a bar as long as the arrow of a round force.
    fn scale_bar(&self, drawing: &mut Drawing) {
        let round = round_below(self.largest / self.epsilon);
        let length = round * self.epsilon * (LONGEST_ARROW / self.largest) * SCALE;
        let y = self.floor + BELOW_FLOOR * SCALE + 32.0;
        let (from, to) = (
            self.middle - 0.5 * length - 18.0,
            self.middle + 0.5 * length - 18.0,
        );
        drawing.line([[from, y], [to, y]], PLANE);
        for end in [from, to] {
            drawing.line([[end, y - 3.5], [end, y + 3.5]], PLANE);
        }
        let text = format!("{round} _m_ _g_");
        drawing.text(text, [to + 7.0, y + 4.0], SMALL, Anchor::Start);
    }
}

/// Whether the arrows on one side of a contact carry letters: those on cylinder 2, and those of the wall.
fn is_named(contact: &ContactPoint, side: f64) -> bool {
    let on = match contact.partner {
        Partner::Body(other) if side < 0.0 => other,
        _ => contact.body,
    };
    on == 1 || contact.partner == Partner::TopWall
}
