//! `trueness section`: the lines, arcs and curves of sections, and where they join.

mod faced;
mod found;
mod layers;
mod method;
mod nominal;
mod planes;
mod table;
mod write;

use crate::command::Run;
use crate::exit::{self, Outcome, Usage};
use crate::noise::NoiseArgs;
use crate::options::{Common, DocumentArgs, PointInputArgs};
use crate::progress::{STEPS, Stage};
use crate::read::{self, Body, Opened};
use crate::report::ReportArgs;
use crate::run_files::RunFiles;
use clap::{Args, ValueEnum};
use found::{Found, described};
use std::path::PathBuf;
use trueness_document::section::SectionDocument;
use trueness_document::{InputRecord, Role, Verdict};
use trueness_geom::noise::{self, Noise};
use trueness_geom::section::{self, Continuity, Options, PlaneFrame, SectionError};
use trueness_geom::space::{Point, minus, norm};
use trueness_measure::section::Section;
use trueness_measure::{NoiseOrReason, noise_or_reason};
use trueness_report::{ViewObject, flat};

/// The lines, arcs and curves of a section, and the exact places where they join
///
/// Of points in the order in which they follow each other along a contour, or where planes cut a mesh or a cloud. Finds
/// number and kinds of the segments, refines all together and tells every join with its uncertainty.
#[derive(Args, Debug)]
#[command(after_help = exit::help("out of tolerance or undecided, segments do not run along their points and tell nothing of the part, a contour is doubtful, or a slab holds an area and no contours; files are written all the same", "\
Examples:
  trueness section profile.txt
  trueness section profile.csv --noise 0.003 --dxf profile.dxf --json profile.json
  trueness section profile.csv --html report.html
  trueness section blade.csv --airfoil
  trueness section profile.csv --tidy
  trueness section profile.csv --nominal profile.dxf --fit free --tolerance 0.05
  trueness section part.stl --plane 0,0,1,12.5 --dxf at-12.5.dxf
  trueness section part.stl --stack 0,0,1,0,40,5
  trueness section scan.stl --plane 0,0,1,12.5 --nominal part.stl
  trueness section cloud.ply --plane 1,0,0,30 --thickness 0.4"))]
pub struct SectionArgs {
    /// Points in order, of two or three columns, or with planes a mesh or a cloud; `-` reads stdin
    input: PathBuf,
    #[command(flatten)]
    planes: planes::PlaneArgs,
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
    #[arg(long, value_name = "PERCENT", default_value = "95", value_parser = percent)]
    level: f64,
    /// Measure each contour as an airfoil or blade: chords, camber line, greatest thickness, radii of its edges; with --nominal
    /// also twist and offset
    #[arg(long)]
    airfoil: bool,
    /// Stacking point of the airfoils in the nominal's coordinates of the plane, mm [default: the centroid of the nominal's profile]
    #[arg(long, value_name = "X,Y", requires = "airfoil", allow_hyphen_values = true, value_parser = place)]
    stacking: Option<[f64; 2]>,
    /// Offer what a drawing would have, where the points allow it: parallel lines, right angles, tangents, equal radii, common
    /// centers, whole numbers; the contour stays as it is found
    #[arg(long)]
    tidy: bool,
    #[command(flatten)]
    shared: NoiseArgs,
    #[command(flatten)]
    method: method::MethodArgs,
    #[command(flatten)]
    nominal: nominal::NominalArgs,
    #[command(flatten)]
    file: PointInputArgs,
    #[command(flatten)]
    document: DocumentArgs,
    #[command(flatten)]
    drawings: write::Drawings,
    #[command(flatten)]
    report: ReportArgs,
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
    /// Refuses a noise that no points of this file can have.
    fn check_noise(&self, record: &InputRecord) -> Result<(), Usage> {
        let size = record.bounds.as_ref().map(|b| norm(minus(b.max, b.min)));
        match self.noise.zip(size) {
            Some((noise, size)) if noise > size => Err(Usage(format!(
                "--noise {noise:?}: all of {} lies within {size:.4} mm; give the standard deviation of its points, mm",
                record.path
            ))),
            _ => Ok(()),
        }
    }

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
            ..Options::default()
        }
    }
}

