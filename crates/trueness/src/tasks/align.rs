//! The motion that brings a measured part onto its reference.

use crate::read::{self, Opened};
use crate::task::{
    Choice, Done, Meaning, Output, PointReading, ReferenceReading, Request, Rounding, RunFiles, STEPS,
    TaskError, Text, ToleranceText, Watch, choices,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use trueness_document::align::AlignDocument;
use trueness_document::{InputRecord, Role};
use trueness_files::Sources;
use trueness_files::write::{self, Block, Layout, MeshFile, Writable};
use trueness_geom::align::{
    self, AlignError, BestFit, ExactSurface, Lock, Measured, Row, RowFit, Start, Target,
};
use trueness_geom::closest::{MeshError, Tree};
use trueness_geom::deviation::surface::{ReferenceSurface, SurfaceOptions};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Silent;
use trueness_geom::rigid::Rigid;
use trueness_geom::scan::Scan;
use trueness_geom::space::{Point, times};
use trueness_measure::cad_faces::CadFaces;
use trueness_measure::compare::Regions;

choices! {
    /// What makes a pose the best.
    pub enum Method {
        BestFit = "best-fit": "The least mean square distance to the surface",
        Chebyshev = "chebyshev": "The least greatest distance to the surface, near the best fit",
        Zones = "zones": "The least greatest excess over tolerances, near the best fit",
        Pairs = "pairs": "Pairs of points that belong together",
        ThreeTwoOne = "3-2-1": "Six rows that hold all six degrees of freedom, exactly",
        Rps = "rps": "A reference point system: rows held along their directions, by weight",
    }
}

choices! {
    /// A component of a motion, in the order of [`Lock::axes`].
    pub enum Axis {
        Tx = "tx": "",
        Ty = "ty": "",
        Tz = "tz": "",
        Rx = "rx": "",
        Ry = "ry": "",
        Rz = "rz": "",
    }
}

/// What an alignment is asked.
///
/// ```
/// use trueness::task::Request;
/// use trueness::{files::FileSources, geom::progress::Silent, tasks::align::AlignRequest};
/// let request = AlignRequest {
///     measured: "../../corpus/bunny/zipper_res3.ply".into(),
///     reference: "../../corpus/bunny/zipper_res4.ply".into(),
///     ..AlignRequest::default()
/// };
/// let done = request.run(&FileSources, &Silent)?;
/// assert!(done.document.angle < 0.01);
/// # Ok::<(), trueness::task::TaskError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct AlignRequest {
    /// The scan: a mesh or points.
    pub measured: PathBuf,
    /// The nominal: a mesh, which does not move.
    pub reference: PathBuf,
    /// How the scan is taken.
    #[serde(flatten)]
    pub reading: PointReading,
    /// How the nominal is taken.
    #[serde(flatten)]
    pub reference_reading: ReferenceReading,
    /// Where to write the scan in the frame of the reference, mm.
    pub out: Option<PathBuf>,
    /// What makes a pose the best.
    pub method: Method,
    /// Table of places that belong together, for `pairs`, `3-2-1` and `rps`.
    pub points: Option<PathBuf>,
    /// For `zones`: what deviations may be, ±T or -L,+U in mm, where no region says otherwise.
    pub tolerance: Option<Text<ToleranceText>>,
    /// For `zones`: regions of the reference with tolerances of their own.
    pub regions: Option<PathBuf>,
    /// Start from the pose in the files instead of looking for one.
    pub from_here: bool,
    /// Components of the motion from here that stay zero: of the translation of the middle of the scan and of the rotation about it, in the
    /// frame of the reference; for `best-fit`.
    pub lock: Vec<Axis>,
    /// Find a scale, too: how many times as large the scan has to be made; for `best-fit`.
    pub scale: bool,
    /// Let all points count, however far off they are.
    pub keep_outliers: bool,
    /// Seed of everything random.
    pub seed: u64,
}

impl AlignRequest {
    fn check(&self) -> Result<(), TaskError> {
        let zones = self.method == Method::Zones;
        if zones != (self.tolerance.is_some() || self.regions.is_some()) {
            return Err(TaskError::usage(match zones {
                true => "--method zones needs the allowed deviations: give --tolerance, --regions or both",
                false => "--tolerance and --regions are for --method zones",
            }));
        }
        let by_rows = matches!(self.method, Method::Pairs | Method::ThreeTwoOne | Method::Rps);
        if by_rows != self.points.is_some() {
            return Err(TaskError::usage(match by_rows {
                true => "--method pairs, 3-2-1 and rps need a table of places: give --points",
                false => "--points is for the methods pairs, 3-2-1 and rps; choose one with --method",
            }));
        }
        if self.method != Method::BestFit && (self.scale || !self.lock.is_empty()) {
            let what = if self.scale { "--scale" } else { "--lock" };
            let why = "the other methods begin with a best fit of all six degrees of freedom, or take the rows of a table";
            return Err(TaskError::usage(format!("{what} is for --method best-fit: {why}")));
        }
        Ok(())
    }

