//! A plan proposed from a CAD model: its own tolerances, else the usual characteristics of its faces.

use super::datums::Datums;
use super::dimension;
use super::draft::{Draft, Refused};
use super::faces::{Faces, Group};
use super::general::{self, General};
use super::geometric::{self, Context};
use super::text::{comment, listed, quoted};
use super::usual::{as_drawn, usual};
use crate::inspection::{Data, Stop, on_model};
use crate::plan::Plan;
use trueness_cad::model::Model;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::shape::{Kind, Shape};

/// Parts of keywords of entities that are lost tolerances where they cannot be read.
const TOLERANCES: [&str; 3] = ["TOLERANCE", "DIMENSION", "DATUM"];

/// What a proposal is asked.
#[derive(Clone, Copy, Debug)]
pub struct Proposal<'a> {
    /// What the plan calls the file of the model.
    pub reference: &'a str,
    /// What holds where the model states no tolerance.
    pub general: Option<&'a General>,
}

/// The text of a plan for a model. It parses, and `inspect` accepts it. Each tolerance of the model is a characteristic, or a comment that says
/// why plans have it not; counts of both stand at the end. A model without tolerances gives its planes, cylinders, cones and spheres as
/// features with the general tolerances, else with placeholders. What the model itself contradicts is a comment. `data` has the model as a
/// reference: its faces and the mesh that draws them.
///
/// # Errors
/// [`Cancelled`].
pub fn of_model(
    model: &Model,
    data: &Data,
    asked: &Proposal,
    progress: &dyn Progress,
) -> Result<String, Cancelled> {
    let (Some(cad), Some(mesh)) = (&data.faces, &data.reference) else { return Ok(String::new()) };
    let faces = Faces::of(cad, mesh);
    let proposed = |refused: &Refused| match model.tolerances.is_empty() {
        true => without_tolerances(&faces, asked, refused),
        false => with_tolerances(model, &faces, asked, refused),
    };
    let first = proposed(&Refused::new());
    Ok(match contradicted(&first, data, progress) {
        Ok(refused) if refused.is_empty() => first,
        Ok(refused) => proposed(&refused),
        Err(Unheld::Cancelled(cancelled)) => return Err(cancelled),
        Err(Unheld::Other(why)) => {
            first + "\n" + &comment(&format!("The plan was not held against the model: {why}"))
        }
    })
}

/// Why a plan was not held against the model.
enum Unheld {
    Cancelled(Cancelled),
    Other(String),
}

/// The characteristics that the model contradicts.
fn contradicted(text: &str, data: &Data, progress: &dyn Progress) -> Result<Refused, Unheld> {
    let plan = Plan::parse(text).map_err(|e| Unheld::Other(e.to_string()))?;
    let found = on_model(&plan, data, progress).map_err(|stop| match stop {
        Stop::Cancelled => Unheld::Cancelled(Cancelled),
        stop => Unheld::Other(stop.to_string()),
    })?;
    let wrong = plan.specs.iter().zip(found).filter_map(|(spec, why)| Some((spec.id.clone(), why?)));
    Ok(wrong.collect())
}

fn head(reference: &str, said: &str, align: &str) -> String {
    format!(
        "{}schema = \"trueness/plan/1\"\nunits = \"mm\"\nmeasured = \"scan.stl\"\nreference = {}\n\n{align}",
        comment(&format!("Proposed from {}. {said}", quoted(reference))),
        quoted(reference)
    )
}

/// What a plan without a characteristic judges.
const PLACEHOLDER_DEVIATION: &str = "\n# No feature can be judged: the deviations from all faces are, by a placeholder.\n[deviation]\ntolerance = 0.1\n";

const BEST_FIT: &str = "# \"none\" where the scan lies in the coordinates of the model already.\n[align]\nmethod = \"best-fit\"\n";

fn with_tolerances(model: &Model, faces: &Faces, asked: &Proposal, refused: &Refused) -> String {
    let all = &model.tolerances;
    let mut draft = Draft::of(faces, refused);
    let (datums, datums_in) = Datums::of(&mut draft, &all.datums);
    // Material requirements go by sizes, so these come first.
    let dimensions_in =
        all.dimensions.iter().filter(|d| dimension::add(&mut draft, d, asked.general)).count();
    let aligned = datums.most_used(&all.geometric);
    let context = Context { datums: &datums, aligned: aligned.as_ref() };
    let geometric_in = all.geometric.iter().filter(|t| geometric::add(&mut draft, &context, t)).count();
    let lost = model.unread.iter().filter(|u| TOLERANCES.iter().any(|t| u.keyword.contains(t)));
    for lost in lost {
        draft.say(&format!("Not in the plan: #{} {}: {}", lost.entity, lost.keyword, lost.reason));
    }
    let align = match &aligned {
        Some(named) => {
            let names: Vec<String> = named.names.iter().map(|name| quoted(name)).collect();
            format!(
                "# By the datum system of most tolerances; sought from the best fit.\n[align]\nmethod = \"datum\"\ndatums = [{}]\n",
                listed(&names)
            )
        }
        None => BEST_FIT.to_string(),
    };
    let counts = [
        ("datums", datums_in, all.datums.len()),
        ("dimensions", dimensions_in, all.dimensions.len()),
        ("geometric tolerances", geometric_in, all.geometric.len()),
    ];
    let counts = counts.map(|(what, found, all)| {
        comment(&format!("{what} of the model: {found} in the plan, {} as comments", all - found))
    });
    let mut out = head(asked.reference, "Its tolerances are those of the model.", &align);
    let is_judged = draft.is_judged();
    out.push_str(&draft.finished());
    out.push_str(if is_judged { "\n" } else { PLACEHOLDER_DEVIATION });
    out.extend(counts);
    out
}

/// Every plane, cylinder, cone and sphere is a feature; the first plane is the datum.
fn without_tolerances(faces: &Faces, asked: &Proposal, refused: &Refused) -> String {
    let said = match asked.general {
        Some(_) => "Tolerances are the general ones: take out what the drawing does not tolerance so.",
        None => "Tolerances are placeholders: put in those of the drawing, take out what is not toleranced.",
    };
    let mut draft = Draft::of(faces, refused);
    let (groups, none) = faces.groups(faces.numbers());
    let mut features: Vec<(String, Group)> = vec![];
    let mut datum = Some("A");
    for group in groups {
        let wanted = if group.shape.kind() == Kind::Plane { datum.take() } else { None };
        let id = draft.feature(&group, wanted);
        draft.keep(&id);
        features.push((id, group));
    }
    if !none.is_empty() {
        draft.say(&format!("Faces that are no features of plans: {}.", none.join(", ")));
    }
    let judged = match asked.general {
        Some(general) => general::characteristics(general, faces, &features, refused),
        None => {
            let shapes: Vec<(String, Shape)> =
                features.into_iter().map(|(id, group)| (id, group.shape)).collect();
            usual(&shapes, as_drawn, refused)
        }
    };
    let is_judged = judged.lines().any(|line| line == "[[characteristic]]");
    let judged = if is_judged { judged } else { judged + PLACEHOLDER_DEVIATION };
    head(asked.reference, said, BEST_FIT) + &draft.finished() + &judged
}
