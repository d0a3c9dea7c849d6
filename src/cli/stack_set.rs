//! The stacks of a crosscheck on the command line.

use super::options::{
    Draw, FRICTIONS, Friction, ResolutionOptions, STIFFNESSES, StackOptions, Stiffness, Values,
    as_flag,
};
use crate::code::{Code, SettledCode};
use crate::model::{InvalidValue, Power, Stack};
use crate::output::friction;
use crate::study::yield_force::{Measurement, Profile};
use clap::{Args, ValueEnum};

const OWN_FRICTIONS: &str = "; with --stiffness and without --profile they make stacks of their own, otherwise they \
    choose rows of the profile";
const OWN_STIFFNESSES: &str = "; with --mu and without --profile they make stacks of their own, otherwise they choose rows of the profile";

/// Largest relative difference between a friction and that of the row that it names. Frictions of a profile differ by
/// more than a hundredth, and people write the critical one with few digits.
const FEW_DIGITS: f64 = 1e-5;

/// What `--profile` chooses.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Chosen {
    /// Six frictions around the critical one at three stiffnesses.
    Quick,
    /// The paper's figure 2(a): 25 frictions at its three stiffnesses.
    Standard,
    /// The same as the paper made it, by the peak at wall speed 1e-6 and time step 1e-3; external codes at
    /// mu = 0.2, stiffness 1e4 alone.
    Paper,
    /// The same by every code: days of one core for an external one (docs/cluster.md).
    Literal,
    /// The authors' published numbers, reproduced by native runs of their program: of `crosscheck` alone, with
    /// --published.
    Published,
}

/// The stacks of a profile or some of them, or others in its way.
#[derive(Debug, Clone, Args)]
pub(super) struct StackSet {
    /// Set of stacks [default: quick]
    #[arg(long, value_enum)]
    profile: Option<Chosen>,
    #[arg(long, help = FRICTIONS.to_owned() + OWN_FRICTIONS, value_parser = Values::<Friction>::parse, allow_hyphen_values = true)]
    mu: Option<Values<Friction>>,
    #[arg(
        long,
        help = STIFFNESSES.to_owned() + OWN_STIFFNESSES,
        value_name = "S",
        value_parser = Values::<Stiffness>::parse,
        allow_hyphen_values = true
    )]
    stiffness: Option<Values<Stiffness>>,
    #[command(flatten)]
    pub others: StackOptions,
}

impl StackSet {
    /// Returns the profile by whose method stacks are measured.
    ///
    /// # Errors
    /// If the published numbers are asked for, which are not measured.
    pub fn profile(&self) -> Result<Profile, InvalidValue> {
        match self.profile {
            None | Some(Chosen::Quick) => Ok(Profile::Quick),
            Some(Chosen::Standard) => Ok(Profile::Standard),
            Some(Chosen::Paper) => Ok(Profile::Paper),
            Some(Chosen::Literal) => Ok(Profile::Literal),
            Some(Chosen::Published) => Err(InvalidValue {
                key: "--profile".to_owned(),
                value: "published".to_owned(),
                accepted: "quick, standard, paper or literal; `tristack crosscheck --profile published --published DIR` \
                           reproduces the published numbers"
                    .to_owned(),
            }),
        }
    }

    /// Returns whether the published numbers are asked for.
    pub fn is_published(&self) -> bool {
        self.profile == Some(Chosen::Published)
    }

    /// Returns the codes that measure the stacks by a law of this power. For other laws than the paper's, the quick
    /// profile has one code of each folder.
    pub fn codes(&self, power: Power) -> Result<Vec<Code>, InvalidValue> {
        let mut codes = Code::with_power(power);
        if power != Power::Linear && self.profile()? == Profile::Quick {
            codes.retain(|code| code.is_first_variant());
        }
        Ok(codes)
    }

    /// Returns the measurements of the stacks by each of `codes`, by a law of this power.
    pub fn measurements(
        &self,
        codes: &[SettledCode],
        power: Power,
    ) -> Result<Vec<Measurement>, InvalidValue> {
        let are_rigid = codes.iter().all(|code| code.name().is_rigid());
        match self.own_stacks(power, are_rigid)? {
            Some(own) => self.measurements_of(&own, codes, power),
            None => {
                let stacks = self.profile()?.stacks(power, self.others.bodies);
                let stacks = self.with_others(&stacks, power)?;
                self.chosen(self.measurements_of(&stacks, codes, power)?)
            }
        }
    }

    /// Returns the measurements of stacks that are drawn, by each of `codes`, by a law of this power.
    pub fn drawn(
        &self,
        draw: Draw,
        codes: &[SettledCode],
        power: Power,
    ) -> Result<Vec<Measurement>, InvalidValue> {
        let Draw { count, seed, .. } = draw;
        let bodies = self.others.bodies;
        let stacks = self.profile()?.drawn((count, seed), power, bodies);
        self.measurements_of(&self.with_others(&stacks, power)?, codes, power)
    }

