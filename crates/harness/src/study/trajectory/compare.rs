//! Compares the runs of a code with those of its twins.

use super::distance::{Branch, Distance, Milestones, Quantity};
use super::documented::documented;
use super::judge::{FORCE_TOLERANCE, judge_order};
use super::judgement::{Comparison, Times, TrajectoryFinding};
use super::plan::{DISTURBANCE, Trajectory, Twin, TwinRuns};
use crate::code::{Code, Identity, Run, SettledCode};
use crate::model::{Case, Stack};
use crate::runs::{Reading, Workload};
use crate::series::{ENOUGH_DIGITS, Mechanics, Sample, most_digits};
use crate::study::{Evaluation, Ground, Grounds, Study, Verdict};

/// The rows of a run, and the program that made it.
#[derive(Debug, Clone)]
pub struct Rows {
    identity: Identity,
    samples: Vec<Sample>,
    absent: Vec<&'static str>,
    mechanics: Mechanics,
}

impl Reading for Rows {
    type Task = Case;

    fn of(run: Run) -> Self {
        Self {
            mechanics: Mechanics::read(&run.series, &run.case),
            identity: run.provenance.identity,
            samples: run.series.samples().to_vec(),
            absent: run.series.absent().to_vec(),
        }
    }

    fn identity(&self) -> &Identity {
        &self.identity
    }
}

impl Study for Trajectory {
    type Reading = Rows;
    type Finding = TrajectoryFinding;

    fn code(&self) -> SettledCode {
        self.code.clone()
    }

    fn workloads(&self) -> Vec<Workload> {
        let own = Workload {
            code: self.code.name().clone(),
            tasks: self.cases.clone(),
        };
        let twins = self.twins.iter().map(|runs| Workload {
            code: Code::native(),
            tasks: runs.all().copied().collect(),
        });
        std::iter::once(own).chain(twins).collect()
    }

    fn evaluate(&self, runs: Vec<Vec<Rows>>) -> Evaluation<TrajectoryFinding> {
        let samples = runs
            .iter()
            .map(|own| own.iter().map(|run| run.samples.as_slice()).collect());
        let samples: Vec<Vec<&[Sample]>> = samples.collect();
        let mut finding = TrajectoryFinding {
            times: None,
            comparisons: Vec::new(),
        };
        let mut grounds = Grounds::new();
        if let Some(run) = runs.iter().flatten().find(|run| !run.absent.is_empty()) {
            grounds.add(Ground::Undecidable(format!(
                "the code does not report {}: motions without all positions and angles are not compared",
                run.absent.join(", ")
            )));
            return Evaluation { finding, grounds };
        }
        match self.pairs(&samples) {
            Some(pairs) => {
                finding.times = pairs.first().map(Pair::times);
                finding.comparisons = pairs.iter().flat_map(Pair::comparisons).collect();
                hold_full_twin_to_the_other(&mut finding.comparisons);
                doubt_few_digits(&mut finding.comparisons, samples.first(), &self.stack);
                // The checks of mechanics assume a symmetric stack.
                if self.stack.arrangement.displacement == 0.0 {
                    hold_to_mechanics(&mut finding.comparisons, runs.first());
                }
            }
            None => grounds.add(Ground::NoYield(Some(
                "a twin shows no peak of the wall force followed by a landing of cylinder 1"
                    .to_owned(),
            ))),
        }
        Evaluation { finding, grounds }
    }
}

