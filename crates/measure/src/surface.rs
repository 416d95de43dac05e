//! From a surface fitted to points to its result document.

use crate::curvature::{bend_record, map, value};
use crate::statistics::{counted, statistics};
use crate::words::ToWord;
use trueness_document::curvature::{CurvatureKind, Range};
use trueness_document::scale::Scale;
use trueness_document::surface::{
    BaseRecord, CurvatureRecord, KnotsRecord, MAX_FOLDED_SHARE, MapRecord, PlaceCurvature, RegionRecord,
    Residual, SCHEMA, SupportRecord, SurfaceDocument, ToleranceRecord, TrimRecord, WorstPoint, is_crushed,
};
use trueness_document::{InputRecord, UNITS, VERSION};
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::{Aabb, Point};
use trueness_geom::spline::surface::{Bend, Patches};
use trueness_geom::stats::statistics::{Statistics, Summary};
use trueness_surface::{
    Base, BaseKind, Fairness, Layout, Options, Outline, OutlineRegion, SurfaceFit, minimum_rectangle,
};

/// Factor by which lengths may grow or shrink as a mesh is laid flat.
const MAX_STRETCH: f64 = 2.0;

/// Sides of the rectangle of the points with a lesser ratio make a strip.
const MIN_RECTANGLE_RATIO: f64 = 1e-3;

/// The document of a fit to `points`, which are those of `inputs` in their order.
///
/// Cost: some passes over the points.
pub fn document(
    fit: &SurfaceFit,
    points: &[Point],
    options: &Options,
    outline: Option<&Outline>,
    inputs: Vec<InputRecord>,
) -> SurfaceDocument {
    let surface = &fit.surface;
    let [_, n] = surface.counts();
    let [u, v] = surface.knots();
    let total = fit.support.control_points;
    let deviations: Vec<f64> = fit.counted().map(|k| fit.deviations[k]).collect();
    let all = Summary::of(&deviations).all;
    SurfaceDocument {
        schema: SCHEMA.into(),
        version: VERSION.into(),
        units: UNITS.into(),
        inputs,
        degree: [u.degree() as u64, v.degree() as u64],
        knots: KnotsRecord { u: u.values().to_vec(), v: v.values().to_vec() },
        control_points: surface.points().chunks(n).map(<[Point]>::to_vec).collect(),
        base: base(&fit.base),
        fairness: fit.fairness,
        fairness_from: if options.fairness == Fairness::Auto { "auto" } else { "given" }.into(),
        degrees_of_freedom: fit.degrees_of_freedom,
        degrees_of_freedom_reason: fit.degrees_of_freedom.is_none().then(|| "the fairness was given".into()),
        map: deviation_map(&all, &deviations, options),
        deviation: statistics(&all, 0.0),
        worst: worst(fit, points),
        residual: Residual {
            sum_of_squares: fit.sum_of_squares,
            rms: (fit.sum_of_squares / fit.kept().count().max(1) as f64).sqrt(),
            max: fit.max_residual,
        },
        tolerance: tolerance(fit, &deviations, options),
        trim: outline.map(|outline| trim(fit, outline)),
        curvature: curvature(fit, points),
        unsupported_share: fit.support.unsupported as f64 / total as f64,
        support: SupportRecord {
            control_points: total as u64,
            unsupported: fit.support.unsupported as u64,
            cells: fit.support.cells as u64,
            empty_cells: fit.support.empty_cells as u64,
        },
        far_control_points: fit.far_control_points as u64,
        corrections: fit.corrections as u64,
        outliers: fit.left_out.len() as u64,
        beyond_border: fit.beyond_border.len() as u64,
        unsettled: fit.unsettled as u64,
        warnings: warnings(fit, outline),
    }
}

fn base(found: &Base) -> BaseRecord {
    BaseRecord {
        kind: found.kind.word(),
        origin: found.origin,
        axes: found.axes,
        turned: found.turned,
        tilted: found.tilted,
        radius: found.radius,
        radius_reason: found.radius.is_none().then(|| "the base is flat".into()),
        around: found.around,
        pole: found.pole,
        folded_share: found.folded_share,
        standing_share: found.standing_share,
        on_edge: found.is_on_edge(),
        stretch: found.stretch,
        round: found.round,
    }
}

