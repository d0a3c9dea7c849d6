//! The stack drawn to scale, with its contact forces as arrows.

use super::Figure;
use super::drawing::{Anchor, Drawing, Paint, Place, Stroke};
use super::style::{
    BODY, BODY_OUTLINE, HATCH, NORMAL_FORCE, ORIENTATION, ORIENTATION_AT_START, PLANE,
    TANGENTIAL_FORCE,
};
use crate::model::{Case, exact};
use crate::output::{friction, significant};
use crate::paper::reproduction::Snapshots;
use crate::series::{ContactPoint, Frame, Frames, Partner, PlacedCylinder};

/// Pixels per r.
const SCALE: f64 = 60.0;
/// Length of the arrow of the largest force of a panel, in r.
const LONGEST_ARROW: f64 = 1.0;
/// Forces below this part of the largest are not drawn.
const SMALLEST_SHARE: f64 = 0.02;
/// Distance between the arrows of action and reaction, in r.
const SIDESTEP: f64 = 0.055;
/// Distance from the tip of an arrow to its letter, in r.
const LETTER_DISTANCE: f64 = 0.13;
/// Smallest half-width of a panel, in r.
const NARROWEST: f64 = 2.35;
/// Largest half-width of a panel, in r. A wider stack has exploded, and its cylinders are far outside.
const WIDEST: f64 = 20.0;
/// A stack is in collapse when its force is below this part of the largest.
const FALLEN: f64 = 0.75;
const ABOVE_WALL: f64 = 0.3;
const BELOW_FLOOR: f64 = 0.3;
const TITLE_HEIGHT: f64 = 44.0;
const FOOT_HEIGHT: f64 = 62.0;
const CAPTION_LINE: f64 = 15.0;
/// Length of the head of an arrow, in pixels.
const HEAD: f64 = 8.0;
const SMALL: f64 = 11.0;
const MEDIUM: f64 = 12.0;
const LARGE: f64 = 14.0;

/// One moment of a stack.
#[derive(Debug, Clone, PartialEq)]
pub struct StackPanel<'a> {
    /// The name of the moment, such as "at rest".
    pub title: &'static str,
    /// The stack.
    pub frame: &'a Frame,
    /// Whether the forces between the cylinders are among its contacts.
    pub pair_forces_known: bool,
}

/// The stack of a run at rest, at its largest force, and in collapse, at about half that force, or else at the end of
/// the run.
pub fn representative_panels(frames: &Frames) -> Vec<StackPanel<'_>> {
    let all = &frames.frames;
    let force = |index: usize| all[index].wall_force;
    let highest = (0..all.len()).max_by(|&i, &j| force(i).total_cmp(&force(j)));
    let (Some(highest), Some(last)) = (highest, all.len().checked_sub(1)) else {
        return Vec::new();
    };
    let bearing = (highest + 1..all.len()).take_while(|&index| force(index) > 0.0);
    let from_half = |index: usize| (force(index) - 0.5 * force(highest)).abs();
    let half = bearing.min_by(|&i, &j| from_half(i).total_cmp(&from_half(j)));
    let fallen = |index: &usize| force(*index) < FALLEN * force(highest);
    let collapsing = half.filter(fallen).or((highest..=last).find(fallen));
    let panel = |title: &'static str, index: usize| StackPanel {
        title,
        frame: &all[index],
        pair_forces_known: frames.pair_forces_known,
    };
    let mut panels = vec![panel("at rest", 0)];
    if highest < last {
        panels.push(panel("at yield", highest));
    }
    panels.push(match collapsing {
        Some(index) => panel("in collapse", index),
        None => panel("at the end of the run", last),
    });
    panels
}

/// The picture of one run as SVG: its [`representative_panels`] with a caption on code and stack.
pub fn run_svg(code: &str, case: &Case, frames: &Frames) -> String {
    let stack = &case.stack;
    let mut caption = vec![format!(
        "{code}: _μ_ = {}, _k_ₙ _r_/(_m_ _g_) = {}, _κ_ = {}, _μ__{{d}} = {}. Circles: undeformed cylinders, so that overlaps show compression; ticks: orientation now and (light) at the start.",
        friction(stack.floor_friction),
        stack.stiffness,
        exact(stack.stiffness_ratio),
        exact(stack.cylinder_friction),
    )];
    if !frames.pair_forces_known {
        caption.push(format!(
            "{code} reports the forces of floor and wall alone; those between the cylinders are not drawn."
        ));
    }
    drawn(&representative_panels(frames), stack.epsilon(), &caption).svg()
}

