//! The results of one or several parts as QIF 3.0 (ISO 23952:2020): characteristics with what is allowed, the features and values
//! measured, verdicts, and what they come from.
//!
//! Lengths are millimeters, angles degrees. What QIF has no element for stands in `Attributes`. The document's identifier comes
//! from what it says: the same results give the same bytes.

mod characteristics;
mod datums;
mod features;
mod xml;

use super::lists::judged;
use super::part::{Failed, Part};
use characteristics::{Ids, status};
use datums::Datums;
use trueness_document::inspect::{InspectDocument, PlanRecord};
use trueness_document::{InputRecord, Role, VERSION, Verdict};
use trueness_files::write;
use xml::{INDENT, Value, Xml, decimal};

/// The results of parts of one plan with this heading.
pub fn qif(parts: &[Part], title: Option<&str>) -> String {
    let mut x = Xml::within_root();
    body(&mut x, parts, title);
    let last = x.last();
    let body = x.finish();
    let mut whole = write::Xml::new(INDENT);
    whole.declaration(&[("encoding", "UTF-8".into())]);
    let root = [
        ("xmlns", "http://qifstandards.org/xsd/qif3".into()),
        ("versionQIF", "3.0.0".into()),
        ("idMax", last.to_string()),
    ];
    whole.element("QIFDocument", &root, |whole| {
        whole.leaf("QPId", &[], &identifier(&body));
        whole.push(&body);
    });
    whole.take()
}

/// A UUID of a text (RFC 9562, version 8): its FNV-1a hash of 128 bits.
fn identifier(text: &str) -> String {
    let (offset, prime) =
        (0x6c62_272e_07bb_0142_62b8_2175_6295_c58d_u128, 0x0100_0000_0000_0000_0000_013b_u128);
    let hash = text.bytes().fold(offset, |h, b| (h ^ u128::from(b)).wrapping_mul(prime));
    let hash = hash & !(0xf << 76) | (8 << 76);
    let hex = format!("{:032x}", hash & !(0x3 << 62) | (2 << 62));
    let parts = [(0, 8), (8, 12), (12, 16), (16, 20), (20, 32)].map(|(from, to)| &hex[from..to]);
    parts.join("-")
}

fn body(x: &mut Xml, parts: &[Part], title: Option<&str>) {
    x.element("Header", &[], |x| {
        x.element("Application", &[], |x| x.leaf("Name", &format!("trueness {VERSION}")));
        if let Some(title) = title {
            x.leaf("Description", title);
        }
    });
    let standard = x.number();
    x.element("StandardsDefinitions", &[("n", "1".into())], |x| {
        x.element("Standard", &[("id", standard.to_string())], |x| {
            x.element("Organization", &[], |x| x.leaf("StandardsOrganizationEnum", "ISO"));
            x.leaf("Designator", "ISO 1101");
            x.leaf("Year", "2017");
        });
    });
    units(x);
    // What is asked of all is what is told of one.
    let Some(first) = parts.iter().find_map(Part::document) else { return results(x, parts, &[], &[]) };
    let datums = Datums::of(x, first);
    datums.definitions(x);
    datums.frames(x, first);
    let ids: Vec<Ids> = first.characteristics.iter().map(|_| Ids::new(x)).collect();
    let shares = shares(x, parts);
    asked(x, first, &ids, &shares, standard, &datums);
    results(x, parts, &ids, &shares);
}

/// The name of a judged share of deviations, and the numbers of its definition, nominal and item.
type Share = (String, [u32; 3]);

/// All that are judged in some part.
fn shares(x: &mut Xml, parts: &[Part]) -> Vec<Share> {
    let mut all: Vec<Share> = vec![];
    for (name, ..) in parts.iter().filter_map(Part::document).flat_map(judged) {
        if all.iter().all(|(known, _)| *known != name) {
            all.push((name, [x.number(), x.number(), x.number()]));
        }
    }
    all
}

fn units(x: &mut Xml) {
    x.element("FileUnits", &[], |x| {
        x.element("PrimaryUnits", &[], |x| {
            let units = [
                ("AngularUnit", "radian", "degree", std::f64::consts::PI / 180.0),
                ("LinearUnit", "meter", "mm", 0.001),
            ];
            for (element, si, name, factor) in units {
                x.element(element, &[], |x| {
                    x.leaf("SIUnitName", si);
                    x.leaf("UnitName", name);
                    x.element("UnitConversion", &[], |x| x.leaf("Factor", &decimal(factor)));
                });
            }
        });
    });
}

