//! Why a class gives no limits.

/// Why a class gives no limits.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ClassError {
    /// The letters are in no table here.
    #[error("class \"{class}\" is not in the tables of this program; write the limits (known: {known})")]
    Unknown {
        /// As written.
        class: String,
        /// What is known.
        known: &'static str,
    },
    /// The grade has no values for these letters.
    #[error(
        "class \"{class}\" is not in the tables of this program: {letters} is there for {known}; write the limits"
    )]
    Grade {
        /// As written.
        class: String,
        /// Its letters.
        letters: String,
        /// Grades that are there.
        known: &'static str,
    },
    /// The length is in no range of the table.
    #[error(
        "class \"{class}\" has no value for {length} mm in the tables of this program ({range}); write the limits"
    )]
    Range {
        /// As written.
        class: String,
        /// The length that it goes by.
        length: f64,
        /// Ranges that are there.
        range: &'static str,
    },
    /// The table goes by a length that was not given.
    #[error("class \"{class}\" goes by a nominal length; give `length`")]
    NoLength {
        /// As written.
        class: String,
    },
}
