//! What the script reads: manifest, words, blobs.

use super::super::html::{Html, json};
use super::super::payload::Payload;
use super::super::picture::{FirstView, others};
use super::super::{Marks, ReportError, ReportInput, Up, ViewObject, ViewRole, text};
use crate::scale::palette::{self, Rgb};
use crate::scale::{Mode, Scale, slot};
use serde_json::{Map, Value, json};
use trueness_geom::parallel::prelude::*;

/// Values of the distribution that the script tells shares of a range from: exactly where these are all, else about.
const QUANTILES: usize = 2000;

/// Writes the data elements.
pub fn data(
    h: &mut Html,
    input: &ReportInput,
    payload: &Payload,
    first: Option<&FirstView>,
    maps: &Value,
) -> Result<(), ReportError> {
    let subject = input.result.subject();
    let manifest = json!({
        "schema": "trueness/view/1",
        "language": input.options.language.code(),
        "decimal": input.options.decimal,
        "up": if input.options.up == Up::Y { "y" } else { "z" },
        "first": first.map(|first| json!({
            "toward": first.toward,
            "places": first.places.iter().map(|(n, _)| n).collect::<Vec<_>>(),
        })),
        "scale": subject.scale(),
        "quantity": subject.quantity(),
        "palettes": subject.scale().map(palettes),
        "maps": maps,
        "picks": picks(input, first),
        "objects": payload.objects,
        "simplified": payload.simplified,
        "display_error": payload.display_error,
        "result": subject.json()?,
    });
    element(h, "manifest", &manifest);
    element(h, "texts", &text::table());
    for (n, blob) in payload.blobs.iter().enumerate() {
        h.raw(&format!("<script type=\"application/octet-stream\" id=\"blob-{n}\">{blob}</script>\n"));
    }
    Ok(())
}

/// The maps that can be shown, with what the scale draws beside them.
pub fn maps(input: &ReportInput) -> Value {
    let subject = input.result.subject();
    let maps = subject.maps();
    let values: Vec<Vec<f64>> = (0..maps.len()).map(|n| sorted(input, n)).collect();
    let all = maps.into_iter().enumerate().map(|(n, m)| {
        json!({
            "name": m.name, "count": m.count, "mean": m.mean, "tolerance": m.tolerance, "histogram": m.histogram,
            "quantiles": quantiles(&values[n]), "slots": slots(&values[n], m.count, m.scale.or(subject.scale())),
            "scale": m.scale, "palettes": m.scale.map(palettes), "quantity": m.quantity,
        })
    });
    all.collect::<Vec<_>>().into()
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

/// How many values have each colour of the scale as it opens, from the low cap to the high one; absent where some of the
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
fn picks(input: &ReportInput, first: Option<&FirstView>) -> Value {
    let normal = |mark: Option<usize>| input.marks.iter().flat_map(Marks::items).nth(mark?)?.normal;
    let all = input.result.subject().picks().into_iter().enumerate().map(|(n, p)| {
        let off = first.is_some_and(|f| f.off[n]);
        json!({
            "position": p.position, "surface": p.surface, "off": off, "reach": p.reach, "normal": p.normal.or_else(|| normal(p.mark)),
            "others": others(&p, input.marks), "mark": p.mark, "object": p.object, "map": p.map, "value": p.value,
            "frame": p.frame,
        })
    });
    all.collect::<Vec<_>>().into()
}

fn element(h: &mut Html, id: &str, value: &Value) {
    h.raw(&format!("<script type=\"application/json\" id=\"{id}\">{}</script>\n", json(value)));
}

/// Every palette's colours for this scale's bands and, in 256 steps, without bands; and three for go / no-go.
fn palettes(scale: &Scale) -> Value {
    let hex =
        |colors: &[Rgb]| colors.iter().map(|[r, g, b]| format!("{r:02x}{g:02x}{b:02x}")).collect::<String>();
    let of = |name: &str| {
        let as_mode = |mode| Scale { mode, palette: name.into(), ..scale.clone() };
        json!({
            "bands": hex(&as_mode(Mode::Bands).colors()),
            "ramp": hex(&as_mode(Mode::Continuous).ramp(256)),
            "go_no_go": hex(&palette::colors(name, 1)),
        })
    };
    Value::Object(Map::from_iter(palette::NAMES.map(|name| (name.to_string(), of(name)))))
}

/// Evenly spaced quantiles of sorted values, all of them where they are few; empty where there are none.
fn quantiles(sorted: &[f64]) -> Vec<f64> {
    let Some(last) = sorted.len().checked_sub(1) else { return vec![] };
    let steps = QUANTILES.min(last.max(1));
    (0..=steps).map(|i| sorted[(i as u64 * last as u64 / steps as u64) as usize]).collect()
}
