//! What is measured of a folder of CAD files: a line for each, to be compared with what other programs measure.
//!
//! `TRUENESS_CAD=FOLDER cargo test -p trueness-files --test cad_measures -- --ignored --nocapture`; with `TRUENESS_FACETS=SHARE` also facets
//! within that share of the diagonal.

#![allow(clippy::unwrap_used, reason = "a test may stop")]

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;
use trueness_cad::brep::Brep;
use trueness_cad::measure::{Integrals, bounds};
use trueness_cad::model::Model;
use trueness_cad::tessellate::{Fineness, Tessellation};
use trueness_cad::trim::{Trim, TrimError};
use trueness_files::{ReadOptions, cad};
use trueness_geom::parallel::prelude::*;
use trueness_geom::progress::Silent;
use trueness_geom::space::{Aabb, cross, dot, minus, norm};

#[test]
#[ignore = "needs a folder of CAD files in TRUENESS_CAD"]
fn a_line_for_each_file() {
    let folder = std::env::var("TRUENESS_CAD").expect("TRUENESS_CAD names a folder");
    let only = std::env::var("TRUENESS_ONLY").unwrap_or_default();
    let mut paths = vec![];
    files(Path::new(&folder), &mut paths);
    paths.retain(|p| p.to_string_lossy().contains(&only));
    paths.sort();
    let mut out = std::io::stdout();
    for path in paths {
        let read = cad::read(&path, &ReadOptions::default(), &Silent);
        let start = Instant::now();
        let about = match read {
            Ok(file) => summary(&file.model),
            Err(e) => format!("\"error\":{:?}", e.to_string()),
        };
        let seconds = start.elapsed().as_secs_f64();
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

type Measured = Result<(Trim, Integrals, Aabb), TrimError>;

fn summary(model: &Model) -> String {
    let all = model.assembled();
    let uncertainty = model.uncertainty.unwrap_or(0.0);
    let of = |face: &trueness_cad::brep::Face| -> Measured {
        let trim = Trim::new(&all, face, uncertainty)?;
        let integrals = Integrals::of(&trim, [0.0; 3]);
        let bounds = bounds(&trim);
        Ok((trim, integrals, bounds))
    };
    let start = Instant::now();
    let measured: Vec<Measured> = all.faces.par_iter().map(of).collect();
    let seconds = start.elapsed().as_secs_f64();
    let mut by_kind: BTreeMap<String, f64> = BTreeMap::new();
    let mut failed = vec![];
    let (mut area, mut bounds, mut gap, mut error) = (0.0, Aabb::EMPTY, 0.0f64, 0.0f64);
    for (face, own) in all.faces.iter().zip(&measured) {
        let kind = format!("{:?}", face.surface.kind()).to_lowercase();
        match own {
            Ok((trim, integrals, own)) => {
                *by_kind.entry(kind).or_default() += integrals.area;
                area += integrals.area;
                bounds = bounds.union(own);
                gap = gap.max(trim.gap);
                error += integrals.errors[0];
            }
            Err(e) => failed.push(format!("{:?}", format!("#{} {kind}: {e}", face.entity))),
        }
    }
    let of_shell = |shell: u32| -> f64 {
        let faces = &all.shells[shell as usize].faces;
        faces.iter().filter_map(|f| measured[*f as usize].as_ref().ok()).map(|m| m.1.volume).sum()
    };
    let volumes: Vec<f64> = all
        .solids
        .iter()
        .map(|s| of_shell(s.outer) + s.voids.iter().map(|v| of_shell(*v)).sum::<f64>())
        .collect();
    let kinds: Vec<String> = by_kind.iter().map(|(k, a)| format!("{k:?}:{a}")).collect();
    let faces: Vec<String> = all
        .faces
        .iter()
        .zip(&measured)
        .filter_map(|(f, m)| {
            m.as_ref().ok().map(|m| format!("[{},{},{}]", f.entity, m.1.area, m.1.errors[0]))
        })
        .collect();
    let facets = std::env::var("TRUENESS_FACETS").ok().and_then(|s| s.parse::<f64>().ok());
    let facets =
        facets.map_or(String::new(), |share| tessellated(&all, &measured, share * bounds.diagonal()));
    format!(
        "\"nfaces\":{},\"measure_seconds\":{seconds:.3},\"area\":{area},\"error\":{error},\"gap\":{gap},\"by_kind\":{{{}}},\"volumes\":{volumes:?},\
         \"bounds\":[{:?},{:?}],\"failed\":[{}],\"face_areas\":[{}]{facets}",
        all.faces.len(),
        kinds.join(","),
        bounds.min,
        bounds.max,
        failed.join(","),
        faces.join(","),
    )
}

fn tessellated(all: &Brep, measured: &[Measured], distance: f64) -> String {
    let trims: Vec<Option<&Trim>> = measured.iter().map(|m| m.as_ref().ok().map(|m| &m.0)).collect();
    let start = Instant::now();
    let made = match Tessellation::new(all, &trims, Fineness { distance, angle: 0.5 }, 5_000_000, &Silent) {
        Ok(made) => made,
        Err(e) => return format!(",\"facets\":{:?}", e.to_string()),
    };
    let seconds = start.elapsed().as_secs_f64();
    let mut sides: BTreeMap<[u32; 2], i32> = BTreeMap::new();
    let (mut area, mut volume) = (0.0, 0.0);
    let mut by_face = vec![0.0; all.faces.len()];
    for (f, face) in made.mesh.faces.iter().zip(&made.faces) {
        let [a, b, c] = f.map(|v| made.mesh.positions[v as usize]);
        let n = cross(minus(b, a), minus(c, a));
        area += 0.5 * norm(n);
        by_face[*face as usize] += 0.5 * norm(n);
        volume += dot(a, n) / 6.0;
        for i in 0..3 {
            *sides.entry([f[i], f[(i + 1) % 3]]).or_default() += 1;
        }
    }
    let open = sides.iter().filter(|([a, b], n)| sides.get(&[*b, *a]) != Some(n)).count();
    let doubled = sides.values().filter(|n| **n > 1).count();
    let coarse = made.bounds.iter().flatten().filter(|b| b.distance > 1.01 * distance).count();
    let unproven = made.bounds.iter().flatten().filter(|b| !b.is_proven).count();
    let failed: Vec<String> = made
        .failed
        .iter()
        .map(|(f, why)| format!("{:?}", format!("#{} {why}", all.faces[*f as usize].entity)))
        .collect();
    let off: Vec<String> = measured
        .iter()
        .enumerate()
        .filter_map(|(i, m)| m.as_ref().ok().map(|m| (i, m.1.area, m.0.gap)))
        .filter(|(i, area, _)| (by_face[*i] - area).abs() > 0.1 * area.max(distance * distance))
        .map(|(i, area, _)| format!("{:?}", format!("#{} {} {area}", all.faces[i].entity, by_face[i])))
        .collect();
    format!(
        ",\"facets\":{},\"facet_seconds\":{seconds:.3},\"facet_area\":{area},\"facet_volume\":{volume},\"open\":{open},\"doubled\":{doubled},\
         \"coarse\":{coarse},\"unproven\":{unproven},\"facets_failed\":[{}],\"facets_off\":[{}]",
        made.mesh.faces.len(),
        failed.join(","),
        off.join(",")
    )
}
