//! Pixels by the numbers of at most 256 colours: drawings have few, and mixtures of them at the rims of lines. Such files are
//! a third as large.

use std::cmp::Reverse;
use std::collections::BTreeMap;

/// The colours, and the number of each pixel's, row by row.
pub struct Indexed {
    pub palette: Vec<[u8; 3]>,
    pub pixels: Vec<u8>,
}

/// The pixels (red, green, blue, alpha, opaque) in these inks and the colours that most of them have, together at most
/// `most`; others take the nearest of these.
pub fn indexed(pixels: &[u8], inks: &[[u8; 3]], most: u8) -> Indexed {
    let rgb = |p: &[u8]| [p[0], p[1], p[2]];
    let mut counts: BTreeMap<[u8; 3], usize> = BTreeMap::new();
    for run in pixels.chunks_exact(4).map(rgb).collect::<Vec<_>>().chunk_by(|a, b| a == b) {
        *counts.entry(run[0]).or_default() += run.len();
    }
    let mut palette: Vec<[u8; 3]> = counts.keys().copied().collect();
    palette.sort_by_cached_key(|c| (!inks.contains(c), Reverse(counts[c])));
    palette.truncate(usize::from(most));
    let numbers: BTreeMap<[u8; 3], u8> =
        counts.into_keys().map(|c| (c, nearest(c, &palette))).collect();
    let mut last = ([0; 3], numbers.get(&[0; 3]).copied().unwrap_or(0));
    let number = |p: [u8; 3]| {
        if p != last.0 {
            last = (p, numbers[&p]);
        }
        last.1
    };
    let pixels = pixels.chunks_exact(4).map(rgb).map(number).collect();
    Indexed { palette, pixels }
}

fn nearest(rgb: [u8; 3], palette: &[[u8; 3]]) -> u8 {
    let off =
        |c: &[u8; 3]| -> i32 { (0..3).map(|k| (i32::from(c[k]) - i32::from(rgb[k])).pow(2)).sum() };
    (0..palette.len()).min_by_key(|&k| off(&palette[k])).unwrap_or(0) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_and_inks_stay_what_they_are_and_rare_ones_become_the_nearest() {
        let few = [[0, 0, 0, 255], [255, 255, 255, 255], [200, 10, 10, 255], [0, 0, 0, 255]];
        let seen = indexed(few.as_flattened(), &[], 3);
        let back: Vec<[u8; 3]> =
            seen.pixels.iter().map(|&k| seen.palette[usize::from(k)]).collect();
        assert_eq!(back, few.map(|p| [p[0], p[1], p[2]]));
        // Each of 200 greys twice, an ink once, and once a colour between two greys.
        let greys = (0..200).flat_map(|k| [[k, k, k, 255]; 2]);
        let pixels: Vec<[u8; 4]> = greys.chain([[0, 200, 0, 255], [9, 9, 10, 255]]).collect();
        let seen = indexed(pixels.as_flattened(), &[[0, 200, 0]], 201);
        let last = &seen.pixels[pixels.len() - 2..];
        let last = [0, 1].map(|k: usize| seen.palette[usize::from(last[k])]);
        assert_eq!((seen.palette.len(), last), (201, [[0, 200, 0], [9, 9, 9]]));
    }
}
