//! The whole-mesh invariant, for tests and for the end of a stage.

use super::Mesh;

impl Mesh {
    /// Check every invariant of the ring mesh.
    ///
    /// # Errors
    /// A sentence naming the first vertex that breaks one.
    pub fn check(&self) -> Result<(), String> {
        for v in self.vertices() {
            let ring = self.ring(v);
            let least = if self.is_boundary(v) { 2 } else { 3 };
            if ring.len() < least {
                return Err(format!("vertex {v} has degree {}", ring.len()));
            }
            for (i, &w) in ring.iter().enumerate() {
                if w == v || !self.is_alive(w) || ring[i + 1..].contains(&w) {
                    return Err(format!(
                        "vertex {v} lists {w}, which is itself, removed or twice there"
                    ));
                }
                if !self.adjacent(w, v) {
                    return Err(format!("vertex {v} lists {w} but not the other way round"));
                }
            }
            for &w in self.along_features(v) {
                if !self.adjacent(v, w) || !self.is_feature_edge(w, v) {
                    return Err(format!(
                        "vertex {v} is on a feature with {w}, which it is not joined to"
                    ));
                }
            }
            for (a, b) in self.fan(v) {
                if self.left(a, b) != Some(v) || self.left(b, v) != Some(a) {
                    return Err(format!("triangle {v} {a} {b} is not seen alike from its corners"));
                }
            }
        }
        let alive = self.vertices().count();
        if alive != self.alive {
            return Err(format!("{alive} vertices in use but {} counted", self.alive));
        }
        Ok(())
    }
}
