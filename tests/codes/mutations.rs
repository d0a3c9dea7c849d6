//! A table of wrong codes: twins of the native DEM with one line changed, and the studies that notice.

use std::path::Path;
use tristack::code::{
    Batching, Code, Failure, Finished, InstalledCode, Interrupt, RunContext, SettledCode,
};
use tristack::code::{Identity, Provenance, Run};
use tristack::dem::{
    Composite, Contact, ContactForce, ContactModel, Counterpart, compress_stack,
    compress_stack_with, run_contact_test, run_contact_test_with,
};
use tristack::model::{
    Arms, Case, ContactConvention, ContactTest, HistoryUpdate, Power, Pyramid, Stack,
};
use tristack::runs::Store;
use tristack::runs::{Progress, Recorded, SelectedCode, Settings};
use tristack::series::{Motion, PyramidRun, Series};
use tristack::study::MIN_TOLERANCE;
use tristack::study::convention::{Findings, passport, probe_all};
use tristack::study::impact::plan_impacts;
use tristack::study::preparation::plan_preparation;
use tristack::study::regimes::{SurveyPlan, survey};
use tristack::study::trajectory::{plan_trajectory, trajectory_stack};
use tristack::study::yield_force::{Judgement, plan};
use tristack::study::{Campaign, Judged, Verdict};

/// The line that is changed.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Mutation {
    None,
    SignOfNormalDamping,
    SignOfTangentialDamping,
    SignOfSpin,
    TwiceTheNormalDamping,
    TwiceTheTangentialDamping,
    PairArmOffBy001,
    FloorArmOffBy001,
    FrictionOnePercentHigh,
    SpringDoesNotTurn,
    SpringGrowsWhileSliding,
    LimitWithoutNormalDamping,
    HalfTheTorqueOnPairs,
    FloorSpringGrows,
    PairSpringGrows,
    NormalForceGrows,
    NormalSpringHighByAThousandth,
    TransportHighByAThousandth,
    LimitHighByAThousandth,
    NormalDampingHighByAThousandth,
    TangentialDampingHighByAThousandth,
    /// A time-step effect of third order, which is no fault in the limit of small steps; not in the table.
    FloorMovesByItsSine,
    /// A term of third order in the speed, which no step is small enough for; not in the table.
    FloorMovesByCubedSpin,
}

const MUTATIONS: [Mutation; 15] = [
    Mutation::SignOfNormalDamping,
    Mutation::SignOfTangentialDamping,
    Mutation::SignOfSpin,
    Mutation::TwiceTheNormalDamping,
    Mutation::TwiceTheTangentialDamping,
    Mutation::PairArmOffBy001,
    Mutation::FloorArmOffBy001,
    Mutation::FrictionOnePercentHigh,
    Mutation::SpringDoesNotTurn,
    Mutation::SpringGrowsWhileSliding,
    Mutation::LimitWithoutNormalDamping,
    Mutation::HalfTheTorqueOnPairs,
    Mutation::FloorSpringGrows,
    Mutation::PairSpringGrows,
    Mutation::NormalForceGrows,
];

/// One coefficient of each term of the contact law, multiplied by 1.001.
const THOUSANDTHS: [Mutation; 5] = [
    Mutation::NormalSpringHighByAThousandth,
    Mutation::TransportHighByAThousandth,
    Mutation::LimitHighByAThousandth,
    Mutation::NormalDampingHighByAThousandth,
    Mutation::TangentialDampingHighByAThousandth,
];

/// The paper's contact law, written a second time, with one line changed.
#[derive(Debug, Clone, Copy)]
struct Twin {
    arms: Arms,
    stiffness: f64,
    normal_damping: f64,
    damping: f64,
    mutation: Mutation,
}

/// Length of the spring, and its vector for a spring that does not turn.
#[derive(Debug, Clone, Copy, Default)]
struct Memory {
    length: f64,
    vector: [f64; 2],
}

