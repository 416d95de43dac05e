//! Faces of a CAD model: what they are called, and the deviations of each.

use crate::number::Style;
use crate::page::parts::section;
use crate::page::table::{Row, table};
use crate::values::Name;
use maud::{Markup, html};
use trueness_document::compare::Comparison;
use trueness_document::face::{FaceDeviation, FaceRecord, worst_first};

/// Faces in the list; the document has all.
const MAX_LISTED_FACES: usize = 20;

/// The number and the name of a face, and its instance.
pub fn called(face: &FaceRecord) -> Markup {
    html! {
        (face.face)
        @if let Some(name) = &face.name { " " (Name(name)) }
        @if let Some(instance) = &face.instance { " " small { (Name(instance)) } }
    }
}

/// The faces with the farthest deviations, the worst first; nothing for a reference without faces.
pub fn faces(s: Style, c: &Comparison, decimals: usize) -> Markup {
    let worst = worst_first(&c.faces, MAX_LISTED_FACES);
    if worst.is_empty() {
        return Markup::default();
    }
    let judged = c.faces.iter().any(|f| f.inside.is_some());
    let row = |f: &&FaceDeviation| {
        let (count, rms) = (s.count(f.count), s.number(f.rms, decimals + 1));
        let (farthest, name) = (s.number(f.worst(), decimals).signed(), called(&f.face));
        match judged {
            true => Row::of(&[&name, &count, &rms, &farthest, &s.optional_percent(f.inside, 1)]),
            false => Row::of(&[&name, &count, &rms, &farthest]),
        }
        .named()
    };
    let numbers: &[&str] = match judged {
        true => &["points", "rms", "deviation", "within.short"],
        false => &["points", "rms", "deviation"],
    };
    let rows = worst.iter().map(row);
    let body = html! {
        (table(s, "statistics", [&[""], numbers], rows))
        @if c.faces.len() > worst.len() {
            p.note { (s.count(worst.len() as u64)) " / " (s.count(c.faces.len() as u64)) }
        }
    };
    section(s, "partition", body)
}
