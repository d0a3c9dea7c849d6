//! The grammar of frictions and stiffnesses on the command line: values, ranges, and lists of both.

/// The grammar, for `tristack --help`.
pub(in crate::cli) const GRAMMAR: &str = "--mu and --stiffness take values and ranges, separated by commas: A:B:STEP goes \
    from A to B in equal steps, A:B:xFACTOR by equal factors, both with B if they meet it, as in 0.1:0.5:0.05,critical or \
    1e2:1e6:x10. `critical`, or `mu_c`, is the friction above which rigid bodies never yield: 2 - sqrt 3 of cylinders, \
    sqrt 3 - sqrt 2 of three spheres, sqrt 2 - 1 of four. A command for one stack takes one value.";

/// Largest number of values in a list.
const MOST_VALUES: usize = 10_000;

/// Significant digits of the values in a range of equal factors, few enough to leave out the rounding of the powers.
const DIGITS_OF_POWERS: usize = 12;

/// A quantity for which a command can take several values.
pub(in crate::cli) trait Quantity: Sized + PartialEq {
    /// An accepted value, as an error describes it.
    const ACCEPTED: &'static str;
    fn of_number(number: f64) -> Self;
    /// Returns the value that has this name.
    fn named(word: &str) -> Option<Self>;
}

/// The values of an option, in the order given, each once.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::cli) struct Values<Q>(pub Vec<Q>);

impl<Q: Quantity> Values<Q> {
    /// Reads values and ranges, separated by commas.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut values = Vec::new();
        for item in text.split(',').map(str::trim) {
            let read = item_values(item).map_err(|trouble| match text == item {
                true => trouble,
                false => format!("`{item}`: {trouble}"),
            });
            for value in read.map_err(|trouble| format!("{trouble}; {}", accepted::<Q>()))? {
                if !values.contains(&value) {
                    values.push(value);
                }
            }
            if values.len() > MOST_VALUES {
                return Err(format!("these are more values; {}", accepted::<Q>()));
            }
        }
        Ok(Self(values))
    }
}

/// Reads the value of a command for one stack.
pub(in crate::cli) fn single<Q: Quantity>(text: &str) -> Result<Q, String> {
    match value(text.trim()) {
        Some(value) => Ok(value),
        None => Err(match Values::<Q>::parse(text) {
            Ok(_) => format!(
                "this is a list or a range, and the command takes one value: {}",
                Q::ACCEPTED
            ),
            Err(_) => format!("accepted is {}", Q::ACCEPTED),
        }),
    }
}

fn accepted<Q: Quantity>() -> String {
    format!(
        "accepted are {}, ranges A:B:STEP with A <= B and STEP > 0 or A:B:xFACTOR with 0 < A <= B and FACTOR > 1, and \
         several of these, separated by commas, at most {MOST_VALUES} values",
        Q::ACCEPTED
    )
}

fn value<Q: Quantity>(text: &str) -> Option<Q> {
    Q::named(text).or_else(|| text.parse().ok().map(Q::of_number))
}

/// Reads the values of one item of a list; the error says what is wrong with it.
fn item_values<Q: Quantity>(item: &str) -> Result<Vec<Q>, String> {
    let parts: Vec<&str> = item.split(':').collect();
    let [from, to, step] = parts[..] else {
        let value = value(item).filter(|_| parts.len() == 1);
        return value.map(|value| vec![value]).ok_or_else(|| match item {
            "" => "a value is missing".to_owned(),
            _ => "it is neither a value nor a range".to_owned(),
        });
    };
    let number = |part: &str| -> Result<f64, String> {
        let number = part.parse().map_err(|_| format!("`{part}` is no number"));
        number.and_then(|number: f64| match number.is_finite() {
            true => Ok(number),
            false => Err(format!("`{part}` is not finite")),
        })
    };
    let (from, to) = (number(from)?, number(to)?);
    if from > to {
        return Err(format!("{from} is above {to}"));
    }
    let values = match step.strip_prefix('x') {
        Some(factor) => equal_factors(from, to, number(factor)?)?,
        None => equal_steps(from, to, number(step)?)?,
    };
    match values.is_sorted_by(|left, right| left < right) {
        true => Ok(values.into_iter().map(Q::of_number).collect()),
        false => Err(format!("numbers near {to} do not differ by {step}")),
    }
}

/// Returns `from`, `from` + `step`, … up to `to`, which is included if it lies on the grid.
fn equal_steps(from: f64, to: f64, step: f64) -> Result<Vec<f64>, String> {
    if step <= 0.0 {
        return Err(format!("its step is {step}"));
    }
    // Precision to which the ends and the step are known.
    let last_digits = 1e-9_f64.max(f64::EPSILON * (from.abs() + to.abs()) / step);
    let count = further_values((to - from) / step + last_digits)?;
    let further = (1..=count).map(|index| rounded(from + step * f64::from(index), step));
    Ok(std::iter::once(from).chain(further).collect())
}

