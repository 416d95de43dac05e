//! Taking the features of a plan from the measured data.

use super::belonging::Belonging;
use super::data::{Data, Stop};
use super::deeper::deeper;
use super::derived::derived;
use super::of_others::OfOthers;
use super::own_facets::OwnFacets;
use super::seed::Seeded;
use crate::characteristic::{Element, Others, Taken};
use crate::plan::{Class, Feature, Plan, Source};
use std::collections::BTreeMap;
use trueness_geom::closest::Tree;
use trueness_geom::feature::{
    FeatureError, FeatureSearch, Found, Nearness, Nominal, Piece, covered, farthest_covered, in_cloud,
    pieces_beside,
};
use trueness_geom::fit::{FitError, Options, fit};
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::Progress;
use trueness_geom::shape::Kind;
use trueness_geom::space::{Point, Vector, cross, dot, minus, norm, unit};
use trueness_geom::spatial::neighbors::PointTree;
use trueness_geom::zone::datum::mean;

/// From this angle to its nominal on an element is another one that goes through the points as well, radians.
const TURNED: f64 = std::f64::consts::FRAC_PI_4;

/// All features of the plan, in its order.
pub(super) fn features(
    plan: &Plan,
    data: &Data,
    seeds: &BTreeMap<usize, Seeded>,
    belonging: Option<&Belonging>,
    progress: &dyn Progress,
) -> Result<Vec<Taken>, Stop> {
    let sought = plan.features.iter().any(|f| matches!(f.source, Source::Nominal | Source::Seed(_)));
    let facets = match &data.measured {
        Some(mesh) if sought && !mesh.faces.is_empty() => {
            let tree = Tree::build_watched(mesh, progress).map_err(|e| Stop::Mesh(e.to_string()))?;
            Some(FeatureSearch::new(mesh, tree))
        }
        _ => None,
    };
    let cloud = data.measured.as_ref().filter(|mesh| sought && mesh.faces.is_empty());
    let cloud = cloud.map(|mesh| Cloud::new(&mesh.positions));
    let search = Search { facets: facets.as_ref(), cloud: cloud.as_ref(), belonging };
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
            Source::Nominal | Source::Seed(_) => {
                found((number, feature), seeds.get(&number), data, &search, progress)?
            }
        };
        associated(taken, feature, progress).map(Some)
    };
    let own: Vec<Option<Taken>> =
        plan.features.par_iter().enumerate().map(of).collect::<Result<_, Stop>>()?;
    let mut all: Vec<Taken> = Vec::with_capacity(plan.features.len());
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
pub(super) fn whole(
    plan: &Plan,
    features: &[Taken],
    progress: &dyn Progress,
) -> Result<Option<Vec<Taken>>, Stop> {
    if features.iter().all(|f| f.others.points.is_empty()) {
        return Ok(None);
    }
    let with_others = |taken: &mut Taken| {
        let any = !taken.others.points.is_empty();
        if any {
            taken.points.append(&mut taken.others.points);
            taken.areas = vec![1.0; taken.points.len()];
        }
        any
    };
    again(plan, features, with_others, progress).map(Some)
}

/// The same features with points as `change` makes them; those that it says it has not changed stay as they are, as do those without
/// points.
pub(super) fn again(
    plan: &Plan,
    features: &[Taken],
    mut change: impl FnMut(&mut Taken) -> bool,
    progress: &dyn Progress,
) -> Result<Vec<Taken>, Stop> {
    let mut all: Vec<Taken> = Vec::with_capacity(features.len());
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
    /// Of a mesh.
    facets: Option<&'a FeatureSearch<'a>>,
    /// Of a cloud.
    cloud: Option<&'a Cloud>,
    belonging: Option<&'a Belonging<'a>>,
}

/// The points of a cloud, each place once: copies tell nothing new, and neighbors that are copies tell nothing at all.
struct Cloud {
    places: Vec<Point>,
    /// Their numbers in the cloud; of copies the first.
    numbers: Vec<u32>,
    tree: PointTree,
    /// How far at most one of them covers a feature, mm.
    farthest: f64,
}