impl Trajectory {
    /// Pairs the code with each of its twins; `None` if a twin does not collapse, or nothing was planned.
    fn pairs<'a>(&'a self, samples: &[Vec<&'a [Sample]>]) -> Option<Vec<Pair<'a>>> {
        let (own, twins) = samples.split_first()?;
        let pairs = self.twins.iter().zip(twins);
        let pairs = pairs.map(|(runs, twin)| Pair::new((&self.code, &self.stack), runs, own, twin));
        let pairs: Vec<Pair> = pairs.collect::<Option<_>>()?;
        (!pairs.is_empty()).then_some(pairs)
    }
}

/// Holds the runs of the code to mechanics in every comparison of the compression.
fn hold_to_mechanics(comparisons: &mut [Comparison], own: Option<&Vec<Rows>>) {
    let comparisons = comparisons.iter_mut();
    for comparison in comparisons.filter(|one| one.branch == Branch::Compression) {
        let runs = own.into_iter().flatten();
        let mechanics = runs.map(|run| Some(&run.mechanics));
        comparison.grounds.hold_to_mechanics(mechanics);
    }
}

/// Requires the full twin, which has the history update of the code, to be the closer one in the collapse, where the
/// update shows in both twins at the same order.
fn hold_full_twin_to_the_other(comparisons: &mut [Comparison]) {
    let largest =
        |comparison: &Comparison| comparison.distances.last().map(|finest| finest.largest);
    let (full, others): (Vec<&mut Comparison>, Vec<&mut Comparison>) = comparisons
        .iter_mut()
        .filter(|comparison| comparison.branch == Branch::Collapse)
        .partition(|comparison| comparison.twin == Twin::Full);
    for (comparison, other) in full.into_iter().zip(others) {
        let both = largest(comparison).zip(largest(other));
        if let Some((own, other)) = both.filter(|(own, other)| own > other) {
            comparison.grounds.add(Ground::Violation(format!(
                "the twin is further away, {own:.1e}, than one whose springs turn with the contact, {other:.1e}"
            )));
        }
    }
}

/// Withdraws disagreements if the series of the code, in `own`, are printed with too few digits to show them.
fn doubt_few_digits(comparisons: &mut [Comparison], own: Option<&Vec<&[Sample]>>, stack: &Stack) {
    let digits = own.into_iter().flatten().map(|samples| {
        let numbers = samples.iter().flat_map(|sample| {
            let quantities = Quantity::of_stack(stack).iter();
            quantities.flat_map(move |quantity| quantity.of(sample))
        });
        most_digits(numbers)
    });
    let Some(digits) = digits.max().filter(|digits| *digits < ENOUGH_DIGITS) else {
        return;
    };
    for comparison in comparisons {
        if comparison.verdict() == Verdict::Differs {
            let note = format!("printed with {digits} digits, too few to tell code and twin apart");
            comparison.grounds.add(Ground::Undecidable(note));
        }
    }
}

/// A code and one of its twins.
struct Pair<'a> {
    code: &'a SettledCode,
    stack: &'a Stack,
    runs: &'a TwinRuns,
    /// Series of the code, one per time step.
    series: Vec<&'a [Sample]>,
    /// Series of the twin at the same time steps.
    twin: Vec<&'a [Sample]>,
    halved: &'a [Sample],
    disturbed: &'a [Sample],
    milestones: Milestones,
}

