//! The files on which the numbers of a program depend, as far as they can be found without running it: the program, the
//! interpreter of a script and the programs and modules that the script names, and the libraries that the loader maps.

use super::definition::LONGEST_START;
use super::manifest::Environment;
use super::packages::Packages;
use super::question::answer;
use super::search_path::in_search_path;
use crate::files::{Links, read_beginning, read_bounded};
use crate::model::sha256_hex;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsString;
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Longest script that is searched for names, in bytes.
const LONGEST_SCRIPT: u64 = 1 << 20;
/// Most modules in a directory of modules; a directory with more is ignored.
const MOST_MODULES: usize = 5000;
const MOST_LEVELS: usize = 8;

/// Identifies a file's content without reading it: device, inode number, size, and time of the last change.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Stamp([i64; 5]);

impl Stamp {
    /// Returns the stamp of the file at `path`, following links; `None` if there is none.
    pub(super) fn of(path: &Path) -> Option<Self> {
        let data = std::fs::metadata(path).ok()?;
        let place = [data.dev() as i64, data.ino() as i64, data.size() as i64];
        let [device, number, size] = place;
        let (seconds, fraction) = (data.ctime(), data.ctime_nsec());
        Some(Self([device, number, size, seconds, fraction]))
    }
}

/// The files that decide what a program computes, with digests and stamps from when they were found.
#[derive(Debug, Clone, Default)]
pub(super) struct CoveredFiles {
    /// SHA-256 of each file.
    hashes: BTreeMap<PathBuf, String>,
    stamps: Vec<(PathBuf, Stamp)>,
}

impl CoveredFiles {
    /// Finds the files behind `program`, which gets `words` as arguments in its `environment`, and `decks` to read.
    /// For a Python interpreter, they include what decks import from its packages.
    pub fn of<'a>(
        program: &Path,
        words: &[String],
        environment: &Environment,
        decks: impl IntoIterator<Item = &'a [u8]>,
    ) -> Self {
        let mut search = Search::default();
        search.add_program(program);
        for deck in decks {
            search.add_imports(Path::new(""), &String::from_utf8_lossy(deck));
        }
        for word in words.iter().map(Path::new) {
            if word.is_absolute() && word.is_file() {
                search.add_program(word);
            }
        }
        let (files, libraries) = (search.files.clone(), search.libraries.clone());
        let environment = search.packages.with_libraries(environment);
        let loaders = search.loaders.par_iter();
        let mapped = loaders.flat_map_iter(|(program, loader)| {
            // Extensions of an interpreter are mapped into it as soon as they are imported.
            mapped_by_loader(loader, program, &libraries, &environment)
        });
        let mapped: Vec<PathBuf> = mapped.collect();
        let others = files.into_iter().chain(libraries.clone());
        let all: BTreeSet<PathBuf> = others.chain(mapped).collect();
        Self::hashed(all)
    }

    fn hashed(files: BTreeSet<PathBuf>) -> Self {
        let files: Vec<PathBuf> = files.into_iter().collect();
        let known: Vec<_> = files
            .into_par_iter()
            .filter_map(|path| {
                let stamp = Stamp::of(&path)?;
                let hash = hash_of(&path, stamp)?;
                Some((path, stamp, hash))
            })
            .collect();
        let stamps = known.iter().map(|(path, stamp, _)| (path.clone(), *stamp));
        Self {
            stamps: stamps.collect(),
            hashes: known
                .into_iter()
                .map(|(path, _, hash)| (path, hash))
                .collect(),
        }
    }

    /// Returns the SHA-256 of `path` if it is covered.
    pub fn hash(&self, path: &Path) -> Option<&String> {
        self.hashes.get(path)
    }

    /// Returns one SHA-256 over the paths and contents of all files.
    pub fn digest(&self) -> String {
        let lines = self.hashes.iter();
        let lines = lines.map(|(path, hash)| format!("{hash}  {path:?}\n"));
        sha256_hex(lines.collect::<String>().as_bytes())
    }

    /// Returns one of the files that has changed since it was read.
    pub fn changed(&self) -> Option<&PathBuf> {
        let mut stamps = self.stamps.iter();
        let changed = stamps.find(|(path, stamp)| Stamp::of(path) != Some(*stamp));
        changed.map(|(path, _)| path)
    }

    /// Returns the number of files, and how many of them are shared libraries.
    pub fn counts(&self) -> (usize, usize) {
        let libraries = self.hashes.keys().filter(|path| is_library(path));
        (self.hashes.len(), libraries.count())
    }
}

