//! docs/formats.md, made from the declared columns.

/// The page.
pub fn formats_page() -> String {
    String::new()
}
