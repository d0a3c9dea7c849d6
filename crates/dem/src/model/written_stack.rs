//! A stack as case files spell it.

use super::{Arrangement, Power};
use super::{BODIES_RANGE, PAPER_BODIES, PAPER_CYLINDER_FRICTION, Stack};
use schemars::{JsonSchema, Schema};
use serde::Deserialize;
use serde_json::json;

/// Default stiffness 1/ε of case files: soft enough for a run of seconds.
const USUAL_STIFFNESS: f64 = 100.0;

/// Three equal cylinders under gravity on a rough floor.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = with_short_names)]
pub struct WrittenStack {
    /// Friction coefficient μ between cylinder and floor; `mu` means the same.
    #[serde(alias = "mu")]
    pub floor_friction: f64,
    /// Friction coefficient μ_d between two cylinders; `mu_d` means the same.
    #[serde(default = "paper_cylinder_friction", alias = "mu_d")]
    pub cylinder_friction: f64,
    /// Stiffness 1/ε = k_n r/(m g); with a law of power p it is K rᵖ/(m g), the force of a pair being K δᵖ.
    #[serde(default = "usual_stiffness")]
    pub stiffness: f64,
    /// Stiffness ratio κ = k_n/k_t; `kappa` means the same. Left out, it is 2.5, and in laws that are not linear 17/14,
    /// that of Poisson's ratio 0.3.
    #[serde(alias = "kappa")]
    pub stiffness_ratio: Option<f64>,
    /// Number n of bodies on the floor: 2, the paper's cylinders, or 3 to 5 spheres in a ring, with one on top.
    #[serde(default = "paper_bodies")]
    #[schemars(range(min = BODIES_RANGE.0, max = BODIES_RANGE.1))]
    pub bodies: u8,
    /// How spheres lie and are numbered.
    #[serde(default)]
    pub arrangement: Arrangement,
}

/// Adds the alternative names of the keys, which JSON Schema cannot express as aliases.
fn with_short_names(schema: &mut Schema) {
    let names = [
        ("floor_friction", "mu"),
        ("cylinder_friction", "mu_d"),
        ("stiffness_ratio", "kappa"),
    ];
    if let Some(properties) = schema
        .get_mut("properties")
        .and_then(|keys| keys.as_object_mut())
    {
        for (name, short) in names {
            properties.insert(short.to_owned(), properties[name].clone());
        }
    }
    schema.remove("required");
    let required = |name: &str| json!({ "required": [name] });
    schema.insert(
        "oneOf".to_owned(),
        json!([required("floor_friction"), required("mu")]),
    );
}

fn usual_stiffness() -> f64 {
    USUAL_STIFFNESS
}

fn paper_bodies() -> u8 {
    PAPER_BODIES
}

fn paper_cylinder_friction() -> f64 {
    PAPER_CYLINDER_FRICTION
}

impl WrittenStack {
    /// Returns the stack, with the default stiffness ratio of a law of this power where none is given.
    pub fn in_law(&self, power: Power) -> Stack {
        let usual = Stack::usual_stiffness_ratio(power);
        Stack {
            floor_friction: self.floor_friction,
            cylinder_friction: self.cylinder_friction,
            stiffness: self.stiffness,
            stiffness_ratio: self.stiffness_ratio.unwrap_or(usual),
            bodies: self.bodies,
            arrangement: self.arrangement,
        }
    }
}

impl From<Stack> for WrittenStack {
    fn from(stack: Stack) -> Self {
        Self {
            floor_friction: stack.floor_friction,
            cylinder_friction: stack.cylinder_friction,
            stiffness: stack.stiffness,
            stiffness_ratio: Some(stack.stiffness_ratio),
            bodies: stack.bodies,
            arrangement: stack.arrangement,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Material;

    #[test]
    fn the_stiffness_ratio_that_is_left_out_depends_on_the_law() {
        let read = |text: &str| toml::from_str::<WrittenStack>(text).unwrap();
        for power in Power::ALL {
            let usual = match power {
                Power::Linear => 2.5,
                _ => Material::USUAL_STIFFNESS_RATIO,
            };
            let ratio = |text: &str| read(text).in_law(power).stiffness_ratio;
            assert_eq!(ratio("mu = 0.3"), usual);
            assert_eq!(ratio("mu = 0.3\nkappa = 2.5"), 2.5);
            assert_eq!(ratio("mu = 0.3\nstiffness_ratio = 1.3"), 1.3);
        }
    }
}
