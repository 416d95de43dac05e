//! Reading IGES files: own ones, those of other programs, broken ones.

use super::surface;
use crate::cad::{SplineModel, SplineSurface};
use crate::write::scratch::Folder;
use crate::{Body, Input, ReadError, ReadOptions, Unit, Warning, open};
use trueness_geom::num::random::Random;
use trueness_geom::spline::surface::Nurbs;

fn read(text: &[u8]) -> Result<Input, ReadError> {
    let folder = Folder::new();
    let path = folder.path().join("model");
    std::fs::write(&path, text).unwrap();
    open(&path, &ReadOptions::default())
}

fn model(text: &[u8]) -> (SplineModel, Unit, Vec<Warning>) {
    let input = read(text).unwrap();
    match input.body {
        Body::Splines(model) => (model, input.provenance.unit_assumed, input.warnings),
        _ => panic!("no splines"),
    }
}

/// Bytes after the line of section T, appended by transfers, are no part of the model. Blank ones need no warning, others do.
#[test]
fn what_follows_the_end_is_not_read() {
    let whole =
        file("2,2HMM", &[(126, 0, "1,1,1,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,1.,2.,3.,0.,1.,0.,0.,1.".into())]);
    for tail in [&b""[..], b"\r\n\r\n", b"\x1a", b"\0\0\0\0\n", b"\n \n\x1a\0"] {
        let (found, _, warnings) = model(&[&whole[..], tail].concat());
        assert!(found.curves.len() == 1 && warnings.is_empty(), "{tail:?} {warnings:?}");
    }
    for (tail, count) in [(&b"the end\n"[..], 6), (b"\n-- \nsent by mail\n", 12), (b"\0x\n\xff\xfe", 3)] {
        let (found, _, warnings) = model(&[&whole[..], tail].concat());
        assert_eq!((found.curves.len(), warnings), (1, vec![Warning::TrailingBytes { count }]), "{tail:?}");
    }
    // Glued to the last line.
    let glued = [&whole[..whole.len() - 1], b"end of file"].concat();
    assert_eq!(model(&glued).2, [Warning::TrailingBytes { count: 9 }]);
}

#[test]
fn what_was_written_reads_back_bit_for_bit() {
    let mut random = Random::stream(3, 0);
    let points: Vec<[f64; 3]> =
        (0..20).map(|_| std::array::from_fn(|k| (random.unit() - 0.5) * [1e-7, 3.0, 1e9][k])).collect();
    let u = [-1.0, -1.0, -1.0, -1.0, 1.0 / 3.0, 7.5, 7.5, 7.5, 7.5];
    let v = [0.0, 0.0, 0.0, 1e-3, 2.0, 2.0, 2.0];
    let mut bytes = vec![];
    surface(&mut bytes, &SplineSurface { degree: [3, 2], knots: [&u, &v], points: &points, faces: &[] })
        .unwrap();
    let (model, unit, warnings) = model(&bytes);
    assert!(unit == Unit::Millimeter && warnings.is_empty());
    let [Nurbs::Plain(found)] = &model.surfaces[..] else { panic!("{}", model.surfaces.len()) };
    assert_eq!((found.knots()[0].values(), found.knots()[1].values()), (&u[..], &v[..]));
    assert_eq!(found.points(), points);
}