impl<'a> Pair<'a> {
    /// `twin` holds the series of `runs` in their order; `None` if the twin does not collapse.
    fn new(
        (code, stack): (&'a SettledCode, &'a Stack),
        runs: &'a TwinRuns,
        series: &[&'a [Sample]],
        twin: &[&'a [Sample]],
    ) -> Option<Self> {
        let (twin, [halved, disturbed]) = twin.split_last_chunk()?;
        Some(Self {
            code,
            stack,
            runs,
            series: series.to_vec(),
            milestones: Milestones::read(twin.last()?, stack)?,
            twin: twin.to_vec(),
            halved,
            disturbed,
        })
    }

    /// Every quantity on every branch.
    fn comparisons(&self) -> Vec<Comparison> {
        let branches = Branch::of_stack(self.stack).iter().flat_map(|&branch| {
            let quantities = branch.quantities(self.stack).iter();
            quantities.map(move |&quantity| self.compare(quantity, branch))
        });
        branches.collect()
    }

    fn finest(&self) -> &'a [Sample] {
        self.twin.last().copied().unwrap_or_default()
    }

    fn times(&self) -> Times {
        let time = |row: usize| self.finest()[row].time;
        let Milestones { peak, later } = self.milestones;
        Times {
            peak: time(peak),
            later: later.map(|rows| rows.map(time)),
        }
    }

    fn compare(&self, quantity: Quantity, branch: Branch) -> Comparison {
        let growth = self.growth(quantity, branch);
        let series = self.series.iter().zip(&self.twin).zip(&self.runs.cases);
        // Measured arms displace surfaces by at most their uncertainty, since overlaps are below r.
        let open: f64 = self.code.settled().arms_open();
        let distances = series.map(|((series, twin), case)| Distance {
            round_off: growth * (round_off(case) + open),
            ..self.between(quantity, branch, case.protocol.time_step, series, twin)
        });
        let distances: Vec<Distance> = distances.collect();
        let step_error = self.step_error(quantity, branch);
        let documented = documented(self.code.name(), self.runs.twin, quantity, branch);
        let grounds = judge_order(documented.order, &distances, step_error);
        let mut comparison = Comparison {
            twin: self.runs.twin,
            quantity,
            branch,
            documented,
            distances,
            step_error,
            grounds,
        };
        comparison.hold_force_to_tolerance();
        comparison
    }

    fn between(
        &self,
        quantity: Quantity,
        branch: Branch,
        time_step: f64,
        left: &[Sample],
        right: &[Sample],
    ) -> Distance {
        let unit = match quantity.is_force() {
            true => self.finest()[self.milestones.peak].wall_force,
            false => 1.0,
        };
        let rows = self.milestones.rows(branch);
        Distance::between(
            quantity,
            unit,
            time_step,
            (&left[rows.clone()], &right[rows]),
        )
    }

    /// Largest change of the twin when a time step is halved. If the twin converges, that is the change of the
    /// coarsest step; if not, it may be that of any.
    fn step_error(&self, quantity: Quantity, branch: Branch) -> f64 {
        let finer = self.twin.iter().skip(1).copied().chain([self.halved]);
        let changes = self
            .twin
            .iter()
            .zip(finer)
            .map(|(coarse, fine)| self.between(quantity, branch, 0.0, coarse, fine).largest);
        changes.fold(0.0, f64::max)
    }

    /// Factor by which a displacement of the wall grows until it is seen, from the twin with a slightly faster wall;
    /// in the unit of the quantity per r, and at least 1.
    fn growth(&self, quantity: Quantity, branch: Branch) -> f64 {
        let Some((case, twin)) = self.runs.cases.first().zip(self.twin.first()) else {
            return f64::INFINITY;
        };
        let distance = self.between(quantity, branch, 0.0, self.disturbed, twin);
        let end = self.milestones.rows(branch).end - 1;
        let displacement = DISTURBANCE * case.protocol.wall_speed * self.finest()[end].time;
        (distance.largest / displacement).max(1.0)
    }
}

/// Largest effect of rounding on a position, if it always errs to the same side: half a unit in the last place of a
/// coordinate between 2 and 4 in every step, in the code and in its twin.
fn round_off(case: &Case) -> f64 {
    2.0 * f64::EPSILON * case.protocol.schedule().total_steps() as f64
}

impl Comparison {
    /// Requires the wall force up to its peak to be close to that of the twin.
    fn hold_force_to_tolerance(&mut self) {
        let judged = self.quantity == Quantity::WallForce && self.branch == Branch::Compression;
        if let Some(finest) = self.distances.last().filter(|_| judged) {
            let note = format!(
                "the wall force deviates by {:.1e} of its peak, accepted is {FORCE_TOLERANCE:e}",
                finest.largest
            );
            self.grounds.compare(
                finest.largest,
                finest.round_off,
                FORCE_TOLERANCE,
                Some(note),
            );
        }
    }
}
