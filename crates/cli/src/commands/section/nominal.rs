//! The nominal that a section is compared with.

use super::faced::faced;
use super::found::Sections;
use super::layers::Layers;
use super::planes::{self, Cut};
use crate::exit::Usage;
use crate::options::{PointInputArgs, ReferenceArgs};
use crate::progress::Stage;
use crate::read::{self, Body, Opened};
use crate::tolerance::ToleranceArg;
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};
use trueness_document::compare::Warning;
use trueness_document::section::{NominalRecord, NominalWarning, ProfileRule};
use trueness_document::tolerance::cannot_fail;
use trueness_document::{InputRecord, of_percent};
use trueness_files::ReadOptions;
use trueness_files::drawing::{Drawing, Drawn};
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Cancelled;
use trueness_geom::section::{
    self, Contour, Freedom, OntoNominal, OntoNominalError, Options, Outline, Plane, PlaneFrame, Segment,
};
use trueness_geom::space::{Aabb, Point, dot};
use trueness_measure::compare::{MIN_COVERAGE, plausibility};
use trueness_measure::section::{Against, AgainstPlane, Section};

/// What the section should be.
#[derive(Args, Debug)]
#[command(next_help_heading = "Nominal")]
pub struct NominalArgs {
    /// Compare the points with the section of this nominal: a mesh, cut by the same planes (or by the plane of the points), a DXF
    /// drawing in the plane's coordinates, or points in order, of which the contour is found
    #[arg(long, value_name = "FILE")]
    pub nominal: Option<PathBuf>,
    /// Bring the section nearest to the nominal first, within its plane, by least squares [default: none, it stays where it is]
    #[arg(long, value_enum, value_name = "WAY", requires = "nominal")]
    fit: Option<FitArg>,
    /// Allowed deviation of the profile: T for ±T (a zone of the width 2 T, even about the nominal: write half of the profile
    /// tolerance of a drawing), or -L,+U with both signs; the exit status is then the verdict
    #[arg(long, value_name = "T | -L,+U", allow_hyphen_values = true, requires = "nominal")]
    tolerance: Option<ToleranceArg>,
    /// Share of the points that must lie within the tolerance, in percent
    #[arg(
        long,
        value_name = "PERCENT",
        default_value = "100",
        requires = "tolerance",
        allow_hyphen_values = true
    )]
    inside: f64,
    /// Share of the nominal's length that must be measured for a pass, and of the points that must have a counterpart on it, in
    /// percent as --inside; 0: a part of it is measured on purpose. Where it is less, what does not fail is undecided
    #[arg(
        long,
        value_name = "PERCENT",
        default_value_t = 100.0 * MIN_COVERAGE,
        requires = "tolerance",
        allow_hyphen_values = true
    )]
    min_coverage: f64,
    /// Exclude (and count) points farther from the nominal than this, mm; the best fit does not look at them either
    #[arg(long, value_name = "MM", requires = "nominal", allow_hyphen_values = true)]
    max_distance: Option<f64>,
    #[command(flatten)]
    reading: ReferenceArgs,
}

/// What of a section may move for the best fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum FitArg {
    /// Shifts along both axes and a turn.
    Free,
    /// Shifts along both axes.
    Xy,
    /// A shift along the first axis.
    X,
    /// A shift along the second axis.
    Y,
    /// A turn about the origin of the plane's axes.
    Turn,
    /// Nothing.
    None,
}

impl FitArg {
    /// Its name and what may move.
    fn freedom(self) -> Option<(&'static str, Freedom)> {
        match self {
            FitArg::Free => Some(("free", Freedom::FREE)),
            FitArg::Xy => Some(("xy", Freedom::SHIFT)),
            FitArg::X => Some(("x", Freedom::X)),
            FitArg::Y => Some(("y", Freedom::Y)),
            FitArg::Turn => Some(("turn", Freedom::TURN)),
            FitArg::None => None,
        }
    }
}

/// What the nominal file held.
enum Nominal {
    Mesh(Mesh),
    /// Points in order, and whether they have two coordinates.
    Row(Vec<Point>, bool),
    Drawing(Drawing),
}

