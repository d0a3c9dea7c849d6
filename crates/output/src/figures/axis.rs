//! An axis: label, range, ticks.

/// An axis of a panel.
#[derive(Debug, Clone)]
pub(super) struct Axis {
    /// Symbol and unit.
    pub label: String,
    /// Lowest and highest value.
    pub range: (f64, f64),
    /// Its ticks.
    pub scale: Scale,
}

/// The ticks of an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Scale {
    /// At multiples of a step, printed with this number of decimals.
    Linear(f64, usize),
    /// At powers of ten and, on short axes, at 2 and 5 times these.
    Log,
    /// No ticks.
    Bare,
}

impl Axis {
    fn new(label: &str, range: (f64, f64), scale: Scale) -> Self {
        Self {
            label: label.to_owned(),
            range,
            scale,
        }
    }

    /// An axis with a tick at every multiple of `step`, with `decimals` digits after the point.
    pub fn linear(label: &str, range: (f64, f64), step: f64, decimals: usize) -> Self {
        Self::new(label, range, Scale::Linear(step, decimals))
    }

    /// An axis over `range` with about five ticks.
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

    /// A logarithmic axis.
    pub fn log(label: &str, range: (f64, f64)) -> Self {
        Self::new(label, range, Scale::Log)
    }

    /// An axis without ticks, for things named elsewhere, one at each whole number from 1 on.
    pub fn bare(range: (f64, f64)) -> Self {
        Self::new("", range, Scale::Bare)
    }

    /// An axis of the floor friction, over the range of Fig. 2(a).
    pub fn friction() -> Self {
        Self::linear("floor friction μ", (0.08, 0.52), 0.1, 1)
    }

    /// Returns the position of `value`: 0 at the lower end, 1 at the upper end.
    pub fn part(&self, value: f64) -> f64 {
        let (low, high) = self.range;
        match self.scale {
            Scale::Linear(..) | Scale::Bare => (value - low) / (high - low),
            Scale::Log => libm::log(value / low) / libm::log(high / low),
        }
    }

    /// Returns the value at the position `part`.
    pub fn at(&self, part: f64) -> f64 {
        let (low, high) = self.range;
        match self.scale {
            Scale::Linear(..) | Scale::Bare => low + part * (high - low),
            Scale::Log => low * libm::exp(part * libm::log(high / low)),
        }
    }

    /// Whether `value` is on the axis; false for NaN.
    pub fn contains(&self, value: f64) -> bool {
        (self.range.0..=self.range.1).contains(&value)
    }

    /// Limits `value` to the range of the axis.
    pub fn clamp(&self, value: f64) -> f64 {
        value.clamp(self.range.0, self.range.1)
    }

    /// Returns the ticks on the axis with their labels.
    pub fn ticks(&self) -> Vec<(f64, String)> {
        let (low, high) = self.range;
        let log_range = (libm::log10(low).floor(), libm::log10(high));
        let ticks: Vec<(f64, String)> = match self.scale {
            Scale::Linear(step, decimals) => multiples(self.range, step)
                .map(|index| index as f64 * step)
                .map(|tick| (tick, format!("{tick:.decimals$}").replace('-', "−")))
                .collect(),
            Scale::Log if high / low > SHORT => multiples(log_range, 1.0)
                .map(|exponent| scientific(1, exponent))
                .map(|tick| (tick, power_of_ten(tick)))
                .collect(),
            Scale::Log => multiples(log_range, 1.0)
                .flat_map(|exponent| [1, 2, 5].map(|digit| scientific(digit, exponent)))
                .map(|tick| (tick, tick.to_string()))
                .collect(),
            Scale::Bare => Vec::new(),
        };
        let on_axis = |tick: &(f64, String)| (-SLACK..=1.0 + SLACK).contains(&self.part(tick.0));
        ticks.into_iter().filter(on_axis).collect()
    }
}

/// A logarithmic axis whose ends differ by less than this factor is short.
const SHORT: f64 = 1e3;
/// Largest distance of a tick beyond the end of its axis by round-off, relative to the axis.
const SLACK: f64 = 1e-9;

/// Returns the integers whose multiples of `step` are in the range.
fn multiples((low, high): (f64, f64), step: f64) -> impl Iterator<Item = i64> {
    let slack = SLACK * (high - low).abs();
    let first = ((low - slack) / step).ceil() as i64;
    first..=((high + slack) / step).floor() as i64
}

/// Returns the double nearest to `digit` times ten to the `exponent`, which the product of two doubles may miss.
fn scientific(digit: u8, exponent: i64) -> f64 {
    format!("{digit}e{exponent}").parse().unwrap_or(f64::NAN)
}

/// Formats `value` as a power of ten with raised exponent; empty for any other value.
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
    fn ticks_are_on_the_axis_and_printed() {
        let printed = |axis: Axis| -> Vec<String> {
            axis.ticks().into_iter().map(|(_, text)| text).collect()
        };
        let linear = Axis::linear("x", (-0.2, 0.3), 0.1, 1);
        assert_eq!(
            printed(linear),
            ["−0.2", "−0.1", "0.0", "0.1", "0.2", "0.3"]
        );
        assert_eq!(
            printed(Axis::log("x", (1e-2, 3e2))),
            ["10⁻²", "10⁻¹", "10⁰", "10¹", "10²"]
        );
        let few = Axis::log("x", (0.2, 20.0));
        assert_eq!(printed(few), ["0.2", "0.5", "1", "2", "5", "10", "20"]);
        assert!(printed(Axis::bare((0.0, 3.0))).is_empty());
    }

    #[test]
    fn a_value_lies_at_its_part_of_the_axis() {
        assert_eq!(Axis::linear("x", (1.0, 3.0), 1.0, 0).part(2.5), 0.75);
        assert!((Axis::log("x", (1e-2, 1e2)).part(10.0) - 0.75).abs() < 1e-15);
        assert!(!Axis::log("x", (1e-2, 1e2)).contains(f64::NAN));
    }
}
