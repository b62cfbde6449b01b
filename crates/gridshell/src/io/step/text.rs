//! The statements of a STEP file's text, found without knowing what they mean, and changes to them.
//!
//! What the parser does not know, and what writers get wrong, is put into words that it knows before it reads them.
//! Lines stay where they are, so that errors name the right ones; what is new comes after the last of the data.

use std::ops::Range;

/// A STEP file's text and the entities in it.
pub(super) struct Text {
    pub bytes: Vec<u8>,
    pub records: Vec<Record>,
    /// Identifiers in order, with their places in `records`.
    by_id: Vec<(u64, u32)>,
    /// Where new entities go: before the `ENDSEC` of the last data.
    end: Option<usize>,
}

/// `#id = KEYWORD(...)`, or `#id = (A(...) B(...))` without a keyword of its own.
#[derive(Clone, Debug)]
pub(super) struct Record {
    pub id: u64,
    pub keyword: Range<usize>,
    /// From the parenthesis behind the keyword to the one that closes it.
    pub list: Range<usize>,
}

impl Text {
    pub fn of(bytes: Vec<u8>) -> Text {
        let (mut records, mut end) = (Vec::new(), None);
        for statement in statements(&bytes) {
            let words = &bytes[statement.clone()];
            if words.first() == Some(&b'#') {
                records.extend(record(&bytes, &statement));
            } else if words.starts_with(b"ENDSEC") && !records.is_empty() {
                end = Some(statement.start);
            }
        }
        let mut by_id: Vec<(u64, u32)> = records.iter().map(|r| r.id).zip(0..).collect();
        if !by_id.is_sorted() {
            by_id.sort_unstable();
        }
        Text { bytes, records, by_id, end }
    }

    /// The entity of this identifier.
    pub fn get(&self, id: u64) -> Option<&Record> {
        let k = self.by_id.binary_search_by_key(&id, |&(id, _)| id).ok()?;
        Some(&self.records[self.by_id[k].1 as usize])
    }

    pub fn keyword(&self, record: &Record) -> &[u8] {
        &self.bytes[record.keyword.clone()]
    }

    /// Whether any entity has one of these keywords.
    pub fn has(&self, keywords: &[&str]) -> bool {
        self.records.iter().any(|r| keywords.iter().any(|k| self.keyword(r) == k.as_bytes()))
    }

    /// The parameters of an entity; of one made of parts, its parts.
    pub fn list(&self, record: &Record) -> Vec<Range<usize>> {
        split(&self.bytes, &record.list)
    }

    pub fn words(&self, range: &Range<usize>) -> &[u8] {
        self.bytes[range.clone()].trim_ascii()
    }

    /// What parameter `k` of an entity refers to.
    pub fn target(&self, record: &Record, k: usize) -> Option<&Record> {
        let list = self.list(record);
        self.get(reference(self.words(list.get(k)?))?)
    }

    /// The numbers in a parameter such as `(1.,2.,3.)`.
    pub fn numbers(&self, range: &Range<usize>) -> Option<Vec<f64>> {
        split(&self.bytes, range).iter().map(|part| number(self.words(part))).collect()
    }

    /// The three coordinates of a point or direction.
    pub fn xyz(&self, record: &Record) -> Option<[f64; 3]> {
        let known = [b"CARTESIAN_POINT".as_slice(), b"DIRECTION"].contains(&self.keyword(record));
        let list = if known { self.list(record) } else { return None };
        let n = self.numbers(list.get(1)?)?;
        (n.len() == 3).then(|| [n[0], n[1], n[2]])
    }

    /// The part with this keyword of an entity made of parts.
    pub fn part(&self, record: &Record, keyword: &str) -> Option<Vec<Range<usize>>> {
        if !record.keyword.is_empty() {
            return None;
        }
        let parts = parts(&self.bytes, &record.list);
        let found = parts.into_iter().find(|(name, _)| self.words(name) == keyword.as_bytes())?;
        Some(split(&self.bytes, &found.1))
    }
}

/// Changes to a text while they are gathered.
pub(super) struct Draft<'t> {
    pub text: &'t Text,
    changes: Vec<(Range<usize>, String)>,
    added: String,
    next: u64,
}

