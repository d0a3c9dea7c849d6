//! Reproduction of the paper: the runs behind each of its figures, and some that it lacks.

mod convergence;
mod curves;
mod force_series;
mod laws;
mod scaling;
mod snapshots;
mod spheres;

pub use convergence::{
    Convergence, ConvergencePoint, FAST_WALL, WALL_SPEEDS, converge, convergence_stack,
    convergence_workloads,
};
pub use curves::{Curves, ModelFormPoint, TheoryPoint, curves};
pub use force_series::{ForceSeries, force_series, force_series_stack};
pub use laws::Laws;
pub use scaling::{
    Exponent, FITTED_FROM, SCALING_FRICTIONS, exponent_at, exponents, scaling_measurements, slope,
};
pub use snapshots::{Snapshots, snapshots};
pub use spheres::{BodiesCurve, SPHERES_STIFFNESSES, Spheres};

use crate::code::{Code, Provenance, SettledCode};
use crate::model::{
    Case, HistoryUpdate, PAPER_BODIES, PAPER_STIFFNESS_RATIO, Power, Problem, Stack,
};
use crate::published::{Checkout, Published};
use crate::runs::{Progress, RunError, RunSummary, SelectedCode, Settings, Workload};
use crate::series::SeriesError;
use crate::study::Campaign;
use crate::study::convention::Probed;
use crate::study::preparation::{PreparationStudy, preparation_cases, preparation_studies};
use crate::study::regimes::{Survey, SurveyPlan, THREE_DIGITS, examined_stacks, survey};
use crate::study::trajectory::{
    Trajectory, TrajectoryJudgement, plan_trajectory, trajectory_stack,
};
use crate::study::yield_force::{Judgement, Measurement, Profile, protocol_at_speed};
use crate::theory::{BoundaryPoint, RegimeMap, quasistatic_limit};
use thiserror::Error;

/// Number of points examined on every boundary of the regime maps.
const BOUNDARY_POINTS: usize = 13;

/// Everything that was computed and measured for the paper.
pub struct Reproduction {
    /// The contact convention of every code, as probed.
    pub probes: Vec<(Code, Probed)>,
    /// Fig. 2(a): every stack of the standard profile with every code.
    pub yield_curves: Vec<Judgement>,
    /// Fig. 2(b).
    pub scaling: Vec<Judgement>,
    /// The exponents of Fig. 2(b).
    pub exponents: Vec<Exponent>,
    /// The same stack with Hertz contacts.
    pub laws: Laws,
    /// Yield forces at the paper's literal wall speed and time step.
    pub literal: Vec<Judgement>,
    /// The supplement's figure on wall speed and time step.
    pub convergence: Convergence,
    /// The supplement's figure of f(t).
    pub force_series: ForceSeries,
    /// Effect of the paper's preparation on c and F. All other runs are prepared by the gravity ramp.
    pub preparation: Vec<PreparationStudy>,
    /// The stack from rest into collapse.
    pub snapshots: Snapshots,
    /// Whole series, compared with native twins.
    pub trajectories: Vec<TrajectoryJudgement>,
    /// The regime maps.
    pub maps: [RegimeMap; 3],
    /// The native DEM's confirmation of the maps.
    pub survey: Survey,
    /// The theories over the ranges of the figures.
    pub curves: Curves,
    /// Spheres in place of cylinders.
    pub spheres: Spheres,
    /// The authors' published data, and its reproduction by native runs of their program; `None` without a checkout.
    pub published: Option<Published>,
    /// The origins of the runs, in the order of their use.
    pub provenances: Vec<Provenance>,
}

impl Reproduction {
    /// Returns every row that is judged: the yield curves and the scaling of both laws. Rows at the paper's literal
    /// settings are only for comparison.
    pub fn judged_rows(&self) -> impl Iterator<Item = &Judgement> {
        let linear = self.yield_curves.iter().chain(&self.scaling);
        linear
            .chain(&self.laws.yield_curves)
            .chain(&self.laws.scaling)
    }
}

/// A failure without which the paper cannot be reproduced.
#[derive(Debug, Error)]
pub enum ReproductionError {
    /// A native run that everything else needs has failed.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The series of the native run that is drawn is invalid.
    #[error(transparent)]
    Series(#[from] SeriesError),
}

/// Extent and settings of a reproduction.
pub struct Scope<'a> {
    /// The codes with the paper's law that take part. The native one must be among them.
    pub codes: &'a [SelectedCode],
    /// The codes with Hertz's law that take part.
    pub hertz_codes: &'a [SelectedCode],
    /// Stores of the runs, and how new ones are made.
    pub settings: &'a Settings<'a>,
    /// Whether all of Fig. 2(a) is run at the paper's literal settings, which takes some ten minutes.
    pub literal: bool,
    /// The authors' repository.
    pub published: Option<&'a Checkout>,
}

