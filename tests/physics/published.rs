//! The authors' published data, read from a checkout of their repository, and reproduced by the native runs of their program.
//! The checkout is not part of the project: without it these tests look at nothing, unless TRISTACK_REQUIRE_PUBLISHED is set.

use crate::common::{
    AUTHORS_FORCE, Bench, assert_only, json_rows, released_program, small_checkout,
};
use std::path::{Path, PathBuf};
use tempfile::tempdir;
use tristack::dem::{LaneWidth, PublishedForces, PublishedRun};
use tristack::paper::published::{Checkout, PublishedForce, published_forces};

/// Wall speed in √(g r) from which on a run takes less than a second.
const FAST: f64 = 1e-3;

/// Where the checkout is looked for.
fn authors() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/authors")
}

fn checkout() -> Option<Checkout> {
    let place = authors();
    let required = std::env::var_os("TRISTACK_REQUIRE_PUBLISHED").is_some();
    assert!(
        required <= place.is_dir(),
        "{} is required",
        place.display()
    );
    place.is_dir().then(|| Checkout::read(&place).unwrap())
}

/// The forces with an origin that `choose` takes, each with what the run gives.
fn again(
    checkout: &Checkout,
    choose: impl Fn(&PublishedForce) -> bool,
) -> Vec<(PublishedForce, f64)> {
    let forces = published_forces(checkout).into_iter();
    let forces: Vec<PublishedForce> = forces.filter(choose).collect();
    let runs = forces
        .iter()
        .map(|force| force.origin.as_ref().unwrap().run);
    let runs: Vec<PublishedRun> = runs.collect();
    let (one, other) = runs.split_at(runs.len() / 2);
    let found = std::thread::scope(|scope| {
        let one = scope.spawn(move || yield_forces(one));
        let other = yield_forces(other);
        [one.join().unwrap(), other].concat()
    });
    forces.into_iter().zip(found).collect()
}

/// The yield force of every run, one by one: in tests the operations of lanes are calls.
fn yield_forces(runs: &[PublishedRun]) -> Vec<f64> {
    let mut found = vec![f64::NAN; runs.len()];
    let ended = |index: usize, forces: PublishedForces| {
        let stopped = forces.samples.last().copied();
        found[index] = stopped.or(forces.yield_force).unwrap();
    };
    LaneWidth::ONE.run_published(runs, || true, ended);
    found
}

fn is_fast(force: &PublishedForce) -> bool {
    let origin = force.origin.as_ref();
    origin.is_some_and(|origin| origin.wall_speed >= FAST && origin.time_step >= 1e-4)
}

#[test]
fn published_forces_are_reproduced_to_their_digits() {
    let Some(checkout) = checkout() else { return };
    let rows = again(&checkout, is_fast);
    let mut printed = 0;
    for (force, found) in &rows {
        let left = (found - force.value.value) / (force.value.value + 3.0);
        printed += usize::from(force.value.is(*found));
        println!(
            "{} {} {} {} {found:.6} {left:+.1e}",
            force.file, force.line, force.stack.floor_friction, force.value.value
        );
        assert!(
            left.abs() < 3e-6,
            "{} line {}: {found}",
            force.file,
            force.line
        );
    }
    println!("{printed} of {}", rows.len());
    assert!(printed >= rows.len() / 2);
}

#[test]
fn the_curve_of_the_later_version_is_reproduced_in_every_digit() {
    if checkout().is_none() {
        return;
    }
    let place = tempdir().unwrap();
    let copied = [
        ("later/figures/fig2b/data", "figures/fig2b/data"),
        ("later/figures/fig2a/data", "figures/fig2a/data"),
        ("src/init", "src/init"),
    ];
    for (from, to) in copied {
        let to = place.path().join(to);
        std::fs::create_dir_all(&to).unwrap();
        for file in std::fs::read_dir(authors().join(from)).unwrap() {
            let file = file.unwrap();
            std::fs::copy(file.path(), to.join(file.file_name())).unwrap();
        }
    }
    let checkout = Checkout::read(place.path()).unwrap();
    let rows = again(&checkout, |force| force.figure() == "fig2b");
    assert_eq!(rows.len(), 19);
    for (force, found) in &rows {
        assert!(
            force.value.is(*found),
            "{} line {}: {found}",
            force.file,
            force.line
        );
    }
    let stopped = rows.iter().filter(|(force, _)| {
        let limit = force.limit.unwrap();
        force.value.value < limit && force.origin.as_ref().unwrap().end_time == Some(500.0)
    });
    assert_eq!(stopped.count(), 10);
}

