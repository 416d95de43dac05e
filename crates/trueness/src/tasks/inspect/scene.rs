//! What the report of an inspection draws.

use crate::task::{Page, Scene, TaskError};
use trueness_document::inspect::InspectDocument;
use trueness_geom::scan::Scan;
use trueness_measure::inspection::Inspection;
use trueness_report::views::compare;
use trueness_report::views::inspect::View;

/// All that was found.
pub(super) struct Inspected(pub Inspection);

impl Scene<InspectDocument> for Inspected {
    fn draw<'a>(&self, document: &InspectDocument, page: &'a mut Page<'a>) -> Result<(), TaskError> {
        let found = &self.0;
        let name = document.inputs.first().map_or("", |i| &i.path);
        let references = found.deviations.as_ref().zip(document.deviation.as_ref());
        let references = references.map(|(d, record)| d.references(&record.reference));
        let deviations = found.deviations.as_ref().zip(references.as_ref()).map(|(d, references)| {
            let mesh = found.measured.as_ref().and_then(Scan::mesh);
            compare::View::new(name, mesh, references, &d.found)
        });
        let view = View::new(document, found, deviations.as_ref());
        page(&view.objects(), &view.marks)
    }
}
