//! Edges of more than two facets, and vertices where several fans of facets touch, are split.
//!
//! Around such an edge the facets are sorted by angle and paired so that material lies between the two of a pair.
//! Around such a vertex, facets that are connected through edges or pairs are one fan. The fan with the largest area
//! keeps the vertex. Each other fan gets a vertex of its own, moved a little into its own material. The next program
//! that reads the file would join a copy at the very same place again.

use super::crowded::{Fan, Rims, meant_as_one};
use super::degenerate::cut;
use super::edges::{Edges, Side};
use super::error::RepairError;
use super::step::{Removes, Step};
use super::work::Work;
use std::collections::{BTreeMap, BTreeSet};
use trueness_geom::check::finding::area;
use trueness_geom::space::{Point, Vector, cross, dot, minus, norm, normal, plus, times, unit};
use trueness_geom::topology::union::Sets;

pub(super) const EDGES: Step = Step {
    name: "non_manifold_edges",
    about: "Parts the surface at edges of more than two facets, so that material stays between each pair.",
    removes: Removes::Nothing,
};

pub(super) fn edges(work: &mut Work) -> Result<(), RepairError> {
    let known = work.known()?;
    let vertices = known.topology.non_manifold_edges.iter().flat_map(|e| e.vertices).collect();
    split(work, vertices, &EDGES, true)
}

pub(super) const VERTICES: Step = Step {
    name: "non_manifold_vertices",
    about: "Parts the surface at vertices where several fans of facets touch.",
    removes: Removes::Nothing,
};

pub(super) fn vertices(work: &mut Work) -> Result<(), RepairError> {
    let vertices = work.known()?.topology.non_manifold_vertices.clone();
    split(work, vertices, &VERTICES, false)
}

/// How far a new vertex is moved into the material, in gaps, tried one after the other until no facets cross. Every
/// second one is negative, out of the material. Where the tips of two pits touch, the way into the material of one
/// leads into the other.
const OFFSETS_IN_GAPS: [f64; 8] = [4.0, -4.0, 32.0, -32.0, 256.0, -256.0, 2048.0, -2048.0];

/// For an edge and a facet at it the other facet of its pair.
type Pairs = BTreeMap<([u32; 2], u32), u32>;

/// Splits the surface at `vertices`. With `open_together`, all fans with a boundary stay one: filling their holes may join
/// them.
fn split(
    work: &mut Work,
    mut vertices: Vec<u32>,
    step: &'static Step,
    open_together: bool,
) -> Result<(), RepairError> {
    vertices.sort_unstable();
    vertices.dedup();
    if vertices.is_empty() {
        return Ok(());
    }
    let known = work.known()?;
    let edges = Edges::of(work.mesh(), &known.topology);
    let pairs = pairs(work, &edges);
    let mut lost: Vec<Fan> = vec![];
    let mut rims = Rims::new();
    for v in vertices {
        work.go_on()?;
        let mut fans = fans(work, &known.topology.facets_at_vertex(v), v, &edges, &pairs, open_together);
        let size = |fan: &Vec<u32>| fan.iter().map(|&f| area(work.corners(f))).sum::<f64>();
        fans.sort_by(|a, b| size(b).total_cmp(&size(a)).then(a[0].cmp(&b[0])));
        let mut fans =
            fans.into_iter().map(|facets| Fan { rim: rim(work, &edges, &facets, v), at: v, facets });
        rims.extend(fans.next().map(|keeps| (v, keeps.rim)));
        lost.extend(fans);
    }
    let again = shared_twice(&edges, &pairs, &lost);
    if lost.is_empty() && again.is_empty() {
        return Ok(());
    }
    let first = work.mesh().positions.len() as u32;
    let lost = apart(work, (lost, rims), &again, step)?;
    work.state.handover.kept_apart.extend(first..work.mesh().positions.len() as u32);
    for fan in &lost {
        work.log(step, "fan of facets given its own vertex", work.at(fan.at), fan.facets.len(), 0.0);
    }
    for (ends, _) in &again {
        let [a, b] = ends.map(|v| work.at(v));
        work.log(step, "edge parted in its middle", times(0.5, plus(a, b)), 2, norm(minus(b, a)));
    }
    Ok(())
}

/// The other ends of the edges of one facet, of these, at `v`.
fn rim(work: &Work, edges: &Edges, facets: &[u32], v: u32) -> Vec<u32> {
    let corners = facets.iter().flat_map(|f| work.mesh().faces[*f as usize]);
    corners.filter(|w| *w != v && edges.at(v, *w).len() == 1).collect()
}

