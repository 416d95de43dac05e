//! Reading a file of whatever format.

use crate::content::cad_file::{CadContent, CadFile};
use crate::{
    Body, Column, Columns, Fault, Input, Provenance, ReadError, SourceMesh, Unit, UnitFrom, Warning,
    assemble, detect,
    error::Located,
    format::{Content, ReadOptions, Weld},
    source::{FileSources, Source, Sources},
};
use std::path::Path;
use trueness_geom::{
    cloud::{PointStream, Whole},
    space::{Aabb, Point},
};

/// Reads a file, `-` being standard input: a mesh as a whole, points as a stream.
///
/// The format is told by the content and, where that says nothing, by the extension; `.gz` is unpacked on the way.
/// A file with faces is a mesh, one with vertices alone is points.
///
/// Errors name file, line or byte, the expected content and a remedy. Errors behind the first block of points come
/// from the stream. Cost: meshes linear in the size of the file, several times that in memory; points next to
/// nothing until the stream is read.
pub fn open(path: &Path, options: &ReadOptions) -> Result<Input, ReadError> {
    open_from(&FileSources, path, options)
}

/// As [`open`], for the bytes of a name in `sources`. The same bytes give the same result wherever they come from.
pub fn open_from(sources: &dyn Sources, name: &Path, options: &ReadOptions) -> Result<Input, ReadError> {
    let file = sources.shown(name);
    let source = sources.bytes(name).map_err(Into::into).and_then(Source::of);
    source.and_then(|source| read(source, name, &file, options)).map_err(|fault| fault.in_file(&file))
}

/// The normals of the points of a file, in the order of the points and neither scaled nor normalized. A PLY file has them as properties
/// `nx`, `ny`, `nz`; a table as columns of these names, or in the columns that `columns` names. In a file with the extension `.xyzn` and
/// no names they are the columns four to six.
///
/// `options` are those with which the points were read; their units and columns do not count.
///
/// Errors: those of [`open`]; a file without normals, or of another format.
pub fn open_normals(
    path: &Path,
    columns: Option<&Columns>,
    options: &ReadOptions,
) -> Result<crate::PointSource, ReadError> {
    open_normals_from(&FileSources, path, columns, options)
}

/// As [`open_normals`], for the bytes of a name in `sources`.
pub fn open_normals_from(
    sources: &dyn Sources,
    name: &Path,
    columns: Option<&Columns>,
    options: &ReadOptions,
) -> Result<crate::PointSource, ReadError> {
    let named = Columns(["nx", "ny", "nz"].map(|n| Column::Name(n.into())).to_vec());
    let of = |columns: &Columns| {
        let columns = Some(columns.clone());
        let options = ReadOptions {
            normals: true,
            columns,
            units: Some(Unit::default()),
            unit_else: None,
            ..options.clone()
        };
        open_from(sources, name, &options).map(|input| input.body.into_points())
    };
    match columns {
        Some(columns) => of(columns),
        None => of(&named).or_else(|e| {
            let xyzn = name.extension().is_some_and(|e| e.eq_ignore_ascii_case("xyzn"));
            if xyzn { of(&Columns([4, 5, 6].map(Column::Number).to_vec())) } else { Err(e) }
        }),
    }
}

fn read(mut source: Source, path: &Path, file: &str, options: &ReadOptions) -> Result<Input, Located> {
    let format = match options.format {
        Some(format) => format,
        None => detect::format(&mut source, path)?,
    };
    let Some(reader) = format.read else { return Err(Fault::NotRead(format.name).into()) };
    if options.normals && !format.has_columns() && format.name != "ply" {
        return Err(Fault::NoNormals(format.name).into());
    }
    if options.columns.is_some() && !format.has_columns() && !options.normals {
        return Err(Fault::NoTable(format.name).into());
    }
    let (bytes, gzip) = (source.bytes, source.gzip);
    let mut parsed = reader(source, options)?;
    let is_cad = matches!(parsed.content, Content::Splines(_) | Content::Drawing(_));
    let (unit, unit_from) = match (options.units, parsed.unit) {
        // A model may have units that are none of these; its file has its own.
        _ if let Content::Cad(content) = &parsed.content => (content.unit.nearest(), content.unit.from),
        (asked, Some(said)) if is_cad => {
            if let Some(asked) = asked.filter(|asked| *asked != said) {
                parsed.warnings.push(Warning::UnitKept { said, asked });
            }
            (said, UnitFrom::Header)
        }
        (Some(asked), said) => {
            // A table tells it itself.
            if let Some(header) = said.filter(|said| *said != asked && parsed.table.is_none()) {
                parsed.warnings.push(Warning::UnitOverruled { header, asked });
            }
            (asked, UnitFrom::Option)
        }
        (None, Some(said)) => (said, UnitFrom::Header),
        (None, None) => match options.unit_else {
            Some(unit) => (unit, UnitFrom::Option),
            None => (Unit::default(), UnitFrom::Assumed),
        },
    };
    let body = match parsed.content {
        Content::Mesh(mut mesh) => {
            unit.apply(&mut mesh.mesh.positions);
            if let Weld::Within(distance) = options.weld {
                let size = Aabb::of(&mesh.mesh.positions).diagonal();
                // A mesh of one place has nothing that could be lost.
                if size > 0.0 && distance >= size {
                    return Err(Fault::WeldTooFar { distance, size }.into());
                }
                mesh.mesh = assemble::within(&mesh.mesh, distance, &mut parsed.warnings)?;
            }
            Body::Mesh(mesh)
        }
        Content::Splines(model) => Body::Splines(model),
        Content::Cad(content) => {
            let CadContent { model, unit, warnings, splines } = *content;
            let format = parsed.variant;
            Body::Cad(Box::new(CadFile { model, format, bytes, gzip, unit, warnings, splines }))
        }
        Content::Drawing(drawing) => Body::Drawing(drawing),
        Content::Points(inner) => Body::Points(Box::new(Named { inner, file: file.into(), unit })),
    };
    let provenance = Provenance {
        path: path.display().to_string(),
        format: parsed.variant,
        bytes,
        gzip,
        unit_assumed: unit,
        unit_from,
        planar: parsed.planar,
        table: parsed.table,
    };
    Ok(Input { provenance, body, warnings: parsed.warnings })
}

/// A stream in millimeters whose errors name the file.
struct Named {
    inner: Box<dyn PointStream<Error = Located> + Send>,
    file: String,
    unit: Unit,
}

impl PointStream for Named {
    type Error = ReadError;
    fn expected(&self) -> Option<u64> {
        self.inner.expected()
    }
    fn next_block(&mut self, block: &mut Vec<Point>) -> Result<(), ReadError> {
        self.inner.next_block(block).map_err(|e| e.in_file(&self.file))?;
        self.unit.apply(block);
        Ok(())
    }
    fn remarks(&self) -> Vec<String> {
        self.inner.remarks()
    }
}

impl Body {
    /// The points: those of a cloud, or the vertices of a mesh in their order; none of splines and drawings.
    pub fn into_points(self) -> crate::PointSource {
        match self {
            Body::Points(points) => points,
            Body::Mesh(SourceMesh { mesh, .. }) => Box::new(Whole::new(mesh.positions)),
            Body::Splines(_) | Body::Cad(_) | Body::Drawing(_) => Box::new(Whole::new(vec![])),
        }
    }
}
