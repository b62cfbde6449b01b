//! The log of a grid's edits: what replays exactly.

use super::{Edit, Editor};
use crate::error::{Error, Result};
use crate::grid::{Grid, Place};
use crate::job::Job;
use crate::recipe::Recipe;
use crate::surface::Origin;
use serde::{Deserialize, Serialize};

/// Name and version of the schema.
pub const SCHEMA: &str = "gridshell.edits/1";

/// Edits in their order, and what they begin from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Log {
    /// [`SCHEMA`].
    pub schema: String,
    /// Version of the program that wrote it; of a log written by hand empty.
    #[serde(default)]
    pub version: String,
    /// Name of the surface; of a log written by hand empty.
    #[serde(default)]
    pub surface: String,
    /// Fingerprint of the grid that the first edit is made in, with its edge length and recipe: 16 hexadecimal digits.
    /// A log without one is tried on any grid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<String>,
    /// The edits.
    pub edits: Vec<Edit>,
}

impl Log {
    /// Read a log from JSON.
    ///
    /// # Errors
    /// [`Error::Surface`] with the line where it is not a log, or one of another version.
    pub fn from_json(text: &str) -> Result<Log> {
        #[derive(Deserialize)]
        struct Head {
            schema: String,
        }
        let head: Head = serde_json::from_str(text).map_err(|e| not_a_log(&e))?;
        if head.schema != SCHEMA {
            let schema: String = head.schema.chars().take(40).collect();
            return Err(Error::Surface(format!(
                "a log of schema {schema:?}, and this version replays {SCHEMA:?}: use the version of gridshell that wrote it"
            )));
        }
        serde_json::from_str(text).map_err(|e| not_a_log(&e))
    }

    /// The log as JSON, an edit a line.
    pub fn to_json(&self) -> String {
        let edits: Vec<String> = self.edits.iter().map(|e| format!("    {}", text(e))).collect();
        let start = self.start.as_ref().map(|s| format!("  \"start\": {},\n", text(s)));
        let edits = if edits.is_empty() {
            "[]".to_owned()
        } else {
            format!("[\n{}\n  ]", edits.join(",\n"))
        };
        format!(
            "{{\n  \"schema\": {},\n  \"version\": {},\n  \"surface\": {},\n{}  \"edits\": {edits}\n}}\n",
            text(&self.schema),
            text(&self.version),
            text(&self.surface),
            start.unwrap_or_default(),
        )
    }
}

fn not_a_log(error: &serde_json::Error) -> Error {
    Error::Surface(format!("not a log of edits: {error}"))
}

fn text(value: &impl Serialize) -> String {
    serde_json::to_string(value).expect("a log has string keys and plain numbers only")
}

impl Editor {
    /// What was done so far.
    pub fn log(&self) -> Log {
        Log {
            schema: SCHEMA.to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            surface: self.surface.name.clone(),
            start: Some(self.start.clone()),
            edits: self.done.iter().map(|e| e.edit.clone()).collect(),
        }
    }

    /// Do all that a log holds, on top of what was done so far; nothing is done where an entry is refused.
    ///
    /// # Errors
    /// [`Error::Surface`] where the log begins from another grid than this editor, or naming the entry that does not
    /// fit; [`Error::Stopped`] where the job was stopped.
    pub fn replay(&mut self, log: &Log, job: &Job) -> Result<()> {
        if log.start.as_ref().is_some_and(|start| *start != self.start) {
            return Err(Error::Surface(format!(
                "the log was made on another grid (on {:?}, fingerprint {}; this one on {:?}, {}): open the grid that it \
                 begins from, with the same surface and recipe; without its \"start\" it is tried on any grid",
                log.surface,
                log.start.as_deref().unwrap_or_default(),
                self.surface.name,
                self.start,
            )));
        }
        let before = self.done.len();
        for (k, edit) in log.edits.iter().enumerate() {
            if let Err(refusal) = self.apply_with(edit.clone(), job) {
                while self.done.len() > before {
                    self.undo();
                }
                self.undone.clear();
                if job.stopped() {
                    return Err(Error::Stopped { phase: "editing" });
                }
                return Err(Error::Surface(format!(
                    "entry {} of the log's {} ({edit}) does not fit the grid: {refusal}",
                    k + 1,
                    log.edits.len(),
                )));
            }
        }
        Ok(())
    }
}

/// Fingerprint (FNV-1a, 64 bits) of a grid with its edge length and recipe.
pub(super) fn digest(grid: &Grid, origin: Origin, recipe: &Recipe, edge_length: f64) -> String {
    let mut hash = Hash(0xcbf29ce484222325);
    let recipe = serde_json::to_string(recipe).expect("a recipe has string keys");
    hash.bytes(recipe.as_bytes());
    hash.number(edge_length);
    let mut panels: Vec<[u32; 3]> = grid.mesh.triangles().collect();
    panels.sort_unstable();
    for v in panels.iter().flatten() {
        hash.bytes(&v.to_le_bytes());
    }
    for v in grid.mesh.vertices() {
        hash.bytes(&[u8::from(grid.mesh.is_pinned(v))]);
        let along = grid.mesh.along_features(v).iter();
        along.for_each(|w| hash.bytes(&w.to_le_bytes()));
        origin.world(grid.xyz[v as usize]).to_array().into_iter().for_each(|x| hash.number(x));
        hash.place(&grid.places[v as usize]);
    }
    format!("{:016x}", hash.0)
}

struct Hash(u64);

impl Hash {
    fn bytes(&mut self, bytes: &[u8]) {
        for b in bytes {
            self.0 = (self.0 ^ u64::from(*b)).wrapping_mul(0x100000001b3);
        }
    }

    fn number(&mut self, x: f64) {
        self.bytes(&x.to_bits().to_le_bytes());
    }

    fn place(&mut self, place: &Place) {
        let (kind, of, numbers) = match place {
            Place::Interior(p) => (0, p.triangle, p.bary),
            Place::Boundary(c) => (1, c.chain, [c.s, 0.0, 0.0]),
            Place::Corner(c) => (2, c.chain, [c.s, 0.0, 0.0]),
            Place::Feature(c) => (3, c.chain, [c.s, 0.0, 0.0]),
            Place::Fixed(p) => (4, p.triangle, p.bary),
        };
        self.bytes(&[kind]);
        self.bytes(&of.to_le_bytes());
        for x in numbers {
            self.number(x);
        }
    }
}
