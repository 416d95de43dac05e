//! Twist, offset and lean of blades against the nominal.

use super::convert::{motion, outline};
use trueness_document::section::{AirfoilRecord, LeanRecord, NominalRecord, OutlineRecord, StackingRecord};
use trueness_geom::progress::{Cancelled, Progress};
use trueness_section::{
    AirfoilError, Chord, Chords, Contour, Outline, PlaneMotion, airfoil, chords, outline_row,
};

/// Where a contour is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Whereabouts {
    /// Number of its plane.
    pub plane: Option<u64>,
    /// Normal and offset of that.
    pub height: Option<([f64; 3], f64)>,
    /// Middle of the box around it.
    pub middle: [f64; 2],
}

/// The chords of an outline of the nominal, or why there are none.
fn of_nominal(outline: &Outline, progress: &dyn Progress) -> Result<Result<Chords, AirfoilError>, Cancelled> {
    let row = outline_row(outline);
    let spacing = outline.length() / row.len().max(1) as f64;
    // The edges are those of a smooth curve through the places, the chords those of the outline itself.
    let bare = Contour { closed: outline.closed, spacing, ..Contour::default() };
    let drawn = Contour { segments: outline.segments.clone(), ..bare.clone() };
    match airfoil(&row, &bare, progress).and_then(|blade| chords(&row, &drawn, &blade)) {
        Err(AirfoilError::Cancelled(e)) => Err(e),
        found => Ok(found),
    }
}

/// Adds twist and offset to the profiles; `stacking` is the point given, in the nominal's coordinates.
///
/// # Errors
/// [`Cancelled`], when asked to stop.
pub(super) fn against_nominal(
    all: &mut [AirfoilRecord],
    contours: &[Whereabouts],
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
                let motion = fit.map_or(PlaneMotion::about([0.0; 2]), motion);
                Some(of_nominal(&self::outline(outline).moved(&motion), progress)?)
            }
            None => None,
        };
        place(found, chords, stacking);
    }
    Ok(())
}

/// The outline of the contour's plane whose box is nearest to the contour's.
fn nearest_outline<'a>(nominal: &'a NominalRecord, contour: &Whereabouts) -> Option<&'a OutlineRecord> {
    let middle = contour.middle;
    let far = |o: &[f64; 2]| libm::hypot(o[0] - middle[0], o[1] - middle[1]);
    let own = nominal.outlines.iter().filter(|o| o.plane == contour.plane && !o.hole);
    own.min_by(|a, b| far(&a.center).total_cmp(&far(&b.center)))
}

/// Puts twist and offset into a record.
fn place(
    found: &mut AirfoilRecord,
    nominal: Option<Result<Chords, AirfoilError>>,
    stacking: Option<[f64; 2]>,
) {
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
pub(super) fn lean(all: &[AirfoilRecord], contours: &[Whereabouts]) -> Option<LeanRecord> {
    let mut places: Vec<(u64, f64, [f64; 2])> = vec![];
    let mut normals: Vec<[f64; 3]> = vec![];
    for found in all {
        let Some(stacking) = found.measures.as_ref().and_then(|m| m.stacking.as_ref()) else { continue };
        let contour = contours.get(found.contour as usize)?;
        let (normal, offset) = contour.height?;
        places.push((contour.plane?, offset, stacking.offset));
        normals.push(normal);
    }
    let first = *normals.first()?;
    let parallel = |n: &[f64; 3]| (0..3).all(|k| (n[k] - first[k]).abs() < PARALLEL_NORMAL_STEP);
    let once = places.windows(2).all(|w| w[0].0 != w[1].0);
    if places.len() < 2 || !once || !normals.iter().all(parallel) {
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
const PARALLEL_NORMAL_STEP: f64 = 1e-9;
