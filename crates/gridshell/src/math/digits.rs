//! Numbers as people write them: as many digits as tell something, whatever the size.

/// Sizes that are written out; others take a power of ten.
const PLAIN: std::ops::Range<f64> = 1e-3..1e7;

/// A quantity to three significant digits: `0.00123`, `12.3`, `1234`, `4.56e-9`.
pub fn three(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    if !PLAIN.contains(&x.abs()) {
        return format!("{x:.2e}");
    }
    let decimals = (0..6).find(|&d| x.abs() * 10f64.powi(d) >= 99.95).unwrap_or(6) as usize;
    format!("{x:.decimals$}")
}

/// So many decimals, and for what is smaller than one as many more as show as many digits: `100.000`, `0.000123`.
pub fn at_least(decimals: usize, x: f64) -> String {
    let seen =
        |d: &usize| x == 0.0 || x.abs() * 10f64.powi(*d as i32) >= 10f64.powi(decimals as i32 - 1);
    let decimals = (decimals..16).find(seen).unwrap_or(16);
    format!("{x:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_and_large_numbers_keep_digits_that_tell_something() {
        let told = [
            (0.0, "0"),
            (3.2e-8, "3.20e-8"),
            (0.00123456, "0.00123"),
            (0.0999, "0.0999"),
            (1.0, "1.00"),
            (99.96, "100"),
            (-12.345, "-12.3"),
            (1234.5, "1234"),
            (3e9, "3.00e9"),
        ];
        for (x, text) in told {
            assert_eq!(three(x), text);
        }
        for (x, text) in
            [(0.0, "0.000"), (1e-6, "0.00000100"), (0.02, "0.0200"), (99.98765, "99.988")]
        {
            assert_eq!(at_least(3, x), text);
        }
    }
}
