//! The verdict on the distances between a code and its twin at successively halved time steps.

use super::distance::Distance;
use super::documented::DocumentedOrder;
use crate::study::{Ground, Grounds, Verdict};
use std::f64::consts::LN_2;

/// Largest distance of the wall force up to its peak that agrees, at the finest time step, in units of the
/// peak.
pub const FORCE_TOLERANCE: f64 = 1e-6;

/// Largest deviation from a documented order that agrees. Orders are whole numbers, which a tolerance of 1/2 could
/// not tell apart; half of this one still would.
pub const ORDER_TOLERANCE: f64 = 0.25;

/// The order seen in distances.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ObservedOrder {
    /// log₂ of the ratio of two distances.
    pub order: f64,
    /// Its uncertainty from the next order in the time step.
    pub curvature: f64,
    /// Its uncertainty from rounding.
    pub noise: f64,
}

impl ObservedOrder {
    /// The sum of both uncertainties.
    pub fn uncertainty(&self) -> f64 {
        self.curvature + self.noise
    }
}

/// log₂ of the ratio of two distances, the second at half the time step of the first; `None` if one of them
/// is zero.
pub(crate) fn order_between(coarse: &Distance, fine: &Distance) -> Option<f64> {
    let ratio = coarse.largest / fine.largest;
    (ratio.is_finite() && ratio > 0.0).then(|| libm::log2(ratio))
}

/// The order seen in three distances, from the pair that shows it best.
///
/// A distance C hᵖ (1 + B h) gives the order p + B h/(2 ln 2) between h and h/2, and half of that excess
/// between h/2 and h/4. The difference of the two orders is therefore the excess of the finer pair, and half
/// the excess of the coarser one, which rounding disturbs less.
pub(crate) fn observed_order(distances: &[Distance]) -> Option<ObservedOrder> {
    let [coarse, middle, fine] = distances else {
        return None;
    };
    let (first, second) = (order_between(coarse, middle)?, order_between(middle, fine)?);
    let change = (first - second).abs();
    let noise =
        |a: &Distance, b: &Distance| (a.round_off / a.largest + b.round_off / b.largest) / LN_2;
    let coarser = ObservedOrder {
        order: first,
        curvature: 2.0 * change,
        noise: noise(coarse, middle),
    };
    let finer = ObservedOrder {
        order: second,
        curvature: change,
        noise: noise(middle, fine),
    };
    let coarser_is_better = coarser.uncertainty() < finer.uncertainty();
    Some(if coarser_is_better { coarser } else { finer })
}

/// Collects the grounds that `distances`, coarsest time step first, give for or against their documented order. The
/// finest distance must not exceed its round-off where only rounding is documented, or otherwise `step_error`, the
/// largest change of the twin itself when its time step is halved.
pub(crate) fn judge_order(
    documented: DocumentedOrder,
    distances: &[Distance],
    step_error: f64,
) -> Grounds {
    let mut grounds = Grounds::new();
    let Some(finest) = distances.last() else {
        grounds.add(Ground::Missing("there are no distances".to_owned()));
        return grounds;
    };
    let (limit, name) = match documented {
        DocumentedOrder::RoundOff => (finest.round_off, "what rounding can do"),
        _ => (step_error, "what the time step does to the twin itself"),
    };
    let note = format!(
        "the distance {:.1e} exceeds {name}, {limit:.1e}",
        finest.largest
    );
    grounds.compare(finest.largest, 0.0, limit, Some(note));
    let order = match documented {
        DocumentedOrder::RoundOff | DocumentedOrder::Irregular => return grounds,
        DocumentedOrder::First => 1.0,
        DocumentedOrder::Second => 2.0,
    };
    if grounds.verdict() == Verdict::Agrees {
        judge_whole_order(order, finest, observed_order(distances), &mut grounds);
    }
    grounds
}

/// Distances below this multiple of their round-off have noise above [`ORDER_TOLERANCE`] in their order.
const NEAR_ROUND_OFF: f64 = 2.0 / (ORDER_TOLERANCE * LN_2);

