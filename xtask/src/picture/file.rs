//! A picture as a small PNG: each pixel is the nearest colour of a palette of inks, thinned inks and greys.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

/// Shares of ink on white paper: full ones, and what is left at the rims of lines.
const SHARES: [f64; 4] = [1.0, 0.75, 0.5, 0.25];
/// Greys from black to white.
const GREYS: u8 = 32;

/// Write red, green, blue and alpha of opaque pixels, row by row. With the greys, four times the number of
/// inks must not be more than 256.
pub fn write(file: &Path, size: [u32; 2], pixels: &[u8], inks: &[[f64; 3]]) -> Result<(), String> {
    let palette = palette(inks);
    let indices = looked_up(pixels, &palette);
    let fault = |e: &dyn std::fmt::Display| format!("{}: {e}", file.display());
    let out = BufWriter::new(File::create(file).map_err(|e| fault(&e))?);
    let mut encoder = png::Encoder::new(out, size[0], size[1]);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_palette(palette.concat());
    encoder.set_compression(png::Compression::Best);
    // Neighbouring indices are no neighbouring colours, so differences between pixels tell nothing.
    encoder.set_filter(png::FilterType::NoFilter);
    let mut writer = encoder.write_header().map_err(|e| fault(&e))?;
    writer.write_image_data(&indices).map_err(|e| fault(&e))
}

fn palette(inks: &[[f64; 3]]) -> Vec<[u8; 3]> {
    let byte = |x: f64| (255.0 * x).round() as u8;
    let greys = (0..GREYS).map(|k| [byte(f64::from(k) / f64::from(GREYS - 1)); 3]);
    let thinned = |ink: &[f64; 3]| {
        let ink = *ink;
        SHARES.map(|share| ink.map(|x| byte(1.0 - share * (1.0 - x))))
    };
    greys.chain(inks.iter().flat_map(thinned)).collect()
}

/// The place of each pixel's nearest colour.
fn looked_up(pixels: &[u8], palette: &[[u8; 3]]) -> Vec<u8> {
    let mut known: BTreeMap<[u8; 3], u8> = BTreeMap::new();
    let indices = pixels.chunks_exact(4).map(|p| {
        let rgb = [p[0], p[1], p[2]];
        *known.entry(rgb).or_insert_with(|| nearest(rgb, palette))
    });
    indices.collect()
}

fn nearest(rgb: [u8; 3], palette: &[[u8; 3]]) -> u8 {
    let distance =
        |c: &[u8; 3]| -> i32 { (0..3).map(|k| (i32::from(c[k]) - i32::from(rgb[k])).pow(2)).sum() };
    let places = 0..palette.len().min(256);
    places.min_by_key(|&k| distance(&palette[k])).unwrap_or(0) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inks_black_and_white_stay_what_they_are() {
        let palette = palette(&[[1.0, 0.0, 0.0], [0.0, 0.2, 0.8]]);
        let pixels = [[0, 0, 0, 255], [255, 255, 255, 255], [255, 0, 0, 255], [0, 51, 204, 255]];
        let seen = looked_up(pixels.as_flattened(), &palette);
        for (k, p) in seen.iter().zip(pixels) {
            assert_eq!(palette[usize::from(*k)], p[..3]);
        }
    }
}
