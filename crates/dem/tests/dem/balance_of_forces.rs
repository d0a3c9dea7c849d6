//! The balance of forces of the stack: how far floor and wall are out of balance while the stack rings, for rows at any
//! distance, and that a force which is wrong by a small multiple of that is noticed.

use tristack_dem::dem::compress_stack;
use tristack_dem::model::{
    Case, ContactConvention, Law, Preparation, Protocol, Sampling, Shortcuts, Stack,
};
use tristack_dem::series::{Deviation, MechanicalLaw, Mechanics, Sample, Series};

const WALL_SPEED: f64 = 1e-5;
const TIME_STEP: f64 = 0.05;
/// The paper's restitution.
const RESTITUTION: f64 = 0.7;

/// A compression that ends before the floor slides, with rows at one distance.
fn case(interval: f64) -> Case {
    Case {
        stack: Stack::paper(0.3, 1e3),
        convention: ContactConvention::TURNING,
        protocol: Protocol {
            preparation: Preparation::GravityRamp {
                ramp_time: 400.0,
                rest_time: 400.0,
            },
            time_step: TIME_STEP,
            wall_speed: WALL_SPEED,
            wall_travel: 300.0 * WALL_SPEED,
            sampling: Sampling {
                coarse_interval: interval,
                fine_from_travel: 0.0,
                fine_interval: interval,
            },
            shortcuts: None,
        },
    }
}

fn series(case: &Case) -> Series {
    case.validate().expect("a valid case");
    compress_stack(case, || true).expect("a finite series")
}

fn deviation(series: &Series, case: &Case, law: MechanicalLaw) -> Deviation {
    *Mechanics::read(series, case)
        .0
        .get(&law)
        .expect("it is read")
}

/// Where rows are further apart than half a period, what they bend by is no bound of the acceleration: at 6.3, nearly a
/// period of the stack, they do not bend at all.
#[test]
fn rows_at_any_distance_accuse_nobody_who_is_honest() {
    let hertz = ContactConvention::with_law(Law::HERTZ);
    let elastic = ContactConvention {
        restitution: 1.0,
        ..ContactConvention::TURNING
    };
    let of_walls = |floor_ratio| ContactConvention {
        law: Law {
            floor_ratio,
            ..Law::LINEAR
        },
        ..ContactConvention::TURNING
    };
    let conventions = [
        ("linear", ContactConvention::TURNING),
        ("fixed spring", ContactConvention::PAPER),
        ("elastic", elastic),
        ("hertz", hertz),
        ("soft walls", of_walls(0.2)),
        ("stiff walls", of_walls(10.0)),
    ];
    for (name, convention) in conventions {
        for bodies in [2, 4] {
            for interval in [0.5, 2.0, 3.15, 6.0, 6.3, 12.6] {
                let mut case = case(interval);
                case.convention = convention;
                case.stack.bodies = bodies;
                let case = Case {
                    convention: convention.of_bodies(&case.stack),
                    ..case
                };
                let mechanics = Mechanics::read(&series(&case), &case);
                let parts: Vec<String> = mechanics
                    .0
                    .iter()
                    .map(|(law, own)| format!("{law:?} {:.2}", own.size / own.bound))
                    .collect();
                println!("{name}, {bodies}, {interval}: {}", parts.join(", "));
                let violations: Vec<_> = mechanics.violations().collect();
                assert!(
                    violations.is_empty(),
                    "{name}, {bodies}, {interval}: {violations:?}"
                );
            }
        }
    }
}

/// A preparation that ends while the stack still moves, as fast as the wall does later.
#[test]
fn what_a_short_preparation_leaves_accuses_nobody() {
    for (ramp_time, rest_time, restitution) in [
        (20.0, 2.0, RESTITUTION),
        (40.0, 10.0, RESTITUTION),
        (100.0, 50.0, RESTITUTION),
        (100.0, 50.0, 1.0),
    ] {
        let mut case = case(2.0);
        case.convention.restitution = restitution;
        case.protocol.preparation = Preparation::GravityRamp {
            ramp_time,
            rest_time,
        };
        let own = deviation(&series(&case), &case, MechanicalLaw::ForceBalance);
        assert!(
            own.is_allowed(),
            "{ramp_time}, {rest_time}, {restitution}: {own:?}"
        );
    }
}

