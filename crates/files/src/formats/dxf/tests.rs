//! Written files read back; entities by their definition; refused ones.

use crate::content::drawing::{Clamped, Drawing, Drawn, Entity, Layer};
use crate::write::scratch::Folder;
use crate::{Body, ReadError, ReadOptions, Unit, open};

pub(super) fn read(text: &str) -> Result<(Drawing, Unit, Vec<String>), ReadError> {
    let folder = Folder::new();
    let path = folder.path().join("drawing");
    std::fs::write(&path, text).unwrap();
    let input = open(&path, &ReadOptions::default())?;
    let Body::Drawing(drawing) = input.body else { panic!("no drawing") };
    let warnings = input.warnings.iter().map(ToString::to_string).collect();
    Ok((drawing, input.provenance.unit_assumed, warnings))
}

/// A drawing of these groups of entities.
fn drawing(header: &str, entities: &str) -> String {
    let lines = |text: &str| text.split_whitespace().map(|w| format!("{w}\n")).collect::<String>();
    let header = lines(header);
    format!(
        "  0\r\nSECTION\r\n  2\r\nHEADER\r\n{header}  0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{}0\nENDSEC\n0\nEOF\n",
        lines(entities)
    )
}

pub(super) fn place(drawn: &Drawn, share: f64) -> [f64; 2] {
    match drawn {
        Drawn::Line { start, end } => [0, 1].map(|k| start[k] + share * (end[k] - start[k])),
        Drawn::Arc { center, radius, start, sweep } => {
            let (s, c) = (start + share * sweep).sin_cos();
            [center[0] + radius * c, center[1] + radius * s]
        }
        Drawn::Spline(curve) => {
            let p = curve.at(share).unwrap();
            [p[0], p[1]]
        }
    }
}

fn is_at(found: [f64; 2], wanted: [f64; 2]) {
    assert!(libm::hypot(found[0] - wanted[0], found[1] - wanted[1]) < 1e-12, "{found:?} {wanted:?}");
}

#[test]
fn what_is_written_reads_back() {
    let entities = vec![
        Entity::Line { start: [0.1, 0.2], end: [1e-20, 3.0] },
        Entity::Arc { center: [1.0, 2.0], radius: 0.5, start: 0.3, sweep: 1.1 },
        Entity::Arc { center: [1.0, 2.0], radius: 0.5, start: 0.0, sweep: std::f64::consts::TAU },
        Entity::Spline(Clamped {
            degree: 2,
            knots: vec![0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0],
            points: vec![[0.0, 0.0], [1.0, 2.0], [3.0, 1.0], [4.0, 0.3]],
        }),
    ];
    let layer = Layer { name: "section-1".into(), entities, ..Layer::default() };
    let mut out = vec![];
    super::write(&mut out, &[layer]).unwrap();
    let (found, unit, warnings) = read(std::str::from_utf8(&out).unwrap()).unwrap();
    assert_eq!((found.entities.len(), unit, warnings), (4, Unit::Millimeter, vec![]));
    assert!(found.entities.iter().all(|e| e.layer == "section-1"));
    let drawn = |i: usize| &found.entities[i].drawn;
    assert_eq!(*drawn(0), Drawn::Line { start: [0.1, 0.2], end: [1e-20, 3.0] });
    let Drawn::Arc { start, sweep, .. } = drawn(1) else { panic!() };
    assert!((start - 0.3).abs() < 1e-14 && (sweep - 1.1).abs() < 1e-14);
    let Drawn::Arc { sweep, .. } = drawn(2) else { panic!() };
    assert_eq!(*sweep, std::f64::consts::TAU);
    // Degree 2: control points and the knot in the middle, where the curve is halfway between two of them.
    is_at(place(drawn(3), 0.5), [2.0, 1.5]);
}

