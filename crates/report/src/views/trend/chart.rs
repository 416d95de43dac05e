//! The course of a characteristic: its value of each part, as SVG.
//!
//! The chart is stretched to the room there is; words and numbers stand in drawings of their own around it, so that they are not.

use super::axes::{Axes, CHART_HEIGHT, CHART_WIDTH};
use super::gutter::{Line, gutter, lines};
use crate::headline::Headline;
use crate::number::Style;
use crate::page::parts::badge;
use crate::page::symbols::{datum_name, symbol};
use crate::values::{Name, Text, leaf};
use maud::{Markup, html};
use std::fmt::Write;
use trueness_document::Verdict;
use trueness_document::trend::{TrendDocument, TrendRecord};

/// Width of the numbers on the left, pixels.
const VALUES_WIDTH: f64 = 64.0;
/// More parts than this have smaller dots.
const MAX_LARGE_DOTS: usize = 150;
/// The verdicts in the order in which their dots are drawn, the worst on top.
pub const ORDER: [Verdict; 4] = [Verdict::NotMeasured, Verdict::Pass, Verdict::Undecided, Verdict::Fail];

/// The chart of characteristic `n`, with `below` under it.
pub fn chart(s: Style, document: &TrendDocument, n: usize, axes: &Axes, below: Markup) -> Markup {
    let c = &document.characteristics[n];
    let lines = lines(c, axes);
    html! {
        figure.chart id={ "course-" (n) } data-of=(n) data-decimals=(axes.decimals) {
            figcaption {
                span.of-what {
                    (Name(&c.id)) " " (symbol(&c.kind)) (s.word(format!("kind.{}", c.kind))) " "
                    small {
                        (Name(&c.feature))
                        @for datum in &c.datums { " | " (datum_name(datum)) }
                    }
                }
                span.unit { (Text(unit(c))) }
                (badge(s, Headline::from(c.verdict())))
            }
            "\n"
            div.around {
                (values(s, axes)) (plot(s, c, axes, &lines)) (gutter(s, axes, &lines)) (parts(s, axes))
            }
            "\n" (below)
        }
        "\n"
    }
}

/// What the values of a characteristic are in.
pub fn unit(c: &TrendRecord) -> &str {
    match c.unit.as_str() {
        "deg" => "°",
        "1" => "",
        unit => unit,
    }
}

/// Round values on the left.
fn values(s: Style, axes: &Axes) -> Markup {
    let (ticks, decimals) = axes.ticks();
    html! {
        svg.values width=(VALUES_WIDTH) height=(CHART_HEIGHT) viewBox={ "0 0 " (VALUES_WIDTH) " " (CHART_HEIGHT) } {
            @for value in ticks {
                @let y = axes.y(value, CHART_HEIGHT);
                (leaf("path", &[("d", &format!("M{} {y:.2}H{VALUES_WIDTH}", VALUES_WIDTH - 4.0))]))
                text x=(VALUES_WIDTH - 7.0) y=(format!("{:.2}", y.clamp(6.0, CHART_HEIGHT - 6.0))) data-n=(value) data-d=(decimals) {
                    (s.fixed(value, decimals))
                }
            }
        }
    }
}

/// Numbers of parts below.
fn parts(s: Style, axes: &Axes) -> Markup {
    html! {
        span.corner { (s.word("part")) }
        svg.numbers-of-parts height="18" {
            @for part in axes.numbered() {
                text x=(format!("{:.3}%", axes.x(part, 100.0))) y="13" data-n=(part + 1) data-d="0" {
                    (s.fixed(part as f64 + 1.0, 0))
                }
            }
        }
    }
}

