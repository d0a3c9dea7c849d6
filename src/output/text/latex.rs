//! Texts in LaTeX.

use super::span::{Span, Target, spans};
use crate::model::readable;

/// Formats `text` for LaTeX: escapes special characters, writes symbols as commands, and sets code in typewriter
/// letters. Of a link it keeps the text alone.
pub(crate) fn latex_text(text: &str) -> String {
    let text = readable(text);
    spans(&text).into_iter().map(span).collect()
}

fn span(span: Span) -> String {
    match span {
        Span::Plain(text) => escaped(text),
        Span::Code(text) => format!("\\texttt{{{}}}", breakable(&escaped(text))),
        Span::Math(tex) => format!("${tex}$"),
        Span::Link {
            text,
            target: Target::Local(_),
        } => latex_text(text),
        Span::Link { text, .. } => escaped(text),
    }
}

/// Allows line breaks in code after underscores and slashes, without a hyphen.
fn breakable(code: &str) -> String {
    code.replace("\\_", "\\_\\allowbreak{}")
        .replace('/', "/\\allowbreak{}")
}

fn escaped(text: &str) -> String {
    text.chars().map(character).collect()
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
    κ \kappa  μ \mu  µ \mu  ν \nu  π \pi  ρ \rho  τ \tau  Φ \Phi  ψ \psi  ω \omega
    ± \pm  × \times  · \cdot  ⋅ \cdot  − -  ∝ \propto  √ \surd  ∫ \int  ∂ \partial  ∞ \infty
    ≤ \le  ≥ \ge  ≠ \ne  ≈ \approx  ≃ \simeq  ∼ \sim  ≡ \equiv  ≪ \ll  ≫ \gg  ≲ \lesssim  ≳ \gtrsim
    → \to  ⋆ \star  ★ \star  ½ \tfrac12  ° ^\circ  ‖ \|
    ⁻ ^{-}  ⁰ ^0  ¹ ^1  ² ^2  ³ ^3  ⁴ ^4  ⁵ ^5  ⁶ ^6  ⁷ ^7  ⁸ ^8  ⁹ ^9
    ₀ _0  ₁ _1  ₂ _2  ₃ _3  ₄ _4  ₅ _5  ₆ _6  ₇ _7  ₈ _8  ₉ _9  ₙ _n  ₜ _t  ᵢ _i  ⱼ _j  ᵣ _r
";

/// Returns the TeX command of a symbol.
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
    fn special_characters_are_escaped_and_mathematics_stays() {
        let cases = [
            (
                "z⋆ & `a_b` |x| < 1",
                "z$\\star$ \\& \\texttt{a\\_\\allowbreak{}b} \\textbar{}x\\textbar{} $<$ 1",
            ),
            ("at $\\mu_c$, 5 %", "at $\\mu_c$, 5 \\%"),
            (
                "[Fig. 1](#figure-a), arXiv:2511.06807",
                "Fig. 1, arXiv:2511.06807",
            ),
            ("\u{202e}", "\\textbackslash{}u\\{202e\\}"),
        ];
        for (text, expected) in cases {
            assert_eq!(latex_text(text), expected);
        }
    }
}
