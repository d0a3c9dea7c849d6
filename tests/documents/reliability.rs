//! docs/reliability.md says what the measurements in reference/reliability say. `bash .ci/reliability` makes both anew.

use serde_json::Value;
use std::fmt::Write;
use std::path::{Path, PathBuf};

const PAGE: &str = "docs/reliability.md";

fn in_project(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn measured(name: &str) -> Value {
    let path = in_project("reference/reliability").join(name);
    let text = std::fs::read_to_string(&path);
    let text = text.unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    serde_json::from_str(&text).expect("JSON")
}

fn list<'a>(value: &'a Value, key: &str) -> &'a [Value] {
    value[key].as_array().expect("a list")
}

fn text<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().expect("a text")
}

fn count(value: &Value, key: &str) -> u64 {
    value[key].as_u64().expect("a number")
}

fn total(values: &[Value], key: &str) -> u64 {
    values.iter().map(|value| count(value, key)).sum()
}

/// When and from which sources.
fn made(value: &Value) -> String {
    let commit = text(value, "commit");
    let day = &text(value, "date")[..10];
    format!("{day}, commit {}", &commit[..commit.len().min(12)])
}

const TOP: &str = "# What must not go wrong, and how it was tried

A crosscheck can take hours, on machines where programs are killed, disks fill up and files are damaged. That must not lose a
finished run, produce a wrong verdict, or leave processes and files behind, and the continued command must print the same
bytes as if nothing had happened. What is done for it: [store.md](store.md), and [ARCHITECTURE.md](../ARCHITECTURE.md), \"Nothing finished is lost\".

All numbers here are measured. `bash .ci/reliability` measures them again (some hours) and writes this page; `bash .ci/reliability
faults`, `fuzz` or `mutants` does so for one section. The lists of defects and the reasons why a mutant may survive are
written by hand.

Known to be left behind: a YADE that is killed leaves an empty directory `/tmp/yade-…`, whose place is fixed in its program. A
tristack that is killed leaves its temporary directory `/tmp/tristack-…` if it was a `simulate` without `--out` or had a store that can
only be read. What `bench`, `check`, `judge` and requests for a version leave is removed by the next tristack that needs such a directory.
";

fn faults_section(page: &mut String, faults: &Value) {
    let rows = list(faults, "faults");
    let (rounds, complaints) = (count(faults, "rounds"), total(rows, "complaints"));
    let (finished, after) = (total(rows, "finished_before"), total(rows, "made_after"));
    let live = total(rows, "real_codes");
    write!(
        page,
        "
## Faults

{rounds} rounds with {} faults at random moments (seed {}), complaints: {complaints}. Each round sets up a sweep of ten
runs, by a code that replays recorded runs or, in {live} of them, by native, LIGGGHTS, YADE or LAMMPS, lets the fault
strike, and then checks

* the printed rows: each is the undisturbed one, byte by byte, or does not agree;
* processes: none that worked in the store or its runs is still running;
* the store: every run that was reported as finished is there, and every file has its digest;
* the same command once more: it prints the undisturbed bytes, and makes no finished run again;
* temporary files, open sessions and run directories: only the evidence of failed runs is left.

{finished} runs were finished when the fault struck or in spite of it, {after} had to be made after it. A disturbed
code must not agree, and what is harmless (a daemon, ten gigabytes of output, a jump of the clock, a second
program) must change nothing.

The rounds with a *folder* test the folder of a code, as a user writes it for `--codes ./mydem`. While `crosscheck`, `check`, `probe` or
`simulate` asks it for its version, a micro-test or a stack, it hangs, writes beside its run directory and into its home, floods, leaves processes
behind, or gives another version each time; or its results in a plan are a named pipe, a link, the result of another run, or far too
long when `judge` reads them. Then only the undisturbed row may agree, the message names the folder, no process is left,
nothing outside of the store is touched or new except the directory of a failed run, and the same command gives the undisturbed
result once the folder behaves. Not prevented, and not tried: a program may write wherever its user may, by an absolute path.

| what goes wrong | fault | rounds | not replayed | struck in time | finished in spite of it | made after it | complaints | measured |
|---|---|---|---|---|---|---|---|---|
",
        rows.len(),
        count(faults, "seed"),
    )
    .expect("text");
    for row in rows {
        writeln!(
            page,
            "| {} | {} | {} | {} | {} | {} | {} | {} | {} |",
            text(row, "kind"),
            text(row, "fault"),
            count(row, "rounds"),
            count(row, "real_codes"),
            count(row, "struck"),
            count(row, "finished_before"),
            count(row, "made_after"),
            count(row, "complaints"),
            made(row)
        )
        .expect("text");
    }
    let found = std::fs::read_to_string(in_project("tests/fault_injection/findings.json"));
    let found: Value = serde_json::from_str(&found.expect("findings")).expect("JSON");
    findings_section(page, found.as_array().expect("a list"), "fault");
}

