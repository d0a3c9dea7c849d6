//! Faults that strike running processes.

use super::common::{replay, wait_a_minute_for};
use super::fault::{ProcessFault, fake_clock};
use super::processes::{self, Process};
use super::round::{Aftermath, HONEST, Round, is_running};
use super::workload::{Workload, address, asked};
use nix::sys::signal::Signal;
use std::collections::BTreeSet;
use std::fs;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Child, Output};
use std::time::{Duration, Instant};
use tristack::code::{Code, witness_test};
use tristack::dem::compress_stack;
use tristack::model::sha256_hex;

/// A second interrupt is immediate: no more than this on a busy machine.
const IMMEDIATE: Duration = Duration::from_secs(1);

pub fn strike(fault: ProcessFault, round: &mut Round) -> Result<Aftermath, String> {
    match fault {
        ProcessFault::Killed => Ok(kill_times(1, round)),
        ProcessFault::KilledTwice => Ok(kill_times(2, round)),
        ProcessFault::KilledWhileCodeHangs => kill_while_code_hangs(round),
        ProcessFault::Interrupted => interrupt(Signal::SIGINT, round),
        ProcessFault::Terminated => interrupt(Signal::SIGTERM, round),
        ProcessFault::InterruptedTwice => interrupt_twice(round),
        ProcessFault::StoppedForAWhile => Ok(stop_for_a_while(round)),
        ProcessFault::CodeKilled => Ok(signal_others(Process::is_foreign, Signal::SIGKILL, round)),
        ProcessFault::CodeStopped => Ok(signal_others(Process::is_foreign, Signal::SIGSTOP, round)),
        ProcessFault::GuardKilled => Ok(signal_others(Process::is_guard, Signal::SIGKILL, round)),
        ProcessFault::CodeReplaced => Ok(replace_code(round)),
        ProcessFault::HiddenCodeReplaced => Ok(replace_hidden_code(round)),
        ProcessFault::ClockJumps => Ok(let_clock_jump(round)),
        ProcessFault::TwoAtOnce => run_two(round, false),
        ProcessFault::TwoAtOnceOneKilled => run_two(round, true),
    }
}

fn signal(child: &mut Child, signal: Signal) {
    // The number of one that has ended may already be that of another process.
    if is_running(child) {
        let process = Process {
            number: child.id() as i32,
            command: String::new(),
        };
        process.signal(signal);
    }
}

fn finish(child: Child) -> Output {
    child.wait_with_output().expect("it ends")
}

/// Waits until the replayed code is asked for the series under `address`.
fn wait_until_asked(round: &Round, address: &str) -> Result<(), String> {
    let is_asked = || asked(&round.bench).iter().any(|asked| asked == address);
    wait_a_minute_for(|| is_asked().then_some(()))
        .ok_or_else(|| format!("nobody has asked for {address}"))
}

fn kill_times(times: usize, round: &mut Round) -> Aftermath {
    let mut aftermath = Aftermath::default();
    for _ in 0..times {
        let mut child = round.start("");
        round.wait_for_a_moment(&mut child);
        signal(&mut child, Signal::SIGKILL);
        let output = finish(child);
        aftermath.struck |= output.status.signal() == Some(Signal::SIGKILL as i32);
        aftermath.outputs.push(output);
    }
    aftermath
}

/// The code would go on for ten minutes, and so would what it has started.
fn kill_while_code_hangs(round: &mut Round) -> Result<Aftermath, String> {
    let first = address(&round.workload.cases[0]);
    let hang = round.bench.path(&format!("replay/{first}.sh"));
    fs::write(&hang, "setsid sleep 600 & sleep 600").expect("a script");
    let mut child = round.start("");
    let begun = wait_until_asked(round, &first);
    std::thread::sleep(Duration::from_millis(round.random.u64(..300)));
    signal(&mut child, Signal::SIGKILL);
    fs::remove_file(hang).expect("it is there");
    let outputs = vec![finish(child)];
    begun.map(|()| Aftermath {
        outputs,
        struck: true,
        ..Aftermath::default()
    })
}

