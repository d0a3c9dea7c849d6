//! The effect of the codes' torque arms and turning springs on the yield force.

use super::Figure;
use super::axis::{Axis, power_of_ten};
use super::codes;
use super::panel::{Anchor, Panel, Sample};
use super::sheet::Sheet;
use super::style::{GUIDE, Mark, STIFFNESS_STROKES};
use crate::code::{Code, SettledCode};
use crate::model::{CRITICAL_FRICTION, PAPER_STIFFNESS_RATIO};
use crate::paper::reproduction::Curves;
use crate::study::yield_force::{Judgement, PAPER_STIFFNESSES};

/// Panels whose curves stay above this value, in percent, have the finer axis.
const SMALL: f64 = -2.0;

/// Draws the difference to the yield force under the paper's convention, by theory and by the codes, for each limit.
pub(super) fn model_form(judgements: &[Judgement], curves: &Curves) -> Figure {
    let groups = &curves.codes_by_limit;
    let panels: Vec<Panel> = groups
        .iter()
        .map(|codes| arms_panel(codes, judgements, curves))
        .collect();
    let letters = ('a'..).zip(groups).map(|(letter, codes)| {
        let [pair, floor] = arms(&codes[0]).map(|arm| arm.replace('−', "-"));
        match pair == floor {
            true => format!("({letter}) $r_1 = {pair}$ between cylinders and at the floor"),
            false => {
                format!("({letter}) $r_1 = {pair}$ between cylinders and ${floor}$ at the floor")
            }
        }
    });
    let letters: Vec<String> = letters.collect();
    let caption = format!(
        "Not in the paper: $(F - F_\\mathrm{{paper}})/(F_\\mathrm{{paper}} + 3)$, what the convention of a code \
         does to the yield force $F = f/(mg)$, over the floor friction $\\mu$ at three stiffnesses $k_n r/(mg)$ \
         and $\\kappa = {PAPER_STIFFNESS_RATIO}$: springs that turn with their contacts, and the torque arms $r + r_1\\cdot$overlap. Lines: \
         exact limits; marks: the codes, by slip onset extrapolated to vanishing wall speed. {}; the paper has $r_1 = 0$ and a spring \
         that nothing turns.",
        letters.join(", ")
    );
    Figure::of_sheet("model-form", caption, &Sheet::of_halves(panels))
}

/// Formats the torque arm coefficients of pair and floor.
fn arms(code: &SettledCode) -> [String; 2] {
    let arms = code.convention().arms;
    [arms.pair.torque, arms.floor.torque].map(|arm| {
        let text = if arm == -0.5 {
            "-1/2".to_owned()
        } else {
            arm.to_string()
        };
        text.replace('-', "−")
    })
}

fn arms_panel(codes: &[SettledCode], judgements: &[Judgement], curves: &Curves) -> Panel {
    let own = curves.model_form.iter();
    let own = own.filter(|point| point.code == *codes[0].name());
    let lowest = own
        .map(|point| 100.0 * point.difference)
        .fold(0.0, f64::min);
    let (axis, key, words) = if lowest > SMALL {
        let axis = Axis::linear(LABEL, (SMALL, 6.0), 1.0, 0);
        (axis, (0.05, 0.14), (0.1, 5.4))
    } else {
        let axis = Axis::linear(LABEL, (-25.0, 5.0), 5.0, 0);
        (axis, (0.05, 0.5), (0.1, 3.2))
    };
    let names: Vec<Code> = codes.iter().map(|own| own.name().clone()).collect();
    let mut panel = panel(axis, &names, judgements, curves);
    panel.key_at(key.0, key.1);
    panel.words(
        format!("arms {}", arms(&codes[0]).join(", ")),
        words,
        Anchor::Start,
    );
    panel
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
        let points = points.map(|point| (point.mu, 100.0 * point.difference));
        panel.line(stroke, points);
        panel.key(Sample::Line(stroke), &power_of_ten(stiffness));
    }
    for code in codes {
        let own = judgements.iter();
        let own = own.filter(|row| row.code == *code);
        panel.marks(Mark::of(code), own.filter_map(measured));
        codes::name(&mut panel, code);
    }
    panel
}

/// Returns the measured difference in percent. The error of a row is relative to its own limit + 3, which differs
/// from the paper's by the model form.
fn measured(row: &Judgement) -> Option<(f64, f64)> {
    let (error, model_form) = row.error().zip(row.model_form())?;
    let ratio = (1.0 + error) * (1.0 + model_form);
    Some((row.mu(), 100.0 * (ratio - 1.0)))
}
