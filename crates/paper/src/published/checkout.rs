//! A checkout of the authors' repository, github.com/Ryudo-Suzuki/arXiv-2511.06807: its data files as they are.

use crate::dem::GivenStart;
use crate::files::{FileError, Links, read_bounded};
use crate::model::{CRITICAL_FRICTION, sha256_hex};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Where the public versions keep their figures.
const LAYOUTS: [&str; 2] = ["", "figures"];
/// Where they may keep the program, its own results, and the states from which it starts.
const PROGRAMS: [&str; 2] = ["src", "src/compress"];
const LARGEST_FILE: u64 = 16 << 20;

/// A number as it is printed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Printed {
    /// Its value.
    pub value: f64,
    /// Digits after the point.
    pub decimals: usize,
}

impl Printed {
    fn parse(word: &str) -> Option<Self> {
        let value = word.parse().ok().filter(|value: &f64| value.is_finite())?;
        let decimals = word.split_once('.').map_or(0, |(_, after)| {
            after.bytes().take_while(u8::is_ascii_digit).count()
        });
        Some(Self { value, decimals })
    }

    /// Returns half a unit of its last digit.
    pub fn half_unit(&self) -> f64 {
        0.5 * 0.1f64.powi(self.decimals as i32)
    }

    /// Returns whether `value`, printed with as many digits after the point, is this number.
    pub fn is(&self, value: f64) -> bool {
        format!("{value:.*}", self.decimals).parse() == Ok(self.value)
    }
}

/// The quantity in the rows of a data file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Subject {
    /// Yield forces at a stiffness, by friction.
    Frictions {
        /// k_n r/(m g).
        stiffness: f64,
    },
    /// Yield forces at a friction, by stiffness.
    Stiffnesses {
        /// μ, from the name of the file.
        friction: f64,
    },
    /// Yield forces of one stack, by time step.
    TimeSteps,
    /// Yield forces of one stack, by wall speed.
    WallSpeeds,
    /// f over time.
    Force,
}

/// A data file of a figure.
#[derive(Debug, Clone, PartialEq)]
pub struct DataFile {
    /// Its path below the checkout.
    pub path: String,
    /// SHA-256 of its content.
    pub digest: String,
    /// What it holds.
    pub subject: Subject,
    /// The comments at its head.
    pub head: Vec<String>,
    /// Its rows, each with its line number.
    pub rows: Vec<(usize, [Printed; 2])>,
}

/// All data of a checkout.
#[derive(Debug, Clone, PartialEq)]
pub struct Checkout {
    /// The data files, by path.
    pub files: Vec<DataFile>,
    /// The states from which runs start, by the push A of the side walls in their names; velocities are in √(g r) and
    /// √(g/r).
    pub starts: BTreeMap<String, GivenStart>,
    /// The sources of the programs, by their paths below the checkout; empty if it has the data alone.
    pub programs: BTreeMap<String, String>,
}

impl Checkout {
    /// Returns whether `directory` holds a checkout of any public version.
    pub fn is_in(directory: &Path) -> bool {
        layout(directory).is_some()
    }

    /// Reads the checkout in `directory`, of any public version.
    ///
    /// # Errors
    /// If it is something else, or a file holds anything but numbers.
    pub fn read(directory: &Path) -> Result<Self, FileError> {
        let layout = layout(directory).ok_or_else(|| {
            let message = "is no checkout of github.com/Ryudo-Suzuki/arXiv-2511.06807: it has neither fig2a/data nor \
                           figures/fig2a/data";
            FileError::content(directory, message.to_owned())
        })?;
        let mut files = Vec::new();
        let figures = ["fig2a", "fig2b", "figS2", "figS3a", "figS3b"];
        let folders = figures.map(|figure| Path::new(layout).join(figure));
        let folders = folders.into_iter().chain(PROGRAMS.map(PathBuf::from));
        for folder in folders.map(|folder| folder.join("data")) {
            for name in names(&directory.join(&folder))? {
                if let Some(subject) = subject(&folder, &name) {
                    files.push(DataFile::read(directory, &folder.join(&name), subject)?);
                }
            }
        }
        let mut starts = BTreeMap::new();
        for folder in PROGRAMS.map(|program| directory.join(program).join("init")) {
            for name in names(&folder)? {
                if let Some(push) = between(&name, "init_p_A", ".txt") {
                    starts.insert(push.to_owned(), start(&folder, push)?);
                }
            }
        }
        let mut programs = BTreeMap::new();
        for folder in PROGRAMS {
            for name in names(&directory.join(folder))? {
                if name.ends_with(".c") {
                    let path = format!("{folder}/{name}");
                    programs.insert(path.clone(), text(&directory.join(&path))?);
                }
            }
        }
        Ok(Self {
            files,
            starts,
            programs,
        })
    }
}

/// Returns the folder of the figures within the checkout in `directory`.
fn layout(directory: &Path) -> Option<&'static str> {
    let has_figures = |layout: &&str| directory.join(layout).join("fig2a/data").is_dir();
    LAYOUTS.into_iter().find(has_figures)
}

