//! The page of a check: sound or not, what the mesh is, and every kind of defect with its places.

use super::super::html::Html;
use super::super::page::blocks::{
    Headline, Tone, fact, key_number, not_printed, pick_row, place_cells, section, swatch,
};
use super::{Head, Pick, Subject};
use crate::results::check::{CheckDocument, Defects, Item};
use crate::scale::palette::category;
use serde_json::Value;

/// Rows of a kind at most, the worst first.
const LISTED: usize = 100;

impl Subject for CheckDocument {
    fn head(&self) -> Head<'_> {
        Head { schema: &self.schema, version: &self.version, units: &self.units, inputs: &self.inputs }
    }

    fn headline(&self) -> Headline {
        let warned = self.found().iter().any(|(_, d)| d.severity == "warning");
        match (self.sound, warned) {
            (true, false) => Headline { key: "sound", tone: Tone::Pass },
            (true, true) => Headline { key: "sound_warned", tone: Tone::Pass },
            (false, _) => Headline { key: "not_sound", tone: Tone::Fail },
        }
    }

    fn picture(&self) -> &'static str {
        "picture.check"
    }

    fn numbers(&self, h: &mut Html) {
        let total = |severity: &str| -> u64 {
            self.defects.values().filter(|d| d.severity == severity).filter_map(|d| d.count).sum()
        };
        let kinds =
            |severity: &str| self.found().iter().filter(|(_, d)| d.severity == severity).count() as u64;
        h.raw("<dl class=\"key-numbers\">");
        for (key, severity, class) in [("errors", "error", "lead"), ("warnings", "warning", "warn")] {
            let (kinds, total) = (kinds(severity), total(severity));
            key_number(h, key, if total > 0 || class == "lead" { class } else { "" }, |h| {
                h.count(kinds);
                if total > 0 {
                    h.raw(" <small>")
                        .word(if kinds == 1 { "kinds.one" } else { "kinds" })
                        .raw(" · ")
                        .count(total)
                        .raw(" ")
                        .word(if total == 1 { "places.one" } else { "places" })
                        .raw("</small>");
                }
            });
        }
        let mut count = |key, class, n| {
            key_number(h, key, class, |h| {
                h.count(n);
            });
        };
        count("facets.title", "", self.facets);
        count("shells", "", self.shells);
        if let Some(size) = self.dimensions {
            key_number(h, "size", "", |h| dimensions(h, size));
        }
        let warned = if self.volume_note.is_some() { "warn" } else { "" };
        key_number(h, "volume", warned, |h| volume(h, self));
        let (class, sign, key) =
            if self.precondition { ("", "✓\u{a0}", "holds") } else { ("warn", "⚠\u{a0}", "fails") };
        key_number(h, "precondition", class, |h| {
            h.raw(sign).word(key);
        });
        h.raw("</dl>");
    }

    fn list(&self, h: &mut Html) {
        section(h, "defects", |h| defects(h, self));
        section(h, "model", |h| model(h, self));
    }

    fn method(&self, h: &mut Html) {
        h.raw("<p>").word("method.check.text").raw("</p><p>").word("method.check.precondition").raw("</p>");
    }

    fn how(&self, h: &mut Html) {
        h.word("method.check");
    }

    fn picks(&self) -> Vec<Pick> {
        picks(&self.found(), 0)
    }

    /// Errors before warnings, the largest first.
    fn important(&self, picks: &[Pick]) -> Vec<usize> {
        let kinds = self.found();
        let errors = |(kind, d): &(&str, &Defects)| {
            std::iter::repeat_n(d.severity == "error", listed(kind, d).len()).collect::<Vec<_>>()
        };
        let errors: Vec<bool> = kinds.iter().flat_map(errors).collect();
        let size = |n: usize| picks[n].reach.unwrap_or(0.0);
        let mut order: Vec<usize> = (0..picks.len().min(errors.len())).collect();
        order.sort_by(|a, b| errors[*b].cmp(&errors[*a]).then(size(*b).total_cmp(&size(*a))));
        order
    }

    fn json(&self) -> serde_json::Result<Value> {
        serde_json::to_value(self)
    }
}