impl Twin {
    fn new(convention: &ContactConvention, stiffness_ratio: f64, mutation: Mutation) -> Self {
        let law = convention.law(stiffness_ratio);
        Self {
            arms: convention.arms,
            stiffness: law.tangential_stiffness,
            normal_damping: match mutation {
                Mutation::SignOfNormalDamping => -law.damping_normal,
                Mutation::TwiceTheNormalDamping => 2.0 * law.damping_normal,
                Mutation::NormalDampingHighByAThousandth => 1.001 * law.damping_normal,
                _ => law.damping_normal,
            },
            damping: match mutation {
                Mutation::SignOfTangentialDamping => -law.damping_tangential,
                Mutation::TwiceTheTangentialDamping => 2.0 * law.damping_tangential,
                Mutation::TangentialDampingHighByAThousandth => 1.001 * law.damping_tangential,
                _ => law.damping_tangential,
            },
            mutation,
        }
    }
}

impl Composite<f64> for Memory {
    fn visit(&mut self, other: &Self, visit: &mut impl FnMut(&mut f64, &f64)) {
        self.length.visit(&other.length, visit);
        self.vector.visit(&other.vector, visit);
    }
}

impl ContactModel<f64> for Twin {
    type Memory = Memory;

    fn initial(&self, _: f64) -> Memory {
        Memory::default()
    }

    fn evaluate(&self, contact: &Contact<f64>, memory: &mut Memory) -> ContactForce<f64> {
        let [nx, ny] = contact.normal;
        let is_pair = contact.counterpart == Counterpart::Cylinder;
        // The paper's law is reciprocal: one arm for torque and surface velocity.
        let coefficient = match self.mutation {
            Mutation::PairArmOffBy001 if is_pair => self.arms.pair.torque + 0.01,
            Mutation::FloorArmOffBy001 if !is_pair => self.arms.floor.torque + 0.01,
            _ if is_pair => self.arms.pair.torque,
            _ => self.arms.floor.torque,
        };
        let arm = 1.0 + coefficient * contact.overlap;
        let rolling = match self.mutation {
            Mutation::SignOfSpin => -(arm * contact.spin),
            _ => arm * contact.spin,
        };
        let velocity = contact.sliding_speed - rolling;
        // LAMMPS has had floors like this since 2023; the normal force is that of spheres.
        let root = contact.overlap.max(0.0).sqrt();
        let stiffness = match self.mutation {
            Mutation::FloorSpringGrows if !is_pair => self.stiffness * root,
            Mutation::PairSpringGrows if is_pair => self.stiffness * root,
            _ => self.stiffness,
        };
        let elastic = match self.mutation {
            Mutation::NormalForceGrows => contact.overlap * root,
            Mutation::NormalSpringHighByAThousandth => 1.001 * contact.overlap,
            _ => contact.overlap,
        };
        let normal = elastic - self.normal_damping * contact.separation_speed;
        let friction = match self.mutation {
            Mutation::FrictionOnePercentHigh => 1.01 * contact.friction,
            Mutation::LimitHighByAThousandth => 1.001 * contact.friction,
            _ => contact.friction,
        };
        let limit = friction
            * match self.mutation {
                Mutation::LimitWithoutNormalDamping => elastic.abs(),
                _ => normal.abs(),
            };
        if self.mutation == Mutation::SpringDoesNotTurn {
            memory.length = memory.vector[1] * nx - memory.vector[0] * ny;
        }
        if self.mutation == Mutation::TransportHighByAThousandth {
            memory.length *= 1.001;
        }
        let turn = contact.spin * contact.time_step;
        let further = match self.mutation {
            Mutation::FloorMovesByItsSine if !is_pair => arm * (turn.powi(3) / 6.0),
            Mutation::FloorMovesByCubedSpin if !is_pair => {
                arm * (1e-3 * contact.spin.powi(3) * contact.time_step)
            }
            _ => 0.0,
        };
        let growth = velocity * contact.time_step + further;
        let stretched = memory.length + growth;
        let trial = -(stiffness * stretched) - self.damping * velocity;
        let sticks = trial.abs() < limit;
        if sticks || self.mutation == Mutation::SpringGrowsWhileSliding {
            memory.length = stretched;
            memory.vector[0] -= growth * ny;
            memory.vector[1] += growth * nx;
        }
        let tangential = match (sticks, trial < 0.0) {
            (true, _) => trial,
            (false, true) => -limit,
            (false, false) => limit,
        };
        let arm = match self.mutation {
            Mutation::HalfTheTorqueOnPairs if is_pair => 0.5 * arm,
            _ => arm,
        };
        ContactForce::new(normal, tangential, arm)
    }
}