fn lies_section(page: &mut String, lies: &Value) {
    let rows = list(lies, "rows");
    write!(
        page,
        "
## Lying engines

{} rounds of engines that are honest in the probe and otherwise in the stack, or that write other numbers than they computed
(`tests/codes/lies/`): one alteration of a random kind and size, under the convention of native, LIGGGHTS, YADE or LAMMPS. None that
moves the yield force by more than 1.2 times the tolerance of its row agreed, and each check was the only one to notice some.
Theory gives how much an alteration moves the yield force.

The table has the resolution of the harness, for native at three stacks ({}): the smallest size, of six a decade, from which
on neither sign agrees, and how much of F + 3 it moves the yield force, beside the tolerance of the row. Sizes are
relative, except that those of arms are absolute, those of cylinder friction relative to b/a at the yield, and those of offsets and positions in units of the
load. An alteration that does not move the yield force may pass: it is no lie about it. One alteration passes although it moves the force by more than
the tolerance: a *static friction* that falls as soon as the floor slides leaves no trace in rows that are further apart than the
fall takes, and passes until it delays the slip by a row.

| altered | mu, stiffness | smallest size that is seen | moves F by, of F + 3 | tolerance |
|---|---|---|---|---|
",
        count(lies, "rounds"),
        made(lies),
    )
    .expect("text");
    for row in rows {
        let number = |key: &str| {
            let value = row[key].as_f64();
            value.map_or_else(|| "-".to_owned(), |value| format!("{value:.1e}"))
        };
        writeln!(
            page,
            "| {} | {:.3}, {} | {} | {} | {} |",
            text(row, "kind"),
            row["mu"].as_f64().expect("a number"),
            row["stiffness"],
            number("smallest"),
            number("moves"),
            number("tolerance"),
        )
        .expect("text");
    }
}

fn fuzz_section(page: &mut String, fuzz: &Value) {
    let rows = list(fuzz, "targets");
    write!(
        page,
        "
## Hostile input

{} executions of {} targets (`{}`; {}; sanitizer {}): no panic, no input that takes longer than is allowed, at most 2 GiB. What
must hold of each parser is in `tests/soundness/`, and proptest tries it in every run of the tests.

| target | what it reads | executions | seconds | allowed for one input, s | peak memory, MiB | measured |
|---|---|---|---|---|---|---|
",
        total(rows, "executions"),
        rows.len(),
        text(fuzz, "command"),
        text(fuzz, "toolchain"),
        text(fuzz, "sanitizer"),
    )
    .expect("text");
    for row in rows {
        writeln!(
            page,
            "| {} | {} | {} | {} | {} | {} | {} |",
            text(row, "target"),
            text(row, "what"),
            count(row, "executions"),
            row["seconds"],
            row["processor_seconds_at_most"],
            row["peak_memory_mib"],
            made(row)
        )
        .expect("text");
    }
    findings_section(page, list(fuzz, "findings"), "target");
}

/// Table of defects, the places where they showed, and the tests that guard against them.
fn findings_section(page: &mut String, findings: &[Value], place: &str) {
    writeln!(page, "\nFound on the way, and mended:\n").expect("text");
    for finding in findings {
        let (place, what, test) = (
            text(finding, place),
            text(finding, "what"),
            text(finding, "mended_by"),
        );
        let how = finding["found_by"].as_str();
        let how = how.map_or_else(String::new, |how| format!("found by {how}; "));
        writeln!(page, "* {place}: {what} ({how}`{test}`)").expect("text");
    }
}