impl DataFile {
    fn read(directory: &Path, path: &Path, subject: Subject) -> Result<Self, FileError> {
        let file = directory.join(path);
        let text = text(&file)?;
        let lines = || text.lines().enumerate();
        let head = lines().filter_map(|(_, line)| line.strip_prefix('#'));
        let rows = lines().filter(|(_, line)| !line.starts_with('#') && !line.trim().is_empty());
        let rows = rows.map(|(index, line)| {
            let words = line.split_whitespace().map(Printed::parse);
            let numbers: Option<Vec<Printed>> = words.collect();
            let numbers = numbers.and_then(|numbers| numbers.try_into().ok());
            let row = numbers.map(|numbers: [Printed; 2]| (index + 1, numbers));
            row.ok_or_else(|| wrong_line(&file, index, line, "two numbers"))
        });
        Ok(Self {
            path: path.to_string_lossy().into_owned(),
            digest: sha256_hex(text.as_bytes()),
            subject,
            head: head.map(|line| line.trim().to_owned()).collect(),
            rows: rows.collect::<Result<_, _>>()?,
        })
    }
}

/// Returns what the file of this name in this folder holds; `None` if it is not a result of the program.
fn subject(folder: &Path, name: &str) -> Option<Subject> {
    let figure = folder.iter().rev().nth(1)?.to_str()?;
    match figure {
        "fig2b" => match between(name, "mu", ".txt")? {
            "c" => Some(CRITICAL_FRICTION),
            friction => friction.parse().ok(),
        }
        .map(|friction| Subject::Stiffnesses { friction }),
        "figS2" => between(name, "f_vwall", ".txt").map(|_| Subject::Force),
        "figS3a" => (name == "dt.txt").then_some(Subject::TimeSteps),
        "figS3b" => (name == "vwall.txt").then_some(Subject::WallSpeeds),
        _ => {
            let stiffness = between(name, "k", ".txt")?.parse().ok()?;
            Some(Subject::Frictions { stiffness })
        }
    }
}

/// Reads the state from the two files named after `push`.
fn start(folder: &Path, push: &str) -> Result<GivenStart, FileError> {
    let places = table::<6>(&folder.join(format!("init_p_A{push}.txt")), 3)?;
    let springs = table::<3>(&folder.join(format!("init_deltat_A{push}.txt")), 8)?;
    // The program numbers the cylinders left, right, top.
    let order = [2, 1, 0];
    Ok(GivenStart {
        places: order.map(|body| [0, 1, 2].map(|column| places[body][column])),
        velocities: order.map(|body| [3, 4, 5].map(|column| places[body][column])),
        pair_springs: [1, 0].map(|body| [springs[body][2], springs[3 + body][2]]),
        floor_springs: [1, 0].map(|body| [springs[6][body], springs[7][body]]),
    })
}

/// Reads a file of numbers, which must have this many `rows`.
fn table<const COLUMNS: usize>(path: &Path, rows: usize) -> Result<Vec<[f64; COLUMNS]>, FileError> {
    let text = text(path)?;
    let lines = text.lines().enumerate();
    let lines = lines.filter(|(_, line)| !line.trim().is_empty());
    let found = lines.map(|(index, line)| {
        let numbers: Result<Vec<f64>, _> = line.split_whitespace().map(str::parse).collect();
        let numbers = numbers.ok().and_then(|numbers| numbers.try_into().ok());
        numbers.ok_or_else(|| wrong_line(path, index, line, &format!("{COLUMNS} numbers")))
    });
    let found: Vec<[f64; COLUMNS]> = found.collect::<Result<_, _>>()?;
    match found.len() == rows {
        true => Ok(found),
        false => {
            let message = format!("has {} rows of numbers; {rows} are expected", found.len());
            Err(FileError::content(path, message))
        }
    }
}

fn wrong_line(path: &Path, index: usize, line: &str, accepted: &str) -> FileError {
    let message = format!("line {}: {line:?}; {accepted} are expected", index + 1);
    FileError::content(path, message)
}

fn text(path: &Path) -> Result<String, FileError> {
    let bytes = read_bounded(path, LARGEST_FILE, Links::Followed);
    let bytes = bytes.map_err(FileError::reading(path))?;
    String::from_utf8(bytes).map_err(|_| FileError::content(path, "is no text"))
}

/// Returns the names in a folder, sorted; none if the folder does not exist.
fn names(folder: &Path) -> Result<Vec<String>, FileError> {
    if !folder.is_dir() {
        return Ok(Vec::new());
    }
    let entries = folder.read_dir().map_err(FileError::reading(folder))?;
    let names = entries.map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()));
    let names: std::io::Result<Vec<String>> = names.collect();
    let mut names = names.map_err(FileError::reading(folder))?;
    names.sort();
    Ok(names)
}

/// Returns the text between a beginning and an end; `None` without them.
fn between<'a>(text: &'a str, beginning: &str, end: &str) -> Option<&'a str> {
    text.strip_prefix(beginning)?.strip_suffix(end)
}
