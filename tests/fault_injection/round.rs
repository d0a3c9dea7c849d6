//! One fault, from the first process to the last look at what it has left.

use super::common::Bench;
use super::fault::{Fault, ProcessFault, StoreFault};
use super::processes;
use super::workload::{Workload, Workloads};
use super::{code_faults, disk, process_faults, store_faults};
use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;
use tristack::model::sha256_hex;

/// Insides of the wrapped code that compute as they should.
pub const HONEST: &str = "honest";

/// A place, something to compute there, and chance.
pub struct Round<'a> {
    pub bench: Bench,
    pub workload: &'a Workload,
    pub workloads: &'a Workloads,
    pub random: fastrand::Rng,
}

/// Effects of a fault, and the outcomes that it allows.
#[derive(Default)]
pub struct Aftermath {
    /// Output of the disturbed programs.
    pub outputs: Vec<Output>,
    /// Output of the programs that ran beside them until they were killed.
    pub killed: Vec<Output>,
    /// Whether the fault came in time to disturb anything.
    pub struck: bool,
    /// Whether they must have come to the same result as if nothing had happened.
    pub harmless: bool,
    /// Whether at least one row must have got no agreement.
    pub harmful: bool,
    /// Whether what is in the store was made by a wrong code, so that going on means to begin anew.
    pub begin_anew: bool,
    /// Number of runs that will be made again because they are damaged.
    pub damaged: usize,
    /// Number of runs in the store that were made by another program than the one that goes on.
    pub foreign: usize,
    /// Number of finished runs that a disturbed program had to make once more.
    pub made_again: usize,
}

impl Aftermath {
    fn all_outputs(&self) -> impl Iterator<Item = &Output> {
        self.outputs.iter().chain(&self.killed)
    }
}

/// Result of a round.
#[derive(Debug, Clone, Copy)]
pub struct Story {
    /// Whether the fault came in time.
    pub struck: bool,
    /// Runs that the disturbed programs had said were finished.
    pub finished_before: usize,
    /// Runs that were made after the fault.
    pub made_after: usize,
    /// Whether native or a real code was at work, not the replayed one.
    pub real: bool,
}

impl<'a> Round<'a> {
    /// Lets `fault` strike, with the chances of `seed`.
    ///
    /// # Errors
    /// A complaint about what went wrong.
    pub fn play(fault: Fault, workloads: &'a Workloads, seed: u64) -> Result<Story, String> {
        if let Fault::Folder(fault) = fault {
            return workloads.folders.play(fault, seed);
        }
        let mut random = fastrand::Rng::with_seed(seed);
        let workload = choose(fault, workloads, &mut random);
        let mut round = Self {
            bench: Bench::with_system_programs(),
            workload,
            workloads,
            random,
        };
        if std::ptr::eq(workload, &workloads.replayed) {
            workloads.install_replay(&round.bench);
        }
        if std::ptr::eq(workload, &workloads.wrapped) {
            workloads.install_wrapped(&round.bench, HONEST);
        }
        let aftermath = match fault {
            Fault::Process(fault) => process_faults::strike(fault, &mut round),
            Fault::Code(fault) => code_faults::strike(fault, &mut round),
            Fault::Store(fault) => store_faults::strike(fault, &mut round),
            Fault::Disk(fault) => disk::strike(fault, &mut round),
            Fault::Folder(_) => unreachable!("it was played above"),
        };
        // Whatever is wrong, nothing may go on running in a place that is about to be removed.
        let ended = processes::all_ended(&round.root());
        let aftermath = aftermath?;
        ended?;
        round.look_at_outputs(&aftermath)?;
        let finished_before = round.look_at_finished(&aftermath)?;
        let made_after = round.go_on(&aftermath)?;
        round.look_for_leftovers(&aftermath)?;
        Ok(Story {
            struck: aftermath.struck,
            finished_before,
            made_after,
            real: !round.is_replayed(),
        })
    }

    /// Whether the code is one that replays recorded runs.
    pub fn is_replayed(&self) -> bool {
        let fakes = [&self.workloads.replayed, &self.workloads.wrapped];
        fakes.iter().any(|fake| std::ptr::eq(self.workload, *fake))
    }

    pub fn root(&self) -> PathBuf {
        self.bench.path("")
    }

