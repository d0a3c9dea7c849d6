//! The stacks of a crosscheck on the command line.

use super::options::{Friction, StackOptions, as_flag, friction};
use crate::code::Code;
use crate::model::{InvalidValue, Power, Stack};
use crate::study::yield_force::{Measurement, Profile};
use clap::Args;

/// The stacks of a profile, or others in its way.
#[derive(Debug, Clone, Args)]
pub(super) struct StackSet {
    /// Set of stacks
    #[arg(long, value_enum, default_value_t = Profile::Quick)]
    profile: Profile,
    /// Floor frictions of other stacks than those of the profile: numbers or the word `critical`, separated by commas
    #[arg(long, requires = "stiffness", value_delimiter = ',', value_parser = friction, allow_negative_numbers = true)]
    mu: Vec<Friction>,
    /// Stiffnesses k_n r/(m g) of these stacks, separated by commas
    #[arg(
        long,
        requires = "mu",
        value_name = "S1,S2",
        value_delimiter = ',',
        allow_negative_numbers = true
    )]
    stiffness: Vec<f64>,
    #[command(flatten)]
    pub others: StackOptions,
}

impl StackSet {
    /// The codes that measure them by a law of this power: of other laws than the paper's, the quick profile has one of
    /// each folder.
    pub fn codes(&self, power: Power) -> Vec<Code> {
        let mut codes = Code::of_power(power);
        if power != Power::Linear && self.profile == Profile::Quick {
            codes.retain(|code| code.is_first_variant());
        }
        codes
    }

    /// The measurements of the stacks by each of the codes `names`, by a law of this power.
    pub fn measurements(
        &self,
        names: &[Code],
        power: Power,
    ) -> Result<Vec<Measurement>, InvalidValue> {
        let stacks = self.stacks(power)?;
        let pairs = stacks
            .iter()
            .flat_map(|stack| names.iter().map(move |name| (stack, name)));
        pairs
            .into_iter()
            .try_for_each(|(stack, name)| name.check_stiffness_ratio(stack.stiffness_ratio))
            .map_err(as_flag)?;
        Ok(self.profile.measurements_of(&stacks, names, power))
    }

    /// The stacks of the profile, or those asked for.
    fn stacks(&self, power: Power) -> Result<Vec<Stack>, InvalidValue> {
        let own = self.stiffness.iter().flat_map(|&stiffness| {
            let frictions = self.mu.iter();
            frictions.map(move |&mu| (mu, stiffness))
        });
        let profile = self.profile.stacks(power, self.others.bodies).into_iter();
        let profile =
            profile.map(|stack| (Friction::Number(stack.floor_friction), stack.stiffness));
        let places: Vec<(Friction, f64)> = match self.mu.is_empty() {
            true => profile.collect(),
            false => own.collect(),
        };
        let stack = |(mu, stiffness)| self.others.stack(mu, stiffness, power);
        places.into_iter().map(stack).collect()
    }
}