/// Returns `from`, `from` × `factor`, … up to `to`, which is included if it lies on the grid.
fn equal_factors(from: f64, to: f64, factor: f64) -> Result<Vec<f64>, String> {
    if factor <= 1.0 {
        return Err(format!("its factor is {factor}"));
    }
    if from <= 0.0 {
        return Err(format!("no factor leads on from {from}"));
    }
    let count = further_values(libm::log(to / from) / libm::log(factor) + 1e-9)?;
    let further = (1..=count).map(|index| {
        let value = from * libm::pow(factor, f64::from(index));
        let text = format!("{value:.*e}", DIGITS_OF_POWERS - 1);
        text.parse().unwrap_or(value)
    });
    Ok(std::iter::once(from).chain(further).collect())
}

/// Returns the whole number of values after the first, if it is below the limit.
fn further_values(count: f64) -> Result<u32, String> {
    let count = count.floor();
    match (0.0..MOST_VALUES as f64).contains(&count) {
        true => Ok(count as u32),
        false => Err(format!("it has more than {MOST_VALUES} values")),
    }
}

/// Rounds `value` to twelve decimals, or to as many as `step` has, without the round-off of the multiplication by the
/// step (0.1 + 2 × 0.1 is not 0.3).
fn rounded(value: f64, step: f64) -> f64 {
    const FEWEST: f64 = 12.0;
    let needed = (1.0 - libm::floor(libm::log10(step))).max(FEWEST);
    let text = format!("{value:.*}", needed.min(30.0) as usize);
    text.parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::options::{Friction, Stiffness};

    fn numbers(text: &str) -> Vec<f64> {
        let values = Values::<Friction>::parse(text).unwrap().0.into_iter();
        values.map(Friction::of_cylinders).collect()
    }

    fn stiffnesses(text: &str) -> Vec<f64> {
        let values = Values::<Stiffness>::parse(text).unwrap().0.into_iter();
        values.map(|value| value.0).collect()
    }

    #[test]
    fn values_of_a_range_are_different_or_refused() {
        assert_eq!(
            numbers("0.3:0.30000000000003:1e-14"),
            [0.3, 0.30000000000001, 0.30000000000002, 0.30000000000003]
        );
        for text in [
            "0.3:0.3000000000000003:1e-17",
            "0.3:0.3000000000000006:4e-17",
        ] {
            let message = Values::<Friction>::parse(text).unwrap_err();
            assert!(message.contains("A:B:STEP"), "{text}: {message}");
        }
    }

    #[test]
    fn a_range_includes_both_ends_without_rounding_debris() {
        assert_eq!(numbers("0.1:0.5:0.1"), [0.1, 0.2, 0.3, 0.4, 0.5]);
        assert_eq!(
            stiffnesses("46021474:46021475:1"),
            [46_021_474.0, 46_021_475.0]
        );
        assert_eq!(stiffnesses("1e2:1e6:x10"), [1e2, 1e3, 1e4, 1e5, 1e6]);
        assert_eq!(stiffnesses("0.1:0.9:x2"), [0.1, 0.2, 0.4, 0.8]);
        let half_decades = stiffnesses("1e2:1e4:x3.1622776601683795");
        assert_eq!(half_decades.len(), 5);
        assert_eq!((half_decades[2], half_decades[4]), (1e3, 1e4));
    }

    #[test]
    fn a_list_keeps_the_order_of_its_values_ranges_and_words() {
        let expected = [0.3, 0.1, 0.2, 2.0 - 3f64.sqrt()];
        let found = numbers("0.3, 0.1:0.3:0.1,critical,mu_c");
        assert_eq!(found.len(), expected.len());
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-15, "{found} {expected}");
        }
        assert_eq!(numbers("0.3"), [0.3]);
    }

    #[test]
    fn ranges_that_never_end_or_go_backwards_are_refused() {
        for text in [
            "0.1:0.5:0",
            "0.5:0.1:0.1",
            "0.1:0.5:-0.1",
            "0:1e9:1e-9",
            "a:b:c",
            "1:2",
            "1:2:3:4",
            "nan:1:1",
            "0:inf:1",
            "0:1:x2",
            "1:2:x1",
            "1:2:x",
            "1:2:x1.0000000001",
            "",
            "1,",
            "1,,2",
            "0:0.9:1e-4,1:1.9:1e-4",
        ] {
            let message = Values::<Friction>::parse(text).unwrap_err();
            assert!(message.contains("accepted are"), "{text}: {message}");
        }
    }

    #[test]
    fn a_command_for_one_stack_says_that_a_list_is_one_too_many() {
        assert_eq!(single::<Friction>("mu_c"), Ok(Friction::Critical));
        assert_eq!(single::<Stiffness>("1e2"), Ok(Stiffness(1e2)));
        for text in ["1e2,1e3", "1e2:1e3:x10"] {
            let message = single::<Stiffness>(text).unwrap_err();
            assert!(message.contains("takes one value"), "{text}: {message}");
        }
        let message = single::<Friction>("high").unwrap_err();
        assert!(message.contains("`critical`"), "{message}");
    }
}
