//! What a structural engineer reads of the file: nodes as point connections, members between them with the surface's
//! normal as local z, and which nodes are held. Supports hold all displacements and no rotation.

use super::super::GridFile;
use super::Common;
use super::step::{Step, encoded, references};
use crate::schedule::Schedule;

/// The model and its place in the building.
pub(super) fn put(w: &mut Step, grid: &GridFile, common: &Common, building: usize) {
    let nodes = nodes(w, grid, common);
    let members = members(w, grid, common, &nodes);
    let all = references(nodes.connections().chain(members.iter().copied()));
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
struct Nodes {
    /// The vertex of the first one.
    vertex: usize,
    /// The place of each node's joint among those that are written.
    place: Vec<usize>,
    /// How many are written.
    count: usize,
}

impl Nodes {
    /// Entities of a node: its vertex, representation, shape and connection.
    const EACH: usize = 4;

    /// Those of these joints, behind the entity `last`: nodes at one place are one.
    fn new(last: usize, joints: &[u32]) -> Nodes {
        let (mut place, mut count) = (Vec::with_capacity(joints.len()), 0);
        for (v, &joint) in joints.iter().enumerate() {
            let own = joint as usize == v;
            place.push(if own { count } else { place[joint as usize] });
            count += usize::from(own);
        }
        Nodes { vertex: last + 1, place, count }
    }

    fn vertex(&self, v: usize) -> usize {
        self.vertex + Nodes::EACH * self.place[v]
    }

    fn connection(&self, v: usize) -> usize {
        self.vertex(v) + Nodes::EACH - 1
    }

    fn connections(&self) -> impl Iterator<Item = usize> {
        let first = self.vertex + Nodes::EACH - 1;
        (0..self.count).map(move |k| first + Nodes::EACH * k)
    }
}

/// All nodes, the supported ones with what holds them.
fn nodes(w: &mut Step, grid: &GridFile, common: &Common) -> Nodes {
    let Common { placement, reference, points, .. } = common;
    let (held, free) = ("IFCBOOLEAN(.T.)", "IFCBOOLEAN(.F.)");
    let hinge = w.put(format_args!(
        "IFCBOUNDARYNODECONDITION('Support',{held},{held},{held},{free},{free},{free})"
    ));
    let joints = grid.joints();
    let supported = grid.held(&joints);
    let nodes = Nodes::new(w.last, &joints);
    for v in (0..joints.len()).filter(|&v| joints[v] as usize == v) {
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
fn members(w: &mut Step, grid: &GridFile, common: &Common, nodes: &Nodes) -> Vec<usize> {
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
