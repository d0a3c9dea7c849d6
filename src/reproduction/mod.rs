//! What the paper did, done again: the runs behind each of its figures, and some that it lacks.

mod convergence;
mod curves;
mod force_series;
mod preparation;
mod scaling;
mod snapshots;

pub use convergence::{
    Convergence, ConvergencePoint, FAST_WALL, converge, convergence_loads, convergence_stack,
};
pub use curves::{Curves, ModelFormPoint, TheoryPoint, curves};
pub use force_series::{ForceSeries, force_series, force_series_stack};
pub use preparation::{
    CriticalPush, Estimator, PreparationPlan, PreparationRow, PreparationStudy, between_side_walls,
    critical_pushes, plan_preparation, preparation_cases, preparation_studies, study_preparation,
};
pub use scaling::{
    Exponent, FITTED_FROM, SCALING_FRICTIONS, SCALING_STIFFNESSES, asymptotic_exponent, exponents,
    scaling_measurements,
};
pub use snapshots::{Snapshots, snapshots};

use crate::archive::{Provenance, Reading};
use crate::crosscheck::{
    Judgement, Measurement, Participant, Probed, Profile, Progress, Recorded, RunError, Settings,
    Survey, THREE_DIGITS, Trajectory, TrajectoryJudgement, examined_stacks, measure,
    measure_trajectories, plan_trajectory, probe_all, survey, trajectory_stack,
};
use crate::engine::EngineName;
use crate::stack::PAPER_STIFFNESS_RATIO;
use crate::theory::{BoundaryPoint, RegimeMap};
use crate::trace::SeriesError;
use thiserror::Error;

/// Points looked at on every boundary of the regime maps.
const BOUNDARY_POINTS: usize = 13;

/// Everything that was computed and measured for the paper.
pub struct Reproduction {
    /// What every code means by a contact.
    pub probes: Vec<(EngineName, Probed)>,
    /// Fig. 2(a): every stack of the standard profile with every code.
    pub yield_curves: Vec<Judgement>,
    /// Fig. 2(b).
    pub scaling: Vec<Judgement>,
    /// The exponents of Fig. 2(b).
    pub exponents: Vec<Exponent>,
    /// At the paper's literal wall speed and time step.
    pub literal: Vec<Judgement>,
    /// The supplement's figure on wall speed and time step.
    pub convergence: Convergence,
    /// The supplement's figure of f(t).
    pub force_series: ForceSeries,
    /// What the paper's preparation does to c and F, which all else leaves to the gravity ramp.
    pub preparation: Vec<PreparationStudy>,
    /// The stack from rest into collapse.
    pub snapshots: Snapshots,
    /// Whole series beside native twins.
    pub trajectories: Vec<TrajectoryJudgement>,
    /// The regime maps …
    pub maps: [RegimeMap; 3],
    /// … and what the native DEM says of them.
    pub survey: Survey,
    /// The theories over the ranges of the figures.
    pub curves: Curves,
    /// Where the runs come from, in the order of their use.
    pub provenances: Vec<Provenance>,
}

/// Why the paper could not be reproduced.
#[derive(Debug, Error)]
pub enum ReproductionError {
    /// A native run that everything else needs is not there.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The native run that is drawn left the finite numbers.
    #[error(transparent)]
    Series(#[from] SeriesError),
}

/// How the paper is reproduced.
pub struct Scope<'a> {
    /// The codes that take part. The native one must be among them.
    pub participants: &'a [Participant],
    /// Where runs come from and go to.
    pub settings: &'a Settings<'a>,
    /// The recorded runs that stand in for trajectories.
    pub trajectories: Recorded,
    /// Whether all of Fig. 2(a) is run at the paper's literal settings, which takes some ten minutes.
    pub literal: bool,
}

/// Carries out everything; `None` after an interrupt. `examined` is told how many more points of the regime
/// maps, of `Scope::points`, are done.
///
/// # Errors
/// If the native run behind f(t), or one behind A*, fails. Failures of other runs are in the rows.
pub fn reproduce(
    scope: &Scope,
    progress: &dyn Progress,
    examined: &(dyn Fn(usize) + Sync),
) -> Result<Option<Reproduction>, ReproductionError> {
    let Scope {
        participants,
        settings,
        ..
    } = scope;
    let interrupted = || settings.interrupt.requested();
    let probes = probe_all(participants, settings, progress);
    let names = participants.iter().map(|who| who.name);
    let probes: Vec<(EngineName, Probed)> = names.zip(probes).collect();
    let plan = Plan::new(scope);
    let measurements = plan.all();
    let judgements = measure(&measurements, participants, settings, progress);
    if interrupted() {
        return Ok(None);
    }
    let of = |part: &[Measurement]| judged(part, &measurements, &judgements);
    let (yield_curves, scaling) = (of(&plan.yield_curves), of(&plan.scaling));
    let literal = of(&plan.literal);
    let (convergence, mut readings) = converge(participants, settings, progress);
    let native = Participant::find(EngineName::Native);
    if interrupted() {
        return Ok(None);
    }
    let (force_series, reading) = force_series(&native, settings, progress)?;
    readings.push(reading);
    let engines: Vec<EngineName> = participants.iter().map(|who| who.name).collect();
    let preparation = preparation_studies(&engines, settings, progress);
    if interrupted() {
        return Ok(None);
    }
    let preparation = preparation?;
    let trajectories = run_trajectories(scope, &probes, progress);
    let maps = RegimeMap::standard(PAPER_STIFFNESS_RATIO);
    let points = boundary_points(&maps);
    let survey = survey(&points, settings.threads, settings.interrupt, examined);
    if interrupted() {
        return Ok(None);
    }
    let Some(snapshots) = snapshots(settings.interrupt)? else {
        return Ok(None);
    };
    let runs = judgements.iter().flat_map(|judgement| &judgement.runs);
    let runs = runs.chain(&readings);
    let provenances = runs.map(|reading| &reading.provenance);
    let prepared = preparation.iter().flat_map(|study| &study.rows);
    let provenances = provenances.chain(prepared.flat_map(|row| &row.provenances));
    Ok(Some(Reproduction {
        provenances: provenances.cloned().collect(),
        probes,
        exponents: exponents(&scaling),
        yield_curves,
        scaling,
        literal,
        convergence,
        force_series,
        preparation,
        snapshots,
        trajectories,
        maps,
        survey,
        curves: curves(),
    }))
}

