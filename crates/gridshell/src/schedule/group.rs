//! Groups of elements that can be made alike.

use std::collections::BTreeMap;

/// The group of each value, from 0 for the smallest values: within a group they differ by at most `tolerance`, and
/// there are as few groups as that allows (each begins at the least value that no group before it holds).
pub fn groups_within(values: &[f64], tolerance: f64) -> Vec<u32> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]).then(a.cmp(&b)));
    let mut groups = vec![0; values.len()];
    let Some(&first) = order.first() else { return groups };
    let (mut group, mut least) = (0, values[first]);
    for i in order {
        // A hair more, so that equal lengths do not part by rounding where the tolerance is 0.
        if values[i] - least > tolerance + 1e-12 * least.abs() {
            group += 1;
            least = values[i];
        }
        groups[i] = group;
    }
    groups
}

/// The group of each element: equal keys are one group, numbered as they appear.
pub(super) fn groups_of<K: Ord>(keys: impl Iterator<Item = K>) -> Vec<u32> {
    let mut known: BTreeMap<K, u32> = BTreeMap::new();
    keys.map(|key| {
        let next = known.len() as u32;
        *known.entry(key).or_insert(next)
    })
    .collect()
}

/// The least of all cyclic turns of a list, so that lists that are turns of one another become the same.
pub(super) fn turned_to_least<T: Ord + Clone>(list: &[T]) -> Vec<T> {
    let turn = |k: usize| [&list[k..], &list[..k]].concat();
    (0..list.len()).map(turn).min().unwrap_or_default()
}

/// Number of groups in a list of group numbers without gaps.
pub(super) fn count(groups: &[u32]) -> usize {
    groups.iter().max().map_or(0, |&g| g as usize + 1)
}
