//! The yield force that the runs of a measurement show, compared with the exact limit.

use super::budget::Budget;
use super::extrapolate::{
    ConvergenceOrder, Estimator, Extrapolation, LARGEST_COORDINATE, printing_error,
};
use super::peak::{load_per_step, peak_allowance};
use super::plan::Measurement;
use super::runs::{Method, SPEEDS};
use crate::code::{SettledCode, Unknown};
use crate::model::Protocol;
use crate::runs::{RunSummary, Workload};
use crate::series::{YieldEstimates, left_of_touch};
use crate::study::{
    Evaluation, Ground, Grounds, Judged, MAX_TOLERANCE, MIN_TOLERANCE, RESOLUTIONS, Study, Verdict,
    tolerance,
};

/// The yield force that the runs of a measurement show.
#[derive(Debug, Clone, PartialEq)]
pub struct YieldForce {
    /// The summary of each run, in the order of the cases.
    pub runs: Vec<RunSummary>,
    /// The slip onset at vanishing wall speed.
    pub slip: Option<Extrapolation>,
    /// The peak at vanishing wall speed.
    pub peak: Option<Extrapolation>,
    /// The uncertainty of that peak, in m g.
    pub peak_uncertainty: Option<f64>,
    /// F with its uncertainty, in m g. It is read off the slip onset; off the peak if there is no onset, or if the
    /// force rises beyond it; or, where the paper is followed literally, off the peak of one run, less what its speed
    /// adds to first order.
    pub force: Option<(f64, f64)>,
}

/// A judged measurement: a row of a crosscheck with its evidence.
pub type Judgement = Judged<Measurement, YieldForce>;

impl Study for Measurement {
    type Reading = RunSummary;
    type Finding = YieldForce;

    fn code(&self) -> SettledCode {
        self.code.clone()
    }

    fn depends_on(&self, unknown: &Unknown) -> bool {
        unknown.moves_limit
    }

    fn resolution(&self) -> f64 {
        self.resolution
    }

    fn workloads(&self) -> Vec<Workload> {
        vec![Workload {
            code: self.code.name().clone(),
            tasks: self.cases.clone(),
        }]
    }

    fn evaluate(&self, runs: Vec<Vec<RunSummary>>) -> Evaluation<YieldForce> {
        let runs = runs.into_iter().flatten().collect();
        let mut reader = Reader::new(self, runs);
        if self.method == Method::Rigid && !self.cases.is_empty() {
            reader.judge_rigid();
            return reader.evaluated();
        }
        reader.hold_to_mechanics();
        match self.limit.yield_force.filter(|_| !self.cases.is_empty()) {
            None => reader
                .grounds
                .add(Ground::NoYield(self.limit.reason.clone())),
            Some(reference) => match self.method {
                Method::Literal => reader.take_literally(reference),
                _ => reader.extrapolate(reference),
            },
        }
        reader.evaluated()
    }
}

/// Reads the yield force of one measurement and collects the grounds for its verdict.
pub(super) struct Reader<'a> {
    pub(super) measurement: &'a Measurement,
    estimates: Vec<YieldEstimates>,
    pub(super) finding: YieldForce,
    pub(super) grounds: Grounds,
}

impl<'a> Reader<'a> {
    fn new(measurement: &'a Measurement, runs: Vec<RunSummary>) -> Self {
        Self {
            measurement,
            estimates: runs.iter().map(|run| run.estimates).collect(),
            finding: YieldForce {
                runs,
                slip: None,
                peak: None,
                peak_uncertainty: None,
                force: None,
            },
            grounds: Grounds::new(),
        }
    }

    fn evaluated(self) -> Evaluation<YieldForce> {
        Evaluation {
            finding: self.finding,
            grounds: self.grounds,
        }
    }

