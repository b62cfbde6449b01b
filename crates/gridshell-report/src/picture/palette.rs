//! Pixels by the numbers of at most 256 colours: drawings have few, and mixtures of them at the rims of lines. Such files are
//! a third as large.

use std::collections::BTreeMap;

/// The colours, and the number of each pixel's, row by row.
pub struct Indexed {
    pub palette: Vec<[u8; 3]>,
    pub pixels: Vec<u8>,
}

/// The pixels (red, green, blue, alpha, opaque) in at most `most` colours: these inks, then one after another the colour
/// whose pixels would be furthest off together, in squares. Others take the nearest of these.
pub fn indexed(pixels: &[u8], inks: &[[u8; 3]], most: u8) -> Indexed {
    let rgb = |p: &[u8]| [p[0], p[1], p[2]];
    let mut counts: BTreeMap<[u8; 3], usize> = BTreeMap::new();
    for run in pixels.chunks_exact(4).map(rgb).collect::<Vec<_>>().chunk_by(|a, b| a == b) {
        *counts.entry(run[0]).or_default() += run.len();
    }
    let inks: Vec<[u8; 3]> = inks.iter().copied().filter(|ink| counts.contains_key(ink)).collect();
    let mut inks = inks.into_iter();
    let mut colours: Vec<Colour> = counts
        .into_iter()
        .map(|(rgb, count)| Colour { rgb, count, nearest: 0, off: NOT_YET })
        .collect();
    let mut palette: Vec<[u8; 3]> = Vec::new();
    while palette.len() < usize::from(most) {
        let worst = colours.iter().filter(|c| c.off > 0).max_by_key(|c| c.count * c.off);
        let Some(rgb) = inks.next().or(worst.map(|c| c.rgb)) else { break };
        for c in &mut colours {
            let off = square_off(c.rgb, rgb);
            if off < c.off {
                (c.nearest, c.off) = (palette.len() as u8, off);
            }
        }
        palette.push(rgb);
    }
    let numbers: BTreeMap<[u8; 3], u8> = colours.iter().map(|c| (c.rgb, c.nearest)).collect();
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

/// Of no colour in the palette so far; the square of how far black is from white is less.
const NOT_YET: usize = 1 << 20;

struct Colour {
    rgb: [u8; 3],
    /// Pixels that have it.
    count: usize,
    /// Number of the nearest in the palette, and how far off that is, squared.
    nearest: u8,
    off: usize,
}

fn square_off(a: [u8; 3], b: [u8; 3]) -> usize {
    (0..3).map(|k| usize::from(a[k].abs_diff(b[k])).pow(2)).sum()
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

    /// The discs at nodes of seven members were grey: many greys of the light on panels had more pixels than their orange.
    #[test]
    fn a_rare_colour_unlike_all_others_stays_what_it_is() {
        let greys = (0..200).flat_map(|k| [[k, k, k, 255]; 100]);
        let pixels: Vec<[u8; 4]> = greys.chain([[230, 120, 0, 255]]).collect();
        let seen = indexed(pixels.as_flattened(), &[], 20);
        let last = seen.palette[usize::from(seen.pixels[pixels.len() - 1])];
        assert_eq!((seen.palette.len(), last), (20, [230, 120, 0]));
        let off = |(p, &k): (&[u8; 4], &u8)| p[0].abs_diff(seen.palette[usize::from(k)][0]);
        assert!(pixels.iter().zip(&seen.pixels).map(off).max() <= Some(16));
    }
}
