//! Options that several commands share.

mod codes;
mod convention;
mod duration;
mod flag;
mod format;
mod runs;
mod stack;

pub(super) use super::code_names::CodeParser;
pub(super) use codes::{CodeOptions, find_all, selected_codes, tell_stand_ins};
pub(super) use convention::{ConventionOptions, power};
pub(super) use flag::as_flag;
pub(super) use format::Format;
pub(super) use runs::{RunOptions, recording_directory, time_limit};
pub(super) use stack::{Friction, OneStackOptions, StackListOptions, StackOptions, friction};

use clap::Args;

/// The options of `T`, each by its name.
pub(super) fn options_of<T: Args>() -> Vec<clap::Id> {
    let command = T::augment_args(clap::Command::default());
    let options = command.get_arguments();
    options.map(|option| option.get_id().clone()).collect()
}
