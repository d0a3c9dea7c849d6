//! The report as a self-contained HTML page, with style and figures inside.

use super::document::Document;
use crate::output::Figure;
use crate::output::table::html_text;
use minijinja::value::{Serde, Value};
use minijinja::{AutoEscape, Environment, UndefinedBehavior, context};

/// The engine of the templates of pages, with the filter `inline` for texts.
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
    let figures: Vec<String> = document.figures().map(Figure::svg).collect();
    let tables: Vec<String> = document.tables().map(|data| data.table.html()).collect();
    template
        .render(context! { document => Value::from(Serde(document)), figures, tables })
        .expect("the template uses only what the document has")
}
