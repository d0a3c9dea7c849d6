//! Files of somebody else: in a store, in a directory for results, among recorded runs. None is removed, replaced,
//! followed or waited for.

use crate::common;
use crate::common::mounts::{NO_DISK, can_mount, with_mounts};
use crate::common::replay::{self, Disturbance};
use crate::common::{Bench, OWN_PROGRAM, save_recording, wait_a_minute_for};
use nix::sys::stat::Mode;
use nix::unistd::{geteuid, mkfifo};
use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::{MetadataExt, PermissionsExt, chown, symlink};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use tristack::code::Code;

const SWEEP: &str = "sweep --code native --mu 0.3 --stiffness 100 --format csv";
const RUN: &str = "simulate --code native --mu 0.3 --stiffness 100";

/// Runs `command`, which must end within a minute.
fn ended(mut command: Command) -> Output {
    let [output, error] = [(); 2].map(|()| tempfile::NamedTempFile::new().expect("a file"));
    let file = |named: &tempfile::NamedTempFile| named.reopen().expect("the same file");
    command
        .stdin(Stdio::null())
        .stdout(file(&output))
        .stderr(file(&error));
    let mut child = command.spawn().expect("it starts");
    let status = wait_a_minute_for(|| child.try_wait().expect("it can be watched"));
    let read = |named: &tempfile::NamedTempFile| fs::read(named.path()).expect("text");
    let (stdout, stderr) = (read(&output), read(&error));
    let Some(status) = status else {
        child.kill().expect("it can be killed");
        let told = String::from_utf8_lossy(&stderr);
        panic!("{command:?} does not end: {told}");
    };
    Output {
        status,
        stdout,
        stderr,
    }
}

/// The status and the message of `line`.
fn outcome(bench: &Bench, line: &str) -> (Option<i32>, String) {
    let output = ended(bench.process(line));
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!message.contains("panicked"), "{message}");
    (output.status.code(), message)
}

/// Refused as wrong input, with a message of one line that has all `parts`.
#[track_caller]
fn refused(bench: &Bench, line: &str, parts: &[&str]) {
    let (status, message) = outcome(bench, &format!("{line} --quiet"));
    assert_eq!(status, Some(1), "{line}: {message}");
    for part in parts {
        assert!(message.contains(part), "{line}: {message} lacks {part}");
    }
    assert_eq!(message.lines().count(), 1, "{line}: {message}");
}

/// Writes a file, in directories to which nobody else may write whatever the umask is.
fn put(path: &Path, content: &str) {
    let above = path.parent().expect("a directory");
    let missing: Vec<&Path> = above
        .ancestors()
        .take_while(|path| !path.exists())
        .collect();
    fs::create_dir_all(above).expect("a directory");
    missing.into_iter().for_each(|path| allow(path, 0o755));
    fs::write(path, content).expect("a file");
}

fn allow(path: &Path, mode: u32) {
    fs::set_permissions(path, fs::Permissions::from_mode(mode)).expect("permissions");
}

fn pipe(path: &Path) {
    mkfifo(path, Mode::S_IRWXU).expect("a named pipe");
}

/// Everything below `directory`: kinds, and contents of regular files.
fn contents(directory: &Path) -> BTreeMap<PathBuf, Option<Vec<u8>>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(directory).expect("a directory").flatten() {
        let (path, kind) = (entry.path(), entry.file_type().expect("a kind"));
        if kind.is_dir() {
            found.extend(contents(&path));
        }
        let content = kind.is_file().then(|| fs::read(&path).expect("a file"));
        found.insert(path, content);
    }
    found
}

// Stores.

#[test]
fn a_directory_that_is_no_store_is_not_adopted_and_left_as_it_is() {
    let bench = Bench::without_codes();
    let project = bench.path("proj");
    for file in ["sessions/monday.md", "work/monday/data.bin", "notes.txt"] {
        put(&project.join(file), "mine");
    }
    let before = contents(&project);
    refused(
        &bench,
        &format!("{SWEEP} --store proj"),
        &[
            "proj/format: no such file beside `notes.txt`",
            "a new or empty directory",
        ],
    );
    assert_eq!(contents(&project), before);
}

