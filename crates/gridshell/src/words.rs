//! Numbers of things, in words.

/// So many things, of which one is called `noun` and more of them the same with an `s`.
#[must_use]
pub fn counted(n: usize, noun: &str) -> String {
    if n == 1 { format!("{n} {noun}") } else { format!("{n} {noun}s") }
}

/// So many things, with the words for one of them and for more.
#[must_use]
pub fn one_or_more(n: usize, [one, more]: [&str; 2]) -> String {
    format!("{n} {}", if n == 1 { one } else { more })
}
