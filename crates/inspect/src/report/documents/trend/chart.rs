//! The course of a characteristic: its value of each part, as SVG.
//!
//! The chart is stretched to the room there is; words and numbers stand in drawings of their own around it, so that they are not.

use super::super::super::html::Html;
use super::super::super::page::blocks::{Headline, badge};
use super::super::super::page::symbols::{datum_name, symbol};
use super::super::super::text::word;
use super::axes::{Axes, HEIGHT, WIDTH};
use super::gutter::{Line, gutter, lines, number};
use crate::results::Verdict;
use crate::results::trend::{TrendDocument, TrendRecord};
use std::fmt::Write;

/// Width of the numbers on the left, pixels.
const LEFT: f64 = 64.0;
/// More parts than this have smaller dots.
const MANY: usize = 150;
/// The verdicts in the order in which their dots are drawn, the worst on top.
pub const ORDER: [Verdict; 4] = [Verdict::NotMeasured, Verdict::Pass, Verdict::Undecided, Verdict::Fail];

/// Writes the chart of characteristic `n`, with `below` under it.
pub fn chart(h: &mut Html, document: &TrendDocument, n: usize, below: impl FnOnce(&mut Html, &Axes)) {
    let c = &document.characteristics[n];
    let axes = Axes::of(c);
    h.raw(&format!("<figure class=\"chart\" id=\"course-{n}\" data-of=\"{n}\" data-decimals=\"{}\"><figcaption><span class=\"of-what\">", axes.decimals));
    h.name(&c.id).raw(" ");
    h.add(symbol(&c.kind));
    h.word(&format!("kind.{}", c.kind)).raw(" <small>").name(&c.feature);
    for datum in &c.datums {
        h.raw(" | ");
        h.add(datum_name(datum));
    }
    h.raw("</small></span><span class=\"unit\">").text(unit(c)).raw("</span>");
    badge(h, Headline::from(c.verdict()));
    h.raw("</figcaption>\n<div class=\"around\">");
    let lines = lines(c, &axes);
    values(h, &axes);
    plot(h, c, &axes, &lines);
    gutter(h, &axes, &lines);
    parts(h, &axes);
    h.raw("</div>\n");
    below(h, &axes);
    h.raw("</figure>\n");
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
fn values(h: &mut Html, axes: &Axes) {
    h.raw(&format!(
        "<svg class=\"values\" width=\"{LEFT}\" height=\"{HEIGHT}\" viewBox=\"0 0 {LEFT} {HEIGHT}\">"
    ));
    let (ticks, decimals) = axes.ticks();
    for value in ticks {
        let y = axes.y(value, HEIGHT);
        h.raw(&format!("<path d=\"M{} {y:.2}H{LEFT}\"/>", LEFT - 4.0));
        let place = format!(" x=\"{}\" y=\"{:.2}\"", LEFT - 7.0, y.clamp(6.0, HEIGHT - 6.0));
        number(h, "text", &place, value, decimals);
    }
    h.raw("</svg>");
}

/// Numbers of parts below.
fn parts(h: &mut Html, axes: &Axes) {
    h.raw("<span class=\"corner\">")
        .word("part")
        .raw("</span><svg class=\"numbers-of-parts\" height=\"18\">");
    for part in axes.numbered() {
        let place = format!(" x=\"{:.3}%\" y=\"13\"", axes.x(part, 100.0));
        number(h, "text", &place, part as f64 + 1.0, 0);
    }
    h.raw("</svg>");
}

fn plot(h: &mut Html, c: &TrendRecord, axes: &Axes, lines: &[Line]) {
    let many = if axes.parts > MANY { " many" } else { "" };
    h.raw(&format!(
        "<svg class=\"plot{many}\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" preserveAspectRatio=\"none\" data-from=\"{}\" \
         data-to=\"{}\" data-parts=\"{}\" role=\"img\"><title>",
        axes.from, axes.to, axes.parts
    ));
    h.text(word("chart.title", h.language())).raw(": ").text(&c.id).raw("</title>");
    band(h, c, axes, HEIGHT);
    for line in lines.iter().filter(|l| axes.holds(l.value)) {
        h.raw(&format!("<path class=\"{}\" d=\"M0 {:.3}H{WIDTH}\"/>", line.name, axes.y(line.value, HEIGHT)));
    }
    let missing = (0..axes.parts).filter(|n| c.values[*n].is_none());
    let d: String = missing.map(|n| format!("M{:.3} 0V{HEIGHT}", axes.x(n, WIDTH))).collect();
    if !d.is_empty() {
        h.raw(&format!("<path class=\"missing\" d=\"{d}\"/>"));
    }
    course(h, c, axes, [WIDTH, HEIGHT]);
    whiskers(h, c, axes);
    let mut out: Vec<usize> = c.out_of_control.iter().filter_map(|o| usize::try_from(o.part).ok()).collect();
    out.dedup();
    let d = dots(c, axes, |n| out.binary_search(&n).is_ok());
    if !d.is_empty() {
        h.raw(&format!("<path class=\"ring\" d=\"{d}\"/><path class=\"ring-within\" d=\"{d}\"/>"));
    }
    for verdict in ORDER {
        let d = dots(c, axes, |n| c.verdicts.get(n) == Some(&verdict));
        if !d.is_empty() {
            h.raw(&format!("<path class=\"dots {}\" d=\"{d}\"/>", Headline::from(verdict).key));
            if verdict == Verdict::Undecided {
                h.raw(&format!("<path class=\"hole\" d=\"{d}\"/>"));
            }
        }
    }
    h.raw("</svg>");
}

/// What is allowed: a band, of a material requirement one that each part has for itself.
pub fn band(h: &mut Html, c: &TrendRecord, axes: &Axes, height: f64) {
    let foot = c.lower.map_or(height, |l| axes.y(l, height).clamp(0.0, height));
    let within = |upper: f64| axes.y(upper, height).clamp(0.0, height);
    match (&c.own_upper, c.upper) {
        (Some(all), _) => {
            let half = 0.5 * WIDTH / axes.parts.max(1) as f64;
            let (mut area, mut line) = (format!("M0 {foot:.3}"), String::new());
            for (n, upper) in all.iter().enumerate() {
                let (x, y) = (axes.x(n, WIDTH), within(*upper));
                let _ = write!(area, "L{:.3} {y:.3}H{:.3}", x - half, x + half);
                let _ = write!(line, "M{:.3} {y:.3}H{:.3}", x - half, x + half);
            }
            h.raw(&format!(
                "<path class=\"allowed\" d=\"{area}V{foot:.3}Z\"/><path class=\"limit\" d=\"{line}\"/>"
            ));
        }
        (None, Some(upper)) => {
            let y = within(upper);
            let height = (foot - y).max(0.0);
            h.raw(&format!(
                "<rect class=\"allowed\" x=\"0\" y=\"{y:.3}\" width=\"{WIDTH}\" height=\"{height:.3}\"/>"
            ));
        }
        (None, None) => {}
    }
}

/// The line from value to value; it is broken where one is missing.
pub fn course(h: &mut Html, c: &TrendRecord, axes: &Axes, [width, height]: [f64; 2]) {
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
    if !d.is_empty() {
        h.raw(&format!("<path class=\"course-line\" d=\"{d}\"/>"));
    }
}

fn whiskers(h: &mut Html, c: &TrendRecord, axes: &Axes) {
    let Some(all) = &c.uncertainties else { return };
    let mut d = String::new();
    for (n, (value, u)) in c.values.iter().zip(all).enumerate() {
        if let (Some(v), Some(u)) = (value, u) {
            let [low, high] = [v - u, v + u].map(|y| axes.y(y, HEIGHT));
            let _ = write!(d, "M{:.3} {low:.3}V{high:.3}", axes.x(n, WIDTH));
        }
    }
    if !d.is_empty() {
        h.raw(&format!("<path class=\"whiskers\" d=\"{d}\"/>"));
    }
}

/// The dots of some parts; of those without a value at the foot.
fn dots(c: &TrendRecord, axes: &Axes, which: impl Fn(usize) -> bool) -> String {
    let mut d = String::new();
    for (n, value) in c.values.iter().enumerate().filter(|(n, _)| which(*n)) {
        let y = value.map_or(HEIGHT - 7.0, |v| axes.y(v, HEIGHT));
        let _ = write!(d, "M{:.3} {y:.3}h0", axes.x(n, WIDTH));
    }
    d
}
