//! The instruction set of the inner loops, where not the best is wanted: for comparing; results do not depend on it.

use crate::exit::Usage;
use trueness_geom::simd::Level;

/// The variable that names it.
const VARIABLE: &str = "TRUENESS_INSTRUCTIONS";

const LEVELS: [(&str, Level); 3] =
    [("plain", Level::Plain), ("avx2", Level::Avx2), ("avx512", Level::Avx512)];

/// Sets what the variable asks for.
///
/// # Errors
/// It names no instruction set, or one that this processor lacks.
pub fn limit() -> Result<(), Usage> {
    let Some(word) = std::env::var_os(VARIABLE) else { return Ok(()) };
    let word = word.to_string_lossy();
    let Some((_, level)) = LEVELS.iter().find(|(name, _)| *name == word) else {
        let names = LEVELS.map(|(name, _)| name).join(", ");
        return Err(Usage(format!("{VARIABLE}={word}: give one of {names}, or leave it out")));
    };
    if *level > Level::of_processor() {
        return Err(Usage(format!("{VARIABLE}={word}: this processor lacks these instructions")));
    }
    Level::limit(*level);
    Ok(())
}
