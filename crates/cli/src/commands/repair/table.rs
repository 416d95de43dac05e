//! The repair as a table for people.

use crate::console::columns;
use crate::number::{FACETS, SHELLS, VERTICES, counted, extent, fixed, grouped, scientific, signed};
use std::collections::BTreeMap;
use trueness_document::InputRecord;
use trueness_document::repair::{RepairDocument, State};
use trueness_measure::words::ToGeometry;
use trueness_solid::repair::Removes;

/// The whole text.
pub fn text(d: &RepairDocument) -> String {
    let mut out = String::new();
    for input in &d.inputs {
        line(&mut out, "mesh", &format!("{}  ({}, {})", input.path, input.format, input.unit_assumed));
        input.warnings.iter().for_each(|w| line(&mut out, "!", w));
    }
    line(&mut out, "before", &state(&d.before));
    line(&mut out, "after", &state(&d.after));
    line(
        &mut out,
        "bodies",
        &format!("{} before, {} after", grouped(d.effect.bodies_before), grouped(d.effect.bodies_after)),
    );
    if let Some(volume) = volume(d) {
        line(&mut out, "volume", &volume);
    }
    let (v, f) = (&d.vertices, &d.facets);
    let counts = |kept: u64, added: u64, removed: u64| {
        format!("{} kept, {} added, {} removed", grouped(kept), grouped(added), grouped(removed))
    };
    line(
        &mut out,
        "vertices",
        &format!("{} moved, {}", grouped(v.moved), counts(v.kept, v.added, v.removed)),
    );
    line(&mut out, "facets", &counts(f.kept, f.added, f.removed));
    match (&d.deviation, &d.deviation_reason) {
        (Some(x), _) => line(
            &mut out,
            "deviation",
            &format!(
                "{} mm at most, {} mm on average (old to new); {} and {} (new to old)",
                fixed(x.removed.max, 6),
                fixed(x.removed.mean, 6),
                fixed(x.added.max, 6),
                fixed(x.added.mean, 6)
            ),
        ),
        (None, reason) => {
            line(&mut out, "deviation", &format!("unknown: {}", reason.as_deref().unwrap_or_default()))
        }
    }
    if let Some(surface) = d.effect.surface {
        let (surface, limit) = (fixed(surface, 6), fixed(d.effect.surface_limit, 6));
        let text = format!("off by {surface} mm at most where it bounds (limit {limit} mm)");
        line(&mut out, "surface", &text);
    }
    changes(&mut out, d);
    defects(&mut out, d);
    out.push_str(&verdict(d));
    out
}

fn line(out: &mut String, name: &str, text: &str) {
    out.push_str(&format!("{name:<9} {text}\n"));
}

fn state(s: &State) -> String {
    let volume = match (s.volume, &s.volume_reason) {
        (Some(volume), _) => format!("{} mm³", extent(volume)),
        (None, Some(reason)) if s.closed => format!("no volume: {reason}"),
        (None, _) => "open".into(),
    };
    let counts = [(s.facets, FACETS), (s.vertices, VERTICES), (s.shells, SHELLS)];
    let counts = counts.map(|(n, what)| counted(n, what)).join(", ");
    format!("{counts}, {} mm², {volume}", extent(s.area))
}

/// Change of the volume.
fn volume(d: &RepairDocument) -> Option<String> {
    let e = &d.effect;
    let (change, error, limit) = (e.volume_change?, e.volume_error?, e.volume_limit?);
    let share = match d.before.volume {
        Some(before) if before > 0.0 => format!(" = {} %", signed(100.0 * change / before)),
        _ => String::new(),
    };
    let inverted = match e.volume_inverted {
        Some(inverted) if inverted > 0.0 => {
            format!("; {} mm³ of bodies that looked inwards come to the volume before", extent(inverted))
        }
        _ => String::new(),
    };
    Some(format!(
        "changed by {} mm³{share} (volume before: ± {} mm³; limit {} mm³{inverted})",
        signed(change),
        scientific(error, 1),
        fixed(limit, 6)
    ))
}

