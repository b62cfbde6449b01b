//! The view that can be turned: a canvas, the grid as packed numbers, and a script of our own.

use super::pictures::{Colored, legends};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use gridshell::design::Design;
use serde::Serialize;
use std::collections::BTreeMap;

const SCRIPT: &str = include_str!("viewer.js");
/// A step that is none.
const PLAIN: u8 = 255;

/// What the script gets. Lists are packed, little-endian, in base 64.
#[derive(Serialize)]
struct Data {
    /// Positions about the middle, single precision, metres.
    xyz: String,
    /// Nodes of members and panels.
    members: String,
    panels: String,
    /// Members of the boundary, creases and guides.
    wide: String,
    /// Adjusted degrees less six.
    excess: String,
    member_length: f64,
    colourings: BTreeMap<&'static str, Layer>,
}

#[derive(Serialize)]
struct Layer {
    inks: Vec<String>,
    /// `members`, `nodes` or `panels`.
    on: &'static str,
    /// The step of each, [`PLAIN`] without.
    steps: String,
}

/// Choice of colours, canvas, legend.
pub fn section(design: &Design, colored: &[Colored]) -> String {
    let all = colored.iter().map(|c| (c.colouring.key, c.colouring.label, c.colouring.help));
    let choice: Vec<String> = all
        .chain([("none", "None", "No colours.")])
        .map(|(key, label, help)| {
            let on = if key == "length" { " checked" } else { "" };
            format!(
                "<label title=\"{help}\"><input type=\"radio\" name=\"colour\" value=\"{key}\"{on}> {label}</label>"
            )
        })
        .collect();
    // No element can end the script: the text has no `<`.
    let data = serde_json::to_string(&data(design, colored)).expect("plain data");
    format!(
        "<section><h2 class=\"screen\">View to turn</h2><div class=\"choice\">Colours: {}\
         <label><input type=\"checkbox\" id=\"panels\" checked> panels</label></div>\
         <div class=\"turn\"><canvas id=\"view\" tabindex=\"0\" aria-label=\"The grid in three dimensions\"></canvas>\
         <div class=\"legends\">{}</div></div>\
         <p class=\"note screen\">Drag to turn, drag with the right button or Shift to move, wheel to zoom, double click to go \
         back.</p><script type=\"application/json\" id=\"grid\">{data}</script></section>",
        choice.concat(),
        legends(colored)
    )
}

pub fn script() -> String {
    format!("<script>\n{SCRIPT}</script>")
}

fn data(design: &Design, colored: &[Colored]) -> Data {
    let schedule = &design.schedule;
    let (nodes, members) = (&schedule.nodes, &schedule.members);
    let low = nodes.xyz.iter().fold(gridshell::DVec3::INFINITY, |a, &b| a.min(b));
    let high = nodes.xyz.iter().fold(gridshell::DVec3::NEG_INFINITY, |a, &b| a.max(b));
    let middle = (low + high) / 2.0;
    let xyz = nodes.xyz.iter().flat_map(|&p| (p - middle).to_array().map(|x| x as f32));
    let wide = members.boundary.iter().zip(&members.feature).map(|(b, f)| u8::from(*b || *f));
    let excess = nodes.adjusted_degree.iter().map(|d| (d - gridshell::degree::REGULAR) as i8 as u8);
    Data {
        xyz: packed(xyz.flat_map(f32::to_le_bytes)),
        members: packed(members.ends.iter().flatten().flat_map(|v| v.to_le_bytes())),
        panels: packed(schedule.panels.nodes.iter().flatten().flat_map(|v| v.to_le_bytes())),
        wide: packed(wide),
        excess: packed(excess),
        member_length: schedule.figures.length.spread.mean,
        colourings: colored.iter().map(|c| (c.colouring.key, layer(c))).collect(),
    }
}

fn layer(Colored { colouring, colours }: &Colored) -> Layer {
    Layer {
        inks: colours.scale.hexes(),
        on: colouring.on.name(),
        steps: packed(colours.steps.iter().map(|s| s.unwrap_or(PLAIN))),
    }
}

fn packed(bytes: impl Iterator<Item = u8>) -> String {
    STANDARD.encode(bytes.collect::<Vec<u8>>())
}
