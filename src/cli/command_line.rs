//! The command line that a result carries, so that it can be produced again.

use crate::model::shell_quoted;
use std::ffi::OsString;
use std::path::Path;

/// Options that change no number: output files, formats, and how runs are carried out.
const LEFT_OUT: [&str; 9] = [
    "--out",
    "--format",
    "--store",
    "--jobs",
    "--time-limit",
    "--time-left",
    "--svg",
    "--vtk",
    "--junit",
];
const LEFT_OUT_FLAGS: [&str; 3] = ["--fresh", "--shared-store", "--quiet"];

/// Returns `tristack` with the arguments on which the results depend. The first of `arguments` is the program.
pub(super) fn command_line(arguments: &[OsString]) -> String {
    let mut line = "tristack".to_owned();
    let mut words = arguments.iter().skip(1);
    while let Some(word) = words.next() {
        let word = crate::model::shown(Path::new(word));
        let name = word.split_once('=').map_or(word.as_str(), |(name, _)| name);
        if LEFT_OUT.contains(&name) {
            if name == word {
                words.next();
            }
        } else if !LEFT_OUT_FLAGS.contains(&name) {
            line += " ";
            line += &shell_quoted(&word);
        }
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(words: &[&str]) -> String {
        let words: Vec<OsString> = words.iter().map(OsString::from).collect();
        command_line(&words)
    }

    #[test]
    fn what_changes_no_number_is_left_out() {
        let given = [
            "/usr/bin/tristack",
            "sweep",
            "--code",
            "native",
            "--out",
            "curve",
            "--format=json",
            "--fresh",
            "--time-left",
            "1h",
            "--mu",
            "0.1:0.3:0.1",
        ];
        assert_eq!(of(&given), "tristack sweep --code native --mu 0.1:0.3:0.1");
    }

    #[test]
    fn words_that_a_shell_would_take_apart_are_quoted() {
        let given = ["tristack", "predict", "--youngs", "1 MPa", "it's"];
        assert_eq!(of(&given), "tristack predict --youngs '1 MPa' 'it'\\''s'");
    }
}
