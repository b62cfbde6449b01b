//! The directory: one entry for each entity, and access to its parameters.

use super::Fault;
use super::records::Records;
use super::tokens::{Delimiters, Field, fields, number};
use crate::surface::nurbs::{FARTHEST_IN_FILE, reach};
use glam::DVec3;
use std::collections::HashMap;

/// One directory entry.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    /// Entity type.
    pub kind: u32,
    pub form: i32,
    /// Its number: that of its first directory record.
    pub number: u32,
    /// First parameter record, from 1, and how many there are.
    first: usize,
    count: usize,
    /// Number of its transformation, or 0.
    pub transform: u32,
    /// Not to be seen.
    pub blank: bool,
    /// A part of another entity that has no meaning by itself.
    pub dependent: bool,
}

/// The entities of a file.
pub(super) struct Directory<'a> {
    records: &'a Records,
    marks: Delimiters,
    pub entries: Vec<Entry>,
    by_number: HashMap<u32, usize>,
}

/// The parameters of one entity, the type left out: the first one has index 0.
pub(super) struct Parameters {
    place: String,
    fields: Vec<Field>,
}

impl Entry {
    /// How errors and notes name it.
    pub fn place(&self) -> String {
        format!("entity D{} (type {})", self.number, self.kind)
    }

    pub fn fault(&self, what: impl Into<String>) -> Fault {
        Fault::new(&self.place(), what)
    }
}

impl<'a> Directory<'a> {
    /// Read all entries. Those that make no sense are kept with what they have: nothing may refer to them.
    pub fn new(records: &'a Records, marks: Delimiters) -> Result<Directory<'a>, Fault> {
        let mut entries = Vec::with_capacity(records.directory.len() / 2);
        let mut by_number = HashMap::new();
        for (i, pair) in records.directory.chunks_exact(2).enumerate() {
            let line = pair[0].1;
            let field = |record: usize, k: usize| {
                let bytes = &pair[record].0[8 * k..8 * k + 8];
                if bytes.iter().all(|&b| b == b' ') { Some(0.0) } else { number(bytes) }
            };
            let whole = |record: usize, k: usize| field(record, k).map(|x| x as i64);
            let wrong = || Fault::new(&format!("line {line}"), "the directory entry is garbled");
            let kind = whole(0, 0).ok_or_else(wrong)?;
            let first = whole(0, 1).ok_or_else(wrong)?;
            let status: Vec<u8> =
                pair[0].0[64..72].iter().map(|&b| if b == b' ' { b'0' } else { b }).collect();
            let number = (2 * i + 1) as u32;
            let entry = Entry {
                kind: u32::try_from(kind).map_err(|_| wrong())?,
                form: whole(1, 4).unwrap_or(0).clamp(-9999, 99_999) as i32,
                number,
                first: usize::try_from(first).map_err(|_| wrong())?,
                count: whole(1, 3).unwrap_or(1).clamp(1, 1 << 40) as usize,
                transform: whole(0, 6).unwrap_or(0).clamp(0, i64::from(u32::MAX)) as u32,
                blank: status[1] == b'1',
                dependent: matches!(status[3], b'1' | b'3'),
            };
            by_number.insert(number, entries.len());
            entries.push(entry);
        }
        let directory = Directory { records, marks, entries, by_number };
        directory.check_end()?;
        Ok(directory)
    }

    /// Refuse a file that ends before its parameters do.
    fn check_end(&self) -> Result<(), Fault> {
        let have = self.records.parameters.len();
        let missing =
            self.entries.iter().filter(|e| e.kind != 0 && e.first + e.count - 1 > have).count();
        if missing > 0 && !self.records.ended {
            return Err(Fault::new(
                &format!("line {}", self.records.last_line),
                format!(
                    "the file is cut off: the parameters of {missing} of its {} entities are missing; export it \
                     again",
                    self.entries.len()
                ),
            ));
        }
        Ok(())
    }

    /// The entity of this number.
    pub fn entry(&self, number: u32) -> Option<Entry> {
        self.by_number.get(&number).map(|&i| self.entries[i])
    }

    /// The parameters of an entity.
    pub fn parameters(&self, entry: &Entry) -> Result<Parameters, Fault> {
        let have = self.records.parameters.len();
        let place = match self.records.parameters.get(entry.first.wrapping_sub(1)) {
            Some((_, line)) => format!("{}, line {line}", entry.place()),
            None => entry.place(),
        };
        if entry.first == 0 || entry.first > have {
            return Err(Fault::new(&place, "its parameters are missing"));
        }
        let last = (entry.first - 1).saturating_add(entry.count).min(have);
        let mut bytes = Vec::with_capacity(64 * (last + 1 - entry.first));
        for (record, _) in &self.records.parameters[entry.first - 1..last] {
            bytes.extend(record);
        }
        let mut fields = fields(&bytes, self.marks).map_err(|what| Fault::new(&place, what))?;
        if fields.first() != Some(&Field::Number(f64::from(entry.kind))) {
            return Err(Fault::new(&place, "its parameters belong to another type of entity"));
        }
        fields.remove(0);
        Ok(Parameters { place, fields })
    }
}

impl Parameters {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.fields.len()
    }

