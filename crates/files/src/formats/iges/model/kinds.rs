//! What entities are, by the numbers of their kinds.

/// What an entity is, with its kind.
pub(super) fn name(kind: u64) -> String {
    let what = match kind {
        100 => "circular arc",
        102 => "composite curve",
        108 => "plane",
        110 => "line",
        114 => "parametric spline surface",
        118 => "ruled surface",
        120 => "surface of revolution",
        122 => "tabulated cylinder",
        124 => "matrix",
        126 => "B-spline curve",
        128 => "B-spline surface",
        140 => "offset surface",
        142 => "curve on a surface",
        143 => "bounded surface",
        144 => "trimmed surface",
        186 => "solid",
        308 | 320 => "subfigure",
        408 | 420 => "instance of a subfigure",
        510 => "face",
        514 => "shell",
        150..=184 | 430 => "constructed solid",
        190..=198 => "analytic surface",
        412 | 414 => "array of instances",
        _ => "entity",
    };
    format!("{what} ({kind})")
}
