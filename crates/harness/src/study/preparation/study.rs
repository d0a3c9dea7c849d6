//! c(A) and F(A) of every code, beside the gravity ramp and the exact limit.

use super::critical::{CriticalPush, critical_pushes};
use super::plan::{PreparationPlan, plan_preparation};
use crate::code::{Code, Provenance, SettledCode, Unknown};
use crate::model::{Arms, CRITICAL_FRICTION, Case, ContactConvention, Problem, Stack};
use crate::runs::{RunError, RunSummary, Workload};
use crate::series::YieldEstimates;
use crate::study::yield_force::{
    COARSE_TIME_STEP_RUN, Estimator, MIDDLE_RUN, SHORT_RAMP_RUN, peak_allowance,
};
use crate::study::{Campaign, Evaluation, Ground, Grounds, Judged, Study};
use crate::theory::{critical_push, pushed_slip_force, quasistatic_limit};
use serde::Serialize;

/// A row: the result of one preparation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PreparationRow {
    /// The code.
    pub code: Code,
    /// The code whose convention it has; native with that of another code is its twin.
    pub convention_of: Code,
    /// A in r; `None` for the gravity ramp.
    pub push: Option<f64>,
    /// In m g: after a gravity ramp, the exact limit under this convention; after a push, what becomes of that limit
    /// if nothing slides during the preparation ([`pushed_slip_force`]), for arms 0 and linear springs alone.
    pub limit_force: Option<f64>,
    /// c between the bottom cylinders when the compression begins, in m g.
    pub contact_force: Option<f64>,
    /// Its change with twice the time step and half the rests, in m g.
    pub contact_uncertainty: Option<f64>,
    /// F at vanishing wall speed, in m g.
    pub yield_force: Option<f64>,
    /// Its uncertainty in m g: wall speed, time step, rests, sampling, round-off, print precision.
    pub uncertainty: Option<f64>,
    /// The estimator of F.
    pub estimator: Option<Estimator>,
    /// Why something is missing.
    pub note: Option<String>,
    /// The origin of its runs.
    #[serde(skip)]
    pub provenances: Vec<Provenance>,
}

/// The effect of the preparation on a stack.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PreparationStudy {
    /// The stack.
    pub stack: Stack,
    /// The exact quasi-static limit after a gravity ramp, under the paper's convention, in m g.
    pub exact_force: Option<f64>,
    /// A* to leading order in ε, if nothing slides during the preparation, in r.
    pub predicted_critical_push: f64,
    /// A* by bisection, under the paper's convention.
    pub critical_push: Option<CriticalPush>,
    /// For every code, and every code's native twin: the gravity ramp, then the pushes in order, A*
    /// among them.
    pub rows: Vec<PreparationRow>,
}

impl PreparationStudy {
    /// Returns the rows of `code` with the convention of `convention_of`.
    pub fn rows_of(
        &self,
        code: &Code,
        convention_of: &Code,
    ) -> impl Iterator<Item = &PreparationRow> {
        let own =
            move |row: &&PreparationRow| row.code == *code && row.convention_of == *convention_of;
        self.rows.iter().filter(own)
    }

    /// Returns by how much F at `push` exceeds F at A = 0, natively under the paper's convention, relative to F + 3
    /// at A = 0.
    pub fn shift(&self, push: f64) -> Option<f64> {
        let native = Code::native();
        let force = |push: f64| {
            let mut rows = self.rows_of(&native, &native);
            rows.find(|row| row.push == Some(push))?.yield_force
        };
        let unpushed = force(0.0)?;
        Some((force(push)? - unpushed) / (unpushed + 3.0))
    }
}

/// Frictions below, at and above the critical one, and stiffnesses, of the paper's figures.
const FRICTIONS: [f64; 3] = [0.2, CRITICAL_FRICTION, 0.3];
const STIFFNESSES: [f64; 2] = [1e2, 1e4];
/// Pushes in units of ε, besides 0 and A*: two below A*, three above.
const PUSHES: [f64; 5] = [0.25, 0.5, 1.0, 2.0, 5.0];

