//! What a model looks like: plan and perspective side by side, parts coloured, loops, creases and patches drawn in.
//! Drawn the same on every machine; as SVG or PNG.

mod drawing;
mod glyphs;
mod png;
mod svg;
mod view;

use crate::failure::Failure;
use drawing::{Drawing, Mark, Rgb};
use gridshell::DVec3;
use gridshell::inspect::Sketch;
use gridshell::surface::Chain;
use gridshell::surface::carrier::NONE;
use std::path::Path;
use view::{Camera, View};

/// Side of the square that each view is drawn in, margin round it and height of the foot with the scale, pixels.
const SIDE: f64 = 640.0;
const MARGIN: f64 = 24.0;
const FOOT: f64 = 44.0;
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
/// Where the light comes from; need not be a unit vector.
const LIGHT: DVec3 = DVec3::new(-0.4, -0.3, 1.0);
/// What is taken from the brightness of triangles along the light, and of those seen from below.
const SHADE: f64 = 0.35;
const BELOW: f64 = 0.12;
/// Lines lie this share of the model's radius before the triangles they are on.
const BEFORE: f64 = 0.02;

/// Whether a picture can be drawn to this file: to be asked before the work.
pub fn check(file: &Path) -> Result<(), Failure> {
    kind(file).map(|_| ())
}

/// Draw the model to a file.
pub fn draw(sketch: &Sketch, file: &Path) -> Result<(), Failure> {
    let drawing = plan_and_perspective(sketch);
    let bytes = match kind(file)? {
        Kind::Svg => svg::encode(&drawing).into_bytes(),
        Kind::Png => png::encode(&drawing)?,
    };
    std::fs::write(file, bytes).map_err(|e| Failure::other(format!("{}: {e}", file.display())))
}

enum Kind {
    Svg,
    Png,
}

fn kind(file: &Path) -> Result<Kind, Failure> {
    let extension = file.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    match extension.as_str() {
        "svg" => Ok(Kind::Svg),
        "png" => Ok(Kind::Png),
        _ => Err(Failure::usage(format!("{}: a picture must end in .svg or .png", file.display()))),
    }
}

fn plan_and_perspective(sketch: &Sketch) -> Drawing {
    let points = &sketch.surface.carrier.points;
    let mut marks = Vec::new();
    let mut tallest: f64 = 0.0;
    for (k, view) in [View::Plan, View::Perspective].into_iter().enumerate() {
        let camera = view.camera(points);
        let left = MARGIN + k as f64 * (SIDE + MARGIN);
        let frame = Frame::new(&camera, points, left);
        tallest = tallest.max(frame.height);
        draw_view(sketch, &camera, &frame, &mut marks);
        if matches!(view, View::Plan) {
            draw_scale(&frame, &mut marks);
        }
    }
    // The scale stands at the foot, whose height is known only now.
    let size = [2.0 * SIDE + 3.0 * MARGIN, tallest + 2.0 * MARGIN + FOOT];
    let mut drawing = Drawing { size, marks };
    drawing.put_down_feet();
    drawing
}

/// Where a view stands on the paper.
struct Frame {
    /// Pixels per metre.
    scale: f64,
    /// Least right and largest up of what is seen, metres, and where that stands, pixels.
    corner: [f64; 2],
    at: [f64; 2],
    height: f64,
}

impl Frame {
    fn new(camera: &Camera, points: &[DVec3], left: f64) -> Frame {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for &p in points {
            let seen = camera.see(p);
            for k in 0..2 {
                low[k] = low[k].min(seen[k]);
                high[k] = high[k].max(seen[k]);
            }
        }
        let extent = [high[0] - low[0], high[1] - low[1]];
        let scale = SIDE / extent[0].max(extent[1]).max(f64::MIN_POSITIVE);
        let indent = (SIDE - extent[0] * scale) / 2.0;
        let height = extent[1] * scale;
        Frame { scale, corner: [low[0], high[1]], at: [left + indent, MARGIN], height }
    }

