//! A wrong value of any flag of any command is named with the flag and with what would be accepted.

use crate::common::{Bench, standard_output};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

const WRONG: [&str; 5] = ["zzz", "-1", "0", "nan", "1e999"];

/// Flags that take the path of a file or a directory, or any line of text.
const TAKE_ANY_TEXT: [&str; 15] = [
    "--junit",
    "--out",
    "--vtk",
    "--store",
    "--case",
    "--series",
    "--coarse-step",
    "--short-ramp",
    "--passport",
    "--passports",
    "--plan",
    "--verdicts",
    "--code-version",
    "--history-of",
    "--file",
];

/// Flags with those of the values above that are right for them.
const RIGHT: [(&str, &[&str]); 9] = [
    ("--seed", &["0"]),
    ("--pair-arm", &["-1", "0"]),
    ("--pair-kinematic-arm", &["-1", "0"]),
    ("--floor-arm", &["-1", "0"]),
    ("--floor-kinematic-arm", &["-1", "0"]),
    ("--push", &["0"]),
    ("--poisson", &["0"]),
    ("--mu-uncertainty", &["0"]),
    ("--mu-d", &["0"]),
];

/// What a command needs beside the flag, so that what its parser lets pass is refused for its range.
const NEEDED: [(&str, &[(&str, &str)]); 8] = [
    ("theory", &[("--mu", "0.3"), ("--stiffness", "100")]),
    (
        "simulate",
        &[
            ("--code", "native"),
            ("--mu", "0.3"),
            ("--stiffness", "100"),
            ("--preparation", "side-walls"),
        ],
    ),
    (
        "sweep",
        &[
            ("--code", "native"),
            ("--mu", "0.3"),
            ("--stiffness", "100"),
        ],
    ),
    (
        "crosscheck",
        &[
            ("--codes", "native"),
            ("--mu", "0.3"),
            ("--stiffness", "100"),
        ],
    ),
    ("impacts", &[("--codes", "native")]),
    (
        "plan",
        &[
            ("--code", "yade"),
            ("--out", "plan"),
            ("--mu", "0.3"),
            ("--stiffness", "100"),
        ],
    ),
    (
        "judge",
        &[
            ("--mu", "0.3"),
            ("--stiffness", "100"),
            ("--speeds", "1e-4,2e-4,4e-4"),
            ("--pair-arm", "0"),
            ("--floor-arm", "0"),
            ("--series", "a,b,c"),
        ],
    ),
    (
        "predict",
        &[
            ("--youngs", "1 MPa"),
            ("--density", "1000 kg/m3"),
            ("--radius", "1 cm"),
            ("--length", "1 cm"),
            ("--mu", "0.3"),
        ],
    ),
];

/// The commands that the program knows.
fn commands(bench: &Bench) -> Vec<String> {
    let help = standard_output(&mut bench.tristack("--help"));
    let list = help
        .split("Commands:\n")
        .nth(1)
        .expect("a list of commands");
    let lines = list.lines().take_while(|line| line.starts_with("  "));
    let names = lines.filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    let names = names.filter(|name| !name.is_empty() && *name != "help");
    names.map(str::to_owned).collect()
}

/// The flags of `command` that take a value.
fn flags(bench: &Bench, command: &str) -> Vec<String> {
    let help = standard_output(&mut bench.tristack(&format!("{command} --help")));
    let options = help.lines().map(str::trim_start);
    let options = options.filter(|line| line.starts_with("--"));
    let valued = options.filter_map(|line| {
        let end = line.find(|letter: char| !(letter.is_ascii_lowercase() || letter == '-'))?;
        let takes_value = [" <", "[=<"]
            .iter()
            .any(|mark| line[end..].starts_with(mark));
        takes_value.then(|| line[..end].to_owned())
    });
    valued.collect()
}

