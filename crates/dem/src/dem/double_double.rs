//! Double-double arithmetic with 106 bits, to measure the rounding errors of doubles.

use super::real::{Real, Work};
use num_traits::Float;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub};
use twofloat::TwoFloat;

/// A number of 106 bits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DoubleDouble(TwoFloat);

impl DoubleDouble {
    /// `value` exactly.
    pub fn new(value: f64) -> Self {
        Self(value.into())
    }
}

macro_rules! operators {
    ($($operator:ident, $method:ident, $sign:tt;)*) => {$(
        impl $operator for DoubleDouble {
            type Output = Self;

            fn $method(self, other: Self) -> Self {
                Self(self.0 $sign other.0)
            }
        }
    )*};
}

operators! {
    Add, add, +;
    Sub, sub, -;
    Mul, mul, *;
}

impl Div for DoubleDouble {
    type Output = Self;

    /// A quotient in twofloat 0.8 has 53 bits; two divisions of the remainder supply the others.
    fn div(self, other: Self) -> Self {
        let rough = TwoFloat::from(self.0.hi() / other.0.hi());
        let remainder = self.0 - rough * other.0;
        let better = rough + remainder.hi() / other.0.hi();
        let remainder = self.0 - better * other.0;
        Self(better + remainder.hi() / other.0.hi())
    }
}

impl Neg for DoubleDouble {
    type Output = Self;

    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl AddAssign for DoubleDouble {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl MulAssign for DoubleDouble {
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl Real for DoubleDouble {
    type Mask = bool;

    const LANES: usize = 1;

    fn like(self, value: f64) -> Self {
        Self::new(value)
    }

    fn sqrt(self) -> Self {
        Self(Float::sqrt(self.0))
    }

    fn abs(self) -> Self {
        Self(Float::abs(self.0))
    }

    fn less(self, other: Self) -> bool {
        self.0 < other.0
    }

    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }

    fn any(self, mask: bool) -> bool {
        mask
    }

    fn all(self, mask: bool) -> bool {
        mask
    }

    fn lane(self, _: usize) -> f64 {
        self.0.into()
    }

    fn set_lane(&mut self, _: usize, other: Self) {
        *self = other;
    }

    fn vectorize(self, work: impl Work) {
        work.carry_out();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotients_and_roots_have_all_digits() {
        for (numerator, denominator) in [(2.0, 3.0), (1.0, 7.0), (0.1, 0.3), (-5.0, 1e-3)] {
            let [n, d] = [numerator, denominator].map(DoubleDouble::new);
            let quotient = n / d;
            let missing = (n - quotient * d) / n;
            assert!(missing.lane(0).abs() < 1e-31, "{numerator} / {denominator}");
        }
        for square in [2.0, 3.0, 0.7] {
            let root = DoubleDouble::new(square).sqrt();
            let missing = root * root - DoubleDouble::new(square);
            assert!(missing.lane(0).abs() < 1e-30 * square, "{square}");
        }
    }
}
