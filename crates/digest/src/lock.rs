//! The packages that a crate computes with.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::{fs, io};
use toml::{Table, Value};

/// Returns the Cargo.lock in `directory` or the nearest directory above it.
pub(super) fn nearest(directory: &Path) -> Option<PathBuf> {
    let locks = directory.ancestors().map(|above| above.join("Cargo.lock"));
    locks.into_iter().find(|lock| lock.is_file())
}

/// Returns name, version and checksum of every package from a registry that the crate in `directory` depends on,
/// directly or through others, as the nearest Cargo.lock has them. Crates of the project are left out, because they
/// have digests of their own, and so is what only the crate's tests or build script need. Without a Cargo.lock,
/// returns the dependencies as Cargo.toml asks for them.
pub(super) fn packages(directory: &Path) -> io::Result<BTreeSet<String>> {
    let manifest = read(&directory.join("Cargo.toml"))?;
    let Some(asked) = manifest.get("dependencies").and_then(Value::as_table) else {
        return Ok(BTreeSet::new());
    };
    let Some(lock) = nearest(directory) else {
        let asked = asked.iter().map(|(name, value)| format!("{name} {value}"));
        return Ok(asked.collect());
    };
    let lock = read(&lock)?;
    let all = lock.get("package").and_then(Value::as_array);
    let locked: Vec<Package> = all.into_iter().flatten().filter_map(Package::of).collect();
    let mut by_name: BTreeMap<&str, Vec<&Package>> = BTreeMap::new();
    for package in &locked {
        by_name.entry(package.name).or_default().push(package);
    }
    let mut found = BTreeSet::new();
    let names = asked.iter().map(|(name, value)| real_name(name, value));
    let mut left: Vec<String> = names.map(str::to_owned).collect();
    while let Some(dependency) = left.pop() {
        // "name", or "name version" where there are several.
        let (name, version) = match dependency.split_once(' ') {
            Some((name, version)) => (name, Some(version)),
            None => (dependency.as_str(), None),
        };
        for package in by_name.get(name).into_iter().flatten() {
            let is_meant =
                version.is_none_or(|version| version.split(' ').next() == Some(package.version));
            if let Some(checksum) = package.checksum.filter(|_| is_meant)
                && found.insert(format!("{name} {} {checksum}", package.version))
            {
                left.extend(package.dependencies.iter().map(|&name| name.to_owned()));
            }
        }
    }
    Ok(found)
}

/// Returns the name of a dependency in the registry; Cargo.toml may rename it.
fn real_name<'a>(name: &'a str, value: &'a Value) -> &'a str {
    value.get("package").and_then(Value::as_str).unwrap_or(name)
}

struct Package<'a> {
    name: &'a str,
    version: &'a str,
    /// Absent for a crate of the project.
    checksum: Option<&'a str>,
    dependencies: Vec<&'a str>,
}

impl<'a> Package<'a> {
    fn of(entry: &'a Value) -> Option<Self> {
        let text = |key: &str| entry.get(key).and_then(Value::as_str);
        let dependencies = entry.get("dependencies").and_then(Value::as_array);
        Some(Self {
            name: text("name")?,
            version: text("version")?,
            checksum: text("checksum"),
            dependencies: dependencies
                .into_iter()
                .flatten()
                .filter_map(Value::as_str)
                .collect(),
        })
    }
}

fn read(path: &Path) -> io::Result<Table> {
    let text = fs::read_to_string(path)?;
    text.parse().map_err(|error| {
        let message = format!("{}: {error}", path.display());
        io::Error::new(io::ErrorKind::InvalidData, message)
    })
}