fn interrupt(how: Signal, round: &mut Round) -> Result<Aftermath, String> {
    let mut child = round.start("");
    round.wait_for_a_moment(&mut child);
    signal(&mut child, how);
    let output = finish(child);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    match output.status.code() {
        Some(130) if message.contains("interrupted") => {}
        Some(0) => {}
        // The signal came before its handler was installed.
        None if output.status.signal() == Some(how as i32) => {}
        code => return Err(format!("it ended with {code:?}\n{message}")),
    }
    let sessions = round.store().join("sessions");
    let left = fs::read_dir(sessions).into_iter().flatten().count();
    if output.status.code().is_some() && left > 0 {
        return Err(format!("{left} sessions are open after an interrupt"));
    }
    Ok(Aftermath {
        struck: output.status.code() == Some(130),
        outputs: vec![output],
        ..Aftermath::default()
    })
}

/// The guard is stopped, so that a single interrupt would have to wait for it.
fn interrupt_twice(round: &mut Round) -> Result<Aftermath, String> {
    let first = address(&round.workload.cases[0]);
    let hang = round.bench.path(&format!("replay/{first}.sh"));
    fs::write(&hang, "sleep 600").expect("a script");
    let mut child = round.start("");
    let begun = wait_until_asked(round, &first);
    let guards = processes::of(&round.root());
    let guards: Vec<Process> = guards.into_iter().filter(Process::is_guard).collect();
    let tell_guards = |what| guards.iter().for_each(|guard| guard.signal(what));
    tell_guards(Signal::SIGSTOP);
    signal(&mut child, Signal::SIGINT);
    std::thread::sleep(Duration::from_millis(100 + round.random.u64(..300)));
    let waited = is_running(&mut child);
    let second = Instant::now();
    signal(&mut child, Signal::SIGINT);
    let output = finish(child);
    let took = second.elapsed();
    tell_guards(Signal::SIGCONT);
    fs::remove_file(hang).expect("it is there");
    begun?;
    if !waited || took > IMMEDIATE || output.status.code() != Some(130) {
        let status = output.status;
        return Err(format!(
            "it waited: {waited}; it ended after {took:?}, {status}"
        ));
    }
    Ok(Aftermath {
        outputs: vec![output],
        struck: true,
        ..Aftermath::default()
    })
}

/// In about every fourth round the pause is longer than the time limit of a run: time while stopped does not count.
fn stop_for_a_while(round: &mut Round) -> Aftermath {
    // On a busy machine a real code may need as much by itself; 0.6 of the rounds are replayed.
    let long = round.is_replayed() && round.random.f64() < 0.4;
    let (options, pause) = match long {
        true => ("--time-limit 3", Duration::from_secs(4)),
        false => ("", Duration::from_millis(300)),
    };
    let mut child = round.start(options);
    round.wait_for_a_moment(&mut child);
    let struck = is_running(&mut child);
    signal(&mut child, Signal::SIGSTOP);
    std::thread::sleep(pause);
    signal(&mut child, Signal::SIGCONT);
    Aftermath {
        struck,
        outputs: vec![finish(child)],
        harmless: true,
        ..Aftermath::default()
    }
}

fn signal_others(which: fn(&Process) -> bool, how: Signal, round: &mut Round) -> Aftermath {
    let mut child = round.start("--time-limit 2");
    round.wait_for_a_moment(&mut child);
    let processes = processes::of(&round.root());
    let struck: Vec<Process> = processes.into_iter().filter(which).collect();
    struck.iter().for_each(|process| process.signal(how));
    Aftermath {
        struck: !struck.is_empty(),
        outputs: vec![finish(child)],
        ..Aftermath::default()
    }
}

fn replace_code(round: &mut Round) -> Aftermath {
    let mut child = round.start("");
    round.wait_for_a_moment(&mut child);
    let program = round.bench.path("programs/yade");
    let script = fs::read_to_string(&program).expect("a script");
    round.bench.install("new", &format!("{script}\n# rebuilt"));
    fs::rename(round.bench.path("programs/new"), &program).expect("it is replaced");
    let output = finish(child);
    Aftermath {
        struck: String::from_utf8_lossy(&output.stderr).contains("was replaced"),
        outputs: vec![output],
        foreign: made_by_others(round, &program),
        ..Aftermath::default()
    }
}

