//! Reading IGES files: own ones, those of other programs, broken ones.

use super::surface;
use super::written::Text;
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
    let model = match input.body {
        Body::Splines(model) => model,
        Body::Cad(file) => file.splines.unwrap(),
        _ => panic!("no splines"),
    };
    (model, input.provenance.unit_assumed, input.warnings)
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
fn file(unit: &'static str, entities: &[(u64, u64, String)]) -> Vec<u8> {
    let mut text = Text::in_unit(unit);
    for (kind, matrix, parameters) in entities {
        text.add(*kind, parameters.clone());
        text.placed(*matrix);
    }
    text.bytes()
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

/// A model is one of whole splines where all of its faces are.
#[test]
fn trimmed_surfaces_are_no_whole_splines() {
    let surface = (128, 0, quarter("0.,1.,0.,1."));
    let line = |a: [f64; 2], b: [f64; 2]| (110, 0, format!("{},{},0.,{},{},0.", a[0], a[1], b[0], b[1]));
    let trimmed = [
        surface.clone(),
        line([0.2, 0.0], [1.0, 0.0]),
        line([1.0, 0.0], [1.0, 1.0]),
        line([1.0, 1.0], [0.2, 1.0]),
        line([0.2, 1.0], [0.2, 0.0]),
        (102, 0, "4,3,5,7,9".into()),
        (142, 0, "0,1,11,0,1".into()),
        (144, 0, "1,1,0,13".into()),
    ];
    let sphere = [surface.clone(), (116, 0, "0.,0.,0.".into()), (196, 0, "3,5.".into())];
    for (entities, whole) in [(&[surface][..], true), (&trimmed, false), (&sphere, false)] {
        let Body::Cad(file) = read(&file("2,2HMM", entities)).unwrap().body else { panic!() };
        assert!(file.model.is_complete() && file.splines.is_some() == whole, "{:?}", file.model.unread);
    }
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
        ("12,2HXX", whole.clone(), Some("inch")),
        ("2,2HMM", whole.replace("2,1,2,1,", "2,1,3,1,"), Some("degrees")),
        ("2,2HMM", whole.replace("2,1,2,1,", "99999999,99999999,2,1,"), Some("99999999 follow")),
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
    assert!(read(&text).err().unwrap().to_string().contains("#7 is not in the file"));
}
