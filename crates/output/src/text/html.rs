//! Texts in HTML, their mathematics in MathML.

use super::span::{Span, spans, without_signs_of_tags};
use crate::model::readable_lines;
use pulldown_latex::{Event, Parser, RenderConfig, Storage, push_mathml};

/// A place in a formula where a line may end: between two `<math>` elements, since no browser breaks one.
const BREAK: &str = "</math><wbr><math display=\"inline\">";
/// Number of letters from which a formula may be broken.
const LONG: usize = 24;
/// Operators after which a formula may be broken.
const BREAKING: [&str; 4] = ["=", "+", "−", ","];

/// Formats `text` as HTML.
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
        // Lines may break after a formula, but not before the punctuation that follows it.
        let rest = next.trim_start_matches(['.', ',', ';', ':', ')', '’']);
        let stops = &next[..next.len() - rest.len()];
        let formula = span(own);
        let last_begins = formula.rfind("<math").unwrap_or(0);
        let (begin, last) = formula.split_at(last_begins);
        html += begin;
        html += &match stops {
            "" => last.to_owned(),
            _ => format!("<span style=\"white-space:nowrap\">{last}{stops}</span>"),
        };
        *next = rest;
    }
    html
}

/// Formats `text` as the value of an attribute, with its notation as it is written.
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

/// Formats the text of a link. Links in it become plain text.
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

/// Converts `tex` to MathML. Returns `None` if it is not TeX or contains `&` or `"`.
fn mathml(tex: &str) -> Option<String> {
    // The renderer does not escape the names of operators and texts.
    if tex.contains(['&', '"']) {
        return None;
    }
    let tex = &without_signs_of_tags(tex);
    let storage = Storage::new();
    let events: Result<Vec<Event>, _> = Parser::new(tex, &storage).collect();
    let mut mathml = String::new();
    let events = events.ok()?.into_iter().map(Ok::<_, std::fmt::Error>);
    push_mathml(&mut mathml, events, RenderConfig::default()).ok()?;
    Some(breakable(&set_as_in_tex(&mathml)))
}

/// Inserts breaks into a long formula, after operators outside of its fractions, roots and other parts. Such
/// operators keep the spaces of an operator between two operands.
fn breakable(mathml: &str) -> String {
    let parts = || {
        mathml
            .split_inclusive('>')
            .map(|part| part.split_at(part.find('<').unwrap_or(0)))
    };
    if parts().map(|(text, _)| text.chars().count()).sum::<usize>() < LONG {
        return mathml.to_owned();
    }
    let (mut broken, mut depth) = (String::new(), 0_usize);
    for (text, tag) in parts() {
        let breaks = depth == 2 && broken.ends_with("<mo>") && BREAKING.contains(&text);
        if breaks {
            broken.insert_str(broken.len() - 1, " form=\"infix\"");
        }
        broken += text;
        broken += tag;
        if breaks {
            broken += BREAK;
        }
        depth = match (tag.starts_with("</"), tag.ends_with("/>")) {
            (true, _) => depth.saturating_sub(1),
            (false, is_whole) => depth + usize::from(!is_whole),
        };
    }
    broken
}

/// Sets `mathml` as TeX would: with the Greek letter in place of the micro sign (which browsers do not slant), spaces
/// in place of their escaped names, and no space around slashes and bars.
fn set_as_in_tex(mathml: &str) -> String {
    mathml
        .replace('\u{b5}', "\u{3bc}")
        .replace("&amp;nbsp;", "\u{a0}")
        .replace("<mo>/</mo>", "<mo lspace=\"0\" rspace=\"0\">/</mo>")
        .replace(
            "<mo symmetric=\"false\" stretchy=\"false\">|</mo>",
            "<mo symmetric=\"false\" stretchy=\"false\" lspace=\"0\" rspace=\"0\">|</mo>",
        )
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
            "$\\operatorname{<b>x</b>}$",
            "$\\mathop{<script>}$",
        ] {
            let shown = html_text(hostile);
            assert!(
                !shown.contains("<b") && !shown.contains("<script"),
                "{shown}"
            );
        }
    }

    #[test]
    fn long_formulas_break_after_operators_outside_of_their_parts() {
        let short = html_text("$-a + b = c$");
        assert!(!short.contains(BREAK), "{short}");
        let long = html_text("$-aaaa bbbb + \\sqrt{cccc + dddd} = (-eeee - ffff) gggg$.");
        let pieces: Vec<&str> = long.split("</math><wbr>").collect();
        assert_eq!(pieces.len(), 4, "{long}");
        for (piece, operator) in pieces.iter().zip(["+", "=", "−"]) {
            let sign = format!("<mo form=\"infix\">{operator}</mo>");
            assert!(piece.ends_with(&sign), "{long}");
        }
        assert!(pieces[1].starts_with("<math") && pieces[2].starts_with("<math"));
        let last = "<span style=\"white-space:nowrap\"><math";
        assert!(pieces[3].starts_with(last) && pieces[3].ends_with("</math>.</span>"));
    }

    #[test]
    fn links_lead_within_the_page_to_its_files_and_to_arxiv() {
        let shown = html_text("[Fig. `a`](#figure-a), [x](tables/a.csv), arXiv:2511.06807");
        let expected = "<a href=\"#figure-a\">Fig. <code>a</code></a>, <a href=\"tables/a.csv\">x</a>, \
                        <a href=\"https://arxiv.org/abs/2511.06807\">arXiv:2511.06807</a>";
        assert_eq!(shown, expected);
    }
}
