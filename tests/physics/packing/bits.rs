//! A packing beside the scene that visits every pair.

use super::{TIME_STEP, distance, moving, solid};
use tristack::code::Code;
use tristack::dem::{
    Body, ContactForce, Cylinder, Facing, Geometry, Material, Packing, PlaneWall, Scene, Space,
    Sphere, SpringDashpot,
};
use tristack::model::{ContactConvention, Stack};

const FLOOR: PlaneWall = PlaneWall {
    facing: Facing::Up,
    offset: 0.0,
    speed: 0.0,
    friction: 0.3,
};

/// Bodies and walls in a scene and in a packing.
struct Twins<const N: usize, const W: usize, G: Geometry<f64>> {
    scene: Scene<N, W, f64, SpringDashpot<f64>, G>,
    packing: Packing<G>,
}

impl<const N: usize, const W: usize, G: Geometry<f64>> Twins<N, W, G>
where
    Body<f64, G>: PartialEq,
    ContactForce<f64, G>: PartialEq,
{
    fn new(bodies: [Body<f64, G>; N], walls: [PlaneWall; W], material: Material) -> Self {
        let mut scene = Scene::new(bodies, walls, material.law, TIME_STEP);
        scene.cylinder_friction = material.cylinder_friction;
        scene.moment_of_inertia = material.moment_of_inertia;
        let packing = Packing::new(bodies.to_vec(), walls.to_vec(), material, TIME_STEP);
        Self { scene, packing }
    }

    /// Steps both and compares every bit of every body and of every force of a wall.
    fn assert_same_bits(&mut self, gravity: f64, steps: u64) {
        let Self { scene, packing } = self;
        for step in 0..steps {
            let risen = gravity * (step as f64 / 1000.0).min(1.0);
            (scene.gravity, packing.gravity) = (risen, risen);
            scene.evaluate_forces();
            packing.evaluate_forces();
            for wall in 0..W {
                for (body, force) in packing.wall_forces(wall) {
                    assert_eq!(force, scene.wall_force(wall, body), "step {step}");
                }
            }
            scene.advance();
            packing.advance();
            assert_eq!(scene.cylinders, packing.cylinders(), "step {step}");
        }
    }
}

/// The material of cylinders under `convention`.
fn cylinders(convention: &ContactConvention) -> Material {
    Material::new(&Stack::paper(0.3, 1e3), convention)
}

/// Codes that differ in arms, spring and operand of Coulomb's limit.
fn conventions() -> [ContactConvention; 3] {
    let built_in = |name| Code::named(name).expect("it is built in");
    let codes = [Code::native(), built_in("liggghts"), built_in("lammps")];
    codes.map(|code| code.declaration().convention)
}

#[test]
fn three_cylinders_have_the_same_bits_as_in_the_small_scene() {
    let height = 1.0 + 3_f64.sqrt();
    let stack = [(0.0, height), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| Cylinder::at(x, y));
    let lid = PlaneWall {
        facing: Facing::Down,
        offset: -(height + 1.2),
        speed: 1e-3,
        friction: 0.0,
    };
    for convention in conventions() {
        let mut twins = Twins::new(stack, [FLOOR, lid], cylinders(&convention));
        twins.assert_same_bits(1e-3, 8000);
        // It has yielded: cylinders slid on the floor and lost each other.
        assert!(twins.packing.cylinders()[1].position[0] > 2.0);
    }
}

/// A heap without any order, dropped between walls: contacts come and go, and lists are made anew.
#[test]
fn a_tumbling_heap_has_the_same_bits_as_in_the_small_scene() {
    let scatter = |index: u32, prime: u32| f64::from(index * prime % 101) / 101.0;
    let heap: [Cylinder; 60] = std::array::from_fn(|from_the_end| {
        let index = 59 - from_the_end as u32;
        let (column, row) = (f64::from(index % 6), f64::from(index / 6));
        let x = 2.3 * column + 0.2 * scatter(index, 37);
        let mut cylinder = Cylinder::at(x, 1.0 + 2.3 * row + 0.2 * scatter(index, 53));
        cylinder.velocity = [0.1 * (scatter(index, 71) - 0.5), 0.0];
        cylinder
    });
    let side = |facing, offset| PlaneWall {
        facing,
        offset,
        ..FLOOR
    };
    let walls = [FLOOR, side(Facing::Right, -1.0), side(Facing::Left, -13.0)];
    let mut twins = Twins::new(heap, walls, cylinders(&ContactConvention::TURNING));
    twins.assert_same_bits(1e-3, 4000);
    let top = |cylinders: &[Cylinder]| {
        let heights = cylinders.iter().map(|cylinder| cylinder.position[1]);
        heights.fold(0.0, f64::max)
    };
    assert!(top(twins.packing.cylinders()) < top(&heap) - 1.0);
}

/// Eight spheres that fill a box, each touching three others and three walls, turn and slide; then the walls recede, and
/// the spheres move about.
#[test]
fn eight_spheres_in_a_box_have_the_same_bits_as_in_the_small_scene() {
    const FRICTION: f64 = 0.05;
    let corner = |index: usize, bit: usize| if index >> bit & 1 == 0 { -0.995 } else { 0.995 };
    let corners: [_; 8] = std::array::from_fn(|index| [0, 1, 2].map(|bit| corner(index, bit)));
    let spheres: [Sphere; 8] = moving(&corners, 0.02).try_into().expect("eight");
    let walls = [
        Facing::Up,
        Facing::Down,
        Facing::Left,
        Facing::Right,
        Facing::Front,
        Facing::Back,
    ];
    let walls = walls.map(|facing| PlaneWall {
        facing,
        offset: -1.99,
        speed: -1e-3,
        friction: FRICTION,
    });
    for convention in conventions() {
        let mut twins = Twins::new(spheres, walls, solid(convention));
        twins.assert_same_bits(1e-3, 1);
        let Twins { scene, packing } = &twins;
        for first in 0..8 {
            for second in 0..first {
                let are_neighbours = usize::is_power_of_two(first ^ second);
                let touch = scene.pair_force(first, second).normal != 0.0;
                assert_eq!(touch, are_neighbours, "{first} {second}");
            }
        }
        let slides = |force: &ContactForce<f64, Space>| {
            let square: f64 = force.tangential.iter().map(|part| part * part).sum();
            (square.sqrt() / (FRICTION * force.normal.abs()) - 1.0).abs() < 1e-12
        };
        for wall in 0..6 {
            let forces = || packing.wall_forces(wall).map(|(_, force)| force);
            assert_eq!(forces().filter(|force| force.normal != 0.0).count(), 4);
            assert!(forces().any(slides));
        }
        twins.assert_same_bits(1e-3, 6000);
        let moved = twins.packing.cylinders().iter().zip(&spheres);
        let moved = moved.map(|(now, then)| distance(now.position, then.position));
        assert!(moved.fold(0.0, f64::max) > 1.0);
    }
}
