//! Where the bodies of a stack lie in space, and how they are numbered.

use super::Stack;
use super::stack::PAPER_BODIES;
use super::validity::{InvalidValue, within};
use serde::{Deserialize, Serialize};

/// Largest number of bodies in a stack.
pub const MOST_BODIES: usize = 6;

/// How the spheres of a stack lie and are numbered. The answer of a code depends on the displacement alone: the others
/// show the same stack from elsewhere.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct Arrangement {
    /// Angle in radians by which the stack is turned about the vertical.
    pub turn: f64,
    /// Whether the ring is numbered clockwise, seen from above.
    pub mirrored: bool,
    /// By how much every number is raised, cyclically; 0 numbers the top sphere 1.
    pub renumbered: u8,
    /// Distance in r by which the first sphere of the ring is displaced along the ring, so that no symmetry is left. The
    /// ring is so much wider that this sphere meets no neighbour: all just touch the top sphere, and nothing is pressed.
    pub displacement: f64,
}

impl Arrangement {
    /// Tells serde to leave the usual arrangement out of files and hashes.
    pub(super) fn is_usual(&self) -> bool {
        *self == Self::default()
    }
}

/// The place of a body on the floor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Index of the body: its number minus one.
    pub body: usize,
    /// Unit vector from the axis of the stack to the body, [x, z]; rolling outwards turns the body about [z, −x].
    pub outwards: [f64; 2],
}

impl Stack {
    /// Index of the body on top.
    pub fn top(&self) -> usize {
        self.body(0)
    }

