//! What the contact law of a code does to the yield force, by theory.

use crate::code::Code;
use crate::model::{ContactConvention, Problem, Stack};
use crate::theory::quasistatic_limit;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

/// Range of floor frictions of a curve. With less friction a stack slides under its own weight under some law.
const FRICTIONS: (f64, f64) = (0.105, 0.5);
/// Number of intervals of a curve.
const INTERVALS: u32 = 60;

/// The exact forces over the floor friction under the convention of a code, at one stiffness.
#[derive(Debug, Clone, PartialEq)]
pub struct LawCurve {
    /// The first code that has this limit.
    pub code: Code,
    /// K_p r^p/(m g).
    pub stiffness: f64,
    /// Floor friction, slip onset and peak; the forces are absent where nothing yields.
    pub points: Vec<(f64, Option<f64>, Option<f64>)>,
}

/// Whether two conventions have the same limit under loading, where damping plays no part, and springs that are
/// rescaled on unloading are the same as those that are not.
fn has_limit_of(one: &ContactConvention, other: &ContactConvention) -> bool {
    let law = |convention: &ContactConvention| {
        let law = convention.law;
        let history = law.history.keeps_force();
        let floor = (law.floor_ratio, law.floor_kappa);
        (law.power, history, floor, law.tangential_stiffening)
    };
    let turns = |convention: &ContactConvention| convention.history_update.turns();
    one.arms == other.arms && turns(one) == turns(other) && law(one) == law(other)
}

/// For every different limit, the first of the codes in `all` that has it.
fn different_limits(all: &[(Code, ContactConvention)]) -> Vec<(Code, ContactConvention)> {
    let mut first: Vec<(Code, ContactConvention)> = Vec::new();
    for own in all {
        if !first.iter().any(|other| has_limit_of(&other.1, &own.1)) {
            first.push(own.clone());
        }
    }
    first
}

/// The curve of every different limit under the conventions of `codes`, at each of these stiffnesses and this
/// stiffness ratio κ.
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
                let limit = Problem::new(stack, convention).map(|own| quasistatic_limit(&own));
                let [onset, peak] =
                    limit.map_or([None; 2], |own| [own.slip_onset, own.yield_force]);
                (mu, onset, peak)
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
        let mut styles = SettledCode::with_power(Power::Hertz);
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

    #[test]
    fn a_spring_that_turns_has_a_limit_of_its_own() {
        let both = [ContactConvention::PAPER, ContactConvention::TURNING];
        let both = both.map(|convention| (Code::native(), convention));
        assert_eq!(different_limits(&both), both);
    }
}
