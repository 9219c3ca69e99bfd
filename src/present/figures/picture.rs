//! An SVG figure as PNG, with letters that need no font of the system.

use crate::present::error::PresentError;
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};

/// Dots to a pixel of the figure: 760 px printed 17 cm wide make 227 dots to the inch.
const DOTS: f32 = 2.0;

/// A PNG picture of an SVG document, two dots to its pixel; letters are set in Noto Sans, which the program carries.
///
/// # Errors
/// [`PresentError::Drawing`] naming the figure when the document does not read or has no size.
pub fn png(name: &str, svg: &str) -> Result<Vec<u8>, PresentError> {
    let failed = |found: String| PresentError::Drawing { figure: name.to_owned(), found };
    let mut options = Options::default();
    let fonts = options.fontdb_mut();
    fonts.load_font_data(notosans::REGULAR_TTF.to_vec());
    fonts.load_font_data(notosans::BOLD_TTF.to_vec());
    let tree = Tree::from_str(svg, &options).map_err(|error| failed(error.to_string()))?;
    let size = tree.size();
    let (width, height) = (DOTS * size.width(), DOTS * size.height());
    let mut pixels = Pixmap::new(width.ceil() as u32, height.ceil() as u32)
        .ok_or_else(|| failed(format!("a size of {width} by {height} dots")))?;
    resvg::render(&tree, Transform::from_scale(DOTS, DOTS), &mut pixels.as_mut());
    let png = pixels.encode_png();
    png.map_err(|error| failed(error.to_string()))
}