/// The twin at the place of the native code.
struct TwinEngine {
    name: Code,
    identity: Identity,
    mutation: Mutation,
    /// Whether it is right in the probe.
    probes_rightly: bool,
}

impl TwinEngine {
    fn selected(mutation: Mutation) -> SelectedCode {
        Self::selected_as(Code::native(), mutation, false)
    }

    fn selected_as(name: Code, mutation: Mutation, probes_rightly: bool) -> SelectedCode {
        SelectedCode {
            name: name.clone(),
            code: Some(Box::new(Self {
                identity: Identity {
                    code: name.to_string(),
                    version: format!("{mutation:?}"),
                    package: None,
                    program_hash: None,
                    files_hash: None,
                    witness: None,
                },
                name,
                mutation,
                probes_rightly,
            })),
        }
    }

    fn compress(&self, case: &Case) -> Result<Series, Box<Failure>> {
        let ratio = case.stack.stiffness_ratio;
        let twin = Twin::new(&case.convention, ratio, self.mutation);
        compress_stack_with(case, twin, || true).map_err(|error| {
            Box::new(Failure {
                code: Code::native(),
                subject: case.to_string(),
                kind: error.into(),
                run_directory: None,
                last_lines: Vec::new(),
            })
        })
    }
}

impl InstalledCode for TwinEngine {
    fn name(&self) -> &Code {
        &self.name
    }

    fn identity(&self) -> &Identity {
        &self.identity
    }

    fn batching(&self) -> Batching {
        Batching::OneCallACase
    }

    fn run(&self, cases: &[Case], _: &RunContext, finished: Finished<Run>) {
        for (index, case) in cases.iter().enumerate() {
            let run = self.compress(case).map(|series| Run {
                case: *case,
                series,
                provenance: Provenance::now(
                    self.identity.clone(),
                    Code::native().deck_hash(case),
                    Vec::new(),
                    case.total_steps(),
                    0.0,
                ),
            });
            finished(index, run.map_err(|failure| *failure));
        }
    }

    fn probe(&self, tests: &[ContactTest], _: &RunContext) -> Result<Vec<Motion>, Box<Failure>> {
        // The twin is a law of the plane; tests/physics/space.rs has mistakes in three dimensions.
        let motion = |test: &ContactTest| {
            let motion = match test.space {
                Some(_) => run_contact_test(test),
                None => {
                    let mutation = match self.probes_rightly {
                        true => Mutation::None,
                        false => self.mutation,
                    };
                    let twin = Twin::new(&test.convention, test.stiffness_ratio, mutation);
                    run_contact_test_with(test, twin)
                }
            };
            motion.expect("a finite motion")
        };
        Ok(tests.iter().map(motion).collect())
    }

    fn build(&self, _: &[Pyramid], _: &RunContext) -> Result<Vec<PyramidRun>, Box<Failure>> {
        unreachable!("a twin is asked for no pyramids")
    }
}

struct Silent;

impl Progress for Silent {
    fn planned(&self, _: &str, _: usize, _: usize, _: f64) {}
    fn advanced(&self, _: f64) {}
    fn finished(&self, _: &Code, _: &dyn std::fmt::Display, _: Result<Option<f64>, &Failure>) {}
    fn warn(&self, _: &str) {}
}

/// Runs `action` with settings that keep everything in a directory of their own.
fn with_settings<T>(action: impl FnOnce(&Settings) -> T) -> T {
    let root = tempfile::tempdir().expect("a directory");
    let settings = Settings {
        store: Store::open(&root.path().join("store")).expect("a store"),
        recorded: Recorded::new(Path::new("nowhere")),
        fresh: true,
        threads: 2,
        time_limit: None,
        interrupt: &Interrupt::new(),
    };
    action(&settings)
}

fn probed(mutation: Mutation) -> Findings {
    let codes = [TwinEngine::selected(mutation)];
    let mut probed = with_settings(|settings| probe_all(&codes, settings, &Silent));
    probed.remove(0).expect("the probe works")
}