/// How many points of the regime maps are examined.
pub fn examined_points() -> usize {
    boundary_points(&RegimeMap::standard(PAPER_STIFFNESS_RATIO)).len() + examined_stacks().len()
}

fn boundary_points(maps: &[RegimeMap]) -> Vec<BoundaryPoint> {
    let of_map = |map: &RegimeMap| map.boundary_points(BOUNDARY_POINTS, THREE_DIGITS);
    maps.iter().flat_map(of_map).collect()
}

fn run_trajectories(
    scope: &Scope,
    probes: &[(EngineName, Probed)],
    progress: &dyn Progress,
) -> Vec<TrajectoryJudgement> {
    let external = scope.participants.iter().map(|who| who.name);
    let external = external.filter(|name| !name.accepts_any_convention());
    let plans: Vec<Trajectory> = external
        .map(|engine| plan_trajectory(engine, &trajectory_stack(), engine.convention()))
        .collect();
    let settings = Settings {
        store: scope.settings.store.clone(),
        recorded: scope.trajectories.clone(),
        ..*scope.settings
    };
    let judged = measure_trajectories(&plans, scope.participants, &settings, progress);
    let judged = judged.into_iter().map(|judgement| {
        let probes = probes.iter().map(|(engine, probed)| (*engine, probed));
        judgement.unless_contradicted(probes)
    });
    judged.collect()
}

/// The measurements behind the figures.
struct Plan {
    yield_curves: Vec<Measurement>,
    scaling: Vec<Measurement>,
    literal: Vec<Measurement>,
}

impl Plan {
    fn new(scope: &Scope) -> Self {
        let engines: Vec<EngineName> = scope.participants.iter().map(|who| who.name).collect();
        let mut literal = Profile::Paper.measurements(&engines);
        if !scope.literal {
            literal.retain(|row| row.stack == convergence_stack());
        }
        Self {
            yield_curves: Profile::Standard.measurements(&engines),
            scaling: scaling_measurements(&engines),
            literal,
        }
    }

    /// Every measurement once: figures share stacks.
    fn all(&self) -> Vec<Measurement> {
        let parts = [&self.yield_curves, &self.scaling, &self.literal];
        let mut all: Vec<Measurement> = Vec::new();
        for measurement in parts.into_iter().flatten() {
            if !all.iter().any(|known| is_same(known, measurement)) {
                all.push(measurement.clone());
            }
        }
        all
    }
}

fn is_same(left: &Measurement, right: &Measurement) -> bool {
    (left.engine, left.stack, left.method) == (right.engine, right.stack, right.method)
}

/// The judgements on `part` of `measurements`, in the order of the part.
fn judged(
    part: &[Measurement],
    measurements: &[Measurement],
    judgements: &[Judgement],
) -> Vec<Judgement> {
    let found = part.iter().filter_map(|wanted| {
        let mut all = measurements.iter().zip(judgements);
        all.find(|(measurement, _)| is_same(measurement, wanted))
    });
    found.map(|(_, judgement)| judgement.clone()).collect()
}

/// Every run of an external engine that the report needs and whose series is too large to keep: the readings
/// that `tristack record` takes.
///
/// # Errors
/// The first run that fails.
pub fn readings_to_record(
    participant: &Participant,
    settings: &Settings,
    progress: &dyn Progress,
) -> Result<Vec<Reading>, RunError> {
    let engines = [participant.name];
    let mut loads = convergence_loads(&engines);
    let measurements = [
        Profile::Standard.measurements(&engines),
        scaling_measurements(&engines),
        Profile::Paper.measurements(&engines),
    ];
    let prepared = preparation_cases(participant.name, settings, progress)?;
    let cases = measurements.into_iter().flatten();
    let cases = cases.flat_map(|measurement| measurement.cases);
    for case in cases.chain(prepared) {
        if !loads[0].cases.contains(&case) {
            loads[0].cases.push(case);
        }
    }
    let participants = std::slice::from_ref(participant);
    let results = crate::crosscheck::read_all(&loads, participants, settings, progress);
    results.into_iter().flatten().collect()
}
