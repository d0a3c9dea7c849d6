//! The regime map, and its comparison with the DEM.

use super::number::{digits, one_digit, optional, relative, significant};
use super::table::{Columns, DataTable, Table};
use super::text::markdown_code;
use crate::model::Stack;
use crate::study::Verdict;
use crate::study::regimes::{Confirmation, Examination, Survey, THREE_DIGITS};
use crate::study::yield_force::Evidence;
use crate::theory::{Across, Axis, FailureMode, LoadingOutcome, LoadingPhase, Regime, RegimeMap};

/// Returns the table of the maps as grids of `columns` values on the axis by `rows` floor frictions.
pub fn regimes(maps: &[RegimeMap], columns: usize, rows: usize) -> DataTable<'_> {
    Columns::<(Axis, Stack, LoadingOutcome)>::new(
        "regimes",
        "A row is one stack of a regime map and what happens first on its way up in load.",
        "`tristack regimes` (regimes.csv)",
    )
    .text("map", |(axis, ..)| axis.as_str())
    .means("what varies besides μ")
    .stack(|(_, stack, _)| *stack)
    .word("event", |(.., outcome)| outcome.first.event)
    .means("the first event")
    .word("stage", |(.., outcome)| outcome.first.stage)
    .means("when it comes: `own-weight` or `wall`")
    .number("force", "m g", |(.., outcome)| outcome.first.force)
    .means("wall force F then; 0 under own weight")
    .number("T", "1", |(.., outcome)| outcome.first.tangent)
    .means("T = tan(ψ/2) then")
    .number("largest_force", "m g", |(.., outcome)| {
        outcome.largest_force
    })
    .means("largest F that the stack carries")
    .word("failure_mode", |(.., outcome)| outcome.failure_mode)
    .means("what the first event does")
    .word("then", |(.., outcome)| outcome.last.event)
    .means(
        "the first slip or wall contact; another event than the first where contact 2–3 \
             closes before it",
    )
    .rows(maps.iter().flat_map(|map| grid(map, columns, rows)))
}

fn grid(map: &RegimeMap, columns: usize, rows: usize) -> Vec<(Axis, Stack, LoadingOutcome)> {
    let mut grid = Vec::new();
    for value in map.axis_values(columns) {
        let path = map.path(value);
        let stacks = map.friction_values(rows).into_iter();
        let stacks = stacks.map(|friction| map.stack(value, friction));
        grid.extend(stacks.filter_map(|stack| {
            let outcome = LoadingOutcome::on(&path, &stack)?;
            Some((map.axis, stack, outcome))
        }));
    }
    grid
}

/// Returns the table of boundary points.
pub fn boundaries(confirmations: &[Confirmation]) -> DataTable<'_> {
    let claimed = |own: &Confirmation, side: usize| own.point.sides[side].regime().to_string();
    let observed = |own: &Confirmation, side: usize| {
        let regime = own.sides[side].observed;
        regime.map(|regime| regime.to_string())
    };
    Columns::<&Confirmation>::new(
        "boundaries",
        "A row is one point of a boundary of a regime map, and what the native DEM shows on both \
         sides of it.",
        "`tristack regimes` (boundaries.csv)",
    )
    .text("map", |own| own.point.map.as_str())
    .means("what varies besides μ")
    .text("across", |own| match own.point.across {
        Across::Friction => "mu",
        Across::Axis(axis) => axis.as_str(),
    })
    .means("what changes across the boundary")
    .stack(|own| own.point.stack)
    .number("distance", "1", |own| own.point.distance)
    .means("relative distance of the neighbours below and above")
    .text("below", move |own| claimed(own, 0))
    .means("regime of the neighbour below, by theory")
    .text("above", move |own| claimed(own, 1))
    .means("the same of the one above")
    .text("below_observed", move |own| observed(own, 0))
    .means("what the DEM shows below; absent if nothing happened")
    .text("above_observed", move |own| observed(own, 1))
    .means("the same above")
    .text("below_verdict", |own| own.sides[0].verdict.as_str())
    .means("verdict on the neighbour below")
    .text("above_verdict", |own| own.sides[1].verdict.as_str())
    .means("the same above")
    .verdict(|own| own.verdict())
    .rows(confirmations)
}

/// Returns the table of largest forces.
pub fn largest_forces(examinations: &[Examination]) -> DataTable<'_> {
    let or_why = |own: &Examination, force: Option<f64>| {
        let without = || match own.claimed.failure_mode {
            FailureMode::Collapses => "falls".to_owned(),
            _ => "grows".to_owned(),
        };
        force.map_or_else(without, digits::<7>)
    };
    let observed = |own: &Examination| own.peak.map(|peak| peak.force);
    Columns::<&Examination>::new(
        "largest_forces",
        "A row is the largest force that one stack carries, by theory and in the native DEM.",
        "`tristack regimes` (largest_forces.csv)",
    )
    .stack(|own| own.stack)
    .again("mu")
    .digits(digits::<4>)
    .again("mu_d")
    .shown("mu_d")
    .dispensable(1)
    .again("kappa")
    .shown("kappa")
    .dispensable(2)
    .word("event", |own| own.claimed.first.event)
    .means("the first event")
    .shown("first event")
    .cell(|own| own.claimed.regime().to_string())
    .word("failure_mode", |own| own.claimed.failure_mode)
    .means("what it does")
    .number("largest_force", "m g", |own| own.claimed.largest_force)
    .means("largest F by theory; absent if it falls, or grows without a peak")
    .shown("theory")
    .cell(move |own| or_why(own, own.claimed.largest_force))
    .number("observed_force", "m g", move |own| observed(own))
    .means("peak of F in the DEM at vanishing wall speed")
    .shown("DEM")
    .cell(move |own| or_why(own, observed(own)))
    .number("uncertainty", "m g", |own| own.uncertainty)
    .means("uncertainty of the peak")
    .shown_as("±", one_digit)
    .dispensable(3)
    .number("error", "1", |own| own.error)
    .means("(observed_force − largest_force)/(largest_force + 3)")
    .shown_as("error", relative)
    .verdict(|own| own.verdict)
    .rows(examinations)
}

