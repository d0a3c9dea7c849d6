//! Nanoseconds per step and cylinder of pyramids: native, LAMMPS and LIGGGHTS, those that are installed.

use tristack::bench::{BenchError, PyramidBench};
use tristack::engine::{EngineName, Interrupt, Workplace};

fn main() -> Result<(), BenchError> {
    let everyone = PyramidBench::default();
    let installed = |engine: &EngineName| engine.find().is_some();
    let bench = PyramidBench {
        engines: everyone.engines.iter().copied().filter(installed).collect(),
        ..everyone
    };
    let directory = tempfile::tempdir().expect("a directory for temporary files");
    let costs = bench.measure(&Workplace::new(directory.path(), &Interrupt::new()))?;
    println!("cylinders  engine    median  fastest  times native");
    for same_pyramid in costs.chunk_by(|one, other| one.rows == other.rows) {
        for cost in same_pyramid {
            println!(
                "{:>9}  {:<8}  {:>6.1}  {:>7.1}  {:>12.2}",
                cost.cylinders,
                cost.engine.as_str(),
                cost.median(),
                cost.fastest(),
                cost.ratio_to(&same_pyramid[0]),
            );
        }
    }
    Ok(())
}
