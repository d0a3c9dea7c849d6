//! The report as one page that needs nothing else: style and figures are inside.

use super::document::Document;
use crate::output::Figure;
use crate::output::table::html_text;
use minijinja::value::{Serde, Value};
use minijinja::{AutoEscape, Environment, UndefinedBehavior, context};

/// The page.
pub fn html(document: &Document) -> String {
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
        .expect("it has just been added");
    let figures: Vec<String> = document.figures().map(embedded).collect();
    let tables: Vec<String> = document.tables().map(|data| data.table.html()).collect();
    template
        .render(context! { document => Value::from(Serde(document)), figures, tables })
        .expect("the template uses only what the document has")
}

/// A figure inside the page. Names inside one drawing must not meet those of another.
fn embedded(figure: &Figure) -> String {
    let start = figure.svg.find("<svg").unwrap_or(0);
    let own = |text: &str, mark: &str| text.replace(mark, &format!("{mark}{}-", figure.name));
    let svg = own(&scalable(&figure.svg[start..]), "id=\"");
    own(&own(&svg, "url(#"), "href=\"#")
}

/// The drawing with a view box, without which a browser cuts what it should shrink.
fn scalable(svg: &str) -> String {
    let (tag, rest) = svg.split_at(svg.find('>').unwrap_or(svg.len()));
    let size = |name: &str| {
        let value = tag.split_once(&format!(" {name}=\""))?.1;
        value.split_once('"').map(|(value, _)| value)
    };
    match size("width").zip(size("height")) {
        Some((width, height)) if !tag.contains("viewBox") => {
            format!("{tag} viewBox=\"0 0 {width} {height}\"{rest}")
        }
        _ => svg.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_inside_a_figure_are_its_own() {
        let figure = Figure {
            name: "two",
            caption: String::new(),
            svg: "<?xml?><svg width=\"9\" height=\"7\"><clipPath id=\"c\"/><g clip-path=\"url(#c)\"/></svg>"
                .to_owned(),
        };
        let expected = "<svg width=\"9\" height=\"7\" viewBox=\"0 0 9 7\"><clipPath id=\"two-c\"/>\
                        <g clip-path=\"url(#two-c)\"/></svg>";
        assert_eq!(embedded(&figure), expected);
    }
}
