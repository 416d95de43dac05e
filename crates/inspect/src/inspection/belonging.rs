//! What of the measured data belongs to a feature of the reference: what is nearest to it.
//!
//! Nearness to a nominal surface alone does not tell the points of a plane from those at the upper end of a wall beside it, nor
//! from the beginning of a fillet. Where the reference is at hand, its facets do: a measured place belongs to a feature if no
//! other facet of the reference is nearer than the feature's own.

use super::data::{Data, Stop};
use super::seed::Seeded;
use crate::plan::Plan;
use std::collections::BTreeMap;
use trueness_geom::closest::{Hit, Query, QueryError, Tree};
use trueness_geom::feature::{Nearness, Nominal, in_mesh};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Progress;
use trueness_geom::space::Point;

/// Facets of a plane lie in it but for this share of the size of the reference; those of a fillet beside it do not.
const PLANE: f64 = 1e-5;
/// Distances that differ by no more than this share of the size of the reference are the same: edges are shared.
const SAME: f64 = 1e-9;

/// A reference, ready to be asked.
pub(super) struct Belonging<'a> {
    reference: &'a Mesh,
    tree: Tree,
    size: f64,
}

impl<'a> Belonging<'a> {
    /// Of the reference, where there is one and a feature is sought by a nominal. Cost: a search tree.
    pub fn new(
        plan: &Plan,
        data: &'a Data,
        seeds: &BTreeMap<usize, Seeded>,
        progress: &dyn Progress,
    ) -> Result<Option<Belonging<'a>>, Stop> {
        let sought = !seeds.is_empty() || plan.features.iter().any(|f| f.nominal.is_some());
        let Some(reference) = data.reference.as_ref().filter(|r| sought && !r.faces.is_empty()) else {
            return Ok(None);
        };
        let tree = Tree::build_watched(reference, progress).map_err(|e| Stop::Mesh(e.to_string()))?;
        Ok(Some(Belonging { reference, tree, size: reference.bounds().diagonal() }))
    }

    /// Size of the reference, mm.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// The facets of the reference that the nominal names, ascending. Of an edge none: its facets are those of its neighbours.
    pub fn facets(
        &self,
        nominal: &Nominal,
        near: &Nearness,
        progress: &dyn Progress,
    ) -> Result<Vec<u32>, Stop> {
        let find = |near: &Nearness| {
            let found = in_mesh(self.reference, &self.tree, nominal, near, progress);
            found.map_or(vec![], |found| found.facets)
        };
        let facets = match nominal {
            Nominal::Edge { .. } => vec![],
            Nominal::Plane { .. } => {
                let exact = find(&Nearness { distance: (PLANE * self.size).min(near.distance), ..*near });
                if exact.is_empty() { find(near) } else { exact }
            }
            _ => find(near),
        };
        if progress.cancelled() { Err(Stop::Cancelled) } else { Ok(facets) }
    }

    /// The nearest facet of the reference to each place and how far off it is, mm; `u32::MAX` beyond `farthest`.
    pub fn nearest(
        &self,
        places: &[Point],
        farthest: f64,
        progress: &dyn Progress,
    ) -> Result<Vec<(u32, f64)>, Stop> {
        nearest(&self.tree, places, farthest, progress)
    }

    /// Which of these places belong to these facets. `shared`: those on an edge that they share with others do too.
    pub fn belong(
        &self,
        places: &[Point],
        facets: &[u32],
        shared: bool,
        progress: &dyn Progress,
    ) -> Result<Vec<bool>, Stop> {
        let all = self.nearest(places, f64::INFINITY, progress)?;
        let is_own = |face: u32| facets.binary_search(&face).is_ok();
        let mut belong: Vec<bool> = all.iter().map(|(face, _)| is_own(*face)).collect();
        let doubtful: Vec<usize> = (0..places.len()).filter(|i| belong[*i] != shared).collect();
        // With shared edges the feature may be as near as the nearest; without them another one may be as near as it.
        let others = |f: &u32| is_own(*f) == shared;
        let kept = (0..self.reference.faces.len() as u32).filter(others);
        let faces: Vec<[u32; 3]> = kept.map(|f| self.reference.faces[f as usize]).collect();
        if doubtful.is_empty() || faces.is_empty() {
            return Ok(belong);
        }
        let mesh = Mesh { positions: self.reference.positions.clone(), faces };
        let tree = Tree::build_watched(&mesh, progress).map_err(|e| Stop::Mesh(e.to_string()))?;
        let asked: Vec<Point> = doubtful.iter().map(|i| places[*i]).collect();
        for (i, (_, off)) in doubtful.into_iter().zip(nearest(&tree, &asked, f64::INFINITY, progress)?) {
            if off <= all[i].1 + SAME * self.size {
                belong[i] = shared;
            }
        }
        Ok(belong)
    }
}

