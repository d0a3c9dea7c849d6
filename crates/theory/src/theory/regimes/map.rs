//! A map over floor friction and one more property of the stack.

use super::super::root::bracketed_root;
use super::release::released_wall_friction;
use super::{Boundary, CLOSING_STIFFNESS_RATIO, EquilibriumPath, LoadingOutcome};
use crate::model::{HistoryUpdate, Stack};
use serde::Serialize;

/// The property that varies besides the floor friction.
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
    /// Returns `stack` with another value on this axis.
    pub fn set(self, stack: &Stack, value: f64) -> Stack {
        let mut changed = *stack;
        match self {
            Self::Stiffness => changed.stiffness = value,
            Self::CylinderFriction => changed.cylinder_friction = value,
            Self::StiffnessRatio => changed.stiffness_ratio = value,
        }
        changed
    }

    /// Returns the value of `stack` on this axis.
    pub fn get(self, stack: &Stack) -> f64 {
        match self {
            Self::Stiffness => stack.stiffness,
            Self::CylinderFriction => stack.cylinder_friction,
            Self::StiffnessRatio => stack.stiffness_ratio,
        }
    }

    /// The name in tables and on the command line.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Stiffness => "stiffness",
            Self::CylinderFriction => "mu_d",
            Self::StiffnessRatio => "kappa",
        }
    }

    /// Whether the axis is logarithmic.
    pub fn is_logarithmic(self) -> bool {
        self != Self::CylinderFriction
    }
}

/// A rectangle in the plane of floor friction and one more property.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RegimeMap {
    /// The property that varies besides the floor friction.
    pub axis: Axis,
    /// The stack with all values that do not vary.
    pub base: Stack,
    /// The rule by which tangential springs change as their contacts turn.
    pub history_update: HistoryUpdate,
    /// Lowest and highest value on the axis.
    pub range: (f64, f64),
    /// Lowest and highest floor friction.
    pub frictions: (f64, f64),
}

/// Number of values on an axis, between which lines are searched.
const SEARCHED_VALUES: usize = 65;

impl RegimeMap {
    /// The three maps: over stiffness, cylinder friction and stiffness ratio. Each varies the paper's stack at
    /// stiffness 100, with `stiffness_ratio` where that is not the axis.
    pub fn standard(stiffness_ratio: f64, history_update: HistoryUpdate) -> [Self; 3] {
        let over = |axis, range| Self {
            axis,
            base: Stack {
                stiffness_ratio,
                ..Stack::paper(0.3, 100.0)
            },
            history_update,
            range,
            frictions: (0.02, 0.8),
        };
        [
            over(Axis::Stiffness, (10.0, 1e5)),
            over(Axis::CylinderFriction, (0.2, 0.8)),
            over(Axis::StiffnessRatio, (0.2, 20.0)),
        ]
    }

    /// Returns `count` values on the axis, both ends included, evenly spaced on its linear or logarithmic scale.
    pub fn axis_values(&self, count: usize) -> Vec<f64> {
        spread(self.range, count, self.axis.is_logarithmic())
    }

    /// Returns `count` floor frictions, evenly spaced, both ends included.
    pub fn friction_values(&self, count: usize) -> Vec<f64> {
        spread(self.frictions, count, false)
    }

    /// Length of an interval of the axis, on the scale of the axis.
    pub fn width(&self, (from, to): (f64, f64)) -> f64 {
        if self.axis.is_logarithmic() {
            libm::log(to / from)
        } else {
            to - from
        }
    }

    /// Midpoint of an interval of the axis, on the scale of the axis.
    pub fn middle(&self, part: (f64, f64)) -> f64 {
        spread(part, 3, self.axis.is_logarithmic())[1]
    }

    /// The stack at a value on the axis and a floor friction.
    pub fn stack(&self, value: f64, floor_friction: f64) -> Stack {
        Stack {
            floor_friction,
            ..self.axis.set(&self.base, value)
        }
    }

    /// The path of equilibria at a value on the axis.
    pub fn path(&self, value: f64) -> EquilibriumPath {
        EquilibriumPath::new(&self.axis.set(&self.base, value), self.history_update)
    }

    /// The boundaries in μ at a value on the axis, as far as they lie on the map.
    pub fn friction_boundaries(&self, value: f64) -> Vec<Boundary> {
        let stack = self.axis.set(&self.base, value);
        let all = Boundary::in_friction(&self.path(value), &stack).into_iter();
        let (lowest, highest) = self.frictions;
        all.filter(|boundary| (lowest..=highest).contains(&boundary.floor_friction))
            .collect()
    }

