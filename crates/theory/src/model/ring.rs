//! The ring of bodies on the floor, and the one on top.

/// Equal bodies on the floor in a ring, each just touching its neighbours, and one of the same size on top that just
/// touches all of them: two cylinders, or three to five spheres. Lengths in r (docs/theory.md, Eqs. 97 and 98).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ring {
    /// n, number of bodies on the floor.
    pub bodies: f64,
    /// x₀ = 1/sin(π/n), distance of their centres from the axis.
    pub radius: f64,
    /// ψ₀, angle between the vertical and the line from such a centre to that of the top body.
    pub angle: f64,
    /// 2 cos ψ₀, height of the centre of the top body over theirs.
    pub rise: f64,
    /// μ_c = tan(ψ₀/2), the rigid critical floor friction.
    pub critical_friction: f64,
    /// Outward component of the forces of all neighbours on a body, divided by the force c of one neighbour: 2
    /// sin(π/n), and 1 for n = 2.
    pub push: f64,
}

impl Ring {
    /// The ring of `bodies` bodies.
    pub(super) fn new(bodies: u8) -> Self {
        let radius = libm::sin(std::f64::consts::PI / f64::from(bodies)).recip();
        Self::of_radius(bodies, radius)
    }

    /// Two cylinders that side walls have pushed to x₀ = 1 − `push`/3 before the top one touches them (docs/theory.md,
    /// Eq. 68). They overlap already, so [`neighbour_overlap`](Self::neighbour_overlap) does not hold for them.
    pub fn pushed(push: f64) -> Self {
        Self::of_radius(2, 1.0 - push / 3.0)
    }

    fn of_radius(bodies: u8, radius: f64) -> Self {
        let rise = (4.0 - radius * radius).sqrt();
        let neighbours = if bodies == 2 { 1.0 } else { 2.0 };
        Self {
            bodies: f64::from(bodies),
            radius,
            angle: libm::asin(0.5 * radius),
            rise,
            critical_friction: radius / (2.0 + rise),
            push: neighbours / radius,
        }
    }

    /// Overlap of neighbours whose centres have moved outwards by `outward`.
    pub fn neighbour_overlap(&self, outward: f64) -> f64 {
        -2.0 * outward / self.radius
    }
}

#[cfg(test)]
mod tests {
    use super::super::CRITICAL_FRICTION;
    use super::*;

    #[test]
    fn two_bodies_have_the_constants_of_the_paper_to_the_last_bit() {
        let ring = Ring::new(2);
        assert_eq!((ring.bodies, ring.radius, ring.push), (2.0, 1.0, 1.0));
        assert_eq!(ring.rise, 3f64.sqrt());
        assert_eq!(ring.critical_friction, CRITICAL_FRICTION);
        assert_eq!(ring.angle, std::f64::consts::FRAC_PI_6);
        assert_eq!(libm::acos(0.5 * ring.radius), std::f64::consts::FRAC_PI_3);
    }

    #[test]
    fn neighbours_and_the_top_body_just_touch() {
        for bodies in 2..=5 {
            let ring = Ring::new(bodies);
            let turn = 2.0 * std::f64::consts::PI / ring.bodies;
            let [x, y] = [turn.cos(), turn.sin()].map(|part| ring.radius * part);
            assert!((f64::hypot(x - ring.radius, y) - 2.0).abs() < 1e-15);
            assert!((ring.radius.hypot(ring.rise) - 2.0).abs() < 1e-15);
            // The force of a neighbour points from it to the body; this is its outward component.
            let neighbours = if bodies == 2 { 1.0 } else { 2.0 };
            assert!((ring.push - neighbours * 0.5 * (ring.radius - x)).abs() < 1e-15);
            let distance = (1.0 - 0.1 / ring.radius) * f64::hypot(x - ring.radius, y);
            assert!((ring.neighbour_overlap(-0.1) - (2.0 - distance)).abs() < 1e-15);
        }
    }

    #[test]
    fn critical_frictions_are_those_of_the_triangle_and_the_square() {
        let friction = |bodies| Ring::new(bodies).critical_friction;
        // √3 − √2 and √2 − 1, written without cancellation.
        assert!((friction(3) * (3f64.sqrt() + 2f64.sqrt()) - 1.0).abs() < 4e-16);
        assert!((friction(4) * (2f64.sqrt() + 1.0) - 1.0).abs() < 4e-16);
        for bodies in 2..=5 {
            let half = 0.5 * Ring::new(bodies).angle;
            assert!((friction(bodies) - half.tan()).abs() < 2e-16);
        }
    }
}