/// Size limit for programs and libraries, in bytes.
const LARGEST_PROGRAM: u64 = 1 << 32;

type Hashes = BTreeMap<(PathBuf, Stamp), Arc<OnceLock<Option<String>>>>;

/// Returns the SHA-256 of a file. An unchanged file is read once, since several codes share libraries.
fn hash_of(path: &Path, stamp: Stamp) -> Option<String> {
    static KNOWN: Mutex<Hashes> = Mutex::new(BTreeMap::new());
    let hash = {
        let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        Arc::clone(known.entry((path.to_owned(), stamp)).or_default())
    };
    let read = || {
        let content = read_bounded(path, LARGEST_PROGRAM, Links::Followed).ok()?;
        Some(sha256_hex(&content))
    };
    hash.get_or_init(read).clone()
}

/// The files found so far, and the loaders and packages that lead to more.
#[derive(Default)]
struct Search {
    files: BTreeSet<PathBuf>,
    libraries: BTreeSet<PathBuf>,
    /// Programs, each with the loader that it names.
    loaders: Vec<(PathBuf, PathBuf)>,
    /// The packages beside the Python interpreters that were found.
    packages: Packages,
}

impl Search {
    /// Adds a program or script with everything that it names.
    fn add_program(&mut self, path: &Path) {
        if !path.is_file() || !self.files.insert(path.to_owned()) {
            return;
        }
        self.packages.add_beside(path);
        let content = beginning(path);
        if let Some(line) = content.strip_prefix(b"#!") {
            self.add_script(path, line, &String::from_utf8_lossy(&content));
        } else if let Some(loader) = loader_in(&content) {
            self.loaders.push((path.to_owned(), loader));
        }
    }

    /// Adds the interpreter in the first `line` of the script at `path`, and what its `text` names.
    fn add_script(&mut self, path: &Path, line: &[u8], text: &str) {
        let line = line.split(|byte| *byte == b'\n').next().unwrap_or_default();
        let line = String::from_utf8_lossy(line).into_owned();
        let mut words = line.split_whitespace();
        let Some(interpreter) = words.next() else {
            return;
        };
        self.add_program(Path::new(interpreter));
        let mut name = file_name(interpreter);
        if interpreter.ends_with("/env") {
            let real = words.find(|word| !word.starts_with('-') && !word.contains('='));
            name = real.map_or_else(String::new, file_name);
            if let Some(real) = real.and_then(in_search_path) {
                self.add_program(&real);
            }
        }
        if name.starts_with("python") {
            return self.add_python(path, text);
        }
        self.add_shell(path, text);
        // Where the interpreter's path is too long for the first line, a shell hands the script on to it.
        self.add_imports(Path::new(""), text);
    }

    /// Adds programs that a shell script names by path, or by a name in the search path or beside it.
    fn add_shell(&mut self, script: &Path, text: &str) {
        for word in words(text) {
            self.add_named(script, word);
            if !word.contains('/')
                && let Some(program) = in_search_path(word)
            {
                self.add_program(&program);
            }
        }
    }

    /// Adds the file that a `word` of a script names by an absolute path, or by its name in the directory of the
    /// script.
    fn add_named(&mut self, script: &Path, word: &str) {
        let path = Path::new(word);
        let beside = script.parent().map(|parent| parent.join(file_name(word)));
        let places = [path.is_absolute().then(|| path.to_owned()), beside];
        for place in places.into_iter().flatten() {
            if place.is_file() && (is_executable(&place) || is_source(&place)) {
                self.add_file(&place);
            }
        }
    }

    fn add_file(&mut self, path: &Path) {
        match is_library(path) {
            true => _ = self.libraries.insert(path.to_owned()),
            false => self.add_program(path),
        }
    }

    /// Adds files and directories of modules that a Python script or module names by path, and the modules that it
    /// imports.
    fn add_python(&mut self, script: &Path, text: &str) {
        for word in words(text).filter(|word| word.starts_with('/')) {
            self.add_named(script, word);
            if is_module_directory(Path::new(word)) {
                self.add_modules(Path::new(word));
            }
        }
        self.add_imports(script.parent().unwrap_or(Path::new("")), text);
    }

