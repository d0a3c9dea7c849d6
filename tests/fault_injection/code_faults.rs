//! Faults of a code that was to deliver a series.

use super::fault::CodeFault as E;
use super::round::{Aftermath, Round};
use super::workload::address;
use std::fs;
use tristack::model::Case;

/// Places of the columns that every series needs.
const NEEDED: [usize; 7] = [0, 1, 2, 12, 13, 14, 15];

pub fn strike(fault: E, round: &mut Round) -> Result<Aftermath, String> {
    let cases = &round.workload.cases;
    let victim = cases[round.random.usize(..cases.len())];
    let own = round.bench.path(&format!("replay/{}", address(&victim)));
    let own = |extension: &str| own.with_extension(extension);
    if let Some(command) = command(fault) {
        fs::write(own("sh"), command).expect("a script");
    } else {
        fs::write(own("csv"), series(fault, &victim, round)).expect("a series");
    }
    let options = match fault {
        E::Hangs | E::StopsItself => "--time-limit 1",
        // Harmless however long it takes, and on a busy machine it takes longer than a run may.
        E::WritesTenGigabytes => "--time-limit 600",
        _ => "",
    };
    let output = round.run(options);
    for extension in ["sh", "csv"] {
        let _ = fs::remove_file(own(extension));
    }
    let harmless = matches!(fault, E::LeavesADaemon | E::WritesTenGigabytes);
    let may_fit = matches!(fault, E::SeriesInOtherUnits | E::SeriesOfAnotherCase);
    Ok(Aftermath {
        outputs: vec![output],
        struck: true,
        harmless,
        harmful: !harmless,
        // A series may be whole and have the right steps, and yet be wrong.
        begin_anew: may_fit && round.entries().len() == round.workload.cases.len(),
        ..Aftermath::default()
    })
}

/// The command that the code executes before it would deliver the series.
fn command(fault: E) -> Option<&'static str> {
    let command = match fault {
        E::Crashes => "kill -SEGV $$",
        E::IsKilledForItsMemory => "kill -KILL $$",
        E::TakesTooMuchMemory => "python3 -c 'bytes(12 << 30)' || exit 1",
        E::Hangs => "sleep 600",
        E::StopsItself => "kill -STOP $$",
        E::EndsSilently => "exit 0",
        E::EndsWithAnError => "echo 'no such material' >&2; exit 7",
        E::LeavesADaemon => "setsid sleep 600 & (setsid sh -c 'sleep 600 & sleep 600' &)",
        E::WritesTenGigabytes => "head -c 10G /dev/zero; head -c 100M /dev/zero >&2",
        E::FillsAFile => "truncate -s 2G \"$directory/big\" || exit 1",
        E::LeavesANamedPipe => "mkfifo \"$directory/$result\"; exit 0",
        E::LeavesALinkToADevice => "ln -s /dev/zero \"$directory/$result\"; exit 0",
        _ => return None,
    };
    Some(command)
}

/// The bytes that the code delivers instead of the series of `victim`.
fn series(fault: E, victim: &Case, round: &mut Round) -> Vec<u8> {
    let right = round.workloads.series(victim);
    let text = String::from_utf8(right).expect("text");
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let row = round.random.usize(1..lines.len() - 1);
    match fault {
        E::SeriesTruncated => lines.truncate(row),
        E::SeriesCutInARow => {
            let length = lines[row].len();
            let cut = round.random.usize(..length);
            lines.truncate(row + 1);
            lines[row].truncate(cut);
        }
        E::SeriesReordered => lines.swap(row, row + 1),
        E::SeriesDuplicated => lines.insert(row, lines[row].clone()),
        E::SeriesNotANumber => {
            let cell = round.random.usize(2..14);
            let poison = ["NaN", "inf", "-inf", "nan", ""][round.random.usize(..5)];
            change_cells(&mut lines[row..=row], |cells| {
                cells[cell] = poison.to_owned()
            });
        }
        E::SeriesInOtherUnits => {
            let factor = [9.81, 1e3, 0.01, 1.0 / 9.81][round.random.usize(..4)];
            change_cells(&mut lines[1..], |cells| {
                let force: f64 = cells[2].parse().expect("a number");
                cells[2] = (force * factor).to_string();
            });
        }
        E::SeriesOfAnotherCase => {
            let cases = &round.workload.cases;
            let others: Vec<&Case> = cases.iter().filter(|case| *case != victim).collect();
            return round
                .workloads
                .series(others[round.random.usize(..others.len())]);
        }
        E::SeriesWithoutAColumn => {
            // Positions and angles may be left out.
            let column = NEEDED[round.random.usize(..NEEDED.len())];
            change_cells(&mut lines, |cells| {
                cells.remove(column);
            });
        }
        E::SeriesNotText => {
            let mut bytes = text.into_bytes();
            let place = round.random.usize(..bytes.len());
            bytes[place] = 0xff;
            return bytes;
        }
        E::SeriesEmpty => return Vec::new(),
        E::SeriesWithoutRows => lines.truncate(1),
        _ => unreachable!("it has a command"),
    }
    (lines.join("\n") + "\n").into_bytes()
}

fn change_cells(lines: &mut [String], change: impl Fn(&mut Vec<String>)) {
    for line in lines {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        change(&mut cells);
        *line = cells.join(",");
    }
}
