//! A page in Markdown, as far as the tests look into it.

use crate::common::{files_below, project};
use std::collections::BTreeSet;
use std::path::{Component, Path, PathBuf};

/// A page of the project.
pub struct Page {
    /// Its path below the top of the project.
    pub name: String,
    pub text: String,
}

/// A command of `tristack` with what it prints.
pub struct Example {
    /// What follows the name of the program.
    pub line: String,
    pub printed: String,
    /// Whether lines are left out, which a line of three dots says.
    pub is_excerpt: bool,
}

/// The line that stands for lines which are left out.
const LEFT_OUT: &str = "...";
const PROGRAMS: [&str; 2] = ["tristack ", "cargo run --release -- "];

impl Page {
    pub fn read(name: &str) -> Self {
        let text = std::fs::read_to_string(project().join(name));
        Self {
            name: name.to_owned(),
            text: text.unwrap_or_else(|error| panic!("{name}: {error}")),
        }
    }

    /// Every page that a person wrote for readers; CHANGELOG.md is about former states.
    pub fn all() -> Vec<Self> {
        let mut names = vec!["README.md".to_owned()];
        names.extend(["ARCHITECTURE.md", "CONTRIBUTING.md"].map(str::to_owned));
        for folder in ["docs", "examples", "reference"] {
            let pages = files_below(&project().join(folder)).into_iter();
            let pages = pages.filter(|path| is_page(path));
            names.extend(pages.map(|path| format!("{folder}/{}", path.display())));
        }
        names.iter().map(|name| Self::read(name)).collect()
    }

    /// The lines of code: indented by four, or between fences.
    pub fn code_lines(&self) -> impl Iterator<Item = &str> {
        let mut is_fenced = false;
        self.text.lines().filter_map(move |line| {
            if line.starts_with("```") {
                is_fenced = !is_fenced;
                return None;
            }
            line.strip_prefix("    ").or(is_fenced.then_some(line))
        })
    }

    /// The commands that are shown with what they print.
    pub fn examples(&self) -> Vec<Example> {
        let mut examples: Vec<Example> = Vec::new();
        let mut is_open = false;
        for line in self.text.lines() {
            let code = line.strip_prefix("    ");
            if let Some(command) = code.and_then(|code| code.strip_prefix("$ tristack ")) {
                is_open = true;
                examples.push(Example {
                    line: command.to_owned(),
                    printed: String::new(),
                    is_excerpt: false,
                });
                continue;
            }
            let (Some(code), Some(example), true) = (code, examples.last_mut(), is_open) else {
                is_open = false;
                continue;
            };
            if code == LEFT_OUT {
                example.is_excerpt = true;
            } else {
                example.printed.push_str(&format!("{code}\n"));
            }
        }
        examples.retain(|example| !example.printed.is_empty());
        examples
    }

    /// What follows the name of the program in code of the page, in lines of their own and between backquotes.
    pub fn command_lines(&self) -> Vec<String> {
        let own = self.code_lines().flat_map(|line| {
            let line = line.split(" #").next().unwrap_or_default();
            line.split("&&").collect::<Vec<_>>()
        });
        let inline = self.text.split('`').skip(1).step_by(2);
        own.chain(inline).filter_map(command_of).collect()
    }

    /// The targets of the links to files and headings.
    pub fn links(&self) -> Vec<String> {
        let marked = self.text.split("](").skip(1);
        let marked = marked.filter_map(|rest| rest.split(')').next());
        let pictures = self.text.split("src=\"").skip(1);
        let pictures = pictures.filter_map(|rest| rest.split('"').next());
        let links = marked.chain(pictures);
        // A bracket before a parenthesis stands in formulas, too.
        let links = links.filter(|link| !link.contains("://") && !link.contains(['\\', ' ', '$']));
        links.map(str::to_owned).collect()
    }

    /// The file at a path relative to the page.
    pub fn beside(&self, path: &str) -> String {
        let mut file = PathBuf::from(&self.name);
        file.pop();
        for part in Path::new(path).components() {
            match part {
                Component::ParentDir => _ = file.pop(),
                part => file.push(part),
            }
        }
        file.display().to_string()
    }

    /// The anchors of the headings, as GitHub makes them.
    pub fn anchors(&self) -> BTreeSet<String> {
        let headings = self.text.lines().filter(|line| line.starts_with('#'));
        let headings = headings.map(|line| line.trim_start_matches('#').trim().to_lowercase());
        let anchors = headings.map(|heading| {
            let kept = heading
                .chars()
                .filter(|&sign| sign.is_alphanumeric() || " -_".contains(sign));
            kept.map(|sign| if sign == ' ' { '-' } else { sign })
                .collect()
        });
        anchors.collect()
    }
}

fn is_page(path: &Path) -> bool {
    let is_installed = path.components().any(|part| part.as_os_str() == "venv");
    !is_installed && path.extension().is_some_and(|ending| ending == "md")
}

/// What follows the name of the program at the start of a piece of code.
fn command_of(code: &str) -> Option<String> {
    let code = code.trim().trim_start_matches("$ ").replace('\n', " ");
    let rest = PROGRAMS
        .iter()
        .find_map(|program| code.strip_prefix(program));
    rest.map(|rest| rest.trim().to_owned())
}

/// The words of a command line, some in double quotes.
pub fn words(line: &str) -> Vec<String> {
    let mut words = Vec::new();
    for (index, part) in line.split('"').enumerate() {
        if index % 2 == 1 {
            words.push(part.to_owned());
        } else {
            words.extend(part.split_whitespace().map(str::to_owned));
        }
    }
    words
}

/// A line without the uncertainties in brackets, and without the width of cells, which depends on them.
pub fn without_uncertainties(line: &str) -> String {
    let is_uncertainty = |word: &str| {
        let inner = word
            .strip_prefix('(')
            .and_then(|word| word.strip_suffix(')'));
        inner.is_some_and(|inner| inner.parse::<f64>().is_ok())
    };
    let words = line.split_whitespace().filter(|word| !is_uncertainty(word));
    words.collect::<Vec<_>>().join(" ")
}
