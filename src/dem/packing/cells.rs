//! Cell list: neighbours by square cells.

/// Points sorted into square cells, row by row. Empty cells take no memory, so that points may be anywhere.
pub(super) struct CellList {
    /// Cell row, cell column and index of every point, in this order.
    entries: Vec<(i64, i64, u32)>,
    edge: f64,
}

impl CellList {
    /// Sorts `points` into cells of size `reach`.
    pub fn new(points: impl Iterator<Item = [f64; 2]>, reach: f64) -> Self {
        let mut entries: Vec<_> = (0..)
            .zip(points)
            .map(|(index, point)| {
                let [column, row] = cell_of(point, reach);
                (row, column, index)
            })
            .collect();
        entries.sort_unstable();
        Self {
            entries,
            edge: reach,
        }
    }

    /// Calls `visit` with the indices of all points in the cell of `point` and the eight around it, which contain
    /// every point within reach.
    pub fn visit_around(&self, point: [f64; 2], mut visit: impl FnMut(u32)) {
        let [column, row] = cell_of(point, self.edge);
        for row in row.saturating_sub(1)..=row.saturating_add(1) {
            let from = (row, column.saturating_sub(1), 0);
            let to = (row, column.saturating_add(1), u32::MAX);
            let start = self.entries.partition_point(|entry| *entry < from);
            let beyond = self.entries[start..].iter();
            beyond
                .take_while(|entry| **entry <= to)
                .for_each(|entry| visit(entry.2));
        }
    }
}

/// Column and row.
fn cell_of(point: [f64; 2], edge: f64) -> [i64; 2] {
    point.map(|coordinate| (coordinate / edge).floor() as i64)
}
