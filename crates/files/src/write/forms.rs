//! The formats of what only few can hold: regions, and numbers of points.

/// The formats that hold regions.
#[derive(Clone, Copy)]
pub(super) enum RegionForm {
    Ply,
    Csv,
}

/// Their endings.
pub(super) const REGION_FORMS: &[(&str, RegionForm)] = &[("ply", RegionForm::Ply), ("csv", RegionForm::Csv)];

/// The formats that hold numbers of points.
#[derive(Clone, Copy)]
pub(super) enum ValueForm {
    Ply,
    Csv,
    Npz,
    Vtp,
    #[cfg(feature = "parquet")]
    Parquet,
}

/// Their endings.
pub(super) const VALUE_FORMS: &[(&str, ValueForm)] = &[
    ("ply", ValueForm::Ply),
    ("csv", ValueForm::Csv),
    ("npz", ValueForm::Npz),
    ("vtp", ValueForm::Vtp),
    #[cfg(feature = "parquet")]
    ("parquet", ValueForm::Parquet),
];
