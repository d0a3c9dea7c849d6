//! A table in LaTeX: a longtable in which text columns have widths and numbers are aligned at their decimal points.

use crate::output::text::latex_text;

/// The packages that every table needs.
const PACKAGES: [&str; 6] = [
    "amsmath",
    "amssymb",
    "booktabs",
    "dcolumn",
    "longtable",
    "lscape",
];

/// Sizes of letters, and how many average letters fit in a line of the class `article` upright and in landscape
/// format; 0 where a size is not used.
const SIZES: [(&str, f64, f64); 4] = [
    ("\\small", 72.0, 0.0),
    ("\\footnotesize", 81.0, 128.0),
    ("\\scriptsize", 0.0, 144.0),
    ("\\tiny", 0.0, 182.0),
];
/// Maximum width, in letters, of a text that stands in one line.
const ONE_LINE: f64 = 22.0;
/// Minimum width of a text in several lines, in letters.
const LEAST: f64 = 14.0;
/// Space between two columns, in letters.
const GAP: f64 = 2.0;
/// Width of a power of ten without its exponent, in digits: the sign, the ten and the spaces.
const POWER: usize = 5;
/// Width of the sign before a number, in digits.
const SIGN: usize = 2;

/// Returns a document that includes the tables in these files.
pub(crate) fn document_of<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let packages = PACKAGES.map(|name| format!("\\usepackage{{{name}}}\n"));
    let inputs = names.into_iter().map(|name| format!("\\input{{{name}}}\n"));
    format!(
        "\\documentclass[a4paper]{{article}}\n\\usepackage[T1]{{fontenc}}\n{}\\begin{{document}}\n\\listoftables\n{}\\end{{document}}\n",
        packages.concat(),
        inputs.collect::<String>()
    )
}

/// A column of a table.
pub(super) struct LatexColumn<'a> {
    pub heading: &'a str,
    pub numeric: bool,
    pub cells: Vec<&'a str>,
}

/// Formats the table with its caption and the label `tab:` followed by `name`.
pub(super) fn latex(name: &str, caption: &str, columns: &[LatexColumn]) -> String {
    let kinds: Vec<Kind> = columns.iter().map(Kind::of).collect();
    let page = Page::of(&kinds);
    let share = page.text_share(&kinds);
    let alignment: String = kinds.iter().map(|kind| kind.alignment(share)).collect();
    let headings = columns.iter().zip(&kinds);
    let headings = joined(headings.map(|(column, kind)| kind.heading(column.heading)));
    let count = columns.first().map_or(0, |column| column.cells.len());
    let rows = (0..count).map(|row| {
        let cells = columns.iter().zip(&kinds);
        joined(cells.map(|(column, kind)| kind.cell(column.cells[row])))
    });
    let (open, close) = page.environment();
    format!(
        "% Needs the packages {}.\n{open}\\begin{{longtable}}{{{alignment}}}\n\
         \\caption{{{}}}\\label{{tab:{name}}}\\\\\n\\toprule\n{headings}\\midrule\n\\endfirsthead\n\\toprule\n\
         {headings}\\midrule\n\\endhead\n\\bottomrule\n\\endlastfoot\n{}\\end{{longtable}}\n{close}",
        PACKAGES.join(", "),
        latex_text(&caption.replace('\n', " ")),
        rows.collect::<String>(),
    )
}

fn joined(cells: impl Iterator<Item = String>) -> String {
    cells.collect::<Vec<_>>().join(" & ") + " \\\\\n"
}

/// How a column is set.
enum Kind {
    /// Numbers, with the digits that they need before and after the point (a digit is as wide as a letter), and the
    /// width of the widest heading line or formula.
    Aligned {
        before: usize,
        after: usize,
        others: f64,
    },
    /// Text in one line.
    Line { width: f64, is_right: bool },
    /// Text in several lines, with its mean width.
    Lines { mean: f64, has_formulas: bool },
}