/// Carries out the studies for the paper's figures: every one of `codes` at μ = 0.2 and stiffness 100, and native at
/// frictions below, at and above the critical one at the stiffnesses 100 and 10⁴.
pub fn preparation_studies(
    campaign: &Campaign,
    codes: &[SettledCode],
) -> Result<Vec<PreparationStudy>, RunError> {
    let stacks: Vec<Stack> = STIFFNESSES
        .iter()
        .flat_map(|&stiffness| FRICTIONS.map(|friction| Stack::paper(friction, stiffness)))
        .collect();
    let (first, others) = stacks.split_at(1);
    let mut studies = study_preparation(campaign, first, &PUSHES, codes)?;
    studies.extend(study_preparation(campaign, others, &PUSHES, &[])?);
    Ok(studies)
}

/// Returns the cases of [`preparation_studies`] that `code` runs.
pub fn preparation_cases(campaign: &Campaign, code: &SettledCode) -> Result<Vec<Case>, RunError> {
    let stack = Stack::paper(FRICTIONS[0], STIFFNESSES[0]);
    let critical = critical_pushes(campaign, &[stack])?;
    let critical = critical.first().and_then(Option::as_ref);
    let mut plans = plans_of(&stack, &PUSHES, critical, std::slice::from_ref(code));
    plans.retain(|plan| plan.code == *code);
    Ok(plans
        .iter()
        .flat_map(|plan| plan.cases())
        .copied()
        .collect())
}

/// Measures c(A) and F(A) of each of `stacks` with native and every one of `codes`, at A = 0, at A* and at
/// the pushes `relative_pushes` × ε; codes without side walls have the gravity ramp alone. Native
/// computes a twin of every other code.
///
/// # Errors
/// If a step of the bisection failed. A failed row says so in its note.
pub fn study_preparation(
    campaign: &Campaign,
    stacks: &[Stack],
    relative_pushes: &[f64],
    codes: &[SettledCode],
) -> Result<Vec<PreparationStudy>, RunError> {
    let critical = critical_pushes(campaign, stacks)?;
    let mut all = [&[SettledCode::native()], codes].concat();
    all.sort_by(|one, other| one.name().cmp(other.name()));
    all.dedup_by(|one, other| one.name() == other.name());
    let plans = stacks.iter().zip(&critical);
    let plans =
        plans.map(|(stack, critical)| plans_of(stack, relative_pushes, critical.as_ref(), &all));
    let plans: Vec<Vec<PreparationPlan>> = plans.collect();
    let counts: Vec<usize> = plans.iter().map(Vec::len).collect();
    let judged = campaign.carry_out(plans.concat());
    let mut rows = judged.into_iter().map(PreparationRow::new);
    let studies = stacks.iter().zip(critical).zip(counts);
    Ok(studies
        .map(|((stack, found), count)| PreparationStudy {
            stack: *stack,
            exact_force: exact_force(stack),
            predicted_critical_push: critical_push(stack),
            critical_push: found,
            rows: rows.by_ref().take(count).collect(),
        })
        .collect())
}

fn exact_force(stack: &Stack) -> Option<f64> {
    let problem = Problem::new(*stack, ContactConvention::PAPER).ok()?;
    quasistatic_limit(&problem).yield_force
}

fn plans_of(
    stack: &Stack,
    relative_pushes: &[f64],
    critical: Option<&CriticalPush>,
    codes: &[SettledCode],
) -> Vec<PreparationPlan> {
    let relative = relative_pushes.iter().map(|push| push * stack.epsilon());
    let mut pushes: Vec<f64> = relative.chain(critical.map(|found| found.push)).collect();
    pushes.push(0.0);
    pushes.sort_by(f64::total_cmp);
    pushes.dedup();
    let preparations = || [None].into_iter().chain(pushes.iter().copied().map(Some));
    let mut plans = Vec::new();
    let native = SettledCode::native();
    for own in codes {
        let twin = (!own.name().is_native()).then_some(&native);
        for code in [own].into_iter().chain(twin) {
            plans.extend(preparations().map(|push| plan_preparation(code, own, stack, push)));
        }
    }
    plans.retain(|plan| {
        // A twin without its original is of no use.
        let names = [plan.code.name(), &plan.convention_of];
        let offered = |case: &Case| {
            let preparation = &case.protocol.preparation;
            let refused = |name: &Code| name.check_preparation(stack, preparation).is_err();
            !names.into_iter().any(refused)
        };
        plan.cases().iter().all(offered)
    });
    plans
}

fn limit_force(plan: &PreparationPlan) -> Option<f64> {
    let convention = plan.measurement.convention;
    match plan.push {
        None => plan.measurement.limit.yield_force,
        Some(push) if convention.arms == Arms::PAPER && convention.law.is_linear() => {
            pushed_slip_force(&plan.measurement.stack, push, convention.history_update)
        }
        Some(_) => None,
    }
}

