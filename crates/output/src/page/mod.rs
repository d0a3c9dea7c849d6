//! The reproducibility report: a document, and the files made of it.

mod document;
mod gallery;
mod html;
mod junit;
mod markdown;
mod references;
mod sections;

pub use sections::Origin;
pub(crate) use sections::declared_tables;

use crate::figures::Figure;
use crate::json;
use crate::paper::claims::ClaimJudgement;
use crate::paper::reproduction::Reproduction;
use document::Document;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

/// A file of the report.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReportFile {
    /// Path below the directory of the report, with `/`.
    pub name: String,
    pub content: Vec<u8>,
}

impl ReportFile {
    fn new(name: impl Into<String>, content: impl Into<Vec<u8>>) -> Self {
        Self {
            name: name.into(),
            content: content.into(),
        }
    }
}

/// Returns all files of the report, with the same bytes for the same runs.
pub fn report_files(
    reproduction: &Reproduction,
    claims: &[ClaimJudgement],
    origin: &Origin,
) -> Vec<ReportFile> {
    let document = sections::document(reproduction, claims, origin);
    let mut files = vec![
        ReportFile::new("report.html", html::html(&document)),
        ReportFile::new("gallery.html", gallery::gallery(&document)),
        ReportFile::new("report.md", markdown::markdown(&document)),
        ReportFile::new(
            "claims.json",
            json(&[sections::claims_table(claims)], &origin.command),
        ),
        ReportFile::new("junit.xml", junit::junit(reproduction, claims)),
    ];
    files.extend(tables(&document));
    files.extend(figures(&document));
    files
}

fn tables(document: &Document) -> Vec<ReportFile> {
    let tables = document.tables();
    let files =
        tables.map(|data| ReportFile::new(format!("tables/{}.csv", data.name), data.csv.clone()));
    files.collect()
}

fn figures(document: &Document) -> Vec<ReportFile> {
    let figures: Vec<&Figure> = document.figures().collect();
    let files = figures.par_iter().flat_map_iter(|figure| {
        let name = figure.name;
        [
            ReportFile::new(format!("figures/{name}.svg"), figure.svg()),
            ReportFile::new(format!("figures/{name}.pdf"), figure.pdf()),
        ]
    });
    files.collect()
}
