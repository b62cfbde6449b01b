//! Grids that are as symmetric as their surface.
//!
//! The whole pipeline runs on one part of the surface, of which all others are images: half of it, or the
//! wedge between two mirror planes or between a plane and its image. The part's grid and its images are joined
//! along the cuts. Then the whole is relaxed once more, so that lines run smoothly across them, and every node
//! is put at the mean of what its images say, which makes it symmetric again to rounding; on a mesh that is symmetric
//! but for its facets, to how far these are off the surface that it stands for.

use super::{Scale, effort, lay, narrow, nodes_for, sampling, verdict, wishes};
use crate::error::{Error, Result};
use crate::grid::{Grid, Place};
use crate::job::Job;
use crate::merit::Sums;
use crate::mesh::Mesh;
use crate::recipe::{Recipe, Symmetry};
use crate::run::{Run, SurfaceSummary, SymmetryReport};
use crate::schedule::{Schedule, Tolerances};
use crate::stages::measure::{irregular_nodes, measure};
use crate::stages::relax;
use crate::surface::symmetry::Miss;
use crate::surface::symmetry::{Part, Wedge};
use crate::surface::{ChainPoint, Group, Locator, Model, Motion, Sampling, Surface, Symmetries};
use crate::validity::Validity;
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// An image may be off the surface by this share of the surface's size.
const OFF_SIZE: f64 = 1e-6;
/// Or by this share of l0.
const OFF_LENGTH: f64 = 1e-3;
/// The smooth surface that a mesh stands for may be off its facets by this share of l0, where symmetries are looked for:
/// no more than a grid may be off its symmetry without it being seen.
const BOW_LENGTH: f64 = 0.02;
/// Nodes that are off their images by more than this, over l0, would be noticed.
const NOTICED: f64 = 0.025;
/// Nodes nearer than this, over l0, are one.
const SAME: f64 = 1e-3;
/// What a stop in here is told as.
const PHASE: &str = "looking for symmetries";
/// Rounds of putting a node on the surface and on its plane.
const ROUNDS: usize = 3;

/// A symmetry of a surface.
pub struct Found {
    group: Group,
    /// How far images may be off the surface for its facets, metres.
    off: f64,
}

/// The symmetry that the recipe asks for; None for none.
///
/// # Errors
/// [`Error::Option`] where the surface does not have the symmetry, with where and by how much.
pub fn group(
    surface: &Surface,
    model: &Model,
    recipe: &Recipe,
    length: f64,
    job: &Job,
) -> Result<Option<Found>> {
    if recipe.symmetry == Symmetry::None {
        return Ok(None);
    }
    let tolerance = (OFF_SIZE * model.size()).max(OFF_LENGTH * length);
    let exact = find(&Symmetries::new(surface, tolerance, job), recipe.symmetry);
    let found = match (&exact, model) {
        (Ok(Some(_)), _) if recipe.symmetry != Symmetry::Auto => exact,
        (_, Model::Mesh(mesh)) => {
            let corner_angle = recipe.corner_angle_deg.to_radians();
            let (max_edge, chord_error) = (f64::INFINITY, f64::INFINITY);
            let facets = mesh.surface(&Sampling { max_edge, chord_error, corner_angle }, job)?;
            let crease_angle = recipe.feature_angle_deg.to_radians();
            let most = BOW_LENGTH * length;
            let near =
                Symmetries::of_facets(&facets, tolerance, [crease_angle, corner_angle], most, job);
            larger(exact, find(&near, recipe.symmetry))
        }
        _ => exact,
    };
    // What was not looked at to the end is neither a symmetry nor none.
    job.check(PHASE)?;
    found.map_err(|Miss { distance, point: p, image }| {
        let at = |p: DVec3| surface.origin.told(p);
        Error::Option(format!(
            "the surface does not have the symmetry {}: the image {} of its point {} is {distance:.3} m off it; \
             leave the symmetry out, or give auto for the one it has",
            recipe.symmetry,
            at(image),
            at(p)
        ))
    })
}