fn nearest(
    tree: &Tree,
    places: &[Point],
    farthest: f64,
    progress: &dyn Progress,
) -> Result<Vec<(u32, f64)>, Stop> {
    let query = Query { max_distance: farthest, ..Query::default() };
    let of = |hit: Option<Hit>| hit.map_or((u32::MAX, 0.0), |h| (h.face, h.distance()));
    tree.map_closest(places, &query, progress, |_, hit| of(hit)).map_err(|e| match e {
        QueryError::Cancelled(_) => Stop::Cancelled,
        e => Stop::Mesh(e.to_string()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inspection::run;
    use trueness_geom::progress::Silent;

    /// A bar along y: its top at z = 0 from x = −10 to 10, then a quarter of a circle of radius 2 in steps of 10°, or a wall.
    fn bar(fillet: bool) -> Mesh {
        let mut profile = vec![[-10.0, -8.0], [-10.0, 0.0], [10.0, 0.0]];
        if fillet {
            let turn = |i: i32| f64::from(10 * i).to_radians();
            profile
                .extend((1..=9).map(|i| [10.0 + 2.0 * libm::sin(turn(i)), 2.0 * libm::cos(turn(i)) - 2.0]));
        }
        let last = profile[profile.len() - 1][0];
        profile.push([last, -8.0]);
        // From fifty to a hundred points along each side, so that every place of the surface is near one.
        let mut mesh = Mesh::default();
        let n = 50u32;
        for side in profile.windows(2) {
            let first = mesh.positions.len() as u32;
            for (i, j) in (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j))) {
                let [s, t] = [i, j].map(|k| f64::from(k) / f64::from(n));
                let [x, z] = [0, 1].map(|k| side[0][k] + s * (side[1][k] - side[0][k]));
                mesh.positions.push([x, 20.0 * t, z]);
                if i < n && j < n {
                    let a = first + i * (n + 1) + j;
                    mesh.faces.extend([[a, a + n + 1, a + 1], [a + 1, a + n + 1, a + n + 2]]);
                }
            }
        }
        mesh
    }

    fn flatness(measured: Mesh, reference: Option<Mesh>) -> (f64, usize) {
        let plan = Plan::parse(
            r#"
            schema = "trueness/plan/1"
            measured = "part.stl"
            [[feature]]
            id = "A"
            shape = "plane"
            extract = { distance = 0.5 }
            [feature.nominal]
            point = [0, 0, 0]
            normal = [0, 0, 1]
            boundary = [[-10, 0, 0], [10, 0, 0], [10, 20, 0], [-10, 20, 0]]
            [[characteristic]]
            id = "1"
            kind = "flatness"
            feature = "A"
            tolerance = 0.1
            "#,
        )
        .unwrap();
        let data = Data { measured: Some(measured), reference, ..Data::default() };
        let found = run(&plan, data, &Silent).unwrap();
        (found.values[0].as_ref().unwrap().value, found.features[0].points.len())
    }

    /// Neither the upper ends of the walls nor the beginning of the fillet are part of the plane between them.
    #[test]
    fn what_is_beside_a_plane_is_no_part_of_it() {
        for (fillet, cloud) in [(false, true), (false, false), (true, true), (true, false)] {
            let reference = bar(fillet);
            let mut measured = reference.clone();
            if cloud {
                measured.faces.clear();
            }
            let (value, points) = flatness(measured, Some(reference));
            assert!(value < 1e-9, "{fillet} {cloud}: {value}");
            assert!(points >= 51 * 51, "{fillet} {cloud}: {points}");
        }
        // Without a reference what lies along its bounds is left out.
        let mut measured = bar(false);
        measured.faces.clear();
        let (value, points) = flatness(measured, None);
        assert!(value < 1e-9 && points > 45 * 45, "{value} {points}");
    }

    /// The plane lies as much too low as its walls reach: its own rim stays with it.
    #[test]
    fn a_coarse_measured_plane_keeps_its_corners() {
        let mut measured = bar(false);
        measured.positions = vec![
            [-10.0, 0.0, -0.1],
            [10.0, 0.0, -0.1],
            [10.0, 20.0, -0.1],
            [-10.0, 20.0, -0.12],
            [10.0, 0.0, -8.0],
            [10.0, 20.0, -8.0],
        ];
        measured.faces = vec![[0, 1, 2], [0, 2, 3], [1, 4, 5], [1, 5, 2]];
        let (value, points) = flatness(measured, Some(bar(false)));
        assert_eq!(points, 4);
        assert!((value - 0.01).abs() < 1e-6, "{value}");
    }
}
