//! All that the document of a comparison tells, as a table for people.

use super::line::{line, short, verdict};
use crate::console::columns;
use crate::number::{
    FACETS, POINTS, counted, fixed, grouped, short as shortest, short_signed, signed, six_digits as number,
};
use trueness_document::compare::{
    AlongKind, AlongRecord, CompareDocument, Comparison, CoverageRecord, OutliersRecord, SignBy, Statistics,
    SurfacesRecord,
};
use trueness_document::face::worst_first;
use trueness_document::research::{Finding, Research, Test};
use trueness_document::statistics::TABLE_ROWS;
use trueness_measure::compare::Excluded;

/// The whole text.
pub fn text(d: &CompareDocument) -> String {
    let mut out = head(d);
    match &d.comparisons[..] {
        [only] => out.push_str(&one(only)),
        several => out.push_str(&ranking(d, several)),
    }
    d.comparisons.iter().for_each(|c| out.push_str(&worst(d, c)));
    d.comparisons.iter().for_each(|c| out.push_str(&faces(d, c)));
    out.push('\n');
    out.push_str(&verdict(d.verdict, &d.verdict_reasons));
    out
}

/// Which of several references a line is about.
fn of_which(d: &CompareDocument, c: &Comparison) -> String {
    if d.comparisons.len() > 1 { format!(" of {}", short(&c.reference)) } else { String::new() }
}

/// The worst places, a line each; those of a region with its name.
pub fn worst(d: &CompareDocument, c: &Comparison) -> String {
    let of = of_which(d, c);
    let mut out = String::new();
    for (n, place) in (1..).zip(&c.worst) {
        let [x, y, z] = place.point.map(shortest);
        let region = place.region.as_ref().map(|r| format!(", region \"{r}\"")).unwrap_or_default();
        out.push_str(&line(
            &format!("worst {n}"),
            &format!("{} mm at {x}, {y}, {z}{region}{of}", short_signed(place.deviation)),
        ));
    }
    out
}

/// Faces that are printed.
const MAX_PRINTED_FACES: usize = 10;

/// The faces of a CAD model with the farthest deviations, a line each.
fn faces(d: &CompareDocument, c: &Comparison) -> String {
    let of = of_which(d, c);
    let mut out = String::new();
    for f in worst_first(&c.faces, MAX_PRINTED_FACES) {
        let name = f.face.name.as_ref().map(|name| format!(" \"{name}\"")).unwrap_or_default();
        let instance = f.face.instance.as_ref().map(|path| format!(" in {path}")).unwrap_or_default();
        let inside = f.inside.map(|share| format!(", {} % within", percent(Some(share)))).unwrap_or_default();
        out.push_str(&line(
            &format!("face {}", f.face.face),
            &format!(
                "{}{name}{instance}{of}: {}, mean {} mm, rms {} mm, farthest {} mm{inside}",
                f.kind,
                counted(f.count, POINTS),
                short_signed(f.mean),
                number(f.rms),
                short_signed(f.worst())
            ),
        ));
    }
    if c.faces.len() > MAX_PRINTED_FACES {
        let text = format!("{} more in the result document", c.faces.len() - MAX_PRINTED_FACES);
        out.push_str(&line("faces", &text));
    }
    out
}

