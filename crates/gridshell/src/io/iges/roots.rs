//! Which entities stand for themselves, and the model made of them: subfigures (408) placed, parts of others and what
//! is blanked left out.

use super::directory::Entry;
use super::shells::{self, Shared};
use super::surfaces::is_surface;
use super::{Fault, File, MOST_FACES, MOST_LEVELS, PLACING, trimmed};
use crate::surface::Loss;
use crate::surface::brep::Brep;
use crate::words;
use glam::{DAffine3, DVec3};
use std::collections::BTreeSet;

impl File<'_> {
    /// All faces, in metres.
    pub fn model(&self, metres: f64) -> Result<Brep, Fault> {
        let parts = self.parts();
        let mut found = Brep::default();
        let mut shared = Shared::default();
        let (mut blank, mut orphans) = (0, 0);
        for entry in &self.directory.entries {
            let root = matches!(entry.kind, 186 | 514 | 510 | 144 | 143 | 408);
            let plane = matches!(entry.kind, 108 | 190 | 192 | 194);
            if !(root || is_surface(entry.kind) && !plane) || parts.contains(&entry.number) {
                continue;
            }
            if entry.blank {
                blank += 1;
            } else if entry.dependent && !root {
                orphans += 1;
            } else {
                let added = self.add(&mut found, &mut shared, entry, 0);
                self.or_lose((entry.kind, entry.number), added)?;
            }
        }
        if blank > 0 {
            self.note(format!(
                "left out {}; show what is meant in the program that wrote the file",
                words::one_or_more(blank, ["hidden (blanked) entity", "hidden (blanked) entities"])
            ));
        }
        if orphans > 0 {
            self.losses.borrow_mut().push(Loss {
                what: words::counted(orphans, "surface"),
                why: "they are parts of entities that are not read; export them as surfaces of their own".into(),
                faces: orphans,
                area: None,
                whole: false,
            });
        }
        let mut brep = Brep::default();
        trimmed::append(&mut brep, found, &DAffine3::from_scale(DVec3::splat(metres)));
        Ok(brep)
    }

    /// Add what one entity stands for.
    fn add(
        &self,
        brep: &mut Brep,
        shared: &mut Shared,
        entry: &Entry,
        level: usize,
    ) -> Result<(), Fault> {
        self.visit(entry, level)?;
        if brep.faces.len() >= MOST_FACES {
            let what = format!("more than {MOST_FACES} faces");
            return Err(Fault { fatal: true, ..entry.fault(what) });
        }
        match entry.kind {
            186 | 514 | 510 if entry.transform == 0 => self.brep(brep, shared, entry),
            186 | 514 | 510 => {
                // Edges of a placed shell are its own.
                let mut part = Brep::default();
                self.brep(&mut part, &mut Shared::default(), entry)?;
                trimmed::append(brep, part, &self.place(entry)?);
                Ok(())
            }
            144 => self.trimmed(brep, entry),
            143 => self.bounded(brep, entry),
            408 => self.instance(brep, entry, level),
            _ => self.alone(brep, entry),
        }
    }

    fn brep(&self, brep: &mut Brep, shared: &mut Shared, entry: &Entry) -> Result<(), Fault> {
        match entry.kind {
            186 => self.solid(brep, shared, entry),
            514 => self.shell(brep, shared, entry),
            _ => self.shell_face(brep, shared, entry, false),
        }
    }

    /// 408: the members of a subfigure (308), placed.
    fn instance(&self, brep: &mut Brep, entry: &Entry, level: usize) -> Result<(), Fault> {
        self.spend(entry, PLACING)?;
        if level >= MOST_LEVELS {
            let what = "subfigures are nested too deep here; one may contain itself";
            return Err(Fault { fatal: true, ..entry.fault(what) });
        }
        let p = self.directory.parameters(entry)?;
        let figure =
            self.known(p.pointer(0)?.ok_or_else(|| p.fault("its subfigure is missing"))?)?;
        let q = self.directory.parameters(&figure)?;
        if figure.kind != 308 {
            return Err(figure.fault("a subfigure is asked for here, which this is not"));
        }
        let scale = p.number_or(4, 1.0);
        let scale = if scale == 0.0 { 1.0 } else { scale };
        let offset = DVec3::new(p.number_or(1, 0.0), p.number_or(2, 0.0), p.number_or(3, 0.0));
        let local = DAffine3::from_translation(offset) * DAffine3::from_scale(DVec3::splat(scale));
        let mut part = Brep::default();
        let mut shared = Shared::default();
        for k in 0..q.count(2)? {
            let Some(member) = q.pointer(3 + k)? else { continue };
            let member = self.known(member)?;
            let faces = matches!(member.kind, 186 | 514 | 510 | 144 | 143 | 408);
            if member.blank || !(faces || is_surface(member.kind)) {
                continue;
            }
            let added = self.add(&mut part, &mut shared, &member, level + 1);
            self.or_lose((member.kind, member.number), added)?;
        }
        if brep.faces.len() + part.faces.len() > MOST_FACES {
            return Err(Fault {
                fatal: true,
                ..entry.fault(format!("more than {MOST_FACES} faces"))
            });
        }
        trimmed::append(brep, part, &(self.place(entry)? * local));
        Ok(())
    }

    /// Entities that are parts of others.
    fn parts(&self) -> BTreeSet<u32> {
        let mut parts = BTreeSet::new();
        for entry in &self.directory.entries {
            let holds = matches!(entry.kind, 186 | 514 | 510 | 140..=144 | 308);
            let Some(p) = holds.then(|| self.directory.parameters(entry).ok()).flatten() else {
                continue;
            };
            let places = match entry.kind {
                186 | 514 | 510 => shells::parts(entry.kind, &p),
                308 => (0..p.count(2).unwrap_or(0)).map(|k| 3 + k).collect(),
                kind => trimmed::parts(kind, &p),
            };
            parts.extend(places.into_iter().filter_map(|k| p.pointer(k).ok().flatten()));
        }
        parts
    }
}