/// Definitions, nominals and items of the characteristics; `shares` are the judged deviations.
fn asked(
    x: &mut Xml,
    first: &InspectDocument,
    ids: &[Ids],
    shares: &[Share],
    standard: u32,
    datums: &Datums,
) {
    let count = ids.len() + shares.len();
    if count == 0 {
        return;
    }
    let n = [("n", count.to_string())];
    let all = || first.characteristics.iter().zip(ids);
    x.element("Characteristics", &[], |x| {
        x.leaf("FormalStandardId", &standard.to_string());
        x.element("CharacteristicDefinitions", &n, |x| {
            all().for_each(|(c, ids)| characteristics::definition(x, first, c, *ids, datums));
            for (name, [definition, ..]) in shares {
                x.element(
                    "UserDefinedAttributeCharacteristicDefinition",
                    &[("id", definition.to_string())],
                    |x| {
                        x.leaf("Name", name);
                        x.leaf(
                            "WhatToMeasure",
                            "share of the measured points whose deviation from the reference is allowed",
                        );
                    },
                );
            }
        });
        x.element("CharacteristicNominals", &n, |x| {
            all().for_each(|(c, ids)| characteristics::nominal(x, first, c, *ids));
            for (name, [definition, nominal, _]) in shares {
                let element = "UserDefinedAttributeCharacteristicNominal";
                x.element(element, &[("id", nominal.to_string())], |x| {
                    x.leaf("CharacteristicDefinitionId", &definition.to_string());
                    x.leaf("Name", name);
                });
            }
        });
        x.element("CharacteristicItems", &n, |x| {
            all().for_each(|(c, ids)| characteristics::item(x, first, c, *ids));
            for (name, [_, nominal, item]) in shares {
                let element = "UserDefinedAttributeCharacteristicItem";
                x.element(element, &[("id", item.to_string())], |x| {
                    x.leaf("Name", name);
                    x.leaf("CharacteristicNominalId", &nominal.to_string());
                });
            }
        });
    });
}

/// What was found, part by part.
fn results(x: &mut Xml, parts: &[Part], ids: &[Ids], shares: &[Share]) {
    let n = [("n", parts.len().to_string())];
    let components: Vec<u32> = parts.iter().map(|_| x.number()).collect();
    x.element("Results", &[], |x| {
        x.element("MeasurementResultsSet", &n, |x| {
            for (part, component) in parts.iter().zip(&components) {
                let id = x.number();
                x.element("MeasurementResults", &[("id", id.to_string())], |x| match part {
                    Part::Inspected(done) => one_part(x, &done.document, ids, shares, *component),
                    Part::Failed(failed) => without_results(x, failed, *component),
                });
            }
        });
        x.element("ActualComponentSets", &[("n", "1".into())], |x| {
            x.element("ActualComponentSet", &n, |x| {
                for (part, component) in parts.iter().zip(&components) {
                    x.element("ActualComponent", &[("id", component.to_string())], |x| {
                        x.leaf("SerialNumber", part.name());
                        let verdict = part.document().map_or(Verdict::NotMeasured, |d| d.verdict);
                        inspection_status(x, "Status", verdict);
                    });
                }
            });
        });
    });
}

/// A part that has none.
fn without_results(x: &mut Xml, failed: &Failed, component: u32) {
    x.attributes(&[("not_inspected", failed.why().into())]);
    x.element("ExternalFileReferences", &[("n", "1".into())], |x| plan_file(x, &failed.plan));
    inspection_status(x, "InspectionStatus", Verdict::NotMeasured);
    x.references("ActualComponentIds", &[component]);
}

fn plan_file(x: &mut Xml, plan: &PlanRecord) {
    file(x, &plan.path, "inspection plan, TOML", "inspection plan", plan.sha256.as_deref());
}

