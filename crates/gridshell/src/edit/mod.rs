//! Edit a grid by hand: every operation with its effect told before it is done, refusals with reasons, undo and redo
//! without limit, and a log that replays bit for bit.
//!
//! ```
//! use gridshell::edit::{Edit, Editor};
//! use gridshell::{io, job::Job, pipeline, recipe::Recipe};
//! # use gridshell::{recipe::Effort, surface::Sampling};
//! use std::sync::Arc;
//!
//! let recipe = Recipe { edge_length: Some(0.8), effort: Effort::Draft, ..Recipe::default() };
//! let job = Job::default();
//! let model = io::open("hexagon", &job)?;
//! let run = pipeline::generate(&model, &recipe, &job)?;
//! # let sampling = Sampling { max_edge: 0.4, chord_error: 1e-3, corner_angle: 0.5 };
//! # let surface = model.surface(&sampling, &job)?;
//! # let panels: Vec<_> = run.grid.mesh.triangles().collect();
//! # let grid = gridshell::grid::Grid::from_panels(run.grid.xyz.clone(), &panels, &surface)?;
//! let mut editor = Editor::new(Arc::new(surface), grid, recipe, 0.8);
//! let member = editor.grid().mesh.edges().find(|&(a, _)| !editor.grid().mesh.is_boundary(a));
//! let (a, b) = member.expect("a member inside");
//! match editor.apply(Edit::Flip { nodes: [a, b] }) {
//!     Ok(effect) => println!("R changed by {}", effect.residual()),
//!     Err(refusal) => println!("{refusal}"),
//! }
//! editor.undo();
//! # Ok::<(), gridshell::Error>(())
//! ```
//!
//! An edit is carried out on a copy of the grid: the operation, then the nodes round it are balanced, put on the exact
//! surface, and their panels looked at. What differs is then swapped into the editor's grid, and back again by undo.
//! Everything is worked out from the grid alone, so replaying a log gives the same bits.

mod anchor;
mod change;
mod effect;
mod guide;
mod line;
mod log;
mod operation;
mod perform;
mod refusal;
mod row;
mod suggest;
mod workbench;

#[cfg(test)]
mod tests;

pub use effect::{Effect, Figures};
pub use log::{Log, SCHEMA};
pub use operation::Edit;
pub use refusal::Refusal;

use crate::degree::{REGULAR, adjusted_degree};
use crate::grid::{Grid, Place};
use crate::job::Job;
use crate::merit::Sums;
use crate::recipe::Recipe;
use crate::stages::measure::measure;
use crate::surface::Surface;
use crate::validity::Validity;
use change::Change;
use std::sync::Arc;
use workbench::Workbench;

/// Nodes read from a file stand at a corner when they are no further from it than this, over l0.
const AT_CORNER: f64 = 1e-3;

/// A grid being edited.
pub struct Editor {
    surface: Arc<Surface>,
    grid: Grid,
    recipe: Recipe,
    edge_length: f64,
    start: String,
    sums: Sums,
    irregular: usize,
    done: Vec<Entry>,
    undone: Vec<Entry>,
    /// What is told of the edit that is being done.
    job: Job,
}

/// An edit in the history.
struct Entry {
    edit: Edit,
    effect: Effect,
    change: Change,
    /// The surface on the other side of the change, where it changed too.
    surface: Option<Arc<Surface>>,
}

/// What comes of an edit.
struct Outcome {
    effect: Effect,
    grid: Grid,
    /// The surface, where the edit changed it.
    surface: Option<Arc<Surface>>,
}

impl Editor {
    /// Edit `grid` on `surface`, where members of `edge_length` metres were wanted by `recipe`. Boundary nodes that
    /// stand at corners of the surface are fixed there: grids from other formats do not say so themselves.
    pub fn new(surface: Arc<Surface>, mut grid: Grid, recipe: Recipe, edge_length: f64) -> Editor {
        fix_corners(&surface, &mut grid, AT_CORNER * edge_length);
        grid.mesh.retire_removed();
        let start = log::digest(&grid, surface.origin, &recipe, edge_length);
        let (done, undone) = (Vec::new(), Vec::new());
        let sums = Sums::default();
        let irregular = 0;
        let job = Job::default();
        let mut editor = Editor {
            surface,
            grid,
            recipe,
            edge_length,
            start,
            sums,
            irregular,
            done,
            undone,
            job,
        };
        editor.count();
        editor
    }

    /// The grid as it is. Ids are stable, so removed nodes leave gaps: see [`Editor::finished`].
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The grid as it is, its nodes numbered anew without gaps, in the same order.
    pub fn finished(&self) -> Grid {
        let mut grid = self.grid.clone();
        let old = grid.mesh.compact();
        grid.places = old.iter().map(|&v| self.grid.places[v as usize]).collect();
        grid.xyz = old.iter().map(|&v| self.grid.xyz[v as usize]).collect();
        grid
    }

    /// The surface that it lies on.
    pub fn surface(&self) -> &Arc<Surface> {
        &self.surface
    }

    /// What is wrong with `grid`, this editor's as it was or [as it is](Editor::finished).
    pub fn validity(&self, grid: &Grid) -> Validity {
        let quality = measure(grid, &self.surface, self.edge_length, &self.recipe.measure);
        Validity::of(grid, &self.surface, self.edge_length, &quality)
    }

    /// The figures of the grid as it is.
    pub fn figures(&self) -> Figures {
        let nodes = self.grid.mesh.vertex_count();
        Figures::new(&self.sums, self.irregular, nodes, self.lambda())
    }

