//! The recorded runs inside the program: those of the checkout it was built from.

/// Embeds the files of every code under their names.
macro_rules! files_of {
    ($($code:literal),*) => {
        &[$(
            (concat!($code, ".csv"), include_bytes!(concat!("../../../reference/recorded/", $code, ".csv"))),
            (concat!($code, ".tar.gz"), include_bytes!(concat!("../../../reference/recorded/", $code, ".tar.gz"))),
        )*]
    };
}

const FILES: &[(&str, &[u8])] = files_of![
    "lammps",
    "lammps-hertz",
    "lammps-mindlin",
    "lammps-mindlin-force",
    "lammps-mindlin-rescale",
    "lammps-mindlin-rescale-force",
    "liggghts",
    "liggghts-hertz",
    "yade",
    "yade-facet",
    "yade-mindlin",
    "yade-mindlin-facet",
    "yade-mindlin-wall",
    "yade-wall"
];

/// Returns the embedded file `name`.
pub(super) fn file(name: &str) -> Option<&'static [u8]> {
    let mut files = FILES.iter();
    let found = files.find(|(own, _)| *own == name);
    found.map(|(_, content)| *content)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::code::Code;
    use std::path::Path;

    #[test]
    fn the_files_of_the_checkout_are_inside_and_every_external_code_has_its_two() {
        let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference/recorded");
        let entries = std::fs::read_dir(directory).unwrap().flatten();
        let mut found: Vec<String> = entries
            .map(|entry| entry.file_name().to_string_lossy().into_owned())
            .collect();
        found.sort();
        let mut inside: Vec<&str> = FILES.iter().map(|(name, _)| *name).collect();
        inside.sort_unstable();
        assert_eq!(found, inside);
        let codes = Code::built_in().into_iter();
        for code in codes.filter(|code| !code.accepts_any_convention()) {
            for ending in ["csv", "tar.gz"] {
                let name = format!("{code}.{ending}");
                assert!(file(&name).is_some(), "{name}");
            }
        }
    }
}
