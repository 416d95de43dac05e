//! What a report draws of an inspection: every feature in the color of its worst verdict, and where values are reached.

use crate::views::segment::rim;
use crate::{Mark, MarkGroup, Marks, ViewObject, ViewRole};
use std::collections::BTreeMap;
use trueness_document::Verdict;
use trueness_document::inspect::{FeatureSource, InspectDocument};
use trueness_document::scale::palette::Rgb;
use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;
use trueness_geom::scan::Scan;
use trueness_measure::inspection::{DrawnFace, Inspection};
use trueness_measure::segment::cut_out;

/// Color of a verdict.
pub fn color(verdict: Verdict) -> Rgb {
    match verdict {
        Verdict::Pass => [0x11, 0x6b, 0x2e],
        Verdict::Fail => [0xc1, 0x1f, 0x2b],
        Verdict::Undecided => [0x8a, 0x52, 0x00],
        Verdict::NotMeasured => [0x57, 0x60, 0x6a],
    }
}

/// An inspection prepared for drawing.
pub struct View<'a> {
    /// The measured data without the features, then a part for each drawn feature.
    parts: Vec<Part>,
    /// Whose points are whose.
    drawn: &'a [DrawnFace],
    /// The deviations from the reference as a comparison draws them.
    deviations: Option<&'a super::compare::View<'a>>,
    /// Where the values are reached, one for each row of the list, in its order.
    pub marks: Vec<Marks>,
}

struct Part {
    name: String,
    scan: Scan,
    color: Option<Rgb>,
}

impl<'a> View<'a> {
    /// Of what was found, which the document tells.
    pub fn new(
        document: &InspectDocument,
        found: &'a Inspection,
        deviations: Option<&'a super::compare::View<'a>>,
    ) -> View<'a> {
        let mut parts = Vec::new();
        let whole = found.measured.as_ref();
        let mut free: Vec<bool> = vec![true; whole.map_or(0, |scan| scan.facets().len())];
        let verdicts = document.worst();
        for (taken, record) in found.features.iter().zip(&document.features) {
            let worst = verdicts.get(record.id.as_str()).copied();
            let mut own = Vec::new();
            for &facet in &taken.facets {
                if std::mem::replace(&mut free[facet as usize], false) {
                    own.push(facet as usize);
                }
            }
            let scan = match whole {
                Some(Scan::Mesh(mesh)) if !taken.facets.is_empty() => Scan::Mesh(cut_out(mesh, &own)),
                // What is derived is drawn by what it is made of.
                _ if *record.source == FeatureSource::Derived => continue,
                _ => Scan::Cloud(taken.points.clone()),
            };
            parts.push(Part { name: record.id.clone(), scan, color: worst.map(color) });
        }
        if let Some(scan) = whole {
            let rest: Vec<usize> = (0..free.len()).filter(|f| free[*f]).collect();
            let (name, color) = (String::new(), None);
            let scan = match scan {
                Scan::Cloud(_) => scan.clone(),
                Scan::Mesh(mesh) => Scan::Mesh(cut_out(mesh, &rest)),
            };
            parts.push(Part { name, scan, color });
        }
        parts.retain(|p| !p.scan.points().is_empty());
        View { marks: marks(document, &parts), parts, drawn: &found.drawn, deviations }
    }

    /// What is drawn.
    pub fn objects(&self) -> Vec<ViewObject<'_>> {
        let mut all: Vec<ViewObject> = self.parts.iter().map(Part::object).collect();
        all.extend(
            self.drawn
                .iter()
                .map(|d| ViewObject::plain(ViewRole::Partition, &d.name, Some(d.color), &d.scan)),
        );
        all.extend(self.deviations.into_iter().flat_map(super::compare::View::mapped));
        all
    }
}

impl Part {
    fn object(&self) -> ViewObject<'_> {
        ViewObject::plain(ViewRole::Part, &self.name, self.color, &self.scan)
    }
}

/// One mark a row: the rim of the feature and the places where the value is reached, in the color of the verdict.
fn marks(document: &InspectDocument, parts: &[Part]) -> Vec<Marks> {
    let mut groups: Vec<MarkGroup> = Vec::new();
    let own: Vec<(&str, &Mesh)> =
        parts.iter().filter_map(|p| Some((p.name.as_str(), p.scan.mesh()?))).collect();
    let rims: Vec<Mark> = own.par_iter().map(|(_, mesh)| rim(mesh)).collect();
    let rims: BTreeMap<&str, Mark> = own.iter().map(|(name, _)| *name).zip(rims).collect();
    for c in document.rows() {
        let key = format!("verdict.{}", key(c.verdict));
        let mut mark = rims.get(c.feature.as_str()).cloned().unwrap_or_default();
        mark.points = c.witness.clone();
        if groups.last().is_none_or(|g| g.key != key) {
            groups.push(MarkGroup { key, color: color(c.verdict), items: vec![] });
        }
        if let Some(group) = groups.last_mut() {
            group.items.push(mark.finite());
        }
    }
    vec![Marks { role: ViewRole::Touching, comparison: None, groups }]
}

/// The word of a verdict in the table of words.
fn key(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "pass",
        Verdict::Fail => "fail",
        Verdict::Undecided => "undecided",
        Verdict::NotMeasured => "not_measured",
    }
}
