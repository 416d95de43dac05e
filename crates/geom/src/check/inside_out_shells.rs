//! Closed shells that look the wrong way.

use super::islands::shell_bounds;
use super::near::Near;
use super::nesting::Container;
use super::{DefectKind, Finding, Inspected, Measure, Severity, Shows};
use crate::mesh::Mesh;
use crate::num::exact::Exact;
use crate::parallel::prelude::*;
use crate::space::{Aabb, Point, times};
use std::sync::LazyLock;

pub(super) const KIND: DefectKind = DefectKind {
    name: "inside_out_shells",
    severity: Severity::Error,
    about: "Closed, consistently oriented shells that bound no material: material is where shells wind around a place at least \
            once, and a shell must have it on its inner side only, or (a cavity, looking inwards) on its outer side only. One \
            that encloses nothing looks neither way. Facets: the first of the shell.",
    size: "volume enclosed, mm³",
    measure: Measure::Volume,
    shows: Shows::Shell,
    follows: false,
    missing: None,
    find: |m| {
        let closed = closed_shells(m);
        let bounds = shell_bounds(m);
        let facets = Facets::new(Box::new(|| by_shell(&m.topology.shell_of, closed.len())));
        let depth = m.depths.get_or_init(|| depths(m, &closed, &bounds, &facets));
        let wrong = |s: &usize| {
            let (outside, looks) = (depth[*s], if closed[*s] { looks(m, *s, &facets) } else { 0 });
            looks != 0 && (outside > 0) == (outside + looks > 0)
        };
        let shells: Vec<usize> = (0..closed.len()).into_par_iter().filter(wrong).collect();
        m.each(&shells, |&s| {
            let (first, bounds) = bounds[s];
            let position = std::array::from_fn(|k| bounds.min[k] / 2.0 + bounds.max[k] / 2.0);
            let measures = vec![("shell", s as f64), ("depth", f64::from(depth[s]))];
            let size = m.properties.shell_volumes[s].abs();
            Finding { facets: vec![first], vertices: vec![], position, bounds, size, measures }
        })
    },
};

/// For each shell of a closed, consistently oriented mesh the way it looks, and how often the others wind around it. It looks
/// outwards (1) or inwards (−1), or encloses nothing (0).
pub(super) fn orientations(m: &Inspected) -> Vec<(i32, i32)> {
    let closed = closed_shells(m);
    let facets = Facets::new(Box::new(|| by_shell(&m.topology.shell_of, closed.len())));
    let depth = m.depths.get_or_init(|| depths(m, &closed, &shell_bounds(m), &facets));
    (0..closed.len()).into_par_iter().map(|s| (looks(m, s, &facets), depth[s])).collect()
}

/// Which shells are closed surfaces, all facets running the same way round.
fn closed_shells(m: &Inspected) -> Vec<bool> {
    let mut closed = vec![true; m.topology.shells];
    let t = m.topology;
    for e in t.boundary_edges.iter().chain(&t.inconsistent_edges).chain(&t.non_manifold_edges) {
        closed[t.shell_of[e.facet as usize] as usize] = false;
    }
    closed
}

/// The facets of each shell, ascending, made when first asked for.
type Facets<'a> = LazyLock<Vec<Vec<u32>>, Box<dyn FnOnce() -> Vec<Vec<u32>> + Send + 'a>>;

/// Whether a closed shell looks outwards (1) or inwards (−1), or encloses nothing (0): the exact sign of its volume.
fn looks(m: &Inspected, shell: usize, facets: &Facets) -> i32 {
    /// Greatest rounding that each facet adds to the volume, as a share of the cube of half the diagonal.
    const VOLUME_ROUNDING_PER_FACET: f64 = 1e-15;
    let volume = m.properties.shell_volumes[shell];
    let radius = m.properties.bounds.diagonal() / 2.0;
    if volume.abs() > VOLUME_ROUNDING_PER_FACET * m.mesh.faces.len() as f64 * radius.powi(3) {
        return if volume > 0.0 { 1 } else { -1 };
    }
    exact_volume(m.mesh, &facets[shell]).sign()
}

/// Six times the volume of a closed shell, in units that keep its products in the range of `f64`.
fn exact_volume(mesh: &Mesh, facets: &[u32]) -> Exact {
    /// Facets of one task.
    const WINDING_FACETS_PER_TASK: usize = 1 << 10;
    let corners = |f: u32| mesh.corners(f);
    let size = |f: &u32| corners(*f).iter().flatten().fold(0.0f64, |size, x| size.max(x.abs()));
    let largest = facets.par_iter().map(size).reduce(|| 0.0, f64::max);
    let unit = 2f64.powi(-(libm::log2(largest.max(f64::MIN_POSITIVE)).floor() as i32).max(-1000));
    let of_part = |part: &[u32]| {
        let mut sum = Exact::default();
        for &f in part {
            let [a, b, c] = corners(f).map(|p| times(unit, p));
            for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
                sum.add_product(a[i], b[j], c[k]);
                sum.add_product(a[i], -b[k], c[j]);
            }
        }
        sum
    };
    let both = |mut a: Exact, b: Exact| {
        a.merge(&b);
        a
    };
    facets.par_chunks(WINDING_FACETS_PER_TASK).map(of_part).reduce(Exact::default, both)
}

