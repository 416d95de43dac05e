use super::*;
use crate::num::predicates;
use crate::num::random::Random;
use crate::progress::Silent;
use crate::samples::on_threads;
use crate::space::{Aabb, Point, plus};
use crate::topology::tests::levels;
use crate::topology::weld;
use std::collections::HashMap;

type Facet = [Point; 3];

/// Compares all levels with all pairs, one by one; returns their number.
fn check(name: &str, facets: &[Facet]) -> usize {
    let mesh = weld::corners(facets.len(), |f, k| facets[f][k]).unwrap();
    let topology = Topology::of(&mesh).unwrap();
    let corners = |f: &[u32; 3]| mesh.places(f);
    let flat = |f: &[u32; 3]| predicates::axis(&corners(f)).is_none();
    let mut want = vec![];
    for (j, g) in mesh.faces.iter().enumerate().filter(|(_, g)| !flat(g)) {
        for (i, f) in mesh.faces[..j].iter().enumerate().filter(|(_, f)| !flat(f)) {
            if meet::meet(&(corners(f), *f), &(corners(g), *g)) {
                want.push([i as u32, j as u32]);
            }
        }
    }
    want.sort_unstable();
    for (level, threads) in levels().flat_map(|l| [(l, 1), (l, 3)]) {
        for limit in [usize::MAX, 7, 0] {
            let search = Search {
                mesh: &mesh,
                topology: &topology,
                selected: None,
                limit,
                most: usize::MAX,
                alone: threads == 1,
            };
            let got = on_threads(threads, || with(&search, &Silent, level)).unwrap();
            let first = &want[..want.len().min(limit)];
            assert_eq!(got.count, want.len(), "{name} {level:?} {threads} {limit}");
            assert!(got.first == first, "{name} {level:?} {threads} {limit}");
        }
        // The last tenth, every third, the first, none.
        let n = mesh.faces.len();
        let chosen: [&dyn Fn(usize) -> bool; 4] =
            [&|f| f >= n - n / 10, &|f| f % 3 == 0, &|f| f == 0, &|_| false];
        for (i, chosen) in chosen.into_iter().enumerate() {
            let selected: Vec<bool> = (0..n).map(chosen).collect();
            let mut want = want.clone();
            want.retain(|pair| pair.iter().any(|f| selected[*f as usize]));
            for most in [usize::MAX, want.len(), want.len().saturating_sub(1), 3] {
                let (selected, limit) = (Some(&selected[..]), usize::MAX);
                let search = Search { mesh: &mesh, topology: &topology, selected, limit, most, alone: false };
                let got = on_threads(threads, || with(&search, &Silent, level)).unwrap();
                assert_eq!(got.count > most, want.len() > most, "{name} {i} {level:?} {threads} {most}");
                assert!(got.count > most || got.first == want, "{name} {i} {level:?} {threads} {most}");
            }
        }
    }
    want.len()
}

#[test]
fn whole_numbers_touch_overlap_and_degenerate() {
    let random = &mut Random::new(1);
    for (n, side) in [(0, 2), (1, 2), (9, 2), (40, 3), (150, 4), (220, 9), (300, 40)] {
        let mut corner = || std::array::from_fn(|_| random.below(side) as f64 - 1.0);
        let facets: Vec<Facet> = (0..n).map(|_| std::array::from_fn(|_| corner())).collect();
        check(&format!("whole numbers {side}"), &facets);
        let shifted: Vec<Facet> = facets.iter().map(|f| f.map(|p| p.map(|x| x * 0.1 + 1e3))).collect();
        check(&format!("tenths {side}"), &shifted);
    }
}

#[test]
fn loose_facets_in_both_precisions() {
    let random = &mut Random::new(2);
    for (n, size) in [(800, 0.1), (800, 0.5), (1200, 1e-3)] {
        let facets: Vec<Facet> = (0..n)
            .map(|_| {
                let c: Point = std::array::from_fn(|_| random.unit());
                std::array::from_fn(|_| std::array::from_fn(|k| c[k] + size * random.unit()))
            })
            .collect();
        let single: Vec<Facet> = facets.iter().map(|f| f.map(|p| p.map(|x| f64::from(x as f32)))).collect();
        let pairs = [check(&format!("soup {size}"), &facets), check(&format!("single soup {size}"), &single)];
        assert!(size < 0.5 || pairs[0] > 100);
    }
}

