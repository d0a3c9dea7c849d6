//! The report as a self-contained HTML page, with style and figures inside.

use super::document::{Block, Document, VerdictCount};
use crate::Figure;
use crate::text::html_text;
use minijinja::value::{Serde, Value};
use minijinja::{AutoEscape, Environment, UndefinedBehavior, context};
use serde::Serialize;

/// Returns the template engine of the pages, with the filter `inline` for texts.
pub(super) fn environment() -> Environment<'static> {
    let mut environment = Environment::new();
    environment.set_undefined_behavior(UndefinedBehavior::Strict);
    environment.set_auto_escape_callback(|_| AutoEscape::Html);
    environment.add_filter("inline", |text: &str| {
        Value::from_safe_string(html_text(text))
    });
    environment
}

pub(super) fn html(document: &Document) -> String {
    let mut environment = environment();
    environment
        .add_template("report", include_str!("report.html"))
        .expect("the template is part of the program and tested");
    let template = environment
        .get_template("report")
        .expect("the template has just been added");
    let figures: Vec<Drawn> = document.figures().map(Drawn::new).collect();
    let figures = Value::from(Serde(figures));
    let tables: Vec<String> = document.tables().map(|data| data.table.html()).collect();
    let verdicts = Value::from(Serde(verdicts(document)));
    template
        .render(context! { document => Value::from(Serde(document)), figures, tables, verdicts })
        .expect("the template uses only what the document has")
}

/// A figure in its layouts for wide and for narrow pages.
#[derive(Debug, Serialize)]
pub(super) struct Drawn {
    wide: String,
    narrow: String,
}

impl Drawn {
    pub fn new(figure: &Figure) -> Self {
        Self {
            wide: figure.svg(),
            narrow: figure.narrow_svg(),
        }
    }
}

/// Returns the verdicts by which claims can be filtered, with their counts.
fn verdicts(document: &Document) -> Vec<VerdictCount> {
    let blocks = document.sections.iter().flat_map(|section| &section.blocks);
    let counts = blocks.filter_map(|block| match block {
        Block::Claims(claims) => Some(claims.counts.clone()),
        _ => None,
    });
    counts.flatten().collect()
}