/// The places of all rows of [`kinds`]; their marks are numbered from `first_mark`.
pub fn picks(found: &[(&str, &Defects)], first_mark: usize) -> Vec<Pick> {
    let mut first = first_mark;
    let mut picks = vec![];
    for (kind, defects) in found {
        picks.extend(listed(kind, defects).into_iter().map(|(n, item)| pick(item, first + n)));
        first += defects.items.len();
    }
    picks
}

/// The items with a row, worst first, and their numbers in the document.
fn listed<'a>(kind: &str, defects: &'a Defects) -> Vec<(usize, &'a Item)> {
    let mut items: Vec<(usize, &Item)> = defects.items.iter().enumerate().collect();
    match kind {
        // The thinner, the worse.
        "sliver_facets" => items.sort_by(|a, b| a.1.size.total_cmp(&b.1.size)),
        _ => items.sort_by(|a, b| b.1.size.total_cmp(&a.1.size)),
    }
    items.truncate(LISTED);
    items
}

fn pick(item: &Item, mark: usize) -> Pick {
    let half = |b: &crate::results::compare::Bounds| {
        0.5 * (0..3).map(|k| (b.max[k] - b.min[k]).powi(2)).sum::<f64>().sqrt()
    };
    Pick {
        position: item.position,
        reach: Some(item.bounds.as_ref().map_or(0.0, half)),
        mark: Some(mark),
        ..Pick::default()
    }
}

/// What the size of an item is: key of its word, and unit.
fn measure(kind: &str) -> (&'static str, &'static str) {
    match kind {
        "holes" => ("perimeter", "mm"),
        "dangling_facets" => ("missing", ""),
        "non_manifold_vertices" => ("facets", ""),
        "duplicate_facets" | "reversed_normals" => ("area", "mm²"),
        "sliver_facets" => ("height", "mm"),
        "inside_out_shells" => ("volume", "mm³"),
        "t_junctions" => ("distance", "mm"),
        "self_intersections" | "unshared_vertices" | "islands" => ("diagonal", "mm"),
        _ => ("length", "mm"),
    }
}

fn defects(h: &mut Html, d: &CheckDocument) {
    kinds(h, &d.found(), 0);
    absent(h, d);
}

/// The kinds found, each with its places; the rows' numbers begin at `first_pick`.
pub fn kinds(h: &mut Html, found: &[(&str, &Defects)], first_pick: usize) {
    let mut first = first_pick;
    // All kinds are seen at once; a single one needs no click.
    let open = if found.len() == 1 { " open" } else { "" };
    for (n, (kind, defects)) in found.iter().enumerate() {
        h.raw(&format!("<details class=\"kind k-{}\"{open}><summary>", defects.severity));
        swatch(h, category(n));
        h.raw("<span class=\"kind-name\">").word(&format!("defect.{kind}")).raw("</span>");
        let severity = if defects.severity == "error" { "severity.error" } else { "severity.warning" };
        h.raw("<span class=\"severity\">").word(severity).raw("</span><strong>");
        h.raw(if defects.at_least { "≥ " } else { "" });
        h.count(defects.count.unwrap_or(0)).raw("</strong></summary>\n");
        h.raw("<p class=\"note\">").word(&format!("about.{kind}")).raw("</p>");
        let rows = listed(kind, defects);
        table(h, kind, &rows, first);
        first += rows.len();
        let (shown, total) = (rows.len() as u64, defects.count.unwrap_or(0));
        if shown < total {
            h.raw("<p class=\"note\">")
                .word("listed")
                .raw(" ")
                .count(shown)
                .raw(" / ")
                .count(total)
                .raw("</p>");
        }
        h.raw("</details>\n");
    }
}