impl Kind {
    fn of(column: &LatexColumn) -> Self {
        let cells = column.cells.iter();
        let widths: Vec<f64> = cells.map(|cell| width(cell)).collect();
        let longest = widths.iter().copied().fold(0.0, f64::max);
        let heading = heading_lines(column.heading, longest);
        let heading = heading.iter().map(|line| width(line)).fold(0.0, f64::max);
        let numbers: Option<Vec<(usize, usize)>> =
            column.cells.iter().map(|cell| digits(cell)).collect();
        if let (Some(numbers), true) = (numbers, column.numeric) {
            let longest = |side: fn(&(usize, usize)) -> usize| numbers.iter().map(side).max();
            let formulas = column.cells.iter().filter(|cell| is_formula(cell));
            return Self::Aligned {
                before: longest(|own| own.0).unwrap_or(1),
                after: longest(|own| own.1).unwrap_or(0),
                others: formulas.map(|cell| width(cell)).fold(heading, f64::max),
            };
        }
        if column.numeric || longest <= ONE_LINE {
            return Self::Line {
                width: longest.max(heading),
                is_right: column.numeric,
            };
        }
        let mean = widths.iter().sum::<f64>() / widths.len().max(1) as f64;
        Self::Lines {
            mean: mean.max(LEAST),
            has_formulas: column.cells.iter().any(|cell| cell.contains('$')),
        }
    }

    /// Returns its minimum width, in letters.
    fn least(&self) -> f64 {
        match self {
            Self::Aligned {
                before,
                after,
                others,
            } => (*before as f64 + *after as f64 + 1.0).max(*others),
            Self::Line { width, .. } => *width,
            Self::Lines { .. } => LEAST,
        }
    }

    /// Returns the weight by which it shares the width of the text columns: the square root of the mean length of its
    /// texts, or 0 if it is no text column.
    fn weight(&self) -> f64 {
        match self {
            Self::Lines { mean, .. } => mean.sqrt(),
            _ => 0.0,
        }
    }

    /// Returns the width beyond its minimum with which it reads well. Formulas need more, since they do not break
    /// where words do.
    fn comfort(&self) -> f64 {
        match self {
            Self::Lines {
                has_formulas: true, ..
            } => 12.0,
            Self::Lines { .. } => 8.0,
            _ => 0.0,
        }
    }

    /// Returns its specifier in the head of the table. Text columns have `share` of a line for each unit of weight.
    fn alignment(&self, share: f64) -> String {
        match self {
            Self::Aligned { before, after, .. } => format!("D{{.}}{{.}}{{{before}.{after}}}"),
            Self::Line { is_right: true, .. } => "r".to_owned(),
            Self::Line { .. } => "l".to_owned(),
            Self::Lines { .. } => format!(
                ">{{\\raggedright\\arraybackslash}}p{{{:.3}\\linewidth}}",
                share * self.weight()
            ),
        }
    }

    fn heading(&self, heading: &str) -> String {
        let (side, longest) = match self {
            Self::Aligned { before, after, .. } => ('c', (before + after + 1) as f64),
            Self::Line {
                is_right: true,
                width,
            } => ('r', *width),
            Self::Line { width, .. } => ('l', *width),
            Self::Lines { .. } => return latex_text(heading),
        };
        let lines: Vec<String> = heading_lines(heading, longest)
            .iter()
            .map(|line| latex_text(line))
            .collect();
        match &lines[..] {
            [line] => format!("\\multicolumn{{1}}{{{side}}}{{{line}}}"),
            lines => format!(
                "\\multicolumn{{1}}{{{side}}}{{\\shortstack[{side}]{{{}}}}}",
                lines.join("\\\\")
            ),
        }
    }

    fn cell(&self, cell: &str) -> String {
        match (self, cell.split_once('e')) {
            (Self::Aligned { .. }, _) if cell == "-" => "\\multicolumn{1}{c}{--}".to_owned(),
            (Self::Aligned { .. }, _) if is_formula(cell) => {
                format!("\\multicolumn{{1}}{{c}}{{{}}}", latex_text(cell))
            }
            (Self::Aligned { .. }, Some((number, exponent))) => with_power(number, exponent),
            (Self::Aligned { .. }, None) => cell.to_owned(),
            (Self::Lines { .. }, _) => breakable(&breakable_formulas(&latex_text(cell))),
            _ => latex_text(cell),
        }
    }
}

/// Allows line breaks in the formulas of `text`, before brackets and after commas.
fn breakable_formulas(text: &str) -> String {
    let parts = text.split('$').enumerate();
    let parts = parts.map(|(index, part)| match index % 2 {
        0 => part.to_owned(),
        _ => open_brackets(part)
            .replace("\\bigl", "\\allowbreak\\bigl")
            .replace("}(", "}\\allowbreak(")
            .replace(", ", ",\\allowbreak\\ "),
    });
    parts.collect::<Vec<_>>().join("$")
}

