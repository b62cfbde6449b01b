//! What runs warned of.

use std::fmt;

/// Something that a run warned of.
pub struct Trouble {
    /// The surface's name.
    pub surface: String,
    /// The seed of the run.
    pub seed: u64,
    /// What it is, with its place if it has one.
    pub what: String,
}

impl fmt::Display for Trouble {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}, seed {}: {}", self.surface, self.seed, self.what)
    }
}

/// A line for each kind of trouble, wherever and however often it was met.
pub fn summary(troubles: &[Trouble]) -> Vec<String> {
    let mut kinds: Vec<(&str, Vec<(&str, usize)>)> = Vec::new();
    for trouble in troubles {
        let surfaces = entry(&mut kinds, without_place(&trouble.what));
        *entry(surfaces, &trouble.surface) += 1;
    }
    let line = |(what, surfaces): (&str, Vec<(&str, usize)>)| {
        let counted = surfaces.iter().map(|&(surface, count)| match count {
            1 => surface.to_owned(),
            _ => format!("{surface} ({count} times)"),
        });
        format!("{}: {what}", counted.collect::<Vec<_>>().join(", "))
    };
    kinds.into_iter().map(line).collect()
}

/// The value of this key, in the order in which keys were met.
fn entry<'a, 'b, T: Default>(list: &'b mut Vec<(&'a str, T)>, key: &'a str) -> &'b mut T {
    let at = list.iter().position(|(k, _)| *k == key).unwrap_or_else(|| {
        list.push((key, T::default()));
        list.len() - 1
    });
    &mut list[at].1
}

fn without_place(what: &str) -> &str {
    let rest = what.strip_prefix("near (").and_then(|rest| rest.split_once(") "));
    rest.map_or(what, |(_, what)| what)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn troubles_that_differ_by_seed_or_place_are_counted() {
        let trouble = |surface: &str, seed, what: &str| Trouble {
            surface: surface.to_owned(),
            seed,
            what: what.to_owned(),
        };
        let troubles = [
            trouble("sail", 1, "near (1.0, 2.0, -3.0) it is narrow"),
            trouble("sail", 2, "near (4.0, 5.0, 6.0) it is narrow"),
            trouble("sail", 2, "2 folded panels"),
            trouble("dome", 1, "near (0.0, 0.0, 0.0) it is narrow"),
        ];
        let wanted = ["sail (2 times), dome: it is narrow", "sail: 2 folded panels"];
        assert_eq!(summary(&troubles), wanted);
        assert_eq!(troubles[2].to_string(), "sail, seed 2: 2 folded panels");
    }
}