/// Formats boundaries and largest forces for a terminal.
pub fn survey_text(survey: &Survey) -> String {
    let [friction, lines, forces] = tables(survey).map(|table| table.terminal());
    format!(
        "Boundaries in mu, and the number of neighbours at a relative distance of {THREE_DIGITS:e} for which \
         the DEM agrees\n{friction}\n\
         Boundaries that do not depend on mu, tested from mu on\n{lines}\n\
         Largest force F of a stack: theory, and peak of the DEM at vanishing wall speed\n{forces}"
    )
}

/// The beginning of the page, by which the program recognises a page of its own.
pub const REGIMES_TITLE: &str = "# Which event comes first\n\nMade by tristack";

/// Formats a page with boundaries, largest forces, the effect of each event, and the figure.
pub fn regimes_markdown(survey: &Survey, command: &str) -> String {
    let command = markdown_code(command);
    let [friction, lines, forces] = tables(survey).map(|table| table.markdown());
    format!(
        "{REGIMES_TITLE} {} with {command}.\n\n\
         ![The three maps](regimes.svg)\n\n\
         Colours say how a stack ends, full lines where another event comes first, dashed lines where the \
         end changes while the events come in the same order. A marker is a point with native DEM runs on \
         both sides; it is a dot if both agree with theory, and a cross if not.\n\n\
         ## What each event does\n\n{}\n\
         ## Boundaries in mu\n\nNative DEM runs on both sides, at a relative distance of {THREE_DIGITS:e}, show \
         which event comes first.\n\n{friction}\n\
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
    Columns::<(&str, FailureMode)>::for_people()
        .left("event", |(event, _)| event.to_string())
        .left("what it does", |(_, mode)| mode.to_string())
        .rows(events)
        .shown()
        .markdown()
}

fn tables(survey: &Survey) -> [Table; 3] {
    [
        friction_table(survey),
        line_table(survey),
        largest_forces(&survey.examinations).shown(),
    ]
}

/// Adjacent boundary points that share a row of a table.
type Group<'a> = &'a [&'a Confirmation];

/// Returns the points whose boundary is crossed in the way that is `wanted`.
fn crossed(survey: &Survey, wanted: impl Fn(Across) -> bool) -> Vec<&Confirmation> {
    let all = survey.confirmations.iter();
    all.filter(|own| wanted(own.point.across)).collect()
}

/// Returns name and value of the parameter that varies besides the floor friction.
fn place(own: &Confirmation) -> (&'static str, f64) {
    let map = own.point.map;
    (map.as_str(), map.get(&own.point.stack))
}

fn friction_table(survey: &Survey) -> Table {
    let friction = |group: &Group, own_weight: bool| {
        let mut points = group.iter().map(|member| &member.point);
        let point = points
            .find(|point| (point.sides[0].last.stage == LoadingPhase::OwnWeight) == own_weight);
        optional(point, |point| significant(point.stack.floor_friction, 6))
    };
    let points = crossed(survey, |across| across == Across::Friction);
    Columns::<Group>::for_people()
        .left("map", |group| format!("mu, {}", place(group[0]).0))
        .right("at", |group| significant(place(group[0]).1, 4))
        .right("own weight up to mu", move |group| friction(group, true))
        .right("floor slip up to mu", move |group| friction(group, false))
        .left("beyond it", |group| {
            let last = group[group.len() - 1];
            last.point.sides[1].last.event.to_string()
        })
        .right("DEM", tally)
        .rows(points.chunk_by(|one, other| place(one) == place(other)))
        .shown()
}

fn line_table(survey: &Survey) -> Table {
    let line = |own: &Confirmation| {
        let (name, value) = place(own);
        format!("{name} = {}", significant(value, 6))
    };
    let events = |own: &Confirmation| {
        let firsts = own.point.sides.map(|side| side.first);
        firsts.map(|first| (first.event, first.stage))
    };
    let first = |group: &Group, side: usize| {
        let side = group[0].point.sides[side];
        let regime = Regime {
            last: side.first.event,
            last_stage: side.first.stage,
            ..side.regime()
        };
        regime.to_string()
    };
    let points = crossed(survey, |across| across != Across::Friction);
    let key = |own: &Confirmation| (line(own), events(own));
    Columns::<Group>::for_people()
        .left("map", |group| format!("mu, {}", place(group[0]).0))
        .left("boundary", move |group| line(group[0]))
        .left("below", move |group| first(group, 0))
        .left("above", move |group| first(group, 1))
        .right("from mu", |group| {
            significant(group[0].point.stack.floor_friction, 3)
        })
        .right("DEM", tally)
        .rows(points.chunk_by(|one, other| key(one) == key(other)))
        .shown()
}

/// Counts the neighbours for which the DEM agrees with theory.
fn tally(group: &Group) -> String {
    let sides = group.iter().flat_map(|member| &member.sides);
    let agree = sides.filter(|side| side.verdict == Verdict::Agrees).count();
    format!("{agree} of {}", 2 * group.len())
}