#[test]
fn a_new_and_an_empty_directory_become_a_store() {
    let bench = Bench::without_codes();
    fs::create_dir(bench.path("empty")).expect("a directory");
    allow(&bench.path("empty"), 0o755);
    // As it is when another program has just begun to make it a store, or was killed then.
    put(
        &bench.path("begun/.format.draft-abcdefABCDEF"),
        "tristack sto",
    );
    for store in ["empty", "begun", "new/one"] {
        let line = format!("{SWEEP} --store {store}");
        let (status, message) = outcome(&bench, &line);
        assert_eq!(status, Some(0), "{message}");
        assert!(bench.path(store).join("format").is_file());
    }
}

#[test]
fn what_no_program_of_ours_is_called_survives_in_a_store() {
    let bench = Bench::without_codes();
    assert_eq!(outcome(&bench, SWEEP).0, Some(0));
    let store = bench.path("store");
    let foreign = [
        "sessions/monday.md",
        "sessions/monday.json",
        // Its stem is `..`: what belongs to such a session would be the whole store.
        "sessions/...json",
        "sessions/session-../x.json",
        "work/monday/data.bin",
        "checkpoints/mine.json",
        "runs/mine/notes.txt",
        "notes.txt",
    ];
    for file in foreign {
        put(&store.join(file), "mine");
    }
    let before = contents(&store);
    assert_eq!(outcome(&bench, SWEEP).0, Some(0));
    assert_eq!(contents(&store).len(), before.len());
    for file in foreign {
        assert!(store.join(file).exists(), "{file} is gone");
    }
}

#[test]
fn links_in_a_store_are_not_followed() {
    let bench = Bench::without_codes();
    let elsewhere = bench.path("elsewhere");
    for name in ["runs", "sessions", "work", "checkpoints", "quarantine"] {
        put(&elsewhere.join("mine.txt"), "mine");
        put(&bench.path("linked/format"), "tristack store, format 2\n");
        symlink(&elsewhere, bench.path("linked").join(name)).expect("a link");
        let parts = [
            name,
            "it is a symbolic link; accepted in a store is a directory",
        ];
        refused(&bench, &format!("{SWEEP} --store linked"), &parts);
        fs::remove_dir_all(bench.path("linked")).expect("it can be removed");
    }
    let before = contents(&elsewhere);
    assert_eq!(before.len(), 1);
}

#[test]
fn a_link_in_the_place_of_an_entry_or_of_its_files_is_put_aside() {
    let bench = Bench::without_codes();
    let first = ended(bench.process(SWEEP));
    for part in ["", "series.csv", "provenance.json"] {
        let entry = entry(&bench);
        let place = entry.join(part);
        let place = if part.is_empty() { &entry } else { &place };
        let aside = bench.path(&format!("aside-{part}"));
        fs::rename(place, &aside).expect("it can be moved");
        symlink(&aside, place).expect("a link");
        let again = ended(bench.process(SWEEP));
        let message = String::from_utf8_lossy(&again.stderr);
        assert_eq!(again.stdout, first.stdout, "{message}");
        assert!(
            message.contains("damaged run in the store"),
            "{part}: {message}"
        );
        assert!(
            message.contains("it is a symbolic link"),
            "{part}: {message}"
        );
        assert!(!place.is_symlink() && aside.exists());
    }
}

/// The directory of a run in the store.
fn entry(bench: &Bench) -> PathBuf {
    let first = |directory: &Path| {
        let entries = fs::read_dir(directory).expect("a directory").flatten();
        entries.map(|entry| entry.path()).min().expect("an entry")
    };
    first(&first(&bench.path("store/runs")))
}

#[test]
fn named_pipes_in_a_store_are_not_waited_for() {
    let bench = Bench::without_codes();
    let first = ended(bench.process(SWEEP));
    let store = bench.path("store");
    fs::create_dir_all(store.join("sessions/session-directoryabc.json")).expect("a directory");
    pipe(&store.join("sessions/session-abcdefABCDEF.json"));
    for file in ["case.json", "series.csv", "SHA256SUMS", ""] {
        let place = entry(&bench).join(file);
        match file {
            "" => fs::remove_dir_all(entry(&bench)).expect("it is there"),
            _ => fs::remove_file(&place).expect("it is there"),
        }
        pipe(Path::new(
            place.to_str().expect("text").trim_end_matches('/'),
        ));
        let again = ended(bench.process(SWEEP));
        let message = String::from_utf8_lossy(&again.stderr);
        assert_eq!(again.stdout, first.stdout, "{message}");
        assert!(message.contains("it is a named pipe"), "{file}: {message}");
    }
    for file in ["lock", "format"] {
        fs::remove_file(store.join(file)).expect("it is there");
        pipe(&store.join(file));
        refused(&bench, SWEEP, &[file, "it is a named pipe"]);
    }
}

