//! Kinds of content that can be written, and their endings.

use super::forms::{REGION_FORMS, VALUE_FORMS};
use crate::{
    FORMATS, Format,
    error::{WriteError, WriteFault},
};
use std::path::Path;

/// The content of a file to be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Writable {
    /// Points, with or without deviations.
    Points,
    /// A mesh.
    Mesh,
    /// Facets or points with the number of their region.
    Regions,
    /// Vertices or points with named numbers.
    Values,
}

impl Writable {
    /// The endings, without dot, of the files that can hold it; the usual one of each format first.
    pub fn endings(self) -> Vec<&'static str> {
        let of = |writes: fn(&Format) -> bool| {
            FORMATS.iter().filter(|f| writes(f)).flat_map(|f| f.written_as.iter().copied()).collect()
        };
        match self {
            Writable::Points => of(Format::writes_points),
            Writable::Mesh => of(Format::writes_meshes),
            Writable::Regions => REGION_FORMS.iter().map(|(ending, _)| *ending).collect(),
            Writable::Values => VALUE_FORMS.iter().map(|(ending, _)| *ending).collect(),
        }
    }

    /// The same as they are shown: `.ply .csv`.
    pub fn shown(self) -> String {
        self.endings().iter().map(|e| format!(".{e}")).collect::<Vec<_>>().join(" ")
    }

    /// Whether a file of this name can hold it.
    ///
    /// # Errors
    /// An ending that is none of [`Writable::endings`].
    pub fn check(self, path: &Path) -> Result<(), WriteError> {
        self.ending_of(path).map(drop).map_err(|e| e.in_file(path))
    }

    /// The entry of the list `forms` for the ending of a path.
    pub(super) fn form<T: Copy>(self, path: &Path, forms: &[(&str, T)]) -> Result<T, WriteFault> {
        let ending = self.ending_of(path)?;
        let found = forms.iter().find(|(of, _)| *of == ending);
        found.map(|(_, form)| *form).ok_or_else(|| self.unknown())
    }

    /// The ending of a path, as it stands in the list.
    pub(crate) fn ending_of(self, path: &Path) -> Result<&'static str, WriteFault> {
        let given = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
        self.endings().into_iter().find(|e| e.eq_ignore_ascii_case(given)).ok_or_else(|| self.unknown())
    }

    /// The writer of a path's extension, and that extension.
    pub(super) fn writer<W>(
        self,
        path: &Path,
        writer: impl Fn(&Format) -> Option<W>,
    ) -> Result<(W, &'static str), WriteFault> {
        let ending = self.ending_of(path)?;
        let format = FORMATS.iter().find(|f| f.written_as.contains(&ending) && writer(f).is_some());
        format.and_then(|f| Some((writer(f)?, ending))).ok_or_else(|| self.unknown())
    }

    fn unknown(self) -> WriteFault {
        let what = match self {
            Writable::Points => "points",
            Writable::Mesh => "a mesh",
            Writable::Regions => "regions",
            Writable::Values => "numbers of points",
        };
        WriteFault::UnknownFormat { what, known: self.shown() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_ending_listed_is_written() {
        for what in [Writable::Points, Writable::Mesh, Writable::Regions, Writable::Values] {
            assert!(!what.endings().is_empty());
            for ending in what.endings() {
                let name = format!("a.{}", ending.to_uppercase());
                assert_eq!(what.ending_of(Path::new(&name)).unwrap(), ending);
            }
            let refused = what.check(Path::new("a.foo")).unwrap_err();
            assert!(refused.fault.is_wrong_usage() && refused.to_string().contains(&what.shown()));
        }
    }
}
