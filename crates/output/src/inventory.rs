//! The codes that tristack knows, as they are installed on this machine.

use super::table::{Columns, DataTable};
use crate::code::{Code, Identity, TaskKind};
use crate::model::{Arms, ContactArms, PAPER_BODIES};
use crate::runs::SelectedCode;

/// Returns the table of installed codes, one row per code of `codes`.
pub fn inventory(codes: &[SelectedCode]) -> DataTable<'static> {
    let rows = codes.iter().map(|selected| {
        let found = selected.code.as_ref();
        (
            selected.name.clone(),
            found.map(|found| found.identity().clone()),
        )
    });
    Columns::<(Code, Option<Identity>)>::new(
        "codes",
        "A row is a code that tristack knows, as it is installed on this machine.",
        "`tristack codes`",
    )
    .code(|(code, _)| code)
    .text("installed", |(_, identity)| identity.is_some())
    .means("whether its program is here; `broken` is its version if that does not work")
    .text("version", |(_, identity)| {
        Some(identity.as_ref()?.version.clone())
    })
    .means("its version")
    .shown("version")
    .cell(|(code, identity)| {
        let absent = || format!("not installed ({})", code.installation_hint());
        let identity = identity.as_ref();
        identity.map_or_else(absent, |identity| identity.version.clone())
    })
    .text("package", |(_, identity)| {
        identity.as_ref()?.package.clone()
    })
    .means("distribution package and its version")
    .shown("package")
    .dispensable(2)
    .convention(|(code, _)| Some(code.as_declared()?.convention().into()))
    .right("pair arm", |(code, _)| arms(code, |arms| arms.pair))
    .right("floor arm", |(code, _)| arms(code, |arms| arms.floor))
    .text("deck_hash", |(code, _)| deck_hash(code))
    .means("SHA-256 of the deck of a stack; empty without a task `stack`")
    .shown("deck")
    .cell(|(code, _)| deck_hash(code).map_or_else(String::new, |hash| hash[..12].to_owned()))
    .dispensable(1)
    .text("install", |(code, _)| code.installation_hint())
    .means("how to install it")
    .rows(rows)
}

/// The hash of the files with which a code compresses a stack, if it does.
fn deck_hash(code: &Code) -> Option<String> {
    let compresses = code.check_compresses(PAPER_BODIES).is_ok();
    compresses.then(|| code.files_hash(TaskKind::Stack))
}

/// Formats declared arms for people, marked `(any)` where they are only the default of a code that accepts any.
/// Nothing is measured for a list.
fn arms(code: &Code, of: fn(&Arms) -> ContactArms) -> String {
    let Some(declared) = code.as_declared() else {
        return "not declared".to_owned();
    };
    let arms = of(&declared.convention().arms);
    match code.accepts_any_convention() {
        true => format!("{arms} (any)"),
        false => arms.to_string(),
    }
}
