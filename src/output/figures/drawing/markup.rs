//! Text with italics and subscripts.

/// The style of a part of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Style {
    Plain,
    Italic,
    Subscript,
}

/// Size of a subscript, relative to its text.
pub(super) const SUBSCRIPT_SIZE: f64 = 0.75;
/// Distance by which a subscript is lowered, in pixels.
pub(super) const SUBSCRIPT_DROP: f64 = 3.0;

/// `text` in parts of one style each: `_x_` is one letter in italics, `_{…}` a subscript.
pub(super) fn spans(text: &str) -> Vec<(Style, &str)> {
    let mut spans = Vec::new();
    let (mut plain, mut from) = (text, 0);
    while let Some(place) = plain[from..].find('_').map(|place| from + place) {
        match marked(&plain[place + 1..]) {
            Some((style, words, rest)) => {
                spans.push((Style::Plain, &plain[..place]));
                spans.push((style, words));
                (plain, from) = (rest, 0);
            }
            None => from = place + 1,
        }
    }
    spans.push((Style::Plain, plain));
    spans.retain(|(_, words)| !words.is_empty());
    spans
}

/// The marked words at the start of `text`, which follows an underscore, and the rest.
fn marked(text: &str) -> Option<(Style, &str, &str)> {
    if let Some(inside) = text.strip_prefix('{') {
        let (words, rest) = inside.split_once('}')?;
        return Some((Style::Subscript, words, rest));
    }
    let (letter, rest) = text.split_once('_')?;
    (letter.chars().count() == 1).then_some((Style::Italic, letter, rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_are_slanted_and_subscripts_lowered() {
        assert_eq!(
            spans("|F_{limit}| = _m_ _μ__{d}"),
            [
                (Style::Plain, "|F"),
                (Style::Subscript, "limit"),
                (Style::Plain, "| = "),
                (Style::Italic, "m"),
                (Style::Plain, " "),
                (Style::Italic, "μ"),
                (Style::Subscript, "d"),
            ]
        );
    }

    #[test]
    fn other_underscores_are_printed() {
        for text in ["my_own_code", "open_{", "_", "__"] {
            assert_eq!(spans(text), [(Style::Plain, text)]);
        }
    }
}
