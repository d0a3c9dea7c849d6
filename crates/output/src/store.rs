//! Tables of the contents of a store.

use super::number::{friction, optional, plain, small};
use super::table::{Columns, DataTable};
use crate::model::{exact, readable, shell_quoted, shown};
use crate::runs::{Content, StoredEntry, StoredFile};
use jiff::{Timestamp, Unit};
use std::collections::BTreeMap;
use std::time::SystemTime;

/// Number of digits of an address that people are shown: no two entries of a store share as many.
const SHOWN_DIGITS: usize = 12;

/// The entries that share kind, code and version.
struct Group<'a> {
    kind: &'static str,
    code: Option<&'a str>,
    version: Option<&'a str>,
    entries: Vec<&'a StoredEntry>,
}

impl Group<'_> {
    fn bytes(&self) -> u64 {
        self.entries.iter().map(|entry| entry.bytes()).sum()
    }

    fn made(&self) -> impl Iterator<Item = SystemTime> {
        self.entries.iter().map(|entry| entry.made)
    }
}

fn groups(contents: &[Content]) -> Vec<Group<'_>> {
    let mut groups: BTreeMap<_, Vec<&StoredEntry>> = BTreeMap::new();
    for content in contents {
        let key = (content.entry.kind, content.code(), version(content));
        groups.entry(key).or_default().push(&content.entry);
    }
    let groups = groups.into_iter().map(|(key, entries)| Group {
        kind: key.0.as_str(),
        code: key.1,
        version: key.2,
        entries,
    });
    groups.collect()
}

fn version(content: &Content) -> Option<&str> {
    content.origin.as_ref().ok()?.version.as_deref()
}

/// Meaning of the column `kind`.
const KIND: &str = "`run`, `probe` (micro-tests), `observation` (of an event run), `impact`, `finding` (what a command has found to be wrong with a code), `checkpoint` (of an unfinished native \
                    run), `failed-run` (the files that it left) or `quarantine` (a damaged result)";

/// Returns the table of what a store holds, summed up by kind, code and version.
pub fn stored(contents: &[Content]) -> DataTable<'_> {
    Columns::<Group>::new(
        "store",
        "A row is what a store holds of one kind, code and version.",
        "`tristack store list`",
    )
    .text("kind", |group| group.kind)
    .means(KIND)
    .shown("kind")
    .text("code", |group| group.code)
    .means("name of the code; missing where an entry cannot be read")
    .shown("code")
    .text("version", |group| group.version)
    .means("version of the code; missing where an entry does not say it")
    .shown("version")
    .number("entries", "1", |group| group.entries.len())
    .means("number of entries")
    .shown("entries")
    .number("bytes", "B", Group::bytes)
    .means("length of their files together")
    .shown_as("size", size)
    .text("oldest", |group| group.made().min().map(time))
    .means("when the first of them was written, UTC")
    .shown("oldest")
    .cell(|group| optional(group.made().min(), day))
    .text("newest", |group| group.made().max().map(time))
    .means("when the last of them was written, UTC")
    .shown("newest")
    .cell(|group| optional(group.made().max(), day))
    .rows(groups(contents))
}

/// Returns the table of the entries of a store.
pub fn stored_entries(contents: &[Content]) -> DataTable<'_> {
    Columns::<&Content>::new(
        "store-entries",
        "A row is an entry of a store.",
        "`tristack store list --entries`, `tristack store show` and `tristack store prune`",
    )
    .text("kind", |one| one.entry.kind.as_str())
    .means(KIND)
    .shown("kind")
    .text("address", |one| one.entry.name.as_str())
    .means(
        "its address: SHA-256 of all that decides its numbers; in quarantine with a number; the directory of a failed run",
    )
    .shown("address")
    .cell(|one| short_address(&one.entry))
    .text("code", |one| one.code())
    .means("name of the code; missing where the entry cannot be read")
    .shown("code")
    .text("version", |one| version(one))
    .means("version of the code; missing where the entry does not say it")
    .number("mu", "1", |one| Some(one.case()?.stack.floor_friction))
    .means("floor friction μ, of a run")
    .shown("mu")
    .cell(|one| optional(one.case(), |case| friction(case.stack.floor_friction)))
    .number("stiffness", "m g/r", |one| Some(one.case()?.stack.stiffness))
    .means("normal stiffness k_n, 1/ε, of a run")
    .shown("stiffness")
    .cell(|one| optional(one.case(), |case| exact(case.stack.stiffness)))
    .number("bodies", "1", |one| Some(u64::from(one.case()?.stack.bodies)))
    .means("number n of bodies on the floor, of a run")
    .number("law_power", "1", |one| Some(one.case()?.convention.law.power.value()))
    .means("power p of the normal force, of a run")
    .number("wall_speed", "r sqrt(k_n/m)", |one| Some(one.case()?.protocol.wall_speed))
    .means("speed of the wall, of a run")
    .shown_as("wall speed", small)
    .number("steps", "1", |one| Some(one.case()?.total_steps()))
    .means("time steps, preparation included, of a run")
    .number("bytes", "B", |one| one.entry.bytes())
    .means("length of its files together")
    .shown_as("size", size)
    .text("made", |one| time(one.entry.made))
    .means("when it was written, UTC")
    .shown("made")
    .cell(|one| day(one.entry.made))
    .rows(contents)
}

