//! Texts in HTML, their mathematics in MathML.

use super::span::{Span, spans};
use crate::model::readable_lines;
use pulldown_latex::{Event, Parser, RenderConfig, Storage, push_mathml};

/// `text` in HTML.
pub(crate) fn html_text(text: &str) -> String {
    let text = readable_lines(text);
    let mut html = String::new();
    let mut spans = spans(&text).into_iter().peekable();
    while let Some(own) = spans.next() {
        let Some(Span::Plain(next)) = spans.peek_mut().filter(|_| matches!(own, Span::Math(_)))
        else {
            html += &span(own);
            continue;
        };
        // Lines may break after a formula, but not before a full stop.
        let rest = next.trim_start_matches(['.', ',', ';', ':', ')', '’']);
        let stops = &next[..next.len() - rest.len()];
        html += &match stops {
            "" => span(own),
            _ => format!(
                "<span style=\"white-space:nowrap\">{}{stops}</span>",
                span(own)
            ),
        };
        *next = rest;
    }
    html
}

/// `text` as the value of an attribute, as it is written.
pub(crate) fn html_attribute(text: &str) -> String {
    escaped(&readable_lines(text))
}

fn span(span: Span) -> String {
    match span {
        Span::Plain(text) => escaped(text),
        Span::Code(text) => format!("<code>{}</code>", escaped(text)),
        Span::Math(tex) => mathml(tex).unwrap_or_else(|| escaped(&format!("${tex}$"))),
        Span::Link { text, target } => {
            format!("<a href=\"{target}\">{}</a>", html_text_without_links(text))
        }
    }
}

/// The text of a link, in which no further link begins.
fn html_text_without_links(text: &str) -> String {
    let parts = spans(text).into_iter().map(|part| match part {
        Span::Link { text, .. } => escaped(text),
        other => span(other),
    });
    parts.collect()
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

/// `tex` as MathML; `None` if it is not TeX.
fn mathml(tex: &str) -> Option<String> {
    // The renderer escapes no text of letters; none of these characters is needed in one.
    if tex.contains(['&', '<', '>', '"']) && tex.contains("\\text") {
        return None;
    }
    let storage = Storage::new();
    let events: Result<Vec<Event>, _> = Parser::new(tex, &storage).collect();
    let mut mathml = String::new();
    let events = events.ok()?.into_iter().map(Ok::<_, std::fmt::Error>);
    push_mathml(&mut mathml, events, RenderConfig::default()).ok()?;
    // TeX sets a slash without space.
    Some(mathml.replace("<mo>/</mo>", "<mo lspace=\"0\" rspace=\"0\">/</mo>"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_escaped_and_code_is_marked() {
        let shown = html_text("a < b & `x > y`");
        assert_eq!(shown, "a &lt; b &amp; <code>x &gt; y</code>");
        assert_eq!(html_text("\u{202e}"), "\\u{202e}");
    }

    #[test]
    fn mathematics_becomes_mathml_and_nothing_else_markup() {
        let shown = html_text("at $\\mu_c = 2 - \\sqrt3$");
        assert!(shown.starts_with("at <math"), "{shown}");
        assert!(
            shown.contains("<msub><mi>μ</mi><mi>c</mi></msub>"),
            "{shown}"
        );
        for hostile in [
            "$\\text{<b>}$",
            "$a<b>c$",
            "$\\frac$",
            "$<script>$",
            "$\\text{&quot;}$",
        ] {
            let shown = html_text(hostile);
            assert!(
                !shown.contains("<b>") && !shown.contains("<script"),
                "{shown}"
            );
        }
    }

    #[test]
    fn links_lead_within_the_page_to_its_files_and_to_arxiv() {
        let shown = html_text("[Fig. `a`](#figure-a), [x](tables/a.csv), arXiv:2511.06807");
        let expected = "<a href=\"#figure-a\">Fig. <code>a</code></a>, <a href=\"tables/a.csv\">x</a>, \
                        <a href=\"https://arxiv.org/abs/2511.06807\">arXiv:2511.06807</a>";
        assert_eq!(shown, expected);
    }
}