/// A file of entities: number, line of the matrix, parameters; `unit` is two global parameters.
fn file(unit: &str, entities: &[(u32, u32, String)]) -> Vec<u8> {
    let mut out = format!("{:<72}S{:>7}\n", "test", 1);
    let global = format!(
        "1H,,1H;,4Htest,8Htest.igs,1H,,1H;,32,38,6,308,15,4Htest,1.,{unit},1,.01,4Hdate,1.E-6,9.,,,11,0;"
    );
    for (k, line) in cut(&global, 72).iter().enumerate() {
        out += &format!("{line:<72}G{:>7}\n", k + 1);
    }
    let (mut parameters, mut directory, mut row) = (String::new(), String::new(), 1);
    for (n, (kind, matrix, own)) in entities.iter().enumerate() {
        let lines = cut(&format!("{kind},{own};"), 64);
        let de = 2 * n + 1;
        directory += &format!(
            "{kind:>8}{row:>8}{:>8}{:>8}{:>8}{:>8}{matrix:>8}{:>8}{:>8}D{de:>7}\n{kind:>8}{:>8}{:>8}{:>8}{:>8}{:>32}D{:>7}\n",
            0,
            0,
            0,
            0,
            0,
            "00000000",
            0,
            0,
            lines.len(),
            0,
            "",
            de + 1
        );
        for line in lines {
            parameters += &format!("{line:<64}{de:>8}P{row:>7}\n");
            row += 1;
        }
    }
    out += &directory;
    out += &parameters;
    out += &format!("{:<72}T{:>7}\n", "S      1G      1", 1);
    out.into_bytes()
}

/// Lines of `width` columns, anywhere cut: others cut numbers too.
fn cut(text: &str, width: usize) -> Vec<String> {
    text.as_bytes().chunks(width).map(|c| String::from_utf8(c.to_vec()).unwrap()).collect()
}

/// A quarter of a cylinder of radius 1 and height 2, with numbers as Fortran writes them; its domain ends are given.
fn quarter(ends: &str) -> String {
    let h = "7.0710678118654757D-01";
    format!(
        "2,1,2,1,0,0,0,0,0,0.,0.,0.,1.,1.,1.,0.,0.,1.,1.,1.,{h},1.,1.,{h},1.,\
         1.,0.,0.,1.,1.,0.,0.,1.,,1.,0.,2.,1.,1.,2.,0.,1.,2.,{ends}"
    )
}

#[test]
fn rational_surfaces_placed_by_a_matrix_in_inches() {
    // x to y, y to z, z to x, then moved by 10 along x.
    let matrix = "0.,0.,1.,10.,1.,0.,0.,0.,0.,1.,0.,0.".to_string();
    let text = file("1,2HIN", &[(124, 0, matrix), (128, 1, quarter("0.,1.,0.,1."))]);
    let (model, unit, warnings) = model(&text);
    assert!(unit == Unit::Inch && warnings.is_empty());
    for (u, v) in [(0.0, 0.0), (0.3, 0.2), (0.9, 1.0)] {
        let [x, y, z] = model.surfaces[0].at(u, v).unwrap();
        assert!((y.hypot(z) - 25.4).abs() < 1e-12 && (x - 25.4 * (10.0 + 2.0 * v)).abs() < 1e-12);
    }
}

#[test]
fn a_part_of_the_domain_is_that_part_of_the_surface() {
    let (model, ..) = model(&file("2,2HMM", &[(128, 0, quarter("0.25,1.,0.,.5"))]));
    let found = &model.surfaces[0];
    assert_eq!(found.knots().each_ref().map(|k| k.domain()), [(0.25, 1.0), (0.0, 0.5)]);
    let [x, y, z] = found.at(0.25, 0.5).unwrap();
    assert!((x.hypot(y) - 1.0).abs() < 1e-15 && (z - 1.0).abs() < 1e-15 && y > 0.1);
}

