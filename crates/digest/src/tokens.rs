//! The tokens of a source file that decide what it computes.

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use std::io;
use std::iter::Peekable;
use std::path::Path;

/// Returns the tokens of the source `content`, each after a blank, without comments, documentation and what only
/// tests use; `None` for a file that only tests use.
pub(super) fn deciding(content: &[u8], file: &Path) -> io::Result<Option<String>> {
    let invalid = |message: String| {
        let message = format!("{}: {message}", file.display());
        io::Error::new(io::ErrorKind::InvalidData, message)
    };
    let text = std::str::from_utf8(content).map_err(|error| invalid(error.to_string()))?;
    let tokens: TokenStream = text.parse().map_err(|error| invalid(format!("{error}")))?;
    if is_for_tests(&tokens) {
        return Ok(None);
    }
    let mut written = String::new();
    write(tokens, &mut written);
    Ok(Some(written))
}

/// Returns whether `#![cfg(test)]` is one of the attributes with which a file begins.
fn is_for_tests(tokens: &TokenStream) -> bool {
    let mut tokens = tokens.clone().into_iter().peekable();
    while let Some(attribute) = inner_attribute(&mut tokens) {
        if says_test(&attribute) {
            return true;
        }
    }
    false
}

type Tokens = Peekable<proc_macro2::token_stream::IntoIter>;

/// Takes the next tokens if they are `#![...]`, and returns the brackets.
fn inner_attribute(tokens: &mut Tokens) -> Option<Group> {
    tokens.next_if(|token| is_punct(token, '#'))?;
    tokens.next_if(|token| is_punct(token, '!'))?;
    brackets(tokens)
}

fn brackets(tokens: &mut Tokens) -> Option<Group> {
    let is_attribute = |token: &TokenTree| matches!(token, TokenTree::Group(group) if group.delimiter() == Delimiter::Bracket);
    match tokens.next_if(is_attribute)? {
        TokenTree::Group(group) => Some(group),
        _ => None,
    }
}

fn write(tokens: TokenStream, written: &mut String) {
    let mut tokens = tokens.into_iter().peekable();
    while let Some(token) = tokens.next() {
        if is_punct(&token, '#') {
            let inner = tokens.next_if(|token| is_punct(token, '!'));
            if let Some(attribute) = brackets(&mut tokens) {
                match attribute {
                    attribute
                        if inner.is_none() && says_test(&attribute) && skip_item(&mut tokens) => {}
                    attribute if is_documentation(&attribute) => {}
                    attribute => {
                        written.push_str(if inner.is_some() { " # ! [" } else { " # [" });
                        write(attribute.stream(), written);
                        written.push_str(" ]");
                    }
                }
                continue;
            }
            written.push_str(" #");
            if inner.is_some() {
                written.push_str(" !");
            }
            continue;
        }
        match token {
            TokenTree::Group(group) => {
                let [open, close] = match group.delimiter() {
                    Delimiter::Parenthesis => [" (", " )"],
                    Delimiter::Brace => [" {", " }"],
                    Delimiter::Bracket => [" [", " ]"],
                    Delimiter::None => [" ", " "],
                };
                written.push_str(open);
                write(group.stream(), written);
                written.push_str(close);
            }
            token => {
                written.push(' ');
                written.push_str(&token.to_string());
            }
        }
    }
}

/// Skips the item after an attribute, with its other attributes, and returns whether it is one. What only looks like an
/// item, such as a field or a statement, has no end that is known here, and stays.
fn skip_item(tokens: &mut Tokens) -> bool {
    let mut ahead = tokens.clone();
    while ahead.next_if(|token| is_punct(token, '#')).is_some() {
        brackets(&mut ahead);
    }
    if ahead.next_if(|token| is_word(token, &["pub"])).is_some() {
        ahead.next_if(|token| is_group(token, Delimiter::Parenthesis));
    }
    let Some(first) = ahead.next_if(|token| is_word(token, &ITEMS)) else {
        return false;
    };
    let is_value = match ahead.peek() {
        Some(second) => is_word(&first, &["const"]) && !is_word(second, &["fn", "unsafe", "async"]),
        None => false,
    };
    let ends_in_semicolon = is_value || is_word(&first, &["use", "static", "type"]);
    for token in ahead.by_ref() {
        if is_punct(&token, ';') || !ends_in_semicolon && is_group(&token, Delimiter::Brace) {
            break;
        }
    }
    *tokens = ahead;
    true
}

