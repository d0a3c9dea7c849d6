//! The supplement's figure of the wall force over time.

use super::Figure;
use super::axis::Axis;
use super::codes;
use super::panel::{Anchor, Panel, Point, Sample};
use super::sheet::Sheet;
use super::style::{EXACT, GUIDE, ONSET, PEAK, PUBLISHED_CURVE};
use crate::paper::claims::number;
use crate::paper::published::{Published, WALL_STARTS};
use crate::paper::reproduction::{ForceSeries, force_series_stack};

/// Unit of printed times.
const LONG: f64 = 1e4;
/// Range of the second panel below the limit, in units of the excess of the peak over the limit.
const BELOW: f64 = 12.0;
/// The same above the limit.
const ABOVE: f64 = 3.0;

/// Draws the wall force over time, as a whole and around its peak.
pub(super) fn force_series(series: &ForceSeries, published: Option<&Published>) -> Figure {
    let panels = [whole(series, published), around_the_peak(series)];
    let stack = force_series_stack();
    let caption = format!(
        "Supplement, figure of f(t). (a) Force $F = f/(mg)$ of the wall over the time $t$ at $\\mu = {}$, \
             $k_n r/(mg) = {}$, $\\kappa = {}$ and the paper's wall speed $v = {}\\,r\\sqrt{{k_n/m}}$ and time step ${}\\sqrt{{m/k_n}}$: one native run. (b) The same around the peak, which the paper takes for the yield force; \
             circle: onset of slip at the floor, diamond: peak, dashed: exact quasi-static limit.{}",
        number(stack.floor_friction),
        number(stack.stiffness),
        number(stack.stiffness_ratio),
        number(series.wall_speed),
        number(series.time_step),
        codes::published_words(
            published,
            "series in (a), over the way of the wall, since its speed and its time have other units than the paper says; \
             that wall starts above the stack, at the height of cylinders that do not overlap"
        )
    );
    Figure::of_sheet("force-series", caption, &Sheet::of_halves(panels))
}

fn whole(series: &ForceSeries, published: Option<&Published>) -> Panel {
    let published = published.and_then(|published| published.series.first());
    let published = published.map(|own| {
        let speed = own.published.wall_speed().unwrap_or(series.wall_speed);
        let rows = own.published.rows.iter();
        let rows = rows.map(|(_, [time, force])| {
            let way = speed * (time.value - WALL_STARTS);
            (way / series.wall_speed / LONG, force.value)
        });
        rows.collect::<Vec<Point>>()
    });
    let peak = published.as_deref().map_or(0.0, |rows| highest(rows).0);
    let end = series.rows.last().map_or(LONG, |row| row.0) / LONG;
    let end = end.max(1.05 * peak);
    let highest = series.peak_force.unwrap_or(1.0);
    let time = Axis::around("time t/(10⁴ √(m/kₙ))", (0.0, 1.04 * end));
    let force = Axis::around("wall force F = f/(m g)", (0.0, 1.15 * highest));
    let mut panel = Panel::new(time, force);
    if let Some(limit) = series.limit {
        panel.level(GUIDE, limit);
        panel.words("exact limit", (0.02 * end, 1.02 * limit), Anchor::Start);
    }
    let rows = series.rows.iter();
    panel.line(EXACT, rows.map(|&(time, force)| (time / LONG, force)));
    if let Some(rows) = published {
        let shown = rows.into_iter();
        let shown = shown.filter(|&(time, _)| (0.0..=1.04 * end).contains(&time));
        panel.line(PUBLISHED_CURVE, shown);
        panel.key(Sample::Line(EXACT), "native");
        panel.key(Sample::Line(PUBLISHED_CURVE), "published");
        panel.key_at(0.66, 0.82);
    }
    panel
}

fn around_the_peak(series: &ForceSeries) -> Panel {
    let peak = highest(&series.rows);
    let limit = series.limit.unwrap_or(peak.1);
    let smallest = f64::max(1e-9 * peak.1.abs(), f64::MIN_POSITIVE);
    let excess = (peak.1 - limit).abs().max(smallest);
    let (low, high) = (limit - BELOW * excess, limit + ABOVE * excess);
    let reach = reach(&series.rows, peak, low);
    let time = "time after the peak (t − t_{peak})/√(m/kₙ)";
    let mut panel = Panel::new(
        Axis::around(time, (-reach, reach)),
        Axis::around("wall force F = f/(m g)", (low, high)),
    );
    panel.level(GUIDE, limit);
    let rows = series.rows.iter();
    panel.line(EXACT, rows.map(|&(time, force)| (time - peak.0, force)));
    let slip = series.slip_force;
    let slip = slip.and_then(|force| first_reaching(&series.rows, force));
    panel.marks(ONSET, slip.map(|slip| (slip.0 - peak.0, slip.1)));
    panel.marks(PEAK, [(0.0, peak.1)]);
    panel.key(Sample::Mark(PEAK), "peak");
    panel.key(Sample::Mark(ONSET), "slip onset");
    panel.key(Sample::Line(GUIDE), "exact limit");
    panel.key_at(0.63, 0.4);
    panel
}

fn highest(rows: &[Point]) -> Point {
    let highest = rows.iter().max_by(|one, other| one.1.total_cmp(&other.1));
    highest.copied().unwrap_or((0.0, 0.0))
}

/// Returns the largest distance in time from the peak among the rows around it that are above `low`, at least 1.
fn reach(rows: &[Point], peak: Point, low: f64) -> f64 {
    let (before, after) = rows.split_at(rows.partition_point(|row| row.0 < peak.0));
    let above = |row: &&Point| row.1 > low;
    let before = before.iter().rev().take_while(above);
    let rows = before.chain(after.iter().take_while(above));
    rows.map(|row| (row.0 - peak.0).abs()).fold(1.0, f64::max)
}

/// Returns the point at which the wall force first reaches `force`, by interpolation between two rows.
fn first_reaching(rows: &[Point], force: f64) -> Option<Point> {
    let mut pairs = rows.windows(2);
    let pair = pairs.find(|pair| (pair[0].1..pair[1].1).contains(&force))?;
    let part = (force - pair[0].1) / (pair[1].1 - pair[0].1);
    Some((pair[0].0 + part * (pair[1].0 - pair[0].0), force))
}