/// What is asked for, if the surface has it; of all symmetries the largest, if there is one.
fn find(symmetries: &Symmetries, wanted: Symmetry) -> std::result::Result<Option<Found>, Miss> {
    let group = match wanted {
        Symmetry::None => return Ok(None),
        Symmetry::Auto => return Ok(symmetries.largest().map(|g| Found::new(g, symmetries))),
        Symmetry::X => symmetries.mirror(DVec2::Y),
        Symmetry::Y => symmetries.mirror(DVec2::X),
        Symmetry::Xy => symmetries.both_mirrors(),
        Symmetry::Turns(n) => symmetries.turns(n),
    };
    group.map(|g| Some(Found::new(g, symmetries)))
}

/// What was found on the surface itself, unless the one that its facets stand for has more.
fn larger(
    exact: std::result::Result<Option<Found>, Miss>,
    near: std::result::Result<Option<Found>, Miss>,
) -> std::result::Result<Option<Found>, Miss> {
    let order = |found: &std::result::Result<Option<Found>, Miss>| {
        found.as_ref().ok().and_then(Option::as_ref).map_or(0, |f| f.group.order())
    };
    if order(&near) > order(&exact) { near } else { exact }
}

impl Found {
    fn new(group: Group, on: &Symmetries) -> Found {
        Found { group, off: on.bow() }
    }
}

/// Lay a grid with the symmetry `found` on `surface`, which was made from `model`.
///
/// # Errors
/// As [`super::generate`].
pub fn generate(
    model: &Model,
    surface: &Surface,
    Found { group, off }: &Found,
    recipe: &Recipe,
    scale: &Scale,
    fixed: Vec<String>,
    job: &Job,
) -> Result<Run> {
    let (length, corner_angle) = (scale.length, recipe.corner_angle_deg.to_radians());
    let wedge = wedge(surface, group, length, job)?;
    let make = |l: f64| -> Result<Part> {
        model.surface(&sampling(l, scale.nodes, recipe), job)?.part(
            &wedge,
            group.order(),
            length,
            corner_angle,
            job,
        )
    };
    let on = std::cell::RefCell::new(Vec::new());
    let (part, _) = wishes::surface(
        recipe,
        length,
        |l| {
            let part = make(l)?;
            on.replace(part.on);
            Ok(part.surface)
        },
        job,
    )?;
    let part = Part { surface: part, on: on.into_inner() };
    let nodes = nodes_for(&part.surface, length);
    // The verdict is on the whole.
    let lenient = Recipe { keep_invalid: true, ..recipe.clone() };
    let mut run = lay(model, &part.surface, &lenient, &Scale { length, nodes }, Vec::new(), job)?;

    let tolerance = (SAME * length).max(2.0 * off);
    let locator = Locator::new(surface);
    let uneven = *off > 0.0;
    let whole = Whole { surface, locator, group, wedge: &wedge, length, tolerance, uneven };
    let part_nodes = run.grid.xyz.len();
    for stage in &mut run.stages {
        let Some(grid) = &stage.grid else { continue };
        let (grid, _) = whole.join(&part, grid)?;
        stage.quality = Some(measure(&grid, surface, length, &recipe.measure));
        stage.grid = Some(grid);
    }
    let (joined, orbits) = whole.join(&part, &run.grid)?;
    let mut relaxed = joined.clone();
    let budget = effort::budgeted(recipe, scale.nodes);
    relax::relax(surface, &mut relaxed, &budget, job);
    whole.symmetrize(&mut relaxed, &orbits);
    let merit = |grid: &Grid| {
        Sums::whole(grid, surface, length, recipe.measure.lambda).merit(recipe.measure.lambda)
    };
    let judged = |grid: Grid| {
        let quality = measure(&grid, surface, length, &recipe.measure);
        let validity = Validity::of(&grid, surface, length, &quality);
        (grid, quality, validity)
    };
    let better = merit(&relaxed) >= merit(&joined);
    let (first, second) = if better { (relaxed, joined) } else { (joined, relaxed) };
    let mut chosen = judged(first);
    if !chosen.2.is_valid() {
        let other = judged(second);
        if other.2.faults.len() < chosen.2.faults.len() {
            chosen = other;
        }
    }
    let (grid, quality, validity) = chosen;
    if uneven {
        whole.check_images(&grid, &orbits)?;
    }
    verdict::check(&validity, recipe, surface.origin, length, job)?;
    if let Some(last) = run.stages.last_mut() {
        last.quality = Some(quality.clone());
        last.grid = Some(grid.clone());
    }
    let schedule = Schedule::new(&grid, surface, &Tolerances::from(&recipe.measure));
    let mut warnings = fixed;
    if uneven {
        warnings.push(format!(
            "the mesh is symmetric but for its facets, whose smooth surface may be {off:.4} m off them: so is the grid"
        ));
    }
    // What is narrow in the part need not be so in the whole.
    warnings.extend(narrow::warnings(surface, &grid, length));
    warnings.extend(validity.warnings());
    warnings.extend(verdict::node_count(recipe, quality.nodes));
    Ok(Run {
        recipe: recipe.clone(),
        valid: validity.is_valid(),
        faults: validity.faults,
        surface: SurfaceSummary::new(model, surface),
        symmetry: Some(SymmetryReport {
            mirrors: group.mirrors().iter().map(|m| m.perp().to_array()).collect(),
            rotations: group.turns,
            centre: surface.origin.world(group.centre.extend(0.0)).truncate().to_array(),
            part_nodes,
        }),
        irregular: irregular_nodes(&grid, surface.origin),
        figures: schedule.figures.clone(),
        stopped: job.stopped(),
        quality,
        warnings,
        grid: Arc::new(grid),
        schedule: Arc::new(schedule),
        ..run
    })
}

