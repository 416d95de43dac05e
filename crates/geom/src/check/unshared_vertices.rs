//! Vertices that were likely meant to be one.

use super::near::{Look, farthest};
use super::{DefectKind, Measure, Severity, Shows};
use crate::parallel::prelude::*;
use crate::space::{Aabb, minus, norm};
use crate::topology::union::Sets;

pub(super) const KIND: DefectKind = DefectKind {
    name: "unshared_vertices",
    severity: Severity::Error,
    about: "Groups of vertices on the boundary that lie within the gap of one another, directly or through others of the \
            group, and are not joined by an edge: were they one, facets would be neighbors.",
    size: "diagonal of their box, mm",
    measure: Measure::Diagonal,
    shows: Shows::Points,
    follows: false,
    missing: None,
    find: |m| {
        let near = m.boundary.near(m.mesh);
        let vertices = m.boundary.vertices();
        let sets = Sets::new(vertices.len());
        let place = |v: u32| vertices.partition_point(|x| *x < v) as u32;
        let join = |v: u32, w: u32| {
            let free = v != w && !m.topology.has_edge(m.mesh, [v, w]);
            if free {
                sets.join(place(v), place(w));
            }
            free
        };
        // One vertex speaks for all of very many in one place.
        let clusters = near.clusters(m.gap, &join);
        vertices.par_iter().for_each(|&v| {
            if m.progress.cancelled() {
                return;
            }
            let at = m.mesh.positions[v as usize];
            let reaches = |b: &Aabb| (0..3).all(|k| at[k] >= b.min[k] - m.gap && at[k] <= b.max[k] + m.gap);
            let look = |node: usize, b: &Aabb| match (reaches(b), clusters[node]) {
                (false, _) => Look::Past,
                (true, true) if farthest(at, b) * (1.0 + 1e-12) <= m.gap => Look::Any,
                _ => Look::Into,
            };
            near.look(look, |p, other| norm(minus(*p, at)) <= m.gap && join(v, other));
        });
        let mut members: Vec<(u32, u32)> = (0..vertices.len() as u32).map(|i| (sets.root(i), i)).collect();
        members.sort_unstable();
        let groups: Vec<&[(u32, u32)]> =
            members.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1).collect();
        m.each(&groups, |group| {
            let mut finding =
                m.finding(vec![], group.iter().map(|(_, i)| vertices[*i as usize]).collect(), 0.0);
            finding.size = finding.bounds.diagonal();
            finding
        })
    },
};

#[cfg(test)]
mod tests {
    use super::KIND;
    use crate::check::{Options, check};
    use crate::mesh::Mesh;
    use crate::num::random::Random;
    use crate::progress::Silent;
    use crate::space::{Point, minus, norm};
    use crate::topology::union::Sets;

    /// Groups of vertices by looking at all pairs; in the mesh all lie on the boundary.
    fn plain(mesh: &Mesh, gap: f64) -> Vec<Vec<u32>> {
        let n = mesh.positions.len() as u32;
        let sets = Sets::new(n as usize);
        let at = |v: u32| mesh.positions[v as usize];
        let edge = |a: u32, b: u32| mesh.faces.iter().any(|f| f.contains(&a) && f.contains(&b));
        for (a, b) in (0..n).flat_map(|a| (0..a).map(move |b| (a, b))) {
            if norm(minus(at(a), at(b))) <= gap && !edge(a, b) {
                sets.join(a, b);
            }
        }
        let mut groups = std::collections::BTreeMap::<u32, Vec<u32>>::new();
        (0..n).for_each(|v| groups.entry(sets.root(v)).or_default().push(v));
        groups.into_values().filter(|g| g.len() > 1).collect()
    }

    #[test]
    fn groups_are_those_of_all_pairs() {
        let random = &mut Random::new(8);
        for case in 0..60 {
            // Facets about as large as the gap, smaller, and larger, in crowds.
            let size = [0.02, 0.2, 2.0][case % 3];
            let mut mesh = Mesh::default();
            for _ in 0..5 + case {
                let n = mesh.positions.len() as u32;
                let middle: Point = std::array::from_fn(|_| f64::from(random.below(2) as u32));
                let place = |random: &mut Random| middle.map(|x| x + size * (random.unit() - 0.5));
                mesh.positions.extend((0..3).map(|_| place(random)));
                mesh.faces.push([n, n + 1, n + 2]);
            }
            let gap = 0.1;
            let options = Options { gap: Some(gap), ..Options::default() };
            let report = check(&mesh, None, &options, &Silent).unwrap();
            let mut found: Vec<Vec<u32>> =
                report.found(&KIND).unwrap().items.iter().map(|f| f.vertices.clone()).collect();
            found.sort();
            let mut expected = plain(&mesh, gap);
            expected.sort();
            assert_eq!(found, expected, "{case}");
        }
    }
}
