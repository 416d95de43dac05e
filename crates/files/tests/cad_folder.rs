//! What is read of a folder of CAD files: a line for each, to be compared with what other programs read.
//!
//! `TRUENESS_CAD=FOLDER cargo test -p trueness-files --test cad_folder -- --ignored --nocapture`

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;
use trueness_cad::brep::Brep;
use trueness_cad::measure::Integrals;
use trueness_cad::model::Model;
use trueness_cad::trim::Trim;
use trueness_files::{ReadOptions, cad};
use trueness_geom::progress::Silent;

#[test]
#[ignore = "needs a folder of CAD files in TRUENESS_CAD"]
fn a_line_for_each_file() {
    let folder = std::env::var("TRUENESS_CAD").expect("TRUENESS_CAD names a folder");
    let mut paths = vec![];
    files(Path::new(&folder), &mut paths);
    paths.sort();
    let mut out = std::io::stdout();
    for path in paths {
        let start = Instant::now();
        let read = cad::read(&path, &ReadOptions::default(), &Silent);
        let seconds = start.elapsed().as_secs_f64();
        let about = match read {
            Ok(file) => format!("\"unit\":{},{}", file.unit.millimeters, summary(&file.model)),
            Err(e) => format!("\"error\":{:?}", e.to_string()),
        };
        writeln!(out, "{{\"file\":{:?},\"seconds\":{seconds:.3},{about}}}", path.display().to_string())
            .unwrap();
    }
}

fn files(folder: &Path, paths: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        if path.is_dir() {
            files(&path, paths);
        } else if ["step", "stp", "p21"].contains(&&extension[..]) {
            paths.push(path);
        }
    }
}

fn summary(model: &Model) -> String {
    let all = model.assembled();
    let mut kinds: BTreeMap<String, u32> = BTreeMap::new();
    for face in &all.faces {
        *kinds.entry(format!("{:?}", face.surface.kind()).to_lowercase()).or_default() += 1;
    }
    let kinds: Vec<String> = kinds.iter().map(|(k, n)| format!("{k:?}:{n}")).collect();
    let unread: Vec<String> = model
        .unread
        .iter()
        .map(|u| format!("{:?}", format!("#{} {} {} {}", u.entity, u.keyword, u.reason, u.holds_faces)))
        .collect();
    let placements: Vec<String> = model
        .instances
        .iter()
        .map(|i| format!("{{\"path\":{:?},\"matrix\":{:?}}}", i.path.join("/"), i.placement.matrix()))
        .collect();
    let wires: u64 =
        model.instances.iter().filter_map(|i| model.parts.get(i.part as usize)).map(|p| p.wires).sum();
    let shells = all.shells.len();
    let closed = all.shells.iter().filter(|s| s.closed).count();
    let colored = all.faces.iter().filter(|f| f.color.is_some()).count();
    let (area, volume, untrimmed) = integrals(&all, model.uncertainty.unwrap_or_default());
    format!(
        "\"area\":{area:?},\"volume\":{volume:?},\"untrimmed\":[{}],\"faces\":{{{}}},\"nfaces\":{},\"edges\":{},\"vertices\":{},\"solids\":{},\"shells\":{shells},\"closed_shells\":{closed},\
         \"instances\":{},\"depth\":{},\"wires\":{wires},\"colored\":{colored},\"hidden\":{},\"layers\":{:?},\"uncertainty\":{:?},\
         \"unread\":[{}],\"placements\":[{}]",
        untrimmed.join(","),
        kinds.join(","),
        all.faces.len(),
        all.edges.len(),
        all.vertices.len(),
        all.solids.len(),
        model.instances.len(),
        model.depth,
        model.hidden.len(),
        model.layers,
        model.uncertainty.unwrap_or_default(),
        unread.join(","),
        placements.join(",")
    )
}

/// Area of all faces, volume of all solids, and the faces whose border contradicts itself.
fn integrals(all: &Brep, uncertainty: f64) -> (f64, f64, Vec<String>) {
    let mut untrimmed = vec![];
    let mut of_face = vec![Integrals::default(); all.faces.len()];
    for (face, own) in all.faces.iter().zip(&mut of_face) {
        match Trim::new(all, face, uncertainty) {
            Ok(trim) => *own = Integrals::of(&trim, [0.0; 3]),
            Err(e) => {
                untrimmed.push(format!("{:?}", format!("#{} {:?} {e}", face.entity, face.surface.kind())))
            }
        }
    }
    let area = of_face.iter().map(|i| i.area).sum();
    let shells = all.solids.iter().flat_map(|s| s.voids.iter().chain([&s.outer]));
    let faces = shells.flat_map(|s| &all.shells[*s as usize].faces);
    (area, faces.map(|f| of_face[*f as usize].volume).sum(), untrimmed)
}
