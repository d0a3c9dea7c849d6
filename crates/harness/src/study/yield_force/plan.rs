//! The runs of a measurement. Theory plans them, so that cost and relative error are the same for every stack.

use super::extrapolate::{
    ConvergenceOrder, Estimator, Extrapolation, at_one_speed, extrapolate_runs,
};
use super::limits::{convention_uncertainty, known_limit};
use super::runs::{COARSE_AND_FAST_RUN, MIDDLE_RUN, Method, RunRoles, SLOWEST_RUN, SPEEDS};
use super::symmetry::lost_before_yield;
use super::touch::{is_gentle, is_surely_gentle, max_touch_speed};
use crate::code::{Settled, SettledCode};
use crate::model::{
    Arms, Case, ContactConvention, Law, PAPER_BODIES, Preparation, Problem, Protocol, Sampling,
    Shortcuts, Stack,
};
use crate::series::{STEP_IN_SINGLE_PRECISION, YieldEstimates};
use crate::study::MAX_TOLERANCE;
use crate::theory::{Limit, LimitCurve, SpeedExcess};

/// Time step of all runs but one.
const TIME_STEP: f64 = 0.1;
/// The same where positions are in single precision: fewer steps are rounded, and each is longer in units of the last place.
const TIME_STEP_IN_SINGLE_PRECISION: f64 = 2.0 * TIME_STEP;
/// Duration of the gravity ramp of all runs but one.
pub(super) const RAMP_TIME: f64 = 100.0;
/// Factor on the duration of the ramp for contacts without stiffness when they just touch (Hertz): their first
/// overlaps lag behind, and what the dampers keep of that lag falls with the duration.
const SOFT_RAMP: f64 = 10.0;
/// Duration of the rest after the ramp, in time scales of the stack.
pub(crate) const REST_TIME: f64 = 100.0;
/// The same for spheres. Oscillations that the ramp leaves behind then fall below rounding, so that no bound on a
/// start has to depend on their phase.
const REST_TIME_OF_SPHERES: f64 = 300.0;
/// Ratio of the duration of the ramp to that of the compression, where the limit depends on the ramp, or oscillations
/// that it leaves behind hardly die away. What the ramp leaves is of second order in its speed, and then small beside
/// the lag of the compression, which is of first order.
const SLOW_RAMP: f64 = 4.0;
/// Rows before the fine ones.
const COARSE_ROWS: f64 = 60.0;
const FINE_INTERVAL: f64 = 2.0;
/// Fine rows before the onset, at least, where walls are fast because positions are in single precision.
const FINE_ROWS: f64 = 10.0;
/// Fraction of the predicted wall travel to the slip onset from which rows are fine.
const FINE_FROM: f64 = 0.98;
/// Travel that is run in any case, as a multiple of the predicted wall travel to the peak.
const TRAVEL_MARGIN: f64 = 1.05;
/// Time added to that travel: the force peaks some ten time units after the slip, at any speed.
const TIME_MARGIN: f64 = 80.0;
/// Stiffness from which [`TIME_MARGIN`] grows; the stiffest stack of the paper's figure 2(a) is below it.
const STIFF: f64 = 2e4;
/// Longest duration of a compression that is slowed down for a gentle touch, or for an onset long before the peak:
/// 2.9 × 10⁶ steps.
const LONGEST_COMPRESSION: f64 = 2.9e5;

/// Largest initial speed-up of the wall in shortened runs with springs that do not turn with their contacts. In a
/// step such springs are stretched along one direction, while the contact turns by an angle that grows with the
/// speed.
const FACTOR_OF_KEPT_DIRECTIONS: f64 = 3.0;
/// Drop of the wall force at which shortened runs with such springs end. While a stack collapses, their |q|/a grows
/// slower than b/a, and rows must show that the cylinders carry more than at the onset of slip.
const DROP_THAT_SHOWS_FRICTION: f64 = 0.5;

