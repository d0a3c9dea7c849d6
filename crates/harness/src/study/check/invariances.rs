//! Contacts that come and go, read as invariances: the same motion of two cylinders in another place, seen otherwise, or
//! begun anew while nothing touches. Nothing of this depends on law and integrator, so that any mistake that depends on
//! where, when or which body shows, without a list of such mistakes.

use super::report::{Grade, Item};
use crate::code::{Failure, InstalledCode, RunContext};
use crate::model::{ContactConvention, ContactTest, InitialMotion, MotionInSpace};
use crate::runs::Answer;
use crate::series::{EXACT_DIGITS, Motion, MotionRow};
use crate::study::convention::{Rounding, turning};

pub(super) const NAME: &str = "contacts that come and go";
pub(super) const IN_SPACE: &str = "spheres: contacts that come and go";
/// Largest deviation, in units of the largest number of its kind: rounding, which grows in a contact that slides.
const SAME: f64 = 1e-6;
/// The same where numbers have 32 bits: their rounding, 6e-8 of positions of 4 r, is 2e-6 of an overlap of 0.1, and grows.
const SAME_IN_SINGLE: f64 = 1e-2;
/// Growth of the rounding of printed digits.
const GROWTH: f64 = 1e3;
/// Largest number of causes.
const MOST_CAUSES: usize = 3;

/// Friction with which contacts stick first and slide later.
const FRICTION: f64 = 0.4;
/// That of the floor, which is larger, so that a mean or the smaller one shows.
const FLOOR_FRICTION: f64 = 0.6;
const TIME_STEP: f64 = 0.05;
/// A height of the top wall that two cylinders do not reach.
const HIGH: f64 = 4.5;
/// Where a cylinder that touches nothing is.
const AWAY: [f64; 2] = [4.0, 2.0];
/// Height about which a view is turned.
const MIDDLE: f64 = 2.25;

/// How the same motion looks otherwise.
#[derive(Debug, Clone, Copy, PartialEq)]
enum View {
    /// Body 1 is where body 2 was.
    Exchanged,
    /// Left and right are exchanged.
    Mirrored,
    /// Everything is this far to the right.
    Moved(f64),
    /// Everything moves to the right with this velocity.
    Carried(f64),
    /// Everything is turned by a quarter about the z axis, counter-clockwise.
    Turned,
    /// Floor and top wall are exchanged.
    UpsideDown,
    /// Everything is turned about the vertical by 1 rad.
    About,
}

type Vector = [f64; 3];

/// What a row says of a body: position, velocity, spin, force, torque.
type Numbers = [Vector; 5];

/// The vectors of a body that a mirror reverses once more.
const OF_ROTATION: [usize; 2] = [2, 4];

impl View {
    /// The directions of the axes in this view.
    fn axes(self) -> [Vector; 3] {
        let (sine, cosine) = (libm::sin(1.0), libm::cos(1.0));
        match self {
            Self::Exchanged | Self::Moved(_) | Self::Carried(_) => UPRIGHT,
            Self::Mirrored => [[-1.0, 0.0, 0.0], UPRIGHT[1], UPRIGHT[2]],
            Self::UpsideDown => [UPRIGHT[0], [0.0, -1.0, 0.0], UPRIGHT[2]],
            Self::Turned => [UPRIGHT[1], [-1.0, 0.0, 0.0], UPRIGHT[2]],
            Self::About => [[cosine, 0.0, -sine], UPRIGHT[1], [sine, 0.0, cosine]],
        }
    }

    /// The numbers of a body in this view after a `time`; `height` is that of the top wall.
    fn of(self, own: Numbers, time: f64, height: f64) -> Numbers {
        let axes = self.axes();
        let is_mirror = matches!(self, Self::Mirrored | Self::UpsideDown);
        let mut seen = own;
        for (place, vector) in seen.iter_mut().enumerate() {
            let from = *vector;
            let sign = if is_mirror && OF_ROTATION.contains(&place) {
                -1.0
            } else {
                1.0
            };
            *vector = std::array::from_fn(|axis| {
                sign * (0..3)
                    .map(|other| from[other] * axes[other][axis])
                    .sum::<f64>()
            });
        }
        match self {
            Self::Moved(way) => seen[0][0] += way,
            Self::Carried(speed) => {
                seen[0][0] += speed * time;
                seen[1][0] += speed;
            }
            Self::Turned => {
                seen[0][0] += MIDDLE;
                seen[0][1] += MIDDLE;
            }
            Self::UpsideDown => seen[0][1] += height,
            Self::Exchanged | Self::Mirrored | Self::About => {}
        }
        seen
    }

