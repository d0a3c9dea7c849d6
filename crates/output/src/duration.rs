//! Forecasts of how long runs will take.

use super::number::{optional, plain};
use super::table::{Columns, DataTable};
use crate::study::cost::{Basis, CodeDuration};

const SECONDS_PER_MINUTE: f64 = 60.0;
const SECONDS_PER_HOUR: f64 = 3600.0;

/// Returns the table of forecasts, one row per code.
pub fn code_durations(rows: &[CodeDuration]) -> DataTable<'_> {
    Columns::<&CodeDuration>::new(
        "time",
        "A row is what a crosscheck needs of one code.",
        "`tristack time`",
    )
    .code(|row| &row.runs.code)
    .text("installed", |row| row.is_installed)
    .means("whether it is installed here; if it is not, recorded runs stand in for it, which takes no time")
    .number("runs", "1", |row| row.runs.tasks)
    .means("different runs that the rows of the crosscheck need")
    .shown("runs")
    .number("there", "1", |row| row.runs.there)
    .means("those that are in the store; of a code that is not installed, those that are recorded")
    .shown("there")
    .cell(|row| match row.is_installed {
        true => row.runs.there.to_string(),
        false => format!("{} recorded", row.runs.there),
    })
    .number("to_make", "1", |row| row.runs.open)
    .means("those that are to be made")
    .shown("to make")
    .number("steps", "1", |row| row.runs.steps)
    .means("time steps of the runs that are to be made")
    .shown_as("steps", |steps| format!("{steps:.2e}"))
    .number("ns_per_step", "ns", |row| Some(1e9 * row.cost?.step))
    .means("wall time of a step of one run on one core; missing where nothing is to be made")
    .shown("ns per step")
    .cell(|row| optional(row.cost, |cost| plain(1e9 * cost.step)))
    .number("start_seconds", "s", |row| Some(row.cost?.start))
    .means("wall time of start and end of a call of the code")
    .text("basis", |row| row.cost.map(|cost| cost.basis.as_str()))
    .means("`measured` on this machine, now, or `manifest`: the forecast of the code's manifest, where a measurement failed")
    .number("probe_seconds", "s", |row| row.probe)
    .means("micro-tests that come first, as long as they took where they were recorded; missing where they are in the store or not recorded")
    .number("core_seconds", "s", |row| row.core_seconds)
    .means("time of one core for all of it")
    .shown_as("time on one core", time_span)
    .rows(rows)
}

/// The forecast for the runs of all codes together.
pub struct AllDurations {
    /// Number of runs at the same time.
    pub jobs: usize,
    /// Number of runs to be made.
    pub runs: usize,
    /// Time steps of these runs.
    pub steps: u64,
    /// Time on one core, in seconds.
    pub core_seconds: f64,
    /// Time until the last run ends, with all jobs, in seconds.
    pub seconds: f64,
}

/// Returns the table of totals over all codes.
pub fn all_durations(all: &[AllDurations]) -> DataTable<'_> {
    Columns::<&AllDurations>::new(
        "time-total",
        "The row is what a crosscheck needs altogether.",
        "`tristack time`",
    )
    .number("jobs", "1", |all| all.jobs)
    .means("runs at the same time")
    .number("to_make", "1", |all| all.runs)
    .means("runs that are to be made")
    .number("steps", "1", |all| all.steps)
    .means("their time steps")
    .number("core_seconds", "s", |all| all.core_seconds)
    .means("time of one core")
    .number("seconds", "s", |all| all.seconds)
    .means("time until the last run ends")
    .rows(all)
}

/// Formats the table for a terminal, names the codes whose forecast is that of the manifest, and gives the totals.
pub fn durations_text(rows: &[CodeDuration], all: &AllDurations) -> String {
    let sentence = to_make(rows, all);
    let by_manifest = rows.iter().filter(|row| {
        let cost = row.cost.as_ref();
        cost.is_some_and(|cost| cost.basis == Basis::Manifest)
    });
    let by_manifest: Vec<&str> = by_manifest.map(|row| row.runs.code.as_str()).collect();
    let forecast = match by_manifest.is_empty() {
        true => String::new(),
        false => format!(
            "not measured here, but taken from the manifest: {}\n",
            by_manifest.join(", ")
        ),
    };
    code_durations(rows).shown().terminal() + &forecast + &sentence
}

/// Says how many runs are to be made, how many are there, and how many are neither.
fn to_make(rows: &[CodeDuration], all: &AllDurations) -> String {
    let total: usize = rows.iter().map(|row| row.runs.tasks).sum();
    let there: usize = rows.iter().map(|row| row.runs.there).sum();
    let missing = total.saturating_sub(there + all.runs);
    let sentence = match all.runs {
        0 if missing == 0 => format!("nothing to make: all {total} runs are there\n"),
        0 => format!("nothing to make: {there} of {total} runs are there\n"),
        runs => format!(
            "{runs} of {total} runs to make: {} with {} at a time\n",
            time_span(all.seconds),
            all.jobs
        ),
    };
    match missing {
        0 => sentence,
        _ => format!(
            "{sentence}{missing} of {total} runs are neither there nor can be made: their codes are not installed\n"
        ),
    }
}

/// Formats a span of time for people.
fn time_span(seconds: f64) -> String {
    match seconds {
        _ if seconds == 0.0 => "0 s".to_owned(),
        _ if seconds < 1.0 => "less than 1 s".to_owned(),
        _ if seconds < 2.0 * SECONDS_PER_MINUTE => format!("about {seconds:.0} s"),
        _ if seconds < 2.0 * SECONDS_PER_HOUR => {
            format!("about {:.0} min", seconds / SECONDS_PER_MINUTE)
        }
        _ => format!("about {:.1} h", seconds / SECONDS_PER_HOUR),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_have_the_unit_that_people_would_take() {
        let spans = [0.0, 0.2, 12.3, 119.0, 120.0, 3600.0, 90_000.0].map(time_span);
        let expected = [
            "0 s",
            "less than 1 s",
            "about 12 s",
            "about 119 s",
            "about 2 min",
            "about 60 min",
            "about 25.0 h",
        ];
        assert_eq!(spans, expected);
    }
}
