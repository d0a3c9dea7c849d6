//! Settles by a probe what a manifest leaves out of its convention.

use super::measured::{Probed, probe_all, read_probe};
use super::micro_tests::ask;
use crate::code::{Code, InstalledCode, Interrupt, RunContext, SettledCode};
use crate::runs::{Progress, SelectedCode, Settings};
use std::path::Path;

/// A settled code, and the result of its probe; `None` if its manifest declares everything.
pub type Settling = (SettledCode, Option<Probed>);

/// Settles the conventions of `codes`, in their order. What a manifest leaves out is measured by a probe, from the
/// store, live, or recorded. `probes_all` codes in any case, to know the precision of their numbers.
pub fn settle(
    codes: &[SelectedCode],
    probes_all: bool,
    settings: &Settings,
    progress: &dyn Progress,
) -> Vec<Settling> {
    let settled = codes.iter().map(|selected| {
        let name = &selected.name;
        let declared = name.as_declared();
        if let Some(declared) = declared.clone().filter(|_| !probes_all) {
            return (declared, None);
        }
        let probed = probe_all(std::slice::from_ref(selected), settings, progress);
        let probed = probed.into_iter().next();
        let settled = match (&probed, declared) {
            (None | Some(Err(_)), Some(declared)) => declared,
            (Some(probed), _) => settled_by(name, probed),
            (None, None) => name.unmeasured("it has not been measured"),
        };
        (settled, probed)
    });
    settled.collect()
}

/// `code` under the convention that its probe shows, wherever the answers come from.
pub fn settled_by(code: &Code, probed: &Probed) -> SettledCode {
    match probed {
        Ok(findings) => SettledCode::new(code.clone(), findings.settled.clone()),
        Err(error) => code.unmeasured(&error.to_string()),
    }
}

/// The code under the convention that `results`, made elsewhere, show; `None` if they do not answer all micro-tests
/// yet.
pub(crate) fn settled_by_files(results: &dyn InstalledCode) -> Option<SettledCode> {
    let (code, nobody) = (results.name(), Interrupt::new());
    let record = ask(results, &RunContext::new(Path::new("."), &nobody)).ok()?;
    Some(settled_by(code, &read_probe(code, record)))
}