#[test]
fn trimmed_surfaces_are_told_from_whole_ones() {
    let surface = (128, 0, quarter("0.,1.,0.,1."));
    let line = |a: [f64; 2], b: [f64; 2]| (110, 0, format!("{},{},0.,{},{},0.", a[0], a[1], b[0], b[1]));
    let square = |inset: f64| {
        let (a, b) = (inset, 1.0);
        vec![
            surface.clone(),
            line([a, 0.0], [b, 0.0]),
            line([b, 0.0], [b, 1.0]),
            line([b, 1.0], [a, 1.0]),
            line([a, 1.0], [a, 0.0]),
            (102, 0, "4,3,5,7,9".into()),
            (142, 0, "0,1,11,0,1".into()),
            (144, 0, "1,1,0,13".into()),
        ]
    };
    assert!(model(&file("2,2HMM", &square(0.0))).2.is_empty());
    assert_eq!(model(&file("2,2HMM", &square(0.2))).2, [Warning::Trimmed { count: 1 }]);
    let mut holes = square(0.0);
    holes[7].2 = "1,0,1,0,13".into();
    assert_eq!(model(&file("2,2HMM", &holes)).2, [Warning::Trimmed { count: 1 }]);
    let sphere = (196, 0, "1,5.".into());
    assert_eq!(model(&file("2,2HMM", &[surface, sphere])).2, [Warning::FacesLeftOut { count: 1, of: 2 }]);
}

#[test]
fn curves_keep_their_weights() {
    let own = "2,2,1,0,0,0,0.,0.,0.,1.,1.,1.,1.,0.5,1.,1.,0.,0.,1.,1.,0.,0.,1.,0.,0.,1.,0.,0.,1.".to_string();
    let (model, ..) = model(&file("2,2HMM", &[(126, 0, own)]));
    let [x, y, z] = model.curves[0].at(0.5).unwrap();
    assert!((x - 1.5 / 3.0 * 1.0).abs() < 0.2 && x == y && z == 0.0);
    assert_eq!(model.curves[0].masses().points()[1].mass, 0.5);
}

#[test]
fn broken_files_are_refused_with_their_line() {
    let whole = quarter("0.,1.,0.,1.");
    let cases = [
        ("1,4HFEET", whole.clone(), None),
        ("4,2HFT", whole.clone(), Some("inch")),
        ("2,2HMM", whole.replace("2,1,2,1,", "2,1,3,1,"), Some("degrees")),
        ("2,2HMM", whole.replace("2,1,2,1,", "99999999,99999999,2,1,"), Some("degrees")),
        ("2,2HMM", whole.replace("2,1,2,1,", "40,40,2,1,"), Some("control points declared")),
        ("2,2HMM", whole.replace("7.0710678118654757D-01,1.,1.", "-1.,1.,1."), Some("above 0")),
        ("2,2HMM", whole.replace("1.,1.,2.,0.,1.,2.,", ""), Some("numbers declared")),
        ("2,2HMM", whole.replace("0.,0.,1.,1.,1.,", "0.,x,1.,1.,1.,"), Some("a number")),
        ("2,2HMM", whole.replace("0.,0.,0.,1.,1.,1.", "0.,0.,0.,-1.,1.,1."), Some("must not fall")),
    ];
    for (unit, own, wanted) in cases {
        let text = file(unit, &[(128, 0, own)]);
        match (read(&text), wanted) {
            (Ok(_), None) => {}
            (Err(e), Some(wanted)) => {
                let said = e.to_string();
                assert!(said.contains(wanted) && (said.contains("line") || wanted == "inch"), "{said}");
            }
            (other, _) => panic!("{wanted:?} {:?}", other.err()),
        }
    }
    let text = file("2,2HMM", &[(128, 7, whole)]);
    assert!(read(&text).err().unwrap().to_string().contains("the matrix that places it"));
}

#[test]
fn cut_short_or_changed_anywhere_it_does_no_harm() {
    let whole = file("2,2HMM", &[(128, 0, quarter("0.,1.,0.,1."))]);
    for end in 0..whole.len() - 80 {
        assert!(read(&whole[..end]).is_err(), "{end}");
    }
    let mut random = Random::stream(12, 0);
    for _ in 0..3000 {
        let mut bytes = whole.clone();
        for _ in 0..1 + random.below(4) {
            let at = random.below(bytes.len() as u64) as usize;
            bytes[at] = b"0123456789HSGDPT,;.-+E \n"[random.below(24) as usize];
        }
        let _ = read(&bytes);
    }
}
