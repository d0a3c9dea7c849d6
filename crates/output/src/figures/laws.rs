//! What the contact law of a code does to the yield force.

use super::Figure;
use super::axis::{Axis, power_of_ten};
use super::codes;
use super::drawing::Stroke;
use super::panel::{Anchor, Panel};
use super::sheet::Sheet;
use super::style::{GUIDE, Mark};
use crate::code::Code;
use crate::model::{CRITICAL_FRICTION, ContactConvention};
use crate::study::yield_force::{Judgement, LawCurve, law_curves};

/// The stiffnesses of the two panels.
const STIFFNESSES: [f64; 2] = [1e2, 1e4];

/// Draws the figure of the page on contact laws as SVG.
pub fn laws_svg(judgements: &[Judgement]) -> String {
    laws_figure(judgements).svg()
}

/// Draws the slip onset of every convention over the floor friction, by theory and by the codes, and the largest
/// force by theory.
pub(crate) fn laws_figure(judgements: &[Judgement]) -> Figure {
    let mut codes: Vec<(Code, ContactConvention)> = Vec::new();
    for row in judgements {
        if !codes.iter().any(|(code, _)| *code == row.code) {
            codes.push((row.code.clone(), row.study.convention));
        }
    }
    let ratio = judgements
        .first()
        .map_or(1.0, |row| row.study.stack.stiffness_ratio);
    let curves = law_curves(&codes, &STIFFNESSES, ratio);
    let panels = STIFFNESSES.map(|stiffness| panel(stiffness, judgements, &curves));
    let caption = "Not in the paper: what a contact law does to the yield force. Load $F + 3 = (f + 3mg)/(mg)$ at which \
                   the floor begins to slip, over the floor friction $\\mu$, for Hertz contacts of one material ($\\nu = 0.3$), \
                   (a) at a stiffness $K r\\sqrt r/(mg)$ of $10^2$, (b) at $10^4$. Lines: exact limits under the convention of each style, \
                   solid the onset of slip, dashed the largest force where it is another one; marks: the codes, \
                   extrapolated to vanishing wall speed. Springs that are rescaled while a contact opens have the \
                   limit of those that are not, since every contact is loaded all the way.";
    let sheet = Sheet::of_halves(panels).with_key(codes::key(judgements));
    Figure::of_sheet("laws", caption, &sheet)
}

fn panel(stiffness: f64, judgements: &[Judgement], curves: &[LawCurve]) -> Panel {
    let highest = 3.0 * stiffness;
    let mut panel = Panel::new(Axis::friction(), codes::load_axis((3.0, highest)));
    panel.upright(GUIDE, CRITICAL_FRICTION);
    panel.words("μ_{c}", (CRITICAL_FRICTION + 0.006, 3.6), Anchor::Start);
    panel.words(
        format!("stiffness {}", power_of_ten(stiffness)),
        (0.11, 0.6 * highest),
        Anchor::Start,
    );
    let load = |force: Option<f64>| force.map(|force| force + 3.0);
    for curve in curves.iter().filter(|curve| curve.stiffness == stiffness) {
        let colour = Mark::of(&curve.code).colour;
        let points = curve.points.iter();
        panel.line(
            Stroke::new(colour, 0.8, &[4.0, 3.0]),
            points.clone().map(|&(mu, _, peak)| (mu, load(peak))),
        );
        panel.line(
            Stroke::new(colour, 1.4, &[]),
            points.map(|&(mu, onset, _)| (mu, load(onset))),
        );
    }
    let own: Vec<Judgement> = judgements
        .iter()
        .filter(|row| row.stiffness() == stiffness)
        .cloned()
        .collect();
    codes::mark(&mut panel, &own, Mark::small, |row| {
        Some((row.mu(), row.slip()?.force + 3.0))
    });
    panel
}
