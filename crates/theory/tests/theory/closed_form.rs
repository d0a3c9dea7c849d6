//! The fast closed form against the differential equation of the path (docs/theory.md, Eq. 17), summed as
//! a Taylor series in double-double arithmetic: neither integrating factor nor quadrature nor root finder.

use tristack_theory::model::CRITICAL_FRICTION;
use tristack_theory::theory::floor_slip_forces;
use twofloat::TwoFloat;

const TOLERANCE: f64 = 1e-12;

fn number(value: f64) -> TwoFloat {
    TwoFloat::from(value)
}

/// twofloat 0.8.4 divides by a double-double to 16 digits only; the remainder gives the others.
fn quotient(dividend: TwoFloat, divisor: TwoFloat) -> TwoFloat {
    let first = dividend / divisor;
    first + (dividend - first * divisor) / divisor
}

fn product(left: &[TwoFloat], right: &[TwoFloat]) -> Vec<TwoFloat> {
    let mut product = vec![number(0.0); left.len() + right.len() - 1];
    for (i, &factor) in left.iter().enumerate() {
        for (j, &other) in right.iter().enumerate() {
            product[i + j] += factor * other;
        }
    }
    product
}

fn sum_of_powers(coefficients: &[TwoFloat], x: TwoFloat) -> TwoFloat {
    let reversed = coefficients.iter().rev();
    reversed.fold(number(0.0), |sum, &coefficient| sum * x + coefficient)
}

/// G(T) as Taylor series about a few T.
struct PreciseCurve {
    pieces: Vec<(TwoFloat, Vec<TwoFloat>)>,
}

impl PreciseCurve {
    /// The nearest singularity is T = 0, so that over a piece, 0.4 of the distance to it, the terms fall
    /// to 0.4⁷⁵ = 10⁻³⁰.
    const TERMS: usize = 75;
    const RATIO: f64 = 1.4;

    /// From G = 0 at T = 2 − √3 to T = 1.
    fn new(stiffness_ratio: f64) -> Self {
        let mut centre = number(2.0) - number(3.0).sqrt();
        let mut overlap = number(0.0);
        let mut pieces = Vec::new();
        while centre < number(1.0) {
            let series = Self::series(centre, overlap, number(stiffness_ratio));
            let next = centre * Self::RATIO;
            overlap = sum_of_powers(&series, next - centre);
            pieces.push((centre, series));
            centre = next;
        }
        Self { pieces }
    }

    /// T (1+T²) [1+κ(1+T²)] G′ = 4 − [2+κ(1+T²)²] G, power by power of T − `centre`.
    fn series(centre: TwoFloat, overlap: TwoFloat, kappa: TwoFloat) -> Vec<TwoFloat> {
        let scaled = |polynomial: &[TwoFloat], constant: f64| {
            let mut scaled: Vec<TwoFloat> = polynomial.iter().map(|&c| kappa * c).collect();
            scaled[0] += number(constant);
            scaled
        };
        let tangent = [centre, number(1.0)];
        let mut square = product(&tangent, &tangent);
        square[0] += number(1.0);
        let of_slope = product(&product(&tangent, &square), &scaled(&square, 1.0));
        let of_overlap = scaled(&product(&square, &square), 2.0);
        let mut series = vec![overlap];
        for n in 0..Self::TERMS {
            let mut right = number(if n == 0 { 4.0 } else { 0.0 });
            for (j, &factor) in of_overlap.iter().enumerate().take(n + 1) {
                right -= factor * series[n - j];
            }
            for (j, &factor) in of_slope.iter().enumerate().take(n + 1).skip(1) {
                right -= factor * series[n - j + 1] * (n - j + 1) as f64;
            }
            series.push(quotient(right, of_slope[0] * (n + 1) as f64));
        }
        series
    }

    fn overlap(&self, tangent: TwoFloat) -> TwoFloat {
        let after = self.pieces.partition_point(|&(centre, _)| centre < tangent);
        let (centre, series) = &self.pieces[after.saturating_sub(1)];
        sum_of_powers(series, tangent - *centre)
    }

