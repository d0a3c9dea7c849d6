//! The documents describe the project as it is.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Every path in backquotes that begins with a folder of the project.
fn paths_in(document: &str) -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(root.join(document)).expect("the document is there");
    let folders = [
        "src/",
        "crates/",
        "tests/",
        "benches/",
        "reference/",
        "liggghts_inputs/",
        "yade_scripts/",
        "lammps_inputs/",
        "docs/",
    ];
    text.split('`')
        .skip(1)
        .step_by(2)
        .filter(|code| folders.iter().any(|folder| code.starts_with(folder)))
        .map(str::to_owned)
        .collect()
}

#[test]
fn every_path_that_the_documents_name_exists() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let architecture = paths_in("ARCHITECTURE.md");
    assert!(
        architecture.len() > 20,
        "the paths are found: {architecture:?}"
    );
    let others = ["CONTRIBUTING.md", "README.md"]
        .into_iter()
        .flat_map(paths_in);
    for path in architecture.into_iter().chain(others) {
        assert!(root.join(&path).exists(), "{path} does not exist");
    }
}

/// The sources of the root package and of every crate.
fn sources() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let crates = std::fs::read_dir(root.join("crates"))
        .expect("crates")
        .flatten();
    let crates = crates.map(|entry| entry.path().join("src"));
    std::iter::once(root.join("src")).chain(crates).collect()
}

#[test]
fn every_folder_of_the_sources_is_told_of() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let told = paths_in("ARCHITECTURE.md");
    for sources in sources() {
        let in_project = sources.strip_prefix(root).expect("it is in the project");
        let mut folders: Vec<String> = std::fs::read_dir(&sources)
            .expect("sources")
            .flatten()
            .filter(|entry| entry.path().is_dir())
            .map(|entry| entry.file_name().to_string_lossy().into_owned())
            .map(|name| format!("{}/{name}/", in_project.display()))
            .collect();
        if folders.is_empty() {
            folders.push(format!("{}/", in_project.display()));
        }
        for folder in folders {
            assert!(
                told.contains(&folder),
                "ARCHITECTURE.md does not mention {folder}"
            );
        }
    }
}

/// Each folder uses only those before it in its crate; between crates, the compiler sees to that.
#[test]
fn no_folder_points_back() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for (sources, order) in [
        (
            "crates/theory/src",
            &["model", "theory", "experiment"] as &[&str],
        ),
        ("crates/dem/src", &["model", "series", "dem"]),
        ("crates/harness/src", &["files", "code", "runs", "study"]),
        ("crates/paper/src", &["published", "reproduction", "claims"]),
    ] {
        for (position, folder) in order.iter().enumerate() {
            for file in rust_files(&root.join(sources).join(folder)) {
                let text = std::fs::read_to_string(&file).expect("a source file");
                for later in &order[position + 1..] {
                    let forbidden = format!("crate::{later}");
                    assert!(
                        !text.contains(&forbidden),
                        "{} uses {forbidden}",
                        file.display()
                    );
                }
            }
        }
    }
}

/// Ways to open or to copy a file: one in the place of which somebody has put a named pipe would never be opened, and
/// one that grows for ever never read to its end.
const WAYS_TO_OPEN: [&str; 9] = [
    "fs::read(",
    "read_to_string",
    "File::open",
    "File::create",
    "OpenOptions",
    ".open(",
    "fs::write(",
    "fs::copy(",
    "from_path(",
];

/// Sources that no program contains.
const FOR_BUILD_SCRIPTS: &str = "crates/digest/src";

/// The lines of `text` outside comments and tests in which a file is opened.
fn lines_that_open(text: &str) -> Vec<&str> {
    let code = text.split("#[cfg(test)]").next().unwrap_or(text);
    let code = code.split("#[cfg(all(test").next().unwrap_or(code);
    let lines = code
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    let opens = |line: &&str| WAYS_TO_OPEN.iter().any(|way| line.contains(way));
    lines.filter(opens).collect()
}

