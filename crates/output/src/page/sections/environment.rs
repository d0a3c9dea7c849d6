//! The environment of the runs: programs, machines, dates, hashes.

use super::super::document::{Block, Section};
use super::Origin;
use crate::DataTable;
use crate::code::{Code, Identity, Provenance, TaskKind};
use crate::model::sha256_hex;
use crate::paper::reproduction::Reproduction;
use crate::study::Source;
use crate::table::Columns;

/// Number of shown digits of a hash.
const SHORT: usize = 12;

pub(super) fn section(reproduction: &Reproduction, origin: &Origin) -> Section {
    let blocks = vec![
        Block::paragraph(format!(
            "Made by `{}`, tristack {}, built from the dependencies in the lock file with SHA-256 `{}`. \
             Dates and durations are those of the runs.",
            origin.command,
            env!("CARGO_PKG_VERSION"),
            sha256_hex(origin.lock_file)
        )),
        Block::table(
            "environment",
            format!("Programs, with the first {SHORT} digits of their SHA-256, and their runs."),
            &programs(&reproduction.provenances, &origin.recorded),
        ),
        Block::table(
            "decks",
            format!(
                "First {SHORT} digits of the SHA-256 of the decks; for the native DEM its sources take their \
                 place."
            ),
            &decks(reproduction.probes.iter().map(|(code, _)| code)),
        ),
    ];
    Section::new("environment", "Environment", blocks)
}

/// The runs of one program on one machine.
type Program<'a> = Vec<&'a Provenance>;

fn programs_of(provenances: &[Provenance]) -> Vec<Program<'_>> {
    let mut programs: Vec<Program> = Vec::new();
    for run in provenances {
        let mut known = programs.iter_mut().map(|own| (own[0], own));
        let same = |one: &Provenance| one.identity == run.identity && one.machine == run.machine;
        match known.find(|(first, _)| same(first)) {
            Some((_, program)) => program.push(run),
            None => programs.push(vec![run]),
        }
    }
    programs
}

pub(crate) fn programs<'a>(provenances: &'a [Provenance], recorded: &'a [Code]) -> DataTable<'a> {
    let identity = |own: &Program<'a>| -> &'a Identity { &own[0].identity };
    let first = |own: &Program<'a>| own.iter().map(|run| &*run.date).min();
    let last = |own: &Program<'a>| own.iter().map(|run| &*run.date).max();
    let source = move |own: &Program| {
        let mut recorded = recorded.iter();
        match recorded.any(|code| code.as_str() == own[0].identity.code) {
            true => Source::Recorded,
            false => Source::Live,
        }
    };
    Columns::<Program>::new(
        "environment",
        "A row is a program on one machine and its runs.",
        "`tristack report` (tables/environment.csv)",
    )
    .text("code", move |own| identity(own).code.clone())
    .means("name of the code")
    .shown("code")
    .text("version", move |own| identity(own).version.clone())
    .means("its version")
    .of_outside()
    .shown("version")
    .text("package", move |own| identity(own).package.clone())
    .means("distribution package and its version")
    .of_outside()
    .shown("package")
    .text("program_hash", move |own| {
        identity(own).program_hash.clone()
    })
    .means("SHA-256 of the program")
    .shown("program")
    .cell(move |own| short(identity(own).program_hash.as_deref().unwrap_or("-")))
    .text("source", move |own| source(own).as_str())
    .means("`live` if it ran on this machine, `recorded` otherwise")
    .shown("source")
    .number("runs", "1", |own| own.len())
    .means("number of runs")
    .shown("runs")
    .number("steps", "1", |own| {
        own.iter().map(|run| run.steps).sum::<u64>()
    })
    .means("their steps")
    .shown_as("steps", |steps| format!("{steps:.1e}"))
    .number("seconds", "s", |own| {
        own.iter().map(|run| run.seconds).sum::<f64>()
    })
    .means("their wall time")
    .shown_as("seconds", |seconds| format!("{seconds:.1}"))
    .text("first_run", first)
    .means("date of the first, UTC")
    .shown("first run, UTC")
    .cell(move |own| first(own).map_or_else(String::new, minute))
    .text("last_run", last)
    .means("date of the last, UTC")
    .shown("last run, UTC")
    .cell(move |own| last(own).map_or_else(String::new, minute))
    .text("machine", |own| own[0].machine.clone())
    .means("processor and system")
    .of_outside()
    .shown("machine")
    .rows(programs_of(provenances))
}

fn short(hash: &str) -> String {
    hash.chars().take(SHORT).collect()
}

/// `date` to the minute.
fn minute(date: &str) -> String {
    date.get(..16).unwrap_or(date).replace('T', " ")
}

pub(crate) fn decks<'a>(codes: impl Iterator<Item = &'a Code>) -> DataTable<'static> {
    let mut all = Code::built_in();
    all.extend(codes.cloned());
    Columns::<Code>::new(
        "decks",
        "A row is the decks of one code; for the native DEM its sources take their place.",
        "`tristack report` (tables/decks.csv)",
    )
    .code(|code| code)
    .text("deck_hash", |code| code.files_hash(TaskKind::Stack))
    .means("SHA-256 of the deck of a stack")
    .shown("SHA-256 of the deck of a stack")
    .cell(|code| short(&code.files_hash(TaskKind::Stack)))
    .text("probe_hash", |code| code.files_hash(TaskKind::Motion))
    .means("SHA-256 of the deck of the micro-tests")
    .shown("of the micro-tests")
    .cell(|code| short(&code.files_hash(TaskKind::Motion)))
    .rows(Code::distinct(&all))
}
