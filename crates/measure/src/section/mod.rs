//! From the contours of sections to the result document.

mod airfoil;
mod blade;
mod chord;
mod convert;
mod cut;
mod dimension;
mod doubts;
mod fitted;
mod found;
mod hints;
mod methods;
mod near_arc;
mod nominal;
mod outline;
mod segment;
mod tidy;

pub use airfoil::airfoils;
pub use convert::{curve, motion, outline};
pub use cut::cut_outline;
pub use fitted::fit_record;
pub use found::Section;
pub use nominal::nominal;
pub use outline::{Against, AgainstPlane, divided};

use crate::noise::{NoiseOrReason, record as noise_record};
use crate::words::ToWord;
use blade::Whereabouts;
use dimension::dimensions_record;
use methods::methods_record;
use segment::segment_record;
use trueness_document::section::{
    ContourRecord, FrameRecord, JoinRecord, PlaneRecord, SCHEMA, SectionDocument,
};
use trueness_document::{InputRecord, UNITS, VERSION};
use trueness_geom::progress::{Cancelled, Progress};
use trueness_section::{Contour, Method, Options, RowKind, Search, SegmentKind};

/// The document of what was found in the file of `inputs`.
pub fn document(sections: &[Section], inputs: Vec<InputRecord>, options: &Options) -> SectionDocument {
    let planes = sections.iter().filter_map(plane).collect();
    let contours = sections.iter().enumerate().flat_map(|(n, section)| {
        let number = section.plane.map(|_| n as u64);
        section.contours.iter().enumerate().map(move |(k, c)| {
            let bent = section.bent.get(k).map_or(&[][..], |bent| bent);
            ContourRecord {
                hints: hints::hints(section, c, bent, options),
                doubts: hints::doubts(c),
                ..contour(c, &section.frame, number)
            }
        })
    });
    SectionDocument {
        schema: SCHEMA.into(),
        version: VERSION.into(),
        units: UNITS.into(),
        inputs,
        level: options.level,
        noise_given: options.noise,
        shared_noise: None,
        shared_noise_reason: None,
        continuity_given: options.continuity.map(ToWord::word),
        frame: sections.first().map_or(FrameRecord::FLAT, |s| s.frame),
        planes,
        contours: contours.collect(),
        dimensions: dimensions_record(sections),
        airfoils: None,
        lean: None,
        nominal: None,
        methods: None,
    }
}

/// Adds the noise of the mesh's vertices, or why none is told; of contours that no scan's facets tell, nothing.
pub fn tell_noise(document: &mut SectionDocument, noise: Option<&NoiseOrReason>) {
    let of_scan = document.contours.iter().any(|c| c.taken.0 == RowKind::Scan.word().0);
    if let Some(noise) = noise.filter(|_| of_scan) {
        (document.shared_noise, document.shared_noise_reason) = noise_record(noise);
    }
}

/// The document with the offers for each contour, whose points are `rows`.
pub fn with_offers(
    mut document: SectionDocument,
    sections: &[Section],
    rows: &[Vec<[f64; 2]>],
) -> SectionDocument {
    for (contour, offers) in document.contours.iter_mut().zip(tidy::offers(sections, rows)) {
        match offers {
            Ok(offers) => contour.tidy = Some(offers),
            Err(reason) => contour.tidy_reason = Some(reason.reason().into()),
        }
    }
    document
}

/// The document with what the paper's methods found, each with its number of points of the curve.
pub fn with_methods(
    document: SectionDocument,
    chosen: Search,
    interval: &str,
    methods: &[(Method, usize)],
) -> SectionDocument {
    let methods = Some(methods_record(chosen, interval, methods));
    SectionDocument { methods, ..document }
}

