//! With what, where and when.

use super::super::document::{Block, DataTable, Section};
use super::Origin;
use crate::code::{Code, TaskKind};
use crate::code::{Identity, Provenance};
use crate::model::sha256_hex;
use crate::output::Table;
use crate::paper::reproduction::Reproduction;

/// Digits of a hash that are shown.
const SHORT: usize = 12;

/// The section.
pub fn section(reproduction: &Reproduction, origin: &Origin) -> Section {
    let lock = sha256_hex(include_bytes!("../../../../Cargo.lock"));
    let blocks = vec![
        Block::paragraph(format!(
            "Made by `{}`, tristack {}, built from the dependencies in the lock file with SHA-256 `{lock}`. \
             Dates and durations are those of the runs.",
            origin.command,
            env!("CARGO_PKG_VERSION")
        )),
        Block::Table(programs(reproduction, origin)),
        Block::Table(decks()),
    ];
    Section {
        id: "environment",
        title: "Environment",
        blocks,
    }
}

/// The runs of one program on one machine.
struct Program<'a> {
    identity: &'a Identity,
    machine: &'a str,
    runs: usize,
    first: &'a str,
    last: &'a str,
    steps: u64,
    seconds: f64,
}

fn programs_of(provenances: &[Provenance]) -> Vec<Program<'_>> {
    let mut programs: Vec<Program> = Vec::new();
    for run in provenances {
        let known = programs
            .iter_mut()
            .find(|program| *program.identity == run.identity && program.machine == run.machine);
        match known {
            Some(program) => {
                program.runs += 1;
                program.first = program.first.min(&run.date);
                program.last = program.last.max(&run.date);
                program.steps += run.steps;
                program.seconds += run.seconds;
            }
            None => programs.push(Program {
                identity: &run.identity,
                machine: &run.machine,
                runs: 1,
                first: &run.date,
                last: &run.date,
                steps: run.steps,
                seconds: run.seconds,
            }),
        }
    }
    programs
}

fn programs(reproduction: &Reproduction, origin: &Origin) -> DataTable {
    let mut table = Table::new(&[
        "code",
        "version",
        "package",
        "program",
        "source",
        "runs>",
        "steps>",
        "seconds>",
        "first run, UTC",
        "last run, UTC",
        "machine",
    ]);
    for program in programs_of(&reproduction.provenances) {
        let Program { identity, .. } = &program;
        let hash = identity.program_hash.as_deref().unwrap_or("-");
        table.push(vec![
            identity.code.clone(),
            identity.version.clone(),
            identity.package.clone().unwrap_or_else(|| "-".to_owned()),
            short(hash),
            origin.source_of(&identity.code).to_owned(),
            program.runs.to_string(),
            format!("{:.1e}", program.steps as f64),
            format!("{:.1}", program.seconds),
            minute(program.first),
            minute(program.last),
            program.machine.to_owned(),
        ]);
    }
    DataTable {
        name: "environment",
        caption: format!(
            "Programs, with the first {SHORT} digits of their SHA-256, and their runs."
        ),
        csv: table.csv(),
        table,
        long: false,
    }
}

fn short(hash: &str) -> String {
    hash.chars().take(SHORT).collect()
}

/// A date to the minute.
fn minute(date: &str) -> String {
    date.get(..16).unwrap_or(date).replace('T', " ")
}

fn decks() -> DataTable {
    let mut table = Table::new(&[
        "code",
        "SHA-256 of the deck of a stack",
        "of the micro-tests",
    ]);
    for code in Code::all() {
        table.push(vec![
            code.to_string(),
            short(&code.files_hash(TaskKind::Stack)),
            short(&code.files_hash(TaskKind::Motion)),
        ]);
    }
    DataTable {
        name: "decks",
        caption: format!(
            "First {SHORT} digits of the SHA-256 of the decks; for the native DEM its sources take their place."
        ),
        csv: table.csv(),
        table,
        long: false,
    }
}
