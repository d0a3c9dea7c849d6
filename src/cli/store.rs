//! `tristack store`.

use super::code_names::known_codes;
use super::options::{Format, StoreOptions, moment, size as size_option};
use super::{CliError, ExitStatus, print, tell};
use crate::model::{InvalidValue, shown};
use crate::output::{entry_text, size, stored, stored_entries, stored_files};
use crate::runs::{
    CodesOfToday, Content, EntryKind, Selection, StoredEntry, StoredFile, contents, oldest_beyond,
};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{ArgGroup, Args, Subcommand};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// Show what the store of finished runs holds, and remove what is not needed
#[derive(Debug, Args)]
#[command(
    subcommand_required = true,
    arg_required_else_help = true,
    after_help = "Examples: tristack store list\n          \
    tristack store prune --outdated --dry-run\n          \
    tristack store prune --to 100MB\n\n\
    Whatever is removed is made again when it is needed, the slow runs of external codes too."
)]
pub(super) struct Arguments {
    #[command(subcommand)]
    action: Action,
}

#[derive(Debug, Subcommand)]
enum Action {
    List(ListArguments),
    Show(ShowArguments),
    Prune(PruneArguments),
}

/// List what the store holds, summed up by kind, code and version
#[derive(Debug, Args)]
struct ListArguments {
    #[command(flatten)]
    store: StoreOptions,
    /// List every entry
    #[arg(long)]
    entries: bool,
    #[command(flatten)]
    chosen: Choice,
    /// Format of the list
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// Show one entry: what it holds, how it was made, and its files
#[derive(Debug, Args)]
struct ShowArguments {
    /// Address of the entry, or the beginning of it; all entries with this address are shown, whatever their kinds
    address: String,
    #[command(flatten)]
    store: StoreOptions,
    /// Format of the entry
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// Remove entries from the store, while no other tristack uses it
///
/// An entry is removed if it matches every option given. Damaged results in quarantine go only with `--kind quarantine`.
/// Nothing is removed that tristack has not put there, and no link is followed.
#[derive(Debug, Args)]
#[command(
    group = ArgGroup::new("asked").args(["kind", "code", "older_than", "outdated", "to"]).required(true).multiple(true)
)]
struct PruneArguments {
    #[command(flatten)]
    store: StoreOptions,
    #[command(flatten)]
    chosen: Choice,
    /// Remove the oldest entries until the store has at most this size, such as 100MB
    #[arg(long, value_name = "SIZE", value_parser = size_option, allow_hyphen_values = true)]
    to: Option<u64>,
    /// Only list what would be removed
    #[arg(long)]
    dry_run: bool,
    /// Format of the list
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// The entries that are meant.
#[derive(Debug, Args)]
struct Choice {
    /// Entries of these kinds, separated by commas
    #[arg(long, value_parser = kinds(), value_delimiter = ',', value_name = "K1,K2")]
    kind: Vec<EntryKind>,
    /// Entries of these codes, separated by commas
    #[arg(long, alias = "codes", value_delimiter = ',', value_name = "C1,C2")]
    code: Vec<String>,
    /// Entries older than an age, such as 12h, 30d or 2w, or written before a date such as 2026-01-31 (UTC)
    #[arg(long, value_name = "AGE", value_parser = moment, allow_hyphen_values = true)]
    older_than: Option<SystemTime>,
    /// Entries that would not be reused today, because tristack, the code or its deck has changed; never entries of codes
    /// that are not installed
    #[arg(long)]
    outdated: bool,
}

/// Parses the name of a kind of entries.
fn kinds() -> impl TypedValueParser<Value = EntryKind> {
    let named = |name: String| {
        let mut all = EntryKind::ALL.into_iter();
        all.find(|kind| kind.as_str() == name)
            .expect("the parser accepts names of kinds alone")
    };
    PossibleValuesParser::new(EntryKind::ALL.map(EntryKind::as_str)).map(named)
}

impl Choice {
    /// Returns those of `contents` that are meant.
    fn of(&self, contents: Vec<Content>) -> Vec<Content> {
        let selection = Selection {
            kinds: self.kind.clone(),
            codes: self.code.clone(),
            before: self.older_than,
            outdated: self.outdated,
        };
        // Only outdated entries depend on the codes. Broken folders are reported by other commands.
        let known = match self.outdated {
            true => known_codes().0,
            false => Vec::new(),
        };
        selection.of(contents, &mut CodesOfToday::new(known))
    }
}

/// Lists, shows or removes entries.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    match &arguments.action {
        Action::List(arguments) => list(arguments, command),
        Action::Show(arguments) => show(arguments, command),
        Action::Prune(arguments) => prune(arguments, command),
    }
}

