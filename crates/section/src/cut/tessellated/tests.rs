//! Sections of prisms whose outlines are known, of scans of them, and of meshes with few facets.

use super::*;
use crate::cut;
use crate::{Continuity, Geometry};
use trueness_geom::mesh::Mesh;
use trueness_geom::num::random::Random;
use trueness_geom::plane::Plane;
use trueness_geom::progress::Silent;

/// The walls of prisms over closed outlines, each quad in two facets, rounded to single precision.
fn prisms(outlines: &[Vec<[f64; 2]>], noise: f64) -> Mesh {
    let random = &mut Random::new(11);
    let mut mesh = Mesh::default();
    for outline in outlines {
        let first = mesh.positions.len() as u32;
        let n = outline.len() as u32;
        for p in outline {
            for z in [0.0, 10.0] {
                let off: [f64; 3] = std::array::from_fn(|_| noise * (random.unit() - 0.5));
                let p = [p[0] + off[0], p[1] + off[1], z + off[2]];
                mesh.positions.push(p.map(|x| f64::from(x as f32)));
            }
        }
        for i in 0..n {
            let (a, b) = (first + 2 * i, first + 2 * ((i + 1) % n));
            mesh.faces.push([a, b, b + 1]);
            mesh.faces.push([a, b + 1, a + 1]);
        }
    }
    mesh
}

/// The chords of an arc, its last point left out.
fn arc(center: [f64; 2], radius: f64, from: f64, to: f64, chords: usize) -> Vec<[f64; 2]> {
    (0..chords)
        .map(|i| libm::sincos((from + (to - from) * i as f64 / chords as f64).to_radians()))
        .map(|(s, c)| [center[0] + radius * c, center[1] + radius * s])
        .collect()
}

fn sections(outlines: &[Vec<[f64; 2]>]) -> Vec<Contour> {
    let mesh = prisms(outlines, 0.0);
    let plane = Plane { normal: [0.0, 0.0, 1.0], offset: 3.7 };
    let frame = PlaneFrame { origin: [0.0, 0.0, 3.7], x: [1.0, 0.0, 0.0], y: [0.0, 1.0, 0.0] };
    let own = &CutMesh::new(&mesh, None);
    cut(&mesh, &plane, &Silent)
        .unwrap()
        .iter()
        .map(|chain| chain_contour(chain, &frame, own, &Options::default(), &Silent).unwrap())
        .collect()
}

/// Kinds in order around, from the longest line on.
fn kinds(contour: &Contour) -> Vec<SegmentKind> {
    let mut all: Vec<SegmentKind> = contour.segments.iter().map(|s| s.geometry.kind()).collect();
    let size = |s: &Segment| if s.geometry.kind() == SegmentKind::Line { s.length } else { 0.0 };
    let first = contour.segments.iter().enumerate().max_by(|a, b| size(a.1).total_cmp(&size(b.1)));
    all.rotate_left(first.unwrap().0);
    all
}

/// Each segment ends where the next starts, and every point has its segment.
fn holds_together(contour: &Contour) {
    let n = contour.segments.len();
    for (i, join) in contour.joins.iter().enumerate() {
        assert!(distance(contour.segments[i].end, join.point) < 1e-5, "{i}");
        assert!(distance(contour.segments[(i + 1) % n].start, join.point) < 1e-5, "{i}");
    }
    let count: usize = contour.segments.iter().map(|s| s.count).sum();
    assert_eq!((count, contour.labels.len()), (contour.residuals.len(), contour.stations.len()));
    assert!(contour.segments.iter().all(|s| s.count > 0));
}

#[test]
fn polygons_are_lines_with_corners() {
    let square = vec![[0.0, 0.0], [40.0, 0.0], [40.0, 40.0], [0.0, 40.0]];
    let hexagon = arc([100.0, 0.0], 8.0, 10.0, 370.0, 6);
    let bracket: Vec<[f64; 2]> =
        vec![[0.0, 60.0], [70.0, 60.0], [70.0, 65.0], [30.0, 80.0], [5.0, 80.0], [5.0, 120.0], [0.0, 120.0]];
    for (contour, corners) in sections(&[square, hexagon, bracket]).iter().zip([4, 6, 7]) {
        assert_eq!(kinds(contour), vec![SegmentKind::Line; corners]);
        assert!(contour.closed && contour.joins.iter().all(|j| j.continuity == Continuity::G0));
        assert!(contour.joins.iter().all(|j| j.uncertainty < 1e-3));
        holds_together(contour);
    }
}

