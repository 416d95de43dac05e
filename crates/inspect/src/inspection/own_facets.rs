//! The facets of the reference that are a feature's own, and which facets of a measured mesh they tell to be of it.
//!
//! The nominal form alone does not tell a pocket that was cut by mistake from one that is drawn, nor where a plane ends that goes over
//! into a fillet: the reference does. Facets are asked by their middles.

use super::data::Stop;
use super::reference::{ELSEWHERE, NEARER, Reference, WITHIN, height, nearest, normal, part};
use trueness_geom::closest::Tree;
use trueness_geom::feature::{FeatureError, Found, Nearness, Nominal, NominalSurface};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Progress;
use trueness_geom::space::{Aabb, Point, cross, dot, minus, norm, plus, times};
use trueness_geom::spatial::neighbors::PointTree;

/// A facet of the reference may be off the surface of the nominal by this share of the distance up to which points are sought.
const ON: f64 = 1e-3;
/// So many times as far as half of the face, by area, lies off the nominal a facet of it may be off: a nominal may lean, by the digits it
/// is written with.
const LEANS: f64 = 4.0;
/// So many times the angle that a feature allows others of the reference may be turned against it that face as it does.
const ALIKE: f64 = 2.0;
/// An edge was broken or rounded if that reaches no farther into the feature than so many times the distance up to which points are sought: a little more
/// than once, for the border is known by places half of it apart.
const BROKEN: f64 = 1.1;
/// Most steps along an edge.
const STEPS: f64 = 1e4;

/// The facets of the reference that lie on the surface of a nominal and within its bounds: all of the face counts, however its facets
/// lie to the margin.
pub(super) struct OwnFacets {
    pub(super) surface: NominalSurface,
    pub(super) near: Nearness,
    /// So far off the surface a facet of the face may be, mm.
    limit: f64,
    /// The side of the surface that they face: its normal's if above zero.
    pub(super) side: f64,
    /// Of a cylinder, cone or sphere, whether they face its axis or center.
    pub(super) inward: Option<bool>,
    /// Their numbers, ascending.
    numbers: Vec<u32>,
    /// Those within the margin.
    within: Vec<u32>,
    pub(super) mesh: Mesh,
    pub(super) tree: Tree,
}

impl OwnFacets {
    /// `None` where the reference has none: of an edge, and where the nominal is off the reference.
    ///
    /// Cost: some looks at each facet of the reference near the feature, and a search tree of its own.
    pub(super) fn new(
        reference: &Reference,
        nominal: &Nominal,
        near: &Nearness,
        progress: &dyn Progress,
    ) -> Result<Option<OwnFacets>, Stop> {
        let Some(surface) = nominal.surface() else { return Ok(None) };
        let Reference { mesh: model, search, rounding, .. } = reference;
        let limit = (ON * near.distance).max(*rounding);
        let of = |near: &Nearness| -> Result<(Vec<u32>, f64), Stop> {
            let found = search.find(nominal, near, progress);
            let Some(found) = some(found)? else { return Ok((vec![], limit)) };
            let limit = (LEANS * middle_off(model, &surface, &found)).max(limit);
            // Those joined to where it is begun, and those that lie apart, beyond a groove or a slot.
            let mut all = some(search.apart(&found, nominal, near, progress))?.unwrap_or_default();
            all.extend(&found.facets);
            all.retain(|f| self::off(model, &surface, *f) <= limit);
            all.sort_unstable();
            Ok((all, limit))
        };
        let (numbers, limit) = of(&Nearness { margin: -near.distance, ..*near })?;
        let (within, _) = of(near)?;
        if numbers.is_empty() {
            return Ok(None);
        }
        let side = numbers.iter().map(|f| outward(model, &surface, *f).signum()).sum::<f64>().signum();
        let inward = (!matches!(nominal, Nominal::Plane { .. }) && side != 0.0).then_some(side < 0.0);
        let mesh = part(model, &numbers);
        let tree = Tree::build_watched(&mesh, progress).map_err(|e| Stop::Mesh(e.to_string()))?;
        Ok(Some(OwnFacets { surface, near: *near, limit, side, inward, numbers, within, mesh, tree }))
    }

