//! A geometric tolerance of a model as characteristics of a plan.

use super::datums::{Datums, Named, material, place};
use super::draft::Draft;
use super::faces::Group;
use super::text::{decimal, listed, quoted};
use trueness_cad::tolerances::GeometricTolerance;
use trueness_document::plan::KINDS;
use trueness_geom::shape::Kind;

/// Modifiers that say how a part is to be measured or made, or what a plan does anyway.
const REMARKS: [&str; 4] =
    ["free state", "separate requirement", "statistical tolerance", "regardless of feature size"];
/// Remarks on targets whose faces tell the same.
const TOLD_BY_FACES: [&str; 4] = ["all around", "between", "continuous", "all over"];
/// What the form of an axis's zone is called, among other words.
const ROUND_ZONE: &str = "cylindrical";
/// A frame that stands where the aligned data do.
const ALIGNED: &str = "frame = { origin = [0.0, 0.0, 0.0], x = [1.0, 0.0, 0.0], z = [0.0, 0.0, 1.0] }\n";

/// What is known where a tolerance becomes characteristics.
pub(super) struct Context<'a> {
    pub datums: &'a Datums,
    /// The datum system that the data are aligned by.
    pub aligned: Option<&'a Named>,
}

/// Puts a tolerance into the plan, or says why it is not; whether all of it is there.
pub(super) fn add(draft: &mut Draft, context: &Context, tolerance: &GeometricTolerance) -> bool {
    let said = said(tolerance);
    let outcome = prepared(context, tolerance).and_then(|made| {
        let (groups, mut none) = draft.faces.groups(tolerance.of.faces.iter().copied());
        if groups.is_empty() {
            return Err(none.first().cloned().unwrap_or_else(|| "it has no faces".into()));
        }
        if let (true, Some(id)) = (made.is_of_middle, draft.median(&groups)) {
            let number = tolerance.entity.to_string();
            let lines = made.lines(&id, None, tolerance)?;
            draft.characteristic(&said, (&number, &lines), &made.features(&id)).map(|()| none)
        } else {
            let several = groups.len() > 1;
            for (k, group) in groups.iter().enumerate() {
                let id = draft.feature(group, None);
                let number = if several {
                    format!("{}.{}", tolerance.entity, k + 1)
                } else {
                    tolerance.entity.to_string()
                };
                let lines = made.lines(&id, Some(group), tolerance);
                let put = lines
                    .and_then(|lines| draft.characteristic(&said, (&number, &lines), &made.features(&id)));
                none.extend(put.err().map(|why| match several {
                    true => format!("{id}: {why}"),
                    false => why,
                }));
            }
            Ok(none)
        }
    });
    let why = outcome.unwrap_or_else(|why| vec![why]);
    if !why.is_empty() {
        draft.say(&format!("Not in the plan: {said}: {}", why.join("; ")));
    }
    why.is_empty()
}

/// A tolerance in words: number, kind, value, datums, faces.
fn said(tolerance: &GeometricTolerance) -> String {
    let mut text = format!("#{} {}", tolerance.entity, tolerance.kind);
    if let Some(width) = tolerance.width {
        text.push_str(&format!(" {}", decimal(width)));
    }
    for modifier in &tolerance.modifiers {
        text.push_str(&format!(" ({modifier})"));
    }
    let datums = tolerance.datums.iter().map(|reference| {
        let parts = reference.parts.iter().map(|p| {
            p.modifiers.iter().fold(p.letter.clone(), |name, modifier| format!("{name} ({modifier})"))
        });
        parts.collect::<Vec<_>>().join("-")
    });
    let datums: Vec<String> = datums.collect();
    if !datums.is_empty() {
        text.push_str(&format!(" to {}", datums.join(" | ")));
    }
    text.push_str(&format!(", of {}", place(&tolerance.of)));
    for note in tolerance.of.notes.iter().chain(&tolerance.notes) {
        text.push_str(&format!(", {note}"));
    }
    if !tolerance.name.is_empty() {
        text.push_str(&format!(", \"{}\"", tolerance.name));
    }
    text
}

