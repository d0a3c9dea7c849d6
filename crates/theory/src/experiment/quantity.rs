//! Quantities as people write them: "1 MPa", "1000 kg/m3", "20mm".

use std::str::FromStr;
use uom::si::f64::{Length, Mass, MassDensity, Pressure};
use uom::si::length::meter;
use uom::si::mass::kilogram;
use uom::si::mass_density::kilogram_per_cubic_meter;
use uom::si::pressure::pascal;

/// Reads a pressure or a modulus, in Pa.
///
/// # Errors
/// The accepted units and an example, as for the other quantities.
pub fn modulus(text: &str) -> Result<f64, String> {
    let accepted = "Pa, kPa, MPa, GPa, N/mm2 or psi, as in \"1 MPa\"";
    let units = &[
        "Pa",
        "kPa",
        "MPa",
        "GPa",
        "N/mm²",
        "psi",
        "pascal",
        "kilopascal",
        "megapascal",
        "gigapascal",
    ];
    quantity(text, units, accepted, |read: Pressure| read.get::<pascal>())
}

/// Reads a mass density, in kg/m³.
pub fn density(text: &str) -> Result<f64, String> {
    let accepted = "kg/m3, g/cm3 or t/m3, as in \"1000 kg/m3\"";
    let units = &["kg/m³", "g/cm³", "t/m³"];
    quantity(text, units, accepted, |read: MassDensity| {
        read.get::<kilogram_per_cubic_meter>()
    })
}

/// Reads a length, in m.
pub fn length(text: &str) -> Result<f64, String> {
    let accepted = "m, cm, mm, um or in, as in \"1 cm\"";
    let units = &["m", "cm", "mm", "µm", "in"];
    quantity(text, units, accepted, |read: Length| read.get::<meter>())
}

/// Reads a mass, in kg.
pub fn mass(text: &str) -> Result<f64, String> {
    let accepted = "kg, g, mg or t, as in \"21.9 g\"";
    let units = &["kg", "g", "mg", "t"];
    quantity(text, units, accepted, |read: Mass| read.get::<kilogram>())
}

/// Parses `text` as a quantity in one of `units`, written as by [`spelled_out`]. Case matters, and units that only
/// `uom` knows are refused, because some are easily mistaken for these (M is the nautical mile).
fn quantity<Q: FromStr>(
    text: &str,
    units: &[&str],
    accepted: &str,
    si: fn(Q) -> f64,
) -> Result<f64, String> {
    let text = spelled_out(text);
    let unit = text.split_once(' ').map_or("", |(_, unit)| unit);
    let value = text.parse().ok().filter(|_| units.contains(&unit)).map(si);
    let value = value.filter(|value| value.is_finite() && *value > 0.0);
    value.ok_or_else(|| format!("accepted is a number above 0 and its unit: {accepted}"))
}

/// Rewrites `text` as `uom` parses it: one blank between number and unit, powers raised, µ for micro.
fn spelled_out(text: &str) -> String {
    let text = text.trim();
    // The longest prefix that is a number: "1e" is not one, so that the e of a unit stays with the unit.
    let is_number = |&end: &usize| {
        text.get(..end)
            .is_some_and(|part| part.parse::<f64>().is_ok())
    };
    let end = (0..=text.len()).rev().find(is_number);
    let (number, unit) = text.split_at(end.unwrap_or(0));
    let unit: String = unit.split_whitespace().collect();
    let unit = unit.replace("**", "").replace('^', "");
    let unit = unit.replace('2', "²").replace('3', "³").replace('μ', "µ");
    let unit = match unit.strip_prefix('u') {
        Some(rest) => format!("µ{rest}"),
        None => unit,
    };
    format!("{number} {unit}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn quantities_are_read_as_people_write_them() {
        for (text, pascals) in [
            ("1 MPa", 1e6),
            ("1MPa", 1e6),
            ("  0.5   GPa ", 5e8),
            ("1e6 Pa", 1e6),
            ("2 N/mm2", 2e6),
            ("2 N/mm^2", 2e6),
            ("1 megapascal", 1e6),
        ] {
            assert_relative_eq!(modulus(text).unwrap(), pascals, max_relative = 1e-15);
        }
        for text in [
            "1000 kg/m3",
            "1000 kg/m^3",
            "1000kg/m³",
            "1 g/cm3",
            "1 g / cm3",
            "1 t/m3",
        ] {
            assert_relative_eq!(density(text).unwrap(), 1e3, max_relative = 1e-15);
        }
        for text in ["20 mm", "2 cm", "0.02 m", "2e-2m", "20000 um", "20000 μm"] {
            assert_relative_eq!(length(text).unwrap(), 0.02, max_relative = 1e-15);
        }
        assert_relative_eq!(mass("21.9 g").unwrap(), 0.0219, max_relative = 1e-15);
    }

    #[test]
    fn units_that_nobody_means_are_refused() {
        for text in [
            "1 M", "1 nmi", "1 MM", "1 Cm", "1 Mm", "1 ly", "1 pc", "1 a.u.", "1 IN",
        ] {
            let message = length(text).unwrap_err();
            assert!(message.contains("m, cm, mm, um or in"), "{text}: {message}");
        }
        for text in ["1 G", "1 KG", "1 T", "1 Mg", "1 u", "1 gr", "1 oz"] {
            assert!(mass(text).is_err(), "{text}");
        }
        for text in ["1 PA", "1 mPa", "1 Gpa", "1 atm", "1 bar", "1 PSI"] {
            assert!(modulus(text).is_err(), "{text}");
        }
        for text in ["1 Kg/m3", "1 g/m3", "1 G/cm3", "1 kg/M3"] {
            assert!(density(text).is_err(), "{text}");
        }
        assert_relative_eq!(length("1 in").unwrap(), 0.0254);
        assert_relative_eq!(modulus("1 psi").unwrap(), 6894.757, max_relative = 1e-6);
    }

    #[test]
    fn what_is_no_positive_quantity_of_the_right_kind_is_refused() {
        for text in [
            "", "1", "MPa", "1 cm", "-1 MPa", "0 MPa", "NaN Pa", "inf Pa", "1 mpa", "1 M Pa s", "é",
        ] {
            let message = modulus(text).unwrap_err();
            assert!(message.contains("MPa"), "{text}: {message}");
        }
        assert!(length("1 kg").is_err());
        assert!(density("1000").is_err());
        assert!(mass("1 mm").is_err());
    }
}
