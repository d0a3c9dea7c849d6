//! One bracketing root finder, exact to the last few units of the argument.

const MOST_ITERATIONS: usize = 400;

/// Returns a root of `function` between `low` and `high`, where its signs must be opposite (or a value must be zero).
///
/// Chandrupatla's method (Advances in Engineering Software 28 (1997) 145): inverse quadratic
/// interpolation where it is safe, bisection elsewhere. It converges in the argument's own relative
/// precision, so a root near zero is found to as many digits as any other. `None` without a change of
/// sign, or where the function is not a number.
pub fn bracketed_root(function: impl Fn(f64) -> f64, low: f64, high: f64) -> Option<f64> {
    let (mut x1, mut x2) = (high, low);
    let (mut f1, mut f2) = (function(x1), function(x2));
    let opposite = (f1 <= 0.0 && f2 >= 0.0) || (f1 >= 0.0 && f2 <= 0.0);
    if !opposite {
        return None;
    }
    // Without this return, the sign of the zero would decide on which side the search continues.
    if f1 == 0.0 {
        return Some(high);
    }
    let mut fraction = 0.5;
    for _ in 0..MOST_ITERATIONS {
        let x = x1 + fraction * (x2 - x1);
        let f = function(x);
        if f.is_nan() {
            return None;
        }
        let (x3, f3);
        if (f > 0.0) == (f1 > 0.0) {
            (x3, f3) = (x1, f1);
        } else {
            (x3, f3) = (x2, f2);
            (x2, f2) = (x1, f1);
        }
        (x1, f1) = (x, f);
        let (best, value) = if f1.abs() < f2.abs() {
            (x1, f1)
        } else {
            (x2, f2)
        };
        let smallest = 2.0 * f64::EPSILON * best.abs() / (x2 - x1).abs();
        if value == 0.0 || smallest > 0.5 {
            return Some(best);
        }
        fraction = next_fraction([x1, x2, x3], [f1, f2, f3]).clamp(smallest, 1.0 - smallest);
    }
    None
}

/// Returns the argument of the only maximum of `function` between `low` and `high`, by golden sections. The error of
/// the maximum is of second order in the width that is left.
pub(super) fn maximum_between(function: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    const SECTIONS: usize = 40;
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    for _ in 0..SECTIONS {
        let width = golden * (high - low);
        if function(high - width) < function(low + width) {
            low = high - width;
        } else {
            high = low + width;
        }
    }
    0.5 * (low + high)
}

/// Returns the next argument to try, as a fraction of the way from x1 to x2.
fn next_fraction([x1, x2, x3]: [f64; 3], [f1, f2, f3]: [f64; 3]) -> f64 {
    let position = (x1 - x2) / (x3 - x2);
    let height = (f1 - f2) / (f3 - f2);
    let monotonic = height * height < position && (1.0 - height) * (1.0 - height) < 1.0 - position;
    if !monotonic {
        return 0.5;
    }
    f1 / (f2 - f1) * f3 / (f2 - f3) + (x3 - x1) / (x2 - x1) * f1 / (f3 - f1) * f2 / (f3 - f2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_a_tiny_root_to_all_digits() {
        let root = bracketed_root(|x| x * (1.0 + x) - 1e-9, 0.0, 1.0).unwrap();
        let exact = 2e-9 / (1.0 + (1.0 + 4e-9f64).sqrt());
        assert!((root - exact).abs() <= 4e-16 * exact);
    }

    #[test]
    fn no_change_of_sign_is_no_root() {
        assert_eq!(bracketed_root(|x| x * x + 1.0, -1.0, 1.0), None);
        assert_eq!(bracketed_root(|_| f64::NAN, -1.0, 1.0), None);
    }

    #[test]
    fn an_end_may_be_the_root() {
        for sign in [1.0, -1.0] {
            assert_eq!(bracketed_root(|x| sign * x, 0.0, 1.0), Some(0.0));
            assert_eq!(bracketed_root(|x| sign * (x - 1.0), 0.0, 1.0), Some(1.0));
        }
    }

    #[test]
    fn a_function_of_one_sign_has_no_root_however_it_slopes() {
        for (sign, slope) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            let function = |x: f64| sign * (2.0 + slope * x);
            assert_eq!(bracketed_root(function, -1.0, 1.0), None);
        }
    }

    #[test]
    fn a_function_that_is_lost_on_the_way_has_no_root() {
        let lost = |x: f64| if x.abs() < 0.5 { f64::NAN } else { x };
        assert_eq!(bracketed_root(lost, -1.0, 1.0), None);
    }

    /// Returns the root of `function` in (0, 1) and the number of evaluations.
    fn counted(function: impl Fn(f64) -> f64) -> (f64, usize) {
        let asked = std::cell::Cell::new(0);
        let counting = |x: f64| {
            asked.set(asked.get() + 1);
            function(x)
        };
        let root = bracketed_root(counting, 0.0, 1.0).unwrap();
        (root, asked.get())
    }

    /// A regression test against earlier results: the evaluations saved characterise the method as much as the root
    /// does.
    #[test]
    fn regress_interpolation_saves_this_many_evaluations() {
        type Function = fn(f64) -> f64;
        let functions: [(Function, f64, usize); 6] = [
            (|x| libm::exp(x) - 2.0, std::f64::consts::LN_2, 8),
            (|x| 2.0 - libm::exp(x), std::f64::consts::LN_2, 8),
            (|x| x * x * x - 0.125, 0.5, 3),
            (|x| x * x - 0.09, 0.3, 10),
            (|x| libm::pow(x, 9.0) - 1e-3, 0.464_158_883_361_277_9, 13),
            (|x| x - 0.7 + if x < 0.7 { -1.0 } else { 1.0 }, 0.7, 53),
        ];
        for (index, (function, exact, expected)) in functions.into_iter().enumerate() {
            let (root, evaluations) = counted(function);
            assert!((root - exact).abs() <= 4e-16 * exact, "{index}: {root}");
            assert_eq!(evaluations, expected, "{index}");
        }
    }

    #[test]
    fn what_bends_too_much_is_halved_and_what_is_nearly_straight_is_interpolated() {
        // Between x = 0 and 1, with an older value: nine tenths of the way, but three fifths of the rise.
        assert_eq!(next_fraction([0.9, 0.0, 1.0], [0.1, -0.5, 0.5]), 0.5);
        // A third of the way, but nine tenths of the rise.
        assert_eq!(next_fraction([0.3, 0.0, 1.0], [0.4, -0.5, 0.5]), 0.5);
        let straight = next_fraction([0.6, 0.0, 1.0], [0.1, -0.5, 0.5]);
        assert!((straight - 1.0 / 6.0).abs() < 1e-15, "{straight}");
    }

    #[test]
    fn golden_sections_find_a_maximum_inside_and_at_the_ends() {
        let highest =
            |function: fn(f64) -> f64, low, high| function(maximum_between(function, low, high));
        let near = |found: f64, expected: f64| (found - expected).abs() < 1e-15;
        assert!(near(highest(|x| x * (1.0 - x), 0.0, 1.0), 0.25));
        assert!(near(highest(|x| x * x * (1.0 - x), 0.2, 1.0), 4.0 / 27.0));
        assert!((highest(|x| x, 0.0, 2.0) - 2.0).abs() < 1e-8);
        assert!((highest(|x| -x, 1.0, 2.0) + 1.0).abs() < 1e-8);
    }
}
