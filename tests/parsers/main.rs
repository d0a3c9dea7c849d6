//! Parsers of everything that comes from outside, under arbitrary and under slightly damaged input: they never
//! panic, and everything that they accept is sound. tests/soundness/ defines soundness, one file a family, also for
//! the long runs of tests/fuzz/run.

#[path = "../common/mod.rs"]
mod common;
mod findings;
#[allow(dead_code)] // The targets of cargo-fuzz use the rest.
#[path = "../soundness/mod.rs"]
mod soundness;

use proptest::prelude::*;
use proptest::sample::{Index, select};

/// A change of a valid input.
#[derive(Debug, Clone)]
enum Change {
    Flip(Index, u8),
    Cut(Index),
    Duplicate(Index, Index),
    Insert(Index, &'static str),
    Bytes(Index, Vec<u8>),
    /// A number is replaced.
    Number(Index, &'static str),
}

/// Extreme numbers, and tokens with a meaning for a parser.
const TOKENS: [&str; 20] = [
    "1e308",
    "-1e308",
    "1e309",
    "-0",
    "0",
    "NaN",
    "nan",
    "inf",
    "-inf",
    "5e-324",
    "null",
    "1e12",
    "18446744073709551615",
    "18446744073709551616",
    "-1",
    "0x1F",
    "\"",
    "\n",
    ",",
    "{",
];

fn change() -> impl Strategy<Value = Change> {
    let index = any::<Index>;
    prop_oneof![
        1 => (index(), any::<u8>()).prop_map(|(at, byte)| Change::Flip(at, byte)),
        1 => index().prop_map(Change::Cut),
        1 => (index(), index()).prop_map(|(from, to)| Change::Duplicate(from, to)),
        1 => (index(), select(&TOKENS[..])).prop_map(|(at, token)| Change::Insert(at, token)),
        1 => (index(), prop::collection::vec(any::<u8>(), 1..8))
            .prop_map(|(at, bytes)| Change::Bytes(at, bytes)),
        4 => (index(), select(&TOKENS[..])).prop_map(|(at, token)| Change::Number(at, token)),
    ]
}

impl Change {
    fn apply(&self, input: &mut Vec<u8>) {
        let place = |index: &Index, input: &[u8]| index.index(input.len() + 1);
        match self {
            Self::Flip(at, byte) if !input.is_empty() => {
                let at = at.index(input.len());
                input[at] ^= byte;
            }
            Self::Flip(..) => {}
            Self::Cut(at) => input.truncate(place(at, input)),
            Self::Duplicate(from, to) => {
                let (from, to) = (place(from, input), place(to, input));
                let part = input[from.min(to)..from.max(to)].to_vec();
                input.splice(to..to, part);
            }
            Self::Insert(at, token) => insert(input, place(at, input), token.as_bytes()),
            Self::Bytes(at, bytes) => insert(input, place(at, input), bytes),
            Self::Number(at, token) => {
                let numbers = numbers(input);
                if !numbers.is_empty() {
                    let number = numbers[at.index(numbers.len())].clone();
                    input.splice(number, token.bytes());
                }
            }
        }
    }
}

fn insert(input: &mut Vec<u8>, at: usize, bytes: &[u8]) {
    input.splice(at..at, bytes.iter().copied());
}

/// Where numbers stand in `input`.
fn numbers(input: &[u8]) -> Vec<std::ops::Range<usize>> {
    let is_part = |byte: &u8| byte.is_ascii_digit() || b"+-.eE".contains(byte);
    let mut numbers = Vec::new();
    let mut start = 0;
    for part in input.chunk_by(|one, other| is_part(one) == is_part(other)) {
        if is_part(&part[0]) && part.iter().any(u8::is_ascii_digit) {
            numbers.push(start..start + part.len());
        }
        start += part.len();
    }
    numbers
}

/// Holds `target` against arbitrary bytes and text, and against its seeds, changed.
fn hold(target: &str, cases: u32) {
    let found = soundness::TARGETS.iter().find(|(name, ..)| *name == target);
    let (_, check, seeds) = found.expect("a target of that name");
    let seeds: Vec<Vec<u8>> = seeds().into_iter().map(|(_, input)| input).collect();
    seeds.iter().for_each(|seed| check(seed));
    let changed =
        (select(seeds), prop::collection::vec(change(), 0..4)).prop_map(|(seed, changes)| {
            let mut input = seed;
            changes.iter().for_each(|change| change.apply(&mut input));
            input
        });
    let input = prop_oneof![
        1 => prop::collection::vec(any::<u8>(), 0..200),
        1 => any::<(u8, String)>().prop_map(|(kind, text)| [&[kind], text.as_bytes()].concat()),
        6 => changed,
    ];
    let config = ProptestConfig {
        cases,
        failure_persistence: None,
        ..ProptestConfig::default()
    };
    proptest!(config, |(input in input)| check(&input));
}

#[test]
fn case_files_are_refused_or_sound() {
    hold("case", 2000);
}

#[test]
fn command_lines_are_refused_or_understood() {
    hold("options", 500);
}

#[test]
fn registers_of_claims_are_refused_or_sound() {
    hold("claims", 1000);
}

#[test]
fn series_are_refused_or_finite_and_as_planned() {
    hold("series", 1000);
}

#[test]
fn logs_are_refused_or_hold_what_was_asked_for() {
    hold("logs", 1000);
}

#[test]
fn records_are_refused_or_give_themselves_back() {
    hold("records", 1000);
}

#[test]
fn no_motion_makes_the_probe_panic() {
    hold("probes", 100);
}

#[test]
fn checkpoints_are_refused_or_can_be_taken_up() {
    hold("checkpoints", 300);
}

#[test]
fn no_accepted_stack_makes_a_theory_panic() {
    hold("stacks", 300);
}

#[test]
fn no_accepted_experiment_makes_a_forecast_panic() {
    hold("forecasts", 100);
}

#[test]
fn plans_are_refused_or_name_runs_inside_of_their_directory() {
    hold("plans", 500);
}

#[test]
fn manifests_are_refused_or_read_the_same_twice() {
    hold("manifests", 1000);
}

#[test]
fn renamed_columns_are_refused_or_finite_and_as_planned() {
    hold("columns", 1000);
}
