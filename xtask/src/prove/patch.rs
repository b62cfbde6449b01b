//! A rational B-spline patch with its own evaluation (Cox and de Boor), as a STEP file of one face.

use fastrand::Rng;

/// Points to a side when an area is measured.
const FINE: usize = 240;

/// A patch whose points run along v first.
pub struct Patch {
    degree: [usize; 2],
    count: [usize; 2],
    knots: [Vec<f64>; 2],
    /// Metres.
    pub points: Vec<[f64; 3]>,
    pub weights: Vec<f64>,
}

impl Patch {
    /// A patch without points yet. Inner knots are drawn at random, and may be as frequent as the degree: folds.
    pub fn new(degree: [usize; 2], count: [usize; 2], rng: &mut Rng) -> Patch {
        let knots = [0, 1].map(|k| knots(degree[k], count[k], rng));
        Patch { degree, count, knots, points: Vec::new(), weights: Vec::new() }
    }

    /// The point where the basis functions have these values.
    fn point(&self, [a, b]: [&[f64]; 2]) -> [f64; 3] {
        let mut sum = [0.0; 4];
        for (i, a) in a.iter().enumerate().filter(|x| *x.1 != 0.0) {
            for (j, b) in b.iter().enumerate().filter(|x| *x.1 != 0.0) {
                let k = i * self.count[1] + j;
                let w = a * b * self.weights[k];
                for c in 0..3 {
                    sum[c] += w * self.points[k][c];
                }
                sum[3] += w;
            }
        }
        [0, 1, 2].map(|c| sum[c] / sum[3])
    }

    /// Its area by fine facets.
    pub fn area(&self) -> f64 {
        let [us, vs] = [0, 1].map(|k| -> Vec<Vec<f64>> {
            let at = |i: usize| i as f64 / FINE as f64;
            let (degree, knots, count) = (self.degree[k], &self.knots[k], self.count[k]);
            (0..=FINE).map(|i| basis(degree, knots, count, at(i))).collect()
        });
        let rows: Vec<Vec<[f64; 3]>> =
            us.iter().map(|u| vs.iter().map(|v| self.point([u, v])).collect()).collect();
        let cells = (0..FINE).flat_map(|i| (0..FINE).map(move |j| (i, j)));
        let cell = |(i, j): (usize, usize)| {
            let [a, b, c, d] = [rows[i][j], rows[i + 1][j], rows[i + 1][j + 1], rows[i][j + 1]];
            triangle([a, b, c]) + triangle([a, c, d])
        };
        cells.map(cell).sum()
    }

    /// As a STEP file in metres or millimetres.
    pub fn step(&self, millimetres: bool) -> String {
        let unit = if millimetres { 1000.0 } else { 1.0 };
        let mut step = Step { text: String::new(), last: 0, unit };
        let [n, m] = self.count;
        let ids: Vec<usize> = self.points.iter().map(|&p| step.point(p)).collect();
        let row = |k: usize| -> Vec<usize> {
            match k {
                0 => (0..n).map(|i| i * m).collect(),
                1 => (0..m).map(|j| (n - 1) * m + j).collect(),
                2 => (0..n).map(|i| i * m + m - 1).collect(),
                _ => (0..m).collect(),
            }
        };
        let net: Vec<String> = ids.chunks(m).map(refs).collect();
        let heads = [0, 1].map(|k| frequencies(&self.knots[k]));
        let [u, v] = self.degree;
        let weights: Vec<String> = self
            .weights
            .chunks(m)
            .map(|r| format!("({})", join(r.iter().map(|w| real(*w)))))
            .collect();
        let surface = step.add(&format!(
            "( BOUNDED_SURFACE() B_SPLINE_SURFACE({u},{v},({}),.UNSPECIFIED.,.F.,.F.,.F.) \
             B_SPLINE_SURFACE_WITH_KNOTS({},{},{},{},.UNSPECIFIED.) GEOMETRIC_REPRESENTATION_ITEM() \
             RATIONAL_B_SPLINE_SURFACE(({})) REPRESENTATION_ITEM('') SURFACE() )",
            net.join(","), heads[0].1, heads[1].1, heads[0].0, heads[1].0, weights.join(",")
        ));
        let corners = [0, (n - 1) * m, n * m - 1, m - 1];
        let vertices = corners.map(|c| step.add(&format!("VERTEX_POINT('',#{})", ids[c])));
        // Sides as they run round the face: the last two backwards.
        let mut ring = Vec::new();
        for k in 0..4 {
            let along = row(k);
            let (d, (many, at)) = (self.degree[k % 2], &heads[k % 2]);
            let points = refs(&along.iter().map(|&i| ids[i]).collect::<Vec<_>>());
            let weights = join(along.iter().map(|&i| real(self.weights[i])));
            let curve = step.add(&format!(
                "( BOUNDED_CURVE() B_SPLINE_CURVE({d},{points},.UNSPECIFIED.,.F.,.F.) \
                 B_SPLINE_CURVE_WITH_KNOTS({at},{many},.UNSPECIFIED.) CURVE() GEOMETRIC_REPRESENTATION_ITEM() \
                 RATIONAL_B_SPLINE_CURVE(({weights})) REPRESENTATION_ITEM('') )"
            ));
            let (from, to) = if k < 2 { (k, k + 1) } else { ((k + 1) % 4, k) };
            let edge = step
                .add(&format!("EDGE_CURVE('',#{},#{},#{curve},.T.)", vertices[from], vertices[to]));
            let sense = if k < 2 { "T" } else { "F" };
            ring.push(step.add(&format!("ORIENTED_EDGE('',*,*,#{edge},.{sense}.)")));
        }
        step.file(surface, &ring)
    }
}