    /// Whether a facet of the reference is one of them.
    pub(super) fn has(&self, facet: u32) -> bool {
        self.numbers.binary_search(&facet).is_ok()
    }

    /// Whether a facet of the reference is one of those within the margin.
    pub(super) fn has_within(&self, facet: u32) -> bool {
        self.within.binary_search(&facet).is_ok()
    }

    /// Whether a facet of the reference lies on the surface of the nominal, however it was cut into facets. The ground of a shallow pocket
    /// and the begin of a fillet are within its reach, and not on it.
    fn is_on(&self, model: &Mesh, facet: u32) -> bool {
        off(model, &self.surface, facet) <= self.limit
    }

    /// Whether each of these places, of facets that face as the feature does, is of it.
    pub(super) fn are_own(
        &self,
        reference: &Reference,
        places: &[Point],
        progress: &dyn Progress,
    ) -> Result<Vec<bool>, Stop> {
        let beside = self.beside(reference, places, progress)?;
        let nearer = self.nearer(reference, places, progress)?;
        Ok(nearer.into_iter().zip(beside).map(|(nearer, beside)| nearer && !beside).collect())
    }

    /// Whether each of these places is nearer to the feature than to others of the reference that face as it does, as the ground of a pocket.
    fn nearer(
        &self,
        reference: &Reference,
        places: &[Point],
        progress: &dyn Progress,
    ) -> Result<Vec<bool>, Stop> {
        let own = nearest(&self.tree, places, f64::INFINITY, progress)?;
        let reach = own.iter().map(|(_, off)| *off).fold(0.0, f64::max);
        let model = reference.mesh;
        let cosine = libm::cos(ALIKE * self.near.angle);
        let mut alike = reference.tree().in_box(&Aabb::of(places).widened(reach));
        alike.retain(|f| !self.is_on(model, *f) && self.side * outward(model, &self.surface, *f) >= cosine);
        if alike.is_empty() {
            return Ok(vec![true; places.len()]);
        }
        let mesh = part(model, &alike);
        let tree = Tree::build_watched(&mesh, progress).map_err(|e| Stop::Mesh(e.to_string()))?;
        let others = nearest(&tree, places, f64::INFINITY, progress)?;
        Ok(own.into_iter().zip(others).map(|(own, other)| own.1 <= other.1).collect())
    }

    /// Whether each of these places is of a face of the reference beside the feature: beyond where this ends, and clearly nearer to that
    /// face, as on a fillet that leaves it as a tangent.
    fn beside(
        &self,
        reference: &Reference,
        places: &[Point],
        progress: &dyn Progress,
    ) -> Result<Vec<bool>, Stop> {
        let on_all = nearest(reference.tree(), places, f64::INFINITY, progress)?;
        let is_other = |n: &usize| on_all[*n].0 != u32::MAX && !self.is_on(reference.mesh, on_all[*n].0);
        let asked: Vec<usize> = (0..places.len()).filter(is_other).collect();
        let of: Vec<Point> = asked.iter().map(|n| places[*n]).collect();
        let mut beside = vec![false; places.len()];
        for (n, own) in asked.into_iter().zip(nearest(&self.tree, &of, f64::INFINITY, progress)?) {
            beside[n] = self.ends_before(places[n], own, on_all[n].1);
        }
        Ok(beside)
    }

    /// Whether the feature ends before a place that is `off` another face, and that one is clearly nearer; `own` is the nearest facet of the
    /// feature with its distance. At a sharp edge that is off its place both are as near.
    pub(super) fn ends_before(&self, place: Point, own: (u32, f64), off: f64) -> bool {
        let (facet, away) = own;
        let over = height(&self.mesh, facet, place).abs();
        let aside = (away * away - over * over).max(0.0).sqrt();
        aside > over && NEARER * off <= away
    }

    /// Whether each of these places is so much nearer to another face of the reference, whichever way it faces, that it is of that one: the ledge of a band
    /// on a shaft faces as the shoulder beside it.
    pub(super) fn are_of_others(
        &self,
        reference: &Reference,
        places: &[Point],
        progress: &dyn Progress,
    ) -> Result<Vec<bool>, Stop> {
        let own = nearest(&self.tree, places, f64::INFINITY, progress)?;
        let all = nearest(reference.tree(), places, f64::INFINITY, progress)?;
        Ok(own.into_iter().zip(all).map(|(own, all)| WITHIN * all.1 <= own.1).collect())
    }

