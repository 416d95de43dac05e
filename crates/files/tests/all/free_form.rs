//! Small meshes in text, written in every way that the formats allow, are read to what was written; damaged ones are refused
//! with place and remedy. The ways are drawn at random, from a fixed seed.

use crate::common;

use common::Folder;
use std::path::Path;
use trueness_files::{Body, ReadOptions, Weld, open};
use trueness_geom::space::Point;

/// Files of a format.
const TRIES: u64 = 300;

/// Random numbers.
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((self.0 >> 33) as usize) % n
    }
    fn one_in(&mut self, n: usize) -> bool {
        self.below(n) == 0
    }
    fn one<'a>(&mut self, of: &[&'a str]) -> &'a str {
        of[self.below(of.len())]
    }
}

struct Solid {
    positions: Vec<Point>,
    faces: Vec<[usize; 3]>,
}

impl Solid {
    /// Places on a grid of quarters, no two the same, and facets of any three of them.
    fn random(random: &mut Random) -> Solid {
        let n = 4 + random.below(6);
        let number = |random: &mut Random| random.below(400) as f64 / 4.0 - 50.0;
        let positions = (0..n).map(|i| [i as f64, number(random), number(random)]).collect();
        let face = |random: &mut Random| {
            let a = random.below(n);
            let b = (a + 1 + random.below(n - 1)) % n;
            let c = (0..n).filter(|c| *c != a && *c != b).nth(random.below(n - 2)).unwrap();
            [a, b, c]
        };
        let mut faces: Vec<[usize; 3]> = (0..2 + random.below(6)).map(|_| face(random)).collect();
        faces.push([0, 1, n - 1]);
        Solid { positions, faces }
    }

    fn corners(&self) -> Vec<[Point; 3]> {
        self.faces.iter().map(|f| f.map(|v| self.positions[v])).collect()
    }
}

/// How a text is laid out.
struct Style {
    end: &'static str,
    /// Whether words may be broken over lines anywhere.
    free: bool,
}

impl Style {
    fn random(random: &mut Random) -> Style {
        Style { end: random.one(&["\n", "\n", "\r\n", "\r"]), free: random.one_in(2) }
    }
    /// Puts rows of words together.
    fn text(&self, random: &mut Random, rows: &[Vec<String>]) -> String {
        let mut text = String::new();
        for row in rows {
            for (i, word) in row.iter().enumerate() {
                if i > 0 {
                    text += if self.free && random.one_in(4) {
                        self.end
                    } else {
                        random.one(&[" ", " ", "\t", "  "])
                    };
                }
                text += word;
            }
            text += if self.free && random.one_in(3) { " " } else { self.end };
            if random.one_in(12) {
                text += self.end;
            }
        }
        text + self.end
    }
}

fn number(random: &mut Random, x: f64) -> String {
    match random.below(5) {
        0 => format!("{x:.6}"),
        1 => format!("{x:e}"),
        2 if x >= 0.0 => format!("+{x}"),
        3 => format!("{x:E}"),
        _ => format!("{x}"),
    }
}

fn point(random: &mut Random, p: Point) -> Vec<String> {
    p.iter().map(|x| number(random, *x)).collect()
}

fn words(text: &str) -> Vec<String> {
    text.split(' ').map(String::from).collect()
}

fn case(random: &mut Random, word: &str) -> String {
    if random.one_in(4) { word.to_uppercase() } else { word.into() }
}

fn obj(random: &mut Random, solid: &Solid) -> String {
    let end = Style::random(random).end;
    let asides = [
        "# head\\",
        "# C:\\models\\",
        "mtllib C:\\parts\\",
        "usemtl a\\",
        "g f\\",
        "o v 1 2\\",
        "",
        "s off",
        "# v 1 2 3",
        "usemtl f",
        "g",
        "vt 0 0",
        "vn 0 \\\n0 1",
    ];
    let mut text = String::new();
    let aside = |random: &mut Random, text: &mut String| {
        if random.one_in(3) {
            *text += &random.one(&asides).replace('\n', end);
            *text += end;
        }
    };
    let line = |random: &mut Random, words: Vec<String>| {
        let mut line = String::new();
        for (i, word) in words.iter().enumerate() {
            if i > 0 {
                let broken = [" \\", "\\", "\\ "].map(|b| format!("{b}{end} "));
                line +=
                    if random.one_in(8) { &broken[random.below(3)] } else { random.one(&[" ", "  ", "\t"]) };
            }
            line += word;
        }
        line + random.one(&["", "", " ", " # note", " # note \\"]) + end
    };
    for p in &solid.positions {
        aside(random, &mut text);
        let row = [vec!["v".into()], point(random, *p)].concat();
        text += &line(random, row);
    }
    for f in &solid.faces {
        aside(random, &mut text);
        let n = solid.positions.len() as i64;
        let corner = |random: &mut Random, v: usize| match random.below(3) {
            0 => format!("{}", v as i64 - n),
            1 => format!("{}/1/1", v + 1),
            _ => format!("{}", v + 1),
        };
        let corners = f.map(|v| corner(random, v));
        text += &line(random, [vec!["f".into()], corners.to_vec()].concat());
    }
    text + random.one(&["", "", "\x1a", "# end\\"])
}

