//! Reads regular files alone, without ever waiting, and no more than a given number of bytes.
//!
//! A named pipe without a writer, a terminal or a device would otherwise block the program for ever. No other place
//! in the program opens a file to read it (`tests/documents/architecture.rs`).

use super::FileError;
use nix::fcntl::OFlag;
use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{Error, ErrorKind, Read, Seek, SeekFrom};
use std::os::unix::fs::{FileTypeExt, OpenOptionsExt};
use std::path::Path;

/// Size limit for system files such as `/proc/cpuinfo`, in bytes.
const LARGEST_SYSTEM_FILE: u64 = 1 << 24;

/// Whether the last part of a path may be a symbolic link.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Links {
    /// For files that a user names.
    Followed,
    /// For files that only this program or a code may have written.
    Refused,
}

/// Reads the regular file at `path` if it has at most `limit` bytes.
///
/// # Errors
/// Any error of the system; [`ErrorKind::InvalidInput`] if the file is not a regular one or is too long.
pub fn read_bounded(path: &Path, limit: u64, links: Links) -> std::io::Result<Vec<u8>> {
    let file = open_regular(path, links, OpenOptions::new().read(true))?;
    if file.metadata()?.len() > limit {
        return Err(too_long(limit));
    }
    let mut content = Vec::new();
    // The file may grow meanwhile, and system files report no length.
    file.take(limit + 1).read_to_end(&mut content)?;
    if content.len() as u64 > limit {
        return Err(too_long(limit));
    }
    Ok(content)
}

/// Reads the first `count` bytes of the regular file at `path`.
pub(crate) fn read_beginning(path: &Path, count: u64) -> std::io::Result<Vec<u8>> {
    let file = open_regular(path, Links::Followed, OpenOptions::new().read(true))?;
    let mut content = Vec::new();
    file.take(count).read_to_end(&mut content)?;
    Ok(content)
}

/// Reads the last `count` bytes of the regular file at `path`, which must not be a symbolic link.
pub(crate) fn read_end(path: &Path, count: u64) -> std::io::Result<Vec<u8>> {
    let mut file = open_regular(path, Links::Refused, OpenOptions::new().read(true))?;
    let start = file.metadata()?.len().saturating_sub(count);
    file.seek(SeekFrom::Start(start))?;
    let mut content = Vec::new();
    file.take(count).read_to_end(&mut content)?;
    Ok(content)
}

/// Reads a system file such as `/proc/cpuinfo` as text; bytes that are not text are replaced.
pub fn system_text(path: impl AsRef<Path>) -> Option<String> {
    let content = read_bounded(path.as_ref(), LARGEST_SYSTEM_FILE, Links::Followed).ok()?;
    Some(String::from_utf8_lossy(&content).into_owned())
}

/// Opens the regular file at `path` with `options`, without waiting for a process at its other end.
///
/// # Errors
/// Any error of the system; [`ErrorKind::InvalidInput`] for anything but a regular file.
pub(crate) fn open_regular(
    path: &Path,
    links: Links,
    options: &mut OpenOptions,
) -> std::io::Result<File> {
    let (found, flags) = match links {
        Links::Followed => (fs::metadata(path), OFlag::empty()),
        Links::Refused => (fs::symlink_metadata(path), OFlag::O_NOFOLLOW),
    };
    // Checked before opening as well, because opening alone can make a device do something.
    match found {
        Ok(found) => accept_regular(&found)?,
        // The file is missing; `options` may create it.
        Err(error) if error.kind() == ErrorKind::NotFound => {}
        Err(error) => return Err(error),
    }
    let flags = flags | OFlag::O_NONBLOCK | OFlag::O_NOCTTY;
    let file = options.custom_flags(flags.bits()).open(path)?;
    accept_regular(&file.metadata()?)?;
    Ok(file)
}

/// Opens the directory at `path`, to lock or to sync it.
pub(crate) fn open_directory(path: &Path) -> std::io::Result<File> {
    let mut options = OpenOptions::new();
    let options = options.read(true);
    let flags = OFlag::O_DIRECTORY | OFlag::O_NONBLOCK;
    options.custom_flags(flags.bits()).open(path)
}

