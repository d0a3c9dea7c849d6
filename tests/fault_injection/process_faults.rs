//! Faults that strike running processes.

use super::fault::{ProcessFault, fake_clock};
use super::processes::{self, Process};
use super::round::{Aftermath, Round};
use super::workload::{address, asked};
use nix::sys::signal::Signal;
use std::collections::BTreeSet;
use std::fs;
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Output};
use std::time::{Duration, Instant};

/// A second interrupt is immediate: no more than this on a busy machine.
const IMMEDIATE: Duration = Duration::from_secs(1);

pub fn strike(fault: ProcessFault, round: &mut Round) -> Result<Aftermath, String> {
    match fault {
        ProcessFault::Killed => Ok(kill_times(1, round)),
        ProcessFault::KilledTwice => Ok(kill_times(2, round)),
        ProcessFault::KilledWhileEngineHangs => Ok(kill_while_engine_hangs(round)),
        ProcessFault::Interrupted => interrupt(Signal::SIGINT, round),
        ProcessFault::Terminated => interrupt(Signal::SIGTERM, round),
        ProcessFault::InterruptedTwice => interrupt_twice(round),
        ProcessFault::StoppedForAWhile => Ok(stop_for_a_while(round)),
        ProcessFault::EngineKilled => {
            Ok(signal_others(Process::is_foreign, Signal::SIGKILL, round))
        }
        ProcessFault::EngineStopped => {
            Ok(signal_others(Process::is_foreign, Signal::SIGSTOP, round))
        }
        ProcessFault::GuardKilled => Ok(signal_others(Process::is_guard, Signal::SIGKILL, round)),
        ProcessFault::EngineReplaced => Ok(replace_engine(round)),
        ProcessFault::ClockJumps => Ok(let_clock_jump(round)),
        ProcessFault::TwoAtOnce => run_two(round, false),
        ProcessFault::TwoAtOnceOneKilled => run_two(round, true),
    }
}

fn signal(child: &Child, signal: Signal) {
    let process = Process {
        number: child.id() as i32,
        command: String::new(),
    };
    process.signal(signal);
}

fn is_running(child: &mut Child) -> bool {
    child.try_wait().expect("it can be watched").is_none()
}

fn finish(child: Child) -> Output {
    child.wait_with_output().expect("it ends")
}

fn kill_times(times: usize, round: &mut Round) -> Aftermath {
    let mut aftermath = Aftermath::default();
    for _ in 0..times {
        let child = round.start("");
        round.wait_for_a_moment();
        signal(&child, Signal::SIGKILL);
        let output = finish(child);
        aftermath.struck |= output.status.signal() == Some(Signal::SIGKILL as i32);
        aftermath.outputs.push(output);
    }
    aftermath
}

/// The engine would go on for ten minutes, and so would what it has started.
fn kill_while_engine_hangs(round: &mut Round) -> Aftermath {
    let first = address(&round.workload.cases[0]);
    let hang = round.bench.path(&format!("replay/{first}.sh"));
    fs::write(&hang, "setsid sleep 600 & sleep 600").expect("a script");
    let child = round.start("");
    while !asked(&round.bench).contains(&first) {
        std::thread::sleep(Duration::from_millis(5));
    }
    std::thread::sleep(Duration::from_millis(round.random.u64(..300)));
    signal(&child, Signal::SIGKILL);
    fs::remove_file(hang).expect("it is there");
    Aftermath {
        outputs: vec![finish(child)],
        struck: true,
        ..Aftermath::default()
    }
}

fn interrupt(how: Signal, round: &mut Round) -> Result<Aftermath, String> {
    let child = round.start("");
    round.wait_for_a_moment();
    signal(&child, how);
    let output = finish(child);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    match output.status.code() {
        Some(130) if message.contains("interrupted") => {}
        Some(0) => {}
        // So early that nobody listened yet.
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
    while !asked(&round.bench).contains(&first) {
        std::thread::sleep(Duration::from_millis(5));
    }
    let guards = processes::of(&round.root());
    let guards: Vec<Process> = guards.into_iter().filter(Process::is_guard).collect();
    let tell_guards = |what| guards.iter().for_each(|guard| guard.signal(what));
    tell_guards(Signal::SIGSTOP);
    signal(&child, Signal::SIGINT);
    std::thread::sleep(Duration::from_millis(100 + round.random.u64(..300)));
    let waited = is_running(&mut child);
    let second = Instant::now();
    signal(&child, Signal::SIGINT);
    let output = finish(child);
    let took = second.elapsed();
    tell_guards(Signal::SIGCONT);
    fs::remove_file(hang).expect("it is there");
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

fn stop_for_a_while(round: &mut Round) -> Aftermath {
    let mut child = round.start("");
    round.wait_for_a_moment();
    let struck = is_running(&mut child);
    signal(&child, Signal::SIGSTOP);
    std::thread::sleep(Duration::from_millis(300));
    signal(&child, Signal::SIGCONT);
    Aftermath {
        struck,
        outputs: vec![finish(child)],
        harmless: true,
        ..Aftermath::default()
    }
}

fn signal_others(which: fn(&Process) -> bool, how: Signal, round: &mut Round) -> Aftermath {
    let child = round.start("--time-limit 2");
    round.wait_for_a_moment();
    let processes = processes::of(&round.root());
    let struck: Vec<Process> = processes.into_iter().filter(which).collect();
    struck.iter().for_each(|process| process.signal(how));
    Aftermath {
        struck: !struck.is_empty(),
        outputs: vec![finish(child)],
        ..Aftermath::default()
    }
}

fn replace_engine(round: &mut Round) -> Aftermath {
    let child = round.start("");
    round.wait_for_a_moment();
    let program = round.bench.path("programs/yade");
    let script = fs::read_to_string(&program).expect("a script");
    round.bench.install("new", &format!("{script}\n# rebuilt"));
    fs::rename(round.bench.path("programs/new"), program).expect("it is replaced");
    let output = finish(child);
    Aftermath {
        struck: String::from_utf8_lossy(&output.stderr).contains("was replaced"),
        outputs: vec![output],
        ..Aftermath::default()
    }
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
    round.wait_for_a_moment();
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
    let mut outputs = Vec::new();
    if kill_one {
        round.wait_for_a_moment();
        let (killed, other) = match round.random.bool() {
            true => (first, second),
            false => (second, first),
        };
        signal(&killed, Signal::SIGKILL);
        struck &= finish(killed).status.signal().is_some();
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
        harmless: true,
        ..Aftermath::default()
    })
}
