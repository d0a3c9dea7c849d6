//! Spheres, drawn to scale in a parallel projection.

use super::moments::StackPanel;
use super::parts::{
    CAPTION_LINE, FOOT_HEIGHT, LARGE, MEDIUM, SMALL, SMALLEST_SHARE, TITLE_HEIGHT, arrow,
    largest_force, legend, legend_lines, letters, number, round_below, shifted,
};
use crate::figures::drawing::{Anchor, Drawing, Paint, Place, Stroke};
use crate::figures::style::{
    BODY_OUTLINE, FLOOR, GRID, INK, NORMAL_FORCE, ORIENTATION, PLANE, SHADOW, SPHERE_AT_START,
    SPHERE_SHADES, TANGENTIAL_FORCE, WALL,
};
use crate::model::Stack;
use crate::series::{ContactPoint, Frame, Partner, PlacedBody};

/// Pixels per r.
const SCALE: f64 = 50.0;
/// Angle in degrees by which the viewer looks down on the floor.
const ELEVATION: f64 = 20.0;
/// Angle in degrees by which x points to the back. With it, no sphere of a usual ring hides another one.
const TURN: f64 = 40.0;
/// Length of the arrow of the largest force of a panel, in r. It is the force of the wall, of which each sphere bears
/// a part.
const LONGEST_ARROW: f64 = 1.3;
/// Distance of the arrow of a tangential force from the wall, in r.
const SIDESTEP: f64 = 0.09;
/// Distance from the tip of an arrow to its letter, in r.
const LETTER_DISTANCE: f64 = 0.16;
/// Distances of the number of a sphere from its centre, outwards and upwards, in r: for a sphere behind the axis,
/// where others may hide the middle, and for one in front of it.
const NUMBER_BEHIND: [f64; 2] = [0.35, 0.55];
const NUMBER_IN_FRONT: [f64; 2] = [0.55, 0.12];
/// Smallest and largest half-width of the floor, in r. Spheres far beyond it have flown apart, and are not drawn.
const FLOOR_WIDTHS: (f64, f64) = (2.3, 12.0);
/// Distance from the spheres to the edge of the floor, in r.
const FLOOR_EDGE: f64 = 0.2;
/// Half-width of the part of the top wall that is drawn, in r.
const WALL_WIDTH: f64 = 1.1;
/// Number of points on the outline of a shadow, or on half a great circle.
const CORNERS: u32 = 48;
/// Step in radius from one shade to the next, and how far each is moved towards the light, as parts of the radius.
const SHADE: (f64, f64) = (0.2, 0.1);

/// Describes the projection in words.
pub(super) fn projection() -> String {
    format!(
        "Parallel projection, seen from {ELEVATION}° above the floor, with _x_ turned to the back by {TURN}°; a square of the grid is 1 _r_ wide."
    )
}

/// Draws `panels` side by side above lines of caption, with the forces of floor and top wall on the spheres in m g.
pub(super) fn drawn(panels: &[StackPanel], stack: &Stack, caption: &[String]) -> Drawing {
    let camera = Camera::new();
    let frames = || panels.iter().map(|panel| panel.frame);
    let (least, most) = FLOOR_WIDTHS;
    let floor_width = frames().map(reach).fold(least, f64::max).min(most);
    let above = frames().map(|frame| camera.height(frame));
    let above = above.fold(0.0, f64::max).min(2.0 * most);
    let [half_width, below] = camera.corner(floor_width);
    let panel_width = 2.0 * (half_width + 0.1) * SCALE;
    let floor = TITLE_HEIGHT + (above + 0.15) * SCALE;
    let foot = floor + (below + 0.1) * SCALE;
    let width = panel_width * panels.len() as f64;
    let legend_lines = legend_lines("sphere", width) as f64;
    let height = foot + FOOT_HEIGHT + CAPTION_LINE * (caption.len() as f64 + legend_lines) + 8.0;
    let mut drawing = Drawing::new(width, height);
    for (index, panel) in panels.iter().enumerate() {
        let view = View {
            camera,
            middle: panel_width * (index as f64 + 0.5),
            floor,
            foot,
            floor_width,
            stack,
            largest: largest_force(panel.frame.contacts.iter().filter(|own| is_drawn(own))),
        };
        view.draw(&mut drawing, panel, char::from(b'a' + (index % 26) as u8));
    }
    let mut line = foot + FOOT_HEIGHT + 6.0;
    legend(&mut drawing, "sphere", line, width);
    line += CAPTION_LINE * (legend_lines - 1.0);
    for text in caption {
        line += CAPTION_LINE;
        drawing.text(text, [12.0, line], SMALL, Anchor::Start);
    }
    drawing
}