/// A tolerance that a plan may have.
struct Prepared {
    kind: String,
    named: Named,
    material: Option<&'static str>,
    is_round: bool,
    /// Whether two opposite planes are toleranced by the plane amid them.
    is_of_middle: bool,
    /// Whether the data are aligned by its datums, and a frame stands for them.
    is_aligned: bool,
}

fn prepared(context: &Context, tolerance: &GeometricTolerance) -> Result<Prepared, String> {
    let kind = match &tolerance.kind[..] {
        "concentricity" => "coaxiality".to_string(),
        kind => kind.replace(' ', "-"),
    };
    if !KINDS.contains(&&kind[..]) {
        return Err(format!("plans have no \"{kind}\""));
    }
    if tolerance.width.is_none() {
        return Err("its width is not known".into());
    }
    let notes = tolerance.of.notes.iter().filter(|n| !TOLD_BY_FACES.contains(&&n[..]));
    // The upper one of a composite tolerance stands by itself.
    let notes = notes.chain(tolerance.notes.iter().filter(|n| !n.ends_with("below it")));
    if let Some(note) = notes.last() {
        return Err(format!("plans have no \"{note}\""));
    }
    let mut requirement = None;
    for modifier in &tolerance.modifiers {
        match (material(modifier), REMARKS.contains(&&modifier[..])) {
            (Some(letter), _) => requirement = Some(letter),
            (None, true) => {}
            (None, false) => return Err(format!("plans have no modifier \"{modifier}\"")),
        }
    }
    let named = context.datums.named(&tolerance.datums)?;
    let is_profile = kind.ends_with("profile");
    let is_aligned = is_profile && context.aligned.is_some_and(|aligned| aligned.names == named.names);
    if is_profile && !named.names.is_empty() && !is_aligned {
        return Err("a profile has no datums in plans but those of the alignment".into());
    }
    Ok(Prepared {
        is_of_middle: matches!(&kind[..], "position" | "symmetry"),
        is_round: tolerance.zone.as_deref().is_some_and(|zone| zone.contains(ROUND_ZONE)),
        material: requirement,
        kind,
        named,
        is_aligned,
    })
}

impl Prepared {
    /// The features that a characteristic of this one names.
    fn features(&self, own: &str) -> Vec<String> {
        let datums = if self.is_aligned { &[] } else { self.named.ids.as_slice() };
        [own.to_string()].iter().chain(datums).cloned().collect()
    }

    /// The lines of a characteristic.
    fn lines(
        &self,
        id: &str,
        group: Option<&Group>,
        tolerance: &GeometricTolerance,
    ) -> Result<String, String> {
        let width = decimal(tolerance.width.unwrap_or_default());
        let mut lines = format!("kind = \"{}\"\nfeature = {}\ntolerance = {width}\n", self.kind, quoted(id));
        let shape = group.map(|g| g.shape.kind());
        let is_axis = matches!(shape, Some(Kind::Cylinder | Kind::Cone));
        match &self.kind[..] {
            "position" | "coaxiality" | "straightness" if is_axis && !self.is_round => {
                return Err(
                    "the file states no cylindrical zone for the axis; plans have no other one here".into()
                );
            }
            "parallelism" | "perpendicularity" | "angularity" if is_axis => {
                lines.push_str(&format!("diametral = {}\n", self.is_round));
            }
            "circular-runout" if shape == Some(Kind::Plane) => lines.push_str("direction = \"axial\"\n"),
            _ => {}
        }
        if self.is_aligned {
            lines.push_str(ALIGNED);
        } else if !self.named.names.is_empty() {
            let names: Vec<String> = self.named.names.iter().map(|name| quoted(name)).collect();
            lines.push_str(&format!("datums = [{}]\n", listed(&names)));
        }
        if let Some(letter) = self.material {
            lines.push_str(&format!("material = \"{letter}\"\n"));
        }
        Ok(lines)
    }
}
