//! What a report draws of a fitted surface. The surface has the colors of its curvatures, the points over it those of their deviations;
//! control net and iso-lines at the knots are drawn, too.

mod reflection;

use crate::views::surface::reflection::reflection_lines;
use crate::{Geometry, Mark, MarkGroup, Marks, NoValue, ViewField, ViewObject, ViewRole};
use trueness_document::curvature::CurvatureKind;
use trueness_document::scale::palette::Rgb;
use trueness_document::surface::SurfaceDocument;
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::{Point, Vector};
use trueness_geom::spline::surface::{Bend, Patches, Surface};
use trueness_measure::curvature::value;
use trueness_surface::{Outline, SurfaceFit};

/// Vertices of the drawn surface, about.
const AIMED_VERTICES: f64 = 160_000.0;
/// Fewest and most steps of a span: curvatures of a cubic change within it as straight lines do at most.
const SPAN_STEPS: [f64; 2] = [3.0, 24.0];
/// Of iso-lines nearer to each other than this share of the side one is drawn: knots set for a feature lie so close that they would hide
/// its colors.
const MIN_LINE_DISTANCE: f64 = 0.025;
/// The control net.
const NET: Rgb = [0x5b, 0x3d, 0xc4];
/// Iso-lines.
const LINE: Rgb = [0x22, 0x26, 0x2b];

/// A surface prepared for drawing.
pub struct View<'a> {
    name: &'a str,
    points: &'a [Point],
    /// NaN of points left out.
    deviations: Vec<f64>,
    left_out: Vec<NoValue>,
    keep: [u32; 1],
    mesh: Mesh,
    /// Curvatures at the vertices, in the order of [`CurvatureKind::ALL`].
    curvatures: [Vec<f64>; 4],
    reasons: Vec<NoValue>,
    /// Iso-lines, then the control net.
    pub marks: Vec<Marks>,
}

impl<'a> View<'a> {
    /// Of a fit to `points`, whose file is shown to the reader as `name`.
    pub fn new(
        document: &SurfaceDocument,
        fit: &'a SurfaceFit,
        outline: Option<&Outline>,
        name: &'a str,
        points: &'a [Point],
    ) -> View<'a> {
        let patches = Patches::new(&fit.surface);
        let lines = lines(&fit.surface);
        let (mut mesh, bends) = drawn(&patches, &lines);
        let mut held = held(fit, &lines);
        if let Some(outline) = outline {
            let inside = inside(outline, &lines);
            held.iter_mut().zip(&inside).for_each(|(held, inside)| *held &= inside);
            mesh.faces.retain(|face| face.iter().any(|v| inside[*v as usize]));
        }
        let reasons: Vec<NoValue> = held
            .iter()
            .map(|held| if *held { NoValue::Undetermined } else { NoValue::NotMeasured })
            .collect();
        let curvatures = CurvatureKind::ALL.map(|kind| {
            let value =
                |(b, held): (&Option<Bend>, &bool)| b.filter(|_| *held).map_or(f64::NAN, |b| value(kind, &b));
            bends.iter().zip(&held).map(value).collect()
        });
        let group = |key: &str, color, mark: Mark| {
            vec![MarkGroup { key: key.into(), color, items: vec![mark.finite()] }]
        };
        let mut drawn_lines = group("iso_lines", LINE, iso_lines(&fit.surface, outline, &patches, &lines));
        drawn_lines.extend(outline.iter().flat_map(|o| group("outline", LINE, trim_lines(o, &fit.surface))));
        let normals: Vec<Option<Vector>> =
            bends.iter().zip(&held).map(|(b, held)| b.filter(|_| *held).map(|b| b.normal)).collect();
        let reflections = group("reflection_lines", LINE, reflection_lines(&mesh, &normals, fit.base.axes));
        let mut deviations = fit.deviations.clone();
        let mut left_out = vec![];
        for (numbers, reason) in
            [(&fit.left_out, NoValue::Outlier), (&fit.beyond_border, NoValue::BoundaryEdge)]
        {
            if !numbers.is_empty() {
                left_out.resize(points.len(), NoValue::Unknown);
            }
            for i in numbers {
                deviations[*i as usize] = f64::NAN;
                left_out[*i as usize] = reason;
            }
        }
        let marks = |role, groups| Marks { role, comparison: None, groups };
        View {
            name,
            points,
            left_out,
            deviations,
            keep: [document.worst.point as u32],
            reasons,
            marks: vec![
                marks(ViewRole::IsoLines, drawn_lines),
                marks(ViewRole::ReflectionLines, reflections),
                marks(ViewRole::Net, group("net", NET, net(&fit.surface))),
            ],
            mesh,
            curvatures,
        }
    }

    /// The points with their deviations, which are map 0, and the surface with its curvatures, the maps after it.
    pub fn objects(&self) -> Vec<ViewObject<'_>> {
        let deviations = ViewField { comparison: 0, values: &self.deviations, reasons: &self.left_out };
        let fields = (1..).zip(&self.curvatures);
        let curvatures =
            fields.map(|(comparison, values)| ViewField { comparison, values, reasons: &self.reasons });
        vec![
            ViewObject {
                role: ViewRole::Measured,
                name: self.name,
                color: None,
                // Over a map of the surface points without values would be in the way.
                comparison: Some(0),
                geometry: Geometry::Points(self.points),
                fields: vec![deviations],
                keep: &self.keep,
                gathered: None,
                faces: None,
            },
            ViewObject {
                role: ViewRole::Surface,
                name: "",
                color: None,
                comparison: None,
                geometry: Geometry::Mesh(&self.mesh),
                fields: curvatures.collect(),
                keep: &[],
                gathered: None,
                faces: None,
            },
        ]
    }
}

