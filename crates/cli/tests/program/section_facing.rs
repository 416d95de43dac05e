//! `trueness section` of meshes, measured and nominal, whose facets do not agree which side the material is on.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, corpus, status, stdout, trueness};
use serde_json::Value;

/// Bytes of an STL file's head, of a facet, and where its corners begin.
const HEAD: usize = 84;
const FACET: usize = 50;
const CORNERS: usize = 12;

/// An STL file with some of its facets turned over, the first of them there twice if asked.
fn turned(stl: &[u8], is_turned: impl Fn(usize) -> bool, twice: usize) -> Vec<u8> {
    let mut all = stl.to_vec();
    for (_, facet) in all[HEAD..].chunks_exact_mut(FACET).enumerate().filter(|(n, _)| is_turned(*n)) {
        let (b, c) = (CORNERS + 12, CORNERS + 24);
        (0..12).for_each(|k| facet.swap(b + k, c + k));
    }
    let again = all[HEAD..HEAD + twice * FACET].to_vec();
    all.extend(again);
    let count = ((all.len() - HEAD) / FACET) as u32;
    all[80..HEAD].copy_from_slice(&count.to_le_bytes());
    all
}

/// The same with all places so many times as far from the origin.
fn grown(stl: &[u8], by: f32) -> Vec<u8> {
    let mut all = stl.to_vec();
    for facet in all[HEAD..].chunks_exact_mut(FACET) {
        for number in facet[CORNERS..CORNERS + 36].chunks_exact_mut(4) {
            let x = f32::from_le_bytes([number[0], number[1], number[2], number[3]]);
            number.copy_from_slice(&(by * x).to_le_bytes());
        }
    }
    all
}

fn answer(words: &[&str]) -> (Value, i32) {
    let done = trueness([words, &["--json", "-", "--quiet"]].concat());
    (serde_json::from_str(&stdout(&done)).unwrap_or_else(|e| panic!("{words:?}: {e}")), status(&done))
}

fn near(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-6 * (1.0 + b.abs()))
}

/// Whole, inside out, 40 % of the facets turned, most turned, and some there twice.
fn variants(folder: &Folder, stl: &[u8]) -> Vec<String> {
    let scattered = |n: usize| n.wrapping_mul(2_654_435_761) % 100;
    let all = [
        turned(stl, |_| true, 0),
        turned(stl, |n| scattered(n) < 40, 0),
        turned(stl, |n| scattered(n) < 85, 0),
        turned(stl, |_| false, 30),
        turned(stl, |n| scattered(n) < 20, 30),
    ];
    let name = |n: usize| format!("{n}.stl");
    let written = all.into_iter().enumerate().map(|(n, bytes)| folder.write(&name(n), bytes));
    written.map(|path| path.to_str().unwrap().to_string()).collect()
}

/// However the facets of the nominal and of the part are turned, deviations, area and verdict stay, and the file is told to be unsound.
#[test]
fn facets_may_be_turned() {
    let folder = Folder::new();
    let drawn = std::fs::read(corpus("examples/plate/nominal.stl")).unwrap();
    // A part that is a little larger all over.
    let made = grown(&drawn, 1.001);
    let file = |name: &str, stl: &[u8]| folder.write(name, stl).to_str().unwrap().to_string();
    let (scan, nominal) = (file("made.stl", &made), file("drawn.stl", &drawn));
    let plane = ["--plane", "0,0,1,10"];
    let told = |(answer, status): (Value, i32)| {
        let warned = answer["inputs"].as_array().unwrap().iter().flat_map(|i| i["warnings"].as_array());
        let warned =
            warned.flatten().any(|w| w.as_str().unwrap().contains("for the section; trueness check"));
        let all = &answer["nominal"]["deviation"]["all"];
        let numbers = [&all["min"], &all["max"], &all["rms"], &answer["planes"][0]["area"]];
        let numbers = numbers.map(|x| x.as_f64().unwrap_or_else(|| panic!("{answer}")));
        (warned, numbers, answer["nominal"]["verdict"].clone(), status)
    };
    // A zone that holds on one side only: signs the other way round are another verdict.
    let against = |scan: &str, nominal: &str| {
        told(answer(
            &[&["section", scan, "--nominal", nominal, "--tolerance", "-0.3,+0.01"], &plane[..]].concat(),
        ))
    };
    let right = against(&scan, &nominal);
    assert!(!right.0 && right.1[1] > 0.05 && right.2 == "fail", "{right:?}");
    for file in variants(&folder, &drawn) {
        let found = against(&scan, &file);
        assert!(found.0 && near(&found.1, &right.1), "{file}: {found:?} {right:?}");
        assert_eq!((&found.2, found.3), (&right.2, right.3), "{file}");
    }
    for file in variants(&folder, &made) {
        let found = against(&file, &nominal);
        assert!(found.0 && near(&found.1, &right.1), "{file}: {found:?} {right:?}");
        assert_eq!((&found.2, found.3), (&right.2, right.3), "{file}");
    }
}
