//! `trueness align`: the motion that brings a measured part onto its reference.

use crate::command::Run;
use crate::console;
use crate::exit::{self, Outcome, Usage};
use crate::number::{POINTS, counted, fixed, grouped, scientific, signed, six_digits};
use crate::options::{Common, DocumentArgs, PointInputArgs, ReferenceArgs};
use crate::progress::{STEPS, Stage};
use crate::read::{self, Body, Opened};
use crate::run_files::RunFiles;
use crate::tolerance::ToleranceArg;
use anyhow::Context;
use clap::{Args, ValueEnum};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use trueness_document::align::AlignDocument;
use trueness_document::{InputRecord, Role};
use trueness_files::write::{self, Block, Layout, Writable};
use trueness_geom::align::{self, AlignError, BestFit, Lock, Measured, Row, RowFit, Start, Target};
use trueness_geom::closest::Tree;
use trueness_geom::deviation::surface::{ReferenceSurface, SurfaceOptions};
use trueness_geom::mesh::Mesh;
use trueness_geom::rigid::Rigid;
use trueness_geom::space::{Point, times};
use trueness_measure::align as align_document;
use trueness_measure::compare::Regions;

/// Brings a scan onto its reference, from any starting pose
///
/// The best fit has the least mean square distance to the surface of the reference, weighted by area where the scan is a
/// mesh; outliers do not count. Whole and partial scans, meshes and points.
#[derive(Args, Debug)]
#[command(after_help = exit::help("the result cannot be relied on: poor, ambiguous, mirrored, not held by what was measured, of a wrong unit, of few points or not settled, or out of tolerance; files are written all the same", "\
Tables of --points, one row a line, mm: of pairs, x y z measured and x y z of the reference; of 3-2-1 and rps, these six and
the direction in which the point is held. A last column, if there, is the weight.

Examples:
  trueness align scan.stl nominal.stl -o aligned.stl
  trueness align scan.ply nominal.stl --json transform.json
  trueness align scan.stl nominal.stl --from-here --lock tz,rx,ry -o aligned.stl
  trueness align scan.stl nominal.stl --scale -o aligned.stl
  trueness align scan.stl nominal.stl --method chebyshev -o aligned.stl
  trueness align scan.stl nominal.stl --method zones --tolerance 0.2 --regions regions.toml -o aligned.stl
  trueness align scan.stl nominal.stl --method rps --points rps.csv -o aligned.stl"))]
pub struct AlignArgs {
    /// The scan: a mesh or points; `-` reads stdin
    measured: PathBuf,
    /// The nominal: a mesh, which does not move
    reference: PathBuf,
    /// The scan in the frame of the reference, mm
    #[arg(short, long, value_name = "FILE", help = out_help())]
    out: Option<PathBuf>,
    /// What makes a pose the best
    #[arg(long, value_enum, default_value = "best-fit")]
    method: MethodArg,
    /// Table of places that belong together, for the methods other than best-fit
    #[arg(long, value_name = "FILE", required_if_eq_any = [("method", "pairs"), ("method", "3-2-1"), ("method", "rps")])]
    points: Option<PathBuf>,
    /// For zones: what deviations may be, ±T or -L,+U in mm, where no region says otherwise
    #[arg(long, value_name = "T | -L,+U", allow_hyphen_values = true)]
    tolerance: Option<ToleranceArg>,
    /// For zones: regions of the reference with tolerances of their own, as for `trueness compare`
    #[arg(long, value_name = "FILE")]
    regions: Option<PathBuf>,
    /// Start from the pose in the files instead of looking for one
    #[arg(long)]
    from_here: bool,
    /// Components of the motion from here that stay zero: tx, ty, tz of the translation of the middle of the scan, rx, ry, rz of the rotation
    /// about it, in the frame of the reference; for best-fit
    #[arg(long, value_delimiter = ',', value_name = "AXES", requires = "from_here", ignore_case = true)]
    lock: Vec<LockArg>,
    /// Find a scale, too: how many times as large the scan has to be made; for best-fit
    #[arg(long, conflicts_with = "lock")]
    scale: bool,
    /// Let all points count, however far off they are
    #[arg(long)]
    keep_outliers: bool,
    #[command(flatten)]
    input: PointInputArgs,
    #[command(flatten)]
    of_reference: ReferenceArgs,
    #[command(flatten)]
    document: DocumentArgs,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum MethodArg {
    /// The least mean square distance to the surface.
    BestFit,
    /// The least greatest distance to the surface, near the best fit.
    Chebyshev,
    /// The least greatest excess over tolerances, near the best fit.
    Zones,
    /// Pairs of points that belong together.
    Pairs,
    /// Six rows that hold all six degrees of freedom, exactly.
    #[value(name = "3-2-1")]
    ThreeTwoOne,
    /// A reference point system: rows held along their directions, by weight.
    Rps,
}

/// A component of a motion, in the order of [`Lock::axes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum LockArg {
    Tx,
    Ty,
    Tz,
    Rx,
    Ry,
    Rz,
}

