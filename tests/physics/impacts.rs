//! Impacts: their exact values by a second route, and what differs from them.

mod equations;

use crate::common::{Bench, json_rows, standard_output};
use equations::Equations;
use insta::assert_snapshot;
use std::f64::consts::PI;
use tristack::code::{Identity, SettledCode};
use tristack::dem::run_contact_test;
use tristack::model::{
    Arms, ContactConvention, ContactTest, CoulombOperand, DampingGrowth, HistoryUpdate, Impact,
    ImpactTarget, Law, Power, SlidingSpring, TangentialHistory, TensileForce,
};
use tristack::runs::{ImpactReading, ImpactRun};
use tristack::series::Rebound;
use tristack::study::impact::{
    ImpactFinding, ImpactQuantity, ImpactStudy, Reference, plan_impacts,
};
use tristack::study::{MIN_TOLERANCE, Study, Verdict};
use tristack::theory::{integrated_impact, normal_impact, sliding_change};

/// The paper's convention with a law of this power.
fn of_power(power: Power) -> ContactConvention {
    ContactConvention::with_law(Law::of_power(power))
}

/// A convention in which nothing is the paper's: Hertz's law, arms, no pulling, damping that grows like the stiffness.
fn another() -> ContactConvention {
    ContactConvention {
        arms: Arms::reciprocal(-0.5, -1.0),
        law: Law {
            history: TangentialHistory::Force,
            damping: DampingGrowth::Viscoelastic,
            floor_kappa: Some(2.0),
            ..Law::HERTZ
        },
        tensile_force: TensileForce::NeverPulls,
        moment_of_inertia: 0.4,
        ..ContactConvention::TURNING
    }
}

/// A convention whose damping Coulomb's limit does not cap.
fn unlimited_damping() -> ContactConvention {
    ContactConvention {
        arms: Arms::reciprocal(-0.5, -0.5),
        coulomb_operand: CoulombOperand::Spring,
        sliding_spring: SlidingSpring::FollowsLimit,
        history_update: HistoryUpdate::Linearised,
        tensile_force: TensileForce::NeverPulls,
        ..ContactConvention::TURNING
    }
}

fn impact(target: ImpactTarget, convention: ContactConvention, restitution: f64) -> Impact {
    Impact {
        target,
        convention: ContactConvention {
            restitution,
            ..convention
        },
        stiffness_ratio: 1.2,
        friction: 0.05,
        approach_speed: 0.07,
        sliding_speed: 1.0,
    }
}

fn assert_close(found: f64, expected: f64, tolerance: f64, what: &str) {
    let error = (found / expected - 1.0).abs();
    assert!(error < tolerance, "{what}: {found} {expected} {error:e}");
}

/// Every law with its impacts.
fn every_impact() -> impl Iterator<Item = Impact> {
    let powers = Power::ALL.into_iter().map(of_power);
    let never_pulls = powers.clone().map(|convention| ContactConvention {
        tensile_force: TensileForce::NeverPulls,
        arms: Arms::reciprocal(-0.5, -1.0),
        ..convention
    });
    let viscoelastic = powers.clone().map(|convention| ContactConvention {
        law: Law {
            damping: DampingGrowth::Viscoelastic,
            ..convention.law
        },
        ..convention
    });
    let all = powers
        .chain(never_pulls)
        .chain(viscoelastic)
        .chain([another()]);
    all.flat_map(|convention| {
        let targets = ImpactTarget::ALL.into_iter();
        targets.flat_map(move |target| {
            [1.0, 0.8, 0.5].map(|restitution| impact(target, convention, restitution))
        })
    })
}

#[test]
fn exact_values_are_those_of_a_second_route() {
    for impact in every_impact() {
        let convention = &impact.convention;
        let what = format!("{:?} {convention:?}", impact.target);
        let equations = Equations::of(&impact);
        let [deepest, end] = equations.solve(0.0);
        let free = if equations.never_pulls {
            end[0] / -end[1]
        } else {
            0.0
        };
        for found in [normal_impact(&impact), integrated_impact(&impact).unwrap()] {
            assert_close(found.greatest_overlap, deepest[0], 1e-11, &what);
            assert_close(
                found.restitution,
                -end[1] / impact.approach_speed,
                1e-11,
                &what,
            );
            assert_close(found.force_duration, end[4], 1e-11, &what);
            assert_close(found.duration, end[4] + free, 1e-11, &what);
        }
        let [_, end] = equations.solve(impact.friction);
        let distance = if impact.target == ImpactTarget::Pair {
            2.0
        } else {
            1.0
        };
        let found = sliding_change(&impact).unwrap();
        assert_close(found.tangential_velocity, end[2] / distance, 1e-11, &what);
        assert_close(found.spin, end[3], 1e-11, &what);
    }
}