fn mutants_section(page: &mut String, mutants: &Value) {
    let rows = list(mutants, "areas");
    write!(
        page,
        "
## Mutants

{} one-line changes of theory, contact law, extrapolation and verdict ({}; `{}`, cargo-mutants {}); {} survive the tests,
each for a reason that is given below. An unviable mutant does not compile; one that does not end counts as caught.

| area | mutants | caught | never end | unviable | survive | commit |
|---|---|---|---|---|---|---|
",
        total(rows, "mutants"),
        text(mutants, "date"),
        text(mutants, "command"),
        text(mutants, "cargo_mutants_version"),
        total(rows, "survived"),
    )
    .expect("text");
    for row in rows {
        writeln!(
            page,
            "| {} | {} | {} | {} | {} | {} | {} |",
            text(row, "area"),
            count(row, "mutants"),
            count(row, "caught"),
            count(row, "timeout"),
            count(row, "unviable"),
            count(row, "survived"),
            &text(row, "commit")[..12]
        )
        .expect("text");
    }
    writeln!(page, "\n| survivor | how many | why |\n|---|---|---|").expect("text");
    for survivor in list(mutants, "survivors") {
        let cell = |key| text(survivor, key).replace('|', "\\|").replace('\n', " ");
        let (mutant, reason) = (cell("mutant"), cell("reason"));
        writeln!(page, "| `{mutant}` | {} | {reason} |", alike(survivor)).expect("text");
    }
}

/// How many survivors there are of one name.
fn alike(survivor: &Value) -> u64 {
    survivor["count"].as_u64().unwrap_or(1)
}

fn page() -> String {
    let mut page = TOP.to_owned();
    faults_section(&mut page, &measured("faults.json"));
    lies_section(&mut page, &measured("lies.json"));
    fuzz_section(&mut page, &measured("fuzz.json"));
    mutants_section(&mut page, &measured("mutants.json"));
    page
}

#[test]
fn the_page_says_what_was_measured() {
    let path = in_project(PAGE);
    if std::env::var_os("TRISTACK_UPDATE_GOLDEN").is_some() {
        std::fs::write(&path, page()).expect("it can be written");
    }
    let written = std::fs::read_to_string(&path).expect("a page");
    assert!(
        written == page(),
        "remake it with: bash .ci/reliability page"
    );
}

/// The resolution that is promised: what moves the yield force by more than 1.2 tolerances is seen. The smallest size that is
/// seen lies at most one step of the sizes, a factor of 10^(1/6), above the one that would do.
#[test]
fn what_moves_the_yield_force_is_seen() {
    let lies = measured("lies.json");
    assert!(count(&lies, "rounds") >= 300);
    let step = 10f64.powf(1.0 / 6.0);
    for row in list(&lies, "rows") {
        let known = text(row, "kind") == "static friction";
        let moved = row["moves"].as_f64().unwrap_or(0.0);
        let tolerance = row["tolerance"].as_f64().expect("a number");
        assert!(known || moved <= 1.2 * step * tolerance, "{row}");
    }
}

/// Five hundred rounds are asked for, none of them in vain.
#[test]
fn every_round_struck_and_none_gave_cause_for_complaint() {
    let faults = measured("faults.json");
    let rows = list(&faults, "faults");
    assert!(count(&faults, "rounds") >= 500);
    for key in ["rounds", "struck"] {
        assert_eq!(total(rows, key), count(&faults, "rounds"), "{key}");
    }
    assert_eq!(total(rows, "complaints"), 0);
}

#[test]
fn every_parser_was_tried_a_million_times() {
    let fuzz = measured("fuzz.json");
    let targets = list(&fuzz, "targets");
    let parsers = [
        "case",
        "options",
        "claims",
        "series",
        "logs",
        "records",
        "checkpoints",
    ];
    for name in parsers {
        let target = targets.iter().find(|one| one["target"] == name);
        let executions = target.map_or(0, |target| count(target, "executions"));
        assert!(executions >= 1_000_000, "{name}: {executions}");
    }
}

#[test]
fn every_mutant_was_tried_and_every_survivor_has_a_reason() {
    let mutants = measured("mutants.json");
    let areas = list(&mutants, "areas");
    let ends = ["caught", "timeout", "unviable", "survived"];
    let ends = ends.map(|key| total(areas, key));
    assert_eq!(total(areas, "mutants"), ends.iter().sum::<u64>());
    let survivors = list(&mutants, "survivors");
    let explained: u64 = survivors.iter().map(alike).sum();
    assert_eq!(total(areas, "survived"), explained);
    for survivor in survivors {
        assert!(text(survivor, "reason").len() > 20, "{survivor}");
    }
}
