//! Origin, licence and compiler version of the dependencies.

use serde_json::Value;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

fn in_project(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// Every package that Cargo.lock names and this machine needs, as cargo tells it.
fn packages() -> Vec<Value> {
    let mut command = Command::new(env!("CARGO"));
    command.args(["metadata", "--format-version", "1", "--locked", "--offline"]);
    command.args(["--filter-platform", "x86_64-unknown-linux-gnu"]);
    let output = command.current_dir(in_project("")).output();
    let output = output.expect("cargo runs");
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success(),
        "Cargo.lock has to be complete: {message}"
    );
    let metadata: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let packages = metadata["packages"].as_array().expect("a list").clone();
    assert!(packages.len() > 100);
    packages
}

fn text<'a>(package: &'a Value, key: &str) -> &'a str {
    package[key].as_str().unwrap_or_default()
}

#[test]
fn every_licence_is_one_that_is_allowed() {
    let rules = std::fs::read_to_string(in_project("deny.toml")).expect("rules");
    let rules: toml::Table = rules.parse().expect("TOML");
    let allowed = rules["licenses"]["allow"].as_array().expect("a list");
    let allowed: Vec<&str> = allowed.iter().filter_map(toml::Value::as_str).collect();
    for package in packages() {
        let (name, licence) = (text(&package, "name"), text(&package, "license"));
        let expression = spdx::Expression::parse_mode(licence, spdx::ParseMode::LAX);
        let expression = expression.unwrap_or_else(|error| panic!("{name}: {licence}: {error}"));
        let fits = expression.evaluate(|one| {
            let id = one.license.id();
            id.is_some_and(|id| allowed.contains(&id.name))
        });
        assert!(fits, "{name}: {licence}");
    }
}

#[test]
fn everything_but_the_crates_of_this_project_comes_from_the_registry() {
    for package in packages() {
        let (name, source) = (text(&package, "name"), text(&package, "source"));
        let own = Path::new(text(&package, "manifest_path")).starts_with(in_project(""));
        assert!(own == source.is_empty(), "{name}: {source}");
        assert!(own || source.starts_with("registry+"), "{name}: {source}");
    }
}

/// Major and minor number.
fn version(text: &str) -> (u32, u32) {
    let mut numbers = text.split('.').map(|part| part.parse().expect("a number"));
    (numbers.next().unwrap_or(0), numbers.next().unwrap_or(0))
}

#[test]
fn nothing_needs_a_newer_compiler_than_is_promised() {
    let promised = version(env!("CARGO_PKG_RUST_VERSION"));
    for package in packages() {
        let needed = text(&package, "rust_version");
        let fits = needed.is_empty() || version(needed) <= promised;
        assert!(fits, "{} needs {needed}", text(&package, "name"));
    }
}

/// What another program compiles that uses the theory; docs/install.md says how many crates.
#[test]
fn the_theory_alone_brings_few_crates() {
    let mut command = Command::new(env!("CARGO"));
    command.args(["tree", "--locked", "--offline", "--prefix", "none"]);
    command.args(["--edges", "normal,build", "--package", "tristack-theory"]);
    let output = command.current_dir(in_project("")).output();
    let output = output.expect("cargo runs").stdout;
    let lines = String::from_utf8(output).expect("text");
    let crates = lines.lines().map(|line| line.trim_end_matches(" (*)"));
    let crates: BTreeSet<&str> = crates.filter(|line| !line.is_empty()).collect();
    let page = std::fs::read_to_string(in_project("docs/install.md")).expect("a page");
    let told = format!("is {} crates to compile", crates.len());
    assert!(page.contains(&told), "{told}: {crates:#?}");
    assert!(crates.len() <= 32, "{crates:#?}");
}

/// The manifests of the root package and of every crate.
fn manifests() -> Vec<toml::Table> {
    let crates = std::fs::read_dir(in_project("crates")).expect("crates");
    let crates = crates
        .flatten()
        .map(|entry| entry.path().join("Cargo.toml"));
    let all = std::iter::once(in_project("Cargo.toml")).chain(crates);
    let read = |path| std::fs::read_to_string(path).expect("a manifest");
    all.map(|path| read(path).parse().expect("TOML")).collect()
}

#[test]
fn no_code_of_this_project_is_unsafe() {
    let all = manifests();
    let lint = all[0]["workspace"]["lints"]["rust"]["unsafe_code"].as_str();
    // The compiler then refuses it, also behind an `allow`.
    assert_eq!(lint, Some("forbid"));
    for manifest in all {
        let (name, lints) = (&manifest["package"]["name"], &manifest["lints"]);
        assert_eq!(lints["workspace"].as_bool(), Some(true), "{name}");
    }
}

/// The crates are released together, under one number.
#[test]
fn all_crates_have_the_version_of_the_workspace() {
    let all = manifests();
    let workspace = &all[0]["workspace"];
    let version = &workspace["package"]["version"];
    for (name, dependency) in workspace["dependencies"].as_table().expect("dependencies") {
        if dependency.get("path").is_some() {
            assert_eq!(&dependency["version"], version, "{name}");
        }
    }
    for manifest in all {
        let package = &manifest["package"];
        let own = package["version"].get("workspace");
        assert_eq!(own.and_then(toml::Value::as_bool), Some(true), "{package}");
    }
}
