//! Folders with a manifest: those that are part of this program, and those on disk.

use crate::files::{Links, read_bounded};
use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};
use toml::Table;

/// The file that describes the codes of a folder.
pub(super) const MANIFEST: &str = "code.toml";
/// Size limit for files of a folder, in bytes; a mesh may be long.
const LARGEST_FILE: u64 = 1 << 26;

/// A folder that is part of this program: its name in the project, and its files.
pub(super) type BuiltIn = (&'static str, &'static [(&'static str, &'static str)]);

/// Embeds the files of a folder, named from the top of the project. Links at the top of the crate lead to them.
macro_rules! folder {
    ($folder:literal, $($file:literal)+) => {
        ($folder, &[$(($file, include_str!(concat!("../../", $folder, "/", $file)))),+])
    };
}

/// The folder of the native code; its only file is the manifest.
const NATIVE: BuiltIn = (
    "crates/harness/src/code/native",
    &[("code.toml", include_str!("native/code.toml"))],
);

/// The only place that names the built-in folders. Their order is that of tables and figures.
pub(super) static BUILT_IN: [BuiltIn; 7] = [
    NATIVE,
    folder!("liggghts_inputs", "code.toml" "stack.in" "side_walls.in" "probe.in" "pyramid.in" "contacts.in"
        "top_wall.in" "wall.stl" "side_wall.stl" "spheres.in" "spheres_probe.in"),
    folder!("yade_scripts", "code.toml" "stack.py" "side_walls.py" "probe.py" "contacts.py" "law.py" "cases.py"
        "spheres.py" "spheres_probe.py" "spheres_scene.py"),
    folder!("lammps_inputs", "code.toml" "stack.in" "probe.in" "pyramid.in" "contacts.in" "top_wall.in" "spheres.in"
        "spheres_probe.in" "spheres_contacts.in"),
    folder!("liggghts_inputs/hertz", "code.toml" "contacts.in" "top_wall.in" "drive.in"),
    folder!("yade_scripts/hertz", "code.toml" "law.py" "probe.py"),
    folder!("lammps_inputs/hertz", "code.toml" "stack.in" "contacts.in" "top_wall.in" "drive.in" "spheres_contacts.in"),
];

/// A folder with a manifest.
#[derive(Debug, Clone)]
pub(super) enum Folder {
    /// Part of this program.
    BuiltIn(BuiltIn),
    /// On disk.
    Disk(PathBuf),
}

impl Folder {
    /// The built-in folder that has a code of this `name`, other than the native one.
    pub fn of_built_in(name: &str) -> Option<Self> {
        let mut external = BUILT_IN.iter().skip(1);
        let folder = external.find(|folder| names_in(folder).contains(&name.to_owned()))?;
        Some(Self::BuiltIn(*folder))
    }

    /// The names of all codes that are part of this program, other than the native one.
    pub fn built_in_names() -> Vec<String> {
        BUILT_IN.iter().skip(1).flat_map(names_in).collect()
    }

    /// Returns the folder at `path`, which may be relative to this one; `None` for a built-in folder.
    pub fn at(&self, path: &str) -> Option<Self> {
        match self {
            Self::BuiltIn(_) => None,
            Self::Disk(own) => Some(Self::Disk(own.join(path))),
        }
    }

    /// Its path; for a built-in one, the path in the project.
    pub fn path(&self) -> &Path {
        match self {
            Self::BuiltIn((path, _)) => Path::new(path),
            Self::Disk(path) => path,
        }
    }

    /// The content of one of its files.
    ///
    /// # Errors
    /// Any error of the system; `NotFound` if a built-in folder has no such file.
    pub fn read(&self, name: &str) -> std::io::Result<Vec<u8>> {
        match self {
            Self::BuiltIn((_, files)) => {
                let found = files.iter().find(|(file, _)| *file == name);
                let absent = || Error::new(ErrorKind::NotFound, "it is not part of this program");
                Ok(found.ok_or_else(absent)?.1.as_bytes().to_vec())
            }
            Self::Disk(path) => read_bounded(&path.join(name), LARGEST_FILE, Links::Followed),
        }
    }
}

/// Returns the names of the codes in a built-in folder: those of its variants, or its own if it has none.
fn names_in((_, files): &BuiltIn) -> Vec<String> {
    let manifest = files.iter().find(|(name, _)| *name == MANIFEST);
    let table: Table = manifest
        .and_then(|(_, text)| text.parse().ok())
        .unwrap_or_default();
    match table.get("variants").and_then(toml::Value::as_table) {
        Some(variants) => variants.keys().cloned().collect(),
        None => table["name"]
            .as_str()
            .map(str::to_owned)
            .into_iter()
            .collect(),
    }
}
