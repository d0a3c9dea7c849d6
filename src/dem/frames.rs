//! The sampled states of a native run with all contact forces.

use super::contact::{ContactModel, ConventionalModel, SpringDashpot};
use super::power_law::PowerLaw;
use super::stack_run::{compress_stack_watched, law};
use super::stack_scene::{FLOOR, StackScene, TOP, TOP_WALL};
use crate::model::Case;
use crate::series::{ContactPoint, Frame, Frames, Partner, PlacedCylinder, Series, SeriesError};

/// Compresses the stack like [`compress_stack`](super::compress_stack), to the same bits, and keeps every contact force
/// at every row of the series.
///
/// # Errors
/// If the motion leaves the finite numbers, or the run is given up.
pub fn compress_stack_into_frames(
    case: &Case,
    wanted: impl Fn() -> bool,
) -> Result<(Series, Frames), SeriesError> {
    match case.convention.law.is_linear() {
        true => into_frames::<SpringDashpot<f64>>(case, wanted),
        false => into_frames::<PowerLaw<f64>>(case, wanted),
    }
}

fn into_frames<Model: ConventionalModel<f64>>(
    case: &Case,
    wanted: impl Fn() -> bool,
) -> Result<(Series, Frames), SeriesError> {
    let mut scenes = Vec::new();
    let model: Model = law(case, 0.0);
    let series = compress_stack_watched(case, (model, 0.0), wanted, |scene| {
        scenes.push(frame(scene));
    })?;
    let stamped = scenes.into_iter().zip(series.samples());
    let frames = stamped.map(|(frame, sample)| Frame {
        step: sample.step,
        time: sample.time,
        ..frame
    });
    let frames = Frames {
        frames: frames.collect(),
        pair_forces_known: true,
    };
    Ok((series, frames))
}

/// The present state of the scene, at time 0.
fn frame<Model: ContactModel<f64>>(scene: &StackScene<f64, Model>) -> Frame {
    let cylinders = scene.cylinders.iter().map(|cylinder| PlacedCylinder {
        position: cylinder.position,
        angle: cylinder.angle,
        velocity: Some(cylinder.velocity),
    });
    let contacts = pair_contacts(scene).chain(wall_contacts(scene));
    let loaded = |contact: &ContactPoint| contact.force() != [0.0; 2];
    Frame {
        step: 0,
        time: 0.0,
        wall_force: scene.wall_force(TOP_WALL, TOP).normal,
        wall_height: -scene.walls[TOP_WALL].offset,
        cylinders: cylinders.collect(),
        contacts: contacts.filter(loaded).collect(),
    }
}

fn pair_contacts<Model: ContactModel<f64>>(
    scene: &StackScene<f64, Model>,
) -> impl Iterator<Item = ContactPoint> + '_ {
    let count = scene.cylinders.len();
    let pairs = (1..count).flat_map(|first| (0..first).map(move |second| (first, second)));
    pairs.map(|(first, second)| {
        let [one, other] = [first, second].map(|index| scene.cylinders[index].position);
        let apart = [one[0] - other[0], one[1] - other[1]];
        let distance = (apart[0] * apart[0] + apart[1] * apart[1]).sqrt();
        let force = scene.pair_force(first, second);
        ContactPoint {
            cylinder: first,
            partner: Partner::Cylinder(second),
            position: [0.5 * (one[0] + other[0]), 0.5 * (one[1] + other[1])],
            normal: apart.map(|component| component / distance),
            normal_force: force.normal,
            tangential_force: force.tangential,
        }
    })
}

fn wall_contacts<Model: ContactModel<f64>>(
    scene: &StackScene<f64, Model>,
) -> impl Iterator<Item = ContactPoint> + '_ {
    let walls = [(FLOOR, Partner::Floor), (TOP_WALL, Partner::TopWall)].into_iter();
    walls.flat_map(move |(wall, partner)| {
        (0..scene.cylinders.len()).map(move |cylinder| {
            let plane = &scene.walls[wall];
            let normal = plane.facing.normal(0.0);
            let [x, _] = scene.cylinders[cylinder].position;
            let force = scene.wall_force(wall, cylinder);
            ContactPoint {
                cylinder,
                partner,
                position: [x, plane.offset * normal[1]],
                normal,
                normal_force: force.normal,
                tangential_force: force.tangential,
            }
        })
    })
}
