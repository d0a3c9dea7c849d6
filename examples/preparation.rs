//! What the paper's preparation between side walls does to c and F, as JSON:
//!
//! ```text
//! cargo run --release --example preparation -- ENGINES FRICTIONS STIFFNESSES PUSHES
//! cargo run --release --example preparation -- native,liggghts,yade 0.2 100 0.1,0.5,1,5
//! ```
//!
//! Lists are separated by commas, pushes in units of epsilon. Runs are kept in TRISTACK_STORE.

use clap::ValueEnum;
use std::path::PathBuf;
use tristack::archive::Run;
use tristack::crosscheck::{Progress, Recorded, Settings, Store};
use tristack::engine::{EngineName, Failure, Interrupt};
use tristack::reproduction::study_preparation;
use tristack::stack::{Case, Stack};

static INTERRUPT: Interrupt = Interrupt::new();

struct Silent;

impl Progress for Silent {
    fn planned(&self, _total: usize, _reused: usize) {}
    fn finished(&self, _engine: EngineName, _case: &Case, _result: Result<&Run, &Failure>) {}
    fn warn(&self, message: &str) {
        eprintln!("{message}");
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [engines, frictions, stiffnesses, pushes] = arguments.as_slice() else {
        return Err("usage: preparation ENGINES FRICTIONS STIFFNESSES PUSHES".into());
    };
    let engines = engines
        .split(',')
        .map(|name| EngineName::from_str(name, false));
    let engines = engines.collect::<Result<Vec<EngineName>, String>>()?;
    let (frictions, pushes) = (numbers(frictions)?, numbers(pushes)?);
    let stacks: Vec<Stack> = numbers(stiffnesses)?
        .iter()
        .flat_map(|&stiffness| frictions.iter().map(move |&mu| Stack::paper(mu, stiffness)))
        .collect();
    for stack in &stacks {
        stack.validate()?;
    }
    let store = std::env::var_os("TRISTACK_STORE").ok_or("TRISTACK_STORE names no directory")?;
    let settings = Settings {
        store: Store::open(&PathBuf::from(store))?,
        recorded: Recorded::new(&PathBuf::from("reference")),
        fresh: false,
        threads: std::thread::available_parallelism().map_or(1, usize::from),
        time_limit: None,
        interrupt: &INTERRUPT,
    };
    let studies = study_preparation(&stacks, &pushes, &engines, &settings, &Silent)?;
    println!("{}", serde_json::to_string_pretty(&studies)?);
    Ok(())
}

fn numbers(list: &str) -> Result<Vec<f64>, std::num::ParseFloatError> {
    list.split(',').map(str::parse).collect()
}
