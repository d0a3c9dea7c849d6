//! Several doubles side by side, in the vector registers of the machine.

use super::real::{Real, Work};
use pulp::bytemuck::{bytes_of, cast_slice, cast_slice_mut};
use pulp::{Simd, WithSimd};
use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub};
use std::slice::{from_mut, from_ref};

/// An instruction set, with the alignment at which its loads and stores are fastest. Those that cross a cache line
/// take twice as long, and delay later reads of the same address.
pub trait InstructionSet: Simd {
    /// A type with that alignment.
    type Alignment: Copy + Debug;
}

/// A type aligned like four doubles.
#[derive(Debug, Clone, Copy)]
#[repr(align(32))]
pub struct AlignedLikeFour;

/// A type aligned like eight doubles.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub struct AlignedLikeEight;

#[cfg(target_arch = "x86_64")]
impl InstructionSet for pulp::x86::V3 {
    type Alignment = AlignedLikeFour;
}

#[cfg(target_arch = "x86_64")]
impl InstructionSet for pulp::x86::V4 {
    type Alignment = AlignedLikeEight;
}

/// One double for each lane of the instruction set `S`. Products are never fused with sums, and square root and
/// quotient are those of IEEE 754, so that a lane has the same bits as a single double.
#[derive(Debug, Clone, Copy)]
pub struct Lanes<S: InstructionSet> {
    simd: S,
    values: S::f64s,
    _alignment: [S::Alignment; 0],
}

impl<S: InstructionSet> Lanes<S> {
    /// `value` in every lane.
    #[inline(always)]
    pub fn splat(simd: S, value: f64) -> Self {
        Self {
            simd,
            values: simd.splat_f64s(value),
            _alignment: [],
        }
    }

    #[inline(always)]
    fn with(self, values: S::f64s) -> Self {
        Self { values, ..self }
    }
}

macro_rules! operators {
    ($($operator:ident, $method:ident, $vector:ident;)*) => {$(
        impl<S: InstructionSet> $operator for Lanes<S> {
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

impl<S: InstructionSet> Neg for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.with(self.simd.neg_f64s(self.values))
    }
}

impl<S: InstructionSet> AddAssign for Lanes<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<S: InstructionSet> MulAssign for Lanes<S> {
    #[inline(always)]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl<S: InstructionSet> Real for Lanes<S> {
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

    #[inline(always)]
    fn all(self, mask: S::m64s) -> bool {
        let here = self.simd.not_m64s(mask);
        !self.any(here)
    }

    fn lane(self, lane: usize) -> f64 {
        cast_slice::<_, f64>(from_ref(&self.values))[lane]
    }

    fn set_lane(&mut self, lane: usize, other: Self) {
        cast_slice_mut::<_, f64>(from_mut(&mut self.values))[lane] = other.lane(lane);
    }

    #[inline(always)]
    fn vectorize(self, work: impl Work) {
        self.simd.vectorize(Vectorized(work));
    }
}

struct Vectorized<W>(W);

impl<W: Work> WithSimd for Vectorized<W> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.0.carry_out();
    }
}

/// Two doubles, for machines without a known instruction set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair([f64; 2]);

macro_rules! pair_operators {
    ($($operator:ident, $method:ident, $sign:tt;)*) => {$(
        impl $operator for Pair {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self([self.0[0] $sign other.0[0], self.0[1] $sign other.0[1]])
            }
        }
    )*};
}

pair_operators! {
    Add, add, +;
    Sub, sub, -;
    Mul, mul, *;
    Div, div, /;
}

impl Neg for Pair {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self([-self.0[0], -self.0[1]])
    }
}

impl AddAssign for Pair {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl MulAssign for Pair {
    #[inline(always)]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl Pair {
    /// `value` in both lanes.
    #[inline(always)]
    pub fn splat(value: f64) -> Self {
        Self([value; 2])
    }
}

impl Real for Pair {
    type Mask = [bool; 2];

    const LANES: usize = 2;

    #[inline(always)]
    fn like(self, value: f64) -> Self {
        Self::splat(value)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self([self.0[0].sqrt(), self.0[1].sqrt()])
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self([self.0[0].abs(), self.0[1].abs()])
    }

    #[inline(always)]
    fn less(self, other: Self) -> [bool; 2] {
        [self.0[0] < other.0[0], self.0[1] < other.0[1]]
    }

    #[inline(always)]
    fn select(mask: [bool; 2], yes: Self, no: Self) -> Self {
        let pick = |lane: usize| if mask[lane] { yes.0[lane] } else { no.0[lane] };
        Self([pick(0), pick(1)])
    }

    #[inline(always)]
    fn any(self, mask: [bool; 2]) -> bool {
        mask[0] | mask[1]
    }

    #[inline(always)]
    fn all(self, mask: [bool; 2]) -> bool {
        mask[0] & mask[1]
    }

    fn lane(self, lane: usize) -> f64 {
        self.0[lane]
    }

    fn set_lane(&mut self, lane: usize, other: Self) {
        self.0[lane] = other.0[lane];
    }

    #[inline(always)]
    fn vectorize(self, work: impl Work) {
        work.carry_out();
    }
}