impl<'t> Draft<'t> {
    pub fn of(text: &'t Text) -> Draft<'t> {
        let next = text.by_id.last().map_or(1, |&(id, _)| id.saturating_add(1));
        Draft { text, changes: Vec::new(), added: String::new(), next }
    }

    /// Put other words in a place; places must not overlap.
    pub fn put(&mut self, range: Range<usize>, words: impl Into<String>) {
        self.changes.push((range, words.into()));
    }

    /// Put another entity in the place of one.
    pub fn replace(&mut self, record: &Record, body: impl Into<String>) {
        self.put(record.keyword.start..record.list.end, body);
    }

    /// Add an entity; its identifier.
    pub fn add(&mut self, body: &str) -> u64 {
        let id = self.next;
        self.next = self.next.saturating_add(1);
        self.added.push_str(&format!("#{id}={body};\n"));
        id
    }

    /// The changed text; None where nothing is changed, or there is no room for it.
    pub fn done(mut self) -> Option<Vec<u8>> {
        if self.changes.is_empty() && self.added.is_empty() || self.next == u64::MAX {
            return None;
        }
        let end = self.text.end?;
        self.changes.push((end..end, self.added));
        self.changes.sort_by_key(|(range, _)| range.start);
        let bytes = &self.text.bytes;
        let mut out = Vec::with_capacity(bytes.len() + self.changes.len() * 16);
        let mut at = 0;
        for (range, words) in self.changes {
            if range.start < at {
                continue;
            }
            out.extend(&bytes[at..range.start]);
            out.extend(words.bytes());
            // As many lines as before.
            let lines = |b: &[u8]| b.split(|&c| c == b'\n').count();
            let (was, is) = (lines(&bytes[range.clone()]), lines(words.as_bytes()));
            out.extend(std::iter::repeat_n(b'\n', was.saturating_sub(is)));
            at = range.end;
        }
        out.extend(&bytes[at..]);
        Some(out)
    }
}

/// `(#1,#2)`.
pub(super) fn list_of(ids: &[u64]) -> String {
    let ids: Vec<String> = ids.iter().map(|id| format!("#{id}")).collect();
    format!("({})", ids.join(","))
}

/// A number as STEP writes it: with a point.
pub(super) fn real(x: f64) -> String {
    let plain = format!("{x:?}");
    match plain.split_once('e') {
        Some((mantissa, power)) if !mantissa.contains('.') => format!("{mantissa}.E{power}"),
        Some((mantissa, power)) => format!("{mantissa}E{power}"),
        None => plain,
    }
}

/// `CARTESIAN_POINT` or `DIRECTION` with these coordinates.
pub(super) fn triple(keyword: &str, p: [f64; 3]) -> String {
    let [x, y, z] = p.map(real);
    format!("{keyword}('',({x},{y},{z}))")
}

/// The identifier in `#12`.
pub(super) fn reference(words: &[u8]) -> Option<u64> {
    std::str::from_utf8(words.strip_prefix(b"#")?).ok()?.trim().parse().ok()
}

/// The identifiers in a list such as `(#1,#2)`.
pub(super) fn references(text: &Text, range: &Range<usize>) -> Vec<u64> {
    split(&text.bytes, range).iter().filter_map(|r| reference(text.words(r))).collect()
}

/// Every `#12` outside strings.
pub(super) fn mentions(words: &[u8]) -> impl Iterator<Item = u64> + '_ {
    let mut quoted = false;
    words.iter().enumerate().filter_map(move |(k, &b)| {
        quoted ^= b == b'\'';
        let digits = words[k + 1..].iter().take_while(|b| b.is_ascii_digit()).count();
        if b == b'#' && !quoted { reference(&words[k..=k + digits]) } else { None }
    })
}

pub(super) fn number(words: &[u8]) -> Option<f64> {
    std::str::from_utf8(words).ok()?.parse().ok().filter(|x: &f64| x.is_finite())
}

/// The statements up to their semicolons, blanks before them left out.
pub(super) fn statements(bytes: &[u8]) -> impl Iterator<Item = Range<usize>> + '_ {
    let mut at = 0;
    std::iter::from_fn(move || {
        at += bytes[at..].iter().take_while(|b| b.is_ascii_whitespace()).count();
        let start = at;
        let mut quoted = false;
        while let Some(&b) = bytes.get(at) {
            at += 1;
            quoted ^= b == b'\'';
            if b == b';' && !quoted {
                return Some(start..at - 1);
            }
        }
        None
    })
}

