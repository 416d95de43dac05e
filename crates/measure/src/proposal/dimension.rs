//! A dimension of a model as characteristics of a plan.

use super::datums::place;
use super::draft::Draft;
use super::faces::Group;
use super::general::{General, of_radius};
use super::sides;
use super::text::{decimal, quoted};
use trueness_cad::tolerances::Dimension;
use trueness_geom::shape::Kind;

/// The greatest angle that plans take, degrees.
const MAX_PLAN_ANGLE: f64 = 90.0;

/// Puts a dimension into the plan, or says why it is not; whether all of it is there.
pub(super) fn add(draft: &mut Draft, dimension: &Dimension, general: Option<&General>) -> bool {
    let said = said(dimension);
    let asked = Asked { dimension, general, said: &said };
    let outcome = match dimension.of.as_slice() {
        [_] if dimension.is_angle => Err("plans have no angle of one feature".into()),
        [one] => size(draft, &asked, &one.faces),
        [from, to] => between(draft, &asked, [&from.faces, &to.faces]),
        _ => Err("it is of nothing".into()),
    };
    let why = outcome.unwrap_or_else(|why| vec![why]);
    if !why.is_empty() {
        draft.say(&format!("Not in the plan: {said}: {}", why.join("; ")));
    }
    why.is_empty()
}

/// A dimension, what holds where it has no limits, and its words.
struct Asked<'a> {
    dimension: &'a Dimension,
    general: Option<&'a General>,
    said: &'a str,
}

/// A number as plans write it: angles are in degrees.
fn shown(dimension: &Dimension, value: f64) -> String {
    decimal(if dimension.is_angle { value.to_degrees() } else { value })
}

/// A dimension in words: number, name, value, limits, faces.
fn said(dimension: &Dimension) -> String {
    let mut text = format!("#{} {}", dimension.entity, dimension.name.trim());
    let shown = |value: f64| shown(dimension, value);
    if let Some(nominal) = dimension.nominal {
        text.push_str(&format!(" {}", shown(nominal)));
    }
    if let Some([lower, upper]) = dimension.deviations {
        text.push_str(&format!(" {} to {}", shown(lower), shown(upper)));
    }
    if let Some([least, greatest]) = dimension.limits {
        text.push_str(&format!(" from {} to {}", shown(least), shown(greatest)));
    }
    if let Some(class) = &dimension.class {
        text.push_str(&format!(" {class}"));
    }
    let places: Vec<String> = dimension.of.iter().map(place).collect();
    text.push_str(&format!(", of {}", places.join(" and ")));
    let notes = dimension.of.iter().flat_map(|t| &t.notes).chain(&dimension.notes);
    notes.for_each(|note| text.push_str(&format!(", {note}")));
    text
}

/// The lines for nominal value and limits: of a radius those of the diameter.
fn limits(asked: &Asked, is_radius: bool) -> Result<String, String> {
    let (dimension, factor) = (asked.dimension, if is_radius { 2.0 } else { 1.0 });
    let Some((nominal, [lower, upper])) = dimension.range() else {
        let Some(nominal) = dimension.nominal else { return Err("it has no value".into()) };
        let by_class =
            |class: &str| format!("nominal = {}\nclass = {}\n", shown(dimension, nominal), quoted(class));
        return match (&dimension.class, asked.general) {
            (Some(class), _) if !is_radius => Ok(by_class(class)),
            (None, Some(_)) if dimension.is_angle => {
                Err("it has no limits, and the general ones of angles go by the length of a leg".into())
            }
            (None, Some(general)) if is_radius => of_radius(general, nominal).map(|[lower, upper]| {
                let [nominal, lower, upper] = [2.0 * nominal, lower, upper].map(decimal);
                format!("nominal = {nominal}\nupper = {upper}\nlower = {lower}\n")
            }),
            (None, Some(General { dimensions: Some(class), .. })) => Ok(by_class(&class.to_string())),
            _ => Err("it has no limits".into()),
        };
    };
    let mut values = [nominal, lower, upper].map(|x| x * factor);
    if dimension.is_angle && nominal.to_degrees() > MAX_PLAN_ANGLE {
        // Plans take the angle that is the smaller one.
        values = [std::f64::consts::PI - nominal, -upper, -lower];
    }
    let [nominal, lower, upper] = values.map(|x| shown(dimension, x));
    Ok(format!("nominal = {nominal}\nupper = {upper}\nlower = {lower}\n"))
}

