//! The list of targets: one for each reader, and one each for the check and the repair of meshes.

mod cad;
mod meshes;
mod readers;
mod scans;

use std::path::Path;
use trueness_geom::num::random::Random;

/// A part of the program that is given broken input.
pub struct Target {
    /// Its name on the command line.
    pub name: &'static str,
    /// How files of its cases end.
    pub extension: &'static str,
    /// The cases it begins with; the argument is the folder `corpus`.
    pub seeds: fn(&Path) -> Vec<Vec<u8>>,
    /// A new case from one and another.
    pub mutate: fn(&mut Random, &[u8], &[u8]) -> Vec<u8>,
    /// Tries a case, which also lies in the file. Panics where a promise is broken.
    pub run: fn(&[u8], &Path),
    /// The size, in bytes, that memory is measured against.
    pub size: fn(&[u8]) -> usize,
}

/// All targets.
pub const TARGETS: [Target; 15] = [
    readers::STL,
    readers::PLY,
    readers::OBJ,
    readers::OFF,
    readers::TABLE,
    readers::NPY,
    scans::PCD,
    scans::PTX,
    scans::LAS,
    scans::E57,
    readers::GZ,
    cad::STEP,
    cad::IGES,
    meshes::CHECK,
    meshes::REPAIR,
];

/// The files below `folder` that are short enough and end in one of `extensions`, in the order of their names.
fn files(folder: &Path, extensions: &[&str]) -> Vec<Vec<u8>> {
    const LONGEST: u64 = 1 << 15;
    let (mut paths, mut folders) = (vec![], vec![folder.to_path_buf()]);
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).into_iter().flatten().flatten() {
            let path = entry.path();
            let ends = |e: &str| path.extension().is_some_and(|x| x.eq_ignore_ascii_case(e));
            if path.is_dir() {
                folders.push(path);
            } else if extensions.iter().any(|e| ends(e)) && entry.metadata().is_ok_and(|m| m.len() <= LONGEST)
            {
                paths.push(path);
            }
        }
    }
    paths.sort();
    paths.iter().filter_map(|p| std::fs::read(p).ok()).collect()
}
