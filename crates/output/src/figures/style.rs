//! The look of every figure: fonts, axes, colours, lines and marks, which differ without colour too.

pub(super) use super::drawing::Stroke;
pub(super) use crate::code::Shape;
use crate::code::{Code, Colour};

/// Fonts of an SVG, in order of preference. A PDF draws DejaVu Sans.
pub(super) const FONT_FAMILY: &str = "Helvetica, Arial, DejaVu Sans, sans-serif";
/// Size of letters in a panel, at ticks and in captions, in pixels.
pub(super) const TEXT_SIZE: f64 = 11.0;
/// Size of the labels of axes.
pub(super) const LABEL_SIZE: f64 = 13.0;
/// Size of the letter that names a panel.
pub(super) const LETTER_SIZE: f64 = 16.0;
/// Half the height of a small letter of [`TEXT_SIZE`].
pub(super) const HALF_LETTER: f64 = 3.8;

/// Margins around the axes of a panel: left, right, top, bottom.
pub(super) const MARGINS: (f64, f64, f64, f64) = (62.0, 12.0, 24.0, 44.0);
/// Distance of two panels.
pub(super) const SPACING: f64 = 10.0;
/// Margin around all panels.
pub(super) const PADDING: f64 = 4.0;
/// The frame of a panel and its ticks.
pub(super) const FRAME: Stroke = Stroke::new(INK, 1.0, &[]);
/// Length of a tick, outwards.
pub(super) const TICK: f64 = 5.0;
/// Distance of lines in a key.
pub(super) const KEY_LINE: f64 = 15.0;
/// Length of a line in a key.
pub(super) const KEY_SAMPLE: f64 = 26.0;
/// Distance of a sample from its words.
pub(super) const KEY_SPACE: f64 = 6.0;
/// Distance of the columns of a key.
pub(super) const KEY_COLUMNS: f64 = 18.0;

/// Near-black for text and lines.
pub(super) const INK: &str = "#1a1a1a";
/// Colour of guides to the eye.
pub(super) const GREY: &str = "#8c8c8c";
/// Colours that stay apart for the colour-blind (Okabe and Ito), darkest first.
const BLUE: &str = "#0072b2";
const VERMILION: &str = "#d55e00";
const PURPLE: &str = "#9c4f86";
const GREEN: &str = "#007d5c";
const ORANGE: &str = "#c98500";

/// Colour of what is not as it should be.
const RED: &str = "#c00000";
/// Colour behind marks that stand side by side for the same value.
pub(super) const TOGETHER: &str = "#f1f1ec";

/// A guide to the eye.
pub(super) const THIN: Stroke = Stroke::new(INK, 0.8, &[]);
/// A guide at a level or a place.
pub(super) const GUIDE: Stroke = Stroke::new(GREY, 0.8, &[3.0, 3.0]);
/// The exact limit.
pub(super) const EXACT: Stroke = Stroke::new(INK, 1.5, &[]);
/// The exact limit after a gravity ramp, beside runs that begin otherwise.
pub(super) const EXACT_AFTER_RAMP: Stroke = Stroke::new(INK, 1.2, &[9.0, 3.0]);
/// The exact limit with Hertz contacts.
pub(super) const HERTZ: Stroke = Stroke::new(INK, 1.2, &[6.0, 2.5, 1.5, 2.5]);
/// The other theories. That of rigid bodies is wide and light where other curves lie on it.
pub(super) const RIGID_BELOW: Stroke = Stroke::new("#e3bfd6", 6.0, &[]);
pub(super) const RIGID: Stroke = Stroke::new(PURPLE, 1.8, &[2.0, 2.5]);
pub(super) const PERTURBATION: Stroke = Stroke::new(VERMILION, 1.5, &[7.0, 3.5]);
pub(super) const ELASTIC: Stroke = Stroke::new(BLUE, 1.5, &[8.0, 3.0, 1.5, 3.0]);
pub(super) const NAIVE: Stroke = Stroke::new(GREEN, 1.5, &[3.5, 2.5]);
/// A bar of a bar chart.
pub(super) const BAR: Stroke = Stroke::new(INK, 9.0, &[]);

/// The stiffnesses of the paper, softest first.
pub(super) const STIFFNESS_STROKES: [Stroke; 3] = [
    Stroke::new(INK, 1.5, &[]),
    Stroke::new(BLUE, 1.5, &[7.0, 3.5]),
    Stroke::new(PURPLE, 1.8, &[2.0, 2.5]),
];

/// The curves of two, three, four and five bodies on the floor.
pub(super) const BODIES_STROKES: [Stroke; 4] = [
    EXACT,
    Stroke::new(BLUE, 1.5, &[9.0, 2.5]),
    Stroke::new(VERMILION, 1.5, &[5.0, 2.5]),
    Stroke::new(GREEN, 1.5, &[8.0, 2.5, 1.5, 2.5]),
];

/// The boundaries in a regime map: beyond the first, another event comes first; beyond the second, the same event has
/// another end.
pub(super) const BOUNDARY: Stroke = Stroke::new(INK, 1.2, &[]);
pub(super) const BOUNDARY_OF_ENDINGS: Stroke = Stroke::new(INK, 1.2, &[8.0, 4.0]);
/// Colours of regions in a regime map, before and after contact 2–3 has closed: light enough for black text, and of
/// different lightness.
pub(super) const FALLS: [&str; 2] = ["#bdbdbd"; 2];
pub(super) const YIELDS: [&str; 2] = ["#fdf6dc", "#e3f1dc"];
pub(super) const SATURATES: [&str; 2] = ["#d3e3f3", "#c3d9df"];
pub(super) const UNKNOWN: [&str; 2] = ["#e4d9ec"; 2];
pub(super) const NO_PEAK: [&str; 2] = ["#f0cdb4", "#bfd9b4"];

