//! Numbers by which quantities are often off, with what is behind them.

use std::f64::consts::PI;

/// Relative distance at which two numbers count as the same.
const SAME_NUMBER: f64 = 2e-3;

/// Whether `found` is `value`, to three digits.
pub(super) fn is_about(found: f64, value: f64) -> bool {
    (found - value).abs() <= SAME_NUMBER * value.abs().max(f64::MIN_POSITIVE)
}

/// The meanings of those `candidates` that `found` is equal to, at most three.
pub(super) fn meanings(found: f64, candidates: &[(f64, String)]) -> Vec<String> {
    let fitting = candidates
        .iter()
        .filter(|(value, _)| value.is_finite() && *value != 0.0 && is_about(found, *value));
    let mut meanings: Vec<String> = fitting.map(|(_, meaning)| meaning.clone()).collect();
    meanings.dedup();
    meanings.truncate(3);
    meanings
}

/// Meanings of a factor by which a force, a length or a stiffness is off, where m g is `weight` k_n r.
pub(super) fn of_factor(factor: f64, weight: f64) -> Vec<String> {
    let own = |value: f64, meaning: &str| (value, meaning.to_owned());
    let candidates = [
        own(
            2.0,
            "it counts twice: a contact that is visited from both of its bodies, or two equal springs side by side",
        ),
        own(
            0.5,
            "it is half: two equal springs in series (k/2), or one of two contributions",
        ),
        own(
            1.0 / weight,
            "its unit is m g, and must be k_n r (here m g = gravity * k_n r)",
        ),
        own(
            weight,
            "it is multiplied by gravity once more, or divided by its unit the wrong way round",
        ),
        own(180.0 / PI, "it is in degrees, and must be in radians"),
        own(
            PI / 180.0,
            "it was converted from degrees, but was in radians already",
        ),
        own(
            4.0 / 3.0 * PI,
            "4 pi/3: the volume of a sphere of radius 1, with density 1; the mass must be 1",
        ),
        own(
            3.0 / (4.0 * PI),
            "3/(4 pi): divided by the volume of a sphere",
        ),
        own(
            PI,
            "pi: the volume of a cylinder of length 1 with density 1; the mass must be 1",
        ),
        own(1.0 / PI, "1/pi: divided by the area of the circle"),
        own(
            4.0 / 3.0,
            "4/3: the mass of a sphere with the density of a cylinder",
        ),
        own(
            0.75,
            "3/4: the mass of a cylinder with the density of a sphere",
        ),
        own(
            2.0 / 3.0,
            "2/3: the mass of a sphere in a cylinder of the same height",
        ),
        own(
            PI / 6.0,
            "pi/6: the volume of a sphere of diameter 1 with density 1",
        ),
        own(
            9.81,
            "9.81: gravity in m/s^2; it must be the parameter `gravity`",
        ),
        own(
            1.0 / 9.81,
            "1/9.81: gravity in m/s^2; it must be the parameter `gravity`",
        ),
        own(3.0, "3: the sum over all three cylinders"),
        own(1.0 / 3.0, "1/3: the mean over the three cylinders"),
        own(1e3, "1000: a prefix of the unit (k or m)"),
        own(1e-3, "1/1000: a prefix of the unit (k or m)"),
    ];
    meanings(factor, &candidates)
}

/// Meanings of a friction that was found where `asked` was, and `other` is that of the other contacts.
pub(super) fn of_friction(found: f64, asked: f64, other: f64) -> Vec<String> {
    if found.abs() < 1e-9 {
        let none =
            "there is no friction at all: the tangential force is never computed, or its cap is 0";
        return vec![none.to_owned()];
    }
    let (degrees, angle) = (asked.to_radians(), libm::atan(asked));
    let candidates = [
        (
            libm::tan(asked),
            "tan(mu): the coefficient is taken for an angle of friction in radians",
        ),
        (
            angle,
            "atan(mu): the coefficient is converted to an angle, and the angle used as a coefficient",
        ),
        (
            libm::tan(degrees),
            "tan(mu in degrees): the coefficient is taken for an angle in degrees",
        ),
        (
            degrees,
            "mu pi/180: the coefficient is converted as if it were degrees",
        ),
        (
            angle.to_degrees(),
            "the angle of friction in degrees is used as a coefficient",
        ),
        (
            libm::sin(angle),
            "sin(atan mu): the sine of the angle of friction in place of its tangent",
        ),
        (
            other,
            "the friction of the other contacts: floor_friction and cylinder_friction are exchanged, or one serves for both",
        ),
        (
            0.5 * (asked + other),
            "the mean of floor_friction and cylinder_friction",
        ),
        (
            (asked * other).sqrt(),
            "the geometric mean of floor_friction and cylinder_friction",
        ),
        (
            2.0 * asked * other / (asked + other),
            "the harmonic mean of floor_friction and cylinder_friction",
        ),
        (2.0 * asked, "twice mu"),
        (0.5 * asked, "half of mu"),
        (
            asked * asked,
            "mu squared: it is multiplied twice, or combined as a product",
        ),
        (asked.sqrt(), "the square root of mu"),
    ];
    meanings(
        found,
        &candidates.map(|(value, meaning)| (value, meaning.to_owned())),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_factor_has_the_meanings_that_it_may_have_and_no_others() {
        let told = |factor| of_factor(factor, 0.01).join(" ");
        assert!(told(100.0).contains("unit is m g"));
        assert!(told(180.0 / PI).contains("degrees"));
        assert!(told(4.0 / 3.0 * PI).contains("sphere"));
        assert_eq!(told(1.234), "");
        // Without a weight nothing is mistaken for one.
        assert!(of_factor(0.0, f64::INFINITY).is_empty());
    }

    #[test]
    fn a_friction_is_told_from_its_angles() {
        let told = |found| of_friction(found, 0.3, 0.7).join(" ");
        assert!(told(libm::tan(0.3)).starts_with("tan(mu)"));
        assert!(told(libm::atan(0.3)).starts_with("atan(mu)"));
        assert!(told(0.7).contains("exchanged"));
        assert!(told(0.5).contains("mean"));
        assert!(told(0.0).contains("no friction"));
        assert_eq!(told(0.44), "");
    }
}
