//! A file made wrong in a few places, as transfers, editors and faulty exporters do.

use fastrand::Rng;

/// Numbers that do harm.
const HARMFUL: [&str; 12] = [
    "0",
    "-1",
    "65536",
    "-65536.",
    "1e6",
    "1e-9",
    "1e300",
    "-1e-300",
    "nan",
    "inf",
    "4294967296",
    "1.E+99",
];
/// Places damaged at most.
const MOST: usize = 3;

/// `bytes` with some damage, drawn by `seed`.
pub fn damaged(bytes: &[u8], seed: u64) -> Vec<u8> {
    let mut rng = Rng::with_seed(seed ^ 0xDA4A_6E00);
    let mut bytes = bytes.to_vec();
    for _ in 0..rng.usize(1..=MOST) {
        if bytes.len() > 2 {
            damage(&mut bytes, &mut rng);
        }
    }
    bytes
}

fn damage(bytes: &mut Vec<u8>, rng: &mut Rng) {
    let at = rng.usize(0..bytes.len());
    match rng.u8(0..10) {
        0 => bytes[at] ^= 1 << rng.u8(0..8),
        1 => bytes.truncate(at),
        2 => {
            let end = (at + rng.usize(1..200)).min(bytes.len());
            bytes.drain(at..end);
        }
        3 => {
            let end = (at + rng.usize(1..200)).min(bytes.len());
            let copy = bytes[at..end].to_vec();
            bytes.splice(at..at, copy);
        }
        _ => {
            let number = |b: &u8| b.is_ascii_digit() || b".-+eE".contains(b);
            let Some(start) = (at..bytes.len()).find(|&i| bytes[i].is_ascii_digit()) else {
                return;
            };
            let end = start + bytes[start..].iter().take_while(|b| number(b)).count();
            bytes.splice(start..end, rng.choice(HARMFUL).unwrap_or("0").bytes());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn same_seed_does_the_same_damage() {
        let file = b"v 1.5 2.5 0\nv 2 3 4\nf 1 2 3\n".repeat(20);
        assert_eq!(damaged(&file, 7), damaged(&file, 7));
        assert!((0..50).filter(|&s| damaged(&file, s) != file).count() > 40);
    }
}
