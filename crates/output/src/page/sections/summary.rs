//! The summary, for a referee with one minute. Every number in it is computed.

use super::super::document::{Block, Section};
use super::tolerances::Agreement;
use crate::code::Code;
use crate::model::{CRITICAL_FRICTION, ContactConvention, Power, Problem, Stack};
use crate::number::{digits, friction_in_tex, percent, power_of_ten, stiffness_in_tex};
use crate::paper::claims::{ClaimJudgement, ClaimVerdict, list};
use crate::paper::published::{Published, RepeatedForce};
use crate::paper::reproduction::{Curves, Reproduction, SCALING_FRICTIONS, TheoryPoint};
use crate::study::Verdict;
use crate::study::yield_force::{Judgement, PAPER_STIFFNESSES, PAPER_WALL_SPEED};
use crate::table::Columns;
use crate::theory::Predictions;
use crate::{DataTable, published_summary_in_tex};

pub(super) fn section(reproduction: &Reproduction, claims: &[ClaimJudgement]) -> Section {
    let items = [
        of_theory(&reproduction.curves),
        reproduction.published.as_ref().map(of_published),
        Some(of_claims(claims)),
        Some(of_codes(reproduction)),
        Some(of_rows(reproduction)),
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
             $F + 3$ over the frictions at which the floor slips first, up to and beyond those of Fig. 2(a). Above $\\mu_c$ the \
             DEM does not converge to them, however stiff the cylinders are.",
            &theories(&reproduction.curves.over_friction),
        ),
        Block::table(
            "points",
            "Yield force $F = f/(mg)$ at some points of Fig. 2(a). A code with another limit turns its springs, or has other torque arms \
             than the paper’s model; that is no error.",
            &points(&reproduction.yield_curves),
        ),
    ];
    Section::new("summary", "Summary", blocks)
}

/// Formats a size in percent, without a sign.
fn unsigned(size: f64) -> String {
    format!("{:.2} %", 100.0 * size)
}

/// States how good the paper's theory is, and whether it becomes exact.
fn of_theory(curves: &Curves) -> Option<String> {
    let error = |point: &TheoryPoint| point.error(point.perturbation);
    let largest = |above: bool| {
        let own = curves.over_friction.iter();
        let own = own.filter(|point| (point.mu >= CRITICAL_FRICTION) == above);
        own.filter_map(error).map(f64::abs).reduce(f64::max)
    };
    let stiffest = |mu: f64| {
        let own = curves.over_stiffness.iter().filter(|point| point.mu == mu);
        let own = own.filter(|point| error(point).is_some());
        own.max_by(|one, other| one.stiffness.total_cmp(&other.stiffness))
    };
    let [below, _, above] = SCALING_FRICTIONS.map(stiffest);
    let (below, above) = (below?, above?);
    Some(format!(
        "The paper’s theory: at the stiffnesses of Fig. 2(a) the load $F + 3$ by Eq. (17) is within {} of the exact limit below $\\mu_c$ \
         and within {} from there on ([](#table-theories), [](#figure-theory-error)). Below $\\mu_c$ it becomes exact for stiff cylinders: \
         {} off at $\\mu = {}$, stiffness ${}$. Above $\\mu_c$ it does not, since its leading order, Eq. (8), is one of small \
         displacements: at $\\mu = {}$, stiffness ${}$ it is {} off, and stays so.",
        unsigned(largest(false)?),
        unsigned(largest(true)?),
        power_of_ten(error(below)?.abs()),
        below.mu,
        stiffness_in_tex(below.stiffness),
        above.mu,
        stiffness_in_tex(above.stiffness),
        percent(error(above)?)
    ))
}

fn of_claims(claims: &[ClaimJudgement]) -> String {
    let count = |verdict| claims.iter().filter(|own| own.verdict == verdict).count();
    let mended = |verdict| {
        let own = claims.iter().filter(|own| own.verdict == verdict);
        own.filter(|own| own.erratum.is_some()).count()
    };
    format!(
        "Of {} [checkable statements](#claims) {} hold, {} hold approximately, {} do not hold as stated, {} cannot be \
         tested here. A corrected form was checked for {} of those that do not hold and for {} of those that hold \
         approximately ([errata](#errata)).",
        claims.len(),
        count(ClaimVerdict::Holds),
        count(ClaimVerdict::Approximately),
        count(ClaimVerdict::Fails),
        count(ClaimVerdict::Untestable),
        mended(ClaimVerdict::Fails),
        mended(ClaimVerdict::Approximately)
    )
}

