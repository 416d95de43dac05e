//! The units of a coordinate system: in well-known text, or in keys of GeoTIFF.

use super::units::{named, numbered, sized};
use crate::{Unit, error::Fault};

/// The units of the coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lengths {
    /// Of x and y.
    pub unit: Unit,
    /// Of z, where the file says it.
    pub height: Option<Unit>,
}

type Found = Result<Option<Lengths>, Fault>;

/// Coordinates that are no lengths.
fn degrees(name: &str) -> Fault {
    Fault::Unsupported {
        what: format!("the coordinates are degrees of a geographic coordinate system{name}, not lengths"),
        remedy: "project them to a system in meters, or name a unit by --units",
    }
}

/// A unit that is not known here.
fn unknown(name: &str) -> Fault {
    Fault::Unsupported {
        what: format!("the unit of lengths is {name}, which is not known here"),
        remedy: "name the unit by --units",
    }
}

/// An element of well-known text: a keyword with what stands in its brackets.
struct Element<'a> {
    keyword: &'a str,
    /// Its texts and numbers, without quotes.
    values: Vec<&'a str>,
    elements: Vec<Element<'a>>,
}

/// Elements in elements are followed to this depth.
const MAX_ELEMENT_DEPTH: usize = 32;

impl<'a> Element<'a> {
    /// The element at the start of `text`, and the text behind it.
    fn parse(text: &'a str, depth: usize) -> Option<(Element<'a>, &'a str)> {
        let text = text.trim_start();
        let (keyword, mut rest) = text.split_once(['[', '('])?;
        let mut element = Element { keyword: keyword.trim(), values: vec![], elements: vec![] };
        if depth == MAX_ELEMENT_DEPTH
            || !element.keyword.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_')
        {
            return None;
        }
        loop {
            rest = rest.trim_start_matches(|c: char| c == ',' || c.is_whitespace());
            if let Some(behind) = rest.strip_prefix([']', ')']) {
                return Some((element, behind));
            }
            if let Some(quoted) = rest.strip_prefix('"') {
                let (value, behind) = quoted.split_once('"')?;
                element.values.push(value);
                rest = behind;
                continue;
            }
            let end = rest.find([',', ']', ')', '[', '('])?;
            if rest[end..].starts_with(['[', '(']) {
                let (inner, behind) = Element::parse(rest, depth + 1)?;
                element.elements.push(inner);
                rest = behind;
            } else {
                element.values.push(rest[..end].trim());
                rest = &rest[end..];
            }
        }
    }

    fn is(&self, keywords: &[&str]) -> bool {
        keywords.iter().any(|k| self.keyword.eq_ignore_ascii_case(k))
    }

    /// The first element of one of these keywords, itself or one within it.
    fn find(&self, keywords: &[&str]) -> Option<&Element<'a>> {
        if self.is(keywords) { Some(self) } else { self.elements.iter().find_map(|e| e.find(keywords)) }
    }

    /// The unit of lengths of a system: its own, else that of its first axis.
    fn unit(&self) -> Option<&Element<'a>> {
        const UNIT_KEYWORDS: [&str; 2] = ["UNIT", "LENGTHUNIT"];
        let own = |e: &'_ Element<'a>| e.elements.iter().position(|inner| inner.is(&UNIT_KEYWORDS));
        if let Some(at) = own(self) {
            return self.elements.get(at);
        }
        let axes = self.elements.iter().filter(|e| e.is(&["AXIS", "CS"]));
        axes.filter_map(|axis| own(axis).and_then(|at| axis.elements.get(at))).next()
    }
}

/// The unit that an element names: by its name where that is known, else by its length in meters.
fn unit_of(element: &Element) -> Result<Unit, Fault> {
    let name = element.values.first().copied().unwrap_or_default();
    let size = element.values.get(1).and_then(|size| size.parse().ok()).and_then(sized);
    named(name).or(size).ok_or_else(|| unknown(&format!("\"{name}\"")))
}

