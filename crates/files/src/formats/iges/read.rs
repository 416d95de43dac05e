//! B-spline surfaces (entity 128) and curves (126) of an IGES file.

use super::text::{Entity, Model, model, up_to_the_end};
use crate::content::spline_model::SplineModel;
use crate::error::{Fault, Result};
use crate::format::{Parsed, ReadOptions};
use crate::formats::spline::{Raw, curve, surface};
use crate::number::{integer, whole_number};
use crate::source::{SNIFFED_BYTES, Source};
use crate::unicode::no_zeros;
use crate::{Unit, Warning};
use std::collections::BTreeMap;

/// Reads a file.
pub(super) fn read(mut source: Source, options: &ReadOptions) -> Result<Parsed> {
    let (head, _) = up_to_the_end(source.feed.ahead(SNIFFED_BYTES)?);
    no_zeros(head)?;
    let (text, trailing) = up_to_the_end(source.feed.all()?);
    no_zeros(text)?;
    let file = model(text)?;
    let said = unit(&file.global)?;
    let unit = options.unit_of(said);
    let (mut out, mut trimmed, mut left_out) = (SplineModel::default(), 0, 0);
    let faces: BTreeMap<u64, bool> = trims(&file)?;
    for (number, entity) in &file.entities {
        match entity.kind {
            128 => {
                let (raw, domain) = of_surface(&file, entity, unit)?;
                let found = surface(raw).map_err(|f| f.at_line(entity.line))?;
                out.surfaces.push(found.within(domain));
                trimmed += u64::from(faces.get(number) == Some(&true));
            }
            126 => {
                let raw = of_curve(&file, entity, unit)?;
                out.curves.push(curve(raw).map_err(|f| f.at_line(entity.line))?);
            }
            // Ruled, turned, swept and offset surfaces, planes and other shapes; solids that are made of shapes.
            108 | 114 | 118 | 120 | 122 | 140 | 190 | 192 | 194 | 196 | 198 => left_out += 1,
            150 | 152 | 154 | 156 | 158 | 160 | 162 | 164 | 168 => left_out += 1,
            _ => {}
        }
    }
    let mut warnings = vec![];
    if trailing > 0 {
        warnings.push(Warning::TrailingBytes { count: trailing });
    }
    if trimmed > 0 {
        warnings.push(Warning::Trimmed { count: trimmed });
    }
    if left_out > 0 {
        warnings.push(Warning::FacesLeftOut { count: left_out, of: left_out + out.surfaces.len() as u64 });
    }
    Ok(Parsed::splines("iges", out, said, warnings))
}

/// The unit of the model.
fn unit(global: &[Vec<u8>]) -> Result<Option<Unit>> {
    let word = |k: usize| global.get(k - 1).map_or(&b""[..], |w| w);
    let scale = if word(13).is_empty() { Some(1.0) } else { whole_number(word(13), b'.') };
    if scale != Some(1.0) {
        let what = "the model is drawn to a scale, which is not read".into();
        return Err(Fault::Unsupported { what, remedy: "export it in its own size" }.into());
    }
    let found = match (integer(word(14)), &word(15).to_ascii_uppercase()[..]) {
        (None, b"") if word(14).is_empty() => return Ok(None),
        (Some(1), _) | (Some(3), b"IN" | b"INCH") => Unit::Inch,
        (Some(2), _) | (Some(3), b"MM") => Unit::Millimeter,
        (Some(6), _) | (Some(3), b"M") => Unit::Meter,
        (Some(9), _) | (Some(3), b"UM") => Unit::Micrometer,
        (Some(10), _) | (Some(3), b"CM") => Unit::Centimeter,
        _ => {
            let what = "the unit of the model is none of um, mm, cm, m and inch".into();
            return Err(Fault::Unsupported { what, remedy: "export it in millimeters" }.into());
        }
    };
    Ok(Some(found))
}

/// The matrix that places an entity: three rows of a rotation and a shift.
fn matrix(file: &Model, entity: &Entity) -> Result<Option<Vec<f64>>> {
    if entity.matrix == 0 {
        return Ok(None);
    }
    let found = file.entities.get(&entity.matrix).filter(|m| m.kind == 124);
    let found = found.ok_or_else(|| entity.wrong("the matrix that places it", b""))?;
    if found.matrix != 0 {
        return Err(found.wrong("a matrix that is not placed by another", b""));
    }
    found.reals(0, 12).map(Some)
}

/// Control points where they lie, millimeters.
fn placed(matrix: Option<&[f64]>, numbers: &[f64], unit: Unit) -> Vec<[f64; 3]> {
    let (points, _) = numbers.as_chunks::<3>();
    let place = |p: &[f64; 3]| match matrix {
        Some(m) => [0, 4, 8].map(|r| m[r] * p[0] + m[r + 1] * p[1] + m[r + 2] * p[2] + m[r + 3]),
        None => *p,
    };
    points.iter().map(|p| place(p).map(|x| unit.to_millimeters(x))).collect()
}

/// Upper indices and degrees: parameter `k` and the next as counts.
fn counts(entity: &Entity, k: usize) -> Result<(usize, usize)> {
    let (most, degree) = (entity.integer(k)?, entity.integer(k + 1)?);
    let all = entity.parameters.len() as i64;
    let good = |n: i64| (1..all.max(2)).contains(&n).then_some(n as usize);
    match (good(most), good(degree)) {
        (Some(most), Some(degree)) if degree <= most => Ok((most + 1, degree)),
        _ => Err(entity.wrong(
            "an upper index and a degree no greater",
            &entity.parameters.get(k).cloned().unwrap_or_default(),
        )),
    }
}

