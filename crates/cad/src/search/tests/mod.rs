use super::*;
use crate::frame::Frame;
use profile::{Piece, arc, polygon};
use solids::{Part, Solid, extruded, turned};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use trueness_geom::num::random::Random;
use trueness_geom::progress::Silent;
use trueness_geom::space::plus;

mod family;
mod profile;
mod solids;
mod splines;

fn spot(random: &mut Random, size: f64) -> Point {
    [0, 1, 2].map(|_| size * (2.0 * random.unit() - 1.0))
}

fn frame(random: &mut Random) -> Frame {
    Frame::new(spot(random, 1.0), spot(random, 1.0), Some(spot(random, 1.0))).unwrap()
}

/// The nearest place by trying everything.
fn brute<R: Region>(search: &Search<R>, p: &Point) -> Nearest {
    let mut best = Best::none(search.0.rivals_within);
    for (number, face) in search.0.faces.iter().enumerate() {
        let (Some(region), shell) = (&face.region, face.shell) else { continue };
        let on = On::Face(number as u32);
        for foot in face.feet.surface().feet(*p) {
            if region.contains(foot.parameters) {
                let Foot { parameters, place, distance } = foot;
                best.take(Candidate { distance, place, on, parameters, shell });
            }
        }
    }
    for target in &search.0.targets {
        if !matches!(target, Target::Unit { .. }) {
            search.look(*target, p, best.reach(), &mut best);
        }
    }
    search.describe(p, &best)
}

/// Solids of all kinds: corners, rounded and tangential edges, seams, holes, poles, apexes, cutting edges.
fn solids(random: &mut Random) -> Vec<(&'static str, Solid)> {
    let mut all = extrusions(random);
    all.extend(turned_solids(random));
    all
}

/// Extruded ones.
fn extrusions(random: &mut Random) -> Vec<(&'static str, Solid)> {
    let r = 0.4 + 0.2 * random.unit();
    let slot = vec![
        Piece::Line { from: [-1.0, -r], to: [1.0, -r] },
        arc([1.0, 0.0], r, [-FRAC_PI_2, FRAC_PI_2]),
        Piece::Line { from: [1.0, r], to: [-1.0, r] },
        arc([-1.0, 0.0], r, [FRAC_PI_2, 3.0 * FRAC_PI_2]),
    ];
    let hook = polygon(&[[0.0, 0.0], [2.0, 0.0], [2.0, 0.5], [0.6, 0.7], [0.5, 2.0], [0.0, 2.0]]);
    let notch = vec![
        Piece::Line { from: [-1.5, -1.0], to: [1.5, -1.0] },
        Piece::Line { from: [1.5, -1.0], to: [1.5, 0.0] },
        Piece::Line { from: [1.5, 0.0], to: [0.5, 0.0] },
        arc([0.0, 0.0], 0.5, [0.0, -PI]),
        Piece::Line { from: [-0.5, 0.0], to: [-1.5, 0.0] },
        Piece::Line { from: [-1.5, 0.0], to: [-1.5, -1.0] },
    ];
    let disc = vec![arc([0.0, 0.0], 1.5, [0.3, 0.3 + TAU])];
    let hole = vec![arc([0.2, 0.1], 0.6, [1.0 + TAU, 1.0])];
    // Two circles that touch within: a crescent, with material that ends in a cutting edge.
    let crescent = vec![arc([0.0, 0.0], 2.0, [0.0, TAU]), arc([1.0, 0.0], 1.0, [TAU, 0.0])];
    // Arcs about (0, ±2.5) touch at the origin and reach (2, ±1): a slit between them, and a horn.
    let angle = 1.5f64.atan2(2.0);
    let slit = vec![
        Piece::Line { from: [-2.0, -2.0], to: [2.0, -2.0] },
        Piece::Line { from: [2.0, -2.0], to: [2.0, -1.0] },
        arc([0.0, -2.5], 2.5, [angle, FRAC_PI_2]),
        arc([0.0, 2.5], 2.5, [-FRAC_PI_2, -angle]),
        Piece::Line { from: [2.0, 1.0], to: [2.0, 2.0] },
        Piece::Line { from: [2.0, 2.0], to: [-2.0, 2.0] },
        Piece::Line { from: [-2.0, 2.0], to: [-2.0, -2.0] },
    ];
    let horn = vec![
        arc([0.0, -2.5], 2.5, [FRAC_PI_2, angle]),
        Piece::Line { from: [2.0, -1.0], to: [2.0, 1.0] },
        arc([0.0, 2.5], 2.5, [-angle, -FRAC_PI_2]),
    ];
    let h = 0.5 + random.unit();
    vec![
        ("slot", vec![slot]),
        ("hook", vec![hook]),
        ("notch", vec![notch]),
        ("ring", vec![disc.clone(), hole]),
        ("disc", vec![disc]),
        ("crescent", vec![crescent]),
        ("slit", vec![slit]),
        ("horn", vec![horn]),
    ]
    .into_iter()
    .map(|(name, chains)| (name, extruded(frame(random), chains, h)))
    .collect()
}

