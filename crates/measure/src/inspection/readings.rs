//! Other readings of a plan's numbers, held against the model.

use super::stop::Stop;
use super::wrong_numbers::{AskedPlace, Place, angle_text, other_text, place_text, sizes_text};
use crate::characteristic::{Characteristic, MeasuredFeature, Measuring, Missing, Size, Spec};
use crate::plan::Plan;
use crate::requirement::{Basic, Limits};
use trueness_document::plan::SizeWord;
use trueness_geom::progress::Progress;
use trueness_geom::rigid::Rigid;
use trueness_geom::space::Point;

/// A characteristic with its features as the model has them.
pub(super) struct OfModel<'a> {
    pub plan: &'a Plan,
    pub spec: &'a Spec,
    pub features: Vec<&'a MeasuredFeature>,
    pub datums: Vec<Vec<&'a MeasuredFeature>>,
    /// How far from its nominal the toleranced feature is sought, mm.
    pub reach: f64,
    pub progress: &'a dyn Progress,
}

impl OfModel<'_> {
    /// The greatest value up to which the model keeps a tolerance: numbers of drawings are rounded.
    pub fn rounded(&self, tolerance: f64) -> f64 {
        tolerance.max(2.0 * DRAWN_ROUNDING_SHARE * self.reach)
    }

    /// The same to be measured, of a characteristic that may say something else.
    pub fn measuring<'b>(&'b self, spec: &'b Spec) -> Measuring<'b> {
        Measuring { spec, features: &self.features, datums: &self.datums, progress: self.progress }
    }
}

/// Share of the distance within which a feature is sought up to which numbers are those of the model: what a drawing rounds.
const DRAWN_ROUNDING_SHARE: f64 = 0.01;

/// What a characteristic says, held against the model.
pub(super) enum Compared {
    /// The same.
    Alike,
    /// The plan gives no exact dimensions; these are the model's.
    Exact(Basic),
    /// Something else, which is to be told with the value.
    Differs(String),
}

/// A characteristic held against the model.
pub(super) fn compared(of: &OfModel) -> Result<Compared, Stop> {
    let exact = match of.spec.kind.exact(&of.measuring(of.spec)) {
        None => return dimension(of),
        Some(Err(Missing::Cancelled)) => return Err(Stop::Cancelled),
        // What its datums do not allow is told when the part is measured.
        Some(Err(_)) => return Ok(Compared::Alike),
        Some(Ok(exact)) => exact,
    };
    let Some(span) = &of.spec.basic_span else { return Ok(Compared::Exact(exact)) };
    let tolerance = match of.spec.limits {
        Limits::Greatest(t) => t,
        Limits::Between { .. } => 0.0,
    };
    let own = of.value(of.spec.basic);
    let (rounded, most) = (of.rounded(tolerance), 2.0 * of.reach);
    if own.as_ref().is_ok_and(|v| *v <= rounded) {
        return Ok(Compared::Alike);
    }
    let value = own.as_ref().copied().unwrap_or(f64::INFINITY);
    let wrong = |what: String| Err(Stop::Plan { span: span.clone(), what });
    let why = own.as_ref().err().map(Missing::to_string);
    if of.spec.basic.angle.is_some() {
        let other =
            other_angles(of.spec.basic).into_iter().find(|b| of.value(*b).is_ok_and(|v| v <= rounded));
        let text = angle_text(of.spec, &exact, other.is_some(), value);
        return if other.is_some() || value > most { wrong(text) } else { Ok(Compared::Differs(text)) };
    }
    let mut best: Option<(f64, Basic)> = None;
    for other in other_places(of.spec.basic.place) {
        if let Ok(v) = of.value(other)
            && v < value
            && best.is_none_or(|(least, _)| v < least)
        {
            best = Some((v, other));
        }
    }
    let limit = if value > most { most.max(rounded) } else { rounded };
    let other = best.filter(|(v, _)| *v <= limit).map(|(_, basic)| basic);
    let frame = of.frame();
    let in_model = frame.as_ref().and_then(|_| of.spec.basic_in_model(of.middle()?, 0.5 * rounded));
    let place = Place { frame, middle: of.middle(), exact, other, is_of_model: in_model.is_some(), why };
    let asked = AskedPlace { plan: of.plan, spec: of.spec, distance: 0.5 * value };
    let refused = place.other.is_some() || place.is_of_model || value > most;
    let text = place_text(&asked, &place, refused);
    if refused { wrong(text) } else { Ok(Compared::Differs(text)) }
}

