//! Many cylinders: a pyramid that stands, and the same one in other codes.

use crate::common::installed;
use tristack::code::{Code, FailureKind, Interrupt, ParameterFormat, RunContext, Task};
use tristack::dem::{Cylinder, Facing, Material, PYRAMID_FLOOR, Packing, PlaneWall, run_pyramid};
use tristack::model::{ContactConvention, Power, Pyramid};
use tristack::study::cost::PyramidBench;

/// Steps `packing` through the whole of `pyramid`.
fn settle(packing: &mut Packing, pyramid: &Pyramid) {
    for step in 0..pyramid.total_steps() {
        packing.gravity = pyramid.gravity_at(step);
        packing.evaluate_forces();
        packing.advance();
    }
}

#[test]
fn a_pyramid_stands_on_its_floor_in_equilibrium_and_symmetric() {
    let pyramid = Pyramid {
        rest_steps: 20_000,
        ..Pyramid::touching(20, 1e4, ContactConvention::TURNING)
    };
    let mut packing = Packing::pyramid(&pyramid);
    settle(&mut packing, &pyramid);
    packing.evaluate_forces();
    let one_weight = pyramid.groups.epsilon();
    let weight = one_weight * pyramid.cylinder_count() as f64;
    let floor: f64 = packing
        .wall_forces(PYRAMID_FLOOR)
        .map(|(_, force)| force.normal)
        .sum();
    let unbalanced = packing.loads().iter().flat_map(|load| {
        let [x, y] = load.force;
        [x, y, load.torque]
    });
    let unbalanced = unbalanced.map(f64::abs).fold(0.0, f64::max);
    println!(
        "floor {:e} of the weight, unbalanced {:e}",
        floor / weight - 1.0,
        unbalanced / one_weight
    );
    // The rest of the slowest oscillation, which has a period of some 60 time units and is hardly damped.
    assert!((floor / weight - 1.0).abs() < 1e-6);
    assert!(unbalanced < 1e-6 * one_weight);
    let farthest = asymmetry(&pyramid, packing.cylinders());
    println!("asymmetry {farthest:e}");
    // Nothing but the order of sums tells left from right: a few hundred units in the last place of 20.
    assert!(farthest < 1e-12);
}

/// Why a pyramid has side walls.
#[test]
fn on_the_floor_alone_four_rows_stand_and_five_roll_apart() {
    for (rows, stands) in [(4, true), (5, false)] {
        let pyramid = Pyramid {
            rest_steps: 20_000,
            ..Pyramid::touching(rows, 1e4, ContactConvention::TURNING)
        };
        let cylinders = pyramid.centres().into_iter();
        let floor = PlaneWall {
            facing: Facing::Up,
            offset: 0.0,
            speed: 0.0,
            friction: pyramid.groups.floor_friction,
        };
        let mut packing = Packing::new(
            cylinders.map(|[x, y]| Cylinder::at(x, y)).collect(),
            vec![floor],
            Material::new(&pyramid.groups, &pyramid.convention),
            pyramid.time_step,
        );
        settle(&mut packing, &pyramid);
        let top = packing.cylinders().last().expect("a top");
        let fallen = pyramid.centres().last().expect("a top")[1] - top.position[1];
        assert_eq!(fallen < 0.01, stands, "{rows} rows: {fallen}");
    }
}

/// Largest distance of a cylinder to the mirror image of its counterpart on the other side.
fn asymmetry(pyramid: &Pyramid, cylinders: &[Cylinder]) -> f64 {
    let mut rest = cylinders;
    let mut farthest: f64 = 0.0;
    for length in (1..=pyramid.rows as usize).rev() {
        let (row, above) = rest.split_at(length);
        for (left, right) in row.iter().zip(row.iter().rev()) {
            let dx = left.position[0] + right.position[0];
            let dy = left.position[1] - right.position[1];
            farthest = farthest.max(dx.abs()).max(dy.abs());
        }
        rest = above;
    }
    farthest
}

/// The external codes that build pyramids.
fn builders() -> Vec<Code> {
    let codes = Code::with_power(Power::Linear).into_iter().skip(1);
    codes.filter(|code| code.builds_pyramids()).collect()
}