/// Formulas of the literature.
#[test]
fn exact_values_are_those_of_known_formulas() {
    for (power, target) in Power::ALL
        .into_iter()
        .flat_map(|power| ImpactTarget::ALL.map(|target| (power, target)))
    {
        let elastic = impact(target, of_power(power), 1.0);
        let (p, speed) = (power.value(), elastic.approach_speed);
        let (mass, stiffness) = match target {
            ImpactTarget::Pair => (0.5, 1.0),
            ImpactTarget::Floor => (1.0, elastic.convention.law.floor_ratio),
        };
        let depth = ((p + 1.0) * mass * speed * speed / (2.0 * stiffness)).powf(1.0 / (p + 1.0));
        let gamma = |x: f64| libm::tgamma(x);
        let part = 1.0 / (p + 1.0);
        let time = 2.0 * depth / speed * PI.sqrt() * gamma(1.0 + part) / gamma(0.5 + part);
        let found = normal_impact(&elastic);
        assert_close(found.greatest_overlap, depth, 1e-14, "depth");
        assert_close(found.duration, time, 1e-14, "time");
        assert_close(found.restitution, 1.0, 1e-15, "restitution");
        assert_close(found.total_impulse, 2.0 * speed, 1e-15, "impulse");
        // The damping ratio of a pair is that of a unit mass times the root of 2.
        let damped = impact(target, of_power(power), 0.6);
        let log = 0.6f64.ln();
        let ratio = -log / (PI * PI + log * log).sqrt() / mass.sqrt();
        let kept = (-PI * ratio / (1.0 - ratio * ratio).sqrt()).exp();
        assert_close(normal_impact(&damped).restitution, kept, 1e-14, "kept");
        // Schwager and Pöschel 2007, for a contact that never pulls.
        let mut held = damped;
        held.convention.tensile_force = TensileForce::NeverPulls;
        let (decay, frequency) = (ratio, (1.0 - ratio * ratio).sqrt());
        let angle = (2.0 * decay * frequency / (frequency * frequency - decay * decay)).atan();
        let kept = (-decay / frequency * (PI - angle)).exp();
        assert_close(normal_impact(&held).restitution, kept, 1e-14, "held");
    }
    // What Coulomb's law alone gives, on a floor without arms.
    for restitution in [1.0, 0.5] {
        let mut floor = impact(ImpactTarget::Floor, ContactConvention::TURNING, restitution);
        floor.convention.tensile_force = TensileForce::NeverPulls;
        let kept = normal_impact(&floor).restitution;
        let change = floor.friction * (1.0 + kept) * floor.approach_speed;
        let found = sliding_change(&floor).unwrap();
        assert_close(found.tangential_velocity, change, 1e-11, "velocity");
        assert_close(found.spin, change / 0.5, 1e-11, "spin");
    }
}

fn reading(run: &ImpactRun, test: &ContactTest) -> ImpactReading {
    let motion = run_contact_test(test).expect("a finite motion");
    ImpactReading {
        identity: Identity {
            code: "native".to_owned(),
            version: String::new(),
            package: None,
            program_hash: None,
            files_hash: None,
            witness: None,
        },
        rebound: Rebound::read(&motion, run.target, run.test.time_step),
    }
}

/// The judgement on the native code whose motions are altered.
fn judge(
    study: &ImpactStudy,
    alter: impl Fn(ContactTest) -> ContactTest,
) -> (Verdict, Option<ImpactFinding>) {
    let mut workloads = study.workloads().into_iter();
    let own = workloads.next().expect("its own runs").tasks;
    let own = own.iter().map(|run| reading(run, &alter(run.test)));
    let twins = workloads.map(|twin| {
        let runs = twin.tasks.iter();
        runs.map(|run| reading(run, &run.test)).collect()
    });
    let runs = std::iter::once(own.collect()).chain(twins);
    let evaluation = study.evaluate(runs.collect());
    (evaluation.grounds.verdict(), evaluation.finding)
}