    /// Judges the yield force at vanishing wall speed by the slip onset, which the peak must not contradict. A stack
    /// that began to slide under its own weight has no onset under the wall, and is judged by the peak.
    fn extrapolate(&mut self, reference: f64) {
        let measurement = self.measurement;
        let onset = measurement.limit.slip_onset;
        let [slip, peak] = [Estimator::SlipOnset, Estimator::Peak].map(|estimator| {
            let found = measurement.extrapolate(&self.estimates, estimator)?;
            self.bounded(found, estimator, reference)
        });
        (self.finding.slip, self.finding.peak) = (slip, peak);
        let Some((peak, allowance)) = peak.zip(peak_allowance(measurement, reference)) else {
            return self.find_no_yield();
        };
        let peak_uncertainty = peak.budget.total() + allowance + self.overshoot(&peak);
        self.finding.peak_uncertainty = Some(peak_uncertainty);
        // An onset is amplified more than a peak, which matters where numbers are coarse.
        let accepts_coarse = measurement.resolution > MAX_TOLERANCE;
        let by_onset = slip.zip(onset).filter(|(slip, onset)| {
            !accepts_coarse || reference != *onset || slip.budget.total() <= peak_uncertainty
        });
        let Some((slip, onset)) = by_onset else {
            self.compare(peak.force, peak_uncertainty, reference);
            self.doubt_unknown_parts(&peak.budget, reference);
            self.doubt_few_digits(peak.budget.print_precision, reference);
            self.doubt_measured_arms(reference);
            if onset.is_none() {
                return self.grounds.add(Ground::Remark(SLIDES_AT_REST.to_owned()));
            }
            if slip.is_none() {
                self.doubt(self.missing_onset());
                return self.doubt_deep_wall(reference);
            }
            self.grounds.add(Ground::Remark(BY_THE_PEAK.to_owned()));
            self.doubt_friction();
            self.doubt_pair_friction();
            return self.doubt_equal_runs();
        };
        self.compare(slip.force, slip.budget.total(), onset);
        self.doubt_unknown_parts(&slip.budget, onset);
        self.doubt_few_digits(slip.budget.print_precision, onset);
        self.doubt_measured_arms(onset);
        if reference != onset {
            self.finding.force = Some((peak.force, peak_uncertainty));
        }
        self.doubt_friction();
        self.doubt_pair_friction();
        self.doubt_equal_runs();
        self.doubt_rough_touch();
        self.doubt_order(&slip);
        self.hold_to_peak(&slip, &peak, peak_uncertainty, reference - onset);
    }

    /// Judges the yield force as the paper reads it: the peak at one wall speed, less what theory expects the speed
    /// to add to first order. A second run, twice as fast, shows what is left: three times the second-order part.
    /// Where theory does not know the addition, the force is the peak itself, and its whole change counts
    /// [`TWO_GRIDS`] times.
    fn take_literally(&mut self, reference: f64) {
        let measurement = self.measurement;
        let peaks: Option<Vec<_>> = self.estimates.iter().map(|run| run.peak).collect();
        let protocols = measurement.cases.iter().map(|case| case.protocol);
        let protocols: Vec<_> = protocols.collect();
        let (Some([slow, fast]), [paper, twice]) = (peaks.as_deref(), &protocols[..]) else {
            return self.find_no_yield();
        };
        let peak_excess = measurement.speed_excess.map(|excess| excess.peak);
        let added = |protocol: &Protocol| peak_excess.unwrap_or(0.0) * protocol.wall_speed;
        let force = slow.force - added(paper);
        let left = (fast.force - added(twice) - force).abs();
        let factor = match peak_excess {
            Some(_) => 1.0,
            None => TWO_GRIDS,
        };
        let load = measurement.stack.floor_load(reference);
        let rounding = step_rounding(paper) * load;
        let printed = self.estimates.iter().filter_map(|run| run.printed);
        let printing = printed.map(|printed| printing_error(&printed, slow));
        let printing = printing.fold(0.0, f64::max);
        let budget = Budget {
            wall_speed: factor * left,
            time_step: None,
            preparation: None,
            sampling: slow.sampling,
            round_off: rounding,
            print_precision: printing,
            shortcuts: 0.0,
            convention: measurement.convention_uncertainty,
        };
        let found = Extrapolation {
            force,
            first_order: force,
            budget,
            order: ConvergenceOrder::NOT_OBSERVED,
        };
        self.finding.peak = Some(found);
        self.finding.peak_uncertainty = Some(budget.total());
        self.compare(force, budget.total(), reference);
        self.doubt_few_digits(printing, reference);
        self.doubt_measured_arms(reference);
        self.doubt_friction();
        let excess = (slow.force - reference) / reference;
        let expected = match peak_excess {
            Some(_) => format!("{:+.1e} expected of its speed", added(paper) / reference),
            None => "what its speed adds is not known".to_owned(),
        };
        self.grounds.add(Ground::Remark(format!(
            "at the paper's wall speed and time step the peak is {excess:+.1e} of the limit away from it, \
             {expected}; with the wall twice as fast it changes by {:.1e} of the limit beside that",
            left / reference
        )));
    }

