//! Texts in Markdown, their mathematics between dollar signs.

use super::span::{Span, Target, spans, without_mathematics, without_signs_of_tags};
use crate::model::{readable, readable_lines};

/// Formats `text` for one cell of a Markdown table, otherwise as [`markdown_text`].
pub(crate) fn markdown_cell(text: &str) -> String {
    let text = readable_lines(&text.replace('\n', " "));
    // A bar would end the cell, in code too. In TeX `\|` is another sign, so there it becomes `\vert`.
    let bar = |part: Span| match part {
        Span::Math(tex) => format!("${}$", without_signs_of_tags(tex).replace('|', "\\vert ")),
        other => span(other).replace('|', "\\|"),
    };
    spans(&text).into_iter().map(bar).collect()
}

/// Formats `text` as Markdown without HTML. Parts between backticks stay code, in which nothing needs an escape.
pub(crate) fn markdown_text(text: &str) -> String {
    let text = readable_lines(text);
    spans(&text).into_iter().map(span).collect()
}

/// Formats notes on a row, one per line, for an item of a list. They may hold the last words of a program.
pub(crate) fn markdown_notes(notes: &str) -> String {
    markdown_text(&without_mathematics(notes)).replace('\n', "\n  ")
}

fn span(span: Span) -> String {
    match span {
        Span::Plain(text) => without_markup(text),
        Span::Code(text) => format!("`{text}`"),
        Span::Math(tex) => format!("${}$", without_signs_of_tags(tex)),
        Span::Link { text, target } => match target {
            Target::ArXiv(_) => format!("[{text}]({target})"),
            Target::Local(_) => format!("[{}]({target})", without_markup(text)),
        },
    }
}

/// Escapes `text` so that no tag, entity, link, picture or mathematics begins in it.
fn without_markup(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for (at, char) in text.char_indices() {
        let next = text[at + char.len_utf8()..].chars().next();
        let next = next.unwrap_or(' ');
        match char {
            '<' if next.is_ascii_alphabetic() || "/!?".contains(next) => escaped += "&lt;",
            '&' if next.is_ascii_alphanumeric() || next == '#' => escaped += "&amp;",
            '$' => escaped += "\\$",
            ']' if "([:".contains(next) => escaped += "\\]",
            _ => escaped.push(char),
        }
    }
    escaped
}

/// Formats `text` as code in Markdown, even if it contains backticks.
pub(crate) fn markdown_code(text: &str) -> String {
    let text = readable(text);
    let longest = text.split(|char| char != '`').map(str::len).max();
    match longest.unwrap_or(0) {
        0 => format!("`{text}`"),
        longest => {
            let fence = "`".repeat(longest + 1);
            format!("{fence} {text} {fence}")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_a_program_are_neither_mathematics_nor_markup() {
        let notes = markdown_notes("$<img src=x>$\nlast words");
        assert_eq!(notes, "\\$&lt;img src=x>\\$\n  last words");
        let formula = markdown_text("$a < b$");
        assert_eq!(formula, "$a \\lt  b$");
    }

    #[test]
    fn nothing_becomes_markup_that_is_none() {
        for (text, expected) in [
            ("a < b & c", "a < b & c"),
            ("<b>x</b> &lt;", "&lt;b>x&lt;/b> &amp;lt;"),
            ("![x](http://x)", "![x\\](http://x)"),
            ("`<b>` and `<b>", "`<b>` and `&lt;b>"),
            ("1\u{202e}2\u{7}", "1\\u{202e}2\\u{7}"),
        ] {
            assert_eq!(markdown_text(text), expected);
        }
        assert_eq!(markdown_code("a b"), "`a b`");
        assert_eq!(markdown_code("a `b` <i>"), "`` a `b` <i> ``");
        assert_eq!(markdown_cell("a|b\n<i>"), "a\\|b &lt;i>");
    }

    #[test]
    fn a_bar_ends_no_cell_and_changes_no_formula() {
        assert_eq!(
            markdown_cell("$|f_n|$ or `a|b`"),
            "$\\vert f_n\\vert $ or `a\\|b`"
        );
        assert_eq!(markdown_text("$|f_n|$"), "$|f_n|$");
    }
}
