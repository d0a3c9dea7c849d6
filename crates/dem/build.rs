//! Digests what decides the numbers of this crate.

fn main() {
    tristack_digest::emit(&["DEP_TRISTACK_THEORY_ROOT"]);
    println!("cargo::rerun-if-changed=build.rs");
}