    /// ε (F + 1) − 2 G(T) at T = μ (F+3)/(F+1), where the floor slips if the stack carries F + 3 = `load`:
    /// negative below the true load, positive above it.
    fn excess(&self, load: TwoFloat, floor_friction: f64, stiffness: f64) -> TwoFloat {
        let tangent = quotient(load * floor_friction, load - 2.0);
        (load - 2.0) / stiffness - self.overlap(tangent) * 2.0
    }

    /// Relative error of F + 3 = `load`: between the tolerance below and above it, the excess is straight.
    fn error(&self, load: f64, floor_friction: f64, stiffness: f64) -> f64 {
        let [below, above] = [1.0 - number(TOLERANCE), 1.0 + number(TOLERANCE)]
            .map(|factor| self.excess(factor * load, floor_friction, stiffness));
        TOLERANCE * f64::from((below + above) / (above - below))
    }

    /// Whether the floor slips under the wall, F ≥ 0, and before T = 1.
    fn slips(&self, floor_friction: f64, stiffness: f64) -> bool {
        let at_highest_tangent = quotient(number(2.0), 1.0 - number(floor_friction));
        let lowest_load = at_highest_tangent.max(number(3.0));
        self.excess(lowest_load, floor_friction, stiffness) < number(0.0)
    }
}

/// The largest error over `frictions` and `stiffnesses`, printed with its place.
fn worst_error(ratios: &[f64], stiffnesses: &[f64], frictions: &[f64]) -> f64 {
    let mut worst = (0.0, String::new());
    let mut compared = 0;
    for &kappa in ratios {
        let curve = PreciseCurve::new(kappa);
        for &stiffness in stiffnesses {
            let forces = floor_slip_forces(frictions, stiffness, kappa);
            for (&mu, force) in frictions.iter().zip(forces) {
                let place = format!("mu {mu}, stiffness {stiffness}, kappa {kappa}");
                assert_eq!(force.is_some(), curve.slips(mu, stiffness), "{place}");
                let Some(force) = force else { continue };
                let error = curve.error(force + 3.0, mu, stiffness).abs();
                compared += 1;
                if error > worst.0 {
                    worst = (error, place);
                }
            }
        }
    }
    println!("{compared} values, worst {:.1e} at {}", worst.0, worst.1);
    worst.0
}

fn decades(lowest: i32, highest: i32) -> Vec<f64> {
    (lowest..=highest)
        .map(|exponent| 10f64.powi(exponent))
        .collect()
}

#[test]
fn yield_force_is_good_to_1e_12_of_the_load() {
    let frictions: Vec<f64> = (10..=120).map(|i| f64::from(i) / 200.0).collect();
    let ratios = [0.5, 0.8, 1.1, 1.5, 2.5, 5.0, 10.0];
    assert!(worst_error(&ratios, &decades(1, 8), &frictions) < TOLERANCE);
}

#[test]
fn it_is_good_to_1e_12_also_where_it_is_most_sensitive() {
    // At μ_c, F depends on the last bits of μ and of μ_c: 3.1e-13 (docs/theory.md, Eq. 73).
    let near = |power: i32| {
        let distance = 10f64.powi(-power);
        [1.0 - distance, 1.0 + distance].map(|factor| CRITICAL_FRICTION * factor)
    };
    let frictions: Vec<f64> = (2..=16).flat_map(near).chain([CRITICAL_FRICTION]).collect();
    assert!(worst_error(&[0.5, 2.5, 10.0], &decades(1, 8), &frictions) < TOLERANCE);
}

#[test]
fn it_is_good_to_1e_12_over_everything_the_command_line_accepts() {
    let frictions: Vec<f64> = (1..=99).map(|i| f64::from(i) / 100.0).collect();
    let ratios = [1e-3, 0.1, 2.5, 1e2, 1e6];
    assert!(worst_error(&ratios, &decades(0, 8), &frictions) < TOLERANCE);
}
