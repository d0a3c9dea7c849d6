//! README.md and the pages of docs/ can be followed: examples print what stands there, links lead somewhere, commands and
//! flags exist, and the first page is short.

mod page;

use crate::common::{Bench, project, standard_output};
use page::{Example, Page, without_uncertainties, words};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use tristack::study::Cause;

/// Characters of README.md at most: a first page is read in one go.
const LONGEST_FIRST_PAGE: usize = 6000;

/// The names of the commands in `tristack --help`.
fn commands() -> BTreeSet<String> {
    let help = standard_output(&mut Bench::without_codes().tristack("--help"));
    let list = help
        .split("Commands:\n")
        .nth(1)
        .expect("a list of commands");
    let lines = list.lines().take_while(|line| !line.is_empty());
    // Lines that go on with a description are indented further.
    let names = lines.filter(|line| !line.starts_with("   "));
    let names = names.filter_map(|line| line.split_whitespace().next());
    names
        .filter(|&name| name != "help")
        .map(str::to_owned)
        .collect()
}

#[test]
fn the_first_page_is_short_and_has_its_two_commands() {
    let page = Page::read("README.md");
    let length = page.text.chars().count();
    assert!(length <= LONGEST_FIRST_PAGE, "{length} characters");
    for command in ["cargo run --release -- crosscheck", "cargo test"] {
        let shown = page.code_lines().any(|line| line.starts_with(command));
        assert!(shown, "{command}");
    }
}

/// No external code is installed, so that recorded runs stand in and every digit is the same on every machine, but for the
/// uncertainties of the probe, which are rounding.
#[test]
fn examples_print_what_stands_on_the_page() {
    let examples: Vec<(String, Example)> = Page::all()
        .iter()
        .flat_map(|page| {
            page.examples()
                .into_iter()
                .map(|example| (page.name.clone(), example))
        })
        .collect();
    let of = |page: &str| examples.iter().filter(|(name, _)| name == page).count();
    assert!(of("README.md") >= 2, "the examples are found");
    assert!(of("docs/experiment.md") >= 1 && of("docs/conventions.md") >= 1);
    let bench = Bench::without_codes();
    for (page, example) in &examples {
        let mut command = bench.tristack("");
        let printed = standard_output(command.args(words(&example.line)));
        if !example.is_excerpt {
            assert_eq!(printed, example.printed, "{page}: {}", example.line);
            continue;
        }
        let is_probe = example.line.starts_with("probe");
        let lines = |text: &str| -> Vec<String> {
            let lines = text.lines();
            let shown = |line: &str| {
                if is_probe {
                    without_uncertainties(line)
                } else {
                    line.to_owned()
                }
            };
            lines.map(shown).collect()
        };
        let printed = lines(&printed);
        let mut rest = printed.iter();
        for line in lines(&example.printed) {
            let found = rest.any(|own| *own == line);
            assert!(found, "{page}: {}\n{line}\n{printed:#?}", example.line);
        }
    }
}

#[test]
fn the_table_of_commands_is_that_of_the_program() {
    let page = Page::read("README.md");
    let section = page.text.split("## Commands").nth(1).expect("the section");
    let rows = section.lines().filter(|line| line.starts_with("| `"));
    let cells = rows.filter_map(|row| row.split('|').nth(1));
    let named: Vec<&str> = cells
        .flat_map(|cell| cell.split('`').skip(1).step_by(2))
        .collect();
    let expected = commands();
    assert_eq!(named.len(), expected.len(), "{named:?}");
    let named: BTreeSet<String> = named.into_iter().map(str::to_owned).collect();
    assert_eq!(named, expected);
}

#[test]
fn every_link_leads_to_a_file_and_a_heading() {
    let mut links = 0;
    for page in Page::all() {
        for link in page.links() {
            links += 1;
            let (path, anchor) = link.split_once('#').unwrap_or((&link, ""));
            let target = match path {
                "" => page.name.clone(),
                path => page.beside(path),
            };
            assert!(project().join(&target).exists(), "{}: {link}", page.name);
            if !anchor.is_empty() {
                let headings = Page::read(&target).anchors();
                assert!(
                    headings.contains(anchor),
                    "{}: {link} {headings:?}",
                    page.name
                );
            }
        }
    }
    assert!(links > 60, "{links} links are found");
}

#[test]
fn every_page_is_in_the_index() {
    let linked = Page::read("docs/README.md").links();
    for entry in std::fs::read_dir(project().join("docs"))
        .expect("the pages")
        .flatten()
    {
        let name = entry.file_name().into_string().expect("text");
        if Path::new(&name)
            .extension()
            .is_some_and(|ending| ending == "md")
            && name != "README.md"
        {
            assert!(linked.contains(&name), "docs/README.md lacks {name}");
        }
    }
}

/// The command of a line, which may have two words, and its flags.
fn command_and_flags(line: &str) -> (String, Vec<String>) {
    let words = words(line);
    let mut command = words.first().cloned().unwrap_or_default();
    // Of commands that have commands of their own the second word counts too.
    if let ("passport" | "store", Some(second)) = (command.as_str(), words.get(1)) {
        command.push_str(&format!(" {second}"));
    }
    let flags = words.iter().filter(|word| word.starts_with("--"));
    let flags = flags.map(|flag| flag.split('=').next().unwrap_or_default().to_owned());
    (command, flags.collect())
}

#[test]
fn every_command_and_flag_of_the_pages_exists() {
    let bench = Bench::without_codes();
    let known = commands();
    let mut helps = BTreeMap::new();
    let mut tried = 0;
    for page in Page::all() {
        for line in page.command_lines() {
            let (command, flags) = command_and_flags(&line);
            let first = command.split(' ').next().unwrap_or_default();
            if first.starts_with("--") || first.is_empty() {
                continue;
            }
            assert!(known.contains(first), "{}: tristack {line}", page.name);
            let help = helps.entry(command.clone()).or_insert_with(|| {
                standard_output(&mut bench.tristack(&format!("{command} --help")))
            });
            for flag in flags {
                let is_known = help
                    .split([' ', '\n', '[', ',', '='])
                    .any(|word| word == flag);
                assert!(is_known, "{}: tristack {line} has no {flag}", page.name);
                tried += 1;
            }
        }
    }
    assert!(tried > 40, "{tried} flags are found");
}

/// The page on verdicts explains every cause.
#[test]
fn every_cause_of_an_inconclusive_row_is_explained() {
    let page = Page::read("docs/verdicts.md");
    for cause in Cause::ALL {
        let row = format!("\n| {} | ", cause.as_str());
        assert!(page.text.contains(&row), "{}", cause.as_str());
    }
}
