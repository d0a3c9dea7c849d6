//! The theories against golden values that were computed another way, to 20 digits, by
//! `reference/golden/generate.py` (Newton on the unreduced equations, Taylor series, Richardson).

use serde::Deserialize;
use std::path::{Path, PathBuf};
use std::process::Command;
use tristack_theory::model::{
    Arms, ContactArms, ContactConvention, DampingGrowth, Law, Power, Problem, Stack,
    TangentialHistory, TangentialStiffening,
};
use tristack_theory::theory::{
    Event, LimitCurve, Predictions, closed_form_limit, followed_limit, rigid_yield,
};

/// A path in the folder `reference` of the project.
fn in_reference(path: &str) -> PathBuf {
    let project = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    project.join("reference").join(path)
}

fn rows<Row: for<'a> Deserialize<'a>>(name: &str) -> Vec<Row> {
    let path = in_reference("golden").join(name);
    let mut reader = csv::Reader::from_path(path).expect("the golden table is there");
    reader
        .deserialize()
        .map(|row| row.expect("the golden table has the columns of this test"))
        .collect()
}

/// The largest relative deviation seen, with the row that shows it.
#[derive(Default)]
struct Worst {
    deviation: f64,
    row: String,
    compared: usize,
}

impl Worst {
    fn compare(&mut self, computed: Option<f64>, golden: Option<f64>, row: &str) {
        assert_eq!(
            computed.is_some(),
            golden.is_some(),
            "{row}: {computed:?} {golden:?}"
        );
        let (Some(computed), Some(golden)) = (computed, golden) else {
            return;
        };
        let deviation = (computed - golden).abs() / golden.abs();
        self.compared += 1;
        if deviation > self.deviation {
            self.deviation = deviation;
            self.row = row.to_owned();
        }
    }

    fn must_stay_below(&self, bound: f64, what: &str) {
        println!(
            "{what}: {} values, worst {:.1e} at {}",
            self.compared, self.deviation, self.row
        );
        assert!(self.compared > 0, "{what}: nothing compared");
        assert!(
            self.deviation < bound,
            "{what}: {:e} at {}",
            self.deviation,
            self.row
        );
    }
}

#[derive(Debug, Deserialize)]
struct SmallDisplacementRow {
    mu: f64,
    stiffness: f64,
    kappa: f64,
    rigid: Option<f64>,
    naive: Option<f64>,
    perturbation: Option<f64>,
    elastic: Option<f64>,
    elastic_x: Option<f64>,
    elastic_y: Option<f64>,
    elastic_z: Option<f64>,
    elastic_theta: Option<f64>,
}

fn stack(mu: f64, stiffness: f64, kappa: f64) -> Stack {
    Stack {
        stiffness_ratio: kappa,
        ..Stack::paper(mu, stiffness)
    }
}

fn problem(stack: Stack, convention: ContactConvention) -> Problem {
    Problem::new(stack, convention).expect("values in range")
}

#[test]
fn small_displacement_theories_match_to_1e_10() {
    let mut worst: [Worst; 8] = Default::default();
    for golden in rows::<SmallDisplacementRow>("small_displacement.csv") {
        let name = format!("{golden:?}");
        let stack = stack(golden.mu, golden.stiffness, golden.kappa);
        let predictions = Predictions::new(&problem(stack, ContactConvention::TURNING));
        let root = predictions.elastic_root;
        let pairs = [
            (predictions.rigid.yield_force, golden.rigid),
            (predictions.naive.yield_force, golden.naive),
            (predictions.perturbation.yield_force, golden.perturbation),
            (predictions.elastic.yield_force, golden.elastic),
            (root.map(|root| root.x), golden.elastic_x),
            (root.map(|root| root.y), golden.elastic_y),
            (root.map(|root| root.z), golden.elastic_z),
            (root.map(|root| root.theta), golden.elastic_theta),
        ];
        for (worst, (computed, golden)) in worst.iter_mut().zip(pairs) {
            worst.compare(computed, golden, &name);
        }
    }
    let names = [
        "rigid",
        "naive",
        "perturbation",
        "elastic",
        "x",
        "y",
        "z",
        "theta",
    ];
    for (worst, name) in worst.iter().zip(names) {
        worst.must_stay_below(1e-10, name);
    }
}

