//! The page of a repair: what was changed and where, the mesh before and after, and what it cost.

use super::super::html::Html;
use super::super::page::blocks::{
    Headline, Tone, fact, key_number, not_printed, pick_row, place_cells, section, swatch,
};
use super::super::text::word;
use super::{Head, Pick, Subject};
use crate::repair::{GONE, NEW, by_step};
use crate::results::repair::{Change, Distances, RepairDocument, State};
use crate::scale::palette::category;
use serde_json::Value;
use std::collections::BTreeSet;

/// Rows of a step, at most.
const LISTED: usize = 100;
/// Half of what is brought into view around a change, as a share of the model's diagonal.
const AROUND: f64 = 0.02;

impl Subject for RepairDocument {
    fn head(&self) -> Head<'_> {
        Head { schema: &self.schema, version: &self.version, units: &self.units, inputs: &self.inputs }
    }

    fn headline(&self) -> Headline {
        match (self.sound, self.change_count) {
            (true, 0) => Headline { key: "nothing_to_repair", tone: Tone::Pass },
            (true, _) => Headline { key: "repaired", tone: Tone::Pass },
            (false, _) if self.after.sound && self.effect.changed => {
                Headline { key: "closed_but_changed", tone: Tone::Fail }
            }
            (false, _) => Headline { key: "not_repaired", tone: Tone::Fail },
        }
    }

    fn picture(&self) -> &'static str {
        "picture.repair"
    }

    fn numbers(&self, h: &mut Html) {
        h.raw("<dl class=\"key-numbers\">");
        let counts = [
            ("changes", self.change_count),
            ("facets.added", self.facets.added),
            ("facets.removed", self.facets.removed),
            ("vertices.moved", self.vertices.moved),
        ];
        for (key, count) in counts {
            key_number(h, key, if key == "changes" { "lead" } else { "" }, |h| {
                h.count(count);
            });
        }
        // Of the surface that bounds: what goes inside of a body changes no part. The list has both.
        let introduced = self.deviation.as_ref().map(|d| d.added.max.max(d.removed.max));
        if let Some(d) = self.effect.surface.or(introduced) {
            key_number(h, "deviation.introduced", "", |h| {
                length(h, d);
            });
        }
        if let Some(change) = self.effect.volume_change {
            let class = if self.effect.changed { "warn" } else { "" };
            key_number(h, "volume.change", class, |h| {
                h.number(change, 3, true).raw("\u{a0}mm³");
            });
        }
        let class = if self.output.sound == Some(false) { "warn" } else { "" };
        key_number(h, "file.written", class, |h| {
            match self.output.sound {
                Some(true) => h.raw("✓\u{a0}").word("sound.short"),
                Some(false) => h.raw("⚠\u{a0}").word("not_sound"),
                None => h.raw("–"),
            };
        });
        h.raw("</dl>");
    }

    fn list(&self, h: &mut Html) {
        section(h, "changes", |h| changes(h, self));
        section(h, "before_after", |h| states(h, self));
        section(h, "deviation.introduced", |h| deviation(h, self));
    }

    fn method(&self, h: &mut Html) {
        h.raw("<p>").word("method.repair.text").raw("</p><p>").word("method.repair.file").raw(" ");
        h.name(&self.output.path).raw("</p>");
    }

    fn how(&self, h: &mut Html) {
        h.word("method.repair");
    }

    fn picks(&self) -> Vec<Pick> {
        let mut first = 0;
        let mut picks = vec![];
        for (_, changes) in by_step(self) {
            let rows = changes.iter().take(LISTED).enumerate();
            // Sizes are lengths, areas or volumes: none says how much to show.
            picks.extend(rows.map(|(n, c)| Pick {
                position: c.position,
                reach: Some(AROUND * self.before.area.max(0.0).sqrt()),
                mark: Some(first + n),
                ..Pick::default()
            }));
            first += changes.len();
        }
        picks
    }

    /// Those of the most facets.
    fn important(&self, picks: &[Pick]) -> Vec<usize> {
        let listed = |(_, changes): (_, Vec<&Change>)| {
            changes.into_iter().take(LISTED).map(|c| c.facets).collect::<Vec<_>>()
        };
        let facets: Vec<u64> = by_step(self).into_iter().flat_map(listed).collect();
        let mut order: Vec<usize> = (0..picks.len().min(facets.len())).collect();
        order.sort_by_key(|n| std::cmp::Reverse(facets[*n]));
        order
    }

    fn json(&self) -> serde_json::Result<Value> {
        serde_json::to_value(self)
    }
}

