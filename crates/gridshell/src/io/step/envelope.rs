//! What stands round the data of a STEP file, put as the parser wants it: marks of other encodings, comments, what
//! follows the end, a missing end or header line, data in several sections, entities of the writer's own.

use super::text::{mentions, reference, statements};

const BEGIN: &[u8] = b"ISO-10303-21";
const END: &[u8] = b"END-ISO-10303-21";
/// Lines that a header must have, and what stands in for them.
const HEADER: [(&[u8], &str); 3] = [
    (b"FILE_DESCRIPTION", "FILE_DESCRIPTION((''),'2;1');"),
    (b"FILE_NAME", "FILE_NAME('','',(''),(''),'','','');"),
    (b"FILE_SCHEMA", "FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));"),
];

/// The text as the parser wants it, and what was done for the user to know.
pub(super) fn clean(bytes: Vec<u8>) -> (Vec<u8>, Vec<String>) {
    let mut bytes = plain(bytes);
    let mut notes = Vec::new();
    if !bytes.trim_ascii_start().starts_with(BEGIN) {
        return (bytes, notes);
    }
    blank_comments(&mut bytes);
    let (mut blanks, mut missing) = (Vec::new(), HEADER.map(|(word, _)| word).to_vec());
    let (mut header, mut own, mut sections) = (None, 0, 0);
    let (mut last, mut ended) = (0..0, false);
    for statement in statements(&bytes) {
        let words = &bytes[statement.clone()];
        let of = |word: &[u8]| words.starts_with(word);
        if of(b"#") {
            if users_own(words) {
                own += 1;
                blanks.push(statement.start..statement.end + 1);
            }
        } else if of(END) {
            ended = true;
            last = statement;
            break;
        } else if of(b"HEADER") {
            header = Some(statement.end + 1);
        } else if of(b"DATA") {
            sections += 1;
            if sections > 1 {
                blanks.extend([last.start..last.end + 1, statement.start..statement.end + 1]);
            }
        } else {
            missing.retain(|word| !of(word));
        }
        last = statement;
    }
    if own > 0 {
        notes.push(format!("{own} entities of the writer's own kinds left out"));
    }
    // Behind the end stands a signature, or what a mail program left.
    if ended {
        bytes.truncate(last.end + 1);
    }
    for range in blanks {
        blank(&mut bytes[range]);
    }
    if !ended && sections > 0 && last.end > 0 && complete(&bytes, last.end) {
        notes.push("the file has no end; all that it refers to is there".into());
        let closed = bytes[last.clone()].starts_with(b"ENDSEC");
        bytes.truncate(last.end + 1);
        bytes.extend(if closed { b"".as_slice() } else { b"\nENDSEC;" });
        bytes.extend(b"\nEND-ISO-10303-21;\n");
    }
    if let Some(at) = header.filter(|_| !missing.is_empty()) {
        let lines = HEADER.iter().filter(|(word, _)| missing.contains(word));
        let lines: String = lines.map(|(_, line)| *line).collect();
        bytes.splice(at..at, lines.bytes());
    }
    (bytes, notes)
}

/// Without marks of an encoding; two bytes a character become as many as they need.
fn plain(bytes: Vec<u8>) -> Vec<u8> {
    let wide = |of: fn([u8; 2]) -> u16| -> Vec<u8> {
        let units = bytes[2..].chunks_exact(2).map(|c| of([c[0], c[1]]));
        let text = char::decode_utf16(units).map(|c| c.unwrap_or('?')).collect::<String>();
        text.into_bytes()
    };
    match bytes.as_slice() {
        [0xff, 0xfe, ..] => wide(u16::from_le_bytes),
        [0xfe, 0xff, ..] => wide(u16::from_be_bytes),
        [0xef, 0xbb, 0xbf, rest @ ..] => rest.to_vec(),
        _ => bytes,
    }
}

