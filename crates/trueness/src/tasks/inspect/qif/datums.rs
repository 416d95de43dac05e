//! Datums and the frames that they make.

use super::xml::Xml;
use trueness_document::inspect::InspectDocument;

/// The datums of a plan.
#[derive(Default)]
pub struct Datums {
    /// Name and number of each datum.
    letters: Vec<(String, u32)>,
    /// Datums as a characteristic names them, and the number of their frame.
    frames: Vec<(Vec<String>, u32)>,
}

/// A datum as a characteristic names it: its letters, several of a common datum, and its material requirement.
pub fn letters_and_modifier<'a>(
    document: &InspectDocument,
    written: &'a str,
) -> (Vec<&'a str>, &'static str) {
    let known = |id: &str| document.features.iter().any(|f| f.id == id);
    let (name, modifier) = match (written.strip_suffix("(M)"), written.strip_suffix("(L)")) {
        (Some(name), _) if !known(written) => (name, "MAXIMUM"),
        (_, Some(name)) if !known(written) => (name, "LEAST"),
        _ => (written, "NONE"),
    };
    let parts: Vec<&str> = name.split('-').collect();
    match parts.len() > 1 && !known(name) {
        true => (parts, modifier),
        false => (vec![name], modifier),
    }
}

impl Datums {
    /// Those of a document.
    pub fn of(x: &mut Xml, document: &InspectDocument) -> Datums {
        let mut all = Datums::default();
        for c in document.characteristics.iter().filter(|c| !c.datums.is_empty()) {
            for written in &c.datums {
                for letter in letters_and_modifier(document, written).0 {
                    if !all.letters.iter().any(|(l, _)| l == letter) {
                        let id = x.number();
                        all.letters.push((letter.into(), id));
                    }
                }
            }
            if !all.frames.iter().any(|(f, _)| *f == c.datums) {
                let id = x.number();
                all.frames.push((c.datums.clone(), id));
            }
        }
        all
    }

    /// The frame of these datums.
    pub fn frame(&self, datums: &[String]) -> Option<u32> {
        self.frames.iter().find(|(f, _)| f == datums).map(|(_, id)| *id)
    }

    fn letter(&self, name: &str) -> u32 {
        self.letters.iter().find(|(l, _)| l == name).map_or(0, |(_, id)| *id)
    }

    /// The definitions. A label is a word without blanks: one that is not has its name as an attribute.
    pub fn definitions(&self, x: &mut Xml) {
        if self.letters.is_empty() {
            return;
        }
        x.element("DatumDefinitions", &[("n", self.letters.len().to_string())], |x| {
            for (name, id) in &self.letters {
                x.element("DatumDefinition", &[("id", id.to_string())], |x| {
                    let label = label(name, *id);
                    if label != *name {
                        x.attributes(&[("name", name.as_str().into())]);
                    }
                    x.leaf("DatumLabel", &label);
                });
            }
        });
    }

    /// The frames.
    pub fn frames(&self, x: &mut Xml, document: &InspectDocument) {
        if self.frames.is_empty() {
            return;
        }
        x.element("DatumReferenceFrames", &[("n", self.frames.len().to_string())], |x| {
            for (datums, id) in &self.frames {
                x.element("DatumReferenceFrame", &[("id", id.to_string())], |x| {
                    x.element("Datums", &[("n", datums.len().to_string())], |x| {
                        for (place, written) in datums.iter().enumerate() {
                            x.element("Datum", &[], |x| self.datum(x, document, written, place));
                        }
                    });
                });
            }
        });
    }

    fn datum(&self, x: &mut Xml, document: &InspectDocument, written: &str, place: usize) {
        let (letters, modifier) = letters_and_modifier(document, written);
        let simple = |x: &mut Xml, letter: &str| {
            x.element("SimpleDatum", &[], |x| {
                x.leaf("DatumDefinitionId", &self.letter(letter).to_string());
                x.leaf("MaterialModifier", modifier);
                x.leaf("ReferencedComponent", "ACTUAL");
            });
        };
        match &letters[..] {
            [one] => simple(x, one),
            several => x.element("CompoundDatum", &[("n", several.len().to_string())], |x| {
                for (n, letter) in several.iter().enumerate() {
                    x.element("Datum", &[], |x| {
                        simple(x, letter);
                        x.leaf("SequenceNumber", &(n + 1).to_string());
                    });
                }
            }),
        }
        let order = ["PRIMARY", "SECONDARY", "TERTIARY", "QUATERNARY", "QUINARY", "SENARY"];
        x.element("Precedence", &[], |x| match order.get(place) {
            Some(word) => x.leaf("PrecedenceEnum", word),
            None => x.leaf("OtherPrecedence", &(place + 1).to_string()),
        });
    }
}

/// A name token of XML for a datum; `id` tells such apart that are not its name.
fn label(name: &str, id: u32) -> String {
    let fits = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '-' | '_' | ':');
    match !name.is_empty() && name.chars().all(fits) {
        true => name.into(),
        false => {
            let safe: String = name.chars().take(40).map(|c| if fits(c) { c } else { '_' }).collect();
            format!("{safe}_{id}")
        }
    }
}