/// The stack drawn to scale: cylinders, walls, orientations at the start and now.
pub(super) const BODY: &str = "#5b7fa6";
pub(super) const BODY_OUTLINE: Stroke = Stroke::new(INK, 1.1, &[]);
pub(super) const PLANE: Stroke = Stroke::new(INK, 1.6, &[]);
pub(super) const HATCH: Stroke = Stroke::new(GREY, 0.8, &[]);
pub(super) const ORIENTATION_AT_START: Stroke = Stroke::new("#9aa7b5", 1.2, &[]);
pub(super) const ORIENTATION: Stroke = Stroke::new(INK, 1.8, &[]);
/// Spheres in a projection: shades from the edge to the light, floor, grid and shadows, top wall.
pub(super) const SPHERE_SHADES: [&str; 4] = ["#a3b8ce", "#b3c5d8", "#c5d3e2", "#d8e2ec"];
pub(super) const SPHERE_AT_START: Stroke = Stroke::new("#7488a0", 1.2, &[]);
pub(super) const FLOOR: &str = "#f5f5f2";
pub(super) const SHADOW: &str = "#e1e3e4";
pub(super) const GRID: Stroke = Stroke::new("#c9c9c4", 0.7, &[]);
pub(super) const WALL: &str = GREY;
/// Shafts of the arrows of forces.
pub(super) const NORMAL_FORCE: Stroke = Stroke::new(INK, 2.0, &[]);
pub(super) const TANGENTIAL_FORCE: Stroke = Stroke::new("#c2410c", 2.0, &[]);

/// The mark of a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mark {
    pub shape: Shape,
    pub colour: &'static str,
    /// Half its width, in pixels.
    pub size: f64,
}

/// Marks of codes whose manifests choose none, in turn.
const UNCHOSEN: [(Shape, Colour); 3] = [
    (Shape::Square, Colour::Green),
    (Shape::Diamond, Colour::Blue),
    (Shape::Plus, Colour::Vermilion),
];

/// Returns half the width of a mark. Marks at one place nest: from inside to outside dot, cross, circle, square,
/// diamond and plus.
const fn size(shape: Shape) -> f64 {
    match shape {
        Shape::Dot => 1.7,
        Shape::Cross => 3.0,
        Shape::Circle => 3.6,
        Shape::Square => 4.4,
        Shape::Diamond | Shape::Plus => 5.0,
    }
}

const fn colour(colour: Colour) -> &'static str {
    match colour {
        Colour::Ink => INK,
        Colour::Blue => BLUE,
        Colour::Vermilion => VERMILION,
        Colour::Purple => PURPLE,
        Colour::Orange => ORANGE,
        Colour::Green => GREEN,
    }
}

impl Mark {
    const fn new(shape: Shape, colour: &'static str, size: f64) -> Self {
        Self {
            shape,
            colour,
            size,
        }
    }

    /// A smaller mark, for crowded panels.
    pub const fn small(self) -> Self {
        Self {
            size: 0.7 * self.size,
            ..self
        }
    }

    /// The mark of a code: that of its manifest, or else one of [`UNCHOSEN`] in turn.
    pub fn of(code: &Code) -> Self {
        let (shape, own) = code.mark().map_or_else(
            || UNCHOSEN[code.turn() % UNCHOSEN.len()],
            |mark| (mark.shape, mark.colour),
        );
        Self::new(shape, colour(own), size(shape))
    }
}

/// A point that the authors have published, drawn around that of a code.
pub(super) const PUBLISHED: Mark = Mark::new(Shape::Square, ORANGE, 5.2);
/// A curve that the authors have published.
pub(super) const PUBLISHED_CURVE: Stroke = Stroke::new(ORANGE, 1.5, &[5.0, 3.0]);
/// A measured point that belongs to no code.
pub(super) const POINT: Mark = Mark::new(Shape::Circle, BLUE, size(Shape::Circle));
/// The onset of slip and the peak on a curve.
pub(super) const ONSET: Mark = Mark::new(Shape::Circle, BLUE, 4.5);
pub(super) const PEAK: Mark = Mark::new(Shape::Diamond, VERMILION, 5.5);
/// The ends of a yield curve: below, the stack slides under its own weight; above, the top wall reaches the bottom
/// bodies, or the top one slips on them.
pub(super) const OWN_WEIGHT: Mark = Mark::new(Shape::Dot, INK, 2.4);
pub(super) const WALL_REACHES: Mark = Mark::new(Shape::Diamond, INK, 4.0);
pub(super) const BODIES_SLIP: Mark = Mark::new(Shape::Cross, INK, 3.4);
/// Rings around points on which a comparison is inconclusive, and around those that differ.
pub(super) const INCONCLUSIVE: Mark = Mark::new(Shape::Circle, RED, 8.0);
pub(super) const DIFFERS: Mark = Mark::new(Shape::Square, RED, 8.0);
/// Points of a regime map at which native runs agree with theory, and at which they do not.
pub(super) const CONFIRMED: Mark = Mark::new(Shape::Dot, INK, 2.2);
pub(super) const NOT_CONFIRMED: Mark = Mark::new(Shape::Cross, RED, 2.2);
