//! TEMPORARY
use crate::reproduction::Reproduction;
pub struct Figure {
    pub name: &'static str,
    pub caption: String,
    pub svg: String,
}
pub fn figures(r: &Reproduction) -> Vec<Figure> {
    vec![Figure {
        name: "regimes",
        caption: "Regimes.".to_owned(),
        svg: crate::report::regimes_svg(&r.maps, &r.survey),
    }]
}
#[derive(Debug, thiserror::Error)]
#[error("x")]
pub struct PdfError;
pub fn pdf(_: &str) -> Result<Vec<u8>, PdfError> {
    Ok(Vec::new())
}
