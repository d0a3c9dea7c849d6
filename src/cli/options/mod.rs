//! Options that several commands share.

mod amount;
mod codes;
mod convention;
mod duration;
mod flag;
mod format;
mod friction;
mod numbers;
mod resolution;
mod rows;
mod runs;
mod stack;
mod unannounced;
mod values;

pub(super) use super::code_names::{CodeList, CodeListParser, CodeParser};
pub(super) use amount::{moment, size};
pub(super) use codes::{
    CodeOptions, check_compress, check_springs, check_yields, find_all, selected_codes,
    tell_stand_ins,
};
pub(super) use convention::{ConventionOptions, history_update, power};
pub(super) use flag::as_flag;
pub(super) use format::Format;
pub(super) use friction::{FRICTION, FRICTIONS, Friction, STIFFNESSES, Stiffness};
pub(super) use numbers::{number, positive, seconds, whole};
pub(super) use resolution::ResolutionOptions;
pub(super) use rows::RowOptions;
pub(super) use runs::{RunOptions, StoreOptions, recording_directory, time_limit};
pub(super) use stack::{OneStackOptions, StackListOptions, StackOptions};
pub(super) use unannounced::{Draw, UnannouncedOptions};
pub(super) use values::{GRAMMAR, Values, single};

use clap::Args;

/// Returns the names of the options of `T`.
pub(super) fn options_of<T: Args>() -> Vec<clap::Id> {
    let command = T::augment_args(clap::Command::default());
    let options = command.get_arguments();
    options.map(|option| option.get_id().clone()).collect()
}
