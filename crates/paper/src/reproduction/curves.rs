//! Curves of theory over the whole range of the figures.

use crate::code::{Code, SettledCode};
use crate::model::{CRITICAL_FRICTION, ContactConvention, PAPER_BODIES, Power, Problem, Stack};
use crate::study::yield_force::PAPER_STIFFNESSES;
use crate::theory::{Predictions, quasistatic_limit};

/// Frictions of the curves: lowest, highest, and their number.
const FRICTIONS: (f64, f64, usize) = (0.09, 0.54, 91);
/// Exponents of the stiffnesses 1/ε of the curves over the stiffness: from 10¹ to 10⁶.
const DECADES: (f64, f64) = (1.0, 6.0);
/// Number of stiffnesses of these curves.
const STIFFNESSES: usize = 41;

/// Every theory for one stack.
#[derive(Debug, Clone, PartialEq)]
pub struct TheoryPoint {
    /// Floor friction μ.
    pub mu: f64,
    /// Stiffness 1/ε.
    pub stiffness: f64,
    /// F of rigid cylinders; absent where it is infinite or the stack falls under its own weight.
    pub rigid: Option<f64>,
    /// F by the naive expansion.
    pub naive: Option<f64>,
    /// F by the singular perturbation.
    pub perturbation: Option<f64>,
    /// F by the elastic equation.
    pub elastic: Option<f64>,
    /// Exact quasi-static limit; absent where another event than floor slip comes first.
    pub exact: Option<f64>,
}

impl TheoryPoint {
    fn new(mu: f64, stiffness: f64) -> Self {
        let problem = Problem::new(Stack::paper(mu, stiffness), ContactConvention::PAPER);
        let predicted = Predictions::new(&problem.expect("the stacks of a figure are in range"));
        Self {
            mu,
            stiffness,
            rigid: predicted.rigid.yield_force,
            naive: predicted.naive.yield_force,
            perturbation: predicted.perturbation.yield_force,
            elastic: predicted.elastic.yield_force,
            exact: predicted.quasistatic.yield_force,
        }
    }

    /// Returns the distance of `theory` from the exact limit, relative to F + 3.
    pub fn error(&self, theory: Option<f64>) -> Option<f64> {
        let (theory, exact) = theory.zip(self.exact)?;
        Some((theory - exact) / (exact + 3.0))
    }
}

/// Difference of the limits under the convention of a code and under the paper's.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelFormPoint {
    /// The code whose convention differs.
    pub code: Code,
    /// Floor friction μ.
    pub mu: f64,
    /// Stiffness 1/ε.
    pub stiffness: f64,
    /// (F − F_paper)/(F_paper + 3).
    pub difference: f64,
}

/// All curves.
#[derive(Debug, Clone, PartialEq)]
pub struct Curves {
    /// Over the friction, at the stiffnesses of the paper.
    pub over_friction: Vec<TheoryPoint>,
    /// Over the stiffness, at the frictions of Fig. 2(b).
    pub over_stiffness: Vec<TheoryPoint>,
    /// Over the friction, at the stiffnesses of the paper, for every code with another convention.
    pub model_form: Vec<ModelFormPoint>,
    /// The codes whose limit is not the paper's, because of their arms or of springs that turn, grouped by these.
    pub codes_by_limit: Vec<Vec<SettledCode>>,
}

/// Returns the frictions of the curves, the critical one included.
fn frictions() -> Vec<f64> {
    let (lowest, highest, count) = FRICTIONS;
    let step = (highest - lowest) / (count - 1) as f64;
    let mut frictions: Vec<f64> = (0..count).map(|i| lowest + step * i as f64).collect();
    frictions.push(CRITICAL_FRICTION);
    frictions.sort_by(f64::total_cmp);
    frictions
}

/// Computes every curve.
pub fn curves(codes: &[SettledCode]) -> Curves {
    let codes_by_limit = codes_by_limit(codes);
    let over_friction = PAPER_STIFFNESSES.into_iter().flat_map(|stiffness| {
        let points = frictions().into_iter();
        points.map(move |mu| TheoryPoint::new(mu, stiffness))
    });
    let over_stiffness = super::SCALING_FRICTIONS.into_iter().flat_map(|mu| {
        (0..STIFFNESSES).map(move |index| {
            let part = index as f64 / (STIFFNESSES - 1) as f64;
            let exponent = DECADES.0 + (DECADES.1 - DECADES.0) * part;
            TheoryPoint::new(mu, libm::exp10(exponent))
        })
    });
    Curves {
        over_friction: over_friction.collect(),
        over_stiffness: over_stiffness.collect(),
        model_form: model_form(&codes_by_limit),
        codes_by_limit,
    }
}

/// Groups the codes whose limit is not the paper's, because of their arms or of springs that turn, by these.
fn codes_by_limit(codes: &[SettledCode]) -> Vec<Vec<SettledCode>> {
    let limit = |code: &SettledCode| {
        let convention = code.stack_convention(Power::Linear, PAPER_BODIES);
        (convention.arms, convention.history_update.turns())
    };
    let mut groups: Vec<Vec<SettledCode>> = Vec::new();
    for code in codes {
        let own = groups
            .iter_mut()
            .find(|group| limit(&group[0]) == limit(code));
        match own {
            Some(group) => group.push(code.clone()),
            None => groups.push(vec![code.clone()]),
        }
    }
    groups.retain(|group| limit(&group[0]) != limit(&SettledCode::native()));
    groups
}

/// Returns the differences for the first code of every group of [`codes_by_limit`].
fn model_form(groups: &[Vec<SettledCode>]) -> Vec<ModelFormPoint> {
    let mut points = Vec::new();
    for code in groups.iter().map(|group| &group[0]) {
        let convention = code.convention();
        for stiffness in PAPER_STIFFNESSES {
            for mu in frictions().into_iter().step_by(2) {
                let stack = Stack::paper(mu, stiffness);
                let force = |convention| {
                    let problem = Problem::new(stack, convention).ok()?;
                    quasistatic_limit(&problem).yield_force
                };
                let both = force(convention).zip(force(ContactConvention::PAPER));
                points.extend(both.map(|(own, paper)| ModelFormPoint {
                    code: code.name().clone(),
                    mu,
                    stiffness,
                    difference: (own - paper) / (paper + 3.0),
                }));
            }
        }
    }
    points
}