/// A level of confidence: a share of 1 written by mistake is refused, since it would make all intervals tiny.
fn percent(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(level) if level > 1.0 && level < 100.0 => Ok(level),
        Ok(level) if level > 0.0 && level <= 1.0 => {
            Err(format!("it is in percent: write {} for a share of {level}", 100.0 * level))
        }
        _ => Err("a number of percent between 1 and 100, such as 95".into()),
    }
}

/// A place in the plane.
fn place(text: &str) -> Result<[f64; 2], String> {
    let numbers =
        text.split_once(',').and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]));
    let finite = numbers.filter(|p: &[f64; 2]| p.iter().all(|x| x.is_finite()));
    finite.ok_or_else(|| format!("‘{text}’ is no place; write two numbers of mm, such as 12.5,-3"))
}

impl Run for SectionArgs {
    fn files(&self) -> anyhow::Result<RunFiles> {
        let inputs = std::iter::once(&self.input).chain(&self.nominal.nominal);
        let files = RunFiles::of(inputs).document(self.document.json.as_ref());
        Ok(self.drawings.files(files.report(self.report.html.as_ref())))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        run(self, common)
    }
}

/// Lets the facets of a mesh look outwards; the noise of its vertices, as it is and as it is told, or why it is not. Of points nothing.
fn as_it_is(
    args: &SectionArgs,
    common: &Common,
    body: &mut Body,
    record: &mut InputRecord,
) -> anyhow::Result<(Option<Noise>, Option<NoiseOrReason>)> {
    let shown = args.input.display().to_string();
    let Body::Mesh(source) = body else {
        args.shared.only_for_meshes(&shown)?;
        return Ok((None, None));
    };
    args.planes.fit_a_mesh(&shown)?;
    args.method.only_for_rows()?;
    let stage = Stage::new(common.progress, "which way facets look", STEPS, None);
    source.mesh = faced::faced(&source.mesh, record, &stage)?;
    drop(stage);
    let mut own = None;
    let find = |stage: &Stage| {
        let found = noise::mesh(&source.mesh, common.seed, stage);
        own = found.as_ref().ok().copied();
        noise_or_reason(found.and_then(Noise::even))
    };
    let told = args.shared.found(common.progress, find)?;
    Ok((own.or(told.as_ref().ok().copied()), Some(told)))
}