#[test]
fn a_store_of_a_program_is_its_own_whatever_the_umask() {
    let bench = Bench::without_codes();
    for umask in ["0002", "0000", "0077"] {
        let store = bench.path(&format!("store-{umask}"));
        for _ in 0..2 {
            let mut command = Command::new("sh");
            let script = format!("umask {umask}; exec \"$@\" --store {}", store.display());
            command.args(["-c", &script, "sh", OWN_PROGRAM]);
            command.args(SWEEP.split(' ')).current_dir(bench.path(""));
            let output = ended(command);
            let message = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(0), "{umask}: {message}");
        }
        let mode = |path: &Path| fs::metadata(path).expect("it is there").mode();
        assert_eq!(mode(&store) & 0o777, 0o700);
        for path in contents(&store).into_keys() {
            // The lock holds nothing, and is behind the store's own permissions.
            let is_lock = path.ends_with("lock") || path.ends_with("format");
            assert!(is_lock || mode(&path) & 0o022 == 0, "{}", path.display());
        }
    }
}

#[test]
fn a_store_that_others_may_write_to_is_refused_unless_it_is_asked_for() {
    let bench = Bench::without_codes();
    assert_eq!(outcome(&bench, SWEEP).0, Some(0));
    for (part, mode) in [
        ("", 0o775),
        ("", 0o757),
        ("runs", 0o777),
        ("sessions", 0o775),
    ] {
        let place = bench.path("store").join(part);
        let before = fs::metadata(&place).expect("it is there").mode();
        allow(&place, mode);
        let told = format!("others than its owner may write to it (mode {mode:03o})");
        refused(&bench, SWEEP, &[&told, "chmod -R go-w", "--shared-store"]);
        let (status, message) = outcome(&bench, &format!("{SWEEP} --shared-store"));
        assert_eq!(status, Some(0), "{message}");
        allow(&place, before & 0o7777);
    }
    assert_eq!(outcome(&bench, SWEEP).0, Some(0));
}

/// Only root can give a directory to somebody else.
#[test]
fn a_store_of_another_user_is_refused_unless_it_is_asked_for() {
    if !geteuid().is_root() {
        eprintln!("not tried: only root can make a directory of another user");
        return;
    }
    let bench = Bench::without_codes();
    assert_eq!(outcome(&bench, SWEEP).0, Some(0));
    for part in ["", "runs"] {
        let place = bench.path("store").join(part);
        chown(&place, Some(12345), None).expect("root may");
        refused(
            &bench,
            SWEEP,
            &["it belongs to user 12345", "--shared-store"],
        );
        assert_eq!(
            outcome(&bench, &format!("{SWEEP} --shared-store")).0,
            Some(0)
        );
        chown(&place, Some(0), None).expect("root may");
    }
}

#[test]
fn a_shared_store_leaves_the_permissions_to_the_umask() {
    let bench = Bench::without_codes();
    let mut command = Command::new("sh");
    command.args([
        "-c",
        "umask 0002; exec \"$@\" --store shared --shared-store",
        "sh",
        OWN_PROGRAM,
    ]);
    command.args(SWEEP.split(' ')).current_dir(bench.path(""));
    assert_eq!(ended(command).status.code(), Some(0));
    for directory in ["shared", "shared/runs", "shared/sessions"] {
        let found = fs::metadata(bench.path(directory)).expect("it is there");
        assert_eq!(found.mode() & 0o777, 0o775, "{directory}");
    }
}