#[test]
fn a_wall_that_slows_down_accuses_nobody() {
    for interval in [0.5, 6.0] {
        let mut case = case(interval);
        case.protocol.shortcuts = Some(Shortcuts {
            speed_factor: 4.0,
            fast_until_travel: 250.0 * WALL_SPEED,
            stop_at_drop: 0.0,
        });
        let mechanics = Mechanics::read(&series(&case), &case);
        let violations: Vec<_> = mechanics.violations().collect();
        assert!(violations.is_empty(), "{interval}: {violations:?}");
    }
}

/// The imbalance so many steps after the touch, by the recurrence of the heights in a leapfrog with dashpots half a step
/// behind: its roots z have |z|² = 1 − η dt and Re z = 1 − (w dt² + η dt)/2.
fn imbalance(step: u64, damping: f64) -> f64 {
    let (alpha, beta) = (TIME_STEP * (TIME_STEP + damping), TIME_STEP * damping);
    let (size, real) = ((1.0 - beta).sqrt(), 1.0 - 0.5 * alpha);
    let imaginary = (size * size - real * real).sqrt();
    let angle = imaginary.atan2(real);
    let power = |step: f64| size.powf(step) * (step * angle).sin();
    let step = step as f64;
    -WALL_SPEED / TIME_STEP * (alpha * power(step) - beta * power(step - 1.0)) / imaginary
}

fn damping() -> f64 {
    let logarithm = RESTITUTION.ln();
    -2.0 * logarithm / std::f64::consts::PI.hypot(logarithm)
}

/// Whatever happens between the bodies, floor and wall are out of balance by the motion of one oscillator, to rounding:
/// 1e-8 of the first imbalance.
#[test]
fn the_native_code_rings_as_the_oscillator_does() {
    let case = case(0.5);
    let found = series(&case);
    for row in &found.samples()[1..] {
        let borne = row.floor[1][1] + row.floor[2][1];
        let own = borne - row.wall_force - 3.0 * case.stack.epsilon();
        let expected = imbalance(row.step, damping());
        assert!(
            (own - expected).abs() < 1e-8 * WALL_SPEED,
            "step {}: {own:e} for {expected:e}",
            row.step
        );
    }
}

/// In every row but those in which rounding is all that is left.
#[test]
fn a_force_that_is_wrong_by_three_times_the_envelope_is_noticed() {
    for interval in [2.0, 6.0] {
        let case = case(interval);
        let honest = series(&case);
        let own = deviation(&honest, &case, MechanicalLaw::ForceBalance);
        assert!(own.is_allowed());
        let rows = honest.samples().len();
        for wrong in 1..rows.min(1 + (120.0 / interval) as usize) {
            let mut samples: Vec<Sample> = honest.samples().to_vec();
            let row = &mut samples[wrong];
            let frequency = (1.0 - 0.25 * damping() * damping()).sqrt();
            let envelope = WALL_SPEED / frequency * (-0.5 * damping() * row.time).exp();
            row.floor[1][1] += 1.5 * envelope;
            row.floor[2][1] += 1.5 * envelope;
            let step = row.step;
            let altered = Series::new(samples, &case).expect("finite numbers");
            let seen = deviation(&altered, &case, MechanicalLaw::ForceBalance);
            assert!(!seen.is_allowed(), "row {wrong}, {interval}: {seen:?}");
            assert_eq!(seen.step, step, "{seen:?}");
            let bound = seen.bound / case.stack.stiffness;
            assert!(
                bound < 1.2 * envelope,
                "row {wrong}: {bound:e} for {envelope:e}"
            );
        }
    }
}