    /// Sets the yield force and compares it with the limit.
    pub(super) fn compare(&mut self, force: f64, uncertainty: f64, reference: f64) {
        self.finding.force = Some((force, uncertainty));
        let load = self.measurement.stack.floor_load(reference);
        let relative = uncertainty / load;
        let error = (force - reference) / load;
        let allowed = tolerance(relative, self.measurement.resolution);
        let is_coarse = Verdict::of(error, relative, allowed) == Verdict::Inconclusive;
        let is_accepted = RESOLUTIONS.contains(&relative);
        let note = is_coarse.then(|| {
            // Two numbers that differ are not told in the same digits.
            let two = |digits: usize| [relative, allowed].map(|one| format!("{one:.digits$e}"));
            let mut told = (1..=5).map(two);
            let [relative, allowed] = told
                .find(|[one, other]| one != other)
                .unwrap_or_else(|| two(1));
            let accepted = match is_accepted {
                true => " unless `--resolution` accepts more",
                false => "",
            };
            format!(
                "too coarse: its uncertainty is {relative} of the load, and may be {allowed}{accepted}"
            )
        });
        self.grounds.compare(error, relative, allowed, note);
    }

    pub(super) fn doubt(&mut self, note: String) {
        self.grounds.add(Ground::Doubt(note));
    }

    fn find_no_yield(&mut self) {
        let last = self.finding.runs.iter().map(|run| run.last_force);
        let highest = last.fold(0.0, f64::max);
        let printed = self.estimates.iter().filter_map(|run| run.printed);
        let mut coarse = printed.filter(|printed| printed.finest < DIGITS_TO_SEE_A_YIELD);
        if let Some(printed) = coarse.next() {
            let digits = printed.digits;
            let note = format!("printed with {digits} digits, too few to show a yield");
            self.grounds.add(Ground::Undecidable(note));
        }
        self.grounds.add(Ground::NoYield(Some(format!(
            "no slip followed by a peak within the planned wall travel; the wall force ends at {highest:.6}"
        ))));
    }

    /// The fewest digits with which a run is printed; `None` if all of them are printed in full.
    fn digits(&self) -> Option<u32> {
        let printed = self.estimates.iter().filter_map(|run| run.printed);
        printed.map(|printed| printed.digits).min()
    }

    /// Adds a doubt if too few digits are printed, which is no error of the code. `uncertainty` is what the missing
    /// digits leave open, in m g.
    fn doubt_few_digits(&mut self, uncertainty: f64, reference: f64) {
        let too_large = uncertainty
            > self.measurement.resolution * self.measurement.stack.floor_load(reference);
        if let Some(digits) = self.digits().filter(|_| too_large) {
            let mut printed = self.estimates.iter().filter_map(|run| run.printed);
            let [are, needed] = match printed.any(|printed| printed.single) {
                true => [
                    "its forces are numbers of 32 bits".to_owned(),
                    "64 bits are needed".to_owned(),
                ],
                false => [
                    format!("printed with {digits} digits"),
                    "17 are needed".to_owned(),
                ],
            };
            self.doubt(format!(
                "{are}, by which the yield force may be off by {uncertainty:.1e}; {needed}"
            ));
        }
    }

    /// Adds a doubt if arms were not measured well enough, which is no error of the code.
    fn doubt_measured_arms(&mut self, reference: f64) {
        let open = self.measurement.convention_uncertainty.unwrap_or(0.0);
        if open > self.measurement.resolution * self.measurement.stack.floor_load(reference) {
            let arms = self.measurement.convention.arms;
            self.doubt(format!(
                "its arms are measured as {}, {}, by whose uncertainty the limit may be off by {open:.1e}",
                arms.pair, arms.floor
            ));
        }
    }

