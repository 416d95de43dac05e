//! The page of a trend's maps: mean and spread of the deviations over the part.

use super::parts;
use super::parts::stripped;
use crate::headline::{Headline, Tone};
use crate::number::Style;
use crate::page::parts::{fact, key_number, place_cells, place_heads, section};
use crate::pages::curvature::{Choice, choices};
use crate::subject::{Head, Map, Pick, Subject};
use maud::{Markup, html};
use serde_json::Value;
use trueness_document::place_map::{MapQuantity, TrendMap};
use trueness_document::scale::Scale;
use trueness_document::trend::TrendDocument;

/// The maps of a trend that has them.
#[derive(Clone, Copy, Debug)]
pub struct MapPage<'a> {
    document: &'a TrendDocument,
    map: &'a TrendMap,
}

/// Keys of the words for a quantity, and for the high and the low end of its scale.
const MEAN: [&str; 3] = ["trend.mean", "ends.high", "ends.low"];
const SPREAD: [&str; 3] = ["trend.std_dev", "ends.spread.high", "ends.spread.low"];

impl<'a> MapPage<'a> {
    /// The page of a trend's maps; `None` where it has none.
    pub fn of(document: &'a TrendDocument) -> Option<MapPage<'a>> {
        Some(MapPage { document, map: document.map.as_ref()? })
    }

    fn quantities(&self) -> [(&'static [&'static str; 3], &'a MapQuantity); 2] {
        [(&MEAN, &self.map.means), (&SPREAD, &self.map.std_devs)]
    }
}

impl Subject for MapPage<'_> {
    fn head(&self) -> Head<'_> {
        self.document.head()
    }

    fn headline(&self) -> Headline {
        Headline { key: "trend_map", tone: Tone::Neutral }
    }

    fn title(&self) -> Option<&str> {
        self.document.title()
    }

    fn convention(&self) -> Option<&'static str> {
        Some("sign.short")
    }

    fn picture(&self) -> &'static str {
        "picture.trend_map"
    }

    fn numbers(&self, s: Style) -> Markup {
        html! { @for (n, (words, of)) in self.quantities().into_iter().enumerate() { (numbers(s, self, n, words, of)) } }
    }

    fn list(&self, s: Style) -> Markup {
        let rows = self.quantities().map(|(words, of)| {
            let p = &of.statistics.percentiles;
            let digits = of.scale.decimals as usize;
            Choice {
                key: words[0],
                values: [p.p2_5, p.p50, p.p97_5],
                digits,
                unit: "mm",
                signed: of.scale.lower < 0.0,
            }
        });
        html! {
            (section(s, "quantities", choices(s, ["p2_5", "median", "p97_5"], rows.into_iter())))
            (section(s, "extremes", html! { @for (n, (_, of)) in self.quantities().into_iter().enumerate() { (greatest(s, n, of)) } }))
            (section(s, "places.title", html! {
                dl.facts.pairs {
                    (fact(s, "places.complete", s.count(self.map.complete)))
                    (fact(s, "places.partial", s.count(self.map.partial)))
                    (fact(s, "places.without", s.count(self.map.without)))
                }
                p.note { (s.word("places.gray")) }
            }))
            (section(s, "files", parts::results(s, &self.document.inputs)))
        }
    }

    fn method(&self, s: Style) -> Markup {
        html! { p { (s.word("method.trend_map.text")) } }
    }

    fn how(&self, s: Style) -> Markup {
        html! { (s.word("verdict.trend_map")) " · " (s.len(&self.document.parts)) " " (s.word("parts.of")) }
    }

    fn scale(&self) -> Option<&Scale> {
        Some(&self.map.means.scale)
    }

    fn quantity(&self) -> [&'static str; 3] {
        MEAN
    }

    fn maps(&self) -> Vec<Map<'_>> {
        let of = |(words, of): (&[&'static str; 3], &'_ MapQuantity)| {
            (*words, of.statistics.mean, of.statistics.count)
        };
        let all = self.quantities();
        all.into_iter()
            .map(|q| {
                let (words, mean, count) = of(q);
                let (histogram, scale) = (q.1.histogram.as_ref(), Some(&q.1.scale));
                Map { name: words[0], count, mean, tolerance: None, histogram, scale, quantity: Some(words) }
            })
            .collect()
    }

    fn picks(&self) -> Vec<Pick> {
        let of = |(n, (_, of)): (usize, (_, &MapQuantity))| {
            let place = of.greatest?;
            Some(Pick { position: place.position, map: Some(n), value: Some(place.value), ..Pick::default() })
        };
        self.quantities().into_iter().enumerate().filter_map(of).collect()
    }

    fn json(&self) -> serde_json::Result<Value> {
        stripped(self.document)
    }
}

/// The key numbers of a quantity, those of map `n`.
fn numbers(s: Style, page: &MapPage, n: usize, words: &[&'static str; 3], of: &MapQuantity) -> Markup {
    let (all, digits) = (&of.statistics, of.scale.decimals as usize);
    let p = &all.percentiles;
    let number = |x: Option<f64>| s.optional(x, digits);
    let some = page.map.partial + page.map.without;
    html! {
        dl.key-numbers data-comparison=(n) hidden[n > 0] {
            (key_number(s, words[0], "lead", html! {
                @if n == 0 { (number(all.median).signed().because(all.median_reason.as_deref())) }
                @else { (number(all.median).because(all.median_reason.as_deref())) }
                "\u{a0}mm " small { (s.word("median")) }
            }))
            (key_number(s, "places.most", "", html! {
                @if n == 0 { (number(p.p2_5).signed()) "\u{2009}…\u{2009}" (number(p.p97_5).signed()) }
                @else { (number(p.p2_5)) "\u{2009}…\u{2009}" (number(p.p97_5)) }
            }))
            (key_number(s, "max", "", html! { (number(all.max).because(all.max_reason.as_deref())) }))
            (key_number(s, "parts", "", s.len(&page.document.parts)))
            @if some > 0 { (key_number(s, "places.gray.short", "warn", s.count(some))) }
        }
    }
}

/// Where a quantity is greatest in size.
fn greatest(s: Style, n: usize, of: &MapQuantity) -> Markup {
    let digits = of.scale.decimals as usize;
    html! {
        @if let Some(place) = of.greatest {
            div data-comparison=(n) hidden[n > 0] {
                table.pick {
                    thead { tr { th {} th.r { (s.word("value")) } (place_heads()) } }
                    tbody {
                        tr data-pick=(n) {
                            td title=(place.index) { (s.word("places.greatest")) }
                            td.r { @if n == 0 { (s.number(place.value, digits).signed()) } @else { (s.number(place.value, digits)) } }
                            (place_cells(s, place.position))
                        }
                    }
                }
            }
        }
    }
}
