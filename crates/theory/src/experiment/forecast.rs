//! Forecasts of an experiment, one for each estimate of the contact stiffness.

use super::{ContactEstimate, Experiment, GRAVITY};
use crate::model::{
    CRITICAL_FRICTION, ContactConvention, HistoryUpdate, InvalidValue, Problem, Stack,
};
use crate::theory::{
    Event, FailureMode, Limit, LoadingOutcome, pair_overlap, perturbation_load, quasistatic_limit,
};
use serde::Serialize;
use std::fmt;

/// Range of the stiffness k_n r/(m g) over which the closed form was compared with its asymptotes; steel cylinders of
/// 1 mm have 3e9.
const STIFFNESS_RANGE: (f64, f64) = (1.0, 1e12);
/// Maximum number of iterations: the secant of Hertz's law and the overlap at yield determine each other.
const ROUNDS: usize = 60;

/// Where the floor friction lies relative to the rigid critical friction μ_c.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FrictionRegime {
    /// μ < μ_c: the yield force is a few weights, however stiff the cylinders are.
    Below,
    /// μ = μ_c within its uncertainty: the yield force grows as 1/√ε.
    At,
    /// μ > μ_c: the yield force grows as 1/ε.
    Above,
}

impl FrictionRegime {
    fn of(experiment: &Experiment) -> Self {
        let distance = experiment.mu - CRITICAL_FRICTION;
        match distance {
            _ if distance.abs() <= experiment.mu_uncertainty => Self::At,
            _ if distance < 0.0 => Self::Below,
            _ => Self::Above,
        }
    }
}

impl fmt::Display for FrictionRegime {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Below => "below mu_c: some weights, however stiff",
            Self::At => "at mu_c: grows as 1/sqrt(epsilon)",
            Self::Above => "above mu_c: grows as 1/epsilon",
        })
    }
}

/// A force in two units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Force {
    /// In m g.
    pub weights: f64,
    /// In N.
    pub newton: f64,
}

/// The forecast by one estimate of the contact.
#[derive(Debug, Clone, PartialEq)]
pub struct Forecasted {
    /// The estimate.
    pub contact: ContactEstimate,
    /// The dimensionless problem, with springs that turn and the stiffness of the estimate, up to 10¹².
    pub problem: Problem,
    /// k_n in N/m.
    pub normal_stiffness: f64,
    /// ε = m g/(k_n r).
    pub epsilon: f64,
    /// 1/ε.
    pub stiffness: f64,
    /// The first event.
    pub event: Event,
    /// Why the first event is not a yield, if it is not.
    pub reason: Option<String>,
    /// Overlap of the contacts between the cylinders at that event, in r.
    pub overlap: f64,
    /// The exact quasi-static yield force (the peak); absent when an event other than floor slip comes first.
    pub yield_force: Option<Force>,
    /// The force at which the floor begins to slip; lower than the peak if the bottom cylinders touch at that moment.
    pub slip_onset: Option<Force>,
    /// The paper's perturbation result; absent where the theory gives none.
    pub perturbation: Option<Force>,
    /// The paper's f = m g/ε, meant for μ > μ_c.
    pub paper_formula: Force,
    /// The largest force that the stack carries, whatever ends the loading; 0 if the stack falls under its own weight,
    /// absent if the force grows without a peak.
    pub largest_force: Option<Force>,
}

/// The smallest and largest force that a stack may carry, over several forecasts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ForceRange {
    /// In N.
    pub lowest: Option<f64>,
    /// In N; absent if some forecast has no peak.
    pub highest: Option<f64>,
}

/// The forecast of an experiment.
#[derive(Debug, Clone, PartialEq)]
pub struct Forecast {
    /// The experiment.
    pub experiment: Experiment,
    /// m in kg.
    pub mass: f64,
    /// m g in N.
    pub weight: f64,
    /// The friction regime, by μ and its uncertainty.
    pub regime: FrictionRegime,
    /// The chosen estimate of the contact.
    pub contact: ContactEstimate,
    /// The yield force by that estimate; absent when an event other than floor slip comes first.
    pub yield_force: Option<Force>,
    /// Range of the largest force over all estimates of the contact and all μ within their uncertainty.
    pub range: ForceRange,
    /// All estimates, side by side.
    pub estimates: Vec<Forecasted>,
}

