//! Parses numbers on the command line; errors say what is accepted.

use std::ops::RangeInclusive;

/// Reads a finite number. The model checks its range.
pub(in crate::cli) fn number(text: &str) -> Result<f64, String> {
    let number: Option<f64> = text.trim().parse().ok();
    let number = number.filter(|number| number.is_finite());
    number.ok_or_else(|| "accepted is a finite number, such as 0.5 or 1e-3".to_owned())
}

/// Reads a finite number above zero.
pub(in crate::cli) fn positive(text: &str) -> Result<f64, String> {
    let number = number(text).ok().filter(|number| *number > 0.0);
    number.ok_or_else(|| "accepted is a number above 0, such as 0.5 or 1e-3".to_owned())
}

/// Reads a duration in seconds.
pub(in crate::cli) fn seconds(text: &str) -> Result<f64, String> {
    let seconds = number(text).ok().filter(|seconds| *seconds > 0.0);
    seconds.ok_or_else(|| "accepted is a number of seconds above 0".to_owned())
}

/// Reads a whole number in `range`.
pub(in crate::cli) fn whole<T>(
    range: RangeInclusive<u16>,
) -> impl Fn(&str) -> Result<T, String> + Clone + Send + Sync + 'static
where
    T: TryFrom<u16>,
{
    move |text| {
        let number: Option<u16> = text.trim().parse().ok();
        let number = number.filter(|number| range.contains(number));
        number
            .and_then(|number| T::try_from(number).ok())
            .ok_or_else(|| {
                let (lowest, highest) = (range.start(), range.end());
                format!("accepted is a whole number from {lowest} to {highest}")
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_finite() {
        assert_eq!(number("-1e-3"), Ok(-1e-3));
        for text in ["", "high", "nan", "inf", "1e999", "1,5"] {
            let message = number(text).unwrap_err();
            assert!(message.starts_with("accepted is a finite number"), "{text}");
        }
    }

    #[test]
    fn whole_numbers_lie_in_their_range() {
        let small = whole::<u8>(2..=5);
        assert_eq!(small("2"), Ok(2));
        for text in ["1", "6", "300", "-2", "2.0", "two"] {
            let message = small(text).unwrap_err();
            assert_eq!(message, "accepted is a whole number from 2 to 5", "{text}");
        }
    }
}