#[test]
fn bores_are_circles_and_slots_and_fillets_have_arcs() {
    let bore = arc([12.0, 7.0], 3.25, 0.0, 360.0, 12);
    let fine = arc([-40.0, 7.0], 20.0, 3.0, 363.0, 720);
    let [right, left] = [arc([100.0, 0.0], 6.0, -90.0, 90.0, 9), arc([80.0, 0.0], 6.0, 90.0, 270.0, 9)];
    let slot = [right, vec![[100.0, 6.0]], left, vec![[80.0, -6.0]]].concat();
    // A plate with one corner rounded by five chords, one by two, and two sharp ones.
    let plate = [
        vec![[0.0, -50.0]],
        arc([55.0, -45.0], 5.0, -90.0, 0.0, 5),
        vec![[60.0, -45.0]],
        arc([58.0, -12.0], 2.0, 0.0, 90.0, 2)[..].to_vec(),
        vec![[58.0, -10.0], [0.0, -10.0]],
    ]
    .concat();
    let found = sections(&[bore, fine, slot, plate]);
    for (contour, (center, radius)) in found.iter().zip([([12.0, 7.0], 3.25), ([-40.0, 7.0], 20.0)]) {
        assert!(contour.joins.is_empty() && contour.segments.len() == 1);
        let Geometry::Arc { center: c, radius: r, sweep, .. } = contour.segments[0].geometry else {
            panic!()
        };
        assert!(distance(c, center) < 1e-5 && (r - radius).abs() < 1e-5, "{c:?} {r}");
        assert!((sweep.abs() - std::f64::consts::TAU).abs() < 1e-9);
        holds_together(contour);
    }
    use SegmentKind::{Arc, Line};
    assert_eq!(kinds(&found[2]), [Line, Arc, Line, Arc]);
    for join in &found[2].joins {
        assert_eq!(join.continuity, Continuity::G1);
        let at = [80.0, 100.0].map(|x| distance([x, join.point[1].signum() * 6.0], join.point));
        assert!(at[0].min(at[1]) < 1e-5, "{join:?}");
    }
    assert_eq!(kinds(&found[3]), [Line, Line, Line, Arc, Line, Arc]);
    let g0 = found[3].joins.iter().filter(|j| j.continuity == Continuity::G0).count();
    assert_eq!(g0, 2);
    let radii: Vec<f64> = found[3]
        .segments
        .iter()
        .filter_map(|s| match s.geometry {
            Geometry::Arc { radius, .. } => Some(radius),
            _ => None,
        })
        .collect();
    assert!(radii.iter().any(|r| (r - 5.0).abs() < 1e-4) && radii.iter().any(|r| (r - 2.0).abs() < 1e-3));
    found[2..].iter().for_each(holds_together);
}

/// Regular polygons wherever they lie, whatever rounding does to their turns: up to ten sides lines, from eleven on circles.
#[test]
fn polygons_of_up_to_ten_sides_are_lines_and_of_eleven_circles() {
    let random = &mut Random::new(8);
    for sides in 3..14 {
        for _ in 0..20 {
            let center = [200.0 * random.unit() - 100.0, 200.0 * random.unit() - 100.0];
            let start = 360.0 * random.unit();
            let outline = arc(center, 1.0 + 20.0 * random.unit(), start, start + 360.0, sides);
            let found = &sections(&[outline])[0];
            let want = if sides <= 10 { vec![SegmentKind::Line; sides] } else { vec![SegmentKind::Arc] };
            assert_eq!(kinds(found), want, "{sides} {center:?} {start}");
            holds_together(found);
        }
    }
    // Uneven chords of one circle that turn by a little more or less than the limit are of one kind.
    for _ in 0..50 {
        let mut angles: Vec<f64> = (0..10).map(|i| 36.0 * f64::from(i) + 4.0 * random.unit()).collect();
        angles.push(angles[0] + 360.0);
        let outline: Vec<[f64; 2]> =
            angles.windows(2).flat_map(|w| arc([3.0, 1.0], 9.0, w[0], w[1], 1)).collect();
        let found = &sections(&[outline])[0];
        assert!(kinds(found).windows(2).all(|w| w[0] == w[1]), "{:?} {angles:?}", kinds(found));
    }
}

