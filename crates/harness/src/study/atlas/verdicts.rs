//! Verdicts of codes on a problem with an exact answer, as `crosscheck --out` has written them.

use crate::study::Verdict;
use crate::study::convention::schema_of;
use serde::Deserialize;
use thiserror::Error;

/// Name and version of the format.
const CROSSCHECK: &str = "tristack/crosscheck/1";

/// The rows of one crosscheck.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Verdicts {
    /// The command that made them.
    pub command: String,
    /// A row for each stack and code.
    pub rows: Vec<VerdictRow>,
}

/// The yield force of one stack by one code.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct VerdictRow {
    /// Name of the code.
    pub code: String,
    /// Its version.
    pub version: Option<String>,
    /// k_n r/(m g).
    pub stiffness: f64,
    /// Friction of the floor.
    pub mu: f64,
    /// The measured force, in m g.
    pub yield_force: Option<f64>,
    /// The exact force under the convention of the code, in m g.
    pub reference_force: Option<f64>,
    /// The difference of both, relative to the load on the floor.
    pub error: Option<f64>,
    /// Whether they agree.
    pub verdict: Verdict,
}

/// What the rows of one code say together.
#[derive(Debug, Clone, PartialEq)]
pub struct CodeVerdicts<'a> {
    /// Name of the code.
    pub code: &'a str,
    /// Its version.
    pub version: &'a str,
    /// Number of its rows.
    pub rows: usize,
    /// Number of those that agree.
    pub agreeing: usize,
    /// Number of those in which no force makes the floor slip.
    pub without_yield: usize,
    /// The largest error, without its sign.
    pub largest_error: Option<f64>,
}

/// Why a file has no verdicts.
#[derive(Debug, Error)]
pub enum UnreadableVerdicts {
    /// It is not JSON, or lacks columns of a crosscheck.
    #[error(transparent)]
    Malformed(#[from] serde_json::Error),
    /// It has another schema.
    #[error("`schema` is `{0}`; accepted is {CROSSCHECK}, as tristack crosscheck --out writes it")]
    OtherSchema(String),
}

impl Verdicts {
    /// Reads the rows in the JSON `text` of a crosscheck.
    ///
    /// # Errors
    /// If `text` is not the JSON of a crosscheck.
    pub fn read(text: &[u8]) -> Result<Self, UnreadableVerdicts> {
        let schema = schema_of(text)?;
        if schema != CROSSCHECK {
            return Err(UnreadableVerdicts::OtherSchema(schema));
        }
        Ok(serde_json::from_slice(text)?)
    }

    /// Sums up the rows of every code, in the order of their first rows.
    pub fn by_code(&self) -> Vec<CodeVerdicts<'_>> {
        let mut codes: Vec<&str> = Vec::new();
        for row in &self.rows {
            if !codes.contains(&row.code.as_str()) {
                codes.push(&row.code);
            }
        }
        let together = codes.into_iter().map(|code| {
            let rows = self.rows.iter().filter(|row| row.code == code);
            let count = |verdict| rows.clone().filter(|row| row.verdict == verdict).count();
            let errors = rows.clone().filter_map(|row| row.error).map(f64::abs);
            CodeVerdicts {
                code,
                version: rows
                    .clone()
                    .find_map(|row| row.version.as_deref())
                    .unwrap_or_default(),
                rows: rows.clone().count(),
                agreeing: count(Verdict::Agrees),
                without_yield: count(Verdict::NoYield),
                largest_error: errors.reduce(f64::max),
            }
        });
        together.collect()
    }
}
