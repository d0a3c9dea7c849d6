//! Tables for a paper: LaTeX with booktabs.

use super::document::DataTable;

/// The table as a `tabular` with a comment that says what it is. It needs the packages booktabs and, for long
/// tables, longtable; every character is plain TeX.
pub fn latex(data: &DataTable) -> String {
    let table = &data.table;
    let alignment: String = table
        .numeric()
        .iter()
        .map(|&numeric| if numeric { 'r' } else { 'l' })
        .collect();
    let line = |cells: &mut dyn Iterator<Item = &str>| {
        let cells: Vec<String> = cells.map(escaped).collect();
        cells.join(" & ") + " \\\\\n"
    };
    let environment = if data.long { "longtable" } else { "tabular" };
    let mut text = format!("% {}\n", data.caption.replace('\n', " "));
    text += &format!("\\begin{{{environment}}}{{{alignment}}}\n\\toprule\n");
    text += &line(&mut table.columns().iter().copied());
    text += "\\midrule\n";
    if data.long {
        text += "\\endhead\n";
    }
    for row in table.rows() {
        text += &line(&mut row.iter().map(String::as_str));
    }
    text + &format!("\\bottomrule\n\\end{{{environment}}}\n")
}

/// `text` for TeX: its special characters escaped, symbols as commands, what stands between backticks in
/// typewriter.
fn escaped(text: &str) -> String {
    let parts = text.split('`').enumerate().map(|(index, part)| {
        let part: String = part.chars().map(character).collect();
        if index % 2 == 1 {
            format!("\\texttt{{{part}}}")
        } else {
            part
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
    const DIGITS: [&str; 2] = ["⁰¹²³⁴⁵⁶⁷⁸⁹", "₀₁₂₃₄₅₆₇₈₉"];
    let digit = |row: usize| DIGITS[row].chars().position(|digit| digit == character);
    if let Some(value) = digit(0) {
        return Some(format!("^{value}"));
    }
    if let Some(value) = digit(1) {
        return Some(format!("_{value}"));
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
        '|' => "|",
        _ => return None,
    };
    Some(name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::Table;

    #[test]
    fn a_table_is_ready_for_a_paper() {
        let mut table = Table::new(&["theory", "error>"]);
        table.push(vec!["z⋆ & `a_b`".to_owned(), "±5 %".to_owned()]);
        let data = DataTable {
            name: "errors",
            caption: "Errors.".to_owned(),
            table,
            csv: Vec::new(),
            long: false,
        };
        let expected = "% Errors.\n\\begin{tabular}{lr}\n\\toprule\ntheory & error \\\\\n\\midrule\n\
                        z$\\star$ \\& \\texttt{a\\_b} & $\\pm$5 \\% \\\\\n\\bottomrule\n\\end{tabular}\n";
        assert_eq!(latex(&data), expected);
    }
}
