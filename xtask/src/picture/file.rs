//! A picture as a small PNG: of at most 256 colours, looked up in a palette.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

/// Levels of each of red, green and blue that are tried first.
const LEVELS: u16 = 10;
/// Levels of grey: more, because shading is a matter of small differences.
const GREYS: u16 = 32;
/// A colour whose largest and least parts are no further apart is grey.
const NEARLY: u8 = 20;
/// Most colours of a palette.
const MOST: usize = 256;

/// Write red, green, blue and alpha of opaque pixels, row by row.
pub fn write(file: &Path, size: [u32; 2], pixels: &[u8]) -> Result<(), String> {
    let (palette, indices) = looked_up(pixels);
    let fault = |e: &dyn std::fmt::Display| format!("{}: {e}", file.display());
    let out = BufWriter::new(File::create(file).map_err(|e| fault(&e))?);
    let mut encoder = png::Encoder::new(out, size[0], size[1]);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_palette(palette);
    encoder.set_compression(png::Compression::Best);
    // Neighbouring indices are no neighbouring colours, so differences between pixels tell nothing.
    encoder.set_filter(png::FilterType::NoFilter);
    let mut writer = encoder.write_header().map_err(|e| fault(&e))?;
    writer.write_image_data(&indices).map_err(|e| fault(&e))
}

/// The palette, and each pixel's place in it.
fn looked_up(pixels: &[u8]) -> (Vec<u8>, Vec<u8>) {
    for levels in (2..=LEVELS).rev() {
        let coarse: Vec<[u8; 3]> =
            pixels.chunks_exact(4).map(|p| coarse([p[0], p[1], p[2]], levels)).collect();
        let mut places: BTreeMap<[u8; 3], u8> = coarse.iter().map(|&c| (c, 0)).collect();
        if places.len() > MOST {
            continue;
        }
        places.values_mut().enumerate().for_each(|(k, place)| *place = k as u8);
        let palette = places.keys().flatten().copied().collect();
        return (palette, coarse.iter().map(|c| places[c]).collect());
    }
    unreachable!("8 colours and {GREYS} greys fit into a palette")
}

/// The nearest colour of so many levels.
fn coarse(rgb: [u8; 3], levels: u16) -> [u8; 3] {
    let [low, high] = [rgb.iter().min(), rgb.iter().max()].map(|x| x.copied().unwrap_or(0));
    let step = |x: u16, levels: u16| {
        let k = (x * (levels - 1) + 127) / 255;
        ((k * 255 + (levels - 1) / 2) / (levels - 1)) as u8
    };
    if high - low <= NEARLY {
        let mean = rgb.iter().map(|&x| u16::from(x)).sum::<u16>() / 3;
        return [step(mean, GREYS); 3];
    }
    rgb.map(|x| step(u16::from(x), levels))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_of_many_colours_fit_into_a_palette() {
        let pixels: Vec<u8> =
            (0..4096_u32).flat_map(|k| [k, k / 16, k * 7, 255].map(|x| (x % 256) as u8)).collect();
        let (palette, indices) = looked_up(&pixels);
        assert!(palette.len() <= 3 * MOST && indices.len() == 4096);
        assert!(indices.iter().all(|&k| 3 * usize::from(k) < palette.len()));
    }

    #[test]
    fn black_and_white_stay_what_they_are() {
        for c in [[0; 3], [255; 3]] {
            assert_eq!(coarse(c, LEVELS), c);
        }
    }
}
