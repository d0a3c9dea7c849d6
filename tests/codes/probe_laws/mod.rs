//! The probe of laws other than the linear one: what is declared is found, and what is not as declared is named.

mod twin;

use tristack::code::{Code, Declaration};
use tristack::dem::{run_contact_test, run_contact_test_with};
use tristack::model::{
    Arms, ContactConvention, ContactTest, CoulombOperand, DampingGrowth, Law, Power, SlidingSpring,
    TangentialHistory, TangentialStiffening,
};
use tristack::series::Motion;
use tristack::study::Verdict;
use tristack::study::convention::{Finding, probe};
use twin::Twin;

/// A part of the scale of a property: what rounding leaves of 64-bit forces in micro-tests is some 1e-11.
const ROUNDING: f64 = 1e-9;

fn convention(law: Law) -> ContactConvention {
    ContactConvention {
        arms: Arms::reciprocal(-0.5, -0.5),
        ..ContactConvention::with_law(law)
    }
}

/// What the probe finds of a code that answers by `motion`, `convention` being declared.
fn findings(
    convention: ContactConvention,
    motion: impl Fn(&ContactTest) -> Motion,
) -> Vec<Finding> {
    let declaration = Declaration {
        convention,
        velocity_lag: 0.5,
        left_out: Vec::new(),
        in_space: false,
    };
    let answers = |tests: &[ContactTest]| Ok::<_, ()>(tests.iter().map(&motion).collect());
    let properties = probe(&declaration, answers).expect("the native DEM answers");
    let code = Code::named("yade").expect("a built-in code");
    let judged = properties.into_iter().map(|own| own.judge(&code, ""));
    judged.collect()
}

fn native(test: &ContactTest) -> Motion {
    run_contact_test(test).expect("a finite motion")
}

/// The native code whose law is another one than it is asked for.
fn with_law(test: &ContactTest, law: Law) -> Motion {
    let mut other = *test;
    other.convention.law = law;
    native(&other)
}

/// Names of the properties that are not as declared.
fn not_as_declared(findings: &[Finding]) -> Vec<&str> {
    let off = findings.iter().filter(|own| own.verdict != Verdict::Agrees);
    off.map(|own| own.property.as_str()).collect()
}

fn is_of_cycle(property: &str) -> bool {
    property.contains("_cycle_work_")
}

/// Names of the properties of free motions that contradict what is declared; the work of cycles follows from them.
fn differing(findings: &[Finding]) -> Vec<String> {
    let off = findings.iter();
    let off = off.filter(|own| own.verdict == Verdict::Differs && !is_of_cycle(&own.property));
    off.map(|own| own.property.clone()).collect()
}

#[test]
fn every_law_is_found_as_it_is_declared() {
    let mut laws: Vec<Law> = Power::ALL.map(Law::of_power).into();
    for history in TangentialHistory::ALL {
        for tangential_stiffening in TangentialStiffening::ALL {
            laws.push(Law {
                history,
                tangential_stiffening,
                floor_kappa: Some(1.7),
                floor_ratio: 1.2,
                ..Law::HERTZ
            });
        }
    }
    laws.push(Law {
        history: TangentialHistory::Force,
        ..Law::LINEAR
    });
    laws.push(Law {
        damping: DampingGrowth::Viscoelastic,
        ..Law::HERTZ
    });
    for law in laws {
        for (coulomb_operand, sliding_spring) in [
            (CoulombOperand::SpringAndDamping, SlidingSpring::Frozen),
            (CoulombOperand::Spring, SlidingSpring::FollowsLimit),
        ] {
            let convention = ContactConvention {
                coulomb_operand,
                sliding_spring,
                ..convention(law)
            };
            let findings = findings(convention, native);
            assert_eq!(not_as_declared(&findings), Vec::<&str>::new(), "{law}");
            // Contacts turn by so little that the change of a spring's length by it is known to a few digits only, and the
            // contact of a pair turns in a cycle.
            let others = findings
                .iter()
                .filter(|own| own.property != "pair_history_update" && !is_of_cycle(&own.property));
            for own in others {
                let Some((declared, measured)) = own.declared.zip(own.measured) else {
                    continue;
                };
                let scale = if declared == 0.0 { 1.0 } else { declared.abs() };
                let off = ((measured - declared) / scale).abs();
                assert!(off <= ROUNDING, "{law} {own:?}");
            }
        }
    }
}

/// The properties that differ where `law` is declared and the native code has the `other` one.
fn told_apart(law: Law, other: Law) -> Vec<String> {
    let findings = findings(convention(law), |test| with_law(test, other));
    differing(&findings)
}

