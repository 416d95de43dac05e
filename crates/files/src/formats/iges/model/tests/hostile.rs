//! Damaged files and files that are made to do harm: no crash, bounded time and memory, and nothing is left out in silence.

use super::super::super::written::{Text, list};
use super::solids::solid_box;
use super::{bound, circle, line, plane, polygon, read, read_bytes};
use std::time::Instant;
use trueness_geom::num::random::Random;

/// A solid and two faces, with what they need.
fn some() -> Text {
    let mut text = Text::new();
    let solid = solid_box(&mut text, &[1]);
    let inner = text.add(308, format!("0,3HBOX,1,{solid}"));
    let at = text.add(124, "1.,0.,0.,5.,0.,1.,0.,0.,0.,0.,1.,0.");
    text.add(408, format!("{inner},0.,0.,0.,1."));
    text.placed(at);
    let surface = plane(&mut text, [0.0, 0.0, 1.0], [0.0; 3]);
    let ring = circle(&mut text, [0.0; 3], 2.0, 0.0);
    let around = bound(&mut text, surface, ring);
    text.add(144, format!("{surface},1,0,{around}"));
    let axis = line(&mut text, [0.0; 3], [0.0, 0.0, 1.0]);
    let profile = line(&mut text, [2.0, 0.0, 0.0], [2.0, 0.0, 5.0]);
    let surface = text.add(120, format!("{axis},{profile},0.,4."));
    let own = polygon(&mut text, &[[0.2, 1.0, 0.0], [0.8, 1.5, 0.0], [0.8, 2.5, 0.0]]);
    let around = text.add(142, format!("0,{surface},{own},0,1"));
    text.add(144, format!("{surface},1,0,{around}"));
    text
}

#[test]
fn cut_short_anywhere_it_is_never_taken_for_whole() {
    let whole = some().bytes();
    let last = whole.len() - 81;
    for end in (0..last).step_by(37) {
        if let Ok(file) = read_bytes(whole[..end].to_vec()) {
            assert!(!file.model.is_complete(), "{end}");
        }
    }
}

#[test]
fn changed_anywhere_it_does_no_harm() {
    let whole = some().bytes();
    let mut random = Random::stream(12, 0);
    for _ in 0..1500 {
        let mut bytes = whole.clone();
        for _ in 0..1 + random.below(4) {
            let at = random.below(bytes.len() as u64) as usize;
            bytes[at] = b"0123456789HSGDPT,;.-+E \n"[random.below(24) as usize];
        }
        let _ = read_bytes(bytes);
    }
}

/// Damage costs the faces that need the entity, and is told.
#[test]
fn damage_costs_the_faces_that_need_it() {
    let cases = [
        ("0.,0.,0.,x,0.,2.,0.", "a number"),
        ("0.,0.,0.,0.,0.,2.,0.", "without a radius"),
        ("0.,0.", "cut short"),
        ("0.,0.,0.,2.,0.,2.,0.,9H", "damaged parameters"),
    ];
    for (arc, wanted) in cases {
        let mut text = Text::new();
        let surface = plane(&mut text, [0.0, 0.0, 1.0], [0.0; 3]);
        let ring = text.add(100, arc);
        let around = bound(&mut text, surface, ring);
        text.add(144, format!("{surface},1,0,{around}"));
        solid_box(&mut text, &[]);
        let file = read(&text);
        assert_eq!(file.model.parts[0].brep.faces.len(), 6, "{arc}");
        let told = format!("{:?}", file.model.unread);
        assert!(told.contains(wanted) && told.contains("trimmed surface (144)"), "{arc}: {told}");
        assert!(!file.model.is_complete());
    }
}

#[test]
fn what_rests_on_itself_ends() {
    let start = Instant::now();
    // A composite curve of itself, a matrix placed by itself, an offset of itself.
    let mut text = Text::new();
    solid_box(&mut text, &[]);
    let surface = plane(&mut text, [0.0, 0.0, 1.0], [0.0; 3]);
    let own = text.add(102, format!("2,{0},{0}", surface + 2));
    let around = bound(&mut text, surface, own);
    text.add(144, format!("{surface},1,0,{around}"));
    let at = text.add(124, "1.,0.,0.,5.,0.,1.,0.,0.,0.,0.,1.,0.");
    text.placed(at);
    let ring = circle(&mut text, [0.0; 3], 2.0, 0.0);
    text.placed(at);
    let around = bound(&mut text, surface, ring);
    text.add(144, format!("{surface},1,0,{around}"));
    let next = text.add(116, "0.,0.,0.") + 2;
    let offset = text.add(140, format!("0.,0.,1.,2.,{next}"));
    text.add(144, format!("{offset},1,0,{around}"));
    let file = read(&text);
    assert_eq!(file.model.parts[0].brep.faces.len(), 6);
    let told: Vec<_> = file.model.unread.iter().filter(|u| u.holds_faces).map(|u| &u.reason).collect();
    assert!(told.len() == 3 && told.iter().all(|r| r.contains("rests on itself")), "{told:?}");
    assert!(start.elapsed().as_secs_f64() < 1.0);
}

/// Each level doubles: curves of curves, subfigures of subfigures, and a large surface in many faces.
#[test]
fn what_doubles_is_refused() {
    let start = Instant::now();
    let mut text = Text::new();
    let surface = plane(&mut text, [0.0, 0.0, 1.0], [0.0; 3]);
    let mut curve = line(&mut text, [0.0; 3], [1.0, 0.0, 0.0]);
    for _ in 0..15 {
        curve = text.add(102, format!("16,{}", list([curve; 16])));
    }
    let around = bound(&mut text, surface, curve);
    text.add(144, format!("{surface},1,0,{around}"));
    let error = read_bytes(text.bytes()).unwrap_err().to_string();
    assert!(error.contains("memory"), "{error}");
    let mut text = Text::new();
    let mut inner = solid_box(&mut text, &[]);
    for _ in 0..40 {
        let figure = text.add(308, format!("0,1HA,2,{inner},{inner}"));
        inner = text.add(408, format!("{figure},0.,0.,0.,1."));
    }
    let error = read_bytes(text.bytes()).unwrap_err().to_string();
    assert!(error.contains("instances of parts"), "{error}");
    assert!(start.elapsed().as_secs_f64() < 2.0, "{:?}", start.elapsed());
}

#[test]
fn compressed_files_are_told() {
    let mut bytes = format!("{:<72}C{:>7}\n", "", 1).into_bytes();
    bytes.extend(some().bytes());
    let error = read_bytes(bytes).unwrap_err().to_string();
    assert!(error.contains("compressed"), "{error}");
}
