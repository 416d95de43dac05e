//! The document as a page holds it.

use crate::results::trend::TrendDocument;
use serde_json::Value;

/// The document without the lists of its places, which a page has no use for and no room.
pub fn stripped(document: &TrendDocument) -> serde_json::Result<Value> {
    let mut value = serde_json::to_value(document)?;
    if let Some(map) = value.get_mut("map").and_then(Value::as_object_mut) {
        map.retain(|_, v| !v.is_array());
    }
    Ok(value)
}