fn run(args: &SectionArgs, common: &Common) -> anyhow::Result<Outcome> {
    let options = args.options();
    args.nominal.rule()?;
    let Opened { mut record, mut body, planar, .. } =
        read::open(&args.input, Role::Measured, &args.file.reading())?;
    let shown = args.input.display();
    let planes = args.planes.planes()?;
    let (known, noise) = as_it_is(args, common, &mut body, &mut record)?;
    let stage = Stage::new(common.progress, "finding segments", STEPS, None);
    let mut methods = None;
    let found = match body {
        Body::Mesh(source) => {
            args.check_noise(&record)?;
            planes::mesh(&source.mesh, known, &planes, &options, &stage)
        }
        Body::Points(source) => {
            let points = read::all_points(&args.input, source)?;
            read::describe(&mut record, &points);
            args.check_noise(&record)?;
            match planes.is_empty() {
                true => {
                    args.planes.fit_a_row()?;
                    row(&points, planar, &options, &stage).and_then(|found| {
                        let (found, table) = args.method.apply(found, &options, &stage)?;
                        methods = table;
                        Ok(found)
                    })
                }
                false => {
                    args.method.only_for_rows()?;
                    let slab = args.planes.slab(&shown.to_string(), planar)?;
                    planes::cloud(&points, &planes, &slab, &options, &stage)
                }
            }
        }
    };
    read::hash(&mut record, &args.input)?;
    let (sections, rows) = found.map_err(|e| match e {
        SectionError::Cancelled(e) => e.into(),
        e @ SectionError::WrongOption { .. } => Usage(e.to_string()).into(),
        e => anyhow::anyhow!("{shown}: {e}"),
    })?;
    if !planes.is_empty() && rows.is_empty() {
        anyhow::bail!("{shown}: {}", planes::nothing_met(&planes, &sections, &record));
    }
    let mut inputs = vec![record];
    let found = (sections, rows);
    let nominal = args.nominal.compare(&args.file, &found, &planes, &options, &stage)?;
    let (sections, rows) = found;
    let airfoils =
        args.airfoil.then(|| trueness_measure::section::airfoils(&sections, &rows, &stage)).transpose()?;
    let nominal = nominal.map(|(nominal, file)| {
        inputs.push(file);
        nominal
    });
    let mut document = trueness_measure::section::document(&sections, inputs, &options);
    trueness_measure::section::tell_noise(&mut document, noise.as_ref());
    (document.nominal, document.airfoils) = (nominal, airfoils);
    for found in document.airfoils.iter().flatten() {
        if let Some(contour) = document.contours.get_mut(found.contour as usize) {
            contour.doubts.extend(found.doubt());
        }
    }
    document = trueness_measure::section::with_blades(document, args.stacking, &stage)?;
    if args.tidy {
        document = trueness_measure::section::with_offers(document, &sections, &rows);
    }
    args.planes.tell_raised_gap(&mut document.planes);
    if let Some((chosen, interval, table)) = methods {
        document = trueness_measure::section::with_methods(document, chosen, interval, &table);
    }
    drop(stage);
    report(args, common, &document, &rows)?;
    args.drawings.write(&sections, &rows, document.nominal.as_ref())?;
    args.document.write(&document)?;
    args.document.table(|| table::table(&document))?;
    Ok(outcome(&document, &sections))
}

/// Whether all contours are beyond doubt, and the profile keeps its tolerance.
fn outcome(document: &SectionDocument, sections: &[Section]) -> Outcome {
    let doubtful = document.contours.iter().any(|c| !c.astray.is_empty() || !c.doubts.is_empty())
        || sections.iter().any(|section| section.fills_area);
    let judged = document.nominal.as_ref().and_then(|nominal| nominal.verdict);
    let fails = judged.is_some_and(|verdict| verdict != Verdict::Pass);
    if doubtful || fails { Outcome::NotConforming } else { Outcome::Conforming }
}

/// The report, with the points of each contour.
fn report(
    args: &SectionArgs,
    common: &Common,
    document: &SectionDocument,
    rows: &[Vec<[f64; 2]>],
) -> anyhow::Result<()> {
    if args.report.html.is_none() {
        return Ok(());
    }
    let places: Vec<Vec<Point>> = rows.iter().map(|row| flat(row)).collect();
    let objects: Vec<ViewObject> = places.iter().map(|p| ViewObject::measured(p)).collect();
    args.report.write(document, &objects, &[], common.progress)
}

/// A row in space in the plane nearest to it; a row of two columns as it is.
fn row(points: &[Point], planar: bool, options: &Options, stage: &Stage) -> Found {
    let through = if planar { None } else { PlaneFrame::through(points) };
    let (frame, flatness) = through.unwrap_or_default();
    let flat: Vec<[f64; 2]> = points.iter().map(|p| frame.flat(*p)).collect();
    let contours = vec![section::contour(&flat, options, stage)?];
    let area = Err("points in order have no facets");
    let frame = described(&frame, flatness);
    Ok((
        vec![Section {
            frame,
            plane: None,
            area,
            loose: 0,
            gap: None,
            thickness: None,
            bent: vec![],
            fills_area: false,
            contours,
        }],
        vec![flat],
    ))
}
