//! Neighbors in a cloud, by distance.

use super::jet::{Fitter, Jet};
use super::terms::{NoCurvature, ResolvedReach, Terms};
use std::f64::consts::PI;
use trueness_geom::fit::Scatter;
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::{Aabb, Point, Vector, dot, minus};
use trueness_geom::spatial::neighbors::{Neighbor, PointTree};

/// Neighbors of a point that normals are handed on to.
const LINKS_PER_POINT: usize = 8;
/// Angle without a neighbor from which on a point lies on a boundary: 150 degrees. One inner point in 200,000 has such a gap among
/// 30 neighbors at random directions; a straight boundary has one of 180 degrees.
const MIN_BOUNDARY_GAP: f64 = 5.0 / 6.0 * PI;

/// The places of a cloud: its finite points, equal ones as one. Copies of a point are no neighbors that tell anything more.
pub(super) struct CloudNeighbors<'a> {
    points: &'a [Point],
    tree: PointTree,
    /// For each place the lowest number of its points.
    numbers: Vec<u32>,
    /// For each point its place; [`u32::MAX`] where it is not finite.
    own: Vec<u32>,
}

/// The answer of a point, and its nearest neighbors, nearest first.
pub(super) type Answer = (Result<Jet, NoCurvature>, Vec<u32>);

impl CloudNeighbors<'_> {
    pub(super) fn new(points: &[Point]) -> CloudNeighbors<'_> {
        // Adding zero makes −0 the 0 that it equals.
        let key = |i: &u32| points[*i as usize].map(|x| (x + 0.0).to_bits());
        let finite = |i: &u32| points[*i as usize].iter().all(|x| x.is_finite());
        let mut order: Vec<u32> = (0..points.len() as u32).filter(finite).collect();
        order.par_sort_unstable_by_key(|i| (key(i), *i));
        let mut first = vec![u32::MAX; points.len()];
        for copies in order.chunk_by(|a, b| key(a) == key(b)) {
            copies.iter().for_each(|i| first[*i as usize] = copies[0]);
        }
        let mut own = vec![u32::MAX; points.len()];
        let mut numbers: Vec<u32> = vec![];
        for i in (0..points.len()).filter(|i| first[*i] != u32::MAX) {
            let lowest = first[i] as usize;
            if lowest == i {
                own[i] = numbers.len() as u32;
                numbers.push(i as u32);
            } else {
                own[i] = own[lowest];
            }
        }
        let kept: Vec<Point> = numbers.iter().map(|i| points[*i as usize]).collect();
        CloudNeighbors { points, tree: PointTree::new(&kept), numbers, own }
    }

    /// The jet at a point; its normal may be on either side.
    pub(super) fn jet(&self, i: u32, terms: &Terms, fitter: &mut Fitter) -> Answer {
        let place = self.points[i as usize];
        let own = self.own[i as usize];
        if own == u32::MAX {
            return (Err(NoCurvature::NotFinite), vec![]);
        }
        let near = self.neighbors(&place, own, terms);
        let number = |n: &Neighbor| self.numbers[n.1 as usize];
        // A copy follows the first of its place.
        let lowest = self.numbers[own as usize];
        let links = (lowest != i).then_some(lowest).into_iter();
        let links = links.chain(near.iter().map(number)).take(LINKS_PER_POINT).collect();
        fitter.take(place, near.iter().map(|n| self.points[number(n) as usize]));
        (fit(fitter, terms), links)
    }

    fn neighbors(&self, place: &Point, own: u32, terms: &Terms) -> Vec<Neighbor> {
        let radius = match terms.reach {
            ResolvedReach::Count(count) => return self.tree.k_nearest(place, count, Some(own)),
            ResolvedReach::Radius(radius) => radius,
        };
        let window = Aabb { min: place.map(|x| x - radius), max: place.map(|x| x + radius) };
        let mut near = vec![];
        self.tree.in_box(&window, |p, n| {
            let q = minus(*p, *place);
            let square = dot(q, q);
            if n != own && square <= radius * radius {
                near.push((square, n));
            }
            true
        });
        near.sort_unstable_by(|a: &Neighbor, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        near
    }
}

fn fit(fitter: &mut Fitter, terms: &Terms) -> Result<Jet, NoCurvature> {
    if fitter.around.len() < terms.unknowns {
        return Err(NoCurvature::FewNeighbors);
    }
    let jet = fitter.jet(flattest(&fitter.around).ok_or(NoCurvature::Undetermined)?)?;
    if !terms.boundary && widest_gap(&fitter.around, &jet) >= MIN_BOUNDARY_GAP {
        return Err(NoCurvature::Boundary);
    }
    Ok(jet)
}

/// Normal of the least-squares plane; `None` where all lie on a line.
fn flattest(around: &[Vector]) -> Option<Vector> {
    let Scatter { variance, axes, .. } = Scatter::of(around);
    // Width of a line that rounding leaves.
    (variance[1] > 1e-14 * variance[2]).then_some(axes[0])
}

/// The widest angle along the surface in which there is no neighbor.
fn widest_gap(around: &[Vector], jet: &Jet) -> f64 {
    let [x, y] = jet.bend.principal.map(|p| p.direction);
    let places = around.iter().map(|q| [dot(*q, x), dot(*q, y)]).filter(|q| *q != [0.0; 2]);
    let mut angles: Vec<f64> = places.map(|[a, b]| libm::atan2(b, a)).collect();
    angles.sort_unstable_by(f64::total_cmp);
    let (Some(first), Some(last)) = (angles.first(), angles.last()) else { return 2.0 * PI };
    angles.windows(2).map(|w| w[1] - w[0]).fold(first + 2.0 * PI - last, f64::max)
}
