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
use trueness_geom::section::{self, Continuity, Contour, Options, PlaneFrame, SectionError};
use trueness_geom::space::Point;
use trueness_inspect::results::Role;
use trueness_inspect::results::section::{FrameRecord, SectionDocument};

/// The lines, arcs and curves of a section, and the exact places where they join
///
/// Of points in the order in which they follow each other along a contour. Finds number and kinds of the segments, refines
/// all together and tells every join with its uncertainty.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  trueness section profile.txt
  trueness section profile.csv --noise 0.003 --dxf profile.dxf --json profile.json")]
pub struct SectionArgs {
    /// Points in order, of two or three columns; `-` reads stdin
    input: PathBuf,
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
        Body::Mesh(_) => {
            return Err(Usage(format!(
                "{shown}: it is a mesh; give the points of its section in their order, two or three columns of numbers"
            ))
            .into());
        }
        Body::Points(source) => {
            let points = read::all_points(source)?;
            read::describe(&mut record, &points);
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
