//! Small files of each kind of entity, and what they are in closed form.

mod assembly;
mod borders;
mod hostile;
mod solids;
mod surfaces;

use super::super::written::{Text, list};
use crate::cad::{CadFile, read_from};
use crate::{MemorySources, ReadError, ReadOptions};
use std::path::Path;
use trueness_cad::brep::Brep;
use trueness_cad::trimmed::Trimmed;
use trueness_geom::progress::Silent;
use trueness_geom::space::Aabb;

/// Reads bytes.
fn read_bytes(bytes: Vec<u8>) -> Result<CadFile, ReadError> {
    let mut sources = MemorySources::new();
    sources.insert("model.igs", bytes);
    read_from(&sources, Path::new("model.igs"), &ReadOptions::default(), &Silent)
}

fn read(text: &Text) -> CadFile {
    read_bytes(text.bytes()).unwrap_or_else(|e| panic!("{e}\n{}", String::from_utf8_lossy(&text.bytes())))
}

/// What a model that must be read whole is.
struct Measured {
    file: CadFile,
    brep: Brep,
    areas: Vec<f64>,
    /// What the normals look out of, over all faces.
    volume: f64,
    bounds: Aabb,
}

impl Measured {
    fn area(&self) -> f64 {
        self.areas.iter().sum()
    }
}

fn measured(text: &Text) -> Measured {
    let file = read(text);
    assert!(file.model.unread.is_empty(), "{:?}", file.model.unread);
    let shape = Trimmed::of(&file.model, &Silent).unwrap();
    for trim in &shape.trims {
        assert!(trim.is_ok(), "{trim:?}");
    }
    let integrals = shape.integrals(&Silent).unwrap();
    let areas = integrals.iter().flatten().map(|i| i.area).collect();
    let volume = integrals.iter().flatten().map(|i| i.volume).sum();
    Measured { bounds: shape.bounds(), brep: shape.brep, file, areas, volume }
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * b.abs().max(1.0)
}

fn line(text: &mut Text, a: [f64; 3], b: [f64; 3]) -> u64 {
    text.add(110, list([a, b].concat()))
}

/// Lines from corner to corner around, as a composite curve.
fn polygon(text: &mut Text, corners: &[[f64; 3]]) -> u64 {
    let next = corners.iter().cycle().skip(1);
    let sides: Vec<u64> = corners.iter().zip(next).map(|(a, b)| line(text, *a, *b)).collect();
    text.add(102, format!("{},{}", sides.len(), list(sides)))
}

/// A curve in space on a surface.
fn bound(text: &mut Text, surface: u64, curve: u64) -> u64 {
    text.add(142, format!("0,{surface},0,{curve},2"))
}

/// The plane through a place at right angles to a normal.
fn plane(text: &mut Text, normal: [f64; 3], at: [f64; 3]) -> u64 {
    let d: f64 = (0..3).map(|k| normal[k] * at[k]).sum();
    text.add(108, format!("{},{d},0,{},0.", list(normal), list(at)))
}

/// A circle about a place, parallel to the plane of x and y, that begins at an angle.
fn circle(text: &mut Text, [x, y, z]: [f64; 3], radius: f64, from: f64) -> u64 {
    let p = [x + radius * from.cos(), y + radius * from.sin()];
    text.add(100, list([z, x, y, p[0], p[1], p[0], p[1]]))
}
