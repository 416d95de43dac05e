//! Edges of faces without topology that coincide become one.
//!
//! Faces of such files share nothing: each has its own border. Where two borders lie within the resolution of the file of each other, they are meant
//! to be one. So do the two sides of a seam, where a face goes around a surface that closes.

use super::loose::{Loose, edges_of};
use std::collections::{BTreeMap, HashMap};
use trueness_cad::brep::{Bounds, Brep, Edge, Loop};
use trueness_geom::space::{Aabb, Point, minus, norm};

/// Shares of an edge at which it must lie on another one.
const SEWN_SHARES: [f64; 3] = [0.25, 0.5, 0.75];

/// Sews the edges of these faces.
pub(super) fn sew(brep: &mut Brep, loose: &[Loose], tolerance: f64) {
    let vertices = joined_vertices(brep, loose, tolerance);
    for edge in &mut brep.edges {
        edge.vertices = edge.vertices.map(|v| vertices.get(v as usize).copied().unwrap_or(v));
    }
    let mut by_ends: BTreeMap<[u32; 2], Vec<(u32, u32)>> = BTreeMap::new();
    for one in loose {
        let Some(face) = brep.faces.get_mut(one.face as usize) else { continue };
        let closes = face.surface.periods().iter().any(Option::is_some);
        let Bounds::Loops(loops) = &mut face.bounds else { continue };
        for around in loops {
            let Loop::Edges(uses) = around else { continue };
            for used in uses {
                let Some(own) = brep.edges.get(used.edge as usize) else { continue };
                let [a, b] = own.vertices;
                let known = by_ends.entry([a.min(b), a.max(b)]).or_default();
                let same = known.iter().find_map(|(edge, face)| {
                    // Within a face only the sides of a seam are one; else they bound a sliver.
                    let may = *face != one.face || closes;
                    let sense = same_way(brep.edges.get(*edge as usize)?, own, tolerance)?;
                    may.then_some((*edge, sense))
                });
                match same {
                    Some((edge, along)) => {
                        used.edge = edge;
                        used.reversed ^= !along;
                    }
                    None => known.push((used.edge, one.face)),
                }
            }
        }
    }
    compact(brep);
}

/// For each vertex the one that stands for all within the tolerance; vertices of solids stand for themselves.
fn joined_vertices(brep: &Brep, loose: &[Loose], tolerance: f64) -> Vec<u32> {
    let mut stands: Vec<u32> = (0..brep.vertices.len() as u32).collect();
    let mut cells: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
    let cell = |p: Point| p.map(|x| (x / (2.0 * tolerance)).floor() as i64);
    let edges = loose.iter().filter_map(|l| brep.faces.get(l.face as usize)).flat_map(edges_of);
    let mut own: Vec<u32> =
        edges.filter_map(|e| brep.edges.get(e as usize)).flat_map(|e| e.vertices).collect();
    own.sort_unstable();
    own.dedup();
    for v in own {
        let Some(place) = brep.vertices.get(v as usize).map(|v| v.place) else { continue };
        let home = cell(place);
        let near = (0..27).find_map(|k: i64| {
            let around = [
                home[0].saturating_add(k % 3 - 1),
                home[1].saturating_add(k / 3 % 3 - 1),
                home[2].saturating_add(k / 9 - 1),
            ];
            let is_near = |w: &&u32| {
                brep.vertices.get(**w as usize).is_some_and(|w| norm(minus(w.place, place)) <= tolerance)
            };
            cells.get(&around)?.iter().find(is_near).copied()
        });
        match near {
            Some(w) => stands[v as usize] = w,
            None => cells.entry(home).or_default().push(v),
        }
    }
    stands
}

/// Whether an edge lies on another one with the same vertices, and then whether it runs the same way.
fn same_way(known: &Edge, own: &Edge, tolerance: f64) -> Option<bool> {
    let places = SEWN_SHARES.map(|share| own.span.derivatives(share)[0]);
    let size = Aabb::of(&[places[0], places[2], own.span.ends()[0]]).diagonal();
    if size <= tolerance {
        return None;
    }
    // A look at the middle says no to most.
    let feet = known.span.feet();
    let mut shares = [0.0; 3];
    for (share, place) in shares.iter_mut().zip(places) {
        let foot = feet.nearest(place);
        if foot.distance > tolerance {
            return None;
        }
        *share = known.span.share(foot.parameter);
    }
    Some(match known.vertices[0] == known.vertices[1] {
        true => shares[0] < shares[2],
        false => known.vertices[0] == own.vertices[0],
    })
}

/// Drops edges and vertices that nothing uses.
fn compact(brep: &mut Brep) {
    let mut uses = vec![false; brep.edges.len()];
    let mut places = vec![false; brep.vertices.len()];
    for face in &brep.faces {
        edges_of(face).into_iter().for_each(|e| uses[e as usize] = true);
        if let Bounds::Loops(loops) = &face.bounds {
            loops.iter().for_each(|l| {
                if let Loop::Vertex(v) = l {
                    places[*v as usize] = true
                }
            });
        }
    }
    for (edge, used) in brep.edges.iter().zip(&uses) {
        edge.vertices.iter().filter(|_| *used).for_each(|v| places[*v as usize] = true);
    }
    let (edges, vertices) = (numbered(&uses), numbered(&places));
    let mut kept = uses.iter();
    brep.edges.retain(|_| kept.next().copied().unwrap_or(true));
    let mut kept = places.iter();
    brep.vertices.retain(|_| kept.next().copied().unwrap_or(true));
    for edge in &mut brep.edges {
        edge.vertices = edge.vertices.map(|v| vertices[v as usize]);
    }
    for face in &mut brep.faces {
        let Bounds::Loops(loops) = &mut face.bounds else { continue };
        for around in loops {
            match around {
                Loop::Vertex(v) => *v = vertices[*v as usize],
                Loop::Edges(own) => own.iter_mut().for_each(|u| u.edge = edges[u.edge as usize]),
            }
        }
    }
}

/// New numbers of what is kept.
fn numbered(kept: &[bool]) -> Vec<u32> {
    let count = |next: &mut u32, kept: &bool| {
        let own = *next;
        *next += u32::from(*kept);
        Some(own)
    };
    kept.iter().scan(0, count).collect()
}
