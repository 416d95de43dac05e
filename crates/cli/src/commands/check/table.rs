//! The check as a table for people.

use crate::console::columns;
use crate::number::{EDGES, FACETS, SHELLS, VERTICES, counted, extent, fixed, grouped};
use trueness_document::check::{CheckDocument, Defects};
use trueness_geom::check::DefectKind;

/// The whole text; kinds in the order given.
pub fn text(d: &CheckDocument, kinds: &[&DefectKind]) -> String {
    let mut out = head(d);
    let mut rows = vec![];
    for kind in kinds {
        let Some(defects) = d.defects.get(kind.name) else { continue };
        if let Some(row) = row(kind.name, defects) {
            rows.push(row);
        }
    }
    if !rows.is_empty() {
        rows.insert(0, ["defect", "", "count", "largest", "at x", "y", "z"].map(String::from).to_vec());
        out.push('\n');
        out.push_str(&columns(&rows));
    }
    let warned = rows.iter().any(|r| r[1] == "warning");
    out.push_str(match (d.sound, warned) {
        (true, false) => "\nsound\n",
        (true, true) => "\nsound, with warnings\n",
        (false, _) => "\nNOT SOUND\n",
    });
    out
}

fn head(d: &CheckDocument) -> String {
    let mut rows: Vec<(&str, String)> = vec![];
    for input in &d.inputs {
        let what = if d.of_drawing.is_empty() { "mesh" } else { "model" };
        rows.push((what, format!("{}  ({}, {})", input.path, input.format, input.unit_assumed)));
        rows.extend(input.warnings.iter().map(|w| ("!", w.clone())));
    }
    let counts = [(d.facets, FACETS), (d.vertices, VERTICES), (d.edges, EDGES), (d.shells, SHELLS)];
    let drawing = if d.of_drawing.is_empty() { "" } else { "  (of the mesh that draws it)" };
    rows.push(("", format!("{}{drawing}", counts.map(|(n, what)| counted(n, what)).join(", "))));
    if let Some([l, b, h]) = d.dimensions {
        rows.push(("size", format!("{} mm", [l, b, h].map(extent).join(" × "))));
    }
    rows.push(("area", format!("{} mm²", extent(d.area))));
    rows.push((
        "volume",
        match (d.volume, &d.volume_reason) {
            (Some(v), _) => {
                let note = d.volume_note.as_ref().map(|note| format!("  ({note})"));
                format!("{} mm³{}", extent(v), note.unwrap_or_default())
            }
            (None, reason) => format!("none: {}", reason.as_deref().unwrap_or_default()),
        },
    ));
    if let Some(place) = d.center_of_mass {
        rows.push(("center", format!("{} (of mass)", place.map(|x| fixed(x, 6)).join(", "))));
    }
    let genus = d.genus.map(|g| format!(", genus {g}")).unwrap_or_default();
    rows.push(("Euler", format!("{}{genus}{drawing}", fixed(d.euler_characteristic as f64, 0))));
    rows.into_iter().map(|(name, text)| format!("{name:<8} {text}\n")).collect()
}

/// A row for a kind that was found, or could not be looked for although it belongs to every check.
fn row(name: &str, defects: &Defects) -> Option<Vec<String>> {
    let name = name.replace('_', " ");
    match defects.count {
        Some(0) => None,
        None if name == "reversed normals" => None,
        None => Some(vec![name, "not asked for".into()]),
        Some(count) => {
            let at_least = if defects.at_least { "at least " } else { "" };
            let mut row = vec![name, defects.severity.to_string(), format!("{at_least}{}", grouped(count))];
            if let Some(largest) = defects.items.iter().max_by(|a, b| a.size.total_cmp(&b.size)) {
                row.push(fixed(largest.size, 4));
                row.extend(largest.position.map(|x| fixed(x, 4)));
            }
            Some(row)
        }
    }
}
