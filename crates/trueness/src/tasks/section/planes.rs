//! Planes that cut a mesh or a cloud.

use super::found::{Found, described};
use super::request::SectionRequest;
use crate::task::{TaskError, above_zero};
use trueness_document::InputRecord;
use trueness_document::section::PlaneRecord;
use trueness_geom::mesh::Mesh;
use trueness_geom::noise::Noise;
use trueness_geom::parallel::prelude::*;
use trueness_geom::plane::{Plane, PlaneFrame};
use trueness_geom::progress::Progress;
use trueness_geom::space::{Point, dot};
use trueness_measure::section::Section;
use trueness_section::{self as section, Chain, Contour, Options, Order, Ordered, SectionError};

/// Most planes of a stack.
const MAX_PLANES_OF_STACK: f64 = 100_000.0;

/// How points are taken to lie on a plane.
pub struct Slab {
    thickness: f64,
    gap: Option<f64>,
}

/// A plane with a normal of length 1, and its frame.
pub struct Cut {
    plane: Plane,
    frame: PlaneFrame,
}

impl SectionRequest {
    /// The planes in the order of the options: each `--plane`, then each `--stack`.
    pub(super) fn planes(&self) -> Result<Vec<Cut>, TaskError> {
        let mut all = vec![];
        for plane @ [x, y, z, d] in &self.plane {
            all.push(cut([*x, *y, *z], *d).map_err(|why| refused("plane", plane, why))?);
        }
        for stack @ [x, y, z, from, to, step] in &self.stack {
            let count = ((to - from) / step + 1e-9).floor();
            if !(0.0..MAX_PLANES_OF_STACK).contains(&count) {
                let why = format!(
                    "the step must lead from the first distance to the last in less than {MAX_PLANES_OF_STACK} steps"
                );
                return Err(refused("stack", stack, why));
            }
            for k in 0..=count as u32 {
                let found = cut([*x, *y, *z], from + f64::from(k) * step);
                all.push(found.map_err(|why| refused("stack", stack, why))?);
            }
        }
        Ok(all)
    }

    /// Refuses what makes no sense for a mesh.
    pub(super) fn fit_a_mesh(&self, shown: &str) -> Result<(), TaskError> {
        if self.plane.is_empty() && self.stack.is_empty() {
            return Err(TaskError::usage(format!(
                "{shown}: it is a mesh; say where to cut it: --plane nx,ny,nz,d or --stack nx,ny,nz,from,to,step"
            )));
        }
        self.without_slab(&format!("{shown}: it is a mesh; "), "clouds of points")
    }

    /// Refuses what makes no sense for points in order.
    pub(super) fn fit_a_row(&self) -> Result<(), TaskError> {
        self.without_slab("", "clouds of points, with --plane or --stack")
    }

    /// Refuses what only clouds have.
    fn without_slab(&self, why: &str, whose: &str) -> Result<(), TaskError> {
        let given = [("thickness", self.thickness), ("gap", self.gap)];
        match given.iter().find(|(_, given)| given.is_some()) {
            Some((name, _)) => Err(TaskError::usage(format!("{why}--{name} is for {whose}"))),
            None => Ok(()),
        }
    }

    /// How the points of a cloud are taken.
    pub(super) fn slab(&self, shown: &str, planar: bool) -> Result<Slab, TaskError> {
        if planar {
            return Err(TaskError::usage(format!(
                "{shown}: its points have two coordinates; leave --plane and --stack out"
            )));
        }
        let Some(thickness) = self.thickness else {
            return Err(TaskError::usage(format!(
                "{shown}: it holds points without facets; say with --thickness how far from the plane they count"
            )));
        };
        let gap = self.gap.map(|g| above_zero("gap", g)).transpose()?;
        Ok(Slab { thickness: above_zero("thickness", thickness)?, gap })
    }

    /// Tells of a `--gap` that is too small for points so far apart: contours go on over a larger one.
    pub(super) fn tell_raised_gap(&self, planes: &mut [PlaneRecord]) {
        let Some(given) = self.gap else { return };
        for plane in planes {
            let Some(gap) = plane.gap.filter(|gap| *gap > given * (1.0 + 1e-9)) else { continue };
            let own = format!("points lie too far apart for --gap {given}: contours go on over {gap:.4}");
            plane.hint = Some(plane.hint.take().map_or(own.clone(), |hint| format!("{own}; {hint}")));
        }
    }
}

/// The plane at a distance from the origin, or why there is none.
fn cut(normal: [f64; 3], distance: f64) -> Result<Cut, &'static str> {
    if !distance.is_finite() {
        return Err("a distance from the origin is a finite number of mm");
    }
    let unit = trueness_geom::space::unit(normal);
    let plane = unit.map(|(normal, _)| Plane { normal, offset: distance });
    let found = plane.and_then(|plane| Some(Cut { plane, frame: plane.frame()? }));
    found.ok_or("the normal has no direction; give one that is not 0")
}

/// An option of several numbers that is refused.
fn refused(option: &str, numbers: &[f64], why: impl std::fmt::Display) -> TaskError {
    let written: Vec<String> = numbers.iter().map(f64::to_string).collect();
    TaskError::option(format!("{option} {}: {why}", written.join(",")))
}

/// A section and the rows of points that its contours were found in.
type WithRows = (Section, Vec<Vec<[f64; 2]>>);

