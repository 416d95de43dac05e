//! `trueness curvature`: principal, mean and Gaussian curvature of a mesh or cloud.

mod table;

use crate::command::Run;
use crate::exit::{Outcome, Usage};
use crate::noise::NoiseArgs;
use crate::options::{Common, DocumentArgs, PointInputArgs};
use crate::progress::Stage;
use crate::read::{self, Body, Opened};
use crate::report::ReportArgs;
use crate::run_files::RunFiles;
use anyhow::bail;
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use trueness_document::Role;
use trueness_document::curvature::{CurvatureDocument, CurvatureKind, NoCurvature};
use trueness_files::write::{Values, Writable, values};
use trueness_geom::curvature::{self, CurvatureError, Curvatures, Options, Reach};
use trueness_geom::mesh::Mesh;
use trueness_measure::curvature::{document, noise, value, without};
use trueness_measure::words::ToWord;
use trueness_report::views::curvature::View;

/// Principal, mean and Gaussian curvature at every vertex of a mesh or point of a cloud
///
/// By polynomials fitted to the neighborhoods (jets). A curvature is positive where the surface bends towards its normal: on a convex
/// body with outward normals both principal curvatures are negative. Places where the surface ends, or that their neighbors do not
/// determine, have no value and are counted.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  trueness curvature scan.stl
  trueness curvature scan.ply --radius 2 --out curvature.ply --color gaussian
  trueness curvature cloud.xyz --neighbors 60 --json curvature.json --html curvature.html")]
pub struct CurvatureArgs {
    /// A mesh, or points; `-` reads stdin
    input: PathBuf,
    /// Degree of the polynomials, from 2 to 6
    #[arg(long, value_name = "D", default_value = "3")]
    degree: usize,
    /// Fewest neighbors: whole rings of a mesh, the nearest ones of a cloud [default: 3 for each unknown, 30 of degree 3]
    #[arg(long, value_name = "N", conflicts_with = "radius")]
    neighbors: Option<usize>,
    /// All neighbors within this distance, mm: curvature at a scale of your own
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    radius: Option<f64>,
    /// Places on a boundary have values too, from the one side that there is
    #[arg(long)]
    boundary: bool,
    #[command(flatten)]
    noise: NoiseArgs,
    #[command(flatten)]
    reading: PointInputArgs,
    #[command(flatten)]
    document: DocumentArgs,
    /// Write the vertices or points with their curvatures
    #[arg(long, value_name = "FILE", help = out_help())]
    out: Option<PathBuf>,
    /// The curvature that a .ply file of --out is colored by
    #[arg(long, value_enum, value_name = "WHICH", default_value = "mean")]
    color: ColorArg,
    #[command(flatten)]
    report: ReportArgs,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ColorArg {
    Mean,
    Gaussian,
    K1,
    K2,
}

impl From<ColorArg> for CurvatureKind {
    fn from(color: ColorArg) -> CurvatureKind {
        match color {
            ColorArg::Mean => CurvatureKind::Mean,
            ColorArg::Gaussian => CurvatureKind::Gaussian,
            ColorArg::K1 => CurvatureKind::K1,
            ColorArg::K2 => CurvatureKind::K2,
        }
    }
}

fn out_help() -> String {
    format!("Write the vertices or points with their curvatures ({})", Writable::Values.shown())
}

impl CurvatureArgs {
    fn options(&self) -> Options {
        let reach = match (self.neighbors, self.radius) {
            (_, Some(radius)) => Reach::Radius(radius),
            (Some(count), None) => Reach::Count(count),
            (None, None) => Reach::Auto,
        };
        Options { degree: self.degree, reach, boundary: self.boundary, noise: None }
    }
}

impl Run for CurvatureArgs {
    fn files(&self) -> anyhow::Result<RunFiles> {
        Ok(RunFiles::of([&self.input])
            .out(self.out.as_ref(), Writable::Values)
            .document(self.document.json.as_ref())
            .report(self.report.html.as_ref()))
    }
    fn run(&self, common: &Common) -> anyhow::Result<Outcome> {
        run(self, common)
    }
}

fn run(args: &CurvatureArgs, common: &Common) -> anyhow::Result<Outcome> {
    let mut options = args.options();
    let shown = args.input.display();
    let Opened { mut record, body, planar, .. } =
        read::open(&args.input, Role::Measured, &args.reading.reading())?;
    if planar {
        return Err(Usage(format!("{shown}: it has two columns; curvatures need x, y and z")).into());
    }
    let (mesh, of_mesh) = match body {
        Body::Mesh(source) => (source.mesh, true),
        Body::Points(source) => {
            (Mesh { positions: read::all_points(&args.input, source)?, faces: vec![] }, false)
        }
    };
    read::describe(&mut record, &mesh.positions);
    let noise = args.noise.found(common.progress, |stage| noise(&mesh, common.seed, stage))?;
    options.noise = noise.as_ref().ok().copied();
    let stage = Stage::new(common.progress, "fitting", "places", Some(mesh.positions.len() as u64));
    let (hash, found) = rayon::join(
        || read::hash(&mut record, &args.input),
        || match of_mesh {
            true => curvature::mesh(&mesh, &options, &stage),
            false => curvature::cloud(&mesh.positions, &options, &stage),
        },
    );
    stage.end(&found);
    hash?;
    let found = found.map_err(|e| match e {
        CurvatureError::Cancelled(e) => e.into(),
        e @ (CurvatureError::Degree(_) | CurvatureError::Neighbors { .. } | CurvatureError::Radius(_)) => {
            Usage(e.to_string()).into()
        }
        e => anyhow::anyhow!("{shown}: {e}"),
    })?;
    let Some(document) = document(&found, &mesh.positions, of_mesh, &options, &noise, vec![record]) else {
        bail!("{shown}: {}", nothing(&found, of_mesh, options.reach));
    };
    if args.report.html.is_some() {
        let view = View::new(&document, &document.inputs[0].path, &mesh, &found);
        args.report.write(&document, &view.objects(), &[], common.progress)?;
    }
    if let Some(path) = &args.out {
        write(path, &mesh, &found, &document, args.color.into())?;
    }
    args.document.write(&document)?;
    args.document.table(|| table::table(&document))?;
    Ok(Outcome::Conforming)
}

/// Why there is not a single value, and what to do.
fn nothing(found: &Curvatures, of_mesh: bool, reach: Reach) -> String {
    let reasons = without(found);
    let Some((most, _)) = reasons.iter().max_by_key(|(_, count)| **count) else {
        return "it holds nothing that could have a curvature".into();
    };
    let wide = matches!(reach, Reach::Radius(_));
    let remedy = match **most {
        NoCurvature::Boundary => "--boundary gives them values from one side",
        NoCurvature::FewNeighbors if wide => "give a larger --radius, or a smaller --degree",
        NoCurvature::FewNeighbors => "give a smaller --degree or --neighbors",
        NoCurvature::Undetermined if !of_mesh => {
            "they lie on lines or at one place: a larger --radius or more --neighbors reach the next line; points of a single line have no curvature"
        }
        NoCurvature::Folded if wide => {
            "within the radius the surface turns back: give a smaller --radius, or see what `trueness check` tells of the mesh"
        }
        NoCurvature::Undetermined
        | NoCurvature::NotFinite
        | NoCurvature::Unused
        | NoCurvature::NotASurface
        | NoCurvature::Folded => "`trueness check` tells what is wrong with a mesh",
    };
    let shares: Vec<String> = reasons
        .iter()
        .map(|(reason, count)| format!("{count} {}", reason.name().replace('_', " ")))
        .collect();
    format!("no place has a curvature ({}); {remedy}", shares.join(", "))
}

/// The words for the reasons in files; the first is of those that have a value.
fn reasons() -> Vec<&'static str> {
    [""].into_iter().chain(NoCurvature::ALL.map(NoCurvature::name)).collect()
}

