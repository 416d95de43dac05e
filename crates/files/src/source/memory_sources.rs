//! Named bytes in memory.

use super::{SourceBytes, Sources};
use crate::error::Fault;
use crate::feed::Shared;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Bytes in memory by their names. They are shared and not copied when they are read.
#[derive(Clone, Default)]
pub struct MemorySources {
    all: BTreeMap<PathBuf, Shared>,
}

impl MemorySources {
    /// Without any bytes yet.
    pub fn new() -> MemorySources {
        MemorySources::default()
    }

    /// Puts bytes under a name, in place of those that went by it before.
    pub fn insert(&mut self, name: impl Into<PathBuf>, bytes: impl AsRef<[u8]> + Send + Sync + 'static) {
        self.all.insert(name.into(), Shared::new(bytes));
    }

    /// The names that there are, in their order.
    pub fn names(&self) -> impl Iterator<Item = &Path> {
        self.all.keys().map(PathBuf::as_path)
    }

    fn of(&self, name: &Path) -> Result<&Shared, Fault> {
        self.all.get(name).ok_or_else(|| Fault::Unnamed { nearest: self.nearest(name) })
    }

    /// The name that is the fewest changes of letters away.
    fn nearest(&self, name: &Path) -> Option<String> {
        let (wanted, known) = (name.to_string_lossy(), self.all.keys().map(|known| known.to_string_lossy()));
        let nearest = known.min_by_key(|known| strsim::levenshtein(known, &wanted));
        nearest.map(String::from)
    }
}

impl<N: Into<PathBuf>, B: AsRef<[u8]> + Send + Sync + 'static> FromIterator<(N, B)> for MemorySources {
    fn from_iter<I: IntoIterator<Item = (N, B)>>(all: I) -> MemorySources {
        let mut sources = MemorySources::new();
        all.into_iter().for_each(|(name, bytes)| sources.insert(name, bytes));
        sources
    }
}

impl Sources for MemorySources {
    fn bytes(&self, name: &Path) -> Result<SourceBytes, Fault> {
        Ok(SourceBytes::shared(self.of(name)?.clone()))
    }

    fn is_stream(&self, _: &Path) -> bool {
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_that_is_not_there_is_answered_with_the_nearest() {
        let sources: MemorySources =
            [("scan.stl", "a"), ("nominal.stl", "b"), ("plan.toml", "c")].into_iter().collect();
        let said = sources.text("scans.stl".as_ref(), 9).unwrap_err().to_string();
        assert_eq!(
            said,
            "scans.stl: nothing goes by this name, the nearest is scan.stl; check the spelling of the name"
        );
        let said = MemorySources::new().text("a".as_ref(), 9).unwrap_err().to_string();
        assert_eq!(said, "a: nothing goes by this name; check the spelling of the name");
        assert_eq!(sources.length("none".as_ref()), None);
    }

    #[test]
    fn texts_up_to_a_limit() {
        let mut sources = MemorySources::new();
        sources.insert("plan.toml", "units = \"mm\"\n");
        sources.insert("plan.toml.gz", packed(b"units = \"mm\"\n"));
        sources.insert("wide.toml", b"\xff\xfea\0b\0=\x001\x003\x00");
        sources.insert("latin.toml", b"a = 1\nb = \"\xe4\"\n");
        sources.insert("empty.toml", "");
        let text = |name: &str, longest| sources.text(name.as_ref(), longest).map_err(|e| e.to_string());
        assert_eq!(text("plan.toml", 13).as_deref(), Ok("units = \"mm\"\n"));
        assert_eq!(text("plan.toml.gz", 13).as_deref(), Ok("units = \"mm\"\n"));
        assert_eq!(text("empty.toml", 0).as_deref(), Ok(""));
        assert_eq!(text("wide.toml", 13).as_deref(), Ok("ab=13"));
        for (name, longest, said) in [
            ("plan.toml", 12, "plan.toml: it is longer than 12 bytes"),
            ("plan.toml.gz", 12, "plan.toml.gz: it is longer than 12 bytes"),
            ("latin.toml", 99, "latin.toml, line 2: expected text in UTF-8"),
        ] {
            let error = text(name, longest).unwrap_err();
            assert!(error.starts_with(said), "{error}");
        }
        assert_eq!(sources.length("plan.toml".as_ref()), Some(13));
    }

    fn packed(bytes: &[u8]) -> Vec<u8> {
        use std::io::Write;
        let mut packer = flate2::write::GzEncoder::new(vec![], flate2::Compression::fast());
        packer.write_all(bytes).unwrap();
        packer.finish().unwrap()
    }
}