impl Forecast {
    /// Computes the forecast for `experiment`, in which `contact` is the chosen estimate.
    ///
    /// ```
    /// use tristack_theory::experiment::{ContactEstimate, Cylinder, Experiment, Forecast};
    ///
    /// let experiment = Experiment::new(Cylinder::paper_elastomer(), 0.3);
    /// let forecast = Forecast::new(&experiment, ContactEstimate::PaperScaling)?;
    /// let estimate = &forecast.estimates[0];
    /// assert!((estimate.epsilon - 9.80665e-5).abs() < 1e-12);
    /// assert!((estimate.paper_formula.newton - 100.0).abs() < 1e-9);
    /// # Ok::<(), tristack_theory::model::InvalidValue>(())
    /// ```
    ///
    /// # Errors
    /// The first value that is out of range.
    pub fn new(experiment: &Experiment, contact: ContactEstimate) -> Result<Self, InvalidValue> {
        experiment.validate()?;
        let at = |mu: f64| -> Result<Vec<Forecasted>, InvalidValue> {
            let all = ContactEstimate::ALL.iter();
            all.map(|&contact| forecasted(experiment, contact, mu))
                .collect()
        };
        let estimates = at(experiment.mu)?;
        let mut extremes = estimates.clone();
        if experiment.mu_uncertainty > 0.0 {
            extremes.extend(at(experiment.mu - experiment.mu_uncertainty)?);
            extremes.extend(at(experiment.mu + experiment.mu_uncertainty)?);
        }
        let mut all = estimates.iter();
        let chosen = all.find(|estimate| estimate.contact == contact);
        let mass = experiment.cylinder.mass();
        Ok(Self {
            experiment: *experiment,
            mass,
            weight: mass * GRAVITY,
            regime: FrictionRegime::of(experiment),
            contact,
            yield_force: chosen.and_then(|estimate| estimate.yield_force),
            range: range(&extremes),
            estimates,
        })
    }
}

fn range(extremes: &[Forecasted]) -> ForceRange {
    let forces = extremes.iter().map(|estimate| estimate.largest_force);
    let newton: Vec<f64> = forces.flatten().map(|force| force.newton).collect();
    let bounded = newton.len() == extremes.len();
    ForceRange {
        lowest: newton.iter().copied().reduce(f64::min),
        highest: newton.into_iter().reduce(f64::max).filter(|_| bounded),
    }
}

fn forecasted(
    experiment: &Experiment,
    contact: ContactEstimate,
    mu: f64,
) -> Result<Forecasted, InvalidValue> {
    let mut overlap = 0.1;
    let mut known = None;
    for _ in 0..ROUNDS {
        let normal_stiffness = contact.normal_stiffness(&experiment.cylinder, overlap);
        let stack = experiment.stack(mu, normal_stiffness);
        check_stiffness(contact, stack.stiffness)?;
        let problem = Problem::checked(stack, ContactConvention::TURNING);
        let limit = quasistatic_limit(&problem);
        let next = overlap_at_the_event(&limit, &stack);
        let settled = (next - overlap).abs() <= 1e-14 * overlap;
        overlap = next;
        known = Some((normal_stiffness, problem, limit));
        if settled {
            break;
        }
    }
    let (normal_stiffness, problem, limit) = known.expect("there is at least one round");
    let stack = problem.stack();
    let weight = experiment.cylinder.mass() * GRAVITY;
    let force = |weights: f64| Force {
        weights,
        newton: weights * weight,
    };
    Ok(Forecasted {
        contact,
        problem,
        normal_stiffness,
        epsilon: stack.epsilon(),
        stiffness: stack.stiffness,
        event: limit.event,
        overlap,
        yield_force: limit.yield_force.map(force),
        slip_onset: limit.slip_onset.map(force),
        perturbation: perturbation_load(stack).map(|load| force(load - stack.own_weight())),
        paper_formula: force(stack.stiffness),
        largest_force: largest_force(&limit, stack).map(force),
        reason: limit.reason,
    })
}