fn stl(random: &mut Random, solid: &Solid) -> String {
    let style = Style::random(random);
    let names = [
        "",
        "part",
        "facet normal",
        "facet normal 0 0 1",
        "my endsolid part",
        "end solid",
        "solid",
        "endfacet endloop",
        "vertex 1 2 3",
        "outer loop",
        "solid facet",
        "endsolid",
    ];
    let two = random.one_in(3);
    let end = |random: &mut Random, of: &str| {
        let word = if two { format!("end {of}") } else { format!("end{of}") };
        case(random, &word)
    };
    let mut text = String::new();
    let mut at = 0;
    while at < solid.faces.len() {
        let to = solid.faces.len().min(at + 1 + random.below(9));
        let name = random.one(&names);
        text += &format!("{} {name}{}", case(random, "solid"), style.end);
        for corners in &solid.corners()[at..to] {
            let mut rows = vec![words("facet normal 0 0 1"), words("outer loop")];
            rows.extend(corners.iter().map(|p| [vec!["vertex".into()], point(random, *p)].concat()));
            rows.extend([vec![end(random, "loop")], vec![end(random, "facet")]]);
            text += &style.text(random, &rows);
        }
        let again = if random.one_in(2) { name } else { "" };
        text += &format!("{} {again}{}", end(random, "solid"), style.end);
        at = to;
    }
    text + random.one(&["", "", "\x1a", "\0\0\0\0", "\r\n\x1a\x1a", "\n\0\0"])
}

fn off(random: &mut Random, solid: &Solid) -> String {
    let style = Style::random(random);
    let prefix = random.one(&["", "", "", "C", "N", "ST"]);
    let extra = match prefix {
        "C" => "0.5 0.5 0.5 1",
        "N" => "0 0 1",
        "ST" => "0.25 0.75",
        _ => "",
    };
    let counts = format!("{} {} 0", solid.positions.len(), solid.faces.len());
    let mut rows = vec![words(&counts)];
    for p in &solid.positions {
        rows.push(point(random, *p));
        if !extra.is_empty() {
            rows.last_mut().unwrap().extend(words(extra));
        }
    }
    let colors = if style.free { "" } else { random.one(&["", "", " 255 0 0", " 1 0 0 1", " 7"]) };
    // The number of the last vertex as a color would stand in for that corner where it is lost.
    let colors = if colors == " 7" && solid.positions.len() == 8 { " 6" } else { colors };
    rows.extend(solid.faces.iter().map(|[a, b, c]| words(&format!("3 {a} {b} {c}{colors}"))));
    let mut text = style.text(random, &rows);
    if random.one_in(3) {
        text = text.replacen(style.end, &format!(" # 3 0 1 2{}", style.end), 1 + random.below(4));
    }
    let between = random.one(&[" ", "#\n", "\n# a comment\n\n"]).replace('\n', style.end);
    let between =
        if between == " " && prefix.is_empty() { between } else { format!("{}{between}", style.end) };
    format!("{prefix}OFF{between}{text}{}", random.one(&["", "", "\x1a", "\0\0\0"]))
}

