//! The file system as a source.

use super::{SourceBytes, Sources, hash};
use crate::error::Fault;
use std::fs::{self, File};
use std::io;
use std::path::Path;

/// The files of the file system by their paths; `-` is standard input.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FileSources;

impl Sources for FileSources {
    fn bytes(&self, name: &Path) -> Result<SourceBytes, Fault> {
        if is_dash(name) {
            return Ok(SourceBytes::stream(io::stdin()));
        }
        SourceBytes::of_file(File::open(name).map_err(Fault::Io)?).map_err(|e| match e.kind() {
            io::ErrorKind::IsADirectory => Fault::Foreign {
                what: "this is a folder, which is not read here".into(),
                remedy: "give a file in it".into(),
            },
            _ => Fault::Io(e),
        })
    }

    fn is_stream(&self, name: &Path) -> bool {
        is_dash(name) || fs::metadata(name).is_ok_and(|there| !there.is_file() && !there.is_dir())
    }

    fn length(&self, name: &Path) -> Option<u64> {
        fs::metadata(name).ok().filter(|there| there.is_file() && !is_dash(name)).map(|there| there.len())
    }

    fn shown(&self, name: &Path) -> String {
        if is_dash(name) { "standard input".into() } else { name.display().to_string() }
    }
}

fn is_dash(name: &Path) -> bool {
    name == Path::new("-")
}

/// SHA-256 of a file's bytes as they lie on disk (packed, where they are packed).
///
/// Errors: those of opening and reading. Cost: one pass, about 2 GB/s where the processor has instructions for it.
pub fn sha256(path: &Path) -> io::Result<[u8; 32]> {
    hash::sha256(File::open(path)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::write::scratch::Folder;

    #[test]
    fn a_file_a_folder_and_nothing() {
        let folder = Folder::new();
        let path = folder.path().join("abc");
        std::fs::write(&path, "abc").unwrap();
        assert_eq!((FileSources.is_stream(&path), FileSources.length(&path)), (false, Some(3)));
        assert_eq!(FileSources.sha256(&path).unwrap(), sha256(&path).unwrap());
        assert_eq!(FileSources.text(&path, 3).unwrap(), "abc");
        assert!(matches!(FileSources.bytes(folder.path()).err(), Some(Fault::Foreign { .. })));
        let missing = folder.path().join("none");
        assert_eq!((FileSources.is_stream(&missing), FileSources.length(&missing)), (false, None));
        let said = FileSources.text(&missing, 3).unwrap_err().to_string();
        assert!(said.contains("none: ") && said.ends_with("check the spelling of the path"), "{said}");
    }

    #[test]
    fn standard_input_is_read_once_and_has_no_fingerprint() {
        let dash = Path::new("-");
        assert_eq!((FileSources.is_stream(dash), FileSources.length(dash)), (true, None));
        assert_eq!(FileSources.shown(dash), "standard input");
        assert!(FileSources.sha256(dash).unwrap_err().to_string().contains("once only"));
    }

    #[cfg(unix)]
    #[test]
    fn a_device_is_a_stream() {
        let device = Path::new("/dev/null");
        assert_eq!((FileSources.is_stream(device), FileSources.length(device)), (true, None));
        assert_eq!(FileSources.bytes(device).unwrap().length(), None);
    }
}
