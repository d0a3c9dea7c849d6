//! The codes that a command runs.

use crate::cli::code_names::{CodeList, CodeListParser};
use crate::cli::progress::during;
use crate::cli::{CliError, tell};
use crate::code::{Code, ManifestError};
use crate::model::{InvalidValue, Power};
use crate::runs::{SelectedCode, in_parallel};
use clap::Args;

/// `--codes`: the codes that a command runs.
#[derive(Debug, Clone, Args)]
pub(in crate::cli) struct CodeOptions {
    /// Codes to run, separated by commas; each must be installed [default: all, recorded if necessary]
    #[arg(id = "codes", long = "codes", alias = "code", value_parser = CodeListParser, value_name = "C1,C2")]
    lists: Vec<CodeList>,
}

impl CodeOptions {
    /// Returns the named codes.
    pub fn named(&self) -> Vec<Code> {
        CodeList::all(&self.lists)
    }

    /// Returns the named codes, each of which must have a law of this power.
    pub fn of_power(&self, power: Power) -> Result<Vec<Code>, InvalidValue> {
        let named = self.named();
        let Some(other) = named.iter().find(|code| !code.has_power(power)) else {
            return Ok(named);
        };
        let names: Vec<String> = Code::with_power(power)
            .into_iter()
            .map(|code| code.to_string())
            .collect();
        Err(InvalidValue {
            key: "--codes".to_owned(),
            value: other.to_string(),
            accepted: format!(
                "codes of the same power as --law, among them {}: {other} has the {}, and is accepted with --law {}",
                names.join(", "),
                other.law(),
                other.law().power.value()
            ),
        })
    }
}

/// Refuses codes whose manifests have no task that compresses stacks of this many `bodies`, before any of them is
/// started.
pub(in crate::cli) fn check_compress(codes: &[Code], bodies: u8) -> Result<(), ManifestError> {
    let mut codes = codes.iter();
    codes.try_for_each(|code| code.check_compresses(bodies))
}

/// Refuses codes whose bodies are rigid.
pub(in crate::cli) fn check_springs(codes: &[Code]) -> Result<(), ManifestError> {
    codes.iter().try_for_each(Code::check_has_springs)
}

/// Refuses codes that give no yield forces of stacks of this many `bodies`, before any of them is started.
pub(in crate::cli) fn check_yields(codes: &[Code], bodies: u8) -> Result<(), ManifestError> {
    let mut codes = codes.iter();
    codes.try_for_each(|code| code.check_yields(bodies))
}

/// Returns the named codes, each of which must be installed, or every code with the paper's law if none is named.
pub(in crate::cli) fn selected_codes(named: &[Code]) -> Result<Vec<SelectedCode>, CliError> {
    if named.is_empty() {
        return Ok(find_all(&Code::with_power(Power::Linear)));
    }
    let found = find_all(&Code::side_by_side(named)?)
        .into_iter()
        .map(|selected| match selected.code.is_some() {
            true => Ok(selected),
            false => Err(CliError::MissingCode(selected.name)),
        });
    found.collect()
}

/// Looks up the codes `names` in parallel, as they are installed here.
pub(in crate::cli) fn find_all(names: &[Code]) -> Vec<SelectedCode> {
    let find = || in_parallel(names, names.len(), |name| SelectedCode::find(name.clone()));
    match names {
        // The native code is part of the program.
        [] => find(),
        [one] if one.is_native() => find(),
        [one] => during(&format!("locating the program of {one}"), find),
        _ => during(
            &format!("locating the programs of {} codes", names.len()),
            find,
        ),
    }
}

/// Reports the codes that are not installed, and whether recorded runs stand in for them.
pub(in crate::cli) fn tell_stand_ins(codes: &[SelectedCode], is_recorded: impl Fn(&Code) -> bool) {
    for selected in codes.iter().filter(|selected| selected.code.is_none()) {
        let instead = match is_recorded(&selected.name) {
            true => "recorded runs stand in for it",
            false => "no recorded run stands in for it",
        };
        tell!(
            "{} is not installed: {instead} (to run it live: {})",
            selected.name,
            selected.name.installation_hint()
        );
    }
}
