//! Histogram and color scale on one axis, as SVG: for print, narrow screens, and readers without scripts.

use super::super::number::Style;
use super::super::values::leaf;
use maud::{Markup, html};
use trueness_document::compare::Histogram;
use trueness_document::scale::Scale;
use trueness_document::scale::palette::{Rgb, hex};

const FIGURE_WIDTH: f64 = 760.0;
const AXIS_LEFT: f64 = 34.0;
const AXIS_RIGHT: f64 = FIGURE_WIDTH - 34.0;
/// Foot of the bars, and top of the colored strip.
const BARS_FOOT: f64 = 96.0;
const MAX_BAR_HEIGHT: f64 = 84.0;
const STRIP_HEIGHT: f64 = 14.0;
/// Room that a number under the strip needs.
const MIN_LABEL_DISTANCE: f64 = 48.0;
/// Length of a cap.
const CAP_WIDTH: f64 = 22.0;

/// The distribution of the first map.
pub fn figure(s: Style, scale: &Scale, histogram: Option<&Histogram>, [_, high, low]: [&str; 3]) -> Markup {
    let at = axis(scale);
    html! {
        svg.distribution viewBox={ "0 0 " (FIGURE_WIDTH) " 162" } role="img" {
            title { (s.bare_word("figure.title")) }
            @if let Some(histogram) = histogram { (bars(histogram, scale, &at)) }
            (strip(scale, &at))
            (ticks(s, scale, &at))
            @for (key, class, x) in [(low, "end", AXIS_LEFT), (high, "end r", AXIS_RIGHT)] {
                text class=(class) x=(x) y="154" data-t=(key) { (s.bare_word(key)) }
            }
        }
    }
}

/// From deviation to place along the axis; the caps take what is beyond the scale.
fn axis(scale: &Scale) -> impl Fn(f64) -> f64 + use<> {
    let [lower, upper] = scale.ends();
    let (from, to) = (AXIS_LEFT + CAP_WIDTH, AXIS_RIGHT - CAP_WIDTH);
    move |d| from + (d - lower) / (upper - lower) * (to - from)
}

/// A box from `x` to the right and from `y` down.
fn filled([x, w]: [f64; 2], [y, height]: [&dyn maud::Render; 2], color: Rgb) -> Markup {
    let (x, w) = (format!("{x:.2}"), format!("{w:.2}"));
    let fill = format!("#{}", hex(color));
    leaf("rect", &[("x", &x), ("y", y), ("width", &w), ("height", height), ("fill", &fill)])
}

/// Bars within the scale, each in the color of its middle; what lies beyond stands as one share at each end.
fn bars(histogram: &Histogram, scale: &Scale, at: &impl Fn(f64) -> f64) -> Markup {
    let [lower, upper] = scale.ends();
    let greatest = histogram.counts.iter().copied().max().unwrap_or(0).max(1) as f64;
    let bar = |(edges, count): (&[f64], &u64)| {
        let (from, to) = (edges[0].max(lower), edges[1].min(upper));
        let height = MAX_BAR_HEIGHT * *count as f64 / greatest;
        let [y, tall] = [BARS_FOOT - height, height].map(|x| format!("{x:.2}"));
        (*count > 0 && from < to)
            .then(|| filled([at(from), at(to) - at(from)], [&y, &tall], scale.color(0.5 * (from + to))))
    };
    html! {
        @for bar in histogram.edges.windows(2).zip(&histogram.counts).filter_map(bar) { (bar) }
    }
}

fn strip(scale: &Scale, at: &impl Fn(f64) -> f64) -> Markup {
    let (limits, colors) = (scale.limits(), scale.colors());
    let piece = |x: f64, w: f64, color: Rgb| filled([x, w], [&BARS_FOOT, &STRIP_HEIGHT], color);
    html! {
        (piece(AXIS_LEFT, CAP_WIDTH, colors[0]))
        @for (pair, color) in limits.windows(2).zip(&colors[1..]) {
            (piece(at(pair[0]), at(pair[1]) - at(pair[0]), *color))
        }
        (piece(AXIS_RIGHT - CAP_WIDTH, CAP_WIDTH, colors[colors.len() - 1]))
    }
}

/// Ticks at all limits; numbers where there is room, first at the tolerance, then at the ends.
fn ticks(s: Style, scale: &Scale, at: &impl Fn(f64) -> f64) -> Markup {
    let zone = scale.tolerance.unwrap_or([f64::NAN; 2]);
    let mut limits = scale.limits();
    limits.dedup();
    limits.sort_by_key(|l| (!zone.contains(l), !scale.ends().contains(l)));
    let mut written: Vec<f64> = vec![];
    let all = limits.into_iter().map(|limit| {
        let x = at(limit);
        let room = written.iter().all(|w| (w - x).abs() >= MIN_LABEL_DISTANCE);
        if room {
            written.push(x);
        }
        tick(s, scale, limit, format!("{x:.2}"), zone.contains(&limit), room)
    });
    html! { @for tick in all { (tick) } }
}

/// One tick, at `x`; with its number where there is room for it.
fn tick(s: Style, scale: &Scale, limit: f64, x: String, tolerance: bool, room: bool) -> Markup {
    let (top, class) = if tolerance { (6.0, "limit") } else { (BARS_FOOT, "tick") };
    let foot = BARS_FOOT + STRIP_HEIGHT + 5.0;
    html! {
        (leaf("line", &[("class", &class), ("x1", &x), ("x2", &x), ("y1", &top), ("y2", &foot)]))
        @if room {
            text class=(class) x=(x) y=(foot + 13.0) { (s.on_scale(limit, Some(scale))) }
        }
    }
}
