//! Names of columns, and what they say of coordinates and units.

use super::cell::{Separator, cells, filled};
use crate::Unit;

/// The name of a column.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Name {
    /// As it stands in the file, quotes and blanks around it taken off.
    pub text: String,
    /// The name without a unit, lower case.
    pub base: String,
    pub unit: UnitWord,
}

/// The unit in a name.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum UnitWord {
    Nothing,
    Unit(Unit),
    /// A unit that is not among those converted here, or may be none.
    Foreign(String),
    /// Words in brackets that are no unit.
    Remark(String),
}

/// A line of names.
#[derive(Clone, Debug)]
pub(super) struct Header {
    /// Index of the line.
    pub line: usize,
    /// It stands in a comment, which may be prose as well.
    pub comment: bool,
    pub names: Vec<Name>,
}

/// Which columns a header calls x, y, z.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Axes {
    /// None of them.
    Unnamed,
    /// x and y, and z unless the points lie in the plane.
    Named(Vec<usize>),
    /// Some, but not x and y: the column of each.
    Partly([Option<usize>; 3]),
    /// Two columns or more by the same name.
    Twice(&'static str),
}

impl Header {
    /// The names on a line, which is cut at `separator`; marks of comments are no part of them.
    pub fn of(line: usize, text: &[u8], comment: bool, separator: Separator) -> Option<Header> {
        let text = text.trim_ascii();
        let mark = |b: &&u8| matches!(b, b'#' | b'/' | b'%' | b'!' | b'\'' | b';');
        let marks = if comment { text.iter().take_while(mark).count() } else { 0 };
        let cells = cells(&text[marks..], separator)?;
        let names = cells[..filled(&cells)].iter().map(|cell| Name::of(cell)).collect();
        Some(Header { line, comment, names })
    }

    /// Which of the names are x, y, z. A plain `x` goes before `pos x`.
    pub fn axes(&self) -> Axes {
        let mut found = [None; 3];
        for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
            let exact: Vec<usize> = self.columns(|n| bare(&n.base) == letter);
            let alike: Vec<usize> = self.columns(|n| axis_of(&n.base) == Some(axis));
            found[axis] = match (&exact[..], &alike[..]) {
                ([one], _) | ([], [one]) => Some(*one),
                ([], []) => None,
                _ => return Axes::Twice(letter),
            };
        }
        match found {
            [Some(x), Some(y), Some(z)] => Axes::Named(vec![x, y, z]),
            [Some(x), Some(y), None] => Axes::Named(vec![x, y]),
            [None, None, None] => Axes::Unnamed,
            some => Axes::Partly(some),
        }
    }

    fn columns(&self, is: impl Fn(&Name) -> bool) -> Vec<usize> {
        self.names.iter().enumerate().filter(|(_, n)| is(n)).map(|(i, _)| i).collect()
    }

    /// Whether the line holds nothing but units.
    pub fn is_units(&self) -> bool {
        let unit = |n: &Name| matches!(n.unit, UnitWord::Unit(_) | UnitWord::Foreign(_)) && n.base.is_empty();
        let bare =
            |n: &Name| matches!(unit_of(&n.text.to_lowercase()), UnitWord::Unit(_) | UnitWord::Foreign(_));
        let said = self.names.iter().filter(|n| !n.text.is_empty());
        said.clone().count() > 1 && said.clone().all(|n| unit(n) || bare(n))
    }

    /// Takes the units of a line that holds nothing but those.
    pub fn take_units(&mut self, units: &Header) {
        for (name, unit) in self.names.iter_mut().zip(&units.names) {
            let said = match &unit.unit {
                UnitWord::Nothing => unit_of(&unit.text.to_lowercase()),
                said => said.clone(),
            };
            if name.unit == UnitWord::Nothing && !unit.text.is_empty() {
                name.unit = said;
            }
        }
    }
}

impl Name {
    fn of(cell: &[u8]) -> Name {
        // Text that is not UTF-8 is most often Latin-1, as the micro sign of older programs.
        let latin = || cell.iter().map(|b| char::from(*b)).collect();
        let text: String = std::str::from_utf8(cell).map_or_else(|_| latin(), str::to_owned);
        let (base, unit) = split(text.trim().to_lowercase());
        Name { text, base, unit }
    }
}

