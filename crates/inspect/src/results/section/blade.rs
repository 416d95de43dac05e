//! Chords of blades by their usual definitions, and twist, offset and lean against the nominal.

use super::airfoil::AirfoilRecord;
use super::nominal::NominalRecord;
use super::{ContourRecord, PlaneRecord};
use crate::results::Word;
use crate::results::word::named;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::section::{
    AirfoilError, Chord, Chords, Options, Outline, PlaneMotion, SectionError, airfoil, chords, contour, outline_row,
};

/// What a chord is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChordBy {
    /// Between the two places that are farthest from each other.
    Farthest,
    /// Between the ends of the camber line, led on to the profile.
    CamberEnds,
    /// The extent along the flat tangent, which touches the hollow side at two places.
    Bitangent,
}

impl ChordBy {
    /// All of them.
    pub const ALL: [ChordBy; 3] = [ChordBy::Farthest, ChordBy::CamberEnds, ChordBy::Bitangent];

    /// The word for it: `farthest`, `camber_ends`, `bitangent`.
    pub fn name(self) -> &'static str {
        match self {
            ChordBy::Farthest => "farthest",
            ChordBy::CamberEnds => "camber_ends",
            ChordBy::Bitangent => "bitangent",
        }
    }
}

named!(ChordBy, "chord", Self::ALL, |by| by.name());

/// A chord.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct ChordRecord {
    /// `farthest`: between the two places of the profile that are farthest from each other; `camber_ends`: between the ends of the camber
    /// line, led on to the profile; `bitangent`: the extent along the flat tangent, the line that touches the hollow side at two places.
    pub definition: Word<ChordBy>,
    /// Its end at the leading edge.
    pub leading: Option<[f64; 2]>,
    /// Its end at the trailing edge.
    pub trailing: Option<[f64; 2]>,
    /// Its length.
    pub length: Option<f64>,
    /// Angle of the way from leading to trailing edge with the first axis, radians.
    pub angle: Option<f64>,
    /// Why there is no such chord.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub length_reason: Option<String>,
    /// Twist: by how much its angle is greater than that of the nominal's chord of the same definition, radians.
    pub twist: Option<f64>,
    /// Why there is no twist.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub twist_reason: Option<String>,
}

/// Where a profile is, against where it should be.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct StackingRecord {
    /// The stacking point: the one given, or the centroid of the nominal's profile.
    pub point: [f64; 2],
    /// `given` or `centroid`.
    pub by: String,
    /// How far the profile's own stacking point is from it. With a nominal it goes with the profile as centroid and twist (of the chord between
    /// the farthest places) say; without one it is the centroid.
    pub offset: [f64; 2],
    /// The same along the profile's farthest chord, positive toward the trailing edge.
    pub along_chord: f64,
    /// The same across it, positive to its left.
    pub across_chord: f64,
}

/// How the offsets of the stacking points grow from plane to plane.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct LeanRecord {
    /// Angles by which the stacking line leans toward the first and the second axis of the planes, radians: of the line of least squares.
    pub lean: [f64; 2],
    /// Greatest distance of an offset from that line.
    pub greatest: f64,
    /// Planes that it is of.
    pub planes: u64,
}

/// The chords of a profile as records, without twist.
pub(super) fn records(found: &Chords) -> Vec<ChordRecord> {
    let all = [
        (ChordBy::Farthest, Ok(found.farthest)),
        (ChordBy::CamberEnds, Ok(found.camber_ends)),
        (ChordBy::Bitangent, found.bitangent),
    ];
    all.into_iter().map(|(by, chord)| record(by, chord)).collect()
}

fn record(by: ChordBy, chord: Result<Chord, AirfoilError>) -> ChordRecord {
    let found = chord.ok();
    ChordRecord {
        definition: Word(by),
        leading: found.map(|c| c.leading),
        trailing: found.map(|c| c.trailing),
        length: found.map(|c| c.length()),
        angle: found.map(|c| c.angle()),
        length_reason: chord.err().map(|e| e.to_string()),
        twist: None,
        twist_reason: Some("there is no nominal to compare with; the angle is that with the first axis".into()),
    }
}

/// The chords of an outline of the nominal, or why there are none.
fn of_nominal(outline: &Outline, progress: &dyn Progress) -> Result<Result<Chords, String>, Cancelled> {
    let row = outline_row(outline);
    let options = Options { closed: Some(outline.closed), ordered: true, ..Options::default() };
    let found = match contour(&row, &options, progress) {
        Err(SectionError::Cancelled(e)) => return Err(e),
        Err(e) => return Ok(Err(e.to_string())),
        Ok(found) => found,
    };
    match airfoil(&row, &found, progress).and_then(|blade| chords(&row, &found, &blade)) {
        Err(AirfoilError::Cancelled(e)) => Err(e),
        found => Ok(found.map_err(|e| e.to_string())),
    }
}

/// Adds twist and offset to the profiles; `stacking` is the point given, in the nominal's coordinates.
///
/// # Errors
/// [`Cancelled`], when asked to stop.
pub fn against_nominal(
    all: &mut [AirfoilRecord],
    contours: &[ContourRecord],
    nominal: Option<&NominalRecord>,
    stacking: Option<[f64; 2]>,
    progress: &dyn Progress,
) -> Result<(), Cancelled> {
    for found in all {
        let Some(contour) = contours.get(found.contour as usize) else { continue };
        let own = nominal.and_then(|n| Some((n, nearest_outline(n, contour)?)));
        let chords = match own {
            Some((nominal, outline)) => {
                let fit = nominal.fits.iter().find(|f| f.plane == contour.plane);
                let motion = fit.map_or(PlaneMotion::about([0.0; 2]), |f| f.motion);
                Some(of_nominal(&outline.moved(&motion), progress)?)
            }
            None => None,
        };
        place(found, chords, stacking);
    }
    Ok(())
}

