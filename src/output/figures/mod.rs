//! The figures, each computed from runs and theory.

mod atlas;
mod axis;
mod codes;
mod convergence;
mod drawing;
mod force_series;
mod laws;
mod model_form;
mod panel;
mod performance;
mod preparation;
mod regimes;
mod scaling;
mod spheres;
mod stack;
mod style;
#[cfg(test)]
mod tests;
mod theory_error;
mod yield_curves;

pub(crate) use atlas::{arm_svg, spread_svg, stiffness_svg, values_svg};
pub(crate) use laws::{laws_figure, laws_svg};
pub(crate) use performance::performance_svg;
pub(crate) use regimes::regimes_svg;
pub(crate) use spheres::spheres_figure;
pub use stack::{StackPanel, representative_panels, run_pdf, run_svg};

use crate::model::CRITICAL_FRICTION;
use crate::paper::reproduction::Reproduction;
use axis::Axis;
use drawing::Drawing;
use panel::{Panel, draw};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use serde::Serialize;

/// Size in pixels of a panel that shares the width of a page with another one.
const HALF_PAGE: (f64, f64) = (350.0, 320.0);
/// Size in pixels of a panel that shares the width of a page with two others.
const THIRD_OF_PAGE: (f64, f64) = (262.0, 250.0);

/// A figure with its caption.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Figure {
    /// Name of its files, without extension.
    pub name: &'static str,
    /// The content of the figure, its runs, and the command that makes it.
    pub caption: String,
    #[serde(skip)]
    drawing: Drawing,
}

impl Figure {
    fn new(name: &'static str, caption: impl Into<String>, drawing: Drawing) -> Self {
        let caption: String = caption.into();
        let files = format!(
            "Made by `tristack report --out DIR`: figures/{name}.svg and figures/{name}.pdf."
        );
        Self {
            name,
            caption: format!("{caption} {files}"),
            drawing,
        }
    }

    /// A figure of panels, two side by side.
    fn of_halves(name: &'static str, caption: impl Into<String>, panels: &[Panel]) -> Self {
        Self::new(name, caption, draw(panels, 2, HALF_PAGE))
    }

    /// A figure of panels, three side by side.
    fn of_thirds(name: &'static str, caption: impl Into<String>, panels: &[Panel]) -> Self {
        Self::new(name, caption, draw(panels, 3, THIRD_OF_PAGE))
    }

    /// The figure as SVG.
    pub fn svg(&self) -> String {
        self.drawing.svg()
    }

    /// The figure as a page of its own size, with its letters as outlines: the same bytes on every machine.
    pub fn pdf(&self) -> Vec<u8> {
        self.drawing.pdf()
    }
}

/// All figures: first those of the paper, then further ones.
pub(crate) fn figures(reproduction: &Reproduction) -> Vec<Figure> {
    let draw: [fn(&Reproduction) -> Figure; 8] = [
        |own| yield_curves::yield_curves(&own.yield_curves, &own.curves),
        |own| scaling::scaling(&own.scaling, &own.exponents, &own.curves, &own.laws),
        |own| force_series::force_series(&own.force_series),
        |own| convergence::convergence(&own.convergence),
        |own| theory_error::theory_error(&own.curves),
        |own| model_form::model_form(&own.yield_curves, &own.curves),
        |own| regimes::regimes(&own.maps, &own.survey),
        |own| stack::stack(&own.snapshots),
    ];
    let mut figures: Vec<Figure> = draw.par_iter().map(|draw| draw(reproduction)).collect();
    let first = reproduction.preparation.first();
    figures.extend(first.map(preparation::preparation));
    figures
}

fn stiffness_axis() -> Axis {
    Axis::log("stiffness kₙ r/(m g)", (6e0, 2e6))
}

/// A floor friction in words; the critical one by its name.
fn friction_words(mu: f64) -> String {
    if mu == CRITICAL_FRICTION {
        "μ = μ_{c}".to_owned()
    } else {
        format!("μ = {mu}")
    }
}