/// Ends of drawn entities that are this share of the drawing apart are one; rational curves are followed within this share of their own size.
const SHARE: f64 = 1e-6;

impl NominalArgs {
    /// What the profile must keep, if anything, and from what distance on points do not count.
    pub fn rule(&self) -> Result<(Option<ProfileRule>, f64), Usage> {
        if self.nominal.is_none() {
            self.reading.without_reference("--nominal")?;
        }
        let share = |name: &str, written: f64| {
            of_percent(written).map_err(|what| Usage(format!("{name} {written}: {what}")))
        };
        let max_distance = self.max_distance.unwrap_or(f64::INFINITY);
        if self.max_distance.is_some_and(|d| !(d > 0.0 && d.is_finite())) {
            return Err(Usage(format!(
                "--max-distance {max_distance}: a distance is a finite number of mm above 0; without the option there is no limit"
            )));
        }
        let Some(ToleranceArg(tolerance)) = self.tolerance else { return Ok((None, max_distance)) };
        if let Some(why) = cannot_fail(max_distance, std::iter::once(tolerance)) {
            return Err(Usage(format!("--max-distance {max_distance}: {why}")));
        }
        let rule = ProfileRule {
            tolerance,
            required_share: share("--inside", self.inside)?,
            min_coverage: share("--min-coverage", self.min_coverage)?,
        };
        Ok((Some(rule), max_distance))
    }

    /// How the points of the sections differ from the nominal, and what there is to say about its file; nothing where none was
    /// given.
    pub fn compare<'a>(
        &self,
        measured: &PointInputArgs,
        (sections, rows): &'a Sections,
        planes: &[Cut],
        options: &Options,
        stage: &Stage,
    ) -> anyhow::Result<Option<(NominalRecord, InputRecord)>> {
        let Some(path) = &self.nominal else { return Ok(None) };
        let shown = path.display();
        let (nominal, mut record) = open(path, &self.reading.reading(measured), stage)?;
        read::hash(&mut record, path)?;
        let layers = match &nominal {
            Nominal::Drawing(drawing) => Layers::of(drawing, sections.len(), &shown.to_string())?,
            _ => Layers::default(),
        };
        let (rule, max_distance) = self.rule()?;
        let freedom = self.fit.and_then(FitArg::freedom);
        let (mut all, mut fits) = (vec![], vec![]);
        let mut rows = rows.iter();
        for (n, section) in sections.iter().enumerate() {
            let outlines = match &nominal {
                Nominal::Mesh(mesh) => cut(mesh, section, planes.get(n), stage)?,
                Nominal::Drawing(drawing) => {
                    let what = drawn(drawing, layers.own(n).as_deref(), &shown.to_string());
                    what.map_err(|e| with_passed_over(e, &record))?
                }
                Nominal::Row(..) if sections.len() > 1 => {
                    return Err(Usage(format!(
                        "--nominal {shown}: it holds points in order, which are of one plane; give one --plane, or a mesh"
                    ))
                    .into());
                }
                Nominal::Row(points, planar) => match contour(points, *planar, section, options, stage) {
                    Ok(outlines) => outlines,
                    Err(section::SectionError::Cancelled(e)) => return Err(e.into()),
                    Err(e) => anyhow::bail!("{shown}: {e}"),
                },
            };
            if !matches!(nominal, Nominal::Mesh(_)) {
                refuse_crossings(&outlines, &shown.to_string(), stage)?;
            }
            let own: Vec<&'a Vec<[f64; 2]>> = rows.by_ref().take(section.contours.len()).collect();
            let plane = section.plane.map(|_| n as u64);
            let mut outlines = outlines;
            if let Some(freedom) = freedom.filter(|_| !outlines.is_empty() && !own.is_empty()) {
                let found = onto(&own, &outlines, freedom.1, max_distance, stage);
                let found = found.map_err(|e| with_place(e, &shown.to_string(), plane))?;
                // Coordinates stay those of the section.
                let back = found.motion.inverse();
                outlines = outlines.iter().map(|o| o.moved(&back)).collect();
                fits.push(trueness_measure::section::fit_record(plane, freedom, &found));
            }
            let contours = (own.into_iter().zip(&section.contours))
                .map(|(points, contour)| against(points, contour, &outlines, max_distance, stage))
                .collect::<Result<_, _>>()?;
            all.push(AgainstPlane { plane, outlines, contours });
        }
        if all.iter().all(|plane| plane.outlines.is_empty()) {
            let first = sections.first().map(|section| plane_of(section, planes.first()));
            let reach = first.map_or(String::new(), |plane| planes::reach(&plane, &record));
            anyhow::bail!(
                "{shown}: no plane of the section meets it{reach}; bring part and nominal together with trueness align, or say its unit \
                 with --reference-units"
            );
        }
        let outline = match nominal {
            Nominal::Mesh(_) => "facets",
            Nominal::Row(..) => "contour",
            Nominal::Drawing(_) => "drawing",
        };
        let unlikely = unlikely(sections, &all).into_iter().map(NominalWarning::from);
        let mut found = trueness_measure::section::nominal(&record.path, outline, all);
        found.warnings.splice(0..0, unlikely.chain(layers.passed_over));
        found.fits = fits;
        if let Some(rule) = rule {
            found.judge(&rule, &record);
        }
        Ok(Some((found, record)))
    }
}

