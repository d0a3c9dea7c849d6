//! The digest of the sources, in copies of the project in which one line is changed.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;
use tristack_dem::dem::SOURCE_DIGEST;

fn project() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// What a build script would say of the sources in `directory`, with the compiler of this test.
fn digest(directory: &Path) -> String {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| OsString::from("rustc"));
    let version = Command::new(&rustc)
        .arg("-vV")
        .output()
        .expect("a compiler");
    let version = String::from_utf8(version.stdout).expect("text");
    let host = version.lines().find_map(|line| line.strip_prefix("host: "));
    let compiler = tristack_digest::compiler(&rustc, host.expect("a host"));
    let crates = ["crates/theory", "crates/dem"].map(|name| directory.join(name));
    tristack_digest::digest(&crates, &compiler).expect("the sources are Rust")
}

/// A copy of all that cargo compiles.
fn copy() -> TempDir {
    let copy = TempDir::new().expect("a directory");
    for folder in ["crates", "src"] {
        copy_into(&project().join(folder), &copy.path().join(folder));
    }
    for file in ["Cargo.toml", "Cargo.lock"] {
        fs::copy(project().join(file), copy.path().join(file)).expect("it is copied");
    }
    copy
}

fn copy_into(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a directory");
    for entry in fs::read_dir(from).expect("a directory").flatten() {
        let (path, target) = (entry.path(), to.join(entry.file_name()));
        match path.is_dir() {
            true => copy_into(&path, &target),
            false => drop(fs::copy(&path, &target).expect("it is copied")),
        }
    }
}

/// The digest after the first `old` in a file has become `new`.
fn digest_with(file: &str, old: &str, new: &str) -> String {
    let copy = copy();
    let path = copy.path().join(file);
    let text = fs::read_to_string(&path).expect("a file of the project");
    assert!(text.contains(old), "{old} in {file}");
    fs::write(&path, text.replacen(old, new, 1)).expect("it is written");
    digest(copy.path())
}

#[test]
fn the_program_says_the_digest_of_the_sources_of_which_it_is_made() {
    assert_eq!(SOURCE_DIGEST, digest(&project()));
    assert_eq!(SOURCE_DIGEST, digest(copy().path()));
}

#[test]
fn a_changed_line_of_what_decides_numbers_changes_it() {
    for (file, old, new) in [
        (
            "crates/theory/src/model/law/damping.rs",
            "libm::log(restitution)",
            "1.001 * libm::log(restitution)",
        ),
        (
            "crates/dem/src/dem/loading.rs",
            "use crate::",
            "use std::fmt as _;\nuse crate::",
        ),
        (
            "crates/dem/src/series/drop.rs",
            "ROWS_SINCE_PEAK: usize = 5",
            "ROWS_SINCE_PEAK: usize = 6",
        ),
        (
            "Cargo.lock",
            "name = \"libm\"\nversion = \"0.2.",
            "name = \"libm\"\nversion = \"0.2.9",
        ),
    ] {
        assert_ne!(digest_with(file, old, new), SOURCE_DIGEST, "{file}: {new}");
    }
}

#[test]
fn a_changed_line_of_anything_else_leaves_it() {
    for (file, old, new) in [
        ("src/cli/theory.rs", "use ", "use std::fmt as _;\nuse "),
        (
            "crates/dem/src/dem/loading.rs",
            "//! ",
            "//! In other words: ",
        ),
        (
            "crates/theory/src/theory/path/tests.rs",
            "use ",
            "use std::fmt as _;\nuse ",
        ),
        (
            "Cargo.toml",
            "[workspace.package]\nversion = \"",
            "[workspace.package]\nversion = \"9",
        ),
        (
            "Cargo.lock",
            "name = \"clap\"\nversion = \"",
            "name = \"clap\"\nversion = \"9",
        ),
    ] {
        assert_eq!(digest_with(file, old, new), SOURCE_DIGEST, "{file}: {new}");
    }
}