    /// Adds modules that a Python `text` imports from `directory`, unless that is empty, and from the packages of its
    /// interpreter.
    fn add_imports(&mut self, directory: &Path, text: &str) {
        let own = (directory != Path::new("")).then(|| directory.to_owned());
        let places: Vec<PathBuf> = own.into_iter().chain(self.packages.places()).collect();
        if places.is_empty() {
            return;
        }
        let imports = text
            .lines()
            .map(str::trim_start)
            .filter(|line| line.starts_with("import ") || line.starts_with("from "));
        for word in imports.flat_map(words) {
            let name = word.trim_start_matches('.').split('.').next();
            let Some(name) = name.filter(|name| !name.is_empty()) else {
                continue;
            };
            for place in &places {
                self.add_module(&place.join(format!("{name}.py")));
                let package = place.join(name);
                if package.join("__init__.py").is_file() {
                    self.add_modules(&package);
                }
            }
        }
    }

    fn add_module(&mut self, path: &Path) {
        if path.is_file() && self.files.insert(path.to_owned()) {
            let text = beginning(path);
            self.add_python(path, &String::from_utf8_lossy(&text));
        }
    }

    /// Adds all modules, extensions and programs below `directory`, unless there are too many.
    fn add_modules(&mut self, directory: &Path) {
        let mut found = Vec::new();
        if modules_below(directory, MOST_LEVELS, &mut found) {
            for path in found {
                match is_module(&path) {
                    true => _ = self.files.insert(path),
                    false => self.add_file(&path),
                }
            }
        }
    }
}

/// Collects modules, extensions and programs down to `levels` below `directory`; returns whether there are few
/// enough.
fn modules_below(directory: &Path, levels: usize, found: &mut Vec<PathBuf>) -> bool {
    let entries = std::fs::read_dir(directory).into_iter().flatten().flatten();
    for entry in entries {
        let path = entry.path();
        let is_directory = entry.file_type().is_ok_and(|kind| kind.is_dir());
        if is_directory && levels > 0 {
            if !modules_below(&path, levels - 1, found) {
                return false;
            }
        } else if path.is_file() && (is_source(&path) || is_executable(&path)) {
            found.push(path);
        }
        if found.len() > MOST_MODULES {
            return false;
        }
    }
    true
}

/// Whether a module or a package lies in `directory` itself.
fn is_module_directory(directory: &Path) -> bool {
    let entries = std::fs::read_dir(directory).into_iter().flatten().flatten();
    let mut paths = entries.map(|entry| entry.path());
    paths.any(|path| {
        path.extension().is_some_and(|end| end == "py") || path.join("__init__.py").is_file()
    })
}

/// Returns the distinct words of a script without its punctuation.
fn words(text: &str) -> impl Iterator<Item = &str> {
    let words =
        text.split(|char: char| char.is_whitespace() || "\"'`;(){}[]=,:&|<>$".contains(char));
    let words: BTreeSet<&str> = words.filter(|word| !word.is_empty()).collect();
    words.into_iter()
}

fn file_name(path: &str) -> String {
    let name = Path::new(path).file_name().unwrap_or_default();
    name.to_string_lossy().into_owned()
}

fn is_executable(path: &Path) -> bool {
    std::fs::metadata(path).is_ok_and(|data| data.mode() & 0o111 != 0)
}

fn is_library(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    name.ends_with(".so") || name.contains(".so.")
}

fn is_module(path: &Path) -> bool {
    path.extension().is_some_and(|end| end == "py")
}

/// Whether scripts may load or execute the file: a Python module, a shell script or a library.
fn is_source(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    name.ends_with(".py") || name.ends_with(".sh") || is_library(path)
}

/// Reads the content of a script, or the head of a program.
fn beginning(path: &Path) -> Vec<u8> {
    read_beginning(path, LONGEST_SCRIPT).unwrap_or_default()
}