/// Refuses a `path`, relative to `root`, that leads through a symbolic link below `root`: what is read or written there
/// would lie in somebody else's directory. What does not exist is no link.
pub(crate) fn refuse_linked(root: &Path, path: &Path) -> Result<(), FileError> {
    let above: Vec<&Path> = path.ancestors().skip(1).collect();
    for part in above.into_iter().rev() {
        let directory = root.join(part);
        let found = fs::symlink_metadata(&directory);
        if !part.as_os_str().is_empty() && found.is_ok_and(|found| found.is_symlink()) {
            let message =
                "it is a symbolic link; accepted is a directory that tristack plan has made";
            return Err(FileError::content(&directory, message));
        }
    }
    Ok(())
}

/// Refuses anything but a regular file.
pub(crate) fn accept_regular(found: &Metadata) -> std::io::Result<()> {
    if found.is_file() {
        return Ok(());
    }
    let message = format!("it is {}; accepted is a regular file", kind(found));
    Err(Error::new(ErrorKind::InvalidInput, message))
}

/// The kind of a file in words.
pub(crate) fn kind(found: &Metadata) -> &'static str {
    let kind = found.file_type();
    match () {
        () if kind.is_symlink() => "a symbolic link",
        () if kind.is_dir() => "a directory",
        () if kind.is_fifo() => "a named pipe",
        () if kind.is_socket() => "a socket",
        () if kind.is_file() => "a regular file",
        () => "a device",
    }
}

fn too_long(limit: u64) -> Error {
    let message = format!("it has more than {limit} bytes, the most that is read");
    Error::new(ErrorKind::InvalidInput, message)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nix::sys::stat::Mode;
    use nix::unistd::mkfifo;
    use std::path::PathBuf;

    /// Creates a regular file, a named pipe, a link to the file and a directory.
    fn zoo(root: &Path) -> [PathBuf; 4] {
        let [file, pipe, link, directory] =
            ["file", "pipe", "link", "directory"].map(|name| root.join(name));
        fs::write(&file, "content").unwrap();
        mkfifo(&pipe, Mode::S_IRWXU).unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        fs::create_dir(&directory).unwrap();
        [file, pipe, link, directory]
    }

    #[test]
    fn only_regular_files_are_read_and_nothing_is_waited_for() {
        let root = tempfile::tempdir().unwrap();
        let [file, pipe, link, directory] = zoo(root.path());
        let read =
            |path: &Path, links| read_bounded(path, 7, links).map_err(|error| error.to_string());
        assert_eq!(read(&file, Links::Refused).unwrap(), b"content");
        assert_eq!(read(&link, Links::Followed).unwrap(), b"content");
        for (path, links, kind) in [
            (&pipe, Links::Followed, "a named pipe"),
            (&pipe, Links::Refused, "a named pipe"),
            (&link, Links::Refused, "a symbolic link"),
            (&directory, Links::Followed, "a directory"),
            (&PathBuf::from("/dev/zero"), Links::Followed, "a device"),
        ] {
            let refusal = read(path, links).unwrap_err();
            assert_eq!(refusal, format!("it is {kind}; accepted is a regular file"));
        }
        let missing = read_bounded(&root.path().join("none"), 7, Links::Followed);
        assert_eq!(missing.unwrap_err().kind(), ErrorKind::NotFound);
    }

    #[test]
    fn a_file_that_is_too_long_is_refused_and_its_end_can_be_read() {
        let root = tempfile::tempdir().unwrap();
        let [file, pipe, ..] = zoo(root.path());
        let refusal = read_bounded(&file, 6, Links::Followed).unwrap_err();
        assert!(
            refusal.to_string().contains("more than 6 bytes"),
            "{refusal}"
        );
        assert_eq!(read_end(&file, 3).unwrap(), b"ent");
        assert_eq!(read_end(&file, 99).unwrap(), b"content");
        assert!(read_end(&pipe, 3).is_err());
    }

    #[test]
    fn files_of_the_system_have_no_length_and_are_read_all_the_same() {
        assert!(
            system_text("/proc/self/status")
                .unwrap()
                .starts_with("Name:")
        );
        assert_eq!(system_text("/dev/zero"), None);
    }
}
