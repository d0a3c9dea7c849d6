//! Fig. 2(a): the yield force over the floor friction.

use super::axis::Axis;
use super::codes::{self, error_panel};
use super::panel::{Anchor, Panel, Sample};
use super::sheet::Sheet;
use super::style::{EXACT, GUIDE, PERTURBATION, RIGID_BELOW};
use super::{Figure, stiffness_words};
use crate::model::{CRITICAL_FRICTION, PAPER_STIFFNESS_RATIO};
use crate::paper::claims::values;
use crate::paper::published::Published;
use crate::paper::reproduction::{Curves, TheoryPoint};
use crate::study::yield_force::{Judgement, PAPER_STIFFNESSES};

/// Lowest and highest load shown.
const LOADS: (f64, f64) = (2.0, 4e4);
/// The load F + 3 of a stack that yields under its own weight.
const WITHOUT_FORCE: f64 = 3.0;
/// Number of points on the curve of rigid cylinders.
const RIGID_POINTS: usize = 61;

/// Draws the yield force by every code and theory, and the errors of the codes, one panel per stiffness.
pub(super) fn yield_curves(
    judgements: &[Judgement],
    curves: &Curves,
    published: Option<&Published>,
) -> Figure {
    let errors = PAPER_STIFFNESSES.map(|stiffness| {
        let own = judgements.iter();
        let own = own.filter(|row| row.stiffness() == stiffness);
        let mut panel = error_panel(Axis::friction(), own, Judgement::mu);
        codes::name_errors(&mut panel, &stiffness_words(stiffness));
        panel
    });
    let panels = [forces(judgements, curves, published)]
        .into_iter()
        .chain(errors);
    let caption = format!(
        "Fig. 2(a) of the paper. (a) Load at yield $F + 3$, with the yield force $F = f/(mg)$, over the floor friction $\\mu$ \
             for stiffnesses {} at $\\kappa = {PAPER_STIFFNESS_RATIO}$: exact quasi-static limit of the paper's model, the \
             paper's perturbation result, the limit of rigid cylinders (wide and light, the same for every stiffness), and \
             every code under its own contact \
             convention, by slip onset extrapolated to vanishing wall speed. (b–d) Distance of \
             each code from the exact limit under its own convention, relative to $F + 3$, a panel for each stiffness; \
             {}. Dashed: the largest tolerance that a row may have; most are smaller. Runs of the standard profile.{}{}",
        values("k_n r/(mg)", &PAPER_STIFFNESSES),
        codes::errors_at_edges(),
        codes::left_out(judgements),
        codes::published_words(published, "points")
    );
    let sheet = Sheet::of_halves(panels.collect::<Vec<Panel>>()).with_key(codes::key(judgements));
    Figure::of_sheet("yield-curves", caption, &sheet)
}

fn forces(judgements: &[Judgement], curves: &Curves, published: Option<&Published>) -> Panel {
    let mut panel = Panel::new(Axis::friction(), codes::load_axis(LOADS));
    panel.line(RIGID_BELOW, rigid());
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
        let place = (0.51, 1.45 * stiffness);
        panel.words(stiffness_words(stiffness), place, Anchor::End);
    }
    codes::loads(&mut panel, judgements, |row| row.mu());
    codes::published(&mut panel, published, "fig2a", |own| {
        Some((own.stack.floor_friction, own.load()))
    });
    panel.key(Sample::Line(EXACT), "exact limit");
    panel.key(Sample::Line(PERTURBATION), "perturbation");
    panel.key(Sample::Line(RIGID_BELOW), "rigid");
    panel
}

/// Returns friction and load of rigid cylinders, for which F + 3 is 2/(1 − μ/μ_c), up to the highest load shown.
fn rigid() -> impl Iterator<Item = (f64, f64)> {
    (0..RIGID_POINTS).map(|index| {
        let part = index as f64 / (RIGID_POINTS - 1) as f64;
        let load = WITHOUT_FORCE * libm::pow(LOADS.1 / WITHOUT_FORCE, part);
        (CRITICAL_FRICTION * (1.0 - 2.0 / load), load)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Stack;
    use crate::theory::rigid_yield;

    #[test]
    fn the_curve_of_rigid_cylinders_is_that_of_theory_and_reaches_the_upper_edge() {
        let points: Vec<(f64, f64)> = rigid().collect();
        let (first, last) = (points[0], points[RIGID_POINTS - 1]);
        assert_eq!(first.1, WITHOUT_FORCE);
        assert!((last.1 / LOADS.1 - 1.0).abs() < 1e-12, "{last:?}");
        for (mu, load) in points {
            let force = rigid_yield(&Stack::paper(mu, 1e2)).yield_force;
            let expected = force.expect("it is below the critical friction") + 3.0;
            // A last bit of μ changes μ_c − μ by up to 1e-16/5e-5 of itself.
            assert!((load / expected - 1.0).abs() < 1e-11, "{mu}: {load}");
        }
    }
}
