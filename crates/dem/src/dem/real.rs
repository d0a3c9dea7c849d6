//! The number types of the time stepping: doubles, double-doubles to measure rounding errors, or several doubles side
//! by side, each for one run.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub};

/// A real number, or one in each of several lanes. Every operation acts on each lane separately, with the same bits as
/// for a single number.
pub trait Real:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + MulAssign
{
    /// The lanes in which a condition holds.
    type Mask: Copy;

    /// Number of lanes.
    const LANES: usize;

    /// Returns `value` exactly, in every lane.
    fn like(self, value: f64) -> Self;
    /// Returns the square root.
    fn sqrt(self) -> Self;
    /// Returns the absolute value.
    fn abs(self) -> Self;
    /// Returns the lanes in which it is less than `other`.
    fn less(self, other: Self) -> Self::Mask;
    /// Returns `yes` where `mask` holds, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// Whether `mask` holds anywhere.
    fn any(self, mask: Self::Mask) -> bool;
    /// Whether `mask` holds everywhere.
    fn all(self, mask: Self::Mask) -> bool;
    /// Returns the number in one lane, to double precision.
    fn lane(self, lane: usize) -> f64;
    /// Copies one lane of `other`.
    fn set_lane(&mut self, lane: usize, other: Self);
    /// Executes `work`, compiled for the instruction set of these numbers.
    fn vectorize(self, work: impl Work);
}

/// A computation. Only code that is inlined into it is compiled for the instruction set of the numbers; other code
/// gives the same bits, but many times more slowly.
pub trait Work {
    /// Executes the computation; must always be inlined.
    fn carry_out(self);
}

impl Real for f64 {
    type Mask = bool;

    const LANES: usize = 1;

    #[inline(always)]
    fn like(self, value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::sqrt(self)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self::abs(self)
    }

    #[inline(always)]
    fn less(self, other: Self) -> bool {
        self < other
    }

    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }

    #[inline(always)]
    fn any(self, mask: bool) -> bool {
        mask
    }

    #[inline(always)]
    fn all(self, mask: bool) -> bool {
        mask
    }

    fn lane(self, _: usize) -> f64 {
        self
    }

    fn set_lane(&mut self, _: usize, other: Self) {
        *self = other;
    }

    #[inline(always)]
    fn vectorize(self, work: impl Work) {
        work.carry_out();
    }
}

/// A value that consists of a fixed sequence of real numbers.
pub trait Composite<R: Real>: Clone {
    /// Calls `visit` with every number and its counterpart in `other`.
    fn visit(&mut self, other: &Self, visit: &mut impl FnMut(&mut R, &R));

    /// Copies one lane of `other`.
    fn take_lane(&mut self, lane: usize, other: &Self) {
        self.visit(other, &mut |number, other| number.set_lane(lane, *other));
    }

    /// Returns its own numbers where `mask` holds, and those of `other` elsewhere.
    #[inline(always)]
    fn or_where_not(mut self, mask: R::Mask, other: &Self) -> Self {
        self.visit(other, &mut |number, other| {
            *number = R::select(mask, *number, *other)
        });
        self
    }
}

impl<R: Real> Composite<R> for R {
    #[inline(always)]
    fn visit(&mut self, other: &Self, visit: &mut impl FnMut(&mut R, &R)) {
        visit(self, other);
    }
}

impl<R: Real, C: Composite<R>> Composite<R> for Vec<C> {
    fn visit(&mut self, other: &Self, visit: &mut impl FnMut(&mut R, &R)) {
        for (own, other) in self.iter_mut().zip(other) {
            own.visit(other, visit);
        }
    }
}

/// Implements [`Composite`] for structs, given the fields that hold their numbers, and `beside` them the others: a field
/// that is in neither list does not compile.
macro_rules! composite {
    ($($name:ident { $($field:ident),* $(,)? } $(beside { $($other:ident),* $(,)? })?),* $(,)?) => {$(
        impl<R: $crate::dem::Real> $crate::dem::Composite<R> for $name<R> {
            #[inline(always)]
            fn visit(&mut self, other: &Self, visit: &mut impl FnMut(&mut R, &R)) {
                let Self { $($field,)* $($($other: _,)*)? } = self;
                $($field.visit(&other.$field, visit);)*
            }
        }
    )*};
}
pub(super) use composite;

impl<R: Real, C: Composite<R>, const N: usize> Composite<R> for [C; N] {
    #[inline(always)]
    fn visit(&mut self, other: &Self, visit: &mut impl FnMut(&mut R, &R)) {
        for (own, other) in self.iter_mut().zip(other) {
            own.visit(other, visit);
        }
    }
}
