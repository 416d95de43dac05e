//! The nominal that a section is compared with.

use super::found::Sections;
use super::planes::Cut;
use crate::exit::Usage;
use crate::options::{PointInputArgs, ReferenceArgs};
use crate::progress::Stage;
use crate::read::{self, Body, Opened};
use clap::Args;
use std::path::PathBuf;
use trueness_geom::mesh::Mesh;
use trueness_geom::section::{self, Options, Outline, Plane, PlaneFrame};
use trueness_geom::space::{Point, dot};
use trueness_inspect::results::section::{Against, NominalRecord, Section};
use trueness_inspect::results::{InputRecord, Role};

/// What the section should be.
#[derive(Args, Debug)]
#[command(next_help_heading = "Nominal")]
pub struct NominalArgs {
    /// Compare the points with the section of this nominal: a mesh, cut by the same planes (or by the plane of the points), or
    /// points in order, of which the contour is found
    #[arg(long, value_name = "FILE")]
    pub nominal: Option<PathBuf>,
    #[command(flatten)]
    reading: ReferenceArgs,
}

/// What the nominal file held.
enum Nominal {
    Mesh(Mesh),
    /// Points in order, and whether they have two coordinates.
    Row(Vec<Point>, bool),
}

impl NominalArgs {
    /// How the points of the sections differ from the nominal, and what there is to say about its file; nothing where none was
    /// given.
    pub fn compare(
        &self,
        measured: &PointInputArgs,
        (sections, rows): &Sections,
        planes: &[Cut],
        options: &Options,
        stage: &Stage,
    ) -> anyhow::Result<Option<(NominalRecord, InputRecord)>> {
        let Some(path) = &self.nominal else { return Ok(None) };
        let shown = path.display();
        let Opened { mut record, body, planar, .. } =
            read::open(path, Role::Reference, &self.reading.reading(measured))?;
        let nominal = match body {
            Body::Mesh(source) => Nominal::Mesh(source.mesh),
            Body::Points(source) => {
                let points = read::all_points(path, source)?;
                read::describe(&mut record, &points);
                Nominal::Row(points, planar)
            }
        };
        read::hash(&mut record, path)?;
        let (mut all, mut closed, mut known) = (vec![], true, 0);
        let mut rows = rows.iter();
        for (n, section) in sections.iter().enumerate() {
            let outlines = match &nominal {
                Nominal::Mesh(mesh) => cut(mesh, section, planes.get(n), stage)?,
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
            known += outlines.len();
            closed &= outlines.iter().all(|o| o.closed);
            for points in rows.by_ref().take(section.contours.len()) {
                let found = section::off_nominal(points, &outlines, stage)?;
                all.push(Against { points, found, outlined: !outlines.is_empty() });
            }
        }
        if known == 0 {
            anyhow::bail!(
                "{shown}: no plane of the section meets it; bring part and nominal together with trueness align"
            );
        }
        let outline = if matches!(nominal, Nominal::Mesh(_)) { "facets" } else { "contour" };
        Ok(Some((NominalRecord::new(&record.path, outline, closed, &all), record)))
    }
}

/// Where the plane of a section cuts a mesh.
fn cut(mesh: &Mesh, section: &Section, own: Option<&Cut>, stage: &Stage) -> anyhow::Result<Vec<Outline>> {
    let frame = frame(section);
    let normal = frame.normal();
    let plane = own.map_or(Plane { normal, offset: dot(normal, frame.origin) }, |cut| cut.plane());
    let chains = section::cut(mesh, &plane, stage)?;
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

fn frame(section: &Section) -> PlaneFrame {
    PlaneFrame { origin: section.frame.origin, x: section.frame.x, y: section.frame.y }
}
