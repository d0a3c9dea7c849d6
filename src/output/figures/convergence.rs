//! The supplement's figure on wall speed and time step.

use super::Figure;
use super::axis::Axis;
use super::codes;
use super::panel::{Anchor, Panel, Point, Stroke};
use super::style::{GUIDE, THIN, THIN_DASHED};
use crate::code::Code;
use crate::model::Power;
use crate::paper::reproduction::{Convergence, ConvergencePoint, FAST_WALL};
use crate::study::yield_force::{PAPER_TIME_STEP, PAPER_WALL_SPEED};

const EXCESS: (f64, f64) = (1e-8, 1e2);
const CHANGE: (f64, f64) = (1e-6, 1e1);

/// Lower end of the key on the axis.
const BELOW_KEY: f64 = 2e-3;

/// A setting, and the force shown of the run with it.
type Run = (f64, Option<f64>);
type Force = fn(&ConvergencePoint) -> Option<f64>;

/// Distance of peak and slip onset from the limit over the wall speed, and their change with the time step.
pub(super) fn convergence(study: &Convergence) -> Figure {
    let mut peaks = steps(study, "F_{peak}", |point| point.peak_force);
    let slips = steps(study, "F_{slip}", |point| point.slip_force);
    let caption = format!(
        "Supplement, figure on convergence: μ = 0.2, kₙ r/(m g) = 10⁴, κ = 2.5. (a) Distance of the largest wall \
         force (F_peak, the paper's yield force; solid) and of the force at the onset of slip (F_slip; dashed) \
         from the exact limit under each code's own convention, over the wall speed v at Δt = {:e} √(m/kₙ). \
         (b) What the time step Δt changes of the peak and (c) of the slip onset at v = {FAST_WALL:e} r √(kₙ/m), \
         relative to the same code at Δt = {:e} √(m/kₙ). Lines join the native runs; vertical: the paper's \
         settings.",
        PAPER_TIME_STEP, PAPER_TIME_STEP
    );
    peaks.key_at(0.03, 0.02);
    for code in Code::of_power(Power::Linear) {
        if study.time_steps.iter().any(|point| point.code == code) {
            codes::name(&mut peaks, code);
        }
    }
    let panels = [speeds(study), peaks, slips];
    Figure::of_thirds("convergence", caption, &panels)
}

fn speeds(study: &Convergence) -> Panel {
    let mut panel = Panel::new(
        Axis::log("wall speed v/(r √(kₙ/m))", (3e-8, 3e-3)),
        Axis::log("|F − F_{limit}|/F_{limit}", EXCESS),
    );
    setting(&mut panel, PAPER_WALL_SPEED, EXCESS);
    let runs = |code: Code, force: Force| -> Vec<Run> {
        let own = study.wall_speeds.iter();
        let own = own.filter(|point| point.code == code);
        own.map(|point| (point.wall_speed, force(point).map(f64::abs)))
            .collect()
    };
    curve(&mut panel, THIN, |code| {
        runs(code, ConvergencePoint::excess_of_peak)
    });
    curve(&mut panel, THIN_DASHED, |code| {
        runs(code, ConvergencePoint::excess_of_slip)
    });
    panel.words("peak", (1.5e-5, 6e-1), Anchor::End);
    panel.words("slip onset", (1.5e-5, 1e-6), Anchor::Start);
    panel
}

fn steps(study: &Convergence, symbol: &str, force: Force) -> Panel {
    let label = format!("|{symbol}(Δt)/{symbol}(10⁻³) − 1|");
    let mut panel = Panel::new(
        Axis::log("time step Δt/√(m/kₙ)", (3e-5, 3e-1)),
        Axis::log(&label, CHANGE),
    );
    setting(&mut panel, PAPER_TIME_STEP, (CHANGE.0, BELOW_KEY));
    curve(&mut panel, THIN, |code| {
        changes(&study.time_steps, code, force)
    });
    panel
}

/// The change of a force of `code` with the time step, relative to the force at the paper's time step, which is left
/// out.
fn changes(points: &[ConvergencePoint], code: Code, force: Force) -> Vec<Run> {
    let own = || points.iter().filter(|point| point.code == code);
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

/// The runs of every code.
fn curve(panel: &mut Panel, stroke: Stroke, runs: impl Fn(Code) -> Vec<Run>) {
    for code in Code::of_power(Power::Linear) {
        let mut points = runs(code);
        points.sort_by(|one, other| one.0.total_cmp(&other.0));
        codes::runs(panel, stroke, code, &points);
    }
}

/// A setting of the paper, as a vertical line.
fn setting(panel: &mut Panel, value: f64, (low, high): Point) {
    panel.line(GUIDE, [(value, low), (value, high)]);
    panel.words("paper", (1.15 * value, 2.0 * low), Anchor::Start);
}
