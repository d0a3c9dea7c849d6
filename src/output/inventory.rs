//! The codes that tristack knows, as they are installed on this machine.

use super::table::{Columns, DataTable};
use crate::code::{Code, Identity, TaskKind};
use crate::model::ContactArms;

/// One code, and its program if it is installed.
pub(crate) struct Inventory {
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

    /// Arms for people, marked where they are only the default of a code that accepts any.
    fn arms(&self, arms: ContactArms) -> String {
        match self.code.accepts_any_convention() {
            true => format!("{arms} (any)"),
            false => arms.to_string(),
        }
    }
}

/// One row per code.
pub(crate) fn inventory(codes: &[Inventory]) -> DataTable<'_> {
    Columns::<&Inventory>::new(
        "codes",
        "A row is a code that tristack knows, as it is installed on this machine.",
        "`tristack codes`",
    )
    .code(|own| own.code)
    .text("installed", "whether it can run here", |own| {
        own.identity.is_some()
    })
    .text("version", "its version", |own| own.version())
    .shown("version")
    .cell(|own| {
        let absent = || format!("not installed ({})", own.code.installation_hint());
        own.version().unwrap_or_else(absent)
    })
    .text("package", "distribution package and its version", |own| {
        own.package()
    })
    .shown("package")
    .convention(|own| own.code.convention())
    .right("pair arm", |own| own.arms(own.code.convention().arms.pair))
    .right("floor arm", |own| {
        own.arms(own.code.convention().arms.floor)
    })
    .text("deck_hash", "SHA-256 of the deck", |own| {
        own.code.files_hash(TaskKind::Stack)
    })
    .shown("deck")
    .cell(|own| own.code.files_hash(TaskKind::Stack)[..12].to_owned())
    .text("install", "how to install it", |own| {
        own.code.installation_hint()
    })
    .rows(codes)
}