/// Reproduces the paper; returns `None` after an interrupt.
///
/// # Errors
/// If the native run behind f(t), or one behind A*, fails. Failures of other runs are in the rows.
pub fn reproduce(
    scope: &Scope,
    progress: &dyn Progress,
) -> Result<Option<Reproduction>, ReproductionError> {
    let settings = scope.settings;
    let campaign = Campaign::new(scope.codes, settings, progress);
    let codes = with_the_rest(&campaign.settled());
    let (theory, measured) =
        rayon::join(|| Theory::new(&codes), || Measured::new(scope, &campaign));
    let Some(measured) = measured? else {
        return Ok(None);
    };
    let laws = Laws::new(&Campaign::new(scope.hertz_codes, settings, progress));
    let Some(survey) = survey(&theory.survey, &campaign) else {
        return Ok(None);
    };
    let Some(snapshots) = snapshots(settings.interrupt)? else {
        return Ok(None);
    };
    let published = match scope.published {
        None => None,
        Some(checkout) => match Published::repeat(checkout, &campaign) {
            None => return Ok(None),
            repeated => repeated,
        },
    };
    let names = campaign.names().into_iter();
    let mut provenances = measured.provenances;
    provenances.extend(provenances_of(&laws.yield_curves));
    provenances.extend(provenances_of(&laws.scaling));
    Ok(Some(Reproduction {
        provenances,
        laws,
        probes: names.zip(campaign.into_probes()).collect(),
        exponents: exponents(&measured.scaling),
        yield_curves: measured.yield_curves,
        scaling: measured.scaling,
        literal: measured.literal,
        convergence: measured.convergence,
        force_series: measured.force_series,
        preparation: measured.preparation,
        trajectories: measured.trajectories,
        snapshots,
        maps: theory.maps,
        survey,
        curves: theory.curves,
        spheres: theory.spheres,
        published,
    }))
}

/// Adds the other codes with linear springs whose manifests declare the whole convention, and sorts all by name.
fn with_the_rest(settled: &[SettledCode]) -> Vec<SettledCode> {
    let rest = Code::with_power(Power::Linear).into_iter();
    let rest = rest.filter(|code| !settled.iter().any(|own| own.name() == code));
    let mut all = settled.to_vec();
    all.extend(rest.filter_map(|code| code.as_declared()));
    all.sort_by(|one, other| one.name().cmp(other.name()));
    all
}

/// Results that need no runs.
struct Theory {
    maps: [RegimeMap; 3],
    survey: SurveyPlan,
    curves: Curves,
    spheres: Spheres,
}

impl Theory {
    fn new(codes: &[SettledCode]) -> Self {
        let maps = RegimeMap::standard(PAPER_STIFFNESS_RATIO, HistoryUpdate::Fixed);
        Self {
            survey: SurveyPlan::new(
                &boundary_points(&maps),
                &examined_stacks(HistoryUpdate::Fixed),
                HistoryUpdate::Fixed,
            ),
            curves: curves(codes),
            spheres: Spheres::new(),
            maps,
        }
    }
}

/// Results that are read off runs.
struct Measured {
    yield_curves: Vec<Judgement>,
    scaling: Vec<Judgement>,
    literal: Vec<Judgement>,
    convergence: Convergence,
    force_series: ForceSeries,
    preparation: Vec<PreparationStudy>,
    trajectories: Vec<TrajectoryJudgement>,
    provenances: Vec<Provenance>,
}

impl Measured {
    /// Carries out all runs; returns `None` after an interrupt.
    fn new(scope: &Scope, campaign: &Campaign) -> Result<Option<Self>, RunError> {
        let interrupted = || scope.settings.interrupt.requested();
        let parts = planned(scope, &campaign.settled());
        let judgements = campaign.carry_out(every_measurement(&parts));
        if interrupted() {
            return Ok(None);
        }
        let (convergence, mut summaries) = converge(campaign);
        if interrupted() {
            return Ok(None);
        }
        let (force_series, summary) = force_series(campaign)?;
        summaries.push(summary);
        let preparation = preparation_studies(campaign, &campaign.settled());
        if interrupted() {
            return Ok(None);
        }
        let preparation = preparation?;
        let runs = summaries.iter().map(|summary| &summary.provenance);
        let prepared = preparation.iter().flat_map(|study| &study.rows);
        let prepared = prepared.flat_map(|row| &row.provenances);
        let mut provenances: Vec<Provenance> = provenances_of(&judgements).collect();
        provenances.extend(runs.chain(prepared).cloned());
        let [yield_curves, scaling, literal] = parts.map(|part| judged(&part, &judgements));
        let trajectories = campaign.carry_out(trajectories(&campaign.settled()));
        Ok(Some(Self {
            yield_curves,
            scaling,
            literal,
            convergence,
            force_series,
            preparation,
            trajectories,
            provenances,
        }))
    }
}

