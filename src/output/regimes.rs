//! The regime map and what the DEM says of it, in every format.

use super::number::{optional, relative, significant};
use super::table::Table;
use crate::model::Stack;
use crate::study::Verdict;
use crate::study::regimes::{Confirmation, Examination, Survey, THREE_DIGITS};
use crate::study::yield_force::Evidence;
use crate::theory::{
    Across, Axis, EquilibriumPath, Event, FailureMode, LoadingOutcome, LoadingPhase, Regime,
    RegimeMap,
};
use serde::Serialize;

/// One stack of the map.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct MapRow {
    map: &'static str,
    mu: f64,
    stiffness: f64,
    mu_d: f64,
    kappa: f64,
    event: Event,
    stage: LoadingPhase,
    force: f64,
    #[serde(rename = "T")]
    tangent: f64,
    largest_force: Option<f64>,
    failure_mode: FailureMode,
    then: Event,
}

/// One point of a boundary.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct BoundaryRow {
    map: &'static str,
    across: &'static str,
    mu: f64,
    stiffness: f64,
    mu_d: f64,
    kappa: f64,
    distance: f64,
    below: String,
    above: String,
    below_observed: Option<String>,
    above_observed: Option<String>,
    below_verdict: Verdict,
    above_verdict: Verdict,
    verdict: Verdict,
}

/// The largest force of one stack.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct ForceRow {
    mu: f64,
    stiffness: f64,
    mu_d: f64,
    kappa: f64,
    event: Event,
    failure_mode: FailureMode,
    largest_force: Option<f64>,
    observed_force: Option<f64>,
    uncertainty: Option<f64>,
    error: Option<f64>,
    verdict: Verdict,
}

impl MapRow {
    fn new(axis: Axis, stack: &Stack, outcome: &LoadingOutcome) -> Self {
        Self {
            map: axis.as_str(),
            mu: stack.floor_friction,
            stiffness: stack.stiffness,
            mu_d: stack.cylinder_friction,
            kappa: stack.stiffness_ratio,
            event: outcome.first.event,
            stage: outcome.first.stage,
            force: outcome.first.force,
            tangent: outcome.first.tangent,
            largest_force: outcome.largest_force,
            failure_mode: outcome.failure_mode,
            then: outcome.last.event,
        }
    }
}

impl BoundaryRow {
    fn new(confirmation: &Confirmation) -> Self {
        let point = &confirmation.point;
        let [below, above] = point.sides.map(|outcome| outcome.regime().to_string());
        let observed = |regime: Option<Regime>| regime.map(|regime| regime.to_string());
        let [first, second] = confirmation.sides;
        Self {
            map: point.map.as_str(),
            across: across_name(point.across),
            mu: point.stack.floor_friction,
            stiffness: point.stack.stiffness,
            mu_d: point.stack.cylinder_friction,
            kappa: point.stack.stiffness_ratio,
            distance: point.distance,
            below,
            above,
            below_observed: observed(first.observed),
            above_observed: observed(second.observed),
            below_verdict: first.verdict,
            above_verdict: second.verdict,
            verdict: confirmation.verdict(),
        }
    }
}

impl ForceRow {
    fn new(examination: &Examination) -> Self {
        let stack = &examination.stack;
        Self {
            mu: stack.floor_friction,
            stiffness: stack.stiffness,
            mu_d: stack.cylinder_friction,
            kappa: stack.stiffness_ratio,
            event: examination.claimed.first.event,
            failure_mode: examination.claimed.failure_mode,
            largest_force: examination.claimed.largest_force,
            observed_force: examination.peak.map(|peak| peak.force),
            uncertainty: examination.uncertainty,
            error: examination.error,
            verdict: examination.verdict,
        }
    }
}

fn across_name(across: Across) -> &'static str {
    match across {
        Across::Friction => "mu",
        Across::Axis(axis) => axis.as_str(),
    }
}

/// The map as a grid of `columns` values on the axis by `rows` floor frictions.
pub fn regimes_csv(maps: &[RegimeMap], columns: usize, rows: usize) -> Vec<u8> {
    lines(maps.iter().flat_map(|map| grid(map, columns, rows)))
}

