//! What lines and marks mean, the same in every figure, and told apart without colour.

use crate::code::Code;

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

/// Outlines, so that marks at the same place do not hide each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    Dot,
    Circle,
    Square,
    Diamond,
    Cross,
    Plus,
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

    /// The mark of an code: from inside to outside dot, cross, circle, plus, square, diamond.
    pub const fn of(code: Code) -> Self {
        match code {
            Code::Native => Self::new(Shape::Dot, INK, 1.7),
            Code::Liggghts => Self::new(Shape::Circle, BLUE, 3.6),
            Code::Yade => Self::new(Shape::Cross, VERMILION, 3.0),
            Code::YadeFacet => Self::new(Shape::Square, PURPLE, 4.4),
            Code::YadeWall => Self::new(Shape::Diamond, ORANGE, 5.0),
            Code::Lammps => Self::new(Shape::Plus, GREEN, 5.0),
        }
    }
}

/// The name of an code in a figure.
pub(super) const fn code_label(code: Code) -> &'static str {
    match code {
        Code::Native => "native",
        Code::Liggghts => "LIGGGHTS",
        Code::Yade => "YADE, box",
        Code::YadeFacet => "YADE, facet",
        Code::YadeWall => "YADE, wall",
        Code::Lammps => "LAMMPS",
    }
}

/// The onset of slip and the peak on a curve.
pub(super) const ONSET: Mark = Mark::new(Shape::Circle, BLUE, 4.5);
pub(super) const PEAK: Mark = Mark::new(Shape::Diamond, VERMILION, 5.5);