/// After some runs, or all, a program with a rougher floor computes behind the same wrapper.
fn replace_hidden_code(round: &mut Round) -> Aftermath {
    let mut child = round.start("");
    if round.random.bool() {
        round.wait_for_a_moment(&mut child);
        signal(&mut child, Signal::SIGKILL);
    }
    let honest = finish(child);
    let kept = round.entries().len();
    let rougher = 1.0 + 10f64.powf(-1.0 - 3.0 * round.random.f64());
    let insides = "rough";
    round.workloads.install_wrapped(&round.bench, insides);
    install_rougher(&round.bench.path(insides), round.workload, rougher);
    let output = round.run("");
    let foreign = round.entries().len() - kept;
    round.workloads.install_wrapped(&round.bench, HONEST);
    Aftermath {
        killed: vec![honest],
        outputs: vec![output],
        struck: kept > 0,
        harmful: true,
        foreign,
        made_again: foreign,
        ..Aftermath::default()
    }
}

/// Puts into `insides` the answers of a program whose floor is rougher by the factor `rougher`.
fn install_rougher(insides: &Path, workload: &Workload, rougher: f64) {
    let yade = Code::named("yade").expect("it is built in");
    for case in &workload.cases {
        let mut changed = *case;
        changed.stack.floor_friction *= rougher;
        let series = compress_stack(&changed, || true).expect("a finite series");
        let path = insides.join(format!("{}.csv", address(case)));
        fs::write(path, series.to_csv()).expect("a series");
    }
    let asked = witness_test(yade.declaration().convention);
    let mut changed = asked;
    changed.floor_friction *= rougher;
    replay::install_motion_as(insides, &asked, &changed);
}

/// Number of runs in the store that were not made by `program` as it is now.
fn made_by_others(round: &Round, program: &Path) -> usize {
    let hash = sha256_hex(&fs::read(program).expect("a script"));
    let entries = round.entries().into_iter();
    let others = entries.filter(|entry| {
        let provenance = fs::read_to_string(entry.join("provenance.json"));
        !provenance.is_ok_and(|text| text.contains(&hash))
    });
    others.count()
}

fn let_clock_jump(round: &mut Round) -> Aftermath {
    let clock = round.bench.path("clock");
    let set = |offset: &str| fs::write(&clock, offset).expect("a clock");
    set("+0");
    let mut command = round.command("");
    command
        .env("LD_PRELOAD", fake_clock().expect("it is installed"))
        .env("FAKETIME_TIMESTAMP_FILE", &clock)
        .env("FAKETIME_NO_CACHE", "1")
        .env("FAKETIME_DONT_FAKE_MONOTONIC", "1");
    let mut child = command.spawn().expect("it starts");
    let jump = ["-9000d", "+9000d", "-3600s"][round.random.usize(..3)];
    round.wait_for_a_moment(&mut child);
    let struck = is_running(&mut child);
    set(jump);
    Aftermath {
        struck,
        outputs: vec![finish(child)],
        harmless: true,
        ..Aftermath::default()
    }
}

fn run_two(round: &mut Round, kill_one: bool) -> Result<Aftermath, String> {
    let mut first = round.start("");
    std::thread::sleep(round.moment().mul_f64(0.5));
    let mut struck = is_running(&mut first);
    let second = round.start("");
    let (mut outputs, mut killed) = (Vec::new(), Vec::new());
    if kill_one {
        let (mut victim, other) = match round.random.bool() {
            true => (first, second),
            false => (second, first),
        };
        round.wait_for_a_moment(&mut victim);
        signal(&mut victim, Signal::SIGKILL);
        let output = finish(victim);
        struck &= output.status.signal().is_some();
        killed.push(output);
        outputs.push(finish(other));
    } else {
        outputs.extend([finish(first), finish(second)]);
        let asked = asked(&round.bench);
        let different: BTreeSet<&String> = asked.iter().collect();
        if different.len() != asked.len() {
            return Err(format!(
                "{} runs were made, {} of them different",
                asked.len(),
                different.len()
            ));
        }
    }
    Ok(Aftermath {
        struck,
        outputs,
        killed,
        harmless: true,
        ..Aftermath::default()
    })
}
