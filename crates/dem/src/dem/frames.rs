//! Frames of a native run: the sampled states with all contact forces.

use super::contact::{ContactModel, ConventionalModel, SpringDashpot};
use super::geometry::{Geometry, Space};
use super::power_law::PowerLaw;
use super::scene::Scene;
use super::stack_run::compress_stack_watched;
use super::stack_scene::{
    ConventionalStack, FLOOR, LoadedStack, SphereScene, StackScene, TOP_WALL,
};
use crate::model::{Case, PAPER_BODIES};
use crate::series::{ContactPoint, Frame, Frames, Partner, PlacedBody, Series, SeriesError};

/// Compresses the stack like [`compress_stack`](super::compress_stack), with the same bits, and keeps every contact
/// force at every row of the series.
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

fn into_frames<Model>(
    case: &Case,
    wanted: impl Fn() -> bool,
) -> Result<(Series, Frames), SeriesError>
where
    Model: ConventionalModel<f64> + ConventionalModel<f64, Space>,
{
    match case.stack.bodies {
        PAPER_BODIES => watched(case, StackScene::<f64, Model>::of_case(case, 0.0), wanted),
        _ => watched(case, SphereScene::<f64, Model>::of_case(case, 0.0), wanted),
    }
}

fn watched<const BODIES: usize, const WALLS: usize, Model, G>(
    case: &Case,
    scene: Scene<BODIES, WALLS, f64, Model, G>,
    wanted: impl Fn() -> bool,
) -> Result<(Series, Frames), SeriesError>
where
    Model: ContactModel<f64, G>,
    G: Geometry<f64>,
    Scene<BODIES, WALLS, f64, Model, G>: LoadedStack,
{
    let mut scenes = Vec::new();
    let series = compress_stack_watched(case, scene, wanted, |scene| {
        scenes.push(frame(case, scene));
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

/// Returns the present state of the scene, with step and time 0.
fn frame<const BODIES: usize, const WALLS: usize, Model, G>(
    case: &Case,
    scene: &Scene<BODIES, WALLS, f64, Model, G>,
) -> Frame
where
    Model: ContactModel<f64, G>,
    G: Geometry<f64>,
{
    let bodies = scene.cylinders.iter().take(count(case));
    let bodies = bodies.map(|body| PlacedBody {
        position: G::components(body.position),
        rotation: G::rotation_components(body.angle),
        velocity: Some(G::components(body.velocity)),
    });
    let contacts = pair_contacts(case, scene).chain(wall_contacts(case, scene));
    Frame {
        step: 0,
        time: 0.0,
        wall_force: scene.wall_force(TOP_WALL, case.stack.top()).normal,
        wall_height: -scene.walls[TOP_WALL].offset,
        bodies: bodies.collect(),
        contacts: contacts.filter(ContactPoint::is_loaded).collect(),
    }
}

/// The number of bodies in this stack.
fn count(case: &Case) -> usize {
    usize::from(case.stack.bodies) + 1
}

fn pair_contacts<const BODIES: usize, const WALLS: usize, Model, G>(
    case: &Case,
    scene: &Scene<BODIES, WALLS, f64, Model, G>,
) -> impl Iterator<Item = ContactPoint>
where
    Model: ContactModel<f64, G>,
    G: Geometry<f64>,
{
    let pairs = (1..count(case)).flat_map(|first| (0..first).map(move |second| (first, second)));
    pairs.map(|(first, second)| {
        let [one, other] =
            [first, second].map(|index| G::components(scene.cylinders[index].position));
        let apart = [0, 1, 2].map(|axis: usize| one[axis] - other[axis]);
        let [x, y, z] = apart;
        let distance = (x * x + y * y + z * z).sqrt();
        let middle = [0, 1, 2].map(|axis: usize| 0.5 * (one[axis] + other[axis]));
        let normal = apart.map(|component| component / distance);
        let force = scene.pair_force(first, second);
        let parts = (force.normal, force.tangential);
        contact::<G>(case, first, Partner::Body(second), middle, normal, parts)
    })
}

fn wall_contacts<const BODIES: usize, const WALLS: usize, Model, G>(
    case: &Case,
    scene: &Scene<BODIES, WALLS, f64, Model, G>,
) -> impl Iterator<Item = ContactPoint>
where
    Model: ContactModel<f64, G>,
    G: Geometry<f64>,
{
    let walls = [(FLOOR, Partner::Floor), (TOP_WALL, Partner::TopWall)].into_iter();
    walls.flat_map(move |(wall, partner)| {
        (0..count(case)).map(move |body| {
            let plane = &scene.walls[wall];
            let normal = G::components(plane.facing.normal::<_, G>(0.0));
            let [x, _, z] = G::components(scene.cylinders[body].position);
            let position = [x, plane.offset * normal[1], z];
            let force = scene.wall_force(wall, body);
            let parts = (force.normal, force.tangential);
            contact::<G>(case, body, partner, position, normal, parts)
        })
    })
}

/// A contact with its normal and tangential force.
fn contact<G: Geometry<f64>>(
    case: &Case,
    body: usize,
    partner: Partner,
    position: [f64; 3],
    normal: [f64; 3],
    (along, across): (f64, G::Tangent),
) -> ContactPoint {
    let direction = G::vector(normal);
    if case.stack.bodies == PAPER_BODIES {
        let ([x, y, _], [nx, ny, _]) = (position, normal);
        // In the plane n × f is the component of f along t.
        let [_, _, across] = G::rotation_components(G::torque(direction, across));
        return ContactPoint::in_plane(body, partner, [x, y], [nx, ny], [along, across]);
    }
    let force = G::components(G::put_together(direction, along, across));
    ContactPoint::in_space(body, partner, position, normal, force)
}
