//! What is said of numbers that the model contradicts: both readings, and what to write.

use crate::characteristic::{COORDINATES, Spec};
use crate::plan::Plan;
use crate::requirement::{Basic, Limits};
use trueness_geom::rigid::Rigid;
use trueness_geom::space::Point;

/// A characteristic and how far its place is from the model's.
pub(super) struct AskedPlace<'a> {
    pub plan: &'a Plan,
    pub spec: &'a Spec,
    /// Distance of the plan's place from the model's, mm; infinite where the plan's is none.
    pub distance: f64,
}

/// A place on the model.
pub(super) struct Place {
    /// Takes the coordinates of the model to those of the datum system; `None` where that leaves motions free.
    pub frame: Option<Rigid>,
    /// The feature's place in the model.
    pub middle: Option<Point>,
    /// What the plan should say.
    pub exact: Basic,
    /// The reading that fits.
    pub other: Option<Basic>,
    /// Whether the plan's numbers are coordinates of the model.
    pub is_of_model: bool,
    /// Why the plan's coordinates place nothing.
    pub why: Option<String>,
}

/// A length in the plan's unit, rounded as drawings are.
fn length(plan: &Plan, x: f64) -> String {
    let unit = plan.units.map_or(1.0, |u| u.millimeters());
    trimmed((x * 1e4).round() / 1e4 / unit)
}

/// Without digits that say nothing.
fn trimmed(x: f64) -> String {
    let text = format!("{x:.7}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

fn coordinates(plan: &Plan, place: [Option<f64>; 3]) -> String {
    let given =
        COORDINATES.iter().zip(place).filter_map(|(name, x)| Some(format!("{name} = {}", length(plan, x?))));
    given.collect::<Vec<_>>().join(", ")
}

/// The coordinates that a plan should give: those of the reading that fits, else those that place the feature; the model's numbers.
fn right(place: &Place, spec: &Spec) -> [Option<f64>; 3] {
    let axes = match (place.other, &place.why) {
        (Some(other), _) => other.place,
        (None, None) => spec.basic.place,
        (None, Some(_)) => return place.exact.place,
    };
    std::array::from_fn(|k| place.exact.place[k].filter(|_| axes[k].is_some()))
}

/// What is said of a place.
pub(super) fn place_text(asked: &AskedPlace, place: &Place, refused: bool) -> String {
    let (plan, spec) = (asked.plan, asked.spec);
    let feature = spec.features.first().map_or("", |n| plan.features[*n].id.as_str());
    let system = match spec.frame {
        Some(_) => "in its `frame`".to_string(),
        None => {
            let names: Vec<String> = spec.datums.iter().map(|d| d.name(&plan.features)).collect();
            format!("in the datum system {}", names.join(" | "))
        }
    };
    let given = coordinates(plan, spec.basic.place);
    let of_model = place.middle.map_or_else(String::new, |p| coordinates(plan, p.map(Some)));
    let right = right(place, spec);
    let is_oblique = place.exact.place == [None; 3];
    let there =
        if is_oblique { String::new() } else { format!(", which is {} {system}", coordinates(plan, right)) };
    let mut text = format!("\"{}\": ", spec.id);
    match &place.why {
        Some(why) => text += why,
        None => {
            // Coordinates that the plan leaves out are the feature's own.
            let seen = place.frame.zip(place.middle).map(|(frame, middle)| {
                let own = frame.point(middle);
                let here: Point = std::array::from_fn(|k| spec.basic.place[k].unwrap_or(own[k]));
                coordinates(plan, frame.inverse().point(here).map(Some))
            });
            let seen = seen.map_or_else(String::new, |seen| format!(" ({seen} of the model)"));
            text += &format!(
                "{given} {system}{seen} is {} {} off the model's feature \"{feature}\"",
                length(plan, asked.distance),
                plan.units.map_or("mm", |u| u.name())
            );
        }
    }
    text += &format!("; the model has it at {of_model}{there}");
    text += match (place.is_of_model, place.other) {
        (true, _) => "; the plan's numbers are coordinates of the model",
        (_, Some(_)) => "; the plan's numbers fit with other signs or along other axes",
        _ if refused && place.why.is_none() => {
            "; no part could pass, as the feature is sought where the model has it"
        }
        _ => "",
    };
    if refused && is_oblique {
        return text + "; leave `basic` out: the place is then the model's";
    }
    if refused {
        text += &format!(
            "; write basic = {{ {} }}, or leave it out: the place is then the model's",
            coordinates(plan, right)
        );
        if spec.frame.is_none() {
            text += " (z goes into a first plane, x into a second, y makes the frame right-handed)";
        }
    }
    text
}

/// What is said of an angle.
pub(super) fn angle_text(spec: &Spec, exact: &Basic, is_other: bool, value: f64) -> String {
    let degrees = |x: Option<f64>| x.map(|x| trimmed((x.to_degrees() * 1e4).round() / 1e4));
    let written = |basic: &Basic| {
        let turn = basic.turn.filter(|_| spec.basic.turn.is_some());
        let all = [("angle", degrees(basic.angle)), ("turn", degrees(turn))];
        let given = all.into_iter().filter_map(|(name, x)| Some(format!("{name} = {}", x?)));
        format!("{{ {} }}", given.collect::<Vec<_>>().join(", "))
    };
    let off = if value.is_finite() {
        format!(": by the plan's the model itself has a value of {}", trimmed((value * 1e4).round() / 1e4))
    } else {
        String::new()
    };
    let which = if is_other { "; the plan gives the angle to the other leg of a right angle" } else { "" };
    format!(
        "\"{}\": basic = {} is not as the model has it, {}{off}{which}; write basic = {}, or leave it out: the angle is then the model's",
        spec.id,
        written(&spec.basic),
        written(exact),
        written(exact)
    )
}

/// What is said where the measured part keeps another reading.
pub(super) fn other_text(plan: &Plan, other: &Basic, value: f64) -> String {
    let degrees = |x: Option<f64>| x.map(|x| trimmed((x.to_degrees() * 1e4).round() / 1e4));
    let angles = [("angle", degrees(other.angle)), ("turn", degrees(other.turn))];
    let angles = angles.into_iter().filter_map(|(name, x)| Some(format!("{name} = {}", x?)));
    let all: Vec<String> =
        angles.chain(Some(coordinates(plan, other.place)).filter(|c| !c.is_empty())).collect();
    format!(
        "the part keeps the numbers of `basic` in another reading: basic = {{ {} }} gives {}; z goes into a first plane, x into a second, y \
         makes the frame right-handed",
        all.join(", "),
        trimmed((value * 1e4).round() / 1e4)
    )
}

/// What is said of a nominal size, distance or angle.
pub(super) fn sizes_text(plan: &Plan, spec: &Spec, value: f64, other: Option<&str>) -> String {
    let Limits::Between { nominal, lower, upper } = spec.limits else { return String::new() };
    let number =
        |x: f64| if spec.unit() == "mm" { length(plan, x) } else { trimmed((x * 1e4).round() / 1e4) };
    let (model, is) = (number(value), number(nominal));
    match other {
        Some(what) => format!(
            "\"{}\": the nominal value is {is}, but its feature has {model} in the plan: {is} is {what}; write nominal = {model}, or mend the feature if that is wrong",
            spec.id
        ),
        None => format!(
            "the model itself has {model} there, which is not within {} to {}",
            number(nominal + lower),
            number(nominal + upper)
        ),
    }
}