/// The words with which an item begins, after its visibility.
const ITEMS: [&str; 14] = [
    "async",
    "const",
    "enum",
    "extern",
    "fn",
    "impl",
    "macro_rules",
    "mod",
    "static",
    "struct",
    "trait",
    "type",
    "unsafe",
    "use",
];

fn is_word(token: &TokenTree, words: &[&str]) -> bool {
    matches!(token, TokenTree::Ident(ident) if words.iter().any(|word| ident == word))
}

fn is_group(token: &TokenTree, delimiter: Delimiter) -> bool {
    matches!(token, TokenTree::Group(group) if group.delimiter() == delimiter)
}

fn is_punct(token: &TokenTree, char: char) -> bool {
    matches!(token, TokenTree::Punct(punct) if punct.as_char() == char)
}

/// Returns whether an attribute is `cfg(test)`, alone or as the first of `all`.
fn says_test(attribute: &Group) -> bool {
    let text: String = attribute.stream().to_string();
    let text: String = text.split_whitespace().collect();
    text == "cfg(test)" || text.starts_with("cfg(all(test,")
}

fn is_documentation(attribute: &Group) -> bool {
    let mut tokens = attribute.stream().into_iter();
    let is_doc = matches!(tokens.next(), Some(TokenTree::Ident(ident)) if ident == "doc");
    is_doc && matches!(tokens.next(), Some(token) if is_punct(&token, '='))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Option<String> {
        deciding(text.as_bytes(), Path::new("lib.rs")).expect("it is Rust")
    }

    #[test]
    fn comments_layout_documentation_and_tests_decide_nothing() {
        let plain = of("pub fn f(x: f64) -> f64 { 2.0 * x }");
        for same in [
            "//! A crate.\n\n/// Twice `x`.\npub fn f(\n    x: f64\n) -> f64 {\n    // Exact.\n    2.0 * x\n}\n",
            "pub fn f(x: f64) -> f64 { 2.0 * x }\n#[cfg(test)]\nmod tests { #[test] fn t() {} }",
            "#[cfg(test)]\nuse std::fmt;\npub fn f(x: f64) -> f64 { 2.0 * x }",
            "#[cfg(test)]\nuse std::{fmt, io};\npub fn f(x: f64) -> f64 { 2.0 * x }",
            "#[cfg(test)]\npub(super) const A: [u8; 1] = { [1] };\npub fn f(x: f64) -> f64 { 2.0 * x }",
            "#[cfg(test)]\nconst fn a() {}\npub fn f(x: f64) -> f64 { 2.0 * x }",
            "#[cfg(all(test, unix))]\n#[allow(unused)]\nfn t(a: [u8; 3]) {}\npub fn f(x: f64) -> f64 { 2.0 * x }",
        ] {
            assert_eq!(of(same), plain, "{same}");
        }
    }

    #[test]
    fn numbers_names_and_attributes_decide() {
        let plain = of("#[inline]\npub fn f(x: f64) -> f64 { 2.0 * x }");
        for other in [
            "#[inline]\npub fn f(x: f64) -> f64 { 2.000000000000001 * x }",
            "#[inline]\npub fn g(x: f64) -> f64 { 2.0 * x }",
            "pub fn f(x: f64) -> f64 { 2.0 * x }",
            "#[inline]\npub fn f(x: f64) -> f64 { 2.0 * x }\n#[cfg(not(test))]\nfn g() {}",
        ] {
            assert_ne!(of(other), plain, "{other}");
        }
    }

    /// What follows a field or a statement of tests is not taken for a part of it.
    #[test]
    fn nothing_beside_a_field_of_tests_is_lost() {
        for [one, other] in [
            [
                "struct A { #[cfg(test)] x: f64, y: f64 }",
                "struct A { #[cfg(test)] x: f64, y: f32 }",
            ],
            [
                "fn f() { #[cfg(test)] g(); h() } fn i() {}",
                "fn f() { #[cfg(test)] g(); j() } fn i() {}",
            ],
            [
                "mod a { #![cfg(test)] } fn f() {}",
                "mod a { #![cfg(test)] } fn g() {}",
            ],
        ] {
            assert_ne!(of(one), of(other), "{one}");
        }
    }

    #[test]
    fn a_file_for_tests_alone_is_left_out() {
        assert_eq!(of("//! Tests.\n#![cfg(test)]\nfn f() {}"), None);
        assert!(of("//! No tests.\n#![allow(unused)]\nfn f() {}").is_some());
    }

    #[test]
    fn what_is_no_rust_is_refused_with_its_name() {
        let error = deciding(b"fn f( {", Path::new("broken.rs")).unwrap_err();
        assert!(error.to_string().starts_with("broken.rs: "), "{error}");
    }
}
