//! The exponent with which the largest force at the critical friction grows with the stiffness: 1/(1 + p).

use crate::common::{Bench, json_rows, standard_output};

/// Stiffnesses a decade apart, so high that the exponent is near its limit.
const STIFFNESSES: [f64; 2] = [1e6, 1e7];

#[test]
fn native_measures_the_exponent_of_the_largest_force_at_the_critical_friction() {
    let bench = Bench::without_codes();
    let [soft, stiff] = STIFFNESSES;
    let line = format!(
        "sweep --code native --law hertz --mu critical --stiffness {soft},{stiff} --format json"
    );
    let rows = json_rows(&standard_output(&mut bench.tristack(&line)));
    let of = |key: &str| -> Vec<f64> {
        let numbers = rows.iter().map(|row| row[key].as_f64());
        numbers.map(|number| number.expect("a number")).collect()
    };
    let exponent = |forces: &[f64]| libm::log10(forces[1] / forces[0]);
    let measured = exponent(&of("peak_force"));
    // The peak is 2.78 ε^(-2/5) in the limit; at these stiffnesses its prefactor still grows by 0.2 % a decade.
    assert!((measured / 0.4 - 1.0).abs() < 0.01, "{measured}");
    // The uncertainties of both peaks, over the logarithm of a decade.
    let forces = of("peak_force").into_iter().zip(of("peak_uncertainty"));
    let allowed: f64 = forces.map(|(force, uncertainty)| uncertainty / force).sum();
    let exact = exponent(&of("reference_force"));
    assert!(
        (measured - exact).abs() < allowed / 10_f64.ln(),
        "{measured} {exact}"
    );
}