fn out_help() -> String {
    format!(
        "The scan in the frame of the reference, mm: a mesh {}; points {}",
        Writable::Mesh.shown(),
        Writable::Points.shown()
    )
}

impl Run for AlignArgs {
    fn files(&self) -> anyhow::Result<RunFiles> {
        let tables = self.points.iter().chain(&self.regions);
        Ok(RunFiles::of([&self.measured, &self.reference].into_iter().chain(tables))
            .also("--out", self.out.as_ref())
            .document(self.document.json.as_ref()))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        run(self, common)
    }
}

/// What is measured, as it stands in its file.
struct Scan {
    mesh: Mesh,
    record: InputRecord,
}

impl Scan {
    fn open(args: &AlignArgs) -> anyhow::Result<Scan> {
        let Opened { mut record, body, .. } =
            read::open(&args.measured, Role::Measured, &args.input.reading())?;
        let mesh = match body {
            Body::Mesh(source) => source.mesh,
            Body::Points(source) => {
                Mesh { positions: read::all_points(&args.measured, source)?, faces: vec![] }
            }
        };
        read::describe(&mut record, &mesh.positions);
        Ok(Scan { mesh, record })
    }

    fn holds(&self) -> Writable {
        if self.mesh.faces.is_empty() { Writable::Points } else { Writable::Mesh }
    }

    /// Writes it as it lies after `motion`, made `factor` times as large before. Gives what the format could not hold, for people.
    fn write(&self, path: &Path, factor: f64, motion: &Rigid) -> anyhow::Result<Option<String>> {
        let moved = |p: &Point| motion.point(times(factor, *p));
        let positions: Vec<Point> = self.mesh.positions.iter().map(moved).collect();
        if self.holds() == Writable::Points {
            let mut file = write::points(path, Layout::default())?;
            file.write(&Block { points: &positions, ..Block::default() })?;
            file.finish()?;
            return Ok(None);
        }
        let loss = write::mesh(path, &Mesh { positions, faces: self.mesh.faces.clone() })?;
        Ok((loss.moved > 0).then(|| {
            format!("{}: its format rounds by up to {} mm", path.display(), scientific(loss.farthest, 1))
        }))
    }
}

fn run(args: &AlignArgs, common: &Common) -> anyhow::Result<Outcome> {
    let zones = args.method == MethodArg::Zones;
    if zones != (args.tolerance.is_some() || args.regions.is_some()) {
        let what = match zones {
            true => "--method zones needs what is allowed: give --tolerance, --regions or both",
            false => "--tolerance and --regions are for --method zones",
        };
        return Err(Usage(what.into()).into());
    }
    if matches!(args.method, MethodArg::BestFit | MethodArg::Chebyshev | MethodArg::Zones)
        && args.points.is_some()
    {
        return Err(
            Usage("--points is for the methods pairs, 3-2-1 and rps; name one by --method".into()).into()
        );
    }
    if args.method != MethodArg::BestFit && (args.scale || !args.lock.is_empty()) {
        let what = if args.scale { "--scale" } else { "--lock" };
        let why = "the other methods begin with a best fit of all six degrees of freedom, or take the rows of a table";
        return Err(Usage(format!("{what} is for --method best-fit: {why}")).into());
    }
    let mut scan = Scan::open(args)?;
    if let Some(path) = &args.out {
        scan.holds().check(path)?;
    }
    let reading = args.of_reference.reading(&args.input);
    let (reference, mut record) = read::mesh(&args.reference, Role::Reference, &reading)?;
    read::hash(&mut scan.record, &args.measured)?;
    read::hash(&mut record, &args.reference)?;
    let records = vec![scan.record.clone(), record];
    let document = match (&args.points, args.method) {
        (Some(path), method) => {
            let found = by_rows(path, method)?;
            let name = match method {
                MethodArg::BestFit | MethodArg::Chebyshev | MethodArg::Zones | MethodArg::Pairs => "pairs",
                MethodArg::ThreeTwoOne => "3-2-1",
                MethodArg::Rps => "rps",
            };
            let corners = reference.mesh.bounds().corners();
            align_document::rows(&found, name, &corners, records, common.seed)
        }
        (None, _) => best_fit(args, &scan, &reference.mesh, records, common)?,
    };
    let motion = Rigid::from_matrix(document.motion()).context("the motion found")?;
    let factor = document.scale.unwrap_or(1.0);
    let loss = args.out.as_ref().map(|path| scan.write(path, factor, &motion)).transpose()?.flatten();
    args.document.write(&document)?;
    args.document.table(|| table(&document, loss.as_deref()))?;
    // Against a reference that was not read in whole nothing is proven.
    let whole = document.inputs.iter().all(|i| i.role != Role::Reference || i.incomplete.is_none());
    let within = document.zones.as_ref().is_none_or(|z| z.beyond == 0 && whole);
    Ok(if document.sound() && within { Outcome::Conforming } else { Outcome::NotConforming })
}

