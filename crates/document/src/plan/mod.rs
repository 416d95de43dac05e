//! The inspection plan as its author writes it: TOML, `trueness/plan/1`.
//!
//! [`PlanText::read`] tells what is wrong with line, column and the nearest known word. What follows from the words, and which of them can be
//! evaluated, is not its business.

mod at;
mod class;
mod error;
mod fault;
mod kinds;
mod numbers;
mod reader;
mod synonyms;
mod text;
mod words;

pub use at::At;
pub use class::Class;
pub use error::{PlanError, unknown};
pub use kinds::KINDS;
pub use text::*;
pub use words::{
    DatumMethodWord, FormMethodWord, FreeWord, KindWord, MaterialWord, NoiseText, NoiseWord, OffsetText,
    RuleWord, RunoutWord, SizeWord, TextureWord,
};

/// Name of the plan's schema.
pub const SCHEMA: &str = "trueness/plan/1";

impl PlanText {
    /// Reads the text of a plan.
    ///
    /// # Errors
    /// The first fault, with line and column: no TOML, an unknown key or word (with the nearest known one), another schema,
    /// a number that no part has.
    ///
    /// ```
    /// use trueness_document::plan::PlanText;
    /// let text = "schema = \"trueness/plan/1\"\n[[feature]]\nid = \"A\"\nshape = \"plane\"\npoints = \"a.xyz\"\n";
    /// assert_eq!(PlanText::read(text)?.feature[0].value.id.value, "A");
    /// let error = PlanText::read(&text.replace("plane", "plain")).unwrap_err();
    /// assert!(error.to_string().starts_with("line 4, column 9: "), "{error}");
    /// # Ok::<(), trueness_document::plan::PlanError>(())
    /// ```
    pub fn read(text: &str) -> Result<PlanText, PlanError> {
        let written: PlanText = reader::read(text)?;
        if written.schema.value != SCHEMA {
            let what =
                format!("the schema is \"{}\", but this program reads \"{SCHEMA}\"", written.schema.value);
            return Err(PlanError::at(text, &written.schema.span, what));
        }
        numbers::checked(text)?;
        Ok(written)
    }
}

impl RegionsText {
    /// Reads the regions of a file.
    ///
    /// # Errors
    /// The first fault, with line and column: no TOML, an unknown key, a number that no part has.
    pub fn read(text: &str) -> Result<RegionsText, PlanError> {
        let written = reader::read(text)?;
        numbers::checked(text)?;
        Ok(written)
    }
}

/// The JSON schema of plans: that of the text, with the words of all characteristics.
pub fn schema() -> schemars::Schema {
    let mut schema = schemars::schema_for!(PlanText);
    if let Some(kind) = schema.pointer_mut("/$defs/Kind").and_then(|kind| kind.as_object_mut()) {
        kind.insert("enum".into(), KINDS.into());
    }
    schema
}
