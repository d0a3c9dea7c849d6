//! What people run: each command, its files and its refusals.

#[path = "../common/mod.rs"]
mod common;

mod atlas;
mod bad_input;
mod case_files;
mod cli_bench;
mod cli_crosscheck;
mod cli_pictures;
mod cli_predict;
mod cli_probe;
mod cli_regimes;
mod cli_simulate;
mod cli_store;
mod cli_tables;
mod cli_theory;
mod cli_time;
mod cli_trajectories;
mod every_flag;
mod example_cases;
mod few_digits;
mod foreign_files;
mod identity;
mod interruption;
mod judge_series;
mod left_out;
mod limits;
mod no_locks;
mod paths;
mod plan_and_judge;
mod shells;
mod store;
mod time_left;
mod wheel;