/// Wall speed of the paper, in r √(k_n/m) (supplement I.C).
pub const PAPER_WALL_SPEED: f64 = 1e-6;
/// Time step of the paper, in √(m/k_n) (supplement I.C).
pub const PAPER_TIME_STEP: f64 = 1e-3;
/// Wall speeds of a literal measurement: the paper's, and twice it to estimate its error.
const LITERAL_SPEEDS: [f64; 2] = [PAPER_WALL_SPEED, 2.0 * PAPER_WALL_SPEED];

/// The planned measurement of a yield force: a row of a crosscheck.
#[derive(Debug, Clone, PartialEq)]
pub struct Measurement {
    /// The code.
    pub code: SettledCode,
    /// The stack.
    pub stack: Stack,
    /// The contact convention of the code.
    pub convention: ContactConvention,
    /// The exact limit under this convention, by which the code is judged.
    pub limit: Limit,
    /// Distance of that limit from the one under the paper's convention, relative to F + 3.
    pub model_form: Option<f64>,
    /// Uncertainty of the limit, in m g, from arms that were measured and not declared; absent if all are declared.
    pub convention_uncertainty: Option<f64>,
    /// What a moving wall adds to the force to first order, in m g per unit of speed in r √(k_n/m); absent if it is
    /// not known, or not needed because the speed is extrapolated.
    pub speed_excess: Option<SpeedExcess>,
    /// How its yield force is read.
    pub method: Method,
    /// Whether the wall touches so gently in every run that the floor does not slide for a moment; a run slow enough
    /// for that may take too long.
    pub is_gentle: bool,
    /// One case per wall speed. Where the speed is extrapolated, also one with a coarse time step and one with a
    /// short gravity ramp, and, where springs remember forces, another one with a coarse time step. Empty where
    /// nothing yields.
    pub cases: Vec<Case>,
    /// Which run is which.
    pub roles: RunRoles,
    /// Largest uncertainty with which the force agrees, relative to the load on the floor.
    pub resolution: f64,
}

/// Plans the measurement of `stack` with `code` under `convention`.
pub fn plan(code: &SettledCode, stack: &Stack, convention: ContactConvention) -> Measurement {
    planned(code, stack, convention, Method::Extrapolated)
}

/// Plans the measurement of `stack` as the paper made it.
pub(crate) fn plan_literal(
    code: &SettledCode,
    stack: &Stack,
    convention: ContactConvention,
) -> Measurement {
    planned(code, stack, convention, Method::Literal)
}

impl Measurement {
    /// The lowest and the highest order of convergence in the wall speed that its runs may show.
    pub fn expected_orders(&self) -> (f64, f64) {
        match self.limit.needs_slow_ramp {
            true => ConvergenceOrder::OF_RAMPS,
            false => (ConvergenceOrder::EXPECTED, ConvergenceOrder::EXPECTED),
        }
    }

    /// Returns the measurement with another largest uncertainty with which the force agrees.
    #[must_use]
    pub fn accepting(self, resolution: f64) -> Self {
        Self { resolution, ..self }
    }

    /// Extrapolates one estimator over `estimates`, those of the cases in their order.
    pub(crate) fn extrapolate(
        &self,
        estimates: &[YieldEstimates],
        estimator: Estimator,
    ) -> Option<Extrapolation> {
        let steps: Vec<u64> = self.cases.iter().map(Case::total_steps).collect();
        let stiffness = self.stack.stiffness;
        let mut found = match self.method {
            Method::AtOneSpeed => {
                let speed = self.cases.first()?.protocol.wall_speed;
                let added = estimator.excess(&self.speed_excess?) * speed;
                at_one_speed(
                    &self.roles,
                    added,
                    estimates,
                    *steps.first()?,
                    stiffness,
                    estimator,
                )
            }
            Method::Rigid => None,
            Method::Extrapolated | Method::Literal => {
                let read = |run: &YieldEstimates| estimator.read(run);
                extrapolate_runs(&self.roles, estimates, &steps, stiffness, read)
            }
        }?;
        found.budget.convention = self.convention_uncertainty;
        Some(found)
    }