/// The stack of the report at rest, at yield and in collapse.
pub(super) fn stack(snapshots: &Snapshots) -> Figure {
    let panels = representative_panels(&snapshots.frames);
    let stack = &snapshots.case.stack;
    let caption = format!(
        "Not in the paper: the stack at rest, at yield and in collapse, drawn to scale, with the contact forces \
         on each cylinder as arrows (dark: normal, light: tangential; a and b between cylinders 1 and 2, d and \
         e at the floor, f at the wall), at μ = {}, kₙ r/(m g) = {}, κ = {}: one native run. Ticks: orientation \
         now and (light) at the start.",
        stack.floor_friction, stack.stiffness, stack.stiffness_ratio
    );
    Figure::new("stack", caption, drawn(&panels, stack.epsilon(), &[]))
}

/// `panels` side by side with forces in m g, above lines of caption. `epsilon` is m g in k_n r.
///
/// The forces are those on each cylinder, from the contact inwards; where two cylinders touch, each has its
/// own arrows.
fn drawn(panels: &[StackPanel], epsilon: f64, caption: &[String]) -> Drawing {
    let widths = panels.iter().map(|panel| reach(panel.frame) + 0.25);
    let half_width = widths.fold(NARROWEST, f64::max).min(WIDEST);
    let heights = panels.iter().map(|panel| top(panel.frame));
    let highest = heights.fold(2.0, f64::max).min(2.0 * WIDEST);
    let panel_width = 2.0 * half_width * SCALE;
    let floor = TITLE_HEIGHT + (highest + ABOVE_WALL) * SCALE;
    let below = floor + BELOW_FLOOR * SCALE;
    let height = below + FOOT_HEIGHT + CAPTION_LINE * (caption.len() as f64 + 1.0) + 8.0;
    let mut drawing = Drawing::new(panel_width * panels.len() as f64, height);
    for (index, panel) in panels.iter().enumerate() {
        let view = View {
            middle: panel_width * (index as f64 + 0.5),
            floor,
            half_width,
            epsilon,
            largest: largest_force(panel.frame),
        };
        view.draw(&mut drawing, panel, char::from(b'a' + (index % 26) as u8));
    }
    let mut line = below + FOOT_HEIGHT + 6.0;
    legend(&mut drawing, line);
    for text in caption {
        line += CAPTION_LINE;
        drawing.text(text, [12.0, line], SMALL, Anchor::Start);
    }
    drawing
}

/// The largest horizontal distance of a cylinder's edge from the middle.
fn reach(frame: &Frame) -> f64 {
    let cylinders = frame.cylinders.iter();
    let sides = cylinders.map(|cylinder| cylinder.position[0].abs() + 1.0);
    sides.fold(0.0, f64::max)
}

fn top(frame: &Frame) -> f64 {
    let cylinders = frame.cylinders.iter();
    let tops = cylinders.map(|cylinder| cylinder.position[1] + 1.0);
    tops.fold(frame.wall_height, f64::max)
}

fn largest_force(frame: &Frame) -> f64 {
    let contacts = frame.contacts.iter();
    let forces = contacts.flat_map(|own| [own.normal_force.abs(), own.tangential_force.abs()]);
    forces.fold(0.0, f64::max)
}

/// Samples of both kinds of arrows.
fn legend(drawing: &mut Drawing, y: f64) {
    let middle = y - 3.5;
    arrow(drawing, [[12.0, middle], [40.0, middle]], NORMAL_FORCE);
    drawing.text("normal force", [46.0, y], SMALL, Anchor::Start);
    let tangential = [[130.0, middle], [158.0, middle]];
    arrow(drawing, tangential, TANGENTIAL_FORCE);
    let words = "tangential force on each cylinder, from the contact inwards; numbers in _m_ _g_";
    drawing.text(words, [164.0, y], SMALL, Anchor::Start);
}

