//! Tables of the cost of steps and yield forces.

use super::number::{one_digit, plain};
use super::table::{Columns, DataTable};
use crate::code::machine;
use crate::dem::LaneWidth;
use crate::study::cost::{BenchTarget, PyramidCost, Scaling, ScalingRow, StackCost};

const BYTES_PER_MEGABYTE: f64 = 1e6;

/// The cost of one target and that of native lanes, if they were measured.
type StackRow<'a> = (&'a StackCost, Option<&'a StackCost>);
/// The cost of one code and that of the native code for the same pyramid, if it was measured.
type PyramidRow<'a> = (&'a PyramidCost, Option<&'a PyramidCost>);

/// Pairs each of `costs` with that of native lanes.
pub(super) fn beside_lanes(costs: &[StackCost]) -> Vec<StackRow<'_>> {
    let mut all = costs.iter();
    let lanes = all.find(|cost| cost.target == BenchTarget::NativeLanes);
    costs.iter().map(|cost| (cost, lanes)).collect()
}

/// Returns the cost of a step as a multiple of that in native lanes.
pub(super) fn times_lanes((cost, lanes): &StackRow) -> Option<f64> {
    lanes.map(|lanes| cost.median() / lanes.median())
}

/// Returns the table of the cost of the stack, one row per target.
pub fn bench(costs: &[StackCost]) -> DataTable<'_> {
    Columns::<StackRow>::new(
        "bench",
        "A row is the cost of a step and of a yield force by one code on one core.",
        "`tristack bench` (bench.csv, bench.json)",
    )
    .text("code", |(cost, _)| cost.target.as_str())
    .means("`native-scalar`, `native-lanes`, or the name of a code")
    .shown("code")
    .version(|(cost, _)| &cost.version)
    .shown("version")
    .dispensable(3)
    .number("ratio", "1", times_lanes)
    .means("`ns_per_step` over that of native lanes")
    .shown_as("times native-lanes", plain)
    .dispensable(6)
    .number("ns_per_step", "ns", |(cost, _)| cost.median())
    .means("wall time per step and case, the median of the runs")
    .shown_as("ns per step and case", plain)
    .number("steps", "1", |(cost, _)| cost.steps)
    .means("steps timed in each run, of all its cases together")
    .number("runs", "1", |(cost, _)| cost.nanoseconds.len())
    .means("how often it was measured")
    .number("start_up_seconds", "s", |(cost, _)| cost.start_up())
    .means("start and end, the median of the runs")
    .shown_as("start s", plain)
    .dispensable(2)
    .number("yield_forces_per_second", "1/s", |(cost, _)| {
        cost.yield_forces_per_second()
    })
    .means("yield forces per second and core, start included")
    .shown_as("yield forces per s", plain)
    .number("yield_force_ratio", "1", |(cost, lanes)| {
        lanes.map(|lanes| lanes.yield_forces_per_second() / cost.yield_forces_per_second())
    })
    .means("how many times as many native lanes make")
    .shown_as("times fewer", plain)
    .dispensable(4)
    .number("largest_error", "1", |(cost, _)| cost.largest_error)
    .means("largest distance of these yield forces from the exact limit, relative to F + n + 1")
    .shown_as("largest error", one_digit)
    .dispensable(5)
    .number("peak_megabytes", "MB", |(cost, _)| {
        cost.peak_bytes
            .map(|bytes| bytes as f64 / BYTES_PER_MEGABYTE)
    })
    .means("largest resident memory; that of native is all of this process")
    .shown_as("MB", |megabytes| format!("{megabytes:.0}"))
    .dispensable(1)
    .rows(beside_lanes(costs))
}

/// Names the machine and the number of lanes (cases) in its widest vectors.
pub fn bench_machine() -> String {
    let lanes = LaneWidth::widest().lanes();
    format!("{}, {lanes} lanes a vector", machine())
}

