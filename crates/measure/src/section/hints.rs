//! What to heed about a contour, each with what may help.

use super::found::Section;
use trueness_section::{Bent, Contour, Geometry, Options, RowKind};

/// A row lies in no plane if its points are off the plane by more than both: so many standard deviations of their scatter within it, and
/// this share of its length.
const MAX_OFF_PLANE: (f64, f64) = (8.0, 1e-4);
/// Scatter of so many times the noise given, or of this share of it, contradicts it, unless chance makes it so ...
const MAX_NOISE_RATIO: f64 = 1.5;
const MIN_NOISE_RATIO: f64 = 0.25;
/// ... once in many thousand rows: so many standard deviations of the logarithm of a standard deviation, which is `1 / √2n` of `n` degrees
/// of freedom.
const CHANCE_DEVIATIONS: f64 = 4.0;

/// So many points to an independent one are told.
const MIN_TOLD_POINTS_PER_INDEPENDENT: f64 = 1.3;

/// What there is to say about a contour of a section; `bent` are its arcs whose radii the slab moves.
pub(super) fn hints(section: &Section, found: &Contour, bent: &[Bent], options: &Options) -> Vec<String> {
    let flat = off_plane(section, found);
    flat.into_iter()
        .chain(noise(found, options))
        .chain(shared(found))
        .chain(slab(section, found, bent))
        .chain(cut_short(found))
        .chain(straight_on(found))
        .chain(few_points(found))
        .collect()
}

/// Neighbors of points in order that share noise.
fn shared(found: &Contour) -> Option<String> {
    let count = found.segments.iter().map(|s| s.count).sum::<usize>() as f64;
    let alike = count / found.independent.max(1.0);
    (found.row_kind == RowKind::Row && found.independent > 0.0 && alike > MIN_TOLD_POINTS_PER_INDEPENDENT).then(|| {
        format!(
            "neighbors share noise, as of filtered profiles: {alike:.1} points tell as much as an independent one, and ± says so; \
             give --noise if they are independent"
        )
    })
}

/// What makes a contour doubtful.
pub(super) fn doubts(found: &Contour) -> Vec<String> {
    strays(found).into_iter().chain(layers(found)).collect()
}

/// Both faces of a wall in one contour.
fn layers(found: &Contour) -> Option<String> {
    let apart = digits(found.layered?);
    Some(format!(
        "the points lie in two layers about {apart} apart, or scatter as much: the contour may run between the faces of a thin wall; scan \
         the faces apart, or cut where points are denser"
    ))
}

/// Points that may be strays.
fn strays(found: &Contour) -> Option<String> {
    let [first, others @ ..] = &found.doubtful[..] else { return None };
    let (which, are, them) = match others.len() {
        0 => (format!("point {first}"), "is", "it"),
        n => (format!("points {first} and {n} more"), "are", "them"),
    };
    Some(format!(
        "{which} (from 0) {are} farther from the rest than its points from each other, and no curve leads there: a stray row, \
         or the contour is missing between; the length counts the way to {them}; delete {them}, or add the points between"
    ))
}

/// Far points that the row leads straight to.
fn straight_on(found: &Contour) -> Option<String> {
    let first = found.straight_on.first()?;
    Some(format!(
        "the step to point {first} (from 0) is many times as long as any other; it goes straight on and was taken for the end of a line; \
         delete the point if it is none"
    ))
}

/// Few points that may be corners.
fn few_points(found: &Contour) -> Option<String> {
    let is_polygon = found.segments.iter().all(|s| s.geometry == Geometry::Line);
    let (taken, other) =
        if is_polygon { ("lines were", "points of a curve") } else { ("curve was", "corners of a polygon") };
    found.may_be_polygon.then(|| {
        format!("the points are few and may be {other} as well: the {taken} taken; give more points on the lines or the curve")
    })
}