fn one_part(x: &mut Xml, document: &InspectDocument, ids: &[Ids], known: &[Share], component: u32) {
    x.attributes(&traced(document));
    let files = 1 + document.inputs.len();
    x.element("ExternalFileReferences", &[("n", files.to_string())], |x| {
        plan_file(x, &document.plan);
        for input in &document.inputs {
            file(x, &input.path, &input.format, role(input), input.sha256.as_deref());
        }
    });
    let features: Vec<(&str, u32)> = document.features.iter().map(|f| (f.id.as_str(), x.number())).collect();
    if !features.is_empty() {
        x.element("MeasuredFeatures", &[("n", features.len().to_string())], |x| {
            for (f, (_, id)) in document.features.iter().zip(&features) {
                features::measured(x, f, *id, component);
            }
        });
    }
    let judged = judged(document);
    let count = ids.len() + judged.len();
    if count > 0 {
        x.element("MeasuredCharacteristics", &[], |x| {
            x.element("CharacteristicMeasurements", &[("n", count.to_string())], |x| {
                for (c, ids) in document.characteristics.iter().zip(ids) {
                    let feature = |name: &str| features.iter().find(|(f, _)| *f == name).map(|(_, id)| *id);
                    characteristics::measured(x, document, c, *ids, component, feature);
                }
                for (of, shares, verdict) in &judged {
                    let Some((_, [_, _, item])) = known.iter().find(|(name, _)| name == of) else { continue };
                    let id = x.number();
                    let name = "UserDefinedAttributeCharacteristicMeasurement";
                    x.element(name, &[("id", id.to_string())], |x| {
                        let numbers =
                            [("lower", shares.lower), ("upper", shares.upper), ("required", shares.required)];
                        x.attributes(&numbers.map(|(name, x)| (name, Value::from(x))));
                        status(x, *verdict);
                        x.leaf("CharacteristicItemId", &item.to_string());
                        x.leaf("ActualComponentId", &component.to_string());
                        if let Some(inside) = shares.inside {
                            x.leaf("Value", &decimal(inside));
                        }
                    });
                }
            });
        });
    }
    inspection_status(x, "InspectionStatus", document.verdict);
    x.references("ActualComponentIds", &[component]);
}

/// What the results come from, as far as QIF has no element for it.
fn traced(document: &InspectDocument) -> Vec<(&'static str, Value)> {
    let mut all: Vec<(&'static str, Value)> = vec![
        ("schema", document.schema.as_str().into()),
        ("program", format!("trueness {}", document.version).into()),
        ("plan", document.plan.path.as_str().into()),
        ("decision_rule", document.decision_rule.as_str().into()),
        ("alignment", document.alignment.method.as_str().into()),
        (
            "alignment_transform",
            serde_json::to_string(&document.alignment.transform).unwrap_or_default().into(),
        ),
    ];
    all.extend(document.plan.sha256.iter().map(|hash| ("plan_sha256", hash.as_str().into())));
    all.extend(document.title.iter().map(|title| ("title", title.as_str().into())));
    all.extend(document.alignment.rms.map(|rms| ("alignment_rms", rms.into())));
    all.extend(document.alignment.warnings.iter().map(|w| ("alignment_warning", w.text.as_str().into())));
    all
}

fn file(x: &mut Xml, path: &str, format: &str, what: &str, hash: Option<&str>) {
    x.element("ExternalFileReference", &[], |x| {
        x.leaf("URI", &uri(path));
        x.element("FileSpec", &[], |x| x.leaf("OtherFileSpec", format));
        let hash = hash.map_or_else(String::new, |h| format!(", SHA-256 {h}"));
        x.leaf("Description", &format!("{what}{hash}"));
    });
}

fn role(input: &InputRecord) -> &'static str {
    match input.role {
        Role::Measured => "measured",
        Role::Reference => "reference",
        Role::Mesh => "mesh",
    }
}

/// A path as a relative reference (RFC 3986).
fn uri(path: &str) -> String {
    let plain = |b: u8| b.is_ascii_alphanumeric() || b"-._~/".contains(&b);
    path.bytes().map(|b| if plain(b) { char::from(b).to_string() } else { format!("%{b:02X}") }).collect()
}

fn inspection_status(x: &mut Xml, element: &str, verdict: Verdict) {
    x.element(element, &[], |x| {
        let word = match verdict {
            Verdict::Pass => "PASS",
            Verdict::Fail => "FAIL",
            Verdict::Undecided => "UNKNOWN",
            Verdict::NotMeasured => "NOT_MEASURED",
        };
        x.leaf("InspectionStatusEnum", word);
    });
}
