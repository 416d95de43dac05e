//! The chords of a profile as documents have them.

use trueness_document::Word;
use trueness_document::section::{ChordBy, ChordRecord};
use trueness_section::{AirfoilError, Chord, Chords};

/// The chords of a profile as records, without twist.
pub(super) fn records(found: &Chords) -> Vec<ChordRecord> {
    let all = [
        (ChordBy::Farthest, Ok(found.farthest)),
        (ChordBy::CamberEnds, Ok(found.camber_ends)),
        (ChordBy::Bitangent, found.bitangent),
    ];
    all.into_iter().map(|(by, chord)| record(by, chord)).collect()
}

fn record(by: ChordBy, chord: Result<Chord, AirfoilError>) -> ChordRecord {
    let found = chord.ok();
    ChordRecord {
        definition: Word(by),
        leading: found.map(|c| c.leading),
        trailing: found.map(|c| c.trailing),
        length: found.map(|c| c.length()),
        angle: found.map(|c| c.angle()),
        length_reason: chord.err().map(|e| e.to_string()),
        twist: None,
        twist_reason: Some(
            "there is no nominal to compare with; the angle is that with the first axis".into(),
        ),
    }
}
