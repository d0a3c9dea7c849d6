//! Fig. 2(b): the yield force over the stiffness, below, at and above the critical friction.

use super::codes::{self, error_panel};
use super::panel::{Anchor, Panel, Sample};
use super::style::{EXACT, HERTZ, PERTURBATION};
use super::{Figure, friction_words, stiffness_axis};
use crate::code::Code;
use crate::model::Power;
use crate::paper::reproduction::{Curves, Exponent, Laws, SCALING_FRICTIONS, TheoryPoint};
use crate::study::yield_force::Judgement;

/// Yield force over the stiffness with the fitted exponents, and the errors of the codes.
pub(super) fn scaling(
    judgements: &[Judgement],
    exponents: &[Exponent],
    curves: &Curves,
    laws: &Laws,
) -> Figure {
    let mut errors = error_panel(stiffness_axis(), judgements, |row| row.stiffness());
    codes::key(&mut errors, judgements, (0.05, 0.01));
    let mut loads = forces(judgements, curves, laws);
    fits(&mut loads, exponents.iter().chain(&laws.exponents));
    let panels = [loads, errors];
    let caption = format!(
        "Fig. 2(b) of the paper. (a) Yield force F = f/(m g) over the stiffness kₙ r/(m g) for floor \
                  frictions μ = 0.25, μ_c = 2 − √3 and 0.3 at κ = 2.5, and beside it at μ_c with Hertz contacts (dash-dotted, \
                  stiffness K r√r/(m g), Poisson’s ratio 0.3; not in the paper), with the exponent β of F + 3 ∝ \
                  (stiffness)^β, fitted from 10³ on to the native runs (in parentheses what the uncertainties \
                  of the forces can do to the last digit) and to the exact limits at the same stiffnesses, and \
                  its value for infinite stiffness. (b) Distance \
                  of each code with linear springs from the exact limit under its own convention, relative to F + 3; errors below \
                  10⁻¹⁰ stand at the lower edge.{}",
        codes::left_out(judgements)
    );
    Figure::of_halves("scaling", caption, &panels)
}

fn forces(judgements: &[Judgement], curves: &Curves, laws: &Laws) -> Panel {
    let mut panel = Panel::new(stiffness_axis(), codes::load_axis((0.02, 3e6)));
    let load = |force: Option<f64>| force.map(|force| force + 3.0);
    for (mu, place) in SCALING_FRICTIONS.into_iter().zip(CURVE_ENDS) {
        let all = curves.over_stiffness.iter();
        let points = all.filter(|point| point.mu == mu);
        let exact = |point: &TheoryPoint| (point.stiffness, load(point.exact));
        let perturbation = |point: &TheoryPoint| (point.stiffness, load(point.perturbation));
        panel.line(EXACT, points.clone().map(exact));
        panel.line(PERTURBATION, points.map(perturbation));
        panel.words(friction_words(mu), place, Anchor::End);
    }
    let hertz = laws.critical.iter();
    let hertz = hertz.map(|&(stiffness, force)| (stiffness, load(force)));
    panel.line(HERTZ, hertz);
    panel.words("μ_{c}, Hertz", HERTZ_END, Anchor::End);
    codes::loads(&mut panel, &laws.scaling, |row| row.stiffness());
    codes::loads(&mut panel, judgements, |row| row.stiffness());
    panel.key(Sample::Line(EXACT), "exact limit");
    panel.key(Sample::Line(PERTURBATION), "perturbation");
    panel
}

/// Places of the names of the curves, above their right ends.
const CURVE_ENDS: [(f64, f64); 3] = [(1.3e6, 50.0), (3e5, 2.2e3), (8e4, 5e4)];

/// Place of the name of the curve with Hertz contacts.
const HERTZ_END: (f64, f64) = (1.35e6, 1.45e2);

/// A table of the fitted exponents, below the curves.
fn fits<'a>(panel: &mut Panel, exponents: impl Iterator<Item = &'a Exponent>) {
    const COLUMNS: [f64; 4] = [2.6e1, 7e2, 2.6e4, 6e5];
    const LINES: [f64; 5] = [2.4, 0.84, 0.3, 0.105, 0.037];
    let heads = ["", "β, native", "β, exact limit", "ε → 0"];
    for (x, head) in COLUMNS.into_iter().zip(heads) {
        panel.words(head, (x, LINES[0]), Anchor::Middle);
    }
    let own = exponents.filter(|own| own.code == Code::NATIVE);
    for (fitted, y) in own.zip(&LINES[1..]) {
        let decimals = decimals(fitted.uncertainty);
        let cells = [
            match fitted.power {
                Power::Linear => friction_words(fitted.mu),
                _ => "μ_{c}, Hertz".to_owned(),
            },
            with_uncertainty(fitted.exponent, fitted.uncertainty),
            format!("{:.decimals$}", fitted.exact),
            fitted.asymptotic.to_string(),
        ];
        for (x, cell) in COLUMNS.into_iter().zip(cells) {
            panel.words(cell, (x, *y), Anchor::Middle);
        }
    }
}

/// The decimal place of the first digit of `uncertainty`.
fn decimals(uncertainty: f64) -> usize {
    let place = -libm::floor(libm::log10(uncertainty));
    if place.is_finite() {
        place.clamp(0.0, 12.0) as usize
    } else {
        6
    }
}

/// `value` with the uncertainty of its last digit in parentheses, rounded up.
fn with_uncertainty(value: f64, uncertainty: f64) -> String {
    let decimals = decimals(uncertainty);
    let digit = libm::ceil(uncertainty * libm::exp10(decimals as f64));
    format!("{value:.decimals$}({digit})")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_digit_carries_the_uncertainty() {
        assert_eq!(with_uncertainty(0.989_588_09, 2.5e-6), "0.989588(3)");
        assert_eq!(with_uncertainty(0.5, 0.0), "0.500000(0)");
    }
}
