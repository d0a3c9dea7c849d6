//! The example of `reference/vectors/README.md`.

use super::file::folder;
use std::process::Command;

fn readme() -> String {
    std::fs::read_to_string(folder().join("README.md")).expect("the page is there")
}

/// The only block of Python on the page.
fn example() -> String {
    let page = readme();
    let [_, rest] = page.split("```python\n").collect::<Vec<_>>()[..] else {
        panic!("one block of Python");
    };
    rest.split("```").next().expect("its end").to_owned()
}

#[test]
fn the_example_of_the_page_runs_and_finds_the_vectors_right() {
    let output = Command::new("python3")
        .args(["-c", &example()])
        .current_dir(folder())
        .output()
        .expect("python3 runs");
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{error}");
    assert!(readme().contains(said.trim_end()), "{said}");
}

/// A theory that is wrong by a ten-thousandth fails in the example.
#[test]
fn the_example_refuses_a_wrong_theory() {
    let wrong = example().replace("< mu / stiffness", "< 1.0001 * mu / stiffness");
    assert_ne!(wrong, example());
    let output = Command::new("python3")
        .args(["-c", &wrong])
        .current_dir(folder())
        .output()
        .expect("python3 runs");
    assert!(!output.status.success());
}

#[test]
fn the_licence_is_named_in_every_place() {
    let licence = std::fs::read_to_string(folder().join("LICENSE-CC0")).expect("a licence");
    assert!(licence.contains("SPDX-License-Identifier: CC0-1.0"));
    assert!(readme().contains("CC0-1.0"));
}
