//! Rows of bubbles along the border: one a lattice row inside it, staggered by half a member, so that the panels
//! at the border are near equilateral. The lattice fills what is left beyond them.

use super::rim::Rim;
use crate::math::trig::{atan2, cos, sin};
use crate::surface::{ChainPoint, Surface, SurfacePoint, chart::Chart};
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_3, PI};

/// Height of an equilateral triangle over its side.
pub const HEIGHT: f64 = 0.866_025_403_784_438_6;
/// Row bubbles are no nearer to one another, over l0: across a neck, say.
pub const APART: f64 = 0.6;
/// Row bubbles are no nearer to any border, over l0.
const CLEAR: f64 = 0.55;
/// Two row bubbles that a convex corner brings nearer than this, over l0, become one.
const MERGED: f64 = 0.75;

/// The rows along all borders.
#[derive(Clone, Debug, Default)]
pub struct Rows {
    /// Their bubbles.
    pub bubbles: Vec<SurfacePoint>,
    /// Where those are in the chart.
    pub uv: Vec<DVec2>,
    /// For each boundary bubble, whether a row runs along the member that begins there.
    pub along: Vec<bool>,
}

/// Rows along the boundary members that a lattice at `angle` in the chart is off by at most `row_angle`, radians;
/// `length` is a member's in the chart.
pub fn rows(
    surface: &Surface,
    chart: &Chart,
    boundary: &[ChainPoint],
    angle: f64,
    length: f64,
    row_angle: Option<f64>,
) -> Rows {
    let mut rows = Rows::default();
    let Some(row_angle) = row_angle else {
        rows.along = vec![false; boundary.len()];
        return rows;
    };
    let clear = Rim::of_border(surface, chart, |_, _| CLEAR * length, CLEAR * length);
    let mut kept: BTreeMap<[i64; 2], Vec<DVec2>> = BTreeMap::new();
    for nodes in boundary.chunk_by(|a, b| a.chain == b.chain) {
        let members: Vec<Member> =
            (0..nodes.len()).map(|k| Member::new(surface, chart, nodes, k)).collect();
        let along: Vec<bool> =
            members.iter().map(|m| off_lattice(m.heading - angle) <= row_angle + 1e-9).collect();
        for point in row(surface, chart, &members, &along, length) {
            let uv = chart.at(&surface.carrier, &point);
            if clear.is_clear(uv) && is_apart(&mut kept, uv, APART * length) {
                rows.bubbles.push(point);
                rows.uv.push(uv);
            }
        }
        rows.along.extend(along);
    }
    rows
}

/// A member of a loop.
struct Member {
    /// Place of its first node.
    start: SurfacePoint,
    /// Its middle on the loop.
    middle: SurfacePoint,
    /// From its first node to the next, metres.
    chord: DVec3,
    /// The same in the chart, as an angle.
    heading: f64,
}

impl Member {
    fn new(surface: &Surface, chart: &Chart, nodes: &[ChainPoint], k: usize) -> Member {
        let (a, b) = (nodes[k], nodes[(k + 1) % nodes.len()]);
        let chain = &surface.loops[a.chain as usize];
        let carrier = &surface.carrier;
        let middle = a.s + 0.5 * chain.wrap(b.s - a.s);
        let d = chart.on_loop(surface, &b) - chart.on_loop(surface, &a);
        Member {
            start: chain.surface_point(a.s),
            middle: chain.surface_point(middle),
            chord: chain.xyz(carrier, b.s) - chain.xyz(carrier, a.s),
            heading: atan2(d.y, d.x),
        }
    }

    /// The place `reach` from `from`, at `angle` to the left of this member.
    fn beside(
        &self,
        surface: &Surface,
        from: &SurfacePoint,
        angle: f64,
        reach: f64,
    ) -> SurfacePoint {
        let ahead = self.chord.normalize_or_zero();
        let left = surface.carrier.normal(from).cross(ahead);
        surface.carrier.trace(from, (ahead * cos(angle) + left * sin(angle)) * reach)
    }
}

/// The row along one loop: over the middle of every member, with more where a concave corner parts them and fewer
/// where a convex one brings them together.
fn row(
    surface: &Surface,
    chart: &Chart,
    members: &[Member],
    along: &[bool],
    length: f64,
) -> Vec<SurfacePoint> {
    let carrier = &surface.carrier;
    let mut row: Vec<SurfacePoint> = Vec::with_capacity(members.len());
    for (k, member) in members.iter().enumerate() {
        if !along[k] {
            continue;
        }
        let last = (k + members.len() - 1) % members.len();
        let size = member.chord.length();
        let here = member.beside(surface, &member.middle, 0.5 * PI, HEIGHT * size);
        if !along[last] {
            row.push(here);
            continue;
        }
        // Panels at the node beyond those of its two members.
        let turn = wrapped(member.heading - members[last].heading);
        let between = PI - turn - 2.0 * FRAC_PI_3;
        let panels = (between / FRAC_PI_3).round();
        for j in 1..panels.max(1.0) as usize {
            let angle = FRAC_PI_3 + between * j as f64 / panels;
            row.push(member.beside(surface, &member.start, angle, size));
        }
        match row.last_mut() {
            Some(other) if panels <= 0.0 && k > 0 => {
                let gap = chart.at(carrier, &here).distance(chart.at(carrier, other));
                if gap < MERGED * length {
                    *other = carrier.follow(other, carrier.xyz(other).midpoint(carrier.xyz(&here)));
                } else {
                    row.push(here);
                }
            }
            _ => row.push(here),
        }
    }
    row
}

