//! Names of columns.

use super::row::{Layout, Separator};

/// The names that a header line gives to its columns, lower case, without quotes, marks of comments and units.
pub(super) fn names(line: &[u8], separator: Separator) -> Vec<String> {
    let line = line.trim_ascii();
    let marks = line.iter().take_while(|b| matches!(b, b'#' | b'/' | b'%' | b'!' | b'\'')).count();
    Layout::words(separator, &line[marks..])
        .into_iter()
        .map(|w| String::from_utf8_lossy(w).trim().to_lowercase())
        .collect()
}

/// The columns named x, y, and perhaps z.
pub(super) fn coordinates(names: &[String]) -> Option<Vec<usize>> {
    let find = |axis: usize| names.iter().position(|n| axis_of(n) == Some(axis));
    let (x, y) = (find(0)?, find(1)?);
    Some(match find(2) {
        Some(z) => vec![x, y, z],
        None => vec![x, y],
    })
}

/// Which coordinate a name means.
fn axis_of(name: &str) -> Option<usize> {
    // "X [mm]" and "X (mm)" are "X".
    let bare = name.split(['[', '(', '{']).next().unwrap_or(name);
    let bare: String = bare.chars().filter(|c| c.is_alphanumeric()).collect();
    let spellings = |i: usize| {
        let axis = ["x", "y", "z"][i];
        let around = ["p", "pos", "point", "position", "coord", "coordinate"];
        bare == axis
            || bare == format!("points{i}")
            || bare == ["easting", "northing", "elevation"][i]
            || bare == format!("{axis}mm")
            || around.iter().any(|w| bare == format!("{w}{axis}") || bare == format!("{axis}{w}"))
    };
    (0..3).find(|i| spellings(*i))
}