fn of_codes(reproduction: &Reproduction) -> String {
    let agreements = Agreement::of(&reproduction.yield_curves);
    let (agreeing, rows) = agreements.iter().fold((0, 0), |(agreeing, rows), own| {
        (agreeing + own.agreeing, rows + own.rows)
    });
    let codes = agreements.iter().map(|own| own.code.to_string());
    let largest = agreements.iter().map(|own| own.largest_error);
    format!(
        "At the stiffnesses of Fig. 2(a), {agreeing} of {rows} yield forces of {} agree with the exact quasi-static limit under the \
         contact convention of the code; the largest error is {} of $F + 3$ \
         ([](#figure-yield-curves), [](#table-yield_curves)).",
        list(codes),
        power_of_ten(largest.fold(0.0, f64::max))
    )
}

/// States what the published figures show, and how their numbers were reproduced.
fn of_published(published: &Published) -> String {
    let farthest = |figure: &str| {
        let own = published.forces.iter();
        let own = own.filter(|own| own.published.figure() == figure);
        let excess = own.filter_map(RepeatedForce::excess);
        percent(
            excess
                .max_by(|one, other| one.abs().total_cmp(&other.abs()))
                .unwrap_or(0.0),
        )
    };
    format!(
        "The published data: {} ([](#table-published)). The points show the exact limit, but for wall speed, start and end of the runs, \
         which differ from point to point: they are up to {} of $F + 3$ off in Fig. 2(a), {} in Fig. 2(b). {} pairs of numbers for the same \
         quantity do not fit together ([](#table-contradictions)).",
        published_summary_in_tex(published),
        farthest("fig2a"),
        farthest("fig2b"),
        published.contradictions.len()
    )
}

/// States where the judged rows come from, counts their verdicts, and names every inconclusive row.
fn of_rows(reproduction: &Reproduction) -> String {
    let rows: Vec<&Judgement> = reproduction.judged_rows().collect();
    let recorded = rows.iter().filter(|row| row.is_recorded()).count();
    let count = |verdict| rows.iter().filter(|row| row.verdict() == verdict).count();
    let named = rows
        .iter()
        .filter(|row| row.verdict() == Verdict::Inconclusive);
    let named = named.map(|row| {
        let mu = friction_in_tex(row.mu());
        format!(
            "{} at $\\mu = {mu}$, stiffness ${}$",
            row.code,
            stiffness_in_tex(row.stiffness())
        )
    });
    let named: Vec<String> = named.collect();
    let named = match named.is_empty() {
        true => String::new(),
        false => format!(" ({}; [why](#untested))", named.join("; ")),
    };
    format!(
        "Of {} judged rows {} are of runs on this machine and {recorded} of recorded runs: {} agree, {} differ, {} \
         inconclusive{named}, {} without yield, {} failed or missing. Not among them are those at \
         the paper’s literal settings ([](#table-literal)), of which {} of {} agree.",
        rows.len(),
        rows.len() - recorded,
        count(Verdict::Agrees),
        count(Verdict::Differs),
        count(Verdict::Inconclusive),
        count(Verdict::NoYield),
        count(Verdict::Failed) + count(Verdict::Missing),
        reproduction
            .literal
            .iter()
            .filter(|row| row.verdict() == Verdict::Agrees)
            .count(),
        reproduction.literal.len()
    )
}

fn of_scaling(reproduction: &Reproduction) -> Option<String> {
    let of = |mu: f64| {
        let mut all = reproduction.exponents.iter();
        all.find(|exponent| exponent.code.is_native() && exponent.mu == mu)
    };
    let (at, above) = (of(CRITICAL_FRICTION)?, of(0.3)?);
    let agreeing = reproduction.exponents.iter();
    let agreeing = agreeing.filter(|exponent| exponent.verdict == Verdict::Agrees);
    Some(format!(
        "Scaling: $F + 3$ grows with the stiffness to the power {:.4} at $\\mu_c$ and {:.4} at $\\mu = 0.3$ \
         between $10^3$ and $10^6$ (1/2 and 1 for $\\epsilon \\to 0$); {} of {} exponents fitted to runs with linear springs are those of \
         the exact limit within their uncertainty ([](#figure-scaling), [](#table-exponents)).",
        at.exponent,
        above.exponent,
        agreeing.count(),
        reproduction.exponents.len()
    ))
}

