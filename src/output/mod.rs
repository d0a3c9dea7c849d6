//! Output for people and programs: tables in every format, figures, pages.

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
pub(crate) mod junit;
mod laws;
mod number;
mod page;
mod passport;
mod plan;
mod probe;
pub(crate) mod published;
mod regimes;
mod schema;
mod series;
mod series_columns;
mod simulation;
mod start_list;
mod store;
mod table;
mod text;
mod theory;
mod trajectory;
mod vtk;

pub use bench::pyramids;
pub use figures::{StackPanel, representative_panels, run_pdf, run_svg};
pub use formats::formats_page;
pub use schema::{Document, all_json_schemas};
pub use table::{DataTable, Table};
pub use vtk::{VtkFile, vtk_series};

pub(crate) use atlas::{Problem, atlas_files, atlas_table};
pub(crate) use bench::{bench, bench_machine, bench_markdown, scaling};
pub(crate) use case_file::commented_case;
pub(crate) use check::{check, check_text};
pub(crate) use crosscheck::{
    budget, crosscheck, crosscheck_markdown, crosscheck_summary, crosscheck_text,
};
pub(crate) use difference::{passport_changes, passport_forces};
pub(crate) use duration::{AllDurations, all_durations, code_durations, durations_text};
pub(crate) use explain::explanation;
pub(crate) use explained::{declared_explanations, explained};
pub(crate) use figures::{Figure, laws_svg, performance_svg, regimes_svg};
pub(crate) use forecast::{forecast_text, forecasts};
pub(crate) use impact::{impacts, impacts_markdown, impacts_text};
pub(crate) use inventory::inventory;
pub(crate) use laws::{
    FORCES_EXPLAINED, LAWS_EXPLAINED, LAWS_TITLE, law_conventions, law_forces, laws_lead,
    laws_markdown,
};
pub(crate) use number::{friction, significant};
pub(crate) use page::{Origin, report_files};
pub(crate) use passport::{arm_effects, measured_convention, passport_json, passport_markdown};
pub(crate) use plan::planned_runs;
pub(crate) use probe::{probe, probe_by_code};
pub(crate) use published::{
    contradictions, given_runs, given_series, published_files, published_forces,
    published_markdown, published_series, published_summary, published_summary_in_tex,
    published_tables, published_text,
};
pub(crate) use regimes::{
    REGIMES_TITLE, boundaries, largest_forces, regimes, regimes_markdown, survey_text,
};
pub(crate) use series::{judged_series, judged_series_text};
pub(crate) use series_columns::series_columns;
pub(crate) use simulation::{simulations, unfinished};
pub(crate) use start_list::{parallel_list, slurm_array, start_list};
pub(crate) use store::{entry_text, size, stored, stored_entries, stored_files};
pub(crate) use table::{json, wrapped_to_screen};
pub(crate) use theory::{theories_by_stack, theory};
pub(crate) use trajectory::{trajectories, trajectories_markdown, trajectories_text};
pub(crate) use vtk::{VTK_COLLECTION, is_vtk_collection, is_vtk_row};
