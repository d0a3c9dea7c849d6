//! Cell list: neighbour search with square or cubic cells.

use crate::dem::geometry::Geometry;
use std::marker::PhantomData;
use std::ops::RangeInclusive;

/// Points sorted into cells, layer by layer and row by row; the plane is one layer. Empty cells take no memory, so that
/// points may be anywhere.
pub(super) struct CellList<G> {
    /// Cell and index of every point, sorted.
    entries: Vec<(Cell, u32)>,
    edge: f64,
    geometry: PhantomData<G>,
}

/// Layer, row and column.
type Cell = [i64; 3];

impl<G: Geometry<f64>> CellList<G> {
    /// Sorts `points` into cells of size `reach`.
    pub fn new(points: impl Iterator<Item = G::Vector>, reach: f64) -> Self {
        let mut entries: Vec<_> = (0..)
            .zip(points)
            .map(|(index, point)| (Self::cell_of(point, reach), index))
            .collect();
        entries.sort_unstable();
        Self {
            entries,
            edge: reach,
            geometry: PhantomData,
        }
    }

    /// Calls `visit` with the indices of all points in the cell of `point` and those around it, which contain every
    /// point within reach.
    pub fn visit_around(&self, point: G::Vector, mut visit: impl FnMut(u32)) {
        let [layer, row, column] = Self::cell_of(point, self.edge);
        let layers = if G::AXES < 3 {
            layer..=layer
        } else {
            around(layer)
        };
        for layer in layers {
            for row in around(row) {
                let columns = around(column);
                let from = ([layer, row, *columns.start()], 0);
                let to = ([layer, row, *columns.end()], u32::MAX);
                let start = self.entries.partition_point(|entry| *entry < from);
                let beyond = self.entries[start..].iter();
                beyond
                    .take_while(|entry| **entry <= to)
                    .for_each(|entry| visit(entry.1));
            }
        }
    }

    fn cell_of(point: G::Vector, edge: f64) -> Cell {
        let [x, y, z] = G::components(point);
        [z, y, x].map(|coordinate| (coordinate / edge).floor() as i64)
    }
}

fn around(place: i64) -> RangeInclusive<i64> {
    place.saturating_sub(1)..=place.saturating_add(1)
}
