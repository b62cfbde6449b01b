//! Small inline pictures of a grid whose colours the page can switch: elements have a class for each colouring.

use crate::colourings::{ALL, Colouring, Colours, Element};
use crate::picture::frame::{Extent, Frame};
use crate::picture::scene::{self, Item, PANEL};
use crate::picture::sheet::COLOURED_NODES;
use crate::picture::svg::hex;
use crate::picture::view::View;
use crate::picture::{legend_of, lit};
use gridshell::degree::REGULAR;
use gridshell::design::Design;
use std::cmp::Ordering;
use std::fmt::Write;

/// Greater side of a picture in its own units: fine enough for whole numbers.
const SIDE: f64 = 4000.0;
/// Room round it, for the marks.
const ROOM: f64 = 60.0;
/// Steps of light on panels.
const LIGHTS: usize = 12;
/// The least light there is.
const DARKEST: f64 = 0.5;

/// The colours of a grid, and what they show.
pub struct Colored {
    pub colouring: &'static Colouring,
    pub colours: Colours,
}

/// The grid from here.
pub fn picture(design: &Design, colored: &[Colored], view: View) -> String {
    let schedule = &design.schedule;
    let points = &schedule.nodes.xyz;
    let camera = view.camera(points);
    let extent = Extent::of(&camera, points);
    let [w, h] = extent.size();
    let scale = SIDE / w.max(h).max(f64::MIN_POSITIVE);
    let frame = Frame::new(&extent, scale, [ROOM, ROOM]);
    let size = [w, h].map(|x| (x * scale + 2.0 * ROOM).ceil());
    let (seen, items) = scene::seen(design, &camera);
    let places: Vec<[i64; 2]> =
        seen.iter().map(|&s| frame.place(s).map(|x| x.round() as i64)).collect();
    let member = scale * schedule.figures.length.spread.mean;
    let width = (0.09 * member).clamp(5.0, 18.0);
    let radius = (0.13 * member).clamp(8.0, 40.0);
    let mut out = format!(
        "<svg class=\"grid\" viewBox=\"0 0 {} {}\" style=\"--w:{width:.1};--r:{radius:.0}px\" stroke-linejoin=\"round\" \
         stroke-linecap=\"round\">",
        size[0], size[1]
    );
    for item in items {
        match item {
            Item::Panel(k) => {
                let t = schedule.panels.nodes[k];
                let [a, b, c] = t.map(|v| places[v as usize]);
                let light = match view {
                    View::Plan => LIGHTS - 1,
                    _ => light(
                        lit([1.0; 3], schedule.panels.normal[k], points[t[0] as usize], &camera)[0],
                    ),
                };
                let classes = classes(colored, Element::Panels, k);
                let _ = write!(out, "<path class=\"p h{light}{classes}\" d=\"M{} {}", a[0], a[1]);
                let _ = write!(out, "L{} {}L{} {}Z\"/>", b[0], b[1], c[0], c[1]);
            }
            Item::Member(k) => {
                let [a, b] = schedule.members.ends[k].map(|v| places[v as usize]);
                let classes = classes(colored, Element::Members, k);
                let wide = schedule.members.boundary[k] || schedule.members.feature[k];
                let wide = if wide { " w" } else { "" };
                let _ = write!(out, "<path class=\"m{wide}{classes}\" d=\"M{} {}", a[0], a[1]);
                let _ = write!(out, "L{} {}\"/>", b[0], b[1]);
            }
            Item::Node(v) => {
                let classes = classes(colored, Element::Nodes, v);
                let kind = match schedule.nodes.adjusted_degree[v].cmp(&REGULAR) {
                    Ordering::Less => "few",
                    Ordering::Greater => "many",
                    Ordering::Equal if classes.is_empty() => continue,
                    Ordering::Equal => "reg",
                };
                let [x, y] = places[v];
                let _ = write!(
                    out,
                    "<circle class=\"n {kind}{classes}\" cx=\"{x}\" cy=\"{y}\" r=\"{radius:.0}\"/>"
                );
            }
        }
    }
    out + "</svg>"
}

/// A plan in one colouring.
pub fn plan(design: &Design, colored: &[Colored]) -> String {
    picture(design, colored, View::Plan)
}

/// ` A4 D0`: the step in each colouring that colours the element.
fn classes(colored: &[Colored], element: Element, k: usize) -> String {
    let mut text = String::new();
    for c in colored {
        if let Some(step) = c.colours.step(element, k) {
            let _ = write!(text, " {}{step}", initial(c.colouring));
        }
    }
    text
}

/// A capital for each colouring: short names keep the page small.
fn initial(colouring: &Colouring) -> char {
    let place = ALL.iter().position(|c| c.key == colouring.key).expect("in the table");
    char::from(b'A' + place as u8)
}

fn light(brightness: f64) -> usize {
    let share = (brightness - DARKEST) / (1.0 - DARKEST);
    (share.clamp(0.0, 1.0) * (LIGHTS - 1) as f64).round() as usize
}

/// What the classes look like in each colouring.
pub fn style(colored: &[Colored]) -> String {
    let mut css = String::new();
    for k in 0..LIGHTS {
        let brightness = DARKEST + (1.0 - DARKEST) * k as f64 / (LIGHTS - 1) as f64;
        let _ = writeln!(css, ".h{k}{{fill:{0};stroke:{0}}}", hex(&PANEL.map(|x| x * brightness)));
    }
    for Colored { colouring, colours } in colored {
        let (on, short) = (format!("[data-colour={}]", colouring.key), initial(colouring));
        for (k, colour) in colours.scale.hexes().iter().enumerate() {
            let class = format!("{short}{k}");
            let _ = match colouring.on {
                Element::Members => writeln!(css, "{on} .m.{class}{{stroke:{colour}}}"),
                Element::Panels => {
                    writeln!(css, "{on} .p.{class}{{fill:{colour};stroke:{colour}}}")
                }
                Element::Nodes => writeln!(
                    css,
                    "{on} .n.{class}{{display:inline;fill:{colour}}}{on} .reg.{class}{{stroke:{colour}}}"
                ),
            };
        }
        if colours.on_nodes() {
            let _ = writeln!(css, "{on} .n{{r:calc({COLOURED_NODES} * var(--r))}}");
        }
        let _ = writeln!(css, "{on} .legend.{}{{display:block}}", colouring.key);
    }
    css
}

/// The legends; the style shows the one that is asked for.
pub fn legends(colored: &[Colored]) -> String {
    let one = |Colored { colouring, colours }: &Colored| {
        format!("<div class=\"legend {}\">{}</div>", colouring.key, legend_of(&colours.scale))
    };
    colored.iter().map(one).collect()
}
