//! Trajectories of codes compared with those of native twins.

use super::number::{optional, small};
use super::table::{Columns, DataTable};
use super::text::{markdown_code, markdown_notes};
use crate::model::{PAPER_BODIES, Power, Stack};
use crate::study::Verdict;
use crate::study::trajectory::{
    Comparison, Distance, FORCE_TOLERANCE, ORDER_TOLERANCE, TrajectoryJudgement, WALL_SPEED,
    time_steps, trajectory_stack,
};

/// One distance of one comparison, by its index. A code without comparisons has one row without a distance.
type Row<'a> = (&'a TrajectoryJudgement, Option<(&'a Comparison, usize)>);

fn rows_of(judgement: &TrajectoryJudgement) -> Vec<Row<'_>> {
    let comparisons = judgement.comparisons().iter();
    let rows = comparisons.flat_map(|own| (0..own.distances.len()).map(move |index| (own, index)));
    let rows: Vec<Row> = rows.map(|row| (judgement, Some(row))).collect();
    match judgement.comparisons().is_empty() {
        true => vec![(judgement, None)],
        false => rows,
    }
}

/// Returns the table of trajectories, one row per distance.
pub fn trajectories(judgements: &[TrajectoryJudgement]) -> DataTable<'_> {
    fn compared<'a>((_, row): &Row<'a>) -> Option<&'a Comparison> {
        row.map(|(comparison, _)| comparison)
    }
    fn own<'a>((_, row): &Row<'a>) -> Option<&'a Distance> {
        row.map(|(comparison, index)| &comparison.distances[index])
    }
    Columns::<Row>::new(
        "trajectories",
        "A row is the distance between the series of a code and of its native twin, in one \
         quantity on one branch at one time step; forces in units of their peak, lengths in r, \
         angles in radians. A code without comparisons has one row without distances.",
        "`tristack trajectories` (trajectories.csv, trajectories.json)",
    )
    .code(|(judgement, _)| &judgement.code)
    .version(|(judgement, _)| &judgement.version)
    .source(|(judgement, _)| judgement.source)
    .stack(|(judgement, _)| judgement.study.stack)
    .convention(|(judgement, _)| {
        let code = &judgement.study.code;
        Some(code.settled().known(&code.convention()))
    })
    .text("twin", |row| Some(compared(row)?.twin.as_str()))
    .means("what the twin has of the convention of the code")
    .text("quantity", |row| Some(compared(row)?.quantity.as_str()))
    .means("what is compared")
    .text("branch", |row| Some(compared(row)?.branch.as_str()))
    .means("`compression`, `collapse` or `fall`")
    .number("time_step", "√(m/k_n)", |row| Some(own(row)?.time_step))
    .means("time step of both")
    .number("largest", "1", |row| Some(own(row)?.largest))
    .means("largest distance")
    .number("rms", "1", |row| Some(own(row)?.rms))
    .means("root mean square of the distance")
    .number("first_above_1e-6", "√(m/k_n)", |row| {
        own(row)?.first_above[0]
    })
    .means("first time at which it exceeds 1e-6, if it does")
    .number("first_above_1e-4", "√(m/k_n)", |row| {
        own(row)?.first_above[1]
    })
    .means("the same for 1e-4")
    .number("first_above_1e-2", "√(m/k_n)", |row| {
        own(row)?.first_above[2]
    })
    .means("the same for 1e-2")
    .number("order", "1", |(_, row)| {
        let (comparison, index) = (*row)?;
        let distances = &comparison.distances;
        comparison.order(&distances[index.checked_sub(1)?], &distances[index])
    })
    .means(
        "log₂ of the largest distance at twice the time step over this one; absent where \
         nothing but rounding is expected",
    )
    .text("documented_order", |row| {
        Some(compared(row)?.documented.order.as_str())
    })
    .means("how the distance must fall with the time step")
    .number("round_off", "1", |row| Some(own(row)?.round_off))
    .means("what rounding may have done to the largest distance")
    .number("step_error", "1", |row| Some(compared(row)?.step_error))
    .means("largest change of the twin itself when its time step is halved")
    .verdict(|row| compared(row).map_or_else(|| row.0.verdict(), Comparison::verdict))
    .rows(judgements.iter().flat_map(rows_of))
}

/// Formats the codes and the comparisons for a terminal.
pub fn trajectories_text(judgements: &[TrajectoryJudgement]) -> String {
    let rows = comparisons(judgements);
    codes(judgements).shown().terminal() + &rows.shown().terminal() + &rows.units()
}

