//! The list of formats: a format is one file or folder here and one line in [`FORMATS`]. Its page, `NAME.md`, is
//! what `trueness formats NAME` prints.

pub(crate) mod brep;
pub(crate) mod dxf;
pub(crate) mod e57;
pub(crate) mod iges;
pub(crate) mod las;
pub(crate) mod npy;
pub(crate) mod npz;
pub(crate) mod obj;
pub(crate) mod off;
#[cfg(feature = "parquet")]
pub(crate) mod parquet;
pub(crate) mod pcd;
pub(crate) mod ply;
pub(crate) mod ptx;
pub(crate) mod spline;
pub(crate) mod step;
pub(crate) mod stl;
pub(crate) mod strided;
pub(crate) mod svg;
pub(crate) mod table;
pub(crate) mod vtp;

use crate::format::{Format, Holds};

/// All formats. Formats whose content shows them plainly come first.
pub static FORMATS: &[&Format] = &[
    &ply::PLY,
    &npy::NPY,
    &pcd::PCD,
    &ptx::PTX,
    &las::LAS,
    &e57::E57,
    &off::OFF,
    &stl::STL,
    &obj::OBJ,
    &step::STEP,
    &iges::IGES,
    &dxf::DXF,
    &table::TABLE,
    &npz::NPZ,
    &vtp::VTP,
    #[cfg(feature = "parquet")]
    &parquet::PARQUET,
];

impl Format {
    /// The format of this name or extension (upper or lower case).
    pub fn named(name: &str) -> Option<&'static Format> {
        let is = |s: &&str| s.eq_ignore_ascii_case(name);
        let by_name = FORMATS.iter().copied().find(|f| is(&f.name));
        by_name.or_else(|| Format::by_extension(name))
    }
    /// The format whose files end in `extension`, given without dot, upper or lower case.
    pub fn by_extension(extension: &str) -> Option<&'static Format> {
        FORMATS.iter().copied().find(|f| f.extensions.iter().any(|e| e.eq_ignore_ascii_case(extension)))
    }
}

impl Holds {
    /// The names of the formats that hold it, as messages have them: `STL, OBJ or PLY`.
    pub fn formats(self) -> String {
        let holding = FORMATS.iter().filter(|f| f.holds.contains(&self));
        let names: Vec<&str> = holding.flat_map(|f| f.known_as.iter().copied()).collect();
        match names.split_last() {
            Some((last, [])) => (*last).into(),
            Some((last, others)) => format!("{} or {last}", others.join(", ")),
            None => String::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::write::scratch::Folder;
    use crate::write::{self, Block, Layout};
    use crate::{Body, ReadOptions, open};
    use std::collections::BTreeSet;
    use std::path::Path;
    use trueness_geom::mesh::Mesh;
    use trueness_geom::space::Point;

    fn tetrahedron() -> Mesh {
        let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 4.0]];
        Mesh { positions, faces: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]] }
    }

    /// The places that a file holds; of a mesh those of its facets' corners, one after the other.
    fn places(path: &Path) -> Vec<Point> {
        let input = open(path, &ReadOptions::default()).unwrap();
        match input.body {
            Body::Mesh(source) => {
                source.mesh.faces.iter().flatten().map(|v| source.mesh.positions[*v as usize]).collect()
            }
            Body::Splines(_) | Body::Cad(_) | Body::Drawing(_) => vec![],
            Body::Points(mut points) => {
                let (mut all, mut block) = (vec![], vec![]);
                while points.next_block(&mut block).is_ok() && !block.is_empty() {
                    all.extend_from_slice(&block);
                }
                all
            }
        }
    }

    /// A written file reads back under a name that does not tell the format; cut short anywhere, it does no harm.
    fn reads_back(folder: &Folder, written: &Path, wanted: &[Point]) {
        assert_eq!(places(written), wanted, "{}", written.display());
        let (bytes, nameless) = (std::fs::read(written).unwrap(), folder.path().join("nameless"));
        std::fs::write(&nameless, &bytes).unwrap();
        assert_eq!(places(&nameless), wanted, "{}", written.display());
        for end in 0..bytes.len() {
            std::fs::write(&nameless, &bytes[..end]).unwrap();
            if let Ok(Body::Points(mut points)) = open(&nameless, &ReadOptions::default()).map(|i| i.body) {
                let _ = points.next_block(&mut vec![]);
            }
        }
    }

    #[test]
    fn every_format_keeps_what_it_promises() {
        let (folder, mut words) = (Folder::new(), BTreeSet::new());
        for format in FORMATS {
            assert_eq!(format.reads(), !format.holds.is_empty(), "{format:?}");
            assert_eq!(format.model.is_some(), format.holds.contains(&Holds::Model), "{format:?}");
            assert!(!format.known_as.is_empty(), "{format:?}");
            assert!(format.reads() || format.writes_points() || format.writes_meshes(), "{format:?}");
            assert!(format.manual.starts_with('#'), "{format:?}: its page has no heading");
            let own: BTreeSet<&str> =
                std::iter::once(format.name).chain(format.extensions.to_vec()).collect();
            for word in own {
                assert!(words.insert(word), "{word} stands for two formats");
                assert_eq!(Format::named(&word.to_uppercase()), Some(*format));
            }
            for ending in format.written_as {
                let path = folder.path().join(format!("a.{ending}"));
                if format.writes_meshes() {
                    let mesh = tetrahedron();
                    write::mesh(&path, &mesh).unwrap();
                    if format.reads() {
                        let corners = mesh.faces.iter().flatten().map(|v| mesh.positions[*v as usize]);
                        reads_back(&folder, &path, &corners.collect::<Vec<_>>());
                    }
                }
                if format.writes_points() {
                    let points = tetrahedron().positions;
                    let mut file = write::points(&path, Layout::default()).unwrap();
                    file.write(&Block { points: &points, ..Block::default() }).unwrap();
                    assert_eq!(file.finish().unwrap(), 4);
                    if format.reads() {
                        reads_back(&folder, &path, &points);
                    }
                }
            }
        }
    }
}