/// Properties that the probe finds to differ from the declaration of native.
fn differing_properties(mutation: Mutation) -> Vec<String> {
    let findings = probed(mutation).findings.into_iter();
    let off = findings.filter(|finding| finding.verdict != Verdict::Agrees);
    off.map(|finding| finding.property).collect()
}

/// What was measured of one property, and its uncertainty.
fn measured(findings: &Findings, property: &str) -> Option<(f64, f64)> {
    let mut findings = findings.findings.iter();
    let own = findings.find(|own| own.property == property)?;
    own.measured.zip(own.uncertainty)
}

/// The arm is that of small steps, and what depends on the step is said as such; a term that no step makes vanish is not
/// taken for one that does.
#[test]
fn a_term_of_third_order_in_the_turn_of_a_step_is_no_arm() {
    let sine = probed(Mutation::FloorMovesByItsSine);
    for own in &sine.findings {
        assert_eq!(own.verdict, Verdict::Agrees, "{own:?}");
    }
    let (coefficient, uncertainty) = measured(&sine, "floor_cubed_turn").expect("it is found");
    assert!((coefficient + 1.0 / 6.0).abs() <= uncertainty && uncertainty < 1e-3);
    let (arm, uncertainty) = measured(&sine, "floor_kinematic_arm").expect("it is found");
    assert!(arm.abs() <= uncertainty && uncertainty < 1e-9, "{arm:e}");
    let effects = passport(&Code::native(), &sine).time_step_effects();
    let effect = "floor: a surface that turns by d in a step moves by d - 0.1667 d^3";
    assert_eq!(effects, [effect]);

    let cubed = probed(Mutation::FloorMovesByCubedSpin);
    assert_eq!(measured(&cubed, "floor_cubed_turn"), None);
    let (_, uncertainty) = measured(&cubed, "floor_kinematic_arm").expect("a number");
    assert!(uncertainty > 1e-9, "{uncertainty:e}");
    assert!(
        passport(&Code::native(), &cubed)
            .time_step_effects()
            .is_empty()
    );
}

/// The exponent is part of the law by which the rest is measured.
#[test]
fn beside_a_stiffness_that_grows_everything_else_is_as_declared() {
    for (mutation, kind) in [
        (Mutation::FloorSpringGrows, "floor"),
        (Mutation::PairSpringGrows, "pair"),
    ] {
        let findings = probed(mutation);
        let exponent = format!("{kind}_tangential_stiffness_exponent");
        let (value, uncertainty) = measured(&findings, &exponent).expect("it grows");
        assert!((value - 0.5).abs() <= uncertainty && uncertainty < 1e-9);
        for own in &findings.findings {
            // What the coefficients leave open shows where the native code has to be as declared to 1e-9.
            let differs = own.verdict == Verdict::Differs && own.property != "pair_history_update";
            assert_eq!(differs, own.property == exponent, "{own:?}");
        }
        let (update, _) = measured(&findings, "pair_history_update").expect("a number");
        assert!(update.abs() < 1e-8, "{update:e}");
        for property in ["kinematic_arm", "torque_arm", "damping_arm"] {
            let (arm, _) = measured(&findings, &format!("{kind}_{property}")).expect("an arm");
            assert!(arm.abs() < 1e-9, "{property}: {arm:e}");
        }
    }
}

/// Crosscheck of one stack that yields at the floor.
fn crosscheck(mutation: Mutation) -> Judgement {
    let stack = Stack::paper(0.3, 1e2);
    let measurements = [plan(
        &SettledCode::native(),
        &stack,
        ContactConvention::TURNING,
    )];
    let codes = [TwinEngine::selected(mutation)];
    let judgements = with_settings(|settings| {
        Campaign::new(&codes, settings, &Silent).carry_out(measurements.to_vec())
    });
    judgements.into_iter().next().expect("a row")
}

