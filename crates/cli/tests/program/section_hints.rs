//! What `trueness section` says of input that it doubts, each with what may help.
#![allow(clippy::disallowed_methods, clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

use crate::common::{Folder, document, status, stdout, trueness};
use std::f64::consts::TAU;

/// A share of 1 that follows no pattern of the numbers.
fn even(i: u32, step: f64) -> f64 {
    (f64::from(i) * step).fract()
}

/// Scatter of about this standard deviation: the sum of four even numbers.
fn scatter(i: u32, deviation: f64) -> f64 {
    let steps = [0.754_877_67, 0.569_840_3, 0.819_172_51, 0.671_043_61];
    (steps.iter().map(|s| even(i, *s)).sum::<f64>() - 2.0) * deviation * 3f64.sqrt()
}

fn hints(words: &[&str]) -> Vec<String> {
    let answer = document(words);
    let contour = &answer["contours"][0];
    let all: Vec<String> = contour["hints"]
        .as_array()
        .map_or(vec![], |list| list.iter().map(|h| h.as_str().unwrap().to_string()).collect());
    let table = stdout(&trueness(words));
    assert!(all.iter().all(|hint| table.contains(&format!("! {hint}\n"))), "{table}");
    all
}

/// Of a ball cut by a slab about its middle the circle is t²/24R too small, and that is said; of a cylinder nothing is.
#[test]
fn a_slab_across_which_the_surface_bends_is_told() {
    let folder = Folder::new();
    let cloud = |ball: bool| -> String {
        (0..4000)
            .map(|i| {
                let (turn, z) = (TAU * even(i, 0.618_033_99), 2.0 * even(i, 0.414_213_56) - 1.0);
                let radius = if ball { (100.0 - z * z).sqrt() } else { 10.0 }
                    + scatter(i, if ball { 0.002 } else { 0.015 });
                format!("{} {} {z}\n", radius * turn.cos(), radius * turn.sin())
            })
            .collect()
    };
    for ball in [true, false] {
        let file = folder.write("cloud.xyz", cloud(ball));
        let words =
            ["section", file.to_str().unwrap(), "--plane", "0,0,1,0", "--thickness", "2", "--noise", "0.015"];
        let all = hints(&words);
        let want = usize::from(ball);
        assert_eq!(all.len(), want, "{all:?}");
        if ball {
            // 4 / 240.
            assert!(
                all[0].contains("of segment 1 is 0.017 too small") && all[0].contains("--thickness of 0."),
                "{all:?}"
            );
            let answer = document(words);
            let radius = answer["contours"][0]["segments"][0]["radius"].as_f64().unwrap();
            assert!((radius - 10.0 + 4.0 / 240.0).abs() < 5e-4, "{radius}");
        }
    }
}

/// A turn of a helix lies in no plane; the same turn with scatter across its plane does.
#[test]
fn points_off_their_plane_are_told() {
    let folder = Folder::new();
    let row = |rise: f64| -> String {
        (0..200)
            .map(|i| {
                let (s, c) = (TAU * 0.8 * f64::from(i) / 200.0).sin_cos();
                let r = 8.0 + scatter(i, 0.003);
                format!("{} {} {}\n", r * c, r * s, rise * f64::from(i) / 200.0 + scatter(i + 500, 0.003))
            })
            .collect()
    };
    let [helix, ring] = [3.0, 0.0].map(|rise| folder.write(&format!("{rise}.xyz"), row(rise)));
    let all = hints(&["section", helix.to_str().unwrap()]);
    assert!(
        all.len() == 1 && all[0].contains("off the plane nearest to them") && all[0].contains("--plane"),
        "{all:?}"
    );
    assert_eq!(hints(&["section", ring.to_str().unwrap()]), [""; 0]);
}

/// A noise far from what the points show is doubted, one near to it is not.
#[test]
fn a_noise_that_the_points_contradict_is_told() {
    let folder = Folder::new();
    let row: String = (0..400)
        .map(|i| {
            let a = 0.01 * f64::from(i.max(200) - 200);
            let s = 0.1 * f64::from(i.min(200));
            let off = scatter(i, 0.01);
            format!("{} {}\n", s + (10.0 - off) * a.sin(), 10.0 - (10.0 - off) * a.cos())
        })
        .collect();
    let file = folder.write("row.txt", row);
    let of = |noise: &str| hints(&["section", file.to_str().unwrap(), "--noise", noise]);
    assert_eq!(of("0.01"), [""; 0]);
    let [less, more] = [of("0.1"), of("0.002")];
    assert!(less.len() == 1 && less[0].contains("less than the --noise 0.1 given"), "{less:?}");
    // A search that follows scatter takes long: that may be told as well, with the same remedy.
    assert!(more[0].contains("more than the --noise 0.002 given"), "{more:?}");
    assert!(more[1..].iter().all(|h| h.contains("whether --noise is too small")), "{more:?}");
}