#[test]
fn each_part_of_a_law_that_is_not_as_declared_differs() {
    let hertz = Law::HERTZ;
    let cases: [(Law, &[&str]); 8] = [
        (
            Law {
                floor_ratio: 1.001 * hertz.floor_ratio,
                ..hertz
            },
            &[
                "floor_normal_stiffness",
                "floor_normal_damping",
                "floor_tangential_stiffness",
                "floor_tangential_damping",
                "floor_ratio",
            ],
        ),
        (
            Law {
                floor_kappa: Some(1.001 * 1.25),
                ..hertz
            },
            &[
                "floor_stiffness_ratio",
                "floor_tangential_stiffness",
                "floor_tangential_damping",
            ],
        ),
        (
            Law {
                tangential_stiffening: TangentialStiffening::Every,
                ..hertz
            },
            &["pair_tangential_stiffening", "floor_tangential_stiffening"],
        ),
        (
            Law {
                tangential_stiffening: TangentialStiffening::Pairs,
                ..hertz
            },
            &["pair_tangential_stiffening"],
        ),
        (
            Law {
                damping: DampingGrowth::Viscoelastic,
                ..hertz
            },
            &[
                "pair_normal_damping_exponent",
                "pair_tangential_damping_exponent",
                "floor_normal_damping_exponent",
                "floor_tangential_damping_exponent",
            ],
        ),
        (
            Law {
                history: TangentialHistory::Force,
                ..hertz
            },
            &["pair_history_force_share", "floor_history_force_share"],
        ),
        (
            Law {
                history: TangentialHistory::DisplacementRescaled,
                ..hertz
            },
            &["pair_history_rescaling", "floor_history_rescaling"],
        ),
        (
            Law {
                history: TangentialHistory::ForceRescaled,
                ..hertz
            },
            &[
                "pair_history_force_share",
                "pair_history_rescaling",
                "floor_history_force_share",
                "floor_history_rescaling",
            ],
        ),
    ];
    for (other, expected) in cases {
        assert_eq!(told_apart(hertz, other), expected, "{other}");
        assert_eq!(told_apart(other, hertz), expected, "{other}");
    }
    let soft = Law {
        power: Power::FiveQuarters,
        ..hertz
    };
    let exponents: Vec<String> = told_apart(hertz, soft);
    for kind in ["pair", "floor", "wall"] {
        assert!(exponents.contains(&format!("{kind}_normal_force_exponent")));
    }
}

/// The properties that differ where Hertz's law with the history is declared and the twin has what `change` makes of it.
fn changed(history: TangentialHistory, change: impl Fn(&mut Twin)) -> Vec<String> {
    let convention = convention(Law {
        history,
        ..Law::HERTZ
    });
    let findings = findings(convention, |test| {
        let mut twin = Twin::asked_for(test);
        change(&mut twin);
        run_contact_test_with(test, twin).expect("a finite motion")
    });
    differing(&findings)
}

/// The same of both histories that are not rescaled.
fn changed_by(change: impl Fn(&mut Twin)) -> Vec<String> {
    let found = changed(TangentialHistory::Displacement, &change);
    assert_eq!(found, changed(TangentialHistory::Force, &change));
    found
}

#[test]
fn each_number_of_a_law_that_is_off_by_a_thousandth_differs() {
    assert_eq!(changed_by(|_| {}), Vec::<String>::new());
    let tangential = changed_by(|twin| {
        twin.stiffness[0][1] *= 1.001;
        twin.stiffness[1][1] *= 0.999;
    });
    let expected = ["pair", "floor"].map(|kind| {
        ["stiffness_ratio", "tangential_stiffness"].map(|name| format!("{kind}_{name}"))
    });
    assert_eq!(tangential, expected.concat());
    let normal = changed_by(|twin| twin.stiffness[0][0] *= 1.001);
    let of_pair = [
        "pair_normal_stiffness",
        "pair_stiffness_ratio",
        "floor_ratio",
    ];
    assert_eq!(normal, of_pair);
    let exponent = changed_by(|twin| twin.power += 1e-3);
    // κ is p K/k_t.
    let of_power = [
        "pair_normal_force_exponent",
        "pair_stiffness_ratio",
        "floor_normal_force_exponent",
        "floor_stiffness_ratio",
        "wall_normal_force_exponent",
    ];
    assert_eq!(exponent, of_power);
    for (change, property) in [
        (
            (|twin: &mut Twin| twin.tangential_exponent += 1e-3) as fn(&mut Twin),
            "tangential_stiffness_exponent",
        ),
        (|twin| twin.stiffening = [1e-3; 2], "tangential_stiffening"),
        (
            |twin| twin.force_share = (twin.force_share - 1e-3).abs(),
            "history_force_share",
        ),
        (|twin| twin.rescaling += 1e-3, "history_rescaling"),
    ] {
        let expected = ["pair", "floor"].map(|kind| format!("{kind}_{property}"));
        assert_eq!(changed_by(change), expected);
    }
    let arms = changed_by(|twin| twin.arm += 1e-3);
    let expected = ["pair", "floor"].map(|kind| {
        ["torque_arm", "kinematic_arm", "damping_arm"].map(|name| format!("{kind}_{name}"))
    });
    assert_eq!(arms, expected.concat());
}

