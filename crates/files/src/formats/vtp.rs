//! VTP: points or a mesh for VTK, as XML with raw bytes appended.

use crate::{
    AtomicFile,
    error::WriteFault,
    format::{
        Format, Head,
        columns::Columns,
        corners::corner_positions,
        loss::Loss,
        sink::{Block, Layout, PointsSink},
        values::Values,
    },
    xml::Xml,
};
use std::io::{self, Seek, SeekFrom, Write};
use trueness_geom::{mesh::Mesh, space::Point};

/// XML PolyData of VTK.
pub(crate) const VTP: Format = Format {
    name: "vtp",
    known_as: &["VTP"],
    extensions: &[],
    written_as: &["vtp"],
    manual: include_str!("vtp.md"),
    holds: &[],
    columns: false,
    sniff: |_: &Head| false,
    read: None,
    model: None,
    points: Some(begin),
    mesh: Some(mesh),
};

/// Bytes reserved for the XML part of a file of points; its counts are known only at the end.
const POINTS_XML_BYTES: usize = 2048;

/// Arrays in the order of their bytes: name, type, components, bytes.
type Array<'a> = (&'a str, &'static str, u32, u64);

/// The XML part: `cells` are `Verts` or `Polys`, of which there are `cell_count`.
fn header(points: u64, cells: &str, cell_count: u64, data: &[Array], lists: &[Array]) -> Vec<u8> {
    sized_header(POINTS_XML_BYTES, points, cells, cell_count, data, lists)
}

/// The same in `size` bytes.
fn sized_header(
    size: usize,
    points: u64,
    cells: &str,
    cell_count: u64,
    data: &[Array],
    lists: &[Array],
) -> Vec<u8> {
    let mut xml = begun();
    let mut offset = 0;
    let mut array = |xml: &mut Xml, (name, kind, components, bytes): &Array| {
        let attributes = [
            ("type", (*kind).to_string()),
            ("Name", (*name).to_string()),
            ("NumberOfComponents", components.to_string()),
            ("format", "appended".into()),
            ("offset", offset.to_string()),
        ];
        xml.empty("DataArray", &attributes);
        offset += 8 + bytes;
    };
    let number_of_cells = format!("NumberOf{cells}");
    let counts = [("NumberOfPoints", points.to_string()), (&*number_of_cells, cell_count.to_string())];
    xml.element("PolyData", &[], |xml| {
        xml.element("Piece", &counts, |xml| {
            xml.element("Points", &[], |xml| array(xml, &("Points", "Float64", 3, 24 * points)));
            xml.element("PointData", &[], |xml| data.iter().for_each(|a| array(xml, a)));
            xml.element(cells, &[], |xml| lists.iter().for_each(|a| array(xml, a)));
        });
    });
    start_of_data(&mut xml);
    let mut bytes = xml.take().into_bytes();
    bytes.resize(bytes.len().max(size - 1), b' ');
    bytes.push(b'_');
    bytes
}

/// The document with its outermost element begun.
fn begun() -> Xml {
    let mut xml = Xml::new(0);
    xml.declaration(&[]);
    let root = [
        ("type", "PolyData".into()),
        ("version", "1.0".into()),
        ("byte_order", "LittleEndian".into()),
        ("header_type", "UInt64".into()),
    ];
    xml.start("VTKFile", &root);
    xml
}

fn start_of_data(xml: &mut Xml) {
    xml.start("AppendedData", &[("encoding", "raw".into())]);
}

/// The text after the data.
fn end(file: &mut AtomicFile) -> io::Result<()> {
    let mut xml = begun();
    start_of_data(&mut xml);
    xml.take();
    xml.end();
    xml.end();
    write!(file, "\n{}", xml.take())
}

fn begin(mut file: AtomicFile, layout: Layout, _: &str) -> Result<Box<dyn PointsSink>, WriteFault> {
    let columns = Columns::beside(&file, layout);
    // Header and length of the positions are written again when the points are counted.
    file.write_all(&[b' '; POINTS_XML_BYTES + 8])?;
    Ok(Box::new(Points { file, columns }))
}

struct Points {
    file: AtomicFile,
    columns: Columns,
}

impl PointsSink for Points {
    fn write(&mut self, block: &Block) -> Result<(), WriteFault> {
        self.columns.write(block, |bytes| self.file.write_all(bytes))
    }

