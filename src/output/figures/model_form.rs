//! What the contact convention of a code does to the yield force.

use super::Figure;
use super::axis::{Axis, power_of_ten};
use super::panel::{Anchor, Panel, Sample, draw};
use super::style::{GUIDE, Mark, STIFFNESS_STROKES, code_label};
use crate::code::Code;
use crate::model::CRITICAL_FRICTION;
use crate::paper::reproduction::Curves;
use crate::study::yield_force::{Judgement, PAPER_STIFFNESSES};

/// Difference to the paper's convention, as theory has it and as the codes measured it.
pub(super) fn model_form(judgements: &[Judgement], curves: &Curves) -> Figure {
    let half_arms = [Code::Liggghts, Code::Yade, Code::YadeFacet];
    let small = Axis::linear(LABEL, (-2.5, 0.5), 0.5, 1);
    let large = Axis::linear(LABEL, (-25.0, 5.0), 5.0, 0);
    let mut left = panel(small, &half_arms, judgements, curves);
    left.key_at(0.62, 0.56);
    left.words("arms −½, −½", (0.5, 0.35), Anchor::End);
    let mut right = panel(large, &[Code::YadeWall], judgements, curves);
    right.key_at(0.05, 0.5);
    right.words("arms −½, −1", (0.5, 3.2), Anchor::End);
    let caption = "Not in the paper: (F − F_paper)/(F_paper + 3), what the torque arms r + r₁·overlap of a code \
                  do to the yield force F = f/(m g), over the floor friction μ at three stiffnesses kₙ r/(m g) \
                  and κ = 2.5. Lines: exact limits; marks: the codes, by slip onset extrapolated to vanishing \
                  wall speed. (a) r₁ = −½ between cylinders and at the floor, (b) r₁ = −½ and −1; the paper has \
                  r₁ = 0.";
    Figure::new(
        "model-form",
        caption,
        draw(&[left, right], 2, super::HALF_PAGE),
    )
}

const LABEL: &str = "(F − F_{paper})/(F_{paper} + 3) in %";

fn panel(y: Axis, codes: &[Code], judgements: &[Judgement], curves: &Curves) -> Panel {
    let mut panel = Panel::new(Axis::friction(), y);
    panel.upright(GUIDE, CRITICAL_FRICTION);
    panel.level(GUIDE, 0.0);
    let drawn = curves.model_form.iter();
    let drawn = drawn.filter(|point| codes.contains(&point.code));
    panel.key(Sample::Heading, "kₙ r/(m g)");
    for (stiffness, stroke) in PAPER_STIFFNESSES.into_iter().zip(STIFFNESS_STROKES) {
        let points = drawn.clone().filter(|point| point.stiffness == stiffness);
        let points = points.map(|point| (point.mu, Some(100.0 * point.difference)));
        panel.line(stroke, points);
        panel.key(Sample::Line(stroke), &power_of_ten(stiffness));
    }
    for &code in codes {
        let own = judgements.iter();
        let own = own.filter(|row| row.code == code);
        panel.marks(Mark::of(code), own.filter_map(measured));
        panel.key(Sample::Mark(Mark::of(code)), code_label(code));
    }
    panel
}

/// The measured difference in percent: the error of a row is relative to its own limit + 3, which differs from
/// the paper's by the model form.
fn measured(row: &Judgement) -> Option<(f64, f64)> {
    let (error, model_form) = row.error().zip(row.model_form())?;
    let ratio = (1.0 + error) * (1.0 + model_form);
    Some((row.mu(), 100.0 * (ratio - 1.0)))
}
