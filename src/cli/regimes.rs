//! `tristack regimes`.

use super::options::{Format, RunOptions, as_flag, history_update, number, whole};
use super::out::Out;
use super::progress::{Reporter, during};
use super::{CliError, ExitStatus, complain, tell};
use crate::code::Code;
use crate::files::Layout;
use crate::model::{HistoryUpdate, InvalidValue, PAPER_STIFFNESS_RATIO};
use crate::output::{
    REGIMES_TITLE, boundaries, largest_forces, regimes, regimes_markdown, regimes_svg, survey_text,
};
use crate::runs::SelectedCode;
use crate::study::regimes::{Survey, SurveyPlan, THREE_DIGITS, examined_stacks, survey};
use crate::study::{Campaign, Verdict};
use crate::theory::{BoundaryPoint, CLOSING_STIFFNESS_RATIO, RegimeMap};
use clap::Args;
use std::ops::RangeInclusive;
use std::path::PathBuf;

/// Numbers of values on the axis and of floor frictions in regimes.csv.
const GRID: (usize, usize) = (25, 40);
const POINTS: RangeInclusive<u16> = 2..=1000;

/// Map which event comes first under load, and what it does
///
/// Maps the events over floor friction and stiffness, cylinder friction, or stiffness ratio. Native DEM runs test
/// every boundary on both sides, at a relative distance of 5e-4, and the largest forces of stacks in every regime
/// are compared with theory. Finished runs are reused.
#[derive(Debug, Args)]
#[command(after_help = "Example: tristack regimes --out regimes")]
pub(super) struct Arguments {
    /// Stiffness ratio k_n/k_t in the maps over other parameters
    #[arg(long, value_name = "K", value_parser = number, default_value_t = PAPER_STIFFNESS_RATIO)]
    kappa: f64,
    /// Change of the tangential spring when a contact turns
    #[arg(long, value_parser = history_update(), value_name = "RULE", default_value = "fixed")]
    history_update: HistoryUpdate,
    /// Number of points tested on each boundary
    #[arg(long, value_name = "N", default_value_t = 13, value_parser = whole::<usize>(POINTS))]
    points: usize,
    /// Directory for regimes.csv, boundaries.csv, largest_forces.csv, regimes.md and regimes.svg
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Format of boundaries and largest forces; csv has the boundaries alone
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    #[command(flatten)]
    run: RunOptions,
}

/// Examines every boundary, prints and writes the result.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    let maps = checked_maps(arguments)?;
    let out = Out::claim(arguments.out.as_deref(), &layout())?;
    let settings = arguments.run.settings()?;
    let of_map = |map: &RegimeMap| map.boundary_points(arguments.points, THREE_DIGITS);
    let points: Vec<BoundaryPoint> = during("mapping the first events", || {
        maps.iter().flat_map(of_map).collect()
    });
    let plan = SurveyPlan::new(
        &points,
        &examined_stacks(arguments.history_update),
        arguments.history_update,
    );
    let native = [SelectedCode::find(Code::native())];
    let survey = survey(&plan, &Campaign::new(&native, &settings, &Reporter::new()));
    let Some(survey) = survey else {
        complain!("interrupted: nothing is printed or written; every finished run is kept");
        return Ok(ExitStatus::Interrupted);
    };
    let tables = [
        boundaries(&survey.confirmations),
        largest_forces(&survey.examinations),
    ];
    let people = || survey_text(&survey);
    let printed = arguments.format.print(&tables, command, people);
    let written = out.write(|| {
        vec![
            ("regimes.csv", regimes(&maps, GRID.0, GRID.1).csv()),
            ("boundaries.csv", tables[0].csv()),
            ("largest_forces.csv", tables[1].csv()),
            ("regimes.md", regimes_markdown(&survey, command)),
            ("regimes.svg", regimes_svg(&maps, &survey)),
        ]
    });
    Ok(conclude(&survey).max(printed).max(written))
}

/// Returns the files that are written.
fn layout() -> Layout {
    let files = [
        "regimes.csv",
        "boundaries.csv",
        "largest_forces.csv",
        "regimes.svg",
    ];
    Layout {
        witness: "regimes.md",
        is_ours: |content| content.starts_with(REGIMES_TITLE.as_bytes()),
        files: files.map(str::to_owned).into(),
        shared: false,
        scratch: None,
    }
}

fn checked_maps(arguments: &Arguments) -> Result<[RegimeMap; 3], InvalidValue> {
    let maps = RegimeMap::standard(arguments.kappa, arguments.history_update);
    maps[0].base.validate().map_err(as_flag)?;
    if (arguments.kappa / CLOSING_STIFFNESS_RATIO - 1.0).abs() < THREE_DIGITS {
        let accepted = format!(
            "further than {THREE_DIGITS:e} from {CLOSING_STIFFNESS_RATIO}, where contact 2-3 just closes: \
             all of the map would be a boundary"
        );
        return Err(InvalidValue::new("--kappa", arguments.kappa, accepted));
    }
    Ok(maps)
}

/// Summarizes the survey on standard error, and returns the exit status.
fn conclude(survey: &Survey) -> ExitStatus {
    for note in &survey.notes {
        tell!("{note}");
    }
    let verdicts: Vec<Verdict> = survey.verdicts().collect();
    let count = |verdict: Verdict| verdicts.iter().filter(|&&other| other == verdict).count();
    let (agree, differ) = (count(Verdict::Agrees), count(Verdict::Differs));
    tell!(
        "{agree} of {} places agree ({} on boundaries, {} largest forces), {differ} differ, {} inconclusive",
        verdicts.len(),
        survey.confirmations.len(),
        survey.examinations.len(),
        verdicts.len() - agree - differ
    );
    let each = verdicts.into_iter().map(ExitStatus::of_verdict);
    each.max().unwrap_or(ExitStatus::Success)
}
