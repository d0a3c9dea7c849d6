//! The supplement's figure on wall speed and time step.

use super::Figure;
use super::axis::Axis;
use super::codes;
use super::panel::{Anchor, Panel, Point, Sample};
use super::sheet::Sheet;
use super::style::{GUIDE, Mark, THIN, TOGETHER};
use crate::code::Code;
use crate::paper::claims::number;
use crate::paper::published::{Published, PublishedForce};
use crate::paper::reproduction::{Convergence, ConvergencePoint, FAST_WALL, convergence_stack};
use crate::study::yield_force::{PAPER_TIME_STEP, PAPER_WALL_SPEED};

/// The largest distance from the limit shown.
const EXCESS: f64 = 3e1;
const CHANGE: (f64, f64) = (1e-5, 3e-2);
/// The slowest wall shown.
const SLOWEST: f64 = 2e-8;
/// The published figure on wall speed.
const PUBLISHED_SPEEDS: &str = "figS3b";
/// Distance of two marks that stand side by side for the same wall speed, as a part of the panel.
const ABREAST: f64 = 0.022;

/// A setting, and the force that is shown of the run with it.
type Run = (f64, Option<f64>);
type Force = fn(&ConvergencePoint) -> Option<f64>;

/// Draws the distance of peak and slip onset from the limit over the wall speed, and their change with the time step.
pub(super) fn convergence(study: &Convergence, published: Option<&Published>) -> Figure {
    // The points are labelled in the unit of the paper, but were made in that of the program.
    let place = |own: &PublishedForce| {
        let speed = own.labelled[0] / own.stack.stiffness.sqrt();
        Some((speed, (own.value.value / own.limit? - 1.0).abs()))
    };
    let points = published.into_iter();
    let points = points.flat_map(|own| own.of_figure(PUBLISHED_SPEEDS).filter_map(place));
    let lowest = points.fold((SLOWEST, 1e-4), |lowest: Point, point: Point| {
        (lowest.0.min(0.5 * point.0), lowest.1.min(0.5 * point.1))
    });
    let mut peaks = speeds(study, "F_{peak}", lowest, ConvergencePoint::excess_of_peak);
    codes::published(&mut peaks, published, PUBLISHED_SPEEDS, place);
    let slowest = (SLOWEST, 1e-8);
    let panels = [
        peaks,
        speeds(study, "F_{slip}", slowest, ConvergencePoint::excess_of_slip),
        steps(study, "F_{peak}", |point| point.peak_force),
        steps(study, "F_{slip}", |point| point.slip_force),
    ];
    let stack = convergence_stack();
    let caption = format!(
        "Supplement, figure on convergence: $\\mu = {}$, $k_n r/(mg) = {}$, $\\kappa = {}$. Distance (a) of the largest wall \
         force ($F_\\mathrm{{peak}}$, the paper's yield force) and (b) of the force at the onset of slip ($F_\\mathrm{{slip}}$) \
         from the exact limit under each code's own convention, over the wall speed $v$ at $\\Delta t = {}\\sqrt{{m/k_n}}$; marks side by \
         side on one band belong to the same wall speed, that in its middle. \
         What the time step $\\Delta t$ changes (c) of the peak and (d) of the slip onset at $v = {}\\,r\\sqrt{{k_n/m}}$, \
         relative to the same code at $\\Delta t = {}\\sqrt{{m/k_n}}$. Lines join the native runs, which stand at their speed; vertical: the paper's \
         settings.{}",
        number(stack.floor_friction),
        number(stack.stiffness),
        number(stack.stiffness_ratio),
        number(PAPER_TIME_STEP),
        number(FAST_WALL),
        number(PAPER_TIME_STEP),
        codes::published_words(
            published,
            "points of (a), at the speeds of their program, which are $\\sqrt{k_n r/(mg)} = 100$ times smaller than their labels"
        )
    );
    let key = shown_codes(study).into_iter();
    let key = key.map(|code| (Sample::Mark(Mark::of(&code)), code.label()));
    Figure::of_sheet(
        "convergence",
        caption,
        &Sheet::of_halves(panels).with_key(key),
    )
}

fn shown_codes(study: &Convergence) -> Vec<Code> {
    Code::distinct(study.time_steps.iter().map(|point| &point.code))
}

/// Draws the distance of a force from the limit over the wall speed. The codes stand side by side, since they would
/// hide each other.
fn speeds(study: &Convergence, symbol: &str, lowest: Point, excess: Force) -> Panel {
    let range = (lowest.1, EXCESS);
    let mut panel = Panel::new(
        Axis::log("wall speed v/(r √(kₙ/m))", (lowest.0, 5e-3)),
        Axis::log(&format!("|{symbol} − F_{{limit}}|/F_{{limit}}"), range),
    );
    let codes = shown_codes(study);
    let mut speeds: Vec<f64> = study.wall_speeds.iter().map(|own| own.wall_speed).collect();
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    for speed in speeds {
        panel.band(TOGETHER, speed, ABREAST * (codes.len() + 1) as f64);
    }
    setting(&mut panel, PAPER_WALL_SPEED, range);
    for (index, code) in codes.into_iter().enumerate() {
        let own = study.wall_speeds.iter();
        let own = own.filter(|point| point.code == code);
        let aside = ABREAST * place_abreast(index);
        let mut points: Vec<Run> = own
            .map(|point| {
                (
                    panel.beside(point.wall_speed, aside),
                    excess(point).map(f64::abs),
                )
            })
            .collect();
        points.sort_by(|one, other| one.0.total_cmp(&other.0));
        codes::runs(&mut panel, THIN, &code, &points);
    }
    panel
}

/// Returns the place of a mark beside others: 0 for the first, which a line joins, then 1, −1, 2, −2.
fn place_abreast(index: usize) -> f64 {
    let distance = index.div_ceil(2) as f64;
    if index % 2 == 1 { distance } else { -distance }
}

fn steps(study: &Convergence, symbol: &str, force: Force) -> Panel {
    let label = format!("|{symbol}(Δt)/{symbol}(10⁻³) − 1|");
    let mut panel = Panel::new(
        Axis::log("time step Δt/√(m/kₙ)", (5e-5, 2e-1)),
        Axis::log(&label, CHANGE),
    );
    setting(&mut panel, PAPER_TIME_STEP, CHANGE);
    for code in shown_codes(study) {
        let mut points = changes(&study.time_steps, &code, force);
        points.sort_by(|one, other| one.0.total_cmp(&other.0));
        codes::runs(&mut panel, THIN, &code, &points);
    }
    panel
}

/// Returns the change of a force of `code` with the time step, relative to the force at the paper's time step, which
/// is left out.
fn changes(points: &[ConvergencePoint], code: &Code, force: Force) -> Vec<Run> {
    let own = || points.iter().filter(|point| point.code == *code);
    let mut paper = own().filter(|point| point.time_step == PAPER_TIME_STEP);
    let Some(paper) = paper.next().and_then(force) else {
        return Vec::new();
    };
    let change = |point: &ConvergencePoint| {
        let other = point.time_step != PAPER_TIME_STEP;
        let force = force(point).filter(|_| other)?;
        Some((force / paper - 1.0).abs())
    };
    own()
        .map(|point| (point.time_step, change(point)))
        .collect()
}

/// Draws a setting of the paper as a vertical line.
fn setting(panel: &mut Panel, value: f64, (low, high): Point) {
    panel.line(GUIDE, [(value, low), (value, high)]);
    panel.words(
        "paper",
        (panel.beside(value, 0.015), 1.25 * low),
        Anchor::Start,
    );
}
