//! Shared parts of the tests of the command line.
#![allow(dead_code)] // Every test binary uses a part of it.

pub mod away;
pub mod browser;
pub mod mounts;
pub mod network;
pub mod replay;

use assert_cmd::Command;
use std::collections::HashMap;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use tempfile::TempDir;
use tristack::code::Code;
use tristack::runs::{Recorded, Recording};
use tristack::study::atlas::{NamedPassport, difference};

/// The program built for the tests.
pub const OWN_PROGRAM: &str = env!("CARGO_BIN_EXE_tristack");

/// The program that was released, if TRISTACK_RELEASE names it.
pub fn released_program() -> Option<PathBuf> {
    let name = std::env::var_os("TRISTACK_RELEASE")?;
    let program = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
    assert!(program.is_file(), "{} is not built", program.display());
    Some(program)
}

/// A place of its own for a test: store, programs in the search path, results.
pub struct Bench {
    root: TempDir,
    /// Whether the search path holds the programs of the system, and with them installed codes.
    system_programs: bool,
}

impl Bench {
    /// A machine on which no code is installed.
    pub fn without_codes() -> Self {
        Self::new(false)
    }

    /// This machine, as it is.
    pub fn with_system_programs() -> Self {
        Self::new(true)
    }

    fn new(system_programs: bool) -> Self {
        let root = tempfile::tempdir().expect("a temporary directory");
        fs::create_dir(root.path().join("programs")).expect("a directory for programs");
        Self {
            root,
            system_programs,
        }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.root.path().join(name)
    }

    /// Installs a shell script as `program`, in front of everything else in the search path.
    pub fn install(&self, program: &str, script: &str) {
        let path = self.path("programs").join(program);
        fs::write(&path, format!("#!/bin/sh\n{script}")).expect("a script");
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).expect("its permissions");
    }

    fn search_path(&self) -> String {
        let own = self.path("programs").display().to_string();
        let system = std::env::var("PATH").unwrap_or_default();
        if self.system_programs {
            format!("{own}:{system}")
        } else {
            own
        }
    }

    /// `tristack` with the arguments in `line`, which are separated by spaces.
    pub fn tristack(&self, line: &str) -> Command {
        Command::from_std(self.process(line))
    }

    /// The same, as a process that can be watched and interrupted.
    pub fn process(&self, line: &str) -> std::process::Command {
        self.process_of(Path::new(OWN_PROGRAM), line)
    }

    /// The same, of another `program` than the one that was built for the tests.
    pub fn process_of(&self, program: &Path, line: &str) -> std::process::Command {
        let mut command = std::process::Command::new(program);
        command
            .args(line.split_whitespace())
            .env("PATH", self.search_path())
            .env("TRISTACK_STORE", self.path("store"))
            .env("TMPDIR", self.root.path())
            .env_remove("TRISTACK_REFERENCE")
            .env_remove("COLUMNS")
            .env_remove("CLICOLOR_FORCE")
            .current_dir(self.root.path());
        command
    }
}

/// The top of the project.
pub fn project() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// What TRISTACK_REQUIRE_ENGINES names, separated by commas: codes, and folders of the project, which have a `/`.
fn required() -> Vec<String> {
    let required = std::env::var("TRISTACK_REQUIRE_ENGINES").unwrap_or_default();
    let names = required.split(',').filter(|name| !name.is_empty());
    names.map(str::to_owned).collect()
}

/// The folders that TRISTACK_REQUIRE_ENGINES names.
pub fn required_folders() -> Vec<String> {
    let names = required().into_iter();
    names.filter(|name| name.contains('/')).collect()
}

/// The code of a folder of the project, `FOLDER` or `FOLDER:NAME`, if it is installed. It becomes one of all codes.
pub fn installed_in_folder(folder: &str) -> Option<Code> {
    let (path, name) = match folder.split_once(':') {
        Some((path, name)) => (path, Some(name)),
        None => (folder, None),
    };
    let code = Code::in_folder(&project().join(path), name);
    Some(code.expect("a folder in order")).filter(|code| code.find().is_some())
}

/// A copy, in `place`, of the folder `original` of the project, with what `change` makes of its manifest.
pub fn code_folder(original: &str, place: &Path, change: impl FnOnce(String) -> String) -> PathBuf {
    fs::create_dir(place).expect("a directory");
    let original = Path::new(env!("CARGO_MANIFEST_DIR")).join(original);
    for entry in fs::read_dir(original).expect("a folder").flatten() {
        if entry.path().is_file() {
            fs::copy(entry.path(), place.join(entry.file_name())).expect("a copy");
        }
    }
    let manifest = place.join("code.toml");
    let text = fs::read_to_string(&manifest).expect("a manifest");
    fs::write(manifest, change(text)).expect("it can be written");
    place.to_owned()
}

/// Those of `codes` that are installed; fails if one that TRISTACK_REQUIRE_ENGINES names is not.
pub fn installed(codes: &[Code]) -> Vec<Code> {
    for name in required().iter().filter(|name| !name.contains('/')) {
        let code = Code::named(name).expect("TRISTACK_REQUIRE_ENGINES names codes");
        assert!(
            code.find().is_some(),
            "{code} is required, but not installed"
        );
    }
    let all = codes.iter().cloned();
    let (installed, missing): (Vec<_>, Vec<_>) = all.partition(|code| code.find().is_some());
    for code in missing {
        eprintln!("{code} is not installed: its live tests are skipped");
    }
    installed
}

