//! The agreement of the codes with the exact limit.

use super::super::document::{Block, Section};
use crate::code::Code;
use crate::number::{friction, one_digit, power_of_ten};
use crate::paper::reproduction::{Exponent, Reproduction};
use crate::study::yield_force::{Evidence, Judgement};
use crate::study::{MAX_TOLERANCE, MIN_TOLERANCE, Verdict};
use crate::table::Columns;
use crate::{DataTable, crosscheck};

/// The agreement of one code: counts of its rows, and their largest errors.
pub(super) struct Agreement {
    pub code: Code,
    pub agreeing: usize,
    pub rows: usize,
    /// Largest |error|, relative to F + 3.
    pub largest_error: f64,
    /// Largest |error| in units of the tolerance of its row.
    largest_share: f64,
}

impl Agreement {
    /// Returns the agreement of every code with rows among `judgements`.
    pub fn of(judgements: &[Judgement]) -> Vec<Self> {
        let codes = Code::distinct(judgements.iter().map(|row| &row.code));
        let all = codes.into_iter().map(|code| {
            let rows = judgements.iter();
            let rows: Vec<_> = rows.filter(|row| row.code == code).collect();
            let agreeing = rows.iter().filter(|row| row.verdict() == Verdict::Agrees);
            let errors = rows.iter().filter_map(|row| row.error().map(f64::abs));
            let shares = rows
                .iter()
                .filter_map(|row| Some(row.error()?.abs() / row.tolerance()?));
            Self {
                code,
                agreeing: agreeing.count(),
                rows: rows.len(),
                largest_error: errors.fold(0.0, f64::max),
                largest_share: shares.fold(0.0, f64::max),
            }
        });
        all.filter(|agreement| agreement.rows > 0).collect()
    }
}

pub(super) fn section(reproduction: &Reproduction) -> Section {
    let blocks = vec![
        Block::paragraph(format!(
            "Each code is held to the exact quasi-static limit under its own, measured convention: the force at which the \
             path of equilibria of the same stack ends, computed from the balances of forces and torques for a wall that \
             moves infinitely slowly, without any time stepping (docs/theory.md). A row is one stack with one code, run at \
             several wall speeds and extrapolated to vanishing speed. The yield force is the force of the wall when the floor \
             begins to slip; with Hertz contacts the force may rise further, and then yield force, ± and exact limit are \
             those of the largest force, while error, tolerance and verdict are those of the onset of slip. Model form is \
             the distance of the limit under the convention of the code from the one under the paper’s, of $F + 3$. The \
             tolerance of a row is the uncertainty of its own runs (wall speed, time step, preparation, \
             sampling, round-off and print precision, each computed), but at least {} and at most \
             {} of $F + 3$; an uncertainty above that decides nothing.",
            power_of_ten(MIN_TOLERANCE),
            power_of_ten(MAX_TOLERANCE)
        )),
        Block::table(
            "agreement",
            "Rows that agree, and their largest errors.",
            &agreement(&[
                ("yield_curves", &reproduction.yield_curves),
                ("scaling", &reproduction.scaling),
                ("laws", &reproduction.laws.yield_curves),
                ("law_scaling", &reproduction.laws.scaling),
            ]),
        ),
        Block::long_table(
            true,
            "exponents",
            "Exponents of the largest $F + 3$ over the stiffness, fitted from $10^3$ to $10^6$, beside those of the \
             exact limit fitted in the same way.",
            &exponents(
                reproduction
                    .exponents
                    .iter()
                    .chain(&reproduction.laws.exponents),
            ),
        ),
        rows(
            "yield_curves",
            "Every row of [](#figure-yield-curves).",
            &reproduction.yield_curves,
        ),
        rows(
            "scaling",
            "Every row of [](#figure-scaling) with linear springs.",
            &reproduction.scaling,
        ),
        rows(
            "literal",
            "At the paper’s literal wall speed $10^{-6}$ and time step $10^{-3}$, yield force by the peak, less what theory \
             expects the speed to add to first order; a second run at twice the speed shows what is left. \
             [](#figure-convergence) has further speeds.",
            &reproduction.literal,
        ),
        Block::paragraph("What each kind of evidence does not prove:"),
        evidence(),
    ];
    let title = "Agreement of the codes with the exact limit";
    Section::new("tolerances", title, blocks)
}

/// Lists what each kind of evidence does not prove.
fn evidence() -> Block {
    let tiers = Evidence::ALL.map(|tier| {
        let (name, limit) = (tier.as_str(), tier.does_not_prove());
        format!("{name}: does not prove {limit}.")
    });
    Block::List {
        items: tiers.to_vec(),
    }
}

pub(crate) fn agreement<'a>(figures: &[(&'a str, &[Judgement])]) -> DataTable<'a> {
    let rows = figures.iter().flat_map(|&(figure, judgements)| {
        let agreements = Agreement::of(judgements).into_iter();
        agreements.map(move |own| (own, figure))
    });
    Columns::<(Agreement, &str)>::new(
        "agreement",
        "A row counts the rows of one code in one figure that agree with the exact limit.",
        "`tristack report` (tables/agreement.csv)",
    )
    .code(|(own, _)| &own.code)
    .text("figure", |(_, figure)| *figure)
    .means("name of the figure")
    .shown("figure")
    .number("rows", "1", |(own, _)| own.rows)
    .means("number of rows")
    .shown("rows")
    .number("agreeing", "1", |(own, _)| own.agreeing)
    .means("how many of them agree")
    .shown("agree")
    .number("largest_error", "1", |(own, _)| own.largest_error)
    .means("largest error, relative to F + 3")
    .shown_as("largest error/$(F + 3)$", |error| format!("{error:.1e}"))
    .number("largest_share", "1", |(own, _)| own.largest_share)
    .means("largest error in units of the tolerance of its row")
    .shown_as("largest error/tolerance", |share| format!("{share:.2}"))
    .rows(rows)
}

pub(crate) fn exponents<'a>(exponents: impl IntoIterator<Item = &'a Exponent>) -> DataTable<'a> {
    Columns::<&Exponent>::new(
        "exponents",
        "A row is the exponent of F + 3 over the stiffness, fitted to the runs of one code at \
         one friction.",
        "`tristack report` (tables/exponents.csv)",
    )
    .code(|own| &own.code)
    .number("mu", "1", |own| own.mu)
    .means("floor friction μ")
    .shown_as("$\\mu$", friction)
    .number("exponent", "1", |own| own.exponent)
    .means("least-squares slope of ln(F + 3) over ln(1/ε)")
    .shown_as("fitted exponent", |exponent| format!("{exponent:.7}"))
    .number("uncertainty", "1", |own| own.uncertainty)
    .means("what the uncertainties of the forces can do to it")
    .shown_as("±", one_digit)
    .number("exact", "1", |own| own.exact)
    .means("the same fit to the exact limits")
    .shown_as("of the exact limit", |exponent| format!("{exponent:.7}"))
    .number("asymptotic", "1", |own| own.asymptotic)
    .means("the exponent for ε → 0")
    .shown("for $\\epsilon \\to 0$")
    .number("points", "1", |own| own.points)
    .means("how many stiffnesses were fitted")
    .number("law_power", "1", |own| own.power.value())
    .means("power p of the normal force K overlapᵖ")
    .shown("power $p$ of the law")
    .verdict(|own| own.verdict)
    .rows(exponents)
}

pub(super) fn rows(name: &'static str, caption: &str, judgements: &[Judgement]) -> Block {
    let long = judgements.len() > 20;
    Block::long_table(long, name, caption, &crosscheck(judgements))
}
