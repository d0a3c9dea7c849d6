//! Properties that every parser has for any input: it returns, and everything that it accepts is sound.
//!
//! Each module has a `check` of some bytes, which panics if something does not hold, and `seeds`, valid inputs
//! to start from. `tests/fuzz/` hands them to libFuzzer, `tests/parsers.rs` to proptest.

pub mod case;
pub mod checkpoints;
pub mod claims;
pub mod columns;
pub mod forecasts;
pub mod logs;
pub mod manifests;
pub mod options;
pub mod plans;
pub mod probes;
pub mod records;
pub mod scenes;
pub mod series;
pub mod stacks;

use nix::sys::resource::{UsageWho, getrusage};
use nix::sys::time::TimeValLike;
use std::path::PathBuf;

/// An input by its name.
pub type Seed = (String, Vec<u8>);

/// A test of arbitrary bytes.
pub type Check = fn(&[u8]);

/// Inputs to start from.
pub type Seeds = fn() -> Vec<Seed>;

/// Name, check and seeds of every target.
pub const TARGETS: [(&str, Check, Seeds); 13] = [
    ("case", case::check, case::seeds),
    ("options", options::check, options::seeds),
    ("claims", claims::check, claims::seeds),
    ("series", series::check, series::seeds),
    ("logs", logs::check, logs::seeds),
    ("records", records::check, records::seeds),
    ("probes", probes::check, probes::seeds),
    ("checkpoints", checkpoints::check, checkpoints::seeds),
    ("stacks", stacks::check, stacks::seeds),
    ("forecasts", forecasts::check, forecasts::seeds),
    ("plans", plans::check, plans::seeds),
    ("manifests", manifests::check, manifests::seeds),
    ("columns", columns::check, columns::seeds),
];

/// `check` of `data`, which must not take more than `seconds` of a processor, however busy the machine is.
pub fn check_within(seconds: f64, check: Check, data: &[u8]) {
    let start = processor_seconds();
    check(data);
    let took = processor_seconds() - start;
    assert!(took <= seconds, "{took} s for an input");
}

/// Of this thread, since it began.
fn processor_seconds() -> f64 {
    let usage = getrusage(UsageWho::RUSAGE_THREAD).expect("the system counts");
    let total = usage.user_time() + usage.system_time();
    1e-6 * total.num_microseconds() as f64
}

/// Writes the seeds of `target` into the directory that `FUZZ_SEEDS` names, if it names one.
pub fn write_seeds(target: &str) {
    let Some(directory) = std::env::var_os("FUZZ_SEEDS").map(PathBuf::from) else {
        return;
    };
    let (.., seeds) = TARGETS
        .iter()
        .find(|(name, ..)| *name == target)
        .expect("a target");
    for (name, content) in seeds() {
        std::fs::write(directory.join(name), content).expect("a seed is written");
    }
}

/// The reference data of the project.
fn reference() -> PathBuf {
    let own = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    [own.join("reference"), own.join("../../reference")]
        .into_iter()
        .find(|directory| directory.is_dir())
        .expect("the reference data are there")
}

/// `text` behind the byte that says what it is.
fn marked(kind: u8, text: impl AsRef<[u8]>) -> Vec<u8> {
    let mut input = vec![kind];
    input.extend(text.as_ref());
    input
}
