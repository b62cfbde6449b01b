//! Sheets to scale: views on paper of a standard size, with legend, figures, title and scale bar. Millimetres.

use super::drawing::{Anchor, Drawing, Unit};
use super::frame::{Extent, Frame};
use super::label::{self, Labels};
use super::scene::{self, INK, Style};
use super::view::{Camera, View};
use super::{glyphs, legend, small};
use crate::colourings::{Colouring, Colours};
use crate::measures::{self, Known};
use gridshell::design::Design;

/// What a sheet shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum Sheet {
    /// From above, x to the right.
    #[cfg_attr(feature = "clap", value(alias = "top"))]
    Plan,
    /// Along y, x to the right.
    Front,
    /// Isometric, from the front, the left and above.
    Iso,
    /// From the front, the right, the back and the left.
    Elevations,
    /// As one sees it from the front, the left and above: not to scale.
    Perspective,
}

/// Paper in landscape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum Paper {
    /// 1189 x 841 mm.
    A0,
    /// 841 x 594 mm.
    A1,
    /// 594 x 420 mm.
    A2,
    /// 420 x 297 mm.
    A3,
    /// 297 x 210 mm.
    A4,
    /// A small picture without border, title and figures, for pages and messages.
    None,
}

/// What is asked of a sheet.
pub struct Wish<'a> {
    /// The views on it.
    pub sheet: Sheet,
    /// Its size.
    pub paper: Paper,
    /// What colours show; None for plain elements.
    pub colouring: Option<&'static Colouring>,
    /// Whose numbers are written beside them.
    pub labels: &'a [Labels],
}

/// Sizes on A1; other papers have them times their factor.
const MARGIN: f64 = 12.0;
const PAD: f64 = 10.0;
const COLUMN: f64 = 140.0;
const FOOT: f64 = 18.0;
const TITLE: f64 = 7.5;
const TYPE: f64 = 3.6;
const LINE: f64 = 6.2;
const THICK: f64 = 0.5;
const THIN: f64 = 0.18;
/// Nodes whose colours matter are so much larger.
pub const COLOURED_NODES: f64 = 1.6;
/// What is added to a view for the width of its marks, over the size of type.
const ROOM_FOR_MARKS: f64 = 1.5;
/// Denominators that rulers have, ascending, to be had times powers of ten; and those of enlargements.
const SCALES: [f64; 7] = [1.0, 2.0, 2.5, 3.0, 4.0, 5.0, 7.5];
const ENLARGED: [f64; 3] = [1.0, 2.0, 5.0];

impl Paper {
    /// Width and height, millimetres; and the size of type and of all that goes with it, over that on A1: smaller paper is
    /// read from nearer. None for no paper.
    fn size(self) -> Option<([f64; 2], f64)> {
        match self {
            Paper::A0 => Some(([1189.0, 841.0], 1.25)),
            Paper::A1 => Some(([841.0, 594.0], 1.0)),
            Paper::A2 => Some(([594.0, 420.0], 0.8)),
            Paper::A3 => Some(([420.0, 297.0], 0.64)),
            Paper::A4 => Some(([297.0, 210.0], 0.52)),
            Paper::None => None,
        }
    }
}

impl Sheet {
    pub(crate) fn views(self) -> &'static [View] {
        match self {
            Sheet::Plan => &[View::Plan],
            Sheet::Front => &[View::Front],
            Sheet::Iso => &[View::Isometric],
            Sheet::Elevations => &[View::Front, View::Right, View::Back, View::Left],
            Sheet::Perspective => &[View::Perspective],
        }
    }

    fn name(self) -> &'static str {
        match self {
            Sheet::Plan => "Plan",
            Sheet::Front => "Front",
            Sheet::Iso => "Isometric",
            Sheet::Elevations => "Elevations",
            Sheet::Perspective => "Perspective",
        }
    }
}

