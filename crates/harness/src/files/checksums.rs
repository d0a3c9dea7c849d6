//! Digests beside the files of an entry, in the form that `sha256sum --check` reads.

use super::FileError;
use super::draft::{OWNER_WRITES, write_by_draft};
use super::read::{Links, read_bounded};
use crate::model::sha256_hex;
use std::ffi::OsStr;
use std::fmt::Display;
use std::io::ErrorKind;
use std::path::Path;

/// The file that holds the digests of all other files of an entry.
pub(crate) const CHECKSUMS: &str = "SHA256SUMS";

/// Size limit for sealed files in bytes: four times the longest result of a code.
const LARGEST: u64 = 1 << 30;

/// Returns the content of the file with the digests of `files`.
pub(crate) fn checksums<'a>(
    files: impl IntoIterator<Item = (impl Display, &'a Vec<u8>)>,
) -> String {
    let files = files.into_iter();
    let lines = files.map(|(name, content)| format!("{}  {name}\n", sha256_hex(content)));
    lines.collect()
}

/// Refuses `content` of the file `name` in `directory` if its digest is not the one in `checksums`.
pub(crate) fn check(
    checksums: &str,
    directory: &Path,
    name: &str,
    content: &[u8],
) -> Result<(), FileError> {
    let mut lines = checksums.lines().filter_map(|line| line.split_once("  "));
    let expected = lines.find(|(_, file)| *file == name);
    let found = sha256_hex(content);
    match expected {
        Some((expected, _)) if expected == found => Ok(()),
        _ => Err(FileError::Damaged {
            path: directory.join(name),
            found,
            expected: expected
                .map_or("no digest at all", |(digest, _)| digest)
                .to_owned(),
        }),
    }
}

/// Returns `content` after a line with its digest.
pub fn seal(content: &[u8]) -> Vec<u8> {
    let mut sealed = sha256_hex(content).into_bytes();
    sealed.push(b'\n');
    sealed.extend(content);
    sealed
}

/// Returns the content of `sealed`, which [`seal`] made; `path` names the file that it was read from.
///
/// # Errors
/// If a single bit has changed; the error names the file and both digests.
pub fn unseal<'a>(path: &Path, sealed: &'a [u8]) -> Result<&'a [u8], FileError> {
    let end = sealed.iter().position(|&byte| byte == b'\n');
    let (digest, content) = match end {
        Some(end) => (&sealed[..end], &sealed[end + 1..]),
        None => (&b"no digest at all"[..], sealed),
    };
    let found = sha256_hex(content);
    if found.as_bytes() == digest {
        return Ok(content);
    }
    Err(FileError::Damaged {
        path: path.to_owned(),
        found,
        expected: String::from_utf8_lossy(&digest[..digest.len().min(64)]).into_owned(),
    })
}

/// Writes the sealed `content` to `path` whole or not at all, through a draft in the directory `drafts`, which the
/// caller cleans up.
///
/// # Errors
/// If the file system refuses; `path` is then as it was.
pub(crate) fn write_sealed(drafts: &Path, path: &Path, content: &[u8]) -> Result<(), FileError> {
    let (prefix, sealed) = (OsStr::new("draft-"), seal(content));
    write_by_draft(drafts, prefix, path, &sealed, OWNER_WRITES)
}

/// Reads and unseals the file at `path`; returns `None` if there is none.
pub(crate) fn read_sealed(path: &Path) -> Result<Option<Vec<u8>>, FileError> {
    match read_bounded(path, LARGEST, Links::Refused) {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(FileError::reading(path)(error)),
        Ok(sealed) => unseal(path, &sealed).map(|content| Some(content.to_vec())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_sealed_comes_back() {
        let path = Path::new("probe.json");
        assert_eq!(unseal(path, &seal(b"{}\n")).unwrap(), b"{}\n");
        assert_eq!(unseal(path, &seal(b"")).unwrap(), b"");
    }

    #[test]
    fn a_flipped_bit_and_a_cut_are_noticed_wherever_they_are() {
        let sealed = seal(b"0.25\n");
        for bit in 0..8 * sealed.len() {
            let mut damaged = sealed.clone();
            damaged[bit / 8] ^= 1 << (bit % 8);
            assert!(unseal(Path::new("x"), &damaged).is_err(), "bit {bit}");
            assert!(unseal(Path::new("x"), &sealed[..bit / 8]).is_err());
        }
    }
}
