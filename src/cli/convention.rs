//! Conventions that manifests leave out: they are measured before a command plans with them.

use super::options::RunOptions;
use super::progress::Reporter;
use super::{CliError, INTERRUPT, complain, tell};
use crate::code::{Code, SettledCode};
use crate::runs::{Progress, SelectedCode, Settings};
use crate::study::convention::{self, NO_CONTACT};

/// Settles the conventions of `codes`, in their order. Says on standard error what was measured where manifests leave
/// something out.
pub(super) fn settle(
    codes: &[SelectedCode],
    options: &RunOptions,
) -> Result<Vec<SettledCode>, CliError> {
    let declared = codes.iter().map(|selected| selected.name.as_declared());
    if let Some(declared) = declared.collect() {
        return Ok(declared);
    }
    settle_unless_interrupted(codes, false, options)
}

/// Does the same after a probe of every code, so that the precision of their numbers is known.
pub(super) fn settle_after_probes(
    codes: &[SelectedCode],
    options: &RunOptions,
) -> Result<Vec<SettledCode>, CliError> {
    settle_unless_interrupted(codes, true, options)
}

fn settle_unless_interrupted(
    codes: &[SelectedCode],
    probes_all: bool,
    options: &RunOptions,
) -> Result<Vec<SettledCode>, CliError> {
    let settled = settle_with(codes, probes_all, &options.settings()?, &Reporter::new());
    match INTERRUPT.requested() {
        true => Err(CliError::Interrupted),
        false => Ok(settled),
    }
}

/// Does the same with these settings.
pub(super) fn settle_with(
    codes: &[SelectedCode],
    probes_all: bool,
    settings: &Settings,
    progress: &dyn Progress,
) -> Vec<SettledCode> {
    let settled = convention::settle(codes, probes_all, settings, progress).into_iter();
    let told = settled.map(|(code, probed)| {
        match probed {
            Some(Ok(probe)) if probe.no_contact => tell!("{}: {NO_CONTACT}", code.name()),
            Some(Ok(_)) => tell_settled(&code),
            Some(Err(error)) if !INTERRUPT.requested() => {
                let name = code.name();
                complain!("{name}: its contact convention could not be measured: {error}");
            }
            _ => {}
        }
        code
    });
    told.collect()
}

/// Settles the convention of one code, which is looked up only if its manifest leaves something out.
pub(super) fn settle_one(code: &Code, options: &RunOptions) -> Result<SettledCode, CliError> {
    if let Some(declared) = code.as_declared() {
        return Ok(declared);
    }
    let settled = settle(&[SelectedCode::find(code.clone())], options)?;
    Ok(settled.into_iter().next().expect("one for each code"))
}

/// Says what the probe of `code` has measured for the keys that its manifest leaves out, and which of them stay
/// unknown.
fn tell_settled(code: &SettledCode) {
    let (settled, code) = (code.settled(), code.name());
    let left_out = code.declaration().left_out;
    let measured = left_out
        .iter()
        .filter(|&&key| settled.reason(key).is_none());
    let measured = measured.map(|&key| format!("{key} = {}", settled.value(key)));
    let measured: Vec<String> = measured.collect();
    if !measured.is_empty() {
        tell!(
            "{code}: measured, because its manifest leaves it out: {}",
            measured.join(", ")
        );
    }
    for own in &settled.unknown {
        let (key, because, matters) = (own.key, &own.because, own.matters());
        tell!("{code}: {key} is left out of its manifest and not known ({because}); {matters}");
    }
}
