//! The report as a self-contained HTML page, with style and figures inside.

use super::document::{Block, Document, VerdictCount};
use crate::output::Figure;
use crate::output::text::html_text;
use minijinja::value::{Serde, Value};
use minijinja::{AutoEscape, Environment, UndefinedBehavior, context};

pub(super) fn html(document: &Document) -> String {
    let mut environment = Environment::new();
    environment.set_undefined_behavior(UndefinedBehavior::Strict);
    environment.set_auto_escape_callback(|_| AutoEscape::Html);
    environment.add_filter("inline", |text: &str| {
        Value::from_safe_string(html_text(text))
    });
    environment
        .add_template("report", include_str!("report.html"))
        .expect("the template is part of the program and tested");
    let template = environment
        .get_template("report")
        .expect("the template has just been added");
    let figures: Vec<String> = document.figures().map(Figure::svg).collect();
    let tables: Vec<String> = document.tables().map(|data| data.table.html()).collect();
    let verdicts = Value::from(Serde(verdicts(document)));
    template
        .render(context! { document => Value::from(Serde(document)), figures, tables, verdicts })
        .expect("the template uses only what the document has")
}

/// The verdicts by which claims are filtered.
fn verdicts(document: &Document) -> Vec<VerdictCount> {
    let blocks = document.sections.iter().flat_map(|section| &section.blocks);
    let counts = blocks.filter_map(|block| match block {
        Block::Claims(claims) => Some(claims.counts.clone()),
        _ => None,
    });
    counts.flatten().collect()
}
