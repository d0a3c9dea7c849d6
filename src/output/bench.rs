//! What steps and yield forces cost, in every format.

use super::number::{optional, plain};
use super::table::Table;
use crate::code::Code;
use crate::code::machine;
use crate::dem::LaneWidth;
use crate::study::cost::{BenchTarget, PyramidCost, Scaling, ScalingRow, StackCost};
use serde::Serialize;

const BYTES_PER_MEGABYTE: f64 = 1e6;

/// What the stack costs one target.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BenchRow {
    /// Who: `native-scalar`, `native-lanes`, or an code.
    pub code: &'static str,
    /// Its version.
    pub version: String,
    /// Wall time per step and case in nanoseconds, the median of the runs.
    pub ns_per_step: f64,
    /// Steps that were timed in each run, of all its cases together.
    pub steps: u64,
    /// How often it was measured.
    pub runs: usize,
    /// `ns_per_step` over that of native lanes.
    pub ratio: Option<f64>,
    /// Start and end in seconds, the median of the runs.
    pub start_up_seconds: f64,
    /// Stacks whose yield force is known, per second and core, start included.
    pub yield_forces_per_second: f64,
    /// How many times as many of these native lanes make.
    pub yield_force_ratio: Option<f64>,
    /// Largest distance of these yield forces from the exact limit, relative to F + 3.
    pub largest_error: f64,
    /// Largest resident memory in megabytes; that of native is all of this process.
    pub peak_megabytes: Option<f64>,
}

/// The rows of `costs`.
pub fn bench_rows(costs: &[StackCost]) -> Vec<BenchRow> {
    let mut all = costs.iter();
    let lanes = all.find(|cost| cost.target == BenchTarget::NativeLanes);
    let row = |cost: &StackCost| BenchRow {
        code: cost.target.as_str(),
        version: cost.version.clone(),
        ns_per_step: cost.median(),
        steps: cost.steps,
        runs: cost.nanoseconds.len(),
        ratio: lanes.map(|lanes| cost.median() / lanes.median()),
        start_up_seconds: cost.start_up(),
        yield_forces_per_second: cost.yield_forces_per_second(),
        yield_force_ratio: lanes
            .map(|lanes| lanes.yield_forces_per_second() / cost.yield_forces_per_second()),
        largest_error: cost.largest_error,
        peak_megabytes: cost
            .peak_bytes
            .map(|bytes| bytes as f64 / BYTES_PER_MEGABYTE),
    };
    costs.iter().map(row).collect()
}

/// One line a row of any kind.
pub fn bench_csv<R: Serialize>(rows: &[R]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer
            .serialize(row)
            .expect("plain rows are written to memory");
    }
    writer.into_inner().expect("memory is flushed")
}

/// Rows of any kind as a list of objects.
pub fn bench_json<R: Serialize>(rows: &[R]) -> String {
    serde_json::to_string_pretty(rows).expect("plain rows have a JSON form") + "\n"
}

/// The machine that everything is measured on, and how many cases its vectors hold.
pub fn bench_machine() -> String {
    let lanes = LaneWidth::widest().lanes();
    format!("{}, {lanes} lanes a vector", machine())
}

/// For people, ratios first.
pub fn bench_table(rows: &[BenchRow]) -> Table {
    let mut table = Table::new(&[
        "code",
        "version",
        "times native-lanes>",
        "ns per step and case>",
        "start s>",
        "yield forces per s>",
        "times fewer>",
        "largest error>",
        "MB>",
    ]);
    for row in rows {
        table.push(vec![
            row.code.to_owned(),
            row.version.clone(),
            optional(row.ratio, plain),
            plain(row.ns_per_step),
            plain(row.start_up_seconds),
            plain(row.yield_forces_per_second),
            optional(row.yield_force_ratio, plain),
            format!("{:.0e}", row.largest_error),
            optional(row.peak_megabytes, |megabytes| format!("{megabytes:.0}")),
        ]);
    }
    table
}

/// How lanes scale, for people.
pub fn scaling_table(rows: &[ScalingRow]) -> Table {
    let mut table = Table::new(&[
        "cases>",
        "cores>",
        "ns per step and case>",
        "times as fast>",
    ]);
    for row in rows {
        table.push(vec![
            row.cases.to_string(),
            row.cores.to_string(),
            plain(row.ns_per_step),
            plain(row.speedup),
        ]);
    }
    table
}

/// Both tables with the machine and what they are, as Markdown.
pub fn bench_markdown(rows: &[BenchRow], scaling: &Scaling) -> String {
    format!(
        "Machine: {}.\n\n{}\nNumber of cases on one core, in lanes:\n\n{}\n\
         Number of cores, planned runs in lanes:\n\n{}",
        bench_machine(),
        bench_table(rows).markdown(),
        scaling_table(&scaling.cases).markdown(),
        scaling_table(&scaling.cores).markdown()
    )
}

/// What a pyramid costs one code.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PyramidRow {
    /// Who.
    pub code: Code,
    /// Its version.
    pub version: String,
    /// Number of cylinders.
    pub cylinders: usize,
    /// Wall time per step and cylinder in nanoseconds, the median of the runs.
    pub ns_per_step: f64,
    /// The same of the fastest run.
    pub fastest_ns_per_step: f64,
    /// Steps that were timed in each run.
    pub steps: u64,
    /// How often it was measured.
    pub runs: usize,
    /// How many times the cost of native this is, run by run.
    pub ratio: Option<f64>,
}

/// The rows of `costs`, in which those of one pyramid stand together.
pub fn pyramid_rows(costs: &[PyramidCost]) -> Vec<PyramidRow> {
    let same_pyramid = costs.chunk_by(|one, other| one.rows == other.rows);
    let rows = same_pyramid.flat_map(|costs| {
        let mut all = costs.iter();
        let native = all.find(|cost| cost.code == Code::NATIVE);
        costs.iter().map(move |cost| PyramidRow {
            code: cost.code,
            version: cost.version.clone(),
            cylinders: cost.cylinders,
            ns_per_step: cost.median(),
            fastest_ns_per_step: cost.fastest(),
            steps: cost.timed_steps,
            runs: cost.nanoseconds.len(),
            ratio: native.map(|native| cost.ratio_to(native)),
        })
    });
    rows.collect()
}

/// For people, ratios first.
pub fn pyramid_table(rows: &[PyramidRow]) -> Table {
    let mut table = Table::new(&[
        "cylinders>",
        "code",
        "times native>",
        "ns per step and cylinder>",
        "fastest>",
    ]);
    for row in rows {
        table.push(vec![
            row.cylinders.to_string(),
            row.code.to_string(),
            optional(row.ratio, plain),
            plain(row.ns_per_step),
            plain(row.fastest_ns_per_step),
        ]);
    }
    table
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
        let liggghts = BenchTarget::External(Code::named("liggghts").unwrap());
        let rows = bench_rows(&[cost(BenchTarget::NativeLanes, 10.0), cost(liggghts, 2500.0)]);
        assert_eq!([rows[0].ratio, rows[1].ratio], [Some(1.0), Some(250.0)]);
        assert_eq!(rows[1].yield_force_ratio, Some(250.0));
        let alone = bench_rows(&[cost(liggghts, 2500.0)]);
        assert_eq!(alone[0].ratio, None);
        assert!(bench_table(&alone).markdown().contains("| liggghts |"));
    }
}
