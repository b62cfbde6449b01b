//! What a carrier edge lies on: a model edge, a feature, both, or neither.

use std::collections::BTreeMap;

/// What one carrier edge lies on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::surface) struct Track {
    /// Index into [`Surface::curves`](crate::surface::Surface::curves), or `u32::MAX` where there is no exact curve.
    pub(in crate::surface) curve: u32,
    /// Curve parameters at the two ends.
    pub(in crate::surface) t: [f64; 2],
    /// Whether members are to follow it.
    pub(in crate::surface) feature: bool,
}

/// The carrier edges that lie on something, by their vertices, the lower one first.
#[derive(Clone, Debug, Default)]
pub(in crate::surface) struct Tracks(BTreeMap<(u32, u32), Track>);

impl Track {
    /// On a curve, no feature.
    pub(in crate::surface) fn of_curve(curve: u32, t: [f64; 2]) -> Track {
        Track { curve, t, feature: false }
    }

    /// A feature without a curve: on a mesh the carrier is exact as it stands.
    pub(in crate::surface) fn of_mesh() -> Track {
        Track { curve: u32::MAX, t: [0.0, 0.0], feature: true }
    }

    /// As seen from the other end.
    fn reversed(self) -> Track {
        Track { t: [self.t[1], self.t[0]], ..self }
    }
}

impl Tracks {
    /// None yet.
    pub(in crate::surface) fn new() -> Tracks {
        Tracks::default()
    }

    /// Say what the edge from `a` to `b` lies on. What it lies on already stays.
    pub(in crate::surface) fn lay(&mut self, a: u32, b: u32, track: Track) {
        let (key, track) = if a < b { ((a, b), track) } else { ((b, a), track.reversed()) };
        let laid = self.0.entry(key).or_insert(track);
        laid.feature |= track.feature;
    }

    /// What the edge from `a` to `b` lies on.
    pub(in crate::surface) fn get(&self, a: u32, b: u32) -> Option<Track> {
        if a < b { self.0.get(&(a, b)).copied() } else { self.0.get(&(b, a)).map(|t| t.reversed()) }
    }

    /// Take an edge out.
    pub(in crate::surface) fn lift(&mut self, a: u32, b: u32) {
        self.0.remove(&(a.min(b), a.max(b)));
    }

    /// The edge is not a feature any more.
    pub(in crate::surface) fn unmark(&mut self, a: u32, b: u32) {
        if let Some(track) = self.0.get_mut(&(a.min(b), a.max(b))) {
            track.feature = false;
        }
    }

    /// The exact curve behind the edge from `a` to `b` with its parameters there.
    pub(in crate::surface) fn curve_of(&self, a: u32, b: u32) -> Option<(u32, f64, f64)> {
        let track = self.get(a, b).filter(|t| t.curve != u32::MAX)?;
        Some((track.curve, track.t[0], track.t[1]))
    }

    /// All edges in order, lower vertex first.
    pub(in crate::surface) fn iter(&self) -> impl Iterator<Item = ((u32, u32), Track)> + '_ {
        self.0.iter().map(|(&edge, &track)| (edge, track))
    }

    /// The edges that members are to follow, in order.
    pub(in crate::surface) fn features(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        self.0.iter().filter(|(_, track)| track.feature).map(|(&edge, _)| edge)
    }
}
