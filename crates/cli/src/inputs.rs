//! How the inputs were taken.

use trueness::document::InputRecord;

/// What there is to say about how the inputs were taken, a line each: tables of text, and what was odd.
pub fn notes(inputs: &[InputRecord]) -> String {
    let of = |input: &InputRecord| {
        let reading = input.reading().map(|r| format!("{}: {r}\n", input.path));
        let warnings = input.warnings.iter().map(|w| format!("! {w}\n"));
        reading.into_iter().chain(warnings).collect::<String>()
    };
    inputs.iter().map(of).collect()
}
