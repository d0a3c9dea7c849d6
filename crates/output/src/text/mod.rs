//! One notation for texts, and its conversion to HTML and Markdown.
//!
//! Text between backticks is code, `$…$` is TeX mathematics, `[text](#anchor)` is a link within a page or to a file
//! beside it, and `arXiv:2511.06807` is a link to that paper. Whatever does not follow the notation is plain text.

mod html;
mod markdown;
mod span;

pub(crate) use html::{html_attribute, html_text};
pub(crate) use markdown::{markdown_cell, markdown_code, markdown_notes, markdown_text};
pub(crate) use span::without_mathematics;
