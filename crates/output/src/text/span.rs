//! The parser of the notation: it splits a text into its parts.

/// A part of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Span<'a> {
    Plain(&'a str),
    /// Between backticks.
    Code(&'a str),
    /// TeX between dollar signs.
    Math(&'a str),
    Link {
        text: &'a str,
        target: Target<'a>,
    },
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Target<'a> {
    /// An anchor with its `#`, or a file beside the page.
    Local(&'a str),
    /// The arXiv number of a paper.
    ArXiv(&'a str),
}

impl std::fmt::Display for Target<'_> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Local(target) => formatter.write_str(target),
            Self::ArXiv(number) => write!(formatter, "https://arxiv.org/abs/{number}"),
        }
    }
}

/// The folders beside the page whose files may be linked; links to other files are plain text.
const FOLDERS: [&str; 2] = ["tables/", "figures/"];
const ARXIV: &str = "arXiv:";

/// Escapes the dollar signs in a `text` from outside, such as the last words of a program, so that none begins
/// mathematics.
pub(crate) fn without_mathematics(text: &str) -> String {
    text.replace('$', "\\$")
}

/// Replaces `<` and `>` in `tex` by commands, so that no HTML tag begins in it.
pub(super) fn without_signs_of_tags(tex: &str) -> String {
    tex.replace('<', "\\lt ").replace('>', "\\gt ")
}

/// Splits `text` into its parts, in order.
pub(super) fn spans(text: &str) -> Vec<Span<'_>> {
    let mut spans = Vec::new();
    let (mut plain, mut at) = (0, 0);
    while let Some(char) = text[at..].chars().next() {
        match marked(&text[at..]) {
            Some((span, length)) => {
                if plain < at {
                    spans.push(Span::Plain(&text[plain..at]));
                }
                spans.push(span);
                at += length;
                plain = at;
            }
            None => at += char.len_utf8(),
        }
    }
    if plain < text.len() {
        spans.push(Span::Plain(&text[plain..]));
    }
    spans
}

/// Parses the marked part at the start of `text`. Returns it with its length, marks included.
fn marked(text: &str) -> Option<(Span<'_>, usize)> {
    match text.as_bytes().first()? {
        b'`' => {
            let inside = text[1..].split_once('`')?.0;
            Some((Span::Code(inside), inside.len() + 2))
        }
        b'$' => math(text),
        b'\\' if text[1..].starts_with('$') => Some((Span::Plain(&text[1..2]), 2)),
        b'[' => link(text),
        b'a' => paper(text),
        _ => None,
    }
}

/// Parses mathematics: TeX that touches its dollar signs from inside. No digit follows, so that amounts of money are
/// not taken for mathematics.
fn math(text: &str) -> Option<(Span<'_>, usize)> {
    let (inside, after) = text[1..].split_once('$')?;
    let touches = !inside.is_empty() && inside.trim() == inside;
    let is_amount = after.starts_with(|next: char| next.is_ascii_digit());
    (touches && !is_amount).then(|| (Span::Math(inside), inside.len() + 2))
}

fn link(text: &str) -> Option<(Span<'_>, usize)> {
    let (label, after) = text[1..].split_once("](")?;
    let target = after.split_once(')')?.0;
    let is_plain = |char: char| char.is_ascii_alphanumeric() || "-_./".contains(char);
    let known = match target.strip_prefix('#') {
        Some(anchor) => !anchor.is_empty() && anchor.chars().all(is_plain),
        None => FOLDERS.iter().any(|own| target.starts_with(own)) && target.chars().all(is_plain),
    };
    let link = Span::Link {
        text: label,
        target: Target::Local(target),
    };
    let is_link = known && !label.contains(['[', ']']);
    is_link.then(|| (link, label.len() + target.len() + 4))
}

/// Parses the number of a paper, such as `arXiv:2511.06807`.
fn paper(text: &str) -> Option<(Span<'_>, usize)> {
    let number = text.strip_prefix(ARXIV)?;
    let end = number.find(|char: char| !char.is_ascii_digit() && char != '.');
    let number = number[..end.unwrap_or(number.len())].trim_end_matches('.');
    let (year, rest) = number.split_once('.')?;
    let length = ARXIV.len() + number.len();
    let link = Span::Link {
        text: &text[..length],
        target: Target::ArXiv(number),
    };
    (year.len() == 4 && rest.len() >= 4).then_some((link, length))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_taken_apart() {
        let text = "by `a$b` at $\\mu_c$ of [Fig. 1](#figure-a), arXiv:2511.06807.";
        let link = |text, target| Span::Link { text, target };
        let expected = [
            Span::Plain("by "),
            Span::Code("a$b"),
            Span::Plain(" at "),
            Span::Math("\\mu_c"),
            Span::Plain(" of "),
            link("Fig. 1", Target::Local("#figure-a")),
            Span::Plain(", "),
            link("arXiv:2511.06807", Target::ArXiv("2511.06807")),
            Span::Plain("."),
        ];
        assert_eq!(spans(text), expected);
    }

    #[test]
    fn what_is_not_of_the_notation_is_plain() {
        for text in [
            "an odd ` backtick",
            "5 $ and 6 $",
            "$5 and $6",
            "[x](http://example.org)",
            "[x](javascript:a)",
            "[x](../a)",
            "arXiv: none",
        ] {
            assert_eq!(spans(text), [Span::Plain(text)], "{text}");
        }
    }
}