/// Turned ones.
fn turned_solids(random: &mut Random) -> Vec<(&'static str, Solid)> {
    let mut all = vec![];
    let ball = vec![arc([0.0, 0.0], 1.0, [-FRAC_PI_2, FRAC_PI_2])];
    let cone = vec![
        Piece::Line { from: [0.0, 0.0], to: [1.0, 0.0] },
        Piece::Line { from: [1.0, 0.0], to: [0.0, 1.3] },
    ];
    let spinner = vec![
        Piece::Line { from: [0.0, -0.4], to: [1.0, 0.0] },
        Piece::Line { from: [1.0, 0.0], to: [0.0, 1.3] },
    ];
    let dent = vec![
        Piece::Line { from: [0.0, 0.0], to: [1.5, -0.5] },
        Piece::Line { from: [1.5, -0.5], to: [1.5, 1.0] },
        Piece::Line { from: [1.5, 1.0], to: [0.7, 1.0] },
        Piece::Line { from: [0.7, 1.0], to: [0.0, 0.4] },
    ];
    let torus = vec![arc([1.5, 0.0], 0.6, [-1.0, -1.0 + TAU])];
    let lens =
        vec![arc([0.0, 1.0], 2.0, [-FRAC_PI_2, -PI / 6.0]), arc([0.0, -1.0], 2.0, [PI / 6.0, FRAC_PI_2])];
    let bottle = vec![
        Piece::Line { from: [0.0, 0.0], to: [0.7, 0.0] },
        arc([0.7, 0.3], 0.3, [-FRAC_PI_2, 0.0]),
        Piece::Line { from: [1.0, 0.3], to: [1.0, 1.0] },
        arc([0.7, 1.0], 0.3, [0.0, FRAC_PI_2]),
        arc([0.7, 1.6], 0.3, [-FRAC_PI_2, -PI]),
        Piece::Line { from: [0.4, 1.6], to: [0.4, 2.0] },
        Piece::Line { from: [0.4, 2.0], to: [0.0, 2.0] },
    ];
    let apple = vec![arc([0.3, 0.0], 1.0, [-(-0.3f64).acos(), (-0.3f64).acos()])];
    let lemon = vec![arc([-0.3, 0.0], 1.0, [-(0.3f64).acos(), (0.3f64).acos()])];
    for (name, chain) in [
        ("ball", ball),
        ("cone", cone),
        ("spinner", spinner),
        ("dent", dent),
        ("torus", torus),
        ("lens", lens),
        ("bottle", bottle),
        ("apple", apple),
        ("lemon", lemon),
    ] {
        all.push((name, turned(frame(random), chain)));
    }
    all
}

/// Points of interest: around the solid, near its surface, and over and under its corners and axes.
fn points(random: &mut Random, solid: &Solid, count: usize) -> Vec<Point> {
    let mut points: Vec<Point> = (0..count).map(|_| spot(random, 4.0)).collect();
    for edge in &solid.brep.edges {
        for share in [0.0, 0.35, 0.8] {
            let place = edge.span.derivatives(share)[0];
            points.extend((0..4).map(|_| plus(place, spot(random, 0.3))));
            points.extend((0..2).map(|_| plus(place, spot(random, 1e-3))));
        }
    }
    points
        .extend(solid.brep.vertices.iter().flat_map(|v| [0.3, 1e-4].map(|s| plus(v.place, spot(random, s)))));
    points
}

#[test]
fn the_search_is_its_brute_force_twin() {
    let mut random = Random::new(17);
    for _ in 0..3 {
        for (name, solid) in solids(&mut random) {
            let search = Search::new(&solid.brep, solid.parts.clone());
            for p in points(&mut random, &solid, 150) {
                let (own, twin) = (search.nearest(&p), brute(&search, &p));
                assert!(own.distance == twin.distance, "{name} {p:?} {own:?} {twin:?}");
                assert!(own.on == twin.on, "{name} {p:?} {own:?} {twin:?}");
                assert!((norm(minus(own.place, p)) - own.distance).abs() < 1e-14);
            }
        }
    }
}

#[test]
fn sides_are_those_of_the_closed_forms() {
    let mut random = Random::new(23);
    for _ in 0..4 {
        for (name, solid) in solids(&mut random) {
            let search = Search::new(&solid.brep, solid.parts.clone());
            for p in points(&mut random, &solid, 150) {
                let own = search.nearest(&p);
                if own.distance < 1e-9 {
                    continue;
                }
                let expected = if solid.holds(p) { Side::Inside } else { Side::Outside };
                assert_eq!(own.side, expected, "{name} {p:?} {own:?}");
            }
        }
    }
}