/// Facets of a few steps of the numbers, at corners of large ones: rounded to the frame they may look to any side.
#[test]
fn facets_smaller_than_the_frame_can_tell() {
    let random = &mut Random::new(4);
    let mut found = 0;
    for turn in 0..40 {
        let hub: Point = std::array::from_fn(|_| random.unit() - 0.5);
        let mut large = || std::array::from_fn(|_| 4.0 * random.unit() - 2.0);
        let mut facets: Vec<Facet> = (0..6).map(|_| [hub, large(), large()]).collect();
        let mut near = || hub.map(|x| x + (random.below(9) as f64 - 4.0) * (x.abs().next_up() - x.abs()));
        facets.extend((0..12).map(|_| [hub, near(), near()]));
        found += check(&format!("steps {turn}"), &facets);
    }
    assert!(found > 300, "{found}");
}

/// Nearly flat, and one plane at a slope: everything hangs on signs that rounding cannot tell.
#[test]
fn planes_that_rounding_cannot_tell_apart() {
    let random = &mut Random::new(3);
    let cases = [
        ("plane", 1.0, 0.0, 0.0),
        ("rough", 1e-3, 1e3, 1e-7),
        ("far", 1e-3, 1e9, 1e-4),
        ("tiny", 1e-30, 0.0, 0.01),
        ("huge", 1e30, 0.0, 0.01),
    ];
    for ((name, scale, offset, noise), single) in cases.into_iter().flat_map(|c| [(c, true), (c, false)]) {
        let (n, mut at, mut facets) = (20, HashMap::new(), vec![]);
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let mut p = |i: i32, j: i32| -> Point {
                *at.entry((i, j)).or_insert_with(|| {
                    let (x, y) = (f64::from(i), f64::from(j));
                    let p = [
                        (x + noise * random.unit()) * scale + offset,
                        y * scale,
                        ((x + y) * 0.1 + noise * random.unit()) * scale,
                    ];
                    if single { p.map(|x| f64::from(x as f32)) } else { p }
                })
            };
            let (a, b, c, e) = (p(i, j), p(i + 1, j), p(i + 1, j + 1), p(i, j + 1));
            facets.extend([[a, b, c], [a, c, e]]);
        }
        facets.push([at[&(3, 3)], at[&(9, 4)], at[&(5, 12)]]);
        facets.push([at[&(0, 0)], at[&(1, 0)], at[&(2, 1)]]);
        let pairs = check(&format!("{name} {single}"), &facets);
        assert!(pairs > 10 || name == "far", "{name} {single} {pairs}");
    }
}

#[test]
fn a_cancelled_search_says_so() {
    struct Never;
    impl Progress for Never {
        fn cancelled(&self) -> bool {
            true
        }
    }
    let mesh = crate::samples::block(5, 1.0);
    let topology = Topology::of(&mesh).unwrap();
    assert_eq!(self_intersections(&mesh, &topology, &Never), Err(Cancelled));
    assert_eq!(self_intersections(&mesh, &topology, &Silent), Ok(vec![]));
}

/// Fans of very many facets around one vertex: flat, on a cone, with corners near and far, and with facets at wrong places.
#[test]
fn vertices_with_very_many_facets() {
    let random = &mut Random::new(4);
    for (shape, height, rough, planted) in [
        ("disc", 0.0, 0.0, 0),
        ("disc", 0.0, 0.5, 30),
        ("cone", 3.0, 0.0, 30),
        ("spikes", 2.0, 0.9, 30),
        ("ball", 0.0, 0.5, 60),
    ] {
        let n = 700;
        let mut at = |i: usize| -> Point {
            if shape == "ball" {
                return std::array::from_fn(|_| random.unit() - 0.5);
            }
            let (turn, far) = (i as f64 / n as f64 * std::f64::consts::TAU, 1.0 - rough * random.unit());
            [10.0 * far * libm::cos(turn), 10.0 * far * libm::sin(turn), -height * far]
        };
        let ring: Vec<Point> = (0..n).map(&mut at).collect();
        let hub = [0.25, 0.5, 1.0];
        let place = |p: &Point| -> Point { std::array::from_fn(|k| p[k] + hub[k]) };
        let mut facets: Vec<Facet> =
            (0..n).map(|i| [hub, place(&ring[i]), place(&ring[(i + 1) % n])]).collect();
        // Others at the hub, facets that have nothing to do with it, and a second vertex with very many.
        let mut any = || random.below(n as u64) as usize;
        for i in 0..planted {
            let (a, b, c) = (place(&ring[any()]), place(&ring[any()]), place(&ring[any()]));
            facets.push(if i % 3 == 0 { [a, b, c] } else { [hub, a, b] });
        }
        if shape == "cone" {
            let other = [0.0, 0.0, -9.0];
            facets.extend((0..n).map(|i| [other, place(&ring[i]), place(&ring[(i + 1) % n])]));
            // And some that have both.
            facets.extend((0..520).map(|i| [hub, other, place(&ring[i])]));
        }
        for single in [true, false] {
            let facets: Vec<Facet> = facets
                .iter()
                .map(|f| f.map(|p| p.map(|x| if single { f64::from(x as f32) } else { x })))
                .collect();
            let pairs = check(&format!("{shape} {rough} {single}"), &facets);
            assert!(pairs >= planted, "{shape} {rough} {single}: {pairs}");
        }
    }
}