/// The sides of a pyramid are one facet each: their cut has no points but the corners. Ten of them are no scan.
#[test]
fn a_pyramid_of_ten_sides_has_ten_lines() {
    for sides in [9, 10] {
        let mut mesh = Mesh::default();
        let base = arc([2.0, 1.0], 12.0, 7.0, 367.0, sides);
        mesh.positions.extend(base.iter().map(|p| [p[0], p[1], 0.0]));
        mesh.positions.push([2.0, 1.0, 20.0]);
        let n = sides as u32;
        mesh.faces.extend((0..n).map(|i| [i, (i + 1) % n, n]));
        let plane = Plane { normal: [0.0, 0.0, 1.0], offset: 3.0 };
        let chains = cut(&mesh, &plane, &Silent).unwrap();
        let options = Options::default();
        let found =
            chain_contour(&chains[0], &plane.frame().unwrap(), &CutMesh::new(&mesh, None), &options, &Silent)
                .unwrap();
        assert_eq!((kinds(&found), found.row_kind), (vec![SegmentKind::Line; sides], RowKind::Facets));
    }
}

/// The half circles of a slot in two to six chords are arcs: they are tangent to its sides.
#[test]
fn coarse_slots_have_arcs() {
    for chords in 2..7 {
        let right = arc([50.0, 0.0], 6.0, -90.0, 90.0, chords);
        let left = arc([20.0, 0.0], 6.0, 90.0, 270.0, chords);
        let slot = [right, vec![[50.0, 6.0]], left, vec![[20.0, -6.0]]].concat();
        let found = &sections(&[slot])[0];
        use SegmentKind::{Arc, Line};
        assert_eq!(kinds(found), [Line, Arc, Line, Arc], "{chords}");
        assert!(found.joins.iter().all(|j| j.continuity == Continuity::G1), "{chords}");
        holds_together(found);
    }
}

