//! Principal, mean and Gaussian curvature of a mesh or cloud.

use crate::read::{self, Body, Opened};
use crate::task::{
    Done, Independence, Output, PointReading, Request, RunFiles, Scene, TaskError, Watch, choices, ended,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use trueness_document::Role;
use trueness_document::curvature::{CurvatureDocument, CurvatureKind, NoCurvature};
use trueness_files::Sources;
use trueness_files::write::{Values, Writable, values};
use trueness_geom::scan::Scan;
use trueness_measure::curvature::{document, noise, value, without};
use trueness_measure::words::ToWord;
use trueness_report::views::curvature::View;
use trueness_report::{Marks, ViewObject};
use trueness_surface::curvature::{self, CurvatureError, Curvatures, Options, Reach};

choices! {
    /// The curvature that a file is colored by.
    pub enum Color {
        Mean = "mean": "",
        Gaussian = "gaussian": "",
        K1 = "k1": "",
        K2 = "k2": "",
    }
}

impl From<Color> for CurvatureKind {
    fn from(color: Color) -> CurvatureKind {
        match color {
            Color::Mean => CurvatureKind::Mean,
            Color::Gaussian => CurvatureKind::Gaussian,
            Color::K1 => CurvatureKind::K1,
            Color::K2 => CurvatureKind::K2,
        }
    }
}

/// What is asked of the curvatures of a mesh or cloud.
///
/// ```
/// use trueness::task::Request;
/// use trueness::{files::FileSources, geom::progress::Silent, tasks::curvature::CurvatureRequest};
/// let request =
///     CurvatureRequest { input: "../../corpus/bunny/zipper_res4.ply".into(), ..CurvatureRequest::default() };
/// let done = request.run(&FileSources, &Silent)?;
/// assert_eq!((done.document.degree, done.document.total), (3, 453));
/// # Ok::<(), trueness::task::TaskError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct CurvatureRequest {
    /// A mesh, or points.
    pub input: PathBuf,
    /// Degree of the polynomials, from 2 to 6.
    pub degree: usize,
    /// Fewest neighbors: whole rings of a mesh, the nearest ones of a cloud; without it 3 for each unknown, 30 of degree 3.
    pub neighbors: Option<usize>,
    /// All neighbors within this distance, mm, in place of a number of them: curvature at a scale of one's own.
    pub radius: Option<f64>,
    /// Places on a boundary have values too, from the one side that there is.
    pub boundary: bool,
    /// How far neighbors share errors.
    #[serde(flatten)]
    pub noise: Independence,
    /// How the input is taken.
    #[serde(flatten)]
    pub reading: PointReading,
    /// Where to write the vertices or points with their curvatures.
    pub out: Option<PathBuf>,
    /// The curvature that a `.ply` file of `out` is colored by.
    pub color: Color,
    /// Seed of everything random.
    pub seed: u64,
    /// Keep what a report draws.
    pub view: bool,
}

impl Default for CurvatureRequest {
    fn default() -> CurvatureRequest {
        CurvatureRequest {
            input: PathBuf::new(),
            degree: 3,
            neighbors: None,
            radius: None,
            boundary: false,
            noise: Independence::default(),
            reading: PointReading::default(),
            out: None,
            color: Color::Mean,
            seed: 0,
            view: false,
        }
    }
}

impl CurvatureRequest {
    fn options(&self) -> Result<Options, TaskError> {
        let reach = match (self.neighbors, self.radius) {
            (Some(_), Some(_)) => {
                return Err(TaskError::usage(
                    "--neighbors and --radius are two ways to say what a neighborhood is; leave one of the two out",
                ));
            }
            (None, Some(radius)) => Reach::Radius(radius),
            (Some(count), None) => Reach::Count(count),
            (None, None) => Reach::Auto,
        };
        Ok(Options { degree: self.degree, reach, boundary: self.boundary, noise: None })
    }
}

impl Request for CurvatureRequest {
    type Document = CurvatureDocument;
    const COMMAND: &'static str = "curvature";

