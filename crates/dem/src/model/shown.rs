//! Escaping of foreign text in messages and results.

use std::path::Path;

/// Returns `path` as one line that a terminal shows literally: control characters and bytes that are not text are
/// escaped, as in `new\\nline` and `caf\\xE9`.
pub fn shown(path: &Path) -> String {
    let mut text = String::new();
    for chunk in path.as_os_str().as_encoded_bytes().utf8_chunks() {
        text += &readable(chunk.valid());
        for byte in chunk.invalid() {
            text += &format!("\\x{byte:02X}");
        }
    }
    text
}

/// Escapes every character of `text` that a terminal or a page does not show literally: control characters, those that
/// change the direction of writing or have no width, and line separators, as in `\\u{202e}`.
pub fn readable(text: &str) -> String {
    let mut readable = String::with_capacity(text.len());
    for char in text.chars() {
        if is_shown(char) {
            readable.push(char);
        } else {
            readable.extend(char.escape_default());
        }
    }
    readable
}

/// Escapes text of several lines, and keeps its line feeds.
pub fn readable_lines(text: &str) -> String {
    let lines: Vec<String> = text.split('\n').map(readable).collect();
    lines.join("\n")
}

/// Quotes `word` for a shell where necessary.
pub fn shell_quoted(word: &str) -> String {
    let plain = |char: char| char.is_ascii_alphanumeric() || "-_=.,:/+@%".contains(char);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

fn is_shown(char: char) -> bool {
    let hidden = matches!(char,
        '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
        | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e007f}');
    !char.is_control() && !hidden
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

    #[test]
    fn what_turns_the_direction_of_writing_is_spelled_out() {
        assert_eq!(readable("1.\u{202e}2\u{200b}"), "1.\\u{202e}2\\u{200b}");
        assert_eq!(readable_lines("a\n\tb"), "a\n\\tb");
    }

    #[cfg(unix)]
    #[test]
    fn bytes_that_are_not_text_are_told() {
        use std::os::unix::ffi::OsStrExt;
        let path = Path::new(std::ffi::OsStr::from_bytes(b"caf\xe9"));
        assert_eq!(shown(path), "caf\\xE9");
    }
}
