//! Nanoseconds per step and cylinder of pyramids: native, LAMMPS and LIGGGHTS, those that are installed.

use tristack::bench::{BenchError, PyramidBench};
use tristack::engine::{EngineName, Interrupt, Workplace};
use tristack::report::{pyramid_rows, pyramid_table};

fn main() -> Result<(), BenchError> {
    let everyone = PyramidBench::default();
    let installed = |engine: &EngineName| engine.find().is_some();
    let bench = PyramidBench {
        engines: everyone.engines.iter().copied().filter(installed).collect(),
        ..everyone
    };
    let directory = tempfile::tempdir().expect("a directory for temporary files");
    let costs = bench.measure(&Workplace::new(directory.path(), &Interrupt::new()))?;
    print!("{}", pyramid_table(&pyramid_rows(&costs)).terminal());
    Ok(())
}