impl Cloud {
    fn new(points: &[Point]) -> Cloud {
        // Minus zero is zero.
        let key = |n: &u32| points[*n as usize].map(|x| (x + 0.0).to_bits());
        let mut numbers: Vec<u32> = (0..points.len() as u32).collect();
        numbers.par_sort_unstable_by_key(|n| (key(n), *n));
        numbers.dedup_by_key(|n| key(n));
        numbers.sort_unstable();
        let places: Vec<Point> = numbers.iter().map(|n| points[*n as usize]).collect();
        let tree = PointTree::new(&places);
        Cloud { farthest: farthest_covered(&places, &tree), tree, places, numbers }
    }

    fn number(&self, place: u32) -> u32 {
        self.numbers[place as usize]
    }
}

/// Takes the points of other surfaces out of those of a cloud near a nominal, which come with the numbers of their places and leave
/// with their own.
fn others(
    points: &mut Vec<u32>,
    measured: &[Point],
    (cloud, reference): (&Cloud, Option<OfOthers>),
    (nominal, near): (&Nominal, &Nearness),
    progress: &dyn Progress,
) -> Result<Others, Stop> {
    // Of all points: those of a wall that lie upon the reference tell where the others are that noise has carried off it.
    let beside = pieces_beside(&cloud.places, &cloud.tree, points, nominal, near, progress);
    let mut pieces = beside.map_err(|e| match e {
        FeatureError::Cancelled => Stop::Cancelled,
        e => Stop::Mesh(e.to_string()),
    })?;
    points.iter_mut().for_each(|p| *p = cloud.number(*p));
    pieces.iter_mut().flat_map(|piece| &mut piece.points).for_each(|p| p.0 = cloud.number(p.0));
    let of_pieces = |pieces: &[Piece]| -> Vec<u32> {
        pieces.iter().flat_map(|piece| piece.points.iter().map(|p| p.0)).collect()
    };
    let (mut out, mut doubted) = match &reference {
        None => (vec![], of_pieces(&pieces)),
        Some(reference) => {
            let mut pieces = of_pieces(&reference.known(pieces)?);
            let [mut out, mut doubted] = reference.upon(points)?;
            without(&mut doubted, &pieces);
            without(&mut pieces, &out);
            without(points, &[&out[..], &doubted, &pieces].concat());
            let [of_faces, beyond] = reference.at_edges(points, &[&pieces[..], &doubted].concat())?;
            without(&mut pieces, &beyond);
            out.extend(pieces.into_iter().chain(of_faces));
            without(&mut doubted, &out);
            doubted.extend(beyond);
            (out, doubted)
        }
    };
    for numbers in [&mut out, &mut doubted] {
        numbers.sort_unstable();
        numbers.dedup();
        without(points, numbers);
    }
    let known = out.len();
    let points = doubted.iter().filter_map(|p| measured.get(*p as usize).copied()).collect();
    Ok(Others { points, known, on_reference: reference.is_some() })
}

/// Takes some numbers out of others.
fn without(numbers: &mut Vec<u32>, out: &[u32]) {
    let mut out = out.to_vec();
    out.sort_unstable();
    numbers.retain(|n| out.binary_search(n).is_err());
}

/// The facets of a measured mesh, to be judged by those that the reference has of the feature.
struct OfMesh<'a> {
    mesh: &'a Mesh,
    facets: &'a FeatureSearch<'a>,
    nominal: &'a Nominal,
    near: &'a Nearness,
    belonging: Option<&'a Belonging<'a>>,
    own: Option<&'a OwnFacets>,
}

