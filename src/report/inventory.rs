//! The engines that tristack knows, as they are installed here.

use super::table::Table;
use crate::engine::EngineName;
use serde::Serialize;

/// One engine.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Inventory {
    /// Its name.
    pub engine: EngineName,
    /// Whether it can run here.
    pub installed: bool,
    /// Its version.
    pub version: Option<String>,
    /// Distribution package and version.
    pub package: Option<String>,
    /// Arm coefficient r₁ of cylinder–cylinder contacts; a default that a case may change for `native`.
    pub pair_arm: f64,
    /// Arm coefficient r₁ of floor contacts.
    pub floor_arm: f64,
    /// SHA-256 of the deck.
    pub deck_hash: String,
    /// How to install it.
    pub install: &'static str,
}

impl Inventory {
    /// Looks for `engine` on this machine.
    pub fn take(engine: EngineName) -> Self {
        let found = engine.find();
        let identity = found.as_ref().map(|found| found.identity());
        Self {
            engine,
            installed: identity.is_some(),
            version: identity.map(|identity| identity.version.clone()),
            package: identity.and_then(|identity| identity.package.clone()),
            pair_arm: engine.convention().pair_arm,
            floor_arm: engine.convention().floor_arm,
            deck_hash: engine.static_deck_hash(),
            install: engine.installation_hint(),
        }
    }
}

/// As a list of objects.
pub fn inventory_json(inventory: &[Inventory]) -> String {
    serde_json::to_string_pretty(inventory).expect("plain data has a JSON form") + "\n"
}

/// One line an engine.
pub fn inventory_csv(inventory: &[Inventory]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for engine in inventory {
        writer
            .serialize(engine)
            .expect("plain rows are written to memory");
    }
    writer.into_inner().expect("memory is flushed")
}

/// For people.
pub fn inventory_table(inventory: &[Inventory]) -> String {
    let mut table = Table::new(&[
        "engine",
        "version",
        "package",
        "pair arm>",
        "floor arm>",
        "deck",
    ]);
    for engine in inventory {
        let absent = format!("not installed ({})", engine.install);
        let arms = |arm: f64| {
            let free = engine.engine.accepts_any_convention();
            if free {
                format!("{arm} (any)")
            } else {
                arm.to_string()
            }
        };
        table.push(vec![
            engine.engine.to_string(),
            engine.version.clone().unwrap_or(absent),
            engine.package.clone().unwrap_or_else(|| "-".to_owned()),
            arms(engine.pair_arm),
            arms(engine.floor_arm),
            engine.deck_hash[..12].to_owned(),
        ]);
    }
    table.terminal()
}