/// Angle between a direction and the nearest of a lattice's three, which lie a sixth of a turn apart from 0 on.
pub fn off_lattice(angle: f64) -> f64 {
    let turns = angle / FRAC_PI_3;
    (turns - turns.round()).abs() * FRAC_PI_3
}

/// The same angle in (-pi, pi].
fn wrapped(angle: f64) -> f64 {
    angle - (angle / (2.0 * PI)).round() * 2.0 * PI
}

/// Whether no point kept so far is nearer than `gap`; `uv` is then kept too.
fn is_apart(kept: &mut BTreeMap<[i64; 2], Vec<DVec2>>, uv: DVec2, gap: f64) -> bool {
    let [x, y] = (uv / gap).floor().to_array().map(|c| c as i64);
    let near = (x - 1..=x + 1).flat_map(|i| (y - 1..=y + 1).map(move |j| [i, j]));
    let crowded =
        near.filter_map(|c| kept.get(&c)).flatten().any(|p| p.distance_squared(uv) < gap * gap);
    if !crowded {
        kept.entry([x, y]).or_default().push(uv);
    }
    !crowded
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Job;
    use crate::stages::pack::boundary::{member_count, pieces, place};
    use crate::surface::{Sampling, builtin};

    /// Rows on a built-in surface with equal boundary members of about `length`, and their distances to the ends
    /// of the nearest member, over that member.
    fn row_on(name: &str, length: f64, angle: f64, row_angle: f64) -> (Rows, Vec<[f64; 2]>) {
        let sampling =
            Sampling { max_edge: 0.5 * length, chord_error: 2e-3 * length, corner_angle: 0.5 };
        let surface = builtin::model(name)
            .expect("built in")
            .surface(&sampling, &Job::default())
            .expect(name);
        let chart = Chart::flatten(&surface, &Job::default()).unwrap().expect("it has a chart");
        let pieces = pieces(&surface);
        let counts: Vec<usize> = pieces.iter().map(|p| member_count(p, length)).collect();
        let boundary = place(&surface, &pieces, &counts, 0.0);
        let rows = rows(&surface, &chart, &boundary, angle, length, Some(row_angle));
        let nodes: Vec<DVec3> = boundary
            .iter()
            .map(|b| surface.loops[b.chain as usize].xyz(&surface.carrier, b.s))
            .collect();
        let nearest = |p: &SurfacePoint| {
            let at = surface.carrier.xyz(p);
            let mut distances: Vec<f64> = nodes.iter().map(|n| n.distance(at) / length).collect();
            distances.sort_by(f64::total_cmp);
            [distances[0], distances[1]]
        };
        let near = rows.bubbles.iter().map(nearest).collect();
        (rows, near)
    }

    #[test]
    fn panels_between_border_and_row_are_near_equilateral() {
        let (rows, near) = row_on("great-court", 2.12, 0.0, 0.6);
        assert!(rows.along.iter().all(|&a| a));
        // A panel for every member but for what the four corners and the hole's opening take and give.
        assert!(rows.bubbles.len().abs_diff(rows.along.len()) < 12, "{}", rows.bubbles.len());
        let good = near.iter().filter(|d| d.iter().all(|x| (x - 1.0).abs() < 0.1)).count();
        assert!(good as f64 > 0.9 * near.len() as f64, "{good} of {}", near.len());
    }

    #[test]
    fn rows_follow_only_borders_that_the_lattice_is_parallel_to() {
        // Of a hexagon's sides all lie along the lattice or none.
        for (angle, parallel) in [(0.0, true), (0.5 * FRAC_PI_3, false)] {
            let (rows, _) = row_on("hexagon", 0.5, angle, 0.1);
            assert!(rows.along.iter().all(|&a| a == parallel), "{angle}");
            assert_eq!(rows.bubbles.is_empty(), !parallel);
        }
    }

    #[test]
    fn the_row_in_a_hexagon_is_its_next_ring() {
        // Eight members a side: the next ring has six times seven nodes, on the lattice.
        let (rows, near) = row_on("hexagon", 0.5, 0.0, 0.1);
        assert_eq!(rows.bubbles.len(), 42);
        for [a, b] in near {
            assert!((a - 1.0).abs() < 1e-6 && (b - 1.0).abs() < 1e-6, "{a} {b}");
        }
    }

    #[test]
    fn a_lattice_is_at_most_thirty_degrees_off() {
        for k in -40..40 {
            let angle = f64::from(k) * 0.1;
            assert!(off_lattice(angle) <= FRAC_PI_3 / 2.0 + 1e-12);
            assert!((off_lattice(angle) - off_lattice(angle + FRAC_PI_3)).abs() < 1e-12);
        }
        assert!((off_lattice(0.1) - 0.1).abs() < 1e-15 && (off_lattice(-0.1) - 0.1).abs() < 1e-15);
    }
}