#[test]
fn a_map_is_the_same_on_any_number_of_threads() {
    let mut random = Random::new(31);
    let (_, solid) = solids(&mut random).swap_remove(0);
    let search = Search::new(&solid.brep, solid.parts.clone());
    let points: Vec<Point> = (0..3000).map(|_| spot(&mut random, 3.0)).collect();
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| search.map(&points, &Silent, |_, n| (n.distance.to_bits(), n.on))).unwrap()
    };
    assert_eq!(run(1), run(3));
    assert!(search.map(&[[f64::NAN; 3]], &Silent, |_, _| ()).is_err());
    assert!(search.nearest(&[f64::NAN; 3]).distance.is_nan());
    let empty: Search<Part> = Search::new(&Brep::default(), vec![]);
    assert!(empty.nearest(&[0.0; 3]).distance.is_nan());
}

#[test]
fn open_boundaries_have_no_side_at_their_end() {
    let mut random = Random::new(41);
    let solid =
        extruded(frame(&mut random), vec![polygon(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]])], 1.0);
    let mut parts = solid.parts.clone();
    parts[5] = None;
    let search = Search::new(&solid.brep, parts);
    let own = solid_frame(&solid);
    let above = search.nearest(&own.place([1.0, 0.3, 1.2]));
    assert_eq!(above.side, Side::Open);
    assert_eq!(search.nearest(&own.place([1.0, 0.3, 0.2])).side, Side::Inside);
    assert_eq!(search.nearest(&own.place([1.0, -0.3, 0.2])).side, Side::Outside);
    // A sheet without edges ends at its sides.
    let sheet = crate::surface::Surface::Cylinder { frame: own, radius: 1.0 };
    let mut brep = Brep::default();
    let bounds = crate::brep::Bounds::Rectangle([[0.0, 1.0], [0.0, 2.0]]);
    let face = crate::brep::Face { surface: sheet, bounds, ..solid.brep.faces[0].clone() };
    brep.faces.push(face);
    let part = Part::Rectangle { sides: [[0.0, 1.0], [0.0, 2.0]], periods: [Some(TAU), None] };
    let search = Search::new(&brep, vec![Some(part)]);
    let near = search.nearest(&own.place([2.0, 0.0, 3.0]));
    assert!((near.distance - 2f64.sqrt()).abs() < 1e-15 && near.side == Side::Open);
    let off = search.nearest(&own.place([0.0, -1.0, 1.0]));
    assert!((off.distance - 2f64.sqrt()).abs() < 1e-15);
    let inner = search.nearest(&own.place([0.5 * 0.5f64.cos(), 0.5 * 0.5f64.sin(), 1.0]));
    assert!((inner.distance - 0.5).abs() < 1e-15 && inner.side == Side::Inside);
}

fn solid_frame(solid: &Solid) -> Frame {
    match &solid.brep.faces[4].surface {
        crate::surface::Surface::Plane(frame) => *frame,
        _ => panic!("the fifth face is the bottom"),
    }
}

#[test]
fn faces_written_as_splines_have_the_same_distances_and_sides() {
    let mut random = Random::new(53);
    for (name, solid) in solids(&mut random) {
        let (brep, parts) = splines::rewritten(&solid);
        let own = Search::new(&brep, parts);
        let closed = Search::new(&solid.brep, solid.parts.clone());
        for p in points(&mut random, &solid, 60) {
            let (a, b) = (own.nearest(&p), closed.nearest(&p));
            assert!((a.distance - b.distance).abs() < 2e-13, "{name} {p:?} {a:?} {b:?}");
            assert!((a.distance - brute(&own, &p).distance).abs() < 1e-13, "{name} {p:?} {a:?}");
            if a.distance > 1e-9 {
                assert_eq!(a.side, b.side, "{name} {p:?} {a:?} {b:?}");
            }
        }
    }
}

#[test]
fn a_point_in_one_of_two_parts_that_touch_is_inside() {
    let own = Frame::new([0.0; 3], [0.0, 0.0, 1.0], Some([1.0, 0.0, 0.0])).unwrap();
    let square = |x: f64| vec![polygon(&[[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]])];
    for order in [[0.0, 1.0], [1.0, 0.0]] {
        let [a, b] = order.map(|x| {
            let mut solid = extruded(own, square(x), 1.0);
            solid.brep.shells.push(crate::brep::Shell { faces: (0..6).collect(), closed: true });
            solid
        });
        let mut brep = Brep::default();
        let placed = crate::frame::Placement::IDENTITY;
        brep.add(&a.brep, &placed, 0);
        brep.add(&b.brep, &placed, 1);
        let parts = a.parts.iter().chain(&b.parts).cloned().collect();
        let search = Search::new(&brep, parts);
        for (x, side) in
            [(0.9, Side::Inside), (1.1, Side::Inside), (-0.1, Side::Outside), (2.1, Side::Outside)]
        {
            let found = search.nearest(&[x, 0.5, 0.45]);
            assert!(found.side == side && (found.distance - 0.1).abs() < 1e-15, "{x} {found:?}");
        }
    }
}
