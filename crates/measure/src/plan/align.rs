//! How the measured data come to lie on the reference.

use super::checker::Checker;
use super::feature::named;
use crate::requirement::Feature;
use std::ops::Range;
use trueness_document::plan::{
    AlignText, AlignWord, At, Class, DatumMethodWord, PairText, PlanError, PlanText,
};
use trueness_geom::align::Row;
use trueness_geom::rigid::Rigid;
use trueness_geom::space::{Point, unit};
use trueness_geom::zone::datum::Rule;

/// How the measured data come to lie on the reference.
#[derive(Clone, Debug, PartialEq)]
pub enum Align {
    /// As measured.
    None,
    /// By this motion: reference from measured.
    Given(Rigid),
    /// By the best fit of the measured data onto the reference, from any pose.
    BestFit,
    /// The least greatest distance from the reference, near the best fit from any pose.
    Chebyshev,
    /// The least greatest excess over the tolerances of the deviations, near the best fit from any pose.
    Zones,
    /// By datum features, whose frame comes to lie on that of their nominals.
    Datum {
        /// Numbers of the features, the first datum first.
        datums: Vec<usize>,
        /// How they are associated.
        rule: Rule,
        /// Where the features are sought from; without it from the best fit, where there is a reference.
        start: Option<Rigid>,
        /// Where the datums stand in the plan.
        span: Range<usize>,
    },
    /// By pairs of places that belong together.
    Pairs {
        /// As measured.
        measured: Vec<Point>,
        /// Where they belong.
        nominal: Vec<Point>,
        /// Their weights.
        weights: Vec<f64>,
    },
    /// By reference points: places that are held in given directions.
    Rps {
        /// The places.
        rows: Vec<Row>,
        /// Where to start; without it from the pairs of places.
        start: Option<Rigid>,
    },
}

impl Align {
    /// The word for it.
    pub fn word(&self) -> &'static str {
        let word = match self {
            Align::None => AlignWord::None,
            Align::Given(_) => AlignWord::Given,
            Align::BestFit => AlignWord::BestFit,
            Align::Chebyshev => AlignWord::Chebyshev,
            Align::Zones => AlignWord::Zones,
            Align::Datum { .. } => AlignWord::Datum,
            Align::Pairs { .. } => AlignWord::Pairs,
            Align::Rps { .. } => AlignWord::Rps,
        };
        word.name()
    }

    /// Whether it uses the mesh of the reference.
    pub fn uses_reference(&self) -> bool {
        matches!(self, Align::BestFit | Align::Chebyshev | Align::Zones | Align::Datum { start: None, .. })
    }
}

pub(super) fn align(checker: &Checker, plan: &PlanText, features: &[Feature]) -> Result<Align, PlanError> {
    let Some(written) = &plan.align else { return Ok(Align::None) };
    let (word, span) = (written.method.value, &written.method.span);
    unused(checker, written)?;
    let start = match &written.transform {
        Some(rows) => Some(motion(checker, rows)?),
        None => None,
    };
    match word {
        AlignWord::None => Ok(Align::None),
        AlignWord::BestFit | AlignWord::Chebyshev | AlignWord::Zones
            if plan.measured.is_none() || plan.reference.is_none() =>
        {
            checker.wrong(span, "a best fit needs `measured` and `reference`")
        }
        AlignWord::Zones if !judged(plan) => {
            let what =
                "method \"zones\" fits into the tolerances of [deviation]; give it a `tolerance` or regions";
            checker.wrong(span, what)
        }
        AlignWord::Zones => Ok(Align::Zones),
        AlignWord::BestFit => Ok(Align::BestFit),
        AlignWord::Chebyshev => Ok(Align::Chebyshev),
        AlignWord::Given => match start {
            Some(motion) => Ok(Align::Given(motion)),
            None => checker.wrong(span, "method \"given\" needs `transform`, four rows of four numbers"),
        },
        AlignWord::Datum => datum(checker, written, features, start),
        AlignWord::Pairs => {
            let points = points(checker, written, 3)?;
            Ok(Align::Pairs {
                measured: points.iter().map(|p| checker.place(p.measured.value)).collect(),
                nominal: points.iter().map(|p| checker.place(p.nominal.value)).collect(),
                weights: points.iter().map(|p| weight(checker, p)).collect::<Result<_, _>>()?,
            })
        }
        AlignWord::Rps => {
            let rows = points(checker, written, 6)?.iter().map(|p| row(checker, p));
            Ok(Align::Rps { rows: rows.collect::<Result<_, _>>()?, start })
        }
    }
}

/// Whether deviations are judged somewhere.
fn judged(plan: &PlanText) -> bool {
    plan.deviation.as_ref().is_some_and(|d| d.value.tolerance.is_some() || !d.value.region.is_empty())
}

