//! The documents speak of the project as it is.

use std::path::Path;

/// Every path in backquotes that begins with a folder of the project.
fn paths_in(document: &str) -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(root.join(document)).expect("the document is there");
    let folders = [
        "src/",
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

#[test]
fn every_folder_of_the_sources_is_told_of() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let told = paths_in("ARCHITECTURE.md");
    for entry in std::fs::read_dir(root.join("src"))
        .expect("sources")
        .flatten()
    {
        if entry.path().is_dir() {
            let folder = format!("src/{}/", entry.file_name().to_string_lossy());
            assert!(
                told.contains(&folder),
                "ARCHITECTURE.md does not mention {folder}"
            );
        }
    }
}

/// Each folder uses only those before it.
#[test]
fn no_folder_points_back() {
    let order = [
        "stack",
        "theory",
        "experiment",
        "series",
        "archive",
        "dem",
        "code",
        "probe",
        "crosscheck",
        "bench",
        "reproduction",
        "claims",
        "report",
        "cli",
    ];
    for (position, folder) in order.iter().enumerate() {
        for file in rust_files(
            &Path::new(env!("CARGO_MANIFEST_DIR"))
                .join("src")
                .join(folder),
        ) {
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

fn rust_files(folder: &Path) -> Vec<std::path::PathBuf> {
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