/// Leapfrog and velocity Verlet are the same positions at the same times as long as everything starts from rest
/// without forces, and the convention of each code is that of its twin: what is left is rounding.
#[test]
fn other_codes_move_every_cylinder_of_a_pyramid_to_the_same_place() {
    let interrupt = Interrupt::new();
    for name in installed(&builders()) {
        let pyramid = Pyramid {
            rest_steps: 1000,
            ..Pyramid::touching(10, 1e3, name.declaration().convention)
        };
        let directory = tempfile::tempdir().expect("a directory");
        let code = name.find().expect("it is installed");
        let context = RunContext::new(directory.path(), &interrupt);
        let runs = code.build(&[pyramid], &context).expect("a run");
        let run = &runs[0];
        let twin = run_pyramid(&pyramid, || true).expect("a run");
        let centres = run.centres().iter().zip(twin.centres());
        let distance =
            |one: &[f64; 2], other: &[f64; 2]| f64::hypot(one[0] - other[0], one[1] - other[1]);
        let largest = centres.clone().map(|(one, other)| distance(one, other));
        let largest = largest.fold(0.0, f64::max);
        let start = pyramid.centres();
        let moved = start.iter().zip(run.centres());
        let moved = moved
            .map(|(one, other)| distance(one, other))
            .fold(0.0, f64::max);
        println!("{name}: {largest:e} from native after a way of {moved:e}");
        assert!(moved > 1e-3);
        // Half a unit in the last place of a coordinate of 20 is 2e-15; were all of 4000 steps rounded to the same
        // side, it would be 7e-12.
        assert!(largest < 7e-12, "{name}: {largest:e}");
        assert!(run.timed_seconds() > 0.0);
    }
}

#[test]
fn a_code_without_a_deck_for_pyramids_and_a_pyramid_that_is_none_are_refused() {
    let interrupt = Interrupt::new();
    let directory = tempfile::tempdir().expect("a directory");
    let context = RunContext::new(directory.path(), &interrupt);
    assert!(
        !Code::named("yade")
            .expect("it is built in")
            .builds_pyramids()
    );
    for name in installed(&[Code::named("yade").expect("it is built in")]) {
        let pyramid = Pyramid::touching(2, 1e3, name.declaration().convention);
        let failure = name.find().expect("installed").build(&[pyramid], &context);
        let kind = failure.expect_err("no deck").kind;
        assert!(matches!(kind, FailureKind::Unsupported(_)));
    }
    let none = Pyramid::touching(0, 1e3, ContactConvention::TURNING);
    let native = Code::native().find().expect("always there");
    let failure = native.build(&[none], &context).expect_err("no rows");
    assert!(
        failure.to_string().contains("`pyramid.rows` is 0"),
        "{failure}"
    );
}

#[test]
fn the_cost_of_a_step_is_measured_for_every_code_and_pyramid() {
    let interrupt = Interrupt::new();
    let directory = tempfile::tempdir().expect("a directory");
    let mut codes = vec![Code::native()];
    codes.extend(installed(&builders()));
    let bench = PyramidBench {
        rows: vec![3, 5],
        codes: codes
            .iter()
            .map(|code| code.as_declared().expect("nothing is left out"))
            .collect(),
        cylinder_steps: 3000,
        repeats: 2,
    };
    let costs = bench.measure(&RunContext::new(directory.path(), &interrupt));
    let costs = costs.expect("measurements");
    assert_eq!(costs.len(), 2 * codes.len());
    for (index, cost) in costs.iter().enumerate() {
        assert_eq!(cost.code, codes[index % codes.len()]);
        assert_eq!(cost.rows, bench.rows[index / codes.len()]);
        assert_eq!(cost.nanoseconds.len(), 2);
        assert!(cost.fastest() > 0.0 && cost.fastest() <= cost.median());
    }
}

/// The examples beside the decks are what the program would give for the pyramid that they say.
#[test]
fn examples_for_running_a_pyramid_by_hand_are_up_to_date() {
    for (code, folder) in [
        (
            Code::named("lammps").expect("it is built in"),
            "lammps_inputs",
        ),
        (
            Code::named("liggghts").expect("it is built in"),
            "liggghts_inputs",
        ),
    ] {
        let pyramid = Pyramid::touching(4, 1e3, code.declaration().convention);
        let beside = |name: &str| {
            let path = format!("{}/{folder}/{name}", env!("CARGO_MANIFEST_DIR"));
            std::fs::read_to_string(path).expect("an example")
        };
        let parameters = beside("pyramid_parameters.in");
        let (comment, variables) = parameters.split_once('\n').expect("a line of comment");
        assert!(comment.starts_with("# Four rows"));
        assert_eq!(
            variables,
            ParameterFormat::LammpsVariables.content(&pyramid.parameters())
        );
        let files = pyramid.files();
        let [(name, content)] = files.as_slice() else {
            panic!("one file: {files:?}");
        };
        assert_eq!(&beside(&format!("pyramid_{name}")), content);
    }
}