impl OfModel<'_> {
    /// The value of the model by these exact dimensions, or why there is none. A material requirement does not move the true place.
    fn value(&self, basic: Basic) -> Result<f64, Missing> {
        let mut spec = Spec { basic, material: None, boundary: None, ..self.spec.clone() };
        for datum in &mut spec.datums {
            (datum.material, datum.boundary) = (None, None);
        }
        if self.spec.kind.word() == Size.word() {
            spec.size = Some(SizeWord::Gg);
        }
        spec.kind.measure(&self.measuring(&spec)).map(|v| v.value)
    }

    /// The datum system on the model; `None` where it leaves motions free: then no place has coordinates of its own.
    fn frame(&self) -> Option<Rigid> {
        let (frame, free) = crate::characteristic::frame(&self.measuring(self.spec)).ok()?;
        (!free.shift.contains(&true) && !free.turn.contains(&true)).then_some(frame)
    }

    fn middle(&self) -> Option<Point> {
        self.features.first()?.middle().ok()
    }
}

impl Spec {
    /// Whether the coordinates that it gives are those of a place in the frame of the model.
    fn basic_in_model(&self, middle: Point, within: f64) -> Option<()> {
        let off = |(k, x): (usize, Option<f64>)| x.map_or(0.0, |x| x - middle[k]);
        let off = self.basic.place.into_iter().enumerate().map(off);
        (off.fold(0.0, libm::hypot) <= within).then_some(())
    }
}

/// The same numbers with other signs, and along other axes.
fn other_places(place: [Option<f64>; 3]) -> Vec<Basic> {
    let numbers: Vec<f64> = place.into_iter().flatten().collect();
    const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let mut all: Vec<Basic> = vec![];
    for order in ORDERS {
        for signs in 0..1_u32 << numbers.len() {
            let mut other = [None; 3];
            for (k, x) in numbers.iter().enumerate() {
                let sign = if (signs >> k) & 1 == 1 { -1.0 } else { 1.0 };
                other[order[k]] = Some(sign * x);
            }
            if other != place && all.iter().all(|b| b.place != other) {
                all.push(Basic { place: other, ..Basic::default() });
            }
        }
    }
    all
}

/// The angles to which a drawing may show the same: that to a right angle, of both.
fn other_angles(basic: Basic) -> Vec<Basic> {
    let across = |a: f64| std::f64::consts::FRAC_PI_2 - a;
    let (angle, turn) = (basic.angle, basic.turn);
    let all = [(angle.map(across), turn), (angle, turn.map(across)), (angle.map(across), turn.map(across))];
    all.into_iter().map(|(angle, turn)| Basic { angle, turn, ..basic }).filter(|b| *b != basic).collect()
}

/// How many times less a value must be by another reading, where only the measured part tells: far more than parts are off.
const CLEAR_VALUE_RATIO: f64 = 20.0;

/// What is said of exact dimensions that the measured part keeps by another reading only; for plans without a model.
pub(super) fn fits_otherwise(of: &OfModel) -> Option<String> {
    let (Limits::Greatest(tolerance), Some(_)) = (of.spec.limits, &of.spec.basic_span) else { return None };
    let own = of.value(of.spec.basic).ok().filter(|v| *v > tolerance)?;
    let is_angle = of.spec.basic.angle.is_some();
    let others = if is_angle { other_angles(of.spec.basic) } else { other_places(of.spec.basic.place) };
    let mut best: Option<(f64, Basic)> = None;
    for other in others {
        if let Ok(v) = of.value(other)
            && CLEAR_VALUE_RATIO * v <= own
            && best.is_none_or(|(least, _)| v < least)
        {
            best = Some((v, other));
        }
    }
    best.map(|(value, other)| other_text(of.plan, &other, value))
}

/// A nominal size, distance or angle held against the model.
fn dimension(of: &OfModel) -> Result<Compared, Stop> {
    let Limits::Between { nominal, lower, upper } = of.spec.limits else { return Ok(Compared::Alike) };
    let Ok(value) = of.value(of.spec.basic) else { return Ok(Compared::Alike) };
    let is_angle = of.spec.unit() == "deg";
    let rounded = if is_angle { 0.0 } else { DRAWN_ROUNDING_SHARE * of.reach };
    if value >= nominal + lower - rounded && value <= nominal + upper + rounded {
        return Ok(Compared::Alike);
    }
    let others: &[(&str, f64)] = match is_angle {
        true => &[("its complement", 90.0 - nominal), ("its supplement", 180.0 - nominal)],
        false if of.spec.kind.word() == Size.word() => {
            &[("its radius", 2.0 * nominal), ("twice its size", 0.5 * nominal)]
        }
        false => &[],
    };
    let within = lower.abs().max(upper.abs()).max(rounded);
    let other = others.iter().find(|(_, other)| (other - value).abs() <= within).map(|(what, _)| *what);
    let text = sizes_text(of.plan, of.spec, value, other);
    match other {
        Some(_) => Err(Stop::Plan { span: of.spec.limits_span.clone(), what: text }),
        None => Ok(Compared::Differs(text)),
    }
}