/// The verdict of the crosscheck without a probe: the row still has its numbers.
fn crosscheck_alone(judgement: &Judgement) -> &'static str {
    let row = judgement;
    let (Some(force), Some(reference), Some(uncertainty)) =
        (row.yield_force(), row.reference_force(), row.uncertainty())
    else {
        // Runs without a yield; a failed one leaves none.
        let without_yield = judgement.grounds.is_contradicted() && !judgement.runs().is_empty();
        return if without_yield {
            Verdict::NoYield.as_str()
        } else {
            row.verdict().as_str()
        };
    };
    let allowed = uncertainty.max(MIN_TOLERANCE * (reference + 3.0));
    if (force - reference).abs() > allowed {
        "differs"
    } else {
        "agrees"
    }
}

#[test]
fn the_unchanged_twin_is_the_native_code_to_the_last_bit() {
    let stack = Stack::paper(0.3, 1e3);
    let case = plan(&SettledCode::native(), &stack, ContactConvention::TURNING).cases[0];
    let ratio = case.stack.stiffness_ratio;
    let twin = Twin::new(&case.convention, ratio, Mutation::None);
    let series = compress_stack_with(&case, twin, || true).expect("a finite series");
    assert_eq!(series, compress_stack(&case, || true).expect("a series"));
    assert_eq!(differing_properties(Mutation::None), Vec::<String>::new());
    assert_eq!(crosscheck(Mutation::None).verdict(), Verdict::Agrees);
}

/// Asserts that a study follows the rule for a code whose probe contradicts its declaration.
fn assert_not_judged<S, F>(judged: &[Judged<S, F>]) {
    assert_eq!(judged.len(), 1);
    let study = &judged[0];
    assert!(study.finding.is_some(), "it was carried out");
    assert_eq!(study.verdict(), Verdict::Inconclusive);
    assert!(study.grounds.is_contradicted());
    let notes = study.notes();
    let first = notes.first().expect("the reason");
    assert!(
        first.starts_with("not judged: its probe contradicts what was asked for: "),
        "{first}"
    );
}

#[test]
fn no_study_judges_a_code_whose_probe_contradicts_its_declaration() {
    let (native, stack) = (SettledCode::native(), Stack::paper(0.3, 1e2));
    let codes = [TwinEngine::selected(Mutation::FrictionOnePercentHigh)];
    with_settings(|settings| {
        let campaign = Campaign::new(&codes, settings, &Silent);
        let convention = ContactConvention::TURNING;
        assert_not_judged(&campaign.carry_out(vec![plan(&native, &stack, convention)]));
        let trajectory = plan_trajectory(&native, &stack, convention);
        assert_not_judged(&campaign.carry_out(vec![trajectory]));
        let preparation = plan_preparation(&native, &native, &stack, Some(0.0));
        assert_not_judged(&campaign.carry_out(vec![preparation]));
        let impact = plan_impacts(&native, convention).swap_remove(0);
        assert_not_judged(&campaign.carry_out(vec![impact]));
        let survey = survey(
            &SurveyPlan::new(&[], &[stack], HistoryUpdate::Rotated),
            &campaign,
        )
        .expect("a survey");
        let verdicts: Vec<Verdict> = survey.verdicts().collect();
        assert_eq!(verdicts, [Verdict::Inconclusive]);
        assert!(
            survey.notes[0].starts_with("not judged: its probe contradicts what was asked for: "),
            "{:?}",
            survey.notes
        );
    });
}

#[test]
fn every_changed_line_is_noticed() {
    let mut table = String::from("changed line | probe | crosscheck alone\n");
    for mutation in MUTATIONS {
        let properties = differing_properties(mutation);
        let judgement = crosscheck(mutation);
        let alone = crosscheck_alone(&judgement);
        assert!(
            !properties.is_empty() || alone != "agrees",
            "nobody noticed {mutation:?}"
        );
        assert_ne!(judgement.verdict(), Verdict::Agrees, "{mutation:?}");
        let seen = match properties.len() {
            0 => "-".to_owned(),
            1..=3 => properties.join(", "),
            count => format!("{} and {} more", properties[0], count - 1),
        };
        table += &format!("{mutation:?} | {seen} | {alone}\n");
    }
    insta::assert_snapshot!(table);
}