#[test]
fn polylines_have_bulges() {
    // A half circle to the right of the way from (0, 0) to (2, 0): below, counter-clockwise; then a straight way back.
    let (found, unit, _) =
        read(&drawing("9 $INSUNITS 70 1", "0 LWPOLYLINE 8 0 90 2 70 1 10 0 20 0 42 1 10 2 20 0 42 0"))
            .unwrap();
    assert_eq!((unit, found.entities.len()), (Unit::Inch, 2));
    is_at(place(&found.entities[0].drawn, 0.0), [0.0, 0.0]);
    is_at(place(&found.entities[0].drawn, 0.5), [25.4, -25.4]);
    is_at(place(&found.entities[0].drawn, 1.0), [50.8, 0.0]);
    assert_eq!(found.entities[1].drawn, Drawn::Line { start: [50.8, 0.0], end: [0.0, 0.0] });
    // A quarter and three quarters of a circle about (0, 0): tan of a quarter of the sweep.
    for (sweep, to) in [(90f64, [0.0, 1.0]), (270.0, [0.0, -1.0]), (-90.0, [0.0, -1.0])] {
        let bulge = (0.25 * sweep.to_radians()).tan();
        let text = format!(
            "0 POLYLINE 66 1 70 0 0 VERTEX 10 1 20 0 42 {bulge} 0 VERTEX 10 {} 20 {} 0 SEQEND",
            to[0], to[1]
        );
        let (found, unit, _) = read(&drawing("", &text)).unwrap();
        assert_eq!((unit, found.entities.len()), (Unit::Millimeter, 1));
        let half = (0.5 * sweep.to_radians()).sin_cos();
        is_at(place(&found.entities[0].drawn, 0.5), [half.1, half.0]);
        is_at(place(&found.entities[0].drawn, 1.0), to);
    }
}

#[test]
fn entities_seen_from_below_are_mirrored_and_ellipses_are_exact() {
    let (found, ..) = read(&drawing(
        "",
        "0 ARC 10 3 20 1 40 2 50 0 51 90 210 0 220 0 230 -1 0 ELLIPSE 10 1 20 2 11 3 21 0 40 0.5 41 0 42 6.283185307179586 0 LWPOLYLINE 10 1 20 0 42 0.5 10 2 20 0 230 -1",
    ))
    .unwrap();
    is_at(place(&found.entities[0].drawn, 0.0), [-5.0, 1.0]);
    is_at(place(&found.entities[0].drawn, 1.0), [-3.0, 3.0]);
    let quarters = &found.entities[1..5];
    for (i, t) in (0..4).flat_map(|i| [(i, 0.0), (i, 0.3), (i, 1.0)]) {
        let p = place(&quarters[i].drawn, t);
        assert!((((p[0] - 1.0) / 3.0).powi(2) + ((p[1] - 2.0) / 1.5).powi(2) - 1.0).abs() < 1e-14);
    }
    is_at(place(&quarters[1].drawn, 0.0), [1.0, 3.5]);
    is_at(place(&found.entities[5].drawn, 0.5), [-1.5, -0.25]);
}

#[test]
fn what_is_passed_over_is_told() {
    let (found, _, warnings) = read(&drawing(
        "",
        "0 TEXT 1 hello 0 LINE 10 0 20 0 11 1 21 0 0 POINT 10 0 20 0 0 POINT 10 1 20 0 0 LINE 67 1 10 0 20 0 11 1 21 0",
    ))
    .unwrap();
    assert_eq!(found.entities.len(), 1);
    assert!(warnings.len() == 1 && warnings[0].contains("2 POINT, 1 TEXT"), "{warnings:?}");
    let (_, _, warnings) = read(&drawing("", "")).unwrap();
    assert_eq!(warnings.len(), 1);
}

/// A drawing of blocks and of entities, in millimeters.
fn with_blocks(blocks: &str, entities: &str) -> String {
    let lines = |text: &str| text.split_whitespace().map(|w| format!("{w}\n")).collect::<String>();
    let section = |name: &str, text: &str| format!("0\nSECTION\n2\n{name}\n{}0\nENDSEC\n", lines(text));
    format!("{}{}0\nEOF\n", section("BLOCKS", blocks), section("ENTITIES", entities))
}