/// States how many rows with Hertz contacts agree, the spread of conventions at [`SPREAD`], where it is largest, and
/// the exponent.
fn of_laws(reproduction: &Reproduction) -> Option<String> {
    let laws = &reproduction.laws;
    let judged = |row: &&Judgement| (row.mu(), row.stiffness()) == SPREAD;
    let onset = |row: &Judgement| Some((row.study.limit.slip_onset?, row.code.clone()));
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
    let (styles, spread) = match agreements.len() {
        1 => (String::new(), String::new()),
        styles => (
            format!(" of {styles} styles"),
            format!(
                ", and these differ by convention alone: at $\\mu = {}$, stiffness {} the floor begins to slip at $F = {}$ ({}) to {} ({})",
                SPREAD.0,
                SPREAD.1,
                digits::<4>(lowest.0),
                lowest.1,
                digits::<4>(highest.0),
                highest.1
            ),
        ),
    };
    Some(format!(
        "Hertz contacts: the onset of slip in {agreeing} of {rows} rows{styles} agrees with its exact limit{spread}. At $\\mu_c$ the \
         largest $F + 3$, which comes later, grows between $10^3$ and $10^6$ to the power {}, and 2/5 for $\\epsilon \\to 0$, where linear springs have 1/2 \
         ([](#figure-laws), [](#table-law_forces)).",
        fitted.join(", ")
    ))
}

/// Friction and stiffness at which the summary compares the conventions with each other.
const SPREAD: (f64, f64) = (0.3, 1e4);

fn of_convergence(reproduction: &Reproduction) -> Option<String> {
    let mut points = reproduction.convergence.wall_speeds.iter();
    let paper =
        points.find(|point| point.code.is_native() && point.wall_speed == PAPER_WALL_SPEED)?;
    Some(format!(
        "At the paper’s own settings (wall speed $10^{{-6}}$, time step $10^{{-3}}$) and the point of its convergence \
         figure ($\\mu = 0.2$, stiffness $10^4$) the peak deviates by {:+.2} % from the limit, the onset of slip \
         by {} of it ([](#figure-convergence)).",
        100.0 * paper.excess_of_peak()?,
        power_of_ten(paper.excess_of_slip()?)
    ))
}

/// Returns the table of the largest errors of the paper's theories over the frictions of its figure, one row per
/// stiffness.
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
    .shown_as("perturbation, $\\mu < \\mu_c$", percent)
    .number("perturbation_above", "1", move |&stiffness| {
        largest(stiffness, true, |point| point.perturbation)
    })
    .means("the same, μ ≥ μ_c")
    .shown_as("perturbation, $\\mu \\ge \\mu_c$", percent)
    .number("elastic_below", "1", move |&stiffness| {
        largest(stiffness, false, |point| point.elastic)
    })
    .means("elastic equation, μ < μ_c")
    .shown_as("elastic equation, $\\mu < \\mu_c$", percent)
    .number("elastic_above", "1", move |&stiffness| {
        largest(stiffness, true, |point| point.elastic)
    })
    .means("the same, μ ≥ μ_c")
    .shown_as("elastic equation, $\\mu \\ge \\mu_c$", percent)
    .rows(PAPER_STIFFNESSES)
}

/// Returns the table of some points of Fig. 2(a), theory and codes side by side.
pub(crate) fn points(judgements: &[Judgement]) -> DataTable<'_> {
    let stacks = PAPER_STIFFNESSES.into_iter().flat_map(|stiffness| {
        let frictions = [0.2, CRITICAL_FRICTION, 0.3, 0.4].into_iter();
        frictions.map(move |mu| Stack::paper(mu, stiffness))
    });
    let rows = stacks.map(|stack| {
        let problem = Problem::new(stack, ContactConvention::PAPER);
        Predictions::new(&problem.expect("the stacks of the figure are in range"))
    });
    let mut columns = Columns::<Predictions>::new(
        "points",
        "A row is the yield force F of one stack of Fig. 2(a), by theory and by every code.",
        "`tristack report` (tables/points.csv)",
    )
    .stack(|theory| *theory.problem.stack())
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
    let built_in = Code::with_power(Power::Linear);
    let codes = built_in
        .iter()
        .chain(judgements.iter().map(|row| &row.code));
    for code in Code::distinct(codes) {
        let name = code.to_string();
        let is_here = judgements.iter().any(|row| row.code == code);
        columns = columns
            .number(name.clone(), "m g", move |theory| {
                let stack = theory.problem.stack();
                let mut rows = judgements.iter();
                let own = rows.find(|row| {
                    let place = (row.mu(), row.stiffness());
                    row.code == code && place == (stack.floor_friction, stack.stiffness)
                });
                own.and_then(|row| row.yield_force())
            })
            .means("F by this code");
        // The page has no empty columns for codes that were not run.
        if is_here {
            columns = columns.shown_as(name, digits::<7>);
        }
    }
    columns.rows(rows)
}