pub fn standard_output(command: &mut Command) -> String {
    let output = command.output().expect("the program starts");
    String::from_utf8(output.stdout).expect("its output is text")
}

pub fn standard_error(command: &mut Command) -> String {
    let output = command.output().expect("the program starts");
    String::from_utf8(output.stderr).expect("its output is text")
}

pub fn json(text: &str) -> serde_json::Value {
    serde_json::from_str(text).expect("the output is JSON")
}

/// Saves in `directory` what is recorded of `code`, as `change` makes it.
pub fn save_recording(directory: &Path, code: &Code, change: impl FnOnce(&mut Recording)) {
    let mut recording = recording(code);
    change(&mut recording);
    recording.save(directory, code).expect("a copy");
}

/// The recording of `code` that is embedded in the program.
pub fn recording(code: &Code) -> Recording {
    let recorded = Recorded::embedded().recording(code);
    recorded.expect("it is not damaged")
}

/// The rows of a table in JSON.
pub fn json_rows(text: &str) -> Vec<serde_json::Value> {
    let rows = json(text)["rows"].as_array().cloned();
    rows.expect("an object with rows")
}

/// The rows of a table of numbers in CSV, each by the names of its columns.
pub fn records(csv: &[u8]) -> Vec<HashMap<String, f64>> {
    let mut reader = csv::Reader::from_reader(csv);
    let rows = reader.deserialize().map(|row| row.expect("numbers"));
    rows.collect()
}

/// Waits until `condition` returns something; `None` after a minute, which is enough on a busy machine.
pub fn wait_a_minute_for<T>(mut condition: impl FnMut() -> Option<T>) -> Option<T> {
    let start = Instant::now();
    while start.elapsed() < Duration::from_secs(60) {
        let value = condition();
        if value.is_some() {
            return value;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    None
}

/// The same, where nothing goes on without it.
#[track_caller]
pub fn wait_for<T>(condition: impl FnMut() -> Option<T>) -> T {
    wait_a_minute_for(condition).expect("what was waited for comes within a minute")
}

/// Nothing but what is named is in `directory`.
pub fn assert_only(directory: &Path, names: &[&str]) {
    let mut found: Vec<String> = fs::read_dir(directory)
        .expect("the directory is there")
        .map(|entry| {
            entry
                .expect("an entry")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    found.sort();
    assert_eq!(found, names);
}

/// The files below a directory, by their paths there. One that is removed meanwhile has none.
pub fn files_below(root: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut open = vec![root.to_owned()];
    while let Some(directory) = open.pop() {
        let entries = match fs::read_dir(&directory) {
            Err(_) if directory != root => continue,
            entries => entries.expect("a directory"),
        };
        for entry in entries.flatten() {
            if entry.path().is_dir() {
                open.push(entry.path());
            } else {
                let path = entry.path();
                files.push(path.strip_prefix(root).expect("below").to_owned());
            }
        }
    }
    files.sort();
    files
}

/// The passports in a directory.
pub fn passports(directory: &Path) -> Vec<NamedPassport> {
    let files = files_below(directory).into_iter();
    let files = files.filter(|path| path.extension().is_some_and(|ending| ending == "json"));
    let texts = files.map(|path| fs::read(directory.join(path)).expect("a file"));
    texts
        .map(|text| NamedPassport::read(text).expect("a passport"))
        .collect()
}

/// Asserts that the passports in a directory say what those on file say of the same versions, and counts them.
pub fn are_as_on_file(directory: &Path) -> usize {
    let on_file = passports(&project().join("reference/passports"));
    let place = |own: &NamedPassport| {
        let passport = &own.passport;
        let version = &passport.program.version;
        [&passport.software, &passport.style, version].map(String::clone)
    };
    let mut compared = 0;
    for own in passports(directory) {
        let Some(before) = on_file.iter().find(|other| place(other) == place(&own)) else {
            eprintln!("{}: no passport of this version is on file", own.name);
            continue;
        };
        let found = difference(&before.passport, &own.passport);
        assert!(found.is_none(), "{}: {:#?}", own.name, found.changes);
        compared += 1;
    }
    compared
}

/// What the authors' program, compiled for this start, stack and time step and for wall speed 1e-3, prints.
pub const AUTHORS_FORCE: &str = "30.140993";

/// A checkout with one start, three touching cylinders, and one yield force of Fig. 2(a), as printed.
pub fn small_checkout(place: &Path, force: &str) {
    let (data, init) = (place.join("fig2a/data"), place.join("src/init"));
    fs::create_dir_all(&data).unwrap();
    fs::create_dir_all(&init).unwrap();
    let top = 1.0 + 3f64.sqrt();
    let places = format!("-1 1 0 0 0 0\n1 1 0 0 0 0\n0 {top} 0 0 0 0\n");
    fs::write(init.join("init_p_A1.0e-03.txt"), places).unwrap();
    fs::write(init.join("init_deltat_A1.0e-03.txt"), "0 0 0\n".repeat(8)).unwrap();
    let head = "# Parameter: dimensionless spring constant kn r / mg = 1.0e+3";
    let rows = format!("{head}\n0.300000 {force}\n");
    fs::write(data.join("k1e+2.txt"), rows).unwrap();
}
