//! Folders of codes that misbehave, through every command that starts a code or reads what it wrote.
//!
//! The folder is the Python example behind a shell script, which answers from a cache where it can: so a round takes
//! no longer than its misbehaviour.

use super::common::away::{native_result, result_of};
use super::common::{Bench, code_folder};
use super::fault::FolderFault as F;
use super::misbehaviour::{command, leave, may_pass};
use super::processes;
use super::round::{Story, finished_runs, is_running, is_whole};
use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Output, Stdio};
use std::time::{Duration, Instant};
use tristack::code::{PlannedRun, PlannedTask};
use tristack::model::sha256_hex;
use tristack::study::Plan;

/// One stack, five runs.
const STACK: &str = "--mu 0.3 --stiffness 100";
/// Ends a program that would never end; nothing is measured by it.
const FOR_EVER: Duration = Duration::from_secs(600);
/// A code that hangs is given so many seconds.
const PATIENCE: &str = "--time-limit 2";

/// A way through which a folder comes in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Door {
    Crosscheck,
    Check,
    Probe,
    Simulate,
    PlanAndJudge,
}

const DOORS: [Door; 5] = [
    Door::Crosscheck,
    Door::Check,
    Door::Probe,
    Door::Simulate,
    Door::PlanAndJudge,
];

impl Door {
    fn line(self) -> String {
        match self {
            Self::Crosscheck => format!("crosscheck --codes ./mydem {STACK} --format csv --jobs 2"),
            Self::Check => "check ./mydem --format json".to_owned(),
            Self::Probe => "probe --codes ./mydem --format csv".to_owned(),
            Self::Simulate => format!("simulate --code ./mydem {STACK} --format csv"),
            Self::PlanAndJudge => "judge away --format csv".to_owned(),
        }
    }

    /// What the code is asked for on the way: its version, micro-tests, stacks.
    fn stages(self) -> &'static [&'static str] {
        match self {
            Self::Crosscheck | Self::Check => &["version", "motion", "stack", "stack"],
            Self::Probe => &["version", "motion", "motion"],
            Self::Simulate => &["version", "stack", "stack"],
            Self::PlanAndJudge => &["stack", "motion"],
        }
    }
}

/// The folder as it should be, what it answers, and what every command prints of it.
pub struct Folders {
    place: Bench,
    honest: Vec<(Door, String)>,
}

impl Folders {
    /// Fills the cache and remembers what an undisturbed folder gives.
    pub fn prepare() -> Self {
        let place = Bench::with_system_programs();
        fs::create_dir(place.path("cache")).expect("a directory");
        let mut folders = Self {
            place,
            honest: Vec::new(),
        };
        let bench = folders.bench();
        for _ in 0..2 {
            for run in &folders.planned(&bench).runs {
                let task = bench.path("away").join(&run.directory).join("task.json");
                let address = sha256_hex(&fs::read(task).expect("a task"));
                let answer = folders.cache().join(format!("{address}.csv"));
                fs::write(answer, native_result(run)).expect("an answer");
            }
        }
        for door in DOORS {
            let bench = folders.bench();
            if door == Door::PlanAndJudge {
                folders.fill(&bench);
            }
            let output = run(&bench, &door.line()).expect("it ends");
            let told = told(&output);
            assert_eq!(output.status.code(), Some(0), "{door:?}: {told}");
            folders.honest.push((door, gist(door, &output)));
        }
        folders
    }

    fn cache(&self) -> PathBuf {
        self.place.path("cache")
    }

    /// A place with the folder, and with nothing that disturbs it.
    fn bench(&self) -> Bench {
        let bench = Bench::with_system_programs();
        fs::create_dir(bench.path("hooks")).expect("a directory");
        for stage in ["version", "motion", "stack"] {
            fs::write(bench.path("hooks").join(stage), "").expect("a hook");
        }
        fs::create_dir(bench.path("precious")).expect("a directory");
        fs::write(bench.path("precious/work.txt"), "mine").expect("a file");
        let folder = code_folder("examples/python", &bench.path("mydem"), |manifest| {
            let of_its_own = "search = [\"{folder}\"]\ncommand = [\"mydem\"";
            manifest
                .replace("command = [\"python3\"", of_its_own)
                .replace("before = \"Python \"", "before = \"mydem \"")
        });
        let program = folder.join("mydem");
        fs::write(&program, script(&bench.path("hooks"), &self.cache())).expect("a script");
        fs::set_permissions(program, fs::Permissions::from_mode(0o755)).expect("permissions");
        bench
    }