#[derive(Debug, Deserialize)]
struct QuasistaticRow {
    mu: f64,
    stiffness: f64,
    kappa: f64,
    mu_d: f64,
    floor_slip_force: Option<f64>,
    #[serde(rename = "T")]
    tangent: Option<f64>,
    y: Option<f64>,
    event: String,
}

#[test]
fn closed_form_matches_to_1e_9_and_names_the_same_event() {
    let [mut force, mut tangent, mut outward]: [Worst; 3] = Default::default();
    for golden in rows::<QuasistaticRow>("quasistatic.csv") {
        let name = format!("{golden:?}");
        let stack = Stack {
            cylinder_friction: golden.mu_d,
            ..stack(golden.mu, golden.stiffness, golden.kappa)
        };
        let limit = closed_form_limit(&stack);
        force.compare(limit.floor_slip_force, golden.floor_slip_force, &name);
        tangent.compare(limit.tangent, golden.tangent, &name);
        outward.compare(limit.y, golden.y, &name);
        let own_weight = golden.event == "own-weight";
        let expected = if own_weight {
            "floor-slip"
        } else {
            &golden.event
        };
        assert_eq!(limit.event.to_string(), expected, "{name}");
        let yields = limit.event == Event::FloorSlip && !own_weight;
        assert_eq!(limit.yield_force.is_some(), yields, "{name}");
    }
    force.must_stay_below(1e-9, "floor slip force");
    tangent.must_stay_below(1e-9, "T");
    outward.must_stay_below(1e-9, "y");
}

#[test]
fn follower_equals_the_closed_form_to_1e_9_for_arms_0() {
    let mut worst = Worst::default();
    for golden in rows::<QuasistaticRow>("quasistatic.csv") {
        let name = format!("{golden:?}");
        let stack = stack(golden.mu, golden.stiffness, golden.kappa);
        let limit = followed_limit(&problem(stack, ContactConvention::TURNING));
        worst.compare(limit.floor_slip_force, golden.floor_slip_force, &name);
    }
    worst.must_stay_below(1e-9, "follower, arms 0");
}

#[derive(Debug, Deserialize)]
struct ArmsRow {
    mu: f64,
    stiffness: f64,
    kappa: f64,
    pair_arm: f64,
    floor_arm: f64,
    floor_slip_force: Option<f64>,
}

#[test]
fn follower_is_converged_to_1e_7_for_every_pair_of_arms() {
    let mut worst = Worst::default();
    for golden in rows::<ArmsRow>("arms.csv") {
        let name = format!("{golden:?}");
        let stack = stack(golden.mu, golden.stiffness, golden.kappa);
        let arms = Arms::reciprocal(golden.pair_arm, golden.floor_arm);
        let limit = followed_limit(&problem(stack, ContactConvention::with_arms(arms)));
        worst.compare(limit.floor_slip_force, golden.floor_slip_force, &name);
    }
    worst.must_stay_below(1e-7, "follower, all arms");
}

#[derive(Debug, Deserialize)]
struct SeparateArmsRow {
    mu: f64,
    stiffness: f64,
    kappa: f64,
    pair_torque_arm: f64,
    pair_kinematic_arm: f64,
    floor_torque_arm: f64,
    floor_kinematic_arm: f64,
    floor_slip_force: Option<f64>,
}

/// The table eliminates the rotation, the follower integrates it.
#[test]
fn follower_equals_the_path_without_rotation_to_1e_9_where_torque_and_kinematic_arms_differ() {
    let mut worst = Worst::default();
    for golden in rows::<SeparateArmsRow>("separate_arms.csv") {
        let arms = Arms {
            pair: ContactArms {
                torque: golden.pair_torque_arm,
                kinematic: golden.pair_kinematic_arm,
            },
            floor: ContactArms {
                torque: golden.floor_torque_arm,
                kinematic: golden.floor_kinematic_arm,
            },
        };
        let stack = stack(golden.mu, golden.stiffness, golden.kappa);
        let limit = followed_limit(&problem(stack, ContactConvention::with_arms(arms)));
        let name = format!("{golden:?}");
        worst.compare(limit.floor_slip_force, golden.floor_slip_force, &name);
    }
    worst.must_stay_below(1e-9, "follower, separate arms");
}

