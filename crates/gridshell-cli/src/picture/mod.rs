//! Pictures: models in plan and perspective, grids on sheets to scale. Drawn the same on every machine; as SVG, PNG or
//! PDF.
//!
//! `view` and `frame` say where things are seen, `colour` what colours mean, `scene` what lies before what; `sheet` and
//! `model` put it on paper as a `drawing`, which `svg`, `png` and `pdf` write.

pub mod colour;
pub mod drawing;
pub mod frame;
mod glyphs;
mod hidden;
pub mod label;
mod legend;
mod light;
mod model;
mod palette;
mod pdf;
mod png;
pub mod scene;
pub mod sheet;
mod small;
pub mod svg;
pub mod view;

pub use light::lit;

use crate::failure::Failure;
use drawing::{Drawing, Unit};
use gridshell::design::Design;
use gridshell::inspect::Sketch;
use gridshell::io;
use std::path::Path;

/// The legend of a scale by itself, as SVG.
pub fn legend_of(scale: &colour::Scale) -> String {
    let mut drawing = Drawing::new([280.0, 172.0], Unit::Pixel, scale.title.to_owned());
    legend::colours(&mut drawing, scale, [6.0, 10.0], 268.0, 12.0);
    svg::encode(&drawing)
}

/// Whether a picture can be drawn to this file: to be asked before the work.
pub fn check(file: &Path) -> Result<(), Failure> {
    kind(file)?;
    io::check_place(file).map_err(Failure::of_output)
}

/// Draw a model to a file.
pub fn draw(sketch: &Sketch, file: &Path) -> Result<(), Failure> {
    write(&model::plan_and_perspective(sketch), file)
}

/// Draw a sheet of a grid to a file.
pub fn draw_sheet(design: &Design, wish: &sheet::Wish, file: &Path) -> Result<(), Failure> {
    write(&sheet::sheet(design, wish), file)
}

fn write(drawing: &Drawing, file: &Path) -> Result<(), Failure> {
    let bytes = match kind(file)? {
        Kind::Svg => svg::encode(drawing).into_bytes(),
        Kind::Png => png::encode(drawing)?,
        Kind::Pdf => pdf::encode(drawing),
    };
    io::replace(file, &bytes).map_err(Failure::other)
}

#[derive(Debug)]
enum Kind {
    Svg,
    Png,
    Pdf,
}

fn kind(file: &Path) -> Result<Kind, Failure> {
    let extension = file.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    match extension.as_str() {
        "svg" => Ok(Kind::Svg),
        "png" => Ok(Kind::Png),
        "pdf" => Ok(Kind::Pdf),
        _ => {
            let message = "a picture must end in .svg, .png or .pdf";
            Err(Failure::usage(format!("{}: {message}", file.display())))
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
