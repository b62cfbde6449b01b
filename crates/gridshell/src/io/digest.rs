//! Digests (FNV-1a) and the identifiers made of them: the same grid has the same identifiers in every file.

use std::fmt;
use std::hash::Hasher;

/// 64 bits, after the FNV Internet-Draft.
pub(super) fn fnv1a_64(bytes: &[u8]) -> u64 {
    let mut quick = Quick::default();
    quick.write(bytes);
    quick.finish()
}

/// The same for tables of short texts of our own.
pub(super) struct Quick(u64);

impl Default for Quick {
    fn default() -> Self {
        Quick(0xcbf2_9ce4_8422_2325)
    }
}

impl Hasher for Quick {
    fn write(&mut self, bytes: &[u8]) {
        let step = |h: u64, b: &u8| (h ^ u64::from(*b)).wrapping_mul(0x0100_0000_01b3);
        self.0 = bytes.iter().fold(self.0, step);
    }

    fn finish(&self) -> u64 {
        self.0
    }
}

/// 128 bits, after the same.
pub(super) fn fnv1a_128(bytes: &[u8]) -> u128 {
    Digest::default().with(bytes).0
}

/// A digest of 128 bits that grows with what is written to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Digest(pub u128);

impl Default for Digest {
    fn default() -> Self {
        Digest(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d)
    }
}

impl Digest {
    /// That of all before and these.
    pub fn with(self, bytes: &[u8]) -> Digest {
        let step = |h: u128, b: &u8| (h ^ u128::from(*b)).wrapping_mul((1 << 88) + 0x13b);
        Digest(bytes.iter().fold(self.0, step))
    }
}

impl fmt::Write for Digest {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        *self = self.with(text.as_bytes());
        Ok(())
    }
}

/// A UUID of version 8 (of our own making, RFC 9562) from a digest.
pub(super) fn uuid(digest: u128) -> String {
    let marked = (digest & !(0xf << 76) & !(0x3 << 62)) | (0x8 << 76) | (0x2 << 62);
    let hex = format!("{marked:032x}");
    format!("{}-{}-{}-{}-{}", &hex[..8], &hex[8..12], &hex[12..16], &hex[16..20], &hex[20..])
}

/// An IFC GlobalId: 128 bits in 22 digits of base 64.
pub(super) struct IfcId(pub u128);

impl fmt::Display for IfcId {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        const DIGITS: &[u8; 64] =
            b"0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$";
        let digits: [u8; 22] =
            std::array::from_fn(|k| DIGITS[(self.0 >> (6 * (21 - k))) as usize & 63]);
        f.write_str(std::str::from_utf8(&digits).unwrap_or_default())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Test vectors of the FNV Internet-Draft.
    #[test]
    fn digests_are_those_of_the_draft() {
        assert_eq!(fnv1a_64(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv1a_64(b"foobar"), 0x8594_4171_f739_67e8);
        assert_eq!(fnv1a_128(b"foobar"), 0x343e_1662_793c_64bf_6f0d_3597_ba44_6f18);
    }

    #[test]
    fn identifiers_have_the_form_that_readers_check() {
        let uuid = uuid(u128::MAX);
        assert_eq!(uuid, "ffffffff-ffff-8fff-bfff-ffffffffffff");
        assert_eq!(IfcId(u128::MAX).to_string(), format!("3{}", "$".repeat(21)));
    }
}
