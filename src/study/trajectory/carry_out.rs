//! Trajectories carried out, compared and judged.

use super::distance::{Branch, Distance, Milestones, Quantity};
use super::documented::documented;
use super::judge::{FORCE_TOLERANCE, judge_order};
use super::judgement::{Comparison, TrajectoryJudgement};
use super::plan::{DISTURBANCE, Trajectory, Twin, TwinRuns};
use crate::code::Code;
use crate::code::Run;
use crate::model::Case;
use crate::runs::Load;
use crate::runs::{Progress, RunError, SelectedCode, Settings, run_all};
use crate::series::Sample;
use crate::study::Source;
use crate::study::Verdict;

/// What is kept of a run: who made it, and the rows.
type Kept = (String, Vec<Sample>);
type Kepts = Vec<Result<Kept, RunError>>;

/// The runs of the twins, each case once.
struct TwinSeries {
    cases: Vec<Case>,
    series: Kepts,
}

impl TwinSeries {
    fn of(&self, case: &Case) -> Result<&[Sample], &RunError> {
        let index = self.cases.iter().position(|own| own == case);
        let result = &self.series[index.expect("every planned twin has been run")];
        result.as_ref().map(|(_, samples)| samples.as_slice())
    }
}

/// Carries out `plans` and the native twins, and judges every comparison. The order is kept; codes that an
/// interrupt has cut short are left out. `codes` must hold the native code.
pub fn measure_trajectories(
    plans: &[Trajectory],
    codes: &[SelectedCode],
    settings: &Settings,
    progress: &dyn Progress,
) -> Vec<TrajectoryJudgement> {
    let mut loads: Vec<Load> = plans
        .iter()
        .map(|plan| Load {
            code: plan.code,
            cases: plan.cases.clone(),
        })
        .collect();
    loads.push(Load {
        code: Code::NATIVE,
        cases: twin_cases(plans),
    });
    let keep = |run: Run| {
        let version = run.provenance.identity.version;
        (version, run.series.samples().to_vec())
    };
    let mut results = run_all(&loads, codes, settings, progress, keep);
    let twins = TwinSeries {
        series: results.pop().unwrap_or_default(),
        cases: loads.pop().map_or_else(Vec::new, |load| load.cases),
    };
    let complete = plans
        .iter()
        .zip(results)
        .filter(|(plan, results)| !interrupted(plan, results, &twins));
    let judged = complete.map(|(plan, results)| {
        let mut codes = codes.iter();
        let selected = codes.find(|selected| selected.name == plan.code);
        judge_code(plan, selected, results, &twins)
    });
    judged.collect()
}

/// Every case of every twin, once: codes with the same convention have the same twin.
fn twin_cases(plans: &[Trajectory]) -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    let twins = plans.iter().flat_map(|plan| &plan.twins);
    for case in twins.flat_map(TwinRuns::all) {
        if !cases.contains(case) {
            cases.push(*case);
        }
    }
    cases
}

fn interrupted(plan: &Trajectory, results: &Kepts, twins: &TwinSeries) -> bool {
    let is_interrupt =
        |error: &RunError| matches!(error, RunError::Failed(failure) if failure.is_interrupted());
    let own = results.iter().filter_map(|result| result.as_ref().err());
    let of_twins = plan.twins.iter().flat_map(TwinRuns::all);
    own.chain(of_twins.filter_map(|case| twins.of(case).err()))
        .any(is_interrupt)
}

fn judge_code(
    plan: &Trajectory,
    selected: Option<&SelectedCode>,
    results: Kepts,
    twins: &TwinSeries,
) -> TrajectoryJudgement {
    let code = selected.and_then(|selected| selected.code.as_deref());
    let mut judgement = TrajectoryJudgement {
        code: plan.code,
        version: code.map_or_else(String::new, |code| code.identity().version.clone()),
        source: if code.is_some() {
            Source::Live
        } else {
            Source::Recorded
        },
        times: None,
        comparisons: Vec::new(),
        verdict: Verdict::NoYield,
        notes: Vec::new(),
    };
    let mut series = Vec::new();
    for result in results {
        match result {
            Ok((version, samples)) => {
                judgement.version = version;
                series.push(samples);
            }
            Err(error) => judgement.miss(&error),
        }
    }
    for error in plan.twins.iter().flat_map(TwinRuns::all) {
        if let Err(error) = twins.of(error) {
            judgement.miss(error);
        }
    }
    if judgement.notes.is_empty() {
        judgement.compare(plan, &series, twins);
    }
    judgement
}

impl TrajectoryJudgement {
    fn miss(&mut self, error: &RunError) {
        self.verdict = match error {
            RunError::Failed(_) => Verdict::Failed,
            RunError::Missing(_) => Verdict::Missing,
        };
        self.notes.push(error.to_string());
    }

    fn compare(&mut self, plan: &Trajectory, series: &[Vec<Sample>], twins: &TwinSeries) {
        let pairs = plan
            .twins
            .iter()
            .filter_map(|runs| Pair::new(plan, runs, series, twins));
        let pairs: Vec<Pair> = pairs.collect();
        if pairs.len() < plan.twins.len() || pairs.is_empty() {
            let note = "a twin shows no peak of the wall force followed by a landing of cylinder 1";
            self.notes.push(note.to_owned());
            return;
        }
        self.times = pairs.first().map(Pair::times);
        for pair in &pairs {
            for branch in Branch::ALL {
                let quantities = branch.quantities().iter();
                let compared = quantities.map(|&quantity| pair.compare(quantity, branch));
                self.comparisons.extend(compared);
            }
        }
        self.hold_full_twin_to_the_other();
    }

