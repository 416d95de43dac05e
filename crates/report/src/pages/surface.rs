//! The page of a surface through points: how far the points lie from it, how it bends, what it rests on.

use crate::headline::{Headline, Tone};
use crate::number::{Style, enough};
use crate::page::parts::{extent, fact, key_number, line, mm, paragraphs, range, section};
use crate::page::table::{Row, places};
use crate::pages::curvature::{Choice, choices, middle, words};
use crate::subject::{Content, Map, Pick, Subject};
use crate::values::Text;
use maud::{Markup, Render, html};
use trueness_document::Verdict;
use trueness_document::compare::ToleranceShares;
use trueness_document::curvature::CurvatureKind;
use trueness_document::scale::Scale;
use trueness_document::surface::{BaseKind, MapRecord, SurfaceDocument};

impl Subject for SurfaceDocument {
    fn content(&self, s: Style) -> serde_json::Result<Content<'_>> {
        Ok(Content {
            convention: Some("sign.plane"),
            picture: "picture.surface",
            numbers: html! {
                (deviations(s, self))
                @for (n, (kind, map)) in curvatures(self).enumerate() { (bend(s, self, n + 1, kind, map)) }
            },
            list: list(s, self),
            method: paragraphs(s, ["method.surface.text", "method.surface.maps"]),
            how: line(s, ["method.surface", "orthogonal"]),
            points: Some(self.deviation.count + self.outliers + self.beyond_border),
            json: serde_json::to_value(self)?,
            ..Content::of(headline(self), [&self.schema, &self.version, &self.units], &self.inputs)
        })
    }

    fn scale(&self) -> Option<&Scale> {
        Some(&self.map.scale)
    }

    fn quantity(&self) -> [&'static str; 3] {
        DEVIATION
    }

    fn maps(&self) -> Vec<Map<'_>> {
        let shares = self.tolerance.as_ref().map(|t| {
            let share = |count: u64| Some(count as f64 / self.deviation.count as f64);
            ToleranceShares {
                lower: -t.value,
                upper: t.value,
                inside: share(self.deviation.count - t.outside),
                inside_reason: None,
                above: None,
                above_reason: Some("counted together with those below".into()),
                below: None,
                below_reason: Some("counted together with those above".into()),
                required: 1.0,
            }
        });
        let first = map(&self.map, "deviation", self.deviation.count, DEVIATION, shares);
        let count = self.curvature.count;
        let rest = curvatures(self).map(|(kind, of)| map(of, kind.name(), count, words(kind), None));
        std::iter::once(first).chain(rest).collect()
    }

    fn picks(&self) -> Vec<Pick> {
        let (position, value) = (self.worst.position, Some(self.worst.deviation));
        vec![Pick { position, map: Some(0), value, ..Pick::default() }]
    }
}

fn headline(d: &SurfaceDocument) -> Headline {
    match &d.tolerance {
        _ if d.base.is_doubtful() => Verdict::Undecided.into(),
        Some(t) if t.reached => Verdict::Pass.into(),
        Some(_) => Verdict::Fail.into(),
        None => Headline { key: "surface", tone: Tone::Neutral },
    }
}

fn list(s: Style, d: &SurfaceDocument) -> Markup {
    let row = Row::at(
        s,
        &"1",
        &s.number(d.worst.deviation, d.map.scale.decimals as usize).signed(),
        d.worst.position,
    );
    html! {
        @if !d.warnings.is_empty() {
            (section(s, "warnings", html! {
                @for warning in &d.warnings { p.warning { "⚠ " (Text(warning)) } }
            }))
        }
        (section(s, "quantities", quantities(s, d)))
        (section(s, "worst", places(s, "deviation", [row.pick(0).title(d.worst.point)])))
        (section(s, "surface.title", facts(s, d)))
    }
}

/// Keys of the words for deviations, and for the high and the low end of their scale.
const DEVIATION: [&str; 3] = ["deviation", "ends.plane.high", "ends.plane.low"];

fn map<'a>(
    of: &'a MapRecord,
    name: &'a str,
    count: u64,
    quantity: [&'static str; 3],
    tolerance: Option<ToleranceShares>,
) -> Map<'a> {
    let (histogram, scale) = (of.histogram.as_ref(), Some(&of.scale));
    Map { name, count, mean: of.mean, tolerance, histogram, scale, quantity: Some(quantity) }
}

/// The curvatures that have values, in the order of their maps.
fn curvatures(d: &SurfaceDocument) -> impl Iterator<Item = (CurvatureKind, &MapRecord)> {
    CurvatureKind::ALL.into_iter().filter_map(|kind| Some((kind, d.curvature.maps.get(kind.name())?)))
}