fn head(d: &CompareDocument) -> String {
    let mut rows = vec![];
    for input in &d.inputs {
        let facets = input.facets.map(|f| format!(", {}", counted(f, FACETS))).unwrap_or_default();
        let points = counted(input.points, POINTS);
        let what = format!("{points}{facets} ({}, {})", input.format, input.unit_assumed);
        rows.push((format!("{:?}", input.role).to_lowercase(), format!("{}  {what}", input.path)));
        if let Some(b) = &input.bounds {
            let [l, w, h] = [0, 1, 2].map(|k| number(b.max[k] - b.min[k]));
            rows.push((String::new(), format!("{l} × {w} × {h} mm")));
        }
        rows.extend(input.reading().map(|r| (String::new(), r)));
        rows.extend(input.warnings.iter().map(|w| (String::new(), format!("! {w}"))));
    }
    if let Some(a) = &d.alignment {
        let by_area = d.inputs.first().is_some_and(|i| i.facets.is_some());
        let what = format!(
            "best fit to {}: rms {} mm{}, {} left out",
            short(&a.reference),
            number(a.rms),
            if by_area { " by area" } else { "" },
            grouped(a.left_out)
        );
        rows.push(("aligned".into(), what));
        rows.extend(a.warnings.iter().map(|w| ("!".into(), w.text.clone())));
    }
    rows.push(("method".into(), d.method.to_string()));
    for c in &d.comparisons {
        let of = if d.comparisons.len() > 1 { format!("{}: ", short(&c.reference)) } else { String::new() };
        rows.extend(c.warnings.iter().map(|w| ("!".into(), format!("{of}{}", w.text))));
        let disagreement = match c.sign.disagreement {
            Some(x) if x > 0.0 => format!("; both methods disagree on {} % of a sample", number(100.0 * x)),
            _ => String::new(),
        };
        rows.push(("sign".into(), format!("{of}{}: {}{disagreement}", c.sign.method, c.sign.reason)));
        if let Some(s) = &c.surfaces {
            rows.push(("surfaces".into(), format!("{of}{}", surfaces(s))));
        }
        if let Some(a) = &c.along {
            rows.push(("along".into(), format!("{of}{}", along(a))));
        }
        if !c.soundness.sound {
            rows.push(("!".into(), format!("{of}the reference is not sound: {}", unsound(c))));
            rows.extend(places(c).map(|place| (String::new(), format!("  {of}{place}"))));
            let signs = match *c.sign.method {
                SignBy::None => "the deviations have no sign".into(),
                method => format!("the signs are those of the method {}", method.name()),
            };
            rows.push((String::new(), format!("  {of}it is compared all the same; {signs}")));
        }
        if let Some(o) = &c.outliers {
            rows.push(("outliers".into(), format!("{of}{}", outliers(o))));
        }
        if let Some(covered) = &c.coverage {
            rows.push(("uncovered".into(), format!("{of}{}", coverage(covered))));
        }
        for (reason, n) in c.excluded.iter().filter(|(_, n)| **n > 0) {
            rows.push((
                "excluded".into(),
                format!("{of}{} ({}{})", counted(*n, POINTS), reason.replace('_', " "), limit(d, reason)),
            ));
        }
    }
    let mut out = String::new();
    let mut last = String::new();
    for (name, text) in rows {
        let shown = if name == last { "" } else { name.as_str() };
        out.push_str(&format!("{shown:<10} {text}\n"));
        last = name;
    }
    out.push('\n');
    out
}

/// The limit that a reason goes by, where it is not the reason's own.
fn limit(d: &CompareDocument, reason: &str) -> String {
    match d.facing.filter(|_| reason == Excluded::Facing.name()) {
        // As it was asked for: what the way there and back through radians adds is far beyond these digits.
        Some(angle) => {
            let degrees = (1e9 * angle.to_degrees()).round() / 1e9;
            format!(": more than {degrees}° from the reference's normal")
        }
        None if reason == Excluded::NoCrossing.name() => ": the line meets nothing near enough".into(),
        None => String::new(),
    }
}

/// Along what lines deviations are.
pub fn along(a: &AlongRecord) -> String {
    match (&a.direction, *a.kind) {
        (Some([x, y, z]), _) => format!("the direction {x}, {y}, {z}, to the nearest crossing"),
        (_, AlongKind::Reference) => {
            "the reference's normal at the nearest place, to the nearest crossing".into()
        }
        _ => "each point's own normal, to the nearest crossing".into(),
    }
}

/// A rule for outliers, and what it gave.
pub fn outliers(o: &OutliersRecord) -> String {
    let reason = o.limits_reason.as_deref().unwrap_or_default();
    match (o.lower, o.upper) {
        (Some(lower), Some(upper)) => {
            let (lower, upper) = (signed(lower), signed(upper));
            format!("{}: {} beyond {lower} … {upper} mm", o.rule, counted(o.count, POINTS))
        }
        _ => format!("{}: {reason}", o.rule),
    }
}

/// What part of a reference is not covered.
pub fn coverage(c: &CoverageRecord) -> String {
    let share = percent(c.uncovered_share);
    let (area, all, reach) = (number(c.uncovered), number(c.area), number(c.reach));
    let between = match c.between {
        0 => String::new(),
        n => format!("; {} on large facets of the measured mesh counted", counted(n, ["place", "places"])),
    };
    format!("{share} % of the reference ({area} of {all} mm²): no point within {reach} mm{between}")
}

/// What is said of surfaces that are measured against themselves.
fn surfaces(s: &SurfacesRecord) -> String {
    let doubt = match s.uncertain {
        0 => String::new(),
        n => format!("; {} with a nearest place that may not be the only one", counted(n, POINTS)),
    };
    format!("{}, measured against directly{doubt}", counted(s.count, ["exact surface", "exact surfaces"]))
}

