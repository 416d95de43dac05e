//! The flags of the stored picture, as SVG over it: for print, and for readers without scripts or WebGL.

use super::super::documents::{Frame, Pick};
use super::super::html::Html;
use super::super::number::Style;
use super::super::picture::{FirstView, flagged};
use crate::scale::Scale;

/// A flag's box, and the room between two and to the rim, in pixels of the picture.
const WIDTH: f64 = 130.0;
/// What a note beside the value takes more.
const NOTE: f64 = 104.0;
const HEIGHT: f64 = 32.0;
const GAP: f64 = 8.0;
/// How far a leader runs straight out of the column before it turns to its place.
const STUB: f64 = 6.0;
/// Width of a sign, and of a letter of usual text.
const SIGN: f64 = 22.0;
const LETTER: f64 = 8.6;

/// A flag that has found its place.
struct Placed {
    pick: usize,
    label: usize,
    x: f64,
    y: f64,
    top: f64,
    /// Left end and width of its box, the end that looks to the place, and where the leader begins: beside the widest box of
    /// the column, so that it runs behind none.
    left: f64,
    width: f64,
    inner: f64,
    start: f64,
}

/// Writes the layer. It is there without flags too, for the script to draw into.
pub fn flags(h: &mut Html, picks: &[Pick], view: &FirstView, scale: Option<&Scale>) {
    let [width, height] = FirstView::SIZE.map(f64::from);
    h.raw(&format!(
        "<svg id=\"flagged\" class=\"flagged\" viewBox=\"0 0 {width} {height}\" aria-hidden=\"true\">"
    ));
    let valued = picks.iter().enumerate().filter(|(_, p)| flagged(p, view.mapped));
    let placed: Vec<Placed> = valued
        .enumerate()
        .map(|(n, (pick, p))| {
            let [x, y] = view.pixel(&view.ends[pick]);
            let own = match &p.frame {
                Some(frame) => framed(h.style, frame).1,
                None if view.off.get(pick) == Some(&true) => WIDTH + NOTE,
                None => WIDTH,
            };
            let (left, inner) = match x < 0.5 * width {
                true => (GAP, GAP + own),
                false => (width - GAP - own, width - GAP - own),
            };
            Placed { pick, label: n + 1, x, y, top: 0.0, left, width: own, inner, start: inner }
        })
        .collect();
    let (mut left, mut right): (Vec<Placed>, Vec<Placed>) =
        placed.into_iter().partition(|f| f.x < 0.5 * width);
    for column in [&mut left, &mut right] {
        // The first matter most; the list has them all.
        column.truncate(((height - GAP) / (HEIGHT + GAP)) as usize);
        stack(column, height);
        let reach = GAP + STUB + column.iter().map(|f| f.width).fold(0.0, f64::max);
        for flag in column {
            flag.start = if flag.left > GAP { width - reach } else { reach };
            draw(h, flag, &picks[flag.pick], view, scale);
        }
    }
    h.raw("</svg>\n");
}

/// What a frame says behind its sign, and how wide its box is.
fn framed(style: Style, frame: &Frame) -> (String, f64) {
    let found = |x| style.fixed(x, frame.decimals);
    // As on a drawing: no zeros behind the last digit.
    let allowed = |x| {
        let text = found(x);
        match frame.decimals {
            0 => text,
            _ => text.trim_end_matches('0').trim_end_matches(['.', ',']).to_string(),
        }
    };
    let mut text = String::from(if frame.diametral { "⌀" } else { "" });
    if let Some(lower) = frame.lower {
        text += &format!("{}\u{2009}…\u{2009}", allowed(lower));
    }
    text += &allowed(frame.upper);
    if let Some(letter) = frame.material {
        text += &format!("\u{a0}({letter})");
    }
    for datum in &frame.datums {
        text += &format!(" | {datum}");
    }
    text += &format!("\u{2002}{}", frame.value.map_or("–".into(), found));
    let width = SIGN * f64::from(u8::from(frame.sign.is_some()))
        + LETTER * (frame.id.chars().count() + 1 + text.chars().count()) as f64
        + 20.0;
    (text, width)
}

