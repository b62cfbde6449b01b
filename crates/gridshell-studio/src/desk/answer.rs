//! What tabs ask for, answered.

use super::{Desk, Outgoing, fault, runs};
use crate::form::Values;
use crate::laid::Laid;
use crate::message::{Event, Request, Shows};
use crate::opened::Opened;
use crate::{candidate, color, editing, measures, pick, scene};
use glam::DVec3;
use gridshell::edit::{Edit, Editor};
use gridshell::error::{Error, Result};
use gridshell::io::Choice;
use gridshell::job::Job;
use gridshell::pipeline;
use gridshell::recipe::Recipe;
use gridshell::stages::measure::irregular_nodes;
use gridshell::surface::Origin;
use serde_json::Value;
use std::sync::Arc;

impl Desk {
    /// Answer what a tab asks for.
    pub fn answer(self: &Arc<Self>, request: Request) -> Vec<Outgoing> {
        let about = match &request {
            Request::Open { .. } | Request::Choose { .. } => "open",
            Request::Estimate { .. } => "estimate",
            Request::Generate { .. } => "generate",
            _ => "message",
        };
        self.try_answer(request).unwrap_or_else(|error| vec![fault(about, &error.to_string())])
    }

    fn try_answer(self: &Arc<Self>, request: Request) -> Result<Vec<Outgoing>> {
        let one = |event| Ok(vec![Outgoing::Event(event)]);
        match request {
            Request::Open { name } => {
                self.put(&Arc::new(Opened::built_in(&name, &self.opening())?));
                Ok(Vec::new())
            }
            Request::Choose { layers, objects } => {
                let opened = self.opened()?.chosen(Choice { layers, objects }, &self.opening())?;
                self.put(&Arc::new(opened));
                Ok(Vec::new())
            }
            Request::Recover { session } => {
                self.recover(&session)?;
                Ok(Vec::new())
            }
            Request::Discard { session } => {
                self.take_left(&session)?.discard();
                Ok(Vec::new())
            }
            Request::Estimate { values } => one(self.estimate(&values)?),
            Request::Generate { values } => {
                self.generate(&values)?;
                Ok(Vec::new())
            }
            Request::Cancel => {
                self.cancel();
                Ok(Vec::new())
            }
            Request::Look { run, stage } => self.look(run, stage.as_deref()),
            Request::Color { run, by } => {
                let laid = self.laid(run)?;
                let frame = color::frame(&laid, &by);
                let frame = frame.ok_or_else(|| Error::Option(format!("no coloring `{by}`")))?;
                Ok(vec![Outgoing::Frame(frame)])
            }
            Request::Pick { run, origin, direction, question } => {
                let laid = self.laid(run)?;
                let [origin, direction] = [origin, direction].map(DVec3::from);
                let (grid, drawn) = (laid.grid(), laid.opened.model.origin());
                one(Event::Picked(pick::pick(&grid, drawn, run, question, origin, direction)))
            }
            Request::Select { run, matrix, rectangle } => one(self.select(run, matrix, rectangle)?),
            Request::Distance { from, to } => {
                let d = DVec3::from(to) - DVec3::from(from);
                one(Event::Distance {
                    straight: d.length(),
                    plan: d.truncate().length(),
                    height: d.z,
                })
            }
            Request::Candidates { run } => {
                let laid = self.laid(run)?;
                Ok(vec![Outgoing::Frame(scene::thumbnails(run, candidate::grids(&laid)))])
            }
            Request::Candidate { run, index } => {
                let laid = self.laid(run)?;
                let grid = candidate::grid(&laid, index)?;
                Ok(vec![Outgoing::Frame(scene::grid(Shows::Stage, run, grid))])
            }
            Request::Take { run, index } => self.take(run, index),
            Request::Edit { run, edit } => self.edit(run, edit),
            Request::Undo { run } => {
                self.change(run, "undo", |editor, _| done(editor.undo(), "undo"))
            }
            Request::Redo { run } => {
                self.change(run, "redo", |editor, _| done(editor.redo(), "redo"))
            }
            Request::Hover { run, nodes, question } => {
                let trial = self.laid(run)?.trial();
                one(editing::hover(run, question, &trial, nodes))
            }
            Request::Suggest { run } => {
                let trial = self.laid(run)?.trial();
                one(editing::suggest(run, &trial))
            }
            Request::Saved { run, version } => {
                self.saved(run, version)?;
                Ok(Vec::new())
            }
            Request::Forget { run } => {
                self.forget(run);
                Ok(Vec::new())
            }
        }
    }