/// Draw a sheet, or a picture where there is no paper.
pub fn sheet(design: &Design, wish: &Wish) -> Drawing {
    let title = format!("{}: {}", design.name(), wish.sheet.name().to_lowercase());
    let Some((paper, f)) = wish.paper.size() else { return small::picture(design, wish, title) };
    let mut drawing = Drawing::new(paper, Unit::Millimetre, title);
    let inner = [paper[0] - 2.0 * MARGIN * f, paper[1] - 2.0 * MARGIN * f];
    let split = paper[0] - (MARGIN + COLUMN) * f;
    border(&mut drawing, inner, split, f);

    let views: Vec<(View, Camera, Extent)> =
        wish.sheet.views().iter().map(|&v| seen(design, v)).collect();
    let at = [(MARGIN + PAD) * f, (MARGIN + PAD) * f];
    let room = [split - at[0] - PAD * f, inner[1] - (2.0 * PAD + FOOT) * f];
    let cells = cells(&views, at, room, f);
    let scale = 1000.0 / denominator(&views, &cells);
    let colours = wish.colouring.map(|c| Colours::new(c, design));
    let colours = colours.as_ref();
    let member = scale * design.schedule.figures.length.spread.mean;
    let mut style = Style::of(member, TYPE * f).beside(wish.labels);
    if colours.is_some_and(Colours::on_nodes) {
        style.node *= COLOURED_NODES;
    }
    for ((view, camera, extent), cell) in views.iter().zip(&cells) {
        let frame = Frame::centred(extent, scale, cell.at, cell.room);
        scene::draw(design, colours, *view, camera, &frame, &style, &mut drawing);
        label::draw(design, wish.labels, colours, camera, &frame, TYPE * f, &mut drawing);
        if views.len() > 1 {
            let foot = cell.at[1] + 0.5 * (cell.room[1] + scale * extent.size()[1]);
            let below = [cell.at[0] + 0.5 * cell.room[0], foot + 3.0 * TYPE * f];
            let name = capital(view.name());
            drawing.text(below, &name, TYPE * f, INK, Anchor::Middle);
        }
    }
    let ground = paper[1] - (MARGIN + 0.45 * FOOT) * f;
    if wish.sheet != Sheet::Perspective {
        legend::scale_bar(&mut drawing, [at[0], ground], scale, f * TYPE, 0.4 * room[0]);
    }
    if wish.sheet == Sheet::Plan {
        legend::axes(
            &mut drawing,
            [split - (PAD + 14.0) * f, ground + 2.0 * f],
            12.0 * f,
            TYPE * f,
        );
    }
    column(design, wish, colours, scale, [split, MARGIN * f], f, &mut drawing);
    drawing
}

/// What a view shows.
pub fn seen(design: &Design, view: View) -> (View, Camera, Extent) {
    let points = &design.schedule.nodes.xyz;
    let camera = view.camera(points);
    let extent = Extent::of(&camera, points);
    (view, camera, extent)
}

fn border(drawing: &mut Drawing, inner: [f64; 2], split: f64, f: f64) {
    let (x, y) = (MARGIN * f, MARGIN * f);
    let (right, foot) = (x + inner[0], y + inner[1]);
    let round = vec![[x, y], [right, y], [right, foot], [x, foot], [x, y]];
    drawing.line(round, THICK * f, INK);
    drawing.line(vec![[split, y], [split, foot]], THICK * f, INK);
}

/// Where a view may stand.
struct Cell {
    at: [f64; 2],
    room: [f64; 2],
}

/// One cell for one view; for several a row each, as high as their views need.
fn cells(views: &[(View, Camera, Extent)], at: [f64; 2], room: [f64; 2], f: f64) -> Vec<Cell> {
    if views.len() == 1 {
        return vec![Cell { at, room }];
    }
    let caption = 3.0 * TYPE * f;
    // Two by two where the views are rather square, one below the other where they are long.
    let widest = views.iter().map(|v| v.2.size()[0]).fold(f64::MIN_POSITIVE, f64::max);
    let tallest = views.iter().map(|v| v.2.size()[1]).fold(f64::MIN_POSITIVE, f64::max);
    let fit = |across: usize, down: usize| {
        let w = (room[0] - (across - 1) as f64 * PAD * f) / across as f64;
        let h = room[1] / down as f64 - caption;
        (w / widest).min(h / tallest)
    };
    let across = if fit(2, 2) >= fit(1, 4) { 2 } else { 1 };
    let down = views.len().div_ceil(across);
    let size = [
        (room[0] - (across - 1) as f64 * PAD * f) / across as f64,
        room[1] / down as f64 - caption,
    ];
    let cell = |k: usize| {
        let (column, row) = ((k % across) as f64, (k / across) as f64);
        let at = [at[0] + column * (size[0] + PAD * f), at[1] + row * (size[1] + caption)];
        Cell { at, room: size }
    };
    (0..views.len()).map(cell).collect()
}

/// The smallest standard denominator at which all views fit their cells.
fn denominator(views: &[(View, Camera, Extent)], cells: &[Cell]) -> f64 {
    let needed = views.iter().zip(cells).map(|((_, _, extent), cell)| {
        let size = extent.size();
        let room = cell.room.map(|x| x - ROOM_FOR_MARKS * TYPE);
        (1000.0 * size[0] / room[0]).max(1000.0 * size[1] / room[1])
    });
    standard(needed.fold(0.0, f64::max))
}

