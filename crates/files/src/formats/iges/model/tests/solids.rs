//! Solids with their own topology.

use super::super::super::written::{Text, list};
use super::{circle, line, measured, near, read};
use std::f64::consts::PI;
use trueness_cad::surface::SurfaceKind;

/// The corners of a box and, for each of its faces, four of them around it as seen from outside.
const CORNERS: [[f64; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [2.0, 0.0, 0.0],
    [2.0, 3.0, 0.0],
    [0.0, 3.0, 0.0],
    [0.0, 0.0, 4.0],
    [2.0, 0.0, 4.0],
    [2.0, 3.0, 4.0],
    [0.0, 3.0, 4.0],
];
pub(super) const SIDES: [([usize; 4], [f64; 3]); 6] = [
    ([0, 3, 2, 1], [0.0, 0.0, -1.0]),
    ([4, 5, 6, 7], [0.0, 0.0, 1.0]),
    ([0, 1, 5, 4], [0.0, -1.0, 0.0]),
    ([1, 2, 6, 5], [1.0, 0.0, 0.0]),
    ([2, 3, 7, 6], [0.0, 1.0, 0.0]),
    ([3, 0, 4, 7], [-1.0, 0.0, 0.0]),
];

pub(super) fn corner(k: usize) -> [f64; 3] {
    CORNERS[k]
}

/// A box of 2 × 3 × 4 as a solid (186); `turned` lists the faces whose planes look inward.
pub(super) fn solid_box(text: &mut Text, turned: &[usize]) -> u64 {
    let vertices = text.form(502, 1, format!("8,{}", list(CORNERS.concat())));
    let mut edges: Vec<[usize; 2]> = vec![];
    for (around, _) in SIDES {
        for k in 0..4 {
            let [a, b] = [around[k], around[(k + 1) % 4]];
            if !edges.contains(&[a.min(b), a.max(b)]) {
                edges.push([a.min(b), a.max(b)]);
            }
        }
    }
    let curves: Vec<u64> = edges.iter().map(|[a, b]| line(text, CORNERS[*a], CORNERS[*b])).collect();
    let member =
        |(curve, [a, b]): (&u64, &[usize; 2])| format!("{curve},{vertices},{},{vertices},{}", a + 1, b + 1);
    let members: Vec<String> = curves.iter().zip(&edges).map(member).collect();
    let list_of_edges = text.form(504, 1, format!("12,{}", members.join(",")));
    let mut faces = vec![];
    for (side, (around, normal)) in SIDES.into_iter().enumerate() {
        let is_turned = turned.contains(&side);
        let uses: Vec<String> = (0..4)
            .map(|k| {
                let [a, b] = [around[k], around[(k + 1) % 4]];
                let edge = edges.iter().position(|e| *e == [a.min(b), a.max(b)]).unwrap();
                format!("0,{list_of_edges},{},{},0", edge + 1, u8::from((a < b) != is_turned))
            })
            .collect();
        let uses: Vec<String> = if is_turned { uses.into_iter().rev().collect() } else { uses };
        let ring = text.form(508, 1, format!("4,{}", uses.join(",")));
        let point = text.add(116, list(CORNERS[around[0]]));
        let direction = text.add(123, list(normal.map(|n| if is_turned { -n } else { n })));
        let plane = text.add(190, format!("{point},{direction}"));
        let face = text.form(510, 1, format!("{plane},1,1,{ring}"));
        faces.push(format!("{face},{}", u8::from(!is_turned)));
    }
    let shell = text.form(514, 1, format!("6,{}", faces.join(",")));
    text.add(186, format!("{shell},1,0"))
}

#[test]
fn a_box_is_one_solid_whichever_way_its_planes_look() {
    for turned in [&[][..], &[1, 3], &[0, 1, 2, 3, 4, 5]] {
        let mut text = Text::new();
        solid_box(&mut text, turned);
        let found = measured(&text);
        let counts = (found.brep.faces.len(), found.brep.edges.len(), found.brep.vertices.len());
        assert_eq!((counts, found.brep.solids.len()), ((6, 12, 8), 1));
        assert!(near(found.volume, 24.0) && near(found.area(), 52.0), "{turned:?}: {}", found.volume);
        assert!(found.file.warnings.is_empty());
    }
}

#[test]
fn units_count_in_lengths() {
    for (unit, factor) in
        [("1,2HIN", 25.4), ("4,2HFT", 304.8), ("3,2HCM", 10.0), ("6,1HM", 1000.0), ("9,2HUM", 1e-3)]
    {
        let mut text = Text::in_unit(unit);
        solid_box(&mut text, &[]);
        assert!(near(measured(&text).volume / (24.0 * factor * factor * factor), 1.0), "{unit}");
        assert_eq!(read(&text).unit.millimeters, factor);
    }
}

/// A cylinder or a cone with its seam, between two caps: radii below and above.
fn turned_solid(text: &mut Text, [below, above]: [f64; 2], height: f64) {
    let rings = [(below, 0.0), (above, height)].map(|(r, z)| circle(text, [0.0, 0.0, z], r, 0.0));
    let seam = line(text, [below, 0.0, 0.0], [above, 0.0, height]);
    let vertices = text.form(502, 1, format!("2,{below},0.,0.,{above},0.,{height}"));
    let v = |k: usize| format!("{vertices},{k}");
    let edges = text.form(
        504,
        1,
        format!("3,{},{},{},{},{},{},{},{},{}", rings[0], v(1), v(1), rings[1], v(2), v(2), seam, v(1), v(2)),
    );
    let ring = |text: &mut Text, uses: &[(usize, u8)]| {
        let uses: Vec<String> =
            uses.iter().map(|(edge, along)| format!("0,{edges},{edge},{along},0")).collect();
        text.form(508, 1, format!("{},{}", uses.len(), uses.join(",")))
    };
    let around = ring(text, &[(1, 1), (3, 1), (2, 0), (3, 0)]);
    let [bottom, top] = [ring(text, &[(1, 0)]), ring(text, &[(2, 1)])];
    let axis = text.add(123, "0.,0.,1.");
    let down = text.add(123, "0.,0.,-1.");
    let [low, high] = [0.0, height].map(|z| text.add(116, list([0.0, 0.0, z])));
    let side = match below == above {
        true => text.add(192, format!("{low},{axis},{below}")),
        false => {
            // The radius grows along the axis of a cone: it looks down here.
            let angle = ((below - above) / height).atan().to_degrees();
            text.add(194, format!("{high},{down},{above},{angle}"))
        }
    };
    let planes = [text.add(190, format!("{low},{down}")), text.add(190, format!("{high},{axis}"))];
    let faces = [(side, around), (planes[0], bottom), (planes[1], top)]
        .map(|(surface, ring)| format!("{},1", text.form(510, 1, format!("{surface},1,1,{ring}"))));
    let shell = text.form(514, 1, format!("3,{}", faces.join(",")));
    text.add(186, format!("{shell},1,0"));
}

#[test]
fn seams_of_cylinders_and_cones() {
    let mut text = Text::new();
    turned_solid(&mut text, [2.0, 2.0], 5.0);
    let found = measured(&text);
    assert!(near(found.volume, 20.0 * PI) && near(found.area(), 28.0 * PI), "{}", found.volume);
    assert_eq!(found.brep.faces[0].surface.kind(), SurfaceKind::Cylinder);
    let mut text = Text::new();
    turned_solid(&mut text, [3.0, 1.0], 4.0);
    assert!(near(measured(&text).volume, PI * 4.0 * (9.0 + 3.0 + 1.0) / 3.0));
}

/// The matrix of a solid places all that it is made of; a mirror keeps its normals outward.
#[test]
fn solids_are_placed_and_mirrored() {
    for mirror in [1.0, -1.0] {
        let mut text = Text::new();
        let at = text.add(124, list([0.0, 0.0, mirror, 10.0, 1.0, 0.0, 0.0, 20.0, 0.0, 1.0, 0.0, 30.0]));
        solid_box(&mut text, &[2]);
        text.placed(at);
        let found = measured(&text);
        assert!(near(found.volume, 24.0), "{mirror}: {}", found.volume);
        let x = if mirror > 0.0 { [10.0, 14.0] } else { [6.0, 10.0] };
        assert!(near(found.bounds.min[0], x[0]) && near(found.bounds.max[0], x[1]));
        assert!(near(found.bounds.min[1], 20.0) && near(found.bounds.max[2], 33.0));
    }
}

/// Constructed solids are told, not left out in silence.
#[test]
fn what_is_not_read_is_told() {
    let mut text = Text::new();
    solid_box(&mut text, &[]);
    let ball = text.add(158, "3.,0.,0.,0.");
    let block = text.add(150, "1.,2.,3.,0.,0.,0.");
    text.add(180, format!("3,-{ball},-{block},1"));
    let file = read(&text);
    assert!(!file.model.is_complete());
    let told: Vec<&str> = file.model.unread.iter().map(|u| &u.keyword[..]).collect();
    assert_eq!(told, ["constructed solid (180)"]);
    assert!(file.model.unread[0].reason.contains("a solid made of other solids"), "{:?}", file.model.unread);
}

#[test]
fn colors_names_and_what_is_hidden() {
    let mut text = Text::new();
    let orange = text.add(314, "100.,50.,0.,6HORANGE");
    let name = text.form(406, 15, "1,6HBORE A");
    let center = text.add(116, "0.,0.,0.,0");
    text.add(196, format!("{center},2.,0,0"));
    text.colored(-(orange as i64));
    text.labeled("BALL");
    text.status("01000000");
    let surface = super::plane(&mut text, [0.0, 0.0, 1.0], [0.0; 3]);
    let ring = circle(&mut text, [0.0; 3], 1.0, 0.0);
    let around = super::bound(&mut text, surface, ring);
    let face = text.add(144, format!("{surface},1,0,{around},0,1,{name}"));
    text.colored(3);
    let file = read(&text);
    let faces = &file.model.parts[0].brep.faces;
    let seen: Vec<_> = faces.iter().map(|f| (&f.name[..], f.color.unwrap())).collect();
    assert_eq!(seen, [("BALL", [1.0, 0.5, 0.0, 1.0]), ("BORE A", [0.0, 1.0, 0.0, 1.0])]);
    assert_eq!(faces[1].entity, face);
    assert_eq!(file.model.hidden, [faces[0].entity]);
}
