//! Numbers as some programs write them, given the point and the digit before it that STEP wants: `2` and `.5` where
//! reals stand.

use super::text::{Draft, Text};
use std::ops::Range;

/// Which parameters of which entities are reals, or lists of them. Of parts of entities the name is not a parameter.
const REALS: [(&str, &[usize]); 17] = [
    ("CARTESIAN_POINT", &[1]),
    ("DIRECTION", &[1]),
    ("VECTOR", &[2]),
    ("CIRCLE", &[2]),
    ("ELLIPSE", &[2, 3]),
    ("PARABOLA", &[2]),
    ("HYPERBOLA", &[2, 3]),
    ("CYLINDRICAL_SURFACE", &[2]),
    ("CONICAL_SURFACE", &[2, 3]),
    ("SPHERICAL_SURFACE", &[2]),
    ("TOROIDAL_SURFACE", &[2, 3]),
    ("DEGENERATE_TOROIDAL_SURFACE", &[2, 3]),
    ("OFFSET_SURFACE", &[2]),
    ("B_SPLINE_CURVE_WITH_KNOTS", &[7]),
    ("B_SPLINE_SURFACE_WITH_KNOTS", &[10, 11]),
    ("COORDINATES_LIST", &[2]),
    ("TRIMMED_CURVE", &[2, 3]),
];
const REALS_OF_PARTS: [(&str, &[usize]); 4] = [
    ("B_SPLINE_CURVE_WITH_KNOTS", &[1]),
    ("B_SPLINE_SURFACE_WITH_KNOTS", &[2, 3]),
    ("RATIONAL_B_SPLINE_CURVE", &[0]),
    ("RATIONAL_B_SPLINE_SURFACE", &[0]),
];

/// The text with its reals written as such; None where they are.
pub(super) fn mended(text: &Text) -> Option<Vec<u8>> {
    let mut draft = Draft::of(text);
    for record in &text.records {
        if record.keyword.is_empty() {
            for (keyword, places) in REALS_OF_PARTS {
                let list = text.part(record, keyword).unwrap_or_default();
                fix(&mut draft, &list, places);
            }
        } else if let Some((_, places)) =
            REALS.iter().find(|(keyword, _)| text.keyword(record) == keyword.as_bytes())
        {
            fix(&mut draft, &text.list(record), places);
        }
    }
    draft.done()
}

fn fix(draft: &mut Draft, list: &[Range<usize>], places: &[usize]) {
    let bytes = &draft.text.bytes;
    for range in places.iter().filter_map(|&k| list.get(k)) {
        for word in words(bytes, range) {
            if let Some(real) = real(&bytes[word.clone()]) {
                draft.put(word, real);
            }
        }
    }
}

/// Runs of what numbers are made of; references and enumerations are none.
fn words<'b>(bytes: &'b [u8], range: &Range<usize>) -> impl Iterator<Item = Range<usize>> + 'b {
    let end = range.end;
    let mut at = range.start;
    std::iter::from_fn(move || {
        let mark = |b: u8| matches!(b, b'(' | b')' | b',') || b.is_ascii_whitespace();
        while at < end && mark(bytes[at]) {
            at += 1;
        }
        let start = at;
        while at < end && !mark(bytes[at]) {
            at += 1;
        }
        (at > start).then_some(start..at)
    })
}

/// The number with its point; None where it has one, or is not a number.
fn real(word: &[u8]) -> Option<String> {
    let digit = |b: Option<&u8>| b.is_some_and(u8::is_ascii_digit);
    let sign = usize::from(matches!(word.first(), Some(b'+' | b'-')));
    let lead = word[sign..].iter().take_while(|b| b.is_ascii_digit()).count();
    let rest = &word[sign + lead..];
    let word = std::str::from_utf8(word).ok()?;
    let (front, back) = word.split_at(sign + lead);
    match rest.first() {
        None | Some(b'e' | b'E') if lead > 0 => Some(format!("{front}.{back}")),
        Some(b'.') if lead == 0 && digit(rest.get(1)) => Some(format!("{front}0{back}")),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_become_reals_where_reals_stand_only() {
        let text = "DATA;#1=CARTESIAN_POINT('2',(0,-1.5, .25));#2=CIRCLE('',#1,3);
#3=B_SPLINE_CURVE_WITH_KNOTS('',1,(#1,#1),.U.,.F.,.F.,(2,2),(0,1E1),.U.);
#4=(B_SPLINE_CURVE(1,(#1,#1))RATIONAL_B_SPLINE_CURVE((1,.5)));ENDSEC;";
        let done = String::from_utf8(mended(&Text::of(text.into())).unwrap()).unwrap();
        assert!(done.contains("('2',(0.,-1.5, 0.25))") && done.contains("#1,3.)"), "{done}");
        assert!(done.contains("1,(#1,#1),.U.,.F.,.F.,(2,2),(0.,1.E1)"), "{done}");
        assert!(done.contains("B_SPLINE_CURVE(1,") && done.contains("((1.,0.5))"), "{done}");
        assert!(mended(&Text::of(done.into())).is_none());
    }
}
