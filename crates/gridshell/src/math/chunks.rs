//! Sums and sweeps over long arrays, in pieces of a fixed size: the same bits for any number of threads.

use rayon::prelude::*;
use std::ops::Range;

/// Entries in a piece. Shorter arrays are worked on by one thread: waking another takes longer.
pub(crate) const CHUNK: usize = 4096;

/// The sum of `part` over the pieces of `0..n`, added up in their order.
pub(crate) fn sum(n: usize, part: impl Fn(Range<usize>) -> f64 + Sync) -> f64 {
    if n <= CHUNK {
        return part(0..n);
    }
    let pieces = (0..n.div_ceil(CHUNK)).into_par_iter();
    let parts: Vec<f64> = pieces.map(|c| part(c * CHUNK..((c + 1) * CHUNK).min(n))).collect();
    parts.iter().sum()
}

/// Run `work` on the pieces of `array`, each with the index of its first entry.
pub(crate) fn sweep<T: Send>(array: &mut [T], work: impl Fn(usize, &mut [T]) + Sync) {
    if array.len() <= CHUNK {
        return work(0, array);
    }
    array.par_chunks_mut(CHUNK).enumerate().for_each(|(c, piece)| work(c * CHUNK, piece));
}

/// An array of `n` entries, each made from its index.
pub(crate) fn collect<T: Send>(n: usize, entry: impl Fn(usize) -> T + Sync) -> Vec<T> {
    if n <= CHUNK {
        return (0..n).map(entry).collect();
    }
    (0..n).into_par_iter().with_min_len(CHUNK).map(&entry).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_entry_is_counted_once() {
        for n in [0, 1, CHUNK, CHUNK + 1, 5 * CHUNK + 7] {
            let total = sum(n, |r| r.map(|i| i as f64).sum());
            assert_eq!(total, (n * n.saturating_sub(1) / 2) as f64);
            let mut array = collect(n, |i| i);
            sweep(&mut array, |first, piece| {
                for (k, x) in piece.iter_mut().enumerate() {
                    assert_eq!(*x, first + k);
                    *x += 1;
                }
            });
            assert_eq!(array.iter().sum::<usize>(), n * (n + 1) / 2);
        }
    }
}
