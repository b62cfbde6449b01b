//! Pictures: models in plan and perspective, grids on sheets to scale. Drawn the same on every machine; as SVG, PNG or
//! PDF.
//!
//! `view` and `frame` say where things are seen, `scene` what lies before what; `sheet` and
//! `model` put it on paper as a `drawing`, which `svg`, `png` and `pdf` write.

pub(crate) mod drawing;
pub(crate) mod frame;
mod glyphs;
mod hidden;
pub(crate) mod label;
mod legend;
mod light;
mod model;
mod palette;
mod pdf;
mod png;
pub(crate) mod scene;
pub(crate) mod sheet;
mod small;
pub(crate) mod svg;
pub(crate) mod view;

pub use label::Labels;
pub(crate) use light::lit;
pub use sheet::{Paper, Sheet, Wish};

use crate::colourings::Scale;
use drawing::{Drawing, Unit};
use gridshell::design::Design;
use gridshell::inspect::Sketch;
use gridshell::{Error, Result, io};
use std::path::Path;

/// The legend of a scale by itself, as SVG.
pub(crate) fn legend_of(scale: &Scale) -> String {
    let mut drawing = Drawing::new([280.0, 188.0], Unit::Pixel, scale.title.clone());
    legend::colours(&mut drawing, scale, [6.0, 10.0], 268.0, 12.0);
    svg::encode(&drawing)
}

/// Refuse a file that is not a picture, or cannot be written, before the work is done.
///
/// # Errors
/// [`Error::Option`] for an extension that is not known, or a folder that is not there; [`Error::Io`].
pub fn check(file: &Path) -> Result<()> {
    kind(file)?;
    io::check_place(file)
}

/// Draw a model in plan and perspective to a file.
///
/// # Errors
/// As [`check`].
pub fn draw(sketch: &Sketch, file: &Path) -> Result<()> {
    write(&model::plan_and_perspective(sketch), file)
}

/// Draw a sheet of a grid to a file.
///
/// # Errors
/// As [`check`].
pub fn draw_sheet(design: &Design, wish: &sheet::Wish, file: &Path) -> Result<()> {
    write(&sheet::sheet(design, wish), file)
}

fn write(drawing: &Drawing, file: &Path) -> Result<()> {
    let bytes = match kind(file)? {
        Kind::Svg => svg::encode(drawing).into_bytes(),
        Kind::Png => png::encode(drawing)
            .map_err(|message| Error::Option(format!("{}: {message}", file.display())))?,
        Kind::Pdf => pdf::encode(drawing),
    };
    io::replace(file, &bytes)
}

#[derive(Debug)]
enum Kind {
    Svg,
    Png,
    Pdf,
}

fn kind(file: &Path) -> Result<Kind> {
    let extension = file.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    match extension.as_str() {
        "svg" => Ok(Kind::Svg),
        "png" => Ok(Kind::Png),
        "pdf" => Ok(Kind::Pdf),
        _ => {
            let message = "a picture must end in .svg, .png or .pdf";
            Err(Error::Option(format!("{}: {message}", file.display())))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_kinds_of_pictures_are_refused() {
        assert!(kind(Path::new("a.jpg")).is_err());
        assert!(kind(Path::new("a.PDF")).is_ok());
    }
}