/// Moves the fans and pairs apart, each by the first distance of [`OFFSETS_IN_GAPS`] at which it crosses nothing, and returns the fans
/// that were moved.
///
/// A fan at a vertex that crosses something at every distance stays where it is; at an edge it is moved all the same.
fn apart(
    work: &mut Work,
    (mut lost, mut rims): (Vec<Fan>, Rims),
    again: &[([u32; 2], [u32; 2])],
    step: &'static Step,
) -> Result<Vec<Fan>, RepairError> {
    let before = work.shared();
    let changing: BTreeSet<u32> = lost
        .iter()
        .flat_map(|fan| &fan.facets)
        .chain(again.iter().flat_map(|(_, pair)| pair))
        .copied()
        .collect();
    // Facets that cross already cannot tell whether the distance is right; in a tangle none can.
    let crossing = work.crossings(|f, _| changing.contains(&f))?;
    let crossing: Option<BTreeSet<u32>> = crossing.map(|pairs| pairs.into_iter().flatten().collect());
    let clean = |facets: &[u32]| crossing.as_ref().is_some_and(|c| !facets.iter().any(|f| c.contains(f)));
    let mut unsettled: Vec<bool> =
        lost.iter().map(|fan| clean(&fan.facets)).chain(again.iter().map(|(_, pair)| clean(pair))).collect();
    let first = before.positions.len() as u32;
    let mut together = together(work, &lost);
    let mut ways = ways(work, &lost, &together);
    let mut nth = vec![0; unsettled.len()];
    // Vertices whose facets are not as they were when they were last looked at; at first all new ones.
    let mut changed: Option<BTreeSet<u32>> = None;
    loop {
        let distances: Vec<f64> = nth.iter().map(|&n| OFFSETS_IN_GAPS[n] * work.gap).collect();
        set_off(work, (&lost, &ways), again, &distances);
        let has_changed = |v: &u32| changed.as_ref().map_or(*v >= first, |changed| changed.contains(v));
        let pairs = work.crossings(|_, face| face.iter().any(has_changed))?;
        let faces = &work.mesh().faces;
        let mut bad: Vec<usize> = match pairs {
            None => (0..unsettled.len()).collect(),
            Some(pairs) => {
                let corners = pairs.iter().flatten().flat_map(|f| faces[*f as usize]);
                corners.filter_map(|v| v.checked_sub(first)).map(|i| i as usize).collect()
            }
        };
        bad.extend(meant_as_one(work, &lost, &rims, first as usize));
        bad.retain(|&i| unsettled[i]);
        bad.extend((0..lost.len()).filter(|&i| distances[i].abs() > ways[i].most));
        let with: BTreeSet<u32> = bad.iter().filter_map(|i| together.get(*i)).copied().collect();
        bad.extend((0..lost.len()).filter(|i| with.contains(&together[*i])));
        bad.sort_unstable();
        bad.dedup();
        let step_of = |i: usize| ways.get(i).map_or(1, |way| way.step);
        let may_go = |i: usize| {
            let next = OFFSETS_IN_GAPS.get(nth[i] + step_of(i));
            next.is_some_and(|o| o.abs() * work.gap <= ways.get(i).map_or(f64::INFINITY, |way| way.most))
        };
        let (more, last): (Vec<usize>, Vec<usize>) = bad.into_iter().partition(|&i| may_go(i));
        let kept: Vec<usize> =
            if *step == VERTICES { last.into_iter().filter(|&i| i < lost.len()).collect() } else { vec![] };
        if more.is_empty() && kept.is_empty() {
            return Ok(lost);
        }
        work.restore(before.clone());
        more.iter().for_each(|&i| nth[i] += step_of(i));
        let moved = more.iter().map(|&i| first + (i - kept.partition_point(|k| *k < i)) as u32);
        changed = Some(moved.chain(kept.iter().map(|&i| lost[i].at)).collect());
        if !kept.is_empty() {
            for &i in &kept {
                rims.entry(lost[i].at).or_default().append(&mut lost[i].rim);
            }
            let stays = |i: usize| kept.binary_search(&i).is_err();
            retain(&mut lost, stays);
            retain(&mut together, stays);
            retain(&mut nth, stays);
            retain(&mut unsettled, stays);
            ways = self::ways(work, &lost, &together);
        }
        if unsettled.is_empty() {
            return Ok(lost);
        }
    }
}

/// Drops the entries that do not stay, by their numbers.
fn retain<T>(all: &mut Vec<T>, stays: impl Fn(usize) -> bool) {
    let mut i = 0;
    all.retain(|_| {
        i += 1;
        stays(i - 1)
    });
}