/// Returns the table of the files of an entry.
pub fn stored_files(files: &[StoredFile]) -> DataTable<'_> {
    Columns::<&StoredFile>::new(
        "store-files",
        "A row is a file of an entry of a store.",
        "`tristack store show`",
    )
    .text("file", |file| file.name.to_string_lossy().into_owned())
    .means("its path in the entry")
    .shown("file")
    .number("bytes", "B", |file| file.bytes)
    .means("its length")
    .shown_as("bytes", |bytes| bytes.to_string())
    .rows(files)
}

/// Formats all that is known of an entry, one fact per line, then its files. `is_outdated` says whether the same task
/// would have another address today, if that is known.
pub fn entry_text(content: &Content, is_outdated: Option<bool>) -> String {
    let entry = &content.entry;
    let mut lines = vec![
        ("kind", entry.kind.as_str().to_owned()),
        ("address", entry.name.clone()),
        ("directory", shown(&entry.path)),
        ("written", time(entry.made)),
        ("size", size(entry.bytes() as f64)),
    ];
    match &content.origin {
        Err(reason) => lines.push(("unreadable", reason.clone())),
        Ok(origin) => {
            let version = origin.version.as_deref().unwrap_or_default();
            lines.push(("code", format!("{} {version}", origin.code)));
            lines.extend(origin.task.as_ref().map(|task| ("task", task.to_string())));
            if let Some(made) = &origin.provenance {
                let seconds = format!("{} steps in {} s", made.steps, plain(made.seconds));
                lines.push(("took", seconds));
                lines.push((
                    "made",
                    format!("{} by tristack {}", made.date, made.tristack),
                ));
                lines.push(("machine", made.machine.clone()));
                let words = made.command.iter();
                let words: Vec<String> = words.map(|word| shell_quoted(word)).collect();
                lines.push(("command", words.join(" ")));
            }
            let outdated = is_outdated.map(|outdated| match outdated {
                true => "yes: this program, the code or its deck have changed since",
                false => "no",
            });
            lines.push(("outdated", outdated.unwrap_or("not known").to_owned()));
        }
    }
    let lines = lines.into_iter();
    let lines: String = lines
        .map(|(name, value)| format!("{name:11} {}\n", readable(value.trim_end())))
        .collect();
    lines + &stored_files(&entry.files).shown().terminal()
}

/// Returns the beginning of an address, or the whole directory of a failed run.
fn short_address(entry: &StoredEntry) -> String {
    match entry.name.contains('/') {
        true => entry.name.clone(),
        false => entry.name.chars().take(SHOWN_DIGITS).collect(),
    }
}

/// Formats a moment to the second, UTC.
fn time(moment: SystemTime) -> String {
    let moment = Timestamp::try_from(moment).unwrap_or_default();
    moment.round(Unit::Second).unwrap_or(moment).to_string()
}

/// Formats a moment to the minute, UTC, for people.
fn day(moment: SystemTime) -> String {
    time(moment).replace('T', " ").chars().take(16).collect()
}

/// Formats a number of bytes for people, in decimal units (kB, MB, GB).
pub fn size(bytes: f64) -> String {
    let units = [(1e9, "GB"), (1e6, "MB"), (1e3, "kB")];
    let unit = units.iter().find(|(unit, _)| bytes >= *unit);
    match unit {
        Some((unit, name)) => format!("{} {name}", plain(bytes / unit)),
        None => format!("{bytes} B"),
    }
}