/// Turn comments into blanks.
fn blank_comments(bytes: &mut [u8]) {
    let (mut at, mut quoted) = (0, false);
    while at + 1 < bytes.len() {
        quoted ^= bytes[at] == b'\'';
        if !quoted && bytes[at..].starts_with(b"/*") {
            let rest = &bytes[at + 2..];
            let Some(length) = rest.windows(2).position(|w| w == b"*/") else { return };
            blank(&mut bytes[at..at + length + 4]);
            at += length + 4;
        } else {
            at += 1;
        }
    }
}

fn blank(bytes: &mut [u8]) {
    for b in bytes.iter_mut().filter(|b| !b.is_ascii_whitespace()) {
        *b = b' ';
    }
}

/// Whether an entity is `#1=!MINE(...)`.
fn users_own(words: &[u8]) -> bool {
    let body = words.iter().position(|&b| b == b'=').map(|k| words[k + 1..].trim_ascii_start());
    body.is_some_and(|body| body.first() == Some(&b'!'))
}

/// Whether nothing but blanks follows the last statement, and all that the statements refer to is there.
fn complete(bytes: &[u8], end: usize) -> bool {
    if !bytes[end + 1..].iter().all(|&b| b.is_ascii_whitespace() || b == 0 || b == 0x1a) {
        return false;
    }
    let (mut there, mut asked) = (Vec::new(), Vec::new());
    for statement in statements(bytes) {
        let words = &bytes[statement];
        let Some(equals) = words.iter().position(|&b| b == b'=') else { continue };
        there.extend(reference(words[..equals].trim_ascii()));
        asked.extend(mentions(&words[equals..]));
    }
    there.sort_unstable();
    !there.is_empty() && asked.iter().all(|id| there.binary_search(id).is_ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str =
        "ISO-10303-21;HEADER;FILE_DESCRIPTION((''),'2;1');FILE_NAME('','',(''),(''),'','','');
FILE_SCHEMA(('X'));ENDSEC;DATA;#1=A('/*');/* #2=B(); */#3=C(#1);ENDSEC;END-ISO-10303-21;";

    fn cleaned(text: &[u8]) -> String {
        String::from_utf8(clean(text.to_vec()).0).unwrap()
    }

    #[test]
    fn comments_and_what_follows_the_end_are_left_out() {
        let text = cleaned(format!("{FILE}\n\u{1a}SIGNATURE;x;").as_bytes());
        assert!(text.ends_with("END-ISO-10303-21;") && text.contains("'/*'"), "{text}");
        assert!(!text.contains("#2"), "{text}");
    }

    #[test]
    fn other_encodings_are_read() {
        let wide: Vec<u8> = FILE.encode_utf16().flat_map(u16::to_le_bytes).collect();
        assert_eq!(cleaned(&[&[0xff, 0xfe], wide.as_slice()].concat()), cleaned(FILE.as_bytes()));
        assert_eq!(cleaned(format!("\u{feff}{FILE}").as_bytes()), cleaned(FILE.as_bytes()));
    }

    #[test]
    fn an_end_is_added_only_where_nothing_is_missing() {
        let (whole, cut) =
            (FILE.replace("END-ISO-10303-21;", ""), FILE.split_at(FILE.len() - 40).0);
        assert!(cleaned(whole.as_bytes()).ends_with("END-ISO-10303-21;\n"));
        assert!(!cleaned(cut.as_bytes()).contains("END-ISO"));
        let dangling = whole.replace("C(#1)", "C(#9)");
        assert!(!cleaned(dangling.as_bytes()).contains("END-ISO"));
    }

    #[test]
    fn header_lines_sections_and_own_entities_are_put_right() {
        let text = FILE.replace("FILE_NAME('','',(''),(''),'','','');", "");
        assert!(cleaned(text.as_bytes()).contains("HEADER;FILE_NAME("));
        let text = FILE.replace("#3=", "ENDSEC;DATA;#4=!MINE('x');#3=");
        let text = cleaned(text.as_bytes());
        assert_eq!(text.matches("DATA;").count(), 1, "{text}");
        assert!(!text.contains("MINE") && text.contains("#3=C(#1)"), "{text}");
    }
}