fn judge_whole_order(
    expected: f64,
    finest: &Distance,
    observed: Option<ObservedOrder>,
    grounds: &mut Grounds,
) {
    let Some(seen) = observed else {
        if finest.largest > finest.round_off {
            grounds.add(Ground::Doubt("too few time steps for an order".to_owned()));
        }
        return;
    };
    // Distances this close to rounding show no order.
    let near = finest.largest <= NEAR_ROUND_OFF * finest.round_off;
    let error = seen.order - expected;
    if near && seen.noise > ORDER_TOLERANCE && error.abs() <= seen.uncertainty() {
        return;
    }
    let note = format!(
        "the order is {:.2} ± {:.2}, documented is {expected}",
        seen.order,
        seen.uncertainty()
    );
    grounds.compare(error, seen.uncertainty(), ORDER_TOLERANCE, Some(note));
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Distances at steps 1, 1/2 and 1/4.
    fn distances(law: impl Fn(f64) -> f64, round_off: f64) -> Vec<Distance> {
        let at = |time_step: f64| Distance {
            time_step,
            largest: law(time_step),
            rms: law(time_step),
            first_above: [None; 3],
            round_off,
        };
        [1.0, 0.5, 0.25].map(at).to_vec()
    }

    fn verdict(order: DocumentedOrder, distances: &[Distance]) -> Verdict {
        judge_order(order, distances, 1e-3).verdict()
    }

    #[test]
    fn a_distance_that_is_lost_in_rounding_at_one_step_alone_decides_nothing() {
        let mut lost = distances(|_| 1e-4, 1e-12);
        lost[1].largest = 1e-12;
        assert_eq!(
            verdict(DocumentedOrder::First, &lost),
            Verdict::Inconclusive
        );
    }

    #[test]
    fn a_distance_of_the_right_order_must_also_be_small() {
        let large = distances(|h| 1e-1 * h, 1e-12);
        assert_eq!(verdict(DocumentedOrder::First, &large), Verdict::Differs);
    }

    #[test]
    fn a_documented_order_agrees_and_another_differs() {
        let first = distances(|h| 1e-5 * h, 1e-12);
        let second = distances(|h| 1e-5 * h * h, 1e-12);
        let none = distances(|_| 1e-5, 1e-12);
        assert_eq!(verdict(DocumentedOrder::First, &first), Verdict::Agrees);
        assert_eq!(verdict(DocumentedOrder::Second, &second), Verdict::Agrees);
        for (order, wrong) in [
            (DocumentedOrder::First, &second),
            (DocumentedOrder::First, &none),
            (DocumentedOrder::Second, &first),
            (DocumentedOrder::RoundOff, &none),
        ] {
            assert_eq!(verdict(order, wrong), Verdict::Differs, "{order:?}");
        }
    }

    #[test]
    fn the_next_order_is_allowed_for_in_the_uncertainty() {
        for slope in [-0.1, 0.1] {
            let seen = observed_order(&distances(|h| 1e-5 * h * (1.0 + slope * h), 0.0)).unwrap();
            // The bound is of first order in the slope; terms of its square remain.
            assert!(
                (seen.order - 1.0).abs() < 1.1 * seen.uncertainty(),
                "{seen:?}"
            );
            assert!(seen.uncertainty() < ORDER_TOLERANCE);
        }
    }

    #[test]
    fn rounding_hides_an_order_without_deciding_against_it() {
        let hidden = distances(|h| 1e-5 * h, 5e-6);
        assert_eq!(verdict(DocumentedOrder::Second, &hidden), Verdict::Agrees);
        let clear = distances(|h| 1e-5 * h, 1e-7);
        assert_eq!(verdict(DocumentedOrder::Second, &clear), Verdict::Differs);
    }

    #[test]
    fn distances_that_fall_irregularly_decide_nothing_about_an_order() {
        let mut irregular = distances(|h| 1e-5 * h, 1e-12);
        irregular[1].largest *= 0.7;
        assert_eq!(
            verdict(DocumentedOrder::First, &irregular),
            Verdict::Inconclusive
        );
    }

    #[test]
    fn the_coarser_pair_speaks_where_rounding_drowns_the_finer() {
        let mut noisy = distances(|h| 1e-5 * h * h, 0.0);
        noisy[2].round_off = 1e-6;
        let seen = observed_order(&noisy).unwrap();
        assert!((seen.order - 2.0).abs() < 1e-12 && seen.uncertainty() < 1e-12);
    }

    #[test]
    fn what_falls_irregularly_must_stay_below_the_error_of_the_step() {
        let small = distances(|h| 1e-5 * h.powi(3), 0.0);
        assert_eq!(
            judge_order(DocumentedOrder::Irregular, &small, 1e-6).verdict(),
            Verdict::Agrees
        );
        assert_eq!(
            judge_order(DocumentedOrder::Irregular, &small, 1e-8).verdict(),
            Verdict::Differs
        );
    }

    #[test]
    fn nothing_and_not_a_number_are_no_pass() {
        assert_eq!(verdict(DocumentedOrder::First, &[]), Verdict::Missing);
        let nan = distances(|_| f64::NAN, 1e-12);
        for order in [
            DocumentedOrder::First,
            DocumentedOrder::RoundOff,
            DocumentedOrder::Irregular,
        ] {
            assert_eq!(verdict(order, &nan), Verdict::Inconclusive);
        }
        let two = &distances(|h| 1e-5 * h, 1e-12)[..2];
        assert_eq!(verdict(DocumentedOrder::First, two), Verdict::Inconclusive);
    }

    #[test]
    fn no_distance_at_all_is_no_doubt() {
        assert_eq!(
            verdict(DocumentedOrder::First, &distances(|_| 0.0, 0.0)),
            Verdict::Agrees
        );
    }
}