fn size(draft: &mut Draft, asked: &Asked, faces: &[u64]) -> Result<Vec<String>, String> {
    let (dimension, said) = (asked.dimension, asked.said);
    let (groups, mut none) = draft.faces.groups(faces.iter().copied());
    if groups.is_empty() {
        return Err(none.first().cloned().unwrap_or_else(|| "it has no faces".into()));
    }
    let is_radius = dimension.name.contains("radius");
    let limits = limits(asked, is_radius)?;
    let lines = |feature: &str, size: &str| {
        format!("kind = \"size\"\nsize = \"{size}\"\nfeature = {feature}\n{limits}")
    };
    if super::faces::median(&groups).is_some() {
        let ids: Vec<String> = groups.iter().map(|g| draft.feature(g, None)).collect();
        let both: Vec<String> = ids.iter().map(|id| quoted(id)).collect();
        let lines = lines(&format!("[{}]", both.join(", ")), "LP");
        return draft.characteristic(said, (&dimension.entity.to_string(), &lines), &ids).map(|()| none);
    }
    let said = if is_radius { format!("{said}; as a diameter") } else { said.to_string() };
    let several = groups.len() > 1;
    for (k, group) in groups.iter().enumerate() {
        let id = draft.feature(group, None);
        let number = match several {
            true => format!("{}.{}", dimension.entity, k + 1),
            false => dimension.entity.to_string(),
        };
        let put = kind_of_size(dimension, group, is_radius).and_then(|size| {
            draft.characteristic(&said, (&number, &lines(&quoted(&id), size)), std::slice::from_ref(&id))
        });
        none.extend(put.err().map(|why| if several { format!("{id}: {why}") } else { why }));
    }
    Ok(none)
}

/// Which size by ISO 14405-1: two-point sizes are the usual ones; a rounding has no opposite points.
fn kind_of_size(dimension: &Dimension, group: &Group, is_radius: bool) -> Result<&'static str, String> {
    match group.shape.kind() {
        Kind::Cylinder if is_radius => Ok("GG"),
        Kind::Cylinder if dimension.name.contains("diamet") => Ok("LP"),
        Kind::Sphere => Ok("GG"),
        kind => Err(format!("plans have no {} of a {}", dimension.name.trim(), kind.name())),
    }
}

fn between(draft: &mut Draft, asked: &Asked, of: [&[u64]; 2]) -> Result<Vec<String>, String> {
    let dimension = asked.dimension;
    if let Some(side) = ["inner", "outer"].into_iter().find(|side| dimension.name.contains(side)) {
        return Err(format!("plans measure to the middle of a feature, not to its {side} side"));
    }
    let (mut ids, mut shapes) = (vec![], vec![]);
    for faces in of {
        let (groups, none) = draft.faces.groups(faces.iter().copied());
        match (groups.as_slice(), none.first()) {
            ([one], None) => {
                ids.push(draft.feature(one, None));
                shapes.push(one.shape);
            }
            (_, Some(why)) => return Err(why.clone()),
            ([], None) => return Err("it is not between faces".into()),
            (several, None) => return Err(format!("one side of it is {} surfaces", several.len())),
        }
    }
    if let ([from, to], Some((nominal, [lower, upper])), false) =
        (shapes.as_slice(), dimension.range(), dimension.is_angle)
        && let Some(sides) = sides::between(from, to, [nominal + lower, nominal + upper])
    {
        return Err(format!("it is from {sides}, and plans measure to the middle of a feature"));
    }
    let limits = limits(asked, false)?;
    let kind = if dimension.is_angle { "angle" } else { "distance" };
    let lines =
        format!("kind = \"{kind}\"\nfeature = {}\ndatums = [{}]\n{limits}", quoted(&ids[1]), quoted(&ids[0]));
    draft.characteristic(asked.said, (&dimension.entity.to_string(), &lines), &ids).map(|()| vec![])
}
