//! What people see: tables of rows, in every format.

mod crosscheck;
mod explain;
mod figures;
mod inventory;
mod number;
mod probe;
mod regimes;
mod simulation;
mod table;
mod theory;
mod trajectory;

pub use crosscheck::{
    budget_csv, crosscheck_csv, crosscheck_json, crosscheck_markdown, crosscheck_table,
};
pub use explain::explanation;
pub use figures::{Figure, PdfError, figures, regimes_svg};
pub use inventory::{Inventory, inventory_csv, inventory_json, inventory_table};
pub use number::{friction, significant};
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
