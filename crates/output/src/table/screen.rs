//! Width and colours of standard output, which may be a terminal.

use crate::study::Verdict;
use console::{Style, Term, measure_text_width};
use std::env::var_os;

/// What standard output can show.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Screen {
    /// Number of columns; `None` where lines may be of any length.
    pub width: Option<usize>,
    pub has_colours: bool,
}

impl Screen {
    /// Returns what standard output can show. Its width is `COLUMNS` if that is set, else that of the terminal; a
    /// pipe has none.
    pub fn of_standard_output() -> Self {
        let set = var_os("COLUMNS").and_then(|text| text.to_str()?.parse().ok());
        let terminal = || {
            let (_, columns) = Term::stdout().size_checked()?;
            Some(usize::from(columns))
        };
        let is_unset = |name: &str| var_os(name).is_none_or(|value| value.is_empty());
        Self {
            width: set.or_else(terminal).filter(|&columns| columns > 0),
            has_colours: is_unset("NO_COLOR") && console::colors_enabled(),
        }
    }
}

/// Wraps `text` to the width of standard output. Tables have been fitted already and stay as they are.
pub fn wrapped_to_screen(text: String) -> String {
    match Screen::of_standard_output().width {
        Some(width) => wrapped(&text, width),
        None => text,
    }
}

/// Breaks lines that are longer than `width` between words. Continuation lines have the indentation of the first one.
pub(super) fn wrapped(text: &str, width: usize) -> String {
    let lines = text.split_inclusive('\n').map(|line| {
        let is_table = line.starts_with(['┌', '│', '╞', '├', '└']);
        match is_table || measure_text_width(line.trim_end()) <= width {
            true => line.to_owned(),
            false => broken(line, width),
        }
    });
    lines.collect()
}

fn broken(line: &str, width: usize) -> String {
    let content = line.trim_start();
    let indent = &line[..line.len() - content.len()];
    let mut lines = vec![indent.to_owned()];
    for word in content.split_whitespace() {
        let last = lines.last_mut().expect("there is a line");
        let is_first = last.len() == indent.len();
        if !is_first && measure_text_width(last) + 1 + measure_text_width(word) > width {
            lines.push(format!("{indent}{word}"));
        } else {
            last.push_str(if is_first { "" } else { " " });
            last.push_str(word);
        }
    }
    let end = if line.ends_with('\n') { "\n" } else { "" };
    lines.join("\n") + end
}

/// Colours the verdicts among the words of `cell`.
pub(super) fn coloured(cell: &str) -> String {
    let words = cell.split_inclusive(' ').map(|word| {
        let name = word.trim_end();
        match style_of(name) {
            Some(style) => style.apply_to(name).to_string() + &word[name.len()..],
            None => word.to_owned(),
        }
    });
    words.collect()
}

/// Returns the colour of a verdict. The word says the same, so that nothing is lost without colour.
fn style_of(word: &str) -> Option<Style> {
    let mut all = Verdict::ALL.into_iter();
    let style = Style::new().force_styling(true);
    Some(match all.find(|verdict| verdict.as_str() == word)? {
        Verdict::Agrees => style.green(),
        Verdict::Differs => style.red(),
        Verdict::Inconclusive => style.yellow(),
        Verdict::NoYield | Verdict::Failed | Verdict::Missing => style.magenta(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lines_are_broken_between_words_and_tables_are_not() {
        let text = "  one two three\n│ one two three │\nfour\n";
        let expected = "  one two\n  three\n│ one two three │\nfour\n";
        assert_eq!(wrapped(text, 10), expected);
        assert_eq!(wrapped("unbreakable", 4), "unbreakable");
    }

    #[test]
    fn verdicts_are_coloured_word_by_word() {
        assert_eq!(coloured(" agrees  "), " \u{1b}[32magrees\u{1b}[0m  ");
        assert_eq!(
            coloured("2 (1e-9) differs from 1"),
            "2 (1e-9) \u{1b}[31mdiffers\u{1b}[0m from 1"
        );
        assert_eq!(coloured(" disagrees "), " disagrees ");
    }
}