/// Returns the directory of a store and what it holds; a store that does not exist holds nothing.
fn open(options: &StoreOptions) -> Result<(PathBuf, Vec<Content>), CliError> {
    let root = options.directory()?;
    let found = contents(&root, options.sharing())?;
    if found.is_none() {
        tell!("there is no store {} yet", shown(&root));
    }
    Ok((root, found.unwrap_or_default()))
}

fn list(arguments: &ListArguments, command: &str) -> Result<ExitStatus, CliError> {
    let (root, all) = open(&arguments.store)?;
    let chosen = arguments.chosen.of(all);
    let tables = [match arguments.entries {
        true => stored_entries(&chosen),
        false => stored(&chosen),
    }];
    let people = || tables[0].shown().terminal() + &sum(&chosen, &root);
    Ok(match arguments.format {
        Format::Table if chosen.is_empty() => print(&sum(&chosen, &root)),
        format => format.print(&tables, command, people),
    })
}

fn show(arguments: &ShowArguments, command: &str) -> Result<ExitStatus, CliError> {
    let (root, all) = open(&arguments.store)?;
    let named = with_address(all, &arguments.address);
    let is_one = named
        .iter()
        .all(|one| one.entry.name == named[0].entry.name);
    if named.is_empty() || !is_one {
        return Err(not_one(&arguments.address, &named, &root).into());
    }
    let files = named.iter().flat_map(|one| one.entry.files.clone());
    let files: Vec<StoredFile> = files.collect();
    let tables = [stored_entries(&named), stored_files(&files)];
    let people = || {
        let mut today = CodesOfToday::new(known_codes().0);
        let texts = named
            .iter()
            .map(|one| entry_text(one, today.is_outdated(one)));
        texts.collect::<Vec<_>>().join("\n")
    };
    Ok(arguments.format.print(&tables, command, people))
}

/// Returns those of `contents` that have the `address`; if there are none, those whose addresses begin with it.
fn with_address(mut contents: Vec<Content>, address: &str) -> Vec<Content> {
    let is_whole = contents.iter().any(|one| one.entry.name == address);
    contents.retain(|one| match is_whole {
        true => one.entry.name == address,
        false => one.entry.name.starts_with(address),
    });
    contents
}

/// Returns the error for an address that does not exist, or for the beginning of several.
fn not_one(address: &str, named: &[Content], root: &Path) -> InvalidValue {
    let accepted = match named {
        [] => format!(
            "the beginning of an address in the store {} (tristack store list --entries)",
            shown(root)
        ),
        [one, other, ..] => format!(
            "more digits: {} entries begin with it, among them {} {} and {} {}",
            named.len(),
            one.entry.kind.as_str(),
            one.entry.name,
            other.entry.kind.as_str(),
            other.entry.name
        ),
        [_] => "another address".to_owned(),
    };
    InvalidValue {
        key: "address".to_owned(),
        value: address.to_owned(),
        accepted,
    }
}

fn prune(arguments: &PruneArguments, command: &str) -> Result<ExitStatus, CliError> {
    let (root, all) = open(&arguments.store)?;
    let total = bytes(&all);
    let mut chosen = arguments.chosen.of(all);
    if !arguments.chosen.kind.contains(&EntryKind::Quarantine) {
        chosen.retain(|content| content.entry.kind != EntryKind::Quarantine);
    }
    if let Some(allowed) = arguments.to {
        chosen = oldest_beyond(chosen, total, allowed);
    }
    if !arguments.dry_run && !chosen.is_empty() {
        let entries = chosen.iter().map(|content| content.entry.clone());
        let entries: Vec<StoredEntry> = entries.collect();
        arguments.store.opened()?.remove(&entries)?;
    }
    let (removed, left) = (bytes(&chosen), total - bytes(&chosen));
    let verb = match arguments.dry_run {
        true => "would be removed",
        false => "removed",
    };
    let sentence = format!(
        "{} entries, {}, {verb} from the store {}; {} left\n",
        chosen.len(),
        size(removed as f64),
        shown(&root),
        size(left as f64)
    );
    if let Some(allowed) = arguments.to.filter(|&allowed| left > allowed) {
        tell!(
            "that is more than {}: what else is there was not asked for, or is in quarantine",
            size(allowed as f64)
        );
    }
    let tables = [stored_entries(&chosen)];
    let summary = stored(&chosen);
    Ok(match arguments.format {
        Format::Table if chosen.is_empty() => print(&sentence),
        format => format.print(&tables, command, || summary.shown().terminal() + &sentence),
    })
}

fn bytes(contents: &[Content]) -> u64 {
    contents.iter().map(|content| content.entry.bytes()).sum()
}

fn sum(contents: &[Content], root: &Path) -> String {
    format!(
        "{} entries, {}, in the store {}\n",
        contents.len(),
        size(bytes(contents) as f64),
        shown(root)
    )
}
