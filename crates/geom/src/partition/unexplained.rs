//! What no face explains.

use super::best::Best;
use super::faces::NO_FACE;
use super::terms::{Class, EXPLAINED};
use crate::mesh::Mesh;
use crate::space::Point;
use crate::spatial::neighbors::PointTree;

/// Points beyond all reach from which on what hangs together with them is of other things.
const SEVERAL: usize = 3;
/// Distances of neighbors from a border up to which points lie along it.
const ALONG: f64 = 1.0;
/// Neighbors of a point in a cloud, and distances of neighbors within which they hang together.
const NEIGHBORS: usize = 8;
const TOGETHER: f64 = 2.5;

/// The class of each point. Points that turn out to be of no face lose their owner.
pub(super) fn classes(scan: &Mesh, best: &mut Best, spacing: f64) -> Vec<Class> {
    let count = scan.positions.len();
    let is_open = |p: usize| best.cost[p].is_nan() || best.cost[p] > EXPLAINED;
    let mut classes: Vec<Class> =
        best.owner.iter().map(|o| if *o == NO_FACE { Class::Beyond } else { Class::Face }).collect();
    let open: Vec<u32> = (0..count as u32).filter(|p| is_open(*p as usize)).collect();
    let mut groups = Groups((0..count as u32).collect());
    match scan.faces.is_empty() {
        false => {
            for f in &scan.faces {
                for k in 0..3 {
                    let (a, b) = (f[k], f[(k + 1) % 3]);
                    if is_open(a as usize) && is_open(b as usize) {
                        groups.join(a, b);
                    }
                }
            }
        }
        true => {
            let places: Vec<Point> = open.iter().map(|p| scan.positions[*p as usize]).collect();
            let tree = PointTree::new(&places);
            for (i, place) in (0u32..).zip(&places) {
                for (square, j) in tree.k_nearest(place, NEIGHBORS, Some(i)) {
                    if square <= (TOGETHER * spacing).powi(2) {
                        groups.join(open[i as usize], open[j as usize]);
                    }
                }
            }
        }
    }
    let mut members: Vec<(u32, u32)> = open.iter().map(|p| (groups.find(*p), *p)).collect();
    members.sort_unstable();
    for group in members.chunk_by(|a, b| a.0 == b.0) {
        let of_faces: Vec<usize> =
            group.iter().map(|m| m.1 as usize).filter(|p| best.owner[*p] != NO_FACE).collect();
        let seats = || of_faces.iter().filter_map(|p| best.seat[*p]);
        let (total, outside) = (seats().count(), seats().filter(|s| s.off > 0.0).count());
        let along = seats().filter(|s| s.within < ALONG * spacing).count();
        let class = if group.len() - of_faces.len() >= SEVERAL {
            for p in of_faces.iter().filter(|p| best.seat[**p].is_none_or(|s| s.within <= 0.0)) {
                best.owner[*p] = NO_FACE;
            }
            if 2 * outside >= total { Class::High } else { Class::Deep }
        } else if 2 * along > total {
            Class::Edge
        } else {
            continue;
        };
        for p in of_faces {
            classes[p] = if best.owner[p] == NO_FACE { Class::Beyond } else { class };
        }
    }
    classes
}

/// Points that hang together.
struct Groups(Vec<u32>);

impl Groups {
    fn find(&mut self, mut p: u32) -> u32 {
        while self.0[p as usize] != p {
            let above = self.0[self.0[p as usize] as usize];
            self.0[p as usize] = above;
            p = above;
        }
        p
    }
    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}