/// Returns the loader that a 64-bit little-endian ELF program names (PT_INTERP of its program headers).
fn loader_in(program: &[u8]) -> Option<PathBuf> {
    const INTERPRETER: u64 = 3;
    if !program.starts_with(b"\x7fELF\x02\x01") {
        return None;
    }
    let number = |offset: usize, length: usize| -> Option<u64> {
        let bytes = program.get(offset..offset.checked_add(length)?)?;
        Some(
            bytes
                .iter()
                .rev()
                .fold(0, |number, byte| number << 8 | u64::from(*byte)),
        )
    };
    let (table, size, count) = (number(0x20, 8)?, number(0x36, 2)?, number(0x38, 2)?);
    let header = (0..count).find_map(|index| {
        let header = usize::try_from(table.checked_add(index * size)?).ok()?;
        (number(header, 4)? == INTERPRETER).then_some(header)
    })?;
    let start = usize::try_from(number(header + 0x08, 8)?).ok()?;
    let length = usize::try_from(number(header + 0x20, 8)?).ok()?;
    let name = program.get(start..start.checked_add(length)?)?;
    let name = String::from_utf8_lossy(name);
    Some(PathBuf::from(name.trim_end_matches('\0')))
}

/// Lists the libraries that `loader` maps for `program` and for `extensions` that are loaded into it.
fn mapped_by_loader(
    loader: &Path,
    program: &Path,
    extensions: &BTreeSet<PathBuf>,
    environment: &Environment,
) -> Vec<PathBuf> {
    let mut command = vec![loader.as_os_str().to_owned()];
    if !extensions.is_empty() {
        let names: Vec<&str> = extensions.iter().filter_map(|path| path.to_str()).collect();
        command.extend(["--preload".into(), OsString::from(names.join(":"))]);
    }
    command.extend(["--list".into(), program.as_os_str().to_owned()]);
    let list = answer(&command, environment, LONGEST_START);
    let list = list.ok().flatten().unwrap_or_default();
    let paths = list.lines().filter_map(|line| {
        let line = line.split(" => ").last()?.trim();
        let path = line.split(" (0x").next()?;
        path.starts_with('/').then(|| PathBuf::from(path))
    });
    paths.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;
    use std::os::unix::fs::PermissionsExt;

    fn write(path: &Path, content: &str, mode: u32) {
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, content).unwrap();
        fs::set_permissions(path, fs::Permissions::from_mode(mode)).unwrap();
    }

    /// Creates a virtual environment with a package whose module starts a program beside it.
    fn environment() -> tempfile::TempDir {
        let place = tempfile::tempdir().unwrap();
        let at = |name: &str| place.path().join(name);
        write(&at("pyvenv.cfg"), "", 0o644);
        write(&at("bin/python3"), "#!/bin/sh\n", 0o755);
        let package = at("lib/python3.1/site-packages/mydem");
        for (file, mode) in [
            ("__init__.py", 0o644),
            ("start.py", 0o644),
            ("core", 0o755),
            ("data.txt", 0o644),
        ] {
            write(&package.join(file), file, mode);
        }
        place
    }

    /// Names of the files of an environment, in the order of their paths.
    fn names(covered: &CoveredFiles, place: &Path) -> Vec<String> {
        let paths = covered.hashes.keys();
        let own = paths.filter(|path| path.starts_with(place));
        own.map(|path| file_name(&path.to_string_lossy())).collect()
    }

    /// The script is as pip writes it: as usual, and where the interpreter's path is too long for the first line.
    #[test]
    fn a_script_of_a_virtual_environment_is_covered_with_the_package_that_it_starts() {
        let place = environment();
        let python = place.path().join("bin/python3");
        for first in [
            format!("#!{}\n", python.display()),
            format!(
                "#!/bin/sh\n'''exec' \"{}\" \"$0\" \"$@\"\n' '''\n",
                python.display()
            ),
        ] {
            let script = place.path().join("bin/mydem");
            let text = format!("{first}import sys\nfrom mydem.start import main\n");
            write(&script, &text, 0o755);
            let covered = CoveredFiles::of(&script, &[], &Environment::new(), []);
            let expected = ["mydem", "python3", "__init__.py", "core", "start.py"];
            assert_eq!(names(&covered, place.path()), expected, "{first}");
        }
    }

    #[test]
    fn an_interpreter_is_covered_with_the_packages_that_its_decks_import() {
        let place = environment();
        let python = place.path().join("bin/python3");
        let of = |deck: &str| {
            let covered = CoveredFiles::of(&python, &[], &Environment::new(), [deck.as_bytes()]);
            names(&covered, place.path())
        };
        assert_eq!(of("import json\n"), ["python3"]);
        let expected = ["python3", "__init__.py", "core", "start.py"];
        assert_eq!(of("import json\nimport mydem as dem\n"), expected);
    }
}
