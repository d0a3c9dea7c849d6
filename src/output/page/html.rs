//! The report as one page that needs nothing else: style and figures are inside.

use super::document::Document;
use crate::output::Figure;
use minijinja::value::{Serde, Value};
use minijinja::{AutoEscape, Environment, UndefinedBehavior, context};

/// The page.
pub fn html(document: &Document) -> String {
    let mut environment = Environment::new();
    environment.set_undefined_behavior(UndefinedBehavior::Strict);
    environment.set_auto_escape_callback(|_| AutoEscape::Html);
    environment.add_filter("inline", inline);
    environment
        .add_template("report", include_str!("report.html"))
        .expect("the template is part of the program and tested");
    let template = environment
        .get_template("report")
        .expect("it has just been added");
    let figures: Vec<String> = document.figures().map(Figure::svg).collect();
    template
        .render(context! { document => Value::from(Serde(document)), figures })
        .expect("the template uses only what the document has")
}

/// `text` with code between backticks, everything else escaped.
fn inline(text: &str) -> Value {
    let parts = text.split('`').enumerate().map(|(index, part)| {
        let escaped = escape(part);
        if index % 2 == 1 {
            format!("<code>{escaped}</code>")
        } else {
            escaped
        }
    });
    Value::from_safe_string(parts.collect())
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_escaped_and_code_is_marked() {
        let shown = inline("a < b & `x > y`").to_string();
        assert_eq!(shown, "a &lt; b &amp; <code>x &gt; y</code>");
    }
}
