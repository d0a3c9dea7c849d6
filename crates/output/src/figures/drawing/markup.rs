//! Text with italics, subscripts and superscripts.

/// The style of a part of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Style {
    Plain,
    Italic,
    Subscript,
    Superscript,
}

impl Style {
    /// Returns the size, relative to the text, and the distance by which it is lowered, in pixels.
    pub fn size_and_drop(self) -> (f64, f64) {
        match self {
            Self::Plain | Self::Italic => (1.0, 0.0),
            Self::Subscript => (0.75, 3.0),
            Self::Superscript => (0.75, -4.0),
        }
    }
}

/// Splits `text` into parts of one style each: `_x_` is one letter in italics, `_{…}` a subscript. The small letters
/// and digits of Unicode are set like all others, since fonts draw them in sizes of their own or not at all.
pub(super) fn spans(text: &str) -> Vec<(Style, String)> {
    let mut spans: Vec<(Style, String)> = Vec::new();
    let marked = marked_spans(text).into_iter();
    let letters = marked.flat_map(|(style, words)| words.chars().map(move |own| (style, own)));
    for (style, letter) in letters {
        let (style, letter) = small(letter).unwrap_or((style, letter));
        match spans.last_mut() {
            Some((last, words)) if *last == style => words.push(letter),
            _ => spans.push((style, letter.to_string())),
        }
    }
    spans
}

/// Returns the style and the ordinary letter of a subscript or superscript of Unicode.
fn small(letter: char) -> Option<(Style, char)> {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = |place: usize| char::from(b'0' + place as u8);
    match letter {
        'ₙ' => Some((Style::Subscript, 'n')),
        'ₜ' => Some((Style::Subscript, 't')),
        '₀'..='₉' => Some((Style::Subscript, digit(letter as usize - '₀' as usize))),
        '⁻' => Some((Style::Superscript, '−')),
        _ => {
            let place = RAISED.iter().position(|&raised| raised == letter)?;
            Some((Style::Superscript, digit(place)))
        }
    }
}

/// Splits `text` by its marks alone.
fn marked_spans(text: &str) -> Vec<(Style, &str)> {
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

/// Parses the marked words at the start of `text`, which follows an underscore. Returns style, words and rest.
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

    fn owned(spans: &[(Style, String)]) -> Vec<(Style, &str)> {
        let parts = spans.iter();
        parts
            .map(|(style, words)| (*style, words.as_str()))
            .collect()
    }

    #[test]
    fn letters_are_slanted_and_subscripts_lowered() {
        assert_eq!(
            owned(&spans("|F_{limit}| = _m_ _μ__{d}")),
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
    fn small_letters_of_unicode_are_subscripts_and_superscripts_like_all_others() {
        assert_eq!(
            owned(&spans("kₙ/kₜ = 10⁻²³, r₁ F_{c}")),
            [
                (Style::Plain, "k"),
                (Style::Subscript, "n"),
                (Style::Plain, "/k"),
                (Style::Subscript, "t"),
                (Style::Plain, " = 10"),
                (Style::Superscript, "−23"),
                (Style::Plain, ", r"),
                (Style::Subscript, "1"),
                (Style::Plain, " F"),
                (Style::Subscript, "c"),
            ]
        );
    }

    #[test]
    fn other_underscores_are_printed() {
        for text in ["my_own_code", "open_{", "_", "__"] {
            assert_eq!(owned(&spans(text)), [(Style::Plain, text)]);
        }
    }
}
