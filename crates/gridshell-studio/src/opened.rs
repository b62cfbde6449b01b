//! A surface that is open: from a built-in name, a file, or a grid that is its own surface.

use crate::message::SurfaceInfo;
use crate::{scene, told};
use axum::body::Bytes;
use gridshell::error::{Error, Result};
use gridshell::inspect::{self, Sketch};
use gridshell::io::{self, Choice, Document, Follow, Opening, Reference};
use gridshell::job::Job;
use gridshell::surface::{Model, PolygonMesh, Surface, builtin};
use std::path::Path;

/// The open surface.
pub struct Opened {
    /// What was opened.
    pub model: Model,
    /// Where it is, for the files of its grids; None for a grid that is its own surface.
    pub reference: Option<Reference>,
    /// The contents of its file, where it has one: to be read in another way, and kept beside the grids laid on it.
    pub file: Option<Bytes>,
    /// A coarse surface for pictures and picking.
    pub sketch: Surface,
    /// What the page is told of it.
    pub info: SurfaceInfo,
    /// How the page draws it.
    pub frame: Bytes,
}

impl Opened {
    /// The built-in surface of this name.
    ///
    /// # Errors
    /// [`Error::Option`] where there is none.
    pub fn built_in(name: &str, job: &Job) -> Result<Opened> {
        let model = builtin::model(name)
            .ok_or_else(|| Error::Option(format!("there is no built-in surface `{name}`")))?;
        Opened::new(model, Some(Reference::Builtin(name.to_owned())), None, job)
    }

    /// The built-in surface of this name, else the file at this path.
    ///
    /// # Errors
    /// What [`io::open_with`] and [`inspect::inspect`] say.
    pub fn named(name_or_path: &str, opening: &Opening, job: &Job) -> Result<Opened> {
        if builtin::model(name_or_path).is_some() {
            return Opened::built_in(name_or_path, job);
        }
        let model = io::open_with(name_or_path, opening, job)?;
        let reference = io::reference(name_or_path, opening, job)?;
        Opened::new(model, Some(reference), Some(contents(Path::new(name_or_path), job)?), job)
    }

    /// A file of these contents that was sent under `name`; messages tell of the name.
    ///
    /// # Errors
    /// As [`Opened::named`].
    pub fn sent(name: &str, file: &Bytes, opening: &Opening, job: &Job) -> Result<Opened> {
        in_folder(name, file, |path| {
            let model = io::load(path, opening, job)?;
            let mut reference = io::reference(&path.to_string_lossy(), opening, job)?;
            if let Reference::File { path, .. } = &mut reference {
                name.clone_into(path);
            }
            Opened::new(model, Some(reference), Some(file.clone()), job)
        })
    }

    /// The same file, of which only these objects are read.
    ///
    /// # Errors
    /// [`Error::Option`] where it is not a file; as [`Opened::named`].
    pub fn chosen(&self, choice: Choice, job: &Job) -> Result<Opened> {
        let (Some(Reference::File { path, opening, .. }), Some(file)) =
            (&self.reference, &self.file)
        else {
            return Err(Error::Option("only in a file there is something to choose from".into()));
        };
        let name = Path::new(path).file_name().unwrap_or_default().to_string_lossy();
        let mut opened = Opened::sent(&name, file, &Opening { choice, ..opening.clone() }, job)?;
        if let Some(Reference::File { path: told, .. }) = &mut opened.reference {
            told.clone_from(path);
        }
        Ok(opened)
    }

    /// What a grid file at `path` refers to: looked for beside it first.
    ///
    /// # Errors
    /// As [`io::open_reference`].
    pub fn referred(reference: &Reference, path: &Path, job: &Job) -> Result<Opened> {
        let model = io::open_reference(reference, path, Follow::Near, job)?;
        let file = io::find_reference(reference, path, Follow::Near, job)?;
        let file = file.map(|file| contents(&file, job)).transpose()?;
        Opened::new(model, Some(reference.clone()), file, job)
    }

    /// The grid of a document, as its own surface.
    ///
    /// # Errors
    /// [`Error::Surface`] where its panels are no surface.
    pub fn alone(document: &Document, job: &Job) -> Result<Opened> {
        let mut mesh = PolygonMesh {
            name: document.name.clone(),
            points: document.nodes.iter().map(|&p| p.into()).collect(),
            faces: document.panels.iter().map(|t| t.to_vec()).collect(),
            ..PolygonMesh::default()
        };
        mesh.settle();
        Opened::new(Model::Mesh(mesh), None, None, job)
    }

    fn new(
        model: Model,
        reference: Option<Reference>,
        file: Option<Bytes>,
        job: &Job,
    ) -> Result<Opened> {
        let inspection = inspect::inspect(&model, job)?;
        let sketch = inspect::sketch(&model, job)?;
        let built_in = matches!(reference, Some(Reference::Builtin(_)));
        let info = told::info(&inspection, &sketch.surface, built_in);
        let frame = scene::surface(&sketch);
        let Sketch { surface: sketch, .. } = sketch;
        Ok(Opened { model, reference, file, sketch, info, frame })
    }

    /// Whether this is the surface that `reference` stands for, wherever its file is.
    pub fn is(&self, reference: &Reference) -> bool {
        let told = |r: &Reference| match r {
            Reference::Builtin(name) => (name.clone(), 0, Opening::default()),
            Reference::File { bytes, fnv1a, opening, .. } => {
                (fnv1a.clone(), *bytes, opening.clone())
            }
        };
        self.reference.as_ref().is_some_and(|own| told(own) == told(reference))
    }
}

/// Work with a file of these contents and this name in a folder of its own; errors tell of the name only.
pub fn in_folder<T>(name: &str, file: &[u8], work: impl FnOnce(&Path) -> Result<T>) -> Result<T> {
    let unwritten = |e: std::io::Error| Error::Option(format!("{name}: {e}"));
    let folder = tempfile::tempdir().map_err(unwritten)?;
    let path = folder.path().join(name);
    std::fs::write(&path, file).map_err(unwritten)?;
    let shown = path.display().to_string();
    work(&path).map_err(|e| Error::Surface(e.to_string().replace(&shown, name)))
}

fn contents(path: &Path, job: &Job) -> Result<Bytes> {
    Ok(io::read(path, job)?.into())
}