/// The units of a system in well-known text, of either version.
pub(super) fn well_known_text(text: &str) -> Found {
    let text = text.trim_end_matches('\0');
    if text.trim().is_empty() {
        return Ok(None);
    }
    let Some((root, _)) = Element::parse(text, 0) else {
        let what = "the text of the coordinate system cannot be read".to_string();
        return Err(Fault::Unsupported { what, remedy: "name the unit by --units" });
    };
    let vertical = root.find(&["VERT_CS", "VERTCRS", "VERTICALCRS"]);
    let height = vertical.and_then(Element::unit).and_then(|unit| unit_of(unit).ok());
    let flat = ["PROJCS", "PROJCRS", "PROJECTEDCRS", "LOCAL_CS", "ENGCRS", "ENGINEERINGCRS", "GEOCCS"];
    match root.find(&flat) {
        Some(system) => match system.unit() {
            Some(unit) => Ok(Some(Lengths { unit: unit_of(unit)?, height })),
            None => Ok(None),
        },
        None => match root.find(&["GEOGCS", "GEOGCRS", "GEOGRAPHICCRS", "GEODCRS", "GEODETICCRS"]) {
            // The same word stands for places in meters from the middle of the Earth.
            Some(system) if system.unit().is_some_and(|u| u.is(&["LENGTHUNIT"])) => {
                let unit = system.unit().map(unit_of).transpose()?;
                Ok(unit.map(|unit| Lengths { unit, height }))
            }
            Some(system) => {
                Err(degrees(&system.values.first().map_or_else(String::new, |n| format!(" ({n})"))))
            }
            None => Ok(None),
        },
    }
}

/// Numbers of GeoTIFF keys.
mod key {
    pub const MODEL: u16 = 1024;
    pub const CITATION: u16 = 1026;
    pub const GEOGRAPHIC_UNIT: u16 = 2052;
    pub const PROJECTED: u16 = 3072;
    pub const PROJECTED_CITATION: u16 = 3073;
    pub const LINEAR_UNIT: u16 = 3076;
    pub const LINEAR_UNIT_SIZE: u16 = 3077;
    pub const VERTICAL_UNIT: u16 = 4099;
}
/// Model types of GeoTIFF.
const GEOGRAPHIC: u16 = 2;
const GEOCENTRIC: u16 = 3;
/// The number of what has no number of its own.
const USER_DEFINED: u16 = 32767;

/// The units in keys of GeoTIFF, with the numbers and texts that these point to.
pub(super) fn geo_keys(keys: &[u8], numbers: &[u8], texts: &[u8]) -> Found {
    let words: Vec<u16> = keys.chunks_exact(2).map(|b| u16::from_le_bytes([b[0], b[1]])).collect();
    let entries: Vec<&[u16]> = words.chunks_exact(4).skip(1).collect();
    let entry = |wanted: u16| entries.iter().find(|e| e[0] == wanted);
    let short = |wanted: u16| entry(wanted).filter(|e| e[1] == 0).map(|e| e[3]);
    let double = |wanted: u16| {
        let at = 8 * usize::from(entry(wanted)?[3]);
        numbers.get(at..)?.first_chunk().map(|b| f64::from_le_bytes(*b))
    };
    let text = |wanted: u16| {
        let [_, _, count, at] = entry(wanted)?.first_chunk::<4>()?.map(usize::from);
        texts.get(at..at + count).map(|text| String::from_utf8_lossy(text).into_owned())
    };
    let linear = if short(key::MODEL) == Some(GEOCENTRIC) { key::GEOGRAPHIC_UNIT } else { key::LINEAR_UNIT };
    let height = short(key::VERTICAL_UNIT).and_then(numbered);
    if short(key::MODEL) == Some(GEOGRAPHIC) {
        return Err(degrees(
            &text(key::CITATION)
                .map_or_else(String::new, |n| format!(" ({})", n.trim_end_matches(['|', '\0']))),
        ));
    }
    let unit = match short(linear) {
        Some(USER_DEFINED) => double(key::LINEAR_UNIT_SIZE).and_then(sized),
        Some(code) => Some(numbered(code).ok_or_else(|| unknown(&format!("number {code} of EPSG")))?),
        None => {
            let by_name = [key::PROJECTED_CITATION, key::CITATION]
                .into_iter()
                .filter_map(text)
                .find_map(|n| in_citation(&n));
            by_name.or_else(|| short(key::PROJECTED).filter(|code| is_metric(*code)).map(|_| Unit::Meter))
        }
    };
    Ok(unit.map(|unit| Lengths { unit, height }))
}

/// The unit that the name of a system says, as EPSG names them.
fn in_citation(name: &str) -> Option<Unit> {
    const WORDS: [(&str, Unit); 4] =
        [("(ftUS)", Unit::SurveyFoot), ("(ft)", Unit::Foot), ("(m)", Unit::Meter), ("UTM zone", Unit::Meter)];
    WORDS.iter().find(|(word, _)| name.contains(word)).map(|(_, unit)| *unit)
}