impl OfMesh<'_> {
    /// What was found without what is of faces beside the feature and with what lies apart from it and is of it; and points of what nothing
    /// tells.
    fn judged(&self, mut found: Found, progress: &dyn Progress) -> Result<(Found, Others), Stop> {
        let OfMesh { facets, nominal, near, .. } = *self;
        let places = |of: &[u32]| -> Vec<Point> { of.iter().map(|f| mean(&self.corners(*f))).collect() };
        let which = |of: &[u32], is: Vec<bool>| -> Vec<u32> {
            of.iter().zip(is).filter(|(_, is)| *is).map(|(f, _)| *f).collect()
        };
        let failed = |e| match e {
            FeatureError::Cancelled => Stop::Cancelled,
            e => Stop::Mesh(e.to_string()),
        };
        let told = self.belonging.map(|b| &b.reference).zip(self.own);
        if let Some((reference, own)) = told {
            let kept = which(&found.facets, own.are_own(reference, &places(&found.facets), progress)?);
            if kept.len() < found.facets.len() {
                found = facets.of(&kept, near);
            }
        }
        let apart = facets.apart(&found, nominal, near, progress).map_err(failed)?;
        let (joined, mut others) = match (told, self.belonging) {
            (Some((reference, own)), _) => {
                let own_ones = which(&apart, own.are_own(reference, &places(&apart), progress)?);
                let of_others = own.are_of_others(reference, &places(&own_ones), progress)?;
                (which(&own_ones, of_others.into_iter().map(|is| !is).collect()), vec![])
            }
            (None, Some(_)) => (apart, vec![]),
            (None, None) => (vec![], apart),
        };
        if !joined.is_empty() {
            found = facets.joined(&found, &joined, near);
        }
        if let Some((reference, own)) = told {
            let slopes = facets.slopes(&found, nominal, near, progress).map_err(failed)?;
            others.extend(which(&slopes, own.over(reference, &places(&slopes), progress)?));
        }
        let points = facets.joined(&Found::default(), &others, near).points;
        let points = points.iter().map(|v| self.mesh.positions[*v as usize]).collect();
        Ok((found, Others { points, known: 0, on_reference: self.belonging.is_some() }))
    }

    fn corners(&self, facet: u32) -> [Point; 3] {
        self.mesh.faces[facet as usize].map(|v| self.mesh.positions[v as usize])
    }
}

/// The direction out of the material that a nominal has.
pub(super) fn normal(nominal: &Nominal) -> Option<Vector> {
    match nominal {
        Nominal::Plane { normal, .. } => Some(*normal),
        _ => None,
    }
}

/// A feature that nothing was found of yet.
pub(super) fn bare(feature: &Feature) -> Taken {
    let normal = feature.nominal.as_ref().and_then(normal);
    let edge = matches!(feature.nominal, Some(Nominal::Edge { .. }));
    Taken {
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
        element: Err("it was not measured".into()),
    }
}