    /// Returns the measurement with shortcuts in every run, and with the two faster runs repeated without them, which
    /// shows the effect of the shortcuts. The wall still touches gently, and is faster by the same factor in every
    /// run, so that its error vanishes with the speed like the rest.
    ///
    /// Literal measurements, and those of codes without shortcuts, are unchanged.
    #[must_use]
    pub fn shortened(mut self) -> Self {
        let fastest = self.cases.first().map(|case| case.protocol.wall_speed);
        let (Some(fastest), Some(travel)) = (fastest, self.limit.wall_travel) else {
            return self;
        };
        if !self.code.name().takes_shortcuts() || self.method == Method::Literal {
            return self;
        }
        let gentle = max_touch_speed(&self.stack, &self.convention);
        let Some(shortcuts) = Shortcuts::towards(travel, fastest, gentle) else {
            return self;
        };
        let (largest_factor, stop_at_drop) = match self.convention.history_update.turns() {
            true => (shortcuts.speed_factor, shortcuts.stop_at_drop),
            false => (FACTOR_OF_KEPT_DIRECTIONS, DROP_THAT_SHOWS_FRICTION),
        };
        let shortcuts = Shortcuts {
            speed_factor: rounded(shortcuts.speed_factor.min(largest_factor)),
            fast_until_travel: rounded(shortcuts.fast_until_travel),
            stop_at_drop,
        };
        let plain = self.cases[..=MIDDLE_RUN].to_vec();
        self.roles.plain = Some([self.cases.len(), self.cases.len() + 1]);
        for case in &mut self.cases {
            case.protocol.shortcuts = Some(shortcuts);
        }
        self.cases.extend(plain);
        self
    }
}

/// Plans the measurement of `stack` with `code` under `convention`, whose yield force is read by `method`.
pub(crate) fn planned(
    code: &SettledCode,
    stack: &Stack,
    convention: ContactConvention,
    method: Method,
) -> Measurement {
    let convention = convention.of_bodies(stack);
    let mut limit = known_limit(stack, &convention);
    let paper = ContactConvention::usual(Arms::PAPER, Law::LINEAR, stack.bodies);
    let paper = known_limit(stack, &paper);
    let model_form = limit
        .yield_force
        .zip(paper.yield_force)
        .map(|(own, paper)| (own - paper) / stack.floor_load(paper));
    let protocols = match method {
        Method::Extrapolated => planned_protocols(&limit, stack, &convention, code.settled()),
        Method::Literal => literal_protocols(&limit),
        Method::AtOneSpeed | Method::Rigid => None,
    };
    let protocols = protocols.into_iter().flatten();
    let cases = protocols.map(|protocol| Case {
        stack: *stack,
        convention,
        protocol,
    });
    let mut cases: Vec<Case> = cases.collect();
    if let Some(reason) = cases.get(SLOWEST_RUN).and_then(lost_before_yield) {
        cases.clear();
        limit.reason = Some(reason);
    }
    let fastest = cases.first();
    let is_gentle =
        fastest.is_none_or(|case| is_gentle(case.protocol.wall_speed, stack, &convention));
    let roles = RunRoles {
        coarse_and_fast: (cases.len() > COARSE_AND_FAST_RUN).then_some(COARSE_AND_FAST_RUN),
        has_slow_ramps: limit.needs_slow_ramp,
        speeds: speeds_in_displacements(&cases, &limit, stack, &convention).unwrap_or(SPEEDS),
        ..RunRoles::PLANNED
    };
    let is_literal = method == Method::Literal;
    Measurement {
        code: code.clone(),
        stack: *stack,
        convention,
        speed_excess: is_literal
            .then(|| speed_excess(stack, &convention, &limit))
            .flatten(),
        method,
        convention_uncertainty: convention_uncertainty(code, stack, &convention),
        is_gentle,
        cases,
        roles,
        limit,
        model_form,
        resolution: MAX_TOLERANCE,
    }
}

