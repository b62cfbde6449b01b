//! Histograms.

use crate::picture::drawing::{Anchor, Drawing, Rgb, Unit};
use crate::picture::svg;
use gridshell::design::Design;
use gridshell::schedule::Spread;

const SIZE: [f64; 2] = [360.0, 170.0];
const LEFT: f64 = 14.0;
const TOP: f64 = 30.0;
const GROUND: f64 = 138.0;
const TYPE: f64 = 12.0;
const INK: Rgb = [0.10, 0.11, 0.12];
const BAR: Rgb = [0.36, 0.52, 0.66];

/// The histograms that the page shows.
pub fn section(design: &Design) -> String {
    let f = &design.schedule.figures;
    let charts = [
        chart("Length of members, m", &f.length.spread, 3),
        chart("Shape q of panels", &f.panel.shape, 3),
        chart("Area of panels, m²", &f.panel.area, 3),
        chart("Angles of panels at nodes, °", &f.angle_deg, 1),
        chart("Folds between panels, °", &f.fold_deg, 2),
        chart("Twist of nodes along members, °", &f.twist_deg, 2),
    ];
    format!(
        "<section><h2>How values spread</h2><div class=\"charts\">{}</div></section>",
        charts.map(|c| format!("<div class=\"chart\">{c}</div>")).concat()
    )
}

fn chart(title: &str, spread: &Spread, digits: usize) -> String {
    let mut drawing = Drawing::new(SIZE, Unit::Pixel, title.to_owned());
    drawing.text([LEFT, 10.0], title, 1.1 * TYPE, INK, Anchor::Start);
    let histogram = &spread.histogram;
    let width = SIZE[0] - 2.0 * LEFT;
    let bar = width / histogram.counts.len().max(1) as f64;
    let most = histogram.counts.iter().copied().max().unwrap_or(0).max(1) as f64;
    for (k, &count) in histogram.counts.iter().enumerate() {
        let high = (GROUND - TOP) * count as f64 / most;
        // What there is can be seen, be it one of thousands.
        let high = if count > 0 { high.max(1.0) } else { 0.0 };
        let left = LEFT + k as f64 * bar;
        drawing.rectangle([left + 0.08 * bar, GROUND - high], [0.84 * bar, high], BAR);
    }
    drawing.line(vec![[LEFT, GROUND], [LEFT + width, GROUND]], 1.0, INK);
    let spreads = histogram.to > histogram.from;
    if spreads {
        let mean = LEFT + width * (spread.mean - histogram.from) / (histogram.to - histogram.from);
        drawing.line(vec![[mean, GROUND], [mean, TOP]], 1.0, INK);
    }
    let y = GROUND + 12.0;
    drawing.text([LEFT, y], &format!("{:.digits$}", histogram.from), TYPE, INK, Anchor::Start);
    drawing.text([LEFT + width, y], &format!("{:.digits$}", histogram.to), TYPE, INK, Anchor::End);
    let (mean, off) = (spread.mean, spread.deviation);
    let text = format!("mean {mean:.digits$}, deviation {off:.digits$}");
    drawing.text([SIZE[0] / 2.0, y], &text, TYPE, INK, Anchor::Middle);
    svg::encode(&drawing)
}