    fn doubt_friction(&mut self) {
        let asked = self.measurement.stack.floor_friction;
        // Two half units of numbers that may be ten times smaller than the largest of their column.
        let same = self.digits().map_or(SAME_FRICTION, |digits| {
            SAME_FRICTION.max(libm::exp10(2.0 - f64::from(digits)))
        });
        let mut measured = self.estimates.iter().filter_map(|run| run.sliding_friction);
        if let Some(other) = measured.find(|friction| (friction / asked - 1.0).abs() > same) {
            self.doubt(format!(
                "the floor slides at |t|/n = {other}, not at mu = {asked}"
            ));
        }
    }

    /// Says why one of the runs has no onset of slip.
    fn missing_onset(&self) -> String {
        let mut departures = (1..).zip(&self.estimates);
        let departure = departures.find_map(|(run, estimates)| Some((run, estimates.departure?)));
        departure.map_or_else(
            || "no onset of slip was found before the peak; judged by the peak".to_owned(),
            |(run, departure)| {
                format!(
                    "between slip and peak the floor does not slide in run {run}: at step {} its |t|/n is {}; judged by \
                     the peak",
                    departure.step, departure.ratio
                )
            },
        )
    }

    /// Adds a doubt if the cylinders may slip on each other before the floor slips, which would end the equilibrium
    /// before the extrapolated onset. They have not slipped if they later carry more friction than they needed until
    /// then. Where the force rises on after the onset, equilibrium does not end there, and a slip of the cylinders
    /// would bend the path before it.
    fn doubt_pair_friction(&mut self) {
        let limit = &self.measurement.limit;
        let Some(needed) = limit.pair_friction.filter(|_| !limit.rises_after_onset()) else {
            return;
        };
        let carried = self.estimates.iter().filter_map(|run| run.pair_friction);
        let carried = carried.fold(0.0, f64::max);
        if carried <= needed {
            self.doubt(format!(
                "the cylinders are not seen to carry more than |q|/a = {carried}, but {needed:.9} is needed until the floor \
                 slips: they may slip on each other before"
            ));
        }
    }

    /// Requires every run to obey mechanics, and those that differ in wall speed to begin at the state of rest that
    /// theory gives.
    fn hold_to_mechanics(&mut self) {
        let runs = &self.finding.runs;
        self.grounds
            .hold_to_mechanics(runs.iter().map(|run| run.mechanics.as_ref()));
        if let Some(run) = runs.iter().find(|run| !run.absent.is_empty()) {
            self.grounds.doubt_what_is_not_tested(&run.absent);
        }
        let by_speed = runs.get(..SPEEDS.len()).unwrap_or_default();
        let begun = by_speed.iter().map(|run| run.start);
        let (Some(rest), Some(mut begun), Some(Some(hastened))) = (
            self.measurement.limit.rest,
            begun.collect::<Option<Vec<_>>>(),
            self.hastened().map(|run| run.start),
        ) else {
            return;
        };
        // Runs with the same bits despite another ramp show no shift; they get a doubt of their own.
        if begun.contains(&hastened) {
            return;
        }
        begun.push(hastened);
        let coarse = self.measurement.roles.coarse_time_step;
        let coarse = coarse.and_then(|run| self.finding.runs.get(run)?.start);
        for run in 0..by_speed.len() {
            for (index, name) in ["x2", "y1", "y2"].into_iter().enumerate() {
                let start = begun[run][index];
                let others = (0..begun.len()).filter(|&other| other != run);
                let others = others.map(|other| begun[other][index]);
                let highest = others.clone().fold(f64::NEG_INFINITY, f64::max);
                let shift = highest - others.fold(f64::INFINITY, f64::min);
                // A scheme of first order comes to rest beside it by as much as twice the time step shifts the start.
                let by_step = (0..by_speed.len()).filter(|&other| other != run);
                let by_step =
                    by_step.map(|other| Some((coarse?[index] - begun[other][index]).abs()));
                let by_step = by_step.flatten().reduce(f64::min).unwrap_or(0.0);
                let bound = SAFETY_OF_REST * shift.max(by_step) + self.rest_accuracy();
                let size = (start - rest[index]).abs();
                if size.is_nan() || size > bound {
                    self.grounds.add(Ground::Violation(format!(
                        "run {} does not begin at rest: its {name} is {start} r, and must be {} r; {size:.1e} apart where \
                         {bound:.1e} is allowed",
                        run + 1,
                        rest[index]
                    )));
                }
            }
        }
    }