/// The name and what it says of a unit: `x [mm]`, `x (mm)`, `x/mm`, `x in mm`, `x_mm`, `xmm`. Lower case.
fn split(name: String) -> (String, UnitWord) {
    if let Some(open) = name.find(['[', '(', '{']) {
        let inner = name[open + 1..].trim_end_matches([']', ')', '}']);
        let said = if inner.bytes().all(|b| b.is_ascii_digit()) { UnitWord::Nothing } else { unit_of(inner) };
        let base = if said == UnitWord::Nothing { name.as_str() } else { &name[..open] };
        return (base.trim().into(), said);
    }
    for sign in ['/', '_', ' '] {
        if let Some((base, last)) = name.rsplit_once(sign)
            && let said @ (UnitWord::Unit(_) | UnitWord::Foreign(_)) = unit_of(last)
        {
            let base = base.strip_suffix(" in").unwrap_or(base);
            // "x_m" may be meters or what was measured.
            let unclear = last == "m" && sign != '/' && !base.is_empty() && !name.ends_with(" in m");
            return (base.trim().into(), if unclear { UnitWord::Foreign("m".into()) } else { said });
        }
    }
    for unit in ["mm", "cm", "um", "\u{b5}m", "\u{3bc}m", "inch"] {
        if let Some(base @ ("x" | "y" | "z")) = name.strip_suffix(unit) {
            return (base.into(), unit_of(unit));
        }
    }
    (name, UnitWord::Nothing)
}

/// Units that are not converted here, and signs of quantities other than lengths.
const FOREIGN_UNITS: [&str; 23] = [
    "nm", "dm", "km", "ft", "feet", "foot", "yd", "mil", "mils", "thou", "pm", "\u{e5}", "px", "pixel",
    "pixels", "deg", "\u{b0}", "rad", "gon", "grad", "%", "usft", "pt",
];

/// The unit that a word names.
pub(super) fn unit_of(word: &str) -> UnitWord {
    let known = match word.trim() {
        "" => return UnitWord::Nothing,
        "mm" | "millimeter" | "millimetre" | "millimeters" | "millimetres" | "\u{43c}\u{43c}"
        | "\u{6beb}\u{7c73}" => Unit::Millimeter,
        "cm" | "centimeter" | "centimetre" | "centimeters" | "centimetres" | "zentimeter" => Unit::Centimeter,
        "m" | "meter" | "metre" | "meters" | "metres" => Unit::Meter,
        "in" | "inch" | "inches" | "zoll" | "\"" => Unit::Inch,
        "um" | "\u{b5}m" | "\u{3bc}m" | "micron" | "microns" | "micrometer" | "micrometre"
        | "micrometers" | "micrometres" | "mikrometer" => Unit::Micrometer,
        word if FOREIGN_UNITS.contains(&word) => return UnitWord::Foreign(word.into()),
        word => return UnitWord::Remark(word.into()),
    };
    UnitWord::Unit(known)
}

/// Words that may stand beside the letter of an axis in a name.
const WORDS_BESIDE_AXIS: [&str; 22] = [
    "p",
    "pos",
    "point",
    "points",
    "position",
    "coord",
    "coords",
    "coordinate",
    "coordinates",
    "koordinate",
    "koordinaten",
    "wert",
    "value",
    "achse",
    "axis",
    "coordonn\u{e9}e",
    "coordonnee",
    "coordenada",
    "coordinata",
    "\u{43a}\u{43e}\u{43e}\u{440}\u{434}\u{438}\u{43d}\u{430}\u{442}\u{430}",
    "\u{5750}\u{6807}",
    "\u{5ea7}\u{6a19}",
];

/// Surveyors' names of the axes.
const SURVEY_AXES: [&[&str]; 3] = [
    &["easting", "east", "ost", "ostwert", "rechtswert"],
    &["northing", "north", "nord", "nordwert", "hochwert"],
    &["elevation", "height", "altitude", "h\u{f6}he", "hoehe"],
];

/// The letters and digits of a name.
fn bare(base: &str) -> String {
    base.chars().filter(|c| c.is_alphanumeric()).collect()
}

