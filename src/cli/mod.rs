//! The command line: one file per command.

mod atlas;
mod bench;
mod check;
mod code_names;
mod codes;
mod command_line;
mod completions;
mod convention;
mod crosscheck;
mod error;
mod explain;
mod findings;
mod given;
mod guard;
mod impacts;
mod interrupt;
mod judge;
mod judge_series;
mod limits;
mod man;
mod options;
mod out;
mod passport;
mod passport_files;
mod pictures;
mod plan;
mod predict;
mod probe;
mod progress;
mod published;
mod record;
mod regimes;
mod report;
mod schema;
mod simulate;
mod stack_set;
mod store;
mod streams;
mod sweep;
mod theory;
mod time;
mod trajectories;

pub use error::{CliError, ExitStatus};

use crate::code::GUARD_COMMAND;
use clap::{Command as Grammar, CommandFactory, FromArgMatches, Parser, Subcommand};
pub(crate) use interrupt::INTERRUPT;
use options::GRAMMAR;
use std::cell::RefCell;
use std::ffi::OsString;
pub(crate) use streams::{complain, print, tell, tell_grounds};

/// Yield force of a three-cylinder stack: exact limit, native DEM, and external DEM codes compared with it
#[derive(Debug, Parser)]
#[command(name = "tristack", version, max_term_width = 100)]
#[command(
    after_help = format!("Forces are in m g, lengths in r, speeds in r sqrt(k_n/m), times in sqrt(m/k_n); \
    --stiffness is k_n r/(m g).\n\n{GRAMMAR}\n\nTables are fitted to the width of the terminal, or to that which \
    COLUMNS says; NO_COLOR and CLICOLOR_FORCE are respected.\n\n--out and --vtk take a new or empty directory, or one with nothing but \
    earlier results of the same command.\n\nExit status: 0 all agree, 1 wrong usage or input, 2 a disagreement, \
    3 a code failed or is missing, 4 inconclusive, 5 a result could not be written, 6 out of time (--time-left), 130 interrupted; of several rows \
    2 counts before 3, and 3 before 4.")
)]
struct Cli {
    /// Leave standard error to errors and warnings: no progress, no notes
    #[arg(long, global = true)]
    quiet: bool,
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Theory(theory::Arguments),
    Simulate(simulate::Arguments),
    Sweep(sweep::Arguments),
    Crosscheck(crosscheck::Arguments),
    Trajectories(trajectories::Arguments),
    Impacts(impacts::Arguments),
    Codes(codes::Arguments),
    Check(check::Arguments),
    Probe(probe::Arguments),
    Passport(passport::Arguments),
    Atlas(atlas::Arguments),
    Record(record::Arguments),
    Regimes(regimes::Arguments),
    Report(report::Arguments),
    Plan(plan::Arguments),
    Judge(judge::Arguments),
    Predict(predict::Arguments),
    Bench(bench::Arguments),
    Time(time::Arguments),
    Store(store::Arguments),
    Schema(schema::Arguments),
    Completions(completions::Arguments),
    Man(man::Arguments),
    #[command(name = GUARD_COMMAND, hide = true)]
    Guard(guard::Arguments),
}

/// Returns the grammar for readers and shells, without the commands with which the program calls itself.
fn public_grammar() -> Grammar {
    let all = grammar();
    let visible = all.get_subcommands().filter(|own| !own.is_hide_set());
    let about = all.get_about().cloned().unwrap_or_default();
    let after = all.get_after_help().cloned().unwrap_or_default();
    Grammar::new("tristack")
        .version(env!("CARGO_PKG_VERSION"))
        .about(about)
        .after_help(after)
        .args(all.get_arguments().cloned())
        .subcommands(visible.cloned())
}

/// Parses the command line `arguments`, the first of which is the program, without running it.
///
/// # Errors
/// The message that [`run`] would print; a request for help is one too.
pub fn check(arguments: impl IntoIterator<Item = OsString>) -> Result<(), clap::Error> {
    thread_local! {
        // Building the grammar takes much longer than parsing one line.
        static GRAMMAR: RefCell<Grammar> = RefCell::new(grammar());
    }
    GRAMMAR.with_borrow_mut(|grammar| parsed(grammar, arguments).map(drop))
}

/// Returns the grammar of the command line. Options that take a value accept negative numbers here, so that the
/// parser of the option itself says what it accepts.
fn grammar() -> Grammar {
    let takes_numbers = |option: clap::Arg| {
        let takes_values = option.get_action().takes_values();
        option.allow_negative_numbers(takes_values)
    };
    Cli::command().mut_subcommands(|command| command.mut_args(takes_numbers))
}

fn parsed(
    grammar: &mut Grammar,
    arguments: impl IntoIterator<Item = OsString>,
) -> Result<Cli, clap::Error> {
    let matches = grammar.try_get_matches_from_mut(arguments)?;
    Cli::from_arg_matches(&matches).map_err(|error| error.format(grammar))
}

/// Runs the command line `arguments`, the first of which is the program.
///
/// # Errors
/// If the input is wrong, or a code is missing or fails.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> Result<ExitStatus, CliError> {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let cli = match parsed(&mut grammar(), arguments.iter().cloned()) {
        Ok(cli) => cli,
        Err(error) => {
            let helped = error.print().is_ok() && !error.use_stderr();
            return Ok(match helped {
                true => ExitStatus::Success,
                false => ExitStatus::WrongInput,
            });
        }
    };
    if cli.quiet {
        streams::be_quiet();
    }
    if !matches!(cli.command, Command::Guard(_)) {
        limits::explain();
        interrupt::listen();
    }
    let command = command_line::command_line(&arguments);
    let command = command.as_str();
    match cli.command {
        Command::Theory(arguments) => theory::run(&arguments, command),
        Command::Simulate(arguments) => simulate::run(&arguments, command),
        Command::Sweep(arguments) => sweep::run(&arguments, command),
        Command::Crosscheck(arguments) => crosscheck::run(&arguments, command),
        Command::Trajectories(arguments) => trajectories::run(&arguments, command),
        Command::Impacts(arguments) => impacts::run(&arguments, command),
        Command::Codes(arguments) => codes::run(&arguments, command),
        Command::Check(arguments) => check::run(&arguments, command),
        Command::Probe(arguments) => probe::run(&arguments, command),
        Command::Passport(arguments) => passport::run(&arguments, command),
        Command::Atlas(arguments) => atlas::run(&arguments, command),
        Command::Record(arguments) => record::run(&arguments),
        Command::Regimes(arguments) => regimes::run(&arguments, command),
        Command::Report(arguments) => report::run(&arguments, command),
        Command::Plan(arguments) => plan::run(&arguments, command),
        Command::Judge(arguments) => judge::run(&arguments, command),
        Command::Predict(arguments) => predict::run(&arguments, command),
        Command::Bench(arguments) => bench::run(&arguments, command),
        Command::Time(arguments) => time::run(&arguments, command),
        Command::Store(arguments) => store::run(&arguments, command),
        Command::Schema(arguments) => schema::run(&arguments),
        Command::Completions(arguments) => completions::run(&arguments),
        Command::Man(arguments) => man::run(&arguments),
        Command::Guard(arguments) => guard::run(&arguments),
    }
}