fn worst(fit: &SurfaceFit, points: &[Point]) -> WorstPoint {
    let size = |k: usize| fit.deviations[k].abs();
    let worst = fit.counted().reduce(|best, k| if size(k) > size(best) { k } else { best }).unwrap_or(0);
    WorstPoint {
        point: worst as u64,
        position: points[worst],
        deviation: fit.deviations[worst],
        parameters: fit.feet[worst],
    }
}

fn tolerance(fit: &SurfaceFit, deviations: &[f64], options: &Options) -> Option<ToleranceRecord> {
    let (Layout::Tolerance(value), Some(reached)) = (&options.layout, fit.reached) else { return None };
    let outside = deviations.iter().filter(|d| d.abs() > *value).count() as u64;
    Some(ToleranceRecord { value: *value, reached: outside == 0, outside, stopped_by: reached.word() })
}

fn trim(fit: &SurfaceFit, outline: &Outline) -> TrimRecord {
    let sides = fit.surface.domain().map(|(from, to)| to - from);
    let region = |r: &OutlineRegion| RegionRecord { outer: r.outer.clone(), holes: r.holes.clone() };
    TrimRecord {
        reach: outline.reach,
        share: outline.area() / (sides[0] * sides[1]),
        regions: outline.regions.iter().map(region).collect(),
        left_out: outline.left_out as u64,
    }
}

/// The deviations' counts and colors: by the tolerance, where there is one.
fn deviation_map(all: &Statistics, deviations: &[f64], options: &Options) -> MapRecord {
    // A few points far off must not hide how the rest lies.
    let [.., p2_5, _, _, _, _, _, p97_5, _, _] = all.percentiles;
    let most = p2_5.map_or(0.0, f64::abs).max(p97_5.map_or(0.0, f64::abs));
    let zone = match options.layout {
        Layout::Tolerance(t) => Some([-t, t]),
        _ => None,
    };
    MapRecord {
        histogram: counted(all, deviations),
        mean: all.mean.ok(),
        scale: Scale::for_deviations(most, zone),
    }
}

fn curvature(fit: &SurfaceFit, points: &[Point]) -> CurvatureRecord {
    let patches = Patches::new(&fit.surface);
    let kept: Vec<[f64; 2]> = fit.kept().map(|k| fit.feet[k]).collect();
    let found: Vec<Bend> = kept.par_iter().filter_map(|p| patches.bend(p[0], p[1])).collect();
    let range = |value: fn(&Bend) -> f64| Range::of(found.iter().map(value).collect());
    let [(a, b), (c, d)] = fit.surface.domain();
    let parameters = [0.5 * (a + b), 0.5 * (c + d)];
    let middle = fit.surface.bend(parameters[0], parameters[1]).map(|bend| PlaceCurvature {
        parameters,
        position: fit.surface.at(parameters[0], parameters[1]),
        bend: bend_record(&bend),
    });
    let size = Aabb::of(points).diagonal();
    let drawn = |kind: CurvatureKind| {
        let values: Vec<f64> = found.iter().map(|bend| value(kind, bend)).collect();
        (kind.name().to_string(), map(&values, kind, size).1)
    };
    let maps = CurvatureKind::ALL.into_iter().filter(|_| !found.is_empty()).map(drawn).collect();
    let missing = found.is_empty() || middle.is_none();
    CurvatureRecord {
        count: found.len() as u64,
        reason: missing.then(|| "the surface has no normal there: its derivatives span no plane".into()),
        k1: range(|b| b.principal[0].curvature),
        k2: range(|b| b.principal[1].curvature),
        mean: range(|b| b.mean),
        gaussian: range(|b| b.gaussian),
        middle,
        maps,
    }
}

