//! The errors of the paper's theories against the exact limit.

use super::axis::{Axis, power_of_ten};
use super::panel::{Anchor, Panel, Sample, Stroke};
use super::sheet::Sheet;
use super::style::{ELASTIC, GUIDE, NAIVE, PERTURBATION};
use super::{Figure, friction_words, stiffness_axis};
use crate::model::CRITICAL_FRICTION;
use crate::paper::reproduction::{Curves, SCALING_FRICTIONS, TheoryPoint};
use crate::study::yield_force::PAPER_STIFFNESSES;

const ERRORS: (f64, f64) = (1e-7, 1e2);
/// Height of the words that name a panel, on the axis of errors.
const HEADING: f64 = 2e1;

/// Draws the relative error of each theory, over the friction and over the stiffness.
pub(super) fn theory_error(curves: &Curves) -> Figure {
    let over_friction = PAPER_STIFFNESSES.iter().map(|&stiffness| {
        let own = |point: &&TheoryPoint| point.stiffness == stiffness;
        let points = curves.over_friction.iter().filter(own);
        let mut panel = panel(Axis::friction(), points, |point| point.mu);
        panel.upright(GUIDE, CRITICAL_FRICTION);
        let heading = format!("kₙ r/(m g) = {}", power_of_ten(stiffness));
        panel.words(heading, (0.5, HEADING), Anchor::End);
        panel
    });
    let over_stiffness = SCALING_FRICTIONS.iter().map(|&mu| {
        let own = |point: &&TheoryPoint| point.mu == mu;
        let points = curves.over_stiffness.iter().filter(own);
        let mut panel = panel(stiffness_axis(), points, |point| point.stiffness);
        panel.words(friction_words(mu), (1e6, HEADING), Anchor::End);
        panel
    });
    let mut panels: Vec<Panel> = over_friction.chain(over_stiffness).collect();
    for (stroke, _, name) in THEORIES {
        panels[5].key(Sample::Line(stroke), name);
    }
    panels[5].key_at(0.05, 0.74);
    let caption = "Not in the paper: $\\lvert F_\\mathrm{theory} - F\\rvert/(F + 3)$, the distance of the paper's theories from the exact \
                  quasi-static limit $F = f/(mg)$ of its model, at $\\kappa = 2.5$. (a–c) Over the floor friction $\\mu$ for \
                  three stiffnesses $k_n r/(mg)$; (d–f) over the stiffness below, at and above $\\mu_c$. Gaps: the \
                  theory gives no number there, or the floor does not slip first. Theory alone, no runs.";
    Figure::of_sheet("theory-error", caption, &Sheet::of_thirds(panels))
}

type Force = fn(&TheoryPoint) -> Option<f64>;

const THEORIES: [(Stroke, Force, &str); 3] = [
    (NAIVE, |point| point.naive, "naive"),
    (PERTURBATION, |point| point.perturbation, "perturbation"),
    (ELASTIC, |point| point.elastic, "elastic equation"),
];

fn panel<'a>(
    x: Axis,
    points: impl Iterator<Item = &'a TheoryPoint> + Clone,
    place: impl Fn(&TheoryPoint) -> f64,
) -> Panel {
    let y = Axis::log("|F_{theory} − F|/(F + 3)", ERRORS);
    let mut panel = Panel::new(x, y);
    for (stroke, force, _) in THEORIES {
        let error = |point: &TheoryPoint| point.error(force(point)).map(f64::abs);
        let points = points.clone();
        panel.line(stroke, points.map(|point| (place(point), error(point))));
    }
    panel
}
