//! Trajectories compared, in every format.

use super::number::optional;
use super::table::Table;
use crate::study::trajectory::{
    Comparison, FORCE_TOLERANCE, ORDER_TOLERANCE, TIME_STEPS, TrajectoryJudgement, TrajectoryRow,
    WALL_SPEED, trajectory_stack,
};

/// The rows with every digit.
pub fn trajectories_csv(judgements: &[TrajectoryJudgement]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows(judgements) {
        writer
            .serialize(row)
            .expect("plain rows are written to memory");
    }
    writer.into_inner().expect("memory is flushed")
}

/// The rows as a list of objects.
pub fn trajectories_json(judgements: &[TrajectoryJudgement]) -> String {
    serde_json::to_string_pretty(&rows(judgements)).expect("plain rows have a JSON form") + "\n"
}

fn rows(judgements: &[TrajectoryJudgement]) -> Vec<TrajectoryRow> {
    judgements
        .iter()
        .flat_map(TrajectoryJudgement::rows)
        .collect()
}

/// The codes and the comparisons for a terminal.
pub fn trajectories_table(judgements: &[TrajectoryJudgement]) -> String {
    codes(judgements).terminal() + &comparisons(judgements).terminal()
}

/// A page with the comparisons, what they mean, why they fall as they do, and what they do not prove.
pub fn trajectories_markdown(judgements: &[TrajectoryJudgement], command: &str) -> String {
    let version = env!("CARGO_PKG_VERSION");
    let mut page = format!(
        "# Trajectories beside native twins\n\nMade by tristack {version} with `{command}`.\n\n"
    );
    page += &meaning();
    page += &codes(judgements).markdown();
    page += "\n";
    page += &comparisons(judgements).markdown();
    page += &reasons(judgements);
    page += NO_PROOF;
    page += &remarks(judgements);
    page
}

fn meaning() -> String {
    let stack = trajectory_stack();
    let [coarse, middle, fine] = TIME_STEPS;
    format!(
        "One stack (mu = {}, stiffness = {}, kappa = {}), prepared by a gravity ramp and compressed at the \
         finite wall speed {WALL_SPEED:e}, by each code and by a twin: the native DEM with the contact \
         convention of that code (torque arms, Coulomb operand, spring of a sliding contact, transport of the \
         spring, inertia). Compared are whole series, row by row: the wall force f in units of its peak, x2 \
         and y1 in r, theta2 in radians.\n\n\
         *Branches.* `compression` is from the first step to the peak of f, `collapse` from there until the \
         wall has lost cylinder 1, `fall` until cylinder 1 has landed on the floor. Row 0, in which the wall \
         just touches, is left out, and so is everything after the landing: the codes differ there in what a \
         touching contact and what the floor below cylinder 1 is.\n\n\
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
        stack.floor_friction, stack.stiffness, stack.stiffness_ratio
    )
}

const NO_PROOF: &str = "\n## What this does not prove\n\n\
    That twin and code are right: they may share an error, which only the exact limit (`tristack crosscheck`) \
    would show. That a code follows its twin for another stack, another wall speed or other contact laws. \
    What happens after the landing of cylinder 1.\n";

/// Every documented order that occurs, with its reason, once.
fn reasons(judgements: &[TrajectoryJudgement]) -> String {
    let mut text = "\n## Why the distances fall as they do\n\n".to_owned();
    let mut seen = Vec::new();
    for comparison in judgements
        .iter()
        .flat_map(|judgement| judgement.comparisons())
    {
        let documented = &comparison.documented;
        if !seen.contains(&documented) {
            text += &format!(
                "- `{}`: {}.\n",
                documented.order.as_str(),
                documented.reason
            );
            seen.push(documented);
        }
    }
    if seen.is_empty() { String::new() } else { text }
}

fn remarks(judgements: &[TrajectoryJudgement]) -> String {
    let mut lines = String::new();
    for judgement in judgements {
        let notes = judgement.notes().join("\n").replace('\n', "\n  ");
        if !notes.is_empty() {
            lines += &format!(
                "- **{}: {}**\n\n  {notes}\n",
                judgement.code,
                judgement.verdict()
            );
        }
        for comparison in judgement.comparisons() {
            for note in comparison.grounds.notes() {
                let (subject, verdict) = (subject(judgement, comparison), comparison.verdict());
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

fn codes(judgements: &[TrajectoryJudgement]) -> Table {
    let mut table = Table::new(&[
        "code",
        "version",
        "source",
        "peak at>",
        "wall lost at>",
        "landed at>",
        "verdict",
    ]);
    for judgement in judgements {
        let time = |index: usize| {
            let time = judgement.times().map(|times| times[index]);
            optional(time, |time| format!("{time:.0}"))
        };
        let version = if judgement.version.is_empty() {
            "-"
        } else {
            &judgement.version
        };
        table.push(vec![
            judgement.code.to_string(),
            version.to_owned(),
            judgement.source.as_str().to_owned(),
            time(0),
            time(1),
            time(2),
            tally(judgement),
        ]);
    }
    table
}

/// The verdict that stands in place of comparisons, or how many of them agree.
fn tally(judgement: &TrajectoryJudgement) -> String {
    if judgement.comparisons().is_empty() {
        return judgement.verdict().to_string();
    }
    let agreeing = judgement.comparisons().iter();
    let agreeing = agreeing.filter(|comparison| comparison.verdict().as_str() == "agrees");
    format!(
        "{} of {} agree",
        agreeing.count(),
        judgement.comparisons().len()
    )
}

fn comparisons(judgements: &[TrajectoryJudgement]) -> Table {
    let mut table = Table::new(&[
        "code",
        "twin",
        "branch",
        "quantity",
        "largest at dt>",
        "at dt/2>",
        "at dt/4>",
        "order>",
        "documented",
        "round-off>",
        "step error>",
        "verdict",
    ]);
    for judgement in judgements {
        for comparison in judgement.comparisons() {
            table.push(cells(judgement, comparison));
        }
    }
    table
}

fn cells(judgement: &TrajectoryJudgement, comparison: &Comparison) -> Vec<String> {
    let distances = &comparison.distances;
    let small = |value: f64| {
        if value == 0.0 {
            "0".to_owned()
        } else {
            format!("{value:.1e}")
        }
    };
    let largest = |index: usize| optional(distances.get(index).map(|own| own.largest), small);
    let round_off = distances.last().map(|distance| distance.round_off);
    vec![
        judgement.code.to_string(),
        comparison.twin.as_str().to_owned(),
        comparison.branch.as_str().to_owned(),
        comparison.quantity.as_str().to_owned(),
        largest(0),
        largest(1),
        largest(2),
        optional(comparison.last_order(), |order| format!("{order:.2}")),
        comparison.documented.order.as_str().to_owned(),
        optional(round_off, small),
        small(comparison.step_error),
        comparison.verdict().to_string(),
    ]
}