fn length(h: &mut Html, x: f64) {
    h.number(x, if x > 0.0 && x < 0.1 { 6 } else { 3 }, false).raw("\u{a0}mm");
}

fn changes(h: &mut Html, d: &RepairDocument) {
    let steps = by_step(d);
    if steps.is_empty() {
        h.raw("<p>").word("changes.none").raw("</p>");
    }
    // The places of a step have its colour, the facets that came and went have their own.
    let (came, went) = (d.facets.added > 0, d.facets.removed > 0);
    if came || went {
        h.raw("<p class=\"note\">");
        for (_, color, key) in
            [(came, NEW, "facets.new"), (went, GONE, "facets.gone")].iter().filter(|(any, ..)| *any)
        {
            swatch(h, *color);
            h.raw(" ").word(key).raw(" ");
        }
        h.raw("</p>\n");
    }
    let open = if steps.len() == 1 { " open" } else { "" };
    let mut first = 0;
    for (n, (step, changes)) in steps.into_iter().enumerate() {
        h.raw(&format!("<details class=\"kind\"{open}><summary>"));
        swatch(h, category(n));
        h.raw("<span class=\"kind-name\">").word(&format!("step.{step}")).raw("</span><strong>");
        h.count(changes.len() as u64).raw("</strong></summary>\n");
        // What is the same in every row is said once.
        let what = changes.first().map_or("", |c| &c.what);
        let same = changes.iter().all(|c| c.what == what);
        if same {
            h.raw("<p class=\"note\">");
            done(h, what);
            h.raw("</p>");
        }
        h.raw("<table class=\"pick\"><thead><tr><th></th><th class=\"r\">");
        h.word("facets.title").raw(
            "</th><th class=\"r\">x</th><th class=\"r\">y</th><th class=\"r\">z</th></tr></thead><tbody>",
        );
        let rows = changes.len().min(LISTED);
        for (k, change) in changes.iter().take(rows).enumerate() {
            pick_row(h, k, first + k);
            h.raw("<td>");
            if same {
                h.text(&(k + 1).to_string());
            } else {
                done(h, &change.what);
            }
            h.raw("</td><td class=\"r\">");
            h.count(change.facets).raw("</td>");
            place_cells(h, change.position);
            h.raw("</tr>");
        }
        h.raw("</tbody></table>");
        not_printed(h, rows);
        if rows < changes.len() {
            h.raw("<p class=\"note\">").word("listed.first").raw(" ").count(rows as u64).raw(" / ");
            h.count(changes.len() as u64).raw("</p>");
        }
        h.raw("</details>\n");
        first += rows;
    }
    if d.truncated {
        h.raw("<p class=\"note\">").word("listed.first").raw(" ").count(d.changes.len() as u64).raw(" / ");
        h.count(d.change_count).raw("</p>");
    }
}

/// What was done, in the reader's language; as the document says it where the table has no words for it.
fn done(h: &mut Html, what: &str) {
    let key = key(what);
    if word(&key, h.language()) == key {
        h.text(what);
    } else {
        h.word(&key);
    }
}

/// Key of what was done in the table of words.
fn key(what: &str) -> String {
    format!("done.{}", what.replace(',', "").replace(' ', "_"))
}