/// The points that the measured data have where the model has the feature.
fn found(
    (number, feature): (usize, &Feature),
    seeded: Option<&Seeded>,
    data: &Data,
    search: &Search,
    progress: &dyn Progress,
) -> Result<Taken, Stop> {
    let mut taken = bare(feature);
    if let Some(seeded) = seeded {
        taken.nominal = Some(seeded.nominal.clone());
        taken.outward = taken.outward.or(normal(&seeded.nominal));
    }
    let (Some(mesh), Some(nominal)) = (&data.measured, taken.nominal.clone()) else { return Ok(taken) };
    let mut near = feature.near(&nominal);
    let own = search.belonging.and_then(|belonging| belonging.own(number));
    // The wall of a tube has a face within reach on its other side.
    near.inward = near.inward.or(own.and_then(|own| own.inward));
    taken.inward = near.inward;
    let found = match (search.facets, search.cloud) {
        (Some(facets), _) => facets.find(&nominal, &near, progress),
        (None, Some(cloud)) => in_cloud(&cloud.places, &nominal, &near),
        (None, None) => Ok(Found::default()),
    };
    let stop = |e| match e {
        FeatureError::Cancelled => Stop::Cancelled,
        e => Stop::Plan { span: feature.span.clone(), what: format!("feature \"{}\": {e}", feature.id) },
    };
    let mut found = found.map_err(stop)?;
    if let Some(facets) = search.facets {
        let of_mesh =
            OfMesh { mesh, facets, nominal: &nominal, near: &near, belonging: search.belonging, own };
        (found, taken.others) = of_mesh.judged(found, progress)?;
    }
    if let (Some(facets), None) = (search.facets, search.belonging) {
        taken.left_out = deeper(mesh, facets, &found, (&nominal, &near), progress).map_err(stop)?;
    }
    if let Some(cloud) = search.cloud {
        let reference = search.belonging.zip(own);
        let reference =
            reference.map(|(belonging, own)| OfOthers { belonging, own, spacing: cloud.farthest, progress });
        let with = (cloud, reference);
        taken.others = others(&mut found.points, &mesh.positions, with, (&nominal, &near), progress)?;
    }
    let places = |vertices: &[u32]| -> Vec<Point> {
        vertices.iter().filter_map(|v| mesh.positions.get(*v as usize).copied()).collect()
    };
    (taken.points, taken.rim) = (places(&found.points), places(&found.rim));
    taken.areas = areas(mesh, &found);
    let farthest = search.cloud.map_or(f64::INFINITY, |cloud| cloud.farthest);
    let area = match search.facets {
        Some(_) => Some(found.area),
        None => {
            covered(&nominal, &taken.points, farthest).zip(nominal.area()).map(|(share, area)| share * area)
        }
    };
    let whole = seeded.map(|s| s.area).or_else(|| nominal.area());
    // Noise makes facets larger than what they lie on.
    taken.coverage = area.zip(whole).map(|(area, whole)| (area / whole).clamp(0.0, 1.0));
    taken.facets = found.facets;
    Ok(taken)
}

/// The area that each point stands for: a third of the feature's facets about it.
fn areas(mesh: &Mesh, found: &Found) -> Vec<f64> {
    if found.facets.is_empty() {
        return vec![1.0; found.points.len()];
    }
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

/// The feature with the element of its points, or the reason why it has none.
pub(super) fn associated(
    mut taken: Taken,
    feature: &Feature,
    progress: &dyn Progress,
) -> Result<Taken, Stop> {
    if taken.points.is_empty() {
        taken.element = Err(match feature.source {
            Source::Nominal | Source::Seed(_) if !taken.facets.is_empty() => {
                "all of its vertices lie on edges, which rim = false leaves out".into()
            }
            Source::Nominal | Source::Seed(_) => "nothing was measured where the model has it".into(),
            _ => "its file has no points".into(),
        });
        return Ok(taken);
    }
    if let Some(share) = taken.coverage.filter(|share| *share < feature.extract.coverage) {
        taken.element = Err(format!(
            "only {:.1} % of its nominal area was measured, less than {:.1} %",
            100.0 * share,
            100.0 * feature.extract.coverage
        ));
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
            match turned.map(|cosine| libm::acos(cosine.min(1.0))).filter(|angle| *angle > TURNED) {
                Some(angle) => Err(format!(
                    "the {} through its points lies at {:.0}° to the nominal one: they do not determine it; measure more of its surface",
                    kind.name(),
                    angle.to_degrees()
                )),
                None => Ok(Element::Fit(Box::new(fit))),
            }
        }
        Err(FitError::Cancelled) => return Err(Stop::Cancelled),
        Err(e @ FitError::NoSuchMethod { .. }) => {
            let what = format!("feature \"{}\": {e}", feature.id);
            return Err(Stop::Plan { span: feature.span.clone(), what });
        }
        Err(e) => Err(e.to_string()),
    };
    Ok(taken)
}

#[cfg(test)]
mod tests {
    use crate::inspection::data::Data;
    use crate::inspection::run;
    use crate::plan::Plan;
    use trueness_geom::mesh::Mesh;
    use trueness_geom::progress::Silent;
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
            let measured = Mesh { positions: positions.to_vec(), faces: vec![] };
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
        let why = value(&six).unwrap_err();
        assert!(why.contains("they do not determine it"), "{why}");
        assert!((value(&eight).unwrap() - 12.0).abs() < 0.006);
    }
}