/// The speeds of the walls of `cases`, faster ones for positions in single precision too, in units of the displacement by
/// which speeds are measured; `None` where those are the planned ones.
fn speeds_in_displacements(
    cases: &[Case],
    limit: &Limit,
    stack: &Stack,
    convention: &ContactConvention,
) -> Option<[f64; 3]> {
    let scale = speed_scale(limit, stack, convention)?;
    let factor = cases.first()?.protocol.wall_speed / (SPEEDS[0] * scale);
    // Speeds are planned to six digits.
    (factor > 1.0 + 1e-5).then(|| SPEEDS.map(|speed| factor * speed))
}

/// What a moving wall adds to the `limit` of `stack`; `None` where theory does not know it.
pub(super) fn speed_excess(
    stack: &Stack,
    convention: &ContactConvention,
    limit: &Limit,
) -> Option<SpeedExcess> {
    let problem = Problem::new(*stack, *convention).ok()?;
    LimitCurve::new(&problem).speed_excess(&problem, limit)
}

fn planned_protocols(
    limit: &Limit,
    stack: &Stack,
    convention: &ContactConvention,
    code: &Settled,
) -> Option<Vec<Protocol>> {
    let levers = largest_levers(limit, convention);
    let usual = match code.has_single_positions {
        true => TIME_STEP_IN_SINGLE_PRECISION,
        false => TIME_STEP,
    };
    let time_step = stable_time_step(usual, (stack, convention), levers, code.force_lag);
    let scale = match code.has_single_positions {
        true => speed_scale_in_single_precision(limit, stack, convention, time_step)?,
        false => speed_scale(limit, stack, convention)?,
    };
    let protocols = SPEEDS.map(|speed| protocol_at_speed(limit, speed * scale, time_step));
    let mut protocols: Vec<Protocol> = protocols.into_iter().collect::<Option<_>>()?;
    if code.has_single_positions {
        let watched = limit.travel_to_watch()?;
        for protocol in &mut protocols {
            let fine = FINE_ROWS * FINE_INTERVAL * protocol.wall_speed;
            let from = (FINE_FROM * watched).min((watched - fine).max(0.5 * watched));
            protocol.sampling.fine_from_travel = rounded(from);
        }
    }
    let middle = protocols[MIDDLE_RUN];
    protocols.push(Protocol {
        time_step: 2.0 * time_step,
        ..middle
    });
    protocols.push(Protocol {
        preparation: preparation(limit, 0.5 * ramp_time(limit, middle.wall_speed)),
        ..middle
    });
    if convention.law.history.keeps_force() {
        protocols.push(Protocol {
            time_step: 2.0 * time_step,
            ..protocols[0]
        });
    }
    Some(protocols)
}

/// The largest product of torque arm and kinematic arm on the way to the peak, in r², and at least 1: what tangential
/// springs hold the rotations with is so many times their stiffness.
pub(crate) fn largest_levers(limit: &Limit, convention: &ContactConvention) -> f64 {
    // The floor carries the largest overlaps.
    let overlap = limit.peak_z.unwrap_or_default();
    let Arms { pair, floor } = convention.arms;
    let levers = [pair, floor].map(|arms| {
        let arm = |coefficient: f64| 1.0 + coefficient * overlap;
        (arm(arms.torque) * arm(arms.kinematic)).abs()
    });
    levers.into_iter().fold(1.0, f64::max)
}

