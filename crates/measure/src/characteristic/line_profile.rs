//! Profile of a line: ISO 1101:2017, 17.6; ISO 1660. ASME Y14.5-2018, section 11, agrees for equally disposed zones.

use super::kind::{Characteristic, Measuring, Question, Refusal, refuse};
use super::profile::{check, search, surface, value};
use super::reason::{Impossible, NotMeasured};
use super::value::{Missing, Value};
use trueness_geom::feature::Nominal;
use trueness_geom::rigid::Rigid;
use trueness_geom::space::{Point, Vector, cross, least_axis, norm, unit};
use trueness_geom::zone::datum::Freedom;
use trueness_geom::zone::motion::{Search, placed};
use trueness_geom::zone::sections;

/// In every intersection plane, the width of the zone about the theoretically exact line; the value is the widest.
///
/// Distances are taken within the plane through each point. Without datums the line of each section may lie anywhere in its plane. The
/// sections are those that the points lie in: rows, else 24 slices. A frame holds all of them.
#[derive(Debug)]
pub struct LineProfile;

/// Fewest points of a section: fewer always fit.
const MIN_SECTION_POINTS: usize = 4;
/// Sine of the angle below which a plane is taken for one along the intersection planes.
const ALONG_PLANES_SINE: f64 = 1e-6;

impl Characteristic for LineProfile {
    fn word(&self) -> &'static str {
        "line-profile"
    }
    fn symbol(&self) -> &'static str {
        "⌒"
    }
    fn standard(&self) -> &'static str {
        "ISO 1101:2017, 17.6; ISO 1660:2017"
    }
    fn keys(&self) -> &'static [&'static str] {
        &["tolerance", "frame", "offset", "intersection"]
    }
    fn check(&self, q: &Question) -> Result<(), Refusal> {
        check(q)?;
        let Some(across) = q.spec.intersection else {
            return refuse(
                "kind",
                "it needs `intersection`, the normal of the planes that its lines lie in: [0, 1, 0]",
            );
        };
        match &q.feature()?.nominal {
            Some(Nominal::Plane { normal, .. })
                if unit(*normal).is_some_and(|n| norm(cross(n.0, across)) < ALONG_PLANES_SINE) =>
            {
                refuse(
                    "intersection",
                    "the intersection planes lie along the nominal plane and do not meet it in lines",
                )
            }
            _ => Ok(()),
        }
    }
    fn measure(&self, m: &Measuring) -> Result<Value, Missing> {
        let Some(across) = m.spec.intersection else {
            return Err(Impossible::NoIntersectionPlanes.into());
        };
        let (surface, points) = (surface(m)?, m.feature().own_points()?);
        // Within a plane: along its two directions, and a turn about its normal.
        let free = Freedom { shift: [true, true, false], turn: [false, false, true] };
        let held = search(m, free)?;
        let lines = Lines { surface, across, search: held };
        if m.spec.frame.is_some() && !held.floating {
            return lines.value(m, &(0..points.len()).collect::<Vec<_>>());
        }
        let mut found: Option<Value> = None;
        let (mut taken, mut left_out) = (0u32, 0);
        for section in sections(points, across) {
            if section.len() < MIN_SECTION_POINTS {
                left_out += 1;
                continue;
            }
            let value = lines.value(m, &section)?;
            taken += 1;
            if found.as_ref().is_none_or(|f| f.value < value.value) {
                found = Some(value);
            }
        }
        let none = || NotMeasured::NoSection { needed: MIN_SECTION_POINTS };
        let mut found = found.ok_or_else(none)?;
        found.parts.push(("sections", f64::from(taken)));
        if left_out > 0 {
            found.notes.push(format!(
                "{left_out} sections with fewer than {MIN_SECTION_POINTS} points were left out"
            ));
        }
        Ok(found)
    }
}

/// The lines of a surface in the planes across a direction.
struct Lines {
    surface: trueness_geom::feature::NominalSurface,
    across: Vector,
    search: Search,
}

impl Lines {
    /// The value of the points with these indices.
    fn value(&self, m: &Measuring, chosen: &[usize]) -> Result<Value, Missing> {
        let points = m.feature().own_points()?;
        let own: Vec<Point> = chosen.iter().map(|i| points[*i]).collect();
        let first = self.search.start.point(own.first().copied().unwrap_or_default());
        // Coordinates with z across the planes; shifts and turns that the search leaves free are along and about these.
        let Some(seen) = Rigid::into_frame(first, self.across, least_axis(self.across)) else {
            return Err(Impossible::PlanesWithoutNormal.into());
        };
        let back = seen.inverse();
        let distance = |_: usize, p: Point| {
            let (d, gradient) = self.surface.distance_within(back.point(p), self.across)?;
            Some((d, seen.vector(gradient)))
        };
        let search = Search { start: seen.after(&self.search.start), ..self.search };
        let found = placed(&own, &distance, &search, m.progress)?;
        value(m, &found, |i| chosen[i])
    }
}