    fn finish(mut self: Box<Self>) -> Result<AtomicFile, WriteFault> {
        let Points { file, columns } = &mut *self;
        let Columns { layout, count, deviation, excluded, color } = columns;
        let count = *count;
        let mut data: Vec<Array> = vec![];
        for (there, name, kind, components, spool) in [
            (layout.deviation, "deviation", "Float64", 1, deviation),
            (layout.deviation, "excluded", "UInt8", 1, excluded),
            (layout.color, "colour", "UInt8", 3, color),
        ] {
            if there {
                data.push((name, kind, components, spool.len()));
                file.write_all(&spool.len().to_le_bytes())?;
                spool.play(|bytes| file.write_all(bytes))?;
            }
        }
        // One cell of all points: programs show points only where cells name them.
        let cells = u64::from(count > 0);
        numbers(file, count, |i| i)?;
        numbers(file, cells, |_| count)?;
        end(file)?;
        let lists = [("connectivity", "Int64", 1, 8 * count), ("offsets", "Int64", 1, 8 * cells)];
        file.seek(SeekFrom::Start(0))?;
        file.write_all(&header(count, "Verts", cells, &data, &lists))?;
        file.write_all(&(24 * count).to_le_bytes())?;
        Ok(self.file)
    }
}

/// An array of `count` 64-bit numbers.
fn numbers(file: &mut AtomicFile, count: u64, number: impl Fn(u64) -> u64) -> io::Result<()> {
    file.write_all(&(8 * count).to_le_bytes())?;
    (0..count).try_for_each(|i| file.write_all(&number(i).to_le_bytes()))
}

fn mesh(file: &mut AtomicFile, mesh: &Mesh) -> Result<Loss, WriteFault> {
    let (points, faces) = (mesh.positions.len() as u64, mesh.faces.len() as u64);
    let lists = [("connectivity", "Int64", 1, 24 * faces), ("offsets", "Int64", 1, 8 * faces)];
    file.write_all(&header(points, "Polys", faces, &[], &lists))?;
    file.write_all(&(24 * points).to_le_bytes())?;
    for x in mesh.positions.as_flattened() {
        file.write_all(&x.to_le_bytes())?;
    }
    for (i, face) in mesh.faces.iter().enumerate() {
        corner_positions(mesh, i, face)?;
    }
    let corners = mesh.faces.as_flattened();
    numbers(file, 3 * faces, |i| u64::from(corners[i as usize]))?;
    numbers(file, faces, |i| 3 * (i + 1))?;
    end(file)?;
    Ok(Loss::default())
}

/// Bytes reserved for the XML part of a file with named numbers, of which it holds some twenty.
const VALUES_XML_BYTES: usize = 4096;

/// Writes points, an array of each of their numbers, and their facets; without facets one cell of all points.
pub(crate) fn values<const N: usize>(
    mut file: AtomicFile,
    points: &[Point],
    faces: &[[u32; 3]],
    values: &Values<N>,
) -> Result<AtomicFile, WriteFault> {
    let (count, face_count) = (points.len() as u64, faces.len() as u64);
    let mut data: Vec<Array> = values.names.iter().map(|name| (*name, "Float64", 1, 8 * count)).collect();
    data.extend([("reason", "UInt8", 1, count), ("colour", "UInt8", 3, 3 * count)]);
    let (cells, cell_count, corners) = match faces.is_empty() {
        true => ("Verts", u64::from(count > 0), count),
        false => ("Polys", face_count, 3 * face_count),
    };
    let lists = [("connectivity", "Int64", 1, 8 * corners), ("offsets", "Int64", 1, 8 * cell_count)];
    file.write_all(&sized_header(VALUES_XML_BYTES, count, cells, cell_count, &data, &lists))?;
    let mut add = |width: u64, row: &dyn Fn(usize, &mut Vec<u8>)| -> io::Result<()> {
        file.write_all(&(width * count).to_le_bytes())?;
        for start in (0..points.len()).step_by(1 << 14) {
            let mut bytes = vec![];
            (start..points.len().min(start + (1 << 14))).for_each(|i| row(i, &mut bytes));
            file.write_all(&bytes)?;
        }
        Ok(())
    };
    add(24, &|i, bytes| points[i].iter().for_each(|x| bytes.extend(x.to_le_bytes())))?;
    for k in 0..N {
        add(8, &|i, bytes| bytes.extend((values.of)(i)[k].to_le_bytes()))?;
    }
    add(1, &|i, bytes| bytes.push((values.reason)(i)))?;
    add(3, &|i, bytes| bytes.extend((values.color)(i)))?;
    let flat = faces.as_flattened();
    if faces.is_empty() {
        numbers(&mut file, count, |i| i)?;
        numbers(&mut file, cell_count, |_| count)?;
    } else {
        numbers(&mut file, corners, |i| u64::from(flat[i as usize]))?;
        numbers(&mut file, cell_count, |i| 3 * (i + 1))?;
    }
    end(&mut file)?;
    Ok(file)
}
