//! A compressed archive of named files with their digests, readable by `tar xzf` and `sha256sum --check`.

use crate::files::{CHECKSUMS, FileError, check, checksums};
use flate2::Compression;
use flate2::read::GzDecoder;
use flate2::write::GzEncoder;
use std::collections::BTreeMap;
use std::io::{Read, Write};
use std::path::Path;

/// Size limit for the content of an archive, in bytes: fifty times that of the recorded ones.
const MAX_CONTENT: u64 = 1 << 26;

/// The files of an archive by their names.
pub(super) type Members = BTreeMap<String, Vec<u8>>;

/// Packs `members` into an archive. Equal members give equal bytes.
pub(super) fn pack(members: &Members) -> Vec<u8> {
    write(members).expect("an archive is written to memory")
}

fn write(members: &Members) -> std::io::Result<Vec<u8>> {
    let mut archive = tar::Builder::new(GzEncoder::new(Vec::new(), Compression::best()));
    append(&mut archive, CHECKSUMS, checksums(members).as_bytes())?;
    for (name, content) in members {
        append(&mut archive, name, content)?;
    }
    archive.into_inner()?.finish()
}

fn append(
    archive: &mut tar::Builder<impl Write>,
    name: &str,
    content: &[u8],
) -> std::io::Result<()> {
    let mut header = tar::Header::new_ustar();
    header.set_size(content.len() as u64);
    header.set_mode(0o644);
    archive.append_data(&mut header, name, content)
}

/// Unpacks the files of the archive `packed`, which was read from `path`.
///
/// # Errors
/// If anything in it is damaged; the error names the archive and, where it is known, the file in it.
pub(super) fn unpack(packed: &[u8], path: &Path) -> Result<Members, FileError> {
    let mut members = read(packed).map_err(FileError::reading(path))?;
    let sums = members.remove(CHECKSUMS).unwrap_or_default();
    let sums = String::from_utf8_lossy(&sums);
    for (name, content) in &members {
        check(&sums, path, name, content)?;
    }
    let listed = sums.lines().filter_map(|line| line.split_once("  "));
    for (_, name) in listed {
        if !members.contains_key(name) {
            let missing = std::io::Error::other("the archive ends before it");
            return Err(FileError::reading(&path.join(name))(missing));
        }
    }
    Ok(members)
}

/// Whether `packed` begins like an archive of this program: with the list of digests.
pub(super) fn is_archive(packed: &[u8]) -> bool {
    let mut archive = tar::Archive::new(GzDecoder::new(packed));
    let entries = archive.entries().ok();
    let first = entries.and_then(|mut entries| entries.next()?.ok());
    first.is_some_and(|entry| *entry.path_bytes() == *CHECKSUMS.as_bytes())
}

fn read(packed: &[u8]) -> std::io::Result<Members> {
    let mut content = Vec::new();
    let mut decoder = GzDecoder::new(packed).take(MAX_CONTENT + 1);
    if decoder.read_to_end(&mut content)? as u64 > MAX_CONTENT {
        let message = format!("it holds more than {MAX_CONTENT} bytes");
        return Err(std::io::Error::other(message));
    }
    let mut archive = tar::Archive::new(content.as_slice());
    let mut members = Members::new();
    for entry in archive.entries()? {
        let mut entry = entry?;
        let name = String::from_utf8_lossy(&entry.path_bytes()).into_owned();
        let mut content = Vec::new();
        entry.read_to_end(&mut content)?;
        members.insert(name, content);
    }
    Ok(members)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn members() -> Members {
        let series = b"step,time\n0,0.0\n".repeat(20);
        let files = [("dt-0.025.csv", series), ("probe.json", b"{}\n".to_vec())];
        files
            .map(|(name, content)| (name.to_owned(), content))
            .into()
    }

    #[test]
    fn what_was_packed_comes_back_and_packs_to_the_same_bytes() {
        let packed = pack(&members());
        let unpacked = unpack(&packed, Path::new("x.tar.gz")).unwrap();
        assert_eq!(unpacked, members());
        assert_eq!(pack(&unpacked), packed);
    }

    #[test]
    fn an_archive_of_somebody_else_is_told_from_ours() {
        assert!(is_archive(&pack(&members())));
        let mut archive = tar::Builder::new(GzEncoder::new(Vec::new(), Compression::fast()));
        append(&mut archive, "lammps/src/main.cpp", b"int main").unwrap();
        let foreign = archive.into_inner().unwrap().finish().unwrap();
        for other in [foreign.as_slice(), b"", b"Makefile"] {
            assert!(!is_archive(other));
        }
    }

    #[test]
    fn an_archive_that_is_cut_or_changed_anywhere_gives_nothing_else() {
        let packed = pack(&members());
        let path = Path::new("x.tar.gz");
        for length in 0..packed.len() {
            assert!(unpack(&packed[..length], path).is_err(), "{length}");
            let mut changed = packed.clone();
            changed[length] ^= 1;
            let changed = unpack(&changed, path);
            assert!(
                changed.is_err() || changed.unwrap() == members(),
                "{length}"
            );
        }
    }

    #[test]
    fn a_file_that_is_not_the_listed_one_is_named() {
        let mut archive = tar::Builder::new(GzEncoder::new(Vec::new(), Compression::fast()));
        let listed = checksums([("a.csv", &b"1".to_vec())]);
        append(&mut archive, CHECKSUMS, listed.as_bytes()).unwrap();
        append(&mut archive, "a.csv", b"2").unwrap();
        let packed = archive.into_inner().unwrap().finish().unwrap();
        let message = unpack(&packed, Path::new("x.tar.gz"))
            .unwrap_err()
            .to_string();
        assert!(
            message.starts_with("x.tar.gz/a.csv: its SHA-256 is"),
            "{message}"
        );
    }
}
