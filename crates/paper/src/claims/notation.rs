//! Numbers and lists in the notation of the claims: TeX between dollar signs.

use crate::model::{CRITICAL_FRICTION, Stack};

/// TeX of 1/ε, by which texts name a stiffness.
pub(crate) const STIFFNESS: &str = r"1/\epsilon";
/// TeX of μ.
pub(crate) const FRICTION: &str = r"\mu";
/// TeX of κ.
pub(crate) const RATIO: &str = r"\kappa";

/// Writes a measured `value` in TeX, with `digits` digits after the point: `1.2\times10^{-5}`.
pub fn scientific(value: f64, digits: usize) -> String {
    power_of_ten(&format!("{value:.digits$e}"))
}

/// Writes a given `value` in TeX with as few digits as it has, up to ten: `10^{-6}`, `0.25`, and μ_c by its name.
pub fn number(value: f64) -> String {
    if value == CRITICAL_FRICTION {
        return r"\mu_c".to_owned();
    }
    // Sums such as 0.1 + 0.38 have a seventeenth digit.
    let value: f64 = format!("{value:.9e}").parse().unwrap_or(value);
    let scientific = format!("{value:e}");
    let is_power = scientific.trim_start_matches('-').starts_with("1e");
    let short = if is_power { 0.1..100.0 } else { 1e-3..1e4 };
    if value == 0.0 || short.contains(&value.abs()) {
        format!("{value}")
    } else {
        power_of_ten(&scientific)
    }
}

/// Returns `text` with numbers in scientific notation, such as 1.03e-5, as TeX between dollar signs.
pub fn powers_in_tex(text: &str) -> String {
    let words = text.split(' ').map(|word| {
        let number = word.trim_end_matches([',', ';', '.', ':']);
        let is_scientific = number.contains('e') && number.parse::<f64>().is_ok();
        match is_scientific {
            true => format!("${}${}", power_of_ten(number), &word[number.len()..]),
            false => word.to_owned(),
        }
    });
    words.collect::<Vec<_>>().join(" ")
}

/// Converts a number in Rust's scientific notation to TeX. A mantissa of 1 without further digits is left out.
fn power_of_ten(scientific: &str) -> String {
    let Some((mantissa, exponent)) = scientific.split_once('e') else {
        return format!(r"\mathrm{{{scientific}}}");
    };
    let exponent = match exponent.len() {
        1 => exponent.to_owned(),
        _ => format!("{{{exponent}}}"),
    };
    match mantissa {
        "1" => format!("10^{exponent}"),
        "-1" => format!("-10^{exponent}"),
        _ if exponent == "0" => mantissa.to_owned(),
        _ => format!(r"{mantissa}\times10^{exponent}"),
    }
}

/// Writes a relative change with its sign: `$+0.86$ %`.
pub(crate) fn percent(change: f64, digits: usize) -> String {
    format!("${:+.digits$}$ %", 100.0 * change)
}

/// Joins the items as in a sentence: "a, b and c".
pub fn list(items: impl IntoIterator<Item = String>) -> String {
    let mut items: Vec<String> = items.into_iter().collect();
    match items.pop() {
        Some(last) if !items.is_empty() => format!("{} and {last}", items.join(", ")),
        last => last.unwrap_or_default(),
    }
}

/// Lists the values of a quantity, which `name` gives in TeX: `$\mu = 0.25$, $\mu_c$ and $0.3$`.
pub fn values(name: &str, values: &[f64]) -> String {
    let numbered = values.iter().enumerate();
    list(numbered.map(|(index, &value)| match index {
        0 => format!("${name} = {}$", number(value)),
        _ => format!("${}$", number(value)),
    }))
}

/// Writes the range of the values of a quantity, which `name` gives in TeX: `$\mu = 0.1$ to $0.7$`.
pub(crate) fn range(name: &str, values: &[f64]) -> String {
    let lowest = values.iter().copied().fold(f64::INFINITY, f64::min);
    let highest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    format!("${name} = {}$ to ${}$", number(lowest), number(highest))
}

/// Lists measured values of one kind with `digits` digits after the point: `$0.280$, $0.300$ and $0.400$`.
pub(crate) fn fixed(values: impl IntoIterator<Item = f64>, digits: usize) -> String {
    list(
        values
            .into_iter()
            .map(|value| format!("${value:.digits$}$")),
    )
}

/// Lists measured values of one kind in scientific notation.
pub(crate) fn powers(values: impl IntoIterator<Item = f64>, digits: usize) -> String {
    let values = values.into_iter();
    list(values.map(|value| format!("${}$", scientific(value, digits))))
}

/// Writes the friction and the stiffness of a stack: `$\mu = 0.2$, $k_n r/mg = 10^2$`.
pub(crate) fn stack(stack: &Stack) -> String {
    let friction = number(stack.floor_friction);
    let stiffness = number(stack.stiffness);
    format!(r"$\mu = {friction}$, $k_n r/mg = {stiffness}$")
}

/// Writes a deviation, or that it is below `bound`: the digits of round-off differ between machines.
pub(crate) fn size(deviation: f64, bound: f64) -> String {
    if deviation <= bound {
        format!("below ${}$", scientific(bound, 0))
    } else {
        format!("${}$", scientific(deviation, 2))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_ten_are_written_as_in_the_paper() {
        assert_eq!(scientific(1.23e-5, 1), r"1.2\times10^{-5}");
        assert_eq!(scientific(-1.23e5, 1), r"-1.2\times10^5");
        assert_eq!(scientific(1e-8, 0), "10^{-8}");
        assert_eq!(scientific(9.96e-9, 1), r"1.0\times10^{-8}");
        assert_eq!(scientific(1.5, 2), "1.50");
        assert_eq!(scientific(f64::NAN, 2), r"\mathrm{NaN}");
    }

    #[test]
    fn given_numbers_keep_every_digit_and_no_more() {
        let written = [1e2, 1e-6, -1e-3, 2.5, 10.0, 0.1, 0.7746, 3e-5, 0.0].map(number);
        let expected = [
            "10^2",
            "10^{-6}",
            "-10^{-3}",
            "2.5",
            "10",
            "0.1",
            "0.7746",
            r"3\times10^{-5}",
            "0",
        ];
        assert_eq!(written, expected);
        assert_eq!(number(CRITICAL_FRICTION), r"\mu_c");
        assert_eq!(number(0.1 + 0.02 * 19.0), "0.48");
    }

    #[test]
    fn lists_read_like_a_sentence() {
        let frictions = [0.25, CRITICAL_FRICTION, 0.3];
        let listed = values(FRICTION, &frictions);
        assert_eq!(listed, r"$\mu = 0.25$, $\mu_c$ and $0.3$");
        assert_eq!(range(FRICTION, &frictions), r"$\mu = 0.25$ to $0.3$");
        assert_eq!(fixed([0.28, 0.3, 0.4], 3), "$0.280$, $0.300$ and $0.400$");
        assert_eq!(powers([1e-4], 1), r"$1.0\times10^{-4}$");
        assert_eq!(list([]), "");
        assert_eq!(percent(0.0086, 2), "$+0.86$ %");
        assert_eq!(size(1e-12, 1e-8), "below $10^{-8}$");
        let told = powers_in_tex("1.03e-5 exceeds 1e-5; see case e of 5");
        assert_eq!(
            told,
            r"$1.03\times10^{-5}$ exceeds $10^{-5}$; see case e of 5"
        );
    }
}
