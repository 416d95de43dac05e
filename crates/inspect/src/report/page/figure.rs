//! Histogram and colour scale on one axis, as SVG: for print, narrow screens, and readers without scripts.

use super::super::html::Html;
use super::super::text::word;
use crate::results::compare::Histogram;
use crate::scale::Scale;
use crate::scale::palette::hex;

const WIDTH: f64 = 760.0;
const LEFT: f64 = 34.0;
const RIGHT: f64 = WIDTH - 34.0;
/// Foot of the bars, and top of the coloured strip.
const FOOT: f64 = 96.0;
const BARS: f64 = 84.0;
const STRIP: f64 = 14.0;
/// Room that a number under the strip needs.
const LABEL: f64 = 48.0;
/// Length of a cap.
const CAP: f64 = 22.0;

/// The distribution of the first map.
pub fn figure(h: &mut Html, scale: &Scale, histogram: Option<&Histogram>, [_, high, low]: [&str; 3]) {
    let at = axis(scale);
    h.raw(&format!("<svg class=\"distribution\" viewBox=\"0 0 {WIDTH} 162\" role=\"img\"><title>"));
    h.text(word("figure.title", h.language())).raw("</title>");
    bars(h, histogram, scale, &at);
    strip(h, scale, &at);
    ticks(h, scale, &at);
    for (key, class, x) in [(low, "end", LEFT), (high, "end r", RIGHT)] {
        h.raw(&format!("<text class=\"{class}\" x=\"{x}\" y=\"154\" data-t=\"{key}\">"));
        h.text(word(key, h.language())).raw("</text>");
    }
    h.raw("</svg>");
}

/// From deviation to place along the axis; the caps take what is beyond the scale.
fn axis(scale: &Scale) -> impl Fn(f64) -> f64 + use<> {
    let [lower, upper] = scale.ends();
    let (from, to) = (LEFT + CAP, RIGHT - CAP);
    move |d| from + (d - lower) / (upper - lower) * (to - from)
}

/// Bars within the scale, each in the colour of its middle; what lies beyond stands as one share at each end.
fn bars(h: &mut Html, histogram: Option<&Histogram>, scale: &Scale, at: &impl Fn(f64) -> f64) {
    let Some(histogram) = histogram else { return };
    let [lower, upper] = scale.ends();
    let greatest = histogram.counts.iter().copied().max().unwrap_or(0).max(1) as f64;
    for (edges, count) in histogram.edges.windows(2).zip(&histogram.counts) {
        let (from, to) = (edges[0].max(lower), edges[1].min(upper));
        if *count == 0 || from >= to {
            continue;
        }
        let (x, w) = (at(from), at(to) - at(from));
        let height = BARS * *count as f64 / greatest;
        let y = FOOT - height;
        let fill = hex(scale.color(0.5 * (from + to)));
        h.raw(&format!(
            "<rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{w:.2}\" height=\"{height:.2}\" fill=\"#{fill}\"/>"
        ));
    }
}

fn strip(h: &mut Html, scale: &Scale, at: &impl Fn(f64) -> f64) {
    let (limits, colors) = (scale.limits(), scale.colors());
    let mut piece = |x: f64, w: f64, fill: &str| {
        h.raw(&format!(
            "<rect x=\"{x:.2}\" y=\"{FOOT}\" width=\"{w:.2}\" height=\"{STRIP}\" fill=\"#{fill}\"/>"
        ));
    };
    piece(LEFT, CAP, &hex(colors[0]));
    for (pair, color) in limits.windows(2).zip(&colors[1..]) {
        piece(at(pair[0]), at(pair[1]) - at(pair[0]), &hex(*color));
    }
    piece(RIGHT - CAP, CAP, &hex(colors[colors.len() - 1]));
}

/// Ticks at all limits; numbers where there is room, first at the tolerance, then at the ends.
fn ticks(h: &mut Html, scale: &Scale, at: &impl Fn(f64) -> f64) {
    let zone = scale.tolerance.unwrap_or([f64::NAN; 2]);
    let mut limits = scale.limits();
    limits.dedup();
    limits.sort_by_key(|l| (!zone.contains(l), !scale.ends().contains(l)));
    let mut written: Vec<f64> = vec![];
    for limit in limits {
        let x = at(limit);
        let (top, class) = if zone.contains(&limit) { (6.0, "limit") } else { (FOOT, "tick") };
        let foot = FOOT + STRIP + 5.0;
        h.raw(&format!("<line class=\"{class}\" x1=\"{x:.2}\" x2=\"{x:.2}\" y1=\"{top}\" y2=\"{foot}\"/>"));
        if written.iter().all(|w| (w - x).abs() >= LABEL) {
            written.push(x);
            let text = h.style.signed(limit, scale.decimals as usize);
            h.raw(&format!("<text class=\"{class}\" x=\"{x:.2}\" y=\"{}\">{text}</text>", foot + 13.0));
        }
    }
}