/// Whether a number of EPSG is of a zone of UTM, all of which are in meters.
fn is_metric(code: u16) -> bool {
    matches!(code, 32601..=32660 | 32701..=32760 | 26901..=26923 | 25828..=25838)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_of_both_versions_says_the_units_of_both_directions() {
        let geographic =
            r#"GEOGCS["NAD83",DATUM["d",SPHEROID["s",6378137,298.25]],UNIT["degree",0.0174532925199433]]"#;
        let projected = |unit: &str| {
            format!(r#"PROJCS["p",{geographic},PROJECTION["x"],PARAMETER["a",1],{unit},AXIS["X",EAST]]"#)
        };
        let feet = projected(r#"UNIT["US survey foot",0.3048006096012192]"#);
        let meters = projected(r#"UNIT["metre",1,AUTHORITY["EPSG","9001"]]"#);
        let both = format!(
            r#"COMPD_CS["c",{meters},VERT_CS["v",VERT_DATUM["d",2005],UNIT["US survey foot",0.3048006]]]"#
        );
        let second = r#"PROJCRS["p",BASEGEOGCRS["b",DATUM["d",ELLIPSOID["e",6378137,298.2,LENGTHUNIT["metre",1]]]],
            CONVERSION["c",METHOD["m"],PARAMETER["f",1,LENGTHUNIT["metre",1]]],CS[Cartesian,2],
            AXIS["x (E)",east],AXIS["y (N)",north],LENGTHUNIT["Foot",0.3048]]"#;
        let geocentric = r#"GEODCRS["g",DATUM["d",ELLIPSOID["e",6378137,298.2]],CS[Cartesian,3],AXIS["x",east],LENGTHUNIT["metre",1]]"#;
        let one = |unit| Some(Lengths { unit, height: None });
        assert_eq!(well_known_text(&feet).unwrap(), one(Unit::SurveyFoot));
        assert_eq!(well_known_text(&meters).unwrap(), one(Unit::Meter));
        assert_eq!(
            well_known_text(&both).unwrap(),
            Some(Lengths { unit: Unit::Meter, height: Some(Unit::SurveyFoot) })
        );
        assert_eq!(well_known_text(second).unwrap(), one(Unit::Foot));
        assert_eq!(well_known_text(geocentric).unwrap(), one(Unit::Meter));
        assert_eq!(well_known_text("\0").unwrap(), None);
        assert!(well_known_text(geographic).unwrap_err().to_string().contains("degrees"));
        assert!(
            well_known_text(&projected(r#"UNIT["rod",5.0292]"#)).unwrap_err().to_string().contains("rod")
        );
        for damaged in ["PROJCS[", "PROJCS[\"a", "x", &"A[".repeat(100_000)] {
            assert!(well_known_text(damaged).is_err(), "{}", damaged.len());
        }
    }

    #[test]
    fn keys_say_the_unit_by_number_size_or_name() {
        let keys = |entries: &[[u16; 4]]| {
            let head = [1, 1, 0, entries.len() as u16];
            std::iter::once(&head).chain(entries).flatten().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>()
        };
        let unit = |entries: &[[u16; 4]], numbers: &[u8], texts: &[u8]| {
            geo_keys(&keys(entries), numbers, texts).map(|found| found.map(|l| l.unit))
        };
        assert_eq!(unit(&[[1024, 0, 1, 1], [3076, 0, 1, 9003]], &[], &[]).unwrap(), Some(Unit::SurveyFoot));
        let size = 0.3048f64.to_le_bytes();
        assert_eq!(unit(&[[3076, 0, 1, 32767], [3077, 34736, 1, 0]], &size, &[]).unwrap(), Some(Unit::Foot));
        assert_eq!(
            unit(&[[3072, 0, 1, 2264], [3073, 34737, 8, 1]], &[], b"|N (ftUS)").unwrap(),
            Some(Unit::SurveyFoot)
        );
        assert_eq!(unit(&[[3072, 0, 1, 32633]], &[], &[]).unwrap(), Some(Unit::Meter));
        assert_eq!(unit(&[[3072, 0, 1, 2264]], &[], &[]).unwrap(), None);
        assert_eq!(geo_keys(&[], &[], &[]).unwrap(), None);
        assert!(unit(&[[1024, 0, 1, 2]], &[], &[]).unwrap_err().to_string().contains("degrees"));
        assert!(unit(&[[3076, 0, 1, 9005]], &[], &[]).is_err());
        let height = geo_keys(&keys(&[[3076, 0, 1, 9001], [4099, 0, 1, 9002]]), &[], &[]).unwrap();
        assert_eq!(height, Some(Lengths { unit: Unit::Meter, height: Some(Unit::Foot) }));
    }
}