    fn measurements_of(
        &self,
        stacks: &[Stack],
        codes: &[SettledCode],
        power: Power,
    ) -> Result<Vec<Measurement>, InvalidValue> {
        let pairs = stacks
            .iter()
            .flat_map(|stack| codes.iter().map(move |code| (stack, code)));
        pairs
            .into_iter()
            .try_for_each(|(stack, code)| code.name().check_stiffness_ratio(stack.stiffness_ratio))
            .map_err(as_flag)?;
        Ok(self.profile()?.measurements_of(stacks, codes, power))
    }

    /// Returns the stacks that are asked for in place of those of a profile. Those of codes that `are_rigid` need no stiffness.
    fn own_stacks(
        &self,
        power: Power,
        are_rigid: bool,
    ) -> Result<Option<Vec<Stack>>, InvalidValue> {
        let any = Values(vec![Stiffness(1.0)]);
        let stiffnesses = self.stiffness.as_ref().or(are_rigid.then_some(&any));
        let (None, Some(frictions), Some(stiffnesses)) = (self.profile, &self.mu, stiffnesses)
        else {
            return Ok(None);
        };
        let places = stiffnesses.0.iter().flat_map(|stiffness| {
            let frictions = frictions.0.iter();
            frictions.map(|&mu| (mu, stiffness.0))
        });
        let stacks = places.map(|(mu, stiffness)| self.others.stack(mu, stiffness, power));
        stacks.collect::<Result<_, _>>().map(Some)
    }

    /// Returns `stacks` with the other parameters that are asked for.
    fn with_others(&self, stacks: &[Stack], power: Power) -> Result<Vec<Stack>, InvalidValue> {
        let with_others = |stack: &Stack| {
            let mu = Friction::Number(stack.floor_friction);
            self.others.stack(mu, stack.stiffness, power)
        };
        stacks.iter().map(with_others).collect()
    }

    /// Returns those `rows` of the profile that --mu and --stiffness choose. Each value must choose at least one.
    fn chosen(&self, mut rows: Vec<Measurement>) -> Result<Vec<Measurement>, InvalidValue> {
        if let Some(Values(asked)) = &self.stiffness {
            let is = |row: &Measurement, stiffness: &Stiffness| {
                row.stack.stiffness == stiffness.0 || row.code.name().is_rigid()
            };
            let shown = |stiffness: &Stiffness| stiffness.0.to_string();
            let of_row = |row: &Measurement| row.stack.stiffness.to_string();
            rows = filtered(rows, "--stiffness", asked, is, shown, of_row)?;
        }
        if let Some(Values(asked)) = &self.mu {
            let is = |row: &Measurement, mu: &Friction| {
                let (own, asked) = (row.stack.floor_friction, mu.of(&row.stack));
                (own - asked).abs() <= FEW_DIGITS * own
            };
            let shown = |mu: &Friction| match mu {
                Friction::Number(number) => number.to_string(),
                Friction::Critical => "critical".to_owned(),
            };
            let of_row = |row: &Measurement| friction(row.stack.floor_friction);
            rows = filtered(rows, "--mu", asked, is, shown, of_row)?;
        }
        Ok(rows)
    }
}

/// Returns the `rows` that a value of `flag` chooses. If a value chooses none, the error lists those that would
/// choose some.
fn filtered<Q>(
    mut rows: Vec<Measurement>,
    flag: &str,
    asked: &[Q],
    is: impl Fn(&Measurement, &Q) -> bool,
    shown: impl Fn(&Q) -> String,
    of_row: impl Fn(&Measurement) -> String,
) -> Result<Vec<Measurement>, InvalidValue> {
    if let Some(none) = asked
        .iter()
        .find(|value| !rows.iter().any(|row| is(row, value)))
    {
        let mut values: Vec<String> = Vec::new();
        for value in rows.iter().map(of_row) {
            if !values.contains(&value) {
                values.push(value);
            }
        }
        return Err(InvalidValue {
            key: flag.to_owned(),
            value: shown(none),
            accepted: format!(
                "one of those that the profile has here: {}; for other stacks give both --mu and --stiffness, and no --profile",
                values.join(", ")
            ),
        });
    }
    rows.retain(|row| asked.iter().any(|value| is(row, value)));
    Ok(rows)
}
/// Returns the measurement with the shortcuts and the resolution that are asked for.
pub(super) fn with_options(
    measurement: Measurement,
    shortcuts: bool,
    resolution: &ResolutionOptions,
) -> Measurement {
    resolution.accepted(match shortcuts {
        true => measurement.shortened(),
        false => measurement,
    })
}