/// Each as near to its place as the others let it.
fn stack(column: &mut [Placed], height: f64) {
    column.sort_by(|a, b| a.y.total_cmp(&b.y));
    let mut free = GAP;
    for flag in column.iter_mut() {
        flag.top = free.max(flag.y - 0.5 * HEIGHT);
        free = flag.top + HEIGHT + GAP;
    }
    let mut limit = height - GAP;
    for flag in column.iter_mut().rev() {
        flag.top = flag.top.min(limit - HEIGHT);
        limit = flag.top - GAP;
    }
}

fn draw(h: &mut Html, flag: &Placed, pick: &Pick, view: &FirstView, scale: Option<&Scale>) {
    let hidden = view.hidden.get(flag.pick) == Some(&true);
    let class = if hidden { " hidden" } else { "" };
    let (Placed { label, x, y, top, left, width, inner, start: begin, .. }, middle) =
        (flag, flag.top + 0.5 * HEIGHT);
    let mut line = |class: &str, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2]| {
        h.raw(&format!(
            "<line class=\"{class}\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>"
        ));
    };
    line(&format!("stub{class}"), [*inner, middle], [*begin, middle]);
    line(&format!("leader{class}"), [*begin, middle], [*x, *y]);
    let off = view.off.get(flag.pick) == Some(&true);
    if let Some(surface) = pick.surface.filter(|_| off) {
        line("way", [*x, *y], view.pixel(&surface));
    }
    h.raw(&format!("<circle class=\"anchor\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4.5\"/>"));
    let verdict = pick.frame.as_ref().map_or(String::new(), |f| format!(" frame {}", f.verdict));
    h.raw(&format!(
        "<rect class=\"{class}{verdict}\" x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{HEIGHT}\" rx=\"5\"/>"
    ));
    let mut start = left + 10.0;
    if let Some(frame) = &pick.frame {
        h.raw(&format!("<text class=\"id{class}\" x=\"{start:.1}\" y=\"{middle:.1}\">"));
        h.text(&frame.id).raw("</text>");
        start += LETTER * (frame.id.chars().count() + 1) as f64;
        if let Some(sign) = frame.sign {
            let y = middle - 8.0;
            h.raw(&format!(
                "<path class=\"gdt{class}\" transform=\"translate({start:.1} {y:.1})\" d=\"{sign}\"/>"
            ));
            start += SIGN;
        }
        h.raw(&format!("<text class=\"{class}{verdict}\" x=\"{start:.1}\" y=\"{middle:.1}\">"));
        let text = framed(h.style, frame).0;
        h.text(&text).raw("</text>");
        return;
    }
    let decimals = scale.map_or(3, |s| s.decimals as usize);
    let value = h.style.signed(pick.value.unwrap_or(0.0), decimals);
    h.raw(&format!("<text class=\"{class}\" x=\"{start:.1}\" y=\"{middle:.1}\">{label}\u{2002}{value}"));
    if off {
        h.raw(" ").raw("<tspan data-t=\"flag.off\">");
        h.text(super::super::text::word("flag.off", h.language())).raw("</tspan>");
    }
    h.raw("</text>");
}

/// How many of the places that the view was chosen for it does not show; the script says it of its own view.
pub fn hidden(h: &mut Html, view: &FirstView) {
    let hidden = view.places.iter().filter(|(_, hidden)| *hidden).count() as u64;
    let none = if hidden == 0 { " hidden" } else { "" };
    h.raw(&format!("<p id=\"unseen\" class=\"unseen-places\"{none}>")).word("hidden.here").raw(" ");
    h.count(hidden).raw(" / ").count(view.places.len() as u64).raw("</p>\n");
}