/// A read-only mount stops root too; permission bits stop everybody else.
#[test]
fn a_store_that_can_only_be_read_is_read() {
    let bench = Bench::with_system_programs();
    let first = ended(bench.process(SWEEP));
    let before = contents(&bench.path("store"));
    let other = SWEEP.replace("0.3", "0.25");
    let expected = ended(bench.process(&format!("{other} --store other")));
    let Some(read_only) = reader(&bench) else {
        return;
    };
    let stored = ended(read_only(SWEEP));
    let message = String::from_utf8_lossy(&stored.stderr);
    assert_eq!(stored.status.code(), Some(0), "{message}");
    assert_eq!(stored.stdout, first.stdout);
    assert!(
        message.contains("5 of 5 runs are there already"),
        "{message}"
    );
    let made = ended(read_only(&other));
    let message = String::from_utf8_lossy(&made.stderr);
    assert_eq!(made.status.code(), Some(0), "{message}");
    assert_eq!(made.stdout, expected.stdout);
    let told = message.matches("nothing new is kept, because the store");
    assert_eq!(told.count(), 1, "{message}");
    assert!(!message.contains("could not be kept"), "{message}");
    allow(&bench.path("store"), 0o700);
    assert_eq!(contents(&bench.path("store")), before);
}

/// Starts the program with a command line.
type Start<'a> = Box<dyn Fn(&str) -> Command + 'a>;

/// Starts it where its store can only be read, if that can be arranged.
fn reader(bench: &Bench) -> Option<Start<'_>> {
    if can_mount() {
        let set_up = "mount --bind store store && mount -o remount,bind,ro store";
        return Some(Box::new(move |line| {
            with_mounts(&bench.process(line), set_up, "\"$@\"")
        }));
    }
    if geteuid().is_root() {
        eprintln!("not tried: nothing can be mounted, and permissions do not stop root");
        return None;
    }
    for (path, content) in contents(&bench.path("store")) {
        if content.is_none() {
            allow(&path, 0o500);
        }
    }
    allow(&bench.path("store"), 0o500);
    Some(Box::new(move |line| bench.process(line)))
}

// Directories for results.

/// Commands with a directory for results, and a file of each that is named by what it writes.
const WRITING: [(&str, &str); 7] = [
    (
        "simulate --code native --mu 0.3 --stiffness 100 --out out",
        "series.csv",
    ),
    (
        "simulate --code native --mu 0.3 --stiffness 100 --vtk out",
        "cylinders_0001.vtp",
    ),
    (
        "sweep --code native --mu 0.3 --stiffness 100 --out out",
        "sweep.csv",
    ),
    ("crosscheck --codes native --out out", "crosscheck.csv"),
    ("regimes --points 2 --out out", "regimes.csv"),
    ("report --out out", "report.md"),
    ("bench --codes native --repeats 1 --out out", "bench.csv"),
];

#[test]
fn a_directory_of_somebody_else_takes_no_results() {
    for (line, result) in WRITING {
        for (name, told) in [
            ("notes.md", "which this command does not write"),
            // A file of somebody else that happens to be called like a result.
            (result, "that tristack wrote"),
            (
                ".home-mine/letter.txt",
                "`.home-mine`, a directory that this command does not make",
            ),
            (".home-backup/letter.txt", "`.home-backup`"),
            ("figures/mine.txt", "does not"),
        ] {
            let bench = Bench::without_codes();
            let out = bench.path("out");
            put(&out.join(name), "mine");
            refused(
                &bench,
                line,
                &[
                    "out: it holds",
                    told,
                    "accepted is a new or empty directory",
                ],
            );
            assert_eq!(contents(&out)[&out.join(name)], Some(b"mine".to_vec()));
            let count = if name.contains('/') { 2 } else { 1 };
            assert_eq!(contents(&out).len(), count, "{line} has written something");
            assert!(!bench.path("store").exists(), "{line} has begun to work");
        }
    }
}

#[test]
fn earlier_results_of_a_command_are_replaced() {
    let bench = Bench::without_codes();
    for line in [WRITING[0].0, WRITING[1].0, WRITING[2].0, WRITING[3].0] {
        let [first, again] = [(); 2].map(|()| outcome(&bench, line));
        assert_eq!([first.0, again.0], [Some(0); 2], "{}", again.1);
        fs::remove_dir_all(bench.path("out")).expect("it is there");
    }
}

