//! docs/formats.md says what the declared columns say.

use std::path::Path;
use tristack::output::formats_page;

#[test]
fn the_page_of_formats_is_the_one_that_the_columns_declare() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/formats.md");
    let page = formats_page();
    if std::env::var_os("TRISTACK_UPDATE_GOLDEN").is_some() {
        std::fs::write(&path, &page).expect("the page is written");
    }
    let written = std::fs::read_to_string(&path).expect("the page is there");
    assert!(
        written == page,
        "docs/formats.md is not what the columns declare; TRISTACK_UPDATE_GOLDEN=1 writes it anew"
    );
}