    /// A tristack at work, with further `options`.
    pub fn command(&self, options: &str) -> Command {
        let mut command = self
            .bench
            .process(&format!("{} {options}", self.workload.line));
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    pub fn start(&self, options: &str) -> Child {
        self.command(options).spawn().expect("it starts")
    }

    pub fn run(&self, options: &str) -> Output {
        self.command(options).output().expect("it runs")
    }

    /// Waits for some time that the work takes, or a little more; every other time, because many rounds at once take
    /// longer, until `child` or its like have finished some of their runs, or it has ended.
    pub fn wait_for_a_moment(&mut self, child: &mut Child) {
        if self.random.bool() {
            std::thread::sleep(self.workload.duration.mul_f64(1.2 * self.random.f64()));
            return;
        }
        let last = self.workload.cases.len() - 1;
        let present = self.entries().len().min(last);
        let kept = self.random.usize(present..=last);
        while self.entries().len() < kept && is_running(child) {
            std::thread::sleep(Duration::from_millis(2));
        }
        std::thread::sleep(Duration::from_millis(self.random.u64(..=50)));
    }

    pub fn moment(&mut self) -> Duration {
        self.workload.duration.mul_f64(self.random.f64())
    }

    pub fn store(&self) -> PathBuf {
        self.bench.path("store")
    }

    /// The directories of all runs in the store.
    pub fn entries(&self) -> Vec<PathBuf> {
        let below = |directory: &Path| {
            let entries = fs::read_dir(directory).into_iter().flatten().flatten();
            let mut paths: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
            paths.sort();
            paths
        };
        let groups = below(&self.store().join("runs"));
        groups.iter().flat_map(|group| below(group)).collect()
    }

    /// No program may have printed anything wrong, and those that were not killed ended as the fault allows.
    fn look_at_outputs(&self, aftermath: &Aftermath) -> Result<(), String> {
        for output in aftermath.all_outputs() {
            self.look_for_mistakes(output)?;
        }
        for output in &aftermath.outputs {
            let same = output.stdout == self.workload.expected.as_bytes();
            let same = same && output.status.success();
            if aftermath.harmless && !same {
                let told = told(output);
                return Err(format!("another result: {:?}\n{told}", output.status));
            }
            if aftermath.harmful && (same || output.status.success()) {
                return Err(format!("nobody noticed\n{}", told(output)));
            }
        }
        Ok(())
    }

    /// A row is the one that nothing has happened to, or it is no agreement.
    fn look_for_mistakes(&self, output: &Output) -> Result<(), String> {
        let expected: Vec<&str> = self.workload.expected.lines().collect();
        let text = String::from_utf8_lossy(&output.stdout);
        let suspicious = text.lines().find(|line| {
            let known = expected.contains(line);
            !known && line.ends_with(",agrees")
        });
        if let Some(row) = suspicious {
            return Err(format!("a wrong agreement: {row}\n{}", told(output)));
        }
        if told(output).contains("panicked") {
            return Err(format!("a panic\n{}", told(output)));
        }
        Ok(())
    }

    /// Every run reported as finished is in the store, and whole; none was run twice without need.
    fn look_at_finished(&self, aftermath: &Aftermath) -> Result<usize, String> {
        let finished: usize = aftermath.all_outputs().map(finished_runs).sum();
        let entries = self.entries();
        let whole = entries.iter().filter(|entry| is_whole(entry)).count();
        if whole + aftermath.damaged != entries.len() {
            return Err(format!("{whole} of {} entries are whole", entries.len()));
        }
        let cases = self.workload.cases.len();
        if finished > cases + aftermath.made_again {
            return Err(format!("{finished} runs were finished, of {cases}"));
        }
        let said = finished.min(cases);
        if entries.len() < said {
            let kept = entries.len();
            return Err(format!("{said} runs were finished, {kept} are kept"));
        }
        Ok(finished.max(entries.len()))
    }

    /// Goes on without faults; returns how many runs were made.
    fn go_on(&self, aftermath: &Aftermath) -> Result<usize, String> {
        let before = self.stamps();
        let options = if aftermath.begin_anew { "--fresh" } else { "" };
        let output = self.run(options);
        let message = String::from_utf8_lossy(&output.stderr);
        if !output.status.success() || output.stdout != self.workload.expected.as_bytes() {
            return Err(format!("going on gives another result\n{}", told(&output)));
        }
        if message.matches("damaged").count() != aftermath.damaged {
            return Err(format!("damage is not told as it is\n{message}"));
        }
        let after = self.stamps();
        let untouched = before
            .iter()
            .filter(|(path, stamp)| after.get(*path) == Some(stamp));
        let lost = before.len() - untouched.count();
        if !aftermath.begin_anew && lost != aftermath.damaged {
            return Err(format!("{lost} finished runs were made again\n{message}"));
        }
        let (made, kept) = (finished_runs(&output), before.len());
        let useless = match aftermath.begin_anew {
            true => kept,
            false => aftermath.damaged + aftermath.foreign,
        };
        if made + kept != self.workload.cases.len() + useless {
            let of_no_use = format!("{useless} of {kept} runs in the store were of no use");
            return Err(format!("{of_no_use}, {made} were made\n{message}"));
        }
        Ok(made)
    }

    /// Stamps that distinguish an entry from another one in its place.
    fn stamps(&self) -> BTreeMap<PathBuf, u64> {
        let entries = self.entries().into_iter();
        let stamps = entries.filter_map(|entry| {
            let number = fs::metadata(&entry).ok()?.ino();
            Some((entry, number))
        });
        stamps.collect()
    }

    /// Nothing temporary is left, but what failed runs have to show.
    fn look_for_leftovers(&self, aftermath: &Aftermath) -> Result<(), String> {
        processes::all_ended(&self.root())?;
        let mut left = Vec::new();
        let mut directories = vec![self.root()];
        while let Some(directory) = directories.pop() {
            for entry in fs::read_dir(&directory).expect("a directory").flatten() {
                let (path, name) = (entry.path(), entry.file_name());
                let name = name.to_string_lossy().into_owned();
                let temporary = [".tmp", ".home", "tristack-"];
                let temporary = temporary.iter().any(|prefix| name.starts_with(prefix));
                if temporary || name.contains("draft-") {
                    left.push(path.clone());
                }
                if directory.ends_with("store/sessions") {
                    left.push(path.clone());
                }
                // Evidence of failures is kept for inspection.
                let kept = directory.ends_with("store/work") && may_leave_evidence(aftermath);
                if directory.ends_with("store/work") && !kept {
                    left.push(path.clone());
                }
                if path.is_dir() && !kept {
                    directories.push(path);
                }
            }
        }
        match left.as_slice() {
            [] => Ok(()),
            left => Err(format!("left behind: {left:?}")),
        }
    }
}

fn may_leave_evidence(aftermath: &Aftermath) -> bool {
    let failed = |output: &Output| String::from_utf8_lossy(&output.stderr).contains("failed");
    aftermath.all_outputs().any(failed)
}

/// Everything that a program said.
fn told(output: &Output) -> String {
    let [text, message] =
        [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes));
    format!("{text}\n{message}")
}