/// Damping that no manifest can declare is measured like any other, and changes nothing else.
#[test]
fn damping_of_any_kind_is_measured() {
    for exponents in [[0.5, 0.5], [0.0, 0.25], [0.25, 0.0]] {
        let damping = [[0.07, 0.05], [0.11, 0.02]];
        let findings = findings(convention(Law::HERTZ), |test| {
            let mut twin = Twin::asked_for(test);
            twin.damping_exponents = exponents;
            // Cycles are driven without damping.
            if test.drive.is_none() {
                twin.damping = damping;
            }
            run_contact_test_with(test, twin).expect("a finite motion")
        });
        let is_damping = |name: &&str| name.contains("l_damping");
        let off = not_as_declared(&findings).into_iter();
        assert_eq!(off.filter(|own| !is_damping(own)).count(), 0);
        for (kind, damping) in ["pair", "floor"].into_iter().zip(damping) {
            for (direction, index) in [("normal", 0), ("tangential", 1)] {
                let own = |ending: &str| {
                    let name = format!("{kind}_{direction}_{ending}");
                    let found = findings.iter().find(|own| own.property == name);
                    let found = found.expect("a property");
                    assert_eq!(found.declared.is_some(), exponents[index] > 0.0);
                    found.measured.expect("a number")
                };
                assert!((own("damping") - damping[index]).abs() < ROUNDING);
                assert!((own("damping_exponent") - exponents[index]).abs() < ROUNDING);
            }
        }
    }
}

/// Work of both cycles at a contact, in units of the energy of its spring, in which nothing turns and nothing slides.
fn cycle_work(findings: &[Finding], kind: &str) -> [f64; 2] {
    ["sheared", "pressed"].map(|first| {
        let name = format!("{kind}_cycle_work_{first}_first");
        let found = findings.iter().find(|own| own.property == name);
        let own = found.expect("a property");
        assert_eq!(own.verdict, Verdict::Agrees, "{own:?}");
        own.measured.expect("a number")
    })
}

#[test]
fn energy_that_a_law_makes_in_a_closed_cycle_is_measured_and_named() {
    for history in TangentialHistory::ALL {
        let convention = convention(Law {
            history,
            ..Law::HERTZ
        });
        let findings = findings(convention, native);
        // The tangential stiffness of the higher overlap is twice that of the lower one.
        let expected = match history {
            TangentialHistory::Displacement => [-0.5, 0.5],
            TangentialHistory::Force => [0.5, -0.5],
            TangentialHistory::DisplacementRescaled => [-0.5, 1.0],
            TangentialHistory::ForceRescaled => [0.5, 0.5],
        };
        for kind in ["pair", "floor"] {
            let work = cycle_work(&findings, kind);
            for (work, expected) in work.into_iter().zip(expected) {
                assert!((work - expected).abs() < 1e-6, "{history} {kind} {work}");
            }
        }
        let made = findings.iter().filter_map(Finding::energy_made);
        let expected = expected.iter().filter(|work| **work < 0.0).count();
        assert_eq!(made.count(), 2 * expected, "{history}");
    }
}

#[test]
fn the_work_of_a_cycle_differs_where_the_history_is_another_one_than_declared() {
    for history in TangentialHistory::ALL {
        let declared = Law {
            history: TangentialHistory::Force,
            ..Law::HERTZ
        };
        let other = Law {
            history,
            ..Law::HERTZ
        };
        let findings = findings(convention(declared), |test| with_law(test, other));
        let differs =
            |own: &&Finding| is_of_cycle(&own.property) && own.verdict == Verdict::Differs;
        let expected = match history {
            TangentialHistory::Force => 0,
            // Only what is released while it is sheared is rescaled.
            TangentialHistory::ForceRescaled => 2,
            TangentialHistory::Displacement | TangentialHistory::DisplacementRescaled => 4,
        };
        assert_eq!(
            findings.iter().filter(differs).count(),
            expected,
            "{history}"
        );
    }
}

#[test]
fn a_linear_law_is_not_driven() {
    let findings = findings(convention(Law::LINEAR), native);
    assert!(findings.iter().all(|own| !own.property.contains("cycle")));
}

/// A spring that turns by half of what its contact does: the part that is left behind is turned into twice, by the sine of half
/// the turn, so that a quarter of it is seen.
#[test]
fn a_spring_that_follows_by_half_is_neither_fixed_nor_turned() {
    let found = findings(convention(Law::LINEAR), |test| {
        let twin = Twin {
            follows: 0.5,
            ..Twin::asked_for(test)
        };
        run_contact_test_with(test, twin).expect("a finite motion")
    });
    let share = found
        .iter()
        .find(|own| own.property == "pair_spring_left_behind");
    let share = share.expect("a share");
    let measured = share.measured.expect("a number");
    assert!((measured - 0.25).abs() < 1e-4, "{measured}");
    assert_eq!(share.verdict, Verdict::Differs);
}
