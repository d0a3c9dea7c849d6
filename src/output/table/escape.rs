//! Escapes of text for Markdown, HTML and TeX.

/// `text` in one cell of a Markdown table.
pub(super) fn markdown_cell(text: &str) -> String {
    text.replace('|', "\\|").replace('\n', " ")
}

/// `text` escaped for HTML, with the parts between backticks as code.
pub(crate) fn html_text(text: &str) -> String {
    code_marked(text, "<code>", "</code>", |part| {
        part.replace('&', "&amp;")
            .replace('<', "&lt;")
            .replace('>', "&gt;")
            .replace('"', "&quot;")
    })
}

/// `text` for TeX: special characters escaped, symbols as commands, parts between backticks in typewriter.
pub(super) fn latex_text(text: &str) -> String {
    code_marked(text, "\\texttt{", "}", |part| {
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
            return symbol(other).map_or_else(|| other.to_string(), |name| format!("${name}$"));
        }
    };
    command.to_owned()
}

/// The TeX command of a symbol.
fn symbol(character: char) -> Option<String> {
    for (digits, mark) in [("⁰¹²³⁴⁵⁶⁷⁸⁹", '^'), ("₀₁₂₃₄₅₆₇₈₉", '_')]
    {
        if let Some(value) = digits.chars().position(|digit| digit == character) {
            return Some(format!("{mark}{value}"));
        }
    }
    let name = match character {
        'α' => "\\alpha",
        'β' => "\\beta",
        'δ' => "\\delta",
        'Δ' => "\\Delta",
        'ε' | 'ϵ' => "\\epsilon",
        'η' => "\\eta",
        'θ' => "\\theta",
        'Θ' => "\\Theta",
        'κ' => "\\kappa",
        'μ' | 'µ' => "\\mu",
        'π' => "\\pi",
        'ρ' => "\\rho",
        'τ' => "\\tau",
        'Φ' => "\\Phi",
        'ψ' => "\\psi",
        'ω' => "\\omega",
        '±' => "\\pm",
        '×' => "\\times",
        '·' | '⋅' => "\\cdot",
        '−' => "-",
        '⁻' => "^{-}",
        '≤' => "\\le",
        '≥' => "\\ge",
        '≠' => "\\ne",
        '≈' => "\\approx",
        '≃' => "\\simeq",
        '∼' => "\\sim",
        '≡' => "\\equiv",
        '≪' => "\\ll",
        '≫' => "\\gg",
        '≲' => "\\lesssim",
        '≳' => "\\gtrsim",
        '→' => "\\to",
        '∞' => "\\infty",
        '∝' => "\\propto",
        '√' => "\\surd",
        '∫' => "\\int",
        '∂' => "\\partial",
        '⋆' | '★' => "\\star",
        'ₙ' => "_n",
        'ₜ' => "_t",
        'ᵢ' => "_i",
        'ⱼ' => "_j",
        'ᵣ' => "_r",
        '½' => "\\tfrac12",
        '°' => "^\\circ",
        _ => return None,
    };
    Some(name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_escaped_and_code_is_marked() {
        let shown = html_text("a < b & `x > y`");
        assert_eq!(shown, "a &lt; b &amp; <code>x &gt; y</code>");
    }
}
