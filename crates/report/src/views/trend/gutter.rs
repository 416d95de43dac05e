//! What the lines of a chart are: words and values beside it, each with a stroke to its line.

use super::axes::{Axes, CHART_HEIGHT, needed};
use crate::number::Style;
use crate::values::leaf;
use maud::{Markup, html};
use trueness_document::trend::TrendRecord;

/// Width, and height of a label, in pixels.
const GUTTER_WIDTH: f64 = 132.0;
const LABEL_HEIGHT: f64 = 14.0;
/// Length of the strokes.
const STROKE_LENGTH: f64 = 16.0;

/// A line of the chart and what it is called.
pub struct Line {
    /// Its class, and what its word begins with.
    pub name: &'static str,
    /// Key of its word.
    key: &'static str,
    /// Its value.
    pub value: f64,
    decimals: usize,
}

/// The lines of a chart; those of limits that are too far off are not in it, but named.
pub fn lines(c: &TrendRecord, axes: &Axes) -> Vec<Line> {
    let line = |name, key, value: Option<f64>, trim: bool| {
        let decimals = |v| if trim { needed(v, axes.decimals) } else { axes.decimals };
        value.map(|value| Line { name, key, value, decimals: decimals(value) })
    };
    let control = c.control.as_ref();
    let course = control.is_some();
    let all = [
        line("limit", "chart.limit", c.upper, true),
        line("limit", "chart.limit", c.lower, true),
        line("nominal", "chart.nominal", c.nominal, true),
        line("mean", "chart.mean", c.mean.filter(|_| course), false),
        line("control", "chart.control", control.map(|k| k.upper), false),
        line("control", "chart.control", control.map(|k| k.lower), false),
    ];
    let mut all: Vec<Line> = all.into_iter().flatten().collect();
    // Nothing varies: one line, one label.
    if control.is_some_and(|k| k.lower == k.upper) {
        all.retain(|l| l.name != "control");
    }
    all
}

/// The labels, each as near to its line as the others let it.
pub fn gutter(s: Style, axes: &Axes, lines: &[Line]) -> Markup {
    let mut order: Vec<(&Line, f64)> =
        lines.iter().map(|l| (l, axes.y(l.value, CHART_HEIGHT).clamp(0.0, CHART_HEIGHT))).collect();
    order.sort_by(|a, b| b.0.value.total_cmp(&a.0.value));
    let mut middles: Vec<f64> = Vec::new();
    let mut free = 0.0;
    for (_, y) in &order {
        let top = f64::max(free, y - 0.5 * LABEL_HEIGHT);
        middles.push(top + 0.5 * LABEL_HEIGHT);
        free = top + LABEL_HEIGHT;
    }
    let mut limit = CHART_HEIGHT;
    for middle in middles.iter_mut().rev() {
        *middle = middle.min(limit - 0.5 * LABEL_HEIGHT);
        limit = *middle - 0.5 * LABEL_HEIGHT;
    }
    html! {
        svg.gutter width=(GUTTER_WIDTH) height=(CHART_HEIGHT) viewBox={ "0 0 " (GUTTER_WIDTH) " " (CHART_HEIGHT) } {
            @for ((line, y), middle) in order.iter().zip(middles) { (label(s, axes, line, *y, middle)) }
        }
    }
}

/// A label with its stroke, or with an arrow where its line is beyond the chart.
fn label(s: Style, axes: &Axes, line: &Line, y: f64, middle: f64) -> Markup {
    let held = axes.holds(line.value);
    let stroke = format!("M0 {y:.2}L{STROKE_LENGTH} {middle:.2}");
    html! {
        @if held { (leaf("path", &[("class", &line.name), ("d", &stroke)])) }
        text class=(line.name) x=(STROKE_LENGTH + 3.0) y=(format!("{middle:.2}")) {
            @if !held { (if line.value > axes.to { "↑ " } else { "↓ " }) }
            tspan data-t=(line.key) { (s.bare_word(line.key)) }
            " "
            tspan data-n=(line.value) data-d=(line.decimals) { (s.fixed(line.value, line.decimals)) }
        }
    }
}