    fn pixel(&self, seen: [f64; 3]) -> [f64; 2] {
        [
            self.at[0] + (seen[0] - self.corner[0]) * self.scale,
            self.at[1] + (self.corner[1] - seen[1]) * self.scale,
        ]
    }
}

/// Triangles and lines from the farthest to the nearest, then the parts' numbers.
fn draw_view(sketch: &Sketch, camera: &Camera, frame: &Frame, marks: &mut Vec<Mark>) {
    let surface = &sketch.surface;
    let carrier = &surface.carrier;
    let seen: Vec<[f64; 3]> = carrier.points.iter().map(|&p| camera.see(p)).collect();
    let mut layers: Vec<(f64, Mark)> = Vec::new();
    let before = BEFORE * camera.radius();
    let line = |a: u32, b: u32, width: f64, rgb: Rgb| {
        let [a, b] = [a, b].map(|v| seen[v as usize]);
        let points = vec![frame.pixel(a), frame.pixel(b)];
        (0.5 * (a[2] + b[2]) - before, Mark::Line { points, width, rgb })
    };
    for (t, corners) in carrier.triangles.iter().enumerate() {
        let places = corners.map(|v| seen[v as usize]);
        let depth = places.iter().map(|p| p[2]).sum::<f64>() / 3.0;
        let rgb = shaded(sketch, camera, t);
        let points = places.map(|p| frame.pixel(p)).to_vec();
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
    marks.extend(layers.into_iter().map(|l| l.1));
    number_parts(sketch, camera, frame, marks);
}

/// The colour of a triangle's part in the light.
fn shaded(sketch: &Sketch, camera: &Camera, t: usize) -> Rgb {
    let carrier = &sketch.surface.carrier;
    let normal = carrier.face_normal(t as u32);
    let middle = carrier.corners(t as u32).iter().sum::<DVec3>() / 3.0;
    let lit = 1.0 - SHADE * (1.0 - normal.dot(LIGHT.normalize()).abs());
    let below = if normal.dot(camera.eye() - middle) < 0.0 { BELOW } else { 0.0 };
    PARTS[sketch.part[t] % PARTS.len()].map(|x| x * (lit - below))
}

/// The number of each part at the triangle nearest to its middle, where there are several.
fn number_parts(sketch: &Sketch, camera: &Camera, frame: &Frame, marks: &mut Vec<Mark>) {
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
        let at = frame.pixel(camera.see(middle(t)));
        marks.push(Mark::Text {
            at,
            text: (part + 1).to_string(),
            size: 15.0,
            rgb: INK,
            foot: false,
        });
    }
}

/// A length of 1, 2 or 5 times a power of ten, as wide as a third of the view at most.
fn draw_scale(frame: &Frame, marks: &mut Vec<Mark>) {
    let most = SIDE / 3.0 / frame.scale;
    let power = (-12..12).rev().map(|k| 10f64.powi(k)).find(|&p| p <= most).unwrap_or(1.0);
    let length = [5.0, 2.0, 1.0].map(|f| f * power).into_iter().find(|&l| l <= most);
    let length = length.unwrap_or(power);
    let [left, right] = [MARGIN, MARGIN + length * frame.scale];
    let points = vec![[left, -5.0], [left, 0.0], [right, 0.0], [right, -5.0]];
    marks.push(Mark::Foot { points, width: 1.5, rgb: INK });
    let text = format!("{length} m");
    marks.push(Mark::Text { at: [right + 24.0, -4.0], text, size: 14.0, rgb: INK, foot: true });
}

#[cfg(test)]
mod tests {
    use super::*;
    use gridshell::inspect::sketch;
    use gridshell::surface::builtin;

    fn dome() -> Drawing {
        plan_and_perspective(&sketch(&builtin::model("dome").unwrap()).unwrap())
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
        assert!(kind(Path::new("a.jpg")).is_err());
    }
}
