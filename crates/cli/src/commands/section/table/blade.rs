//! Chords, twist, offset and lean of blades, for people.

use crate::console;
use crate::number::fixed;
use std::fmt::Write;
use trueness_document::section::{AirfoilMeasures, LeanRecord};

/// The chords of a profile and its stacking point.
pub fn chords(m: &AirfoilMeasures) -> String {
    let mut out = String::new();
    if let Some(reason) = &m.chords_reason {
        let _ = writeln!(out, "no chords: {reason}");
    }
    if m.chords.is_empty() {
        return out;
    }
    let degrees = |x: f64| format!("{}°", fixed(x.to_degrees(), 4));
    let twist = m.chords.iter().any(|c| c.twist.is_some());
    let mut head = vec!["chord by", "length", "angle with x"];
    head.extend(twist.then_some("twist against the nominal"));
    let mut rows = vec![head.into_iter().map(String::from).collect::<Vec<_>>()];
    for chord in &m.chords {
        let mut row = vec![
            chord.definition.name().replace('_', " "),
            chord.length.map_or("–".into(), |x| fixed(x, 6)),
            chord.angle.map_or("–".into(), degrees),
        ];
        row.extend(twist.then(|| chord.twist.map_or("–".into(), degrees)));
        rows.push(row);
    }
    out.push_str(&console::columns(&rows));
    for chord in &m.chords {
        if let Some(reason) = &chord.length_reason {
            let _ = writeln!(out, "no {} chord: {reason}", chord.definition.name().replace('_', " "));
        }
    }
    // One reason for all: that there is no nominal is no news.
    let told =
        m.chords.iter().filter_map(|c| c.twist_reason.as_deref()).find(|r| r.starts_with("the nominal is"));
    told.into_iter().for_each(|reason| _ = writeln!(out, "no twist: {reason}"));
    if let Some([x, y]) = m.centroid.map(|c| c.map(|x| fixed(x, 6))) {
        let area = m.area.map_or(String::new(), |a| format!("   area {}", fixed(a, 6)));
        let _ = writeln!(out, "centroid {x} {y}{area}");
    }
    if let Some(s) = &m.stacking {
        let [a, b, c, d] = [s.point[0], s.point[1], s.offset[0], s.offset[1]].map(|x| fixed(x, 6));
        let _ = writeln!(
            out,
            "stacking point {a} {b} ({})   offset {c} {d}   along the chord {}   across it {}",
            s.by,
            fixed(s.along_chord, 6),
            fixed(s.across_chord, 6)
        );
    }
    out
}

/// How the stacking points lean from plane to plane.
pub fn lean(found: &LeanRecord) -> String {
    let [x, y] = found.lean.map(|a| fixed(a.to_degrees(), 4));
    format!(
        "lean of the stacking points over {} planes: {x}° toward x, {y}° toward y, within {}\n",
        found.planes,
        fixed(found.greatest, 6)
    )
}
