//! Faces with straight edges given by their corners alone (`POLY_LOOP`, `FACE`, `FACETED_BREP`), given edges and
//! planes; models of face sets as models of shells; triangles as the strips that the parser knows.

use super::text::{Draft, Record, Text, list_of, references, triple};
use glam::DVec3;
use std::collections::BTreeMap;

/// Keywords, and those of entities with the same parameters that the parser knows.
const SAME: [(&str, &str); 4] = [
    ("FACETED_BREP", "MANIFOLD_SOLID_BREP"),
    ("FACETED_BREP_SHAPE_REPRESENTATION", "ADVANCED_BREP_SHAPE_REPRESENTATION"),
    ("FACE_BASED_SURFACE_MODEL", "SHELL_BASED_SURFACE_MODEL"),
    ("CONNECTED_FACE_SET", "OPEN_SHELL"),
];
/// Lists of triangles, which are strips of one triangle each.
const TRIANGLES: [&str; 2] = ["TRIANGULATED_FACE", "TRIANGULATED_SURFACE_SET"];

/// The text in other words; None where it has none of these.
pub(super) fn mended(text: &Text) -> Option<Vec<u8>> {
    let same = SAME.map(|(from, _)| from);
    if !text.has(&same) && !text.has(&TRIANGLES) && !text.has(&["POLY_LOOP", "FACE"]) {
        return None;
    }
    let mut facets = Facets {
        draft: Draft::of(text),
        vertices: BTreeMap::new(),
        edges: BTreeMap::new(),
        way: None,
    };
    for record in &text.records {
        let keyword = text.keyword(record);
        if let Some((_, to)) = SAME.iter().find(|(from, _)| keyword == from.as_bytes()) {
            facets.draft.put(record.keyword.clone(), *to);
        } else if TRIANGLES.iter().any(|t| keyword == t.as_bytes()) {
            let keyword = String::from_utf8_lossy(keyword);
            facets.draft.put(record.keyword.clone(), format!("COMPLEX_{keyword}"));
            facets.draft.put(record.list.end - 1..record.list.end, ",())");
        } else if keyword == b"POLY_LOOP" {
            facets.edge_loop(record);
        } else if keyword == b"FACE" {
            facets.plane(record);
        }
    }
    facets.draft.done()
}

struct Facets<'t> {
    draft: Draft<'t>,
    /// By what the file says of their place: many give each face points of its own.
    vertices: BTreeMap<Vec<u8>, (u64, u64)>,
    edges: BTreeMap<(u64, u64), u64>,
    /// A direction for lines, which nobody reads: their ends say it.
    way: Option<u64>,
}

impl Facets<'_> {
    /// Edges in the place of corners.
    fn edge_loop(&mut self, record: &Record) -> Option<()> {
        let text = self.draft.text;
        let mut corners: Vec<(u64, u64)> = Vec::new();
        for id in references(text, text.list(record).get(1)?) {
            let corner = self.vertex(id)?;
            if corners.last() != Some(&corner) {
                corners.push(corner);
            }
        }
        if corners.len() > 1 && corners.first() == corners.last() {
            corners.pop();
        }
        let mut edges = Vec::new();
        for (k, &a) in corners.iter().enumerate() {
            let b = corners[(k + 1) % corners.len()];
            let edge = self.edge(a.min(b), a.max(b));
            let way = if a <= b { "T" } else { "F" };
            edges.push(self.draft.add(&format!("ORIENTED_EDGE('',*,*,#{edge},.{way}.)")));
        }
        self.draft.replace(record, format!("EDGE_LOOP('',{})", list_of(&edges)));
        Some(())
    }

    /// Vertex and point at a point of the file.
    fn vertex(&mut self, point: u64) -> Option<(u64, u64)> {
        let text = self.draft.text;
        let record = text.get(point)?;
        text.xyz(record)?;
        let key = text.words(text.list(record).get(1)?).to_vec();
        if let Some(&known) = self.vertices.get(&key) {
            return Some(known);
        }
        let vertex = self.draft.add(&format!("VERTEX_POINT('',#{point})"));
        self.vertices.insert(key, (vertex, point));
        Some((vertex, point))
    }

    fn edge(&mut self, a: (u64, u64), b: (u64, u64)) -> u64 {
        if let Some(&known) = self.edges.get(&(a.0, b.0)) {
            return known;
        }
        let way = self.way.unwrap_or_else(|| {
            let x = self.draft.add(&triple("DIRECTION", [1.0, 0.0, 0.0]));
            self.draft.add(&format!("VECTOR('',#{x},1.)"))
        });
        self.way = Some(way);
        let line = self.draft.add(&format!("LINE('',#{},#{way})", a.1));
        let edge = self.draft.add(&format!("EDGE_CURVE('',#{},#{},#{line},.T.)", a.0, b.0));
        self.edges.insert((a.0, b.0), edge);
        edge
    }

    /// A plane under a face that names no surface.
    fn plane(&mut self, record: &Record) -> Option<()> {
        let text = self.draft.text;
        let list = text.list(record);
        let mut normal = DVec3::ZERO;
        let mut first = None;
        for id in references(text, list.get(1)?) {
            let bound = text.get(id)?;
            let corners = references(text, text.list(text.target(bound, 1)?).get(1)?);
            let at = |id: u64| Some(DVec3::from(text.xyz(text.get(id)?)?));
            let points: Vec<DVec3> = corners.into_iter().map(at).collect::<Option<_>>()?;
            let from = *points.first()?;
            let turn: DVec3 = points.windows(2).map(|w| (w[0] - from).cross(w[1] - from)).sum();
            let with = text.words(text.list(bound).get(2)?) != b".F.";
            if turn.length() > normal.length() {
                normal = if with { turn } else { -turn };
                first = Some(from);
            }
        }
        let (from, z) = (first?, normal.try_normalize()?);
        let x = z.any_orthonormal_vector();
        let at = self.draft.add(&triple("CARTESIAN_POINT", from.to_array()));
        let [z, x] = [z, x].map(|d| self.draft.add(&triple("DIRECTION", d.to_array())));
        let place = self.draft.add(&format!("AXIS2_PLACEMENT_3D('',#{at},#{z},#{x})"));
        let plane = self.draft.add(&format!("PLANE('',#{place})"));
        self.draft.put(record.keyword.clone(), "FACE_SURFACE");
        self.draft.put(record.list.end - 1..record.list.end, format!(",#{plane},.T.)"));
        Some(())
    }
}