/// The `usual` time step, halved until twice that step is stable: below κ = 0.375 tangential springs are too stiff for
/// it, and so are they with `levers` much larger than r². Forces that are late by `force_lag` steps must leave half of the damping then.
fn stable_time_step(
    usual: f64,
    (stack, convention): (&Stack, &ContactConvention),
    levers: f64,
    force_lag: f64,
) -> f64 {
    let longest = stack.longest_time_step(convention) / levers.sqrt();
    let at_rest = stack.epsilon() / f64::from(stack.bodies);
    let laws = [
        convention.law(stack.stiffness_ratio),
        convention.wall_law(stack.stiffness_ratio),
    ];
    let damping_time = laws.map(|law| law.damping_time(at_rest));
    // Where nothing is damped, nothing can be left.
    let latest = match 0.5 * damping_time[0].min(damping_time[1]) {
        latest if latest > 0.0 => latest,
        _ => f64::INFINITY,
    };
    let mut time_step = usual;
    while 2.0 * time_step > longest || 2.0 * time_step * force_lag > latest {
        time_step *= 0.5;
    }
    time_step
}

fn literal_protocols(limit: &Limit) -> Option<Vec<Protocol>> {
    let protocols = LITERAL_SPEEDS.map(|speed| protocol_at_speed(limit, speed, PAPER_TIME_STEP));
    protocols.into_iter().collect()
}

/// The displacement by which wall speeds are measured: z at the predicted slip onset or, where that is smaller, the
/// predicted travel of the wall, so that no onset comes too soon after the start; divided by the time scale of the
/// stack at rest. For a stack that slides under its own weight the peak takes the place of the onset. The
/// displacement is less where the fastest wall would make the floor slide at its first touch, as far as the slowest
/// run stays affordable. It is more where a run to a peak far beyond the onset would otherwise not be affordable.
/// `None` where nothing yields.
pub(super) fn speed_scale(
    limit: &Limit,
    stack: &Stack,
    convention: &ContactConvention,
) -> Option<f64> {
    let [fastest, _, slowest] = SPEEDS;
    let travel = limit.peak_travel?;
    let affordable = TRAVEL_MARGIN * travel / (LONGEST_COMPRESSION * slowest);
    let near = limit.z.or(limit.peak_z)?.min(limit.travel_to_watch()?) / limit.time_scale;
    let scale = match limit.rises_after_onset() {
        true => near.max(affordable),
        false => near,
    };
    if is_surely_gentle(fastest * scale, stack) {
        return Some(scale);
    }
    let gentle = max_touch_speed(stack, convention) / fastest;
    Some(scale.min(gentle.max(affordable)))
}

/// The same for positions in single precision: no step of the wall is so short that their rounding adds up, as long as
/// the fastest wall touches gently.
fn speed_scale_in_single_precision(
    limit: &Limit,
    stack: &Stack,
    convention: &ContactConvention,
    time_step: f64,
) -> Option<f64> {
    let [fastest, _, slowest] = SPEEDS;
    let resolved = STEP_IN_SINGLE_PRECISION / (slowest * time_step);
    let gentle = max_touch_speed(stack, convention) / fastest;
    Some(speed_scale(limit, stack, convention)?.max(resolved.min(gentle)))
}

/// The protocol of a run whose wall moves, per unit time, by `speed` times the displacement by which the
/// speeds of a measurement are measured. `None` where nothing yields.
pub fn planned_protocol(
    limit: &Limit,
    stack: &Stack,
    convention: &ContactConvention,
    speed: f64,
    time_step: f64,
) -> Option<Protocol> {
    let scale = speed_scale(limit, stack, convention)?;
    protocol_at_speed(limit, speed * scale, time_step)
}

/// The protocol of a run with a given wall speed in r √(k_n/m); `None` where nothing yields.
pub fn protocol_at_speed(limit: &Limit, wall_speed: f64, time_step: f64) -> Option<Protocol> {
    limit.yield_force?;
    let fine_from_travel = FINE_FROM * limit.travel_to_watch()?;
    let travel = limit.peak_travel?;
    Some(Protocol {
        preparation: preparation(limit, ramp_time(limit, rounded(wall_speed))),
        time_step,
        wall_speed: rounded(wall_speed),
        wall_travel: rounded(TRAVEL_MARGIN * travel + time_margin(limit) * wall_speed),
        sampling: Sampling {
            coarse_interval: rounded(fine_from_travel / wall_speed / COARSE_ROWS),
            fine_from_travel: rounded(fine_from_travel),
            fine_interval: FINE_INTERVAL,
        },
        shortcuts: None,
    })
}