/// The words of a command line with `flag` as `value`.
fn words(command: &str, flag: &str, value: &str) -> Vec<String> {
    let mut words = vec![command.to_owned()];
    let needed = NEEDED.iter().find(|(name, _)| *name == command);
    let needed = needed.map_or(&[][..], |(_, needed)| needed);
    // An arm for a command that already has it, the material in place of what it gives.
    let replaced = |name: &str| match flag {
        "--youngs" => name == flag || (name == "--stiffness" && command != "predict"),
        "--mass" => name == "--density",
        "--profile" | "--published" => ["--mu", "--stiffness"].contains(&name),
        "--explain" => ["--mu", "--codes"].contains(&name),
        _ => name == flag,
    };
    for (name, usual) in needed.iter().filter(|(name, _)| !replaced(name)) {
        words.push((*name).to_owned());
        match *name {
            "--series" => words.extend(usual.split(',').map(str::to_owned)),
            _ => words.push((*usual).to_owned()),
        }
    }
    if flag == "--youngs" && command != "predict" {
        words.extend(["--poisson", "0.3", "--law", "hertz"].map(str::to_owned));
    }
    if flag == "--published" && command == "crosscheck" {
        words.extend(["--profile", "published"].map(str::to_owned));
    }
    match flag {
        "--tangential-stiffening" => words.push(format!("{flag}={value}")),
        _ => words.extend([flag.to_owned(), value.to_owned()]),
    }
    words
}

/// What is missing in the message about `flag` with `value`, if anything is.
fn complaint(bench: &Bench, command: &str, flag: &str, value: &str) -> Option<String> {
    let words = words(command, flag, value);
    let output = bench.process("").args(&words).output().expect("it starts");
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    let says = |part: &str| message.to_lowercase().contains(part);
    let value = if value == "1e999" && !says(value) {
        "inf"
    } else {
        value
    };
    let says_what = ["accepted", "but must be", "possible values"];
    let is_plain = output.status.code() == Some(1)
        && says(flag)
        && says(value)
        && says_what.iter().any(|part| says(part))
        && !says("invalid float")
        && !says("panicked");
    (!is_plain).then(|| format!("{} ({})\n{message}", words.join(" "), output.status))
}

#[test]
fn a_wrong_value_of_any_flag_is_named_with_the_flag_and_what_is_accepted() {
    let bench = Bench::without_codes();
    let commands = commands(&bench);
    assert!(commands.len() > 15, "{commands:?}");
    let complaints = commands.into_par_iter().flat_map_iter(|command| {
        let bench = Bench::without_codes();
        let flags = flags(&bench, &command);
        let free = |flag: &String| TAKE_ANY_TEXT.contains(&flag.as_str());
        let flags = flags.into_iter().filter(|flag| !free(flag));
        let complaints = flags.flat_map(|flag| {
            let right = RIGHT.iter().find(|(name, _)| *name == flag);
            let right = right.map_or(&[][..], |(_, values)| values);
            let wrong = WRONG.iter().filter(|value| !right.contains(value));
            let complaints = wrong.filter_map(|value| complaint(&bench, &command, &flag, value));
            complaints.collect::<Vec<_>>()
        });
        complaints.collect::<Vec<_>>()
    });
    let complaints: Vec<String> = complaints.collect();
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

#[test]
fn a_negative_quantity_is_refused_as_a_quantity() {
    let bench = Bench::without_codes();
    for flag in ["--youngs", "--density", "--mass", "--radius", "--length"] {
        let complaint = complaint(&bench, "predict", flag, "-1 MPa");
        // The message shows the value as it was given.
        let complaint = complaint.filter(|message| !message.contains("'-1 MPa'"));
        assert_eq!(complaint, None);
    }
}

#[test]
fn a_store_that_cannot_be_used_is_called_the_store() {
    let bench = Bench::without_codes();
    std::fs::write(bench.path("file"), "").expect("a file where a directory is wanted");
    let mut command = bench.process("crosscheck --codes native --store file/store");
    let output = command.output().expect("it starts");
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1));
    for part in [
        "the store cannot be used",
        "file/store",
        "accepted is",
        "--store",
    ] {
        assert!(message.contains(part), "{message} lacks {part}");
    }
}