#[test]
fn results_are_not_written_through_links() {
    let bench = Bench::without_codes();
    let mine = bench.path("mine.txt");
    for name in ["series.csv", "summary.json", "case.json"] {
        for links in [true, false] {
            put(&mine, "mine");
            assert_eq!(outcome(&bench, &format!("{RUN} --out out")).0, Some(0));
            let place = bench.path("out").join(name);
            let content = fs::read(&place).expect("a result");
            fs::remove_file(&place).expect("it is there");
            if links {
                symlink(&mine, &place).expect("a link");
                let told = format!("`{name}`, a symbolic link");
                refused(&bench, &format!("{RUN} --out out"), &[&told]);
            } else {
                fs::write(&mine, &content).expect("a file");
                fs::hard_link(&mine, &place).expect("a link");
                let line = RUN.replace("0.3", "0.25");
                assert_eq!(outcome(&bench, &format!("{line} --out out")).0, Some(0));
                assert_eq!(fs::read(&mine).expect("a file"), content);
                put(&mine, "mine");
            }
            assert_eq!(fs::read(&mine).expect("a file"), b"mine");
            fs::remove_dir_all(bench.path("out")).expect("it is there");
            fs::remove_file(&mine).expect("it is there");
        }
    }
}

#[test]
fn a_picture_does_not_take_the_place_of_a_link_or_a_device() {
    let bench = Bench::without_codes();
    put(&bench.path("mine.txt"), "mine");
    symlink("mine.txt", bench.path("picture.svg")).expect("a link");
    let output = ended(bench.process(&format!("{RUN} --format csv --svg picture.svg")));
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(5), "{message}");
    assert!(
        message.contains("picture.svg: it is a symbolic link"),
        "{message}"
    );
    assert!(!output.stdout.is_empty());
    assert!(bench.path("picture.svg").is_symlink());
    assert_eq!(fs::read(bench.path("mine.txt")).expect("a file"), b"mine");
}

#[test]
fn the_run_directory_of_one_code_is_not_taken_for_that_of_another() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::None);
    put(&bench.path("case.json"), &replay::first_case().to_json());
    let yade = "simulate --code yade --case case.json --out run";
    assert_eq!(outcome(&bench, yade).0, Some(0));
    let before = contents(&bench.path("run"));
    refused(&bench, &format!("{RUN} --out run"), &["run: it holds `"]);
    assert_eq!(contents(&bench.path("run")), before);
    // A process that was killed leaves its home behind.
    put(&bench.path("run/.home-abcdefABCDEF/cache/file"), "left");
    let (status, message) = outcome(&bench, yade);
    assert_eq!(status, Some(0), "{message}");
    assert!(!bench.path("run/.home-abcdefABCDEF").exists());
}

#[test]
fn pictures_may_lie_in_the_directory_of_the_run() {
    let bench = Bench::without_codes();
    for pictures in [
        "--svg out/stack.svg --vtk out/para",
        "--svg out/stack.svg --vtk out",
    ] {
        for _ in 0..2 {
            let (status, message) = outcome(&bench, &format!("{RUN} --out out {pictures}"));
            assert_eq!(status, Some(0), "{message}");
        }
        fs::remove_dir_all(bench.path("out")).expect("it is there");
    }
}

// Results that cannot be written.

/// A code that turns the directory for results into a file while it works, so that nothing can be written there.
fn sabotage(bench: &Bench) {
    replay::install(bench, |_| Disturbance::None);
    let program = bench.path("programs/yade");
    let script = fs::read_to_string(&program).expect("a script");
    let out = bench.path("out").display().to_string();
    let sabotaged = script.replace(
        "shift 5\n",
        &format!("shift 5\nrm -rf {out}; touch {out}\n"),
    );
    assert_ne!(sabotaged, script);
    fs::write(program, sabotaged).expect("a script");
}

#[test]
fn what_cannot_be_written_is_printed_and_named_and_has_a_status_of_its_own() {
    let line = "sweep --code yade --mu 0.3 --stiffness 100 --format csv";
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::None);
    let expected = ended(bench.process(line));
    assert_eq!(expected.status.code(), Some(0));
    let bench = Bench::with_system_programs();
    sabotage(&bench);
    let output = ended(bench.process(&format!("{line} --out out")));
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(5), "{message}");
    assert_eq!(output.stdout, expected.stdout);
    assert!(message.contains("error: cannot write "), "{message}");
    assert!(message.contains("out/sweep.json"), "{message}");
}

