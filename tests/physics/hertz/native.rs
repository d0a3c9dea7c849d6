//! The native DEM against the limit: three wall speeds, as a crosscheck plans them, extrapolated to none.

use super::Problem;
use crate::at_rest::onset_and_peak;
use tristack::code::SettledCode;
use tristack::model::TangentialHistory;
use tristack::study::yield_force::plan;

/// Deviations of slip onset and peak, extrapolated over the wall speed, from their limits, in F + 3.
fn deviations(own: &Problem) -> [f64; 2] {
    let measurement = plan(&SettledCode::native(), &own.stack(), own.convention());
    let limit = &measurement.limit;
    assert!(measurement.is_gentle);
    let limits = [limit.slip_onset.unwrap(), limit.peak_force.unwrap()];
    let found = onset_and_peak(&measurement);
    println!("{own:?}: {found:?} {limits:?}");
    [0, 1].map(|which| (found[which] - limits[which]) / (limits[which] + 3.0))
}

#[test]
fn onset_of_the_native_dem_is_the_limit_without_a_closed_contact() {
    for (history, mu) in [
        (TangentialHistory::Displacement, 0.21),
        (TangentialHistory::Force, 0.29),
    ] {
        let own = Problem {
            mu,
            history,
            floor_ratio: std::f64::consts::SQRT_2,
            arms: [-0.5, 0.0, 0.0, 0.0],
            ..Problem::HERTZ
        };
        let [onset, _] = deviations(&own);
        assert!(onset.abs() < 1e-6, "{history} {onset:e}");
    }
}

#[test]
fn onset_and_peak_of_the_native_dem_are_the_limits_with_a_closed_contact() {
    for (history, kappa) in [
        (TangentialHistory::Displacement, 1.3),
        (TangentialHistory::Force, 0.95),
    ] {
        let own = Problem {
            kappa,
            history,
            stiffening: true,
            arms: [-0.5; 4],
            ..Problem::HERTZ
        };
        let [onset, peak] = deviations(&own);
        assert!(onset.abs() < 1e-6, "{history} {onset:e}");
        // A fold, passed at a finite speed.
        assert!(peak.abs() < 1e-4, "{history} {peak:e}");
    }
}
