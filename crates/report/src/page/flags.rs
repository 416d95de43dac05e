//! The flags of the stored picture, as SVG over it: for print, and for readers without scripts or WebGL.

use super::super::number::Style;
use super::super::picture::{FirstView, flagged};
use super::super::subject::{Frame, Pick};
use super::super::values::{Text, leaf};
use maud::{Markup, html};
use trueness_document::scale::Scale;

/// A flag's box, and the room between two and to the rim, in pixels of the picture.
const FLAG_WIDTH: f64 = 130.0;
/// What a note beside the value takes more.
const NOTE_WIDTH: f64 = 104.0;
const FLAG_HEIGHT: f64 = 32.0;
const FLAG_GAP: f64 = 8.0;
/// How far a leader runs straight out of the column before it turns to its place.
const STUB_LENGTH: f64 = 6.0;
/// Width of a sign, and of a letter of usual text.
const SIGN_WIDTH: f64 = 22.0;
const LETTER_WIDTH: f64 = 9.0;

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

/// The layer. It is there without flags too, for the script to draw into.
pub fn flags(s: Style, picks: &[Pick], view: &FirstView, scale: Option<&Scale>) -> Markup {
    let [width, height] = FirstView::SIZE.map(f64::from);
    let placed: Vec<Placed> = flagged(picks, view.mapped)
        .into_iter()
        .enumerate()
        .map(|(n, pick)| {
            let p = &picks[pick];
            let [x, y] = view.pixel(&view.ends[pick]);
            let own = match &p.frame {
                Some(frame) => framed(s, frame).1,
                None if view.off.get(pick) == Some(&true) => FLAG_WIDTH + NOTE_WIDTH,
                None => FLAG_WIDTH,
            };
            let (left, inner) = match x < 0.5 * width {
                true => (FLAG_GAP, FLAG_GAP + own),
                false => (width - FLAG_GAP - own, width - FLAG_GAP - own),
            };
            Placed { pick, label: n + 1, x, y, top: 0.0, left, width: own, inner, start: inner }
        })
        .collect();
    let (mut left, mut right): (Vec<Placed>, Vec<Placed>) =
        placed.into_iter().partition(|f| f.x < 0.5 * width);
    for column in [&mut left, &mut right] {
        // The first matter most; the list has them all.
        column.truncate(((height - FLAG_GAP) / (FLAG_HEIGHT + FLAG_GAP)) as usize);
        stack(column, height);
        let reach = FLAG_GAP + STUB_LENGTH + column.iter().map(|f| f.width).fold(0.0, f64::max);
        for flag in column {
            flag.start = if flag.left > FLAG_GAP { width - reach } else { reach };
        }
    }
    html! {
        svg id="flagged" class="flagged" viewBox={ "0 0 " (width) " " (height) } aria-hidden="true" {
            @for flag in left.iter().chain(&right) { (draw(s, flag, &picks[flag.pick], view, scale)) }
        }
        "\n"
    }
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
    let mut text = frame.parameter.as_ref().map_or(String::new(), |name| format!("{name}\u{a0}"));
    text += if frame.diametral { "⌀" } else { "" };
    if let Some(lower) = frame.lower {
        text += &format!("{}\u{2009}…\u{2009}", allowed(lower));
    }
    text += &allowed(frame.upper);
    text += frame.unit;
    for letters in &frame.letters {
        text += &format!("\u{a0}{letters}");
    }
    if let Some(letter) = frame.material {
        text += &format!("\u{a0}({letter})");
    }
    for datum in &frame.datums {
        text += &format!(" | {datum}");
    }
    text += &format!("\u{2002}{}", frame.value.map_or("–".into(), |x| found(x) + frame.unit));
    let width = SIGN_WIDTH * f64::from(u8::from(frame.sign.is_some()))
        + LETTER_WIDTH * (frame.id.chars().count() + 1 + text.chars().count()) as f64
        + 20.0;
    (text, width)
}

