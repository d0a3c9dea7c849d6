//! The stack: friction, stiffness, stiffness ratio, or the material that they follow from.

use super::flag::as_flag;
use super::friction::{FRICTION, FRICTIONS, Friction, STIFFNESS, STIFFNESSES, Stiffness};
use super::numbers::number;
use super::values::{Values, single};
use crate::model::{InvalidValue, Material, PAPER_BODIES, PAPER_CYLINDER_FRICTION, Power, Stack};
use clap::Args;

/// Largest number of stacks in one command: a thousand frictions by a thousand stiffnesses.
const MOST_STACKS: usize = 1_000_000;

/// The parameters of a stack other than floor friction and stiffness.
#[derive(Debug, Clone, Args)]
pub(in crate::cli) struct StackOptions {
    /// Stiffness ratio k_n/k_t [default: 2.5; of laws that are not linear 17/14, that of Poisson's ratio 0.3]
    #[arg(long, value_name = "K", value_parser = number)]
    kappa: Option<f64>,
    /// Friction between cylinders
    #[arg(long, value_name = "D", value_parser = number, default_value_t = PAPER_CYLINDER_FRICTION)]
    pub mu_d: f64,
    /// Bodies on the floor: 2 cylinders, or 3 to 5 spheres in a ring with one on top
    #[arg(long, value_name = "N", default_value_t = PAPER_BODIES, value_parser = bodies)]
    pub bodies: u8,
}

/// Reads `--bodies`. The check of the stack says why there cannot be more.
fn bodies(text: &str) -> Result<u8, String> {
    let number = text.parse();
    number.map_err(|_| "accepted is a whole number from 2 to 5".to_owned())
}

impl StackOptions {
    /// Returns the stiffness ratio of pairs in a law of this power.
    pub fn kappa(&self, power: Power) -> f64 {
        self.kappa
            .unwrap_or_else(|| Stack::usual_stiffness_ratio(power))
    }

    /// Refuses other bodies than cylinders.
    pub fn refuse_spheres(&self) -> Result<(), InvalidValue> {
        let stack = Stack {
            bodies: self.bodies,
            ..Stack::paper(f64::NAN, f64::NAN)
        };
        stack.refuse_spheres().map_err(as_flag)
    }

    /// Returns the checked stack with floor friction `mu` and this stiffness, in a law of this power.
    pub fn stack(&self, mu: Friction, stiffness: f64, power: Power) -> Result<Stack, InvalidValue> {
        let mut stack = Stack {
            cylinder_friction: self.mu_d,
            stiffness_ratio: self.kappa(power),
            bodies: self.bodies,
            ..Stack::paper(f64::NAN, stiffness)
        };
        stack.floor_friction = mu.of(&stack);
        stack.validate().map_err(as_flag)?;
        Ok(stack)
    }
}

/// The material of Hertz contacts, from which stiffness and stiffness ratio follow.
#[derive(Debug, Clone, Args)]
pub(in crate::cli) struct MaterialOptions {
    /// Young's modulus in m g/r^2 of equal bodies in Hertz's theory, in place of --stiffness
    #[arg(
        long,
        value_name = "E",
        group = "hardness",
        requires = "poisson",
        conflicts_with = "stiffness",
        value_parser = number,
        allow_hyphen_values = true
    )]
    youngs: Option<f64>,
    /// Their Poisson's ratio, from 0 to 0.5, in place of --kappa
    #[arg(
        long,
        value_name = "NU",
        conflicts_with = "kappa",
        value_parser = number
    )]
    poisson: Option<f64>,
}

impl MaterialOptions {
    /// Returns the material; `None` without a Poisson's ratio. Without a modulus, its stiffness means nothing.
    fn material(&self) -> Option<Material> {
        Some(Material {
            youngs_modulus: self.youngs.unwrap_or(1.0),
            poisson_ratio: self.poisson?,
        })
    }

    /// Returns the stiffness that the modulus gives; `None` without a modulus.
    fn stiffness(&self) -> Option<f64> {
        self.youngs
            .and(self.material())
            .map(|own| own.pair_stiffness())
    }