    /// What `edit` would do; the grid stays as it is. Takes about a millisecond for 5,000 nodes, but for `Relax` and
    /// `Heal`, which take as long as doing them.
    ///
    /// # Errors
    /// [`Refusal`] where it would not be done.
    pub fn preview(&self, edit: &Edit) -> Result<Effect, Refusal> {
        self.outcome(edit).map(|o| o.effect)
    }

    /// What comes of an edit.
    fn outcome(&self, edit: &Edit) -> Result<Outcome, Refusal> {
        match edit {
            Edit::AddGuide { points } => guide::add(self, points),
            Edit::RemoveGuide { nodes } => guide::remove(self, *nodes),
            _ => {
                let mut bench = Workbench::new(self);
                let effect = bench.carry_out(edit)?;
                Ok(Outcome { effect, grid: bench.into_grid(), surface: None })
            }
        }
    }

    /// What each operation on the member between `a` and `b` would do.
    pub fn hover(&self, a: u32, b: u32) -> [(Edit, Result<Effect, Refusal>); 4] {
        let nodes = [a, b];
        let mut bench = Workbench::new(self);
        let drift = Edit::Drift { nodes, toward: None, steps: None };
        [Edit::Flip { nodes }, Edit::Split { nodes }, Edit::Collapse { nodes }, drift].map(|edit| {
            let effect = bench.carry_out(&edit);
            bench.take_back();
            (edit, effect)
        })
    }

    /// Do it; what was undone can no longer be redone.
    ///
    /// # Errors
    /// [`Refusal`], with the grid as it was.
    pub fn apply(&mut self, edit: Edit) -> Result<Effect, Refusal> {
        self.apply_with(edit, &Job::default())
    }

    /// As [`Editor::apply`], telling `job` how far relaxing is. Healing and relaxing end when it is cancelled; then
    /// nothing is done.
    ///
    /// # Errors
    /// As [`Editor::apply`], and where the job was stopped.
    pub fn apply_with(&mut self, edit: Edit, job: &Job) -> Result<Effect, Refusal> {
        self.job = job.clone();
        let outcome = self.outcome(&edit);
        self.job = Job::default();
        if job.stopped() {
            return Err(Refusal::new(format!("{edit} was stopped"), "the grid is as it was"));
        }
        let Outcome { effect, grid, surface } = outcome?;
        let change = Change::between(&self.grid, &grid);
        let mut entry = Entry { edit, effect, change, surface };
        self.swap(&mut entry);
        self.undone.clear();
        self.done.push(entry);
        Ok(effect)
    }

    /// Take the last edit back; gives it.
    pub fn undo(&mut self) -> Option<&Edit> {
        let mut entry = self.done.pop()?;
        self.swap(&mut entry);
        self.undone.push(entry);
        self.undone.last().map(|e| &e.edit)
    }

    /// Do again what was taken back last; gives it.
    pub fn redo(&mut self) -> Option<&Edit> {
        let mut entry = self.undone.pop()?;
        self.swap(&mut entry);
        self.done.push(entry);
        self.done.last().map(|e| &e.edit)
    }

    /// What was done, oldest first, each with its effect.
    pub fn history(&self) -> impl DoubleEndedIterator<Item = (&Edit, &Effect)> + ExactSizeIterator {
        self.done.iter().map(|e| (&e.edit, &e.effect))
    }

    /// What was taken back and can be done again, the next one first.
    pub fn undone(&self) -> impl DoubleEndedIterator<Item = (&Edit, &Effect)> + ExactSizeIterator {
        self.undone.iter().rev().map(|e| (&e.edit, &e.effect))
    }

    /// Go to the other side of an edit.
    fn swap(&mut self, entry: &mut Entry) {
        entry.change.swap(&mut self.grid);
        if let Some(surface) = &mut entry.surface {
            std::mem::swap(surface, &mut self.surface);
        }
        self.count();
    }

    /// Another editor with this one's wishes, to try something on.
    fn on(&self, surface: Arc<Surface>, grid: Grid) -> Editor {
        let mut editor = Editor {
            surface,
            grid,
            recipe: self.recipe.clone(),
            edge_length: self.edge_length,
            start: String::new(),
            sums: Sums::default(),
            irregular: 0,
            done: Vec::new(),
            undone: Vec::new(),
            job: self.job.clone(),
        };
        editor.count();
        editor
    }

    fn lambda(&self) -> f64 {
        self.recipe.measure.lambda
    }

    fn count(&mut self) {
        let lambda = self.lambda();
        self.sums = Sums::whole(&self.grid, &self.surface, self.edge_length, lambda);
        let all: Vec<u32> = self.grid.mesh.vertices().collect();
        self.irregular = irregular(&self.grid, &all);
    }
}

/// How many of these nodes are irregular.
fn irregular(grid: &Grid, nodes: &[u32]) -> usize {
    nodes.iter().filter(|&&v| adjusted_degree(&grid.mesh, &grid.xyz, v) != REGULAR).count()
}

fn fix_corners(surface: &Surface, grid: &mut Grid, near: f64) {
    for (v, place) in grid.places.iter_mut().enumerate() {
        if let Place::Boundary(at) = *place {
            let chain = &surface.loops[at.chain as usize];
            let corner = chain.corners.iter().map(|&k| chain.vertices[k as usize]);
            let mut corners = corner.map(|c| surface.carrier.points[c as usize]);
            if corners.any(|c| c.distance(grid.xyz[v]) <= near) {
                *place = Place::Corner(at);
            }
        }
        if place.is_fixed() {
            grid.mesh.pin(v as u32, true);
        }
    }
}
