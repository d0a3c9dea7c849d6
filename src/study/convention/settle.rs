//! What a manifest leaves out of its convention, settled by the probe.

use super::measured::{Probed, probe_all, read_probe};
use super::micro_tests::ask;
use crate::code::{Code, InstalledCode, Interrupt, RunContext};
use crate::runs::{Progress, SelectedCode, Settings};
use std::path::Path;

/// Settles the conventions of `codes` before anything is planned by them: what their manifests leave out is measured by
/// their probes, from the store, live, or recorded. Returns what each of the codes that leave something out has shown.
pub fn settle(
    codes: &[SelectedCode],
    settings: &Settings,
    progress: &dyn Progress,
) -> Vec<(Code, Probed)> {
    let open = codes.iter().filter(|selected| !selected.name.is_settled());
    let settled = open.map(|selected| {
        let probed = probe_all(std::slice::from_ref(selected), settings, progress);
        let probed = probed.into_iter().next();
        probed.map(|probed| (selected.name, probed))
    });
    let settled: Vec<(Code, Probed)> = settled.flatten().collect();
    for (code, probed) in &settled {
        settle_by(*code, probed);
    }
    settled
}

/// Settles the convention of `code` by its probe, wherever the answers come from.
pub fn settle_by(code: Code, probed: &Probed) {
    code.settle(match probed {
        Ok(findings) => findings.settled.clone(),
        Err(error) => code.declaration().unsettled(&error.to_string()),
    });
}

/// Settles the convention of a code whose `results` were made elsewhere, if they answer all micro-tests; otherwise it
/// stays open.
pub(crate) fn settle_by_files(results: &dyn InstalledCode) {
    let (code, nobody) = (results.name(), Interrupt::new());
    if let Ok(record) = ask(results, &RunContext::new(Path::new("."), &nobody)) {
        settle_by(code, &read_probe(code, record));
    }
}