/// A block of a line from (2, 1) to (3, 1) and an arc of a quarter about (2, 1) from (3, 1), its base (2, 1).
const HOOK: &str = "0 BLOCK 2 Hook 10 2 20 1 0 LINE 8 0 10 2 20 1 11 3 21 1 0 ARC 8 own 10 2 20 1 40 1 50 0 51 90 0 TEXT 1 t 0 ENDBLK 5 1";

/// The places along blocks are those that scale, turn and shift make of the block's own; in rows, within each other, mirrored.
#[test]
fn blocks_are_placed() {
    let (found, _, warnings) =
        read(&with_blocks(HOOK, "0 INSERT 8 there 2 HOOK 10 10 20 20 41 2 42 2 50 90 70 2 71 3 44 5 45 -4"))
            .unwrap();
    assert_eq!(found.entities.len(), 12);
    assert!(warnings.len() == 2 && warnings[0].contains("6 TEXT"), "{warnings:?}");
    for (k, (column, row)) in
        (0..2).flat_map(|c| (0..3).map(move |r| (f64::from(c), f64::from(r)))).enumerate()
    {
        // Columns along y, rows along x, as the block is turned.
        let at = [10.0 + 4.0 * row, 20.0 + 5.0 * column];
        let [line, arc] = [&found.entities[2 * k], &found.entities[2 * k + 1]];
        assert_eq!((line.layer.as_str(), arc.layer.as_str()), ("there", "own"));
        is_at(place(&line.drawn, 0.0), at);
        is_at(place(&line.drawn, 1.0), [at[0], at[1] + 2.0]);
        is_at(place(&arc.drawn, 0.0), [at[0], at[1] + 2.0]);
        is_at(place(&arc.drawn, 1.0), [at[0] - 2.0, at[1]]);
    }
    // Seen from below it is mirrored; scales of two signs turn the sense of the arc.
    for (text, start, middle) in [
        ("0 INSERT 2 HOOK 10 -5 20 0 230 -1", [4.0, 0.0], [-1.0, 1.0]),
        ("0 INSERT 2 HOOK 10 5 20 0 41 -1", [4.0, 0.0], [-1.0, 1.0]),
        ("0 INSERT 2 HOOK 10 5 20 0 41 3 42 -3", [8.0, 0.0], [3.0, -3.0]),
    ] {
        let (found, ..) = read(&with_blocks(HOOK, text)).unwrap();
        is_at(place(&found.entities[1].drawn, 0.0), start);
        let half = 0.5_f64.sqrt();
        is_at(place(&found.entities[1].drawn, 0.5), [5.0 + half * middle[0], half * middle[1]]);
        assert!(matches!(found.entities[1].drawn, Drawn::Arc { .. }));
    }
    // With two scales it is a part of an ellipse.
    let (found, ..) = read(&with_blocks(HOOK, "0 INSERT 2 HOOK 10 5 20 0 41 3 42 0.5 50 30")).unwrap();
    let (s, c) = 30f64.to_radians().sin_cos();
    for t in [0.0, 0.3, 1.0] {
        let p = place(&found.entities[1].drawn, t);
        let (x, y) = (c * (p[0] - 5.0) + s * p[1], c * p[1] - s * (p[0] - 5.0));
        assert!(((x / 3.0).powi(2) + (y / 0.5).powi(2) - 1.0).abs() < 1e-12, "{x} {y}");
    }
}