/// The wedge of which all others are images.
fn wedge(surface: &Surface, group: &Group, length: f64, job: &Job) -> Result<Wedge> {
    let first = Symmetries::new(surface, OFF_LENGTH * length, job).cut(group);
    job.check(PHASE)?;
    let sectors = if group.mirror.is_some() { 2 * group.turns } else { group.turns };
    let turn = group.mirror.is_none().then(|| Motion::turn(group.centre, 1, group.turns));
    let second = Motion::turn(DVec2::ZERO, 1, sectors).image(first.extend(0.0)).truncate();
    Ok(Wedge { centre: group.centre, rays: [first, second], turn })
}

/// Joins grids of the part to grids of the whole surface.
struct Whole<'a> {
    surface: &'a Surface,
    locator: Locator<'a>,
    group: &'a Group,
    wedge: &'a Wedge,
    /// Wanted member length, metres.
    length: f64,
    tolerance: f64,
    /// The surface is symmetric but for its facets: nodes are put back on them.
    uneven: bool,
}

/// Which nodes are images of one another.
struct Orbits {
    /// Of each node of the part, its image under each motion.
    images: Vec<Vec<u32>>,
    /// The cuts that each node of the part is on.
    on: Vec<[bool; 2]>,
}

impl Whole<'_> {
    /// The grid made of the images of a part's grid.
    ///
    /// # Errors
    /// [`Error::NoGrid`] where they do not fit together.
    fn join(&self, part: &Part, grid: &Grid) -> Result<(Grid, Orbits)> {
        let mut xyz = grid.xyz.clone();
        let mut on: Vec<[bool; 2]> = grid.places.iter().map(|p| cuts(part, p)).collect();
        let mut panels: Vec<[u32; 3]> = grid.mesh.triangles().collect();
        let mut marked: Vec<(u32, u32)> =
            grid.mesh.edges().filter(|&(a, b)| grid.mesh.is_feature_edge(a, b)).collect();
        let mut outside: Vec<bool> = (0..xyz.len())
            .map(|v| grid.mesh.is_boundary(v as u32) && !on[v].contains(&true))
            .collect();
        for (v, p) in xyz.iter_mut().enumerate() {
            *p = self.on_cuts(on[v], *p);
        }
        let partner = match &self.wedge.turn {
            None => Vec::new(),
            Some(turn) => {
                self.match_cuts(turn, &mut xyz, &mut on, &mut panels);
                outside.resize(xyz.len(), false);
                partners(turn, &mut xyz, &on)
            }
        };
        let motions = self.group.motions();
        let images = self.images(&motions, &on, &partner);
        let count = images.iter().flatten().max().map_or(0, |&v| v as usize + 1);
        // Numbers in order of first use.
        let mut number = vec![u32::MAX; count];
        let mut all = Vec::new();
        let mut images = images;
        for g in 0..motions.len() {
            for (v, image) in images.iter_mut().enumerate() {
                let id = &mut number[image[g] as usize];
                if *id == u32::MAX {
                    *id = all.len() as u32;
                    all.push(motions[g].image(xyz[v]));
                }
                image[g] = *id;
            }
        }
        let mut joined = Vec::with_capacity(panels.len() * motions.len());
        for (g, motion) in motions.iter().enumerate() {
            joined.extend(panels.iter().map(|p| {
                let [a, b, c] = p.map(|v| images[v as usize][g]);
                if motion.mirrors() { [a, c, b] } else { [a, b, c] }
            }));
        }
        let misfit = |message: String| Error::NoGrid {
            at: self.surface.origin.world(all[0]).to_array(),
            message: format!("the part's grid and its images do not fit together: {message}"),
            edge_length: 0.5 * self.length,
        };
        let mesh = Mesh::from_triangles(all.len(), &joined).map_err(|e| misfit(e.to_string()))?;
        marked.extend(self.marked_on_cuts(&xyz, &on, &panels));
        let mut whole = Grid { places: Vec::new(), xyz: all, mesh };
        for (a, b) in marked {
            for g in 0..motions.len() {
                whole.mesh.mark_feature(images[a as usize][g], images[b as usize][g])?;
            }
        }
        self.place(&mut whole)?;
        if self.uneven {
            whole.settle_exactly(self.surface);
        }
        Ok((whole, Orbits { images, on }))
    }

    /// Refuse a grid on uneven facets whose nodes are not where their images say.
    ///
    /// # Errors
    /// [`Error::NoGrid`] with the node.
    fn check_images(&self, grid: &Grid, orbits: &Orbits) -> Result<()> {
        let motions = self.group.motions();
        for images in &orbits.images {
            let first = grid.xyz[images[0] as usize];
            for (motion, &v) in motions.iter().zip(images) {
                let p = grid.xyz[v as usize];
                let off = p.distance(motion.image(first));
                if off > NOTICED * self.length {
                    return Err(Error::NoGrid {
                        at: self.surface.origin.world(p).to_array(),
                        message: format!("the node there is {off:.3} m off the image of another"),
                        edge_length: 0.5 * self.length,
                    });
                }
            }
        }
        Ok(())
    }

    /// The point exactly on its cuts where they are mirror planes, or on the axis.
    fn on_cuts(&self, on: [bool; 2], p: DVec3) -> DVec3 {
        let (centre, off) = (self.wedge.centre, p.truncate() - self.wedge.centre);
        if on == [true; 2] {
            return centre.extend(p.z);
        }
        let ray = (0..2).find(|&i| on[i]).filter(|_| self.wedge.turn.is_none());
        ray.map_or(p, |i| {
            let along = self.wedge.rays[i];
            (centre + along * off.dot(along)).extend(p.z)
        })
    }

    /// Give both cuts the same nodes: what one lacks is put into its panel.
    fn match_cuts(
        &self,
        turn: &Motion,
        xyz: &mut Vec<DVec3>,
        on: &mut Vec<[bool; 2]>,
        panels: &mut Vec<[u32; 3]>,
    ) {
        for (from, to) in [(0, 1), (1, 0)] {
            let wanted: Vec<DVec3> = (0..xyz.len())
                .filter(|&v| on[v][from] && !on[v][to])
                .map(|v| if from == 0 { turn.image(xyz[v]) } else { turn.preimage(xyz[v]) })
                .collect();
            for p in wanted {
                if (0..xyz.len()).any(|w| on[w][to] && xyz[w].distance(p) < self.tolerance) {
                    continue;
                }
                let mut edges = Vec::new();
                for (i, panel) in panels.iter().enumerate() {
                    for k in 0..3 {
                        let (a, b) = (panel[k] as usize, panel[(k + 1) % 3] as usize);
                        if on[a][to] && on[b][to] {
                            let around = xyz[a].distance(p) + xyz[b].distance(p);
                            edges.push((around - xyz[a].distance(xyz[b]), i, k));
                        }
                    }
                }
                let Some(&(_, i, k)) = edges.iter().min_by(|x, y| x.0.total_cmp(&y.0)) else {
                    continue;
                };
                let [a, b, c] = [k, (k + 1) % 3, (k + 2) % 3].map(|k| panels[i][k]);
                let m = xyz.len() as u32;
                xyz.push(p);
                on.push(if to == 0 { [true, false] } else { [false, true] });
                panels[i] = [a, m, c];
                panels.push([m, b, c]);
            }
        }
    }

    /// A number for each node of the part under each motion, the same for the same node of the whole.
    fn images(
        &self,
        motions: &[Motion],
        on: &[[bool; 2]],
        partner: &[Option<u32>],
    ) -> Vec<Vec<u32>> {
        let (turns, count) = (self.group.turns as usize, on.len());
        let image = |v: usize, g: usize| -> u32 {
            let (k, mirrored) = (g % turns, g >= turns);
            let id = |v: usize, g: usize| (g * count + v) as u32;
            // The motions that take the node to the same place.
            match (on[v], self.wedge.turn.is_some()) {
                ([true, true], _) => id(v, 0),
                ([false, false], _) | ([true, false], true) => id(v, g),
                ([false, true], true) => match partner[v] {
                    Some(w) => id(w as usize, (k + 1) % turns),
                    None => id(v, g),
                },
                ([true, false], false) => id(v, k),
                ([false, true], false) => {
                    // The second plane's mirroring is the first one's and a turn after it.
                    id(v, if mirrored { (k + turns - 1) % turns } else { k })
                }
            }
        };
        (0..count).map(|v| (0..motions.len()).map(|g| image(v, g)).collect()).collect()
    }

    /// Edges on cuts that lie on features of the whole.
    fn marked_on_cuts(
        &self,
        xyz: &[DVec3],
        on: &[[bool; 2]],
        panels: &[[u32; 3]],
    ) -> Vec<(u32, u32)> {
        let mut marked = Vec::new();
        if self.surface.features.is_empty() {
            return marked;
        }
        for p in panels {
            for k in 0..3 {
                let (a, b) = (p[k] as usize, p[(k + 1) % 3] as usize);
                let cut = (0..2).any(|i| on[a][i] && on[b][i]);
                let near = |p: DVec3| self.on_feature(p, 0.02 * self.length).is_some();
                if cut && near(xyz[a]) && near(xyz[b]) && near((xyz[a] + xyz[b]) * 0.5) {
                    marked.push((a as u32, b as u32));
                }
            }
        }
        marked
    }

    /// The place on a feature of the whole within `slack` metres.
    fn on_feature(&self, p: DVec3, slack: f64) -> Option<ChainPoint> {
        let carrier = &self.surface.carrier;
        let mut best: Option<(f64, ChainPoint)> = None;
        for (c, chain) in self.surface.features.iter().enumerate() {
            for k in 0..chain.segments.len() {
                let ends = [k, (k + 1) % chain.vertices.len()].map(|k| chain.vertices[k]);
                let [a, b] = ends.map(|v| carrier.points[v as usize]);
                let d = b - a;
                let f = ((p - a).dot(d) / d.length_squared()).clamp(0.0, 1.0);
                let off = (a + d * f).distance(p);
                if off <= slack && best.is_none_or(|(least, _)| off < least) {
                    let s = chain.arc[k] + (chain.arc[k + 1] - chain.arc[k]) * f;
                    best = Some((off, ChainPoint { chain: c as u32, s }));
                }
            }
        }
        best.map(|b| b.1)
    }

    /// Find the places of all nodes.
    fn place(&self, grid: &mut Grid) -> Result<()> {
        let surface = self.surface;
        let missing =
            || Error::Surface("the surface has no boundary where the grid has one".into());
        let places: Option<Vec<Place>> = grid
            .xyz
            .iter()
            .enumerate()
            .map(|(v, &p)| {
                let v = v as u32;
                if grid.mesh.is_boundary(v) {
                    let at = self.locator.nearest_on_loops(p)?;
                    let chain = &surface.loops[at.chain as usize];
                    let corner =
                        chain.corners.iter().map(|&k| chain.arc[k as usize]).find(|&s| {
                            chain.xyz(&surface.carrier, s).distance(p) <= self.tolerance
                        });
                    return Some(match corner {
                        Some(s) => Place::Corner(ChainPoint { s, ..at }),
                        None => Place::Boundary(at),
                    });
                }
                let fixed = surface
                    .fixed
                    .iter()
                    .find(|f| surface.carrier.xyz(f).distance(p) <= self.tolerance);
                if let Some(&f) = fixed {
                    return Some(Place::Fixed(f));
                }
                let along = !grid.mesh.along_features(v).is_empty();
                let feature = along.then(|| self.on_feature(p, self.length)).flatten();
                match feature {
                    Some(at) => Some(Place::Feature(at)),
                    None => self.locator.nearest(p).map(Place::Interior),
                }
            })
            .collect();
        grid.places = places.ok_or_else(missing)?;
        Ok(())
    }

    /// Put every node at the mean of what its images say, on the exact surface.
    fn symmetrize(&self, grid: &mut Grid, orbits: &Orbits) {
        let motions = self.group.motions();
        for (v, images) in orbits.images.iter().enumerate() {
            let on = orbits.on[v];
            if self.wedge.turn.is_some() && on == [false, true] {
                continue;
            }
            let said = images.iter().zip(&motions).map(|(&i, m)| m.preimage(grid.xyz[i as usize]));
            let mut p = said.sum::<DVec3>() / motions.len() as f64;
            for _ in 0..ROUNDS {
                p = self.on_cuts(on, p);
                p = self.foot(&grid.places[images[0] as usize], p);
            }
            p = self.on_cuts(on, p);
            for (&i, m) in images.iter().zip(&motions) {
                grid.xyz[i as usize] = m.image(p);
            }
        }
        // The places of images are where they are now; they were there before.
        if let Err(e) = self.place(grid) {
            unreachable!("a boundary does not go away: {e}");
        }
        if self.uneven {
            grid.settle_exactly(self.surface);
        }
    }

    /// The exact point of the surface, or of the line that the place is on, nearest to `p`.
    fn foot(&self, place: &Place, p: DVec3) -> DVec3 {
        let surface = self.surface;
        match place {
            Place::Interior(at) => surface.foot(&surface.carrier.follow(at, p), p),
            Place::Boundary(_) => {
                let Some(at) = self.locator.nearest_on_loops(p) else { return p };
                surface.loops[at.chain as usize].foot(surface, at.s, p)
            }
            Place::Feature(at) => {
                let at = self.on_feature(p, f64::INFINITY).unwrap_or(*at);
                surface.features[at.chain as usize].foot(surface, at.s, p)
            }
            Place::Corner(_) | Place::Fixed(_) => place.exact(surface),
        }
    }
}