/// Below the critical friction a solver of non-smooth dynamics, which knows no stiffness, lets the floor slide where the rigid
/// theory does: within one step of its force.
#[test]
fn rigid_disks_of_another_kind_of_solver_slide_at_the_rigid_limit() {
    #[derive(Deserialize)]
    struct Row {
        mu: f64,
        growth: f64,
        sticks_at: f64,
        slides_at: f64,
    }
    let witness = in_reference("witness");
    let recorded = std::fs::read_to_string(witness.join("siconos.csv")).expect("the record");
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(recorded.as_bytes());
    let rows: Vec<Row> = reader
        .deserialize()
        .map(|row| row.expect("a row"))
        .collect();
    assert_eq!(rows.len(), 3);
    for row in rows {
        let limit = rigid_yield(&Stack::paper(row.mu, 1e4)).yield_force;
        let limit = limit.expect("below the critical friction");
        assert!(row.slides_at > row.sticks_at);
        let middle = 0.5 * (row.sticks_at + row.slides_at);
        let distance = (middle - limit).abs();
        assert!(
            distance <= row.growth,
            "{}: {middle} in place of {limit}",
            row.mu
        );
    }
    // Debian's Python has the solver, if any.
    let python = "/usr/bin/python3";
    let installed = Command::new(python)
        .args(["-c", "import siconos.kernel"])
        .output();
    if !installed.is_ok_and(|output| output.status.success()) {
        eprintln!("Siconos is not installed: its forces are not made anew");
        return;
    }
    let anew = Command::new(python)
        .arg(witness.join("siconos_stack.py"))
        .output();
    let anew = anew.expect("it starts");
    assert_eq!(String::from_utf8_lossy(&anew.stdout), recorded);
}

/// What a wall speed adds, by bodies in the plane all of whose derivatives are differences
/// (reference/witness/first_order.py). Such differences over 1e-6 are rounded to 1e-10 of k_n r; at the stiffness 10⁴ that
/// is 1e-6 of a weight, and as much of the lag, which the onset follows alone.
#[test]
fn a_wall_speed_adds_what_the_balances_of_the_bodies_say() {
    #[derive(Deserialize)]
    struct Row {
        stiffness: f64,
        kappa: f64,
        mu: f64,
        spring: String,
        pair_torque_arm: f64,
        pair_kinematic_arm: f64,
        floor_torque_arm: f64,
        floor_kinematic_arm: f64,
        power: Power,
        floor_ratio: f64,
        history: TangentialHistory,
        tangential_stiffening: TangentialStiffening,
        damping: DampingGrowth,
        force: f64,
        onset_per_speed: f64,
        peak_per_speed: f64,
    }
    let witness = in_reference("witness/first_order.csv");
    let mut reader = csv::Reader::from_path(witness).expect("the record");
    let rows: Vec<Row> = reader
        .deserialize()
        .map(|row| row.expect("a row"))
        .collect();
    assert_eq!(rows.len(), 20);
    let mut worst = [Worst::default(), Worst::default(), Worst::default()];
    for row in rows {
        let stack = Stack {
            stiffness_ratio: row.kappa,
            ..Stack::paper(row.mu, row.stiffness)
        };
        let arms = Arms {
            pair: ContactArms {
                torque: row.pair_torque_arm,
                kinematic: row.pair_kinematic_arm,
            },
            floor: ContactArms {
                torque: row.floor_torque_arm,
                kinematic: row.floor_kinematic_arm,
            },
        };
        let law = Law {
            power: row.power,
            floor_ratio: row.floor_ratio,
            history: row.history,
            tangential_stiffening: row.tangential_stiffening,
            damping: row.damping,
            ..Law::LINEAR
        };
        let convention = ContactConvention {
            arms,
            law,
            ..match row.spring.as_str() {
                "fixed" => ContactConvention::PAPER,
                _ => ContactConvention::TURNING,
            }
        };
        let problem = problem(stack, convention);
        let curve = LimitCurve::new(&problem);
        let limit = curve.limit(&problem);
        let added = curve.speed_excess(&problem, &limit).expect("an excess");
        let name = format!("{stack:?} {}", row.spring);
        worst[0].compare(limit.yield_force, Some(row.force), &name);
        worst[1].compare(Some(added.onset), Some(row.onset_per_speed), &name);
        worst[2].compare(Some(added.peak), Some(row.peak_per_speed), &name);
    }
    let [limit, onset, peak] = worst;
    limit.must_stay_below(1e-8, "limit beside the witness");
    onset.must_stay_below(1e-5, "onset per speed");
    peak.must_stay_below(1e-8, "peak per speed");
}