/// The numbers of a surface, and the parameters that it is meant to have.
fn of_surface(file: &Model, entity: &Entity, unit: Unit) -> Result<(Raw, [(f64, f64); 2])> {
    let swap = |k: usize| -> Result<(usize, usize)> {
        let (most, degree) = (entity.integer(k)?, entity.integer(k + 2)?);
        let all = entity.parameters.len() as i64;
        let good = degree >= 1 && degree <= most && most < all;
        if good {
            Ok((most as usize + 1, degree as usize))
        } else {
            Err(entity.wrong("upper indices and degrees no greater", b""))
        }
    };
    let [(m, p), (n, q)] = [swap(0)?, swap(1)?];
    let net = m.checked_mul(n).filter(|k| *k <= entity.parameters.len());
    let Some(net) = net else {
        let there = entity.parameters.len() as u64;
        let short =
            Fault::Short { what: "control points", declared: m as u64 * n as u64, present: there / 4 };
        return Err(short.at_line(entity.line));
    };
    let (a, b) = (m + p + 1, n + q + 1);
    let all = entity.reals(9, a + b + 4 * net + 4)?;
    let (knots, rest) = all.split_at(a + b);
    let (weights, rest) = rest.split_at(net);
    let (numbers, domain) = rest.split_at(3 * net);
    let points = placed(matrix(file, entity)?.as_deref(), numbers, unit);
    // In the file points run along u first.
    let turn = |k: usize| (k % n) * m + k / n;
    let raw = Raw {
        degree: vec![p, q],
        knots: vec![knots[..a].to_vec(), knots[a..].to_vec()],
        counts: vec![m, n],
        points: (0..net).map(|k| points[turn(k)]).collect(),
        weights: (0..net).map(|k| weights[turn(k)]).collect(),
    };
    Ok((raw, [(domain[0], domain[1]), (domain[2], domain[3])]))
}

fn of_curve(file: &Model, entity: &Entity, unit: Unit) -> Result<Raw> {
    let (n, p) = counts(entity, 0)?;
    let all = entity.reals(6, n + p + 1 + 4 * n)?;
    let (knots, rest) = all.split_at(n + p + 1);
    let (weights, numbers) = rest.split_at(n);
    let points = placed(matrix(file, entity)?.as_deref(), numbers, unit);
    Ok(Raw {
        degree: vec![p],
        knots: vec![knots.to_vec()],
        counts: vec![n],
        points,
        weights: weights.to_vec(),
    })
}

/// The surfaces that faces lie on, and whether they are less than these.
fn trims(file: &Model) -> Result<BTreeMap<u64, bool>> {
    let mut all = BTreeMap::new();
    for entity in file.entities.values() {
        let number = |k: usize| entity.integer(k).map(|n| u64::try_from(n).unwrap_or(0));
        let (surface, trimmed) = match entity.kind {
            // Surface, whether the outer bound is its own, number of inner bounds, outer bound.
            144 => {
                (number(0)?, number(2)? > 0 || number(1)? != 0 && !on_border(file, number(0)?, number(3)?)?)
            }
            143 => (number(1)?, true),
            // A face of a solid: its loops beyond the first are holes.
            510 => (number(0)?, number(1)? > 1),
            _ => continue,
        };
        all.insert(surface, trimmed);
    }
    Ok(all)
}

/// Whether a bound (entity 142) runs along the border of the surface's domain, by its curve in the parameters.
fn on_border(file: &Model, surface: u64, bound: u64) -> Result<bool> {
    let (Some(surface), Some(bound)) = (file.entities.get(&surface), file.entities.get(&bound)) else {
        return Ok(false);
    };
    if surface.kind != 128 || bound.kind != 142 {
        return Ok(false);
    }
    let (_, domain) = of_surface(file, surface, Unit::Millimeter)?;
    let mut places = vec![];
    collect(file, u64::try_from(bound.integer(2)?).unwrap_or(0), 0, &mut places)?;
    // A curve lies on a side if all of its control points do.
    let on_side = |own: &Vec<[f64; 3]>| {
        (0..4).any(|side| {
            let (k, (from, to)) = (side / 2, domain[side / 2]);
            let at = if side % 2 == 0 { from } else { to };
            own.iter().all(|p| (p[k] - at).abs() <= 1e-6 * (to - from))
        })
    };
    Ok(!places.is_empty() && places.iter().all(on_side))
}

/// Places of each curve in the parameters: control points, ends of lines, of a composite curve those of its parts.
fn collect(file: &Model, number: u64, depth: usize, places: &mut Vec<Vec<[f64; 3]>>) -> Result<()> {
    let Some(entity) = file.entities.get(&number).filter(|_| depth < 4) else {
        // An unknown curve may lie anywhere.
        places.push(vec![[f64::NAN; 3]]);
        return Ok(());
    };
    match entity.kind {
        102 => {
            for k in 1..entity.parameters.len() {
                if k as i64 <= entity.integer(0)? {
                    collect(file, u64::try_from(entity.integer(k)?).unwrap_or(0), depth + 1, places)?;
                }
            }
        }
        110 => places.push(placed(None, &entity.reals(0, 6)?, Unit::Millimeter)),
        126 => places.push(of_curve(file, entity, Unit::Millimeter)?.points),
        _ => places.push(vec![[f64::NAN; 3]]),
    }
    Ok(())
}