/// What was done, by step and kind.
fn changes(out: &mut String, d: &RepairDocument) {
    let mut sums: BTreeMap<(usize, &str), (u64, u64)> = BTreeMap::new();
    for change in &d.changes {
        let step = d.steps.iter().position(|s| *s == change.step).unwrap_or(usize::MAX);
        let sum = sums.entry((step, &change.what)).or_default();
        *sum = (sum.0 + 1, sum.1 + change.facets);
    }
    if sums.is_empty() {
        return;
    }
    let mut rows = vec![["done", "times", "facets"].map(String::from).to_vec()];
    rows.extend(sums.iter().map(|((_, what), (n, f))| vec![what.to_string(), grouped(*n), grouped(*f)]));
    if d.truncated {
        let rest = d.change_count - d.changes.len() as u64;
        rows.push(vec!["… more, not listed (--items)".into(), grouped(rest)]);
    }
    out.push('\n');
    out.push_str(&columns(&rows));
}

/// Defects before, after, and in the file.
fn defects(out: &mut String, d: &RepairDocument) {
    let (b, a, o) = (&d.before, &d.after, &d.output);
    let all = [(&b.defects, &b.at_least), (&a.defects, &a.at_least), (&o.defects, &o.at_least)];
    let mut names: Vec<&String> = all.iter().flat_map(|(m, _)| m.keys()).collect();
    names.sort_unstable();
    names.dedup();
    if names.is_empty() {
        return;
    }
    let mut rows = vec![["defect", "before", "after", "in the file"].map(String::from).to_vec()];
    for name in names {
        let mut row = vec![name.replace('_', " ")];
        row.extend(all.iter().map(|(counts, capped)| {
            let more = if capped.contains(name) { "at least " } else { "" };
            format!("{more}{}", grouped(counts.get(name).copied().unwrap_or(0)))
        }));
        if d.output.sound.is_none() {
            row[3] = "?".into();
        }
        rows.push(row);
    }
    out.push('\n');
    out.push_str(&columns(&rows));
}

fn verdict(d: &RepairDocument) -> String {
    let o = &d.output;
    let rounded = match o.rounded_vertices {
        0 => String::new(),
        n => format!(", {} rounded by up to {} mm", counted(n, VERTICES), scientific(o.rounding, 3)),
    };
    let written = format!("written to {}{rounded}", o.path);
    let again = match &d.taken_back[..] {
        [] => String::new(),
        steps => {
            format!(
                " Done without {}: with that, some defect would be there more often, or surface be removed in vain.",
                steps.iter().map(|step| step.name()).collect::<Vec<_>>().join(", ")
            )
        }
    };
    let again = match &d.not_united {
        Some(reason) => format!("{again} Shells that meet were not united: {reason}."),
        None => again,
    };
    match (d.after.sound, o.sound) {
        (true, Some(false)) => format!(
            "\nSOUND IN MEMORY ONLY: {written}; the format does not hold the repair. Write .ply, .obj or .off instead.\n"
        ),
        (true, _) if d.effect.changed => {
            let removed = d.changes.iter().any(|change| change.step.geometry().removes == Removes::Sheets);
            let sheets = match (removed, d.hole_limit) {
                (true, Some(_)) => {
                    " Loose sheets were removed: --all-holes closes them, --skip scraps keeps them."
                }
                (true, None) => " Loose sheets were removed that no patch closes: --skip scraps keeps them.",
                (false, _) => "",
            };
            let inwards = match d.effect.volume_inverted {
                Some(volume) if volume > 0.0 => {
                    " What looks inwards bounds no material; a whole body is kept if it is turned first: --only orient,outward, \
                     then repair the result."
                }
                _ => "",
            };
            format!(
                "\nCLOSED, BUT CHANGED: {written}. It is not the same part: volume or surface went beyond --max-change.{sheets}{inwards}{again}\n"
            )
        }
        (true, _) if d.inputs.iter().any(InputRecord::lacks_faces) => {
            format!(
                "\nOF AN INCOMPLETE MODEL: {written}. Faces that could not be read are missing in it.{again}\n"
            )
        }
        (true, None) => format!("\nsound; {written}, not read again\n"),
        (true, Some(true)) => format!("\nsound; {written}\n"),
        (false, _) => {
            let open = match (d.after.closed, d.hole_limit) {
                _ if d.after.facets == 0 => " No facet with an area is left: the mesh holds no surface.",
                (true, _) => "",
                (false, Some(_)) => {
                    " Holes larger than the limit stay open, and with them others of their shell, unless --all-holes is given."
                }
                (false, None) => " Holes that no patch fits stay open, and the border of a flat sheet.",
            };
            format!("\nNOT SOUND: {written}.{open}{again}\n")
        }
    }
}
