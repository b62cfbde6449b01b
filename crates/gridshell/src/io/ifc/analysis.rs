//! What a structural engineer reads of the file: nodes as point connections, members between them with the surface's
//! normal as local z, and which nodes are held. Supports hold all displacements and no rotation.

use super::super::GridFile;
use super::Common;
use super::step::{Step, encoded, references};
use crate::schedule::Schedule;

/// The model and its place in the building.
pub(super) fn put(w: &mut Step, grid: &GridFile, common: &Common, building: usize) {
    let first = nodes(w, grid, common);
    let members = members(w, grid, common, first);
    let count = grid.schedule.nodes.xyz.len();
    let all = references((0..count).map(|v| first.connection(v)).chain(members.iter().copied()));
    let id = w.id("analysis");
    let model = w.put(format_args!(
        "IFCSTRUCTURALANALYSISMODEL('{id}',$,'Frame',$,$,.LOADING_3D.,$,$,$,#{})",
        common.placement
    ));
    let id = w.id("parts of analysis");
    w.put(format_args!("IFCRELASSIGNSTOGROUP('{id}',$,$,$,({all}),$,#{model})"));
    let id = w.id("analysis of building");
    w.put(format_args!("IFCRELSERVICESBUILDINGS('{id}',$,$,$,#{model},(#{building}))"));
    section(w, grid, common, &references(members.into_iter()));
}

/// Where the entities of nodes are.
#[derive(Clone, Copy)]
struct Nodes {
    /// The vertex of the first one.
    vertex: usize,
}

impl Nodes {
    /// Entities of a node: its vertex, representation, shape and connection.
    const EACH: usize = 4;

    fn vertex(self, v: usize) -> usize {
        self.vertex + Nodes::EACH * v
    }

    fn connection(self, v: usize) -> usize {
        self.vertex(v) + Nodes::EACH - 1
    }
}

/// All nodes, the supported ones with what holds them.
fn nodes(w: &mut Step, grid: &GridFile, common: &Common) -> Nodes {
    let Common { placement, reference, points, .. } = common;
    let (held, free) = ("IFCBOOLEAN(.T.)", "IFCBOOLEAN(.F.)");
    let hinge = w.put(format_args!(
        "IFCBOUNDARYNODECONDITION('Support',{held},{held},{held},{free},{free},{free})"
    ));
    let supported = grid.supported();
    let nodes = Nodes { vertex: w.last + 1 };
    for v in 0..grid.schedule.nodes.xyz.len() {
        let vertex = w.put(format_args!("IFCVERTEXPOINT(#{})", points + v));
        let shape = w.put(format_args!(
            "IFCTOPOLOGYREPRESENTATION(#{reference},'Reference','Vertex',(#{vertex}))"
        ));
        let shape = w.put(format_args!("IFCPRODUCTDEFINITIONSHAPE($,$,(#{shape}))"));
        let id = w.id(format_args!("node {v}"));
        let condition = if supported[v] { format!("#{hinge}") } else { "$".to_owned() };
        w.put(format_args!(
            "IFCSTRUCTURALPOINTCONNECTION('{id}',$,'N{v}',$,$,#{placement},#{shape},{condition},$)"
        ));
    }
    nodes
}

/// All members, joined to their nodes; gives their numbers.
fn members(w: &mut Step, grid: &GridFile, common: &Common, nodes: Nodes) -> Vec<usize> {
    let Common { placement, reference, .. } = common;
    let Schedule { members, .. } = grid.schedule;
    let mut numbers = Vec::with_capacity(members.ends.len());
    for (k, ends) in members.ends.iter().enumerate() {
        let [a, b] = ends.map(|v| v as usize);
        let edge = w.put(format_args!("IFCEDGE(#{},#{})", nodes.vertex(a), nodes.vertex(b)));
        let shape = w.put(format_args!(
            "IFCTOPOLOGYREPRESENTATION(#{reference},'Reference','Edge',(#{edge}))"
        ));
        let shape = w.put(format_args!("IFCPRODUCTDEFINITIONSHAPE($,$,(#{shape}))"));
        let up = w.triple("IFCDIRECTION", members.normal[k]);
        let id = w.id(format_args!("axis of member {k}"));
        let member = w.put(format_args!(
            "IFCSTRUCTURALCURVEMEMBER('{id}',$,'M{k}',$,$,#{placement},#{shape},.RIGID_JOINED_MEMBER.,#{up})"
        ));
        for v in [a, b] {
            let id = w.id(format_args!("member {k} at node {v}"));
            let node = nodes.connection(v);
            w.put(format_args!(
                "IFCRELCONNECTSSTRUCTURALMEMBER('{id}',$,$,$,#{member},#{node},$,$,$,$)"
            ));
        }
        numbers.push(member);
    }
    numbers
}

/// The section and the material of the members.
fn section(w: &mut Step, grid: &GridFile, common: &Common, members: &str) {
    let name = encoded(&grid.structure.section.name);
    let Common { profile, material, .. } = common;
    let profile = w
        .put(format_args!("IFCMATERIALPROFILE('{name}',$,#{material},#{profile},$,'LoadBearing')"));
    let set = w.put(format_args!("IFCMATERIALPROFILESET('{name}',$,(#{profile}),$)"));
    let id = w.id("section of frame");
    w.put(format_args!("IFCRELASSOCIATESMATERIAL('{id}',$,$,$,({members}),#{set})"));
}
