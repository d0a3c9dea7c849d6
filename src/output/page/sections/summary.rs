//! The summary, for a referee with one minute. Every number in it is computed.

use super::super::document::{Block, Section};
use super::tolerances::Agreement;
use crate::code::Code;
use crate::model::{CRITICAL_FRICTION, ContactConvention, Power, Stack};
use crate::output::DataTable;
use crate::output::number::{digits, percent};
use crate::output::table::Columns;
use crate::paper::claims::{ClaimJudgement, ClaimVerdict};
use crate::paper::reproduction::{Reproduction, TheoryPoint};
use crate::study::Verdict;
use crate::study::yield_force::{Judgement, PAPER_STIFFNESSES, PAPER_WALL_SPEED};
use crate::theory::Predictions;

pub(super) fn section(reproduction: &Reproduction, claims: &[ClaimJudgement]) -> Section {
    let items = [
        Some(of_claims(claims)),
        Some(of_codes(reproduction)),
        of_scaling(reproduction),
        of_laws(reproduction),
        of_convergence(reproduction),
    ];
    let blocks = vec![
        Block::List {
            items: items.into_iter().flatten().collect(),
        },
        Block::table(
            "theories",
            "The paper’s theories against the exact quasi-static limit of its own DEM: largest error relative to \
             F + 3 over the frictions of Fig. 2(a). Above μ_c they are no limit of the DEM.",
            &theories(&reproduction.curves.over_friction),
        ),
        Block::table(
            "points",
            "Yield force F = f/(m g) at some points of Fig. 2(a). A code with another limit has other torque arms \
             than the paper’s model; that is no error.",
            &points(&reproduction.yield_curves),
        ),
    ];
    Section::new("summary", "Summary", blocks)
}

fn of_claims(claims: &[ClaimJudgement]) -> String {
    let count = |verdict| claims.iter().filter(|own| own.verdict == verdict).count();
    let errata = claims.iter().filter(|own| own.erratum.is_some()).count();
    format!(
        "Of {} checkable statements {} hold, {} hold approximately, {} do not hold as stated ({errata} of \
         the displayed forms and numbers have an erratum), {} cannot be tested here.",
        claims.len(),
        count(ClaimVerdict::Holds),
        count(ClaimVerdict::Approximately),
        count(ClaimVerdict::Fails),
        count(ClaimVerdict::Untestable)
    )
}

fn of_codes(reproduction: &Reproduction) -> String {
    let agreements = Agreement::of(&reproduction.yield_curves);
    let (agreeing, rows) = agreements.iter().fold((0, 0), |(agreeing, rows), own| {
        (agreeing + own.agreeing, rows + own.rows)
    });
    let largest = agreements.iter().map(|own| own.largest_error);
    format!(
        "{} codes reproduce the yield curve of Fig. 2(a): {agreeing} of {rows} yield forces agree with the \
         exact quasi-static limit under the convention of the code; the largest error is {:.0e} of F + 3.",
        agreements.len(),
        largest.fold(0.0, f64::max)
    )
}

fn of_scaling(reproduction: &Reproduction) -> Option<String> {
    let of = |mu: f64| {
        let mut all = reproduction.exponents.iter();
        all.find(|exponent| exponent.code == Code::NATIVE && exponent.mu == mu)
    };
    let (at, above) = (of(CRITICAL_FRICTION)?, of(0.3)?);
    let agreeing = reproduction.exponents.iter();
    let agreeing = agreeing.filter(|exponent| exponent.verdict == Verdict::Agrees);
    Some(format!(
        "Scaling: F + 3 grows with the stiffness to the power {:.4} at μ_c and {:.4} at μ = 0.3 \
         between 10³ and 10⁶ (1/2 and 1 for ε → 0); {} of {} exponents fitted to runs are those of the exact \
         limit within their uncertainty.",
        at.exponent,
        above.exponent,
        agreeing.count(),
        reproduction.exponents.len()
    ))
}

/// The spread of the conventions at the stack where it is largest, and the exponent.
fn of_laws(reproduction: &Reproduction) -> Option<String> {
    let laws = &reproduction.laws;
    let judged = |row: &&Judgement| (row.mu(), row.stiffness()) == SPREAD;
    let onset = |row: &Judgement| Some((row.study.limit.slip_onset?, row.code));
    let onsets = laws.yield_curves.iter().filter(judged).filter_map(onset);
    let lowest = onsets
        .clone()
        .min_by(|left, right| left.0.total_cmp(&right.0))?;
    let highest = onsets.max_by(|left, right| left.0.total_cmp(&right.0))?;
    let agreements = Agreement::of(&laws.yield_curves);
    let (agreeing, rows) = agreements.iter().fold((0, 0), |(agreeing, rows), own| {
        (agreeing + own.agreeing, rows + own.rows)
    });
    let fitted = laws.exponents.iter();
    let fitted = fitted.map(|own| format!("{:.4} ({})", own.exponent, own.code));
    let fitted: Vec<String> = fitted.collect();
    Some(format!(
        "Hertz contacts: {agreeing} of {rows} rows of {} styles agree with their exact limits, which differ by \
         convention alone: at μ = {}, stiffness {} the floor begins to slip at F = {} ({}) to {} ({}). At μ_c the exponent \
         of F + 3 between 10³ and 10⁶ is {}, and 2/5 for ε → 0, where linear springs have 1/2.",
        agreements.len(),
        SPREAD.0,
        SPREAD.1,
        digits::<4>(lowest.0),
        lowest.1,
        digits::<4>(highest.0),
        highest.1,
        fitted.join(", ")
    ))
}

