//! A face-centred heap of spheres in a box.

use tristack::dem::{Facing, PlaneWall};

/// Square layers of touching spheres, each in the hollows of the one below. Every other layer, the lowest among them,
/// has `edge` × `edge` spheres, so that its outermost ones touch the side walls.
#[derive(Debug, Clone, Copy)]
pub struct Heap {
    pub edge: u32,
    pub layers: u32,
}

impl Heap {
    /// Centres of the spheres, layer by layer upwards from a floor at y = 0.
    pub fn centres(self) -> Vec<[f64; 3]> {
        let layers = (0..self.layers).flat_map(|layer| {
            let count = self.edge - layer % 2;
            let height = 1.0 + 2_f64.sqrt() * f64::from(layer);
            let place = move |index: u32| f64::from(2 * index) - f64::from(count - 1);
            (0..count * count)
                .map(move |index| [place(index % count), height, place(index / count)])
        });
        layers.collect()
    }

    /// The same a little closer together, so that all contacts have an overlap.
    pub fn compressed(self) -> Vec<[f64; 3]> {
        let centres = self.centres().into_iter();
        centres
            .map(|centre| centre.map(|part| 0.998 * part))
            .collect()
    }

    /// Floor and side walls at rest, with these coefficients of friction.
    pub fn walls(self, floor: f64, sides: [f64; 4]) -> Vec<PlaneWall> {
        let facing = [Facing::Right, Facing::Left, Facing::Front, Facing::Back];
        let wall = |facing, offset, friction| PlaneWall {
            facing,
            offset,
            speed: 0.0,
            friction,
        };
        let aside = -f64::from(self.edge);
        let sides = facing.into_iter().zip(sides);
        let sides = sides.map(|(facing, friction)| wall(facing, aside, friction));
        [wall(Facing::Up, 0.0, floor)]
            .into_iter()
            .chain(sides)
            .collect()
    }
}
