//! The same bits everywhere: one stack at a time or many in a vector, on one core or two, unoptimised or released.
//!
//! `TRISTACK_RELEASE` names a released program that is to be looked at too. After a change of the bits that is
//! meant, `TRISTACK_UPDATE_GOLDEN=1 cargo test --test physics determinism` writes them anew.

use crate::common::{Bench, OWN_PROGRAM, released_program};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use tristack::code::SettledCode;
use tristack::dem::compress_stack;
use tristack::model::{Case, ContactConvention, sha256_hex};
use tristack::runs::read_entry;
use tristack::study::yield_force::{Profile, plan};

const GOLDEN: &str = "reference/golden/native_series.sha256";

fn in_project(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn programs() -> Vec<PathBuf> {
    let own = PathBuf::from(OWN_PROGRAM);
    std::iter::once(own).chain(released_program()).collect()
}

/// Digest of the series of every case, by the digest of the case.
type Digests = BTreeMap<String, String>;

fn golden() -> Digests {
    let text = fs::read_to_string(in_project(GOLDEN)).expect("golden digests");
    let lines = text.lines().filter_map(|line| line.split_once("  "));
    lines
        .map(|(series, case)| (case.to_owned(), series.to_owned()))
        .collect()
}

/// The runs of the quick profile with the paper's springs, and those of its stacks with springs that turn.
fn cases() -> Vec<Case> {
    let fixed = Profile::Quick.measurements(&[SettledCode::native()]);
    let stacks = fixed.iter().map(|one| one.stack);
    let turning =
        stacks.map(|stack| plan(&SettledCode::native(), &stack, ContactConvention::TURNING));
    let turning: Vec<_> = turning.collect();
    let cases = fixed.into_iter().chain(turning).flat_map(|one| one.cases);
    cases.collect()
}

fn assert_golden(digests: &Digests, how: &str) {
    let golden = golden();
    assert_eq!(digests.len(), golden.len(), "{how}");
    let different = golden
        .iter()
        .filter(|(case, series)| digests.get(*case) != Some(series));
    assert_eq!(different.count(), 0, "series with other bits, {how}");
}

#[test]
fn one_stack_at_a_time_has_the_golden_bits() {
    let digests: Digests = cases()
        .iter()
        .map(|case| {
            let series = compress_stack(case, || true).expect("a finite series");
            (case.content_hash(), sha256_hex(&series.to_csv()))
        })
        .collect();
    if std::env::var_os("TRISTACK_UPDATE_GOLDEN").is_some() {
        let lines = digests
            .iter()
            .map(|(case, series)| format!("{series}  {case}\n"));
        fs::write(in_project(GOLDEN), lines.collect::<String>()).expect("it can be written");
    }
    assert_golden(&digests, "one at a time");
}

/// The stacks of the quick profile with springs that turn.
const TURNING: &str = "sweep --code native --history-update rotated --mu 0.12,0.2,0.25,critical,0.3,0.4 \
                       --stiffness 1e2,1e3,1e4";

/// The digests of what is in the store of `bench`.
fn stored(bench: &Bench) -> Digests {
    let root = bench.path("store/runs");
    let mut digests = Digests::new();
    for group in fs::read_dir(&root).expect("runs").flatten() {
        for entry in fs::read_dir(group.path()).expect("runs").flatten() {
            let run = read_entry(&entry.path()).expect("whole").expect("there");
            digests.insert(run.case.content_hash(), sha256_hex(&run.series.to_csv()));
        }
    }
    digests
}

#[test]
fn many_in_a_vector_have_the_golden_bits_on_one_core_and_on_two_in_every_build() {
    let mut tables = Vec::new();
    for program in programs() {
        for jobs in [1, 2] {
            let bench = Bench::without_codes();
            let how = format!("{} on {jobs} cores", program.display());
            let both = ["crosscheck --codes native", TURNING].map(|line| {
                let line = format!("{line} --format csv --jobs {jobs}");
                let output = bench.process_of(&program, &line).output().expect("it runs");
                assert_eq!(output.status.code(), Some(0), "{line}: {how}");
                output.stdout
            });
            assert_golden(&stored(&bench), &how);
            tables.push(both);
        }
    }
    assert!(tables.iter().all(|table| *table == tables[0]));
}

/// Operations whose results may depend on the compiler, the allocator or the scheduler.
const UNORDERED_OR_FUSED: [&str; 9] = [
    "mul_add",
    ".sum()",
    ".sum::<",
    ".product()",
    "par_iter",
    "rayon",
    "HashMap",
    "HashSet",
    "algebraic",
];

fn sources(directory: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(directory).expect("a directory").flatten();
    let found = entries.flat_map(|entry| match entry.path() {
        path if path.is_dir() => sources(&path),
        path => vec![path],
    });
    found.collect()
}

#[test]
fn the_sources_of_the_stepping_fuse_nothing_and_sum_in_order() {
    let files = sources(&in_project("crates/dem/src/dem"));
    assert!(files.len() > 20);
    for file in files {
        let text = fs::read_to_string(&file).expect("a source");
        for word in UNORDERED_OR_FUSED {
            assert!(!text.contains(word), "{} has {word}", file.display());
        }
    }
}

/// Instructions that round once where the source rounds twice, or that only approximate.
fn is_fused_or_approximate(instruction: &str) -> bool {
    [
        "vfm", "vfnm", "fmadd", "fmsub", "fnmadd", "vrcp", "rcpps", "rcpss", "vrsqrt", "rsqrtps",
        "rsqrtss",
    ]
    .iter()
    .any(|start| instruction.starts_with(start))
}

#[test]
fn the_compiled_stepping_fuses_nothing_and_approximates_nothing() {
    for program in programs() {
        let mut command = Command::new("objdump");
        command.args(["--disassemble", "--demangle", "--no-show-raw-insn"]);
        let output = command.arg(&program).output().expect("objdump runs");
        assert!(output.status.success());
        let text = String::from_utf8_lossy(&output.stdout);
        let (mut stepping, mut instructions, mut vectors) = (false, 0, 0);
        for line in text.lines() {
            if line.ends_with(">:") {
                // Vector code is compiled into the function of pulp that switches the instructions on.
                stepping = line.contains("tristack_dem::dem::") || line.contains("::vectorize::");
            } else if let Some((_, instruction)) = line.split_once(":\t") {
                let name = instruction.split_whitespace().next().unwrap_or_default();
                if stepping {
                    instructions += 1;
                    vectors += usize::from(instruction.contains("%zmm") && name == "vmulpd");
                    let place = program.display();
                    assert!(!is_fused_or_approximate(name), "{instruction} in {place}");
                }
            }
        }
        println!("{instructions} instructions, {vectors} multiplications of eight");
        assert!(instructions > 10_000);
        // Where every operation on vectors is a call, none of them is in sight.
        let released = program != Path::new(OWN_PROGRAM);
        if released && cfg!(target_arch = "x86_64") {
            assert!(vectors > 100, "{vectors} multiplications of eight");
        }
    }
}