fn check_stiffness(contact: ContactEstimate, stiffness: f64) -> Result<(), InvalidValue> {
    let (lowest, highest) = STIFFNESS_RANGE;
    if (lowest..=highest).contains(&stiffness) {
        return Ok(());
    }
    let key = format!("k_n r/(m g), by {contact}");
    let accepted = format!(
        "from {lowest} to {highest:e}: softer cylinders are flat under their own weight; look at the units"
    );
    Err(InvalidValue::new(&key, stiffness, accepted))
}

/// Returns G at the first event. Where the cylinders slip, G follows from T = μ_d. With a peak or a floor-slip force
/// F, G = ε (F + 1)/2 (docs/theory.md, Eq. 14). Where nothing else is known, G is that under own weight, ε/2.
fn overlap_at_the_event(limit: &Limit, stack: &Stack) -> f64 {
    let beyond = stack.cylinder_friction - CRITICAL_FRICTION;
    match (limit.event, limit.peak_force.or(limit.floor_slip_force)) {
        (Event::CylinderSlip, _) if beyond > 0.0 => pair_overlap(beyond, stack.stiffness_ratio),
        (_, Some(force)) => 0.5 * stack.epsilon() * (force + 1.0),
        _ => 0.5 * stack.epsilon(),
    }
}