fn preparation(limit: &Limit, ramp_time: f64) -> Preparation {
    let rest_time = match limit.bodies {
        PAPER_BODIES => REST_TIME,
        _ => REST_TIME_OF_SPHERES,
    };
    Preparation::GravityRamp {
        ramp_time: rounded(ramp_time),
        rest_time: rounded(rest_time * limit.time_scale),
    }
}

/// Duration of the gravity ramp of a run with this wall speed. A limit that depends on the preparation is approached
/// only if the ramp slows down with the wall.
pub(crate) fn ramp_time(limit: &Limit, wall_speed: f64) -> f64 {
    let is_soft = limit.time_scale > 1.0;
    let usual = RAMP_TIME * limit.time_scale * if is_soft { SOFT_RAMP } else { 1.0 };
    match limit.peak_travel {
        Some(travel) if limit.needs_slow_ramp => usual.max(SLOW_RAMP * travel / wall_speed),
        _ => usual,
    }
}

/// Duration of the compression beyond the planned travel. The force that drives the collapse of a stack near μ_c falls
/// with the square root of ε, so that stiff stacks take longer.
fn time_margin(limit: &Limit) -> f64 {
    let stiffness = limit.yield_force.zip(limit.peak_z);
    let bodies = f64::from(limit.bodies);
    let stiffness = stiffness.map_or(0.0, |(force, z)| (force + bodies + 1.0) / (bodies * z));
    TIME_MARGIN * (stiffness / STIFF).sqrt().max(limit.time_scale)
}

