//! The paper's preparation between side walls.

use crate::stack::{Preparation, Protocol, Sampling, SideWalls};

/// How much further the wall goes than after a gravity ramp: a stack that starts with c > 0 yields later.
const FURTHER: f64 = 1.3;
/// Part of the way to the yield from which rows are fine.
const FINE_FROM: f64 = 0.5;

/// `protocol`, planned for a gravity ramp, with a preparation between side walls in its place.
pub fn between_side_walls(protocol: &Protocol, walls: SideWalls) -> Protocol {
    Protocol {
        preparation: Preparation::SideWalls(walls),
        wall_travel: FURTHER * protocol.wall_travel,
        sampling: Sampling {
            fine_from_travel: FINE_FROM * protocol.sampling.fine_from_travel,
            ..protocol.sampling
        },
        ..*protocol
    }
}