/// Blocks within blocks; such as hold themselves, or are not there, are told; faults of blocks count where they are inserted.
#[test]
fn blocks_within_blocks() {
    let outer = format!(
        "{HOOK} 0 BLOCK 2 two 10 0 20 0 0 INSERT 8 0 2 hook 10 1 20 0 50 90 0 INSERT 2 hook 10 4 20 0 0 ENDBLK"
    );
    let (found, ..) = read(&with_blocks(&outer, "0 INSERT 8 l 2 two 10 0 20 7 50 90 41 2 42 2")).unwrap();
    assert_eq!(found.entities.len(), 4);
    is_at(place(&found.entities[0].drawn, 1.0), [-2.0, 9.0]);
    is_at(place(&found.entities[2].drawn, 1.0), [0.0, 17.0]);
    assert_eq!(found.entities[0].layer, "l");
    let own = "0 BLOCK 2 a 10 0 20 0 0 LINE 10 0 20 0 11 1 21 0 0 INSERT 2 b 10 1 20 0 0 ENDBLK 0 BLOCK 2 b 10 0 20 0 0 INSERT 2 a 10 1 20 0 0 ENDBLK";
    let (found, _, warnings) =
        read(&with_blocks(own, "0 INSERT 2 a 10 0 20 0 0 INSERT 2 none 10 0 20 0")).unwrap();
    assert_eq!(found.entities.len(), 1);
    assert!(
        warnings[0].contains("INSERT of `A`") && warnings[0].contains("INSERT of `NONE`"),
        "{warnings:?}"
    );
    let broken = "0 BLOCK 2 a 10 0 20 0 0 CIRCLE 10 0 20 0 40 -1 0 ENDBLK";
    assert!(read(&with_blocks(broken, "0 LINE 10 0 20 0 11 1 21 0")).is_ok());
    assert!(read(&with_blocks(broken, "0 INSERT 2 a 10 0 20 0")).unwrap_err().to_string().contains("radius"));
    // Rows of rows of rows.
    let rows: String = (0..9)
        .map(|k| format!("0 BLOCK 2 b{k} 0 INSERT 2 b{} 10 0 20 0 70 30000 71 30000 0 ENDBLK ", k + 1))
        .collect();
    let error = read(&with_blocks(&rows, "0 INSERT 2 b0 10 0 20 0")).err().map(|e| e.to_string());
    assert!(error.is_none_or(|e| e.contains("1000000")));
    let full = format!("{HOOK} {rows} 0 BLOCK 2 b9 0 INSERT 2 hook 10 0 20 0 0 ENDBLK");
    assert!(
        read(&with_blocks(&full, "0 INSERT 2 b0 10 0 20 0")).unwrap_err().to_string().contains("1000000")
    );
}

/// Splines by points pass through these, keep their tangents, close smoothly; polynomials of degree 3 are themselves.
#[test]
fn splines_by_points_pass_through_these() {
    let text = |points: &[[f64; 2]], more: &str| {
        let points: String = points.iter().map(|[x, y]| format!("11 {x} 21 {y} ")).collect();
        drawing("", &format!("0 SPLINE 71 3 74 4 {points} {more}"))
    };
    let near = |drawn: &Drawn, p: [f64; 2]| {
        (0..=20000)
            .map(|i| place(drawn, f64::from(i) / 20000.0))
            .map(|q| libm::hypot(q[0] - p[0], q[1] - p[1]))
            .fold(f64::INFINITY, f64::min)
    };
    let points = [[0.0, 0.0], [3.0, 2.0], [5.0, -1.0], [9.0, 0.5], [12.0, 4.0]];
    for count in 2..=5 {
        for tangents in ["", "12 0 22 1", "13 1 23 0", "12 0 22 1 13 1 23 0"] {
            let (found, _, warnings) = read(&text(&points[..count], tangents)).unwrap();
            assert!(
                warnings.len() == 1 && warnings[0].contains("1 spline(s) given only by the points"),
                "{warnings:?}"
            );
            let drawn = &found.entities[0].drawn;
            assert!(points[..count].iter().all(|p| near(drawn, *p) < 1e-3), "{count} {tangents}");
            is_at(place(drawn, 0.0), points[0]);
            is_at(place(drawn, 1.0), points[count - 1]);
            if tangents.starts_with("12") {
                let q = place(drawn, 1e-6);
                assert!(q[0].abs() < 1e-3 * q[1], "{count} {q:?}");
            }
        }
    }
    // A circle by twelve points, closed: within a few thousandths, and smooth over the seam.
    let ring: Vec<[f64; 2]> = (0..12)
        .map(|i| f64::from(i).mul_add(30.0, 7.0).to_radians().sin_cos())
        .map(|(s, c)| [10.0 * c, 10.0 * s])
        .collect();
    let (found, ..) = read(&text(&ring, "70 3")).unwrap();
    let Drawn::Spline(curve) = &found.entities[0].drawn else { panic!() };
    let (from, to) = curve.masses().domain();
    let off = (0..=1000).map(|i| curve.at(from + (to - from) * f64::from(i) / 1000.0).unwrap());
    assert!(off.into_iter().all(|p| (libm::hypot(p[0], p[1]) - 10.0).abs() < 0.02));
    let [a, b] = [from, to].map(|t| curve.derivatives(t, 2).unwrap());
    for k in 0..=2 {
        assert!((0..2).all(|i| (a[k][i] - b[k][i]).abs() < 1e-6 * (1.0 + a[k][i].abs())), "{k} {a:?} {b:?}");
    }
    let (found, ..) = read(&text(&[[0.0, 0.0], [1.0, 2.0]], "")).unwrap();
    assert_eq!(found.entities[0].drawn, Drawn::Line { start: [0.0, 0.0], end: [1.0, 2.0] });
}

