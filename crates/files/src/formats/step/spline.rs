//! What the entities of a B-spline curve or surface say of it.

use super::part21::{Entity, Record, Value, Wrong};
use crate::formats::spline::Raw;
use std::iter::repeat_n;
use trueness_geom::space::Point;

/// With knots, Bézier, quasi-uniform, uniform; then what a complex instance has its control points and its weights in.
pub(super) const SURFACES: [&str; 6] = [
    "B_SPLINE_SURFACE_WITH_KNOTS",
    "BEZIER_SURFACE",
    "QUASI_UNIFORM_SURFACE",
    "UNIFORM_SURFACE",
    "B_SPLINE_SURFACE",
    "RATIONAL_B_SPLINE_SURFACE",
];
/// The same of curves.
pub(super) const CURVES: [&str; 6] = [
    "B_SPLINE_CURVE_WITH_KNOTS",
    "BEZIER_CURVE",
    "QUASI_UNIFORM_CURVE",
    "UNIFORM_CURVE",
    "B_SPLINE_CURVE",
    "RATIONAL_B_SPLINE_CURVE",
];
/// The record that has the name of a complex instance.
const NAME_RECORD: &str = "REPRESENTATION_ITEM";
/// Parameters of a B-spline before its knots, without its name: of a curve, of a surface.
const BASE: [usize; 2] = [5, 7];

/// A B-spline as its records have it; control points by their numbers, row after row.
pub(super) struct SplineRecord<'f> {
    /// The record that holds the control points: faults are told of it.
    base: Record<'f>,
    /// The keyword that says which knots it has.
    kind: &'static str,
    /// What follows the control points: knots.
    rest: &'f [Value<'f>],
    weights: Option<Record<'f>>,
    degree: Vec<usize>,
    counts: Vec<usize>,
    points: Vec<u64>,
}

/// What the records of an entity say of a surface (`dimensions` of 2) or a curve (1); `None` if they are none.
pub(super) fn spline<'f>(entity: &Entity<'f>, dimensions: usize) -> Result<Option<SplineRecord<'f>>, Wrong> {
    let names = if dimensions == 2 { SURFACES } else { CURVES };
    let own = names[..4].iter().find_map(|n| entity.record(n).map(|r| (*n, r)));
    let Some((kind, own)) = own else {
        return Ok(None);
    };
    // A simple instance has its name first, then all parameters; of a complex one each record has its own.
    let simple = entity.is_simple();
    let is_known = |r: &Record| names.contains(&r.keyword) || r.values.is_empty() || NAME_RECORD == r.keyword;
    if let Some(strange) = entity.records().find(|r| !simple && !is_known(r)) {
        return Err(strange.wrong(format!("has a record that is not known, {}", strange.keyword)));
    }
    let (base, first, rest) = match entity.record(names[4]) {
        Some(base) if !simple => (base, 0, own.values),
        None if !simple => return Ok(None),
        _ => (own, 1, own.values.get(1 + BASE[dimensions - 1]..).unwrap_or_default()),
    };
    let degree = (0..dimensions).map(|k| base.count(first + k)).collect::<Result<Vec<_>, _>>()?;
    let net = base.list(first + dimensions)?;
    let rows: Vec<&[Value]> = match dimensions {
        2 => net.iter().map(|row| base.items(*row)).collect::<Option<_>>(),
        _ => Some(vec![net]),
    }
    .ok_or_else(|| base.wrong("has control points that do not stand in rows"))?;
    let count = rows.first().map_or(0, |r| r.len());
    if rows.iter().any(|r| r.len() != count) {
        return Err(base.wrong("has not equally many control points in each row"));
    }
    let number = |v: &Value| match v {
        Value::Reference(n) => Ok(*n),
        _ => Err(base.wrong("has control points that are no references")),
    };
    let points = rows.iter().flat_map(|r| r.iter()).map(number).collect::<Result<Vec<_>, _>>()?;
    let counts = if dimensions == 2 { vec![rows.len(), count] } else { vec![count] };
    Ok(Some(SplineRecord { base, kind, rest, weights: entity.record(names[5]), degree, counts, points }))
}

