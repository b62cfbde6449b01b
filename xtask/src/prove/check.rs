//! Whether the grid in an OBJ file is valid, told from its text alone.

use std::collections::{HashMap, HashSet};

type Point = [f64; 3];

/// Two nodes are no nearer than this share of the mean member, which may be longer than what is promised a share of.
const NEAREST: f64 = 0.03;
/// Neighbouring panels turn by less than the angle of this cosine (150 degrees), or by what the surface itself does.
const FOLDED: f64 = -0.866;
/// Rounding in a file's coordinates turns panels by as much, as a change of the cosine.
const ROUNDING: f64 = 1e-3;

/// What is known of the surface that a grid was laid on.
#[derive(Clone, Copy)]
pub struct Known {
    /// Its Euler characteristic.
    pub euler: Option<i64>,
    /// The cosine of its sharpest bend.
    pub sharpest: f64,
    /// It was said to be so narrow somewhere that nodes on its boundary may touch.
    pub narrow: bool,
}

/// The area of the grid in `text`, where it is a connected manifold with the surface's Euler characteristic, no two
/// nodes at one place and no panels that turn further than the sharpest bend of its surface.
///
/// # Errors
/// What is wrong with it.
pub fn valid(text: &str, known: Known) -> Result<f64, String> {
    let (points, panels) = read(text)?;
    let sides = sides(&panels)?;
    let got = points.len() as i64 - sides.len() as i64 + panels.len() as i64;
    if let Some(wanted) = known.euler.filter(|&e| e != got) {
        return Err(format!("Euler characteristic {got} instead of {wanted}"));
    }
    connected(points.len(), &panels)?;
    apart(&points, &sides, known.narrow)?;
    if let Some(pair) =
        bends(&points, &panels, &sides).find(|b| b.1 < FOLDED.min(known.sharpest - ROUNDING))
    {
        let [a, b] = pair.0;
        return Err(format!("panels {} and {} fold over", a + 1, b + 1));
    }
    Ok(panels.iter().map(|&p| 0.5 * length(normal(&points, p))).sum())
}

fn read(text: &str) -> Result<(Vec<Point>, Vec<[usize; 3]>), String> {
    let (mut points, mut panels) = (Vec::new(), Vec::new());
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let p: Vec<f64> = words.filter_map(|w| w.parse().ok()).collect();
                let p: Point =
                    p.try_into().map_err(|_| format!("a node is not a point: {line}"))?;
                if !p.iter().all(|x| x.is_finite()) {
                    return Err(format!("a node is nowhere: {line}"));
                }
                points.push(p);
            }
            Some("f") => {
                let first = |w: &str| w.split('/').next()?.parse::<usize>().ok();
                let panel: Vec<usize> = words.filter_map(first).map(|i| i - 1).collect();
                panels.push(panel.try_into().map_err(|_| format!("no triangle: {line}"))?);
            }
            _ => {}
        }
    }
    if panels.is_empty() { Err("no panels".into()) } else { Ok((points, panels)) }
}

/// Panels by member; every member has one or two, which run along it in opposite ways.
fn sides(panels: &[[usize; 3]]) -> Result<HashMap<(usize, usize), Vec<usize>>, String> {
    let mut seen = HashMap::new();
    let mut sides: HashMap<(usize, usize), Vec<usize>> = HashMap::new();
    for (t, p) in panels.iter().enumerate() {
        for k in 0..3 {
            let (a, b) = (p[k], p[(k + 1) % 3]);
            if a == b || seen.insert((a, b), t).is_some() {
                return Err(format!("no manifold at member {}-{}", a + 1, b + 1));
            }
            sides.entry((a.min(b), a.max(b))).or_default().push(t);
        }
    }
    Ok(sides)
}

/// One piece, and round every node one fan of panels.
fn connected(nodes: usize, panels: &[[usize; 3]]) -> Result<(), String> {
    let mut fans: Vec<Vec<[usize; 2]>> = vec![Vec::new(); nodes];
    for p in panels {
        for k in 0..3 {
            fans[p[k]].push([p[(k + 1) % 3], p[(k + 2) % 3]]);
        }
    }
    for (i, fan) in fans.iter().enumerate() {
        let Some(&[start, mut at]) = fan.first() else {
            return Err(format!("node {} is on no panel", i + 1));
        };
        let mut first = start;
        let mut used = 1;
        while let Some(next) = fan.iter().find(|s| s[0] == at && at != start) {
            at = next[1];
            used += 1;
        }
        while let Some(before) = fan.iter().find(|s| s[1] == first && at != start) {
            first = before[0];
            used += 1;
        }
        if used != fan.len() {
            return Err(format!("the grid is pinched at node {}", i + 1));
        }
    }
    let mut reached = vec![false; nodes];
    let mut open = vec![0];
    while let Some(i) = open.pop() {
        if !std::mem::replace(&mut reached[i], true) {
            open.extend(fans[i].iter().flatten());
        }
    }
    match reached.iter().position(|r| !r) {
        Some(i) => Err(format!("node {} hangs by no member on the others", i + 1)),
        None => Ok(()),
    }
}

