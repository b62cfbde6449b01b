//! What a model looks like: plan and perspective side by side, parts coloured, loops, creases and patches drawn in.

use super::drawing::{Anchor, Drawing, Mark, Rgb, Unit};
use super::frame::{Extent, Frame, round_length};
use super::light::lit;
use super::view::{Camera, View};
use gridshell::DVec3;
use gridshell::inspect::Sketch;
use gridshell::surface::Chain;
use gridshell::surface::carrier::NONE;

/// Side of the square that each view is drawn in, margin round it and height of the foot with the scale, pixels.
const SIDE: f64 = 640.0;
const MARGIN: f64 = 24.0;
const FOOT: f64 = 44.0;
/// Height of the foot line above the lower edge.
const FOOT_LINE: f64 = 20.0;
/// Colours of parts, in turn.
const PARTS: [Rgb; 8] = [
    [0.80, 0.85, 0.90],
    [0.95, 0.83, 0.66],
    [0.76, 0.88, 0.74],
    [0.93, 0.76, 0.76],
    [0.85, 0.79, 0.92],
    [0.72, 0.89, 0.89],
    [0.92, 0.90, 0.68],
    [0.87, 0.87, 0.87],
];
const LOOP: Rgb = [0.75, 0.13, 0.10];
const CREASE: Rgb = [0.10, 0.30, 0.75];
const PATCH: Rgb = [0.50, 0.52, 0.55];
const INK: Rgb = [0.15, 0.15, 0.15];
/// Lines lie this share of the model's radius before the triangles they are on.
const BEFORE: f64 = 0.02;

/// Plan and perspective of a model.
pub fn plan_and_perspective(sketch: &Sketch) -> Drawing {
    let points = &sketch.surface.carrier.points;
    let views = [View::Plan, View::Perspective].map(|view| {
        let camera = view.camera(points);
        let extent = Extent::of(&camera, points);
        (camera, extent)
    });
    let scale = |extent: &Extent| {
        let [w, h] = extent.size();
        SIDE / w.max(h).max(f64::MIN_POSITIVE)
    };
    let tallest = views.iter().map(|(_, e)| e.size()[1] * scale(e)).fold(0.0, f64::max);
    let size = [2.0 * SIDE + 3.0 * MARGIN, tallest + 2.0 * MARGIN + FOOT];
    let mut drawing = Drawing::new(size, Unit::Pixel, sketch.surface.name.clone());
    for (k, (camera, extent)) in views.iter().enumerate() {
        let scale = scale(extent);
        let left = MARGIN + k as f64 * (SIDE + MARGIN);
        let indent = (SIDE - extent.size()[0] * scale) / 2.0;
        let frame = Frame::new(extent, scale, [left + indent, MARGIN]);
        draw_view(sketch, camera, &frame, &mut drawing);
    }
    draw_scale(scale(&views[0].1), &mut drawing);
    drawing
}

