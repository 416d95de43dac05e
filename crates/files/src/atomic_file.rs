//! A file that appears whole or not at all.

use crate::{
    error::{WriteError, WriteFault},
    temporary::Temporary,
};
use std::{
    fs::{self, File, OpenOptions},
    io::{self, BufWriter, Seek, SeekFrom, Write},
    path::{Path, PathBuf},
};

/// Written beside its place under another name, and moved there by [`AtomicFile::commit`]. Dropped before that, it is
/// removed, and what stood in its place before is untouched.
///
/// Devices and pipes, which cannot be replaced, are written directly. A symbolic link stays; the file it names is
/// replaced. Guards against failure of the program, not of the power supply: nothing is forced onto the disk.
#[derive(Debug)]
pub struct AtomicFile {
    /// Where it is written, and where it shall be; `None` for what is written directly. It is dropped before the file is
    /// closed: without its lock it would look like that of a run that was killed.
    places: Option<(Temporary, PathBuf)>,
    file: BufWriter<File>,
}

impl AtomicFile {
    /// Begins a file that will be at `path`.
    pub fn create(path: &Path) -> io::Result<AtomicFile> {
        let target = match fs::metadata(path) {
            Ok(there) if there.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
            Ok(there) if there.is_file() => fs::canonicalize(path)?,
            Ok(_) => {
                let file = OpenOptions::new().write(true).open(path)?;
                return Ok(AtomicFile { file: buffered(file), places: None });
            }
            Err(_) => path.to_path_buf(),
        };
        let (file, temporary) = Temporary::beside(&target)?;
        if let Ok(there) = fs::metadata(&target) {
            // Who could read the old file can read the new one.
            let _ = fs::set_permissions(temporary.path(), there.permissions());
        }
        Ok(AtomicFile { file: buffered(file), places: Some((temporary, target)) })
    }

    /// Finds out whether a file can be made at `path`, before there is anything to write. Nothing stays, and what stands
    /// there is not touched. Devices and pipes are not opened: that could block, and could end what reads them.
    ///
    /// # Errors
    /// A folder that does not exist or in which nothing can be made; a folder of this name; a file that is protected
    /// against writing.
    pub fn try_out(path: &Path) -> Result<(), WriteError> {
        let there = fs::metadata(path).ok();
        let refused = |e: io::Error| Err(WriteError::new(path, e));
        match there {
            Some(there) if there.is_file() && there.permissions().readonly() => {
                Err(WriteFault::Protected.in_file(path))
            }
            Some(there) if !there.is_file() && !there.is_dir() => Ok(()),
            _ => AtomicFile::create(path).map(drop).or_else(refused),
        }
    }

    /// Moves the file to its place, replacing what is there.
    pub fn commit(mut self) -> io::Result<()> {
        self.file.flush()?;
        match self.places.take() {
            // The file stays open, and so locked, until it has its name.
            Some((temporary, target)) => temporary.rename(&target),
            None => Ok(()),
        }
    }

    /// Where everything written so far can be read before the file is in its place; `None` for a device or a pipe.
    pub fn so_far(&mut self) -> io::Result<Option<&Path>> {
        self.flush()?;
        Ok(self.places.as_ref().map(|(temporary, _)| temporary.path()))
    }

    /// The file beside which helping files may be made.
    pub(crate) fn target(&self) -> PathBuf {
        match &self.places {
            Some((_, target)) => target.clone(),
            None => std::env::temp_dir().join("trueness"),
        }
    }
}

fn buffered(file: File) -> BufWriter<File> {
    BufWriter::with_capacity(1 << 18, file)
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }
    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Seek for AtomicFile {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::write::scratch::Folder;

    #[test]
    fn all_or_nothing() {
        let folder = Folder::new();
        let path = folder.path().join("out.txt");
        fs::write(&path, "old").unwrap();
        let mut file = AtomicFile::create(&path).unwrap();
        file.write_all(b"half").unwrap();
        drop(file);
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
        let mut file = AtomicFile::create(&path).unwrap();
        file.write_all(b"whole").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"old");
        file.commit().unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"whole");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn folders_are_refused() {
        let folder = Folder::new();
        assert_eq!(AtomicFile::create(folder.path()).unwrap_err().kind(), io::ErrorKind::IsADirectory);
        let missing = folder.path().join("no/such");
        assert_eq!(AtomicFile::create(&missing).unwrap_err().kind(), io::ErrorKind::NotFound);
    }

    #[test]
    fn trying_out_changes_nothing() {
        let folder = Folder::new();
        let (path, new) = (folder.path().join("old"), folder.path().join("new"));
        fs::write(&path, "old").unwrap();
        AtomicFile::try_out(&path).unwrap();
        AtomicFile::try_out(&new).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
        let refused = |path: &Path| AtomicFile::try_out(path).unwrap_err().to_string();
        assert!(refused(folder.path()).contains("this is a folder"));
        assert!(refused(&folder.path().join("no/such")).contains("the folder does not exist"));
        assert!(refused(&path.join("below")).contains("is not a folder"));
        let mut locked = fs::metadata(&path).unwrap().permissions();
        locked.set_readonly(true);
        fs::set_permissions(&path, locked).unwrap();
        assert!(refused(&path).contains("protected against writing"));
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_is_reported_and_the_device_stays() {
        let full = Path::new("/dev/full");
        let mut file = AtomicFile::create(full).unwrap();
        let written = file.write_all(&vec![0; 1 << 20]).and_then(|()| file.commit());
        assert_eq!(written.unwrap_err().kind(), io::ErrorKind::StorageFull);
        assert!(fs::metadata(full).is_ok_and(|m| !m.is_file()));
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_a_link() {
        let folder = Folder::new();
        let (real, link) = (folder.path().join("real"), folder.path().join("link"));
        fs::write(&real, "old").unwrap();
        std::os::unix::fs::symlink(&real, &link).unwrap();
        let mut file = AtomicFile::create(&link).unwrap();
        file.write_all(b"new").unwrap();
        file.commit().unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&real).unwrap(), b"new");
    }
}