    /// In the collapse the transport of the springs shows, in both twins at the same order. The twin that has
    /// the transport of the code must be the closer one.
    fn hold_full_twin_to_the_other(&mut self) {
        let largest =
            |comparison: &Comparison| comparison.distances.last().map(|finest| finest.largest);
        let (full, others): (Vec<&mut Comparison>, Vec<&mut Comparison>) = self
            .comparisons
            .iter_mut()
            .filter(|comparison| comparison.branch == Branch::Collapse)
            .partition(|comparison| comparison.twin == Twin::Full);
        for (comparison, other) in full.into_iter().zip(others) {
            let Some((own, other)) = largest(comparison)
                .zip(largest(other))
                .filter(|(own, other)| own > other)
            else {
                continue;
            };
            comparison.verdict = Verdict::Differs;
            comparison.note = Some(format!(
                "the twin is further away, {own:.1e}, than one whose springs turn with the contact, {other:.1e}"
            ));
        }
    }
}

/// A code and one of its twins.
struct Pair<'a> {
    code: Code,
    runs: &'a TwinRuns,
    /// Series of the code, one per time step.
    series: &'a [Vec<Sample>],
    /// Series of the twin at the same time steps.
    twin: Vec<&'a [Sample]>,
    halved: &'a [Sample],
    disturbed: &'a [Sample],
    milestones: Milestones,
}

impl<'a> Pair<'a> {
    /// `None` if a run is not there or the twin does not collapse.
    fn new(
        plan: &Trajectory,
        runs: &'a TwinRuns,
        series: &'a [Vec<Sample>],
        twins: &'a TwinSeries,
    ) -> Option<Self> {
        let twin: Option<Vec<&[Sample]>> =
            runs.cases.iter().map(|case| twins.of(case).ok()).collect();
        let twin = twin?;
        Some(Self {
            code: plan.code,
            runs,
            series,
            milestones: Milestones::read(twin.last()?)?,
            twin,
            halved: twins.of(&runs.halved).ok()?,
            disturbed: twins.of(&runs.disturbed).ok()?,
        })
    }

    fn finest(&self) -> &'a [Sample] {
        self.twin.last().copied().unwrap_or_default()
    }

    fn times(&self) -> [f64; 3] {
        let Milestones { peak, lost, landed } = self.milestones;
        [peak, lost, landed].map(|row| self.finest()[row].time)
    }

    fn compare(&self, quantity: Quantity, branch: Branch) -> Comparison {
        let growth = self.growth(quantity, branch);
        let series = self.series.iter().zip(&self.twin).zip(&self.runs.cases);
        let distances = series.map(|((series, twin), case)| Distance {
            round_off: growth * round_off(case),
            ..self.between(quantity, branch, case.protocol.time_step, series, twin)
        });
        let distances: Vec<Distance> = distances.collect();
        let step_error = self.step_error(quantity, branch);
        let documented = documented(self.code, self.runs.twin, quantity, branch);
        let (verdict, note) = judge_order(documented.order, &distances, step_error);
        let comparison = Comparison {
            twin: self.runs.twin,
            quantity,
            branch,
            documented,
            distances,
            step_error,
            verdict,
            note,
        };
        comparison.held_to_the_bar()
    }

    fn between(
        &self,
        quantity: Quantity,
        branch: Branch,
        time_step: f64,
        left: &[Sample],
        right: &[Sample],
    ) -> Distance {
        let unit = match quantity {
            Quantity::WallForce => self.finest()[self.milestones.peak].wall_force,
            _ => 1.0,
        };
        let rows = self.milestones.rows(branch);
        Distance::between(
            quantity,
            unit,
            time_step,
            (&left[rows.clone()], &right[rows]),
        )
    }

    /// Largest change of the twin when a time step is halved. Where it converges that is the change of the
    /// coarsest; where it does not, any of them may be.
    fn step_error(&self, quantity: Quantity, branch: Branch) -> f64 {
        let finer = self.twin.iter().skip(1).copied().chain([self.halved]);
        let changes = self
            .twin
            .iter()
            .zip(finer)
            .map(|(coarse, fine)| self.between(quantity, branch, 0.0, coarse, fine).largest);
        changes.fold(0.0, f64::max)
    }

    /// Factor by which a displacement of the wall grows until it is seen, from the twin with a wall that is
    /// slightly faster; in the unit of the quantity per r, at least 1 of a length.
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

/// What rounding can do to a position of a run, if it always errs to the same side: half a unit in the last
/// place of a coordinate between 2 and 4 in every step, in the code and in its twin.
fn round_off(case: &Case) -> f64 {
    2.0 * f64::EPSILON * case.protocol.schedule().total_steps() as f64
}

impl Comparison {
    /// The wall force must also be close to that of the twin in itself, up to its peak.
    fn held_to_the_bar(mut self) -> Self {
        let judged = self.quantity == Quantity::WallForce && self.branch == Branch::Compression;
        let Some(finest) = self.distances.last().filter(|_| judged) else {
            return self;
        };
        let verdict = Verdict::of(finest.largest, finest.round_off, FORCE_TOLERANCE);
        if verdict != Verdict::Agrees {
            let note = format!(
                "the wall force deviates by {:.1e} of its peak, accepted is {FORCE_TOLERANCE:e}",
                finest.largest
            );
            if self.verdict != Verdict::Differs {
                self.verdict = verdict;
            }
            self.note = Some(
                self.note
                    .map_or(note.clone(), |own| format!("{own}; {note}")),
            );
        }
        self
    }
}