/// How often the other closed shells wind around each closed shell.
fn depths(m: &Inspected, closed: &[bool], bounds: &[(u32, Aabb)], facets: &Facets) -> Vec<i32> {
    let mut depth = vec![0; closed.len()];
    let corner = |s: usize| (bounds[s].1.min, s as u32);
    let near = Near::new((0..closed.len()).filter(|&s| closed[s]).map(corner).collect());
    if closed.len() < 2 {
        return depth;
    }
    let contains = |outer: &Aabb, inner: &Aabb| {
        (0..3).all(|k| outer.min[k] <= inner.min[k] && inner.max[k] <= outer.max[k])
    };
    let inside = |s: usize| {
        let (own, mut inner) = (bounds[s].1, vec![]);
        let reaches = |b: &Aabb| (0..3).all(|k| b.min[k] <= own.max[k] && own.min[k] <= b.max[k]);
        near.visit(reaches, |_, other| {
            if other as usize != s && contains(&own, &bounds[other as usize].1) {
                inner.push(other);
            }
        });
        inner
    };
    let shells = 0..closed.len();
    let outer: Vec<usize> = shells.into_par_iter().filter(|&s| closed[s] && !inside(s).is_empty()).collect();
    if outer.is_empty() {
        return depth;
    }
    // One after the other: all lists together might have as many entries as there are pairs of shells.
    for s in outer {
        let container = Container::new(m.mesh, &facets[s], 0);
        let held = inside(s).into_par_iter().map(|s| (s, winding(m, &facets[s as usize], &container)));
        held.collect::<Vec<(u32, i32)>>().into_iter().for_each(|(s, w)| depth[s as usize] += w);
    }
    depth
}

/// How often the container winds around the shell. Asks about corners until one does not lie on the container. For shells that
/// share their corners it asks about the middles of facets, which rounding moves by less than a step of the numbers.
fn winding(m: &Inspected, shell: &[u32], container: &Container) -> i32 {
    /// Shells that touch in more places are taken to lie side by side.
    const MAX_TOUCHING_PLACES: usize = 64;
    let middle = |[a, b, c]: [Point; 3]| std::array::from_fn(|k| a[k] / 3.0 + b[k] / 3.0 + c[k] / 3.0);
    let corners = || shell.iter().take(MAX_TOUCHING_PLACES).map(|&f| m.corners(f));
    let places = corners().map(|[a, ..]| a).chain(corners().map(middle));
    places.into_iter().find_map(|p| container.winding(&p)).unwrap_or(0)
}

/// The facets of each shell, ascending.
fn by_shell(shell_of: &[u32], shells: usize) -> Vec<Vec<u32>> {
    let mut facets = vec![vec![]; shells];
    for (f, &shell) in (0..).zip(shell_of) {
        if let Some(list) = facets.get_mut(shell as usize) {
            list.push(f);
        }
    }
    facets
}

#[cfg(test)]
mod tests {
    use super::KIND;
    use crate::check::{Options, check};
    use crate::mesh::Mesh;
    use crate::num::random::Random;
    use crate::progress::Silent;
    use crate::samples::{add, block, inverted};

    fn wrong(mesh: &Mesh) -> Vec<u32> {
        let report = check(mesh, None, &Options::default(), &Silent).unwrap();
        report.found(&KIND).unwrap().items.iter().map(|finding| finding.facets[0]).collect()
    }

    /// Their volumes are less than what rounding does to sums over the whole.
    #[test]
    fn tiny_shells_far_from_the_middle_are_told_apart() {
        let random = &mut Random::new(3);
        let mut mesh = block(4, 1000.0);
        let (mut expected, tiny) = (vec![], block(2, 1e-3));
        for k in 0..200 {
            let first = mesh.faces.len() as u32;
            let place = [1000.0 + random.unit(), 1000.0 * random.unit(), f64::from(k)];
            if random.below(2) == 0 {
                add(&mut mesh, &inverted(tiny.clone()), place);
                expected.push(first);
            } else {
                add(&mut mesh, &tiny, place);
            }
        }
        assert_eq!(wrong(&mesh), expected);
        for scale in [1e-200, 1e200] {
            let mut scaled = mesh.clone();
            scaled.positions.iter_mut().flatten().for_each(|x| *x *= scale);
            assert_eq!(wrong(&scaled), expected, "{scale}");
        }
    }

    /// The same square twice, divided along the one diagonal and along the other, one corner off by the last digit or not.
    #[test]
    fn what_encloses_nothing_looks_neither_way() {
        const LAST_DIGIT: f64 = f64::EPSILON / 2.0;
        for (z, expected) in [(0.0, 0), (LAST_DIGIT, 0), (-LAST_DIGIT, 1)] {
            let positions = vec![
                [0.125, 0.125, 0.0],
                [0.875, 0.125, 0.375],
                [0.875, 0.875, 0.75 + z],
                [0.125, 0.875, 0.375],
            ];
            let mesh = Mesh { positions, faces: vec![[0, 1, 2], [0, 2, 3], [1, 0, 3], [1, 3, 2]] };
            assert_eq!(wrong(&mesh).len(), expected, "{z}");
        }
    }
}