    fn planned(&self, bench: &Bench) -> Plan {
        let line = format!("plan --code ./mydem --out away {STACK}");
        let output = run(bench, &line).expect("it ends");
        assert_eq!(output.status.code(), Some(0), "{}", told(&output));
        let plan = Plan::read(&bench.path("away")).expect("it is readable");
        plan.expect("it is there")
    }

    /// Plans both rounds on `bench` and puts all results there.
    fn fill(&self, bench: &Bench) -> Plan {
        for _ in 0..2 {
            for run in &self.planned(bench).runs {
                let result = result_of(bench, run);
                if !result.exists() {
                    fs::write(result, native_result(run)).expect("a result");
                }
            }
        }
        self.planned(bench)
    }

    fn honest(&self, door: Door) -> &str {
        let known = self.honest.iter().find(|(known, _)| *known == door);
        &known.expect("every door was tried").1
    }

    /// Lets a folder misbehave, with the chances of `seed`.
    ///
    /// # Errors
    /// A complaint about what went wrong.
    pub fn play(&self, fault: F, seed: u64) -> Result<Story, String> {
        let mut random = fastrand::Rng::with_seed(seed);
        let door = DOORS[random.usize(..DOORS.len())];
        let is_asked = |stage: &&&str| match fault {
            F::LiesAboutItsVersion => **stage == "version" || door == Door::PlanAndJudge,
            // tests/codes/faults.rs waits for the answer to the question for a version.
            F::Hangs => **stage != "version",
            _ => true,
        };
        let stages: Vec<&str> = door.stages().iter().filter(is_asked).copied().collect();
        let stage = stages[random.usize(..stages.len())];
        let round = FolderRound {
            folders: self,
            bench: self.bench(),
            door,
            stage,
        };
        let story = match door {
            Door::PlanAndJudge => round.judge(fault, &mut random),
            _ => round.start(fault, &mut random),
        };
        story.map_err(|complaint| format!("{door:?}, {stage}: {complaint}"))
    }
}

/// A round: a place, a door, and what the code is asked when it misbehaves.
struct FolderRound<'a> {
    folders: &'a Folders,
    bench: Bench,
    door: Door,
    stage: &'static str,
}