fn grid(map: &RegimeMap, columns: usize, rows: usize) -> Vec<MapRow> {
    let mut grid = Vec::new();
    for value in map.axis_values(columns) {
        let path = EquilibriumPath::new(&map.axis.set(&map.base, value));
        let stacks = map.friction_values(rows).into_iter();
        let stacks = stacks.map(|friction| map.stack(value, friction));
        grid.extend(stacks.filter_map(|stack| {
            let outcome = LoadingOutcome::on(&path, &stack)?;
            Some(MapRow::new(map.axis, &stack, &outcome))
        }));
    }
    grid
}

/// The boundary points with every digit.
pub fn boundaries_csv(survey: &Survey) -> Vec<u8> {
    lines(survey.confirmations.iter().map(BoundaryRow::new))
}

/// The largest forces with every digit.
pub fn largest_forces_csv(survey: &Survey) -> Vec<u8> {
    lines(survey.examinations.iter().map(ForceRow::new))
}

fn lines(rows: impl Iterator<Item = impl Serialize>) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer
            .serialize(row)
            .expect("plain rows are written to memory");
    }
    writer.into_inner().expect("memory is flushed")
}

/// Boundaries and largest forces as one object.
pub fn survey_json(survey: &Survey) -> String {
    #[derive(Serialize)]
    struct Both {
        boundaries: Vec<BoundaryRow>,
        largest_forces: Vec<ForceRow>,
    }
    let both = Both {
        boundaries: survey.confirmations.iter().map(BoundaryRow::new).collect(),
        largest_forces: survey.examinations.iter().map(ForceRow::new).collect(),
    };
    serde_json::to_string_pretty(&both).expect("plain rows have a JSON form") + "\n"
}

/// Boundaries and largest forces for a terminal.
pub fn survey_table(survey: &Survey) -> String {
    let [friction, lines, forces] = tables(survey).map(|table| table.terminal());
    format!(
        "Boundaries in mu, and how many of their neighbours at a relative distance of {THREE_DIGITS:e} are in \
         the DEM what they should be\n{friction}\n\
         Boundaries that do not depend on mu, looked at from mu on\n{lines}\n\
         Largest force F that a stack bears, theory and peak of the DEM at vanishing wall speed\n{forces}"
    )
}

/// The same as a page, with what each event does and the figure.
pub fn regimes_markdown(survey: &Survey, command: &str) -> String {
    let [friction, lines, forces] = tables(survey).map(|table| table.markdown());
    format!(
        "# Which event comes first\n\nMade by tristack {} with `{command}`.\n\n\
         ![The three maps](regimes.svg)\n\n\
         Colours say how a stack ends, full lines where another event comes first, dashed lines where the \
         end changes while the events come in the same order. A marker is a point that was looked at with the \
         native DEM on both sides; it is filled if the DEM shows on both what it should.\n\n\
         ## What each event does\n\n{}\n\
         ## Boundaries in mu\n\nOn both sides, at a relative distance of {THREE_DIGITS:e}, the DEM was asked \
         what happens first.\n\n{friction}\n\
         ## Boundaries that do not depend on mu\n\n{lines}\n\
         ## Largest force\n\nThe peak of the wall force in the DEM, extrapolated to vanishing wall speed; \
         the error is relative to F + 3.\n\n{forces}\n\
         ## Evidence\n\nOf the kind *{}*: it does not prove {}.\n",
        env!("CARGO_PKG_VERSION"),
        what_events_do(),
        Evidence::ClosedForm.as_str(),
        Evidence::ClosedForm.does_not_prove()
    )
}

fn what_events_do() -> String {
    let events = [
        ("floor slip under the wall, c = 0", FailureMode::Yields),
        (
            "cylinder slip under the wall, c = 0",
            FailureMode::Saturates,
        ),
        ("contact 2-3 closes", FailureMode::Shares),
        ("top wall reaches cylinder 2", FailureMode::SecondLoadPath),
        ("any slip under own weight, c = 0", FailureMode::Collapses),
        (
            "none, while the load passes a maximum",
            FailureMode::Softens,
        ),
    ];
    let mut table = Table::new(&["event", "what it does"]);
    for (event, failure_mode) in events {
        table.push(vec![event.to_owned(), failure_mode.to_string()]);
    }
    table.markdown()
}

