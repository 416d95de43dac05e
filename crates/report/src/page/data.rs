//! What the script reads: manifest, words, blobs.

use super::super::payload::{Entry, Payload};
use super::super::picture::{FirstView, others, reached};
use super::super::subject::{Frame, Map, Pick};
use super::super::values::json;
use super::super::{Marks, ReportError, ReportInput, Up, ViewObject, ViewRole, text};
use maud::{PreEscaped, Render, html};
use serde::{Serialize, Serializer};
use serde_json::Value;
use trueness_document::compare::{Histogram, ToleranceShares};
use trueness_document::scale::palette::{self, Rgb};
use trueness_document::scale::{Mode, Scale, slot};
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::{Point, Vector};

/// Values of the distribution that the script tells shares of a range from: exactly where these are all, else about.
const MAX_QUANTILES: usize = 2000;

/// `trueness/view/1`, as docs/decisions tell it.
#[derive(Serialize)]
struct Manifest<'a> {
    schema: &'static str,
    language: &'static str,
    decimal: Option<char>,
    up: &'static str,
    first: Option<FirstEntry>,
    scale: Option<&'a Scale>,
    quantity: [&'static str; 3],
    palettes: Option<Palettes>,
    maps: &'a [MapEntry<'a>],
    picks: Vec<PickEntry>,
    objects: &'a [Entry],
    simplified: bool,
    display_error: f64,
    result: &'a Value,
}

/// What the first view shows.
#[derive(Serialize)]
struct FirstEntry {
    toward: Vector,
    /// Numbers of the picks that it was chosen for.
    places: Vec<usize>,
}

/// A map that can be shown, with what the scale draws beside it.
#[derive(Serialize)]
pub struct MapEntry<'a> {
    name: &'a str,
    count: u64,
    mean: Option<f64>,
    tolerance: Option<ToleranceShares>,
    histogram: Option<&'a Histogram>,
    quantiles: Vec<f64>,
    slots: Option<Vec<u64>>,
    scale: Option<&'a Scale>,
    palettes: Option<Palettes>,
    quantity: Option<[&'static str; 3]>,
}

/// A place that a row of the list leads to.
#[derive(Serialize)]
struct PickEntry {
    position: Point,
    surface: Option<Point>,
    off: bool,
    reach: Option<f64>,
    normal: Option<Vector>,
    others: Vec<Point>,
    reached: usize,
    mark: Option<usize>,
    object: Option<usize>,
    map: Option<usize>,
    value: Option<f64>,
    frame: Option<Frame>,
}

/// Every palette's colors for one scale.
struct Palettes(Vec<(&'static str, PaletteEntry)>);

impl Serialize for Palettes {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, entry)| (name, entry)))
    }
}

/// Colors, six hexadecimal digits each.
#[derive(Serialize)]
struct PaletteEntry {
    /// For the scale's bands.
    bands: String,
    /// In 256 steps, without bands.
    ramp: String,
    /// Below, in and above the zone.
    go_no_go: String,
}

/// The data elements.
pub struct Data<'a> {
    manifest: String,
    texts: String,
    blobs: &'a [String],
}

impl<'a> Data<'a> {
    /// Of a page with this payload; `first` is what its stage shows of a part, `result` the document.
    pub fn of(
        input: &ReportInput,
        payload: &'a Payload,
        first: Option<&FirstView>,
        maps: &[MapEntry],
        result: &Value,
    ) -> Result<Data<'a>, ReportError> {
        let subject = input.result;
        let first_entry = |first: &FirstView| FirstEntry {
            toward: first.toward,
            places: first.places.iter().map(|(n, _)| *n).collect(),
        };
        let manifest = Manifest {
            schema: "trueness/view/1",
            language: input.options.language.code(),
            decimal: input.options.decimal,
            up: if input.options.up == Up::Y { "y" } else { "z" },
            first: first.map(first_entry),
            scale: subject.scale(),
            quantity: subject.quantity(),
            palettes: subject.scale().map(palettes),
            maps,
            picks: picks(input, first),
            objects: &payload.objects,
            simplified: payload.simplified,
            display_error: payload.display_error,
            result,
        };
        Ok(Data { manifest: json(&manifest)?, texts: json(&text::table())?, blobs: &payload.blobs })
    }
}