/// The entity in a statement that begins with `#`.
fn record(bytes: &[u8], statement: &Range<usize>) -> Option<Record> {
    let words = &bytes[statement.clone()];
    let equals = words.iter().position(|&b| b == b'=')?;
    let id = reference(words[..equals].trim_ascii())?;
    let open = equals + words[equals..].iter().position(|&b| b == b'(')?;
    let close = words.iter().rposition(|&b| b == b')')?;
    let from =
        equals + 1 + words[equals + 1..].iter().take_while(|b| b.is_ascii_whitespace()).count();
    let name = words[from..open.max(from)].trim_ascii_end().len();
    let at = |k: usize| statement.start + k;
    (close > open).then(|| Record {
        id,
        keyword: at(from)..at(from + name),
        list: at(open)..at(close + 1),
    })
}

/// What stands between the commas of a list; nothing of what is not a list.
fn split(bytes: &[u8], list: &Range<usize>) -> Vec<Range<usize>> {
    let trimmed = bytes[list.clone()].trim_ascii_start();
    let from = list.end - trimmed.len();
    if trimmed.first() != Some(&b'(') {
        return Vec::new();
    }
    let (mut parts, mut depth, mut quoted, mut start) = (Vec::new(), 0_usize, false, from + 1);
    for k in from..list.end {
        quoted ^= bytes[k] == b'\'';
        match bytes[k] {
            _ if quoted => {}
            b'(' => depth += 1,
            b')' => {
                depth = depth.saturating_sub(1);
                if depth == 0 {
                    if !(parts.is_empty() && bytes[start..k].trim_ascii().is_empty()) {
                        parts.push(start..k);
                    }
                    return parts;
                }
            }
            b',' if depth == 1 => {
                parts.push(start..k);
                start = k + 1;
            }
            _ => {}
        }
    }
    parts
}

/// Names and lists of the parts of `(A(...) B(...))`.
fn parts(bytes: &[u8], list: &Range<usize>) -> Vec<(Range<usize>, Range<usize>)> {
    let (mut parts, mut depth, mut quoted) = (Vec::new(), 0_usize, false);
    let (mut name, mut open) = (list.start + 1, list.start);
    for k in list.start + 1..list.end {
        quoted ^= bytes[k] == b'\'';
        match bytes[k] {
            _ if quoted => {}
            b'(' => {
                if depth == 0 {
                    open = k;
                }
                depth += 1;
            }
            b')' if depth > 0 => {
                depth -= 1;
                if depth == 0 {
                    parts.push((name..open, open..k + 1));
                    name = k + 1;
                }
            }
            _ => {}
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entities_are_found_with_their_parts_whatever_their_names_hold() {
        let text = Text::of(
            b"ISO;DATA;\n#7 = PLANE ('a;(,)''#1', #3 , (1.,2.) ) ;#3=(A()B('x',(#7)));\nENDSEC;"
                .to_vec(),
        );
        assert_eq!(text.records.len(), 2);
        let plane = text.get(7).unwrap();
        assert_eq!(text.keyword(plane), b"PLANE");
        let list = text.list(plane);
        assert_eq!(list.len(), 3);
        assert_eq!(text.target(plane, 1).unwrap().id, 3);
        assert_eq!(text.numbers(&list[2]), Some(vec![1.0, 2.0]));
        let part = text.part(text.get(3).unwrap(), "B").unwrap();
        assert_eq!(references(&text, &part[1]), [7]);
    }

    #[test]
    fn lines_stay_where_they_are() {
        let text = Text::of(b"DATA;\n#1=A(\n1,\n2);\n#2=B(#1);\nENDSEC;".to_vec());
        let mut draft = Draft::of(&text);
        let id = draft.add("C()");
        draft.replace(text.get(1).unwrap(), "D()");
        let done = String::from_utf8(draft.done().unwrap()).unwrap();
        assert_eq!(id, 3);
        assert_eq!(done, "DATA;\n#1=D()\n\n;\n#2=B(#1);\n#3=C();\nENDSEC;");
    }

    #[test]
    fn numbers_are_written_with_a_point() {
        for (x, s) in [(1.0, "1.0"), (1e-9, "1.E-9".to_lowercase().as_str()), (2.5e30, "2.5E30")] {
            assert!(real(x).eq_ignore_ascii_case(s), "{}", real(x));
            assert_eq!(number(real(x).as_bytes()), Some(x));
        }
    }
}
