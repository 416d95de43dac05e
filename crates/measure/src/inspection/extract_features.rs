//! Taking the features of a plan from the measured data.

use super::data::Data;
use super::derived::derived;
use super::edge;
use super::nominals::Nominals;
use super::parted::{OfFeature, Parted};
use super::stop::Stop;
use crate::characteristic::{Element, MeasuredFeature, NoElement, Others};
use crate::plan::Plan;
use crate::requirement::{Feature, Source};
use trueness_document::plan::Class;
use trueness_geom::feature::{FeatureError, Found, Nominal, covered, farthest_covered};
use trueness_geom::fit::{FitError, Options, fit};
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::Progress;
use trueness_geom::scan::Scan;
use trueness_geom::shape::Kind;
use trueness_geom::space::{Point, Vector, cross, dot, minus, norm, unit};
use trueness_geom::spatial::neighbors::PointTree;
use trueness_geom::zone::mean;

/// From this angle to its nominal on an element is another one that goes through the points as well, radians.
const MAX_TURN: f64 = std::f64::consts::FRAC_PI_4;

/// All features of the plan, in its order.
pub(super) fn features(
    plan: &Plan,
    (data, measured): (&Data, Option<&Scan>),
    nominals: &Nominals,
    parted: Option<&Parted>,
    progress: &dyn Progress,
) -> Result<Vec<MeasuredFeature>, Stop> {
    let farthest = match measured {
        Some(Scan::Cloud(points)) if plan.features.iter().any(Feature::is_sought) => {
            farthest_covered(points, &PointTree::new(points))
        }
        _ => f64::INFINITY,
    };
    let search = Search { measured, parted, farthest };
    let of = |(number, feature): (usize, &Feature)| {
        if progress.cancelled() {
            return Err(Stop::Cancelled);
        }
        let taken = match &feature.source {
            Source::Derived { .. } => return Ok(None),
            Source::Points(_) => {
                let mut taken = bare(feature);
                if let Some(own) = data.points.get(&number) {
                    (taken.points, taken.planar) = (own.points.clone(), own.planar);
                }
                taken.areas = vec![1.0; taken.points.len()];
                taken
            }
            Source::Nominal | Source::Seed(_) | Source::Faces(_) => {
                found((number, feature), nominals, &search)?
            }
        };
        associated(taken, feature, progress).map(Some)
    };
    let own: Vec<Option<MeasuredFeature>> =
        plan.features.par_iter().enumerate().map(of).collect::<Result<_, Stop>>()?;
    let mut all: Vec<MeasuredFeature> = Vec::with_capacity(plan.features.len());
    for (feature, own) in plan.features.iter().zip(own) {
        let made = |how, a: usize, b: usize| derived(bare(feature), how, &all[a], &all[b]);
        let taken = match (own, &feature.source) {
            (Some(taken), _) => taken,
            (None, Source::Derived { how, of: [a, b] }) => made(*how, *a, *b),
            (None, _) => bare(feature),
        };
        all.push(taken);
    }
    Ok(all)
}

/// The features with the points of which it is not certain that they are of other surfaces; `None` where there are none.
pub(super) fn with_others(
    plan: &Plan,
    features: &[MeasuredFeature],
    progress: &dyn Progress,
) -> Result<Option<Vec<MeasuredFeature>>, Stop> {
    if features.iter().all(|f| f.others.points.is_empty()) {
        return Ok(None);
    }
    let with_others = |taken: &mut MeasuredFeature| {
        let any = !taken.others.points.is_empty();
        if any {
            taken.points.append(&mut taken.others.points);
            taken.areas = vec![1.0; taken.points.len()];
        }
        any
    };
    associated_anew(plan, features, with_others, progress).map(Some)
}

/// The same features with points as `change` makes them; those that it says it has not changed stay as they are, as do those without
/// points.
pub(super) fn associated_anew(
    plan: &Plan,
    features: &[MeasuredFeature],
    mut change: impl FnMut(&mut MeasuredFeature) -> bool,
    progress: &dyn Progress,
) -> Result<Vec<MeasuredFeature>, Stop> {
    let mut all: Vec<MeasuredFeature> = Vec::with_capacity(features.len());
    for (feature, taken) in plan.features.iter().zip(features) {
        all.push(match &feature.source {
            Source::Derived { how, of: [a, b] } => derived(bare(feature), *how, &all[*a], &all[*b]),
            _ if taken.points.is_empty() => taken.clone(),
            _ => {
                let mut taken = taken.clone();
                if change(&mut taken) { associated(taken, feature, progress)? } else { taken }
            }
        });
    }
    Ok(all)
}