fn write(
    path: &std::path::Path,
    mesh: &Mesh,
    found: &Curvatures,
    document: &CurvatureDocument,
    kind: CurvatureKind,
) -> anyhow::Result<()> {
    let scale = &document.quantity(kind).scale;
    let row = |i: usize| -> [f64; 17] {
        let Ok(jet) = &found.places[i] else { return [f64::NAN; 17] };
        let [first, second] = jet.bend.principal;
        let ([a, b, c], [d, e, f], [g, h, j]) = (jet.bend.normal, first.direction, second.direction);
        [
            a,
            b,
            c,
            first.curvature,
            second.curvature,
            jet.bend.mean,
            jet.bend.gaussian,
            d,
            e,
            f,
            g,
            h,
            j,
            jet.uncertainty,
            jet.residual,
            jet.condition,
            f64::from(jet.neighbors),
        ]
    };
    let code = |i: usize| {
        let place = |why: &curvature::NoCurvature| NoCurvature::ALL.iter().position(|r| *r == *why.word());
        found.places[i].as_ref().err().and_then(place).map_or(0, |n| n as u8 + 1)
    };
    let color =
        |i: usize| scale.color(found.places[i].as_ref().map_or(f64::NAN, |jet| value(kind, &jet.bend)));
    let columns = Values {
        names: [
            "nx",
            "ny",
            "nz",
            "k1",
            "k2",
            "mean",
            "gaussian",
            "k1_x",
            "k1_y",
            "k1_z",
            "k2_x",
            "k2_y",
            "k2_z",
            "uncertainty",
            "residual",
            "condition",
            "neighbors",
        ],
        of: &row,
        reason: &code,
        reasons: &reasons(),
        color: &color,
    };
    Ok(values(path, &mesh.positions, &mesh.faces, &columns)?)
}
