//! Bytes as text, whichever program wrote them: byte order marks, UTF-16, and lines that end as on old Macs.

use std::borrow::Cow;

/// The text in these bytes. Names and comments may be in any encoding, so what is not UTF-8 is replaced; numbers are
/// ASCII.
pub(super) fn decode(bytes: &[u8]) -> Cow<'_, str> {
    let text = match bytes {
        [0xEF, 0xBB, 0xBF, rest @ ..] => String::from_utf8_lossy(rest),
        [0xFF, 0xFE, rest @ ..] => Cow::Owned(wide(rest, u16::from_le_bytes)),
        [0xFE, 0xFF, rest @ ..] => Cow::Owned(wide(rest, u16::from_be_bytes)),
        _ => String::from_utf8_lossy(bytes),
    };
    if text.contains('\r') && !text.contains('\n') {
        return Cow::Owned(text.replace('\r', "\n"));
    }
    text
}

fn wide(bytes: &[u8], unit: impl Fn([u8; 2]) -> u16) -> String {
    let units = bytes.chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
    char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_cut_off_and_wide_letters_and_old_line_ends_understood() {
        for bytes in [
            &b"v 1\nf"[..],
            b"\xEF\xBB\xBFv 1\nf",
            b"\xFF\xFEv\0 \x001\0\n\0f\0",
            b"\xFE\xFF\0v\0 \x001\0\n\0f",
            b"v 1\rf",
        ] {
            assert_eq!(decode(bytes), "v 1\nf", "{bytes:?}");
        }
        assert_eq!(decode(b"v 1\r\nf"), "v 1\r\nf");
    }
}
