//! The origin of a run: program, inputs, time and machine.

use super::described::Code;
use crate::files::system_text;
use crate::model::{Case, sha256_hex};
use crate::series::Series;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

/// The program that computes.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Identity {
    /// Name of the code.
    pub code: String,
    /// Version that the code gives itself.
    pub version: String,
    /// Distribution package and its version, if the binary belongs to one.
    pub package: Option<String>,
    /// SHA-256 of the program file; absent for the native code, whose sources are hashed like a deck.
    pub program_hash: Option<String>,
    /// SHA-256 of the other files that decide what the program computes: its libraries, the interpreter of a script,
    /// and the programs and modules that the script names; absent from older recordings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub files_hash: Option<String>,
    /// SHA-256 of the motion of one micro-test to ten digits, where the program is quick enough to be asked in every
    /// session; absent from older recordings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub witness: Option<String>,
}

impl Identity {
    /// Returns the identity of the native code.
    pub(crate) fn native() -> &'static Self {
        static NATIVE: LazyLock<Identity> = LazyLock::new(|| Identity {
            code: Code::native().as_str().to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            package: None,
            program_hash: None,
            files_hash: None,
            witness: None,
        });
        &NATIVE
    }

    /// Returns the part of the identity that decides numbers. For the native code, that is not the release, because
    /// its sources are hashed like a deck, but the arithmetic that the version names after it.
    pub(crate) fn deciding(&self) -> Self {
        let mut deciding = self.clone();
        if self.code == Code::native().as_str() {
            let arithmetic = self.version.split_once(' ').map_or("", |(_, rest)| rest);
            deciding.version = arithmetic.to_owned();
        }
        deciding
    }

    /// Returns the content address of the run of `case` by this program with the deck that has `deck_hash`.
    pub fn address(&self, case: &Case, deck_hash: &str) -> String {
        let parts = serde_json::json!([case.content_hash(), self.deciding(), deck_hash]);
        sha256_hex(parts.to_string().as_bytes())
    }
}

/// How a run was made, so that it can be made again.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// The program that computed it.
    pub identity: Identity,
    /// SHA-256 of all inputs of the program: deck, parameters, arguments and environment; for the native code, of
    /// sources and parameters.
    pub deck_hash: String,
    /// Version of tristack that drove it.
    pub tristack: String,
    /// The command that repeats the run in a directory with the deck and the parameters of the case, as
    /// `tristack simulate --case case.json --out DIRECTORY` makes it.
    pub command: Vec<String>,
    /// When it finished, UTC.
    pub date: String,
    /// Processor, number of cores and operating system.
    pub machine: String,
    /// Steps in all, preparation included.
    pub steps: u64,
    /// Wall time since the process was started or, where many runs share it, since its previous run finished.
    pub seconds: f64,
}

impl Provenance {
    /// Returns the provenance of a run that has just finished here.
    pub fn now(
        identity: Identity,
        deck_hash: String,
        command: Vec<String>,
        steps: u64,
        seconds: f64,
    ) -> Self {
        let now = jiff::Timestamp::now();
        Self {
            identity,
            deck_hash,
            tristack: env!("CARGO_PKG_VERSION").to_owned(),
            command,
            date: now.round(jiff::Unit::Second).unwrap_or(now).to_string(),
            machine: machine().to_owned(),
            steps,
            seconds,
        }
    }

    /// Returns indented JSON with a final newline.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("plain data has a JSON form") + "\n"
    }
}

/// Describes this machine: processor, number of cores and operating system.
pub fn machine() -> &'static str {
    static MACHINE: LazyLock<String> = LazyLock::new(read_machine);
    &MACHINE
}

fn read_machine() -> String {
    let cpu_info = system_text("/proc/cpuinfo").unwrap_or_default();
    let mut lines = cpu_info.lines();
    let model = lines.find_map(|line| line.strip_prefix("model name"));
    let model = model.map(|rest| rest.trim_start_matches([' ', '\t', ':']));
    let model = model.unwrap_or("unknown processor");
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let (system, architecture) = (std::env::consts::OS, std::env::consts::ARCH);
    format!("{model}, {cores} cores, {system} {architecture}")
}

/// A finished run.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// The case.
    pub case: Case,
    /// Its series.
    pub series: Series,
    /// Its origin.
    pub provenance: Provenance,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_release_of_the_same_sources_has_the_same_runs_but_not_another_arithmetic() {
        let of = |version: &str| Identity {
            version: version.to_owned(),
            ..Identity::native().clone()
        };
        let deciding = |version: &str| of(version).deciding();
        assert_eq!(deciding("0.1.0"), deciding("9.8.7"));
        assert_ne!(deciding("0.1.0"), deciding("0.1.0 double-double"));
        let external = |version: &str| Identity {
            code: "yade".to_owned(),
            ..of(version)
        };
        assert_ne!(external("1").deciding(), external("2").deciding());
    }
}