    /// The bodies on the floor, in the order of the ring: cylinder 2 on the right, then cylinder 3.
    pub fn places(&self) -> impl ExactSizeIterator<Item = Place> + '_ {
        let Arrangement { turn, mirrored, .. } = self.arrangement;
        (0..usize::from(self.bodies)).map(move |position| {
            let angle = std::f64::consts::TAU * position as f64 / f64::from(self.bodies);
            let angle = turn + if mirrored { -angle } else { angle };
            // A rotation about y turns x towards −z.
            let outwards = match (self.bodies, position) {
                (PAPER_BODIES, 0) => [1.0, 0.0],
                (PAPER_BODIES, _) => [-1.0, 0.0],
                _ => [libm::cos(angle), -libm::sin(angle)],
            };
            Place {
                body: self.body(position + 1),
                outwards,
            }
        })
    }

    fn body(&self, position: usize) -> usize {
        (position + usize::from(self.arrangement.renumbered)) % (usize::from(self.bodies) + 1)
    }

    /// Centres of all bodies before loading, in the order of their numbers: [x, y, z] with y upwards. The bodies just
    /// touch; cylinders have z = 0.
    pub fn initial_positions(&self) -> Vec<[f64; 3]> {
        let displacement = self.arrangement.displacement;
        let ring = self.ring();
        let (radius, rise) = match displacement {
            0.0 => (ring.radius, ring.rise),
            _ => {
                let wider = ring.radius * (1.0 + 0.5 * displacement.abs());
                (wider, (4.0 - wider * wider).sqrt())
            }
        };
        let mut centres = vec![[0.0; 3]; usize::from(self.bodies) + 1];
        centres[self.top()] = [0.0, 1.0 + rise, 0.0];
        for (position, place) in self.places().enumerate() {
            let turn = if position == 0 {
                displacement / radius
            } else {
                0.0
            };
            let (sine, cosine) = (libm::sin(turn), libm::cos(turn));
            let [x, z] = place.outwards;
            // A rotation about y turns x towards −z.
            let turned = [x * cosine + z * sine, z * cosine - x * sine];
            let [x, z] = turned.map(|part| radius * part);
            centres[place.body] = [x, 1.0, z];
        }
        centres
    }

    pub(super) fn validate_arrangement(&self) -> Result<(), InvalidValue> {
        const MOST_DISPLACED: f64 = 0.01;
        let Arrangement {
            turn,
            renumbered,
            displacement,
            ..
        } = self.arrangement;
        if self.bodies == PAPER_BODIES && !self.arrangement.is_usual() {
            let value = self.bodies.into();
            let accepted = "3, 4 or 5 where `stack.arrangement` is given: cylinders lie as they do";
            return Err(InvalidValue::new("stack.bodies", value, accepted));
        }
        within("stack.arrangement.turn", turn, -1e3, 1e3)?;
        within(
            "stack.arrangement.renumbered",
            renumbered.into(),
            0.0,
            self.bodies.into(),
        )?;
        within(
            "stack.arrangement.displacement",
            displacement,
            -MOST_DISPLACED,
            MOST_DISPLACED,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stack(bodies: u8, arrangement: Arrangement) -> Stack {
        Stack {
            bodies,
            arrangement,
            ..Stack::paper(0.3, 100.0)
        }
    }

    fn distance(one: [f64; 3], other: [f64; 3]) -> f64 {
        let square = |axis: usize| (one[axis] - other[axis]) * (one[axis] - other[axis]);
        (square(0) + square(1) + square(2)).sqrt()
    }

    const OTHER: Arrangement = Arrangement {
        turn: 1.0,
        mirrored: true,
        renumbered: 2,
        displacement: 0.0,
    };

    #[test]
    fn the_cylinders_lie_as_in_the_paper_to_the_last_bit() {
        let stack = stack(2, Arrangement::default());
        let top = 1.0 + 3f64.sqrt();
        let expected = [[0.0, top, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
        assert_eq!(stack.initial_positions(), expected);
        let places = stack.places().map(|place| (place.body, place.outwards[0]));
        assert_eq!(places.collect::<Vec<_>>(), [(1, 1.0), (2, -1.0)]);
    }

    #[test]
    fn neighbours_and_the_top_sphere_just_touch_in_every_arrangement() {
        for bodies in 3..=5 {
            for arrangement in [Arrangement::default(), OTHER] {
                let stack = stack(bodies, arrangement);
                let centres = stack.initial_positions();
                let ring: Vec<_> = stack.places().map(|place| centres[place.body]).collect();
                for (index, &centre) in ring.iter().enumerate() {
                    let next = ring[(index + 1) % ring.len()];
                    assert!((distance(centre, next) - 2.0).abs() < 1e-15);
                    assert!((distance(centre, centres[stack.top()]) - 2.0).abs() < 1e-15);
                }
            }
        }
    }

    #[test]
    fn a_displaced_sphere_presses_nothing_and_still_touches_the_top() {
        for bodies in 3..=5 {
            for displacement in [1e-3, -1e-3] {
                let stack = stack(
                    bodies,
                    Arrangement {
                        displacement,
                        ..OTHER
                    },
                );
                let centres = stack.initial_positions();
                let ring: Vec<_> = stack.places().map(|place| centres[place.body]).collect();
                let mut gaps: Vec<f64> = (0..ring.len())
                    .map(|index| distance(ring[index], ring[(index + 1) % ring.len()]) - 2.0)
                    .collect();
                gaps.sort_by(f64::total_cmp);
                // One pair of neighbours is nearer than the others, and one is further apart.
                assert!(gaps[0] > 1e-5 && gaps[0] < 0.9e-3, "{gaps:?}");
                assert!(gaps[gaps.len() - 1] > 1.1e-3, "{gaps:?}");
                for centre in ring {
                    assert!((distance(centre, centres[stack.top()]) - 2.0).abs() < 1e-15);
                }
            }
        }
    }

    #[test]
    fn every_body_has_one_number() {
        for renumbered in 0..=4 {
            let stack = stack(
                4,
                Arrangement {
                    renumbered,
                    ..OTHER
                },
            );
            let on_floor = stack.places().map(|place| place.body);
            let mut numbers: Vec<usize> = on_floor.chain([stack.top()]).collect();
            numbers.sort_unstable();
            assert_eq!(numbers, [0, 1, 2, 3, 4]);
        }
    }

    #[test]
    fn arrangements_out_of_range_are_refused_by_their_key() {
        let refused = |bodies, arrangement: Arrangement, key: &str| {
            let error = stack(bodies, arrangement).validate().unwrap_err();
            assert!(error.to_string().contains(key), "{error}");
        };
        refused(2, OTHER, "stack.bodies");
        let far = Arrangement {
            displacement: 0.5,
            ..OTHER
        };
        refused(3, far, "stack.arrangement.displacement");
        let high = Arrangement {
            renumbered: 5,
            ..OTHER
        };
        refused(4, high, "stack.arrangement.renumbered");
        assert_eq!(stack(3, OTHER).validate(), Ok(()));
    }
}