    /// Whether each of these places lies over the feature, farther inside than its `distance` from where it ends, or outside the
    /// material: edges that were broken or rounded are within that distance, and lack material.
    pub(super) fn over(
        &self,
        reference: &Reference,
        places: &[Point],
        progress: &dyn Progress,
    ) -> Result<Vec<bool>, Stop> {
        if places.is_empty() {
            return Ok(vec![]);
        }
        let Reference { mesh, size, rounding, .. } = reference;
        let edge = BROKEN * self.near.distance;
        let border = PointTree::new(&along_border(&self.mesh, 0.5 * self.near.distance));
        let inside = |p: &Point| border.nearest(p).is_none_or(|(square, _)| square > edge * edge);
        let hits = nearest(reference.tree(), places, ELSEWHERE * size, progress)?;
        let over = |(p, (face, _)): (&Point, (u32, f64))| {
            self.has(face) && (inside(p) || height(mesh, face, *p) > *rounding)
        };
        Ok(places.iter().zip(hits).map(over).collect())
    }
}

/// What was found, `None` of a nominal that makes no sense: who seeks it in the measured data is told.
fn some<T>(found: Result<T, FeatureError>) -> Result<Option<T>, Stop> {
    match found {
        Err(FeatureError::Cancelled) => Err(Stop::Cancelled),
        found => Ok(found.ok()),
    }
}

/// How far the farthest corner of a facet is off a surface.
fn off(mesh: &Mesh, surface: &NominalSurface, facet: u32) -> f64 {
    let of = |v: u32| surface.distance(mesh.positions[v as usize]).map_or(0.0, |d| d.0.abs());
    mesh.faces[facet as usize].iter().map(|v| of(*v)).fold(0.0, f64::max)
}

/// How far off a surface those facets are that have half of the area of what was found.
fn middle_off(mesh: &Mesh, surface: &NominalSurface, found: &Found) -> f64 {
    let area = |f: u32| {
        let [a, b, c] = mesh.faces[f as usize].map(|v| mesh.positions[v as usize]);
        0.5 * norm(cross(minus(b, a), minus(c, a)))
    };
    let mut all: Vec<(f64, f64)> = found.facets.iter().map(|f| (off(mesh, surface, *f), area(*f))).collect();
    all.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let mut left = 0.5 * found.area;
    let middle = all.iter().find(|(_, area)| {
        left -= area;
        left <= 0.0
    });
    middle.or(all.last()).map_or(0.0, |middle| middle.0)
}

/// Cosine of the angle between a facet's normal and that of a surface there; 0 of one without area.
fn outward(mesh: &Mesh, surface: &NominalSurface, facet: u32) -> f64 {
    let [a, b, c] = mesh.faces[facet as usize].map(|v| mesh.positions[v as usize]);
    let way = surface.distance(times(1.0 / 3.0, plus(a, plus(b, c))));
    way.zip(normal(mesh, facet)).map_or(0.0, |((_, way), facing)| dot(way, facing))
}

/// Places along the edges of a mesh that one facet alone has, no farther apart than `step`.
fn along_border(mesh: &Mesh, step: f64) -> Vec<Point> {
    let mut sides: Vec<[u32; 2]> = (mesh.faces.iter())
        .flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]])
        .map(|[a, b]| [*a.min(b), *a.max(b)])
        .collect();
    sides.sort_unstable();
    let mut places = vec![];
    for edge in sides.chunk_by(|a, b| a == b).filter(|edge| edge.len() == 1).map(|edge| edge[0]) {
        let [a, b] = edge.map(|v| mesh.positions[v as usize]);
        let steps = (norm(minus(b, a)) / step).ceil().clamp(1.0, STEPS);
        places.extend((0..=steps as u32).map(|k| plus(a, times(f64::from(k) / steps, minus(b, a)))));
    }
    places
}
