//! A fake YADE that replays recorded runs, so that the whole way from plan to verdict can be tested
//! without codes, and disturbed at will.

use super::Bench;
use std::fs;
use std::path::Path;
use tristack::code::{ParameterFormat, Task};
use tristack::model::{Case, sha256_hex};
use tristack::runs::ProbeRecord;
use tristack::series::MotionRow;

/// What happens to the recorded series of one case.
pub enum Disturbance {
    /// It is delivered as it was recorded.
    None,
    /// It is delivered changed.
    Change(fn(String) -> String),
    /// Another series is delivered.
    Series(String),
    /// A shell command is executed instead.
    Instead(&'static str),
}

/// Installs the fake on `bench`; `disturb` decides for every recorded run of the crosscheck. Returns how many
/// there are.
pub fn install(bench: &Bench, disturb: impl Fn(&Case) -> Disturbance) -> usize {
    let replay = bench.path("replay");
    fs::create_dir_all(&replay).expect("a directory");
    let count = install_runs(&replay, "reference/yade", disturb);
    install_runs(&replay, "reference/trajectories/yade", |_| {
        Disturbance::None
    });
    install_probe(bench, |row| row);
    bench.install("yade", &script(&replay, ""));
    count
}

/// The runs recorded in one directory, as `disturb` makes them. Returns how many there are.
fn install_runs(replay: &Path, recorded: &str, disturb: impl Fn(&Case) -> Disturbance) -> usize {
    let recorded = Path::new(env!("CARGO_MANIFEST_DIR")).join(recorded);
    let mut count = 0;
    for entry in fs::read_dir(recorded).expect("recorded runs").flatten() {
        let case = Case::read(&entry.path().join("case.json")).expect("a case");
        let series = fs::read_to_string(entry.path().join("series.csv")).expect("a series");
        let address = sha256_hex(ParameterFormat::Json.content(&case.parameters()).as_bytes());
        let write = |extension: &str, text: &str| {
            fs::write(replay.join(format!("{address}.{extension}")), text).expect("a file");
        };
        match disturb(&case) {
            Disturbance::None => write("csv", &series),
            Disturbance::Change(change) => write("csv", &change(series)),
            Disturbance::Series(other) => write("csv", &other),
            Disturbance::Instead(command) => write("sh", command),
        }
        count += 1;
    }
    count
}

/// The recorded answers to micro-tests, row by row as `change` makes them.
pub fn install_probe(bench: &Bench, change: fn(MotionRow) -> MotionRow) {
    let replay = bench.path("replay");
    let recorded = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference/probes/yade.json");
    let record = ProbeRecord::load(&recorded)
        .expect("a record")
        .expect("it is there");
    for answer in record.answers {
        let parameters = ParameterFormat::Json.content(&answer.test.parameters());
        let address = sha256_hex(parameters.as_bytes());
        let mut writer =
            csv::Writer::from_path(replay.join(format!("{address}.csv"))).expect("a file");
        for row in answer.motion.rows() {
            writer.serialize(change(*row)).expect("a row");
        }
    }
}

/// The fake with something to do after the last case.
pub fn install_with_ending(bench: &Bench, ending: &str) {
    install(bench, |_| Disturbance::None);
    bench.install("yade", &script(&bench.path("replay"), ending));
}

fn script(replay: &Path, ending: &str) -> String {
    let replay = replay.display();
    format!(
        r#"
if [ "$1" = --version ]; then echo "Yade version: replayed"; exit 0; fi
case $4 in probe.py) result=probe.csv;; *) result=series.csv;; esac
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
