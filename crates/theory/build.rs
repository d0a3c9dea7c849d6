//! Passes the directory of this crate to build scripts of the crates above it, which digest its sources.

fn main() {
    println!("cargo::metadata=root={}", env!("CARGO_MANIFEST_DIR"));
    println!("cargo::rerun-if-changed=build.rs");
}
