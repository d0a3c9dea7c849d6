//! A fake YADE that delivers finished series, so that the whole way from plan to verdict can be tested without
//! codes, and disturbed at will. Those of the quick profile are native ones, all others recorded.

use super::{Bench, recording};
use std::fs;
use std::path::Path;
use std::sync::LazyLock;
use tristack::code::{Code, ParameterFormat, Task};
use tristack::dem::{compress_stack, run_contact_test};
use tristack::model::{Case, ContactTest, Power, sha256_hex};
use tristack::series::{Motion, MotionRow, Series};
use tristack::study::yield_force::{Profile, plan};

fn yade() -> Code {
    Code::named("yade").expect("it is built in")
}

/// A change of the series of one case.
pub enum Disturbance {
    /// It is delivered as it is.
    None,
    /// It is delivered changed.
    Change(fn(String) -> String),
    /// Another series is delivered.
    Series(String),
    /// A shell command is executed instead.
    Instead(&'static str),
}

/// Installs the fake on `bench`; `disturb` decides for every run of the quick profile. Returns how many there
/// are.
pub fn install(bench: &Bench, disturb: impl Fn(&Case) -> Disturbance) -> usize {
    let replay = bench.path("replay");
    fs::create_dir_all(&replay).expect("a directory");
    for (case, series) in quick_profile() {
        install_run(&replay, case, series, disturb(case));
    }
    for (case, series) in recorded_series() {
        install_run(&replay, &case, &series, Disturbance::None);
    }
    install_probe(bench, |row| row);
    bench.install("yade", &script(&replay, ""));
    quick_profile().len()
}

/// Lets the fake know the runs of the rings of spheres that are recorded; returns how many there are.
pub fn install_rings(bench: &Bench) -> usize {
    let stacks = [3, 4].map(|bodies| Profile::Quick.stacks(Power::Linear, bodies));
    let settled = yade().as_declared().expect("nothing is left out");
    let plans = stacks.concat();
    let plans = plans
        .iter()
        .map(|stack| plan(&settled, stack, settled.convention()));
    let cases: Vec<Case> = plans.flat_map(|plan| plan.cases).collect();
    for case in &cases {
        let series = compress_stack(case, || true).expect("a finite series");
        install_run(
            &bench.path("replay"),
            case,
            &text(&series),
            Disturbance::None,
        );
    }
    cases.len()
}

/// Cases and series of the quick profile, by the native DEM with the contact convention of YADE.
fn quick_profile() -> &'static [(Case, String)] {
    static RUNS: LazyLock<Vec<(Case, String)>> = LazyLock::new(|| {
        let yade = yade().as_declared().expect("nothing is left out");
        let plans = Profile::Quick.measurements(&[yade]);
        let cases = plans.into_iter().flat_map(|plan| plan.cases);
        let runs = cases.map(|case| {
            let series = compress_stack(&case, || true).expect("a finite series");
            (case, text(&series))
        });
        runs.collect()
    });
    &RUNS
}

/// A case of the quick profile.
pub fn first_case() -> Case {
    quick_profile()[0].0
}

fn recorded_series() -> impl Iterator<Item = (Case, String)> {
    let runs = recording(&yade()).runs.into_iter();
    runs.filter_map(|run| Some((run.summary.case, text(&run.series?))))
}

fn text(series: &Series) -> String {
    String::from_utf8(series.to_csv()).expect("text")
}

/// Puts the run of `case` where the fake finds it.
fn install_run(replay: &Path, case: &Case, series: &str, disturbance: Disturbance) {
    let address = sha256_hex(ParameterFormat::Json.content(&case.parameters()).as_bytes());
    let write = |extension: &str, text: &str| {
        fs::write(replay.join(format!("{address}.{extension}")), text).expect("a file");
    };
    match disturbance {
        Disturbance::None => write("csv", series),
        Disturbance::Change(change) => write("csv", &change(series.to_owned())),
        Disturbance::Series(other) => write("csv", &other),
        Disturbance::Instead(command) => write("sh", command),
    }
}

/// The recorded answers to micro-tests, row by row as `change` makes them.
pub fn install_probe(bench: &Bench, change: fn(MotionRow) -> MotionRow) {
    let replay = bench.path("replay");
    let record = recording(&yade()).probe.expect("it is there");
    for answer in record.answers {
        let parameters = ParameterFormat::Json.content(&answer.test.parameters());
        let rows = answer.motion.rows().iter().map(|row| change(*row));
        let motion = Motion::new(rows.collect(), answer.test.steps).expect("as many rows");
        write_motion(&replay, &parameters, &motion);
    }
}

/// The fake with something to do after the last case.
pub fn install_with_ending(bench: &Bench, ending: &str) {
    install(bench, |_| Disturbance::None);
    bench.install("yade", &script(&bench.path("replay"), ending));
}

/// Puts the motion of `test`, by the native DEM, where the fake finds it when it is asked for `asked`.
pub fn install_motion_as(replay: &Path, asked: &ContactTest, test: &ContactTest) {
    let motion = run_contact_test(test).expect("a finite motion");
    let parameters = ParameterFormat::Json.content(&asked.parameters());
    write_motion(replay, &parameters, &motion);
}

fn write_motion(replay: &Path, parameters: &str, motion: &Motion) {
    let address = sha256_hex(parameters.as_bytes());
    let path = replay.join(format!("{address}.csv"));
    fs::write(path, motion.to_csv()).expect("a file");
}

/// The body of a shell script that replays what is in `replay`, and does something after the last case.
pub fn script(replay: &Path, ending: &str) -> String {
    let replay = replay.display();
    format!(
        r#"
if [ "$1" = --version ]; then echo "Yade version: replayed"; exit 0; fi
case $4 in probe.py|spheres_probe.py) result=probe.csv;; *) result=series.csv;; esac
shift 5
for directory in "$@"; do
    address=$(sha256sum "$directory/parameters.json" | cut -c 1-64)
    if [ -f "{replay}/$address.sh" ]; then . "{replay}/$address.sh"; continue; fi
    cp "{replay}/$address.csv" "$directory/$result.part" || exit 9
    mv "$directory/$result.part" "$directory/$result"
done
{ending}
"#
    )
}

/// Makes `folder` one with YADE under another name, which starts in less than a second,
/// and whose program is called mydem.
pub fn quick_folder(folder: &Path) -> String {
    fs::create_dir(folder).expect("a directory");
    let original = Path::new(env!("CARGO_MANIFEST_DIR")).join("yade_scripts");
    for entry in fs::read_dir(original).expect("a folder").flatten() {
        if entry.path().is_file() {
            fs::copy(entry.path(), folder.join(entry.file_name())).expect("a copy");
        }
    }
    let manifest = folder.join("code.toml");
    let mut text = fs::read_to_string(&manifest).expect("a manifest");
    for (from, to) in [
        ("name = \"yade\"", "name = \"mydem\""),
        ("[variants.yade", "[variants.mydem"),
        ("start = 1.5", "start = 0.5"),
        ("command = [\"yade\"", "command = [\"mydem\""),
    ] {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    fs::write(manifest, text).expect("it can be written");
    folder.display().to_string()
}

/// Installs on `bench` a program called mydem that does what the script `inside` says, whose path it puts together while
/// it runs: from outside the script is not seen.
pub fn install_wrapper(bench: &Bench, inside: &Path) {
    let which = bench.path("which.txt");
    fs::write(&which, format!("{}\n", inside.display())).expect("a choice");
    let script = format!("read inside < '{}'\n. \"$inside\"", which.display());
    bench.install("mydem", &script);
}