/// Triangles and lines from the farthest to the nearest, then the parts' numbers.
fn draw_view(sketch: &Sketch, camera: &Camera, frame: &Frame, drawing: &mut Drawing) {
    let surface = &sketch.surface;
    let carrier = &surface.carrier;
    let seen: Vec<[f64; 3]> = carrier.points.iter().map(|&p| camera.see(p)).collect();
    let mut layers: Vec<(f64, Mark)> = Vec::new();
    let before = BEFORE * camera.radius();
    let line = |a: u32, b: u32, width: f64, rgb: Rgb| {
        let [a, b] = [a, b].map(|v| seen[v as usize]);
        let points = vec![frame.place(a), frame.place(b)];
        (0.5 * (a[2] + b[2]) - before, Mark::Line { points, width, rgb })
    };
    for (t, corners) in carrier.triangles.iter().enumerate() {
        let places = corners.map(|v| seen[v as usize]);
        let depth = places.iter().map(|p| p[2]).sum::<f64>() / 3.0;
        let middle = carrier.corners(t as u32).iter().sum::<DVec3>() / 3.0;
        let part = PARTS[sketch.part[t] % PARTS.len()];
        let rgb = lit(part, carrier.face_normal(t as u32), middle, camera);
        let points = places.map(|p| frame.place(p)).to_vec();
        layers.push((depth, Mark::Area { points, rgb }));
        for k in 0..3 {
            let other = carrier.neighbors[t][k];
            let patches = other != NONE && carrier.patch[t] < carrier.patch[other as usize];
            if patches {
                layers.push(line(corners[k], corners[(k + 1) % 3], 0.7, PATCH));
            }
        }
    }
    let chains = |chains: &[Chain]| -> Vec<[u32; 2]> {
        let pair = |c: &Chain, k: usize| [c.vertices[k], c.vertices[(k + 1) % c.vertices.len()]];
        chains
            .iter()
            .flat_map(|c| (0..c.segments.len()).map(|k| pair(c, k)).collect::<Vec<_>>())
            .collect()
    };
    for [a, b] in chains(&surface.features) {
        layers.push(line(a, b, 1.8, CREASE));
    }
    for [a, b] in chains(&surface.loops) {
        layers.push(line(a, b, 1.8, LOOP));
    }
    layers.sort_by(|a, b| b.0.total_cmp(&a.0));
    drawing.marks.extend(layers.into_iter().map(|l| l.1));
    number_parts(sketch, camera, frame, drawing);
}

/// The number of each part at the triangle nearest to its middle, where there are several.
fn number_parts(sketch: &Sketch, camera: &Camera, frame: &Frame, drawing: &mut Drawing) {
    let carrier = &sketch.surface.carrier;
    let count = sketch.part.iter().max().map_or(0, |&p| p + 1);
    if count < 2 {
        return;
    }
    let middle = |t: usize| carrier.corners(t as u32).iter().sum::<DVec3>() / 3.0;
    for part in 0..count {
        let own: Vec<usize> = (0..sketch.part.len()).filter(|&t| sketch.part[t] == part).collect();
        let centre = own.iter().map(|&t| middle(t)).sum::<DVec3>() / own.len().max(1) as f64;
        let off = |t: usize| middle(t).distance_squared(centre);
        let Some(&t) = own.iter().min_by(|&&a, &&b| off(a).total_cmp(&off(b))) else { continue };
        let at = frame.place(camera.see(middle(t)));
        drawing.text(at, &(part + 1).to_string(), 15.0, INK, Anchor::Middle);
    }
}

/// A length of 1, 2 or 5 times a power of ten, as wide as a third of the view at most.
fn draw_scale(scale: f64, drawing: &mut Drawing) {
    let length = round_length(SIDE / 3.0 / scale);
    let ground = drawing.size[1] - FOOT_LINE;
    let [left, right] = [MARGIN, MARGIN + length * scale];
    let points = [[left, -5.0], [left, 0.0], [right, 0.0], [right, -5.0]];
    drawing.line(points.map(|p| [p[0], p[1] + ground]).to_vec(), 1.5, INK);
    drawing.text([right + 8.0, ground - 4.0], &format!("{length} m"), 14.0, INK, Anchor::Start);
}

#[cfg(test)]
mod tests {
    use super::super::{png, svg};
    use super::*;
    use gridshell::inspect::sketch;
    use gridshell::job::Job;
    use gridshell::surface::builtin;

    fn dome() -> Drawing {
        plan_and_perspective(&sketch(&builtin::model("dome").unwrap(), &Job::default()).unwrap())
    }

    #[test]
    fn everything_lies_on_the_paper() {
        let drawing = dome();
        assert!(drawing.marks.len() > 1000);
        for p in drawing.marks.iter().flat_map(Mark::points) {
            assert!((0..2).all(|k| (-1.0..=drawing.size[k] + 1.0).contains(&p[k])), "{p:?}");
        }
    }

    #[test]
    fn pictures_are_the_same_each_time_and_of_their_kind() {
        let svg = svg::encode(&dome());
        assert_eq!(svg, svg::encode(&dome()));
        assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"));
        let png = png::encode(&dome()).unwrap();
        assert_eq!(&png[1..4], b"PNG");
    }
}