/// Formats a page with the comparisons, their meaning, the reasons for their orders, and their limits.
pub fn trajectories_markdown(judgements: &[TrajectoryJudgement], command: &str) -> String {
    let version = env!("CARGO_PKG_VERSION");
    let command = markdown_code(command);
    let mut page = format!(
        "# Trajectories beside native twins\n\nMade by tristack {version} with {command}.\n\n"
    );
    page += &meaning(judgements);
    page += &codes(judgements).shown().markdown();
    page += "\n";
    page += &comparisons(judgements).shown().markdown();
    page += &reasons(judgements);
    page += NO_PROOF;
    page += &remarks(judgements);
    page
}

fn meaning(judgements: &[TrajectoryJudgement]) -> String {
    let stack = judgements.first().map(|judgement| judgement.study.stack);
    let stack = stack.unwrap_or_else(|| trajectory_stack(PAPER_BODIES, Power::Linear));
    let kappas = kappas(judgements, &stack);
    let [coarse, middle, fine] = time_steps(&stack);
    let (quantities, branches) = match stack.bodies {
        PAPER_BODIES => (OF_CYLINDERS, BRANCHES_OF_CYLINDERS),
        _ => (OF_SPHERES, BRANCHES_OF_SPHERES),
    };
    format!(
        "One stack ({} bodies on the floor, mu = {}, stiffness = {}, kappa = {kappas}), prepared by a gravity ramp and compressed at \
         the finite wall speed {WALL_SPEED:e}, by each code and by a twin: the native DEM with the contact \
         convention of that code (torque arms, Coulomb operand, spring of a sliding contact, transport of the \
         spring, inertia). Compared are whole series, row by row: the wall force f in units of its peak, {quantities}.\n\n\
         *Branches.* {branches} Row 0, in which the wall just touches, is left out.\n\n\
         *Largest distances* are given at the time steps {coarse}, {middle} and {fine}; the CSV file also has \
         the root mean squares and the times at which a distance first exceeds 1e-6, 1e-4 and 1e-2. *Order* is \
         log2 of the last two distances' ratio: 1 if halving the time step halves the distance, 2 if it \
         quarters it.\n\n\
         *Verdict.* `round-off`: the distance is below what rounding can do (half a unit in the last place in \
         every step, grown as much as a small disturbance of the wall grows in the twin). `first`, `second`: \
         the order is that one within {ORDER_TOLERANCE}, from the pair of time steps that shows it best, or \
         the distances are so close to rounding (some ten times it) that no order could be seen; and the \
         finest distance is below the step error. `irregular`: the distance is below the step error, the largest \
         change of the twin itself when its own time step is halved. In the collapse the full twin is closer than the one \
         with rotated springs. And up to the peak f is within \
         {FORCE_TOLERANCE:e} of its peak at the finest time step.\n\n",
        stack.bodies, stack.floor_friction, stack.stiffness
    )
}

/// Lists every stiffness ratio that occurs, in the order of the codes; each law has its usual one.
fn kappas(judgements: &[TrajectoryJudgement], stack: &Stack) -> String {
    let mut kappas = vec![stack.stiffness_ratio];
    for judgement in judgements {
        let kappa = judgement.study.stack.stiffness_ratio;
        if !kappas.contains(&kappa) {
            kappas.push(kappa);
        }
    }
    let written: Vec<String> = kappas.iter().map(f64::to_string).collect();
    match written.len() {
        1 => written.concat(),
        _ => format!("{} by the law of the code", written.join(" or ")),
    }
}

const OF_CYLINDERS: &str = "x2 and y1 in r, theta2 in radians";
const BRANCHES_OF_CYLINDERS: &str = "`compression` is from the first step to the peak of f, `collapse` from there until the \
    wall has lost cylinder 1, `fall` until cylinder 1 has landed on the floor. What comes after the landing is left out: the \
    codes differ there in what a touching contact and what the floor below cylinder 1 is.";

const OF_SPHERES: &str = "all centres in r, all rotations in radians, and all components of the forces of the floor in units \
    of the peak of f; a distance is that of the worst component of the worst sphere. One sphere is displaced along the ring, \
    so that no symmetry is left that could hide a difference";
const BRANCHES_OF_SPHERES: &str = "`compression` is from the first step to the peak of f. What comes after the peak is left \
    out: a ring of spheres collapses in directions that the last digits decide.";

const NO_PROOF: &str = "\n## What this does not prove\n\n\
    That twin and code are right: they may share an error, which only the exact limit (`tristack crosscheck`) \
    would show. That a code follows its twin for another stack, another wall speed or other contact laws. \
    What happens after the landing of cylinder 1.\n";

