//! What a referee reads in a minute. Every number in it is computed.

use super::super::document::{Block, DataTable, Section};
use super::tolerances::{Agreement, force};
use crate::code::Code;
use crate::model::{Arms, CRITICAL_FRICTION};
use crate::output::Table;
use crate::paper::claims::{ClaimJudgement, ClaimVerdict};
use crate::paper::reproduction::{Reproduction, TheoryPoint};
use crate::study::Verdict;
use crate::study::yield_force::PAPER_STIFFNESSES;

/// The section.
pub fn section(reproduction: &Reproduction, claims: &[ClaimJudgement]) -> Section {
    let mut blocks = vec![Block::List {
        items: [
            Some(of_claims(claims)),
            Some(of_codes(reproduction)),
            of_scaling(reproduction),
            of_convergence(reproduction),
        ]
        .into_iter()
        .flatten()
        .collect(),
    }];
    blocks.push(Block::Table(theories(reproduction)));
    blocks.push(Block::Table(points(reproduction)));
    Section {
        id: "summary",
        title: "Summary",
        blocks,
    }
}

fn of_claims(claims: &[ClaimJudgement]) -> String {
    let count = |verdict| {
        claims
            .iter()
            .filter(|claim| claim.verdict == verdict)
            .count()
    };
    let errata = claims
        .iter()
        .filter(|claim| claim.erratum.is_some())
        .count();
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

fn of_convergence(reproduction: &Reproduction) -> Option<String> {
    let mut points = reproduction.convergence.wall_speeds.iter();
    let paper = points.find(|point| {
        point.code == Code::NATIVE
            && point.wall_speed == crate::study::yield_force::PAPER_WALL_SPEED
    })?;
    Some(format!(
        "At the paper’s own settings (wall speed 10⁻⁶, time step 10⁻³) and the point of its convergence \
         figure (μ = 0.2, stiffness 10⁴) the peak deviates by {:+.2} % from the limit, the onset of slip \
         by {:+.0e}.",
        100.0 * paper.excess_of_peak()?,
        paper.excess_of_slip()?
    ))
}

/// Largest errors of the paper's theories over the frictions of its figure.
fn theories(reproduction: &Reproduction) -> DataTable {
    let mut table = Table::new(&[
        "stiffness>",
        "perturbation, μ < μ_c>",
        "perturbation, μ ≥ μ_c>",
        "elastic equation, μ < μ_c>",
        "elastic equation, μ ≥ μ_c>",
    ]);
    for stiffness in PAPER_STIFFNESSES {
        let largest = |above: bool, theory: fn(&TheoryPoint) -> Option<f64>| {
            let points = reproduction.curves.over_friction.iter();
            let own = points.filter(|point| {
                point.stiffness == stiffness && (point.mu >= CRITICAL_FRICTION) == above
            });
            let errors = own.filter_map(|point| point.error(theory(point)));
            let largest = errors.max_by(|left, right| left.abs().total_cmp(&right.abs()));
            largest.map_or_else(
                || "-".to_owned(),
                |error| format!("{:+.2} %", 100.0 * error),
            )
        };
        table.push(vec![
            stiffness.to_string(),
            largest(false, |point| point.perturbation),
            largest(true, |point| point.perturbation),
            largest(false, |point| point.elastic),
            largest(true, |point| point.elastic),
        ]);
    }
    DataTable {
        name: "theories",
        caption: "The paper’s theories against the exact quasi-static limit of its own DEM: largest error \
                  relative to F + 3 over the frictions of Fig. 2(a). Above μ_c they are no limit of the DEM."
            .to_owned(),
        csv: table.csv(),
        table,
        long: false,
    }
}

/// Some points of Fig. 2(a), theory and codes side by side.
fn points(reproduction: &Reproduction) -> DataTable {
    let mut columns = vec!["stiffness>", "μ>", "perturbation>", "exact limit>"];
    let codes = Code::all();
    columns.extend(codes.iter().map(|code| code.as_str()));
    let mut table = Table::new(&columns);
    for stiffness in PAPER_STIFFNESSES {
        for mu in [0.2, CRITICAL_FRICTION, 0.3, 0.4] {
            let rows = reproduction.yield_curves.iter();
            let rows: Vec<_> = rows
                .filter(|row| row.mu() == mu && row.stiffness() == stiffness)
                .collect();
            let stack = crate::model::Stack::paper(mu, stiffness);
            let theory = crate::theory::Predictions::new(&stack, &Arms::PAPER);
            let mut cells = vec![
                stiffness.to_string(),
                crate::output::friction(mu),
                force(theory.perturbation.yield_force),
                force(theory.quasistatic.yield_force),
            ];
            cells.extend(codes.iter().map(|&code| {
                let own = rows.iter().find(|row| row.code == code);
                force(own.and_then(|row| row.yield_force()))
            }));
            table.push(cells);
        }
    }
    DataTable {
        name: "points",
        caption: "Yield force F = f/(m g) at some points of Fig. 2(a). Codes whose limit is \
                  another one have other torque arms than the paper’s model; that is no error."
            .to_owned(),
        csv: table.csv(),
        table,
        long: false,
    }
}