/// A number for each fan. Fans with the same number are moved together: they have common facets, at vertices within the gap
/// of each other.
fn together(work: &Work, lost: &[Fan]) -> Vec<u32> {
    let sets = Sets::new(lost.len());
    let mut fans: BTreeMap<(u32, u32), u32> = BTreeMap::new();
    for (i, fan) in (0..).zip(lost) {
        fans.extend(fan.facets.iter().map(|f| ((*f, fan.at), i)));
    }
    for (&(f, v), &i) in &fans {
        for w in work.mesh().faces[f as usize] {
            if w > v && norm(minus(work.at(v), work.at(w))) <= work.gap {
                fans.get(&(f, w)).iter().for_each(|j| sets.join(i, **j));
            }
        }
    }
    (0..lost.len() as u32).map(|i| sets.root(i)).collect()
}

/// Gives the fans their vertices and the pairs of `again` a vertex in the middle of their edge, each at its distance.
fn set_off(
    work: &mut Work,
    (lost, ways): (&[Fan], &[FanMove]),
    again: &[([u32; 2], [u32; 2])],
    distances: &[f64],
) {
    let mut renamed = BTreeMap::new();
    for ((fan, way), distance) in lost.iter().zip(ways).zip(distances) {
        let new = work.add(plus(work.at(fan.at), times(-distance, way.out)));
        renamed.extend(fan.facets.iter().map(|&f| ((f, fan.at), new)));
    }
    let (mut removed, mut added) = (vec![], vec![]);
    for ((ends, facets), distance) in again.iter().zip(&distances[lost.len()..]) {
        let middle = times(0.5, plus(work.at(ends[0]), work.at(ends[1])));
        let place = plus(middle, times(-distance, outwards(work, facets, middle).out));
        let new = work.add(place);
        for &f in facets {
            removed.push(f);
            let renamed = |v: u32| renamed.get(&(f, v)).copied().unwrap_or(v);
            added.extend(cut(work.mesh().faces[f as usize], *ends, new).map(|part| part.map(renamed)));
        }
    }
    work.rename(|f, v| renamed.get(&(f, v)).copied().unwrap_or(v));
    work.replace(&removed, &added);
}

/// Where a fan goes.
#[derive(Clone, Copy)]
struct FanMove {
    /// Unit vector, away from which it is moved.
    out: Vector,
    /// How many of [`OFFSETS_IN_GAPS`] are one step: all, or those on this side.
    step: usize,
    /// How far it may be moved at most: no farther than changes little of it.
    most: f64,
}

/// The ways of the fans; those with the same number go the same way.
fn ways(work: &Work, lost: &[Fan], together: &[u32]) -> Vec<FanMove> {
    let mut facets: BTreeMap<u32, BTreeSet<u32>> = BTreeMap::new();
    for (fan, number) in lost.iter().zip(together) {
        facets.entry(*number).or_default().extend(&fan.facets);
    }
    let mut ways: BTreeMap<u32, FanMove> = BTreeMap::new();
    let way = |(fan, number): (&Fan, &u32)| {
        *ways.entry(*number).or_insert_with(|| {
            let facets: Vec<u32> = facets.get(number).into_iter().flatten().copied().collect();
            outwards(work, &facets, work.at(fan.at))
        })
    };
    lost.iter().zip(together).map(way).collect()
}

/// The cone or material out of which the common place of these facets can be moved. Where the cone that they are seen
/// in from there is narrow, it is moved out of that. A place moved within the cone meets nothing outside. Else it is
/// moved out of the material between them, and back.
fn outwards(work: &Work, facets: &[u32], at: Point) -> FanMove {
    /// Cosine of half the angle of a cone that is narrow: 60 degrees, far from a half space.
    const MIN_NARROW_CONE_COSINE: f64 = 0.5;
    /// Share of the way to the nearest other corner.
    const MAX_MOVE_SHARE: f64 = 0.05;
    let corners = facets.iter().flat_map(|f| work.corners(*f)).filter(|p| norm(minus(*p, at)) > work.gap);
    let (seen, far): (Vec<Vector>, Vec<f64>) = corners.filter_map(|p| unit(minus(p, at))).unzip();
    let most = MAX_MOVE_SHARE * far.iter().copied().fold(f64::INFINITY, f64::min);
    let axis = unit(seen.iter().copied().fold([0.0; 3], plus));
    if let Some((axis, _)) =
        axis.filter(|(axis, _)| seen.iter().all(|way| dot(*way, *axis) > MIN_NARROW_CONE_COSINE))
    {
        return FanMove { out: times(-1.0, axis), step: 2, most };
    }
    let unit_normal = |f: &u32| normal(work.corners(*f)).unwrap_or([0.0; 3]);
    let sum = facets.iter().map(unit_normal).fold([0.0; 3], plus);
    let away = || {
        let middle = facets.iter().map(|f| work.middle(*f)).fold([0.0; 3], plus);
        minus(at, times(1.0 / facets.len() as f64, middle))
    };
    let out = unit(sum).or_else(|| unit(away())).map_or([1.0, 0.0, 0.0], |(n, _)| n);
    FanMove { out, step: 1, most }
}