/// Returns the largest F that the stack carries. Beyond the stiffnesses of the regime map only the closed form gives
/// it: from the yield force, or from the saturated force of slipping cylinders.
fn largest_force(limit: &Limit, stack: &Stack) -> Option<f64> {
    if stack.validate().is_ok()
        && let Some(outcome) = LoadingOutcome::of(stack, HistoryUpdate::Rotated)
    {
        return match outcome.failure_mode {
            FailureMode::Collapses => Some(0.0),
            FailureMode::Yields | FailureMode::Shares => {
                limit.yield_force.or(outcome.largest_force)
            }
            _ => outcome.largest_force,
        };
    }
    let saturated = 2.0 * overlap_at_the_event(limit, stack) * stack.stiffness - 1.0;
    match (limit.yield_force, limit.event) {
        (Some(force), _) => Some(force),
        (None, Event::CylinderSlip) => Some(saturated.max(0.0)),
        (None, Event::FloorSlip) => Some(0.0),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::Cylinder;
    use approx::assert_relative_eq;

    fn forecast(cylinder: Cylinder, mu: f64) -> Forecast {
        let experiment = Experiment::new(cylinder, mu);
        Forecast::new(&experiment, ContactEstimate::LineContact).expect("sensible values")
    }

    #[test]
    fn elastomer_of_the_paper() {
        let forecast = forecast(Cylinder::paper_elastomer(), 0.3);
        assert_relative_eq!(forecast.mass, 1e-3, max_relative = 1e-14);
        let scaling = &forecast.estimates[0];
        assert_relative_eq!(scaling.epsilon, 9.80665e-5, max_relative = 1e-13);
        assert_relative_eq!(scaling.paper_formula.newton, 100.0, max_relative = 1e-13);
    }

    /// The paper's wood: m = 1 g. The values that the paper leaves out are E = 1 GPa, ρ = 500 kg/m³ and ν = 0.3, all
    /// of the order of soft wood across its grain.
    fn paper_wood() -> Cylinder {
        Cylinder::paper(1e9, 0.3, 500.0)
    }

    /// The wooden cylinders of the paper's movies, r = 20 mm, l = 40 mm, m = 21.9 g (supplement III).
    fn paper_movie() -> Cylinder {
        let cylinder = Cylinder {
            radius: 0.02,
            length: 0.04,
            ..paper_wood()
        };
        cylinder.weighing(0.0219)
    }

    /// E = 1 GPa gives the printed 1e5 N; 10 GPa does not.
    #[test]
    fn wood_of_the_paper() {
        let wood = paper_wood();
        let formula = |cylinder| forecast(cylinder, 0.3).estimates[0].paper_formula.newton;
        assert_relative_eq!(forecast(wood, 0.3).mass, 1e-3, max_relative = 1e-14);
        assert_eq!(libm::log10(formula(wood)).round(), 5.0);
        let along_the_grain = Cylinder {
            youngs_modulus: 1e10,
            ..wood
        };
        assert_eq!(libm::log10(formula(along_the_grain)).round(), 6.0);
    }

    #[test]
    fn wood_of_the_movies_has_the_density_of_wood() {
        let cylinder = paper_movie();
        assert_relative_eq!(cylinder.mass(), 0.0219, max_relative = 1e-14);
        assert_relative_eq!(cylinder.density, 435.69, max_relative = 1e-4);
    }

    #[test]
    fn limit_keeps_its_digits_up_to_the_stiffest_cylinders() {
        for stiffness in [1e8, 1e10, 1e12] {
            let force = |mu| {
                let stack = Stack::paper(mu, stiffness);
                let limit = quasistatic_limit(&Problem::checked(stack, ContactConvention::TURNING));
                assert_eq!(limit.event, Event::FloorSlip, "{stiffness} {mu}");
                limit.yield_force.expect("the floor slips")
            };
            let rigid = 4.886_751_345_948_132;
            assert!((force(0.2) - rigid).abs() < 1e2 / stiffness);
            let scaled = 2.0 * pair_overlap(0.3 - CRITICAL_FRICTION, 2.5) * stiffness;
            assert!((force(0.3) / scaled - 1.0).abs() < 2e2 / stiffness);
        }
    }

    #[test]
    fn hertz_secant_is_that_at_its_own_yield() {
        for mu in [0.15, 0.2, CRITICAL_FRICTION, 0.3, 0.5, 0.6] {
            let forecast = forecast(Cylinder::paper_elastomer(), mu);
            let hertz = &forecast.estimates[2];
            let cylinder = &forecast.experiment.cylinder;
            let again = ContactEstimate::Hertz.normal_stiffness(cylinder, hertz.overlap);
            assert_relative_eq!(again, hertz.normal_stiffness, max_relative = 1e-12);
        }
    }

    #[test]
    fn range_covers_all_estimates_and_both_ends_of_the_friction() {
        let mut experiment = Experiment::new(Cylinder::paper_elastomer(), 0.26);
        let exact = Forecast::new(&experiment, ContactEstimate::Hertz).unwrap();
        experiment.mu_uncertainty = 0.03;
        let rough = Forecast::new(&experiment, ContactEstimate::Hertz).unwrap();
        assert_eq!(rough.regime, FrictionRegime::At);
        assert_eq!(exact.regime, FrictionRegime::Below);
        assert!(rough.range.lowest < exact.range.lowest);
        assert!(rough.range.highest > exact.range.highest);
        for estimate in &exact.estimates {
            let newton = estimate.yield_force.map(|force| force.newton);
            assert!(newton >= exact.range.lowest && newton <= exact.range.highest);
        }
    }

    #[test]
    fn what_does_not_yield_says_what_happens_instead() {
        let falling = forecast(Cylinder::paper_elastomer(), 0.05);
        assert_eq!(falling.yield_force, None);
        assert_eq!(falling.range.highest, Some(0.0));
        let saturated = forecast(Cylinder::paper_elastomer(), 0.9);
        assert_eq!(saturated.yield_force, None);
        assert!(saturated.estimates[0].reason.is_some());
        let stiff = Cylinder {
            youngs_modulus: 1e12,
            ..Cylinder::paper_elastomer()
        };
        let stiff = forecast(stiff, 0.9);
        let ratio = |forecast: &Forecast| forecast.estimates[1].largest_force.map(|f| f.newton);
        assert_eq!(saturated.estimates[1].event, stiff.estimates[1].event);
        assert_eq!(ratio(&saturated).is_some(), ratio(&stiff).is_some());
    }

    #[test]
    fn values_out_of_range_are_named() {
        let error = |cylinder, mu| {
            let experiment = Experiment::new(cylinder, mu);
            Forecast::new(&experiment, ContactEstimate::Hertz).unwrap_err()
        };
        let cylinder = Cylinder::paper_elastomer();
        assert_eq!(error(cylinder, -0.1).key, "stack.floor_friction");
        let soft = Cylinder {
            youngs_modulus: 1.0,
            ..cylinder
        };
        assert!(error(soft, 0.3).key.contains("k_n r/(m g)"));
        let odd = Cylinder {
            poisson_ratio: 0.7,
            ..cylinder
        };
        assert_eq!(error(odd, 0.3).key, "cylinder.poisson_ratio");
    }
}