/// Counts how often a search asks whether to go on: once for each pair that may meet, each leaf, and each part of a tree.
fn asked(mesh: &Mesh) -> (usize, usize) {
    struct Asked(AtomicUsize);
    impl Progress for Asked {
        fn cancelled(&self) -> bool {
            self.0.fetch_add(1, Relaxed);
            false
        }
    }
    let (topology, counter) = (Topology::of(mesh).unwrap(), Asked(AtomicUsize::new(0)));
    let found = first_self_intersections(mesh, &topology, 10, &counter).unwrap();
    (counter.0.into_inner(), found.count)
}

/// Two fans of `n / 2` facets in a plane, on both sides of a line whose places they share.
fn seam(n: usize) -> Vec<Facet> {
    let along = |i: usize| 2.0 * i as f64 / n as f64;
    let place = |s: f64, t: f64| [0.8 * s - 0.36 * t, 0.6 * s + 0.48 * t, 0.8 * t + 0.1];
    let of = |i: usize| {
        let (a, b) = (place(along(i), 0.0), place(along(i + 1), 0.0));
        [[a, b, place(0.6, 0.7)], [b, a, place(0.3, -0.5)]]
    };
    (0..n / 2).flat_map(of).collect()
}

/// Work grows little faster than the facets: around two vertices, around one edge, upon each other.
#[test]
fn crowds_take_n_log_n() {
    let round = |i: usize, n: usize| (i as f64 / n as f64) * std::f64::consts::TAU;
    let rim = |i: usize, n: usize, z: f64| [libm::cos(round(i, n)), libm::sin(round(i, n)), z];
    let bicone = |n: usize| -> Vec<Facet> {
        let of = |i: usize| {
            let (a, b) = (rim(i, n, 0.0), rim((i + 1) % n, n, 0.0));
            [[[0.0, 0.0, 1.0], a, b], [[0.0; 3], b, a]]
        };
        (0..n).flat_map(of).collect()
    };
    let book = |n: usize| (0..n).map(|i| [[0.0; 3], [0.0, 0.0, 1.0], rim(i, n, 0.5)]).collect();
    // Every second gap between pages is closed by a facet at either end of the spine.
    let closed_book = |n: usize| -> Vec<Facet> {
        let of = |i: usize| {
            let (a, b) = (rim(i, n, 0.5), rim(i + 1, n, 0.5));
            let lids =
                [[[0.0; 3], a, b], [[0.0, 0.0, 1.0], b, a]].into_iter().filter(move |_| i.is_multiple_of(2));
            std::iter::once([[0.0; 3], [0.0, 0.0, 1.0], a]).chain(lids)
        };
        (0..n / 2).flat_map(of).collect()
    };
    let coincident = |n: usize| -> Vec<Facet> {
        let block = crate::samples::block(1, 1.0);
        let facets = block.faces.iter().map(|f| block.places(f));
        facets.cycle().take(12 * (n / 12)).collect()
    };
    // Their tips are a hair apart.
    let needles = |n: usize| -> Vec<Facet> {
        let of = |i: usize| {
            let (a, b) = (rim(i, n, 0.0), rim(i + 1, n, 0.0));
            [rim(2 * i + 1, 2 * n, 1e5).map(|x| x * 1e-5), a, b]
        };
        (0..n).step_by(2).map(of).collect()
    };
    type Shape<'a> = (&'a str, &'a dyn Fn(usize) -> Vec<Facet>);
    let shapes: [Shape; 6] = [
        ("needles", &needles),
        ("bicone", &bicone),
        ("book", &book),
        ("closed book", &closed_book),
        ("coincident", &coincident),
        ("seam", &seam),
    ];
    for (name, shape) in shapes {
        let work = [2000, 8000, 32_000].map(|n| {
            let facets = shape(n);
            let (asked, found) = asked(&weld::corners(facets.len(), |f, k| facets[f][k]).unwrap());
            assert_eq!(found, 0, "{name} {n}");
            asked.max(1000)
        });
        // Four times the facets: a square would be sixteen times the work.
        assert!(work.windows(2).all(|w| w[1] < 7 * w[0]), "{name} {work:?}");
        assert!(work[2] < 32_000 * 40, "{name} {work:?}");
    }
}

