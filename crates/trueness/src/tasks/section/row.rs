//! The contour of points in order, and the methods of a paper for the join of one line and one curve.

use super::found::{Found, Methods, described};
use super::request::{Interval, SectionRequest};
use crate::task::TaskError;
use trueness_geom::plane::PlaneFrame;
use trueness_geom::progress::Progress;
use trueness_geom::space::Point;
use trueness_measure::section::Section;
use trueness_section::{self as section, Options, SectionError, SegmentKind};

/// A row in space in the plane nearest to it; a row of two columns as it is. Its contour is that of the method asked for, if one was.
pub fn row(
    request: &SectionRequest,
    (points, planar): (&[Point], bool),
    options: &Options,
    progress: &dyn Progress,
) -> Result<Found, SectionError> {
    let through = if planar { None } else { PlaneFrame::through(points) };
    let (frame, flatness) = through.unwrap_or_default();
    let flat: Vec<[f64; 2]> = points.iter().map(|p| frame.flat(*p)).collect();
    let contours = vec![section::contour(&flat, options, progress)?];
    let found =
        Section::new(described(&frame, flatness), None, Err("points in order have no facets"), contours);
    let found = Found { sections: vec![found], rows: vec![flat], methods: None };
    by_method(request, found, options, progress)
}

/// Refuses the methods where there is no row of points in order.
pub fn no_method(request: &SectionRequest) -> Result<(), TaskError> {
    match request.method() {
        None => Ok(()),
        Some(_) => {
            Err(TaskError::usage("--search and --interval paper are for points in order, not for planes"))
        }
    }
}

/// The contour of the method asked for in place of that found.
fn by_method(
    request: &SectionRequest,
    mut all: Found,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Found, SectionError> {
    let (Some(chosen), Some(points)) = (request.method(), all.rows.first()) else { return Ok(all) };
    let Some(found) = all.sections.first_mut().and_then(|s| s.contours.first_mut()) else { return Ok(all) };
    let first = found.segments.first().is_some_and(|s| s.geometry.kind() == SegmentKind::Line);
    let join = if first { found.joins.first() } else { found.joins.last() };
    let interval = join.filter(|_| request.interval == Interval::Profile).map(|j| j.interval);
    let (methods, reversed) = section::line_and_curve(points, found, interval, progress)?;
    let kept = points.len() - found.outliers.len() - found.repeated.len();
    if let Some(method) = methods.iter().find(|m| m.search == chosen) {
        *found = section::method_contour(points, found, method, reversed, options);
    }
    let table = methods.into_iter().map(|m| (kept - m.on_line, m));
    let table = table.map(|(on_curve, m)| (m, on_curve)).collect();
    // Where the likelihood found no join, the paper's rule stands in.
    let interval = if interval.is_some() { "profile" } else { "paper" };
    all.methods = Some(Methods { chosen, interval, table });
    Ok(all)
}