fn tables(survey: &Survey) -> [Table; 3] {
    [
        friction_table(survey),
        line_table(survey),
        force_table(survey),
    ]
}

/// Confirmations of the same kind that follow each other.
fn groups<Key: PartialEq>(
    survey: &Survey,
    key: impl Fn(&Confirmation) -> Option<Key>,
) -> Vec<(Key, Vec<&Confirmation>)> {
    let mut groups: Vec<(Key, Vec<&Confirmation>)> = Vec::new();
    for confirmation in &survey.confirmations {
        let Some(key) = key(confirmation) else {
            continue;
        };
        match groups.last_mut() {
            Some((last, members)) if *last == key => members.push(confirmation),
            _ => groups.push((key, vec![confirmation])),
        }
    }
    groups
}

fn friction_table(survey: &Survey) -> Table {
    let mut table = Table::new(&[
        "map",
        "at>",
        "own weight up to mu>",
        "floor slip up to mu>",
        "beyond it",
        "DEM>",
    ]);
    let key = |confirmation: &Confirmation| {
        let point = &confirmation.point;
        (point.across == Across::Friction).then(|| (point.map, point.map.get(&point.stack)))
    };
    for ((axis, value), members) in groups(survey, key) {
        let friction = |own_weight: bool| {
            let point = members
                .iter()
                .map(|member| &member.point)
                .find(|point| (point.sides[0].last.stage == LoadingPhase::OwnWeight) == own_weight);
            point.map(|point| point.stack.floor_friction)
        };
        let beyond = members
            .last()
            .map(|member| member.point.sides[1].last.event);
        table.push(vec![
            format!("mu, {}", axis.as_str()),
            significant(value, 4),
            optional(friction(true), |mu| significant(mu, 6)),
            optional(friction(false), |mu| significant(mu, 6)),
            beyond.map_or_else(String::new, |event| event.to_string()),
            tally(&members),
        ]);
    }
    table
}

fn line_table(survey: &Survey) -> Table {
    let mut table = Table::new(&["map", "boundary", "below", "above", "from mu>", "DEM>"]);
    let key = |confirmation: &Confirmation| {
        let point = &confirmation.point;
        let Across::Axis(axis) = point.across else {
            return None;
        };
        let last = point.sides.map(|side| (side.first.event, side.first.stage));
        let line = format!(
            "{} = {}",
            axis.as_str(),
            significant(axis.get(&point.stack), 6)
        );
        Some((axis, line, last))
    };
    for ((axis, line, _), members) in groups(survey, key) {
        let [below, above] = members[0].point.sides.map(|side| {
            Regime {
                last: side.first.event,
                last_stage: side.first.stage,
                ..side.regime()
            }
            .to_string()
        });
        table.push(vec![
            format!("mu, {}", axis.as_str()),
            line,
            below,
            above,
            significant(members[0].point.stack.floor_friction, 3),
            tally(&members),
        ]);
    }
    table
}

/// How many of the neighbours are what they should be.
fn tally(members: &[&Confirmation]) -> String {
    let sides = members.iter().flat_map(|member| &member.sides);
    let agree = sides.filter(|side| side.verdict == Verdict::Agrees).count();
    format!("{agree} of {}", 2 * members.len())
}

fn force_table(survey: &Survey) -> Table {
    let mut table = Table::new(&[
        "mu>",
        "mu_d>",
        "stiffness>",
        "kappa>",
        "first event",
        "theory>",
        "DEM>",
        "±>",
        "error>",
        "verdict",
    ]);
    for examination in &survey.examinations {
        let row = ForceRow::new(examination);
        let force = |force: f64| significant(force, 7);
        let without = || match examination.claimed.failure_mode {
            FailureMode::Collapses => "falls".to_owned(),
            _ => "grows".to_owned(),
        };
        table.push(vec![
            significant(row.mu, 4),
            row.mu_d.to_string(),
            row.stiffness.to_string(),
            row.kappa.to_string(),
            examination.claimed.regime().to_string(),
            row.largest_force.map_or_else(without, force),
            row.observed_force.map_or_else(without, force),
            optional(row.uncertainty, |uncertainty| format!("{uncertainty:.0e}")),
            optional(row.error, relative),
            row.verdict.to_string(),
        ]);
    }
    table
}
