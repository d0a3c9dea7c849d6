//! The cylinders that may touch a wall, with the springs and forces of these contacts.

use super::pairs::UNSTRETCHED;
use crate::dem::contact::{ContactForce, Spring};
use crate::dem::scene::Cylinder;
use crate::dem::wall::PlaneWall;

/// A cylinder beside a wall.
#[derive(Debug, Clone, Copy)]
pub(super) struct WallContact {
    pub cylinder: u32,
    pub memory: Spring<f64>,
    pub force: ContactForce<f64>,
}

/// The cylinders whose surfaces are less than `gap` away from `wall`, by ascending index. Those in `known`
/// keep spring and force.
pub(super) fn beside_wall(
    wall: &PlaneWall,
    cylinders: &[Cylinder],
    gap: f64,
    known: &[WallContact],
) -> Vec<WallContact> {
    let mut known = known.iter().copied().peekable();
    let mut contacts = Vec::new();
    for (cylinder, body) in (0..).zip(cylinders) {
        let old = known.next_if(|contact| contact.cylinder == cylinder);
        if -wall.overlap(body.position) < gap {
            contacts.push(old.unwrap_or(WallContact {
                cylinder,
                memory: UNSTRETCHED,
                force: ContactForce::none(0.0),
            }));
        }
    }
    contacts
}