/// Returns half the width of a floor that carries all spheres.
fn reach(frame: &Frame) -> f64 {
    let sides = frame.bodies.iter().map(|body| {
        let [x, _, z] = body.position;
        x.abs().max(z.abs()) + 1.0 + FLOOR_EDGE
    });
    sides.fold(0.0, f64::max)
}

fn is_seen(body: &PlacedBody) -> bool {
    let (_, most) = FLOOR_WIDTHS;
    let mut position = body.position.iter();
    position.all(|component| component.abs() <= 2.0 * most)
}

/// Whether a contact is drawn: forces between spheres would be lost in the picture.
fn is_drawn(contact: &ContactPoint) -> bool {
    !matches!(contact.partner, Partner::Body(_))
}

fn product(one: [f64; 3], other: [f64; 3]) -> f64 {
    one[0] * other[0] + one[1] * other[1] + one[2] * other[2]
}

fn cross([a, b, c]: [f64; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

/// Returns `from` moved by `share` times `direction`.
fn moved(from: [f64; 3], direction: [f64; 3], share: f64) -> [f64; 3] {
    [0, 1, 2].map(|axis: usize| from[axis] + share * direction[axis])
}

/// Returns `vector` turned by a rotation vector.
fn rotated(vector: [f64; 3], rotation: [f64; 3]) -> [f64; 3] {
    let angle = libm::sqrt(product(rotation, rotation));
    if angle == 0.0 {
        return vector;
    }
    let axis = rotation.map(|component| component / angle);
    let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
    let kept = vector.map(|component| cosine * component);
    let turned = moved(kept, cross(axis, vector), sine);
    moved(turned, axis, (1.0 - cosine) * product(axis, vector))
}

/// The directions of a parallel projection, as seen from far away.
#[derive(Debug, Clone, Copy)]
struct Camera {
    /// To the right on the picture.
    right: [f64; 3],
    /// Upwards on the picture.
    up: [f64; 3],
    /// Towards the viewer.
    viewer: [f64; 3],
}

impl Camera {
    fn new() -> Self {
        let [turn, elevation] = [TURN, ELEVATION].map(f64::to_radians);
        // y is upwards, and x, y, z are right-handed, so that z points to the viewer where nothing is turned.
        let (sine, cosine) = (libm::sin(elevation), libm::cos(elevation));
        let right = [libm::cos(turn), 0.0, libm::sin(turn)];
        let level = [-libm::sin(turn), 0.0, libm::cos(turn)];
        Self {
            right,
            up: [-sine * level[0], cosine, -sine * level[2]],
            viewer: [cosine * level[0], sine, cosine * level[2]],
        }
    }

    /// Returns the place of `point` on the picture in r: to the right and upwards from the axis on the floor.
    fn seen(&self, point: [f64; 3]) -> [f64; 2] {
        [product(point, self.right), product(point, self.up)]
    }

    /// Returns how far a square of this half-width reaches to the side and downwards.
    fn corner(&self, half_width: f64) -> [f64; 2] {
        let part = |axis: [f64; 3]| half_width * (axis[0].abs() + axis[2].abs());
        [part(self.right), part(self.up)]
    }

    /// Returns the highest place of a frame on the picture.
    fn height(&self, frame: &Frame) -> f64 {
        let tops = frame
            .bodies
            .iter()
            .map(|body| self.seen(body.position)[1] + 1.0);
        let wall = self.seen([0.0, frame.wall_height, 0.0])[1] + self.corner(WALL_WIDTH)[1];
        tops.fold(wall, f64::max)
    }
}

/// The place of a panel on the drawing.
struct View<'a> {
    camera: Camera,
    middle: f64,
    /// Vertical place, in pixels, at which the axis meets the floor.
    floor: f64,
    /// Vertical place of the lower edge of the picture, in pixels.
    foot: f64,
    floor_width: f64,
    stack: &'a Stack,
    /// The largest force that is drawn, in k_n r.
    largest: f64,
}

impl View<'_> {
    fn at(&self, point: [f64; 3]) -> Place {
        let [x, y] = self.camera.seen(point);
        [self.middle + SCALE * x, self.floor - SCALE * y]
    }

    fn draw(&self, drawing: &mut Drawing, panel: &StackPanel, letter: char) {
        let frame = panel.frame;
        let title = format!("({letter}) {}", panel.title);
        drawing.text(title, [self.middle, 18.0], LARGE, Anchor::Middle);
        let wall = format!(
            "_f_ = {} _m_ _g_",
            number(frame.wall_force / self.stack.epsilon())
        );
        drawing.text(wall, [self.middle, 36.0], MEDIUM, Anchor::Middle);
        // Nearer spheres hide those farther away, so they are drawn later.
        let nearness = |index: &usize| product(frame.bodies[*index].position, self.camera.viewer);
        let mut order: Vec<usize> = (0..frame.bodies.len()).collect();
        order.retain(|&index| is_seen(&frame.bodies[index]));
        order.sort_by(|one, other| nearness(one).total_cmp(&nearness(other)));
        self.floor(drawing);
        let on_floor = order.iter().rev().find(|&&index| index != self.stack.top());
        let nearest = on_floor.copied().unwrap_or_default();
        for &index in &order {
            self.shadow(drawing, &frame.bodies[index]);
        }
        self.grid(drawing);
        for index in order {
            self.sphere(drawing, index, &frame.bodies[index]);
            let on_it = frame.contacts.iter().filter(|own| own.body == index);
            for contact in on_it.filter(|own| own.partner == Partner::Floor) {
                self.contact(drawing, contact, index == nearest);
            }
        }
        self.wall(drawing, frame.wall_height);
        let contacts = frame.contacts.iter();
        for contact in contacts.filter(|own| own.partner == Partner::TopWall) {
            self.contact(drawing, contact, true);
        }
        if self.largest > 0.0 {
            self.scale_bar(drawing);
        }
        self.values(drawing, panel, nearest);
    }

    fn floor(&self, drawing: &mut Drawing) {
        let edge = self.square(self.floor_width, 0.0);
        drawing.polygon(edge, Paint::Filled(FLOOR));
    }

    /// Draws the shadow of a sphere in vertical light, unless it has left the floor.
    fn shadow(&self, drawing: &mut Drawing, body: &PlacedBody) {
        let [x, _, z] = body.position;
        if x.abs().max(z.abs()) + 1.0 > self.floor_width {
            return;
        }
        let corners = (0..CORNERS).map(|corner| {
            let angle = std::f64::consts::TAU * f64::from(corner) / f64::from(CORNERS);
            self.at([x + libm::cos(angle), 0.0, z + libm::sin(angle)])
        });
        drawing.polygon(corners.collect::<Vec<_>>(), Paint::Filled(SHADOW));
    }

    fn grid(&self, drawing: &mut Drawing) {
        let side = self.floor_width;
        let lines = side as i32;
        for line in -lines..=lines {
            let place = f64::from(line);
            let along_x = [[-side, 0.0, place], [side, 0.0, place]];
            let along_z = [[place, 0.0, -side], [place, 0.0, side]];
            for ends in [along_x, along_z] {
                drawing.line(ends.map(|end| self.at(end)), GRID);
            }
        }
        drawing.polygon(self.square(side, 0.0), Paint::Outlined(GRID));
    }

    fn square(&self, side: f64, height: f64) -> [Place; 4] {
        let corners = [(-side, -side), (side, -side), (side, side), (-side, side)];
        corners.map(|(x, z)| self.at([x, height, z]))
    }

    fn wall(&self, drawing: &mut Drawing, height: f64) {
        drawing.polygon(self.square(WALL_WIDTH, height), Paint::Tinted(PLANE, WALL));
    }

    /// Draws the undeformed sphere, its number, and the circle that was its equator at the start, then and now.
    fn sphere(&self, drawing: &mut Drawing, index: usize, body: &PlacedBody) {
        let [x, y] = self.at(body.position);
        let (narrower, towards_light) = SHADE;
        for (shade, colour) in SPHERE_SHADES.into_iter().enumerate() {
            let radius = SCALE * (1.0 - narrower * shade as f64);
            let offset = SCALE * towards_light * shade as f64;
            drawing.circle([x - offset, y - offset], radius, Paint::Filled(colour));
        }
        drawing.circle([x, y], SCALE, Paint::Outlined(BODY_OUTLINE));
        let vertical = [0.0, 1.0, 0.0];
        let now = rotated(vertical, body.rotation);
        for (pole, stroke) in [(vertical, SPHERE_AT_START), (now, ORIENTATION)] {
            let arc = self.great_circle(body.position, pole);
            drawing.line(arc, stroke);
        }
        let [across, _, along] = body.position;
        let behind = across * self.camera.viewer[0] + along * self.camera.viewer[2] < 0.0;
        let is_top = index == self.stack.top();
        let [outwards, upwards] = match behind && !is_top {
            true => NUMBER_BEHIND,
            false => NUMBER_IN_FRONT,
        };
        let to_the_right = !is_top && self.camera.seen(body.position)[0] > 0.0;
        let outwards = if to_the_right { outwards } else { -outwards };
        let place = [x + SCALE * outwards, y - SCALE * upwards + 5.0];
        drawing.text(index + 1, place, LARGE, Anchor::Middle);
    }

    /// Returns the half of a great circle about `pole` that faces the viewer.
    fn great_circle(&self, centre: [f64; 3], pole: [f64; 3]) -> Vec<Place> {
        let viewer = self.camera.viewer;
        let towards = moved(viewer, pole, -product(viewer, pole));
        let size = libm::sqrt(product(towards, towards)).max(f64::MIN_POSITIVE);
        let towards = towards.map(|component| component / size);
        let aside = cross(pole, towards);
        let points = (0..=CORNERS).map(|corner| {
            let angle = std::f64::consts::PI * (f64::from(corner) / f64::from(CORNERS) - 0.5);
            let point = moved(centre, towards, libm::cos(angle));
            self.at(moved(point, aside, libm::sin(angle)))
        });
        points.collect()
    }

    /// Draws the point of contact, and the force on the sphere there, with its letters if it is named.
    fn contact(&self, drawing: &mut Drawing, contact: &ContactPoint, is_named: bool) {
        const POINT_SIZE: f64 = 2.6;
        drawing.circle(self.at(contact.position), POINT_SIZE, Paint::Filled(INK));
        let (normal, tangential) = match is_named {
            true => letters(contact.partner, self.stack.top()),
            false => ("", ""),
        };
        let start = contact.position;
        let (along, across) = (contact.normal_vector(), contact.tangential_vector());
        self.arrow(drawing, start, along, NORMAL_FORCE, normal);
        let beside = moved(start, contact.normal, SIDESTEP);
        self.arrow(drawing, beside, across, TANGENTIAL_FORCE, tangential);
    }

    fn arrow(
        &self,
        drawing: &mut Drawing,
        start: [f64; 3],
        force: [f64; 3],
        stroke: Stroke,
        letter: &str,
    ) {
        let size = libm::sqrt(product(force, force));
        if self.largest == 0.0 || size < SMALLEST_SHARE * self.largest {
            return;
        }
        let end = moved(start, force, LONGEST_ARROW / self.largest);
        let [from, to] = [start, end].map(|point| self.at(point));
        arrow(drawing, [from, to], stroke);
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let length = libm::hypot(dx, dy);
        if !letter.is_empty() && length > 0.0 {
            let [x, y] = shifted(to, [dx, dy], LETTER_DISTANCE * SCALE / length);
            let letter = format!("_{letter}_");
            drawing.text(letter, [x, y + 4.0], MEDIUM, Anchor::Middle);
        }
    }

    /// Draws a bar as long as the arrow of a round force that is vertical.
    fn scale_bar(&self, drawing: &mut Drawing) {
        let epsilon = self.stack.epsilon();
        let round = round_below(self.largest / epsilon);
        let length = self.camera.up[1] * round * epsilon * (LONGEST_ARROW / self.largest) * SCALE;
        let y = self.foot + 42.0;
        let (from, to) = (
            self.middle - 0.5 * length - 36.0,
            self.middle + 0.5 * length - 36.0,
        );
        drawing.line([[from, y], [to, y]], PLANE);
        for end in [from, to] {
            drawing.line([[end, y - 3.5], [end, y + 3.5]], PLANE);
        }
        let text = format!("{round} _m_ _g_, if vertical");
        drawing.text(text, [to + 7.0, y + 4.0], SMALL, Anchor::Start);
    }

    /// Writes the forces on `body`, with the letters of the paper's figure.
    fn values(&self, drawing: &mut Drawing, panel: &StackPanel, body: usize) {
        let top = self.stack.top();
        let ring: Vec<usize> = self.stack.places().map(|place| place.body).collect();
        let position = ring.iter().position(|&other| other == body);
        let next = position.map_or(body, |position| ring[(position + 1) % ring.len()]);
        let bodies = [Partner::Body(top), Partner::Body(next)];
        let known = bodies.into_iter().filter(|_| panel.pair_forces_known);
        let parts = known.chain([Partner::Floor]).flat_map(|partner| {
            let found = panel
                .frame
                .contacts
                .iter()
                .find(|own| touches(own, body, partner));
            let (normal, tangential) = letters(partner, top);
            [
                (normal, found.map_or(0.0, |one| one.normal_force)),
                (tangential, found.map_or(0.0, |one| one.tangential_force)),
            ]
        });
        let parts = parts.filter(|(letter, _)| !letter.is_empty());
        let parts = parts.map(|(letter, force)| {
            let force = number(force.abs() / self.stack.epsilon());
            format!("_{letter}_ = {force}")
        });
        let parts: Vec<String> = parts.collect();
        let between = parts.len().saturating_sub(2);
        let lines = [&parts[..between], &parts[between..]];
        let mut y = self.foot + 10.0;
        for line in lines.into_iter().filter(|line| !line.is_empty()) {
            let words = format!("on sphere {}: {}", body + 1, line.join(",  "));
            drawing.text(words, [self.middle, y], SMALL, Anchor::Middle);
            y += CAPTION_LINE;
        }
    }
}

