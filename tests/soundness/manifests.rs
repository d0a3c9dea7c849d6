//! Manifests of folders, with those that they extend, with variants and placeholders.

use super::Seed;
use std::fs;
use std::path::PathBuf;
use std::sync::LazyLock;
use tempfile::TempDir;
use tristack::code::Definition;

/// A folder with files and, beside it, one that may be extended; each input is the manifest of the first.
static FOLDER: LazyLock<(TempDir, PathBuf)> = LazyLock::new(|| {
    let place = tempfile::tempdir().expect("a directory");
    let [folder, base] = ["mine", "base"].map(|name| place.path().join(name));
    for folder in [&folder, &base] {
        fs::create_dir(folder).expect("a directory");
        for name in ["stack.deck", "motion.deck", "contacts_a.deck"] {
            fs::write(folder.join(name), "deck\n").expect("a deck");
        }
    }
    fs::write(place.path().join("outside"), "secret\n").expect("a file");
    fs::write(base.join("code.toml"), BASE).expect("a manifest");
    (place, folder)
});

const BASE: &str = r#"schema = 1
name = "base"
[program]
command = ["lmp", "-in", "{deck}", "{style}"]
environment = { A = "b" }
[result]
file = "log.txt"
format = "lammps-thermo"
[tasks]
stack = { files = ["stack.deck"] }
[set]
style = "a"
[variants.base]
[variants.base-soft]
set = { style = "b" }
"#;

pub fn check(data: &[u8]) {
    let (_, folder) = &*FOLDER;
    fs::write(folder.join("code.toml"), data).expect("it can be written");
    match Definition::read(folder) {
        Ok(codes) => {
            assert!(!codes.is_empty());
            let told = format!("{codes:?}");
            assert!(!told.contains("secret"), "a file outside of the folder");
            let again = Definition::read(folder).expect("the same manifest");
            assert_eq!(told, format!("{again:?}"));
        }
        Err(refusal) => {
            let message = refusal.to_string();
            assert!(message.contains("code.toml"), "{message}");
            assert!(!message.contains('\u{1b}'), "{message:?}");
        }
    }
}

pub fn seeds() -> Vec<Seed> {
    let full = r#"schema = 1
name = "mine"
title = "Mine"
install = "make"
label = "soft"
mark = { shape = "cross", colour = "vermilion" }
seconds = { start = 0.5, step = 1e-6 }
[program]
command = ["mine", "{deck}", "{directories}", "{floor}"]
higher_precision = "mine-long"
search = ["{folder}/bin", "$VIRTUAL_ENV/bin", "$PATH"]
version = { arguments = ["--version"], before = "Mine " }
environment = { A = "b" }
logs = ["log.txt"]
[parameters]
file = "parameters.json"
format = "json"
[result]
file = "series.csv"
format = "csv"
columns = { wall_force = "f_top", floor_n2 = { from = "fn2", factor = -1.0 } }
[tasks]
stack = { files = ["stack.deck", "contacts_a.deck"], result = "series.csv" }
motion = { files = ["motion.deck"], columns = { fx1 = "force" } }
[convention]
pair = { torque_arm = -0.5, kinematic_arm = 0.0 }
floor = { torque_arm = -0.5 }
coulomb_operand = "spring"
sliding_spring = "follows-limit"
[integration]
velocity_lag = 0.5
angle = "own"
touches_at_zero_overlap = true
[refused]
restitution = { values = [1.0], because = "of zero" }
[variants.mine]
set = { floor = "box" }
[variants.mine-wall]
set = { floor = "wall" }
convention = { floor = { torque_arm = -1.0 } }
"#;
    let extends = |base: &str, rest: &str| {
        format!("schema = 1\nname = \"mine\"\nextends = \"{base}\"\n{rest}")
    };
    let seeds = [
        ("full", full.to_owned()),
        ("base", BASE.to_owned()),
        (
            "extends-folder",
            extends("../base", "set = { style = \"c\" }\n"),
        ),
        ("extends-itself", extends(".", "")),
        (
            "extends-lammps",
            extends("lammps", "[program]\nsearch = [\"{folder}\"]\n"),
        ),
        (
            "extends-yade",
            extends("yade", "[variants.mine]\nset = { floor = \"box\" }\n"),
        ),
        (
            "python",
            include_str!("../../examples/python/code.toml").to_owned(),
        ),
    ];
    seeds
        .map(|(name, text)| (name.to_owned(), text.into_bytes()))
        .into()
}
