//! All figures of the report on one self-contained page.

use super::document::{Document, NumberedFigure};
use super::html::{Drawn, environment};
use minijinja::context;
use minijinja::value::{Serde, Value};

/// Returns the page with every figure, numbered as in the report, with its caption and links to its files.
pub(super) fn gallery(document: &Document) -> String {
    let pictures: Vec<&NumberedFigure> = document.numbered_figures().collect();
    let drawn: Vec<Drawn> = document.figures().map(Drawn::new).collect();
    let mut environment = environment();
    environment
        .add_template("gallery", include_str!("gallery.html"))
        .expect("the template is part of the program and tested");
    let template = environment
        .get_template("gallery")
        .expect("the template has just been added");
    let (pictures, drawn) = (Value::from(Serde(pictures)), Value::from(Serde(drawn)));
    template
        .render(context! { title => &document.title, pictures, drawn })
        .expect("the template uses only what the pictures have")
}
