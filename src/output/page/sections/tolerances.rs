//! How well the codes agree with the exact limit.

use super::super::document::{Block, DataTable, Section};
use crate::code::Code;
use crate::output::number::{friction, optional, significant};
use crate::output::{Table, crosscheck_csv, crosscheck_rows};
use crate::paper::reproduction::{Exponent, Reproduction};
use crate::study::Verdict;
use crate::study::yield_force::{Evidence, Judgement};
use crate::study::{MAX_TOLERANCE, MIN_TOLERANCE};

/// What the rows of one code amount to.
pub struct Agreement {
    /// Which code.
    pub code: Code,
    /// How many of its rows agree.
    pub agreeing: usize,
    /// How many rows it has.
    pub rows: usize,
    /// Largest |error|, relative to F + 3.
    pub largest_error: f64,
    /// Largest |error| in units of the tolerance of its row.
    pub largest_share: f64,
}

impl Agreement {
    /// One for every code with rows among `judgements`.
    pub fn of(judgements: &[Judgement]) -> Vec<Self> {
        let codes = Code::all().into_iter();
        let all = codes.map(|code| {
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

/// The section.
pub fn section(reproduction: &Reproduction) -> Section {
    let mut blocks = vec![
        Block::paragraph(format!(
            "Each code is held to the exact quasi-static limit under its own, measured convention. The \
             tolerance of a row is the uncertainty of its own runs (wall speed, time step, preparation, \
             sampling, round-off and print precision, each computed), but at least {MIN_TOLERANCE:e} and at most \
             {MAX_TOLERANCE:e} of F + 3; an uncertainty above that decides nothing."
        )),
        Block::Table(agreement(reproduction)),
        Block::Table(exponents(&reproduction.exponents)),
        Block::Table(rows(
            "yield_curves",
            "Every row of figure yield_curves.",
            &reproduction.yield_curves,
        )),
        Block::Table(rows(
            "scaling",
            "Every row of figure scaling.",
            &reproduction.scaling,
        )),
        Block::Table(rows(
            "literal",
            "At the paper’s literal wall speed 10⁻⁶ and time step 10⁻³, yield force by the peak.",
            &reproduction.literal,
        )),
    ];
    blocks.push(Block::List {
        items: Evidence::ALL
            .map(|tier| {
                format!(
                    "{}: does not prove {}.",
                    tier.as_str(),
                    tier.does_not_prove()
                )
            })
            .to_vec(),
    });
    Section {
        id: "tolerances",
        title: "Agreement of the codes with the exact limit",
        blocks,
    }
}

fn agreement(reproduction: &Reproduction) -> DataTable {
    let mut table = Table::new(&[
        "code",
        "figure",
        "rows>",
        "agree>",
        "largest error/(F + 3)>",
        "largest error/tolerance>",
    ]);
    let parts = [
        ("yield_curves", &reproduction.yield_curves),
        ("scaling", &reproduction.scaling),
    ];
    for (figure, judgements) in parts {
        for own in Agreement::of(judgements) {
            table.push(vec![
                own.code.to_string(),
                figure.to_owned(),
                own.rows.to_string(),
                own.agreeing.to_string(),
                format!("{:.1e}", own.largest_error),
                format!("{:.2}", own.largest_share),
            ]);
        }
    }
    DataTable {
        name: "agreement",
        caption: "Rows that agree, and their largest errors.".to_owned(),
        csv: table.csv(),
        table,
        long: false,
    }
}

fn exponents(exponents: &[Exponent]) -> DataTable {
    let mut table = Table::new(&[
        "code",
        "μ>",
        "fitted exponent>",
        "±>",
        "of the exact limit>",
        "for ε → 0>",
        "verdict",
    ]);
    for exponent in exponents {
        table.push(vec![
            exponent.code.to_string(),
            friction(exponent.mu),
            format!("{:.7}", exponent.exponent),
            format!("{:.0e}", exponent.uncertainty),
            format!("{:.7}", exponent.exact),
            exponent.asymptotic.to_string(),
            exponent.verdict.to_string(),
        ]);
    }
    let mut writer = csv::Writer::from_writer(Vec::new());
    for exponent in exponents {
        writer
            .serialize(exponent)
            .expect("plain rows are written to memory");
    }
    DataTable {
        name: "exponents",
        caption: "Exponents of F + 3 over the stiffness, fitted from 10³ to 10⁶, beside those of the exact \
                  limit fitted in the same way."
            .to_owned(),
        csv: writer.into_inner().expect("memory is flushed"),
        table,
        long: true,
    }
}

fn rows(name: &'static str, caption: &str, judgements: &[Judgement]) -> DataTable {
    DataTable {
        name,
        caption: caption.to_owned(),
        table: crosscheck_rows(judgements),
        csv: crosscheck_csv(judgements),
        long: judgements.len() > 20,
    }
}

/// A yield force with its uncertainty.
pub fn force(force: Option<f64>) -> String {
    optional(force, |force| significant(force, 7))
}