/// Replaces brackets in `tex` that fit what they enclose by brackets of one size, since TeX breaks no line between
/// the former.
fn open_brackets(tex: &str) -> String {
    let mut opened = String::new();
    let mut rest = tex;
    while let Some(at) = rest
        .find("\\left")
        .into_iter()
        .chain(rest.find("\\right"))
        .min()
    {
        let (before, found) = rest.split_at(at);
        let name = match found.starts_with("\\left") {
            true => "\\left",
            false => "\\right",
        };
        let after = &found[name.len()..];
        let is_bracket = !after.starts_with(|next: char| next.is_ascii_alphabetic());
        opened += before;
        opened += match (is_bracket, name) {
            (true, "\\left") => "\\bigl",
            (true, _) => "\\bigr",
            (false, name) => name,
        };
        rest = after;
    }
    opened + rest
}

/// Allows line breaks in long words of `text`, such as versions, after `+` and `.`.
fn breakable(text: &str) -> String {
    let words = text.split(' ').map(|word| {
        let is_plain = !word.contains(['\\', '$']);
        match is_plain && word.len() as f64 > LEAST {
            true => word
                .replace('+', "+\\allowbreak{}")
                .replace('.', ".\\allowbreak{}"),
            false => word.to_owned(),
        }
    });
    words.collect::<Vec<_>>().join(" ")
}

/// Formats a number and its power of ten, which stands in the space after the point even if the number has no point.
///
/// A column places all of a cell without a point before the point, where there is no room for the power.
fn with_power(number: &str, exponent: &str) -> String {
    let power = format!("\\times10^{{{}}}", exponent.trim_start_matches('+'));
    match number.contains('.') {
        true => number.to_owned() + &power,
        false => format!("{number}\\rlap{{${{}}{power}$}}"),
    }
}

/// Returns the width of a number in digits before and after its point, with its power of ten after it; `None` for a
/// text.
fn digits(cell: &str) -> Option<(usize, usize)> {
    if cell == "-" || cell.is_empty() || is_formula(cell) {
        return Some((1, 0));
    }
    cell.parse::<f64>()
        .ok()
        .filter(|number| number.is_finite())?;
    let (number, exponent) = cell.split_once('e').unwrap_or((cell, ""));
    let (before, after) = number.split_once('.').unwrap_or((number, ""));
    let power = match exponent {
        "" => 0,
        exponent => POWER + exponent.len(),
    };
    let before = match before.strip_prefix(['-', '+']) {
        Some(unsigned) => SIGN + unsigned.len(),
        None => before.len(),
    };
    Some((before, after.len() + power))
}

/// Whether all of `cell` is a formula, such as a friction by its name.
fn is_formula(cell: &str) -> bool {
    let inside = cell
        .strip_prefix('$')
        .and_then(|rest| rest.strip_suffix('$'));
    inside.is_some_and(|tex| !tex.contains('$'))
}

/// Breaks `heading` at spaces into lines that are hardly longer than the cells below it.
fn heading_lines(heading: &str, longest: f64) -> Vec<String> {
    let widest = longest.max(9.0);
    let mut lines: Vec<String> = Vec::new();
    for word in words(heading) {
        match lines.last_mut() {
            Some(line) if width(line) + width(word) < widest => *line += &format!(" {word}"),
            _ => lines.push(word.to_owned()),
        }
    }
    if lines.is_empty() {
        vec![String::new()]
    } else {
        lines
    }
}

/// Splits a text into words; a formula is one word.
fn words(text: &str) -> Vec<&str> {
    let mut inside = false;
    let words = text.split(move |char: char| {
        inside ^= char == '$';
        char == ' ' && !inside
    });
    words.collect()
}

/// Returns the width of `text` in average letters. A TeX command in a formula counts as one letter.
fn width(text: &str) -> f64 {
    let (mut letters, mut in_math, mut in_command) = (0.0, false, false);
    for char in text.chars() {
        in_math ^= char == '$';
        if in_command && char.is_ascii_alphabetic() {
            continue;
        }
        in_command = in_math && char == '\\';
        letters += match char {
            '$' | '`' | '{' | '}' => 0.0,
            '_' | '^' if in_math => 0.0,
            _ => 1.0,
        };
    }
    letters
}

/// The size of letters and the orientation of the page.
struct Page {
    size: &'static str,
    is_landscape: bool,
    /// Number of letters in a line.
    letters: f64,
}

