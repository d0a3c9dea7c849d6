//! SVG to PDF, with a font of our own, so that every machine writes the same bytes.

use base64::prelude::{BASE64_STANDARD, Engine as _};
use krilla::Document;
use krilla::geom::Size;
use krilla::page::PageSettings;
use krilla_svg::{SurfaceExt, SvgSettings};
use kuva::backend::svg::SvgBackend;
use kuva::render::render::Scene;
use std::sync::{Arc, OnceLock};
use thiserror::Error;
use usvg::fontdb::Database;

/// Why a figure could not be written as PDF.
#[derive(Debug, Error)]
#[error("cannot convert SVG to PDF: {0}")]
pub struct PdfError(String);

const FAMILY: &str = "DejaVu Sans";
/// Points in a pixel: an SVG has 96 pixels to the inch.
const POINTS: f32 = 0.75;

/// `svg` as a page of its size, its texts in DejaVu Sans and searchable.
///
/// # Errors
/// If `svg` is not one.
pub fn pdf(svg: &str) -> Result<Vec<u8>, PdfError> {
    let options = usvg::Options {
        fontdb: fonts(),
        font_family: FAMILY.to_owned(),
        ..usvg::Options::default()
    };
    let tree = usvg::Tree::from_str(svg, &options).map_err(|error| PdfError(error.to_string()))?;
    let (width, height) = (tree.size().width() * POINTS, tree.size().height() * POINTS);
    let size = Size::from_wh(width, height)
        .ok_or_else(|| PdfError(format!("no page is {width} x {height} points")))?;
    let mut document = Document::new();
    let mut page = document.start_page_with(PageSettings::new(size));
    let mut surface = page.surface();
    surface.draw_svg(&tree, size, SvgSettings::default());
    surface.finish();
    page.finish();
    document
        .finish()
        .map_err(|error| PdfError(format!("{error:?}")))
}
fn fonts() -> Arc<Database> {
    static FONTS: OnceLock<Arc<Database>> = OnceLock::new();
    let load = || {
        let mut database = Database::new();
        for font in embedded_fonts() {
            database.load_font_data(font);
        }
        Arc::new(database)
    };
    Arc::clone(FONTS.get_or_init(load))
}

/// The faces of DejaVu Sans that kuva carries. It gives them away only inside an SVG, as data URLs.
fn embedded_fonts() -> Vec<Vec<u8>> {
    let empty = Scene::new(1.0, 1.0);
    let svg = SvgBackend::new()
        .with_embedded_font(true)
        .render_scene(&empty);
    let urls = svg.split(";base64,").skip(1);
    let encoded = urls.filter_map(|url| url.split('\'').next());
    encoded
        .filter_map(|font| BASE64_STANDARD.decode(font).ok())
        .collect()
}