/// Least, middle and greatest value of a curvature.
fn ends(d: &SurfaceDocument, kind: CurvatureKind) -> [Option<f64>; 3] {
    let found = match kind {
        CurvatureKind::Mean => d.curvature.mean,
        CurvatureKind::Gaussian => d.curvature.gaussian,
        CurvatureKind::K1 => d.curvature.k1,
        CurvatureKind::K2 => d.curvature.k2,
    };
    found.map_or([None; 3], |r| [r.min, r.median, r.max].map(Some))
}

fn deviations(s: Style, d: &SurfaceDocument) -> Markup {
    let (all, digits) = (&d.deviation, d.map.scale.decimals as usize);
    html! {
        dl.key-numbers data-comparison="0" {
            (key_number(s, "rms", "lead", mm(s.optional(all.rms, digits + 1).because(all.rms_reason.as_deref()))))
            (key_number(s, "range", "", extent(s, all, digits)))
            @if let Some(tolerance) = &d.tolerance {
                (key_number(s, "tolerance", "", html! { "±" (s.number(tolerance.value, digits)) }))
                (key_number(s, "beyond", if tolerance.reached { "" } else { "warn" }, s.count(tolerance.outside)))
            }
            (key_number(s, "points", "", s.count(all.count)))
            @if d.outliers > 0 { (key_number(s, "outliers", "warn", s.count(d.outliers))) }
            @if d.beyond_border > 0 { (key_number(s, "beyond_border", "warn", s.count(d.beyond_border))) }
        }
    }
}

/// The key numbers of a curvature, those of map `n`.
fn bend(s: Style, d: &SurfaceDocument, n: usize, kind: CurvatureKind, map: &MapRecord) -> Markup {
    let [least, median, greatest] = ends(d, kind);
    let value = |x| s.optional(x, enough(median, map.scale.decimals as usize)).signed();
    html! {
        dl.key-numbers data-comparison=(n) hidden {
            (middle(s, kind, value(median)))
            (key_number(s, "range", "", range(value(least), value(greatest))))
        }
    }
}

/// Deviation and curvatures, each in a row that shows its map.
fn quantities(s: Style, d: &SurfaceDocument) -> Markup {
    let (all, digits) = (&d.deviation, d.map.scale.decimals as usize);
    let first =
        Choice { key: "deviation", values: [all.min, all.median, all.max], digits, unit: "mm", signed: true };
    let rest = curvatures(d).map(|(kind, map)| {
        let values = ends(d, kind);
        let digits = enough(values[1], map.scale.decimals as usize);
        Choice { key: words(kind)[0], values, digits, unit: kind.unit(), signed: true }
    });
    html! {
        (choices(s, ["min", "median", "max"], std::iter::once(first).chain(rest)))
        @if d.curvature.reason.is_some() { p.note { (s.word("surface.no_normal")) } }
    }
}

/// What the surface is made of and what it rests on.
fn facts(s: Style, d: &SurfaceDocument) -> Markup {
    let by = |[a, b]: [u64; 2]| html! { (s.count(a)) "\u{2009}×\u{2009}" (s.count(b)) };
    let (m, n) = (d.control_points.len(), d.control_points.first().map_or(0, Vec::len));
    let base = match *d.base.kind {
        BaseKind::Cylinder => "verdict.cylinder",
        BaseKind::Sphere => "verdict.sphere",
        BaseKind::Xy => "base.xy",
        BaseKind::Plane => "verdict.plane",
        BaseKind::Mesh => "base.mesh",
    };
    let fairness = match d.fairness {
        0.0 => html! { "0" },
        fairness => s.scientific(fairness, 1).render(),
    };
    html! {
        dl.facts.pairs {
            (fact(s, "degree", by(d.degree)))
            (fact(s, "control_points", by([m as u64, n as u64])))
            (fact(s, "surface.base", s.word(base)))
            @if d.base.tilted != 0.0 {
                (fact(s, "surface.tilted", html! { (s.number(d.base.tilted.to_degrees(), 2)) "°" }))
            }
            @if let Some([least, most]) = d.base.stretch {
                (fact(s, "surface.stretch", html! { (s.number(least, 3)) " … " (s.number(most, 3)) }))
            }
            @if d.base.turned != 0.0 {
                (fact(s, "surface.turned", html! { (s.number(d.base.turned.to_degrees(), 2).signed()) "°" }))
            }
            (fact(s, "fairness", html! { (fairness) "\u{a0}mm²" }))
            @if let Some(freedom) = d.degrees_of_freedom { (fact(s, "degrees_of_freedom", s.number(freedom, 1))) }
            (fact(s, "corrections", s.count(d.corrections)))
            (fact(s, "unsupported", s.percent(d.unsupported_share, 1)))
            @if let Some(trim) = &d.trim {
                (fact(s, "surface.trim", s.percent(trim.share, 1)))
                (fact(s, "surface.trim.gaps", html! { "≤\u{a0}" (mm(s.number(2.0 * trim.reach, 2))) }))
                @if trim.left_out > 0 { (fact(s, "surface.trim.left_out", s.count(trim.left_out))) }
            }
        }
    }
}
