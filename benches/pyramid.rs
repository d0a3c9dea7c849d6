//! Nanoseconds per step and cylinder of pyramids: native, LAMMPS and LIGGGHTS, those that are installed.

use tristack::code::{Interrupt, RunContext};
use tristack::output::pyramids;
use tristack::study::cost::{BenchError, PyramidBench};

fn main() -> Result<(), BenchError> {
    let mut bench = PyramidBench::default();
    bench.codes.retain(|code| code.name().find().is_some());
    let directory = tempfile::tempdir().expect("a directory for temporary files");
    let costs = bench.measure(&RunContext::new(directory.path(), &Interrupt::new()))?;
    print!("{}", pyramids(&costs).shown().terminal());
    Ok(())
}
