//! Digests (FNV-1a) and the identifiers made of them: the same grid has the same identifiers in every file.

/// 64 bits, after the FNV Internet-Draft.
pub(super) fn fnv1a_64(bytes: &[u8]) -> u64 {
    let step = |h: u64, b: &u8| (h ^ u64::from(*b)).wrapping_mul(0x0100_0000_01b3);
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, step)
}

/// 128 bits, after the same.
pub(super) fn fnv1a_128(bytes: &[u8]) -> u128 {
    let step = |h: u128, b: &u8| (h ^ u128::from(*b)).wrapping_mul((1 << 88) + 0x13b);
    bytes.iter().fold(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d, step)
}

/// A UUID of version 8 (of our own making, RFC 9562) from a digest.
pub(super) fn uuid(digest: u128) -> String {
    let marked = (digest & !(0xf << 76) & !(0x3 << 62)) | (0x8 << 76) | (0x2 << 62);
    let hex = format!("{marked:032x}");
    format!("{}-{}-{}-{}-{}", &hex[..8], &hex[8..12], &hex[12..16], &hex[16..20], &hex[20..])
}

/// An IFC GlobalId: 128 bits in 22 digits of base 64.
pub(super) fn ifc_id(digest: u128) -> String {
    const DIGITS: &[u8; 64] = b"0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$";
    (0..22).rev().map(|k| DIGITS[(digest >> (6 * k)) as usize & 63] as char).collect()
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
        assert_eq!(ifc_id(u128::MAX), format!("3{}", "$".repeat(21)));
    }
}