    /// Accuracy of the state of rest, in r: the sum of those of the limit, of the rounding of every step, and of
    /// printing.
    fn rest_accuracy(&self) -> f64 {
        let steps = self
            .measurement
            .cases
            .first()
            .map_or(0, |case| case.protocol.schedule().preparation.total());
        MIN_TOLERANCE * self.measurement.stack.epsilon()
            + steps as f64 * LARGEST_COORDINATE * f64::EPSILON
            + self.printed_coordinate()
    }

    /// Rounding of coordinates that are printed with few digits, in r: half a unit in the start, and a whole unit in
    /// the shift, which counts twice.
    fn printed_coordinate(&self) -> f64 {
        let printed = self.estimates.iter().filter_map(|run| run.printed);
        let half_units = printed.map(|printed| 25.0 * libm::exp10(-f64::from(printed.digits)));
        half_units.fold(0.0, f64::max)
    }

    fn hastened(&self) -> Option<&RunSummary> {
        self.finding.runs.get(self.measurement.roles.short_ramp?)
    }

    /// Returns `found` with bounds in place of the parts of its budget that no run shows. The bound for the time step
    /// is the load of two steps of the wall: positions and forces are a step late at most. The bound for the
    /// preparation is the distance of the starts from rest. At one speed, neither what is left of the touch of the
    /// wall nor the rounding of its steps is extrapolated away, so that both are added. `None` where nothing is
    /// planned.
    fn bounded(
        &self,
        mut found: Extrapolation,
        estimator: Estimator,
        reference: f64,
    ) -> Option<Extrapolation> {
        let Measurement {
            stack,
            convention,
            limit,
            method,
            cases,
            ..
        } = self.measurement;
        let protocol = &cases.get(method.compared_run())?.protocol;
        let read = estimator.read(self.estimates.get(method.compared_run())?)?;
        let amplified = stack.stiffness * read.sensitivity;
        let step = load_per_step(self.measurement, protocol, reference)?;
        let budget = &mut found.budget;
        budget.time_step.get_or_insert(STEPS_LATE * step);
        let off_rest = self.off_rest().map(|distance| amplified * distance);
        budget.preparation = budget.preparation.or(off_rest);
        if *method == Method::AtOneSpeed {
            let age = limit.wall_travel.or(limit.peak_travel)? / protocol.wall_speed;
            let left = left_of_touch(stack, convention, protocol.wall_speed, age);
            budget.wall_speed += amplified * left;
            budget.round_off += step_rounding(protocol) * stack.floor_load(reference);
        }
        Some(found)
    }

    /// The largest distance of a start from the state of rest, in r; `None` if that state or a start is not known.
    fn off_rest(&self) -> Option<f64> {
        let rest = self.measurement.limit.rest?;
        let mut starts = self.finding.runs.iter().map(|run| run.start);
        starts.try_fold(0.0, |most, start| {
            let apart = start?.into_iter().zip(rest);
            let apart = apart.map(|(own, rest): (f64, f64)| (own - rest).abs());
            Some(apart.fold(most, f64::max))
        })
    }

    /// Adds doubts about the budget: a deviation that an unknown part may explain decides nothing, and nothing agrees
    /// if the bound of a part is too large.
    fn doubt_unknown_parts(&mut self, budget: &Budget, reference: f64) {
        let most = self.measurement.resolution * self.measurement.stack.floor_load(reference);
        if self.measurement.method == Method::AtOneSpeed && budget.wall_speed > most {
            self.doubt(format!(
                "the part of the wall speed in the uncertainty is {:.1e}, which is too much for one run: with a slower wall it \
                 is less, and three runs at different speeds need no such part",
                budget.wall_speed
            ));
        }
        for (part, bound) in budget.bounded(&self.measurement.roles) {
            if bound > most {
                self.doubt(format!(
                    "the part of the {} in the uncertainty is at most {bound:.1e}, which is too much; it would be shown \
                     by {}",
                    part.heading, part.known_by
                ));
            }
        }
        for part in budget.unknown() {
            let note = format!(
                "the part of the {} in the uncertainty is not known; it would be by {}",
                part.heading, part.known_by
            );
            let up_to = f64::INFINITY;
            self.grounds.add(Ground::Blur { up_to, note });
        }
    }

