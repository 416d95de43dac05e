//! The flags of the stored picture, as SVG over it: for print, and for readers without scripts or WebGL.

use super::super::documents::Pick;
use super::super::html::Html;
use super::super::picture::FirstView;
use crate::scale::Scale;

/// A flag's box, and the room between two and to the rim, in pixels of the picture.
const WIDTH: f64 = 130.0;
/// What a note beside the value takes more.
const NOTE: f64 = 104.0;
const HEIGHT: f64 = 32.0;
const GAP: f64 = 8.0;

/// A flag that has found its place.
struct Placed {
    pick: usize,
    label: usize,
    x: f64,
    y: f64,
    top: f64,
}

/// Writes the layer. It is there without flags too, for the script to draw into.
pub fn flags(h: &mut Html, picks: &[Pick], view: &FirstView, scale: Option<&Scale>) {
    let [width, height] = FirstView::SIZE.map(f64::from);
    h.raw(&format!(
        "<svg id=\"flagged\" class=\"flagged\" viewBox=\"0 0 {width} {height}\" aria-hidden=\"true\">"
    ));
    let valued = picks.iter().enumerate().filter(|(_, p)| p.value.is_some() && p.map.unwrap_or(0) == 0);
    let placed = valued.enumerate().map(|(n, (pick, p))| {
        let [x, y] = view.pixel(&p.position);
        Placed { pick, label: n + 1, x, y, top: 0.0 }
    });
    let (mut left, mut right): (Vec<Placed>, Vec<Placed>) = placed.partition(|f| f.x < 0.5 * width);
    for (column, at) in [(&mut left, GAP), (&mut right, width - WIDTH - GAP)] {
        stack(column, height);
        for flag in column {
            let note = if view.off.get(flag.pick) == Some(&true) { NOTE } else { 0.0 };
            let [left, inner] = if at > GAP { [at - note; 2] } else { [at, at + WIDTH + note] };
            draw(h, flag, &picks[flag.pick], view, scale, [left, WIDTH + note, inner]);
        }
    }
    h.raw("</svg>\n");
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

fn draw(
    h: &mut Html,
    flag: &Placed,
    pick: &Pick,
    view: &FirstView,
    scale: Option<&Scale>,
    [left, width, inner]: [f64; 3],
) {
    let hidden = view.hidden.get(flag.pick) == Some(&true);
    let class = if hidden { " hidden" } else { "" };
    let (Placed { label, x, y, top, .. }, middle) = (flag, flag.top + 0.5 * HEIGHT);
    let mut line = |class: &str, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2]| {
        h.raw(&format!(
            "<line class=\"{class}\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>"
        ));
    };
    line(&format!("leader{class}"), [inner, middle], [*x, *y]);
    let off = view.off.get(flag.pick) == Some(&true);
    if let Some(surface) = pick.surface.filter(|_| off) {
        line("way", [*x, *y], view.pixel(&surface));
    }
    h.raw(&format!("<circle class=\"anchor\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4.5\"/>"));
    h.raw(&format!(
        "<rect class=\"{class}\" x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width}\" height=\"{HEIGHT}\" rx=\"5\"/>"
    ));
    let decimals = scale.map_or(3, |s| s.decimals as usize);
    let value = h.style.signed(pick.value.unwrap_or(0.0), decimals);
    h.raw(&format!(
        "<text class=\"{class}\" x=\"{:.1}\" y=\"{middle:.1}\">{label}\u{2002}{value}",
        left + 10.0
    ));
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
