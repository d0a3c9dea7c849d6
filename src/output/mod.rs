//! What people see: tables of rows, in every format.

mod bench;
mod crosscheck;
mod explain;
mod figures;
mod forecast;
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

pub use bench::{
    BenchRow, PyramidRow, bench_csv, bench_json, bench_machine, bench_markdown, bench_rows,
    bench_table, pyramid_rows, pyramid_table, scaling_table,
};
pub use crosscheck::{
    budget_csv, crosscheck_csv, crosscheck_json, crosscheck_markdown, crosscheck_rows,
    crosscheck_table,
};
pub use explain::explanation;
pub use figures::{
    Figure, StackPanel, figures, performance_svg, regimes_svg, representative_panels, run_svg,
};
pub use forecast::{forecast_csv, forecast_json, forecast_table};
pub use inventory::{Inventory, inventory_csv, inventory_json, inventory_table};
pub use number::{friction, significant};
pub use page::{Origin, ReportFile, report_files};
pub use probe::{probe_csv, probe_json, probe_markdown, probe_table};
pub use regimes::{
    boundaries_csv, largest_forces_csv, regimes_csv, regimes_markdown, survey_json, survey_table,
};
pub use simulation::{Simulation, simulation_csv, simulation_json, simulation_table};
pub use table::Table;
pub use theory::{theory_csv, theory_json, theory_table};
pub use trajectory::{
    trajectories_csv, trajectories_json, trajectories_markdown, trajectories_table,
};
pub use vtk::{VtkFile, is_vtk_row, vtk_series};