/// What is wrong with a reference, in words.
pub fn unsound(c: &Comparison) -> String {
    let s = &c.soundness;
    let faults = [
        (s.boundary_edges, ["boundary edge", "boundary edges"]),
        (s.non_manifold_edges, ["edge with more than two facets", "edges with more than two facets"]),
        (s.non_manifold_vertices, ["vertex that is no closed fan", "vertices that are no closed fan"]),
        (
            s.inconsistent_edges,
            ["edge between facets of opposite orientation", "edges between facets of opposite orientation"],
        ),
        (s.duplicate_facets, ["coincident facet", "coincident facets"]),
        (s.degenerate_facets, ["facet without area", "facets without area"]),
        (u64::from(s.closed && !s.outward), ["volume turned inside out", "volumes turned inside out"]),
    ];
    if !s.closed && s.boundary_edges == 0 {
        return "it has no facets".into();
    }
    let named: Vec<String> =
        faults.iter().filter(|(n, _)| *n > 0).map(|(n, what)| counted(*n, *what)).collect();
    named.join(", ")
}

/// Where the largest flaw of each kind is.
fn places(c: &Comparison) -> impl Iterator<Item = String> {
    c.soundness.findings.iter().filter_map(|(kind, found)| {
        let largest = found.items.iter().max_by(|a, b| a.size.total_cmp(&b.size))?;
        let [x, y, z] = largest.position.map(number);
        let count = grouped(found.count?);
        let (kind, size) = (kind.replace('_', " "), number(largest.size));
        Some(format!("{kind}: {count}, the largest at {x}, {y}, {z} ({}: {size})", found.size))
    })
}

/// One reference: statistics in rows, sides in columns.
fn one(c: &Comparison) -> String {
    let has_sign = *c.sign.method != SignBy::None;
    let sides: Vec<&Statistics> = if has_sign {
        vec![&c.deviation.all, &c.deviation.positive, &c.deviation.negative]
    } else {
        vec![&c.deviation.all]
    };
    let mut rows = vec![vec!["deviation, mm".to_string(), "all".into()]];
    if has_sign {
        rows[0].extend(["+ outside".into(), "− inside".into()]);
    }
    let line = |name: &str, f: &dyn Fn(&Statistics) -> String| {
        std::iter::once(name.to_string()).chain(sides.iter().map(|s| f(s))).collect::<Vec<String>>()
    };
    rows.push(line("points", &|s| grouped(s.count)));
    for (name, get) in TABLE_ROWS {
        rows.push(line(name, &|s| get(s).map(number).unwrap_or_else(|| "–".into())));
    }
    let mut out = columns(&rows);
    if let Some(r) = &c.reverse {
        out.push_str("\nfrom the reference to the measured mesh, mm\n");
        let rows: Vec<Vec<String>> = [
            ("mean", r.deviation.mean),
            ("max", r.deviation.max),
            ("both ways: mean", r.mean),
            ("both ways: Hausdorff distance", r.hausdorff),
        ]
        .iter()
        .map(|(name, x)| vec![name.to_string(), x.map(number).unwrap_or_else(|| "–".into())])
        .collect();
        out.push_str(&columns(&rows));
    }
    if let Some(p) = &c.paper_vs_exact {
        out.push_str(&format!(
            "\npaper against exact: {} of {} points differ ({} too small), by {} mm at most\n",
            grouped(p.differing),
            grouped(p.count),
            grouped(p.too_small),
            number(p.max_difference)
        ));
    }
    if let Some(r) = &c.research {
        out.push_str(&research(r));
    }
    if !c.regions.is_empty() {
        out.push_str(&regions(c));
    } else if let (Some(t), Some(v)) = (&c.tolerance, c.verdict) {
        out.push_str(&format!(
            "\ntolerance {} … {} mm: {} % inside, {} % above, {} % below: {}\n",
            signed(t.lower),
            signed(t.upper),
            percent(t.inside),
            percent(t.above),
            percent(t.below),
            v.word().to_uppercase()
        ));
    }
    out
}

/// A line a region, one for all other points, and what they say together.
pub fn regions(c: &Comparison) -> String {
    let head = ["region", "points", "tolerance, mm", "inside %", "above %", "below %", "min", "max", ""];
    let mut rows = vec![head.map(String::from).to_vec()];
    let optional = |x: Option<f64>| x.map_or_else(|| "–".into(), number);
    for r in &c.regions {
        let t = &r.tolerance;
        rows.push(vec![
            r.id.clone(),
            grouped(r.deviation.count),
            format!("{} … {}", signed(t.lower), signed(t.upper)),
            percent(t.inside),
            percent(t.above),
            percent(t.below),
            optional(r.deviation.min),
            optional(r.deviation.max),
            r.verdict.word().into(),
        ]);
    }
    let rest = c.deviation.all.count - c.regions.iter().map(|r| r.deviation.count).sum::<u64>();
    if let Some(t) = &c.tolerance {
        let zone = format!("{} … {}", signed(t.lower), signed(t.upper));
        let mut row = vec!["(others)".into(), grouped(rest), zone];
        row.extend([percent(t.inside), percent(t.above), percent(t.below)]);
        // Their least and greatest deviations are not known apart from those of the regions.
        row.extend([String::new(), String::new(), c.others_verdict.map_or("", |v| v.word()).to_string()]);
        rows.push(row);
    }
    let verdict = c.verdict.map_or_else(String::new, |v| format!("together: {}\n", v.word().to_uppercase()));
    format!("\n{}{verdict}", columns(&rows))
}