fn table(h: &mut Html, kind: &str, rows: &[(usize, &Item)], first: usize) {
    if rows.is_empty() {
        return;
    }
    let (word, unit) = measure(kind);
    h.raw("<table class=\"pick\"><thead><tr><th></th><th class=\"r\">").word(word);
    h.raw("</th><th class=\"r\">x</th><th class=\"r\">y</th><th class=\"r\">z</th></tr></thead><tbody>");
    for (n, (_, item)) in rows.iter().enumerate() {
        pick_row(h, n, first + n);
        h.raw(&format!("<td>{}</td><td class=\"r\">", n + 1));
        let decimals = match unit {
            "" => 0,
            _ if item.size > 0.0 && item.size < 0.1 => 6,
            _ => 3,
        };
        h.number(item.size, decimals, false);
        if !unit.is_empty() {
            h.raw("\u{a0}").raw(unit);
        }
        h.raw("</td>");
        place_cells(h, item.position);
        h.raw("</tr>");
    }
    h.raw("</tbody></table>");
    not_printed(h, rows.len());
}

/// What was looked for and not found, and what was not looked for.
fn absent(h: &mut Html, d: &CheckDocument) {
    let with = |count: Option<u64>| d.defects.iter().filter(move |(_, x)| x.count == count).peekable();
    let mut none = with(Some(0));
    if none.peek().is_some() {
        h.raw("<p class=\"absent\"><span class=\"v-pass\">✓\u{a0}</span>").word("none_of").raw(" ");
        for (n, (kind, _)) in none.enumerate() {
            h.raw(if n > 0 { ", " } else { "" }).word(&format!("defect.{kind}"));
        }
        h.raw("</p>");
    }
    for (kind, defects) in with(None) {
        h.raw("<p class=\"absent\">–\u{a0}").word(&format!("defect.{kind}")).raw(": ");
        h.text(defects.count_reason.as_deref().unwrap_or("")).raw("</p>");
    }
}

fn model(h: &mut Html, d: &CheckDocument) {
    h.raw("<dl class=\"facts pairs\">");
    for (key, count) in
        [("facets.title", d.facets), ("vertices.title", d.vertices), ("edges", d.edges), ("shells", d.shells)]
    {
        fact(h, key, |h| {
            h.count(count);
        });
    }
    if let Some(size) = d.dimensions {
        fact(h, "size", |h| dimensions(h, size));
    }
    fact(h, "area.title", |h| {
        h.number(d.area, 3, false).raw("\u{a0}mm²");
    });
    fact(h, "volume", |h| {
        volume(h, d);
        if d.volume_note.is_some() {
            h.raw(" (").word("volume.overlaps").raw(")");
        }
    });
    fact(h, "centre_of_mass", |h| match d.centre_of_mass {
        Some(place) => triple(h, place, ", ", 3),
        None => {
            h.text(d.centre_of_mass_reason.as_deref().unwrap_or("–"));
        }
    });
    fact(h, "euler", |h| {
        h.number(d.euler_characteristic as f64, 0, false);
    });
    fact(h, "genus", |h| {
        match d.genus {
            Some(genus) => h.number(genus as f64, 0, false),
            None => h.text(d.genus_reason.as_deref().unwrap_or("–")),
        };
    });
    fact(h, "gap", |h| {
        h.scientific(d.tolerances.gap, 2).raw("\u{a0}mm");
    });
    h.raw("</dl>");
}

fn dimensions(h: &mut Html, size: [f64; 3]) {
    triple(h, size, "\u{2009}×\u{2009}", 2);
    h.raw("\u{a0}mm");
}

fn triple(h: &mut Html, numbers: [f64; 3], between: &str, decimals: usize) {
    for (k, x) in numbers.into_iter().enumerate() {
        h.raw(if k > 0 { between } else { "" }).number(x, decimals, false);
    }
}

fn volume(h: &mut Html, d: &CheckDocument) {
    h.optional(d.volume, d.volume_reason.as_deref(), 2, false);
    h.raw(if d.volume.is_some() { "\u{a0}mm³" } else { "" });
}