/// Of each node on the second cut, the one on the first whose image it is; puts it exactly there.
fn partners(turn: &Motion, xyz: &mut [DVec3], on: &[[bool; 2]]) -> Vec<Option<u32>> {
    let first: Vec<usize> = (0..xyz.len()).filter(|&v| on[v] == [true, false]).collect();
    let mut partner = vec![None; xyz.len()];
    for w in (0..xyz.len()).filter(|&w| on[w] == [false, true]) {
        let p = turn.preimage(xyz[w]);
        let nearest = first
            .iter()
            .min_by(|&&a, &&b| xyz[a].distance_squared(p).total_cmp(&xyz[b].distance_squared(p)));
        if let Some(&v) = nearest {
            partner[w] = Some(v as u32);
            xyz[w] = turn.image(xyz[v]);
        }
    }
    partner
}

/// The cuts that a place of the part is on.
fn cuts(part: &Part, place: &Place) -> [bool; 2] {
    let (Place::Boundary(at) | Place::Corner(at)) = place else { return [false; 2] };
    let chain = &part.surface.loops[at.chain as usize];
    let (k, f) = chain.locate(at.s);
    let n = chain.vertices.len();
    let [a, b] = [k, k + 1].map(|k| part.on[chain.vertices[k % n] as usize]);
    match f {
        0.0 => a,
        1.0 => b,
        _ => [a[0] && b[0], a[1] && b[1]],
    }
}
