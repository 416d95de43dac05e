//! Tolerances that a model carries beside its faces: datums, geometric tolerances, dimensions. Millimeters and radians; faces are named by
//! the numbers of their entities, words are those of ISO 10303 in lower case.

/// All tolerances of a model, each kind in the order of its numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tolerances {
    /// Datums.
    pub datums: Vec<Datum>,
    /// Tolerances of form, attitude, place and run-out.
    pub geometric: Vec<GeometricTolerance>,
    /// Sizes, distances and angles.
    pub dimensions: Vec<Dimension>,
}

impl Tolerances {
    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.datums.is_empty() && self.geometric.is_empty() && self.dimensions.is_empty()
    }
}

/// What a tolerance, dimension or datum is of.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Target {
    /// The entity that names it, an aspect of the shape.
    pub entity: u64,
    /// Its name; may be empty.
    pub name: String,
    /// The faces, in the order of their numbers.
    pub faces: Vec<u64>,
    /// Items that are no faces, such as edges: number and keyword.
    pub others: Vec<(u64, String)>,
    /// What else is said of it: `all around`, `whole part`.
    pub notes: Vec<String>,
}

/// A datum.
#[derive(Clone, Debug, PartialEq)]
pub struct Datum {
    /// Its entity.
    pub entity: u64,
    /// Its letter.
    pub letter: String,
    /// What it is taken from.
    pub features: Vec<Target>,
    /// The places that it is taken from, if it has such.
    pub targets: Vec<DatumTarget>,
}

/// A place that a datum is taken from.
#[derive(Clone, Debug, PartialEq)]
pub struct DatumTarget {
    /// Its entity.
    pub entity: u64,
    /// Its number beside the letter.
    pub number: String,
    /// `point`, `line`, `rectangle`, `circle`, …
    pub form: String,
    /// Where it is.
    pub of: Target,
}

/// A datum as a tolerance refers to it; several parts are a common datum.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DatumReference {
    /// The datums that make it.
    pub parts: Vec<DatumPart>,
}

/// A datum within a reference.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DatumPart {
    /// Its letter.
    pub letter: String,
    /// Words such as `maximum material requirement`.
    pub modifiers: Vec<String>,
}

/// A geometric tolerance.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GeometricTolerance {
    /// Its entity.
    pub entity: u64,
    /// `flatness`, `surface profile`, …
    pub kind: String,
    /// Its name; may be empty.
    pub name: String,
    /// Width or diameter of its zone; `None` where it cannot be read, as a note says.
    pub width: Option<f64>,
    /// What it is of.
    pub of: Target,
    /// The datum system, the first one first.
    pub datums: Vec<DatumReference>,
    /// Words such as `maximum material requirement`.
    pub modifiers: Vec<String>,
    /// The form of its zone where that is stated, such as `cylindrical or circular`.
    pub zone: Option<String>,
    /// What else is said of it.
    pub notes: Vec<String>,
}

/// A size of one feature, or a distance or angle of two.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dimension {
    /// Its entity.
    pub entity: u64,
    /// `diameter`, `linear distance`, …
    pub name: String,
    /// What it is of: of a distance or angle, from where and to where.
    pub of: Vec<Target>,
    /// Whether its numbers are angles.
    pub is_angle: bool,
    /// Nominal value.
    pub nominal: Option<f64>,
    /// Lower and upper limit deviation from the nominal value.
    pub deviations: Option<[f64; 2]>,
    /// Least and greatest allowed value.
    pub limits: Option<[f64; 2]>,
    /// Tolerance class, such as `H7`.
    pub class: Option<String>,
    /// What else is said of it.
    pub notes: Vec<String>,
}

impl Dimension {
    /// Nominal value, lower and upper limit deviation, however the file states them; the middle of limits without a nominal value.
    ///
    /// ```
    /// use trueness_cad::tolerances::Dimension;
    /// let limits = Dimension { limits: Some([24.0, 26.0]), ..Dimension::default() };
    /// assert_eq!(limits.range(), Some((25.0, [-1.0, 1.0])));
    /// let stated = Dimension { nominal: Some(24.5), ..limits };
    /// assert_eq!(stated.range(), Some((24.5, [-0.5, 1.5])));
    /// ```
    pub fn range(&self) -> Option<(f64, [f64; 2])> {
        match (self.nominal, self.deviations, self.limits) {
            (Some(nominal), Some(deviations), _) => Some((nominal, deviations)),
            (nominal, _, Some([least, greatest])) => {
                let nominal = nominal.unwrap_or(0.5 * (least + greatest));
                Some((nominal, [least - nominal, greatest - nominal]))
            }
            _ => None,
        }
    }
}
