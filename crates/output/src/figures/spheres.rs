//! Yield curves of spheres beside those of cylinders.

use super::Figure;
use super::axis::{Axis, power_of_ten};
use super::panel::{Anchor, Panel, Sample};
use super::sheet::Sheet;
use super::style::{
    BODIES_SLIP, BODIES_STROKES, GUIDE, INK, Mark, OWN_WEIGHT, RIGID, Stroke, WALL_REACHES,
};
use crate::model::{PAPER_BODIES, PAPER_CYLINDER_FRICTION, PAPER_STIFFNESS_RATIO};
use crate::paper::reproduction::{BodiesCurve, SPHERES_STIFFNESSES, Spheres};
use crate::theory::Event;

/// Draws the load of each bottom body over the floor friction, both in units in which rigid stacks do not differ.
pub(crate) fn spheres_figure(spheres: &Spheres) -> Figure {
    let [soft, stiff] = SPHERES_STIFFNESSES;
    let mut panels = SPHERES_STIFFNESSES.map(|stiffness| panel(spheres, stiffness));
    name_curves(&mut panels[0], spheres);
    name_ends(&mut panels[1]);
    let caption = format!(
        "Not in the paper: the paper’s two cylinders with one on top ($n = 2$) beside three to five spheres in a ring with one on \
         top. Load $(F + n + 1)/n$ that each bottom body puts on the floor at yield, in $mg$, over the floor friction in units of \
         the rigid critical one, at a stiffness $k_n r/(mg)$ of (a) {}, (b) {}; $\\kappa = {PAPER_STIFFNESS_RATIO}$, \
         $\\mu_d = {PAPER_CYLINDER_FRICTION}$. Lines: exact quasi-static limit under the paper’s convention, where slip onset and \
         peak are one force. In these units rigid stacks of every $n$ have one curve, $1/(1 - \\mu/\\mu_c)$, \
         so that elasticity alone separates the lines. A curve begins where the \
         stack just carries its own weight, at $\\mu_c/(n + 1)$ if it is rigid, and ends where the floor is no longer the first \
         to slip: the top wall reaches the bottom bodies, or the top one slips on them.",
        power_of_ten(soft),
        power_of_ten(stiff)
    );
    Figure::of_sheet("spheres", caption, &Sheet::of_halves(panels))
}

fn panel(spheres: &Spheres, stiffness: f64) -> Panel {
    let highest = 3.0 * stiffness;
    let friction = Axis::linear("floor friction μ/μ_{c}", (0.0, 2.2), 0.5, 1);
    let load = Axis::log("load per bottom body (F + n + 1)/n", (1.0, highest));
    let mut panel = Panel::new(friction, load);
    panel.upright(GUIDE, 1.0);
    panel.words(
        format!("stiffness {}", power_of_ten(stiffness)),
        (0.08, 0.6 * highest),
        Anchor::Start,
    );
    let curves = spheres.curves.iter();
    for curve in curves.filter(|curve| curve.stack.stiffness == stiffness) {
        let stroke = stroke(curve);
        let points = curve.points.iter();
        let points = points.map(|&(mu, force)| (mu, force.map(|force| curve.load(force))));
        let points: Vec<(f64, Option<f64>)> = points.collect();
        panel.line(stroke, points.iter().copied());
        let end = match curve.ends_by {
            Event::CylinderSlip => BODIES_SLIP,
            _ => WALL_REACHES,
        };
        for (mark, point) in [(OWN_WEIGHT, points.first()), (end, points.last())] {
            let place = point.and_then(|&(mu, load)| Some((mu, load?)));
            let colour = stroke.colour;
            panel.marks(Mark { colour, ..mark }, place);
        }
    }
    panel.line(RIGID, spheres.rigid.iter().copied());
    panel
}

fn stroke(curve: &BodiesCurve) -> Stroke {
    BODIES_STROKES[usize::from(curve.stack.bodies - PAPER_BODIES) % BODIES_STROKES.len()]
}

fn name_curves(panel: &mut Panel, spheres: &Spheres) {
    panel.key_at(0.53, 0.6);
    let [soft, _] = SPHERES_STIFFNESSES;
    let curves = spheres.curves.iter();
    for curve in curves.filter(|curve| curve.stack.stiffness == soft) {
        let bodies = curve.stack.bodies;
        let words = match bodies {
            PAPER_BODIES => format!("n = {bodies}, cylinders"),
            _ => format!("n = {bodies}, spheres"),
        };
        panel.key(Sample::Line(stroke(curve)), &words);
    }
    panel.key(Sample::Line(RIGID), "rigid, every n");
}

fn name_ends(panel: &mut Panel) {
    panel.key_at(0.51, 0.66);
    let ends = [
        (OWN_WEIGHT, "carries its weight"),
        (WALL_REACHES, "top wall touches"),
        (BODIES_SLIP, "top body slips"),
    ];
    for (mark, words) in ends {
        panel.key(
            Sample::Mark(Mark {
                colour: INK,
                ..mark
            }),
            words,
        );
    }
}