#[test]
fn native_is_exact_under_every_law() {
    let powers = Power::ALL.map(of_power);
    let mut numbers = 0;
    for convention in powers.into_iter().chain([another()]) {
        for study in plan_impacts(&SettledCode::native(), convention) {
            let (verdict, finding) = judge(&study, |test| test);
            let finding = finding.expect("a number");
            assert_eq!(verdict, Verdict::Agrees, "{study:?} {finding:?}");
            assert_ne!(study.reference(), Reference::Twin);
            assert!(finding.budget.total() < 5e-6, "{study:?} {finding:?}");
            // Where two orders cancel in the last change of an extrapolation, the budget is too small, but not by more
            // than a tenth of the smallest tolerance.
            let covered = finding.budget.total() + 0.1 * MIN_TOLERANCE;
            assert!(finding.error.abs() <= covered, "{study:?} {finding:?}");
            numbers += 1;
        }
    }
    assert_eq!(numbers, 6 * 44);
}

/// The targets and quantities that are not the exact ones any more.
fn differing(
    convention: ContactConvention,
    alter: impl Fn(ContactTest) -> ContactTest + Copy,
) -> Vec<(ImpactTarget, ImpactQuantity)> {
    let studies = plan_impacts(&SettledCode::native(), convention);
    let mut differing = Vec::new();
    for study in studies {
        let found = (study.impact.target, study.quantity);
        if judge(&study, alter).0 == Verdict::Differs && !differing.contains(&found) {
            differing.push(found);
        }
    }
    differing
}

#[test]
fn a_wrong_part_of_a_convention_differs() {
    use ImpactQuantity::{Duration, GreatestOverlap, Restitution, Spin, TangentialVelocity};
    use ImpactTarget::{Floor, Pair};
    const OFF: f64 = 1.0 + 1e-3;
    let altered = |convention: ContactConvention, alter: fn(&mut ContactTest)| {
        differing(convention, |mut test| {
            alter(&mut test);
            test
        })
    };
    let hertz = of_power(Power::Hertz);
    assert_eq!(altered(hertz, |_| ()), []);
    let damping = altered(hertz, |test| {
        test.convention.restitution = 1.0 - OFF * (1.0 - test.convention.restitution);
    });
    for target in ImpactTarget::ALL {
        for quantity in [GreatestOverlap, Restitution] {
            assert!(damping.contains(&(target, quantity)), "{damping:?}");
        }
    }
    let friction = |test: &mut ContactTest| {
        test.floor_friction *= OFF;
        test.cylinder_friction *= OFF;
    };
    let oblique = [
        (Pair, TangentialVelocity),
        (Pair, Spin),
        (Floor, TangentialVelocity),
        (Floor, Spin),
    ];
    assert_eq!(altered(hertz, friction), oblique);
    let floor = altered(hertz, |test| test.convention.law.floor_ratio *= OFF);
    assert!(floor.contains(&(Floor, GreatestOverlap)) && floor.contains(&(Floor, Duration)));
    assert!(
        floor.iter().all(|(target, _)| *target == Floor),
        "{floor:?}"
    );
    // A stiffer pair has the motion of a faster clock.
    let pair = altered(hertz, |test| {
        let clock = OFF.sqrt();
        test.time_step *= clock;
        for body in &mut test.initial_motions {
            (body.vx, body.vy) = (body.vx / clock, body.vy / clock);
        }
    });
    assert!(pair.contains(&(Pair, GreatestOverlap)) && pair.contains(&(Pair, Duration)));
    let inertia = altered(hertz, |test| test.convention.moment_of_inertia *= OFF);
    assert_eq!(inertia, [(Pair, Spin), (Floor, Spin)]);
    let arm = altered(hertz, |test| test.convention.arms.floor.torque += 1e-3);
    assert_eq!(arm, [(Floor, Spin)]);
    let pulling = altered(hertz, |test| {
        test.convention.tensile_force = TensileForce::NeverPulls;
    });
    assert!(pulling.contains(&(Pair, Restitution)) && pulling.contains(&(Floor, Restitution)));
    let growth = altered(hertz, |test| {
        test.convention.law.damping = DampingGrowth::Viscoelastic;
    });
    assert!(growth.contains(&(Floor, Restitution)), "{growth:?}");
}