/// The points of a contour against outlines; those farther than `max_distance` are left out.
fn against<'a>(
    points: &'a [[f64; 2]],
    contour: &'a Contour,
    outlines: &[Outline],
    max_distance: f64,
    stage: &Stage,
) -> Result<Against<'a>, Cancelled> {
    let mut found = section::off_nominal(points, outlines, stage)?;
    let mut far = 0;
    for off in &mut found {
        if off.is_some_and(|o| o.deviation.abs() > max_distance) {
            (*off, far) = (None, far + 1);
        }
    }
    Ok(Against { points, found, far, contour })
}

/// The best fit of a plane's points.
fn onto(
    rows: &[&Vec<[f64; 2]>],
    outlines: &[Outline],
    freedom: Freedom,
    max_distance: f64,
    stage: &Stage,
) -> Result<OntoNominal, OntoNominalError> {
    let points: Vec<&[[f64; 2]]> = rows.iter().map(|r| &r[..]).collect();
    section::onto_nominal(&points, outlines, freedom, max_distance, stage)
}

/// Why there is no best fit, with the file and the plane.
fn with_place(e: OntoNominalError, shown: &str, plane: Option<u64>) -> anyhow::Error {
    match e {
        OntoNominalError::Cancelled(e) => e.into(),
        e => anyhow::anyhow!(
            "{shown}: --fit{}: {e}",
            plane.map_or(String::new(), |n| format!(" in plane {}", n + 1))
        ),
    }
}

/// What makes it unlikely that part and nominal belong together: sizes as of another unit, boxes that lie apart.
fn unlikely(sections: &[Section], all: &[AgainstPlane]) -> Vec<Warning> {
    let (mut measured, mut nominal) = (vec![], vec![]);
    // What one of them alone has in a plane tells nothing.
    let both = |(_, p): &(&Section, &AgainstPlane)| !p.outlines.is_empty() && !p.contours.is_empty();
    for (section, plane) in sections.iter().zip(all).filter(both) {
        measured.extend(plane.contours.iter().flat_map(|c| c.points).map(|p| section.frame.place(*p)));
        for corners in plane.outlines.iter().filter_map(Outline::bounds) {
            let corner = |[i, j]: [usize; 2]| section.frame.place([corners[i][0], corners[j][1]]);
            nominal.extend([[0, 0], [0, 1], [1, 0], [1, 1]].map(corner));
        }
    }
    let [measured, nominal] = [measured, nominal].map(|places| trueness_measure::bounds(&Aabb::of(&places)));
    match (measured, nominal) {
        (Some(m), Some(n)) => plausibility::warnings(&m, &n, "--units, --reference-units"),
        _ => vec![],
    }
}