/// Scatter of many distances between points makes no gap; a real one stays told.
#[test]
fn scatter_is_no_gap() {
    let folder = Folder::new();
    let row = |gap: f64| -> String {
        (0..2000)
            .map(|i| {
                let s = 0.01 * f64::from(i) + if i < 1000 { 0.0 } else { gap };
                format!("{s} {}\n", scatter(i * 7 % 2003, 0.05))
            })
            .collect()
    };
    let gaps = |gap: f64| {
        document(["section", folder.write("row.txt", row(gap)).to_str().unwrap()])["contours"][0]["gaps"]
            .clone()
    };
    assert_eq!((gaps(0.0), gaps(3.0)), (serde_json::json!([]), serde_json::json!([999])));
}

/// Coordinates of points in space are those of the plane nearest to them, which the table names.
#[test]
fn the_plane_of_points_in_space_is_named() {
    let folder = Folder::new();
    let at = |i: u32| f64::from(i) * 0.1;
    let flat: String = (0..60).map(|i| format!("{} {}\n", at(i), 2.0 * at(i))).collect();
    let arc: String = (0..60).map(|i| format!("{} 7 {}\n", 5.0 * at(i).sin(), 5.0 * at(i).cos())).collect();
    for (name, text) in [("flat.txt", flat), ("space.txt", arc)] {
        let file = folder.write(name, text);
        let words = ["section", file.to_str().unwrap()];
        let (table, frame) = (stdout(&trueness(words)), document(words)["frame"].take());
        let named = table.lines().find(|l| l.starts_with("frame     x along "));
        assert_eq!(named.is_some(), name == "space.txt", "{table}");
        let Some(named) = named else { continue };
        // What stands in the line is the document's frame: origin, then both axes are at right angles to y.
        let numbers: Vec<f64> =
            (named.replace('−', "-").split([' ', ','])).filter_map(|w| w.parse::<f64>().ok()).collect();
        let told = |key: &str| (0..3).map(|k| frame[key][k].as_f64().unwrap()).collect::<Vec<_>>();
        let wanted = [told("x"), told("y"), told("origin")].concat();
        assert_eq!(numbers.len(), 9, "{named}");
        assert!(numbers.iter().zip(&wanted).all(|(a, b)| (a - b).abs() < 1e-4), "{named} {wanted:?}");
        assert!(
            numbers[1].abs() < 1e-3 && numbers[4].abs() < 1e-3 && (numbers[7] - 7.0).abs() < 1e-3,
            "{named}"
        );
    }
}

#[test]
fn clouds_that_tell_nothing_come_with_the_advice_that_fits() {
    let folder = Folder::new();
    // Roberts' sequence: neither a grid nor by chance.
    let even = |i: u32, step: f64| 10.0 * (f64::from(i) * step).fract();
    let area: String = (1..400)
        .map(|i| format!("{} {} {}\n", even(i, 0.754_877_67), even(i, 0.569_840_3), 0.01 * f64::from(i % 3)))
        .collect();
    let corner = |k: u32| (f64::from(k) * std::f64::consts::FRAC_PI_4 + 0.3).sin_cos();
    let octagon: String = (0..16)
        .map(|i| {
            // A corner, the middle of the side after it, and so on.
            let ((s, c), (t, d)) = (corner(i / 2), corner(i.div_ceil(2)));
            format!("{} {} {}\n", 5.0 * (c + d), 5.0 * (s + t), 0.01 * f64::from(i % 3))
        })
        .collect();
    for (name, cloud, want) in
        [("area.xyz", area, "a thinner slab"), ("octagon.xyz", octagon, "a thicker slab")]
    {
        let file = folder.write(name, cloud);
        let words = ["section", file.to_str().unwrap(), "--plane", "0,0,1,0.01", "--thickness", "0.1"];
        let answer = trueness(words);
        let text = stdout(&answer);
        assert_eq!(status(&answer), 1, "{text}");
        let advice: Vec<&str> = text.lines().filter(|l| l.starts_with("! ")).collect();
        assert!(!advice.is_empty() && advice.iter().all(|a| a.contains(want)), "{advice:?}");
    }
}
