//! Faults of what is kept.

use super::fault::StoreFault;
use super::round::{Aftermath, Round, finished_runs};
use nix::sys::stat::Mode;
use nix::unistd::mkfifo;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;
use tristack::model::sha256_hex;

const FILES: [&str; 4] = ["case.json", "series.csv", "provenance.json", "SHA256SUMS"];

pub fn strike(fault: StoreFault, round: &mut Round) -> Result<Aftermath, String> {
    let before = round.run("");
    let aftermath = Aftermath {
        outputs: vec![before],
        struck: true,
        harmless: true,
        ..Aftermath::default()
    };
    if fault == StoreFault::ForeignFiles {
        return keep_foreign_files(round, aftermath);
    }
    if fault == StoreFault::OtherFormat {
        return refuse_other_format(round).map(|()| aftermath);
    }
    let entries = round.entries();
    let entry = &entries[round.random.usize(..entries.len())];
    let file = entry.join(FILES[round.random.usize(..FILES.len())]);
    let mut content = fs::read(&file).expect("a file");
    match fault {
        StoreFault::BitFlipped => {
            let bit = round.random.usize(..8 * content.len());
            content[bit / 8] ^= 1 << (bit % 8);
            fs::write(&file, content).expect("it can be written");
        }
        StoreFault::FileTruncated => {
            // A list of digests without the newline at its end would still be whole.
            content.truncate(round.random.usize(..content.len() - 1));
            fs::write(&file, content).expect("it can be written");
        }
        StoreFault::NamedPipeInPlace => {
            fs::remove_file(&file).expect("it is there");
            mkfifo(&file, Mode::S_IRWXU).expect("a named pipe");
        }
        StoreFault::LinkInPlace => {
            let elsewhere = round.bench.path("elsewhere");
            fs::rename(&file, &elsewhere).expect("it can be moved");
            symlink(&elsewhere, &file).expect("a link");
        }
        StoreFault::FileMissing => fs::remove_file(&file).expect("it is there"),
        StoreFault::MadeWithAnotherDeck => {
            return make_again(round, entry, "\"deck_hash\": \"", aftermath);
        }
        _ => return make_again(round, entry, "\"program_hash\": \"", aftermath),
    }
    Ok(Aftermath {
        damaged: 1,
        ..aftermath
    })
}

/// As if an entry had been made with something else than its address says: it must not be used.
fn make_again(
    round: &Round,
    entry: &Path,
    key: &str,
    mut aftermath: Aftermath,
) -> Result<Aftermath, String> {
    let path = entry.join("provenance.json");
    let text = fs::read_to_string(&path).expect("a provenance");
    let at = text.find(key).map(|at| at + key.len());
    let Some(at) = at else {
        // Native has no program file.
        return Ok(aftermath);
    };
    let other = if &text[at..=at] == "0" { "1" } else { "0" };
    let changed = format!("{}{other}{}", &text[..at], &text[at + 1..]);
    let sums = fs::read_to_string(entry.join("SHA256SUMS")).expect("digests");
    let [old, new] = [&text, &changed].map(|text| sha256_hex(text.as_bytes()));
    fs::write(entry.join("SHA256SUMS"), sums.replace(&old, &new)).expect("digests");
    fs::write(&path, &changed).expect("it can be written");
    let output = round.run("");
    let made = finished_runs(&output);
    aftermath.outputs.push(output);
    aftermath.made_again = 1;
    if made != 1 {
        return Err(format!("{made} runs were made again instead of one"));
    }
    if fs::read_to_string(&path).is_ok_and(|kept| kept == changed) {
        return Err("a run of something else was used".to_owned());
    }
    Ok(aftermath)
}

/// Files of somebody else in the store: with names that resemble those of the program, and with others.
fn keep_foreign_files(round: &mut Round, mut aftermath: Aftermath) -> Result<Aftermath, String> {
    const NAMES: [&str; 8] = [
        "notes.txt",
        "sessions/monday.md",
        "sessions/monday.json",
        "sessions/...json",
        "sessions/session-monday.json",
        "work/monday/data.bin",
        "runs/aa/notes.txt",
        "checkpoints/mine.json",
    ];
    let mut chosen: Vec<_> = NAMES.map(|name| round.store().join(name)).into();
    round.random.shuffle(&mut chosen);
    chosen.truncate(round.random.usize(1..=NAMES.len()));
    for path in &chosen {
        fs::create_dir_all(path.parent().expect("a directory")).expect("a directory");
        fs::write(path, "mine").expect("a file");
    }
    aftermath.outputs.push(round.run(""));
    for path in &chosen {
        if fs::read(path).ok().as_deref() != Some(b"mine") {
            return Err(format!("{} is gone", path.display()));
        }
        fs::remove_file(path).expect("it is there");
    }
    // Whatever is left in these directories counts as left behind.
    let _ = fs::remove_dir(round.store().join("work/monday"));
    let _ = fs::remove_dir(round.store().join("runs/aa"));
    Ok(aftermath)
}

fn refuse_other_format(round: &mut Round) -> Result<(), String> {
    let path = round.store().join("format");
    let right = fs::read(&path).expect("a format");
    let other = ["tristack store, format 3\n", "", "\u{0}"][round.random.usize(..3)];
    fs::write(&path, other).expect("it can be written");
    let output = round.run("");
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    fs::write(&path, right).expect("it can be written");
    let named = message.contains("format") && message.contains("accepted is");
    if output.status.code() == Some(1) && output.stdout.is_empty() && named {
        return Ok(());
    }
    Err(format!(
        "it was not refused: {:?}\n{message}",
        output.status
    ))
}