    fn estimate(&self, values: &Values) -> Result<Event> {
        let opened = self.opened()?;
        let recipe = self.recipe(values)?;
        let edge_length = edge_length(&opened, &recipe)?;
        // What makes so many nodes makes members of so many metres: the inverse by bisection of a falling function.
        let (mut low, mut high) = (3.0_f64, 2e6_f64);
        while high - low > 0.5 {
            let middle = f64::midpoint(low, high);
            if pipeline::length_for(&opened.sketch, middle as usize) > edge_length {
                low = middle;
            } else {
                high = middle;
            }
        }
        Ok(Event::Estimate { edge_length, nodes: high.round() as u32 })
    }

    /// The nodes inside a rectangle of the screen.
    fn select(&self, run: u32, matrix: Vec<f64>, rectangle: [f64; 4]) -> Result<Event> {
        let grid = self.laid(run)?.grid();
        let matrix =
            matrix.try_into().map_err(|_| Error::Option("a matrix has 16 numbers".into()))?;
        let nodes = pick::within(&grid, &matrix, rectangle);
        let odd = irregular_nodes(&grid, Origin::default());
        let odd = odd.iter().filter(|n| nodes.binary_search(&n.node).is_ok());
        let irregular = odd.count() as u32;
        Ok(Event::Selected { run, nodes, irregular })
    }

    /// Keep a candidate as a grid of its own.
    fn take(self: &Arc<Self>, run: u32, index: u32) -> Result<Vec<Outgoing>> {
        let laid = self.laid(run)?;
        let origin = format!("candidate {} of run {run}", index + 1);
        let work = self.begin(run, &origin)?;
        let taken = candidate::taken(&laid, index, &work.job)?;
        drop(work);
        let number = self.number();
        self.keep(Laid::of_run(number, taken, Arc::clone(&laid.opened), Some(origin)));
        Ok(Vec::new())
    }

    /// Do an edit.
    fn edit(self: &Arc<Self>, run: u32, edit: Value) -> Result<Vec<Outgoing>> {
        let edit = editing::parse(edit, self.laid(run)?.opened.model.origin())?;
        let what = edit.to_string();
        self.change(run, &what, |editor, job| {
            let done = editor.apply_with(edit, job).map(|_| ());
            done.map_err(|refusal| Error::Option(refusal.to_string()))
        })
    }

    /// Change a run's grid; every tab is told. One change goes on at a time.
    pub(super) fn change(
        self: &Arc<Self>,
        run: u32,
        what: &str,
        change: impl FnOnce(&mut Editor, &Job) -> Result<()>,
    ) -> Result<Vec<Outgoing>> {
        // Before the grid is looked for: one that is being changed is not put away.
        let work = self.begin(run, what)?;
        let laid = self.laid(run)?;
        laid.change(&work.job, change)?;
        for outgoing in self.look(run, None)? {
            self.send(outgoing);
        }
        let state = self.state();
        if let Some(session) = &state.session {
            session.save(&laid);
        }
        self.tell(runs(&state));
        drop(state);
        drop(work);
        Ok(Vec::new())
    }

    fn look(&self, run: u32, stage: Option<&str>) -> Result<Vec<Outgoing>> {
        let laid = self.laid(run)?;
        if let Some(name) = stage {
            let stages = laid.design.run.iter().flat_map(|run| &run.stages);
            let found = stages.filter(|s| s.name == name).find_map(|s| s.grid.as_ref());
            let grid =
                found.ok_or_else(|| Error::Option(format!("no stage `{name}` with a grid")))?;
            return Ok(vec![Outgoing::Frame(scene::grid(Shows::Stage, run, grid))]);
        }
        self.used(&laid);
        let now = laid.now();
        let info = measures::told(laid.summary(), &laid, &now);
        let history = now.history.clone();
        let frame = scene::grid(Shows::Grid, run, &now.grid);
        Ok(vec![
            Outgoing::Frame(frame),
            Outgoing::Event(Event::Run(info)),
            Outgoing::Event(history),
        ])
    }
}

/// Whether there was anything to undo or redo.
fn done(edit: Option<&Edit>, what: &str) -> Result<()> {
    edit.map(|_| ()).ok_or_else(|| Error::Option(format!("there is nothing to {what}")))
}

/// The member length that a recipe aims at, metres.
fn edge_length(opened: &Opened, recipe: &Recipe) -> Result<f64> {
    match (recipe.edge_length, recipe.nodes) {
        (Some(length), _) => {
            Recipe::check_edge_length(length, opened.sketch.area)?;
            Ok(length)
        }
        (None, Some(nodes)) => Ok(pipeline::length_for(&opened.sketch, nodes)),
        (None, None) => Ok(opened.info.edge_length),
    }
}