/// The outline of the contour's plane whose box is nearest to the contour's.
fn nearest_outline<'a>(nominal: &'a NominalRecord, contour: &ContourRecord) -> Option<&'a Outline> {
    let ends = || contour.segments.iter().flat_map(|s| [s.start, s.end]);
    let middle = [0, 1].map(|k| {
        let [low, high] = ends().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], p| [l.min(p[k]), h.max(p[k])]);
        0.5 * (low + high)
    });
    let far = |o: &[f64; 2]| libm::hypot(o[0] - middle[0], o[1] - middle[1]);
    let own = nominal.outlines.iter().filter(|o| o.plane == contour.plane && !o.hole);
    own.min_by(|a, b| far(&a.center).total_cmp(&far(&b.center))).map(|o| &o.drawn)
}

/// Puts twist and offset into a record.
fn place(found: &mut AirfoilRecord, nominal: Option<Result<Chords, String>>, stacking: Option<[f64; 2]>) {
    let Some(measures) = &mut found.measures else { return };
    let (mut twist, mut center) = (0.0, None);
    match nominal {
        Some(Ok(nominal)) => {
            center = Some(nominal.centroid);
            let angles = [Ok(nominal.farthest), Ok(nominal.camber_ends), nominal.bitangent];
            for (own, nominal) in measures.chords.iter_mut().zip(angles) {
                let pair = own.angle.zip(nominal.as_ref().ok().map(Chord::angle));
                own.twist = pair.map(|(own, nominal)| within_half_a_turn(own - nominal));
                own.twist_reason = match (own.angle, &nominal) {
                    _ if own.twist.is_some() => None,
                    (None, _) => Some("the profile has no such chord".into()),
                    (_, Err(e)) => Some(format!("the nominal has no such chord: {e}")),
                    _ => None,
                };
            }
            twist = measures.chords.first().and_then(|c| c.twist).unwrap_or(0.0);
        }
        Some(Err(why)) => {
            let reason = format!("the nominal is no profile: {why}");
            measures.chords.iter_mut().for_each(|c| c.twist_reason = Some(reason.clone()));
        }
        None => {}
    }
    let own = measures.centroid;
    let there = match (stacking, center, own) {
        (Some(point), Some(center), Some(own)) => {
            let motion = PlaneMotion { center, turn: twist, shift: [own[0] - center[0], own[1] - center[1]] };
            Some((point, "given", motion.apply(point)))
        }
        (Some(point), None, Some(own)) => Some((point, "given", own)),
        (None, Some(center), Some(own)) => Some((center, "centroid", own)),
        _ => None,
    };
    let angle = measures.chords.first().and_then(|c| c.angle).unwrap_or(0.0);
    measures.stacking = there.map(|(point, by, there)| {
        let offset = [there[0] - point[0], there[1] - point[1]];
        let (sin, cos) = libm::sincos(angle);
        StackingRecord {
            point,
            by: by.into(),
            offset,
            along_chord: cos * offset[0] + sin * offset[1],
            across_chord: cos * offset[1] - sin * offset[0],
        }
    });
}

fn within_half_a_turn(angle: f64) -> f64 {
    let turn = std::f64::consts::TAU;
    angle - turn * (angle / turn).round()
}

/// The lean of the profiles of parallel planes, one in each; `None` of fewer than two.
pub fn lean(all: &[AirfoilRecord], contours: &[ContourRecord], planes: &[PlaneRecord]) -> Option<LeanRecord> {
    let first = planes.first()?;
    let parallel = |p: &PlaneRecord| (0..3).all(|k| (p.normal[k] - first.normal[k]).abs() < PARALLEL);
    let mut places: Vec<(u64, f64, [f64; 2])> = vec![];
    for found in all {
        let Some(stacking) = found.measures.as_ref().and_then(|m| m.stacking.as_ref()) else { continue };
        let plane = contours.get(found.contour as usize)?.plane?;
        places.push((plane, planes.get(plane as usize)?.offset, stacking.offset));
    }
    let once = places.windows(2).all(|w| w[0].0 != w[1].0);
    if places.len() < 2 || !once || !planes.iter().all(parallel) {
        return None;
    }
    let n = places.len() as f64;
    let mean = places.iter().map(|p| p.1).sum::<f64>() / n;
    let square = places.iter().map(|p| (p.1 - mean).powi(2)).sum::<f64>();
    let slope = |k: usize| places.iter().map(|p| (p.1 - mean) * p.2[k]).sum::<f64>() / square;
    let middle = [0, 1].map(|k| places.iter().map(|p| p.2[k]).sum::<f64>() / n);
    let slopes = [slope(0), slope(1)];
    let off = |p: &(u64, f64, [f64; 2])| {
        let d = [0, 1].map(|k| p.2[k] - middle[k] - slopes[k] * (p.1 - mean));
        libm::hypot(d[0], d[1])
    };
    (square > 0.0).then(|| LeanRecord {
        lean: slopes.map(libm::atan),
        greatest: places.iter().map(off).fold(0.0, f64::max),
        planes: places.len() as u64,
    })
}

/// Normals of planes whose components differ by less are parallel.
const PARALLEL: f64 = 1e-9;
