//! Words that other standards and programs have for those of plans.

/// A word of plans, and what others call it.
const SYNONYMS: &[(&str, &[&str])] = &[
    ("coaxiality", &["concentricity", "concentric", "coaxial", "alignment"]),
    ("position", &["true-position", "location", "positional", "positioning", "true-location"]),
    ("roundness", &["circularity", "out-of-roundness", "ovality", "circular", "round", "roundness-error"]),
    ("cylindricity", &["cylinder-form", "cylindrical", "cylindricality"]),
    (
        "perpendicularity",
        &["squareness", "orthogonality", "square", "perpendicular", "normality", "rectangularity"],
    ),
    ("parallelism", &["parallel", "parallelity"]),
    ("angularity", &["inclination", "slope", "angular"]),
    ("flatness", &["planarity", "planeness", "flat", "evenness"]),
    ("straightness", &["linearity", "straight"]),
    ("symmetry", &["symmetric", "symmetricity", "centrality"]),
    (
        "size",
        &[
            "diameter",
            "dia",
            "radius",
            "width",
            "thickness",
            "length",
            "diametre",
            "bore",
            "dimension",
            "slot-width",
        ],
    ),
    ("distance", &["height", "depth", "gap", "spacing", "offset", "step", "length", "dimension"]),
    ("angle", &["angular-dimension", "included-angle", "degrees"]),
    (
        "circular-runout",
        &[
            "runout",
            "run-out",
            "radial-runout",
            "axial-runout",
            "wobble",
            "simple-runout",
            "circular-run-out",
            "face-runout",
        ],
    ),
    (
        "total-runout",
        &["runout", "run-out", "full-runout", "total-indicator-reading", "tir", "total-run-out", "fim"],
    ),
    (
        "line-profile",
        &[
            "profile",
            "profile-of-a-line",
            "profile-of-line",
            "profile-line",
            "contour",
            "line-form",
            "profile-any-line",
        ],
    ),
    (
        "surface-profile",
        &[
            "profile",
            "profile-of-a-surface",
            "profile-of-surface",
            "profile-surface",
            "form",
            "freeform",
            "surface-form",
            "profile-any-surface",
        ],
    ),
    ("texture", &["roughness", "surface-roughness", "surface-texture", "finish", "surface-finish"]),
    // Shapes of features.
    ("cylinder", &["hole", "bore", "shaft", "pin", "boss", "axis", "drilling"]),
    ("plane", &["face", "flat", "surface-plane"]),
    ("sphere", &["ball"]),
    ("circle", &["ring", "section"]),
    ("torus", &["donut", "ring-torus"]),
    ("edge", &["corner", "border"]),
    (
        "median-plane",
        &["midplane", "mid-plane", "center-plane", "centre-plane", "symmetry-plane", "middle-plane"],
    ),
    ("midpoint", &["middle", "center", "centre", "mean-point"]),
    ("intersection", &["intersect", "cross", "intersection-line", "intersection-point"]),
    // Methods.
    ("gaussian", &["least-squares", "lsq", "lsc", "best-fit", "gauss", "mean", "least-square"]),
    ("minimum-zone", &["chebyshev", "minimax", "tangent", "minimum", "min-zone", "mzc", "tschebyscheff"]),
    ("minimum-circumscribed", &["circumscribed", "mcc", "outer-tangential", "min-circumscribed"]),
    ("maximum-inscribed", &["inscribed", "mic", "inner-tangential", "max-inscribed"]),
    ("best-fit", &["bestfit", "icp", "least-squares", "gaussian", "auto", "global"]),
    ("datum", &["datums", "reference-system"]),
    ("given", &["matrix", "transform", "manual"]),
    ("rps", &["3-2-1", "321", "reference-points"]),
    ("iso14253-1", &["iso", "iso14253", "iso-14253-1", "guard-band", "14253"]),
    ("simple", &["none", "simple-acceptance", "asme", "plain"]),
    // Keys.
    ("tolerance", &["tol", "zone", "limit"]),
    ("datums", &["datum", "references", "reference", "drf"]),
    ("upper", &["plus", "max", "upper-limit", "es", "usl", "upper-tol"]),
    ("lower", &["minus", "min", "lower-limit", "ei", "lsl", "lower-tol"]),
    ("material", &["mmc", "lmc", "mmr", "lmr", "modifier"]),
    ("seed", &["pick", "at"]),
    ("basic", &["ted", "true-place", "coordinates", "theoretical"]),
    ("mm", &["millimeter", "millimeters", "millimetre", "millimetres"]),
    ("in", &["inch", "inches", "\""]),
    ("um", &["µm", "micron", "microns", "micrometer", "micrometre"]),
    ("m", &["meter", "meters", "metre", "metres"]),
    ("cm", &["centimeter", "centimeters", "centimetre", "centimetres"]),
];

/// Those of the known words that others call so.
pub(super) fn synonyms<'a>(word: &str, known: &[&'a str]) -> Vec<&'a str> {
    let plain = |w: &str| -> String { w.to_lowercase().replace([' ', '_'], "-") };
    let alike = |w: &str| plain(w).replace('-', "");
    let (own, joined) = (plain(word), alike(word));
    // A known word in another spelling is that word.
    if let Some(same) = known.iter().find(|k| alike(k) == joined) {
        return vec![*same];
    }
    let is_meant = |k: &&&str| {
        SYNONYMS.iter().any(|(of, words)| *of == **k && words.iter().any(|w| *w == own || alike(w) == joined))
    };
    known.iter().filter(is_meant).copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::KINDS;

    #[test]
    fn words_of_others_lead_to_those_of_plans() {
        for (word, meant) in [
            ("concentricity", &["coaxiality"][..]),
            ("Concentricity", &["coaxiality"]),
            ("diameter", &["size"]),
            ("runout", &["circular-runout", "total-runout"]),
            ("run-out", &["circular-runout", "total-runout"]),
            ("total_run-out", &["total-runout"]),
            ("profile", &["line-profile", "surface-profile"]),
            ("profile of a surface", &["surface-profile"]),
            ("true position", &["position"]),
            ("circularity", &["roundness"]),
            ("squareness", &["perpendicularity"]),
            ("parallel", &["parallelism"]),
            ("roughness", &["texture"]),
            ("Flatness", &["flatness"]),
            ("zebra", &[]),
        ] {
            assert_eq!(synonyms(word, KINDS), meant, "{word}");
        }
    }
}
