//! Every computation that may last stops when it is told to, whenever that is.

use super::*;
use crate::check::{self, Precondition, check, intersect};
use crate::closest::{BoundaryEdges, Query, Signs, Tree, Winding};
use crate::deviation::surface::{ReferenceSurface, SurfaceOptions};
use crate::mesh::Mesh;
use crate::samples::{add, cube, on_threads, sphere};
use crate::topology::Topology;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// Wants to stop from the question of this number on; counts the questions.
struct After(usize, AtomicUsize);

impl Progress for After {
    fn cancelled(&self) -> bool {
        self.1.fetch_add(1, Relaxed) >= self.0
    }
}

/// Two spheres that cross, one with holes, and doubled facets: something to do for every step.
fn broken() -> Mesh {
    let mut mesh = sphere(24, 10.0, [0.0; 3]);
    let mut f = 0;
    mesh.faces.retain(|_| {
        f += 1;
        f % 97 != 0
    });
    add(&mut mesh, &sphere(20, 6.0, [0.0; 3]), [8.0, 1.0, 0.5]);
    mesh.faces.extend_from_within(30..60);
    mesh.faces[100].swap(0, 1);
    mesh
}

/// A name, and whether the work was stopped.
type Job<'a> = (&'a str, Box<dyn Fn(&dyn Progress) -> bool + Sync + 'a>);

fn jobs<'a>(mesh: &'a Mesh, tree: &'a Tree, whole: &'a ReferenceSurface) -> Vec<Job<'a>> {
    let surface = SurfaceOptions { skip_boundary: true, ..SurfaceOptions::default() };
    let topology = Topology::of(mesh).unwrap();
    let few = topology.shell_of.iter().map(|_| true).collect::<Vec<bool>>();
    let again = Topology::of(mesh).unwrap();
    vec![
        ("topology", Box::new(|p| Topology::watched(mesh, p).is_err())),
        ("precondition", Box::new(|p| Precondition::of(mesh, 9, p).is_err())),
        ("check", Box::new(|p| check(mesh, None, &check::Options::default(), p).is_err())),
        ("crossings", Box::new(move |p| intersect::self_intersections(mesh, &topology, p).is_err())),
        (
            "few crossings",
            Box::new(move |p| {
                intersect::selected_self_intersections(mesh, &again, &few, 1 << 30, p).is_err()
            }),
        ),
        ("tree", Box::new(|p| Tree::build_watched(mesh, p).is_err())),
        ("signs", Box::new(|p| Signs::watched(tree, p).is_err())),
        ("boundary edges", Box::new(|p| BoundaryEdges::watched(tree, p).is_err())),
        ("distances", Box::new(|p| tree.distances(&mesh.positions, &Query::default(), p).is_err())),
        ("winding", Box::new(|p| Winding::new(tree).numbers(&mesh.positions, p).is_err())),
        ("surface", Box::new(move |p| ReferenceSurface::new(tree, mesh, &surface, p).is_err())),
        ("deviations", Box::new(|p| whole.deviations(&mesh.positions, p).is_err())),
        ("disagreement", Box::new(|p| whole.disagreement(&mesh.positions, p).is_err())),
    ]
}

#[test]
fn all_stop_when_they_are_told_to() {
    for mesh in [broken(), cube(2.0)] {
        let tree = Tree::build(&mesh).unwrap();
        let whole = ReferenceSurface::new(&tree, &mesh, &SurfaceOptions::default(), &Silent).unwrap();
        for (name, job) in jobs(&mesh, &tree, &whole) {
            let run = |after: usize| {
                on_threads(1, || {
                    let progress = After(after, AtomicUsize::new(0));
                    (job(&progress), progress.1.into_inner())
                })
            };
            let (stopped, asked) = run(usize::MAX);
            assert!(!stopped && asked > 0, "{name} asks {asked} times");
            for after in [0, 1, 2, 3, asked / 4, asked / 2, asked - asked / 4, asked - 1] {
                assert!(run(after.min(asked - 1)).0, "{name} goes on after {after} of {asked}");
            }
        }
    }
}