/// Returns the table of the cost of a step over the number of cases and cores.
pub fn scaling<'a>(rows: impl IntoIterator<Item = &'a ScalingRow>) -> DataTable<'a> {
    Columns::<&ScalingRow>::new(
        "scaling",
        "A row is the cost of a step in native lanes with some number of cases and cores.",
        "`tristack bench` (scaling.csv)",
    )
    .number("cases", "1", |row| row.cases)
    .means("number of cases")
    .shown("cases")
    .number("cores", "1", |row| row.cores)
    .means("number of cores")
    .shown("cores")
    .number("ns_per_step", "ns", |row| row.ns_per_step)
    .means("wall time per step and case, the median of the repeats")
    .shown_as("ns per step and case", plain)
    .number("speedup", "1", |row| row.speedup)
    .means("how many times as fast as the first row")
    .shown_as("times as fast", plain)
    .rows(rows)
}

/// Formats the machine, the table of costs and both tables of scaling as Markdown.
pub fn bench_markdown(costs: &[StackCost], measured: &Scaling) -> String {
    format!(
        "Machine: {}.\n\n{}\nNumber of cases on one core, in lanes:\n\n{}\n\
         Number of cores, planned runs in lanes:\n\n{}",
        bench_machine(),
        bench(costs).shown().markdown(),
        scaling(&measured.cases).shown().markdown(),
        scaling(&measured.cores).shown().markdown()
    )
}

/// Returns the table of the cost of a step of pyramids. Costs of one pyramid must be adjacent in `costs`.
pub fn pyramids(costs: &[PyramidCost]) -> DataTable<'_> {
    let same_pyramid = costs.chunk_by(|one, other| one.rows == other.rows);
    let rows = same_pyramid.flat_map(|costs| {
        let mut all = costs.iter();
        let native = all.find(|cost| cost.code.is_native());
        costs.iter().map(move |cost| (cost, native))
    });
    Columns::<PyramidRow>::new(
        "pyramids",
        "A row is the cost of a step of a pyramid of cylinders by one code on one core.",
        "`tristack bench --pyramids`",
    )
    .number("cylinders", "1", |(cost, _)| cost.cylinders)
    .means("number of cylinders")
    .shown("cylinders")
    .code(|(cost, _)| &cost.code)
    .version(|(cost, _)| &cost.version)
    .number("ratio", "1", |(cost, native)| {
        native.map(|native| cost.ratio_to(native))
    })
    .means("how many times the cost of native this is, run by run")
    .shown_as("times native", plain)
    .number("ns_per_step", "ns", |(cost, _)| cost.median())
    .means("wall time per step and cylinder, the median of the runs")
    .shown_as("ns per step and cylinder", plain)
    .number("fastest_ns_per_step", "ns", |(cost, _)| cost.fastest())
    .means("the same of the fastest run")
    .shown_as("fastest", plain)
    .number("steps", "1", |(cost, _)| cost.timed_steps)
    .means("steps timed in each run")
    .number("runs", "1", |(cost, _)| cost.nanoseconds.len())
    .means("how often it was measured")
    .rows(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cost(target: BenchTarget, nanoseconds: f64) -> StackCost {
        StackCost {
            target,
            version: "1".to_owned(),
            steps: 1000,
            nanoseconds: vec![nanoseconds],
            start_up_seconds: vec![0.5],
            seconds_per_yield_force: vec![nanoseconds],
            largest_error: 2e-8,
            peak_bytes: None,
        }
    }

    #[test]
    fn ratios_are_to_native_lanes() {
        let liggghts = BenchTarget::External(crate::code::Code::named("liggghts").unwrap());
        let costs = [cost(BenchTarget::NativeLanes, 10.0), cost(liggghts, 2500.0)];
        let ratios = beside_lanes(&costs)
            .iter()
            .map(times_lanes)
            .collect::<Vec<_>>();
        assert_eq!(ratios, [Some(1.0), Some(250.0)]);
        assert_eq!(times_lanes(&beside_lanes(&costs[1..])[0]), None);
        assert!(
            bench(&costs[1..])
                .shown()
                .markdown()
                .contains("| liggghts |")
        );
    }
}
