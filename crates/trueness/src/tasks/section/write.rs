//! Drawings and tables of points of a section.

use super::request::SectionRequest;
use crate::task::{Output, TaskError};
use std::io::Write;
use trueness_document::section::{FrameRecord, NominalRecord};
use trueness_files::drawing::{self, Clamped, Entity, Layer};
use trueness_files::write::{Csv, LineEnd};
use trueness_geom::plane::PlaneFrame;
use trueness_measure::section::Section;
use trueness_section::{Geometry, Segment};

/// The files that were asked for, unfinished: of each section its contours, `rows`, the points of each contour, and their deviations from
/// the nominal, where there is one.
pub fn outputs(
    request: &SectionRequest,
    sections: &[Section],
    rows: &[Vec<[f64; 2]>],
    nominal: Option<&NominalRecord>,
) -> Result<Vec<Output>, TaskError> {
    let layers: Vec<Layer> = sections.iter().enumerate().map(|(n, s)| layer(n, s)).collect();
    let mut all = vec![];
    if let Some(path) = &request.dxf {
        all.push(Output::written(path, |file| drawing::dxf(file, &layers))?);
    }
    if let Some(path) = &request.svg {
        all.push(Output::written(path, |file| drawing::svg(file, &layers))?);
    }
    if let Some(path) = &request.step {
        all.push(Output::written(path, |file| drawing::step(file, &layers))?);
    }
    if let Some(path) = &request.iges {
        all.push(Output::written(path, |file| drawing::iges(file, &layers))?);
    }
    if let Some(path) = &request.out {
        all.push(Output::written(path, |file| points(file, sections, rows, nominal))?);
    }
    Ok(all)
}

/// The points of all contours, a row each.
fn points(
    file: &mut dyn Write,
    sections: &[Section],
    rows: &[Vec<[f64; 2]>],
    nominal: Option<&NominalRecord>,
) -> std::io::Result<()> {
    let mut text = vec![];
    let head = ["x", "y", "contour", "segment", "length", "distance"];
    Csv::at_end_of(&mut text, LineEnd::Lf).row(head.into_iter().chain(nominal.map(|_| "deviation")));
    let contours = sections.iter().flat_map(|s| &s.contours);
    for (n, (contour, row)) in contours.zip(rows).enumerate() {
        for (i, [x, y]) in row.iter().enumerate() {
            let mut csv = Csv::at_end_of(&mut text, LineEnd::Lf);
            csv.number(x).number(y).number(n + 1).number(contour.labels[i] + 1);
            csv.number(contour.stations[i]).number(contour.residuals[i]);
            if let Some(nominal) = nominal {
                csv.optional(nominal.deviations[n][i]);
            }
            csv.end_row();
            file.write_all(&text)?;
            text.clear();
        }
    }
    file.write_all(&text)
}

fn layer(number: usize, section: &Section) -> Layer {
    let entity = |segment: &Segment| match &segment.geometry {
        Geometry::Line => Entity::Line { start: segment.start, end: segment.end },
        Geometry::Arc { center, radius, start, sweep } => {
            Entity::Arc { center: *center, radius: *radius, start: *start, sweep: *sweep }
        }
        Geometry::Spline { curve, .. } => Entity::Spline(Clamped {
            degree: curve.knots().degree(),
            knots: curve.knots().values().to_vec(),
            points: curve.points().to_vec(),
        }),
    };
    let entities = section.contours.iter().flat_map(|c| &c.segments).map(entity).collect();
    let FrameRecord { origin, x, y, .. } = section.frame;
    Layer { name: format!("section-{}", number + 1), frame: PlaneFrame { origin, x, y }, entities }
}
