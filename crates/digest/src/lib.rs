//! Digest of everything that decides the numbers of a program, made when it is built.
//!
//! The digest covers the sources of some crates without comments, layout and tests, the packages that they compute
//! with as Cargo.lock has them, and the compiler. No release number is part of it, so a release with unchanged
//! sources keeps the runs of the one before.

mod lock;
mod tokens;

use sha2::{Digest, Sha256};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs, io};

/// Sets the environment variable `SOURCE_DIGEST` for the compilation of the crate whose build script calls this.
///
/// The digest covers that crate and those whose directories the variables named in `below` hold: a crate with a
/// `links` key passes its directory to build scripts of the crates that depend on it, as `DEP_<LINKS>_ROOT`.
///
/// # Panics
/// If a source cannot be read or is not Rust, which fails the build.
pub fn emit(below: &[&str]) {
    let own = PathBuf::from(variable("CARGO_MANIFEST_DIR"));
    let mut crates: Vec<PathBuf> = below.iter().map(|name| variable(name).into()).collect();
    crates.push(own);
    for directory in &crates {
        println!(
            "cargo::rerun-if-changed={}",
            directory.join("src").display()
        );
        println!(
            "cargo::rerun-if-changed={}",
            directory.join("Cargo.toml").display()
        );
        if let Some(lock) = lock::nearest(directory) {
            println!("cargo::rerun-if-changed={}", lock.display());
        }
    }
    let compiler = compiler(variable("RUSTC"), &variable("TARGET"));
    let digest = digest(&crates, &compiler).expect("the sources of a crate that is being built");
    println!("cargo::rustc-env=SOURCE_DIGEST={digest}");
}

/// Returns the SHA-256, in hexadecimal, of what decides the numbers of `crates` when `compiler` compiles them. Each
/// of the `crates` is a directory with Cargo.toml and `src`.
///
/// # Errors
/// If a file cannot be read, or is not Rust or TOML.
pub fn digest(crates: &[impl AsRef<Path>], compiler: &str) -> io::Result<String> {
    let mut hash = Sha256::new();
    let mut part = |name: &str, content: &[u8]| {
        // Lengths keep parts apart.
        for piece in [name.as_bytes(), content] {
            hash.update(piece.len().to_le_bytes());
            hash.update(piece);
        }
    };
    part("compiler", compiler.as_bytes());
    for directory in crates {
        let directory = directory.as_ref();
        let sources = directory.join("src");
        for file in files(&sources)? {
            let content = fs::read(&file)?;
            let name = file
                .strip_prefix(&sources)
                .unwrap_or(&file)
                .to_string_lossy();
            if file.extension().is_some_and(|extension| extension == "rs") {
                if let Some(tokens) = tokens::deciding(&content, &file)? {
                    part(&name, tokens.as_bytes());
                }
            } else {
                part(&name, &content);
            }
        }
        for package in lock::packages(directory)? {
            part("package", package.as_bytes());
        }
    }
    Ok(hash
        .finalize()
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect())
}

/// Names the compiler `rustc`, as `rustc -vV` does, and the `target` that it compiles for.
///
/// # Panics
/// If it does not say its version.
pub fn compiler(rustc: impl AsRef<OsStr>, target: &str) -> String {
    let output = Command::new(rustc).arg("-vV").output();
    let output = output.expect("the compiler starts");
    assert!(output.status.success(), "the compiler says its version");
    format!("{}{target}", String::from_utf8_lossy(&output.stdout))
}

fn variable(name: &str) -> String {
    env::var(name).unwrap_or_else(|_| panic!("{name} is set for build scripts"))
}

/// Returns all files below `directory`, sorted by their paths.
fn files(directory: &Path) -> io::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(directory)? {
        let path = entry?.path();
        match path.is_dir() {
            true => found.extend(files(&path)?),
            false => found.push(path),
        }
    }
    found.sort();
    Ok(found)
}
