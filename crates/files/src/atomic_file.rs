//! A file that appears whole or not at all.

use std::{
    fs::{self, File, OpenOptions},
    io::{self, BufWriter, Seek, SeekFrom, Write},
    path::{Path, PathBuf},
    sync::atomic::{AtomicU64, Ordering::Relaxed},
};

/// Written beside its place under another name, and moved there by [`AtomicFile::commit`]. Dropped before that, it is
/// removed, and what stood in its place before is untouched.
///
/// Devices and pipes, which cannot be replaced, are written directly. A symbolic link stays; the file it names is
/// replaced. Guards against failure of the program, not of the power supply: nothing is forced onto the disk.
#[derive(Debug)]
pub struct AtomicFile {
    /// Always there but while closing.
    file: Option<BufWriter<File>>,
    /// Where it is written, and where it shall be; `None` for what is written directly.
    places: Option<(PathBuf, PathBuf)>,
}

impl AtomicFile {
    /// Begins a file that will be at `path`.
    pub fn create(path: &Path) -> io::Result<AtomicFile> {
        let target = match fs::metadata(path) {
            Ok(there) if there.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
            Ok(there) if there.is_file() => fs::canonicalize(path)?,
            Ok(_) => {
                let file = OpenOptions::new().write(true).open(path)?;
                return Ok(AtomicFile { file: Some(buffered(file)), places: None });
            }
            Err(_) => path.to_path_buf(),
        };
        let beside = beside(&target)?;
        let file = OpenOptions::new().read(true).write(true).create_new(true).open(&beside)?;
        if let Ok(there) = fs::metadata(&target) {
            // Who could read the old file can read the new one.
            let _ = fs::set_permissions(&beside, there.permissions());
        }
        Ok(AtomicFile { file: Some(buffered(file)), places: Some((beside, target)) })
    }

    /// Moves the file to its place, replacing what is there.
    pub fn commit(mut self) -> io::Result<()> {
        if let Some(mut file) = self.file.take() {
            file.flush()?;
        }
        match &self.places {
            Some((beside, target)) => {
                fs::rename(beside, target)?;
                self.places = None;
                Ok(())
            }
            None => Ok(()),
        }
    }

    /// Where everything written so far can be read before the file is in its place; `None` for a device or a pipe.
    pub fn so_far(&mut self) -> io::Result<Option<&Path>> {
        self.flush()?;
        Ok(self.places.as_ref().map(|(beside, _)| beside.as_path()))
    }

    /// A free name in the same folder, for what helps to write this file.
    pub(crate) fn beside(&self) -> io::Result<PathBuf> {
        match &self.places {
            Some((_, target)) => beside(target),
            None => beside(&std::env::temp_dir().join("trueness")),
        }
    }

    fn inner(&mut self) -> io::Result<&mut BufWriter<File>> {
        self.file.as_mut().ok_or_else(|| io::ErrorKind::BrokenPipe.into())
    }
}

fn buffered(file: File) -> BufWriter<File> {
    BufWriter::with_capacity(1 << 18, file)
}

/// A new name in the same folder, so that moving is renaming.
fn beside(target: &Path) -> io::Result<PathBuf> {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    let Some(name) = target.file_name() else { return Err(io::ErrorKind::InvalidInput.into()) };
    let mut new = std::ffi::OsString::from(".");
    new.push(name);
    new.push(format!(".{}-{}.part", std::process::id(), NEXT.fetch_add(1, Relaxed)));
    Ok(target.with_file_name(new))
}

impl Drop for AtomicFile {
    fn drop(&mut self) {
        if let Some((beside, _)) = &self.places {
            self.file = None;
            // Nothing better can be done about a failure here.
            let _ = fs::remove_file(beside);
        }
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.inner()?.write(bytes)
    }
    fn flush(&mut self) -> io::Result<()> {
        self.inner()?.flush()
    }
}

impl Seek for AtomicFile {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.inner()?.seek(to)
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
