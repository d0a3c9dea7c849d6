//! What commands have found to be wrong with a code, and tell each other.

use super::{INTERRUPT, tell};
use crate::code::InstalledCode;
use crate::runs::{Finder, Findings, SelectedCode, Store};

/// Returns what other commands than `by` have found to be wrong with a code, and keeps for them what `by` has found.
pub(super) fn exchange(
    by: Finder,
    code: &dyn InstalledCode,
    store: &Store,
    wrong: Vec<String>,
) -> Vec<String> {
    let others = match Findings::of_others(by, code, store) {
        Ok(others) => others.iter().map(Findings::to_string).collect(),
        Err(error) => vec![format!(
            "what other commands have found is not known: {error}"
        )],
    };
    let kept = Findings::keep(by, code, wrong, store).err();
    let kept = kept.map(|error| format!("other commands will not know of this: {error}"));
    others.into_iter().chain(kept).collect()
}

/// Does the same for the installed ones of `codes`, and says it on standard error; `wrong` is what `by` has found.
pub(super) fn exchange_all(
    by: Finder,
    codes: &[SelectedCode],
    store: &Store,
    wrong: impl Fn(&SelectedCode) -> Vec<String>,
) {
    if INTERRUPT.requested() {
        return;
    }
    for selected in codes {
        let installed = selected.code.iter();
        for told in installed.flat_map(|own| exchange(by, &**own, store, wrong(selected))) {
            tell!("{}: {told}", selected.name);
        }
    }
}
