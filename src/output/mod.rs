//! What people see: tables of rows, in every format.

mod bench;
mod crosscheck;
mod explain;
mod figures;
mod forecast;
mod formats;
mod inventory;
mod number;
mod page;
mod probe;
mod regimes;
mod simulation;
mod table;
mod theory;
mod trajectory;
mod vtk;

pub use bench::{bench, bench_machine, bench_markdown, pyramids, scaling};
pub use crosscheck::{budget, crosscheck, crosscheck_markdown, crosscheck_text};
pub use explain::explanation;
pub use figures::{
    Figure, StackPanel, figures, performance_svg, regimes_svg, representative_panels, run_svg,
};
pub use forecast::{forecast_text, forecasts};
pub use formats::formats_page;
pub use inventory::{Inventory, inventory};
pub use number::{friction, significant};
pub use page::{Origin, ReportFile, report_files};
pub use probe::{probe, probe_by_code};
pub use regimes::{boundaries, largest_forces, regimes, regimes_markdown, survey_text};
pub use simulation::{Simulation, simulations};
pub(crate) use table::json;
pub use table::{DataTable, Table};
pub use theory::{theories_by_stack, theory};
pub use trajectory::{trajectories, trajectories_markdown, trajectories_text};
pub use vtk::{VtkFile, is_vtk_row, vtk_series};
