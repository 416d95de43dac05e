//! Facets or points with the number of the region they belong to.

use super::Writable;
use super::forms::{REGION_FORMS, RegionForm};
use crate::{
    AtomicFile,
    csv::{Csv, LineEnd},
    error::{WriteError, WriteFault},
};
use std::io::{BufWriter, Write};
use std::path::Path;
use trueness_geom::space::{Point, plus, times};

/// The pieces that have a region.
#[derive(Clone, Copy, Debug)]
pub enum Pieces<'a> {
    /// The points themselves.
    Points,
    /// Facets: the points that each one has for corners.
    Facets(&'a [[u32; 3]]),
}

/// Writes `points` (millimeters) and `pieces`, each with its label, −1 for none, and in a PLY file with a color. In a
/// PLY file, labels are a property `region` of vertices or faces. A CSV file has a row for each point or for the middle
/// of each facet. The file lies unfinished beside its place until it is committed.
///
/// # Errors
/// An extension other than .ply and .csv; a facet that names no point; as many labels as pieces must be given;
/// those of the system.
pub fn regions(
    path: &Path,
    points: &[Point],
    pieces: Pieces,
    labels: &[i32],
    color: impl Fn(i32) -> [u8; 3],
) -> Result<AtomicFile, WriteError> {
    let write = || -> Result<AtomicFile, WriteFault> {
        let form = Writable::Regions.form(path, REGION_FORMS)?;
        let count = check(points, pieces)?;
        if labels.len() != count {
            return Err(WriteFault::Uneven { what: "labels", points: count, values: labels.len() });
        }
        let mut file = BufWriter::new(AtomicFile::create(path)?);
        match form {
            RegionForm::Ply => ply(&mut file, points, pieces, labels, &color)?,
            RegionForm::Csv => csv(&mut file, points, pieces, labels)?,
        }
        Ok(file.into_inner().map_err(|e| e.into_error())?)
    };
    write().map_err(|e| e.in_file(path))
}

/// The number of pieces, all of whose corners exist.
fn check(points: &[Point], pieces: Pieces) -> Result<usize, WriteFault> {
    match pieces {
        Pieces::Points => Ok(points.len()),
        Pieces::Facets(faces) => {
            let lost = faces.iter().position(|face| face.iter().any(|&v| v as usize >= points.len()));
            lost.map_or(Ok(faces.len()), |face| Err(WriteFault::NoSuchVertex { face }))
        }
    }
}

type Color<'a> = &'a dyn Fn(i32) -> [u8; 3];

fn ply(
    file: &mut impl Write,
    points: &[Point],
    pieces: Pieces,
    labels: &[i32],
    color: Color,
) -> Result<(), WriteFault> {
    let label = "property int region\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n";
    let (on_points, faces) = match pieces {
        Pieces::Points => (label, String::new()),
        Pieces::Facets(faces) => {
            ("", format!("element face {}\nproperty list uchar uint vertex_indices\n{label}", faces.len()))
        }
    };
    write!(
        file,
        "ply\nformat binary_little_endian 1.0\ncomment millimetres\nelement vertex {}\n\
         property double x\nproperty double y\nproperty double z\n{on_points}{faces}end_header\n",
        points.len()
    )?;
    let tail = |file: &mut _, label: i32| -> std::io::Result<()> {
        let file: &mut dyn Write = file;
        file.write_all(&label.to_le_bytes())?;
        file.write_all(&color(label))
    };
    for (i, point) in points.iter().enumerate() {
        for x in point {
            file.write_all(&x.to_le_bytes())?;
        }
        if let Pieces::Points = pieces {
            tail(file, labels[i])?;
        }
    }
    if let Pieces::Facets(faces) = pieces {
        for (face, &label) in faces.iter().zip(labels) {
            file.write_all(&[3])?;
            for v in face {
                file.write_all(&v.to_le_bytes())?;
            }
            tail(file, label)?;
        }
    }
    Ok(())
}

fn csv(file: &mut impl Write, points: &[Point], pieces: Pieces, labels: &[i32]) -> Result<(), WriteFault> {
    let mut text = vec![];
    Csv::at_end_of(&mut text, LineEnd::Lf).row(["x", "y", "z", "region"]);
    let mut row = |p: Point, label: i32| {
        let mut csv = Csv::at_end_of(&mut text, LineEnd::Lf);
        csv.number(p[0]).number(p[1]).number(p[2]).number(label).end_row();
        file.write_all(&text)?;
        text.clear();
        Ok::<(), WriteFault>(())
    };
    match pieces {
        Pieces::Points => points.iter().zip(labels).try_for_each(|(&p, &label)| row(p, label))?,
        Pieces::Facets(faces) => faces.iter().zip(labels).try_for_each(|(face, &label)| {
            let [a, b, c] = face.map(|v| points[v as usize]);
            row(times(1.0 / 3.0, plus(a, plus(b, c))), label)
        })?,
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::write::scratch::Folder;
    use crate::{Body, ReadOptions, open};

    const POINTS: [Point; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 1.5]];
    const FACES: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

    fn color(label: i32) -> [u8; 3] {
        [label.max(0) as u8, 7, 9]
    }

    #[test]
    fn a_mesh_is_read_back_with_its_labels() {
        let folder = Folder::new();
        let path = folder.path().join("r.ply");
        regions(&path, &POINTS, Pieces::Facets(&FACES), &[4, -1], color).unwrap().commit().unwrap();
        let Body::Mesh(mesh) = open(&path, &ReadOptions::default()).unwrap().body else { panic!() };
        assert_eq!((&mesh.mesh.positions[..], &mesh.mesh.faces[..]), (&POINTS[..], &FACES[..]));
        let bytes = std::fs::read(&path).unwrap();
        // A row is 1 + 12 + 4 + 3 bytes.
        let rows = &bytes[bytes.len() - 40..];
        assert_eq!(rows[13..20], [4, 0, 0, 0, 4, 7, 9]);
        assert_eq!(rows[33..40], [255, 255, 255, 255, 0, 7, 9]);
    }

    #[test]
    fn points_and_tables() {
        let folder = Folder::new();
        let (ply, csv) = (folder.path().join("p.ply"), folder.path().join("p.csv"));
        let labels = [0, 1, -1, 2];
        regions(&ply, &POINTS, Pieces::Points, &labels, color).unwrap().commit().unwrap();
        assert!(matches!(open(&ply, &ReadOptions::default()).unwrap().body, Body::Points(_)));
        regions(&csv, &POINTS, Pieces::Points, &labels, color).unwrap().commit().unwrap();
        let text = std::fs::read_to_string(&csv).unwrap();
        assert_eq!(text, "x,y,z,region\n0,0,0,0\n1,0,0,1\n0,3,0,-1\n0,0,1.5,2\n");
        regions(&csv, &POINTS, Pieces::Facets(&FACES), &[3, 5], color).unwrap().commit().unwrap();
        assert!(std::fs::read_to_string(&csv).unwrap().ends_with("0,1,0.5,5\n"));
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let folder = Folder::new();
        let write = |name: &str, faces: &[[u32; 3]], labels: &[i32]| {
            regions(&folder.path().join(name), &POINTS, Pieces::Facets(faces), labels, color)
                .unwrap_err()
                .to_string()
        };
        assert!(write("r.stl", &FACES, &[1, 2]).contains(".ply .csv"));
        assert!(write("r.ply", &FACES, &[1]).contains("1 labels"));
        assert!(write("r.ply", &[[0, 1, 9]], &[1]).contains("face 0"));
    }
}
