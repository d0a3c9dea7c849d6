//! All figures of the report on one self-contained page.

use super::document::Document;
use super::html::environment;
use crate::output::Figure;
use minijinja::context;
use minijinja::value::{Serde, Value};
use serde::Serialize;

/// A figure in its layouts, with its place in the report.
#[derive(Debug, Serialize)]
struct Picture<'a> {
    number: usize,
    #[serde(flatten)]
    figure: &'a Figure,
    wide: String,
    narrow: String,
}

/// Every figure, numbered as in the report, with its caption and links to its files.
pub(super) fn gallery(document: &Document) -> String {
    let figures = (1..).zip(document.figures());
    let pictures = figures.map(|(number, figure)| Picture {
        number,
        figure,
        wide: figure.svg(),
        narrow: figure.narrow_svg(),
    });
    let pictures: Vec<Picture> = pictures.collect();
    let mut environment = environment();
    environment
        .add_template("gallery", include_str!("gallery.html"))
        .expect("the template is part of the program and tested");
    let template = environment
        .get_template("gallery")
        .expect("the template has just been added");
    template
        .render(context! { title => &document.title, pictures => Value::from(Serde(pictures)) })
        .expect("the template uses only what the pictures have")
}
