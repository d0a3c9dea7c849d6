//! The number of digits with which a code has printed a series, inferred from its numbers.

use super::column::Column;
use super::sample::{ANGLE, FORCE, LENGTH, Sample};
use serde::{Deserialize, Serialize};

/// Rounding of the largest coordinate of the stack, 1 + √3.
pub(super) const COORDINATE: f64 = 3.0 * f64::EPSILON;
/// Number of digits at which rounding is far below every tolerance for micro-tests and trajectories.
pub const ENOUGH_DIGITS: u32 = 13;
/// Number of digits that reproduce any double exactly.
pub const EXACT_DIGITS: u32 = 17;
/// Decimal digits of single precision.
const SINGLE_DIGITS: u32 = 7;
/// The distance of neighbouring numbers of 32 bits between 2 and 4, as the largest coordinates are, in r.
pub(super) const SINGLE_COORDINATE: f64 = 2.0 * f32::EPSILON as f64;
/// Shortest step of the wall, in r, at which positions in single precision round at random: a body that moves by a tenth of
/// it still moves by some twenty units in the last place.
pub const STEP_IN_SINGLE_PRECISION: f64 = 256.0 * SINGLE_COORDINATE;
/// Fewest numbers of a column with more digits than [`TELLING_DIGITS`] that show that it is in single precision.
pub const TELLING: usize = 20;
/// Digits that a number in single precision shows at least, unless it is a short one.
pub const TELLING_DIGITS: u32 = 6;
/// Roundings of a balance of forces in single precision, in those of the forces that are reported: the ones between cylinders,
/// which are not, are rounded too.
const ROUNDED_FORCES: f64 = 3.0;
/// Rows after the peak from which the friction is read.
const ROWS_AFTER_PEAK: usize = 4;
/// The force columns, on which the yield force depends.
fn forces() -> impl Iterator<Item = &'static Column<Sample>> {
    Sample::EVERY.iter().filter(|column| column.unit == FORCE)
}

fn coordinates() -> impl Iterator<Item = &'static Column<Sample>> {
    let moved = [LENGTH, ANGLE];
    let columns = Sample::EVERY.iter();
    columns.filter(move |column| moved.contains(&column.unit))
}

/// Largest rounding of the numbers of a series, in its own units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rounding {
    /// Rounding error of a coordinate in the rows.
    pub(super) coordinate: f64,
    /// Rounding error of a coordinate in every step.
    pub(super) step: f64,
    /// Rounding error of a force.
    pub(super) force: f64,
}

impl Rounding {
    /// That of double precision.
    pub(super) const DOUBLE: Self = Self {
        coordinate: COORDINATE,
        step: COORDINATE,
        force: 0.0,
    };

    /// Whether coordinates are numbers of 32 bits.
    pub(super) fn has_single_positions(&self) -> bool {
        self.step > Self::DOUBLE.step
    }

    /// Infers the rounding errors in `samples`: those of double or single precision, or those of printing.
    pub(super) fn read(samples: &[Sample]) -> Self {
        let half_unit = |column: &'static Column<Sample>| {
            let printed = precision(samples.iter().map(column.value));
            printed.map_or(0.0, |printed| printed.half_unit)
        };
        let mut lengths = coordinates().filter(|column| column.unit == LENGTH);
        let is_single = lengths.any(|column| is_single(samples.iter().map(column.value)));
        Self {
            coordinate: coordinates()
                .map(half_unit)
                .fold(Self::DOUBLE.coordinate, f64::max),
            step: match is_single {
                true => SINGLE_COORDINATE,
                false => Self::DOUBLE.step,
            },
            force: forces().map(half_unit).fold(0.0, f64::max),
        }
    }
}

/// The precision of a series that was printed with fewer digits than its numbers have.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PrintedDigits {
    /// Significant digits of the largest numbers, in the coarsest column that matters.
    pub digits: u32,
    /// Significant digits of the largest numbers in the finest of these columns; 17 if one has all digits.
    pub finest: u32,
    /// Half a unit in the last place of these numbers, in m g; the largest over all columns that matter.
    pub half_unit: f64,
    /// Whether a column has numbers of 32 bits, in whatever digits they are printed.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub single: bool,
}

impl PrintedDigits {
    const IN_FULL: Self = Self {
        digits: EXACT_DIGITS,
        finest: EXACT_DIGITS,
        half_unit: 0.0,
        single: false,
    };

    /// Infers the digits of `samples`, with forces in units of k_n r, which is `stiffness` m g; `None` if every column
    /// that matters has all digits.
    ///
    /// A column is taken to be printed with as many digits as its longest number, since trailing zeros of others may
    /// be cut off. For the largest numbers of a column, fixed decimals are the same as significant digits, and it is
    /// the last place of these numbers that counts.
    pub(super) fn read(samples: &[Sample], stiffness: f64) -> Option<Self> {
        let force = |index: &usize| samples[*index].wall_force;
        let peak = (0..samples.len()).max_by(|i, j| force(i).total_cmp(&force(j)))?;
        let end = samples.len().min(peak + ROWS_AFTER_PEAK + 1);
        let columns =
            forces().filter_map(|column| precision(samples[..end].iter().map(column.value)));
        let coarsest = columns.reduce(|left, right| Self {
            digits: left.digits.min(right.digits),
            finest: left.finest.max(right.finest),
            half_unit: left.half_unit.max(right.half_unit),
            single: left.single || right.single,
        })?;
        (coarsest.digits < EXACT_DIGITS).then_some(Self {
            half_unit: coarsest.half_unit * stiffness,
            ..coarsest
        })
    }
}