    /// The boundaries that do not depend on the floor friction: where the cylinders just bear their own weight,
    /// where they slip just as the wall arrives, and where contact 2–3 closes.
    pub fn lines(&self) -> Vec<Line> {
        let mut lines = Vec::new();
        let path = |value: f64| self.path(value);
        let cylinder_friction = |value: f64| self.axis.set(&self.base, value).cylinder_friction;
        let own_weight = |value| path(value).settled_pair_ratio() - cylinder_friction(value);
        let wall = |value| {
            let needed = path(value).wall_contact_pair_ratio();
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

    /// The floor friction above which `line` is a boundary. With less, the floor slips first on both sides of the
    /// line.
    pub fn lowest_friction_of(&self, line: Line) -> f64 {
        let path = self.path(line.value());
        let end = match line {
            Line::WallArrivesAsCylindersSlip(_) => path.wall_contact(),
            _ => Some(path.settled()),
        };
        let needed = end.map(|end| path.largest_until(end, |point| point.floor_ratio));
        needed.map_or(self.frictions.0, |needed| needed.max(self.frictions.0))
    }

    /// The values on the axis at which contact 2–3 has just opened again when gravity is complete, or when the wall
    /// reaches the bottom cylinders; beyond them the frictions of [`super::released_frictions`] no longer matter. Also
    /// the values at which the failure of stacks above those frictions changes.
    pub fn reopenings(&self) -> Vec<f64> {
        let path = |value: f64| self.path(value);
        let settled = self.roots(|value| path(value).settled_outward());
        let wall = self.roots(|value| path(value).wall_contact_outward().unwrap_or(f64::NAN));
        let pair = self.roots(|value| {
            let stack = self.axis.set(&self.base, value);
            let needed = released_wall_friction(&path(value), &stack).unwrap_or(f64::NAN);
            needed - stack.cylinder_friction
        });
        settled.chain(wall).chain(pair).collect()
    }

    /// Points on every boundary, with the outcomes on both sides at a relative distance of `distance`. The boundaries
    /// in μ have points at `count` values on the axis, and each line has them at `count` floor frictions.
    pub fn boundary_points(&self, count: usize, distance: f64) -> Vec<BoundaryPoint> {
        let mut places = Vec::new();
        for value in self.axis_values(count) {
            let boundaries = self.friction_boundaries(value).into_iter();
            let stacks = boundaries.map(|boundary| self.stack(value, boundary.floor_friction));
            places.extend(stacks.map(|stack| (stack, Across::Friction)));
        }
        for line in self.lines() {
            let lowest = self.lowest_friction_of(line);
            let width = (self.frictions.1 - lowest).max(0.0) / count as f64;
            // In the middle of each part, so that no point lies where the line meets another boundary.
            let frictions = (0..count).map(|index| lowest + width * (index as f64 + 0.5));
            let stacks = frictions.map(|friction| self.stack(line.value(), friction));
            places.extend(stacks.map(|stack| (stack, Across::Axis(self.axis))));
        }
        let points = places.into_iter();
        points
            .filter_map(|(stack, across)| BoundaryPoint::new(self, stack, across, distance))
            .collect()
    }

    fn roots(&self, function: impl Fn(f64) -> f64) -> impl Iterator<Item = f64> {
        let values = self.axis_values(SEARCHED_VALUES);
        let heights: Vec<f64> = values.iter().map(|&value| function(value)).collect();
        let roots = (1..values.len()).filter_map(|index| {
            let changes = (heights[index - 1] < 0.0) != (heights[index] < 0.0);
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

/// The property that changes when a boundary is crossed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Across {
    /// μ.
    Friction,
    /// The other property of the map.
    Axis(Axis),
}

impl Across {
    /// `stack` with the property multiplied by `factor`.
    pub fn scale(self, stack: &Stack, factor: f64) -> Stack {
        match self {
            Self::Friction => Stack {
                floor_friction: stack.floor_friction * factor,
                ..*stack
            },
            Self::Axis(axis) => axis.set(stack, axis.get(stack) * factor),
        }
    }
}

/// A stack on a boundary, and the predicted outcomes of its neighbours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundaryPoint {
    /// The axis of the map besides the floor friction.
    pub map: Axis,
    /// The rule by which tangential springs change as their contacts turn.
    pub history_update: HistoryUpdate,
    /// The stack on the boundary.
    pub stack: Stack,
    /// The property that changes across the boundary.
    pub across: Across,
    /// Relative distance of the neighbours from the boundary.
    pub distance: f64,
    /// Outcomes of the lower and the upper neighbour.
    pub sides: [LoadingOutcome; 2],
}

impl BoundaryPoint {
    /// `stack` as a point on a boundary. `None` if a neighbour has no outcome.
    fn new(map: &RegimeMap, stack: Stack, across: Across, distance: f64) -> Option<Self> {
        let history_update = map.history_update;
        let side = |factor: f64| LoadingOutcome::of(&across.scale(&stack, factor), history_update);
        Some(Self {
            map: map.axis,
            history_update,
            sides: [side(1.0 - distance)?, side(1.0 + distance)?],
            stack,
            across,
            distance,
        })
    }

    /// The lower and the upper neighbour.
    pub fn neighbours(&self) -> [Stack; 2] {
        [1.0 - self.distance, 1.0 + self.distance]
            .map(|factor| self.across.scale(&self.stack, factor))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_found_also_where_it_meets_a_value_that_is_looked_at() {
        let [map, ..] = RegimeMap::standard(2.5, HistoryUpdate::Fixed);
        let values = map.axis_values(SEARCHED_VALUES);
        let between = (values[30] * values[31]).sqrt();
        for place in [values[1], values[30], between, values[63]] {
            for sign in [1.0, -1.0] {
                let found: Vec<f64> = map.roots(|value| sign * (value - place)).collect();
                assert_eq!(found.len(), 1, "{place}: {found:?}");
                assert!((found[0] / place - 1.0).abs() < 1e-14);
            }
        }
    }
}
