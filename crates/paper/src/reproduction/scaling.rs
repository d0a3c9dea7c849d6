//! Fig. 2(b): scaling of the yield force with the stiffness, below, at and above the critical friction.

use crate::code::{Code, SettledCode};
use crate::model::{CRITICAL_FRICTION, PAPER_BODIES, Power, Stack};
use crate::study::yield_force::{Judgement, Measurement, plan};
use crate::study::{MAX_TOLERANCE, Verdict};

/// Frictions of Fig. 2(b).
pub const SCALING_FRICTIONS: [f64; 3] = [0.25, CRITICAL_FRICTION, 0.3];

/// Stiffnesses 1/ε of Fig. 2(b), one per decade.
pub(super) const SCALING_STIFFNESSES: [f64; 6] = [1e1, 1e2, 1e3, 1e4, 1e5, 1e6];

/// Lowest stiffness of the fits: from here on, ε is at most 1e-3.
pub const FITTED_FROM: f64 = 1e3;

/// An exponent β in F + 3 ∝ (K r^p/(m g))^β, fitted over stiffnesses from 10³ on. K is k_n for linear springs.
#[derive(Debug, Clone, PartialEq)]
pub struct Exponent {
    /// The code that measured the yield forces.
    pub code: Code,
    /// The power p of the normal force.
    pub power: Power,
    /// Floor friction μ.
    pub mu: f64,
    /// Least-squares slope of ln(F + 3) over ln(1/ε).
    pub exponent: f64,
    /// Largest change of the exponent within the uncertainties of the forces.
    pub uncertainty: f64,
    /// The same fit to the exact limits under the code's convention: the exponent of this finite range.
    pub exact: f64,
    /// The exponent for ε → 0: 0, 1/(1 + p), 1 below, at and above μ_c (paper, Eq. (5), for p = 1).
    pub asymptotic: f64,
    /// Number of stiffnesses fitted.
    pub points: usize,
    /// Verdict on the difference of `exponent` and `exact`.
    pub verdict: Verdict,
}

/// Returns the measurements for Fig. 2(b): every stack that yields, by each of the `codes`.
pub fn scaling_measurements(codes: &[SettledCode]) -> Vec<Measurement> {
    let stacks = SCALING_FRICTIONS
        .iter()
        .flat_map(|&mu| SCALING_STIFFNESSES.map(|stiffness| Stack::paper(mu, stiffness)));
    let rows = stacks.flat_map(|stack| {
        let codes = codes.iter();
        codes.map(move |code| {
            plan(
                code,
                &stack,
                code.stack_convention(Power::Linear, PAPER_BODIES),
            )
        })
    });
    rows.filter(|row| !row.cases.is_empty()).collect()
}

/// Returns the exponents of every code at every friction of Fig. 2(b) that has at least two points to fit.
pub fn exponents(judgements: &[Judgement]) -> Vec<Exponent> {
    let frictions = SCALING_FRICTIONS.into_iter();
    let fitted = frictions.flat_map(|mu| fitted_exponents(judgements, mu));
    fitted.collect()
}

/// Returns the exponents of every code that has at least two points to fit at `mu`.
pub(super) fn fitted_exponents(judgements: &[Judgement], mu: f64) -> Vec<Exponent> {
    let codes = Code::distinct(judgements.iter().map(|row| &row.code)).into_iter();
    let fitted = codes.filter_map(|code| {
        let own = judgements.iter();
        let own =
            own.filter(|row| row.code == code && row.mu() == mu && row.stiffness() >= FITTED_FROM);
        let power = own.clone().next()?.study.convention.law.power;
        let points: Vec<Point> = own.filter_map(Point::of).collect();
        (points.len() >= 2).then(|| fit(code, power, mu, &points))
    });
    fitted.collect()
}

/// Logarithms of a measured load F + 3, its limit and its stiffness, and the uncertainty of the first.
struct Point {
    stiffness: f64,
    load: f64,
    uncertainty: f64,
    limit: f64,
}