#[test]
fn a_contact_that_sticks_at_first_is_compared_with_a_twin() {
    let studies = plan_impacts(&SettledCode::native(), unlimited_damping());
    let twins = studies
        .iter()
        .filter(|own| own.reference() == Reference::Twin);
    assert_eq!(twins.clone().count(), 4);
    for study in twins {
        assert_eq!(judge(study, |test| test).0, Verdict::Agrees);
        let (verdict, _) = judge(study, |mut test| {
            test.convention.coulomb_operand = CoulombOperand::SpringAndDamping;
            test
        });
        assert_eq!(verdict, Verdict::Differs, "{study:?}");
    }
}

/// A remembered force that follows the limit less the damping falls below it where the damping fades.
#[test]
fn a_contact_that_sticks_again_is_compared_with_a_twin() {
    let fading = ContactConvention {
        law: Law {
            history: TangentialHistory::Force,
            damping: DampingGrowth::Viscoelastic,
            ..Law::HERTZ
        },
        sliding_spring: SlidingSpring::FollowsLimit,
        ..ContactConvention::TURNING
    };
    let studies = plan_impacts(&SettledCode::native(), fading);
    let twins = studies
        .iter()
        .filter(|own| own.reference() == Reference::Twin);
    assert_eq!(twins.clone().count(), 4);
    for study in twins {
        let (verdict, finding) = judge(study, |test| test);
        assert_eq!(verdict, Verdict::Agrees);
        let sliding = study.exact().expect("a number");
        let beside = finding.expect("a number").exact / sliding - 1.0;
        assert!((-1e-3..-1e-5).contains(&beside), "{beside:e}");
    }
}

#[test]
fn bodies_that_do_not_part_are_a_violation() {
    let study = &plan_impacts(&SettledCode::native(), ContactConvention::TURNING)[0];
    let (verdict, finding) = judge(study, |mut test| {
        test.time_step *= 0.1;
        test
    });
    assert_eq!((verdict, finding), (Verdict::Differs, None));
}

#[test]
fn the_command_judges_every_number_of_the_native_code() {
    let bench = Bench::without_codes();
    let line = "impacts --codes native --law hertz --floor-arm -0.5 --pair-arm -0.5";
    let table = standard_output(&mut bench.tristack(line));
    // Errors and uncertainties are rounding, and differ between machines.
    assert_snapshot!(without_errors(&table));
    let out = bench.path("impacts");
    let output = bench
        .tristack(&format!(
            "impacts --codes native --format json --out {}",
            out.display()
        ))
        .output()
        .expect("it runs");
    assert_eq!(output.status.code(), Some(0));
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(message.contains("44 of 44 numbers agree"), "{message}");
    let rows = json_rows(&String::from_utf8_lossy(&output.stdout));
    let of = |target: &str, quantity: &str| {
        let mut rows = rows.iter();
        let found = rows.find(|row| {
            row["target"] == target
                && row["quantity"] == quantity
                && row["declared_restitution"] == 0.5
        });
        found.expect("a row")["measured"]
            .as_f64()
            .expect("a number")
    };
    assert!((of("floor", "restitution") - 0.5).abs() < 1e-9);
    let pair: f64 = of("pair", "restitution");
    assert!((pair - 0.366_035_23).abs() < 1e-8, "{pair}");
    for file in ["impacts.csv", "impacts.json", "impacts.md"] {
        assert!(out.join(file).is_file(), "{file}");
    }
}

/// The cells without measured numbers, errors, uncertainties and tolerances.
fn without_errors(table: &str) -> String {
    let rows = table.lines().filter(|line| line.starts_with('│'));
    let rows = rows.map(|row| {
        let cells: Vec<&str> = row.trim_matches('│').split('┆').map(str::trim).collect();
        [&cells[..8], &cells[12..]].concat().join(" | ")
    });
    rows.collect::<Vec<_>>().join("\n")
}

#[test]
fn a_convention_that_a_code_does_not_have_is_refused() {
    let bench = Bench::without_codes();
    for (line, flag) in [
        ("impacts --codes liggghts --law 1.25", "--codes"),
        ("impacts --history force", "--law"),
    ] {
        let output = bench.tristack(line).output().expect("it runs");
        assert_eq!(output.status.code(), Some(1), "{line}");
        let message = String::from_utf8_lossy(&output.stderr);
        assert!(message.contains(flag), "{message}");
    }
}
