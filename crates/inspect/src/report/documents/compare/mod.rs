//! The page of a comparison: deviations, worst places, statistics.

mod list;
mod words;

pub use list::{by_side, excluded, passing, regions, rules, statistics, worst};

use super::super::html::Html;
use super::super::page::blocks::{Headline, key_number};
use super::{Head, Map, Pick, Subject, check};
use crate::results::align::AlignedTo;
use crate::results::check::found;
use crate::results::compare::{CompareDocument, Comparison, Worst};
use crate::scale::Scale;
use serde_json::Value;
use words::{headline, sign_key, warning_key};

impl Subject for CompareDocument {
    fn head(&self) -> Head<'_> {
        Head { schema: &self.schema, version: &self.version, units: &self.units, inputs: &self.inputs }
    }

    fn headline(&self) -> Headline {
        headline(self.verdict)
    }

    fn convention(&self) -> Option<&'static str> {
        Some("sign.short")
    }

    fn picture(&self) -> &'static str {
        "picture.alt"
    }

    fn numbers(&self, h: &mut Html) {
        for (n, comparison) in self.comparisons.iter().enumerate() {
            numbers(h, (comparison, n), self.scale.decimals as usize, self.alignment.as_ref());
        }
    }

    fn list(&self, h: &mut Html) {
        list::list(h, self);
    }

    fn method(&self, h: &mut Html) {
        let text = if self.method == "paper" { "method.paper.text" } else { "method.exact.text" };
        // The map is one of points, if they were not a mesh's own vertices.
        let points = (self.measured.kind != "vertices").then_some("method.points.text");
        for key in [text, "method.sign.text", "method.map.text"].into_iter().chain(points) {
            h.raw("<p>").word(key).raw("</p>");
        }
    }

    fn how(&self, h: &mut Html) {
        let method = if self.method == "paper" { "method.paper" } else { "method.exact" };
        h.word(method).raw(" · ").word("sign.method").raw(": ").word(&sign_key(&self.sign));
    }

    fn points(&self) -> Option<u64> {
        Some(self.measured.count)
    }

    fn seed(&self) -> Option<u64> {
        Some(self.seed)
    }

    fn scale(&self) -> Option<&Scale> {
        Some(&self.scale)
    }

    fn maps(&self) -> Vec<Map<'_>> {
        self.comparisons.iter().map(map).collect()
    }

    fn picks(&self) -> Vec<Pick> {
        let mut first_mark = 0;
        let mut picks = vec![];
        for (n, c) in self.comparisons.iter().enumerate() {
            let map = Some(n);
            picks.extend(c.worst.iter().map(|w| pick(w, n)));
            let found = found(&c.soundness.findings);
            picks.extend(check::picks(&found, first_mark).into_iter().map(|p| Pick { map, ..p }));
            first_mark += found.iter().map(|(_, d)| d.items.len()).sum::<usize>();
        }
        picks
    }

    fn json(&self) -> serde_json::Result<Value> {
        serde_json::to_value(self)
    }
}

/// The map of a comparison.
pub fn map(c: &Comparison) -> Map<'_> {
    let all = &c.deviation.all;
    // Where several tolerances hold, no band of the map shows what is within them.
    let tolerance = c.tolerance.clone().filter(|_| c.regions.is_empty());
    let histogram = c.histogram.as_ref();
    Map { name: &c.reference, count: all.count, mean: all.mean, tolerance, histogram, ..Map::default() }
}

/// One of the worst places of comparison `n`.
pub fn pick(w: &Worst, n: usize) -> Pick {
    let (value, surface) = (Some(w.deviation), Some(w.nearest));
    Pick { position: w.point, surface, normal: w.normal, map: Some(n), value, ..Pick::default() }
}

/// The line of key numbers for one comparison; the script shows the one chosen.
fn numbers(h: &mut Html, (c, n): (&Comparison, usize), decimals: usize, aligned: Option<&AlignedTo>) {
    let all = &c.deviation.all;
    let shown = if n == 0 { "" } else { " hidden" };
    h.raw(&format!("<dl class=\"key-numbers\" data-comparison=\"{n}\"{shown}>"));
    match &c.tolerance {
        _ if !c.regions.is_empty() => key_number(h, "regions.pass", "lead", |h| list::passing(h, c)),
        Some(t) => {
            key_number(h, "within", "lead", |h| {
                h.optional_percent(t.inside, t.inside_reason.as_deref(), 2);
            });
            key_number(h, "tolerance", "", |h| {
                h.number(t.lower, decimals, true).raw("\u{2009}…\u{2009}").number(t.upper, decimals, true);
            });
            if t.required < 1.0 {
                key_number(h, "required", "", |h| {
                    h.raw("≥\u{a0}").percent(t.required, 2);
                });
            }
        }
        None => key_number(h, "most_within", "lead", |h| {
            let p = &all.percentiles;
            h.optional(p.p2_5, None, decimals, true)
                .raw("\u{2009}…\u{2009}")
                .optional(p.p97_5, None, decimals, true);
        }),
    }
    key_number(h, "range", "", |h| {
        h.optional(all.min, all.min_reason.as_deref(), decimals, true).raw("\u{2009}…\u{2009}");
        h.optional(all.max, all.max_reason.as_deref(), decimals, true);
    });
    let mut optional = |key, value, reason: &Option<String>, signed| {
        key_number(h, key, "", |h| {
            h.optional(value, reason.as_deref(), decimals + 1, signed);
        });
    };
    optional("mean", all.mean, &all.mean_reason, true);
    optional("std_dev", all.std_dev, &all.std_dev_reason, false);
    let excluded: u64 = c.excluded.values().sum();
    for (key, count) in [("points", all.count), ("excluded", excluded)] {
        let class = if key == "excluded" && count > 0 { "warn" } else { "" };
        key_number(h, key, class, |h| {
            h.count(count);
        });
    }
    key_number(h, "sign.method", "", |h| {
        h.word(&sign_key(&c.sign));
    });
    let (class, sign, state) =
        if c.soundness.sound { ("", "✓\u{a0}", "sound.short") } else { ("warn", "⚠\u{a0}", "not_sound") };
    key_number(h, "soundness", class, |h| {
        h.raw(sign).word(state);
    });
    if let Some(a) = aligned {
        let (class, sign) = if a.sound() { ("", "") } else { ("warn", "⚠\u{a0}") };
        key_number(h, "alignment", class, |h| {
            h.raw(sign).word("rms").raw("\u{a0}").number(a.rms, decimals + 1, false);
        });
    }
    for warning in &c.warnings {
        key_number(h, warning_key(warning.kind), "warn", |h| {
            h.raw("⚠\u{a0}").number(warning.value, 3, false);
        });
    }
    h.raw("</dl>");
}
