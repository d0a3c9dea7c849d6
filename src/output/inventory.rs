//! The codes that tristack knows, as they are installed here.

use super::table::Table;
use crate::code::{Code, TaskKind};
use crate::model::{Arms, ContactArms};
use serde::Serialize;

/// One code.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Inventory {
    /// Its name.
    pub code: Code,
    /// Whether it can run here.
    pub installed: bool,
    /// Its version.
    pub version: Option<String>,
    /// Distribution package and version.
    pub package: Option<String>,
    /// Arm coefficients of its contacts; a default that a case may change for `native`.
    #[serde(flatten, serialize_with = "Arms::serialize_flat")]
    pub arms: Arms,
    /// SHA-256 of the deck.
    pub deck_hash: String,
    /// How to install it.
    pub install: &'static str,
}

impl Inventory {
    /// Looks for `code` on this machine.
    pub fn take(code: Code) -> Self {
        let found = code.find();
        let identity = found.as_ref().map(|found| found.identity());
        Self {
            code,
            installed: identity.is_some(),
            version: identity.map(|identity| identity.version.clone()),
            package: identity.and_then(|identity| identity.package.clone()),
            arms: code.convention().arms,
            deck_hash: code.files_hash(TaskKind::Stack),
            install: code.installation_hint(),
        }
    }
}

/// As a list of objects.
pub fn inventory_json(inventory: &[Inventory]) -> String {
    serde_json::to_string_pretty(inventory).expect("plain data has a JSON form") + "\n"
}

/// One line an code.
pub fn inventory_csv(inventory: &[Inventory]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for code in inventory {
        writer
            .serialize(code)
            .expect("plain rows are written to memory");
    }
    writer.into_inner().expect("memory is flushed")
}

/// For people.
pub fn inventory_table(inventory: &[Inventory]) -> String {
    let mut table = Table::new(&[
        "code",
        "version",
        "package",
        "pair arm>",
        "floor arm>",
        "deck",
    ]);
    for code in inventory {
        let absent = format!("not installed ({})", code.install);
        let shown = |arms: ContactArms| {
            let free = code.code.accepts_any_convention();
            if free {
                format!("{arms} (any)")
            } else {
                arms.to_string()
            }
        };
        table.push(vec![
            code.code.to_string(),
            code.version.clone().unwrap_or(absent),
            code.package.clone().unwrap_or_else(|| "-".to_owned()),
            shown(code.arms.pair),
            shown(code.arms.floor),
            code.deck_hash[..12].to_owned(),
        ]);
    }
    table.terminal()
}