    /// The pose of a best fit, or of a search that begins with one.
    fn best_fit(
        &self,
        (scan, reference, faces): (&Scan, &Mesh, Option<&CadFaces>),
        records: Vec<InputRecord>,
        (sources, watch): (&dyn Sources, &dyn Watch),
    ) -> Result<AlignDocument, TaskError> {
        let in_reference = |e: String| TaskError::unanswerable(format!("{}: {e}", self.reference.display()));
        let stage = watch.stage("aligning", STEPS, None);
        let tree = Tree::build_watched(reference, &*stage).map_err(|e| match e {
            MeshError::Cancelled(e) => e.into(),
            e => in_reference(e.to_string()),
        })?;
        let measured = Measured::from(scan);
        let options = BestFit {
            start: if self.from_here { Start::From(Rigid::IDENTITY) } else { Start::Anywhere },
            robust: !self.keep_outliers,
            seed: self.seed,
            lock: (!self.lock.is_empty()).then(|| {
                let axes = std::array::from_fn(|k| self.lock.iter().any(|axis| *axis as usize == k));
                Lock::new(axes, &measured, Rigid::IDENTITY)
            }),
        };
        let exact = faces.map(|faces| faces as &dyn ExactSurface);
        let target = Target::new(reference, &tree).drawing(exact);
        let failed = |e: AlignError| match e {
            AlignError::Cancelled(e) => e.into(),
            e => TaskError::unanswerable(format!("{}: {e}", self.measured.display())),
        };
        if self.scale {
            let found = align::best_fit_scaled(&measured, &target, &options, &*stage);
            let (fit, scale) = found.map_err(failed)?;
            return Ok(trueness_measure::align::with_scale(
                trueness_measure::align::best_fit(&fit, records, self.seed),
                &scale,
            ));
        }
        let fit = align::best_fit(&measured, &target, &options, &*stage).map_err(failed)?;
        match self.method {
            Method::Chebyshev => {
                let found = align::minimax(&measured, &target, &fit, &options, &*stage).map_err(failed)?;
                Ok(trueness_measure::align::minimax(&found, &fit, records, self.seed))
            }
            Method::Zones => {
                let surface = ReferenceSurface::new(&tree, reference, &SurfaceOptions::default(), &*stage)
                    .map_err(TaskError::because)?;
                let rules = self.regions.as_deref().map(|path| read::regions(sources, path));
                let rules = rules.transpose()?.unwrap_or_default();
                let regions = Regions::new(&rules, reference, &tree, self.seed, &*stage)
                    .map_err(|e| in_reference(e.to_string()))?;
                let elsewhere = self.tolerance.as_ref().map(|t| t.value.0);
                let zones = |face, place: &Point| regions.allowed(face, place, elsewhere);
                let found = align::into_zones(&measured, &target, &surface, &zones, &fit, &options, &*stage);
                Ok(trueness_measure::align::zones(&found.map_err(failed)?, &fit, records, self.seed))
            }
            _ => {
                let document = trueness_measure::align::best_fit(&fit, records, self.seed);
                Ok(match &options.lock {
                    Some(lock) => trueness_measure::align::with_lock(document, lock),
                    None => document,
                })
            }
        }
    }
}

impl Request for AlignRequest {
    type Document = AlignDocument;
    const COMMAND: &'static str = "align";

    fn files(&self, _: &dyn Sources) -> Result<RunFiles, TaskError> {
        let tables = self.points.iter().chain(&self.regions);
        Ok(RunFiles::of([&self.measured, &self.reference].into_iter().chain(tables))
            .also("--out", self.out.as_ref()))
    }

    fn answer(&self, sources: &dyn Sources, watch: &dyn Watch) -> Result<Done<AlignDocument>, TaskError> {
        self.check()?;
        let mut measured = MeasuredFile::open(self, sources)?;
        if let Some(path) = &self.out {
            measured.holds().check(path)?;
        }
        let reading = self.reference_reading.options(&self.reading);
        let (reference, faces, mut record) =
            read::mesh_or_faces(sources, &self.reference, &reading, &Silent)?;
        read::hash(sources, &mut measured.record, &self.measured)?;
        read::hash(sources, &mut record, &self.reference)?;
        let records = vec![measured.record.clone(), record];
        let document = match &self.points {
            Some(path) => {
                let found = by_rows(sources, path, self.method)?;
                let corners = reference.mesh.bounds().corners();
                trueness_measure::align::rows(&found, self.method.word(), &corners, records, self.seed)
            }
            None => {
                let parts = (&measured.scan, &reference.mesh, faces.as_ref());
                self.best_fit(parts, records, (sources, watch))?
            }
        };
        let motion = Rigid::from_matrix(document.motion()).meaning(|| "the motion found".into())?;
        let mut done = Done::new(document);
        if let Some(path) = &self.out {
            let (output, loss) = measured.write(path, done.document.scale.unwrap_or(1.0), &motion)?;
            done.outputs.push(output);
            done.losses.extend(loss);
        }
        Ok(done)
    }
}