#[test]
fn a_full_disk_loses_nothing_that_is_printed() {
    if !can_mount() {
        eprintln!("not tried: no file system can be mounted");
        return;
    }
    let bench = Bench::with_system_programs();
    for (line, first) in [
        (format!("{SWEEP} --out disk/out"), "sweep.csv"),
        (format!("{RUN} --format csv --out disk/out"), "series.csv"),
    ] {
        let expected = ended(bench.process(line.split(" --out").next().expect("a line")));
        let set_up = "mkdir -p disk && mount -t tmpfs -o size=8k none disk && mkdir disk/out && echo > disk/all";
        let output = ended(with_mounts(&bench.process(&line), set_up, "\"$@\""));
        let message = String::from_utf8_lossy(&output.stderr);
        assert_ne!(output.status.code(), Some(NO_DISK), "{message}");
        assert_eq!(output.status.code(), Some(5), "{message}");
        assert!(
            message.contains(&format!("cannot write disk/out/{first}")),
            "{message}"
        );
        assert!(message.contains("No space left"), "{message}");
        let numbers = |output: &[u8]| String::from_utf8_lossy(output).lines().count();
        assert_eq!(numbers(&output.stdout), numbers(&expected.stdout));
        assert!(numbers(&output.stdout) > 1);
    }
}

#[test]
fn a_run_is_printed_though_not_a_byte_of_it_can_be_written() {
    if !can_mount() {
        eprintln!("not tried: no file system can be mounted");
        return;
    }
    let bench = Bench::with_system_programs();
    let line = format!("{RUN} --format csv --out disk/out --quiet");
    let set_up =
        "mkdir disk && mount -t tmpfs -o size=4k none disk && mkdir disk/out && echo > disk/all";
    let output = ended(with_mounts(
        &bench.process(&line),
        set_up,
        "\"$@\"; status=$?; ls -A disk/out >&2; exit $status",
    ));
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(5), "{message}");
    let told = "error: cannot write disk/out/case.json: No space left on device";
    assert!(message.starts_with(told), "{message}");
    assert_eq!(
        message.lines().count(),
        1,
        "something is left behind: {message}"
    );
    assert_eq!(String::from_utf8_lossy(&output.stdout).lines().count(), 2);
}

#[test]
fn files_are_written_though_standard_output_is_full() {
    let bench = Bench::without_codes();
    let mut command = bench.process(&format!("{SWEEP} --out out"));
    command.stdout(
        fs::File::options()
            .write(true)
            .open("/dev/full")
            .expect("a device"),
    );
    let output = command.output().expect("it runs");
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(5), "{message}");
    assert!(
        message.contains("cannot write standard output"),
        "{message}"
    );
    common::assert_only(&bench.path("out"), &["sweep.csv", "sweep.json"]);
}

// Recorded runs.

#[test]
fn record_replaces_nothing_but_recordings() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::None);
    let reference = bench.path("lammps");
    let foreign = [
        "yade/src/main.cpp",
        "yade.csv.bak",
        "quick/notes.md",
        "Makefile",
    ];
    for file in foreign {
        put(&reference.join(file), "mine");
    }
    let record = || {
        let mut command = bench.process("record --codes yade --only probe --quiet");
        command.env("TRISTACK_REFERENCE", &reference);
        let output = ended(command);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        (output.status.code(), message)
    };
    for (name, content) in [("yade.csv", "a,b\n1,2\n"), ("yade.tar.gz", "sources")] {
        put(&reference.join(name), content);
        let (status, message) = record();
        assert_eq!(status, Some(1), "{message}");
        assert!(
            message.contains(&format!("{name}: it is no recording")),
            "{message}"
        );
        assert_eq!(message.lines().count(), 1, "something ran: {message}");
        assert_eq!(
            fs::read_to_string(reference.join(name)).expect("text"),
            content
        );
        fs::remove_file(reference.join(name)).expect("it is there");
    }
    for _ in 0..2 {
        let (status, message) = record();
        assert_eq!(status, Some(0), "{message}");
    }
    for file in foreign {
        assert_eq!(fs::read(reference.join(file)).expect("a file"), b"mine");
    }
}

// Reads that would never end.

