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
mod sheet;
mod spheres;
mod stack;
mod style;
#[cfg(test)]
mod tests;
mod theory_error;
mod yield_curves;

pub(crate) use atlas::{arm_svg, spread_svg, stiffness_svg, values_svg};
pub(crate) use laws::laws_figure;
pub use laws::laws_svg;
pub use performance::performance_svg;
pub use regimes::regimes_svg;
pub(crate) use spheres::spheres_figure;
pub use stack::{StackPanel, representative_panels, run_pdf, run_svg};

use crate::model::CRITICAL_FRICTION;
use crate::paper::reproduction::Reproduction;
use axis::Axis;
use drawing::Drawing;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use serde::Serialize;
use sheet::Sheet;

/// A figure with its caption.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Figure {
    /// Name of its files, without extension.
    pub name: &'static str,
    /// The content of the figure and its runs.
    pub caption: String,
    #[serde(skip)]
    wide: Drawing,
    #[serde(skip)]
    narrow: Drawing,
}

impl Figure {
    /// Creates a figure from its layouts for wide and for narrow pages.
    fn new(name: &'static str, caption: impl Into<String>, [wide, narrow]: [Drawing; 2]) -> Self {
        Self {
            name,
            caption: caption.into(),
            wide,
            narrow,
        }
    }

    fn of_sheet(name: &'static str, caption: impl Into<String>, sheet: &Sheet) -> Self {
        Self::new(name, caption, [sheet.wide(), sheet.narrow()])
    }

    /// Returns the figure as SVG.
    pub fn svg(&self) -> String {
        self.wide.svg()
    }

    /// Returns the figure as SVG with one panel below the other, for screens on which the letters of [`Self::svg`]
    /// would be too small: below some 600 pixels.
    pub fn narrow_svg(&self) -> String {
        self.narrow.svg()
    }

    /// Returns the figure as a PDF page of its own size, with its letters as outlines: the same bytes on every machine.
    pub fn pdf(&self) -> Vec<u8> {
        self.wide.pdf()
    }
}

/// Draws all figures: first those of the paper, then further ones.
pub(crate) fn figures(reproduction: &Reproduction) -> Vec<Figure> {
    let draw: [fn(&Reproduction) -> Figure; 8] = [
        |own| yield_curves::yield_curves(&own.yield_curves, &own.curves, own.published.as_ref()),
        |own| scaling::scaling(own),
        |own| force_series::force_series(&own.force_series, own.published.as_ref()),
        |own| convergence::convergence(&own.convergence, own.published.as_ref()),
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

/// Formats a stiffness in words, as a power of ten.
fn stiffness_words(stiffness: f64) -> String {
    format!("kₙ r/(m g) = {}", axis::power_of_ten(stiffness))
}

/// Formats a floor friction in words; the critical one by its name.
fn friction_words(mu: f64) -> String {
    if mu == CRITICAL_FRICTION {
        "μ = μ_{c}".to_owned()
    } else {
        format!("μ = {mu}")
    }
}