    /// The bodies, or what belongs to them, in the order of their numbers in this view.
    fn order<T>(self, [one, two]: [T; 2]) -> [T; 2] {
        match self {
            Self::Exchanged => [two, one],
            _ => [one, two],
        }
    }

    fn of_test(self, test: &ContactTest) -> ContactTest {
        let bodies = beginning(test).map(|own| self.of(own, 0.0, test.wall_height));
        beginning_with(test, self.order(bodies))
    }

    /// The view in words.
    fn words(self) -> String {
        match self {
            Self::Exchanged => "with the bodies exchanged".to_owned(),
            Self::Mirrored => "mirrored".to_owned(),
            Self::Moved(way) => format!("{way:+} r to the right"),
            Self::Carried(speed) => format!("carried along with the velocity {speed:+}"),
            Self::Turned => "turned by a quarter".to_owned(),
            Self::UpsideDown => "upside down".to_owned(),
            Self::About => "turned about the vertical by 1 rad".to_owned(),
        }
    }

    /// What may be wrong if the motion looks different.
    fn cause(self) -> &'static str {
        match self {
            Self::Exchanged => {
                "something depends on the number of a body: a wall, or a contact, that knows body 1 alone; the order of a pair"
            }
            Self::Mirrored => {
                "something depends on left and right: a sign of a tangent, or of a spring when a pair changes its order"
            }
            Self::Moved(_) => {
                "something depends on the place: an edge of a mesh, the end of a periodic box, a boundary between processors or cells"
            }
            Self::Carried(_) => {
                "something depends on the place, or on velocities that two bodies have in common: a list of neighbours that is not made \
                 anew, the end of a periodic box, a boundary between processors or cells"
            }
            Self::Turned | Self::About => {
                "something depends on the direction: a pair that is sorted by a coordinate, a component that is left out"
            }
            Self::UpsideDown => {
                "floor and top wall are not the same to a body without friction that touches both: one of them is left out, or damps \
                 otherwise"
            }
        }
    }
}