/// What is to be said of an outline.
fn cut(outline: &Outline) -> Vec<String> {
    let mut all = vec![];
    if outline.reach > (1.0 + 1e-9) * outline.wanted {
        all.push(format!(
            "--trim={}: the outline of a surface so large is found to {:.4} mm and no finer",
            outline.wanted, outline.reach
        ));
    }
    if outline.regions.len() > 1 {
        all.push(format!(
            "the outline of the points has {} parts: gaps of more than {:.4} mm part them; a greater --trim=MM joins them",
            outline.regions.len(),
            2.0 * outline.reach
        ));
    }
    if outline.left_out > 0 {
        all.push(format!("{} points of small parts are left out of the outline", outline.left_out));
    }
    all
}

/// What makes the surface doubtful, in words.
fn warnings(fit: &SurfaceFit, outline: Option<&Outline>) -> Vec<String> {
    let mut all: Vec<String> = outline.into_iter().flat_map(cut).collect();
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    if fit.base.folded_share > MAX_FOLDED_SHARE {
        all.push(format!(
            "{} of the points lie in layers over one another as seen on the base ({}): the surface lies between the layers, or folds steeply from one to the other; take another base, or the layers one by one",
            percent(fit.base.folded_share),
            fit.base.kind.name()
        ));
    }
    if fit.base.is_on_edge() {
        all.push(format!(
            "{} of the points stand on edge on the base ({}): the surface follows the line that they stand on, not what they are part of; take another base ({}), or a part of the points that lies flatter",
            percent(fit.base.standing_share),
            fit.base.kind.name(),
            match fit.base.kind {
                BaseKind::Cylinder | BaseKind::Sphere => "plane, or mesh where there are facets",
                _ => "cylinder, sphere, or mesh where there are facets",
            }
        ));
    }
    if let Some([least, most]) = fit.base.stretch
        && (least < 1.0 / MAX_STRETCH || most > MAX_STRETCH)
    {
        let so = if is_crushed([least, most]) {
            "what shrinks so much the knots do not tell apart, and the surface may cross itself there"
        } else {
            "where they grow the surface has few points for its knots, where they shrink it has few knots"
        };
        all.push(format!(
            "laid flat, lengths on the facets are {least:.3} to {most:.3} times what they are: {so}; take a part of the mesh that bends less"
        ));
    }
    if fit.base.round {
        all.push("laid out freely, the mesh would lie on itself: it is laid within a circle, where its parts are less alike in size".into());
    }
    if fit.base.pole {
        all.push("points lie within 10° of a pole of the sphere, whichever its axis: the surface is torn or creased there, and its curvature is not that of the part; take a part of the points, or --base mesh where there are facets".into());
    }
    if fit.base.around {
        all.push("the points go all around the base: the surface has a seam, where it is not smooth".into());
    }
    if !fit.beyond_border.is_empty() {
        all.push(format!(
            "{} of the points lie beyond the border of the surface, where their distance is no deviation: they are counted, and in no other number",
            fit.beyond_border.len()
        ));
    }
    if fit.far_control_points > 0 {
        all.push(format!(
            "control points lie outside of twice the box of the points ({} in all): the points hold them badly; ask for fewer spans, a greater --fairness, or another base",
            fit.far_control_points
        ));
    }
    let points = fit.feet.len();
    if points < fit.support.control_points {
        all.push(format!(
            "there are fewer points ({points}) than control points ({}): between the points the surface is a thin plate, not data",
            fit.support.control_points
        ));
    }
    if let Some([long, short]) = minimum_rectangle(&fit.feet).map(|r| r.sides)
        && short < MIN_RECTANGLE_RATIO * long
    {
        all.push(format!(
            "the points lie in a strip of {long:.4} mm by {short:.4} mm: across it the surface may follow their noise alone"
        ));
    }
    if fit.support.unsupported > 0 {
        all.push(format!(
            "{} of the control points have no points near them: there the surface is a thin plate, not data",
            percent(fit.support.unsupported as f64 / fit.support.control_points as f64)
        ));
    }
    all
}