impl Render for Data<'_> {
    fn render_to(&self, page: &mut String) {
        for (id, json) in [("manifest", &self.manifest), ("texts", &self.texts)] {
            html! { script type="application/json" id=(id) { (PreEscaped(json)) } "\n" }.render_to(page);
        }
        for (n, blob) in self.blobs.iter().enumerate() {
            html! { script type="application/octet-stream" id={ "blob-" (n) } { (PreEscaped(blob)) } "\n" }
                .render_to(page);
        }
    }
}

/// The maps that can be shown, with what the scale draws beside them.
pub fn maps<'a>(input: &'a ReportInput) -> Vec<MapEntry<'a>> {
    let subject = input.result;
    let of = |(n, m): (usize, Map<'a>)| {
        let values = sorted(input, n);
        MapEntry {
            name: m.name,
            count: m.count,
            mean: m.mean,
            tolerance: m.tolerance,
            histogram: m.histogram,
            quantiles: quantiles(&values),
            slots: slots(&values, m.count, m.scale.or(subject.scale())),
            scale: m.scale,
            palettes: m.scale.map(palettes),
            quantity: m.quantity,
        }
    };
    subject.maps().into_iter().enumerate().map(of).collect()
}

/// The values at hand of a map, least to greatest.
fn sorted(input: &ReportInput, map: usize) -> Vec<f64> {
    // What a reference or a surface shows is not what was counted.
    let counted = |o: &&ViewObject| match o.role {
        ViewRole::Measured | ViewRole::Part => true,
        ViewRole::Deviation => o.gathered.is_none(),
        _ => false,
    };
    let valued = input.objects.iter().filter(counted);
    let mut sorted: Vec<f64> = valued
        .filter_map(|o| o.field(map))
        .flat_map(|f| f.values.iter().copied().filter(|v| v.is_finite()))
        .collect();
    sorted.par_sort_unstable_by(f64::total_cmp);
    sorted
}

/// How many values have each color of the scale as it opens, from the low cap to the high one; absent where some of the
/// values are not at hand, for then nobody can count them.
fn slots(sorted: &[f64], count: u64, scale: Option<&Scale>) -> Option<Vec<u64>> {
    let limits = scale.filter(|_| sorted.len() as u64 == count)?.limits();
    let mut counts = vec![0; limits.len() + 1];
    for value in sorted {
        counts[slot(&limits, *value)] += 1;
    }
    Some(counts)
}

/// The places of the list, in the order of its rows.
fn picks(input: &ReportInput, first: Option<&FirstView>) -> Vec<PickEntry> {
    let marks = Marks::numbered(input.marks);
    let mark = |p: &Pick| p.mark.and_then(|m| marks.get(m).copied());
    let of = |(n, p): (usize, Pick)| PickEntry {
        position: p.position,
        surface: p.surface,
        off: first.is_some_and(|f| f.off[n]),
        reach: p.reach,
        normal: p.normal.or_else(|| mark(&p)?.normal),
        others: others(&p, mark(&p)),
        reached: reached(&p, mark(&p)),
        mark: p.mark,
        object: p.object,
        map: p.map,
        value: p.value,
        frame: p.frame,
    };
    input.result.picks().into_iter().enumerate().map(of).collect()
}

fn palettes(scale: &Scale) -> Palettes {
    let hex =
        |colors: &[Rgb]| colors.iter().map(|[r, g, b]| format!("{r:02x}{g:02x}{b:02x}")).collect::<String>();
    let of = |name: &str| {
        let as_mode = |mode| Scale { mode, palette: name.into(), ..scale.clone() };
        PaletteEntry {
            bands: hex(&as_mode(Mode::Bands).colors()),
            ramp: hex(&as_mode(Mode::Continuous).ramp(256)),
            go_no_go: hex(&palette::colors(name, 1)),
        }
    };
    Palettes(palette::NAMES.map(|name| (name, of(name))).into())
}

/// Evenly spaced quantiles of sorted values, all of them where they are few; empty where there are none.
fn quantiles(sorted: &[f64]) -> Vec<f64> {
    let Some(last) = sorted.len().checked_sub(1) else { return vec![] };
    let steps = MAX_QUANTILES.min(last.max(1));
    (0..=steps).map(|i| sorted[(i as u64 * last as u64 / steps as u64) as usize]).collect()
}