/// Lists every documented order that occurs, once, with its reason.
fn reasons(judgements: &[TrajectoryJudgement]) -> String {
    let mut text = "\n## Why the distances fall as they do\n\n".to_owned();
    let mut seen = Vec::new();
    let comparisons = judgements.iter().flat_map(|own| own.comparisons());
    for documented in comparisons.map(|comparison| &comparison.documented) {
        if !seen.contains(&documented) {
            let (order, reason) = (documented.order.as_str(), &documented.reason);
            text += &format!("- `{order}`: {reason}.\n");
            seen.push(documented);
        }
    }
    if seen.is_empty() { String::new() } else { text }
}

fn remarks(judgements: &[TrajectoryJudgement]) -> String {
    let mut lines = String::new();
    for judgement in judgements {
        let notes = markdown_notes(&judgement.notes().join("\n"));
        if !notes.is_empty() {
            let (code, verdict) = (judgement.code.clone(), judgement.grounds.in_words());
            lines += &format!("- **{code}: {verdict}**\n\n  {notes}\n");
        }
        for comparison in judgement.comparisons() {
            for note in comparison.grounds.notes() {
                let (subject, verdict) = (subject(judgement, comparison), comparison.verdict());
                let note = markdown_notes(note);
                lines += &format!("- **{subject}: {verdict}**: {note}\n");
            }
        }
    }
    if lines.is_empty() {
        return lines;
    }
    format!("\n## Remarks\n\n{lines}")
}

fn subject(judgement: &TrajectoryJudgement, comparison: &Comparison) -> String {
    format!(
        "{}, {} twin, {}, {}",
        judgement.code,
        comparison.twin.as_str(),
        comparison.branch.as_str(),
        comparison.quantity.as_str()
    )
}

fn codes(judgements: &[TrajectoryJudgement]) -> DataTable<'_> {
    let time = |own: &TrajectoryJudgement, index: usize| {
        let times = own.times().and_then(|times| {
            let [lost, landed] = times.later.map_or([None; 2], |later| later.map(Some));
            [Some(times.peak), lost, landed][index]
        });
        optional(times, |time| format!("{time:.0}"))
    };
    Columns::<&TrajectoryJudgement>::for_people()
        .code(|own| &own.code)
        .version(|own| &own.version)
        .shown("version")
        .source(|own| own.source)
        .shown("source")
        .right("peak at", move |own| time(own, 0))
        .dispensable(3)
        .right("wall lost at", move |own| time(own, 1))
        .dispensable(2)
        .right("landed at", move |own| time(own, 2))
        .dispensable(1)
        .left("verdict", |own| tally(own))
        .with_verdicts()
        .rows(judgements)
}

/// Returns the number of comparisons that agree, or the verdict of a code without comparisons.
fn tally(judgement: &TrajectoryJudgement) -> String {
    if judgement.comparisons().is_empty() {
        return judgement.verdict().to_string();
    }
    let all = judgement.comparisons();
    let agreeing = all.iter().filter(|own| own.verdict() == Verdict::Agrees);
    format!("{} of {} agree", agreeing.count(), all.len())
}

/// Returns a table for people, one row per comparison with its distances side by side.
fn comparisons(judgements: &[TrajectoryJudgement]) -> DataTable<'_> {
    type Row<'a> = (&'a TrajectoryJudgement, &'a Comparison);
    let largest = |own: &Comparison, index: usize| {
        optional(own.distances.get(index), |own| small(own.largest))
    };
    let rows = judgements.iter().flat_map(|judgement| {
        let comparisons = judgement.comparisons().iter();
        comparisons.map(move |comparison| (judgement, comparison))
    });
    Columns::<Row>::for_people()
        .left("code", |(judgement, _)| judgement.code.to_string())
        .left("twin", |(_, own)| own.twin.as_str().to_owned())
        .left("branch", |(_, own)| own.branch.as_str().to_owned())
        .left("quantity", |(_, own)| own.quantity.as_str().to_owned())
        .right("largest at dt", move |(_, own)| largest(own, 0))
        .dispensable(4)
        .right("at dt/2", move |(_, own)| largest(own, 1))
        .dispensable(5)
        .right("at dt/4", move |(_, own)| largest(own, 2))
        .dispensable(6)
        .right("order", |(_, own)| {
            optional(own.last_order(), |order| format!("{order:.2}"))
        })
        .dispensable(7)
        .left("documented", |(_, own)| {
            own.documented.order.as_str().to_owned()
        })
        .dispensable(3)
        .right("round-off", |(_, own)| {
            optional(own.distances.last(), |own| small(own.round_off))
        })
        .dispensable(1)
        .right("step error", |(_, own)| small(own.step_error))
        .dispensable(2)
        .left("verdict", |(_, own)| own.verdict().to_string())
        .with_verdicts()
        .rows(rows)
}