impl Page {
    /// Chooses the largest letters with which every column reads well, in landscape format only if none fit upright.
    /// If none fit at all, it takes the smallest.
    fn of(kinds: &[Kind]) -> Self {
        let least: f64 = kinds.iter().map(|kind| kind.least() + GAP).sum();
        let comfort = least + kinds.iter().map(Kind::comfort).sum::<f64>();
        let upright = SIZES
            .iter()
            .map(|&(size, letters, _)| (size, letters, false));
        let landscape = SIZES
            .iter()
            .map(|&(size, _, letters)| (size, letters, true));
        let mut pages = upright.chain(landscape);
        let fitting = pages.find(|(_, letters, _)| comfort <= *letters);
        let (size, letters, is_landscape) = fitting.unwrap_or(("\\tiny", least.max(182.0), true));
        Self {
            size,
            is_landscape,
            letters,
        }
    }

    /// Returns the share of a line that a text column has for each unit of its weight.
    fn text_share(&self, kinds: &[Kind]) -> f64 {
        let fixed = kinds.iter().filter(|kind| kind.weight() == 0.0);
        let fixed: f64 = fixed.map(Kind::least).sum();
        let gaps = GAP * kinds.len() as f64;
        let weights: f64 = kinds.iter().map(Kind::weight).sum();
        let free = (self.letters - fixed - gaps).max(LEAST) / self.letters;
        free / weights.max(1.0)
    }

    /// Returns what stands before and after the table.
    fn environment(&self) -> (String, &'static str) {
        let spacing = format!("{}\\setlength{{\\tabcolsep}}{{3pt}}\n", self.size);
        match self.is_landscape {
            true => (
                format!("\\begin{{landscape}}{spacing}"),
                "\\end{landscape}\n",
            ),
            false => (format!("\\begingroup{spacing}"), "\\endgroup\n"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column<'a>(heading: &'a str, numeric: bool, cells: &[&'a str]) -> LatexColumn<'a> {
        LatexColumn {
            heading,
            numeric,
            cells: cells.to_vec(),
        }
    }

    #[test]
    fn numbers_are_aligned_and_long_texts_have_a_width() {
        let text = "a statement that is much too long for one line of a column & more";
        let columns = [
            column("theory", false, &["z⋆", "rigid"]),
            column("error", true, &["-1.25e-8", "$\\mu_c$"]),
            column("statement", false, &[text, "-"]),
        ];
        let table = latex("errors", "Errors of $F$.", &columns);
        assert!(
            table.contains("{lD{.}{.}{3.9}>{\\raggedright\\arraybackslash}p{0."),
            "{table}"
        );
        assert!(
            table.contains("\\caption{Errors of $F$.}\\label{tab:errors}"),
            "{table}"
        );
        assert!(
            table.contains("z$\\star$ & -1.25\\times10^{-8} & a statement"),
            "{table}"
        );
        assert!(
            table.contains("rigid & \\multicolumn{1}{c}{$\\mu_c$} & -"),
            "{table}"
        );
        assert!(table.contains("column \\& more"), "{table}");
    }

    #[test]
    fn a_power_of_ten_stands_after_the_point_where_its_column_has_room() {
        let cells = ["2e-8", "-1.25e-8", "3", "-4e+12", "-"];
        let table = latex("errors", "Errors.", &[column("±", true, &cells)]);
        for expected in [
            "{longtable}{D{.}{.}{3.9}}",
            "\n2\\rlap{${}\\times10^{-8}$} \\\\\n",
            "\n-1.25\\times10^{-8} \\\\\n",
            "\n3 \\\\\n",
            "\n-4\\rlap{${}\\times10^{12}$} \\\\\n",
        ] {
            assert!(table.contains(expected), "no {expected} in {table}");
        }
        assert_eq!(digits("2e-8"), Some((1, 7)));
        assert_eq!(digits("-0.5"), Some((3, 1)));
        assert_eq!(digits("+5.3e-3"), Some((3, 8)));
    }

    #[test]
    fn a_column_of_numbers_has_room_for_its_formulas() {
        let column = column("mu", true, &["0.5", "$\\mu_c / 2 + \\mu_d / 2$"]);
        assert_eq!(Kind::of(&column).least(), 15.0);
    }

    #[test]
    fn a_heading_is_broken_at_spaces_outside_of_formulas() {
        let lines = heading_lines("F at $\\mu_c / 2$ of all codes", 8.0);
        assert_eq!(lines, ["F at", "$\\mu_c / 2$ of", "all codes"]);
        assert_eq!(width("$\\mu_c$"), 2.0);
        let text = "a, b: $\\left(a, b\\right) \\leftarrow c$";
        let opened = "a, b: $\\allowbreak\\bigl(a,\\allowbreak\\ b\\bigr) \\leftarrow c$";
        assert_eq!(breakable_formulas(text), opened);
    }
}