#[test]
fn anything_else_is_refused_by_what_it_lacks() {
    let place = tempdir().unwrap();
    let error = Checkout::read(place.path()).unwrap_err().to_string();
    assert!(error.contains("figures/fig2a/data"), "{error}");
    let data = place.path().join("figures/fig2a/data");
    std::fs::create_dir_all(&data).unwrap();
    std::fs::write(data.join("k1e+2.txt"), "# head\n0.1 0.161201\n0.2 none\n").unwrap();
    let error = Checkout::read(place.path()).unwrap_err().to_string();
    assert!(
        error.contains("line 3") && error.contains("none"),
        "{error}"
    );
}

#[test]
fn a_file_is_read_with_its_head_its_lines_and_its_digits() {
    let place = tempdir().unwrap();
    let data = place.path().join("fig2b/data");
    std::fs::create_dir_all(&data).unwrap();
    std::fs::create_dir_all(place.path().join("fig2a/data")).unwrap();
    std::fs::write(data.join("mu0.33.txt"), "# Parameter: 0.3\n\n100 41.486832").unwrap();
    std::fs::write(data.join("load.plt"), "plot").unwrap();
    let checkout = Checkout::read(place.path()).unwrap();
    let [file] = &checkout.files[..] else {
        panic!("{:?}", checkout.files)
    };
    assert_eq!(file.head, ["Parameter: 0.3"]);
    let [(line, [_, force])] = file.rows[..] else {
        panic!("{file:?}")
    };
    assert_eq!((line, force.decimals), (3, 6));
    assert!(force.is(41.486_832_4) && !force.is(41.486_833));
    let [force] = &published_forces(&checkout)[..] else {
        panic!("one force")
    };
    assert_eq!(
        (force.stack.floor_friction, force.stack.stiffness),
        (0.33, 100.0)
    );
    assert_eq!(force.origin, None);
}

