//! The words of characteristics and decisions.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use std::borrow::Cow;

/// How datums are associated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum DatumMethodWord {
    /// Least squares.
    Gaussian,
    /// Minimum zone, tangent outside the material.
    MinimumZone,
}

/// A material requirement of ISO 2692.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
pub enum MaterialWord {
    /// Maximum material requirement.
    M,
    /// Least material requirement.
    L,
}

impl MaterialWord {
    /// Its letter.
    pub fn word(self) -> &'static str {
        match self {
            MaterialWord::M => "M",
            MaterialWord::L => "L",
        }
    }

    /// Its sign on drawings.
    pub fn symbol(self) -> &'static str {
        match self {
            MaterialWord::M => "Ⓜ",
            MaterialWord::L => "Ⓛ",
        }
    }
}

/// Where the zone of a profile lies.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "`offset` is a length, or \"free\"")]
pub enum OffsetText {
    /// About the offset by this length out of the material (UZ).
    Length(f64),
    /// About the offset that makes it narrowest (OZ).
    Free(FreeWord),
}

/// The word for what is not held.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum FreeWord {
    /// Not held.
    Free,
}

/// How a form is evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FormMethodWord {
    /// The narrowest zone, as the standards define it.
    MinimumZone,
    /// About the least-squares element.
    Gaussian,
}

/// Sizes of ISO 14405-1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "UPPERCASE")]
pub enum SizeWord {
    /// Two-point size.
    Lp,
    /// Least-squares size.
    Gg,
    /// Minimum circumscribed size.
    Gn,
    /// Maximum inscribed size.
    Gx,
    /// Minimax size.
    Gc,
}

impl SizeWord {
    /// All of them.
    pub const ALL: [SizeWord; 5] = [SizeWord::Lp, SizeWord::Gg, SizeWord::Gn, SizeWord::Gx, SizeWord::Gc];

    /// Its letters.
    pub fn word(self) -> &'static str {
        match self {
            SizeWord::Lp => "LP",
            SizeWord::Gg => "GG",
            SizeWord::Gn => "GN",
            SizeWord::Gx => "GX",
            SizeWord::Gc => "GC",
        }
    }
}

/// Along which way a run-out is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum RunoutWord {
    /// Across the datum axis.
    Radial,
    /// Along it.
    Axial,
}

/// Parameters of ISO 25178-2.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
pub enum TextureWord {
    /// Arithmetic mean height.
    Sa,
    /// Root mean square height.
    Sq,
    /// Maximum height.
    Sz,
    /// Skewness.
    Ssk,
    /// Kurtosis.
    Sku,
}

impl TextureWord {
    /// All of them.
    pub const ALL: [TextureWord; 5] =
        [TextureWord::Sa, TextureWord::Sq, TextureWord::Sz, TextureWord::Ssk, TextureWord::Sku];

    /// Its letters.
    pub fn word(self) -> &'static str {
        match self {
            TextureWord::Sa => "Sa",
            TextureWord::Sq => "Sq",
            TextureWord::Sz => "Sz",
            TextureWord::Ssk => "Ssk",
            TextureWord::Sku => "Sku",
        }
    }

    /// Whether it is a length, not a ratio.
    pub fn is_length(self) -> bool {
        !matches!(self, TextureWord::Ssk | TextureWord::Sku)
    }
}

/// Decision rules.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
pub enum RuleWord {
    /// The value alone decides.
    #[serde(rename = "simple")]
    Simple,
    /// Within the uncertainty of a limit nothing is decided.
    #[serde(rename = "iso14253-1")]
    Iso14253,
}

/// The word of a characteristic, one of the list that the plan's schema adds.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(transparent)]
pub struct KindWord(pub String);

impl JsonSchema for KindWord {
    fn schema_name() -> Cow<'static, str> {
        "Kind".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "string" })
    }
}

/// The noise of measured points.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "`noise` is a length, or \"measured\"")]
pub enum NoiseText {
    /// Its standard deviation.
    Deviation(f64),
    /// What was measured tells it.
    Word(NoiseWord),
}

/// The word for noise that is found in what was measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum NoiseWord {
    /// Found there.
    Measured,
}
