//! The bodies that may touch a wall, with the springs and forces of these contacts.

use crate::dem::body::Body;
use crate::dem::contact::{ContactForce, Spring};
use crate::dem::geometry::Geometry;
use crate::dem::wall::PlaneWall;

/// A cylinder or sphere near a wall.
#[derive(Debug, Clone, Copy)]
pub(super) struct WallContact<G: Geometry<f64>> {
    pub cylinder: u32,
    pub memory: Spring<f64, G>,
    pub force: ContactForce<f64, G>,
}

/// Returns the bodies whose surfaces are less than `gap` from `wall`, by ascending index. Those in `known` keep spring
/// and force.
pub(super) fn beside_wall<G: Geometry<f64>>(
    wall: &PlaneWall,
    cylinders: &[Body<f64, G>],
    gap: f64,
    known: &[WallContact<G>],
) -> Vec<WallContact<G>> {
    let mut known = known.iter().copied().peekable();
    let mut contacts = Vec::new();
    for (cylinder, body) in (0..).zip(cylinders) {
        let old = known.next_if(|contact| contact.cylinder == cylinder);
        if -wall.overlap::<G>(body.position) < gap {
            contacts.push(old.unwrap_or(WallContact {
                cylinder,
                memory: Spring::unstretched(0.0),
                force: ContactForce::none(0.0),
            }));
        }
    }
    contacts
}
