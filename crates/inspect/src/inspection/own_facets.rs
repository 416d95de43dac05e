//! Which facets of a measured mesh are of a feature, as the facets tell that the reference has of it.
//!
//! The nominal form alone does not tell a pocket that was cut by mistake from one that is drawn, nor where a plane ends that goes over
//! into a fillet: the reference does. Facets are asked by their middles.

use super::belonging::{Belonging, ELSEWHERE, NEARER, height, nearest, normal};
use super::data::Stop;
use trueness_geom::closest::Tree;
use trueness_geom::feature::{Nearness, Nominal};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Progress;
use trueness_geom::space::{Point, dot, minus, norm, plus, times};
use trueness_geom::spatial::neighbors::PointTree;

/// So many times the angle that a feature allows others of the reference may be turned against it that face as it does.
const ALIKE: f64 = 2.0;
/// Most steps along an edge.
const STEPS: f64 = 1e4;

/// The facets of the reference that lie on the surface of a nominal and within its bounds.
pub(super) struct OwnFacets<'a> {
    belonging: &'a Belonging<'a>,
    distance: f64,
    /// Of a cylinder, cone or sphere, whether they face its axis or center.
    pub(super) inward: Option<bool>,
    /// For each facet of the reference, whether it lies on the surface of the nominal, however it was cut into facets.
    on_surface: Vec<bool>,
    /// Their numbers, ascending.
    numbers: Vec<u32>,
    own: Part,
    /// Others that face as they do: the ground of a pocket.
    alike: Option<Part>,
}

/// Some facets with their search tree.
struct Part {
    mesh: Mesh,
    tree: Tree,
}

impl Part {
    fn new(mesh: Mesh, progress: &dyn Progress) -> Result<Part, Stop> {
        let tree = Tree::build_watched(&mesh, progress).map_err(|e| Stop::Mesh(e.to_string()))?;
        Ok(Part { mesh, tree })
    }
}

impl<'a> OwnFacets<'a> {
    /// `None` where the reference has none: of an edge, and where the nominal is off the reference.
    ///
    /// Cost: some looks at each facet of the reference, and search trees of those of the nominal.
    pub(super) fn new(
        belonging: &'a Belonging,
        nominal: &Nominal,
        near: &Nearness,
        progress: &dyn Progress,
    ) -> Result<Option<OwnFacets<'a>>, Stop> {
        let Some(surface) = nominal.surface() else { return Ok(None) };
        let reference = belonging.reference;
        let all = 0..reference.faces.len() as u32;
        let on_surface: Vec<bool> = all.clone().map(|f| belonging.is_on(&surface, f, near)).collect();
        let whole = Nearness { margin: -near.distance, ..*near };
        let mut numbers = belonging.facets(nominal, &whole, progress);
        numbers.retain(|f| on_surface[*f as usize]);
        if numbers.is_empty() {
            return Ok(None);
        }
        let outward = |f: u32| {
            let [a, b, c] = reference.faces[f as usize].map(|v| reference.positions[v as usize]);
            let way = surface.distance(times(1.0 / 3.0, plus(a, plus(b, c))));
            way.zip(normal(reference, f)).map_or(0.0, |((_, way), facing)| dot(way, facing))
        };
        let side: f64 = numbers.iter().map(|f| outward(*f).signum()).sum::<f64>().signum();
        let cosine = libm::cos(ALIKE * near.angle);
        let alike = belonging.part(all.filter(|f| !on_surface[*f as usize] && side * outward(*f) >= cosine));
        let alike = if alike.faces.is_empty() { None } else { Some(Part::new(alike, progress)?) };
        let own = Part::new(belonging.part(numbers.iter().copied()), progress)?;
        let inward = (!matches!(nominal, Nominal::Plane { .. }) && side != 0.0).then_some(side < 0.0);
        let distance = near.distance;
        Ok(Some(OwnFacets { belonging, distance, inward, on_surface, numbers, own, alike }))
    }

    /// Whether each of these places, of facets that face as the feature does, is of it.
    pub(super) fn are_own(&self, places: &[Point], progress: &dyn Progress) -> Result<Vec<bool>, Stop> {
        let beside = self.beside(places, progress)?;
        let nearer = self.nearer(places, progress)?;
        Ok(nearer.into_iter().zip(beside).map(|(nearer, beside)| nearer && !beside).collect())
    }

    /// Whether each of these places is nearer to the feature than to others of the reference that face as it does.
    fn nearer(&self, places: &[Point], progress: &dyn Progress) -> Result<Vec<bool>, Stop> {
        let Some(alike) = &self.alike else { return Ok(vec![true; places.len()]) };
        let away = |part: &Part| nearest(&part.tree, places, f64::INFINITY, progress);
        Ok(away(&self.own)?.into_iter().zip(away(alike)?).map(|(own, other)| own.1 <= other.1).collect())
    }

    /// Whether each of these places is of a face of the reference beside the feature: beyond where this ends, and clearly nearer to that
    /// face, as on a fillet that leaves it as a tangent.
    fn beside(&self, places: &[Point], progress: &dyn Progress) -> Result<Vec<bool>, Stop> {
        let on_all = nearest(self.belonging.search.tree(), places, f64::INFINITY, progress)?;
        let is_other = |n: &usize| self.on_surface.get(on_all[*n].0 as usize).is_some_and(|on| !on);
        let asked: Vec<usize> = (0..places.len()).filter(is_other).collect();
        let of: Vec<Point> = asked.iter().map(|n| places[*n]).collect();
        let mut beside = vec![false; places.len()];
        for (n, (face, away)) in asked.into_iter().zip(nearest(&self.own.tree, &of, f64::INFINITY, progress)?)
        {
            let over = height(&self.own.mesh, face, places[n]).abs();
            let aside = (away * away - over * over).max(0.0).sqrt();
            // At a sharp edge that is off its place both are as near.
            beside[n] = aside > over && NEARER * on_all[n].1 <= away;
        }
        Ok(beside)
    }

    /// Whether each of these places lies over the feature, farther inside than its `distance` from where it ends, or outside the
    /// material: edges that were broken or rounded are within that distance, and lack material.
    pub(super) fn over(&self, places: &[Point], progress: &dyn Progress) -> Result<Vec<bool>, Stop> {
        if places.is_empty() {
            return Ok(vec![]);
        }
        let Belonging { reference, size, rounding, search, .. } = self.belonging;
        let distance = self.distance;
        let border = PointTree::new(&along_border(&self.own.mesh, 0.5 * distance));
        let inside =
            |p: &Point| border.nearest(p).is_none_or(|(square, _)| square > 2.0 * distance * distance);
        let hits = nearest(search.tree(), places, ELSEWHERE * size, progress)?;
        let over = |(p, (face, _)): (&Point, (u32, f64))| {
            self.numbers.binary_search(&face).is_ok()
                && (inside(p) || height(reference, face, *p) > *rounding)
        };
        Ok(places.iter().zip(hits).map(over).collect())
    }
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
