//! The codes that tristack knows, as they are installed here.

use super::table::{Columns, DataTable};
use crate::code::{Code, Identity};

/// One code, and its program where it is installed.
pub struct Inventory {
    code: Code,
    identity: Option<Identity>,
}

impl Inventory {
    /// Looks for `code` on this machine.
    pub fn take(code: Code) -> Self {
        let found = code.find();
        Self {
            code,
            identity: found.map(|found| found.identity().clone()),
        }
    }

    fn version(&self) -> Option<String> {
        let identity = self.identity.as_ref();
        identity.map(|identity| identity.version.clone())
    }

    fn package(&self) -> Option<String> {
        let identity = self.identity.as_ref();
        identity.and_then(|identity| identity.package.clone())
    }

    /// An arm for people: of the codes that a case may give any arm, it is a default.
    fn arm(&self, arm: f64) -> String {
        match self.code.accepts_any_convention() {
            true => format!("{arm} (any)"),
            false => arm.to_string(),
        }
    }
}

/// One row a code.
pub fn inventory(codes: &[Inventory]) -> DataTable<'_> {
    Columns::<&Inventory>::new(
        "codes",
        "A row is a code that tristack knows, as it is installed on this machine.",
        "`tristack codes`",
    )
    .text("code", "name of the code", |own| own.code.as_str())
    .shown("code")
    .text("installed", "whether it can run here", |own| own.identity.is_some())
    .text("version", "its version", |own| own.version())
    .shown("version")
    .cell(|own| {
        let absent = || format!("not installed ({})", own.code.installation_hint());
        own.version().unwrap_or_else(absent)
    })
    .text("package", "distribution package and its version", |own| own.package())
    .shown("package")
    .number(
        "pair_arm",
        "1",
        "arm coefficient r₁ of cylinder–cylinder contacts; a default that a case may change for `native`",
        |own| own.code.convention().pair_arm,
    )
    .shown("pair arm")
    .cell(|own| own.arm(own.code.convention().pair_arm))
    .number(
        "floor_arm",
        "1",
        "arm coefficient r₁ of floor contacts",
        |own| own.code.convention().floor_arm,
    )
    .shown("floor arm")
    .cell(|own| own.arm(own.code.convention().floor_arm))
    .text("deck_hash", "SHA-256 of the deck", |own| own.code.static_deck_hash())
    .shown("deck")
    .cell(|own| own.code.static_deck_hash()[..12].to_owned())
    .text("install", "how to install it", |own| own.code.installation_hint())
    .rows(codes)
}