/// Refuses keys that the method has no use for: they would be lost in silence.
fn unused(checker: &Checker, written: &AlignText) -> Result<(), PlanError> {
    use AlignWord::{Datum, Given, Pairs, Rps};
    let keys = [
        ("transform", written.transform.as_ref().map(|x| &x.span), &[Given, Datum, Rps][..]),
        ("datums", written.datums.as_ref().map(|x| &x.span), &[Datum]),
        ("datum_method", written.datum_method.as_ref().map(|x| &x.span), &[Datum]),
        ("points", written.points.as_ref().map(|x| &x.span), &[Pairs, Rps]),
    ];
    let method = written.method.value;
    match keys.into_iter().find(|(_, span, of)| span.is_some() && !of.contains(&method)) {
        Some((key, Some(span), of)) => {
            let known: Vec<String> = of.iter().map(|w| format!("\"{}\"", w.name())).collect();
            checker.wrong(span, format!("`{key}` goes with method {}", known.join(" or ")))
        }
        _ => Ok(()),
    }
}

fn motion(checker: &Checker, rows: &At<Vec<Vec<f64>>>) -> Result<Rigid, PlanError> {
    let row = |k: usize| -> Option<[f64; 4]> { rows.value.get(k)?.as_slice().try_into().ok() };
    let four = [row(0), row(1), row(2), row(3)];
    let ([Some(mut a), Some(mut b), Some(mut c), Some(d)], 4) = (four, rows.value.len()) else {
        return checker.wrong(&rows.span, "a transform has four rows of four numbers");
    };
    for row in [&mut a, &mut b, &mut c] {
        row[3] *= checker.unit;
    }
    let motion = Rigid::from_matrix([a, b, c, d]);
    motion.or_else(|e| checker.wrong(&rows.span, format!("the transform: {e}")))
}

fn datum(
    checker: &Checker,
    written: &AlignText,
    features: &[Feature],
    start: Option<Rigid>,
) -> Result<Align, PlanError> {
    let Some(names) = &written.datums else {
        let what = "method \"datum\" needs `datums`, the features that the part is placed by";
        return checker.wrong(&written.method.span, what);
    };
    let mut datums = vec![];
    for name in &names.value {
        let number = named(checker, &name.value, &name.span, features)?;
        if !features[number].has_nominal() {
            let what =
                format!("feature \"{}\" has no `nominal`: where it should lie is not known", name.value);
            return checker.wrong(&name.span, what);
        }
        if !matches!(
            features[number].class,
            Class::Plane | Class::Cylinder | Class::Cone | Class::Sphere | Class::Line
        ) {
            let what = format!("a {} cannot be a datum here", features[number].class.word());
            return checker.wrong(&name.span, what);
        }
        datums.push(number);
    }
    if datums.is_empty() {
        return checker.wrong(&names.span, "there is no datum in the list");
    }
    let rule = match written.datum_method.as_ref().map(|m| m.value) {
        None | Some(DatumMethodWord::Gaussian) => Rule::Gaussian,
        Some(DatumMethodWord::MinimumZone) => Rule::MinimumZone,
    };
    Ok(Align::Datum { datums, rule, start, span: names.span.clone() })
}

fn points<'a>(checker: &Checker, written: &'a AlignText, least: usize) -> Result<&'a [PairText], PlanError> {
    let method = written.method.value.name();
    match &written.points {
        None => {
            let what = format!("method \"{method}\" needs `points`, a list of {{ measured, nominal }}");
            checker.wrong(&written.method.span, what)
        }
        Some(list) if list.value.len() < least => {
            let found = list.value.len();
            checker.wrong(
                &list.span,
                format!("method \"{method}\" needs at least {least} points, there are {found}"),
            )
        }
        Some(list) => Ok(&list.value),
    }
}

fn weight(checker: &Checker, point: &PairText) -> Result<f64, PlanError> {
    match &point.weight {
        None => Ok(1.0),
        Some(w) if w.value.is_finite() && w.value >= 0.0 => Ok(w.value),
        Some(w) => checker.wrong(&w.span, format!("the weight is {}; give a number from 0 upwards", w.value)),
    }
}

fn row(checker: &Checker, point: &PairText) -> Result<Row, PlanError> {
    let Some(direction) = &point.direction else {
        let what = "a reference point needs `direction`: it is held in that direction";
        return checker.wrong(&point.nominal.span, what);
    };
    if unit(direction.value).is_none() {
        return checker.wrong(&direction.span, "the direction has no length");
    }
    Ok(Row {
        measured: checker.place(point.measured.value),
        nominal: checker.place(point.nominal.value),
        direction: direction.value,
        weight: weight(checker, point)?,
    })
}
