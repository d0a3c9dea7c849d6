//! Fig. 2(b): the yield force over the stiffness, below, at and above the critical friction.

use super::codes::{self, error_panel};
use super::panel::{Anchor, Panel, Point, Sample};
use super::sheet::Sheet;
use super::style::{EXACT, HERTZ, PERTURBATION, THIN};
use super::{Figure, friction_words, stiffness_axis};
use crate::model::{PAPER_STIFFNESS_RATIO, Power};
use crate::paper::claims::{number, values};
use crate::paper::published::Published;
use crate::paper::reproduction::{
    Curves, Exponent, FITTED_FROM, Laws, Reproduction, SCALING_FRICTIONS, TheoryPoint,
};
use crate::study::yield_force::Judgement;

/// Draws the yield force over the stiffness with the fitted exponents, and the errors of the codes at each friction.
pub fn scaling(reproduction: &Reproduction) -> Figure {
    let (judgements, laws) = (&reproduction.scaling, &reproduction.laws);
    let published = reproduction.published.as_ref();
    let errors = SCALING_FRICTIONS.map(|mu| {
        let own = judgements.iter();
        let own = own.filter(|row| row.mu() == mu);
        let mut panel = error_panel(stiffness_axis(), own, Judgement::stiffness);
        codes::name_errors(&mut panel, &friction_words(mu));
        panel
    });
    let loads = forces(judgements, &reproduction.curves, laws, published);
    let others: Vec<f64> = other_frictions(published).iter().map(|own| own.0).collect();
    let points = match others.is_empty() {
        true => "points".to_owned(),
        false => format!(
            "points; thin: the exact limit at {}, the friction of some of them",
            values("\\mu", &others)
        ),
    };
    let panels: Vec<Panel> = [loads].into_iter().chain(errors).collect();
    let caption = format!(
        "Fig. 2(b) of the paper. (a) Load at yield $F + 3$, with the yield force $F = f/(mg)$, over the stiffness \
                  $k_n r/(mg)$ for floor \
                  frictions {} with $\\mu_c = 2 - \\sqrt3$, at $\\kappa = {PAPER_STIFFNESS_RATIO}$, and beside it at $\\mu_c$ with Hertz contacts (dash-dotted, \
                  stiffness $K r\\sqrt r/(mg)$, $\\kappa = 17/14$; not in the paper); in the table the exponent $\\beta$ with which $F + 3$ grows over the \
                  stiffness, fitted from ${}$ on to the native runs (in parentheses what the uncertainties \
                  of the forces can do to the last digit) and to the exact limits at the same stiffnesses, and \
                  its value for infinite stiffness. (b–d) Distance \
                  of each code with linear springs from the exact limit under its own convention, relative to $F + 3$, a panel \
                  for each friction; {}. \
                  Dashed: the largest tolerance that a row may have. Points with a ring: inconclusive, their uncertainty is larger than the largest tolerance.{}{}",
        values("\\mu", &SCALING_FRICTIONS),
        number(FITTED_FROM),
        codes::errors_at_edges(),
        codes::left_out(judgements),
        codes::published_words(published, &points)
    );
    let both: Vec<Judgement> = judgements.iter().chain(&laws.scaling).cloned().collect();
    let sheet = Sheet::of_halves(panels)
        .with_key(codes::key(&both))
        .with_table(fits(reproduction.exponents.iter().chain(&laws.exponents)));
    Figure::of_sheet("scaling", caption, &sheet)
}

fn forces(
    judgements: &[Judgement],
    curves: &Curves,
    laws: &Laws,
    published: Option<&Published>,
) -> Panel {
    let mut panel = Panel::new(stiffness_axis(), codes::load_axis((4.0, 6e5)));
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
    panel.words(HERTZ_WORDS, HERTZ_END, Anchor::End);
    codes::loads(&mut panel, &laws.scaling, |row| row.stiffness());
    codes::loads(&mut panel, judgements, |row| row.stiffness());
    for (friction, limits) in other_frictions(published) {
        if let Some(&(stiffness, load)) = limits.last() {
            let place = (stiffness, 2.5 * load);
            panel.words(friction_words(friction), place, Anchor::End);
        }
        panel.line(THIN, limits);
    }
    codes::published(&mut panel, published, PUBLISHED_FIGURE, |own| {
        Some((own.stack.stiffness, own.load()))
    });
    panel.key(Sample::Line(EXACT), "exact limit");
    panel.key(Sample::Line(PERTURBATION), "perturbation");
    panel.key(Sample::Line(HERTZ), "exact limit, Hertz");
    panel
}

/// Returns the frictions of published points that no curve has, each with its points of stiffness and F + 3 of the
/// exact limit, softest first.
fn other_frictions(published: Option<&Published>) -> Vec<(f64, Vec<Point>)> {
    let own = published.into_iter();
    let own = own.flat_map(|published| published.of_figure(PUBLISHED_FIGURE));
    let mut found: Vec<(f64, Vec<Point>)> = Vec::new();
    for own in own {
        let friction = own.stack.floor_friction;
        let Some(limit) = own.limit.filter(|_| !SCALING_FRICTIONS.contains(&friction)) else {
            continue;
        };
        let point = (own.stack.stiffness, limit + 3.0);
        match found.iter_mut().find(|known| known.0 == friction) {
            Some((_, points)) => points.push(point),
            None => found.push((friction, vec![point])),
        }
    }
    for (_, points) in &mut found {
        points.sort_by(|one, other| one.0.total_cmp(&other.0));
    }
    found
}

/// Name of the published figure.
const PUBLISHED_FIGURE: &str = "fig2b";

/// Places of the names of the curves, above their right ends.
const CURVE_ENDS: [(f64, f64); 3] = [(1.3e6, 42.0), (3e5, 2.2e3), (8e4, 5e4)];

/// Name of the curve with Hertz contacts, and its place.
const HERTZ_WORDS: &str = "μ = μ_{c}, Hertz";
const HERTZ_END: (f64, f64) = (1.35e6, 85.0);

/// Returns the table of the fitted exponents.
fn fits<'a>(exponents: impl Iterator<Item = &'a Exponent>) -> Vec<Vec<String>> {
    let heads = ["exponent β", "native", "exact limit", "kₙ → ∞"];
    let own = exponents.filter(|own| own.code.is_native());
    let rows = own.map(|fitted| {
        let decimals = decimals(fitted.uncertainty);
        vec![
            match fitted.power {
                Power::Linear => friction_words(fitted.mu),
                _ => HERTZ_WORDS.to_owned(),
            },
            with_uncertainty(fitted.exponent, fitted.uncertainty),
            format!("{:.decimals$}", fitted.exact),
            fitted.asymptotic.to_string(),
        ]
    });
    let heads = heads.map(str::to_owned).to_vec();
    [heads].into_iter().chain(rows).collect()
}

/// Returns the decimal place of the first digit of `uncertainty`.
fn decimals(uncertainty: f64) -> usize {
    let place = -libm::floor(libm::log10(uncertainty));
    if place.is_finite() {
        place.clamp(0.0, 12.0) as usize
    } else {
        6
    }
}

/// Formats `value` with the uncertainty of its last digit in parentheses, rounded up.
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