/// The worst verdict on the series of a stack beside those of the native code, for a code that is right in the probe.
fn series_beside_native(mutation: Mutation) -> Verdict {
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/python");
    let example = Code::in_folder(&example, None).expect("a code");
    let settled = example.as_declared().expect("it declares everything");
    let native = SelectedCode {
        code: Code::native().find(),
        name: Code::native(),
    };
    let codes = [native, TwinEngine::selected_as(example, mutation, true)];
    let stack = trajectory_stack(2, Power::Linear);
    let plan = plan_trajectory(&settled, &stack, ContactConvention::TURNING);
    let judged =
        with_settings(|settings| Campaign::new(&codes, settings, &Silent).carry_out(vec![plan]));
    let verdicts = judged[0].verdicts().into_iter();
    verdicts.max().expect("there are comparisons")
}

/// Whether the restitution of an impact is off by more than what is known of it.
fn restitution_is_off(mutation: Mutation) -> bool {
    let codes = [TwinEngine::selected(mutation)];
    let plans = plan_impacts(&SettledCode::native(), ContactConvention::TURNING);
    let judged =
        with_settings(|settings| Campaign::new(&codes, settings, &Silent).carry_out(plans));
    let mut findings = judged
        .iter()
        .filter_map(|own| own.finding.as_ref()?.as_ref());
    findings.any(|own| own.error.abs() > own.budget.total().max(MIN_TOLERANCE))
}

/// By the probe; in a series, beside the native one; and in a number that theory knows, the yield force or the
/// restitution of an impact. No such number depends on the tangential damping.
#[test]
fn a_thousandth_of_any_coefficient_is_seen_in_probe_series_and_theory() {
    assert_eq!(series_beside_native(Mutation::None), Verdict::Agrees);
    assert!(!restitution_is_off(Mutation::None));
    for mutation in THOUSANDTHS {
        assert_ne!(
            differing_properties(mutation),
            Vec::<String>::new(),
            "{mutation:?}"
        );
        assert_eq!(
            series_beside_native(mutation),
            Verdict::Differs,
            "{mutation:?}"
        );
        let force_is_off = crosscheck_alone(&crosscheck(mutation)) != "agrees";
        let is_known_to_theory = mutation != Mutation::TangentialDampingHighByAThousandth;
        let is_off = force_is_off || restitution_is_off(mutation);
        assert_eq!(is_off, is_known_to_theory, "{mutation:?}");
    }
}

#[test]
fn a_stiffness_that_grows_with_the_overlap_is_named() {
    for (mutation, said) in [
        (
            Mutation::FloorSpringGrows,
            "floor k_t grows with the overlap (like overlap^0.50)",
        ),
        (
            Mutation::PairSpringGrows,
            "pair k_t grows with the overlap (like overlap^0.50)",
        ),
        (
            Mutation::NormalForceGrows,
            "pair k_n grows with the overlap (like overlap^0.50)",
        ),
    ] {
        let judgement = crosscheck(mutation);
        let notes = judgement.notes();
        let first = notes.first().expect("the reason");
        let reason = format!("not judged: its probe contradicts what was asked for: {said}");
        assert!(first.starts_with(&reason), "{mutation:?}: {first}");
    }
}

/// The other way round: a right code under a wrong declaration.
#[test]
fn a_wrong_declaration_is_noticed_and_nothing_is_judged_by_it() {
    let wrong = ContactConvention {
        arms: Arms::reciprocal(0.0, -0.01),
        ..ContactConvention::TURNING
    };
    let declared = tristack::code::Declaration {
        convention: wrong,
        ..Code::native().declaration()
    };
    let properties = tristack::study::convention::probe(&declared, |tests| {
        let honest: Vec<ContactTest> = tests
            .iter()
            .map(|test| ContactTest {
                convention: ContactConvention {
                    arms: Arms::PAPER,
                    ..test.convention
                },
                ..*test
            })
            .collect();
        let motions = honest.iter().map(tristack::dem::run_contact_test);
        motions.collect::<Result<Vec<Motion>, _>>()
    })
    .expect("finite motions");
    let findings = properties
        .into_iter()
        .map(|property| property.judge(&Code::native(), ""));
    let off: Vec<String> = findings
        .filter(|finding| finding.verdict == Verdict::Differs)
        .map(|finding| finding.property)
        .collect();
    assert_eq!(
        off,
        [
            "floor_torque_arm",
            "floor_kinematic_arm",
            "floor_damping_arm"
        ]
    );
}
