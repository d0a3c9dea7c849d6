//! The cost of a step, and the scaling of native lanes.

use super::axis::Axis;
use super::panel::{Anchor, Panel};
use super::sheet::Sheet;
use super::style::{BAR, EXACT, GUIDE, POINT};
use crate::bench::{beside_lanes, times_lanes};
use crate::number::plain;
use crate::study::cost::{Scaling, ScalingRow, StackCost};

/// Distance of a bar from its words, in units of the distance between bars.
const ABOVE: f64 = 0.27;

/// Draws time per step and case of each of `costs` as bars, and the speed-up of native lanes over the cases.
pub fn performance_svg(costs: &[StackCost], scaling: &Scaling) -> String {
    let panels = [bars(costs), speedups(&scaling.cases)];
    Sheet::of_halves(panels).wide().svg()
}

fn bars(costs: &[StackCost]) -> Panel {
    let largest = costs.iter().map(StackCost::median).fold(1e3, f64::max);
    let time = Axis::log("ns per step and case", (1.0, 2.0 * largest));
    let mut panel = Panel::new(time, Axis::bare((0.4, costs.len() as f64 + 0.8)));
    for (place, row) in beside_lanes(costs).iter().rev().enumerate() {
        let (y, ns_per_step) = (place as f64 + 1.0, row.0.median());
        panel.line(BAR, [(1.0, y), (ns_per_step, y)]);
        let ratio = times_lanes(row).map_or_else(String::new, |ratio| {
            format!(", {} times native-lanes", plain(ratio))
        });
        let words = format!(
            "{}: {} ns{ratio}",
            row.0.target.as_str(),
            plain(ns_per_step)
        );
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
    panel.line(EXACT, points());
    panel.marks(POINT, points());
    panel
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::code::Code;
    use crate::study::cost::BenchTarget;

    #[test]
    fn every_target_has_a_bar_and_every_number_of_cases_a_mark() {
        let cost = |target, ns_per_step| StackCost {
            target,
            version: String::new(),
            steps: 1,
            nanoseconds: vec![ns_per_step],
            start_up_seconds: vec![0.0],
            seconds_per_yield_force: vec![1.0],
            largest_error: 0.0,
            peak_bytes: None,
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
        let costs = [
            cost(BenchTarget::NativeLanes, 10.0),
            cost(BenchTarget::External(Code::named("yade").unwrap()), 5e3),
        ];
        let svg = performance_svg(&costs, &scaling);
        assert!(svg.contains("yade: 5000 ns, 500 times native-lanes"));
        assert_eq!(svg.matches("<circle").count(), 2);
        assert!(!svg.contains("NaN"));
    }
}