/// Tips near one place, but not at one vertex, are searched as around one, and the pairs are the same.
#[test]
fn crowds_cross_where_they_do() {
    let random = &mut Random::new(8);
    for (apart, single) in [(1e-3, false), (1e-6, false), (1e-6, true), (1e-12, false)] {
        let mut ball = |size: f64| -> Point { std::array::from_fn(|_| size * (random.unit() - 0.5)) };
        let center = [0.3, 0.7, -0.2];
        let mut facet = || {
            let (far, tip) = (plus(center, ball(4.0)), plus(center, ball(apart)));
            [tip, far, plus(far, ball(0.5))]
        };
        let mut facets: Vec<Facet> = (0..700).map(|_| facet()).collect();
        facets.extend((0..30).map(|_| [ball(3.0), ball(3.0), ball(3.0)]));
        if single {
            facets.iter_mut().flatten().flatten().for_each(|x| *x = f64::from(*x as f32));
        }
        let mesh = weld::corners(facets.len(), |f, k| facets[f][k]).unwrap();
        let hubs = crowd::crowds(&mesh, &mut vec![true; facets.len()]);
        assert!(hubs.iter().flat_map(Hub::facets).count() > 600, "{apart}");
        assert!(check(&format!("crowd {apart} {single}"), &facets) > 1000);
    }
}

/// Two fans that cross see each other's facets long and thin: what is looked at grows as what is found.
#[test]
fn fans_that_cross_take_what_they_find() {
    let bicone = |n: usize, by: Point| -> Vec<Facet> {
        let rim = |i: usize| {
            let (sin, cos) = libm::sincos(i as f64 / n as f64 * std::f64::consts::TAU);
            plus([cos, sin, 0.0], by)
        };
        let of = |i: usize| {
            let (a, b) = (rim(i), rim((i + 1) % n));
            [[plus([0.0, 0.0, 1.0], by), a, b], [by, b, a]]
        };
        (0..n).flat_map(of).collect()
    };
    let pair = |n: usize| [bicone(n, [0.0; 3]), bicone(n, [0.1, 0.05, 0.02])].concat();
    assert!(check("fans", &pair(520)) > 500);
    let work = [1000, 4000, 16_000].map(|n| {
        let facets = pair(n);
        let (asked, found) = asked(&weld::corners(facets.len(), |f, k| facets[f][k]).unwrap());
        assert!(found > n && found < 4 * n, "{n}: {found}");
        asked
    });
    // Four times the facets: a square would be sixteen times the work.
    assert!(work.windows(2).all(|w| w[1] < 7 * w[0]) && work[2] < 16_000 * 40, "{work:?}");
}