/// What features are sought with.
struct Search<'a> {
    /// The measured mesh, or the distinct places of a cloud.
    measured: Option<&'a Scan>,
    /// That parted among faces.
    parted: Option<&'a Parted<'a>>,
    /// How far at most one point of a cloud covers a feature, mm.
    farthest: f64,
}

/// The direction out of the material that a nominal has.
pub(super) fn normal(nominal: &Nominal) -> Option<Vector> {
    match nominal {
        Nominal::Plane { normal, .. } => Some(*normal),
        _ => None,
    }
}

/// A feature that nothing was found of yet.
pub(super) fn bare(feature: &Feature) -> MeasuredFeature {
    let normal = feature.nominal.as_ref().and_then(normal);
    let edge = matches!(feature.nominal, Some(Nominal::Edge { .. }));
    MeasuredFeature {
        id: feature.id.clone(),
        class: feature.class,
        points: vec![],
        rim: vec![],
        areas: vec![],
        facets: vec![],
        planar: false,
        edge,
        outward: feature.outward.or(normal),
        internal: feature.internal,
        inward: feature.internal,
        nominal: feature.nominal.clone(),
        coverage: None,
        left_out: None,
        others: Others::default(),
        element: Err(NoElement::NotSought),
    }
}

/// The points that the measured data have where the model has the feature.
fn found(
    (number, feature): (usize, &Feature),
    nominals: &Nominals,
    search: &Search,
) -> Result<MeasuredFeature, Stop> {
    let mut taken = bare(feature);
    let located = nominals.located.get(&number);
    if let Some(located) = located {
        taken.nominal = Some(located.nominal.clone());
        taken.outward = taken.outward.or(normal(&located.nominal));
    }
    let (Some(scan), Some(nominal)) = (search.measured, taken.nominal.clone()) else { return Ok(taken) };
    let mut near = feature.near(&nominal);
    let own = search.parted.and_then(|parted| Some((parted, parted.own(number)?)));
    near.inward = near.inward.or(own.and_then(|(_, own)| own.inward));
    taken.inward = near.inward;
    let of = match own {
        Some((parted, own)) => parted.of((number, own), (&nominal, &near), feature.extract.outliers),
        None => edge::of(scan, &nominal, &near),
    };
    let wrong = |e: FeatureError| format!("feature \"{}\": {e}", feature.id);
    let of = of.map_err(|e| Stop::Plan { span: feature.span.clone(), what: wrong(e) })?;
    let OfFeature { found, covering, others, left_out } = of;
    (taken.others, taken.left_out) = (others, left_out);
    let places = |vertices: &[u32]| -> Vec<Point> {
        vertices.iter().filter_map(|v| scan.points().get(*v as usize).copied()).collect()
    };
    (taken.points, taken.rim) = (places(&found.points), places(&found.rim));
    taken.areas = areas(scan, &found);
    let area = match scan {
        Scan::Mesh(_) => Some(found.area),
        Scan::Cloud(_) => {
            let covering = covering.map_or_else(|| taken.points.clone(), |points| places(&points));
            covered(&nominal, &covering, search.farthest)
                .zip(nominal.area())
                .map(|(share, area)| share * area)
        }
    };
    let whole = located.map(|l| l.area).or_else(|| nominal.area());
    // Noise makes facets larger than what they lie on.
    taken.coverage = area.zip(whole).map(|(area, whole)| (area / whole).clamp(0.0, 1.0) + 0.0);
    taken.facets = found.facets;
    Ok(taken)
}

/// The area that each point stands for: a third of the feature's facets about it.
fn areas(scan: &Scan, found: &Found) -> Vec<f64> {
    let Some(mesh) = scan.mesh().filter(|_| !found.facets.is_empty()) else {
        return vec![1.0; found.points.len()];
    };
    let mut areas = vec![0.0; found.points.len()];
    for face in found.facets.iter().filter_map(|f| mesh.faces.get(*f as usize)) {
        let [a, b, c] = face.map(|v| mesh.positions[v as usize]);
        let third = norm(cross(minus(b, a), minus(c, a))) / 6.0;
        for v in face {
            if let Ok(place) = found.points.binary_search(v) {
                areas[place] += third;
            }
        }
    }
    areas
}