fn best_fit(
    args: &AlignArgs,
    scan: &Scan,
    reference: &Mesh,
    records: Vec<InputRecord>,
    common: &Common,
) -> anyhow::Result<AlignDocument> {
    let of_reference = || args.reference.display().to_string();
    let stage = Stage::new(common.progress, "aligning", STEPS, None);
    let tree = Tree::build_watched(reference, &stage).map_err(|e| match e {
        trueness_geom::closest::MeshError::Cancelled(e) => e.into(),
        e => anyhow::anyhow!("{}: {e}", of_reference()),
    })?;
    let measured = match scan.holds() {
        Writable::Mesh => Measured::Mesh(&scan.mesh),
        _ => Measured::Points { points: &scan.mesh.positions, normals: None },
    };
    let options = BestFit {
        start: if args.from_here { Start::Given(Rigid::IDENTITY) } else { Start::Anywhere },
        robust: !args.keep_outliers,
        seed: common.seed,
        lock: (!args.lock.is_empty()).then(|| {
            let axes = std::array::from_fn(|k| args.lock.iter().any(|axis| *axis as usize == k));
            Lock::new(axes, &measured, Rigid::IDENTITY)
        }),
    };
    let target = Target::new(reference, &tree);
    let failed = |e: AlignError| match e {
        AlignError::Cancelled(e) => e.into(),
        e => anyhow::anyhow!("{}: {e}", args.measured.display()),
    };
    if args.scale {
        let (fit, scale) = align::best_fit_scaled(&measured, &target, &options, &stage).map_err(failed)?;
        return Ok(align_document::with_scale(align_document::best_fit(&fit, records, common.seed), &scale));
    }
    let fit = align::best_fit(&measured, &target, &options, &stage).map_err(failed)?;
    match args.method {
        MethodArg::Chebyshev => {
            let found = align::minimax(&measured, &target, &fit, &options, &stage).map_err(failed)?;
            Ok(align_document::minimax(&found, &fit, records, common.seed))
        }
        MethodArg::Zones => {
            let surface = ReferenceSurface::new(&tree, reference, &SurfaceOptions::default(), &stage)?;
            let rules = args.regions.as_deref().map(read::regions).transpose()?.unwrap_or_default();
            let regions = Regions::new(&rules, reference, &tree, common.seed, &stage)
                .map_err(|e| anyhow::anyhow!("{}: {e}", of_reference()))?;
            let elsewhere = args.tolerance.map(|t| t.0);
            let zones = |face, place: &Point| regions.allowed(face, place, elsewhere);
            let found = align::into_zones(&measured, &target, &surface, &zones, &fit, &options, &stage);
            Ok(align_document::zones(&found.map_err(failed)?, &fit, records, common.seed))
        }
        _ => {
            let document = align_document::best_fit(&fit, records, common.seed);
            Ok(match &options.lock {
                Some(lock) => align_document::with_lock(document, lock),
                None => document,
            })
        }
    }
}

/// The rows of a table: numbers separated by blanks, commas, semicolons or tabs; `#` begins a comment.
fn rows(path: &Path) -> anyhow::Result<Vec<Vec<f64>>> {
    let text = std::fs::read_to_string(path).with_context(|| path.display().to_string())?;
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
            Err(e) => anyhow::bail!(
                "{}: line {}: {e}; give numbers with a decimal point",
                path.display(),
                number + 1
            ),
        }
    }
    Ok(all)
}

