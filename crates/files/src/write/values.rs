//! Points or vertices, each with named numbers.

use super::Writable;
use super::forms::{VALUE_FORMS, ValueForm};
use crate::csv::{Csv, LineEnd};
use crate::format::values::Values;
#[cfg(feature = "parquet")]
use crate::formats::parquet;
use crate::{
    AtomicFile,
    error::{WriteError, WriteFault},
    formats::{npz, vtp},
    number::push_number,
};
use std::io::{BufWriter, Write};
use std::path::Path;
use trueness_geom::parallel::prelude::*;
use trueness_geom::space::Point;

/// One task makes this many rows into bytes.
const VALUE_ROWS_PER_TASK: usize = 1 << 12;

/// The file, after `write` has written to it through a buffer.
fn buffered(
    file: AtomicFile,
    write: impl FnOnce(&mut BufWriter<AtomicFile>) -> Result<(), WriteFault>,
) -> Result<AtomicFile, WriteFault> {
    let mut file = BufWriter::new(file);
    write(&mut file)?;
    Ok(file.into_inner().map_err(|e| e.into_error())?)
}

/// Writes `points` (millimeters), the facets between them if there are any, and what is known of each point.
///
/// | file | holds |
/// |---|---|
/// | `.ply`, `.vtp` | each number by its name, `reason` as a number (explained in the header of a PLY file), a color, the facets |
/// | `.csv` | a column for each name, empty where there is no number; `reason` as a word |
/// | `.parquet` | a column for each name, null where there is no number; `reason` as a number |
/// | `.npz` | an array for each name, `reason`, the facets |
///
/// The file lies unfinished beside its place until it is committed.
///
/// # Errors
/// Another extension; a facet that names no point; those of the system.
pub fn values<const N: usize>(
    path: &Path,
    points: &[Point],
    faces: &[[u32; 3]],
    values: &Values<N>,
) -> Result<AtomicFile, WriteError> {
    let write = || -> Result<AtomicFile, WriteFault> {
        let form = Writable::Values.form(path, VALUE_FORMS)?;
        let lost = |face: &[u32; 3]| face.iter().any(|v| *v as usize >= points.len());
        if let Some(face) = faces.iter().position(lost) {
            return Err(WriteFault::NoSuchVertex { face });
        }
        let file = AtomicFile::create(path)?;
        Ok(match form {
            ValueForm::Npz => npz::values(file, points, faces, values)?,
            ValueForm::Vtp => vtp::values(file, points, faces, values)?,
            #[cfg(feature = "parquet")]
            ValueForm::Parquet => parquet::values(file, points, values)?,
            ValueForm::Ply => buffered(file, |file| ply(file, points, faces, values))?,
            ValueForm::Csv => buffered(file, |file| csv(file, points, values))?,
        })
    };
    write().map_err(|e| e.in_file(path))
}

/// Writes the rows of all points, some of them at a time.
fn rows(
    file: &mut impl Write,
    count: usize,
    row: impl Fn(usize, &mut Vec<u8>) + Sync,
) -> Result<(), WriteFault> {
    let starts: Vec<usize> = (0..count).step_by(VALUE_ROWS_PER_TASK).collect();
    for group in starts.chunks(4 * rayon::current_num_threads().max(1)) {
        let bytes = |start: &usize| {
            let mut bytes = vec![];
            (*start..count.min(start + VALUE_ROWS_PER_TASK)).for_each(|i| row(i, &mut bytes));
            bytes
        };
        let parts: Vec<Vec<u8>> = group.par_iter().map(bytes).collect();
        for part in parts {
            file.write_all(&part)?;
        }
    }
    Ok(())
}

fn ply<const N: usize>(
    file: &mut impl Write,
    points: &[Point],
    faces: &[[u32; 3]],
    values: &Values<N>,
) -> Result<(), WriteFault> {
    writeln!(file, "ply\nformat binary_little_endian 1.0\ncomment millimetres")?;
    for (code, word) in values.reasons.iter().enumerate().skip(1) {
        writeln!(file, "comment reason {code}: {word}")?;
    }
    writeln!(file, "element vertex {}", points.len())?;
    for name in ["x", "y", "z"].iter().chain(&values.names) {
        writeln!(file, "property double {name}")?;
    }
    for name in ["reason", "red", "green", "blue"] {
        writeln!(file, "property uchar {name}")?;
    }
    if !faces.is_empty() {
        writeln!(file, "element face {}\nproperty list uchar uint vertex_indices", faces.len())?;
    }
    writeln!(file, "end_header")?;
    rows(file, points.len(), |i, bytes| {
        points[i].iter().chain(&(values.of)(i)).for_each(|x| bytes.extend(x.to_le_bytes()));
        bytes.push((values.reason)(i));
        bytes.extend((values.color)(i));
    })?;
    rows(file, faces.len(), |i, bytes| {
        bytes.push(3);
        faces[i].iter().for_each(|v| bytes.extend(v.to_le_bytes()));
    })
}

