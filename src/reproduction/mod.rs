//! What the paper did, done again.

mod preparation;

pub use preparation::between_side_walls;
