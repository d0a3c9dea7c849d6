//! What lines and marks mean, the same in every figure, and told apart without colour.

use crate::code::{Code, Colour};

pub(super) use crate::code::Shape;

/// Black enough for print.
pub(super) const INK: &str = "#1a1a1a";
/// For what is only a help to the eye.
pub(super) const GREY: &str = "#8c8c8c";
/// Colours that stay apart for the colour-blind (Okabe and Ito), darkest first.
const BLUE: &str = "#0072b2";
const VERMILION: &str = "#d55e00";
const PURPLE: &str = "#9c4f86";
const GREEN: &str = "#007d5c";
const ORANGE: &str = "#c98500";

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stroke {
    pub colour: &'static str,
    pub width: f64,
    /// Lengths of dashes and gaps in pixels; solid if empty.
    pub dashes: &'static str,
}

/// A help to the eye.
pub(super) const THIN: Stroke = Stroke::new(INK, 0.8, "");
/// The same for what is the smaller of two.
pub(super) const THIN_DASHED: Stroke = Stroke::new(INK, 0.8, "5 3");
/// A level or a place.
pub(super) const GUIDE: Stroke = Stroke::new(GREY, 0.8, "3 3");
/// What everything is held against.
pub(super) const EXACT: Stroke = Stroke::new(INK, 1.5, "");
/// The other theories.
pub(super) const RIGID: Stroke = Stroke::new(PURPLE, 1.8, "2 2.5");
pub(super) const PERTURBATION: Stroke = Stroke::new(VERMILION, 1.5, "7 3.5");
pub(super) const ELASTIC: Stroke = Stroke::new(BLUE, 1.5, "8 3 1.5 3");
pub(super) const NAIVE: Stroke = Stroke::new(GREEN, 1.5, "3.5 2.5");

/// The stiffnesses of the paper, softest first.
pub(super) const STIFFNESS_STROKES: [Stroke; 3] = [
    Stroke::new(INK, 1.5, ""),
    Stroke::new(BLUE, 1.5, "7 3.5"),
    Stroke::new(PURPLE, 1.8, "2 2.5"),
];

impl Stroke {
    /// A line of `width` pixels.
    pub const fn new(colour: &'static str, width: f64, dashes: &'static str) -> Self {
        Self {
            colour,
            width,
            dashes,
        }
    }
}

/// What marks a point.
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

/// Half the width of a mark: from inside to outside dot, cross, circle, square, diamond and plus.
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

    /// The same smaller, where many stand close together.
    pub const fn small(self) -> Self {
        Self {
            size: 0.7 * self.size,
            ..self
        }
    }

    /// The mark of a code: that of its manifest, or the next of those that are left.
    pub fn of(code: Code) -> Self {
        let (shape, own) = code.mark().map_or_else(
            || {
                let others = Code::all().into_iter().filter(|other| *other < code);
                let unchosen = others.filter(|other| other.mark().is_none()).count();
                UNCHOSEN[unchosen % UNCHOSEN.len()]
            },
            |mark| (mark.shape, mark.colour),
        );
        Self::new(shape, colour(own), size(shape))
    }
}

/// A measured point that belongs to no code.
pub(super) const POINT: Mark = Mark::new(Shape::Circle, BLUE, size(Shape::Circle));
/// The onset of slip and the peak on a curve.
pub(super) const ONSET: Mark = Mark::new(Shape::Circle, BLUE, 4.5);
pub(super) const PEAK: Mark = Mark::new(Shape::Diamond, VERMILION, 5.5);
