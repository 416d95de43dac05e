//! The words of all characteristics.

/// The words of the characteristics that plans may ask for, in the order of ISO 1101, then dimensions, then texture.
pub const KINDS: &[&str] = &[
    "straightness",
    "flatness",
    "roundness",
    "cylindricity",
    "line-profile",
    "surface-profile",
    "parallelism",
    "perpendicularity",
    "angularity",
    "position",
    "coaxiality",
    "symmetry",
    "circular-runout",
    "total-runout",
    "size",
    "distance",
    "angle",
    "texture",
];
