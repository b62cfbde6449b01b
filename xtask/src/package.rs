//! What is given to others.

use crate::build::cargo;
use crate::page;

/// The crates as they are published. The studio's has the built page inside.
pub fn crates() -> Result<(), String> {
    page::build()?;
    cargo(&["package", "--workspace", "--exclude", "xtask"], &[])
}
