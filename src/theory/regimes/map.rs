//! A map over floor friction and one more property of the stack.

use super::super::root::bracketed_root;
use super::{Boundary, CLOSING_STIFFNESS_RATIO, Course};
use crate::stack::Stack;
use serde::Serialize;

/// What varies besides the floor friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Axis {
    /// 1/ε.
    Stiffness,
    /// μ_d.
    CylinderFriction,
    /// κ.
    StiffnessRatio,
}

impl Axis {
    /// `stack` with another value on this axis.
    pub fn set(self, stack: &Stack, value: f64) -> Stack {
        let mut changed = *stack;
        match self {
            Self::Stiffness => changed.stiffness = value,
            Self::CylinderFriction => changed.cylinder_friction = value,
            Self::StiffnessRatio => changed.stiffness_ratio = value,
        }
        changed
    }

    /// The value of `stack` on this axis.
    pub fn get(self, stack: &Stack) -> f64 {
        match self {
            Self::Stiffness => stack.stiffness,
            Self::CylinderFriction => stack.cylinder_friction,
            Self::StiffnessRatio => stack.stiffness_ratio,
        }
    }

    /// Whether its values spread over decades.
    pub fn is_logarithmic(self) -> bool {
        self != Self::CylinderFriction
    }
}

/// A rectangle of stacks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RegimeMap {
    /// What varies besides the floor friction.
    pub axis: Axis,
    /// Everything that does not vary.
    pub base: Stack,
    /// Lowest and highest value on the axis.
    pub range: (f64, f64),
    /// Lowest and highest floor friction.
    pub frictions: (f64, f64),
}

/// Intervals of an axis in which a line is looked for.
const SEARCHED_INTERVALS: usize = 64;

impl RegimeMap {
    /// `count` values on the axis, both ends included; evenly spread, or over the logarithm.
    pub fn axis_values(&self, count: usize) -> Vec<f64> {
        spread(self.range, count, self.axis.is_logarithmic())
    }

    /// `count` floor frictions, both ends included.
    pub fn friction_values(&self, count: usize) -> Vec<f64> {
        spread(self.frictions, count, false)
    }

    /// The stack at a value on the axis and a floor friction.
    pub fn stack(&self, value: f64, floor_friction: f64) -> Stack {
        Stack {
            floor_friction,
            ..self.axis.set(&self.base, value)
        }
    }

    /// The boundaries in μ at a value on the axis that lie on the map.
    pub fn friction_boundaries(&self, value: f64) -> Vec<Boundary> {
        let stack = self.axis.set(&self.base, value);
        let all = Boundary::in_friction(&Course::new(&stack), &stack).into_iter();
        let (lowest, highest) = self.frictions;
        all.filter(|boundary| (lowest..=highest).contains(&boundary.floor_friction))
            .collect()
    }

    /// The values on the axis at which something changes whatever the floor friction is: where the cylinders
    /// just bear their own weight, where they slip just as the wall arrives, and where contact 2–3 closes.
    pub fn lines(&self) -> Vec<Line> {
        let mut lines = Vec::new();
        let course = |value: f64| Course::new(&self.axis.set(&self.base, value));
        let cylinder_friction = |value: f64| self.axis.set(&self.base, value).cylinder_friction;
        let own_weight = |value| course(value).settled_pair_ratio() - cylinder_friction(value);
        let wall = |value| {
            let needed = course(value).wall_contact_pair_ratio();
            needed.unwrap_or(f64::INFINITY) - cylinder_friction(value)
        };
        lines.extend(self.roots(own_weight).map(Line::CylindersBearTheirWeight));
        lines.extend(self.roots(wall).map(Line::WallArrivesAsCylindersSlip));
        let (lowest, highest) = self.range;
        if self.axis == Axis::StiffnessRatio
            && (lowest..=highest).contains(&CLOSING_STIFFNESS_RATIO)
        {
            lines.push(Line::ContactCloses(CLOSING_STIFFNESS_RATIO));
        }
        lines
    }

    /// The floor friction from which on `line` separates anything: with less, the floor slips first on both
    /// sides of it.
    pub fn lowest_friction_of(&self, line: Line) -> f64 {
        let course = Course::new(&self.axis.set(&self.base, line.value()));
        let end = match line {
            Line::WallArrivesAsCylindersSlip(_) => course.wall_contact(),
            _ => Some(course.settled()),
        };
        let needed = end.map(|end| course.largest_until(end, |point| point.floor_ratio));
        needed.map_or(self.frictions.0, |needed| needed.max(self.frictions.0))
    }

    fn roots(&self, function: impl Fn(f64) -> f64) -> impl Iterator<Item = f64> {
        let values = self.axis_values(SEARCHED_INTERVALS + 1);
        let heights: Vec<f64> = values.iter().map(|&value| function(value)).collect();
        let roots = (1..values.len()).filter_map(|index| {
            let changes = heights[index - 1] * heights[index] < 0.0;
            changes.then(|| bracketed_root(&function, values[index - 1], values[index]))?
        });
        roots.collect::<Vec<_>>().into_iter()
    }
}

/// A boundary that does not depend on the floor friction: a value on the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Line {
    /// b/a = μ_d when gravity is complete.
    CylindersBearTheirWeight(f64),
    /// b/a = μ_d when the wall reaches the bottom cylinders.
    WallArrivesAsCylindersSlip(f64),
    /// κ = κ_c.
    ContactCloses(f64),
}

impl Line {
    /// The value on the axis.
    pub fn value(self) -> f64 {
        match self {
            Self::CylindersBearTheirWeight(value)
            | Self::WallArrivesAsCylindersSlip(value)
            | Self::ContactCloses(value) => value,
        }
    }
}

fn spread((lowest, highest): (f64, f64), count: usize, logarithmic: bool) -> Vec<f64> {
    let last = count.saturating_sub(1).max(1) as f64;
    let between = |index: usize| {
        let fraction = index as f64 / last;
        if logarithmic {
            lowest * libm::pow(highest / lowest, fraction)
        } else {
            lowest + (highest - lowest) * fraction
        }
    };
    (0..count).map(between).collect()
}