/// What a mesh's facets are where planes cut it; `noise` is that of its vertices, if it is known.
pub fn mesh(
    mesh: &Mesh,
    noise: Option<Noise>,
    planes: &[Cut],
    options: &Options,
    progress: &dyn Progress,
) -> Result<Found, SectionError> {
    let cut_mesh = section::CutMesh::new(mesh, noise);
    let of = |cut: &Cut, facets: &[u32]| -> Result<WithRows, SectionError> {
        let chains = section::cut_facets(mesh, &cut.plane, facets, progress)?;
        let contours = chains
            .par_iter()
            .map(|chain| section::chain_contour(chain, &cut.frame, &cut_mesh, options, progress))
            .collect::<Result<Vec<Contour>, SectionError>>()?;
        let closed = chains.iter().all(|c| c.closed);
        let area = match closed {
            true => Ok(section::area(&chains, &cut.frame)),
            false => Err("a contour is open"),
        };
        let flat = |c: &Chain| c.points.iter().map(|p| cut.frame.flat(*p)).collect();
        let places = |(chain, found): (&Chain, &Contour)| match found.moved.is_empty() {
            true => flat(chain),
            false => found.moved.clone(),
        };
        let rows = chains.iter().zip(&contours).map(places).collect();
        Ok((cut.section(area, contours), rows))
    };
    let all: Vec<Plane> = planes.iter().map(|cut| cut.plane).collect();
    let mut found = vec![];
    section::facets_near::<SectionError>(mesh, &all, progress, |some| {
        found
            .extend(some.into_par_iter().map(|(k, facets)| (k, of(&planes[k], &facets))).collect::<Vec<_>>());
        Ok(())
    })?;
    found.sort_by_key(|(k, _)| *k);
    gather(found.into_iter().map(|(_, each)| each).collect())
}

/// Contours of a cloud's points near planes.
pub fn cloud(
    points: &[Point],
    planes: &[Cut],
    slab: &Slab,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Found, SectionError> {
    let of = |cut: &Cut| -> Result<WithRows, SectionError> {
        let (numbers, flat) = section::slab(points, &cut.plane, &cut.frame, slab.thickness);
        let Order { rows, gap, wider, fills_area } = section::order(&flat, slab.gap, progress)?;
        let contours = (rows.par_iter())
            .map(|row| section::ordered_contour(&flat, row, options, progress))
            .collect::<Result<Vec<Contour>, SectionError>>()?;
        let height = |i: &usize| dot(cut.plane.normal, points[numbers[*i]]) - cut.plane.offset;
        let heights = |row: &Ordered| row.numbers.iter().map(height).collect::<Vec<f64>>();
        let bent =
            rows.iter().zip(&contours).map(|(row, c)| section::bent_across(c, &heights(row))).collect();
        let own = rows.iter().map(|row| row.numbers.iter().map(|i| flat[*i]).collect()).collect();
        let loose = numbers.len() - rows.iter().map(|r| r.numbers.len()).sum::<usize>();
        let (gap, thickness) = (Some((gap, wider)), Some(slab.thickness));
        let found = cut.section(Err("points have no facets"), contours);
        Ok((Section { loose, gap, thickness, bent, fills_area, ..found }, own))
    };
    gather(planes.par_iter().map(of).collect())
}

fn gather(each: Vec<Result<WithRows, SectionError>>) -> Result<Found, SectionError> {
    let (mut sections, mut rows) = (vec![], vec![]);
    for one in each {
        let (section, own) = one?;
        sections.push(section);
        rows.extend(own);
    }
    Ok(Found { sections, rows, methods: None })
}

impl Cut {
    /// The plane.
    pub fn plane(&self) -> Plane {
        self.plane
    }

    /// What was found in the plane, but for what only a cloud has.
    fn section(&self, area: Result<f64, &'static str>, contours: Vec<Contour>) -> Section {
        let plane = Some((self.plane.normal, self.plane.offset));
        Section::new(described(&self.frame, 0.0), plane, area, contours)
    }
}

/// Why there is no contour: where the planes are, and where the part is.
pub fn nothing_met(planes: &[Cut], sections: &[Section], record: &InputRecord) -> String {
    let loose: usize = sections.iter().map(|s| s.loose).sum();
    if sections.iter().any(|s| s.fills_area) {
        return format!("{loose} points: {}", Section::FILLS_AREA);
    }
    if loose > 0 {
        let slab = if planes.len() == 1 { "the slab holds" } else { "the slabs hold" };
        return format!(
            "{slab} {loose} points, too few in a row for a contour; a larger --thickness may help"
        );
    }
    let which =
        if planes.len() == 1 { "the plane does not meet the part" } else { "no plane meets the part" };
    format!("{which}{}", reach(&planes[0].plane, record))
}

/// From where to where a mesh or cloud reaches along the normal of the first plane, and what that means; empty where nobody knows.
pub fn reach(plane: &Plane, record: &InputRecord) -> String {
    let (Some(bounds), normal) = (record.bounds.as_ref(), plane.normal) else { return String::new() };
    let mut range = [0.0; 2];
    for (k, along) in normal.into_iter().enumerate() {
        let ends = [along * bounds.min[k], along * bounds.max[k]];
        range[0] += ends[0].min(ends[1]);
        range[1] += ends[0].max(ends[1]);
    }
    let [low, high] = range.map(|x| (x * 1e4).round() / 1e4 + 0.0);
    let remedy = match ((range[0]..=range[1]).contains(&plane.offset), record.facets) {
        (false, _) => "",
        (true, None | Some(0)) => "; no points lie within the slab: a larger --thickness may help",
        (true, Some(_)) => {
            "; where a plane only touches the part, or lies in a face of it, there is no section: move it inwards"
        }
    };
    // Across the axes no more is known than the box around all.
    let is_along_an_axis = normal.iter().filter(|x| **x != 0.0).count() == 1;
    let (what, to) = if is_along_an_axis { ("it reaches from", "to") } else { ("it lies between", "and") };
    format!(
        "; along the first normal {what} {low} {to} {high} mm, and the first plane lies at {}{remedy}",
        plane.offset
    )
}