/// Number of runs that a program said it has made, less those that it could not keep. It says so at the end of a phase,
/// so that one that was killed has said nothing.
pub fn finished_runs(output: &Output) -> usize {
    let message = String::from_utf8_lossy(&output.stderr);
    if message.contains(disk::NOT_KEPT) {
        return 0;
    }
    let made = message.lines().filter_map(|line| {
        let numbers = line.strip_prefix("compressions: ")?;
        numbers.split_once(" of ")?.0.parse::<usize>().ok()
    });
    let lost = message.matches("a finished run could not be kept");
    made.sum::<usize>().saturating_sub(lost.count())
}

pub fn is_running(child: &mut Child) -> bool {
    child.try_wait().expect("it can be watched").is_none()
}

fn choose<'a>(fault: Fault, all: &'a Workloads, random: &mut fastrand::Rng) -> &'a Workload {
    use ProcessFault as P;
    let real = &all.real[random.usize(..all.real.len())];
    let native = &all.real[0];
    let often_real = random.f64() < 0.4;
    match fault {
        Fault::Code(_) | Fault::Process(P::CodeReplaced) => &all.replayed,
        // A code that hangs without a time limit must not be waited for.
        Fault::Process(P::CodeStopped | P::KilledWhileCodeHangs | P::InterruptedTwice) => {
            &all.replayed
        }
        Fault::Process(P::CodeKilled | P::GuardKilled) if std::ptr::eq(real, native) => {
            &all.replayed
        }
        Fault::Process(P::HiddenCodeReplaced) => &all.wrapped,
        Fault::Store(StoreFault::MadeByAnotherProgram) => &all.replayed,
        _ if often_real => real,
        _ => &all.replayed,
    }
}

/// Whether every file of an entry is the one that was written.
pub fn is_whole(entry: &Path) -> bool {
    let content = |name: &str| {
        let path = entry.join(name);
        let is_file = fs::symlink_metadata(&path).is_ok_and(|found| found.is_file());
        is_file.then(|| fs::read(&path).ok()).flatten()
    };
    let sums = content("SHA256SUMS").unwrap_or_default();
    let sums = String::from_utf8_lossy(&sums);
    let right = sums.lines().filter(|line| {
        let (digest, name) = line.split_once("  ").unwrap_or_default();
        content(name).is_some_and(|content| sha256_hex(&content) == digest)
    });
    right.count() == 3
}