/// What is measured, as it stands in its file.
struct MeasuredFile {
    scan: Scan,
    record: InputRecord,
}

impl MeasuredFile {
    fn open(request: &AlignRequest, sources: &dyn Sources) -> Result<MeasuredFile, TaskError> {
        let Opened { mut record, body, .. } =
            read::open(sources, &request.measured, Role::Measured, &request.reading.options())?;
        let scan = read::scan(&request.measured, body, &mut record)?;
        read::describe(&mut record, scan.points());
        Ok(MeasuredFile { scan, record })
    }

    fn holds(&self) -> Writable {
        match self.scan {
            Scan::Mesh(_) => Writable::Mesh,
            Scan::Cloud(_) => Writable::Points,
        }
    }

    /// Writes it as it lies after `motion`, made `factor` times as large before. Gives what the format could not hold.
    fn write(
        &self,
        path: &Path,
        factor: f64,
        motion: &Rigid,
    ) -> Result<(Output, Option<Rounding>), TaskError> {
        let moved = |p: &Point| motion.point(times(factor, *p));
        let positions: Vec<Point> = self.scan.points().iter().map(moved).collect();
        let Scan::Mesh(mesh) = &self.scan else {
            let mut file = write::points(path, Layout::default())?;
            file.write(&Block { points: &positions, ..Block::default() })?;
            return Ok((Output::later(move || file.finish().map(drop)), None));
        };
        let file = MeshFile::write(path, &Mesh { positions, faces: mesh.faces.clone() })?;
        let loss = file.loss;
        let rounding =
            (loss.moved > 0).then(|| Rounding { path: path.to_path_buf(), farthest: loss.farthest });
        Ok((Output::later(move || file.finish()), rounding))
    }
}

/// Longest table of places, bytes.
const LONGEST_TABLE: usize = 16 << 20;

/// The rows of a table: numbers separated by blanks, commas, semicolons or tabs; `#` begins a comment.
fn rows(sources: &dyn Sources, path: &Path) -> Result<Vec<Vec<f64>>, TaskError> {
    let text = sources.text(path, LONGEST_TABLE)?;
    let mut all: Vec<Vec<f64>> = vec![];
    for (number, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default();
        let words = line.split([' ', ',', ';', '\t']).filter(|word| !word.is_empty());
        let row: Result<Vec<f64>, _> = words.map(str::parse::<f64>).collect();
        match row {
            Ok(row) if row.is_empty() => {}
            Ok(row) => all.push(row),
            // Names of the columns.
            Err(_) if all.is_empty() && number == 0 => {}
            Err(e) => {
                return Err(TaskError::unanswerable(format!(
                    "{}: line {}: {e}; give numbers with a decimal point",
                    path.display(),
                    number + 1
                )));
            }
        }
    }
    Ok(all)
}

/// Aligns by the rows of a table.
fn by_rows(sources: &dyn Sources, path: &Path, method: Method) -> Result<RowFit, TaskError> {
    let shown = path.display();
    let rows = rows(sources, path)?;
    let columns = if method == Method::Pairs { 6 } else { 9 };
    if let Some(i) = rows.iter().position(|r| r.len() != columns && r.len() != columns + 1) {
        let found = rows[i].len();
        return Err(TaskError::unanswerable(format!(
            "{shown}: row {} has {found} numbers; give {columns}, or {} with the weight",
            i + 1,
            columns + 1
        )));
    }
    if method == Method::ThreeTwoOne && rows.len() != 6 {
        let (wanted, there) = ("3-2-1 needs six rows", rows.len());
        let text = format!("{shown}: {wanted}, and there are {there}; --method rps takes more");
        return Err(TaskError::unanswerable(text));
    }
    let three = |row: &[f64], k: usize| [row[k], row[k + 1], row[k + 2]];
    let weight = |row: &Vec<f64>| row.get(columns).copied().unwrap_or(1.0);
    let found = if method == Method::Pairs {
        let measured: Vec<Point> = rows.iter().map(|r| three(r, 0)).collect();
        let reference: Vec<Point> = rows.iter().map(|r| three(r, 3)).collect();
        let weights: Vec<f64> = rows.iter().map(weight).collect();
        align::pairs(&measured, &reference, Some(&weights))
    } else {
        let row = |r: &Vec<f64>| Row {
            measured: three(r, 0),
            nominal: three(r, 3),
            direction: three(r, 6),
            weight: weight(r),
        };
        align::constrained(&rows.iter().map(row).collect::<Vec<Row>>(), None)
    };
    found.map_err(|e| TaskError::unanswerable(format!("{shown}: {e}")))
}
