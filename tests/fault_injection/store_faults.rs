//! Faults of what is kept.

use super::fault::StoreFault;
use super::round::{Aftermath, Round, finished_runs};
use std::fs;
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
