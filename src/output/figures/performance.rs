//! What a step costs each target, and how native lanes scale.

use super::axis::Axis;
use super::panel::{Anchor, Panel, draw};
use super::style::{BAR, EXACT, GUIDE, POINT};
use crate::output::BenchRow;
use crate::output::number::plain;
use crate::study::cost::{Scaling, ScalingRow};

/// Distance of the words of a bar from the bar, in bars.
const ABOVE: f64 = 0.27;

/// Time per step and case of each of `rows` as bars, and the speed-up of native lanes over the number of cases.
pub fn performance_svg(rows: &[BenchRow], scaling: &Scaling) -> String {
    let panels = [costs(rows), speedups(&scaling.cases)];
    draw(&panels, 2, super::HALF_PAGE).svg()
}

fn costs(rows: &[BenchRow]) -> Panel {
    let largest = rows.iter().map(|row| row.ns_per_step).fold(1e3, f64::max);
    let time = Axis::log("ns per step and case", (1.0, 2.0 * largest));
    let mut panel = Panel::new(time, Axis::bare((0.4, rows.len() as f64 + 0.8)));
    for (place, row) in rows.iter().rev().enumerate() {
        let y = place as f64 + 1.0;
        panel.line(BAR, [(1.0, Some(y)), (row.ns_per_step, Some(y))]);
        let ratio = row.ratio.map_or_else(String::new, |ratio| {
            format!(", {} times native-lanes", plain(ratio))
        });
        let words = format!("{}: {} ns{ratio}", row.code, plain(row.ns_per_step));
        panel.words(words, (1.2, y + ABOVE), Anchor::Start);
    }
    panel
}

fn speedups(rows: &[ScalingRow]) -> Panel {
    let most = rows.iter().map(|row| row.cases).max().unwrap_or(1) as f64;
    let fastest = rows.iter().map(|row| row.speedup).fold(1.0, f64::max);
    let mut panel = Panel::new(
        Axis::log("cases on one core", (0.8, 1.5 * most.max(10.0))),
        Axis::around("times as fast as one case", (0.0, 1.15 * fastest)),
    );
    let points = || rows.iter().map(|row| (row.cases as f64, row.speedup));
    panel.level(GUIDE, 1.0);
    panel.line(
        EXACT,
        points().map(|(cases, speedup)| (cases, Some(speedup))),
    );
    panel.marks(POINT, points());
    panel
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_contestant_has_a_bar_and_every_number_of_cases_a_mark() {
        let row = |code, ns_per_step| BenchRow {
            code,
            version: String::new(),
            ns_per_step,
            steps: 1,
            runs: 1,
            ratio: Some(ns_per_step / 10.0),
            start_up_seconds: 0.0,
            yield_forces_per_second: 1.0,
            yield_force_ratio: None,
            largest_error: 0.0,
            peak_megabytes: None,
        };
        let cases = [1, 8].map(|cases| ScalingRow {
            cases,
            cores: 1,
            ns_per_step: 40.0 / cases as f64,
            speedup: cases as f64,
        });
        let scaling = Scaling {
            cases: cases.to_vec(),
            cores: Vec::new(),
        };
        let svg = performance_svg(&[row("native-lanes", 10.0), row("yade", 5e3)], &scaling);
        assert!(svg.contains("yade: 5000 ns, 500 times native-lanes"));
        assert_eq!(svg.matches("<circle").count(), 2);
        assert!(!svg.contains("NaN"));
    }
}
