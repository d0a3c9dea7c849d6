//! An axis: what it measures, from where to where.

use kuva::render::layout::TickFormat;
use std::sync::Arc;

/// Lowest value on a logarithmic axis of kuva.
const LOWEST: f64 = 1e-10;

/// What an axis measures, and from where to where.
#[derive(Debug, Clone)]
pub(super) struct Axis {
    /// Symbol and unit.
    pub label: String,
    /// Lowest and highest value.
    pub range: (f64, f64),
    /// Where its ticks are.
    pub scale: Scale,
}

/// Where the ticks of an axis are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Scale {
    /// At multiples of a step, printed with so many decimals.
    Linear(f64, usize),
    /// At powers of ten.
    Log,
    /// Nowhere.
    Bare,
}

impl Axis {
    /// An axis with a tick at every multiple of `step`, with `decimals` digits after the point.
    pub fn linear(label: &str, range: (f64, f64), step: f64, decimals: usize) -> Self {
        Self {
            label: label.to_owned(),
            range,
            scale: Scale::Linear(step, decimals),
        }
    }

    /// An axis around `range` with five ticks or so.
    pub fn around(label: &str, range: (f64, f64)) -> Self {
        let span = range.1 - range.0;
        let rough = if span > 0.0 { span / 5.0 } else { 1.0 };
        let power = libm::exp10(libm::floor(libm::log10(rough)));
        let steps = [1.0, 2.0, 5.0, 10.0].map(|multiple| multiple * power);
        let step = steps.into_iter().find(|&step| step >= 0.8 * rough);
        let step = step.unwrap_or(rough);
        let decimals = (-libm::floor(libm::log10(step) + 1e-9)).clamp(0.0, 9.0);
        Self::linear(label, range, step, decimals as usize)
    }

    /// An axis with a tick at every power of ten. It begins at 1e-10 at the lowest, as those of kuva do.
    pub fn log(label: &str, (low, high): (f64, f64)) -> Self {
        Self {
            label: label.to_owned(),
            range: (low.max(LOWEST), high),
            scale: Scale::Log,
        }
    }

    /// An axis of things that are named elsewhere, one at each whole number from 1 on.
    pub fn bare(range: (f64, f64)) -> Self {
        Self {
            label: String::new(),
            range,
            scale: Scale::Bare,
        }
    }

    /// The floor friction, over the range of Fig. 2(a).
    pub fn friction() -> Self {
        Self::linear("floor friction μ", (0.08, 0.52), 0.1, 1)
    }

    /// Where `value` lies: 0 at the lower end, 1 at the upper end.
    pub fn part(&self, value: f64) -> f64 {
        let (low, high) = self.range;
        match self.scale {
            Scale::Linear(..) | Scale::Bare => (value - low) / (high - low),
            Scale::Log => libm::log(value / low) / libm::log(high / low),
        }
    }

    /// The value that lies at `part`.
    pub fn at(&self, part: f64) -> f64 {
        let (low, high) = self.range;
        match self.scale {
            Scale::Linear(..) | Scale::Bare => low + part * (high - low),
            Scale::Log => low * libm::exp(part * libm::log(high / low)),
        }
    }

    /// Whether `value` is on it. Not so if it is not a number.
    pub fn contains(&self, value: f64) -> bool {
        (self.range.0..=self.range.1).contains(&value)
    }

    /// How its ticks are printed.
    pub fn ticks(&self) -> TickFormat {
        match self.scale {
            Scale::Linear(_, decimals) => {
                let print = move |value: f64| format!("{value:.decimals$}").replace('-', "−");
                TickFormat::Custom(Arc::new(print))
            }
            Scale::Log => TickFormat::Custom(Arc::new(power_of_ten)),
            Scale::Bare => TickFormat::Custom(Arc::new(|_| String::new())),
        }
    }
}

/// `value` as a power of ten with the exponent raised; nothing for the values between.
pub(super) fn power_of_ten(value: f64) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let exponent = libm::log10(value);
    if !exponent.is_finite() || (exponent - exponent.round()).abs() > 1e-6 {
        return String::new();
    }
    let digits = format!("{}", exponent.round() as i32);
    let raise = |digit: char| match digit.to_digit(10) {
        Some(digit) => RAISED[digit as usize],
        None => '⁻',
    };
    format!("10{}", digits.chars().map(raise).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_ten_are_printed_as_such_and_others_not_at_all() {
        assert_eq!(power_of_ten(1e4), "10⁴");
        assert_eq!(power_of_ten(1.0), "10⁰");
        assert_eq!(power_of_ten(1e-10), "10⁻¹⁰");
        assert_eq!(power_of_ten(200.0), "");
        assert_eq!(power_of_ten(0.0), "");
    }

    #[test]
    fn a_value_lies_at_its_part_of_the_axis() {
        assert_eq!(Axis::linear("x", (1.0, 3.0), 1.0, 0).part(2.5), 0.75);
        assert!((Axis::log("x", (1e-2, 1e2)).part(10.0) - 0.75).abs() < 1e-15);
        assert!(!Axis::log("x", (1e-2, 1e2)).contains(f64::NAN));
    }
}
