//! The array of cluster/crosscheck.slurm on a real Slurm: the tasks share the work, a node that dies and a task that runs
//! out of time lose what they were at and nothing else, and every task ends with the rows of one undisturbed machine.

#[path = "../common/mod.rs"]
mod common;

mod cluster;

use cluster::{Cluster, NODES};
use common::{Bench, OWN_PROGRAM, files_below, project};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

const LINE: &str = "--codes native,lammps --mu 0.2,0.3 --stiffness 1e2";
const TASKS: usize = 3;
/// A LAMMPS that notes on which node it begins and finishes which run of the store, and begins no stack there as long as the
/// node is held. A start of tristack has it make another run, as a witness to what is installed.
fn install_noting_lammps(bench: &Bench) {
    let [noted, hold] = ["noted", "hold"].map(|name| bench.path(name).display().to_string());
    let script = format!(
        "case $PWD in */store/work/*) ;; *) exec /usr/bin/lmp \"$@\" ;; esac\n\
         note() {{ echo $1 $(hostname) $(cat *.in | sha256sum) >> {noted}; }}\n\
         note begun\n\
         if [ -f stack.in ] && [ -e {hold}-$(hostname) ]; then\n\
             note held\n\
             while [ -e {hold}-$(hostname) ]; do sleep 0.05; done\n\
         fi\n\
         /usr/bin/lmp \"$@\" || exit\n\
         note finished\n"
    );
    bench.install("lmp", &script);
    for node in NODES {
        fs::write(bench.path(&format!("hold-{node}")), "").expect("a file");
    }
}

fn release(bench: &Bench, node: &str) {
    fs::remove_file(bench.path(&format!("hold-{node}"))).expect("it is there");
}

/// What was noted: begun, held or finished, on which node, which run.
fn noted(bench: &Bench) -> Vec<[String; 3]> {
    let text = fs::read_to_string(bench.path("noted")).unwrap_or_default();
    let lines = text.lines().map(|line| {
        let mut words = line.split_whitespace().map(str::to_owned);
        [(); 3].map(|()| words.next().unwrap_or_default())
    });
    lines.collect()
}

/// The script, edited as its page says.
fn edited_script(bench: &Bench) {
    let script = fs::read_to_string(project().join("cluster/crosscheck.slurm")).expect("a script");
    let mut lines: Vec<String> = script.lines().map(str::to_owned).collect();
    let edits = [
        (
            "#SBATCH --array=",
            format!("#SBATCH --array=1-{TASKS} # EDIT: as it stands there"),
        ),
        (
            "#SBATCH --time=",
            "#SBATCH --time=00:30:00 # EDIT: as it stands there".to_owned(),
        ),
        (
            "directory=",
            format!("directory={}", bench.path("shared").display()),
        ),
    ];
    for (beginning, edit) in edits {
        let line = lines.iter_mut().find(|line| line.starts_with(beginning));
        let line = line.expect("a line to edit");
        assert!(line.contains("# EDIT"), "{line}");
        *line = edit;
    }
    fs::write(bench.path("crosscheck.slurm"), lines.join("\n")).expect("a script");
}

/// The content of every file of the rows in `directory`.
fn rows(directory: &Path) -> BTreeMap<String, Vec<u8>> {
    let files = files_below(directory).into_iter();
    let files = files.map(|file| {
        let content = fs::read(directory.join(&file)).expect("a file");
        (file.display().to_string(), content)
    });
    files.collect()
}

#[test]
fn an_array_that_loses_a_node_and_runs_out_of_time_gives_the_rows_of_one_machine() {
    if !cluster::is_possible()
        || common::installed(&[tristack::code::Code::named("lammps").expect("a code")]).is_empty()
    {
        return;
    }
    let bench = Bench::with_system_programs();
    install_noting_lammps(&bench);
    edited_script(&bench);
    let mut cluster = Cluster::start(&bench);
    let mut sbatch = cluster.command("sbatch");
    sbatch
        .args(["--parsable", "crosscheck.slurm"])
        .args(LINE.split(' '));
    let submitted = sbatch
        .env("TRISTACK", OWN_PROGRAM)
        .output()
        .expect("it starts");
    let error = String::from_utf8_lossy(&submitted.stderr);
    assert!(submitted.status.success(), "{error}\n{}", cluster.logs());
    let job = String::from_utf8_lossy(&submitted.stdout).trim().to_owned();

    // Both nodes are making runs. One dies; the other is told that its time is up, and requeues its task itself.
    for node in NODES {
        let is_held = |note: &[String; 3]| note[0] == "held" && note[1] == node;
        cluster.wait_for("a run is under way", || noted(&bench).iter().any(is_held));
    }
    cluster.kill("n2");
    release(&bench, "n2");
    let running = cluster.ask("squeue --noheader --states=running --format=%i");
    assert_eq!(running.lines().count(), 1, "{running}");
    let survivor = running.trim();
    cluster.ask(&format!("scancel --full --signal=USR1 {survivor}"));
    let out = bench.path(&format!("crosscheck-{}.txt", survivor.replace('_', "-")));
    let told = |part| fs::read_to_string(&out).is_ok_and(|text| text.contains(part));
    cluster.wait_for("the task ends", || told("out of time with"));
    release(&bench, "n1");
    cluster.boot("n2");
    cluster.wait_for("the array ends", || {
        cluster.ask("squeue --noheader").is_empty()
    });
    for task in 1..=TASKS {
        let state = cluster.ask(&format!("scontrol --oneliner show job {job}_{task}"));
        let told = fs::read_to_string(bench.path(&format!("crosscheck-{job}-{task}.txt")));
        assert!(
            state.contains("JobState=COMPLETED"),
            "{state}\n{}",
            told.unwrap_or_default()
        );
    }

    // What was finished was made once, and what was lost is what was begun and not finished.
    let notes = noted(&bench);
    let mut finished = BTreeMap::new();
    for note in notes.iter().filter(|note| note[0] == "finished") {
        *finished.entry(note[2].as_str()).or_insert(0) += 1;
    }
    let often: Vec<_> = finished.iter().filter(|(_, times)| **times != 1).collect();
    assert!(often.is_empty(), "made more than once: {often:?}");
    assert!(finished.len() > 10, "{notes:?}");
    let begun = notes.iter().filter(|note| note[0] == "begun").count();
    assert_eq!(
        begun - finished.len(),
        2,
        "one by the dead node, one by the task that was out of time"
    );

    // The rows of one machine, with a store of its own.
    let line = format!("crosscheck {LINE} --out alone");
    let alone = bench.tristack(&line).output().expect("it runs");
    assert_eq!(
        alone.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&alone.stderr)
    );
    let expected = rows(&bench.path("alone"));
    assert!(expected.contains_key("crosscheck.csv"));
    for task in 1..=TASKS {
        let found = rows(&bench.path(&format!("shared/rows/{task}")));
        assert!(found == expected, "task {task} has other rows");
    }
}
