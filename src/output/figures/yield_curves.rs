//! Fig. 2(a): the yield force over the floor friction.

use super::Figure;
use super::axis::{Axis, power_of_ten};
use super::codes::{self, error_panel};
use super::panel::{Anchor, Panel, Sample};
use super::style::{EXACT, GUIDE, PERTURBATION, RIGID};
use crate::model::CRITICAL_FRICTION;
use crate::paper::reproduction::{Curves, TheoryPoint};
use crate::study::yield_force::{Judgement, PAPER_STIFFNESSES};

/// Yield force by every code and theory, and the errors of the codes.
pub(super) fn yield_curves(judgements: &[Judgement], curves: &Curves) -> Figure {
    let mut errors = error_panel(Axis::friction(), judgements, |row| row.mu());
    codes::key(&mut errors, judgements, (0.05, 0.01));
    let panels = [forces(judgements, curves), errors];
    let caption = format!(
        "Fig. 2(a) of the paper. (a) Yield force F = f/(m g) over the floor friction μ for stiffnesses \
             kₙ r/(m g) = 10², 10³ and 10⁴ at κ = 2.5: exact quasi-static limit of the paper's model, the \
             paper's perturbation result, the limit of rigid cylinders, and every code under its own contact \
             convention, by slip onset extrapolated to vanishing wall speed (marks as in b). (b) Distance of \
             each code from the exact limit under its own convention, relative to F + 3; errors below \
             10⁻¹⁰ stand at the lower edge. Runs of the standard profile.{}",
        codes::left_out(judgements)
    );
    Figure::of_halves("yield-curves", caption, &panels)
}

fn forces(judgements: &[Judgement], curves: &Curves) -> Panel {
    let mut panel = Panel::new(Axis::friction(), codes::load_axis((2.0, 4e4)));
    panel.upright(GUIDE, CRITICAL_FRICTION);
    panel.words("μ_{c}", (CRITICAL_FRICTION + 0.006, 2.5), Anchor::Start);
    let loads = |theory: &dyn Fn(&TheoryPoint) -> Option<f64>, stiffness: f64| -> Vec<_> {
        let points = curves.over_friction.iter();
        let points = points.filter(|point| point.stiffness == stiffness);
        let load = |point: &TheoryPoint| (point.mu, theory(point).map(|force| force + 3.0));
        points.map(load).collect()
    };
    for stiffness in PAPER_STIFFNESSES {
        panel.line(EXACT, loads(&|point| point.exact, stiffness));
        panel.line(PERTURBATION, loads(&|point| point.perturbation, stiffness));
        let words = format!("kₙ r/(m g) = {}", power_of_ten(stiffness));
        panel.words(words, (0.51, 1.45 * stiffness), Anchor::End);
    }
    let [softest, ..] = PAPER_STIFFNESSES;
    panel.line(RIGID, loads(&|point| point.rigid, softest));
    codes::loads(&mut panel, judgements, |row| row.mu());
    panel.key(Sample::Line(EXACT), "exact limit");
    panel.key(Sample::Line(PERTURBATION), "perturbation");
    panel.key(Sample::Line(RIGID), "rigid");
    panel
}