/// Each as near to its place as the others let it.
fn stack(column: &mut [Placed], height: f64) {
    column.sort_by(|a, b| a.y.total_cmp(&b.y));
    let mut free = FLAG_GAP;
    for flag in column.iter_mut() {
        flag.top = free.max(flag.y - 0.5 * FLAG_HEIGHT);
        free = flag.top + FLAG_HEIGHT + FLAG_GAP;
    }
    let mut limit = height - FLAG_GAP;
    for flag in column.iter_mut().rev() {
        flag.top = flag.top.min(limit - FLAG_HEIGHT);
        limit = flag.top - FLAG_GAP;
    }
}

/// A flag with its leader.
fn draw(s: Style, flag: &Placed, pick: &Pick, view: &FirstView, scale: Option<&Scale>) -> Markup {
    let hidden = view.hidden.get(flag.pick) == Some(&true);
    let off = view.off.get(flag.pick) == Some(&true);
    let class = if hidden { " hidden" } else { "" };
    let (Placed { x, y, inner, start: begin, .. }, middle) = (flag, flag.top + 0.5 * FLAG_HEIGHT);
    let surface = pick.surface.filter(|_| off);
    html! {
        (line(&format!("stub{class}"), [*inner, middle], [*begin, middle]))
        (line(&format!("leader{class}"), [*begin, middle], [*x, *y]))
        @if let Some(surface) = surface { (line("way", [*x, *y], view.pixel(&surface))) }
        @if view.reached.get(flag.pick) != Some(&false) {
            (leaf("circle", &[("class", &"anchor"), ("cx", &places(*x)), ("cy", &places(*y)), ("r", &4.5)]))
        }
        @match &pick.frame {
            Some(frame) => (written(s, flag, frame, class)),
            None => {
                (around(flag, class))
                text class=(class) x=(places(flag.left + 10.0)) y=(places(middle)) {
                    (flag.label) "\u{2002}"
                    (s.on_scale(pick.value.unwrap_or(0.0), scale))
                    @if off { " " tspan data-t="flag.off" { (s.bare_word("flag.off")) } }
                }
            }
        }
    }
}

/// A length as drawings have it.
fn places(x: f64) -> String {
    format!("{x:.1}")
}

fn line(class: &str, from: [f64; 2], to: [f64; 2]) -> Markup {
    let ([x1, y1], [x2, y2]) = (from.map(places), to.map(places));
    leaf("line", &[("class", &class), ("x1", &x1), ("y1", &y1), ("x2", &x2), ("y2", &y2)])
}

/// The box of a flag.
fn around(flag: &Placed, class: &str) -> Markup {
    let [x, y, width] = [flag.left, flag.top, flag.width].map(places);
    leaf(
        "rect",
        &[("class", &class), ("x", &x), ("y", &y), ("width", &width), ("height", &FLAG_HEIGHT), ("rx", &5)],
    )
}

/// A characteristic in its box: its name, its sign, what is allowed and what was found.
fn written(s: Style, flag: &Placed, frame: &Frame, class: &str) -> Markup {
    let middle = flag.top + 0.5 * FLAG_HEIGHT;
    let sign = flag.left + 10.0 + LETTER_WIDTH * (frame.id.chars().count() + 1) as f64;
    let turned = format!("translate({sign:.1} {:.1})", middle - 8.0);
    let start = sign + if frame.sign.is_some() { SIGN_WIDTH } else { 0.0 };
    let verdict = format!("{class} frame {}", frame.verdict);
    html! {
        (around(flag, &verdict))
        text class={ "id" (class) } x=(places(flag.left + 10.0)) y=(places(middle)) { (Text(&frame.id)) }
        @if let Some(path) = frame.sign {
            (leaf("path", &[("class", &format!("gdt{class}")), ("transform", &turned), ("d", &path)]))
        }
        text class=(verdict) x=(places(start)) y=(places(middle)) { (Text(framed(s, frame).0)) }
    }
}

/// How many of the places that the view was chosen for it does not show; the script says it of its own view.
pub fn hidden(s: Style, view: &FirstView) -> Markup {
    let hidden = view.places.iter().filter(|(_, hidden)| *hidden).count() as u64;
    html! {
        p id="unseen" class="unseen-places" hidden[hidden == 0] {
            (s.word("hidden.here")) " " (s.count(hidden)) " / " (s.len(&view.places))
        }
        "\n"
    }
}
