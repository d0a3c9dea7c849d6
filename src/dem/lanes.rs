//! Several doubles side by side, in the vector registers of the machine.

use super::real::Real;
use pulp::{Simd, WithSimd};
use pulp::bytemuck::{bytes_of, cast_slice, cast_slice_mut};
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub};
use std::slice::{from_mut, from_ref};

/// One double for each lane of the instruction set `S`. Products are never fused with sums, and root and
/// quotient are those of IEEE 754, so that a lane holds the same bits as a double of its own.
#[derive(Debug, Clone, Copy)]
pub struct Lanes<S: Simd> {
    simd: S,
    values: S::f64s,
}

impl<S: Simd> Lanes<S> {
    /// `value` in every lane.
    #[inline(always)]
    pub fn splat(simd: S, value: f64) -> Self {
        let values = simd.splat_f64s(value);
        Self { simd, values }
    }

    #[inline(always)]
    fn with(self, values: S::f64s) -> Self {
        let simd = self.simd;
        Self { simd, values }
    }
}

macro_rules! operators {
    ($($operator:ident, $method:ident, $vector:ident;)*) => {$(
        impl<S: Simd> $operator for Lanes<S> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.with(self.simd.$vector(self.values, other.values))
            }
        }
    )*};
}

operators! {
    Add, add, add_f64s;
    Sub, sub, sub_f64s;
    Mul, mul, mul_f64s;
    Div, div, div_f64s;
}

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.with(self.simd.neg_f64s(self.values))
    }
}

impl<S: Simd> AddAssign for Lanes<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<S: Simd> MulAssign for Lanes<S> {
    #[inline(always)]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl<S: Simd> Real for Lanes<S> {
    type Mask = S::m64s;

    const LANES: usize = S::F64_LANES;

    #[inline(always)]
    fn like(self, value: f64) -> Self {
        Self::splat(self.simd, value)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.with(self.simd.sqrt_f64s(self.values))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.with(self.simd.abs_f64s(self.values))
    }

    #[inline(always)]
    fn less(self, other: Self) -> S::m64s {
        self.simd.less_than_f64s(self.values, other.values)
    }

    #[inline(always)]
    fn select(mask: S::m64s, yes: Self, no: Self) -> Self {
        yes.with(yes.simd.select_f64s(mask, yes.values, no.values))
    }

    #[inline(always)]
    fn any(self, mask: S::m64s) -> bool {
        bytes_of(&mask).iter().fold(0, |all, byte| all | byte) != 0
    }

    fn lane(self, lane: usize) -> f64 {
        cast_slice::<_, f64>(from_ref(&self.values))[lane]
    }

    fn set_lane(&mut self, lane: usize, other: Self) {
        cast_slice_mut::<_, f64>(from_mut(&mut self.values))[lane] = other.lane(lane);
    }

    #[inline(always)]
    fn vectorize<T>(self, work: impl FnOnce() -> T) -> T {
        self.simd.vectorize(Work(work))
    }
}

struct Work<F>(F);

impl<T, F: FnOnce() -> T> WithSimd for Work<F> {
    type Output = T;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> T {
        (self.0)()
    }
}
