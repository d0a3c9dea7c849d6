//! Nanoseconds per step and cylinder of pyramids: native, LAMMPS and LIGGGHTS, those that are installed.

use tristack::code::{Code, Interrupt, RunContext};
use tristack::output::pyramids;
use tristack::study::cost::{BenchError, PyramidBench};

fn main() -> Result<(), BenchError> {
    let everyone = PyramidBench::default();
    let installed = |code: &Code| code.find().is_some();
    let bench = PyramidBench {
        codes: everyone.codes.iter().copied().filter(installed).collect(),
        ..everyone
    };
    let directory = tempfile::tempdir().expect("a directory for temporary files");
    let costs = bench.measure(&RunContext::new(directory.path(), &Interrupt::new()))?;
    print!("{}", pyramids(&costs).shown().terminal());
    Ok(())
}
