//! Stiff stacks: exponents and prefactors of docs/theory.md, section 11.4.

use super::Problem;
use tristack::model::{CRITICAL_FRICTION, Power, TangentialHistory};

/// F at μ_c and this stiffness.
fn peak(own: Problem, stiffness: f64) -> f64 {
    let own = Problem {
        mu: CRITICAL_FRICTION,
        stiffness,
        ..own
    };
    let limit = own.limit();
    limit
        .peak_force
        .unwrap_or_else(|| panic!("{own:?} {limit:?}"))
}

#[test]
fn without_a_closed_contact_the_force_at_mu_c_has_exponent_and_prefactor_of_the_power() {
    let mu = CRITICAL_FRICTION;
    for power in Power::ALL {
        for floor_ratio in [1.0, 1.6] {
            let own = Problem {
                power,
                floor_ratio,
                kappa: 5.6,
                ..Problem::HERTZ
            };
            let p = power.value();
            // Eq. 86 with d = a.
            let compliance = own.kappa * (1.0 + floor_ratio.powf(-1.0 / p)) / p;
            let slope = 1.0 / (mu * mu * (1.0 + 2.0 * compliance * mu));
            let law = |stiffness: f64| {
                2.0 * (mu * slope).powf(p / (1.0 + p)) * stiffness.powf(1.0 / (1.0 + p))
            };
            let [coarse, fine] = [1e15, 1e16].map(|stiffness| peak(own, stiffness));
            assert!(
                ((fine / coarse).log10() - 1.0 / (1.0 + p)).abs() < 1e-5,
                "{power}"
            );
            assert!(
                (fine / law(1e16) - 1.0).abs() < 1e-5,
                "{power} {}",
                fine / law(1e16)
            );
        }
    }
}

#[test]
fn the_peak_after_a_slip_with_a_closed_contact_has_one_prefactor_for_all_materials() {
    for (kappa, floor_ratio) in [(0.9, 1.1), (1.4, 1.5)] {
        let own = Problem {
            kappa,
            floor_ratio,
            ..Problem::HERTZ
        };
        let [coarse, fine] = [1e15, 1e16].map(|stiffness| peak(own, stiffness));
        assert!(((fine / coarse).log10() - 0.4).abs() < 1e-5);
        let law = 2.0 * 3f64.powf(0.3) * 1e16f64.powf(0.4);
        assert!((fine / law - 1.0).abs() < 1e-5, "{}", fine / law);
    }
}

/// The path under own weight keeps a part in the force, which fades slowly.
#[test]
fn a_remembered_force_has_the_same_exponent_and_comes_to_its_prefactor_more_slowly() {
    let mu = CRITICAL_FRICTION;
    let own = Problem {
        history: TangentialHistory::Force,
        kappa: 5.6,
        ..Problem::HERTZ
    };
    let compliance = own.kappa * (1.0 + own.floor_ratio.powf(-1.0 / 1.5));
    let slope = 1.0 / (mu * mu * (1.0 + 2.0 * compliance * mu));
    let ratios = [1e8, 1e12, 1e16].map(|stiffness: f64| {
        let law = 2.0 * (mu * slope).powf(0.6) * stiffness.powf(0.4);
        (peak(own, stiffness) / law - 1.0).abs()
    });
    assert!(ratios[2] < ratios[1] && ratios[1] < ratios[0], "{ratios:?}");
    assert!(ratios[2] < 2e-4, "{ratios:?}");
}

/// Where contact 2-3 is closed the onset has a limit for rigid cylinders that depends on the law, below that of the peak.
#[test]
fn below_mu_c_the_onset_of_rigid_cylinders_depends_on_the_law_and_the_peak_does_not() {
    let own = Problem {
        mu: 0.2,
        kappa: 1.3,
        ..Problem::HERTZ
    };
    let at = |stiffness| Problem { stiffness, ..own }.limit();
    let [soft, stiff] = [1e9, 1e10].map(at);
    let rigid = (3.0 * own.mu - CRITICAL_FRICTION) / (CRITICAL_FRICTION - own.mu);
    assert!((stiff.peak_force.unwrap() / rigid - 1.0).abs() < 1e-5);
    let [soft, stiff] = [soft, stiff].map(|limit| limit.slip_onset.unwrap());
    assert!((stiff / soft - 1.0).abs() < 1e-5 && stiff < 0.8 * rigid);
}