/// Returns the origins of the runs behind `judgements`.
fn provenances_of(judgements: &[Judgement]) -> impl Iterator<Item = Provenance> {
    let runs = judgements.iter().flat_map(Judgement::runs);
    runs.map(|summary| summary.provenance.clone())
}

/// Returns the run of `stack` at a given wall speed; `None` if the stack does not yield.
fn case_at_speed(
    code: &SettledCode,
    stack: Stack,
    wall_speed: f64,
    time_step: f64,
) -> Option<Case> {
    let convention = code.stack_convention(Power::Linear, stack.bodies);
    let limit = quasistatic_limit(&Problem::new(stack, convention).ok()?);
    Some(Case {
        stack,
        convention,
        protocol: protocol_at_speed(&limit, wall_speed, time_step)?,
    })
}

fn boundary_points(maps: &[RegimeMap]) -> Vec<BoundaryPoint> {
    let of_map = |map: &RegimeMap| map.boundary_points(BOUNDARY_POINTS, THREE_DIGITS);
    maps.iter().flat_map(of_map).collect()
}

fn trajectories(codes: &[SettledCode]) -> Vec<Trajectory> {
    let codes = codes.iter();
    let external = codes.filter(|code| !code.name().accepts_any_convention());
    let planned = external.map(|code| {
        let convention = code.convention();
        let stack = trajectory_stack(PAPER_BODIES, convention.law.power);
        plan_trajectory(code, &stack, convention)
    });
    planned.collect()
}

/// Returns the measurements behind Fig. 2(a) and Fig. 2(b), and those at the paper's literal settings.
fn planned(scope: &Scope, codes: &[SettledCode]) -> [Vec<Measurement>; 3] {
    let [yield_curves, scaling, mut literal] = all_measurements(codes);
    if !scope.literal {
        literal.retain(|row| row.stack == convergence_stack());
    }
    [yield_curves, scaling, literal]
}

fn all_measurements(codes: &[SettledCode]) -> [Vec<Measurement>; 3] {
    [
        Profile::Standard.measurements(codes),
        scaling_measurements(codes),
        Profile::Paper.measurements(codes),
    ]
}

/// Returns every measurement once, since figures share stacks.
fn every_measurement(parts: &[Vec<Measurement>]) -> Vec<Measurement> {
    let mut all: Vec<Measurement> = Vec::new();
    for measurement in parts.iter().flatten() {
        if !all.iter().any(|known| is_same(known, measurement)) {
            all.push(measurement.clone());
        }
    }
    all
}

fn is_same(left: &Measurement, right: &Measurement) -> bool {
    (&left.code, left.stack, left.method) == (&right.code, right.stack, right.method)
}

/// Returns the `judgements` of the measurements in `part`, in the order of `part`.
fn judged(part: &[Measurement], judgements: &[Judgement]) -> Vec<Judgement> {
    let found = part.iter().filter_map(|wanted| {
        let mut all = judgements.iter();
        all.find(|judgement| is_same(&judgement.study, wanted))
    });
    found.cloned().collect()
}

/// Returns the summaries of all runs of an external code that the report needs, for `tristack record`.
///
/// # Errors
/// The first run that fails.
pub fn summaries_to_record(
    selected: &SelectedCode,
    settings: &Settings,
    progress: &dyn Progress,
) -> Result<Vec<RunSummary>, RunError> {
    let campaign = Campaign::new(std::slice::from_ref(selected), settings, progress);
    let mut tasks: Vec<Case> = Vec::new();
    for case in cases_to_record(&campaign)? {
        if !tasks.contains(&case) {
            tasks.push(case);
        }
    }
    let code = selected.name.clone();
    let results = campaign.read(&[Workload { code, tasks }]);
    results.into_iter().flatten().collect()
}

fn cases_to_record(campaign: &Campaign) -> Result<Vec<Case>, RunError> {
    let codes = campaign.settled();
    let cases = |measurements: &[Vec<Measurement>]| -> Vec<Case> {
        let all = measurements.iter().flatten();
        all.flat_map(|measurement| measurement.cases.clone())
            .collect()
    };
    if !codes
        .iter()
        .all(|code| code.name().has_power(Power::Linear))
    {
        return Ok(cases(&laws::measurements(&codes)));
    }
    let convergence = convergence_workloads(&codes).into_iter();
    let mut all: Vec<Case> = convergence.flat_map(|workload| workload.tasks).collect();
    all.extend(cases(&all_measurements(&codes)));
    for code in &codes {
        all.extend(preparation_cases(campaign, code)?);
    }
    Ok(all)
}