fn csv<const N: usize>(
    file: &mut impl Write,
    points: &[Point],
    values: &Values<N>,
) -> Result<(), WriteFault> {
    let mut head = vec![];
    Csv::at_end_of(&mut head, LineEnd::Lf)
        .row(["x", "y", "z"].into_iter().chain(values.names).chain(["reason"]));
    file.write_all(&head)?;
    rows(file, points.len(), |i, text| {
        let mut csv = Csv::at_end_of(text, LineEnd::Lf);
        for x in points[i].iter().chain(&(values.of)(i)) {
            let cell = csv.cell();
            if x.is_finite() {
                push_number(cell, *x);
            }
        }
        let word = values.reasons.get(usize::from((values.reason)(i))).copied().unwrap_or_default();
        csv.text(word).end_row();
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::write::scratch::Folder;
    use crate::{Body, ReadOptions, open};

    const POINTS: [Point; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 1.5]];
    const FACES: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

    fn known(write: impl Fn(&Values<2>)) {
        write(&Values {
            names: ["k1", "k2"],
            of: &|i| if i == 1 { [f64::NAN; 2] } else { [0.5 * i as f64, -0.25] },
            reason: &|i| u8::from(i == 1),
            reasons: &["", "boundary"],
            color: &|i| [i as u8, 7, 9],
        });
    }

    #[test]
    fn a_mesh_is_read_back_with_its_numbers() {
        let folder = Folder::new();
        let path = folder.path().join("k.ply");
        known(|v| values(&path, &POINTS, &FACES, v).unwrap().commit().unwrap());
        let Body::Mesh(mesh) = open(&path, &ReadOptions::default()).unwrap().body else { panic!() };
        assert_eq!((&mesh.mesh.positions[..], &mesh.mesh.faces[..]), (&POINTS[..], &FACES[..]));
        let bytes = std::fs::read(&path).unwrap();
        assert!(bytes.windows(27).any(|w| w == b"comment reason 1: boundary\n"));
        // A vertex is 5 numbers and 4 bytes, a facet 13 bytes.
        let last = &bytes[bytes.len() - 26 - 44..bytes.len() - 26];
        assert_eq!(last[24..40], [1.5f64.to_le_bytes(), (-0.25f64).to_le_bytes()].concat());
        assert_eq!(last[40..], [0, 3, 7, 9]);
    }

    #[test]
    fn a_table_has_empty_cells_and_the_reason() {
        let folder = Folder::new();
        let path = folder.path().join("k.csv");
        known(|v| values(&path, &POINTS, &FACES, v).unwrap().commit().unwrap());
        let text = std::fs::read_to_string(&path).unwrap();
        assert_eq!(
            text,
            "x,y,z,k1,k2,reason\n0,0,0,0,-0.25,\n1,0,0,,,boundary\n0,3,0,1,-0.25,\n0,0,1.5,1.5,-0.25,\n"
        );
    }

    /// Arrays of an archive lie as they are: each follows its name and header.
    #[test]
    fn an_archive_has_an_array_of_each_name() {
        let folder = Folder::new();
        let path = folder.path().join("k.npz");
        known(|v| values(&path, &POINTS, &FACES, v).unwrap().commit().unwrap());
        let bytes = std::fs::read(&path).unwrap();
        let array = |name: &str, header: &str| {
            let start = memchr::memmem::find(&bytes, format!("{name}.npy").as_bytes()).unwrap();
            let start = start + memchr::memmem::find(&bytes[start..], b"\x93NUMPY").unwrap();
            assert!(String::from_utf8_lossy(&bytes[start..start + 128]).contains(header), "{name}");
            &bytes[start + 128..]
        };
        let number = |of: &[u8], k: usize| f64::from_le_bytes(of[8 * k..8 * k + 8].try_into().unwrap());
        let k1 = array("k1", "'<f8', 'fortran_order': False, 'shape': (4,)");
        assert!(number(k1, 1).is_nan() && (number(k1, 2), number(k1, 3)) == (1.0, 1.5));
        assert_eq!(number(array("points", "(4, 3)"), 7), 3.0);
        assert_eq!(array("reason", "'|u1'")[..4], [0, 1, 0, 0]);
        assert_eq!(
            array("faces", "'<u4', 'fortran_order': False, 'shape': (2, 3)")[..8],
            [0, 0, 0, 0, 1, 0, 0, 0]
        );
    }

    /// Offsets lead to arrays, each behind its length.
    #[test]
    fn a_vtk_file_has_arrays_where_it_says() {
        let folder = Folder::new();
        for faces in [&FACES[..], &[]] {
            let path = folder.path().join("k.vtp");
            known(|v| values(&path, &POINTS, faces, v).unwrap().commit().unwrap());
            let bytes = std::fs::read(&path).unwrap();
            let data = 4096;
            assert_eq!(bytes[data - 1], b'_');
            let xml = String::from_utf8_lossy(&bytes[..data]).into_owned();
            let array = |name: &str| {
                let rest = xml.split(&format!("Name=\"{name}\"")).nth(1).unwrap();
                let offset: usize =
                    rest.split("offset=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
                let at = data + offset;
                let length = u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap()) as usize;
                &bytes[at + 8..at + 8 + length]
            };
            assert_eq!(
                (array("k1").len(), array("Points").len(), array("reason")),
                (32, 96, &[0, 1, 0, 0][..])
            );
            assert_eq!(array("k2")[24..], (-0.25f64).to_le_bytes());
            assert_eq!(array("colour")[9..], [3, 7, 9]);
            let corners = if faces.is_empty() { 4 } else { 6 };
            assert_eq!(array("connectivity").len(), 8 * corners);
            assert_eq!(array("offsets")[..8], (if faces.is_empty() { 4u64 } else { 3 }).to_le_bytes());
            assert!(bytes.ends_with(b"</VTKFile>\n"));
        }
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let folder = Folder::new();
        known(|v| {
            let write = |name: &str, faces: &[[u32; 3]]| {
                values(&folder.path().join(name), &POINTS, faces, v).unwrap_err().to_string()
            };
            assert!(write("k.stl", &FACES).contains(".ply .csv .npz .vtp"));
            assert!(write("k.ply", &[[0, 1, 9]]).contains("face 0"));
        });
    }
}
