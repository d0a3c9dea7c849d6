//! Escapes of text for Markdown, HTML and TeX.

use crate::model::{readable, readable_lines};

/// `text` in one cell of a Markdown table, as [`markdown_text`].
pub(super) fn markdown_cell(text: &str) -> String {
    markdown_text(&text.replace('\n', " ")).replace('|', "\\|")
}

/// `text` in Markdown without HTML in it; parts between backticks stay code, in which nothing needs an escape.
pub(crate) fn markdown_text(text: &str) -> String {
    let text = readable_lines(text);
    let last = text.matches('`').count();
    let parts = text.split('`').enumerate().map(|(index, part)| {
        // An odd backtick begins no code.
        match index % 2 == 1 && index < last {
            true => part.to_owned(),
            false => without_markup(part),
        }
    });
    parts.collect::<Vec<_>>().join("`")
}

/// `text` in which no tag, entity, link or picture begins.
fn without_markup(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for (at, char) in text.char_indices() {
        let next = text[at + char.len_utf8()..].chars().next();
        let next = next.unwrap_or(' ');
        match char {
            '<' if next.is_ascii_alphabetic() || "/!?".contains(next) => escaped += "&lt;",
            '&' if next.is_ascii_alphanumeric() || next == '#' => escaped += "&amp;",
            ']' if "([:".contains(next) => escaped += "\\]",
            _ => escaped.push(char),
        }
    }
    escaped
}

/// `text` as code in Markdown, also if it has backticks.
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

/// `text` in one cell for a terminal.
pub(super) fn terminal_cell(text: &str) -> String {
    readable_lines(text)
}

/// `text` escaped for HTML, with the parts between backticks as code.
pub(crate) fn html_text(text: &str) -> String {
    code_marked(&readable_lines(text), "<code>", "</code>", |part| {
        part.replace('&', "&amp;")
            .replace('<', "&lt;")
            .replace('>', "&gt;")
            .replace('"', "&quot;")
    })
}

/// `text` for TeX: special characters escaped, symbols as commands, parts between backticks in typewriter.
pub(super) fn latex_text(text: &str) -> String {
    code_marked(&readable(text), "\\texttt{", "}", |part| {
        part.chars().map(character).collect()
    })
}

/// `text` with every part `escaped`, and those between backticks between `open` and `close`.
fn code_marked(text: &str, open: &str, close: &str, escaped: impl Fn(&str) -> String) -> String {
    let parts = text.split('`').enumerate().map(|(index, part)| {
        if index % 2 == 1 {
            format!("{open}{}{close}", escaped(part))
        } else {
            escaped(part)
        }
    });
    parts.collect()
}

fn character(character: char) -> String {
    let command = match character {
        '&' | '%' | '$' | '#' | '_' | '{' | '}' => return format!("\\{character}"),
        '\\' => "\\textbackslash{}",
        '~' => "\\textasciitilde{}",
        '^' => "\\textasciicircum{}",
        '|' => "\\textbar{}",
        '–' => "--",
        '…' => "\\dots{}",
        '“' => "``",
        '”' => "''",
        '’' => "'",
        '<' => "$<$",
        '>' => "$>$",
        other => {
            let name = symbol(other).map(|name| format!("${name}$"));
            return name.unwrap_or_else(|| other.to_string());
        }
    };
    command.to_owned()
}

/// Symbols, each with its TeX command.
const SYMBOLS: &str = r"
    α \alpha  β \beta  δ \delta  Δ \Delta  ε \epsilon  ϵ \epsilon  η \eta  θ \theta  Θ \Theta
    κ \kappa  μ \mu  µ \mu  π \pi  ρ \rho  τ \tau  Φ \Phi  ψ \psi  ω \omega
    ± \pm  × \times  · \cdot  ⋅ \cdot  − -  ∝ \propto  √ \surd  ∫ \int  ∂ \partial  ∞ \infty
    ≤ \le  ≥ \ge  ≠ \ne  ≈ \approx  ≃ \simeq  ∼ \sim  ≡ \equiv  ≪ \ll  ≫ \gg  ≲ \lesssim  ≳ \gtrsim
    → \to  ⋆ \star  ★ \star  ½ \tfrac12  ° ^\circ
    ⁻ ^{-}  ⁰ ^0  ¹ ^1  ² ^2  ³ ^3  ⁴ ^4  ⁵ ^5  ⁶ ^6  ⁷ ^7  ⁸ ^8  ⁹ ^9
    ₀ _0  ₁ _1  ₂ _2  ₃ _3  ₄ _4  ₅ _5  ₆ _6  ₇ _7  ₈ _8  ₉ _9  ₙ _n  ₜ _t  ᵢ _i  ⱼ _j  ᵣ _r
";

/// The TeX command of a symbol.
fn symbol(character: char) -> Option<&'static str> {
    let mut words = SYMBOLS.split_whitespace();
    let mut pairs = std::iter::from_fn(|| words.next().zip(words.next()));
    let found = pairs.find(|(symbol, _)| symbol.chars().eq([character]));
    found.map(|(_, command)| command)
}

#[cfg(test)]
mod tests {
    use super::*;

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
        assert_eq!(html_text("\u{202e}"), "\\u{202e}");
        assert_eq!(latex_text("\u{202e}"), "\\textbackslash{}u\\{202e\\}");
    }

    #[test]
    fn text_is_escaped_and_code_is_marked() {
        let shown = html_text("a < b & `x > y`");
        assert_eq!(shown, "a &lt; b &amp; <code>x &gt; y</code>");
    }
}