const UPRIGHT: [Vector; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// The bodies of `test` at the beginning, without forces.
fn beginning(test: &ContactTest) -> [Numbers; 2] {
    let space = test.space.unwrap_or_default();
    std::array::from_fn(|body| {
        let InitialMotion { x, y, vx, vy, spin } = test.initial_motions[body];
        let MotionInSpace {
            z,
            vz,
            spinx,
            spiny,
        } = space[body];
        [
            [x, y, z],
            [vx, vy, vz],
            [spinx, spiny, spin],
            [0.0; 3],
            [0.0; 3],
        ]
    })
}

/// `test` with other bodies at the beginning.
fn beginning_with(test: &ContactTest, bodies: [Numbers; 2]) -> ContactTest {
    let initial_motions =
        bodies.map(|[[x, y, _], [vx, vy, _], [.., spin], ..]| InitialMotion { x, y, vx, vy, spin });
    let space = bodies.map(|[[.., z], [.., vz], [spinx, spiny, _], ..]| MotionInSpace {
        z,
        vz,
        spinx,
        spiny,
    });
    ContactTest {
        initial_motions,
        space: test.space.map(|_| space),
        ..*test
    }
}

/// The bodies in a row.
fn numbers(row: &MotionRow) -> [Numbers; 2] {
    let bodies = row.bodies();
    std::array::from_fn(|body| {
        let (own, space) = (bodies[body], row.space[body]);
        let ([x, y], [vx, vy], [fx, fy]) = (own.position, own.velocity, own.force);
        let ([spinx, spiny], [torquex, torquey]) = (space.spin, space.torque);
        [
            [x, y, space.z],
            [vx, vy, space.vz],
            [spinx, spiny, own.spin],
            [fx, fy, space.fz],
            [torquex, torquey, own.torque],
        ]
    })
}

/// A motion, and the views of it that must look the same.
pub(super) struct Start {
    name: &'static str,
    pub test: ContactTest,
    views: Vec<View>,
    /// Whether nothing touches for a while, so that the rest can be begun anew.
    parts: bool,
}

fn at([x, y]: [f64; 2], [vx, vy]: [f64; 2], spin: f64) -> InitialMotion {
    InitialMotion { x, y, vx, vy, spin }
}

pub(super) fn starts(convention: &ContactConvention, in_space: bool) -> Vec<Start> {
    use View::{About, Carried, Exchanged, Mirrored, Moved, Turned, UpsideDown};
    let test = |steps, wall_height, initial_motions| ContactTest {
        floor_friction: FLOOR_FRICTION,
        cylinder_friction: FRICTION,
        time_step: TIME_STEP,
        steps,
        wall_height,
        initial_motions,
        space: in_space.then(Default::default),
        ..turning(convention)
    };
    let still = at(AWAY, [0.0; 2], 0.0);
    let squeezed = at([4.0, 0.9], [0.0; 2], 0.0);
    let start = |name, test, views: &[View]| Start {
        name,
        test,
        views: views.to_vec(),
        parts: false,
    };
    let mut all = vec![
        start(
            "a cylinder squeezed between floor and top wall that rolls",
            test(120, 1.8, [at([0.3, 0.93], [0.2, -0.02], 0.1), squeezed]),
            &[Exchanged, Mirrored, Moved(1.437)],
        ),
        start(
            "two cylinders beside each other, squeezed between floor and top wall",
            test(
                120,
                1.8,
                [
                    at([-0.3, 0.93], [0.1, 0.0], 0.05),
                    at([1.6, 0.88], [-0.05, 0.02], -0.1),
                ],
            ),
            &[Exchanged, Mirrored, Moved(1.437)],
        ),
        start(
            "two cylinders beside each other on the floor, of which one parts from the other",
            test(
                120,
                HIGH,
                [
                    at([-0.95, 0.9], [-0.05, 0.0], 0.1),
                    at([0.95, 0.88], [0.08, 0.0], 0.02),
                ],
            ),
            &[Exchanged, Mirrored, Moved(1.437)],
        ),
        start(
            "two cylinders beside each other on the floor, of which one is lifted from it",
            test(
                60,
                HIGH,
                [
                    at([-0.95, 0.99], [0.15, 0.3], 0.1),
                    at([0.95, 0.88], [-0.1, 0.0], 0.02),
                ],
            ),
            &[Exchanged, Mirrored, Moved(1.437)],
        ),
        start(
            "a pair that turns by 1 rad while it touches",
            test(
                60,
                HIGH,
                [
                    at([0.45, 3.18], [-0.62, -0.3], 0.1),
                    at([-0.45, 1.32], [0.62, 0.3], -0.05),
                ],
            ),
            &[Exchanged, Mirrored, Turned, Moved(0.6), Carried(-1.3)],
        ),
        start(
            "a cylinder that rolls on the floor",
            test(90, HIGH, [at([-0.83, 0.98], [0.5, -0.1], -0.3), still]),
            &[Exchanged, Mirrored, Moved(1.437)],
        ),
        start(
            "a cylinder that is pressed on the floor",
            test(60, HIGH, [at([0.25, 0.97], [0.0, -0.1], 0.02), still]),
            &[Moved(0.75), Moved(-0.25), Moved(-1.25)],
        ),
        Start {
            parts: true,
            ..start(
                "a pair that meets, parts and meets again",
                test(
                    400,
                    HIGH,
                    [
                        at([0.12, 3.29], [0.01, -0.4], 0.1),
                        at([-0.12, 1.21], [-0.01, 0.4], 0.05),
                    ],
                ),
                &[Exchanged, Mirrored, Moved(0.6)],
            )
        },
    ];
    // The wall of a law that grows may be of another kind than the floor.
    if convention.law.is_linear() {
        let pressed = at([0.3, 0.95], [0.0; 2], 0.0);
        all.push(start(
            "a cylinder squeezed between floor and top wall",
            ContactTest {
                floor_friction: 0.0,
                ..test(120, 1.8, [pressed, squeezed])
            },
            &[UpsideDown],
        ));
    }
    for own in all.iter_mut().filter(|_| in_space) {
        own.views.push(About);
    }
    all
}

/// What the micro-tests in other places show.
pub(super) struct Elsewhere {
    pub item: Item,
    pub answers: Vec<Answer>,
}

/// Carries out all motions and views of them with an installed `code`, each round in a directory of its own.
///
/// # Errors
/// If the code fails.
pub(super) fn of_code(
    code: &dyn InstalledCode,
    in_space: bool,
    context: &RunContext,
) -> Result<Elsewhere, Box<Failure>> {
    let mut round = 0;
    seen(&code.name().declaration().convention, in_space, |tests| {
        round += 1;
        let place = context.directory.join(format!("round-{round}"));
        let context = RunContext {
            directory: &place,
            ..*context
        };
        match tests.is_empty() {
            true => Ok(Vec::new()),
            false => code.probe(tests, &context),
        }
    })
}

/// Carries out all motions and views of them, with `run`, under this `convention`.
///
/// # Errors
/// Those of `run`.
fn seen<E>(
    convention: &ContactConvention,
    in_space: bool,
    mut run: impl FnMut(&[ContactTest]) -> Result<Vec<Motion>, E>,
) -> Result<Elsewhere, E> {
    let starts = starts(convention, in_space);
    let views = starts.iter().flat_map(|own| {
        let views = own.views.iter();
        let views = views.map(|view| (own, *view, view.of_test(&own.test)));
        views.collect::<Vec<_>>()
    });
    let views: Vec<(&Start, View, ContactTest)> = views.collect();
    let first: Vec<ContactTest> = starts.iter().map(|own| own.test).collect();
    let tests: Vec<ContactTest> = first
        .iter()
        .copied()
        .chain(views.iter().map(|(.., test)| *test))
        .collect();
    let mut motions = run(&tests)?;
    let of_start = |own: &Start| starts.iter().position(|other| other.name == own.name);

    let mut anew: Vec<(&Start, u64, ContactTest)> = Vec::new();
    for (own, motion) in starts.iter().zip(&motions) {
        let apart = own.parts.then(|| apart(motion)).flatten();
        anew.extend(apart.map(|row| (own, row.step, begun_at(&own.test, row))));
    }
    let further: Vec<ContactTest> = anew.iter().map(|(.., test)| *test).collect();
    motions.extend(run(&further)?);

    let rounding = Rounding::of(&motions.iter().collect::<Vec<_>>());
    let allowed = match rounding.is_single() {
        true => SAME_IN_SINGLE,
        false if rounding.digits < EXACT_DIGITS => {
            (GROWTH * libm::exp10(-f64::from(rounding.digits))).max(SAME)
        }
        false => SAME,
    };
    let (whole, others) = motions.split_at(starts.len());
    let (seen, later) = others.split_at(views.len());
    let mut worst: Vec<Deviation> = Vec::new();
    for ((own, view, _), found) in views.iter().zip(seen) {
        let Some(motion) = of_start(own).map(|place| &whole[place]) else {
            continue;
        };
        let expected = motion.rows().iter().map(|row| {
            let time = row.step as f64 * own.test.time_step;
            let bodies = numbers(row).map(|body| view.of(body, time, own.test.wall_height));
            (view.order(bodies), row.wall_force)
        });
        let with_wall = *view != View::UpsideDown;
        let of = || (format!("{}, {}", own.name, view.words()), view.cause());
        worst.extend(deviation(expected, found.rows(), with_wall, of));
    }
    for ((own, step, _), found) in anew.iter().zip(later) {
        let Some(motion) = of_start(own).map(|place| &whole[place]) else {
            continue;
        };
        let rest = motion.rows().iter().filter(|row| row.step >= *step);
        let expected = rest.map(|row| (numbers(row), row.wall_force));
        let of = || {
            let told = format!(
                "{}, begun anew at step {step}, where nothing touches",
                own.name
            );
            (
                told,
                "a contact remembers what was before it has opened: its spring is not cleared",
            )
        };
        worst.extend(deviation(expected, found.rows(), true, of));
    }
    let answers = tests.iter().chain(&further).zip(&motions);
    let answers = answers.map(|(test, motion)| Answer {
        test: *test,
        input_hash: String::new(),
        motion: motion.clone(),
    });
    Ok(Elsewhere {
        item: item(
            if in_space { IN_SPACE } else { NAME },
            worst,
            allowed,
            motions.len(),
        ),
        answers: answers.collect(),
    })
}

/// The largest deviation of a motion from what it must be.
struct Deviation {
    /// In units of the largest number of its kind.
    size: f64,
    motion: String,
    cause: &'static str,
    column: String,
    step: u64,
    found: f64,
    expected: f64,
}

fn item(name: &'static str, mut all: Vec<Deviation>, allowed: f64, count: usize) -> Item {
    let grade = Grade::Consistency;
    all.sort_by(|one, other| other.size.total_cmp(&one.size));
    let Some(worst) = all.first() else {
        return Item::not_tested(grade, name, "the motions have no rows");
    };
    if worst.size <= allowed {
        let found = format!(
            "{count} motions look the same elsewhere, to {:.1e}",
            worst.size
        );
        return Item::passed(grade, name, found);
    }
    let mut causes: Vec<String> = Vec::new();
    for own in all.iter().filter(|own| own.size > allowed) {
        let told = own.cause.to_owned();
        if causes.len() < MOST_CAUSES && !causes.contains(&told) {
            causes.push(told);
        }
    }
    let Deviation { column, step, .. } = worst;
    Item::failed(
        grade,
        name,
        format!(
            "{column} {:.9} at step {step}: the motion is {}",
            worst.expected, worst.motion
        ),
        format!("{column} {:.9}", worst.found),
        causes,
    )
}

/// Names of the numbers of a body; those that the plane lacks are 0 there.
const COLUMNS: [[&str; 3]; 5] = [
    ["x", "y", "z"],
    ["vx", "vy", "vz"],
    ["spinx", "spiny", "spin"],
    ["fx", "fy", "fz"],
    ["torquex", "torquey", "torque"],
];

/// The largest deviation of rows from those that are expected; those of a motion that ends early are compared as far as
/// they go.
fn deviation(
    expected: impl Iterator<Item = ([Numbers; 2], f64)>,
    found: &[MotionRow],
    with_wall: bool,
    of: impl Fn() -> (String, &'static str),
) -> Option<Deviation> {
    let expected: Vec<([Numbers; 2], f64)> = expected.collect();
    let largest = |vector: usize| {
        let bodies = expected.iter().flat_map(|(bodies, _)| bodies);
        let values = bodies.flat_map(|body| body[vector]);
        values.fold(0.0, |largest: f64, value| largest.max(value.abs()))
    };
    // A displacement of r, and torques of the largest force at r.
    let (speed, force) = (largest(1).max(largest(2)), largest(3));
    let scales = [1.0, speed, speed, force, force];
    let mut worst: Option<(f64, String, u64, f64, f64)> = None;
    let mut take = |name: &dyn Fn() -> String, scale: f64, step: u64, found: f64, expected: f64| {
        let size = (found - expected).abs() / scale;
        let size = if size.is_nan() { 0.0 } else { size };
        if worst.as_ref().is_none_or(|own| size > own.0) {
            worst = Some((size, name(), step, found, expected));
        }
    };
    for ((bodies, wall), row) in expected.iter().zip(found) {
        for (body, (expected, found)) in bodies.iter().zip(numbers(row)).enumerate() {
            for (vector, names) in COLUMNS.iter().enumerate() {
                for (axis, name) in names.iter().enumerate() {
                    let name = || format!("{name}{}", body + 1);
                    let (found, expected) = (found[vector][axis], expected[vector][axis]);
                    take(&name, scales[vector], row.step, found, expected);
                }
            }
        }
        if with_wall {
            take(
                &|| "wall_force".to_owned(),
                force,
                row.step,
                row.wall_force,
                *wall,
            );
        }
    }
    let (size, column, step, found, expected) = worst?;
    let (motion, cause) = of();
    Some(Deviation {
        size,
        motion,
        cause,
        column,
        step,
        found,
        expected,
    })
}

/// The last row of `motion` before the bodies meet again in which nothing touches, nor in the rows before and after.
fn apart(motion: &Motion) -> Option<&MotionRow> {
    let rows = motion.rows();
    let touches = |row: &MotionRow| {
        let [one, two] = numbers(row).map(|[position, ..]| position);
        let apart = (0..3).map(|axis| one[axis] - two[axis]);
        apart.map(|own| own * own).sum::<f64>() < 4.0
    };
    let first = rows.iter().position(touches)?;
    let parted = first + rows[first..].iter().position(|row| !touches(row))?;
    let again = parted + rows[parted..].iter().position(touches)?;
    let is_free = |row: &MotionRow| {
        let mut bodies = numbers(row).into_iter();
        bodies.all(|[.., force, torque]| force == [0.0; 3] && torque == [0.0; 3])
    };
    let places = parted + 1..again.checked_sub(1)?;
    let place = places
        .rev()
        .find(|place| rows[place - 1..=place + 1].iter().all(is_free))?;
    Some(&rows[place])
}

/// The rest of the motion of `test` from this `row` on.
fn begun_at(test: &ContactTest, row: &MotionRow) -> ContactTest {
    ContactTest {
        steps: test.steps - row.step,
        ..beginning_with(test, numbers(row))
    }
}

#[cfg(test)]
mod tests {
    use super::super::conventions;
    use super::super::report::Outcome;
    use super::*;
    use crate::dem::run_contact_test;

    fn of_native(
        convention: &ContactConvention,
        in_space: bool,
        change: impl Fn(&ContactTest, &mut Motion),
    ) -> Item {
        let run = |tests: &[ContactTest]| {
            let motions = tests.iter().map(|test| {
                let mut motion = run_contact_test(test).expect("it is finite");
                change(test, &mut motion);
                motion
            });
            Ok::<_, ()>(motions.collect())
        };
        let seen = seen(convention, in_space, run);
        seen.expect("every test is answered").item
    }

    #[test]
    fn motions_of_the_native_code_look_the_same_under_every_convention() {
        for convention in conventions() {
            for in_space in [false, true] {
                let item = of_native(&convention, in_space, |_, _| ());
                assert_eq!(item.outcome, Outcome::Passed, "{convention:?}: {item:?}");
            }
        }
    }

    #[test]
    fn what_depends_on_the_place_is_named_with_the_motion() {
        let pushed = |_: &ContactTest, motion: &mut Motion| {
            let rows = motion.rows().iter().map(|row| MotionRow {
                fx1: if row.x1 == 1.0 {
                    row.fx1 + 1e-4
                } else {
                    row.fx1
                },
                ..*row
            });
            let rows: Vec<MotionRow> = rows.collect();
            let steps = rows.len() as u64 - 1;
            *motion = Motion::new(rows, steps).expect("it is whole");
        };
        let item = of_native(&ContactConvention::TURNING, false, pushed);
        assert_eq!(item.outcome, Outcome::Failed);
        assert!(
            item.expected
                .contains("pressed on the floor, +0.75 r to the right"),
            "{item:?}"
        );
        assert_eq!(item.causes, [View::Moved(0.75).cause()]);
    }

    #[test]
    fn cylinders_part_before_they_meet_again() {
        let starts = starts(&ContactConvention::TURNING, false);
        let start = starts.iter().find(|own| own.parts).expect("a start");
        let motion = run_contact_test(&start.test).expect("it is finite");
        let row = apart(&motion).expect("a row in which nothing touches");
        let later = motion.rows().iter().filter(|later| later.step > row.step);
        let forces = later.map(|later| later.torque1.abs());
        assert!(forces.fold(0.0, f64::max) > 1e-3);
    }
}