/// Which coordinate a name, lower case and without a unit, means.
fn axis_of(base: &str) -> Option<usize> {
    let bare = bare(base);
    let words: Vec<&str> = base.split(|c: char| !c.is_alphanumeric()).filter(|w| !w.is_empty()).collect();
    let is = |i: usize| {
        let axis = ["x", "y", "z"][i];
        // Typed on a Russian keyboard, x and y look the same and are other letters.
        let letter = |w: &str| w == axis || i < 2 && w == ["\u{445}", "\u{443}"][i];
        let beside = words.iter().filter(|w| letter(w)).count() == 1
            && words.iter().all(|w| letter(w) || WORDS_BESIDE_AXIS.contains(w));
        let glued =
            || WORDS_BESIDE_AXIS.iter().any(|w| bare == format!("{w}{axis}") || bare == format!("{axis}{w}"));
        bare == format!("points{i}") || SURVEY_AXES[i].contains(&bare.as_str()) || beside || glued()
    };
    (0..3).find(|i| is(*i))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn header(line: &str, separator: Separator) -> Header {
        Header::of(0, line.as_bytes(), line.starts_with(['#', '/']), separator).unwrap()
    }

    #[test]
    fn names_of_axes() {
        let semicolon = Separator::Byte(b';');
        let named = |line: &str, want: &[usize]| {
            assert_eq!(header(line, semicolon).axes(), Axes::Named(want.to_vec()), "{line}");
        };
        named("x;y;z", &[0, 1, 2]);
        named("i;Z;Y;X", &[3, 2, 1]);
        named("\"Points:0\";\"Points:1\";\"Points:2\";e", &[0, 1, 2]);
        named("X-Koordinate;Y-Koordinate;Z-Koordinate", &[0, 1, 2]);
        named("Nr;X-Wert;Y-Wert", &[1, 2]);
        named("Koordinate X [mm];Koordinate Y [mm];Koordinate Z [mm]", &[0, 1, 2]);
        named("coordonn\u{e9}e x;coordonn\u{e9}e y;coordonn\u{e9}e z", &[0, 1, 2]);
        named("\u{5750}\u{6807}X;\u{5750}\u{6807}Y;\u{5750}\u{6807}Z", &[0, 1, 2]);
        named("\u{425};\u{423};Z", &[0, 1, 2]);
        named("Hochwert;Rechtswert;H\u{f6}he", &[1, 0, 2]);
        named("x;y;z;px;py;pz", &[0, 1, 2]);
        assert_eq!(header("// X Y Z R G B", Separator::Blanks).axes(), Axes::Named(vec![0, 1, 2]));
        assert_eq!(header("a;b;c", semicolon).axes(), Axes::Unnamed);
        assert_eq!(header("nx;ny;nz", semicolon).axes(), Axes::Unnamed);
        assert_eq!(header("X (Soll);Y (Soll);X (Ist);Y (Ist)", semicolon).axes(), Axes::Twice("x"));
        assert_eq!(header("z;a;b", semicolon).axes(), Axes::Partly([None, None, Some(0)]));
    }

    #[test]
    fn units_in_names() {
        let said = |name: &str| Name::of(name.as_bytes()).unit;
        for (name, unit) in [
            ("X [in]", Unit::Inch),
            ("X (mm)", Unit::Millimeter),
            ("x/mm", Unit::Millimeter),
            ("x in mm", Unit::Millimeter),
            ("x_mm", Unit::Millimeter),
            ("Xmm", Unit::Millimeter),
            ("x [m]", Unit::Meter),
            ("x in m", Unit::Meter),
            ("X [\u{b5}m]", Unit::Micrometer),
            ("X{cm}", Unit::Centimeter),
            ("X (Zoll)", Unit::Inch),
            ("X inch", Unit::Inch),
        ] {
            assert_eq!(said(name), UnitWord::Unit(unit), "{name}");
            let same =
                Header { line: 0, comment: false, names: vec![Name::of(name.as_bytes()), Name::of(b"y")] };
            assert_eq!(same.axes(), Axes::Named(vec![0, 1]), "{name}");
        }
        assert_eq!(Name::of(b"X [\xb5m]").unit, UnitWord::Unit(Unit::Micrometer));
        assert_eq!(said("x [ft]"), UnitWord::Foreign("ft".into()));
        assert_eq!(said("x_m"), UnitWord::Foreign("m".into()));
        assert_eq!(said("X (Ist)"), UnitWord::Remark("ist".into()));
        assert_eq!(said("x"), UnitWord::Nothing);
        let units = |line: &str| header(line, Separator::Byte(b';')).is_units();
        assert!(units("[mm];[mm];[mm]") && units("mm;mm;in") && !units("x;y;z") && !units("x [mm];y [mm]"));
    }
}