    fn doubt_equal_runs(&mut self) {
        let compared = self.estimates.get(self.measurement.method.compared_run());
        let hastened = self.hastened().map(|run| &run.estimates);
        // Rest is the same to 32 bits after either ramp.
        let is_single = compared.is_some_and(|run| run.position_drift.is_some());
        if hastened.is_some() && hastened == compared && !is_single {
            self.doubt(
                "two runs that differ in their preparation gave the same bits: a series is that of another \
                 case, or the code takes no notice of the preparation"
                    .to_owned(),
            );
        }
    }

    /// A floor that slides at the first touch moves the yield force by some 1e-6 at the speeds of such plans,
    /// which must not count as a disagreement.
    fn doubt_rough_touch(&mut self) {
        if !self.measurement.is_gentle {
            self.grounds.add(Ground::Blur {
                up_to: MAX_TOLERANCE,
                note: ROUGH_TOUCH.to_owned(),
            });
        }
    }

    /// Extra uncertainty of an extrapolated peak to which the force rises on after the onset. The runs overshoot it
    /// by an amount whose order in the wall speed changes as they begin to resolve the rise. Therefore all that is
    /// extrapolated counts, and more if the order is far from the expected one.
    fn overshoot(&self, peak: &Extrapolation) -> f64 {
        let slowest = self.estimates.get(SPEEDS.len() - 1);
        let slowest = slowest.and_then(|run| run.peak).map(|peak| peak.force);
        let rising = slowest.filter(|_| self.measurement.limit.rises_after_onset());
        rising.map_or(0.0, |slowest| {
            (slowest - peak.force).abs().max(peak.wrong_order(slowest))
        })
    }

    fn doubt_order(&mut self, slip: &Extrapolation) {
        let orders = self.measurement.expected_orders();
        if !slip.order.is_between(orders) {
            self.doubt(format!(
                "the slip onset converges with order {:.2} in the wall speed, not {}",
                slip.order.observed.unwrap_or(f64::NAN),
                ConvergenceOrder::range(orders)
            ));
        }
    }

    /// Adds a doubt unless onset and peak are `rise` apart, within their uncertainties.
    fn hold_to_peak(
        &mut self,
        slip: &Extrapolation,
        peak: &Extrapolation,
        peak_uncertainty: f64,
        rise: f64,
    ) {
        let together = slip.budget.total() + peak_uncertainty;
        if (peak.force - slip.force - rise).abs() > together {
            if rise > 0.0 {
                return self.doubt(format!(
                    "from slip onset {:.6} to peak {:.6} the force rises by another amount than {rise:.6}: beyond \
                     their uncertainties {together:.1e}",
                    slip.force, peak.force
                ));
            }
            self.doubt(format!(
                "slip onset gives {:.6}, the peak {:.6}: further apart than their uncertainties {together:.1e}",
                slip.force, peak.force
            ));
        }
    }

    /// A code that drops the contact of a wall beyond the centre of a cylinder cannot follow a wall force above k_n r;
    /// its series has no onset then, and shows nothing about the yield.
    fn doubt_deep_wall(&mut self, reference: f64) {
        let stack = &self.measurement.stack;
        if reference < stack.stiffness {
            return;
        }
        let depth = reference * stack.epsilon();
        self.grounds.add(Ground::Undecidable(format!(
            "at the yield the wall is {depth:.2} r deep in cylinder 1, beyond its centre, where codes let go"
        )));
    }
}

/// Allowed distance of a start from rest, as a multiple of the shift among the other runs. Damping along the gravity
/// ramp leaves the stack away from rest by an amount that falls with the duration of the ramp, so that halving the
/// ramp shifts the start by at least as much as the whole ramp leaves it away from rest. Twice that is allowed,
/// because the fastest run needs it where ramps slow down with the wall: its ramp is the halved one. A run is held to
/// the shift among the others, since its own start is in question. Of what a scheme of first order shifts, twice is
/// allowed too, for what it has of higher order.
const SAFETY_OF_REST: f64 = 2.0;

