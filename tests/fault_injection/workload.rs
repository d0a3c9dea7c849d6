//! The computations that faults disturb.

use super::common::Bench;
use super::common::replay::{self, Disturbance};
use super::folder_faults::Folders;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use tristack::code::{Code, ParameterFormat, Task};
use tristack::model::{Case, Stack, sha256_hex};
use tristack::study::yield_force::plan;

/// A sweep, and what comes out if nothing happens.
pub struct Workload {
    /// The arguments of tristack.
    pub line: String,
    pub cases: Vec<Case>,
    /// Expected output.
    pub expected: String,
    /// How long it takes.
    pub duration: Duration,
}

/// All there is to compute here.
pub struct Workloads {
    /// Holds the series that the replayed code delivers.
    shared: Bench,
    /// A code that delivers recorded series.
    pub replayed: Workload,
    /// The same code behind a wrapper that hides it.
    pub wrapped: Workload,
    /// Native, and the real codes that are installed.
    pub real: Vec<Workload>,
    /// A folder that is going to misbehave.
    pub folders: Folders,
}

impl Workloads {
    pub fn find() -> Self {
        let shared = Bench::with_system_programs();
        replay::install(&shared, |_| Disturbance::None);
        let place = Bench::with_system_programs();
        install(&place, &shared.path("replay"));
        let yade = Code::named("yade").expect("it is built in");
        let replayed = Workload::new(&place, yade.clone(), "yade", &[0.2, 0.3], 100.0);
        let folder = replay::quick_folder(&shared.path("folder"));
        let place = Bench::with_system_programs();
        install_wrapped(&place, &shared.path("replay"), "honest");
        let wrapped = Workload::new(&place, yade, &folder, &[0.2, 0.3], 100.0);
        let codes = [
            Code::named("liggghts").expect("it is built in"),
            Code::named("lammps").expect("it is built in"),
            Code::named("yade").expect("it is built in"),
        ];
        let mut real = vec![(Code::native(), 1e4)];
        let installed = codes.iter().filter(|code| code.find().is_some());
        real.extend(installed.map(|code| (code.clone(), 100.0)));
        let real = real.into_iter().map(|(code, stiffness)| {
            let place = Bench::with_system_programs();
            Workload::new(
                &place,
                code.clone(),
                code.as_str(),
                &[0.25, 0.35],
                stiffness,
            )
        });
        Self {
            real: real.collect(),
            shared,
            replayed,
            wrapped,
            folders: Folders::prepare(),
        }
    }

    /// The replayed code on `bench`; what the bench has of its own in `replay` is delivered first.
    pub fn install_replay(&self, bench: &Bench) {
        install(bench, &self.shared.path("replay"));
    }

    /// The wrapped code on `bench`, by the name of its insides; what the bench has in a directory of that name is
    /// delivered first.
    pub fn install_wrapped(&self, bench: &Bench, insides: &str) {
        install_wrapped(bench, &self.shared.path("replay"), insides);
    }

    /// The series that the replayed code delivers for `case`.
    pub fn series(&self, case: &Case) -> Vec<u8> {
        let path = self.shared.path("replay");
        std::fs::read(path.join(format!("{}.csv", address(case)))).expect("a series")
    }
}

/// The replayed code's name of a case.
pub fn address(case: &Case) -> String {
    sha256_hex(ParameterFormat::Json.content(&case.parameters()).as_bytes())
}

impl Workload {
    /// A sweep of `code` under the `name` that the command line gives it.
    fn new(place: &Bench, code: Code, name: &str, frictions: &[f64], stiffness: f64) -> Self {
        let [first, last] = [frictions[0], frictions[frictions.len() - 1]];
        let line = format!(
            "sweep --code {name} --mu {first}:{last}:0.1 --stiffness {stiffness} --format csv --jobs 2"
        );
        let cases = frictions.iter().flat_map(|&friction| {
            let stack = Stack::paper(friction, stiffness);
            let code = code.as_declared().expect("nothing is left out");
            plan(&code, &stack, code.convention()).cases
        });
        let start = Instant::now();
        let output = place.process(&line).output().expect("it runs");
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{message}");
        Self {
            line,
            cases: cases.collect(),
            expected: String::from_utf8(output.stdout).expect("text"),
            duration: start.elapsed(),
        }
    }
}

fn install(bench: &Bench, shared: &Path) {
    let own = bench.path("replay");
    std::fs::create_dir_all(&own).expect("a directory");
    bench.install("yade", &script(&own, shared));
}

fn install_wrapped(bench: &Bench, shared: &Path, insides: &str) {
    let own = bench.path(insides);
    std::fs::create_dir_all(&own).expect("a directory");
    let inside = own.with_extension("txt");
    std::fs::write(&inside, script(&own, shared)).expect("a script");
    replay::install_wrapper(bench, &inside);
}

/// A YADE that takes 80 ms a case, notes what it is asked, and delivers what it finds: in `own`, then in `shared`.
fn script(own: &Path, shared: &Path) -> String {
    let (own, shared) = (own.display(), shared.display());
    format!(
        r#"
if [ "$1" = --version ]; then echo "Yade version: replayed"; exit 0; fi
case $4 in probe.py|spheres_probe.py) result=probe.csv;; *) result=series.csv;; esac
shift 5
for directory in "$@"; do
    address=$(sha256sum "$directory/parameters.json" | cut -c 1-64)
    [ $result = probe.csv ] || {{ echo "$address" >> "{own}/asked"; sleep 0.08; }}
    source="{shared}/$address.csv"
    if [ -f "{own}/$address.csv" ]; then source="{own}/$address.csv"; fi
    if [ -f "{own}/$address.sh" ]; then . "{own}/$address.sh"; fi
    cp "$source" "$directory/$result.part" || exit 9
    mv "$directory/$result.part" "$directory/$result"
done
"#
    )
}

/// How often the replayed code on `bench` was asked for a series.
pub fn asked(bench: &Bench) -> Vec<String> {
    let path: PathBuf = bench.path("replay/asked");
    let text = std::fs::read_to_string(path).unwrap_or_default();
    text.lines().map(str::to_owned).collect()
}
