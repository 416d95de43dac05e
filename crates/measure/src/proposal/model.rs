//! A plan proposed from a CAD model: its own tolerances, else the usual characteristics of its faces.

use super::datums::Datums;
use super::dimension;
use super::draft::Draft;
use super::faces::Faces;
use super::geometric::{self, Context};
use super::text::{comment, listed, quoted};
use super::usual::usual;
use trueness_cad::model::Model;
use trueness_geom::shape::{Kind, Shape};

/// Parts of keywords of entities that are lost tolerances where they cannot be read.
const TOLERANCES: [&str; 3] = ["TOLERANCE", "DIMENSION", "DATUM"];

/// The text of a plan for a model whose file is called `reference`. It parses. Each tolerance of the model is a characteristic, or a
/// comment that says why plans have it not; counts of both stand at the end. A model without tolerances gives its planes, cylinders,
/// cones and spheres as features with placeholders.
pub fn of_model(model: &Model, reference: &str) -> String {
    let faces = Faces::of(model);
    let tolerances = &model.tolerances;
    match tolerances.geometric.is_empty() && tolerances.dimensions.is_empty() && tolerances.datums.is_empty()
    {
        true => placeholders(&faces, reference),
        false => with_tolerances(model, &faces, reference),
    }
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

fn with_tolerances(model: &Model, faces: &Faces, reference: &str) -> String {
    let all = &model.tolerances;
    let mut draft = Draft::of(faces);
    let (datums, datums_in) = Datums::of(&mut draft, &all.datums);
    // Material requirements go by sizes, so these come first.
    let dimensions_in = all.dimensions.iter().filter(|d| dimension::add(&mut draft, d)).count();
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
    let mut out = head(reference, "Its tolerances are those of the model.", &align);
    let is_judged = draft.is_judged();
    out.push_str(&draft.finished());
    out.push_str(if is_judged { "\n" } else { PLACEHOLDER_DEVIATION });
    out.extend(counts);
    out
}

/// Every plane, cylinder, cone and sphere is a feature; the first plane is the datum.
fn placeholders(faces: &Faces, reference: &str) -> String {
    let said = "Tolerances are placeholders: put in those of the drawing, take out what is not toleranced.";
    let mut draft = Draft::of(faces);
    let (groups, none) = faces.groups(faces.numbers());
    let mut features: Vec<(String, Shape)> = vec![];
    let mut datum = Some("A");
    for group in &groups {
        let wanted = if group.shape.kind() == Kind::Plane { datum.take() } else { None };
        let id = draft.feature(group, wanted);
        draft.keep(&id);
        features.push((id, group.shape));
    }
    if !none.is_empty() {
        draft.say(&format!("Faces that are no features of plans: {}.", none.join(", ")));
    }
    let judged = if features.is_empty() { PLACEHOLDER_DEVIATION.into() } else { usual(&features) };
    head(reference, said, BEST_FIT) + &draft.finished() + &judged
}