/// Parameters of the drawn vertices in both directions: every span in equal steps.
fn lines(surface: &Surface<Point>) -> [Vec<f64>; 2] {
    let knots = surface.knots().each_ref().map(|k| k.distinct());
    let spans: f64 = knots.iter().map(|k| (k.len() - 1) as f64).product();
    let steps = (AIMED_VERTICES / spans).sqrt().floor().clamp(SPAN_STEPS[0], SPAN_STEPS[1]) as usize;
    knots.map(|knots| {
        let inner = knots.windows(2).flat_map(|w| {
            let (from, length) = (w[0], w[1] - w[0]);
            (0..steps).map(move |i| from + length * i as f64 / steps as f64)
        });
        inner.chain(knots.last().copied()).collect()
    })
}

/// The surface as facets that look the way of its normal, and normal and curvatures at the vertices.
fn drawn(patches: &Patches, [us, vs]: &[Vec<f64>; 2]) -> (Mesh, Vec<Option<Bend>>) {
    let places: Vec<(Point, Option<Bend>)> = us
        .par_iter()
        .flat_map_iter(|u| vs.iter().map(|v| (patches.at(*u, *v), patches.bend(*u, *v))))
        .collect();
    let n = vs.len() as u32;
    let cells = (0..us.len() as u32 - 1).flat_map(|i| (0..n - 1).map(move |j| i * n + j));
    let faces = cells.flat_map(|a| [[a, a + n, a + n + 1], [a, a + n + 1, a + 1]]).collect();
    let (positions, bends) = places.into_iter().unzip();
    (Mesh { positions, faces }, bends)
}

