//! Rectangular trimmed surfaces, which the parser does not know, replaced by the surfaces that they trim.
//!
//! A face's own loops bound it, so the rectangle says nothing that is needed. Done in the text: every mention
//! of the trimmed surface becomes one of its basis.

const KEYWORD: &[u8] = b"RECTANGULAR_TRIMMED_SURFACE";
/// Trimmed surfaces of trimmed surfaces are followed this far.
const MOST_LEVELS: usize = 8;

/// The text without mentions of rectangular trimmed surfaces.
pub(super) fn without(text: Vec<u8>) -> Vec<u8> {
    let mut bases: Vec<(u64, u64)> = text
        .windows(KEYWORD.len())
        .enumerate()
        .filter(|w| w.1 == KEYWORD)
        .filter_map(|w| pair(&text, w.0))
        .collect();
    if bases.is_empty() {
        return text;
    }
    bases.sort_unstable();
    let basis = |id: u64| bases.binary_search_by_key(&id, |b| b.0).ok().map(|k| bases[k].1);
    let mut out = Vec::with_capacity(text.len());
    let mut quoted = false;
    let mut at = 0;
    while at < text.len() {
        quoted ^= text[at] == b'\'';
        out.push(text[at]);
        at += 1;
        if quoted || text[at - 1] != b'#' {
            continue;
        }
        let end = at + digits(&text[at..]);
        let defined = after_blanks(&text, end) == Some(b'=');
        let known = number(&text[at..end]).filter(|_| !defined).and_then(basis);
        if let Some(mut id) = known {
            for _ in 0..MOST_LEVELS {
                id = basis(id).unwrap_or(id);
            }
            out.extend(id.to_string().bytes());
            at = end;
        }
    }
    out
}

/// The number of the entity whose keyword stands at `at`, and that of its basis.
fn pair(text: &[u8], at: usize) -> Option<(u64, u64)> {
    let head = text[..at].trim_ascii_end().strip_suffix(b"=")?.trim_ascii_end();
    let from = head.iter().rposition(|&b| b == b'#')?;
    // After the name, which is quoted and may hold anything, or left out.
    let rest = text[at + KEYWORD.len()..].trim_ascii_start().strip_prefix(b"(")?;
    let mut quoted = false;
    let comma = rest.iter().position(|&b| {
        quoted ^= b == b'\'';
        !quoted && b == b','
    })?;
    let basis = rest[comma + 1..].trim_ascii_start().strip_prefix(b"#")?;
    Some((number(&head[from + 1..])?, number(&basis[..digits(basis)])?))
}

fn digits(text: &[u8]) -> usize {
    text.iter().take_while(|b| b.is_ascii_digit()).count()
}

fn number(text: &[u8]) -> Option<u64> {
    std::str::from_utf8(text).ok()?.parse().ok()
}

fn after_blanks(text: &[u8], from: usize) -> Option<u8> {
    text[from..].iter().copied().find(|b| !b.is_ascii_whitespace())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mentions_become_those_of_the_basis() {
        let text = "#7 = RECTANGULAR_TRIMMED_SURFACE('a,#9', #12,0.,1.,0.,1.,.T.,.T.);\n\
                    #8=RECTANGULAR_TRIMMED_SURFACE('',#7,0.,1.,0.,1.,.T.,.T.);\n\
                    #9=OFFSET_SURFACE('#8',#8,0.5,.F.);#70=PLANE('',#71);";
        let done = String::from_utf8(without(text.into())).unwrap();
        assert!(done.contains("#9=OFFSET_SURFACE('#8',#12,0.5,.F.);#70=PLANE('',#71);"), "{done}");
        assert!(done.starts_with("#7 = RECT"), "{done}");
    }

    #[test]
    fn cut_off_text_is_left_alone() {
        for text in [
            "",
            "RECTANGULAR_TRIMMED_SURFACE",
            "#1=RECTANGULAR_TRIMMED_SURFACE('",
            "=RECTANGULAR_TRIMMED_SURFACE('',#",
        ] {
            assert_eq!(without(text.into()), text.as_bytes());
        }
    }
}
