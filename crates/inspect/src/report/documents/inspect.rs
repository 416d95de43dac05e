//! The page of an inspection: the verdict, every characteristic with its value, the features.

use super::super::html::Html;
use super::super::page::blocks::{Headline, badge, fact, key_number, section};
use super::super::page::symbols::{datum_name, path, requirement, symbol};
use super::alignment::{Facts, alignment};
use super::{Frame, Head, Map, Pick, Subject, compare};
use crate::results::Verdict;
use crate::results::compare::Comparison;
use crate::results::inspect::{CharacteristicRecord, FeatureRecord, InspectDocument};
use crate::scale::Scale;
use serde_json::Value;

impl Subject for InspectDocument {
    fn head(&self) -> Head<'_> {
        Head { schema: &self.schema, version: &self.version, units: &self.units, inputs: &self.inputs }
    }

    fn headline(&self) -> Headline {
        self.verdict.into()
    }

    fn title(&self) -> Option<&str> {
        self.title.as_deref()
    }

    fn picture(&self) -> &'static str {
        "picture.inspect"
    }

    fn numbers(&self, h: &mut Html) {
        let n = &self.counts;
        h.raw("<dl class=\"key-numbers\">");
        let regions = self.deviation.as_ref().filter(|d| !d.regions.is_empty());
        let within =
            self.deviation.as_ref().filter(|d| d.regions.is_empty()).and_then(|d| d.tolerance.as_ref());
        let judged = within.is_some() || regions.is_some();
        let outside = judged && self.deviation.as_ref().and_then(|d| d.verdict) != Some(Verdict::Pass);
        let key = if regions.is_some() { "regions.pass" } else { "deviations.within" };
        let share = |h: &mut Html| {
            if let Some(c) = regions {
                compare::passing(h, c);
            }
            if let Some(t) = within {
                h.optional_percent(t.inside, t.inside_reason.as_deref(), 2);
                if t.required < 1.0 {
                    h.raw(" <small>(≥\u{a0}").percent(t.required, 2).raw(")</small>");
                }
            }
        };
        // The worst verdict leads, with how many of all have it; where the deviations alone fail, they do.
        let alone = outside && n.fail == 0;
        let mut lead = !alone;
        if alone {
            key_number(h, key, "lead", share);
        }
        for (word, count, class) in [
            ("verdict.fail", n.fail, "warn"),
            ("verdict.undecided", n.undecided, "warn"),
            ("verdict.not_measured", n.not_measured, "warn"),
            ("verdict.pass", n.pass, ""),
        ] {
            if count > 0 || word == "verdict.pass" {
                let leads = count > 0 && std::mem::take(&mut lead);
                key_number(h, word, if leads { "lead" } else { class }, |h| {
                    h.count(count);
                    if leads {
                        h.raw(" <small>/\u{a0}").count(self.characteristics.len() as u64).raw("</small>");
                    }
                });
            }
        }
        key_number(h, "characteristics", "", |h| {
            h.count(self.characteristics.len() as u64);
        });
        if judged && !alone {
            key_number(h, key, if outside { "warn" } else { "" }, share);
        }
        h.raw("</dl>");
    }

    fn list(&self, h: &mut Html) {
        section(h, "characteristics", |h| characteristics(h, self));
        if let (Some(c), Some(scale)) = (&self.deviation, &self.scale) {
            deviations(h, c, scale.decimals as usize, self.characteristics.len());
        }
        section(h, "features", |h| features(h, self));
        let (of, left_out) = (&self.alignment, None);
        alignment(
            h,
            &Facts {
                method: &of.method,
                rms: of.rms,
                greatest: of.greatest,
                left_out,
                warnings: &of.warnings,
            },
        );
    }

    fn method(&self, h: &mut Html) {
        h.raw("<p>").word("method.inspect.text").raw("</p><p>");
        h.word(&format!("decision.{}.text", self.decision_rule)).raw("</p><ul>");
        let mut standards: Vec<&str> = self.characteristics.iter().map(|c| c.standard.as_str()).collect();
        standards.sort_unstable();
        standards.dedup();
        for standard in standards {
            h.raw("<li>").text(standard).raw("</li>");
        }
        h.raw("</ul>");
    }

    fn how(&self, h: &mut Html) {
        h.word("decision").raw(": ").word(&format!("decision.{}", self.decision_rule));
    }

    fn picks(&self) -> Vec<Pick> {
        let of = |(n, c): (usize, &CharacteristicRecord)| Pick {
            position: c.anchor.unwrap_or([0.0; 3]),
            mark: Some(n),
            frame: c.anchor.map(|_| frame(c)),
            ..Pick::default()
        };
        let worst = self.deviation.iter().flat_map(|d| &d.worst).map(|w| compare::pick(w, 0));
        self.rows().into_iter().enumerate().map(of).chain(worst).collect()
    }

    fn important(&self, _: &[Pick]) -> Vec<usize> {
        (0..self.characteristics.len()).collect()
    }

    fn scale(&self) -> Option<&Scale> {
        self.scale.as_ref()
    }

    fn maps(&self) -> Vec<Map<'_>> {
        self.deviation.iter().map(compare::map).collect()
    }

    fn json(&self) -> serde_json::Result<Value> {
        serde_json::to_value(self)
    }
}