/// A row in space that lies in no plane.
fn off_plane(section: &Section, found: &Contour) -> Option<String> {
    let off = section.frame.flatness;
    let most = (MAX_OFF_PLANE.0 * found.noise).max(MAX_OFF_PLANE.1 * found.length());
    (section.plane.is_none() && off > most).then(|| {
        format!(
            "the points lie up to {} off the plane nearest to them and were projected into it: lengths, radii and angles are those of \
             their projection; check the columns, or cut a mesh or a cloud with --plane",
            digits(off)
        )
    })
}

/// A search that ended before all was tried.
fn cut_short(found: &Contour) -> Option<String> {
    found.cut_short.then(|| {
        "the search took long and ended before all was tried: fewer segments may do; thin the points, cut the row in two at a corner, or \
         look whether --noise is too small"
            .into()
    })
}

/// A noise given that the points contradict.
fn noise(found: &Contour, options: &Options) -> Option<String> {
    let given = options.noise?;
    let lists = [&found.outliers, &found.repeated, &found.bevels];
    let left_out = |i: &usize| lists.iter().any(|list| list.binary_search(i).is_ok());
    let kept: Vec<f64> =
        (0..found.residuals.len()).filter(|i| !left_out(i)).map(|i| found.residuals[i]).collect();
    let degrees = (kept.len() as f64).min(found.independent) - found.unknowns;
    if degrees < 4.0 {
        return None;
    }
    let own = (kept.iter().map(|r| r * r).sum::<f64>() / degrees).sqrt();
    let ratio = own / given;
    let far = libm::log(ratio).abs() > CHANCE_DEVIATIONS / (2.0 * degrees).sqrt();
    let (word, consequence) = match ratio {
        r if r > MAX_NOISE_RATIO => {
            ("more", "intervals and uncertainties are too small, and segments may follow scatter")
        }
        r if r < MIN_NOISE_RATIO => {
            ("less", "intervals and uncertainties are too large, and form may pass for scatter")
        }
        _ => return None,
    };
    far.then(|| {
        format!(
            "the points scatter by {} about the contour, {word} than the --noise {given} given: {consequence}; leave --noise out, or \
             give what repeated measurements show",
            digits(own)
        )
    })
}

/// The arc whose radius a slab moves most, of those that it moves by more than their uncertainty.
fn slab(section: &Section, found: &Contour, bent: &[Bent]) -> Option<String> {
    let worst = bent
        .iter()
        .max_by(|a, b| (a.bias.abs() / a.uncertainty).total_cmp(&(b.bias.abs() / b.uncertainty)))?;
    let Geometry::Arc { radius, .. } = found.segments.get(worst.segment)?.geometry else { return None };
    let thickness = section.thickness?;
    // It grows with the square of the thickness.
    let enough = thickness * (worst.uncertainty / worst.bias.abs()).sqrt();
    Some(format!(
        "the surface bends across the slab: the radius {radius:.4} of segment {} is {} too {}, more than its uncertainty; a \
         --thickness of {} is thin enough",
        worst.segment + 1,
        digits(worst.bias.abs()),
        if worst.bias < 0.0 { "small" } else { "large" },
        digits(enough)
    ))
}

/// A length with two digits, for words.
pub(super) fn digits(x: f64) -> String {
    let places = (1.0 - libm::log10(x.abs().max(1e-9)).floor()).clamp(0.0, 9.0) as usize;
    format!("{x:.places$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_search_cut_short_is_told() {
        assert_eq!(cut_short(&Contour::default()), None);
        let hint = cut_short(&Contour { cut_short: true, ..Contour::default() }).unwrap();
        assert!(hint.contains("before all was tried"), "{hint}");
    }

    #[test]
    fn few_points_of_a_curve_or_polygon_are_told() {
        assert_eq!(few_points(&Contour::default()), None);
        let hint = few_points(&Contour { may_be_polygon: true, ..Contour::default() }).unwrap();
        assert!(hint.contains("points of a curve as well: the lines were taken"), "{hint}");
    }
}