/// `value` to six significant digits. A plan is part of the address of a run: it must not depend on the
/// last digits of the limit, which may differ between machines.
fn rounded(value: f64) -> f64 {
    let text = format!("{value:.5e}");
    text.parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::super::runs::{COARSE_TIME_STEP_RUN, SHORT_RAMP_RUN};
    use super::*;
    use crate::model::Power;

    #[test]
    fn every_planned_case_is_valid_and_of_similar_length() {
        for stack in crate::study::yield_force::Profile::Quick.stacks(Power::Linear, 2) {
            let measurement = plan(
                &SettledCode::named("yade"),
                &stack,
                SettledCode::named("yade").convention(),
            );
            assert_eq!(measurement.cases.len(), SPEEDS.len() + 2);
            for case in &measurement.cases {
                case.validate().unwrap();
                let steps = case.total_steps();
                assert!((3_000..150_000).contains(&steps), "{steps}");
            }
        }
    }

    #[test]
    fn each_further_run_differs_from_the_middle_one_in_one_thing() {
        let stack = Stack::paper(0.3, 1e3);
        let cases = plan(&SettledCode::native(), &stack, ContactConvention::TURNING).cases;
        let middle = cases[MIDDLE_RUN];
        let mut coarse = cases[COARSE_TIME_STEP_RUN];
        assert_eq!(coarse.protocol.time_step, 2.0 * TIME_STEP);
        coarse.protocol.time_step = TIME_STEP;
        assert_eq!(coarse, middle);
        let mut short = cases[SHORT_RAMP_RUN];
        assert_ne!(short, middle);
        short.protocol.preparation = middle.protocol.preparation;
        assert_eq!(short, middle);
    }

    #[test]
    fn springs_that_remember_forces_have_a_second_run_with_twice_the_time_step() {
        let stack = Stack::paper(0.3, 1e3);
        let code = &SettledCode::named("yade-mindlin");
        let plan = plan(code, &stack, code.convention());
        let coarse = plan.cases[plan.roles.coarse_and_fast.unwrap()];
        let mut fast = plan.cases[0];
        assert_eq!(plan.cases.len(), 6);
        fast.protocol.time_step *= 2.0;
        assert_eq!(coarse, fast);
    }

    /// The recorded runs depend on this: they were planned before the touch of the wall was taken into account.
    #[test]
    fn walls_of_the_figure_are_gentle_as_they_are() {
        let profile = crate::study::yield_force::Profile::Standard;
        for plan in profile.measurements(&SettledCode::with_power(Power::Linear)) {
            let scale = plan.limit.z.unwrap().min(plan.limit.wall_travel.unwrap());
            let speeds = plan.cases.iter().map(|case| case.protocol.wall_speed);
            let expected = SPEEDS.map(|speed| rounded(speed * scale));
            assert_eq!(speeds.take(3).collect::<Vec<_>>(), expected);
            assert!(plan.is_gentle);
        }
    }

    #[test]
    fn a_wall_that_would_make_the_floor_slide_is_slower_or_the_plan_says_so() {
        let planned = |stiffness: f64| {
            let stack = Stack {
                stiffness_ratio: 1.2,
                ..Stack::paper(0.35, stiffness)
            };
            plan(&SettledCode::native(), &stack, ContactConvention::TURNING)
        };
        let [slowed, rough] = [1e5, 1e6].map(planned);
        assert!(slowed.is_gentle && !rough.is_gentle);
        assert!(slowed.cases[0].protocol.wall_speed < 9e-5);
        for case in slowed.cases.iter().chain(&rough.cases) {
            assert!(case.total_steps() < 3_000_000, "{}", case.total_steps());
        }
    }

    #[test]
    fn a_peak_far_beyond_the_onset_is_reached_at_a_bearable_cost_with_fine_rows_from_the_onset_on()
    {
        for (stiffness, kappa) in [(1e2, 1.0), (1e2, 0.3), (1e4, 0.6), (1e6, 0.6)] {
            let stack = Stack {
                stiffness_ratio: kappa,
                ..Stack::paper(0.3, stiffness)
            };
            let measurement = plan(&SettledCode::native(), &stack, ContactConvention::TURNING);
            let limit = &measurement.limit;
            assert!(limit.rises_after_onset() && !measurement.cases.is_empty());
            for case in &measurement.cases {
                case.validate().unwrap();
                assert!(case.total_steps() < 6_400_000, "{}", case.total_steps());
                assert!(case.protocol.sampling.fine_from_travel < limit.wall_travel.unwrap());
                assert!(case.protocol.wall_travel > limit.peak_travel.unwrap());
            }
        }
    }

    #[test]
    fn a_plan_does_not_see_the_last_digits_of_the_limit() {
        assert_eq!(rounded(1.642_259_585e-4), 1.64226e-4);
        assert_eq!(rounded(0.7), 0.7);
    }

    #[test]
    fn shortcuts_save_most_of_the_steps_and_two_runs_go_without_them() {
        let stack = Stack::paper(0.3, 1e2);
        let measurement = plan(&SettledCode::native(), &stack, ContactConvention::TURNING);
        let shortened = measurement.clone().shortened();
        let plain = shortened.roles.plain.unwrap();
        for (position, plain) in plain.into_iter().zip(&measurement.cases) {
            assert_eq!(shortened.cases[position], *plain);
        }
        for (short, plain) in shortened.cases.iter().zip(&measurement.cases) {
            short.validate().unwrap();
            let [short, plain] = [short, plain].map(|case| {
                let schedule = case.protocol.schedule();
                schedule.compression_steps as f64
            });
            assert!(short < 0.5 * plain, "{short} {plain}");
        }
        let literal = plan_literal(&SettledCode::native(), &stack, ContactConvention::TURNING);
        assert_eq!(literal.clone().shortened(), literal);
        let yade = plan(
            &SettledCode::named("yade"),
            &stack,
            SettledCode::named("yade").convention(),
        );
        assert_eq!(yade.clone().shortened(), yade);
    }

    #[test]
    fn nothing_is_planned_where_nothing_yields() {
        let measurement = plan(
            &SettledCode::native(),
            &Stack::paper(0.05, 1e2),
            ContactConvention::TURNING,
        );
        assert!(measurement.cases.is_empty());
    }
}
