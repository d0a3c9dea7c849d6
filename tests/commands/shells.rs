//! Completions for shells, and manual pages.

use crate::common;
use crate::common::{Bench, standard_output};
use std::fs;
use std::process::{Command, Output};

/// The command that the program gives itself alone.
const GUARD: &str = "guard";

/// The commands of the program, as its help lists them.
fn commands(bench: &Bench) -> Vec<String> {
    let help = standard_output(&mut bench.tristack("--help"));
    let list = help.split("Commands:\n").nth(1).expect("a list");
    let list = list.split("\n\n").next().expect("its lines");
    let lines = list.lines().filter(|line| !line.starts_with("   "));
    let names = lines.filter_map(|line| line.split_whitespace().next());
    let names = names.filter(|name| *name != "help").map(str::to_owned);
    let names: Vec<String> = names.collect();
    assert!(names.len() > 15, "{names:?}");
    names
}

/// What `program` makes of a file; nothing where it is not installed.
fn judged(program: &str, arguments: &[&str]) -> Option<Output> {
    match Command::new(program).args(arguments).output() {
        Ok(output) => Some(output),
        Err(_) => {
            eprintln!("skipped: {program} is not installed");
            None
        }
    }
}

#[test]
fn every_shell_has_completions_of_every_command() {
    let bench = Bench::without_codes();
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let line = format!("completions {shell}");
        let script = standard_output(&mut bench.tristack(&line));
        for name in commands(&bench) {
            assert!(script.contains(&name), "{shell} lacks {name}");
        }
        assert!(!script.contains(GUARD), "it is no command for people");
        let path = bench.path(shell);
        fs::write(&path, script).expect("a script");
        let path = path.display().to_string();
        let checked = match shell {
            "bash" | "zsh" => judged(shell, &["-n", &path]),
            "fish" => judged(shell, &["--no-execute", &path]),
            _ => None,
        };
        if let Some(output) = checked {
            let message = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success() && message.is_empty(), "{message}");
        }
    }
}

/// What bash completes when the words of `line` have been typed, the last of them in part.
fn completed(bench: &Bench, line: &str) -> Vec<String> {
    let script = bench.path("bash");
    fs::write(
        &script,
        standard_output(&mut bench.tristack("completions bash")),
    )
    .expect("a script");
    let words: Vec<&str> = line.split(' ').collect();
    let (last, before) = (words[words.len() - 1], words[words.len() - 2]);
    let asked = format!(
        "source {}; COMP_WORDS=({line}); COMP_CWORD={}; _tristack tristack '{last}' '{before}'; echo \"${{COMPREPLY[@]}}\"",
        script.display(),
        words.len() - 1,
    );
    let output = Command::new("bash").args(["--norc", "-c", &asked]).output();
    let output = String::from_utf8(output.expect("bash").stdout).expect("text");
    output.split_whitespace().map(str::to_owned).collect()
}

#[test]
fn bash_completes_commands_options_and_values() {
    let bench = Bench::without_codes();
    assert_eq!(completed(&bench, "tristack cross"), ["crosscheck"]);
    assert_eq!(completed(&bench, "tristack store pr"), ["prune"]);
    let options = completed(&bench, "tristack crosscheck --prof");
    assert_eq!(options, ["--profile"]);
    let values = completed(&bench, "tristack crosscheck --profile s");
    assert_eq!(values, ["standard"]);
    let codes = completed(&bench, "tristack crosscheck --codes nat");
    assert_eq!(codes, ["native"]);
}

#[test]
fn every_command_has_a_manual_page_without_faults() {
    let bench = Bench::without_codes();
    bench.tristack("man --out pages").assert().code(0);
    let mut expected = commands(&bench);
    expected
        .extend(["passport-diff", "store-list", "store-show", "store-prune"].map(str::to_owned));
    let mut expected: Vec<String> = expected
        .iter()
        .map(|name| format!("tristack-{name}.1"))
        .collect();
    expected.push("tristack.1".to_owned());
    expected.sort();
    let expected: Vec<&str> = expected.iter().map(String::as_str).collect();
    common::assert_only(&bench.path("pages"), &expected);
    for name in expected {
        let path = bench.path("pages").join(name).display().to_string();
        if let Some(output) = judged("groff", &["-Kutf8", "-Tutf8", "-man", "-ww", "-z", &path]) {
            let message = String::from_utf8_lossy(&output.stderr);
            assert!(
                output.status.success() && message.is_empty(),
                "{name}: {message}"
            );
        }
    }
    // The same again takes the place of what it wrote.
    bench.tristack("man --out pages").assert().code(0);
    fs::write(bench.path("pages/ls.1"), "").expect("a page of somebody else");
    bench.tristack("man --out pages").assert().code(1);
}

#[test]
fn a_page_is_printed_by_the_words_of_its_command() {
    let bench = Bench::without_codes();
    let page = standard_output(&mut bench.tristack("man store prune"));
    for part in [
        ".TH tristack-store-prune 1",
        "\\-\\-older\\-than",
        "Remove entries",
    ] {
        assert!(page.contains(part), "{page} lacks {part}");
    }
    let first = standard_output(&mut bench.tristack("man"));
    assert!(first.contains("Exit status: 0 all agree"), "{first}");
    let refused = bench.tristack("man store burn").assert().code(1);
    let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    for part in ["burn", "list, show, prune"] {
        assert!(message.contains(part), "{message} lacks {part}");
    }
}
