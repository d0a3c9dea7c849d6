//! All theories for one stack, side by side.

use super::{
    ElasticRoot, Limit, LimitCurve, RigidYield, SpeedExcess, elastic_root, naive_load,
    perturbation_load, rigid_yield,
};
use crate::model::{Problem, Stack};

/// The yield force according to one theory, or why that theory gives none.
#[derive(Debug, Clone, PartialEq)]
pub struct Prediction {
    /// F = f/(m g).
    pub yield_force: Option<f64>,
    /// Why there is none.
    pub reason: Option<&'static str>,
}

impl Prediction {
    fn from_load(stack: &Stack, load: Option<f64>, reason: &'static str) -> Self {
        Self {
            yield_force: load.map(|load| load - stack.own_weight()),
            reason: load.is_none().then_some(reason),
        }
    }
}

/// The yield force of one stack according to every theory.
#[derive(Debug, Clone, PartialEq)]
pub struct Predictions {
    /// The stack, and the contact convention, which affects the quasi-static limit alone.
    pub problem: Problem,
    /// Rigid cylinders.
    pub rigid: RigidYield,
    /// Naive expansion.
    pub naive: Prediction,
    /// Singular perturbation.
    pub perturbation: Prediction,
    /// Elastic equation.
    pub elastic: Prediction,
    /// The state at yield by the elastic equation.
    pub elastic_root: Option<ElasticRoot>,
    /// Exact quasi-static limit of the DEM.
    pub quasistatic: Limit,
    /// The DEM at a finite wall speed, if one was asked for.
    pub moving: Option<MovingWall>,
}

/// The effect of a moving wall on the yield force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovingWall {
    /// Speed of the wall in r √(k_n/m).
    pub speed: f64,
    /// What is added per unit of speed; `None` where [`LimitCurve::speed_excess`] gives none.
    pub excess: Option<SpeedExcess>,
}

impl Predictions {
    /// Evaluates every theory for `problem`.
    pub fn new(problem: &Problem) -> Self {
        Self::on(&LimitCurve::new(problem), problem)
    }

    /// Evaluates every theory for each of `problems`. Consecutive ones that differ in their frictions alone share one
    /// path of equilibria.
    pub fn of_each<'a>(
        problems: impl IntoIterator<Item = &'a Problem>,
    ) -> impl Iterator<Item = Self> {
        let mut curve: Option<LimitCurve> = None;
        problems.into_iter().map(move |problem| {
            let kept = curve.take().filter(|own| own.holds(problem));
            let kept = kept.unwrap_or_else(|| LimitCurve::new(problem));
            Self::on(curve.insert(kept), problem)
        })
    }

    fn on(curve: &LimitCurve, problem: &Problem) -> Self {
        let stack = problem.stack();
        let elastic_root = elastic_root(stack);
        Self {
            problem: *problem,
            rigid: rigid_yield(stack),
            naive: Prediction::from_load(stack, naive_load(stack), "the expansion gives F < 0"),
            perturbation: Prediction::from_load(
                stack,
                perturbation_load(stack),
                "the solution is not real or gives F < 0",
            ),
            elastic: Prediction::from_load(
                stack,
                elastic_root.map(|root| root.load),
                "the equation has no root with F >= 0",
            ),
            elastic_root,
            quasistatic: curve.limit(problem),
            moving: None,
        }
    }

    /// Adds the effect of a wall that moves at this `speed`, in r √(k_n/m), to first order.
    #[must_use]
    pub fn at_speed(self, speed: f64) -> Self {
        let curve = LimitCurve::new(&self.problem);
        let excess = curve.speed_excess(&self.problem, &self.quasistatic);
        Self {
            moving: Some(MovingWall { speed, excess }),
            ..self
        }
    }

    /// Peak of F at the speed of the wall, to first order.
    pub fn moving_peak(&self) -> Option<f64> {
        let moving = self.moving?;
        Some(self.quasistatic.peak_force? + moving.excess?.peak * moving.speed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::ContactConvention;

    #[test]
    fn a_moving_wall_adds_its_speed_times_the_excess() {
        let problem = Problem::new(Stack::paper(0.2, 1e4), ContactConvention::TURNING);
        let still = Predictions::new(&problem.unwrap());
        assert_eq!(still.moving_peak(), None);
        // Limit and coefficient by runs at two speeds.
        let expected = 4.880_027_89 + 41_762.7 * 1e-6;
        let moving = still.at_speed(1e-6).moving_peak().unwrap();
        assert!((moving - expected).abs() < 1e-7, "{moving}");
    }

    #[test]
    fn each_of_several_stacks_has_its_own_predictions() {
        let problems = [(0.2, 1e2), (0.3, 1e2), (0.3, 1e3)].map(|(friction, stiffness)| {
            let stack = Stack::paper(friction, stiffness);
            Problem::new(stack, ContactConvention::PAPER).unwrap()
        });
        let each: Vec<Predictions> = Predictions::of_each(&problems).collect();
        assert_eq!(each.len(), problems.len());
        for (own, problem) in each.iter().zip(&problems) {
            let alone = Predictions::new(problem);
            assert_eq!(own.problem, *problem);
            assert_eq!(own.perturbation, alone.perturbation);
            let [own, alone] = [own, &alone].map(|one| one.quasistatic.yield_force.unwrap());
            assert!((own / alone - 1.0).abs() < 1e-12, "{own} {alone}");
        }
    }
}