/// What the file of a nominal holds.
fn open(path: &Path, reading: &ReadOptions, stage: &Stage) -> anyhow::Result<(Nominal, InputRecord)> {
    let Opened { mut record, body, planar, .. } = match read::nominal(path, reading)? {
        Ok((drawing, record)) => return Ok((Nominal::Drawing(drawing), record)),
        Err(opened) => opened,
    };
    let nominal = match body {
        Body::Mesh(source) => Nominal::Mesh(faced(&source.mesh, &mut record, stage)?),
        Body::Points(source) => {
            let points = read::all_points(path, source)?;
            read::describe(&mut record, &points);
            Nominal::Row(points, planar)
        }
    };
    Ok((nominal, record))
}

/// The outlines of a drawing, of all of it or of the plane's own layer.
fn drawn(drawing: &Drawing, own: Option<&str>, shown: &str) -> anyhow::Result<Vec<Outline>> {
    let kept = drawing.entities.iter().filter(|e| own.is_none_or(|own| *own == e.layer));
    let mut segments = vec![];
    for entity in kept {
        segments.push(match &entity.drawn {
            Drawn::Line { start, end } => Segment::straight(*start, *end),
            Drawn::Arc { center, radius, start, sweep } => Segment::arc(*center, *radius, *start, *sweep),
            Drawn::Spline(curve) => match Segment::curve(curve, SHARE * entity.drawn.size()) {
                Some(segment) => segment,
                None => anyhow::bail!("{shown}: a rational spline of it has no finite place; draw it anew"),
            },
        });
    }
    if segments.is_empty() && own.is_none() {
        anyhow::bail!(
            "{shown}: it holds neither lines nor arcs nor splines that are read: there is no nominal"
        );
    }
    Ok(section::with_material_inside(section::joined(segments, SHARE * drawing.size())))
}

/// The same error, with what of the drawing was passed over.
fn with_passed_over(e: anyhow::Error, record: &InputRecord) -> anyhow::Error {
    let Some(told) = record.warnings.iter().find(|w| w.contains("passed over")) else { return e };
    let explode = if told.contains(" INSERT") { "; explode its blocks (INSERT)" } else { "" };
    anyhow::anyhow!("{e}; {told}{explode}")
}

/// Refuses closed outlines that cross themselves: no side of them is outside.
fn refuse_crossings(outlines: &[Outline], shown: &str, stage: &Stage) -> anyhow::Result<()> {
    for outline in outlines.iter().filter(|o| o.closed) {
        if let [[x, y], ..] = section::crossings(&outline.segments, true, stage)?[..] {
            anyhow::bail!(
                "{shown}: its outline crosses itself at ({x:.4}, {y:.4}): no side of it is outside of the material; mend it"
            );
        }
    }
    Ok(())
}

/// Where the plane of a section cuts a mesh.
fn cut(mesh: &Mesh, section: &Section, own: Option<&Cut>, stage: &Stage) -> anyhow::Result<Vec<Outline>> {
    let frame = frame(section);
    let chains = section::cut(mesh, &plane_of(section, own), stage)?;
    let flat = |chain: &section::Chain| chain.points.iter().map(|p| frame.flat(*p)).collect::<Vec<_>>();
    Ok(chains.iter().map(|chain| Outline::polyline(&flat(chain), chain.closed)).collect())
}

/// The contour of a row of points, which is the outer one if it is closed.
fn contour(
    points: &[Point],
    planar: bool,
    section: &Section,
    options: &Options,
    stage: &Stage,
) -> Result<Vec<Outline>, section::SectionError> {
    // Two columns are coordinates in the plane already.
    let frame = if planar { PlaneFrame::default() } else { frame(section) };
    let flat: Vec<[f64; 2]> = points.iter().map(|p| frame.flat(*p)).collect();
    let own = Options { level: options.level, ..Options::default() };
    let found = section::contour(&flat, &own, stage)?;
    Ok(section::with_material_inside(vec![Outline::of(&found)]))
}

/// The plane of a section: the one that it was cut by, or that of points in order.
fn plane_of(section: &Section, own: Option<&Cut>) -> Plane {
    let frame = frame(section);
    let normal = frame.normal();
    own.map_or(Plane { normal, offset: dot(normal, frame.origin) }, |cut| cut.plane())
}

fn frame(section: &Section) -> PlaneFrame {
    PlaneFrame { origin: section.frame.origin, x: section.frame.x, y: section.frame.y }
}
