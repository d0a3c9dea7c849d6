//! The figures: each computed from runs and theory, none from a stored picture.

mod axis;
mod codes;
mod convergence;
mod drawing;
mod force_series;
mod model_form;
mod panel;
mod performance;
mod preparation;
mod regimes;
mod scaling;
mod stack;
mod style;
#[cfg(test)]
mod tests;
mod theory_error;
mod yield_curves;

pub(crate) use performance::performance_svg;
pub(crate) use regimes::regimes_svg;
pub use stack::{StackPanel, representative_panels, run_svg};

use crate::model::CRITICAL_FRICTION;
use crate::paper::reproduction::Reproduction;
use axis::Axis;
use drawing::Drawing;
use serde::Serialize;

/// A panel that shares the width of a page with another one, in pixels.
const HALF_PAGE: (f64, f64) = (350.0, 320.0);
/// A panel that shares the width of a page with two others.
const THIRD_OF_PAGE: (f64, f64) = (262.0, 250.0);

/// A figure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Figure {
    /// The name of its files, without extension.
    pub name: &'static str,
    /// What it shows, from which runs, and how to make it again.
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

    /// The figure as SVG.
    pub fn svg(&self) -> String {
        self.drawing.svg()
    }

    /// The figure as a page of its own size, with its font embedded: the same bytes on every machine.
    pub fn pdf(&self) -> Vec<u8> {
        self.drawing.pdf()
    }
}

/// Every figure: those of the paper first, then what the paper lacks.
pub(crate) fn figures(reproduction: &Reproduction) -> Vec<Figure> {
    let Reproduction {
        yield_curves: curves_measured,
        scaling: scaling_measured,
        exponents,
        curves,
        ..
    } = reproduction;
    let mut figures = vec![
        yield_curves::yield_curves(curves_measured, curves),
        scaling::scaling(scaling_measured, exponents, curves),
        force_series::force_series(&reproduction.force_series),
        convergence::convergence(&reproduction.convergence),
        theory_error::theory_error(curves),
        model_form::model_form(curves_measured, curves),
        regimes::regimes(&reproduction.maps, &reproduction.survey),
        stack::stack(&reproduction.snapshots),
    ];
    figures.extend(
        reproduction
            .preparation
            .first()
            .map(preparation::preparation),
    );
    figures
}

fn stiffness_axis() -> Axis {
    Axis::log("stiffness kₙ r/(m g)", (6e0, 2e6))
}

/// A friction in a figure, the critical one by its name.
fn friction_words(mu: f64) -> String {
    if mu == CRITICAL_FRICTION {
        "μ = μ_{c}".to_owned()
    } else {
        format!("μ = {mu}")
    }
}
