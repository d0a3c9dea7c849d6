//! Paths in messages.

use std::path::Path;

/// `path` in one line that a terminal shows as it is: control characters and bytes that are not text are
/// escaped, as in `new\\nline` and `caf\\xE9`.
pub fn shown(path: &Path) -> String {
    let mut text = String::new();
    for chunk in path.as_os_str().as_encoded_bytes().utf8_chunks() {
        for char in chunk.valid().chars() {
            if char.is_control() {
                text.extend(char.escape_default());
            } else {
                text.push(char);
            }
        }
        for byte in chunk.invalid() {
            text += &format!("\\x{byte:02X}");
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readable_paths_stay_as_they_are() {
        for path in ["/tmp/a b/größe", "it's", "-x; $(y)", "back\\slash"] {
            assert_eq!(shown(Path::new(path)), path);
        }
    }

    #[test]
    fn a_line_feed_and_an_escape_sequence_are_spelled_out() {
        assert_eq!(shown(Path::new("a\nb\x1b[31m")), "a\\nb\\u{1b}[31m");
    }

    #[cfg(unix)]
    #[test]
    fn bytes_that_are_not_text_are_told() {
        use std::os::unix::ffi::OsStrExt;
        let path = Path::new(std::ffi::OsStr::from_bytes(b"caf\xe9"));
        assert_eq!(shown(path), "caf\\xE9");
    }
}