/// The result of the runs of a preparation.
#[derive(Debug, Clone, PartialEq)]
pub struct PreparationFinding {
    /// c between the bottom cylinders when the compression begins, in m g.
    contact_force: Option<f64>,
    /// Its change with twice the time step and half the rests, in m g.
    contact_uncertainty: Option<f64>,
    /// F at vanishing wall speed with its uncertainty, in m g.
    yield_force: Option<(f64, f64, Estimator)>,
    /// The origin of the runs.
    provenances: Vec<Provenance>,
}

impl Study for PreparationPlan {
    type Reading = RunSummary;
    type Finding = PreparationFinding;

    fn code(&self) -> SettledCode {
        self.code.clone()
    }

    fn depends_on(&self, unknown: &Unknown) -> bool {
        unknown.moves_limit
    }

    fn workloads(&self) -> Vec<Workload> {
        self.measurement.workloads()
    }

    fn evaluate(&self, runs: Vec<Vec<RunSummary>>) -> Evaluation<PreparationFinding> {
        let runs: Vec<RunSummary> = runs.into_iter().flatten().collect();
        let contact = |run: usize| runs.get(run)?.contact_force;
        let change = |run: usize| Some((contact(run)? - contact(MIDDLE_RUN)?).abs());
        let changes = change(COARSE_TIME_STEP_RUN).zip(change(SHORT_RAMP_RUN));
        let yield_force = self.yield_force(&runs);
        let mut grounds = Grounds::new();
        if let Some(run) = runs.iter().find(|run| !run.absent.is_empty()) {
            grounds.doubt_what_is_not_tested(&run.absent);
        }
        if runs.is_empty() {
            grounds.add(Ground::NoYield(Some("nothing yields".to_owned())));
        } else if yield_force.is_none() {
            grounds.add(Ground::NoYield(Some(
                "the wall force has no peak".to_owned(),
            )));
        }
        Evaluation {
            finding: PreparationFinding {
                contact_force: contact(MIDDLE_RUN),
                contact_uncertainty: changes.map(|(time_step, rest)| time_step + rest),
                yield_force,
                provenances: runs.into_iter().map(|run| run.provenance).collect(),
            },
            grounds,
        }
    }
}

impl PreparationPlan {
    /// Returns F with its uncertainty, from the slip onset unless the peak contradicts it, else from the peak; `None`
    /// without a peak.
    fn yield_force(&self, runs: &[RunSummary]) -> Option<(f64, f64, Estimator)> {
        let estimates: Vec<YieldEstimates> = runs.iter().map(|run| run.estimates).collect();
        let slip = self
            .measurement
            .extrapolate(&estimates, Estimator::SlipOnset);
        let peak = self.measurement.extrapolate(&estimates, Estimator::Peak)?;
        let allowance = peak_allowance(&self.measurement, peak.force).unwrap_or(0.0);
        let peak_uncertainty = peak.budget.total() + allowance;
        let same = slip.filter(|slip| {
            (slip.force - peak.force).abs() <= slip.budget.total() + peak_uncertainty
        });
        Some(match same {
            Some(slip) => (slip.force, slip.budget.total(), Estimator::SlipOnset),
            None => (peak.force, peak_uncertainty, Estimator::Peak),
        })
    }
}

impl PreparationRow {
    fn new(judged: Judged<PreparationPlan, PreparationFinding>) -> Self {
        let note = judged.notes().join("; ");
        let plan = judged.study;
        let finding = judged.finding.as_ref();
        let force = finding.and_then(|finding| finding.yield_force);
        Self {
            code: plan.code.name().clone(),
            convention_of: plan.convention_of.clone(),
            push: plan.push,
            limit_force: limit_force(&plan),
            contact_force: finding.and_then(|finding| finding.contact_force),
            contact_uncertainty: finding.and_then(|finding| finding.contact_uncertainty),
            yield_force: force.map(|(force, ..)| force),
            uncertainty: force.map(|(_, uncertainty, _)| uncertainty),
            estimator: force.map(|(.., estimator)| estimator),
            note: (!note.is_empty()).then_some(note),
            provenances: judged
                .finding
                .map_or_else(Vec::new, |finding| finding.provenances),
        }
    }
}