fn ply(random: &mut Random, solid: &Solid) -> String {
    let style = Style::random(random);
    let (list_before, list_after, quality) = (random.one_in(5), random.one_in(5), random.one_in(3));
    let mut vertex_head = format!("element vertex {}\n", solid.positions.len());
    vertex_head += if list_before { "property list uchar int neighbors\n" } else { "" };
    vertex_head += "property float x\nproperty double y\nproperty float z\n";
    vertex_head += if list_after { "property list uchar float more\n" } else { "" };
    let mut face_head = format!("element face {}\n", solid.faces.len());
    face_head += if quality { "property float quality\n" } else { "" };
    face_head += "property list uchar int vertex_indices\n";
    let list = |random: &mut Random| {
        let n = random.below(3);
        [vec![n.to_string()], vec!["1".into(); n]].concat()
    };
    let mut vertices = vec![];
    for p in &solid.positions {
        let before = if list_before { list(random) } else { vec![] };
        let after = if list_after { list(random) } else { vec![] };
        vertices.push([before, point(random, *p), after].concat());
    }
    let quality = if quality { "0.5 " } else { "" };
    let faces = solid.faces.iter().map(|[a, b, c]| words(&format!("{quality}3 {a} {b} {c}"))).collect();
    let (heads, rows) = if random.one_in(3) {
        (format!("{face_head}{vertex_head}"), [faces, vertices].concat())
    } else {
        (format!("{vertex_head}{face_head}"), [vertices, faces].concat())
    };
    let magic = random.one(&["ply", "ply", "PLY"]);
    let comment = random.one(&["", "comment element vertex 3\n", "obj_info x\n"]);
    let head = format!("{magic}\nformat ascii 1.0\n{comment}{heads}end_header\n");
    let tail = random.one(&["", "", "\x1a", "\0\0\0"]);
    head.replace('\n', style.end) + &style.text(random, &rows) + tail
}

type Writer = fn(&mut Random, &Solid) -> String;
const FORMATS: [(&str, Writer); 4] = [("obj", obj), ("stl", stl), ("off", off), ("ply", ply)];

/// The corners of the facets of a file, in its order.
fn read(path: &Path) -> Result<Vec<[Point; 3]>, String> {
    let options = ReadOptions { weld: Weld::None, ..ReadOptions::default() };
    match open(path, &options).map_err(|e| e.to_string())?.body {
        Body::Mesh(source) => {
            let at = |f: &[u32; 3]| f.map(|v| source.mesh.positions[v as usize]);
            Ok(source.mesh.faces.iter().map(at).collect())
        }
        _ => Err("no mesh".into()),
    }
}

#[test]
fn every_way_to_write_a_mesh_in_text_is_read() {
    let folder = Folder::new();
    for (format, write) in FORMATS {
        let (mut refused, mut wrong, mut shown) = (0, 0, String::new());
        for seed in 0..TRIES {
            let mut random = Random(seed * 7919 + 1);
            let solid = Solid::random(&mut random);
            let text = write(&mut random, &solid);
            // With the extension and without.
            let name = if random.one_in(2) { format!("a.{format}") } else { "a".into() };
            match read(&folder.file(&name, text.as_bytes())) {
                Ok(read) if read == solid.corners() => continue,
                Ok(_) => {
                    wrong += 1;
                    shown = format!("wrong: {text}");
                }
                Err(said) => {
                    refused += 1;
                    shown = if shown.is_empty() { format!("{said}: {text}") } else { shown };
                }
            }
        }
        println!("{format}: {refused} refused and {wrong} wrong of {TRIES}");
        assert!(refused + wrong == 0, "{format}: {refused} refused and {wrong} wrong of {TRIES}\n{shown}");
    }
}

/// A word lost, doubled or made into none: the count of words no longer fits, or one of them is no number.
#[test]
fn damaged_text_is_refused_with_place_and_remedy() {
    let folder = Folder::new();
    for (format, write) in FORMATS {
        let (mut silent, mut unplaced, mut shown) = (0, 0, String::new());
        for seed in 0..TRIES {
            let mut random = Random(seed * 104_729 + 5);
            let solid = Solid::random(&mut random);
            let text = write(&mut random, &solid);
            let Some(damaged) = damaged(&mut random, format, &text) else { continue };
            let said =
                match open(&folder.file(&format!("a.{format}"), damaged.as_bytes()), &ReadOptions::default())
                {
                    Ok(input)
                        if input.warnings.is_empty()
                            || read(&folder.path().join(format!("a.{format}"))) == Ok(solid.corners()) =>
                    {
                        silent += 1;
                        shown = damaged;
                        continue;
                    }
                    Ok(_) => continue,
                    Err(e) => e.to_string(),
                };
            if !(said.contains(", line ") && said.contains("; ")) {
                unplaced += 1;
                shown = format!("{said}: {damaged}");
            }
        }
        println!("{format}: {silent} read without a word, {unplaced} refused without a place, of {TRIES}");
        assert!(silent + unplaced == 0, "{format}: {silent} silent, {unplaced} without a place\n{shown}");
    }
}

