//! Conventions that manifests leave out, measured before a command plans anything by them.

use super::options::RunOptions;
use super::progress::Reporter;
use super::{CliError, INTERRUPT, complain, tell};
use crate::code::Code;
use crate::runs::{Progress, SelectedCode, Settings};
use crate::study::convention;

/// Settles the conventions of `codes`, and says on standard error what was measured. Nothing happens where the manifests
/// leave nothing out.
pub(super) fn settle(codes: &[SelectedCode], options: &RunOptions) -> Result<(), CliError> {
    if codes.iter().all(|selected| selected.name.is_settled()) {
        return Ok(());
    }
    settle_with(codes, &options.settings()?, &Reporter::new());
    match INTERRUPT.requested() {
        true => Err(CliError::Interrupted),
        false => Ok(()),
    }
}

/// The same with these settings.
pub(super) fn settle_with(codes: &[SelectedCode], settings: &Settings, progress: &dyn Progress) {
    for (code, probed) in convention::settle(codes, settings, progress) {
        match probed {
            Ok(_) => tell_settled(code),
            Err(_) if INTERRUPT.requested() => {}
            Err(error) => {
                complain!("{code}: its contact convention could not be measured: {error}")
            }
        }
    }
}

/// The same for one `code`, which is looked up where something is left out.
pub(super) fn settle_one(code: Code, options: &RunOptions) -> Result<(), CliError> {
    match code.is_settled() {
        true => Ok(()),
        false => settle(&[SelectedCode::find(code)], options),
    }
}

/// What the probe of `code` has put in place of the keys that are left out.
fn tell_settled(code: Code) {
    let settled = code.settled();
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