    fn files(&self, _: &dyn Sources) -> Result<RunFiles, TaskError> {
        Ok(RunFiles::of([&self.input]).out(self.out.as_ref(), Writable::Values))
    }

    fn answer(&self, sources: &dyn Sources, watch: &dyn Watch) -> Result<Done<CurvatureDocument>, TaskError> {
        let mut options = self.options()?;
        let shown = self.input.display();
        let Opened { mut record, body, planar, .. } =
            read::open(sources, &self.input, Role::Measured, &self.reading.options())?;
        if planar {
            return Err(TaskError::usage(format!("{shown}: it has two columns; curvatures need x, y and z")));
        }
        let scan = match body {
            Body::Mesh(source) => Scan::Mesh(source.mesh),
            Body::Points(source) => Scan::Cloud(read::all_points(&self.input, source, &mut record)?),
        };
        read::describe(&mut record, scan.points());
        let noise = self.noise.shared_noise(watch, |stage| noise(&scan, self.seed, stage))?;
        options.noise = noise.as_ref().ok().copied();
        let stage = watch.stage("fitting", "places", Some(scan.points().len() as u64));
        let (hash, found) = rayon::join(
            || read::hash(sources, &mut record, &self.input),
            || match &scan {
                Scan::Mesh(mesh) => curvature::mesh(mesh, &options, &*stage),
                Scan::Cloud(points) => curvature::cloud(points, &options, &*stage),
            },
        );
        let found = ended(stage, found);
        hash?;
        let found = found.map_err(|e| match e {
            CurvatureError::Cancelled(e) => e.into(),
            e
            @ (CurvatureError::Degree(_) | CurvatureError::Neighbors { .. } | CurvatureError::Radius(_)) => {
                TaskError::option(e)
            }
            e => TaskError::unanswerable(format!("{shown}: {e}")),
        })?;
        let document = document(&found, &scan, &options, &noise, vec![record]).ok_or_else(|| {
            TaskError::unanswerable(format!("{shown}: {}", explain_missing(&found, &scan, options.reach)))
        })?;
        let write = |path: &PathBuf| write(path, &scan, &found, &document, self.color.into());
        let output = self.out.as_ref().map(write).transpose()?;
        let scene = self.view.then(|| Box::new(Curved { scan, found }) as Box<dyn Scene<CurvatureDocument>>);
        Ok(Done { scene, outputs: output.into_iter().collect(), ..Done::new(document) })
    }
}

/// The places with their curvatures.
struct Curved {
    scan: Scan,
    found: Curvatures,
}

impl Scene<CurvatureDocument> for Curved {
    fn draw(
        &self,
        document: &CurvatureDocument,
        page: &mut dyn FnMut(&[ViewObject], &[Marks]) -> Result<(), TaskError>,
    ) -> Result<(), TaskError> {
        let view = View::new(document, &document.inputs[0].path, &self.scan, &self.found);
        page(&view.objects(), &[])
    }
}

/// Why there is not a single value, and what to do.
fn explain_missing(found: &Curvatures, scan: &Scan, reach: Reach) -> String {
    let reasons = without(found);
    let Some((most, _)) = reasons.iter().max_by_key(|(_, count)| **count) else {
        return "it holds nothing that could have a curvature".into();
    };
    let wide = matches!(reach, Reach::Radius(_));
    let remedy = match **most {
        NoCurvature::Boundary => "--boundary gives them values from one side",
        NoCurvature::FewNeighbors if wide => "give a larger --radius, or a smaller --degree",
        NoCurvature::FewNeighbors => "give a smaller --degree or --neighbors",
        NoCurvature::Undetermined if matches!(scan, Scan::Cloud(_)) => {
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

/// Writes the places with their curvatures.
fn write(
    path: &Path,
    scan: &Scan,
    found: &Curvatures,
    document: &CurvatureDocument,
    kind: CurvatureKind,
) -> Result<Output, TaskError> {
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
    Ok(Output::file(path, values(path, scan.points(), scan.facets(), &columns)?))
}