/// A torus cut at the plane tangent to its inner equator: two loops that touch each other in a corner, on the saddle.
#[test]
fn loops_that_touch_have_their_corner() {
    // By 4,000,000 chords of the curve itself.
    let length_of_loop = 31.9196;
    for (around, across) in [(96_u32, 48_u32), (120, 60), (200, 100), (64, 32)] {
        let mut mesh = Mesh::default();
        for i in 0..around {
            let (s, c) = libm::sincos(std::f64::consts::TAU * f64::from(i) / f64::from(around));
            for j in 0..across {
                let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(j) / f64::from(across));
                let r = 10.0 + 4.0 * cos;
                mesh.positions.push([r * c, r * s, 4.0 * sin].map(|x| f64::from(x as f32)));
                let at = |i: u32, j: u32| (i % around) * across + j % across;
                mesh.faces.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
                mesh.faces.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
        let plane = Plane { normal: [1.0, 0.0, 0.0], offset: 6.0 };
        let frame = plane.frame().unwrap();
        let chains = cut(&mesh, &plane, &Silent).unwrap();
        assert_eq!(chains.len(), 2, "{around}");
        for chain in &chains {
            let found =
                chain_contour(chain, &frame, &CutMesh::new(&mesh, None), &Options::default(), &Silent)
                    .unwrap();
            assert!(found.closed && found.unreliable.is_empty());
            assert!((found.length() / length_of_loop - 1.0).abs() < 0.004, "{around}: {}", found.length());
            let corner = found.joins.iter().find(|j| distance(j.point, [0.0, 0.0]) < 1e-4).unwrap();
            assert_eq!(corner.continuity, Continuity::G0, "{around}");
            // The drawing ends there.
            let near =
                found.segments.iter().map(|s| s.foot([0.0, 0.0]).1.abs()).fold(f64::INFINITY, f64::min);
            assert!(near < 1e-4, "{around}: {near}");
            holds_together(&found);
        }
    }
}

/// A slot cut by an oblique plane: half ellipses between lines that are the edges of flat faces, as far apart as these exactly.
#[test]
fn sides_of_an_oblique_slot_are_exact() {
    let normal = [0.3, 0.2, 1.0];
    let plane = Plane { normal, offset: 6.0 };
    let frame = plane.frame().unwrap();
    for chords in [12, 24, 48] {
        for degrees in [0.0, 33.0, 57.0, 80.0_f64] {
            let right = arc([4.0, 0.0], 1.5, -90.0, 90.0, chords);
            let left = arc([-4.0, 0.0], 1.5, 90.0, 270.0, chords);
            let (sin, cos) = libm::sincos(degrees.to_radians());
            let slot = [right, vec![[4.0, 1.5]], left, vec![[-4.0, -1.5]]].concat();
            let slot = slot.iter().map(|[x, y]| [cos * x - sin * y, sin * x + cos * y]).collect();
            let mesh = prisms(&[slot], 0.0);
            let chains = cut(&mesh, &plane, &Silent).unwrap();
            let found =
                chain_contour(&chains[0], &frame, &CutMesh::new(&mesh, None), &Options::default(), &Silent)
                    .unwrap();
            holds_together(&found);
            // The walls' distance over the length of their normal's part in the plane.
            let along = 0.2 * cos - 0.3 * sin;
            let want = 3.0 / (1.0 - along * along / 1.13_f64).sqrt();
            let widths: Vec<_> = crate::dimensions(&[found])
                .into_iter()
                .filter(|d| d.kind == crate::DimensionKind::Width)
                .collect();
            assert!(!widths.is_empty(), "{chords} {degrees}");
            for d in widths {
                let off = (d.value - want).abs();
                assert!(
                    off < 2e-5 && d.uncertainty.is_none(),
                    "{chords} {degrees}: {off} {:?}",
                    d.uncertainty
                );
            }
        }
    }
}

/// A line goes on as half a wave of a cosine and a line again: the free curve is no row of lines.
#[test]
fn a_free_curve_between_lines_is_a_spline() {
    let wave = |x: f64| 6.0 * (1.0 - libm::cos(x * std::f64::consts::PI / 40.0)) / 2.0;
    let mut outline = vec![[-30.0, -20.0], [70.0, -20.0], [70.0, 6.0]];
    outline.extend((0..=40).rev().map(f64::from).map(|x| [x, wave(x)]));
    outline.push([-30.0, 0.0]);
    let found = &sections(&[outline.clone()])[0];
    use SegmentKind::{Line, Spline};
    assert_eq!(kinds(found), [Line, Line, Line, Spline, Line, Line]);
    let spline = found.segments.iter().find(|s| s.geometry.kind() == Spline).unwrap();
    for p in outline.iter().filter(|p| p[0] > 3.0 && p[0] < 37.0 && p[1] > -1.0) {
        // Chords of 1 mm and a radius of 54 mm or more are 0.0023 mm off.
        assert!(spline.foot(*p).1.abs() < 0.003, "{p:?} {:?}", spline.foot(*p));
    }
    holds_together(found);
}

/// The same outline scanned: uneven points, noise of 0.005 mm.
#[test]
fn a_scan_is_a_row_of_independent_points() {
    let mut outline = vec![];
    let random = &mut Random::new(3);
    let mut s = 0.0;
    while s < 100.0 + 20.0 * std::f64::consts::PI {
        outline.push(stadium(s));
        s += 0.3 + 0.4 * random.unit();
    }
    let mesh = prisms(&[outline], 0.02);
    let plane = Plane { normal: [0.0, 0.0, 1.0], offset: 5.0 };
    let frame = PlaneFrame { origin: [0.0, 0.0, 5.0], x: [1.0, 0.0, 0.0], y: [0.0, 1.0, 0.0] };
    let chains = cut(&mesh, &plane, &Silent).unwrap();
    let found =
        chain_contour(&chains[0], &frame, &CutMesh::new(&mesh, None), &Options::default(), &Silent).unwrap();
    assert_eq!(found.row_kind, RowKind::Scan);
    use SegmentKind::{Arc, Line};
    assert_eq!(kinds(&found), [Line, Arc, Line, Arc]);
    for truth in [[0.0, 0.0], [50.0, 0.0], [50.0, 20.0], [0.0, 20.0]] {
        let join = found.joins.iter().find(|j| distance(j.point, truth) < 0.5).unwrap();
        // Chords of up to 0.7 mm lie up to 0.006 mm inside of the circle. That moves a join by no more than twice as
        // much.
        assert!(distance(join.point, truth) < 5.0 * join.uncertainty + 0.012, "{join:?}");
    }
    assert_eq!(found.labels.len(), chains[0].points.len());
    assert!(found.residuals.iter().all(|r| r.abs() < 0.03));
}

/// Two lines of length 50 and two half circles of radius 10.
fn stadium(s: f64) -> [f64; 2] {
    let half = 10.0 * std::f64::consts::PI;
    let around = |x: f64, a: f64| {
        let (sin, cos) = libm::sincos(a);
        [x + 10.0 * sin, 10.0 - 10.0 * cos]
    };
    match s {
        s if s < 50.0 => [s, 0.0],
        s if s < 50.0 + half => around(50.0, (s - 50.0) / 10.0),
        s if s < 100.0 + half => [100.0 + half - s, 20.0],
        s => around(0.0, std::f64::consts::PI + (s - 100.0 - half) / 10.0),
    }
}

#[test]
fn few_points_and_wrong_options() {
    let frame = PlaneFrame { origin: [0.0; 3], x: [1.0, 0.0, 0.0], y: [0.0, 1.0, 0.0] };
    let chain = |points: Vec<[f64; 3]>| Chain {
        edges: (0..points.len() as u32).map(|i| [i, i + 1]).collect(),
        points,
        closed: false,
    };
    let options = Options::default();
    // A mesh that the chains are not of: crossings count as they are.
    let other = Mesh::default();
    let mesh = &CutMesh::new(&other, None);
    let two = chain(vec![[0.0; 3], [2.0, 0.0, 0.0]]);
    let line = chain_contour(&two, &frame, mesh, &options, &Silent).unwrap();
    assert!(line.segments.len() == 1 && line.joins.is_empty() && !line.closed);
    // A noise or continuity asked for is that of rows: a chain too short for one is its lines all the same.
    for asked in
        [Options { noise: Some(0.1), ..options }, Options { continuity: Some(Continuity::G1), ..options }]
    {
        let short = chain_contour(&two, &frame, mesh, &asked, &Silent).unwrap();
        assert_eq!((short.segments.len(), short.length()), (1, 2.0));
    }
    let one = chain(vec![[0.0; 3]]);
    assert!(matches!(
        chain_contour(&one, &frame, mesh, &options, &Silent),
        Err(SectionError::TooFewPoints { found: 1 })
    ));
    for wrong in [Options { level: 2.0, ..options }, Options { resolution: Some(f64::NAN), ..options }] {
        assert!(matches!(
            chain_contour(&two, &frame, mesh, &wrong, &Silent),
            Err(SectionError::WrongOption { .. })
        ));
    }
}

/// A contour tells nothing where its points scatter much more about it than they do by the noise that is known.
#[test]
fn segments_that_hide_form_are_astray() {
    for (off, unreliable) in [(0.01, vec![]), (0.025, vec![]), (0.04, vec![0])] {
        // Points to both sides of a line by turns.
        let y = |i: usize| if i % 4 < 2 { off } else { -off };
        let points: Vec<[f64; 2]> = (0..60).map(|i| [i as f64, y(i)]).collect();
        let kept: Vec<usize> = (0..60).collect();
        let found = Contour {
            segments: vec![Segment::straight([0.0, 0.0], [59.0, 0.0])],
            labels: vec![0; kept.len()],
            residuals: kept.iter().map(|i| y(*i)).collect(),
            stations: kept.iter().map(|i| *i as f64).collect(),
            noise: off,
            spacing: 1.0,
            ..Contour::default()
        };
        let known = Some(KnownNoise { deviation: 0.01, degrees: 50.0 });
        assert_eq!(spread(found, &kept, known, &points).unreliable, unreliable, "{off}");
    }
}