/// Size and defects in two columns.
fn states(h: &mut Html, d: &RepairDocument) {
    h.raw("<table class=\"states\"><thead><tr><th></th><th class=\"r\">").word("before");
    h.raw("</th><th class=\"r\">").word("after").raw("</th></tr></thead><tbody>");
    let mut row = |key: &str, cell: &dyn Fn(&mut Html, &State)| {
        h.raw("<tr><th scope=\"row\">").word(key).raw("</th>");
        for state in [&d.before, &d.after] {
            h.raw("<td class=\"r\">");
            cell(h, state);
            h.raw("</td>");
        }
        h.raw("</tr>");
    };
    let yes = |h: &mut Html, yes: bool| {
        h.raw(if yes { "✓\u{a0}" } else { "✕\u{a0}" }).word(if yes { "yes" } else { "no" });
    };
    row("sound.title", &|h, s| yes(h, s.sound));
    row("closed", &|h, s| yes(h, s.closed));
    row("facets.title", &|h, s| {
        h.count(s.facets);
    });
    row("vertices.title", &|h, s| {
        h.count(s.vertices);
    });
    row("shells", &|h, s| {
        h.count(s.shells);
    });
    row("bodies", &|h, s| {
        h.count(if std::ptr::eq(s, &d.before) { d.effect.bodies_before } else { d.effect.bodies_after });
    });
    row("area.mm2", &|h, s| {
        h.number(s.area, 2, false);
    });
    row("volume.mm3", &|h, s| {
        h.optional(s.volume, s.volume_reason.as_deref(), 2, false);
    });
    let kinds: BTreeSet<&String> = d.before.defects.keys().chain(d.after.defects.keys()).collect();
    for kind in kinds {
        row(&format!("defect.{kind}"), &|h, s| {
            h.raw(if s.at_least.contains(kind) { "≥ " } else { "" });
            h.count(s.defects.get(kind).copied().unwrap_or(0));
        });
    }
    h.raw("</tbody></table>");
}

/// How far the surface went: what is missing, what was added.
fn deviation(h: &mut Html, d: &RepairDocument) {
    let Some(found) = &d.deviation else {
        h.raw("<p>–\u{a0}").text(d.deviation_reason.as_deref().unwrap_or("")).raw("</p>");
        return;
    };
    h.raw("<dl class=\"facts pairs\">");
    for (key, Distances { max, mean }) in [("surface.added", found.added), ("surface.removed", found.removed)]
    {
        fact(h, key, |h| {
            h.raw("≤\u{a0}");
            length(h, max);
            h.raw("<br><small>").word("mean").raw(" ");
            length(h, mean);
            h.raw("</small>");
        });
    }
    if let Some(surface) = d.effect.surface {
        fact(h, "surface.bounding", |h| {
            h.raw("≤\u{a0}");
            length(h, surface);
        });
    }
    fact(h, "change.limit", |h| {
        length(h, d.effect.surface_limit);
        if let Some(limit) = d.effect.volume_limit {
            h.raw(", ").number(limit, 3, false).raw("\u{a0}mm³");
        }
    });
    if d.output.rounded_vertices > 0 {
        fact(h, "file.rounding", |h| {
            h.raw("≤\u{a0}").scientific(d.output.rounding, 1).raw("\u{a0}mm");
        });
    }
    h.raw("</dl>");
}

#[cfg(test)]
mod tests {
    use super::super::super::text::Language;
    use super::*;
    use std::path::{Path, PathBuf};
    use trueness_geom::repair::STEPS;

    fn sources(folder: &Path) -> Vec<PathBuf> {
        let all = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path());
        all.flat_map(|p| if p.is_dir() { sources(&p) } else { vec![p] }).collect()
    }

    /// What the steps log: the text in each call of `log`, and in the branches that such a text is chosen from.
    fn logged() -> Vec<String> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../geom/src/repair");
        let mut all = vec![];
        for file in sources(&folder).iter().filter(|p| !p.ends_with("tests.rs")) {
            let text = std::fs::read_to_string(file).unwrap();
            for call in text.split(".log(").skip(1).chain(text.split("let what = match").skip(1)) {
                let statement = &call[..call.find(';').unwrap_or(call.len())];
                all.extend(statement.split('"').skip(1).step_by(2).map(str::to_string));
            }
        }
        all
    }

    #[test]
    fn every_step_and_what_it_does_has_words_in_every_language() {
        let phrases = logged();
        assert!(phrases.len() >= 20 && phrases.iter().any(|p| p == "facets inside the material removed"));
        let steps = STEPS.iter().map(|s| format!("step.{}", s.name));
        for key in steps.chain(phrases.iter().map(|p| key(p))) {
            for language in Language::ALL {
                assert_ne!(word(&key, language), key, "{language:?}");
            }
        }
    }
}