#[test]
fn hostile_drawings_are_refused_with_their_line() {
    let refused = |header: &str, entities: &str| read(&drawing(header, entities)).unwrap_err().to_string();
    for (entities, word) in [
        ("0 LINE 10 0 20 nan 11 1 21 0", "finite number"),
        ("0 LINE 10 0 20 1e999 11 1 21 0", "finite number"),
        ("0 LINE 10 0 20 0 11 1", "all numbers"),
        ("0 LINE 10 0 20 0 30 0 11 1 21 0 31 5", "leaves the plane"),
        ("0 CIRCLE 10 0 20 0 40 -1", "radius above 0"),
        ("0 CIRCLE 10 0 20 0 40 1 210 1 220 0 230 0", "turned out of the plane"),
        (
            "0 SPLINE 71 3 11 0 21 0 31 0 11 0 21 0 31 0",
            "fewer than two different ones; export it with its control points",
        ),
        ("0 SPLINE 71 3 11 0 21 0 31 0 11 1", "two coordinates"),
        ("0 INSERT 2 b 10 0 20 0 41 0", "scale of 0"),
        ("0 INSERT 2 b 10 0 20 0 210 1 220 0 230 0", "turned out of the plane"),
        ("0 SPLINE 71 3 40 0 40 0 40 1 40 1 10 0 20 0 10 1 20 1", "knots"),
        ("0 SPLINE 71 99999999999 40 0 40 1 10 0 20 0 10 1 20 1", "degree"),
        (
            "0 SPLINE 71 1 72 4000000000 73 4000000000 40 0 40 0 40 1 40 1 41 -1 41 1 10 0 20 0 10 1 20 1",
            "weight",
        ),
        ("0 POLYLINE 70 0 0 VERTEX 10 0 20 0", "SEQEND"),
        ("0 LWPOLYLINE 20 0 10 0", "first coordinate"),
        ("x LINE", "code of a group"),
        ("5 LINE", "an entity"),
    ] {
        let error = refused("", entities);
        assert!(error.contains(word) && error.contains("line "), "{entities}: {error}");
    }
    assert!(refused("9 $INSUNITS 70 7", "").contains("$INSUNITS"));
    let whole = drawing("9 $INSUNITS 70 4", "0 LINE 10 0 20 0 11 1 21 0 0 CIRCLE 10 0 20 0 40 1");
    for end in 40..whole.len() - 4 {
        assert!(read(&whole[..end]).is_err(), "{end}");
    }
    assert!(read("AutoCAD Binary DXF\r\n\u{1a}\0").unwrap_err().to_string().contains("ASCII"));
}