/// Friction and stiffness at which the summary compares the conventions with each other.
const SPREAD: (f64, f64) = (0.3, 1e4);

fn of_convergence(reproduction: &Reproduction) -> Option<String> {
    let mut points = reproduction.convergence.wall_speeds.iter();
    let paper =
        points.find(|point| point.code == Code::NATIVE && point.wall_speed == PAPER_WALL_SPEED)?;
    Some(format!(
        "At the paper’s own settings (wall speed 10⁻⁶, time step 10⁻³) and the point of its convergence \
         figure (μ = 0.2, stiffness 10⁴) the peak deviates by {:+.2} % from the limit, the onset of slip \
         by {:+.0e}.",
        100.0 * paper.excess_of_peak()?,
        paper.excess_of_slip()?
    ))
}

/// Largest errors of the paper's theories over the frictions of its figure, stiffness by stiffness.
pub(crate) fn theories(curve: &[TheoryPoint]) -> DataTable<'_> {
    let largest = |stiffness: f64, above: bool, theory: fn(&TheoryPoint) -> Option<f64>| {
        let own = curve.iter().filter(move |point| {
            point.stiffness == stiffness && (point.mu >= CRITICAL_FRICTION) == above
        });
        let errors = own.filter_map(|point| point.error(theory(point)));
        errors.max_by(|left, right| left.abs().total_cmp(&right.abs()))
    };
    Columns::<f64>::new(
        "theories",
        "A row is the largest errors of the paper's theories at one stiffness, relative to \
         F + 3, over the frictions of Fig. 2(a).",
        "`tristack report` (tables/theories.csv)",
    )
    .number("stiffness", "m g/r", |stiffness| *stiffness)
    .means("normal stiffness k_n, 1/ε")
    .shown("stiffness")
    .number("perturbation_below", "1", move |&stiffness| {
        largest(stiffness, false, |point| point.perturbation)
    })
    .means("singular perturbation, μ < μ_c")
    .shown_as("perturbation, μ < μ_c", percent)
    .number("perturbation_above", "1", move |&stiffness| {
        largest(stiffness, true, |point| point.perturbation)
    })
    .means("the same, μ ≥ μ_c")
    .shown_as("perturbation, μ ≥ μ_c", percent)
    .number("elastic_below", "1", move |&stiffness| {
        largest(stiffness, false, |point| point.elastic)
    })
    .means("elastic equation, μ < μ_c")
    .shown_as("elastic equation, μ < μ_c", percent)
    .number("elastic_above", "1", move |&stiffness| {
        largest(stiffness, true, |point| point.elastic)
    })
    .means("the same, μ ≥ μ_c")
    .shown_as("elastic equation, μ ≥ μ_c", percent)
    .rows(PAPER_STIFFNESSES)
}

/// Some points of Fig. 2(a), theory and codes side by side.
pub(crate) fn points(judgements: &[Judgement]) -> DataTable<'_> {
    let stacks = PAPER_STIFFNESSES.into_iter().flat_map(|stiffness| {
        let frictions = [0.2, CRITICAL_FRICTION, 0.3, 0.4].into_iter();
        frictions.map(move |mu| Stack::paper(mu, stiffness))
    });
    let rows = stacks.map(|stack| Predictions::new(&stack, &ContactConvention::PAPER));
    let mut columns = Columns::<Predictions>::new(
        "points",
        "A row is the yield force F of one stack of Fig. 2(a), by theory and by every code.",
        "`tristack report` (tables/points.csv)",
    )
    .stack(|theory| theory.stack)
    .number("perturbation", "m g", |theory| {
        theory.perturbation.yield_force
    })
    .means("singular perturbation")
    .shown_as("perturbation", digits::<7>)
    .number("quasistatic", "m g", |theory| {
        theory.quasistatic.yield_force
    })
    .means("exact quasi-static limit under the paper's convention")
    .shown_as("exact limit", digits::<7>);
    for code in Code::of_power(Power::Linear) {
        columns = columns
            .number(code.as_str(), "m g", move |theory| {
                let stack = &theory.stack;
                let mut rows = judgements.iter();
                let own = rows.find(|row| {
                    let place = (row.mu(), row.stiffness());
                    row.code == code && place == (stack.floor_friction, stack.stiffness)
                });
                own.and_then(|row| row.yield_force())
            })
            .means("F by this code")
            .shown_as(code.as_str(), digits::<7>);
    }
    columns.rows(rows)
}
