//! A grid as OpenSees input (Tcl): an elastic frame under its own weight, as a check that it stands. Newtons and metres;
//! one command a line, without loops. Tags are the numbers of nodes and members plus 1.

use super::GridFile;
use crate::io::WRITING;
use crate::job::Job;
use crate::schedule::Schedule;
use crate::structure::Properties;
use glam::DVec3;
use std::fmt::Write;

/// Standard gravity, m/s2.
const GRAVITY: f64 = 9.80665;

/// The file's bytes.
pub(super) fn encode(grid: &GridFile, job: &Job) -> Vec<u8> {
    let Schedule { nodes, members, .. } = grid.schedule;
    let (section, material) = (&grid.structure.section, &grid.structure.material);
    let Properties { area, iy, iz, torsion } = section.shape.properties();
    let (youngs, shear) = (material.youngs_mpa * 1e6, material.shear_mpa * 1e6);
    let weight = grid.structure.member_mass(1.0) * GRAVITY;

    let mut out = format!("# {}\n", grid.headline());
    let _ = writeln!(out, "# N, m. Section {}, material {}.", section.name, material.name);
    out.push_str("wipe\nmodel BasicBuilder -ndm 3 -ndf 6\n");
    let joints = grid.joints();
    let own = |v: &u32| joints[*v as usize] == *v;
    let nodes_of = nodes.xyz.iter().enumerate().filter(|(v, _)| own(&(*v as u32)));
    for (v, p) in nodes_of.take_while(|_| !job.is_over(WRITING)) {
        let _ = writeln!(out, "node {} {} {} {}", v + 1, p.x, p.y, p.z);
    }
    let supported = grid.held(&joints);
    for v in (0..supported.len()).filter(|&v| supported[v]) {
        let _ = writeln!(out, "fix {} 1 1 1 0 0 0", v + 1);
    }
    for (k, [a, b]) in members.ends.iter().enumerate().take_while(|_| !job.is_over(WRITING)) {
        let (tag, n) = (k + 1, members.normal[k]);
        let _ = writeln!(out, "geomTransf Linear {tag} {} {} {}", n.x, n.y, n.z);
        let _ = writeln!(
            out,
            "element elasticBeamColumn {tag} {} {} {area} {youngs} {shear} {torsion} {iy} {iz} {tag}",
            joints[*a as usize] + 1,
            joints[*b as usize] + 1
        );
    }
    out.push_str("timeSeries Linear 1\npattern Plain 1 1 {\n");
    for (k, [a, b]) in members.ends.iter().enumerate().take_while(|_| !job.is_over(WRITING)) {
        let x = (nodes.xyz[*b as usize] - nodes.xyz[*a as usize]).normalize_or_zero();
        let z = members.normal[k];
        let y = z.cross(x);
        let load = DVec3::new(0.0, 0.0, -weight);
        let [along, across, up] = [load.dot(x), load.dot(y), load.dot(z)];
        let _ = writeln!(out, "eleLoad -ele {} -type -beamUniform {across} {up} {along}", k + 1);
    }
    let total = weight * grid.schedule.figures.length.total;
    out.push_str("}\nsystem UmfPack\nnumberer RCM\nconstraints Plain\nintegrator LoadControl 1\n");
    out.push_str("algorithm Linear\nanalysis Static\nanalyze 1\nreactions\n");
    let _ = writeln!(out, "# The vertical reactions add up to the weight, {total} N.");
    out.into_bytes()
}
