//! What is under the pointer, and what is inside a rectangle of the screen.

use crate::message::{Fact, Picked};
use glam::{DMat4, DVec3};
use gridshell::degree::adjusted_degree;
use gridshell::grid::Grid;
use gridshell::merit;
use gridshell::surface::Origin;

/// A node is meant rather than a member within this share of the panel's longest side.
const NEAR_NODE: f64 = 0.28;

/// The nearest panel that the line of sight meets, with its nearest node and member; `drawn` is the origin of the
/// coordinates that the page draws in.
pub fn pick(
    grid: &Grid,
    drawn: Origin,
    run: u32,
    question: u32,
    origin: DVec3,
    direction: DVec3,
) -> Picked {
    let mut picked = Picked {
        run,
        question,
        at: None,
        node: None,
        node_at: None,
        member: None,
        member_at: None,
        node_first: false,
        facts: Vec::new(),
    };
    let direction = direction.normalize_or_zero();
    let corners = |t: [u32; 3]| t.map(|v| grid.xyz[v as usize]);
    let hits =
        grid.mesh.triangles().filter_map(|t| Some((meet(corners(t), origin, direction)?, t)));
    let Some((distance, panel)) = hits.min_by(|a, b| a.0.total_cmp(&b.0)) else { return picked };
    let at = origin + direction * distance;
    let p = corners(panel);
    let side = [0, 1, 2].map(|k| p[k].distance(p[(k + 1) % 3]));
    let least =
        |values: [f64; 3]| (0..3).min_by(|&i, &j| values[i].total_cmp(&values[j])).unwrap_or(0);
    let n = least(p.map(|q| q.distance(at)));
    let m = least([0, 1, 2].map(|k| from_line(at, p[k], p[(k + 1) % 3])));
    let member = [panel[m], panel[(m + 1) % 3]];
    picked.at = Some(at.to_array());
    picked.node = Some(panel[n]);
    picked.node_at = Some(p[n].to_array());
    picked.member = Some(member);
    picked.member_at = Some(member.map(|v| grid.xyz[v as usize].to_array()));
    picked.node_first = p[n].distance(at) < NEAR_NODE * side.iter().copied().fold(0.0, f64::max);
    picked.facts = facts(grid, drawn, &picked, panel);
    picked
}

fn facts(grid: &Grid, drawn: Origin, picked: &Picked, panel: [u32; 3]) -> Vec<Fact> {
    let fact = |label: &str, value: String| Fact { label: label.into(), value };
    let mesh = &grid.mesh;
    let mut facts = Vec::new();
    if let (Some(v), true) = (picked.node, picked.node_first) {
        let p = drawn.world(grid.xyz[v as usize]);
        let adjusted = adjusted_degree(mesh, &grid.xyz, v);
        let place = if mesh.is_boundary(v) { "on the boundary" } else { "inside" };
        facts.push(fact("Node", format!("{v}, {place}")));
        facts.push(fact(
            "Degree",
            match (mesh.is_boundary(v), adjusted) {
                (false, 6) => "6, regular".to_owned(),
                (false, d) => format!("{d}, irregular"),
                (true, 6) => format!("{} (adjusted 6, regular)", mesh.degree(v)),
                (true, d) => format!("{} (adjusted {d}, irregular)", mesh.degree(v)),
            },
        ));
        if !mesh.is_boundary(v) && adjusted == 6 {
            facts.push(fact("Disfluency", format!("{:.2}°", merit::delta(grid, v).to_degrees())));
        }
        facts.push(fact("At", format!("{:.3}, {:.3}, {:.3} m", p.x, p.y, p.z)));
    } else if let Some([a, b]) = picked.member {
        facts.push(fact("Member", format!("{a} – {b}")));
        facts.push(fact("Length", format!("{:.3} m", grid.length(a, b))));
    }
    let shape = merit::shape(panel.map(|v| grid.xyz[v as usize]));
    facts.push(fact("Panel shape", format!("{shape:.3}")));
    facts
}

/// Where a ray meets a triangle, as a distance along it; after Möller and Trumbore.
fn meet([a, b, c]: [DVec3; 3], origin: DVec3, direction: DVec3) -> Option<f64> {
    let (e, f) = (b - a, c - a);
    let across = direction.cross(f);
    let det = e.dot(across);
    if det.abs() < f64::MIN_POSITIVE {
        return None;
    }
    let from = origin - a;
    let u = from.dot(across) / det;
    let along = from.cross(e);
    let v = direction.dot(along) / det;
    let t = f.dot(along) / det;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t.is_finite()).then_some(t)
}

fn from_line(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let d = b - a;
    let s = ((p - a).dot(d) / d.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    p.distance(a + d * s)
}

/// The nodes that `matrix` (world to screen, column by column) puts into the rectangle `[left, bottom, right, top]`.
pub fn within(grid: &Grid, matrix: &[f64; 16], rectangle: [f64; 4]) -> Vec<u32> {
    let matrix = DMat4::from_cols_array(matrix);
    let [left, bottom, right, top] = rectangle;
    let inside = |v: &u32| {
        let p = matrix * grid.xyz[*v as usize].extend(1.0);
        let (x, y) = (p.x / p.w, p.y / p.w);
        p.w > 0.0 && (left..=right).contains(&x) && (bottom..=top).contains(&y)
    };
    grid.mesh.vertices().filter(inside).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measures::tests::square;

    #[test]
    fn a_look_from_above_finds_the_node_or_member_below() {
        let (grid, _) = square();
        let drawn = Origin::default();
        let look = |x: f64, y: f64| pick(&grid, drawn, 1, 0, DVec3::new(x, y, 9.0), -DVec3::Z);
        let corner = look(0.05, 0.03);
        assert!(corner.node_first);
        let p = corner.node_at.unwrap();
        assert_eq!([p[0], p[1]], [0.0, 0.0]);
        let side = look(0.5, 0.02);
        assert!(!side.node_first);
        let ends = side.member_at.unwrap();
        assert!(ends.iter().all(|p| p[1] == 0.0), "{ends:?}");
        assert!(look(-3.0, 0.0).at.is_none());
    }

    #[test]
    fn a_rectangle_of_the_screen_holds_the_nodes_drawn_in_it() {
        let (grid, _) = square();
        let all = within(&grid, &DMat4::IDENTITY.to_cols_array(), [-9.0, -9.0, 9.0, 9.0]);
        assert_eq!(all.len(), grid.xyz.len());
        let few = within(&grid, &DMat4::IDENTITY.to_cols_array(), [-0.1, -0.1, 0.1, 9.0]);
        assert!(!few.is_empty() && few.iter().all(|&v| grid.xyz[v as usize].x == 0.0));
    }
}