/// Whether a contact is that of `body` with `partner`, on whichever of the two its force is given.
fn touches(contact: &ContactPoint, body: usize, partner: Partner) -> bool {
    let turned = Partner::Body(contact.body) == partner && contact.partner == Partner::Body(body);
    turned || (contact.body == body && contact.partner == partner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_of_the_picture_are_right_handed_unit_vectors() {
        let Camera { right, up, viewer } = Camera::new();
        for (one, other, third) in [
            (right, up, viewer),
            (up, viewer, right),
            (viewer, right, up),
        ] {
            let expected = cross(one, other);
            assert!((0..3).all(|axis| (expected[axis] - third[axis]).abs() < 1e-15));
        }
        assert!(up[1] > 0.9 && viewer[1] > 0.0);
    }

    #[test]
    fn rotations_are_right_handed_and_keep_lengths() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let turned = rotated([1.0, 0.0, 0.0], [0.0, 0.0, quarter]);
        assert!((turned[1] - 1.0).abs() < 1e-15 && turned[0].abs() < 1e-15);
        let turned = rotated([1.0, -2.0, 0.5], [0.3, 1.0, -0.7]);
        assert!((product(turned, turned) - 5.25).abs() < 1e-14);
        assert_eq!(rotated([1.0, 2.0, 3.0], [0.0; 3]), [1.0, 2.0, 3.0]);
    }

    #[test]
    fn no_sphere_of_a_usual_ring_is_right_behind_another() {
        let camera = Camera::new();
        for bodies in 3..=5 {
            let stack = Stack {
                bodies,
                ..Stack::paper(0.3, 1e2)
            };
            let centres = stack.initial_positions();
            for place in stack.places() {
                for other in stack.places().filter(|other| other.body != place.body) {
                    let [one, two] = [place, other].map(|place| camera.seen(centres[place.body]));
                    assert!(libm::hypot(one[0] - two[0], one[1] - two[1]) > 0.5);
                }
            }
        }
    }
}
