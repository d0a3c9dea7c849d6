//! What the contact law of a code does to the yield force, by theory.

use crate::code::Code;
use crate::model::{ContactConvention, Stack};
use crate::theory::quasistatic_limit;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

/// Range of the floor frictions of a curve: less slides under its own weight in some law.
const FRICTIONS: (f64, f64) = (0.105, 0.5);
/// Number of intervals of a curve.
const INTERVALS: u32 = 60;

/// The exact forces over the floor friction under the convention of a code, at one stiffness.
#[derive(Debug, Clone, PartialEq)]
pub struct LawCurve {
    /// The code, the first of those that have this limit.
    pub code: Code,
    /// K_p r^p/(m g).
    pub stiffness: f64,
    /// Floor friction, slip onset and peak; the forces are absent where nothing yields.
    pub points: Vec<(f64, Option<f64>, Option<f64>)>,
}

/// Whether two conventions have the same limit on a path of loading: damping does not enter it, and springs that are
/// rescaled on unloading are those that are not.
fn has_limit_of(one: &ContactConvention, other: &ContactConvention) -> bool {
    let law = |convention: &ContactConvention| {
        let law = convention.law;
        let history = law.history.keeps_force();
        let floor = (law.floor_ratio, law.floor_kappa);
        (law.power, history, floor, law.tangential_stiffening)
    };
    one.arms == other.arms && law(one) == law(other)
}

/// The codes of `all` whose limits differ, the first of each kind.
fn different_limits(all: &[(Code, ContactConvention)]) -> Vec<(Code, ContactConvention)> {
    let mut first: Vec<(Code, ContactConvention)> = Vec::new();
    for own in all {
        if !first.iter().any(|other| has_limit_of(&other.1, &own.1)) {
            first.push(own.clone());
        }
    }
    first
}

/// The curves of every limit under the conventions of the `codes` at these stiffnesses, κ being the stiffness ratio.
pub fn law_curves(
    codes: &[(Code, ContactConvention)],
    stiffnesses: &[f64],
    stiffness_ratio: f64,
) -> Vec<LawCurve> {
    let curves = different_limits(codes).into_iter().flat_map(|own| {
        let stiffnesses = stiffnesses.iter();
        stiffnesses.map(move |&stiffness| (own.clone(), stiffness))
    });
    let curves: Vec<_> = curves.collect();
    let (least, most) = FRICTIONS;
    let frictions = (0..=INTERVALS).map(|index| {
        let part = f64::from(index) / f64::from(INTERVALS);
        least + part * (most - least)
    });
    let frictions: Vec<f64> = frictions.collect();
    let curves = curves
        .into_par_iter()
        .map(|((code, convention), stiffness)| {
            let points = frictions.iter().map(|&mu| {
                let stack = Stack {
                    stiffness_ratio,
                    ..Stack::paper(mu, stiffness)
                };
                let limit = quasistatic_limit(&stack, &convention);
                (mu, limit.slip_onset, limit.yield_force)
            });
            LawCurve {
                code,
                stiffness,
                points: points.collect(),
            }
        });
    curves.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::code::SettledCode;
    use crate::model::Power;

    #[test]
    fn seven_limits_stand_behind_the_styles_of_hertz() {
        let mut styles = SettledCode::of_power(Power::Hertz);
        styles.retain(|code| !code.name().accepts_any_convention());
        let styles: Vec<_> = styles
            .into_iter()
            .map(|code| (code.name().clone(), code.convention()))
            .collect();
        let different = different_limits(&styles);
        let names: Vec<&str> = different.iter().map(|(code, _)| code.as_str()).collect();
        let expected = [
            "liggghts-hertz",
            "yade-mindlin",
            "yade-mindlin-facet",
            "yade-mindlin-wall",
            "lammps-hertz",
            "lammps-mindlin",
            "lammps-mindlin-force",
        ];
        assert_eq!(names, expected);
    }
}