    /// Returns `others` with the stiffness ratio of the material, if there is one, in a law of this power.
    fn over(&self, others: &StackOptions, power: Power) -> Result<StackOptions, InvalidValue> {
        let Some(material) = self.material() else {
            return Ok(others.clone());
        };
        let (modulus, poisson_ratio) = (material.youngs_modulus, material.poisson_ratio);
        let refused = |flag, value, accepted| Err(InvalidValue::new(flag, value, accepted));
        if power != Power::Hertz {
            let accepted = "left out, unless --law is hertz";
            return refused("--poisson", poisson_ratio, accepted);
        }
        if !(0.0..=0.5).contains(&poisson_ratio) {
            return refused("--poisson", poisson_ratio, "a number from 0 to 0.5");
        }
        if !(modulus > 0.0 && modulus.is_finite()) {
            return refused("--youngs", modulus, "a number above 0");
        }
        Ok(StackOptions {
            kappa: Some(material.stiffness_ratio()),
            ..others.clone()
        })
    }
}

/// The parameters of one stack.
#[derive(Debug, Clone, Args)]
pub(in crate::cli) struct OneStackOptions {
    #[arg(long, help = FRICTION, value_parser = single::<Friction>, requires = "hardness", allow_hyphen_values = true)]
    mu: Option<Friction>,
    #[arg(
        long,
        help = STIFFNESS,
        value_name = "S",
        value_parser = single::<Stiffness>,
        group = "hardness",
        requires = "mu",
        allow_hyphen_values = true
    )]
    stiffness: Option<Stiffness>,
    #[command(flatten)]
    others: StackOptions,
    #[command(flatten)]
    material: MaterialOptions,
}

impl OneStackOptions {
    /// Returns the number of bodies on the floor.
    pub fn bodies(&self) -> u8 {
        self.others.bodies
    }

    /// Returns the checked stack, in a law of this power.
    pub fn stack(&self, power: Power) -> Result<Stack, InvalidValue> {
        let others = self.material.over(&self.others, power)?;
        let own = self.stiffness.map(|stiffness| stiffness.0);
        let stiffness = own.or_else(|| self.material.stiffness());
        let mu = self.mu.unwrap_or(Friction::Number(f64::NAN));
        others.stack(mu, stiffness.unwrap_or(f64::NAN), power)
    }
}

/// The parameters of several stacks.
#[derive(Debug, Clone, Args)]
pub(in crate::cli) struct StackListOptions {
    #[arg(id = "mu", long = "mu", help = FRICTIONS, value_name = "MU", value_parser = Values::<Friction>::parse, allow_hyphen_values = true)]
    frictions: Values<Friction>,
    #[arg(
        id = "stiffness",
        long = "stiffness",
        help = STIFFNESSES,
        required_unless_present = "youngs",
        value_name = "S",
        value_parser = Values::<Stiffness>::parse,
        allow_hyphen_values = true
    )]
    stiffnesses: Option<Values<Stiffness>>,
    #[command(flatten)]
    others: StackOptions,
    #[command(flatten)]
    material: MaterialOptions,
}

impl StackListOptions {
    /// Returns the number of bodies on the floor.
    pub fn bodies(&self) -> u8 {
        self.others.bodies
    }

    /// Returns the checked stacks of every combination of friction and stiffness, in a law of this power; the
    /// friction varies fastest.
    pub fn stacks(&self, power: Power) -> Result<Vec<Stack>, InvalidValue> {
        let others = self.material.over(&self.others, power)?;
        let material = self.material.stiffness().map(Stiffness);
        let own = self.stiffnesses.iter().flat_map(|values| &values.0);
        let stiffnesses: Vec<Stiffness> = own.copied().chain(material).collect();
        let frictions = &self.frictions.0;
        let count = frictions.len().saturating_mul(stiffnesses.len());
        if count > MOST_STACKS {
            return Err(InvalidValue {
                key: "--mu, --stiffness".to_owned(),
                value: format!("{count} combinations"),
                accepted: format!("at most {MOST_STACKS} combinations"),
            });
        }
        let stacks = stiffnesses.iter().flat_map(|&stiffness| {
            let frictions = frictions.iter();
            let others = &others;
            frictions.map(move |&mu| others.stack(mu, stiffness.0, power))
        });
        stacks.collect()
    }
}