/// Returns the number of significant digits of the longest of `values`, at most those that reproduce every number.
pub fn most_digits(values: impl Iterator<Item = f64>) -> u32 {
    let mut most = 0;
    for value in values.filter(|value| *value != 0.0) {
        most = most.max(decimal(value).0);
        if most >= EXACT_DIGITS {
            break;
        }
    }
    most
}

/// Whether a number is one of single precision.
pub fn is_of_32_bits(value: f64) -> bool {
    f64::from(value as f32) == value
}

/// Whether a column holds numbers of 32 bits. One of them, the first, may be given by the task.
fn is_single(values: impl Iterator<Item = f64>) -> bool {
    let mut telling = 0;
    for value in values.skip(1).filter(|value| value.is_finite()) {
        if !is_of_32_bits(value) {
            return false;
        }
        // A short number is the same with 32 bits.
        telling += usize::from(telling < TELLING && decimal(value).0 > TELLING_DIGITS);
    }
    telling == TELLING
}

/// Returns the precision of a column; `None` if it holds nothing but zeros and NaN.
fn precision(values: impl Iterator<Item = f64> + Clone) -> Option<PrintedDigits> {
    if is_single(values.clone()) {
        let finite = values.filter(|value| value.is_finite());
        let largest = finite.map(f64::abs).fold(0.0, f64::max);
        return Some(PrintedDigits {
            digits: SINGLE_DIGITS,
            finest: SINGLE_DIGITS,
            half_unit: ROUNDED_FORCES * 0.5 * f64::from(f32::EPSILON) * largest,
            single: true,
        });
    }
    let (mut digits, mut highest) = (0, i32::MIN);
    // A value that is not reported is NaN.
    for value in values.filter(|value| *value != 0.0 && !value.is_nan()) {
        let (own, exponent) = decimal(value);
        if own >= EXACT_DIGITS {
            return Some(PrintedDigits::IN_FULL);
        }
        digits = digits.max(own);
        highest = highest.max(exponent);
    }
    let last_place = highest.checked_sub(digits as i32 - 1)?;
    (digits > 0).then(|| PrintedDigits {
        digits,
        finest: digits,
        half_unit: 0.5 * libm::exp10(f64::from(last_place)),
        single: false,
    })
}

/// Returns the number of significant digits of the shortest decimal that reproduces `value`, and the exponent of the
/// first digit.
pub fn decimal(value: f64) -> (u32, i32) {
    let text = format!("{value:e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let digits = mantissa.chars().filter(char::is_ascii_digit).count();
    (digits as u32, exponent.parse().unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn printed(print: impl Fn(f64) -> String) -> Option<PrintedDigits> {
        let values = (1..400).map(|row| f64::from(row) * 0.001 * std::f64::consts::E);
        precision(values.map(|value| print(value).parse().expect("a number")))
    }

    #[test]
    fn numbers_in_full_have_no_precision_of_their_own() {
        for in_full in [
            printed(|value| format!("{value:.16e}")),
            printed(|value| format!("{value}")),
        ] {
            assert_eq!(in_full, Some(PrintedDigits::IN_FULL));
        }
        assert_eq!(precision([0.0, 0.0].into_iter()), None);
    }

    #[test]
    fn significant_digits_are_counted_though_zeros_at_the_end_are_cut() {
        // The largest number is 1.08...: its sixth digit is that of 1e-5.
        for print in [
            |value| format!("{value:.5e}"),
            |value| {
                let text = format!("{value:.5e}");
                let (mantissa, exponent) = text.split_once('e').expect("an exponent");
                format!("{}e{exponent}", mantissa.trim_end_matches('0'))
            },
        ] {
            let printed = printed(print).expect("fewer digits");
            assert_eq!(printed.digits, 6);
            assert!((printed.half_unit / 0.5e-5 - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn numbers_of_32_bits_are_known_from_all_their_digits() {
        let values = (1..400).map(|row| f64::from(row) * 0.001 * std::f64::consts::E);
        let single = values.clone().map(|value| f64::from(value as f32));
        let printed = precision(single.clone()).expect("numbers");
        assert!(printed.single && printed.digits == SINGLE_DIGITS);
        assert!(
            (printed.half_unit / (1.085 * ROUNDED_FORCES * 0.5 * f64::from(f32::EPSILON)) - 1.0)
                .abs()
                < 1e-3
        );
        // Short numbers, and columns of both kinds, are none.
        assert!(!is_single((1..400).map(|row| f64::from(row) / 16.0)));
        assert!(!is_single(single.chain(values)));
    }

    #[test]
    fn fixed_decimals_have_the_digits_of_the_largest_number() {
        let printed = printed(|value| format!("{value:.6}")).expect("fewer digits");
        assert_eq!(printed.digits, 7);
        assert!((printed.half_unit / 0.5e-6 - 1.0).abs() < 1e-12);
    }
}