#[test]
fn files_are_opened_in_one_room_alone() {
    let files = Path::new(env!("CARGO_MANIFEST_DIR")).join("crates/harness/src/files");
    let mut found = 0;
    let is_of_programs = |folder: &PathBuf| !folder.ends_with(FOR_BUILD_SCRIPTS);
    let folders = sources().into_iter().filter(is_of_programs);
    for file in folders.flat_map(|folder| rust_files(&folder)) {
        let text = std::fs::read_to_string(&file).expect("a source file");
        let mut lines = lines_that_open(&text);
        if file.starts_with(&files) {
            found += lines.len();
            continue;
        }
        // The files by which the kernel is told who somebody is: they take what is written at once.
        lines.retain(|line| !line.contains("fs::write(\"/proc/self/"));
        assert!(lines.is_empty(), "{}: {lines:#?}", file.display());
    }
    assert!(found >= 5, "files are opened somewhere");
}

#[test]
fn a_file_that_is_opened_elsewhere_would_be_noticed() {
    let text = "let a = std::fs::read(path)?;\n// fs::read(path)\nlet f = File::open(path);\n\
                options.write(true).open(path)\n#[cfg(test)]\nfs::read(path)";
    assert_eq!(lines_that_open(text).len(), 3);
}

/// Files of one room may use one another, but not in a circle.
#[test]
fn no_files_of_a_room_import_one_another_in_a_circle() {
    let text_of = |file: &PathBuf| std::fs::read_to_string(file).expect("a source file");
    let files: BTreeMap<String, String> = sources()
        .iter()
        .flat_map(|sources| {
            rust_files(sources)
                .into_iter()
                .map(move |file| (sources, file))
        })
        .map(|(sources, file)| {
            let module = module_of(file.strip_prefix(sources).expect("a file below src"));
            (module, text_of(&file))
        })
        .filter(|(module, _)| module.contains("::"))
        .collect();
    let imports: BTreeMap<&str, Vec<&str>> = files
        .iter()
        .map(|(module, text)| (module.as_str(), imported(module, text, &files)))
        .collect();
    assert!(
        imports.values().flatten().count() > 200,
        "imports are found"
    );
    for start in imports.keys() {
        let mut reached: BTreeSet<&str> = BTreeSet::new();
        let mut open = imports[start].clone();
        while let Some(next) = open.pop() {
            assert_ne!(next, *start, "{start} imports itself by way of {reached:?}");
            if reached.insert(next) {
                open.extend(&imports[next]);
            }
        }
    }
}

/// `code::native::lanes` for code/native/lanes.rs; a mod.rs, which collects what is below it, counts as none.
fn module_of(file: &Path) -> String {
    let parts: Vec<&str> = file.iter().filter_map(|part| part.to_str()).collect();
    match parts.join("::").strip_suffix(".rs") {
        Some(module) if !module.ends_with("::mod") => module.to_owned(),
        _ => String::new(),
    }
}

/// The modules of the same room that the file of `module` names by path, in code outside its tests.
fn imported<'a>(module: &str, text: &str, files: &'a BTreeMap<String, String>) -> Vec<&'a str> {
    let code = text.split("#[cfg(test)]").next().unwrap_or(text);
    let code: String = code
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"))
        .collect();
    let room = module.split("::").next().unwrap_or_default();
    let parent = module.rsplit_once("::").map_or("", |(parent, _)| parent);
    let names = |other: &str| {
        let beside = other
            .strip_prefix(parent)
            .and_then(|rest| rest.strip_prefix("::"));
        let beside = beside.is_some_and(|name| code.contains(&format!("super::{name}::")));
        beside || code.contains(&format!("crate::{other}::"))
    };
    let others = files.keys().map(String::as_str);
    let others = others.filter(|other| *other != module && other.split("::").next() == Some(room));
    others.filter(|other| names(other)).collect()
}

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder)
        .expect("a folder of sources")
        .flatten();
    entries
        .flat_map(|entry| {
            let path = entry.path();
            if path.is_dir() {
                rust_files(&path)
            } else {
                vec![path]
            }
        })
        .filter(|path| path.extension().is_some_and(|extension| extension == "rs"))
        .collect()
}