/// STEP text while it is written.
struct Step {
    text: String,
    last: usize,
    unit: f64,
}

impl Step {
    fn add(&mut self, entity: &str) -> usize {
        self.last += 1;
        self.text += &format!("#{}={entity};\n", self.last);
        self.last
    }

    fn point(&mut self, p: [f64; 3]) -> usize {
        let p = join(p.iter().map(|x| real(x * self.unit)));
        self.add(&format!("CARTESIAN_POINT('',({p}))"))
    }

    fn file(mut self, surface: usize, ring: &[usize]) -> String {
        let ring = self.add(&format!("EDGE_LOOP('',{})", refs(ring)));
        let bound = self.add(&format!("FACE_OUTER_BOUND('',#{ring},.T.)"));
        let face = self.add(&format!("ADVANCED_FACE('',(#{bound}),#{surface},.T.)"));
        let shell = self.add(&format!("OPEN_SHELL('',(#{face}))"));
        let model = self.add(&format!("SHELL_BASED_SURFACE_MODEL('',(#{shell}))"));
        let prefix = if self.unit == 1.0 { "$" } else { ".MILLI." };
        let length =
            self.add(&format!("( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT({prefix},.METRE.) )"));
        let angle = self.add("( NAMED_UNIT(*) PLANE_ANGLE_UNIT() SI_UNIT($,.RADIAN.) )");
        let solid = self.add("( NAMED_UNIT(*) SI_UNIT($,.STERADIAN.) SOLID_ANGLE_UNIT() )");
        let context = self.add(&format!(
            "( GEOMETRIC_REPRESENTATION_CONTEXT(3) GLOBAL_UNIT_ASSIGNED_CONTEXT((#{length},#{angle},#{solid})) \
             REPRESENTATION_CONTEXT('','') )"
        ));
        self.add(&format!("MANIFOLD_SURFACE_SHAPE_REPRESENTATION('',(#{model}),#{context})"));
        format!(
            "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','2026-01-01T00:00:00',(''),(''),'','','');\n\
             FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n{}ENDSEC;\nEND-ISO-10303-21;\n",
            self.text
        )
    }
}

fn refs(ids: &[usize]) -> String {
    format!("({})", join(ids.iter().map(|i| format!("#{i}"))))
}

fn join(words: impl Iterator<Item = String>) -> String {
    words.collect::<Vec<_>>().join(",")
}

/// A number as STEP wants it: with a point.
fn real(x: f64) -> String {
    format!("{x:?}").replace('e', "E")
}

/// Clamped knots from 0 to 1.
fn knots(degree: usize, count: usize, rng: &mut Rng) -> Vec<f64> {
    let mut inner: Vec<f64> = Vec::new();
    while inner.len() < count - degree - 1 {
        let left = count - degree - 1 - inner.len();
        let often = if rng.u8(0..4) == 0 { rng.usize(1..=degree.min(left)) } else { 1 };
        let at = (1.0 + 998.0 * rng.f64()).round() / 1000.0;
        if !inner.contains(&at) {
            inner.extend(std::iter::repeat_n(at, often));
        }
    }
    inner.sort_by(f64::total_cmp);
    let end = |t: f64| std::iter::repeat_n(t, degree + 1);
    end(0.0).chain(inner).chain(end(1.0)).collect()
}

/// Distinct knots and how often each is there, as STEP lists.
fn frequencies(knots: &[f64]) -> (String, String) {
    let runs: Vec<&[f64]> = knots.chunk_by(|a, b| a == b).collect();
    let at = join(runs.iter().map(|r| real(r[0])));
    let many = join(runs.iter().map(|r| r.len().to_string()));
    (format!("({at})"), format!("({many})"))
}

/// All basis functions at `t`, by the recursion of Cox and de Boor.
fn basis(degree: usize, knots: &[f64], count: usize, t: f64) -> Vec<f64> {
    let last = count - 1;
    let span = (degree..=last).rev().find(|&i| knots[i] <= t && knots[i] < knots[i + 1]);
    let mut n = vec![0.0; knots.len()];
    n[span.unwrap_or(degree)] = 1.0;
    for d in 1..=degree {
        for i in 0..knots.len() - d - 1 {
            let part = |a: f64, b: f64, n: f64| if b > 0.0 { a / b * n } else { 0.0 };
            n[i] = part(t - knots[i], knots[i + d] - knots[i], n[i])
                + part(knots[i + d + 1] - t, knots[i + d + 1] - knots[i + 1], n[i + 1]);
        }
    }
    n.truncate(count);
    n
}

/// Area of a triangle.
pub fn triangle([a, b, c]: [[f64; 3]; 3]) -> f64 {
    let [u, v] = [b, c].map(|p| [0, 1, 2].map(|k| p[k] - a[k]));
    let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    0.5 * (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt()
}