/// The findings of `--research`, a line each.
pub fn research(r: &Research) -> String {
    fn line<T>(name: &str, finding: &Finding<T>, text: impl Fn(&T) -> String) -> Vec<String> {
        let text = match finding {
            Finding::Found(x) => text(x),
            Finding::Missing { reason } => format!("– ({reason})"),
        };
        vec![name.to_string(), text]
    }
    let interval = |[a, b]: [f64; 2]| format!("{} … {}", signed(a), signed(b));
    let test = |t: &Test| {
        format!("{} (p {}, {})", number(t.statistic), p_value(t.p_value), counted(t.count, POINTS))
    };
    let rows = [
        line("95 % interval of the mean", &r.bootstrap, |b| interval(b.mean)),
        // A deviation has no sign.
        line("95 % interval of σ", &r.bootstrap, |b| b.std_dev.map(number).join(" … ")),
        line("… of the mean, correlated in space", &r.block_mean, |b| {
            format!("{} (as {} independent points)", interval(b.interval), number(b.effective_count.round()))
        }),
        line("normal? D'Agostino–Pearson K²", &r.normality.d_agostino, test),
        line("normal? Anderson–Darling A²", &r.normality.anderson_darling, test),
        line("best distribution", &r.distributions, |all| match &all[..] {
            [best, ..] => {
                format!("{} (location {}, scale {})", best.family, number(best.location), number(best.scale))
            }
            [] => "–".into(),
        }),
        line("Moran's I", &r.moran, |m| {
            format!("{} over {} mm (p {})", fixed(m.i, 4), number(m.neighbor_distance), p_value(m.p_value))
        }),
    ];
    let width = rows.iter().map(|r| r[0].chars().count()).max().unwrap_or(0);
    let mut out = String::from("\nresearch, mm\n");
    for row in rows {
        let pad = " ".repeat(width - row[0].chars().count());
        out.push_str(&format!("{}{pad}  {}\n", row[0], row[1]));
    }
    out
}

/// Several references: one row each, the best first; then the paired differences.
fn ranking(d: &CompareDocument, several: &[Comparison]) -> String {
    let names =
        ["rank", "reference", "points", "rms", "mean", "σ", "mean |d|", "median", "95 %", "min", "max"];
    let mut rows = vec![names.map(String::from).to_vec()];
    let tolerance = several.iter().any(|c| c.verdict.is_some());
    if tolerance {
        rows[0].extend(["inside %".into(), "verdict".into()]);
    }
    let mut order: Vec<&Comparison> = several.iter().collect();
    order.sort_by_key(|c| c.rank);
    for c in order {
        let s = &c.deviation.all;
        let mut row = vec![c.rank.to_string(), short(&c.reference).to_string(), grouped(s.count)];
        let numbers = [s.rms, s.mean, s.std_dev, s.mean_abs, s.median, s.percentiles.p95, s.min, s.max];
        row.extend(numbers.map(|x| x.map(number).unwrap_or_else(|| "–".into())));
        if let Some(v) = c.verdict {
            let inside = c.tolerance.as_ref().filter(|_| c.regions.is_empty()).and_then(|t| t.inside);
            row.extend([percent(inside), v.word().to_string()]);
        }
        rows.push(row);
    }
    let mut out = columns(&rows);
    out.push_str("\npaired differences of |d| on the same points, mm (negative: the first is nearer)\n");
    let mut rows =
        vec![["pair", "mean difference", "95 % interval", "p", "points as one"].map(String::from).to_vec()];
    for p in &d.paired {
        let name = |i: usize| several.get(i).map(|c| short(&c.reference)).unwrap_or("?");
        let interval = p.interval.map(|[a, b]| format!("{} … {}", signed(a), signed(b)));
        rows.push(vec![
            format!("{} − {}", name(p.better), name(p.other)),
            p.mean_difference.map(signed).unwrap_or_else(|| "–".into()),
            interval.unwrap_or_else(|| "–".into()),
            p.p_value.map(p_value).unwrap_or_else(|| "–".into()),
            p.points_per_independent.map_or_else(|| "–".into(), |points| fixed(points, 1)),
        ]);
    }
    out.push_str(&columns(&rows));
    out
}

fn percent(share: Option<f64>) -> String {
    share.map_or("–".into(), |share| fixed(100.0 * share, 3))
}

fn p_value(p: f64) -> String {
    if p < 1e-4 { "< 0.0001".into() } else { format!("{p:.4}") }
}