impl FolderRound<'_> {
    /// The folder is started by the program, and misbehaves at one stage.
    fn start(&self, fault: F, random: &mut fastrand::Rng) -> Result<Story, String> {
        let hook = self.bench.path("hooks").join(self.stage);
        let struck = self.bench.path("hooks/struck");
        let command = command(fault, random);
        fs::write(
            &hook,
            format!("echo >> '{}'\n{command}\n", struck.display()),
        )
        .expect("a hook");
        let before = self.foreign_files();
        let output = run(&self.bench, &format!("{} {PATIENCE}", self.door.line()));
        let ended = processes::all_ended(&self.bench.path(""));
        let output = output?;
        ended?;
        self.look_for_mistakes(&output, fault)?;
        let came = struck.exists();
        let _ = fs::remove_file(struck);
        self.look_outside(&before)?;
        fs::write(hook, "").expect("a hook");
        let made_after = self.go_on()?;
        Ok(Story {
            struck: came,
            finished_before: finished_runs(&output),
            made_after,
            real: false,
        })
    }

    /// The runs were made elsewhere, and one of them is not what it should be.
    fn judge(&self, fault: F, random: &mut fastrand::Rng) -> Result<Story, String> {
        let plan = self.folders.fill(&self.bench);
        let is_wanted = |run: &&PlannedRun| {
            matches!(run.task, PlannedTask::Stack(_)) == (self.stage == "stack")
        };
        let runs: Vec<&PlannedRun> = plan.runs.iter().filter(is_wanted).collect();
        let victim = random.usize(..runs.len());
        let path = result_of(&self.bench, runs[victim]);
        let other = result_of(&self.bench, runs[(victim + 1) % runs.len()]);
        let kept = fs::read(&path).expect("a result");
        let given = self
            .bench
            .path("away")
            .join(&runs[victim].directory)
            .join("task.json");
        let task = fs::read(&given).expect("a task");
        leave(fault, &path, &given, &other);
        let before = self.foreign_files();
        let output = run(&self.bench, &self.door.line());
        let ended = processes::all_ended(&self.bench.path(""));
        let output = output?;
        ended?;
        self.look_for_mistakes(&output, fault)?;
        self.look_outside(&before)?;
        fs::remove_file(&path).expect("it is there");
        fs::write(&path, kept).expect("a result");
        fs::write(&given, task).expect("a task");
        self.go_on()?;
        let finished = plan.runs.len() - 1;
        Ok(Story {
            struck: true,
            finished_before: finished,
            made_after: 1,
            real: false,
        })
    }

    /// A row that agrees is the honest one; what cannot be overlooked is told, with the name of the folder.
    fn look_for_mistakes(&self, output: &Output, fault: F) -> Result<(), String> {
        let (told, gist) = (told(output), gist(self.door, output));
        let honest: Vec<&str> = self.folders.honest(self.door).lines().collect();
        let is_wrong = |line: &&str| line.ends_with(",agrees") && !honest.contains(line);
        if let Some(row) = gist.lines().find(is_wrong) {
            return Err(format!("a wrong agreement: {row}\n{told}"));
        }
        if told.contains("panicked") || output.status.code().is_none() {
            return Err(format!("{:?}\n{told}", output.status));
        }
        let same = gist == self.folders.honest(self.door);
        // What was left in a plan stays there until it is judged.
        let is_allowed = self.door != Door::PlanAndJudge && may_pass(fault, self.stage);
        match output.status.code() {
            Some(0) if same && is_allowed => Ok(()),
            Some(0) => Err(format!("nobody noticed\n{told}")),
            Some(1..=4) if told.contains("mydem") => Ok(()),
            status => Err(format!("{status:?}, and the folder is not named\n{told}")),
        }
    }

    /// Everything on the bench that is neither of the store nor made to disturb, with its content.
    fn foreign_files(&self) -> BTreeMap<PathBuf, String> {
        let mut found = BTreeMap::new();
        let mut directories = vec![self.bench.path("")];
        while let Some(directory) = directories.pop() {
            for entry in fs::read_dir(directory).expect("a directory").flatten() {
                let path = entry.path();
                let metadata = fs::symlink_metadata(&path).expect("it is there");
                if path == self.bench.path("store") || path == self.bench.path("hooks") {
                    continue;
                }
                let short = metadata.is_file() && metadata.len() < 1 << 24;
                let content = match short {
                    true => sha256_hex(&fs::read(&path).expect("a file")),
                    false => format!("{:?}, {} bytes", metadata.file_type(), metadata.len()),
                };
                if metadata.is_dir() {
                    directories.push(path.clone());
                    found.insert(path, String::new());
                } else {
                    found.insert(path, content);
                }
            }
        }
        found
    }

    /// Nothing is there that was not, but the directories of failed runs that are kept to be looked at; all that was
    /// there is as it was.
    fn look_outside(&self, before: &BTreeMap<PathBuf, String>) -> Result<(), String> {
        let after = self.foreign_files();
        let changed = before
            .iter()
            .find(|(path, content)| after.get(*path) != Some(content));
        if let Some((path, _)) = changed {
            return Err(format!("{} was touched", path.display()));
        }
        let evidence = |path: &&PathBuf| {
            let below = path.strip_prefix(self.bench.path("")).unwrap_or(path);
            let first = below.components().next().map(|first| first.as_os_str());
            let name = first.unwrap_or_default().to_string_lossy();
            name.starts_with("tristack-") && !name.starts_with("tristack-scratch-")
        };
        let new = after.keys().filter(|path| !before.contains_key(*path));
        let left: Vec<&PathBuf> = new.filter(|path| !evidence(path)).collect();
        match left.as_slice() {
            [] => Ok(()),
            left => Err(format!("left behind: {left:?}")),
        }
    }

    /// The folder behaves again: the same command gives what it gives of an honest folder; returns how many runs it made.
    fn go_on(&self) -> Result<usize, String> {
        let entries = entries(&self.bench.path("store/runs"));
        if let Some(broken) = entries.iter().find(|entry| !is_whole(entry)) {
            return Err(format!("{} is not whole", broken.display()));
        }
        let output = run(&self.bench, &self.door.line())?;
        processes::all_ended(&self.bench.path(""))?;
        let gist = gist(self.door, &output);
        if output.status.code() != Some(0) || gist != self.folders.honest(self.door) {
            return Err(format!("going on gives another result\n{}", told(&output)));
        }
        Ok(finished_runs(&output))
    }
}

