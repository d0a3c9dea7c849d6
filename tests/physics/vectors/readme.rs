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

/// A theory that is wrong by a ten-thousandth fails in the example, and so does one of the other spring.
#[test]
fn the_example_refuses_a_wrong_theory() {
    for (right, wrong) in [
        ("< mu / stiffness", "< 1.0001 * mu / stiffness"),
        ("if spring == \"fixed\"", "if False"),
        ("if spring == \"fixed\"", "if True"),
    ] {
        let program = example().replace(right, wrong);
        assert_ne!(program, example());
        let output = Command::new("python3")
            .args(["-c", &program])
            .current_dir(folder())
            .output()
            .expect("python3 runs");
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(error.contains("AssertionError"), "{wrong}: {error}");
    }
}

#[test]
fn the_licence_is_named_in_every_place() {
    let licence = std::fs::read_to_string(folder().join("LICENSE-CC0")).expect("a licence");
    assert!(licence.contains("SPDX-License-Identifier: CC0-1.0"));
    assert!(readme().contains("CC0-1.0"));
}
