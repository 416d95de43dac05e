//! `trueness section`: the lines, arcs and curves of sections, and where they join.

mod table;
mod write;

use crate::command::Run;
use crate::exit::{Outcome, Usage};
use crate::options::{Common, DocumentArgs, PointInputArgs};
use crate::progress::Stage;
use crate::read::{self, Opened};
use crate::run_files::RunFiles;
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use trueness_files::Body;
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Progress;
use trueness_geom::section::{self, Continuity, Contour, Options, Plane, PlaneFrame, SectionError};
use trueness_geom::space::Point;
use trueness_inspect::results::Role;
use trueness_inspect::results::section::{FrameRecord, SectionDocument};

/// The lines, arcs and curves of a section, and the exact places where they join
///
/// Of points in the order in which they follow each other along a contour, or of a mesh cut by a plane. Finds number and
/// kinds of the segments, refines all together and tells every join with its uncertainty.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  trueness section profile.txt
  trueness section profile.csv --noise 0.003 --dxf profile.dxf --json profile.json
  trueness section part.stl --plane 0,0,1,12.5 --svg section.svg")]
pub struct SectionArgs {
    /// Points in order, of two or three columns, or a mesh; `-` reads stdin
    input: PathBuf,
    /// Cut the mesh by the plane of all points with nx·x + ny·y + nz·z = d
    #[arg(long, value_name = "NX,NY,NZ,D", value_parser = plane, allow_hyphen_values = true)]
    plane: Option<Plane>,
    /// Standard deviation of the points across the contour, mm [default: found from the data]
    #[arg(long, value_name = "MM")]
    noise: Option<f64>,
    /// Continuity of all joins [default: told from the data]
    #[arg(long, value_enum, value_name = "G")]
    continuity: Option<ContinuityArg>,
    /// The contour is closed [default: told from the gap between its ends]
    #[arg(long, conflicts_with = "open")]
    closed: bool,
    /// The contour is open
    #[arg(long)]
    open: bool,
    /// Confidence of the intervals, percent
    #[arg(long, value_name = "PERCENT", default_value = "95")]
    level: f64,
    #[command(flatten)]
    file: PointInputArgs,
    #[command(flatten)]
    document: DocumentArgs,
    #[command(flatten)]
    drawings: write::Drawings,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ContinuityArg {
    /// Corners everywhere.
    G0,
    /// Common tangents everywhere.
    G1,
    /// Common tangents, and common curvatures at the ends of splines.
    G2,
}

fn plane(text: &str) -> Result<Plane, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|word| word.trim().parse::<f64>()).collect();
    match numbers.as_deref() {
        Ok([x, y, z, offset]) if [x, y, z, offset].iter().all(|n| n.is_finite()) => {
            let plane = Plane { normal: [*x, *y, *z], offset: *offset };
            plane.frame().map(|_| plane).ok_or_else(|| "the normal has no direction".into())
        }
        _ => Err("give four numbers: the normal and the offset, e.g. 0,0,1,12.5".into()),
    }
}

impl SectionArgs {
    fn options(&self) -> Options {
        Options {
            noise: self.noise,
            continuity: self.continuity.map(|c| match c {
                ContinuityArg::G0 => Continuity::G0,
                ContinuityArg::G1 => Continuity::G1,
                ContinuityArg::G2 => Continuity::G2,
            }),
            closed: (self.closed || self.open).then_some(self.closed),
            level: self.level / 100.0,
        }
    }
}

/// Rows of points in a plane of space.
struct Rows {
    rows: Vec<(Vec<[f64; 2]>, Option<bool>)>,
    frame: FrameRecord,
}

impl Run for SectionArgs {
    fn files(&self) -> anyhow::Result<RunFiles> {
        Ok(self.drawings.files(RunFiles::of([&self.input]).document(self.document.json.as_ref())))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        run(self, common)
    }
}

fn run(args: &SectionArgs, common: &Common) -> anyhow::Result<Outcome> {
    let options = args.options();
    let Opened { mut record, body, planar, .. } =
        read::open(&args.input, Role::Measured, &args.file.reading())?;
    let shown = args.input.display();
    let stage = Stage::new(common.progress, "finding segments", "points", None);
    let rows = match body {
        Body::Mesh(source) => {
            let Some(plane) = args.plane else {
                return Err(Usage(format!("{shown}: it is a mesh; say where to cut it with --plane")).into());
            };
            cut(&source.mesh, &plane, &stage).map_err(|e| e.unless_cancelled(&shown))?
        }
        Body::Points(source) => {
            let points = read::all_points(source)?;
            read::describe(&mut record, &points);
            if args.plane.is_some() {
                return Err(Usage(format!("{shown}: it holds points in order; --plane cuts meshes")).into());
            }
            flattened(&points, planar)
        }
    };
    read::hash(&mut record, &args.input)?;
    let contours = rows
        .rows
        .iter()
        .map(|(row, closed)| {
            let own = Options { closed: options.closed.or(*closed), ..options };
            section::contour(row, &own, &stage)
        })
        .collect::<Result<Vec<Contour>, SectionError>>();
    drop(stage);
    let contours = contours.map_err(|e| match e {
        SectionError::Cancelled(e) => e.into(),
        e @ SectionError::WrongOption { .. } => Usage(e.to_string()).into(),
        e => anyhow::anyhow!("{shown}: {e}"),
    })?;
    let document = SectionDocument::new(&contours, rows.frame, vec![record], &options);
    args.drawings.write(&contours, &rows.rows)?;
    args.document.write(&document)?;
    args.document.table(|| table::table(&document))?;
    Ok(Outcome::Conforming)
}

/// Why a mesh has no section.
enum CutError {
    Cancelled(trueness_geom::progress::Cancelled),
    Nothing,
}

impl CutError {
    fn unless_cancelled(self, shown: &std::path::Display) -> anyhow::Error {
        match self {
            CutError::Cancelled(e) => e.into(),
            CutError::Nothing => anyhow::anyhow!("{shown}: the plane does not cut it; choose another offset"),
        }
    }
}

fn cut(mesh: &Mesh, plane: &Plane, progress: &dyn Progress) -> Result<Rows, CutError> {
    let chains = section::cut(mesh, plane, progress).map_err(CutError::Cancelled)?;
    let frame = plane.frame().filter(|_| !chains.is_empty()).ok_or(CutError::Nothing)?;
    let flat =
        |chain: &section::Chain| (chain.points.iter().map(|p| frame.flat(*p)).collect(), Some(chain.closed));
    Ok(Rows { rows: chains.iter().map(flat).collect(), frame: described(&frame, 0.0) })
}

/// A row in space in the plane nearest to it; a row of two columns as it is.
fn flattened(points: &[Point], planar: bool) -> Rows {
    let found = if planar { None } else { PlaneFrame::through(points) };
    let own = PlaneFrame { origin: [0.0; 3], x: [1.0, 0.0, 0.0], y: [0.0, 1.0, 0.0] };
    let flat = |frame: &PlaneFrame| points.iter().map(|p| frame.flat(*p)).collect();
    match found {
        Some((frame, off)) => Rows { rows: vec![(flat(&frame), None)], frame: described(&frame, off) },
        None => Rows { rows: vec![(flat(&own), None)], frame: described(&own, 0.0) },
    }
}

fn described(frame: &PlaneFrame, flatness: f64) -> FrameRecord {
    FrameRecord { origin: frame.origin, x: frame.x, y: frame.y, flatness }
}