    pub fn fault(&self, what: impl Into<String>) -> Fault {
        Fault::new(&self.place, what)
    }

    /// A point that is not too far away.
    pub fn reached(&self, point: DVec3) -> Result<DVec3, Fault> {
        reach(point, FARTHEST_IN_FILE).map_err(|e| self.fault(e.to_string()))
    }

    /// The number at `k`; 0 where it is left out before the end.
    pub fn number(&self, k: usize) -> Result<f64, Fault> {
        match self.fields.get(k) {
            Some(Field::Number(x)) => Ok(*x),
            Some(Field::Empty) => Ok(0.0),
            Some(Field::Text(_)) => Err(self.fault(format!("parameter {} is not a number", k + 1))),
            None => Err(self.fault(format!("parameter {} is missing", k + 1))),
        }
    }

    /// The number at `k`, or `default` where it is left out.
    pub fn number_or(&self, k: usize, default: f64) -> f64 {
        match self.fields.get(k) {
            Some(Field::Number(x)) => *x,
            _ => default,
        }
    }

    /// A count at `k`: no more than there are parameters.
    pub fn count(&self, k: usize) -> Result<usize, Fault> {
        let x = self.number(k)?;
        if x.fract() != 0.0 || x < 0.0 {
            return Err(self.fault(format!("parameter {} is {x}, which is not a count", k + 1)));
        }
        if x > self.len() as f64 {
            return Err(self.fault(format!(
                "parameter {} asks for {x} items where there are {} parameters",
                k + 1,
                self.len()
            )));
        }
        Ok(x as usize)
    }

    /// Whether the flag at `k` is set.
    pub fn flag(&self, k: usize) -> bool {
        self.number_or(k, 0.0) != 0.0
    }

    /// The number of an entity at `k`; None where it is 0 or left out.
    pub fn pointer(&self, k: usize) -> Result<Option<u32>, Fault> {
        let x = self.number(k)?;
        if x == 0.0 {
            return Ok(None);
        }
        if x.fract() != 0.0 || !(1.0..4e9).contains(&x) {
            return Err(self.fault(format!("parameter {} is {x}, which is not an entity", k + 1)));
        }
        Ok(Some(x as u32))
    }

    /// `count` numbers from `k` on.
    pub fn numbers(&self, k: usize, count: usize) -> Result<Vec<f64>, Fault> {
        if k.checked_add(count).is_none_or(|end| end > self.len()) {
            return Err(self.fault(format!("it has {} parameters, which are too few", self.len())));
        }
        (k..k + count).map(|k| self.number(k)).collect()
    }
}
