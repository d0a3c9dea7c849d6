//! What people and programs read: tables in every format, figures, and the pages of report and atlas.

mod atlas;
mod bench;
mod case_file;
mod check;
mod crosscheck;
mod difference;
mod duration;
mod explain;
mod explained;
mod figures;
mod forecast;
mod formats;
mod impact;
mod inventory;
mod judged_series;
pub mod junit;
mod laws;
mod number;
mod page;
mod passport;
mod plan;
mod probe;
pub mod published;
mod regimes;
mod schema;
mod series_columns;
mod simulation;
mod start_list;
mod store;
mod table;
mod text;
mod theories;
mod trajectory;
mod vtk;

pub use atlas::{Problem, atlas_files};
pub use bench::{bench, bench_machine, bench_markdown, pyramids, scaling};
pub use case_file::commented_case;
pub use check::{check, check_text};
pub use crosscheck::{
    budget, crosscheck, crosscheck_markdown, crosscheck_summary, crosscheck_text,
};
pub use difference::{passport_changes, passport_forces};
pub use duration::{AllDurations, all_durations, code_durations, durations_text};
pub use explain::explanation;
pub use explained::explained;
pub use figures::{
    Figure, StackPanel, laws_svg, performance_svg, regimes_svg, representative_panels, run_pdf,
    run_svg,
};
pub use forecast::{forecast_text, forecasts};
pub use formats::formats_page;
pub use impact::{impacts, impacts_markdown, impacts_text};
pub use inventory::inventory;
pub use judged_series::{judged_series, judged_series_text};
pub use laws::{law_forces, laws_markdown};
pub use number::friction;
pub use page::{Origin, report_files};
pub use passport::{arm_effects, passport_json, passport_markdown};
pub use plan::planned_runs;
pub use probe::{probe, probe_by_code};
pub use published::{
    contradictions, given_runs, given_series, published_files, published_forces,
    published_markdown, published_series, published_summary, published_tables, published_text,
};
pub use regimes::{
    REGIMES_TITLE, boundaries, largest_forces, regimes, regimes_markdown, survey_text,
};
pub use schema::{Document, all_json_schemas};
pub use series_columns::series_columns;
pub use simulation::{simulations, unfinished};
pub use start_list::{parallel_list, slurm_array, start_list};
pub use store::{entry_text, size, stored, stored_entries, stored_files};
pub use table::{DataTable, Table, json, wrapped_to_screen};
pub use theories::{theories_by_stack, theory};
pub use trajectory::{trajectories, trajectories_markdown, trajectories_text};
pub use vtk::{VTK_COLLECTION, VtkFile, is_vtk_collection, is_vtk_row, vtk_series};

pub(crate) use atlas::atlas_table;
pub(crate) use explained::declared_explanations;
pub(crate) use laws::{FORCES_EXPLAINED, LAWS_EXPLAINED, LAWS_TITLE, law_conventions, laws_lead};
pub(crate) use number::significant;
pub(crate) use passport::measured_convention;
pub(crate) use published::published_summary_in_tex;

use tristack_dem::{dem, model, series};
#[cfg(test)]
use tristack_harness::files;
use tristack_harness::{code, runs, study};
use tristack_paper as paper;
use tristack_theory::{experiment, theory};