/// What stands at the end of its leader.
fn frame(c: &CharacteristicRecord) -> Frame {
    Frame {
        id: c.id.clone(),
        sign: path(&c.kind),
        diametral: c.zone == "diameter",
        lower: c.lower,
        upper: c.requirement().map_or(c.upper, |(tolerance, _)| tolerance),
        material: c.requirement().map(|(_, material)| material.word()),
        datums: c.datums.clone(),
        value: c.value,
        decimals: digits(c),
        verdict: Headline::from(c.verdict).key,
    }
}

/// Three columns, so that the verdict stands in view beside the part: what and of which feature, value over what is allowed,
/// verdict.
fn characteristics(h: &mut Html, d: &InspectDocument) {
    h.raw("<table class=\"pick\"><thead><tr><th>").word("feature").raw("</th><th class=\"r\">");
    h.word("value").raw("<br><small>").word("allowed").raw("</small></th><th>").word("verdict");
    h.raw("</th></tr></thead><tbody>");
    for (n, c) in d.rows().into_iter().enumerate() {
        h.raw(&format!("<tr data-pick=\"{n}\"><td>")).name(&c.id).raw(" ");
        symbol(h, &c.kind);
        h.word(&format!("kind.{}", c.kind));
        for letters in c.letters() {
            h.raw(" ").text(letters);
        }
        h.raw("<br><small>").name(&c.feature);
        for datum in &c.datums {
            h.raw(" | ");
            datum_name(h, datum);
        }
        h.raw("</small></td><td class=\"r\">");
        h.optional(c.value, c.reason.as_deref(), digits(c), false);
        if let Some(u) = c.uncertainty {
            h.raw(" ±\u{a0}").number(u, digits(c), false);
        }
        h.raw("<br><small>");
        allowed(h, c);
        h.raw("</small></td><td>");
        badge(h, c.verdict.into());
        h.raw("</td></tr>");
        for note in c.reason.iter().chain(&c.notes) {
            h.raw("<tr><td colspan=\"3\" class=\"note\">").text(note).raw("</td></tr>");
        }
    }
    h.raw("</tbody></table>");
}

/// The deviations from the reference: the verdict, the worst places, the statistics.
fn deviations(h: &mut Html, c: &Comparison, decimals: usize, first_pick: usize) {
    section(h, "deviations", |h| {
        h.raw("<dl class=\"facts pairs\">");
        if let Some(verdict) = c.verdict {
            fact(h, "verdict", |h| badge(h, verdict.into()));
        }
        if let Some(t) = c.tolerance.as_ref().filter(|_| c.regions.is_empty()) {
            fact(h, "tolerance", |h| {
                h.number(t.lower, decimals, true).raw("\u{2009}…\u{2009}").number(t.upper, decimals, true);
            });
            fact(h, "within", |h| {
                h.optional_percent(t.inside, t.inside_reason.as_deref(), 2);
                if t.required < 1.0 {
                    h.raw(" (≥\u{a0}").percent(t.required, 2).raw(")");
                }
            });
        }
        let all = c.deviation.all.count + c.excluded.values().sum::<u64>();
        fact(h, "excluded", |h| compare::excluded(h, c, all));
        compare::rules(h, c, decimals);
        h.raw("</dl>");
        for warning in &c.warnings {
            h.raw("<p class=\"note\">⚠ ").text(&warning.text).raw("</p>");
        }
    });
    compare::regions(h, c, decimals);
    compare::worst(h, c, decimals, first_pick);
    compare::statistics(h, c, decimals);
}

fn digits(c: &CharacteristicRecord) -> usize {
    if c.unit == "mm" { 4 } else { 3 }
}

fn allowed(h: &mut Html, c: &CharacteristicRecord) {
    match (c.nominal, c.lower) {
        (Some(_), Some(lower)) => {
            h.number(lower, digits(c), false).raw(" … ").number(c.upper, digits(c), false);
        }
        _ => {
            h.raw(if c.zone == "diameter" { "≤\u{a0}⌀" } else { "≤\u{a0}" }).number(
                c.upper,
                digits(c),
                false,
            );
            if let Some((t, material)) = c.requirement() {
                h.raw(" (").number(t, digits(c), false).raw("\u{a0}");
                requirement(h, material.word());
                h.raw(")");
            }
        }
    }
}

fn features(h: &mut Html, d: &InspectDocument) {
    h.raw("<table><thead><tr><th></th><th class=\"r\">").word("points").raw("</th><th class=\"r\">");
    h.word("form_error").raw("</th><th class=\"r\">").word("coverage").raw("</th></tr></thead><tbody>");
    for f in &d.features {
        h.raw("<tr><td>").name(&f.id).raw(" ");
        h.word(&format!("shape.{}", f.shape)).raw("</td><td class=\"r\">").count(f.points);
        h.raw("</td><td class=\"r\">").optional(f.form_error, reason(f), 4, false);
        h.raw("</td><td class=\"r\">").optional_percent(f.coverage, f.coverage_reason.as_deref(), 1);
        h.raw("</td></tr>");
    }
    h.raw("</tbody></table>");
}

fn reason(f: &FeatureRecord) -> Option<&str> {
    f.reason.as_deref().or(f.uncertainty_reason.as_deref())
}
