//! Binary frames of flat arrays, as [`FrameHead`] describes them: the page lays its arrays over the bytes and hands
//! them to the graphics card as they are.

use crate::message::{ArrayHead, FrameHead, Scale, Shows};
use axum::body::Bytes;
use glam::DVec3;

/// A frame being put together.
pub struct Frame {
    head: FrameHead,
    body: Vec<u8>,
}

impl Frame {
    /// An empty one.
    pub fn new(shows: Shows, run: u32) -> Frame {
        let head = FrameHead { shows, run, arrays: Vec::new(), scale: None };
        Frame { head, body: Vec::new() }
    }

    /// Say what the values stand for.
    #[must_use]
    pub fn scaled(mut self, scale: Scale) -> Frame {
        self.head.scale = Some(scale);
        self
    }

    /// Add single precision numbers.
    #[must_use]
    pub fn floats(mut self, name: &str, numbers: impl Iterator<Item = f64>) -> Frame {
        let before = self.body.len();
        numbers.for_each(|x| self.body.extend((x as f32).to_le_bytes()));
        self.told(name, "f32", before)
    }

    /// Add points: x, y, z of one after the other.
    #[must_use]
    pub fn points(self, name: &str, points: &[DVec3]) -> Frame {
        self.floats(name, points.iter().flat_map(DVec3::to_array))
    }

    /// Add whole numbers.
    #[must_use]
    pub fn wholes(mut self, name: &str, numbers: impl Iterator<Item = u32>) -> Frame {
        let before = self.body.len();
        numbers.for_each(|n| self.body.extend(n.to_le_bytes()));
        self.told(name, "u32", before)
    }

    fn told(mut self, name: &str, of: &str, before: usize) -> Frame {
        let length = ((self.body.len() - before) / 4) as u32;
        self.head.arrays.push(ArrayHead { name: name.into(), of: of.into(), length });
        self
    }

    /// The bytes to be sent.
    pub fn bytes(self) -> Bytes {
        let mut head = serde_json::to_vec(&self.head).expect("heads have text keys only");
        head.resize(head.len().next_multiple_of(4), b' ');
        let mut bytes = Vec::with_capacity(4 + head.len() + self.body.len());
        bytes.extend((head.len() as u32).to_le_bytes());
        bytes.extend(head);
        bytes.extend(self.body);
        bytes.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_begin_at_multiples_of_four_and_come_out_as_they_went_in() {
        let frame = Frame::new(Shows::Bubbles, 7)
            .points("xyz", &[DVec3::new(1.0, -2.0, 0.5)])
            .wholes("few", [3, u32::MAX].into_iter());
        let bytes = frame.bytes();
        let head = u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize;
        assert_eq!(head % 4, 0);
        let told: serde_json::Value = serde_json::from_slice(&bytes[4..4 + head]).unwrap();
        assert_eq!((&told["run"], &told["shows"]), (&7.into(), &"bubbles".into()));
        assert_eq!(told["arrays"][1]["length"], 2);
        let body = &bytes[4 + head..];
        let floats = body.chunks(4).take(3).map(|b| f32::from_le_bytes(b.try_into().unwrap()));
        assert_eq!(floats.collect::<Vec<_>>(), [1.0, -2.0, 0.5]);
        assert_eq!(&body[16..], u32::MAX.to_le_bytes());
    }
}