/// For each drawn vertex whether points hold the surface there: there are some in a cell of knots that it lies in, or in one
/// beside that. Elsewhere the surface only goes on as smoothly as it can, and its curvature tells nothing of the part.
fn held(fit: &SurfaceFit, lines: &[Vec<f64>; 2]) -> Vec<bool> {
    let knots = fit.surface.knots().each_ref().map(|k| k.distinct());
    let [rows, columns] = knots.each_ref().map(|k| k.len() - 1);
    let cell = |k: usize, t: f64| (knots[k].partition_point(|x| *x <= t).max(1) - 1).min(knots[k].len() - 2);
    let mut filled = vec![false; rows * columns];
    for [u, v] in &fit.feet {
        filled[cell(0, *u) * columns + cell(1, *v)] = true;
    }
    // Of each line the cells on both sides, and one more.
    let around = |k: usize, t: &f64, count: usize| {
        let at = cell(k, *t);
        let before = if knots[k][at] == *t { 2 } else { 1 };
        at.saturating_sub(before)..(at + 2).min(count)
    };
    let near =
        |u: &f64, v: &f64| around(0, u, rows).any(|i| around(1, v, columns).any(|j| filled[i * columns + j]));
    let [us, vs] = lines;
    us.par_iter().flat_map_iter(|u| vs.iter().map(move |v| near(u, v))).collect()
}

/// The lines of the surface at its knots, through the drawn vertices within the outline.
fn iso_lines(
    surface: &Surface<Point>,
    outline: Option<&Outline>,
    patches: &Patches,
    [us, vs]: &[Vec<f64>; 2],
) -> Mark {
    let mut mark = Mark::default();
    let mut add = |places: Vec<[f64; 2]>| {
        let is_inside = |p: &[f64; 2]| outline.is_none_or(|outline| outline.holds(*p));
        let runs = places.chunk_by(|a, b| is_inside(a) == is_inside(b));
        for run in runs.filter(|run| is_inside(&run[0])) {
            mark.add_line(&run.iter().map(|[u, v]| patches.at(*u, *v)).collect::<Vec<_>>(), false);
        }
    };
    let held = surface.knots().each_ref().map(|k| {
        let (from, to) = k.domain();
        let apart = MIN_LINE_DISTANCE * (to - from);
        let mut drawn = vec![from];
        for t in k.distinct() {
            if drawn.last().is_some_and(|last| t - last >= apart) && to - t >= apart {
                drawn.push(t);
            }
        }
        drawn.push(to);
        drawn
    });
    for u in &held[0] {
        add(vs.iter().map(|v| [*u, *v]).collect());
    }
    for v in &held[1] {
        add(us.iter().map(|u| [*u, *v]).collect());
    }
    mark
}

/// The control points and the lines between neighbors.
fn net(surface: &Surface<Point>) -> Mark {
    let [m, n] = surface.counts();
    let points = surface.points();
    let mut mark = Mark { points: points.to_vec(), ..Mark::default() };
    for row in points.chunks(n) {
        mark.add_line(row, false);
    }
    for j in 0..n {
        let column: Vec<Point> = (0..m).map(|i| points[i * n + j]).collect();
        mark.add_line(&column, false);
    }
    mark
}

/// For each drawn vertex whether it lies within the outline.
fn inside(outline: &Outline, [us, vs]: &[Vec<f64>; 2]) -> Vec<bool> {
    us.par_iter().flat_map_iter(|u| vs.iter().map(|v| outline.holds([*u, *v]))).collect()
}

/// The outline on the surface.
fn trim_lines(outline: &Outline, surface: &Surface<Point>) -> Mark {
    /// Places along a curve between two knots.
    const PLACES_PER_SPAN: usize = 4;
    let mut mark = Mark::default();
    for corners in outline.regions.iter().flat_map(|region| region.loops()) {
        let next = corners.iter().cycle().skip(1);
        let side = |(a, b): (&[f64; 2], &[f64; 2])| {
            let curve = surface.over_line(*a, *b);
            let knots = curve.knots().distinct();
            let steps = move |w: &[f64]| -> Vec<f64> {
                (0..PLACES_PER_SPAN)
                    .map(|i| w[0] + (w[1] - w[0]) * i as f64 / PLACES_PER_SPAN as f64)
                    .collect()
            };
            let places: Vec<f64> = knots.windows(2).flat_map(steps).collect();
            places.into_iter().map(move |t| curve.at(t))
        };
        mark.add_line(&corners.iter().zip(next).flat_map(side).collect::<Vec<_>>(), true);
    }
    mark
}