fn plot(s: Style, c: &TrendRecord, axes: &Axes, lines: &[Line]) -> Markup {
    let missing: String = (0..axes.parts)
        .filter(|n| c.values[*n].is_none())
        .map(|n| format!("M{:.3} 0V{CHART_HEIGHT}", axes.x(n, CHART_WIDTH)))
        .collect();
    let mut out: Vec<usize> = c.out_of_control.iter().filter_map(|o| usize::try_from(o.part).ok()).collect();
    out.dedup();
    let rings = dots(c, axes, DOT_HEIGHTS, |n| out.binary_search(&n).is_ok());
    html! {
        svg.plot.many[axes.parts > MAX_LARGE_DOTS] viewBox={ "0 0 " (CHART_WIDTH) " " (CHART_HEIGHT) } preserveAspectRatio="none"
            data-from=(axes.from) data-to=(axes.to) data-parts=(axes.parts) role="img" {
            title { (s.bare_word("chart.title")) ": " (Text(&c.id)) }
            (band(c, axes, CHART_HEIGHT))
            @for line in lines.iter().filter(|l| axes.holds(l.value)) {
                (path(line.name, &format!("M0 {:.3}H{CHART_WIDTH}", axes.y(line.value, CHART_HEIGHT))))
            }
            (path("missing", &missing))
            (course(c, axes, [CHART_WIDTH, CHART_HEIGHT]))
            (path("whiskers", &whiskers(c, axes)))
            (path("ring", &rings)) (path("ring-within", &rings))
            @for verdict in ORDER {
                @let d = dots(c, axes, DOT_HEIGHTS, |n| c.verdicts.get(n) == Some(&verdict));
                (path(&format!("dots {}", Headline::from(verdict).key), &d))
                @if verdict == Verdict::Undecided { (path("hole", &d)) }
            }
        }
    }
}

/// A path, if there is one.
fn path(class: &str, d: &str) -> Markup {
    if d.is_empty() { Markup::default() } else { leaf("path", &[("class", &class), ("d", &d)]) }
}

/// What is allowed: a band, of a material requirement one that each part has for itself.
pub fn band(c: &TrendRecord, axes: &Axes, height: f64) -> Markup {
    let foot = c.lower.map_or(height, |l| axes.y(l, height).clamp(0.0, height));
    let within = |upper: f64| axes.y(upper, height).clamp(0.0, height);
    match (&c.own_upper, c.upper) {
        (Some(all), _) => {
            let half = 0.5 * CHART_WIDTH / axes.parts.max(1) as f64;
            let (mut area, mut line) = (format!("M0 {foot:.3}"), String::new());
            for (n, upper) in all.iter().enumerate() {
                let (x, y) = (axes.x(n, CHART_WIDTH), within(*upper));
                let _ = write!(area, "L{:.3} {y:.3}H{:.3}", x - half, x + half);
                let _ = write!(line, "M{:.3} {y:.3}H{:.3}", x - half, x + half);
            }
            let _ = write!(area, "V{foot:.3}Z");
            let limit = leaf("path", &[("class", &"limit"), ("d", &line)]);
            html! { (leaf("path", &[("class", &"allowed"), ("d", &area)])) (limit) }
        }
        (None, Some(upper)) => {
            let y = within(upper);
            let [y, height] = [y, (foot - y).max(0.0)].map(|x| format!("{x:.3}"));
            leaf(
                "rect",
                &[("class", &"allowed"), ("x", &0), ("y", &y), ("width", &CHART_WIDTH), ("height", &height)],
            )
        }
        (None, None) => Markup::default(),
    }
}

/// The line from value to value; it is broken where one is missing.
pub fn course(c: &TrendRecord, axes: &Axes, [width, height]: [f64; 2]) -> Markup {
    let (mut d, mut open) = (String::new(), false);
    for (n, value) in c.values.iter().enumerate() {
        match value {
            Some(v) => {
                let letter = if open { 'L' } else { 'M' };
                let _ = write!(d, "{letter}{:.3} {:.3}", axes.x(n, width), axes.y(*v, height));
                open = true;
            }
            None => open = false,
        }
    }
    path("course-line", &d)
}

fn whiskers(c: &TrendRecord, axes: &Axes) -> String {
    let mut d = String::new();
    for (n, interval) in c.intervals.iter().flatten().enumerate() {
        if let Some(ends) = interval {
            let [low, high] = ends.map(|y| axes.y(y, CHART_HEIGHT));
            let _ = write!(d, "M{:.3} {low:.3}V{high:.3}", axes.x(n, CHART_WIDTH));
        }
    }
    d
}

/// Height of a chart, and of the dots of parts without a value over its foot.
const DOT_HEIGHTS: [f64; 2] = [CHART_HEIGHT, 7.0];

/// The dots of some parts; of those without a value at the foot.
pub fn dots(c: &TrendRecord, axes: &Axes, [height, foot]: [f64; 2], which: impl Fn(usize) -> bool) -> String {
    let mut d = String::new();
    for (n, value) in c.values.iter().enumerate().filter(|(n, _)| which(*n)) {
        let y = value.map_or(height - foot, |v| axes.y(v, height));
        let _ = write!(d, "M{:.3} {y:.3}h0", axes.x(n, CHART_WIDTH));
    }
    d
}