/// The directories of all runs in a store.
fn entries(runs: &Path) -> Vec<PathBuf> {
    let below = |directory: PathBuf| {
        let entries = fs::read_dir(directory).into_iter().flatten().flatten();
        entries.map(|entry| entry.path())
    };
    below(runs.to_owned()).flat_map(below).collect()
}

/// Runs tristack until it ends, or for ever.
fn run(bench: &Bench, line: &str) -> Result<Output, String> {
    let mut command = bench.process(line);
    let [out, error] = ["out", "error"].map(|name| bench.path("hooks").join(name));
    let file = |path: &Path| Stdio::from(fs::File::create(path).expect("a file"));
    command.stdout(file(&out)).stderr(file(&error));
    let mut child = command.spawn().expect("it starts");
    let start = Instant::now();
    while is_running(&mut child) {
        if start.elapsed() > FOR_EVER {
            let _ = child.kill();
            return Err(format!("`{line}` does not end"));
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    let status = child.wait().expect("it has ended");
    let [stdout, stderr] = [out, error].map(|path| fs::read(path).expect("a file"));
    Ok(Output {
        status,
        stdout,
        stderr,
    })
}

fn told(output: &Output) -> String {
    let [text, message] =
        [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes));
    format!("{text}\n{message}")
}

/// What of the output depends neither on time nor on what the code calls its version.
fn gist(door: Door, output: &Output) -> String {
    let text = String::from_utf8_lossy(&output.stdout);
    match door {
        Door::Check => {
            let report: serde_json::Value = serde_json::from_str(&text).unwrap_or_default();
            let items = report["rows"].as_array().into_iter().flatten();
            let items = items.filter(|item| item["item"] != "program");
            let items = items.map(|item| format!("{}: {}", item["item"], item["outcome"]));
            items.collect::<Vec<_>>().join("\n")
        }
        _ => without(&["version", "seconds"], &text),
    }
}

/// The lines of a table in CSV without some columns.
fn without(columns: &[&str], table: &str) -> String {
    let mut reader = csv::ReaderBuilder::new();
    let reader = reader.has_headers(false).flexible(true);
    let rows: Vec<csv::StringRecord> = reader
        .from_reader(table.as_bytes())
        .records()
        .flatten()
        .collect();
    let is_kept = |index: usize| {
        let name = rows.first().and_then(|header| header.get(index));
        !name.is_some_and(|name| columns.contains(&name))
    };
    let lines = rows.iter().map(|row| {
        let cells = row.iter().enumerate();
        let cells = cells.filter(|(index, _)| is_kept(*index));
        let cells: Vec<&str> = cells.map(|(_, cell)| cell).collect();
        cells.join(",")
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// The program of the folder. A hook is executed before a question is answered.
fn script(hooks: &Path, cache: &Path) -> String {
    let (hooks, cache) = (hooks.display(), cache.display());
    format!(
        r#"#!/bin/sh
if [ "$1" = --version ]; then . '{hooks}/version'; echo "mydem 1.0"; exit 0; fi
stage=motion
if grep -q ramp_steps task.json; then stage=stack; fi
. "{hooks}/$stage"
answer="{cache}/$(sha256sum task.json | cut -c 1-64).csv"
if [ ! -f "$answer" ]; then
    python3 "$1" && cp result.csv "$answer.$$" && mv "$answer.$$" "$answer"
fi
cp "$answer" result.csv
"#
    )
}
