//! The page of a trend's maps: mean and spread of the deviations over the part.

use super::parts;
use crate::number::Style;
use crate::page::parts::{fact, key_number, median, mm, most, paragraphs, section};
use crate::page::table::{Row, places};
use crate::pages::curvature::{Choice, USUAL_COLUMNS, choices};
use crate::subject::{Content, Map, Pick, Subject};
use maud::{Markup, html};
use trueness_document::place_map::{MapPlace, MapQuantity, TrendMap};
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
    fn content(&self, s: Style) -> serde_json::Result<Content<'_>> {
        let quantities = self.quantities();
        Ok(Content {
            convention: Some("sign.short"),
            picture: "picture.trend_map",
            numbers: html! {
                @for (n, (words, of)) in quantities.into_iter().enumerate() { (numbers(s, self, n, words, of)) }
            },
            list: list(s, self),
            method: paragraphs(s, ["method.trend_map.text"]),
            how: html! {
                (s.word("verdict.trend_map")) " · " (s.len(&self.document.parts)) " " (s.word("parts.of"))
            },
            ..parts::common(self.document)?
        })
    }

    fn scale(&self) -> Option<&Scale> {
        Some(&self.map.means.scale)
    }

    fn quantity(&self) -> [&'static str; 3] {
        MEAN
    }

    fn maps(&self) -> Vec<Map<'_>> {
        let maps = self.quantities().map(|(words, of)| Map {
            name: words[0],
            count: of.statistics.count,
            mean: of.statistics.mean,
            tolerance: None,
            histogram: of.histogram.as_ref(),
            scale: Some(&of.scale),
            quantity: Some(*words),
        });
        maps.into()
    }

    fn picks(&self) -> Vec<Pick> {
        let of = |(n, (_, of)): (usize, (_, &MapQuantity))| {
            let place = of.greatest?;
            Some(Pick { position: place.position, map: Some(n), value: Some(place.value), ..Pick::default() })
        };
        self.quantities().into_iter().enumerate().filter_map(of).collect()
    }
}

fn list(s: Style, page: &MapPage) -> Markup {
    let map = page.map;
    let rows = page.quantities().map(|(words, of)| {
        let digits = of.scale.decimals as usize;
        Choice::usual(words[0], &of.statistics, digits, "mm", of.scale.lower < 0.0)
    });
    let extremes = html! {
        @for (n, (_, of)) in page.quantities().into_iter().enumerate() { (greatest(s, n, of)) }
    };
    let places = html! {
        dl.facts.pairs {
            (fact(s, "places.complete", s.count(map.complete)))
            (fact(s, "places.partial", s.count(map.partial)))
            (fact(s, "places.without", s.count(map.without)))
        }
        p.note { (s.word("places.gray")) }
    };
    html! {
        (section(s, "quantities", choices(s, USUAL_COLUMNS, rows.into_iter())))
        (section(s, "extremes", extremes))
        (section(s, "places.title", places))
        (section(s, "files", parts::results(s, &page.document.inputs)))
    }
}

/// The key numbers of a quantity, those of map `n`. The first of them has a sign.
fn numbers(s: Style, page: &MapPage, n: usize, words: &[&'static str; 3], of: &MapQuantity) -> Markup {
    let (all, digits) = (&of.statistics, of.scale.decimals as usize);
    let some = page.map.partial + page.map.without;
    html! {
        dl.key-numbers data-comparison=(n) hidden[n > 0] {
            (key_number(s, words[0], "lead", html! {
                (mm(median(s, all, digits, n == 0))) " " small { (s.word("median")) }
            }))
            (key_number(s, "places.most", "", most(s, all, digits, n == 0)))
            (key_number(s, "max", "", html! { (s.optional(all.max, digits).because(all.max_reason.as_deref())) }))
            (key_number(s, "parts", "", s.len(&page.document.parts)))
            @if some > 0 { (key_number(s, "places.gray.short", "warn", s.count(some))) }
        }
    }
}

/// Where a quantity is greatest in size.
fn greatest(s: Style, n: usize, of: &MapQuantity) -> Markup {
    let digits = of.scale.decimals as usize;
    let row = |place: MapPlace| {
        let value = s.optional(Some(place.value), digits).with_sign(n == 0);
        Row::at(s, &s.word("places.greatest"), &value, place.position).pick(n).title(place.index)
    };
    html! {
        @if let Some(place) = of.greatest {
            div data-comparison=(n) hidden[n > 0] { (places(s, "value", [row(place)])) }
        }
    }
}