fn apart(
    points: &[Point],
    sides: &HashMap<(usize, usize), Vec<usize>>,
    narrow: bool,
) -> Result<(), String> {
    let rim: HashSet<usize> =
        sides.iter().filter(|s| s.1.len() == 1).flat_map(|s| [s.0.0, s.0.1]).collect();
    let excused = |a: usize, b: usize| narrow && rim.contains(&a) && rim.contains(&b);
    let between = |a: usize, b: usize| length(minus(points[a], points[b]));
    // In order, so that the sum is the same every time.
    let mut members: Vec<_> = sides.keys().copied().collect();
    members.sort_unstable();
    let mean = members.iter().map(|&(a, b)| between(a, b)).sum::<f64>() / members.len() as f64;
    let mut sorted: Vec<usize> = (0..points.len()).collect();
    sorted.sort_by(|&a, &b| points[a][0].total_cmp(&points[b][0]));
    for (k, &a) in sorted.iter().enumerate() {
        let near = |b: &&usize| points[**b][0] - points[a][0] < NEAREST * mean;
        for &b in sorted[k + 1..].iter().take_while(near) {
            if between(a, b) < NEAREST * mean && !excused(a, b) {
                let d = between(a, b) / mean;
                return Err(format!("nodes {} and {} are {d:.1e} members apart", a + 1, b + 1));
            }
        }
    }
    Ok(())
}

/// The cosine of the sharpest bend between the faces of a mesh; 1 where all is flat.
pub fn sharpest(points: &[Point], faces: &[[usize; 3]]) -> f64 {
    let sides = sides(faces).unwrap_or_default();
    bends(points, faces, &sides).map(|b| b.1).fold(1.0, f64::min)
}

/// Panels that meet, and the cosine of the angle between their normals.
fn bends<'a>(
    points: &'a [Point],
    panels: &'a [[usize; 3]],
    sides: &HashMap<(usize, usize), Vec<usize>>,
) -> impl Iterator<Item = ([usize; 2], f64)> + 'a {
    let mut pairs: Vec<[usize; 2]> =
        sides.values().filter_map(|s| s.as_slice().try_into().ok()).collect();
    pairs.sort_unstable();
    pairs.into_iter().map(|pair| {
        let [n, m] = pair.map(|t| normal(points, panels[t]));
        (pair, dot(n, m) / (length(n) * length(m)))
    })
}

fn normal(points: &[Point], [a, b, c]: [usize; 3]) -> Point {
    let (u, v) = (minus(points[b], points[a]), minus(points[c], points[a]));
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

fn minus(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn length(a: Point) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
    const FLAT: Known = Known { euler: None, sharpest: 1.0, narrow: false };

    #[test]
    fn square_of_two_panels_is_valid() {
        let disc = Known { euler: Some(1), ..FLAT };
        assert!((valid(SQUARE, disc).unwrap() - 1.0).abs() < 1e-12);
        let ring = Known { euler: Some(0), ..FLAT };
        assert!(valid(SQUARE, ring).unwrap_err().contains("Euler"));
    }

    #[test]
    fn boundary_nodes_at_one_place_are_excused_where_the_surface_is_that_narrow() {
        let touching = SQUARE.replace("v 0 1 0", "v 1 0 1e-9");
        assert!(valid(&touching, FLAT).unwrap_err().contains("apart"));
        assert!(
            !valid(&touching, Known { narrow: true, ..FLAT }).is_err_and(|e| e.contains("apart"))
        );
    }

    #[test]
    fn every_fault_is_seen() {
        let told = |text: &str| valid(text, FLAT).unwrap_err();
        assert!(told(&SQUARE.replace("f 1 3 4", "f 3 1 4")).contains("manifold"));
        assert!(told(&SQUARE.replace("v 0 1 0", "v 1 0 1e-9")).contains("apart"));
        assert!(told(&SQUARE.replace("v 0 1 0", "v 0.9 0.1 0")).contains("fold"));
        assert!(told(&format!("{SQUARE}v 5 5 5\n")).contains("no panel"));
        let bow = format!("{SQUARE}v -1 0 0\nv -1 -1 0\nf 1 5 6\n");
        assert!(told(&bow).contains("pinched"));
    }
}