/// Why no point is of a feature.
fn no_points(taken: &MeasuredFeature, feature: &Feature) -> NoElement {
    match (feature.is_sought(), taken.others.edge) {
        (true, _) if !taken.facets.is_empty() => NoElement::OnRim,
        (true, 0) => NoElement::NotThere { has_margin: feature.extract.has_margin() },
        (true, points) => NoElement::OnRoundedEdges { points },
        (false, _) => NoElement::EmptyFile,
    }
}

/// The feature with the element of its points, or the reason why it has none.
pub(super) fn associated(
    mut taken: MeasuredFeature,
    feature: &Feature,
    progress: &dyn Progress,
) -> Result<MeasuredFeature, Stop> {
    if taken.points.is_empty() {
        taken.element = Err(no_points(&taken, feature));
        return Ok(taken);
    }
    let required = feature.extract.coverage;
    if let Some(share) = taken.coverage.filter(|share| *share < required) {
        taken.element = Err(NoElement::Coverage { share, required });
        return Ok(taken);
    }
    let kind = match taken.class {
        Class::Point => {
            taken.element = Ok(Element::Point(mean(&taken.points)));
            return Ok(taken);
        }
        Class::Line if taken.planar => Kind::Line2,
        Class::Line => Kind::Line,
        Class::Plane => Kind::Plane,
        Class::Circle if taken.planar => Kind::Circle2,
        Class::Circle => Kind::Circle,
        Class::Sphere => Kind::Sphere,
        Class::Cylinder => Kind::Cylinder,
        Class::Cone => Kind::Cone,
        Class::Torus => Kind::Torus,
    };
    let options = Options { method: feature.method, ..Options::default() };
    let along = taken.nominal.as_ref().and_then(Nominal::direction).and_then(unit);
    taken.element = match fit(&taken.points, kind, &options, progress) {
        Ok(fit) => {
            let turned = fit.shape.direction().zip(along).map(|(is, (shall, _))| dot(is, shall).abs());
            match turned.map(|cosine| libm::acos(cosine.min(1.0))).filter(|angle| *angle > MAX_TURN) {
                Some(angle) => Err(NoElement::Turned { kind, angle }),
                None => Ok(Element::Fit(Box::new(fit))),
            }
        }
        Err(FitError::Cancelled) => return Err(Stop::Cancelled),
        Err(e @ FitError::NoSuchMethod { .. }) => {
            let what = format!("feature \"{}\": {e}", feature.id);
            return Err(Stop::Plan { span: feature.span.clone(), what });
        }
        Err(e) => Err(NoElement::Fit(e)),
    };
    Ok(taken)
}

#[cfg(test)]
mod tests {
    use crate::inspection::data::Data;
    use crate::inspection::run;
    use crate::plan::Plan;
    use trueness_geom::progress::Silent;
    use trueness_geom::scan::Scan;
    use trueness_geom::space::Point;

    /// Six points of a bore lie on another cylinder too, of diameter 13.2, whose axis is across; eight on none.
    #[test]
    fn points_on_another_cylinder_do_not_measure_a_bore() {
        let plan = Plan::parse(
            r#"
            schema = "trueness/plan/1"
            measured = "points.xyz"
            [[feature]]
            id = "B"
            shape = "cylinder"
            extract = { distance = 0.4, coverage = 0.0 }
            nominal = { point = [0, 0, 0], direction = [0, 0, 1], radius = 6, length = 20 }
            [[characteristic]]
            id = "1"
            kind = "size"
            size = "GG"
            feature = "B"
            nominal = 12
            lower = -0.1
            upper = 0.1
            "#,
        )
        .unwrap();
        let value = |positions: &[Point]| {
            let measured = Scan::Cloud(positions.to_vec());
            let data = Data { measured: Some(measured), ..Data::default() };
            run(&plan, data, &Silent).unwrap().values.remove(0).map(|v| v.value)
        };
        let six = [
            [6.000, -0.001, 4.999],
            [-3.005, 5.200, 5.002],
            [-3.001, -5.195, 5.001],
            [4.853, 3.529, 14.999],
            [-5.482, 2.439, 15.001],
            [0.627, -5.966, 14.999],
        ];
        let eight = [&six[..], &[[6.0, 0.0, 10.0], [0.0, 6.0, 10.0]]].concat();
        let why = value(&six).unwrap_err().to_string();
        assert!(why.contains("they do not determine it"), "{why}");
        assert!((value(&eight).unwrap() - 12.0).abs() < 0.006);
    }
}