fn table(bench: &Bench) -> serde_json::Value {
    let text = std::fs::read_to_string(bench.path("out/published.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

#[test]
fn the_command_reproduces_a_checkout_and_names_what_differs() {
    let bench = Bench::without_codes();
    let command = "crosscheck --profile published --published repository --out out";
    small_checkout(&bench.path("repository"), "31.000000");
    let wrong = bench.tristack(command).output().unwrap();
    assert_eq!(wrong.status.code(), Some(2), "{wrong:?}");
    let tables = table(&bench);
    let row = &tables["tables"][0]["rows"][0];
    assert_eq!(row["fit"], "differs");
    assert_eq!(row["wall_speed"], 1e-3);
    let head = &tables["tables"][2]["rows"];
    let heads = head.as_array().unwrap().iter();
    let mut heads = heads.filter(|row| row["second"] == 1e3);
    assert_eq!(heads.next().unwrap()["first"], 1e2);
    small_checkout(&bench.path("repository"), AUTHORS_FORCE);
    let right = bench.tristack(command).output().unwrap();
    assert_eq!(right.status.code(), Some(0), "{right:?}");
    let row = &table(&bench)["tables"][0]["rows"][0];
    assert_eq!(row["fit"], "every-digit");
    let files = [
        "contradictions.csv",
        "published.csv",
        "published.json",
        "published.md",
        "published_files.csv",
        "published_series.csv",
    ];
    assert_only(&bench.path("out"), &files);
}

#[test]
fn the_published_profile_asks_for_its_checkout_and_for_no_other_code() {
    let bench = Bench::without_codes();
    let said = |command: &str| {
        let output = bench.tristack(command).output().unwrap();
        assert!(!output.status.success(), "{output:?}");
        String::from_utf8(output.stderr).unwrap()
    };
    let crosscheck = "crosscheck --profile published";
    assert!(said(crosscheck).contains("--published DIR"));
    let published = format!("{crosscheck} --published .");
    assert!(said(&published).contains("figures/fig2a/data"));
    assert!(said(&format!("{published} --codes native,yade")).contains("yade"));
    assert!(said(&format!("{published} --mu 0.3")).contains("--mu"));
    assert!(said("time --profile published").contains(crosscheck));
}

/// Everything, which takes minutes even for a released program.
#[test]
fn the_released_program_reproduces_every_published_number() {
    let (Some(program), Some(_)) = (released_program(), checkout()) else {
        return;
    };
    let place = tempdir().unwrap();
    let output = std::process::Command::new(&program)
        .args(["crosscheck", "--profile", "published", "--published"])
        .arg(authors())
        .args(["--format", "json", "--store"])
        .arg(place.path().join("store"))
        .output()
        .unwrap();
    assert!(output.status.success(), "{output:?}");
    let tables: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let rows = |table: usize| tables["tables"][table]["rows"].as_array().unwrap();
    let fits = |fit: &str| rows(0).iter().filter(|row| row["fit"] == fit).count();
    let (every_digit, alike) = (fits("every-digit"), fits("alike"));
    println!(
        "{every_digit} of {} in every digit, {alike} alike",
        rows(0).len()
    );
    assert_eq!(every_digit + alike, rows(0).len());
    assert!(every_digit > 2 * alike);
    assert_eq!(rows(1)[0]["fit"], "alike");
    // The report finds these runs in the store, and makes its own.
    let output = std::process::Command::new(&program)
        .args(["report", "--codes", "native", "--published"])
        .arg(authors())
        .arg("--store")
        .arg(place.path().join("store"))
        .arg("--out")
        .arg(place.path().join("report"))
        .output()
        .unwrap();
    assert!(output.status.success(), "{output:?}");
    let claims = std::fs::read(place.path().join("report/claims.json")).unwrap();
    let claims: serde_json::Value = serde_json::from_slice(&claims).unwrap();
    let claims = claims["rows"].as_array().unwrap().iter();
    let second = claims.filter_map(|row| {
        let verdict = row["published_verdict"].as_str()?;
        Some((row["id"].as_str().unwrap(), verdict))
    });
    let second: Vec<(&str, &str)> = second.collect();
    let expected = [
        ("force-series", "holds"),
        ("dem-agrees", "approximately"),
        ("dem-approaches-rigid", "approximately"),
        ("dem-scales", "approximately"),
        ("peak-definition", "holds"),
        ("converges-with-speed", "holds"),
        ("compression-speed", "holds"),
        ("time-step", "holds"),
    ];
    assert_eq!(second, expected);
}

const GIVEN: &str = include_str!("../../examples/cases/given/authors.toml");

/// What `simulate` says of a case with a start.
fn simulated(bench: &Bench, case: &str, more: &str) -> std::process::Output {
    std::fs::write(bench.path("given.toml"), case).unwrap();
    let line = format!("simulate --case given.toml {more}");
    bench.tristack(&line).output().unwrap()
}

#[test]
fn a_case_with_a_start_is_run_as_their_program_runs() {
    let bench = Bench::without_codes();
    let output = simulated(&bench, GIVEN, "--code native --format json");
    assert!(output.status.success(), "{output:?}");
    let row = &json_rows(std::str::from_utf8(&output.stdout).unwrap())[0];
    let force = row["yield_force"].as_f64().unwrap();
    assert_eq!(format!("{force:.6}"), AUTHORS_FORCE);
    assert!(row["excess"].as_f64().unwrap() > 0.0);
    let until = |end: &str| GIVEN.replace("# end_time = 60.0", end);
    let with_rows = until("end_time = 900.0").replace("# interval = 0.1", "interval = 0.5");
    let output = simulated(&bench, &with_rows, "--code native --out out");
    assert!(output.status.success(), "{output:?}");
    assert_only(&bench.path("out"), &["series.csv", "summary.json"]);
    let rows = std::fs::read_to_string(bench.path("out/series.csv")).unwrap();
    let rows = rows.lines().skip(1).map(|line| {
        let (time, force) = line.split_once(',').unwrap();
        (time.parse().unwrap(), force.parse().unwrap())
    });
    let rows: Vec<(f64, f64)> = rows.collect();
    assert_eq!((rows.len(), rows[0]), (1801, (0.0, 0.0)));
    assert_eq!(rows[1800].0, 900.0);
    // Half a time unit before and after the peak, which the run goes beyond.
    let highest = rows.iter().map(|row| row.1).fold(0.0, f64::max);
    assert!(highest < force && highest > 0.99 * force, "{highest}");
    // The wall has not reached far enough.
    let output = simulated(
        &bench,
        &until("end_time = 20.0"),
        "--code native --format json",
    );
    let tables: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let [run, series] = [0, 1].map(|table| &tables["tables"][table]["rows"]);
    assert!(run[0].is_object() && run[0]["yield_force"].is_null());
    assert_eq!(series[0]["time"], 20.0);
}

#[test]
fn what_a_case_with_a_start_cannot_have_is_named() {
    let bench = Bench::without_codes();
    let refused = |case: &str, more: &str, parts: &[&str]| {
        let output = simulated(&bench, case, more);
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(
            parts.iter().all(|part| said.contains(part)),
            "{parts:?}: {said}"
        );
    };
    let native = "--code native";
    refused(GIVEN, "--code yade", &["--code", "yade", "native"]);
    refused(GIVEN, "--code native --svg a.svg", &["--svg", "a.svg"]);
    refused(
        GIVEN,
        "--code native --time-limit 5",
        &["--time-limit", "5"],
    );
    for (from, to, parts) in [
        (
            "time_step = 1e-3",
            "time_step = 1.0",
            ["time_step", "at most"],
        ),
        (
            "wall_speed = 1e-3",
            "wall_speed = 0",
            ["wall_speed", "above 0"],
        ),
        (
            "# interval = 0.1",
            "interval = 0.1",
            ["interval", "end_time"],
        ),
        (
            "restitution = 0.3",
            "restitution = 0",
            ["`restitution`", "from"],
        ),
        ("mu = 0.3", "mu = 0.3\nbodies = 3", ["stack.bodies", "2"]),
        (
            "[-1.0, 1.0, 0.0]]",
            "[-1.0, nan, 0.0]]",
            ["start.places", "-10"],
        ),
        ("wall_speed", "wall_sped", ["wall_sped", "wall_speed"]),
    ] {
        let case = GIVEN.replacen(from, to, 1);
        assert_ne!(case, GIVEN);
        refused(&case, native, &[&parts[..], &["given.toml"]].concat());
    }
}

#[test]
fn rows_that_no_run_can_have_are_shown_and_not_run() {
    let bench = Bench::without_codes();
    small_checkout(&bench.path("repository"), AUTHORS_FORCE);
    let figure = |name: &str, file: &str, rows: &str| {
        let data = bench.path("repository").join(name).join("data");
        std::fs::create_dir_all(&data).unwrap();
        std::fs::write(data.join(file), rows).unwrap();
    };
    figure("figS3a", "dt.txt", "0 5.2\n-1 5.2\n");
    figure("figS3b", "vwall.txt", "0 5.2\n");
    figure("fig2a", "k0.txt", "-0.3 5.2\n");
    let command = "crosscheck --profile published --published repository --out out";
    let output = bench.tristack(command).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let tables = table(&bench);
    let rows = tables["tables"][0]["rows"].as_array().unwrap();
    let unknown = rows.iter().filter(|row| row["fit"] == "unknown");
    assert_eq!((rows.len(), unknown.count()), (5, 4));
}