/// The place of a panel on the drawing.
struct View {
    middle: f64,
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
        self.centred(drawing, title, 18.0, LARGE);
        let wall = format!("_f_ = {} _m_ _g_", number(force));
        self.centred(drawing, wall, 36.0, MEDIUM);
        self.planes(drawing, frame);
        for (index, cylinder) in frame.cylinders.iter().enumerate() {
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

    /// Floor and top wall, hatched on their far side.
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

    /// The undeformed circle, its number, and its orientation now and at the start.
    fn cylinder(&self, drawing: &mut Drawing, index: usize, cylinder: &PlacedCylinder) {
        let [x, y] = cylinder.position;
        drawing.circle(self.at([x, y]), SCALE, Paint::Tinted(BODY_OUTLINE, BODY));
        // Directions without a contact at rest.
        let rest = [0.0, 0.8, std::f64::consts::PI - 0.8][index % 3];
        for (angle, stroke) in [
            (rest, ORIENTATION_AT_START),
            (rest + cylinder.angle, ORIENTATION),
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

    /// The values of the forces, with the letters of the paper's figure.
    fn values(&self, drawing: &mut Drawing, panel: &StackPanel) {
        let pairs = [(1, Partner::Cylinder(0)), (2, Partner::Cylinder(1))];
        let known = pairs.into_iter().filter(|_| panel.pair_forces_known);
        let parts = known.chain([(1, Partner::Floor)]).flat_map(|contact| {
            let mut all = panel.frame.contacts.iter();
            let found = all.find(|one| (one.cylinder, one.partner) == contact);
            let (normal, tangential) = letters(contact.1);
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

    /// The force on the cylinder, and the opposite one on its partner if that is a cylinder too.
    fn contact(&self, drawing: &mut Drawing, contact: &ContactPoint) {
        let partners = matches!(contact.partner, Partner::Cylinder(_));
        let sides: &[f64] = if partners { &[1.0, -1.0] } else { &[1.0] };
        for &side in sides {
            let towards = |vector: [f64; 2]| vector.map(|component| side * component);
            let inwards = towards(contact.normal);
            let (along, across) = (contact.normal_vector(), contact.tangential_vector());
            let named = match is_named(contact, side) {
                true => letters(contact.partner),
                false => ("", ""),
            };
            let start = if partners { SIDESTEP } else { 0.0 };
            let start = shifted(contact.position, inwards, start);
            self.arrow(drawing, start, towards(along), NORMAL_FORCE, named.0);
            let start = shifted(contact.position, inwards, 1.6 * SIDESTEP);
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

    /// A round force and its length.
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

/// An arrow with a filled head for a normal force, an open one for a tangential force. That of a short arrow shrinks
/// with it.
fn arrow(drawing: &mut Drawing, [from, to]: [Place; 2], stroke: Stroke) {
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let length = (dx * dx + dy * dy).sqrt();
    if length == 0.0 {
        return;
    }
    let head = HEAD.min(0.6 * length);
    let along = [dx / length, dy / length];
    let across = [-along[1], along[0]];
    let foot = shifted(to, along, -head);
    let [left, right] = [0.42, -0.42].map(|share| shifted(foot, across, share * head));
    if stroke == NORMAL_FORCE {
        drawing.line([from, foot], stroke);
        drawing.polygon([left, to, right], Paint::Filled(stroke.colour));
    } else {
        drawing.line([from, to], stroke);
        let thinner = Stroke {
            width: 1.6,
            ..stroke
        };
        drawing.line([left, to, right], thinner);
    }
}

/// The letters of normal and tangential force in the paper's figure.
fn letters(partner: Partner) -> (&'static str, &'static str) {
    match partner {
        Partner::Cylinder(0) => ("a", "b"),
        Partner::Cylinder(_) => ("c", ""),
        Partner::Floor => ("d", "e"),
        Partner::TopWall => ("f", ""),
    }
}

/// Whether the arrows on one side of a contact carry letters: those on cylinder 2, and those of the wall.
fn is_named(contact: &ContactPoint, side: f64) -> bool {
    let on = match contact.partner {
        Partner::Cylinder(other) if side < 0.0 => other,
        _ => contact.cylinder,
    };
    on == 1 || contact.partner == Partner::TopWall
}

fn shifted(from: Place, direction: Place, by: f64) -> Place {
    [from[0] + by * direction[0], from[1] + by * direction[1]]
}

/// The largest of 1, 2, 5 times a power of ten that is not above `value`.
fn round_below(value: f64) -> f64 {
    let power = libm::exp10(libm::floor(libm::log10(value)));
    let round = [5.0, 2.0, 1.0]
        .into_iter()
        .find(|digit| digit * power <= value * (1.0 + 1e-12));
    // A power of ten below 1 is not exact; as text and back it is the nearest one.
    let exact = format!("{:.0e}", round.unwrap_or(1.0) * power);
    exact.parse().unwrap_or(value)
}

/// Three or four digits, and zero where the force is round-off.
fn number(weights: f64) -> String {
    if weights.abs() < 5e-4 {
        return "0".to_owned();
    }
    significant(weights, if weights.abs() < 1.0 { 3 } else { 4 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scale_bars_are_round() {
        for (value, round) in [
            (15.6, 10.0),
            (0.58, 0.5),
            (2.0, 2.0),
            (1e3, 1e3),
            (0.0299, 0.02),
        ] {
            assert_eq!(round_below(value), round);
        }
    }
}
