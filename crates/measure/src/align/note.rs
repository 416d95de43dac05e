//! What is to be said about an alignment.

use trueness_document::Word;
use trueness_document::align::{AlignNote, AlignNoteKind};
use trueness_geom::align::{AlignWarning, Alignment, Freedom, MIN_AMPLIFICATION, NotCounted, RowFit};

/// The note that a warning makes.
pub fn note(warning: &AlignWarning) -> AlignNote {
    let (kind, text) = match warning {
        AlignWarning::Poor { share } => (
            AlignNoteKind::Poor,
            format!(
                "half of the points are farther than {:.2} % of the size from the reference: it is hardly the same part, or its \
                 place was not found",
                100.0 * share
            ),
        ),
        AlignWarning::PoorRows { share, row, residual, mirrored } => {
            (AlignNoteKind::Poor, poor_rows(*share, *row, *residual, *mirrored))
        }
        AlignWarning::Ambiguous { count } => (
            AlignNoteKind::Ambiguous,
            format!(
                "{count} other {} as well: the part looks the same in several ways",
                if *count == 1 { "pose fits about" } else { "poses fit about" }
            ),
        ),
        AlignWarning::Free(motion) => {
            (AlignNoteKind::Free, format!("the shape leaves it free to {}", way(motion)))
        }
        AlignWarning::Undetermined { motion, width } => {
            (AlignNoteKind::Undetermined, undetermined(motion, *width))
        }
        AlignWarning::Mirrored { ratio } => (
            AlignNoteKind::Mirrored,
            format!(
                "the measured looks mirrored: its mirror image leaves {:.0} % of what it leaves itself; is it a part of the other hand, or \
                 was the sign of an axis reversed?",
                100.0 * ratio
            ),
        ),
        AlignWarning::NormalsTurned => {
            (AlignNoteKind::NormalsTurned, "the measured normals point inward; they were turned round".into())
        }
        AlignWarning::Scale { factor } => (
            AlignNoteKind::Scale,
            format!(
                "the measured fits when it is {factor:.6} times as large: is a unit wrong? (--units, --reference-units; `units` of a plan)"
            ),
        ),
        AlignWarning::FewPoints { count } => (
            AlignNoteKind::Few,
            format!(
                "{count} points are few for a search from any pose: look at the result, or align roughly and start \
                 --from-here, or give --method pairs"
            ),
        ),
        AlignWarning::Unconfirmed { searches } => (
            AlignNoteKind::Unconfirmed,
            format!(
                "many points do not lie on the reference, and one of {searches} searches alone found this pose: look at the \
                 result, or align roughly and start --from-here"
            ),
        ),
        AlignWarning::Excluded { share, farthest, limit } => (
            AlignNoteKind::LeftOut,
            format!(
                "{:.0} % of the measured does not count{}: the rest lies within {limit:.4} mm; where it is the part that is off \
                 there, align by --method chebyshev or by datums",
                100.0 * share,
                // Beyond reach of the search nothing has a place.
                if *farthest > *limit {
                    format!(", it lies up to {farthest:.4} mm from the reference")
                } else {
                    String::new()
                }
            ),
        ),
        AlignWarning::NotConverged => (AlignNoteKind::NotConverged, "the iteration did not settle".into()),
    };
    AlignNote { kind: Word(kind), text }
}

/// The notes of an alignment by rows, of a part with these corners.
pub fn notes_of_rows(found: &RowFit, corners: &[[f64; 3]]) -> Vec<AlignNote> {
    let mut notes: Vec<AlignNote> = found.warnings.iter().map(note).collect();
    let amplified = found.amplifications(corners);
    let most = amplified.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
    if let Some((row, by)) = most.filter(|(_, by)| **by >= MIN_AMPLIFICATION) {
        let rows = amplified.iter().filter(|by| **by >= MIN_AMPLIFICATION).count();
        let others = match rows {
            1 => String::new(),
            _ => format!(" ({rows} rows are amplified tenfold or more)"),
        };
        let text = format!(
            "row {}: an error of 0.01 mm there moves the farthest corner of the part by {:.3} mm{others}: the places held along its direction \
             lie near to each other or to one line; take places that are farther apart, over all of the part",
            row + 1,
            0.01 * by
        );
        notes.push(AlignNote { kind: Word(AlignNoteKind::Amplified), text });
    }
    notes
}

/// The notes of the best fit `from` that a search for the least greatest distance began with, and of what did not count in it. What did not count in the
/// best fit may count there.
pub fn notes_of_search(from: &Alignment, left_out: &NotCounted) -> Vec<AlignNote> {
    let told = from.warnings.iter().filter(|w| !matches!(w, AlignWarning::Excluded { .. }));
    let mut notes: Vec<AlignNote> = told.map(note).collect();
    let NotCounted { count, farthest, limit } = *left_out;
    if count == 0 {
        return notes;
    }
    let far = match limit.is_finite() {
        true => format!("farther than {limit:.4} mm from the reference in the best fit, "),
        false => String::new(),
    };
    let text = format!(
        "{count} {} not count in the search for the pose: {far}beside its rim, on the other side of a wall or of no facet; they lie up to \
         {farthest:.4} mm off{}",
        if count == 1 { "point does" } else { "points do" },
        if limit.is_finite() { " (--keep-outliers of trueness align lets the far ones count)" } else { "" }
    );
    notes.push(AlignNote { kind: Word(AlignNoteKind::LeftOut), text });
    notes
}

/// A motion in words.
fn way(motion: &Freedom) -> String {
    let three = |v: &[f64; 3]| format!("({:.3} {:.3} {:.3})", v[0], v[1], v[2]);
    match motion {
        Freedom::Slides { direction } => format!("slide along {}", three(direction)),
        Freedom::Turns { point, direction } => {
            format!("turn about the axis along {} through {}", three(direction), three(point))
        }
    }
}

/// What is said of a motion that is not held.
fn undetermined(motion: &Freedom, width: Option<f64>) -> String {
    let by = width.map_or_else(String::new, |w| format!(", by {w:.3} mm at least"));
    format!(
        "the measured does not tell where it lies: it is free to {}{by}, and the reference is not the same there; measure a face that holds \
         it, or align roughly and start --from-here with --lock",
        way(motion)
    )
}

/// What is said of rows of places that do not fit.
fn poor_rows(share: f64, row: usize, residual: f64, mirrored: bool) -> String {
    let why = match mirrored {
        true => "they look mirrored, as with the sign of an axis reversed",
        false => "some do not belong together, or they are of another part",
    };
    format!(
        "the places that belong together lie apart by {:.2} % of their size, row {} the most, by {residual:.3} mm: {why}",
        100.0 * share,
        row + 1
    )
}