/// Books with pages folded upon each other, and facets that are there several times and cross others.
#[test]
fn books_and_copies_that_cross() {
    let random = &mut Random::new(7);
    let mut facets: Vec<Facet> = vec![];
    for i in 0..600 {
        let (turn, far) = (f64::from(i % 550) * 0.01, 1.0 + random.unit());
        facets.push([[0.0; 3], [0.0, 0.0, 4.0], [far * libm::cos(turn), far * libm::sin(turn), 1.0]]);
        if i % 20 == 0 {
            let whole = f64::from(i / 20);
            facets.push([[0.0; 3], [0.0, 0.0, 4.0], [whole + 1.0, whole + 1.0, 2.0]]);
            facets.push([[0.0; 3], [0.5, whole / 9.0, 3.0], [0.75, 0.5, whole / 9.0]]);
            facets.push([[-1.0, 0.5, whole / 7.0], [2.0, 0.5, 1.0], [0.5, 2.0, 2.0]]);
            // At an end of the spine, narrow, wide, across the angle at which numbers jump, and around the spine.
            let at = |turn: f64| [libm::cos(whole + turn), libm::sin(whole + turn), whole / 8.0];
            facets.push([[0.0; 3], at(0.0), at(0.03)]);
            facets.push([[0.0, 0.0, 4.0], at(0.0), at(2.0)]);
            facets.push([[0.0, 0.0, 4.0], at(0.5), at(0.5 + std::f64::consts::PI)]);
            facets.push([at(0.0), at(2.1), at(4.2)]);
        }
    }
    assert!(check("book", &facets) > 500);
    assert_eq!(check("seam", &seam(600)), 0);
    // The apex of one fan is pulled across the seam.
    let mut folded = seam(600);
    folded.iter_mut().step_by(2).for_each(|f| f[2] = plus(f[2], [0.36, -0.48, -0.8]));
    assert!(check("folded seam", &folded) > 500);
    for i in (0..facets.len()).step_by(5) {
        let [a, b, c] = facets[i];
        facets.extend([[b, c, a], [c, b, a]]);
    }
    facets.truncate(900);
    assert!(check("copies", &facets) > 1000);
}

/// The count of a tangle is a lower bound, and the list does not depend on the threads.
#[test]
fn a_tangle_is_not_counted_to_the_end() {
    let random = &mut Random::new(8);
    let corners: Vec<Point> = (0..4000).map(|_| [random.unit(), random.unit(), 0.0]).collect();
    let facets: Vec<Facet> = (1..3999).map(|i| [corners[0], corners[i], corners[i + 1]]).collect();
    let mesh = weld::corners(facets.len(), |f, k| facets[f][k]).unwrap();
    let topology = Topology::of(&mesh).unwrap();
    let run =
        |threads| on_threads(threads, || first_self_intersections(&mesh, &topology, 50, &Silent)).unwrap();
    let found = run(1);
    assert_eq!((found.count, found.at_least, found.first.len()), (MAX_PAIRS_TO_FIRST, true, 50));
    assert_eq!(found, run(3));
    let triangle = |f: u32| {
        let face = mesh.faces[f as usize];
        (mesh.places(&face), face)
    };
    assert!(found.first.iter().all(|[a, b]| a < b && meet::meet(&triangle(*a), &triangle(*b))));
}

/// The same facets as are listed box by box, each once; around a hub too, whose facets every box meets.
#[test]
fn facets_in_reach_of_any_box_are_those_in_reach_of_some() {
    let random = &mut Random::new(31);
    for case in 0..40 {
        let (n, single) = (1 + random.below(3000) as usize, case % 2 == 0);
        let mut place = || -> Point {
            let p: Point = std::array::from_fn(|_| 3.0 * random.unit());
            if single { p.map(|x| f64::from(x as f32)) } else { p }
        };
        let hub = place();
        let facets: Vec<Facet> = (0..n)
            .map(|f| {
                let a = if f % 3 == 0 { hub } else { place() };
                let size = if f % 5 == 0 { 1.0 } else { 0.05 };
                [
                    a,
                    plus(a, place().map(|x| size * x)),
                    if f % 50 == 0 { a } else { plus(a, place().map(|x| size * x)) },
                ]
            })
            .collect();
        let mesh = weld::corners(facets.len(), |f, k| facets[f][k]).unwrap();
        let topology = Topology::of(&mesh).unwrap();
        let boxes: Vec<Aabb> = (0..case).map(|i| Aabb::of(&facets[i * 7 % n])).collect();
        let mut want: Vec<u32> =
            reaching(&mesh, &topology, &boxes, usize::MAX, &Silent).unwrap().unwrap().concat();
        want.sort_unstable();
        want.dedup();
        assert_eq!(reaching_any(&mesh, &topology, &boxes, &Silent).unwrap(), want, "{case}");
    }
}
