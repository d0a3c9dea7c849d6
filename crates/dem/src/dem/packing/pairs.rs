//! Verlet list: the pairs of bodies that may touch, with their tangential springs.

use super::cells::CellList;
use crate::dem::body::Body;
use crate::dem::contact::Spring;
use crate::dem::geometry::Geometry;

/// All pairs within some distance, each once, grouped by their first body, which has the higher index. Both indices
/// ascend, so that the order of sums over pairs depends on the indices alone.
#[derive(Debug, Clone)]
pub(super) struct PairList<G: Geometry<f64>> {
    /// End of the pairs of each first body, where those of the next one begin.
    pub ends: Vec<u32>,
    /// Second body of each pair.
    pub seconds: Vec<u32>,
    /// Tangential spring of each pair.
    pub memories: Vec<Spring<f64, G>>,
}

impl<G: Geometry<f64>> PairList<G> {
    /// A list for `count` bodies, without pairs.
    pub fn empty(count: usize) -> Self {
        Self {
            ends: vec![0; count],
            seconds: Vec::new(),
            memories: Vec::new(),
        }
    }

    /// The pairs whose centres are less than `reach` apart. A pair of `self` keeps its spring.
    pub fn renewed(&self, cylinders: &[Body<f64, G>], reach: f64) -> Self {
        let cells = CellList::<G>::new(cylinders.iter().map(|cylinder| cylinder.position), reach);
        let mut list = Self {
            ends: Vec::with_capacity(cylinders.len()),
            seconds: Vec::with_capacity(self.seconds.len()),
            memories: Vec::with_capacity(self.memories.len()),
        };
        for (first, cylinder) in cylinders.iter().enumerate() {
            let begin = list.seconds.len();
            cells.visit_around(cylinder.position, |second| {
                let other = &cylinders[second as usize];
                let is_close = || Body::apart([cylinder, other]).1 < reach * reach;
                if (second as usize) < first && is_close() {
                    list.seconds.push(second);
                }
            });
            list.seconds[begin..].sort_unstable();
            let memories = list.seconds[begin..]
                .iter()
                .map(|&second| self.memory(first, second));
            list.memories.extend(memories);
            list.ends.push(list.seconds.len() as u32);
        }
        list
    }

    fn memory(&self, first: usize, second: u32) -> Spring<f64, G> {
        let start = first.checked_sub(1).map_or(0, |before| self.ends[before]);
        let range = start as usize..self.ends[first] as usize;
        let found = self.seconds[range.clone()].binary_search(&second);
        found.map_or(Spring::unstretched(0.0), |place| {
            self.memories[range.start + place]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::{Plane, Space};

    fn scattered<G: Geometry<f64>>(count: u32) -> Vec<Body<f64, G>> {
        let place = |index: u32, prime: u32| f64::from(index * prime % 97) / 97.0;
        let near = (0..count).map(|index| {
            [
                20.0 * place(index, 31) - 10.0,
                12.0 * place(index, 57) - 3.0,
                6.0 * place(index, 83) - 3.0,
            ]
        });
        near.chain([[-1e12, 1e12, -1e12], [f64::MAX, -1e300, 1e300]])
            .map(|centre| Body::resting(G::vector(centre)))
            .collect()
    }

    fn pairs<G: Geometry<f64>>(list: &PairList<G>) -> Vec<(usize, u32)> {
        let mut start = 0;
        let mut pairs = Vec::new();
        for (first, &end) in list.ends.iter().enumerate() {
            let seconds = &list.seconds[start..end as usize];
            pairs.extend(seconds.iter().map(|&second| (first, second)));
            start = end as usize;
        }
        pairs
    }

    fn assert_every_close_pair_is_listed<G: Geometry<f64>>() {
        let bodies = scattered::<G>(90);
        let list = PairList::empty(bodies.len()).renewed(&bodies, 2.5);
        let mut close = Vec::new();
        for (first, one) in bodies.iter().enumerate() {
            for (second, other) in (0..).zip(&bodies[..first]) {
                if Body::apart([one, other]).1 < 2.5 * 2.5 {
                    close.push((first, second));
                }
            }
        }
        assert!(close.len() > 100, "{}", close.len());
        assert_eq!(pairs(&list), close);
        assert_eq!(list.memories.len(), close.len());
    }

    #[test]
    fn a_list_holds_every_close_pair_once_and_in_order() {
        assert_every_close_pair_is_listed::<Plane>();
        assert_every_close_pair_is_listed::<Space>();
    }

    #[test]
    fn a_new_list_remembers_what_the_old_one_knew() {
        let mut cylinders = scattered::<Plane>(90);
        let mut old = PairList::empty(cylinders.len()).renewed(&cylinders, 2.5);
        for (length, memory) in (1..).zip(&mut old.memories) {
            memory.length = f64::from(length);
        }
        for cylinder in &mut cylinders {
            cylinder.position[0] *= 0.9;
        }
        let new = old.renewed(&cylinders, 2.5);
        let known = pairs(&old);
        let mut remembered = 0;
        for (pair, memory) in pairs(&new).iter().zip(&new.memories) {
            match known.binary_search(pair) {
                Ok(place) => {
                    assert_eq!(*memory, old.memories[place]);
                    remembered += 1;
                }
                Err(_) => assert_eq!(*memory, Spring::unstretched(0.0)),
            }
        }
        assert!(remembered > 100 && remembered < new.memories.len());
    }
}
