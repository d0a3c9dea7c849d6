//! `tristack passport`.

use super::options::Format;
use super::passport_files::read_passport;
use super::{CliError, ExitStatus, tell};
use crate::output::{passport_changes, passport_forces};
use crate::study::atlas::{NamedPassport, difference};
use clap::{Args, Subcommand};
use std::path::PathBuf;

/// Compare passports of codes
#[derive(Debug, Args)]
#[command(subcommand_required = true, arg_required_else_help = true)]
pub(super) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Diff(DiffArguments),
}

/// Compare two passports: what changed, by how many uncertainties, and what it does to three yield forces
///
/// The exit status is 2 if anything differs by more than the uncertainties of both and the tolerance of the probe, 4 if
/// nothing does but an uncertainty would hide it or nothing is known to both, and 0 otherwise, so that a code can be held to
/// the passport of its last release. What is unknown to one of them because its motions have few digits is no difference,
/// and is named, as is what neither knows. A passport that contradicts itself is refused.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: tristack probe --codes ./mydem --out now; tristack passport diff released.json now/mydem.json"
)]
struct DiffArguments {
    /// Passport that is compared with, as `probe --out` or `probe --passports` has written it
    #[arg(value_name = "BEFORE.json")]
    before: PathBuf,
    /// Passport that is compared
    #[arg(value_name = "AFTER.json")]
    after: PathBuf,
    /// Format of the tables
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// Prints what differs.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    let Command::Diff(arguments) = &arguments.command;
    let before = read_passport(&arguments.before)?;
    let after = read_passport(&arguments.after)?;
    let found = difference(&before.passport, &after.passport);
    let tables = [
        passport_changes(&found.changes),
        passport_forces(&found.forces),
    ];
    let people = || {
        let forces = tables[1].shown().terminal();
        match found.is_none() {
            true => forces,
            false => format!("{}\n{forces}", tables[0].shown().terminal()),
        }
    };
    tell!("before: {}", described(&before));
    tell!("after:  {}", described(&after));
    let printed = arguments.format.print(&tables, command, people);
    let beside_arms = found.beside_arms();
    if !beside_arms.is_empty() {
        tell!(
            "the forces are those of the arms alone; they do not count that {} changed as well",
            beside_arms.join(", ")
        );
    }
    for own in [&before, &after] {
        if let Some(because) = own
            .passport
            .is_coarse_because()
            .filter(|_| !found.unknown.is_empty())
        {
            tell!(
                "not known where the motions {because}, and no difference: {}",
                found.unknown.join(", ")
            );
        }
    }
    for (names, what) in [
        (&found.neither, "known to neither, and not compared"),
        (
            &found.undecided,
            "the uncertainties would hide a difference of a thousandth",
        ),
    ] {
        if !names.is_empty() {
            tell!("{what}: {}", names.join(", "));
        }
    }
    let files = [&before, &after].map(|own| own.passport.is_coarse_because().is_some());
    let is_open = found.is_open(files.contains(&true));
    match found.changes.len() {
        0 if found.compared == 0 => {
            tell!("nothing is known to both passports, so that nothing was compared")
        }
        0 if is_open => {
            tell!("nothing differs as far as the uncertainties show, which is not far enough")
        }
        0 => tell!("nothing differs by more than the uncertainties"),
        1 => tell!("1 rule or property differs"),
        count => tell!("{count} rules and properties differ"),
    }
    Ok(match found.is_none() {
        true if is_open => printed.max(ExitStatus::Inconclusive),
        true => printed,
        false => printed.max(ExitStatus::Disagreement),
    })
}

fn described(own: &NamedPassport) -> String {
    let passport = &own.passport;
    format!(
        "{} {}, {} (`{}`), probed by tristack {} on {}",
        passport.software,
        passport.program.version,
        passport.style,
        passport.code,
        passport.tristack,
        passport.date.get(..10).unwrap_or(&passport.date)
    )
}