/// The text with one number in the last facet or vertex made into a word, or lost.
fn damaged(random: &mut Random, format: &str, text: &str) -> Option<String> {
    let keep = text.trim_end_matches(['\0', '\x1a', '\n', '\r', ' ']);
    let is_number = |word: &&str| word.parse::<f64>().is_ok();
    let start = if format == "obj" { keep.rfind("\nv ").or(keep.rfind("\rv "))? } else { 0 };
    let line = keep.rsplit(['\n', '\r']).next()?;
    let row: Vec<&str> = line.split_ascii_whitespace().collect();
    let numbers: Vec<&str> = match format {
        // The first coordinate of the last vertex.
        "obj" => keep[start + 3..].split_ascii_whitespace().take(1).collect(),
        // Behind the last facet stands a name, in which there may be any word.
        "stl" => keep[keep[..keep.rfind(['\n', '\r'])?].rfind("vertex")? + 6..]
            .split_ascii_whitespace()
            .take(1)
            .collect(),
        // Behind the corners on a line there may be a color, which a facet need not have and which is not read.
        "off" if row.len() > 4 && row[0] == "3" => row[3..4].to_vec(),
        _ => keep.split_ascii_whitespace().filter(is_number).collect(),
    };
    let word = numbers.last().copied().filter(is_number)?;
    let at = word.as_ptr() as usize - text.as_ptr() as usize;
    let instead = random.one(&["x", "1,5", ""]);
    let instead = if instead.is_empty() && matches!(format, "obj") { "?" } else { instead };
    Some(format!("{}{instead}{}", &text[..at], &text[at + word.len()..]))
}

#[test]
fn formats_that_are_not_read_are_named() {
    let folder = Folder::new();
    let rows = "1 2 3\n4 5 6\n7 8 9\n";
    // By their endings, whatever they hold.
    for (ending, name) in [
        ("3mf", "3MF"),
        ("3MF", "3MF"),
        ("3mf.gz", "3MF"),
        ("fls", "FARO"),
        ("glb", "glTF"),
        ("gltf", "glTF"),
        ("x3d", "X3D"),
        ("jt", "JT"),
        ("sldprt", "SolidWorks"),
        ("wrl", "VRML"),
    ] {
        let said = read(&folder.file(&format!("a.{ending}"), rows.as_bytes())).unwrap_err();
        assert!(said.contains(name) && said.contains("export it as"), "{said}");
    }
    // By what they hold, whatever they are called.
    for (text, name) in [
        ("glTF\x02\0\0\0", "glTF"),
        ("{\"asset\": {\"version\": \"2.0\"}}", "glTF"),
        ("<?xml version=\"1.0\"?>\n<X3D><Scene/></X3D>", "X3D"),
        ("#VRML V2.0 utf8\n1 2 3\n", "VRML"),
    ] {
        for file in ["a", "a.xyz", "a.stl"] {
            let said = read(&folder.file(file, text.as_bytes())).unwrap_err();
            assert!(said.contains(name) && said.contains("export it as"), "{file}: {said}");
        }
    }
}

#[test]
fn solids_keep_their_names() {
    let folder = Folder::new();
    let facet = |z: &str| {
        format!(
            "facet normal 0 0 1\nouter loop\nvertex 0 0 {z}\nvertex 1 0 {z}\nvertex 0 1 {z}\nendloop\nendfacet\n"
        )
    };
    let solid = |name: &str, zs: &[&str]| {
        format!("solid {name}\n{}endsolid\n", zs.iter().map(|z| facet(z)).collect::<String>())
    };
    let text = solid("my endsolid part", &["0", "1"]) + &solid("", &[]) + &solid("b", &["nan", "2"]);
    let Body::Mesh(source) =
        open(&folder.file("a.stl", text.as_bytes()), &ReadOptions::default()).unwrap().body
    else {
        panic!()
    };
    let regions = source.regions.unwrap();
    assert_eq!(regions.names, ["my endsolid part", "", "b"]);
    assert_eq!(regions.of_facet, [0, 0, 2]);
    // Parts of a large file are read at the same time.
    let many = vec!["3"; 20_000];
    let text = solid("a", &many) + &solid("b", &many);
    let Body::Mesh(source) =
        open(&folder.file("b.stl", text.as_bytes()), &ReadOptions::default()).unwrap().body
    else {
        panic!()
    };
    let regions = source.regions.unwrap();
    assert_eq!(regions.names, ["a", "b"]);
    assert!(regions.of_facet.iter().enumerate().all(|(f, r)| *r == u32::from(f >= 20_000)));
}