/// The smallest standard denominator that is no less than `needed`.
fn standard(needed: f64) -> f64 {
    let enlarged = (-6..0).flat_map(|k| ENLARGED.map(|s| s * 10f64.powi(k)));
    let mut all = enlarged.chain((0..9).flat_map(|k| SCALES.map(|s| s * 10f64.powi(k))));
    all.find(|&d| d >= needed).unwrap_or(1e9)
}

/// A scale as it is written: `1:200`, `5:1`.
fn told(denominator: f64) -> String {
    if denominator >= 1.0 {
        format!("1:{denominator}")
    } else {
        format!("{}:1", (1.0 / denominator).round())
    }
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |c| c.to_uppercase().chain(letters).collect())
}

/// Legend and figures from the top, the title at the foot.
fn column(
    design: &Design,
    wish: &Wish,
    colours: Option<&Colours>,
    scale: f64,
    at: [f64; 2],
    f: f64,
    drawing: &mut Drawing,
) {
    let (left, width) = (at[0] + PAD * f, (COLUMN - 2.0 * PAD) * f);
    let mut y = at[1] + PAD * f;
    let size = TYPE * f;
    if let Some(colours) = colours {
        y = legend::colours(drawing, &colours.scale, [left, y], width, size) + 1.5 * LINE * f;
    }
    y = legend::marks(drawing, design, colours, [left, y], size, LINE * f) + LINE * f;
    heading(drawing, "Figures", [left, y], width, f);
    y += 1.4 * LINE * f;
    let known = Known::of(design);
    for measure in measures::ALL {
        if let Some(value) = measure.full_text(&known) {
            legend::row(drawing, (measure.name, &value), [left, y], width, size);
            y += LINE * f;
        }
    }
    title(design, wish, scale, [left, width], f, drawing);
}

fn heading(drawing: &mut Drawing, text: &str, at: [f64; 2], width: f64, f: f64) {
    drawing.text(at, text, 1.15 * TYPE * f, INK, Anchor::Start);
    let y = at[1] + 0.5 * LINE * f;
    drawing.line(vec![[at[0], y], [at[0] + width, y]], THIN * f, INK);
}

fn title(
    design: &Design,
    wish: &Wish,
    scale: f64,
    [left, width]: [f64; 2],
    f: f64,
    drawing: &mut Drawing,
) {
    let name = if design.name().is_empty() { "Grid" } else { design.name() };
    let to_scale = told((1000.0 / scale * 1e9).round() / 1e9);
    let to_scale = match wish.sheet {
        Sheet::Iso => to_scale + " in the plane of the picture",
        Sheet::Perspective => "none: a perspective".to_owned(),
        _ => to_scale,
    };
    let seed = design.document.seed.map_or("-".to_owned(), |s| s.to_string());
    let rows = [
        ("Scale", to_scale),
        ("Units", "metres, degrees".to_owned()),
        ("Paper", format!("{:?}", wish.paper)),
        ("Seed", seed),
        ("Made by", format!("gridshell {}", design.document.version)),
    ];
    let foot = drawing.size[1] - MARGIN * f;
    let top = foot - (rows.len() as f64 * LINE + 2.0 * TITLE + 16.0) * f;
    let column = [left - PAD * f, left + width + PAD * f];
    drawing.line(vec![[column[0], top], [column[1], top]], THICK * f, INK);
    // The name may be long: it is set smaller, not cut.
    let long = glyphs::length(name, TITLE * f);
    let size = TITLE * f * (width / long).min(1.0);
    drawing.text([left, top + 8.0 * f], name, size, INK, Anchor::Start);
    let what = format!("Triangular grid, {}", wish.sheet.name().to_lowercase());
    drawing.text([left, top + 17.0 * f], &what, 1.2 * TYPE * f, INK, Anchor::Start);
    let mut y = foot - ((rows.len() as f64 - 0.5) * LINE + 4.0) * f;
    for (name, value) in &rows {
        legend::row(drawing, (name, value), [left, y], width, TYPE * f);
        y += LINE * f;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_those_on_rulers() {
        let cases = [
            (0.3, 0.5),
            (3.3, 4.0),
            (1.0, 1.0),
            (47.0, 50.0),
            (101.0, 200.0),
            (201.0, 250.0),
            (999.0, 1000.0),
        ];
        for (needed, wanted) in cases {
            assert!((standard(needed) / wanted - 1.0).abs() < 1e-12, "{needed}");
        }
        assert_eq!(told(200.0), "1:200");
        assert_eq!(told(0.2), "5:1");
    }
}