/// Pairs of facets at an edge that would still share it with another pair: both its ends keep their fans together.
fn shared_twice(edges: &Edges, pairs: &Pairs, lost: &[Fan]) -> Vec<([u32; 2], [u32; 2])> {
    let mut moved: Vec<(u32, u32, usize)> = vec![];
    for (i, fan) in lost.iter().enumerate() {
        moved.extend(fan.facets.iter().map(|&f| (f, fan.at, i + 1)));
    }
    moved.sort_unstable();
    let fan_of =
        |f: u32, v: u32| moved.binary_search_by_key(&(f, v), |m| (m.0, m.1)).map_or(0, |i| moved[i].2);
    let mut again = vec![];
    let mut touched = BTreeSet::new();
    for edge in edges.iter().filter(|e| e.len() > 2) {
        let ends = edge[0].ends;
        let mut seen = vec![];
        for side in edge {
            let Some(&other) = pairs.get(&(ends, side.facet)) else { continue };
            if other < side.facet {
                continue;
            }
            let fans = ends.map(|v| fan_of(side.facet, v));
            // A facet is cut at one edge only in one pass.
            let free = !touched.contains(&side.facet) && !touched.contains(&other);
            if seen.contains(&fans) && free {
                touched.extend([side.facet, other]);
                again.push((ends, [side.facet, other]));
            }
            seen.push(fans);
        }
    }
    again
}

/// The facets at `v` by connection through edges and pairs there.
fn fans(
    work: &Work,
    facets: &[u32],
    v: u32,
    edges: &Edges,
    pairs: &Pairs,
    open_together: bool,
) -> Vec<Vec<u32>> {
    let sets = Sets::new(facets.len());
    let index = |f: u32| facets.binary_search(&f).unwrap_or(0) as u32;
    let mut open: Option<u32> = None;
    for &f in facets {
        for w in work.mesh().faces[f as usize].into_iter().filter(|w| *w != v) {
            match edges.at(v, w) {
                [_] if open_together => sets.join(index(f), *open.get_or_insert(index(f))),
                [_] => {}
                [a, b] => sets.join(index(a.facet), index(b.facet)),
                _ => {
                    if let Some(&g) = pairs.get(&([v.min(w), v.max(w)], f)) {
                        sets.join(index(f), index(g));
                    }
                }
            }
        }
    }
    let mut members: Vec<(u32, u32)> = facets.iter().map(|&f| (sets.root(index(f)), f)).collect();
    members.sort_unstable();
    members.chunk_by(|a, b| a.0 == b.0).map(|fan| fan.iter().map(|m| m.1).collect()).collect()
}

/// Pairs the facets at each edge of more than two so that material lies between them.
fn pairs(work: &Work, edges: &Edges) -> Pairs {
    let mut pairs = Pairs::new();
    for edge in edges.iter().filter(|e| e.len() > 2) {
        let mut around = by_angle(work, edge);
        // Facets that run down the edge have material on the side of growing angle, those that run up have it before
        // them. They pair like brackets, twice round so that none is missed where the circle was cut open.
        let mut opened: Vec<u32> = vec![];
        for _ in 0..2 {
            for side in &around {
                if !side.up {
                    opened.retain(|f| *f != side.facet);
                    opened.push(side.facet);
                } else if let Some(f) = opened.pop() {
                    pairs.insert((side.ends, side.facet), f);
                    pairs.insert((side.ends, f), side.facet);
                }
            }
            around.retain(|s| !pairs.contains_key(&(s.ends, s.facet)));
        }
    }
    pairs
}

/// The sides sorted by the angle of their facets around the edge, seen against its direction.
fn by_angle(work: &Work, edge: &[Side]) -> Vec<Side> {
    let [a, b] = edge[0].ends.map(|v| work.at(v));
    let axis = unit(minus(b, a)).map_or([0.0; 3], |(u, _)| u);
    let arm = |s: &Side| {
        let third = work.mesh().faces[s.facet as usize].into_iter().find(|v| !s.ends.contains(v));
        let to = third.map_or([0.0; 3], |v| minus(work.at(v), a));
        minus(to, times(dot(to, axis), axis))
    };
    let x = arm(&edge[0]);
    let y = cross(axis, x);
    let angle = |s: &Side| {
        let d = arm(s);
        libm::atan2(dot(d, y), dot(d, x))
    };
    let mut sides: Vec<(f64, Side)> = edge.iter().map(|s| (angle(s), *s)).collect();
    sides.sort_by(|p, q| p.0.total_cmp(&q.0).then(p.1.cmp(&q.1)));
    sides.into_iter().map(|s| s.1).collect()
}