/// The document with twist, offset and lean of its airfoils; `stacking` is the stacking point given, in the nominal's coordinates.
///
/// # Errors
/// [`Cancelled`], when asked to stop.
pub fn with_blades(
    mut document: SectionDocument,
    stacking: Option<[f64; 2]>,
    progress: &dyn Progress,
) -> Result<SectionDocument, Cancelled> {
    let places: Vec<Whereabouts> = document.contours.iter().map(|c| whereabouts(&document, c)).collect();
    if let Some(airfoils) = &mut document.airfoils {
        blade::against_nominal(airfoils, &places, document.nominal.as_ref(), stacking, progress)?;
        document.lean = blade::lean(airfoils, &places);
    }
    Ok(document)
}

fn whereabouts(document: &SectionDocument, contour: &ContourRecord) -> Whereabouts {
    let plane = contour.plane.and_then(|n| document.planes.get(n as usize));
    let ends = || contour.segments.iter().flat_map(|s| [s.start, s.end]);
    let middle = |k: usize| {
        let low = ends().map(|p| p[k]).fold(f64::INFINITY, f64::min);
        let high = ends().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max);
        0.5 * (low + high)
    };
    Whereabouts {
        plane: contour.plane,
        height: plane.map(|p| (p.normal, p.offset)),
        middle: [middle(0), middle(1)],
    }
}

fn plane(section: &Section) -> Option<PlaneRecord> {
    let (normal, offset) = section.plane?;
    Some(PlaneRecord {
        normal,
        offset,
        frame: section.frame,
        contours: section.contours.len() as u64,
        area: section.area.ok(),
        area_reason: section.area.err().map(Into::into),
        loose: section.loose as u64,
        gap: section.gap.map(|(gap, _)| gap),
        hint: hint(section),
        fills_area: section.fills_area,
    })
}

/// What may help where a cloud has no contours, or suspiciously many.
fn hint(section: &Section) -> Option<String> {
    if section.fills_area {
        return Some(Section::FILLS_AREA.into());
    }
    let (gap, wider) = section.gap?;
    let open = section.contours.iter().filter(|c| !c.closed).count();
    Some(format!(
        "{open} of {} contours are open and end near each other: points are missing over more than the gap of {}; \
         --gap {} lets most of them go on, a thicker slab (--thickness) brings points nearer together",
        section.contours.len(),
        hints::digits(gap),
        hints::digits(wider? * 1.05)
    ))
}

fn contour(found: &Contour, frame: &FrameRecord, plane: Option<u64>) -> ContourRecord {
    let numbers = |list: &[usize]| list.iter().map(|i| *i as u64).collect();
    let joins: Vec<JoinRecord> = found
        .joins
        .iter()
        .map(|join| JoinRecord {
            point: join.point,
            position: frame.place(join.point),
            continuity: join.continuity.word(),
            interval: join.interval,
            std_uncertainty: join.uncertainty,
            interval_open: join.open,
            turn: join.turn,
        })
        .collect();
    let reason = match &found.segments[..] {
        // A closed curve with a corner joins itself.
        _ if !joins.is_empty() => None,
        [one] if one.geometry.kind() != SegmentKind::Line => {
            Some("one segment fits all points; no line segment found")
        }
        [_] => Some("one line fits all points"),
        _ => None,
    };
    ContourRecord {
        plane,
        taken: found.row_kind.word(),
        closed: found.closed,
        length: found.length(),
        noise: found.noise,
        spacing: found.spacing,
        points: found.labels.len() as u64,
        segments: found.segments.iter().map(|s| segment_record(s, found.row_kind)).collect(),
        joins,
        joins_reason: reason.map(Into::into),
        outliers: numbers(&found.outliers),
        bevels: numbers(&found.bevels),
        repeated: numbers(&found.repeated),
        gaps: numbers(&found.gaps),
        crossings: found.crossings.clone(),
        astray: numbers(&found.unreliable),
        doubts: vec![],
        hints: vec![],
        tidy: None,
        tidy_reason: None,
        residuals: found.residuals.clone(),
        labels: found.labels.clone(),
        stations: found.stations.clone(),
    }
}