impl Point {
    fn of(row: &Judgement) -> Option<Self> {
        let load = row.yield_force()? + 3.0;
        Some(Self {
            stiffness: libm::log(row.stiffness()),
            load: libm::log(load),
            uncertainty: row.uncertainty()? / load,
            limit: libm::log(row.reference_force()? + 3.0),
        })
    }
}

fn fit(code: Code, power: Power, mu: f64, points: &[Point]) -> Exponent {
    let weights = slope_weights(points.iter().map(|point| point.stiffness));
    let sum = |term: &dyn Fn(f64, &Point) -> f64| -> f64 {
        let terms = weights.iter().zip(points);
        terms.map(|(&weight, point)| term(weight, point)).sum()
    };
    let exponent = sum(&|weight, point| weight * point.load);
    let exact = sum(&|weight, point| weight * point.limit);
    let uncertainty = sum(&|weight, point| weight.abs() * point.uncertainty);
    let tolerance = sum(&|weight, _| weight.abs() * MAX_TOLERANCE);
    Exponent {
        code,
        power,
        mu,
        exponent,
        uncertainty,
        exact,
        asymptotic: exponent_at(mu, [0.0, 1.0 / (1.0 + power.value()), 1.0]),
        points: points.len(),
        verdict: Verdict::of(exponent - exact, uncertainty, tolerance),
    }
}

/// Returns the weights of the ordinates in a least-squares slope.
fn slope_weights(abscissae: impl ExactSizeIterator<Item = f64> + Clone) -> Vec<f64> {
    let count = abscissae.len() as f64;
    let mean = abscissae.clone().sum::<f64>() / count;
    let distances = abscissae.map(|abscissa| abscissa - mean);
    let spread: f64 = distances.clone().map(|distance| distance.powi(2)).sum();
    distances.map(|distance| distance / spread).collect()
}

/// Returns the least-squares slope of ln(F + 3) over ln(1/ε) for pairs of stiffness and load; NaN for a single pair.
pub fn slope(points: &[(f64, f64)]) -> f64 {
    let weights = slope_weights(points.iter().map(|point| libm::log(point.0)));
    let terms = weights.iter().zip(points);
    terms
        .map(|(weight, point)| weight * libm::log(point.1))
        .sum()
}

/// Returns the exponent for `mu` out of three, for frictions below, at and above μ_c.
pub fn exponent_at(mu: f64, [below, at, above]: [f64; 3]) -> f64 {
    match mu.total_cmp(&CRITICAL_FRICTION) {
        std::cmp::Ordering::Less => below,
        std::cmp::Ordering::Equal => at,
        std::cmp::Ordering::Greater => above,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(stiffness: f64, load: f64) -> Point {
        Point {
            stiffness: libm::log(stiffness),
            load: libm::log(load),
            uncertainty: 1e-6,
            limit: libm::log(load * 1.000_001),
        }
    }

    #[test]
    fn a_power_law_gives_its_exponent_back() {
        let points: Vec<Point> = [1e3, 1e4, 1e5]
            .map(|stiffness: f64| point(stiffness, 2.0 * stiffness.powf(0.7)))
            .into();
        let fitted = fit(Code::native(), Power::Linear, 0.3, &points);
        assert!((fitted.exponent - 0.7).abs() < 1e-12);
        assert_eq!(fitted.verdict, Verdict::Agrees);
    }

    #[test]
    fn a_wrong_force_shows_in_the_exponent() {
        let mut points: Vec<Point> = [1e3, 1e4, 1e5].map(|s: f64| point(s, s.sqrt())).into();
        points[2].load += 1e-3;
        let fitted = fit(Code::native(), Power::Hertz, CRITICAL_FRICTION, &points);
        assert_eq!(fitted.asymptotic, 0.4);
        assert_eq!(fitted.verdict, Verdict::Differs);
    }

    #[test]
    fn stacks_that_do_not_yield_are_not_planned() {
        let rows = scaling_measurements(&SettledCode::with_power(Power::Linear));
        assert!(rows.iter().all(|row| row.cases.len() == 5));
        assert!(rows.len() > 6 * 15);
    }
}
