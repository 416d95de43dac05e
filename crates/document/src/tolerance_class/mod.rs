//! Tolerances by letters: the classes of ISO 286-2 for sizes and the general tolerances of ISO 2768.
//!
//! What is not in the tables here is refused: limits are never guessed.

mod error;
mod iso2768;
mod iso286;

pub use error::ClassError;

/// Limit deviations of an external radius or the height of a chamfer: ISO 2768-1, table 2.
///
/// # Errors
/// [`ClassError`]: other letters than f, m, c and v, or a radius below 0.5 mm.
///
/// ```
/// use trueness_document::tolerance_class::radius;
/// assert_eq!([radius("m", 3.0)?, radius("m", 3.1)?, radius("v", 10.0)?], [[-0.2, 0.2], [-0.5, 0.5], [-2.0, 2.0]]);
/// assert!(radius("m", 0.4).is_err() && radius("K", 3.0).is_err());
/// # Ok::<(), trueness_document::tolerance_class::ClassError>(())
/// ```
pub fn radius(class: &str, nominal: f64) -> Result<[f64; 2], ClassError> {
    iso2768::radius(class, nominal)
}

/// Which table a kind of characteristic takes its classes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Table {
    /// Sizes: ISO 286-2, and ISO 2768-1 for linear dimensions.
    Size,
    /// Linear dimensions: ISO 2768-1, table 1.
    Linear,
    /// Angular dimensions: ISO 2768-1, table 3; the length is that of the shorter leg.
    Angular,
    /// Straightness and flatness: ISO 2768-2, table 1; the length is that of the line or of the longer side.
    Form,
    /// Perpendicularity: ISO 2768-2, table 2; the length is that of the shorter side.
    Perpendicularity,
    /// Symmetry: ISO 2768-2, table 3; the length is that of the feature.
    Symmetry,
    /// Circular run-out: ISO 2768-2, table 4; it needs no length.
    Runout,
}

/// What is wrong with a class by ISO 286 on a feature that is a hole or slot (`internal`), or a shaft or thickness; `None` where nothing is, and
/// of classes that are the same for both.
///
/// ```
/// use trueness_document::tolerance_class::wrong_side;
/// assert!(wrong_side("h7", true, "bore").is_some_and(|what| what.ends_with("write \"H7\"")));
/// assert_eq!(wrong_side("H7", true, "bore"), None);
/// assert_eq!([wrong_side("js9", true, "bore"), wrong_side("m", true, "bore")], [None, None]);
/// ```
pub fn wrong_side(class: &str, internal: bool, feature: &str) -> Option<String> {
    let digits = class.find(|c: char| c.is_ascii_digit())?;
    let (letters, grade) = class.split_at(digits);
    let is_hole = letters.chars().all(|c| c.is_ascii_uppercase());
    if letters.is_empty() || letters.eq_ignore_ascii_case("js") || is_hole == internal {
        return None;
    }
    let (of, is, letters) = match is_hole {
        true => ("holes and slots (capital letters)", "a shaft or a thickness", letters.to_lowercase()),
        false => ("shafts and thicknesses (small letters)", "a hole or a slot", letters.to_uppercase()),
    };
    Some(format!(
        "\"{class}\" is a class of {of}, and feature \"{feature}\" is {is}; write \"{letters}{grade}\""
    ))
}

impl Table {
    /// Whether the table goes by `length`, not by the nominal value.
    pub fn takes_length(self) -> bool {
        !matches!(self, Table::Size | Table::Linear | Table::Runout)
    }

    /// Lower and upper limit deviation by a class; of a form or attitude 0 and the tolerance. Millimeters, of an angle
    /// degrees. `nominal` is the nominal value, `length` the length that a table goes by, both in millimeters.
    ///
    /// # Errors
    /// [`ClassError`]: letters, grades and ranges that are not in the tables.
    ///
    /// ```
    /// use trueness_document::tolerance_class::Table;
    /// assert_eq!(Table::Size.limits("H7", 25.0, None)?, [0.0, 0.021]);
    /// assert_eq!(Table::Size.limits("g6", 25.0, None)?, [-0.020, -0.007]);
    /// assert_eq!(Table::Linear.limits("m", 25.0, None)?, [-0.2, 0.2]);
    /// assert_eq!(Table::Form.limits("K", 0.0, Some(80.0))?, [0.0, 0.2]);
    /// # Ok::<(), trueness_document::tolerance_class::ClassError>(())
    /// ```
    pub fn limits(self, class: &str, nominal: f64, length: Option<f64>) -> Result<[f64; 2], ClassError> {
        let by_length = || length.ok_or_else(|| ClassError::NoLength { class: class.into() });
        match self {
            Table::Size if class.ends_with(|c: char| c.is_ascii_digit()) => iso286::limits(class, nominal),
            Table::Size => iso2768::linear(class, nominal, "H7, g6, js9, …; f, m, c, v of ISO 2768-1"),
            Table::Linear => iso2768::linear(class, nominal, "f, m, c, v of ISO 2768-1"),
            Table::Angular => iso2768::angular(class, by_length()?),
            Table::Form => iso2768::form(class, by_length()?),
            Table::Perpendicularity => iso2768::perpendicularity(class, by_length()?),
            Table::Symmetry => iso2768::symmetry(class, by_length()?),
            Table::Runout => iso2768::runout(class),
        }
    }
}