#[test]
fn input_that_never_ends_is_refused() {
    let bench = Bench::without_codes();
    pipe(&bench.path("pipe.json"));
    symlink("/dev/zero", bench.path("zero.json")).expect("a link");
    for (file, kind) in [("pipe.json", "a named pipe"), ("zero.json", "a device")] {
        let line = format!("simulate --code native --case {file}");
        refused(&bench, &line, &[file, kind, "accepted is a regular file"]);
    }
    for (name, manifest) in [("a", "code.toml"), ("b", "stack.in")] {
        let folder = bench.path(name);
        fs::create_dir(&folder).expect("a directory");
        let original = Path::new(env!("CARGO_MANIFEST_DIR")).join("lammps_inputs");
        let entries = fs::read_dir(original).expect("a folder").flatten();
        for entry in entries.filter(|entry| entry.path().is_file()) {
            fs::copy(entry.path(), folder.join(entry.file_name())).expect("a copy");
        }
        fs::remove_file(folder.join(manifest)).expect("it is there");
        pipe(&folder.join(manifest));
        let (status, message) = outcome(&bench, &format!("probe --codes ./{name}"));
        assert_eq!(status, Some(1), "{message}");
        assert!(message.contains("a named pipe"), "{message}");
    }
}

#[test]
fn a_named_pipe_among_recorded_runs_is_not_waited_for() {
    let bench = Bench::without_codes();
    let reference = bench.path("reference");
    let yade = Code::named("yade").expect("it is built in");
    for name in ["yade.csv", "yade.tar.gz"] {
        save_recording(&reference, &yade, |_| ());
        fs::remove_file(reference.join(name)).expect("it is there");
        pipe(&reference.join(name));
        let mut command = bench.process("crosscheck --explain yade/0.3/100");
        command.env("TRISTACK_REFERENCE", &reference);
        let output = ended(command);
        let told = [output.stdout, output.stderr].concat();
        let told = String::from_utf8_lossy(&told);
        assert!(told.contains("it is a named pipe"), "{told}");
        fs::remove_dir_all(&reference).expect("it is there");
    }
}

/// A script for LIGGGHTS that executes `command` in place of a run.
fn unless_asked_for_its_version(command: &str) -> String {
    format!("case \"$*\" in *-help*|*/dev/null*) exit 0;; esac; {command}")
}

#[test]
fn a_code_that_leaves_a_pipe_or_a_device_as_its_result_fails() {
    let bench = Bench::with_system_programs();
    for (command, kind) in [
        ("mkfifo log.liggghts", "a named pipe"),
        ("ln -s /dev/zero log.liggghts", "a symbolic link"),
        ("mkdir log.liggghts", "a directory"),
    ] {
        bench.install("liggghts", &unless_asked_for_its_version(command));
        for place in ["", "--out run"] {
            let line = format!("simulate --code liggghts --mu 0.3 --stiffness 100 {place}");
            let (status, message) = outcome(&bench, &line);
            assert_eq!(status, Some(3), "{message}");
            let told = format!("cannot read log.liggghts: it is {kind}");
            assert!(message.contains(&told), "{message}");
        }
        fs::remove_dir_all(bench.path("run")).expect("it is there");
    }
}

#[test]
fn the_evidence_of_a_failed_run_is_not_shortened_elsewhere() {
    let bench = Bench::with_system_programs();
    let mine = bench.path("mine.bin");
    fs::File::create(&mine)
        .and_then(|file| file.set_len(10 << 20))
        .expect("a file");
    let command = format!("ln '{}' original.bin; exit 7", mine.display());
    let script = unless_asked_for_its_version(&command);
    bench.install("liggghts", &script);
    let line = "simulate --code liggghts --mu 0.3 --stiffness 100";
    assert_eq!(outcome(&bench, line).0, Some(3));
    assert_eq!(fs::metadata(&mine).expect("it is there").len(), 10 << 20);
    assert_eq!(
        fs::metadata(&mine).expect("it is there").nlink(),
        2,
        "the link was kept"
    );
}

#[test]
fn the_case_of_a_run_directory_is_still_a_case() {
    let bench = Bench::without_codes();
    assert_eq!(outcome(&bench, &format!("{RUN} --out run")).0, Some(0));
    let case = tristack::files::read_case(&bench.path("run/case.json")).expect("a case");
    assert_eq!(case.stack.floor_friction, 0.3);
}