/// Time steps by which the readings of a run may be late.
const STEPS_LATE: f64 = 2.0;

/// Note on rows without an onset under the wall.
const SLIDES_AT_REST: &str = "the floor slides under the stack's own weight until contact 2-3 bears it: there is no \
                              slip onset under the wall, and the peak is compared";

/// Note on rows of coarse numbers that are judged by the peak.
const BY_THE_PEAK: &str = "judged by the peak, which is known better than the onset of slip";

/// Note on rows whose planned walls are too fast.
const ROUGH_TOUCH: &str = "the wall touches the stack so fast that the floor slides for a moment, and a gentle \
                           wall would take more than 3e6 steps";

/// Safety factor of the grid convergence index where two runs do not show the order of convergence (ASME
/// V&V 20, section 2-4.1; P. J. Roache, J. Fluids Eng. 116, 405 (1994)).
pub(super) const TWO_GRIDS: f64 = 3.0;

/// Relative error of a step of the wall from rounding, which is much the same in every step: the heights of cylinder
/// 1 and of the wall are coordinates from 2 to 4.
fn step_rounding(protocol: &Protocol) -> f64 {
    const LARGEST: f64 = f64::EPSILON;
    LARGEST / (protocol.wall_speed * protocol.time_step)
}

/// A measured friction this close, relatively, to the one asked for is the same: codes cap the force at μ n itself,
/// some through tan(atan μ), so that only roundings of 1e-16 separate them.
const SAME_FRICTION: f64 = 1e-9;

/// Fewest digits that show a yield: with fewer, a force changes in steps of a hundredth of itself, between which it
/// may rise and fall.
const DIGITS_TO_SEE_A_YIELD: u32 = 4;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::code::{Identity, Provenance, Run};
    use crate::dem::compress_stack;
    use crate::model::{ContactConvention, Stack};
    use crate::study::Verdict;
    use crate::study::yield_force::plan::plan_literal;

    /// The runs of `measurement` by the native DEM, on a floor with `friction` times the friction asked for.
    fn runs(measurement: &Measurement, friction: f64) -> Vec<RunSummary> {
        let cases = measurement.cases.iter();
        let runs = cases.map(|case| {
            let mut made = *case;
            made.stack.floor_friction *= friction;
            let series = compress_stack(&made, || true).expect("a finite series");
            let identity = Identity::native().clone();
            let steps = case.total_steps();
            RunSummary::new(Run {
                case: *case,
                series,
                provenance: Provenance::now(identity, String::new(), Vec::new(), steps, 0.0),
            })
        });
        runs.collect()
    }

    /// At the paper's speed the peak is more than half a percent of the load above the limit.
    #[test]
    fn a_peak_at_the_paper_s_speed_agrees_and_one_that_is_off_differs() {
        let stack = Stack::paper(0.16, 1e4);
        let measurement = plan_literal(&SettledCode::native(), &stack, ContactConvention::PAPER);
        let made = runs(&measurement, 1.0);
        let judged = |runs: &[RunSummary]| {
            let evaluation = measurement.evaluate(vec![runs.to_vec()]);
            let (_, uncertainty) = evaluation.finding.force.expect("a force");
            let load = stack.floor_load(measurement.limit.yield_force.unwrap());
            (evaluation.grounds.verdict(), uncertainty / load)
        };
        let (verdict, uncertainty) = judged(&made);
        assert_eq!(verdict, Verdict::Agrees);
        assert!(uncertainty < MAX_TOLERANCE, "{uncertainty:e}");
        let mut off = made.clone();
        for run in &mut off {
            let peak = run.estimates.peak.as_mut().expect("a peak");
            peak.force += 1e-4 * stack.floor_load(peak.force);
        }
        assert_eq!(judged(&off).0, Verdict::Differs);
        assert_eq!(judged(&runs(&measurement, 1.001)).0, Verdict::Differs);
        // If theory does not know what the speed adds, nothing is decided.
        let unknown = Measurement {
            speed_excess: None,
            ..measurement.clone()
        };
        let evaluation = unknown.evaluate(vec![made]);
        assert_eq!(evaluation.grounds.verdict(), Verdict::Inconclusive);
    }
}