/// Aligns by the rows of a table.
fn by_rows(path: &Path, method: MethodArg) -> anyhow::Result<RowFit> {
    let shown = path.display();
    let rows = rows(path)?;
    let columns = if method == MethodArg::Pairs { 6 } else { 9 };
    if let Some(i) = rows.iter().position(|r| r.len() != columns && r.len() != columns + 1) {
        let found = rows[i].len();
        anyhow::bail!(
            "{shown}: row {} has {found} numbers; give {columns}, or {} with the weight",
            i + 1,
            columns + 1
        );
    }
    if method == MethodArg::ThreeTwoOne && rows.len() != 6 {
        anyhow::bail!("{shown}: 3-2-1 needs six rows, and there are {}; --method rps takes more", rows.len());
    }
    let three = |row: &[f64], k: usize| [row[k], row[k + 1], row[k + 2]];
    let weight = |row: &Vec<f64>| row.get(columns).copied().unwrap_or(1.0);
    let found = if method == MethodArg::Pairs {
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
    found.map_err(|e| anyhow::anyhow!("{shown}: {e}"))
}

/// The document for people.
fn table(document: &AlignDocument, loss: Option<&str>) -> String {
    let mut out = read::notes(&document.inputs);
    let _ = writeln!(out, "reference from measured by {}, mm", document.method);
    let rows: Vec<Vec<String>> =
        document.transform.iter().map(|row| row.iter().map(|x| fixed(*x, 12)).collect()).collect();
    out.push_str(&console::columns(&rows));
    let settled = if document.converged { "settled" } else { "not settled" };
    let _ = writeln!(
        out,
        "rms {}   mean {}   {} after {}",
        six_digits(document.rms),
        six_digits(document.mean_abs),
        settled,
        counted(document.iterations, ["step", "steps"])
    );
    if let (Some(scale), Some(u)) = (document.scale, document.scale_std_uncertainty) {
        let _ = writeln!(
            out,
            "scale {} ± {} (one standard deviation): the scan is made so many times as large",
            fixed(scale, 9),
            scientific(u, 1)
        );
    }
    if let Some(lock) = &document.lock {
        let [x, y, z] = lock.center.map(six_digits);
        let _ = writeln!(out, "locked: {}, about {x}, {y}, {z}", lock.axes.join(", "));
    }
    searched(document, &mut out);
    if let Some(fit) = &document.best_fit {
        let _ = writeln!(
            out,
            "{} count, {} left out   share of the surface {} %   median {}",
            counted(fit.used, POINTS),
            grouped(fit.left_out),
            fixed(100.0 * fit.share, 1),
            six_digits(fit.median)
        );
        let u = fit.std_uncertainty;
        let open = align_document::open(document);
        let told = |k: usize, x: f64| if open[k] { "free".into() } else { scientific(x, 1) };
        let degrees = [0, 1, 2].map(|k| told(k, u[k].to_degrees())).join(" ");
        let lengths = [3, 4, 5].map(|k| told(k, u[k])).join(" ");
        let _ = writeln!(out, "standard uncertainty: rotation {degrees} degrees, translation {lengths} mm");
    }
    for pair in &document.pairs {
        let amplified = pair
            .amplification
            .map(|by| format!("   1 mm of error there moves the farthest corner by {} mm", fixed(by, 2)));
        let _ = writeln!(
            out,
            "row {}: {}{}",
            pair.row + 1,
            six_digits(pair.residual),
            amplified.unwrap_or_default()
        );
    }
    for warning in &document.warnings {
        let _ = writeln!(out, "! {}", warning.text);
    }
    out.extend(loss.map(|text| format!("{text}\n")));
    out
}

/// What a search that began with the best fit found.
fn searched(document: &AlignDocument, out: &mut String) {
    if let Some(found) = &document.chebyshev {
        let [x, y, z] = found.at.map(six_digits);
        let _ = writeln!(
            out,
            "greatest distance {} at {x}, {y}, {z}: the least near the best fit",
            six_digits(found.greatest)
        );
        let _ = writeln!(
            out,
            "{} count, {} left out; of the best fit:",
            counted(found.used, POINTS),
            grouped(found.left_out)
        );
    }
    if let Some(found) = &document.zones {
        let [x, y, z] = found.at.map(six_digits);
        let [lower, upper] = found.tolerance.map(signed);
        let _ = writeln!(
            out,
            "greatest excess {} at {x}, {y}, {z} (deviation {}, allowed {lower} … {upper}){}",
            signed(found.excess),
            signed(found.deviation),
            match found.left_out {
                0 => ": the least near the best fit".into(),
                _ => format!("; of the points that count in the search {}", signed(found.least)),
            }
        );
        let within = match found.beyond {
            0 => format!("all {} within", counted(found.used, POINTS)),
            beyond => format!("{} of {} beyond", grouped(beyond), counted(found.used, POINTS)),
        };
        let (without, left_out) = (grouped(found.without_zone), grouped(found.left_out));
        let _ = writeln!(
            out,
            "{within}, {without} at places without a tolerance, {left_out} left out in the search; of the best fit:"
        );
    }
}
