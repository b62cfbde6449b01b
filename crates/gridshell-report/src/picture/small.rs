//! A small picture of a grid without a sheet about it: its views below one another, and what the colours mean; supports are
//! left out. Pixels.

use super::drawing::{Drawing, Unit};
use super::frame::Frame;
use super::scene::{self, Style};
use super::sheet::{COLOURED_NODES, Wish, seen};
use super::{label, legend};
use crate::colourings::Colours;
use gridshell::design::Design;

/// The greater side of a view, the room round it and the size of type.
const SIDE: f64 = 730.0;
const MARGIN: f64 = 15.0;
const TYPE: f64 = 13.0;
/// Width of the strip of colours, and of the narrowest picture.
const STRIP: f64 = 300.0;

/// Draw it.
pub fn picture(design: &Design, wish: &Wish, title: String) -> Drawing {
    let views: Vec<_> = wish.sheet.views().iter().map(|&v| seen(design, v)).collect();
    let greatest = views.iter().flat_map(|v| v.2.size()).fold(f64::MIN_POSITIVE, f64::max);
    let scale = SIDE / greatest;
    let heights: Vec<f64> = views.iter().map(|v| v.2.size()[1] * scale).collect();
    let widest = views.iter().map(|v| v.2.size()[0] * scale).fold(STRIP, f64::max);
    let colours = wish.colouring.map(|c| Colours::new(c, design));
    let colours = colours.as_ref();
    let foot = if colours.is_some() { 3.2 * TYPE } else { 0.0 };
    let gaps = MARGIN * (views.len() + 1) as f64;
    let size = [widest + 2.0 * MARGIN, heights.iter().sum::<f64>() + gaps + foot];
    let mut drawing = Drawing::new(size.map(f64::ceil), Unit::Pixel, title);
    let member = scale * design.schedule.figures.length.spread.mean;
    let style = Style::of(member, TYPE);
    let mut style = Style { member: 1.6 * style.member, support: 0.0, ..style }.beside(wish.labels);
    if colours.is_some_and(Colours::on_nodes) {
        style.node *= COLOURED_NODES;
    }
    let mut y = MARGIN;
    for ((view, camera, extent), height) in views.iter().zip(heights) {
        let frame = Frame::centred(extent, scale, [MARGIN, y], [widest, height]);
        scene::draw(design, colours, *view, camera, &frame, &style, &mut drawing);
        label::draw(design, wish.labels, colours, camera, &frame, TYPE, &mut drawing);
        y += height + MARGIN;
    }
    if let Some(colours) = colours {
        legend::strip(&mut drawing, &colours.scale, [MARGIN, y], STRIP, TYPE);
    }
    drawing
}
