//! Documents from JSON.

use serde::de::DeserializeOwned;

/// Why a text is no document of the kind that was asked for.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}, column {column}: {what}")]
pub struct JsonError {
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1.
    pub column: usize,
    /// What is wrong there.
    pub what: String,
}

impl From<serde_json::Error> for JsonError {
    fn from(e: serde_json::Error) -> JsonError {
        let (line, column) = (e.line(), e.column());
        let text = e.to_string();
        let place = format!(" at line {line} column {column}");
        JsonError { line, column, what: text.strip_suffix(&place).unwrap_or(&text).to_string() }
    }
}

/// Reads a document. Which kind it is of, its `schema` says.
///
/// # Errors
/// The first place that is no JSON, or nothing of such a document.
///
/// ```
/// use trueness_document::Verdict;
/// use trueness_document::json::read;
/// assert_eq!(read::<Verdict>("\"pass\"")?, Verdict::Pass);
/// let error = read::<Verdict>("\n\"good\"").unwrap_err();
/// assert!(error.to_string().starts_with("line 2, column 6: unknown variant `good`"), "{error}");
/// # Ok::<(), trueness_document::json::JsonError>(())
/// ```
pub fn read<D: DeserializeOwned>(text: &str) -> Result<D, JsonError> {
    Ok(serde_json::from_str(text)?)
}
