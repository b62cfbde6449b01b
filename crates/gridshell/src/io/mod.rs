//! Files in and out: one file per format.

pub mod step;

use crate::error::{Error, Result};
use crate::surface::Model;
use std::path::Path;

/// Read the model in a file; the format goes by the extension.
///
/// # Errors
/// [`Error::Io`] where the file cannot be opened, [`Error::Parse`] where its contents or its format are
/// not known.
pub fn load(path: &Path) -> Result<Model> {
    let extension =
        path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
    match extension.as_str() {
        "step" | "stp" => step::read(path).map(Model::Brep),
        _ => Err(Error::Parse {
            path: path.to_path_buf(),
            place: "file name".into(),
            message: "no reader for this extension; give a .step or .stp file".into(),
        }),
    }
}