impl SplineRecord<'_> {
    /// The numbers of its control points.
    pub fn points(&self) -> &[u64] {
        &self.points
    }

    /// A fault of the spline.
    pub fn wrong(&self, reason: String) -> Wrong {
        self.base.wrong(reason)
    }

    /// The spline with these places of its control points.
    pub fn with(&self, points: Vec<Point>) -> Result<Raw, Wrong> {
        let dimensions = self.degree.len();
        let needed = |k: usize| self.counts[k].checked_add(self.degree[k])?.checked_add(1);
        let knots = if self.kind.ends_with("WITH_KNOTS") {
            let list = |at: usize| self.base.items(*self.rest.get(at)?);
            let knots = |k: usize| self.repeated(list(k)?, list(dimensions + k)?, needed(k)?);
            (0..dimensions).map(knots).collect::<Option<Vec<_>>>().ok_or_else(|| {
                self.base
                    .wrong("has not knots, each as often as its multiplicity, that fit the control points")
            })?
        } else {
            let knots = |k: usize| implied(self.kind, self.degree[k], self.counts[k]);
            (0..dimensions)
                .map(knots)
                .collect::<Option<Vec<_>>>()
                .ok_or_else(|| self.base.wrong("has not as many control points as its kind needs"))?
        };
        let weights = match &self.weights {
            None => vec![1.0; points.len()],
            Some(own) => {
                weights(own, dimensions).ok_or_else(|| own.wrong("has weights that are no numbers"))?
            }
        };
        Ok(Raw { degree: self.degree.clone(), knots, counts: self.counts.clone(), points, weights })
    }

    /// Knots by their multiplicities; `None` unless there are `needed`.
    fn repeated(&self, times: &[Value], knots: &[Value], needed: usize) -> Option<Vec<f64>> {
        let count = |v: &Value| match v {
            Value::Integer(n) => usize::try_from(*n).ok(),
            _ => None,
        };
        let times: Vec<usize> = times.iter().map(count).collect::<Option<_>>()?;
        let sum = times.iter().try_fold(0usize, |sum, n| sum.checked_add(*n))?;
        if times.len() != knots.len() || sum != needed {
            return None;
        }
        let knots: Vec<f64> = knots.iter().map(|v| self.base.number(*v)).collect::<Option<_>>()?;
        Some(knots.iter().zip(times).flat_map(|(t, n)| repeat_n(*t, n)).collect())
    }
}

/// The knots that a kind of splines has without saying so.
fn implied(kind: &str, degree: usize, count: usize) -> Option<Vec<f64>> {
    let needed = count.checked_add(degree)?.checked_add(1)?;
    let spans = count.checked_sub(degree).filter(|_| degree > 0)?;
    let at = |i: usize| match kind {
        k if k.starts_with("UNIFORM") => i as f64 - degree as f64,
        k if k.starts_with("BEZIER") => (i.saturating_sub(1) / degree).min((count - 1) / degree) as f64,
        _ => i.saturating_sub(degree).min(spans) as f64,
    };
    let whole = !kind.starts_with("BEZIER") || (count - 1).is_multiple_of(degree);
    (whole && spans > 0).then(|| (0..needed).map(at).collect())
}

/// Weights in rows, or in one list.
fn weights(own: &Record, dimensions: usize) -> Option<Vec<f64>> {
    let all = own.items(*own.values.last()?)?;
    let numbers = |list: &[Value]| list.iter().map(|v| own.number(*v)).collect::<Option<Vec<f64>>>();
    match dimensions {
        2 => all.iter().map(|row| numbers(own.items(*row)?)).collect::<Option<Vec<_>>>().map(|r| r.concat()),
        _ => numbers(all),
    }
}
