//! The verdict on series of one stack that were made without a plan.

use super::number::{digits, one_digit, optional, relative, significant, small};
use super::table::{Columns, DataTable};
use crate::study::yield_force::{Budget, BudgetPart, FoundSeries, JudgedSeries, Method, RunRoles};

/// Returns the tables of the verdict on the series (one row), of the runs behind it, and of its uncertainty.
pub fn judged_series(judged: Option<&JudgedSeries>) -> [DataTable<'_>; 3] {
    [verdict(judged), runs(judged), budget(judged)]
}

fn verdict(judged: Option<&JudgedSeries>) -> DataTable<'_> {
    Columns::<&JudgedSeries>::new(
        "judged_series",
        "A row is the yield force of one stack at vanishing wall speed, from the series of one run or a few, and the \
         verdict on it.",
        "`tristack judge --series` (judged_series.csv)",
    )
    .stack(|row| row.measurement.stack)
    .convention(|row| Some(row.measurement.convention.into()))
    .number("slip_onset", "m g", |row| Some(row.finding.slip?.force))
    .means("F at which the floor begins to slip, at vanishing wall speed: extrapolated, or less what theory expects of the speed")
    .shown_as("slip onset", digits::<9>)
    .number("peak_force", "m g", |row| Some(row.finding.peak?.force))
    .means("the largest F, at vanishing wall speed in the same way")
    .shown_as("peak", digits::<9>)
    .number("uncertainty", "m g", |row| Some(row.budget()?.total()))
    .means("numerical uncertainty of the force that is judged: the sum of the parts that are known")
    .shown_as("± known", one_digit)
    .text("not_known", |row| not_known(row))
    .means("the parts of the uncertainty that are not known, separated by commas")
    .shown("not known")
    .number("reference_onset", "m g", |row| {
        row.measurement.limit.slip_onset
    })
    .means("the exact limit of the slip onset under these arms")
    .number("reference_force", "m g", |row| {
        row.measurement.limit.yield_force
    })
    .means("the exact limit of the yield force, which is larger where contact 2–3 is closed at the onset")
    .shown_as("exact limit", digits::<9>)
    .number("error", "1", |row| Some(row.grounds.deviation()?.0))
    .means("(slip_onset − reference_onset)/(reference_onset + n + 1); of the peak where there is no onset")
    .shown_as("error", relative)
    .number("tolerance", "1", |row| Some(row.grounds.deviation()?.1))
    .means("largest error that agrees, if the whole uncertainty is known")
    .shown_as("tolerance", small)
    .cause(|row| row.grounds.cause())
    .verdict(|row| row.grounds.verdict())
    .rows(judged)
}

fn not_known(row: &JudgedSeries) -> String {
    let parts = row.budget().into_iter().flat_map(Budget::unknown);
    let names: Vec<&str> = parts.map(|part| part.name).collect();
    names.join(", ")
}

fn runs(judged: Option<&JudgedSeries>) -> DataTable<'_> {
    let found = judged.into_iter();
    let found = found.flat_map(|judged| judged.faster.iter().chain(&judged.used));
    Columns::<&FoundSeries>::new(
        "series_runs",
        "A row is one of the series behind a row of `judged_series`.",
        "`tristack judge --series` (series_runs.csv)",
    )
    .text("file", |run| run.name.as_str())
    .means("its file")
    .shown("file")
    .text("differs_in", |run| run.role)
    .means("in what it differs from the others")
    .shown("differs in")
    .number("wall_speed", "r √(k_n/m)", |run| {
        run.summary.case.protocol.wall_speed
    })
    .means("speed of the wall")
    .shown_as("wall speed", |speed| format!("{speed:.3e}"))
    .number("time_step", "√(m/k_n)", |run| {
        run.summary.case.protocol.time_step
    })
    .means("time step, as the times of the series say")
    .shown_as("time step", digits::<4>)
    .number("slip_onset", "m g", |run| {
        Some(run.summary.estimates.slip?.force)
    })
    .means("F at which the floor begins to slip in this run")
    .shown_as("slip onset", digits::<9>)
    .number("peak_force", "m g", |run| {
        Some(run.summary.estimates.peak?.force)
    })
    .means("the largest F in this run")
    .shown_as("peak", digits::<9>)
    .rows(found)
}

fn budget(judged: Option<&JudgedSeries>) -> DataTable<'_> {
    let parts = judged.and_then(JudgedSeries::budget).into_iter();
    let parts = parts.flat_map(|budget| Budget::PARTS.map(|part| (part, (part.value)(budget))));
    // Series without a plan take no shortcuts, and arms given on the command line are not measured.
    let concerns = |(part, value): &(BudgetPart, Option<f64>)| {
        part.name != "shortcuts" && (value.is_some() || !part.known_by.is_empty())
    };
    let parts = parts.filter(concerns);
    let load = judged.and_then(|judged| {
        let limit = &judged.measurement.limit;
        let reference = limit.slip_onset.or(limit.yield_force)?;
        Some(judged.measurement.stack.floor_load(reference))
    });
    let (method, roles) = judged.map_or((Method::Extrapolated, RunRoles::PLANNED), |judged| {
        (judged.measurement.method, judged.measurement.roles)
    });
    let known = move |(part, value): &(BudgetPart, Option<f64>)| match value {
        Some(_) => part.how(method, &roles),
        None => part.known_by,
    };
    Columns::<(BudgetPart, Option<f64>)>::new(
        "series_budget",
        "A row is one part of the uncertainty (ASME V&V 20) of a row of `judged_series`.",
        "`tristack judge --series` (series_budget.csv)",
    )
    .text("part", |(part, _)| part.name)
    .means("its name, as in `budget`")
    .number("value", "m g", |(_, value)| *value)
    .means("its value; absent where it is not known")
    .text("how", known)
    .means("how it is computed, or by what run it would be known")
    .left("part of the uncertainty", |(part, _)| {
        part.heading.to_owned()
    })
    .right("m g", |(_, value)| {
        value.map_or_else(|| "not known".to_owned(), |value| format!("{value:.1e}"))
    })
    .right("of F + n + 1", move |(_, value)| {
        let relative = value.zip(load).map(|(value, load)| value / load);
        optional(relative, |value| format!("{value:.1e}"))
    })
    .left("how it is known, or would be", move |row| {
        known(row).to_owned()
    })
    .rows(parts)
}

/// Formats the tables for a terminal, and states the distance from the exact limit in a sentence.
pub fn judged_series_text(judged: &JudgedSeries) -> String {
    let limit = &judged.measurement.limit;
    let tables = judged_series(Some(judged));
    let [verdict, runs, budget] = tables.map(|table| table.shown().terminal());
    let reference = limit.slip_onset.or(limit.yield_force);
    let distance = judged.grounds.deviation().zip(reference);
    let distance = optional(distance, |((error, _), reference)| {
        format!(
            "{} of F + n + 1 from the exact limit {} under arms {}, {}",
            relative(error),
            significant(reference, 9),
            judged.measurement.convention.arms.pair,
            judged.measurement.convention.arms.floor
        )
    });
    format!("{runs}{budget}{verdict}distance: {distance}\n")
}
