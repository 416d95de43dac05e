//! Files that exist only while something is being written: their names, and the remains of killed runs.
//!
//! The run that writes such a file locks it. The system frees the lock when that run ends, however it ends. A run that
//! gets the lock knows that nobody writes the file any longer, and may remove it. A process number in the name
//! would not tell that: numbers are used again, and differ between machines that share a folder.

use std::{
    ffi::OsString,
    fs::{self, File, OpenOptions, TryLockError},
    io,
    path::{Path, PathBuf},
    sync::atomic::{AtomicU64, Ordering::Relaxed},
    sync::{Mutex, MutexGuard, PoisonError},
};

/// The name of every such file ends in this.
const UNFINISHED_ENDING: &str = ".trueness.part";

/// The unfinished files of this run.
static UNFINISHED_FILES: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn held() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED_FILES.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A file of this run that is removed when this goes out of scope.
#[derive(Debug)]
pub(crate) struct Temporary {
    path: PathBuf,
}

impl Temporary {
    /// A new file in the folder of `target`, so that moving it there is renaming. It stays locked while it is open.
    pub fn beside(target: &Path) -> io::Result<(File, Temporary)> {
        let Some(name) = target.file_name() else { return Err(io::ErrorKind::InvalidInput.into()) };
        loop {
            let path = target.with_file_name(new_name(&name.to_string_lossy()));
            let mut held = held();
            let file = OpenOptions::new().read(true).write(true).create_new(true).open(&path)?;
            held.push(path.clone());
            drop(held);
            let temporary = Temporary { path };
            // Another run may have found it before it was locked, and removed it.
            if lock(&file) != Lock::Foreign && is_at(&file, &temporary.path) {
                return Ok((file, temporary));
            }
        }
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Moves it to `target`, replacing what is there.
    pub fn rename(mut self, target: &Path) -> io::Result<()> {
        let mut held = held();
        fs::rename(&self.path, target)?;
        held.retain(|path| *path != self.path);
        self.path = PathBuf::new();
        Ok(())
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if !self.path.as_os_str().is_empty() {
            let mut held = held();
            // Nothing better can be done about a failure here.
            let _ = fs::remove_file(&self.path);
            held.retain(|path| *path != self.path);
        }
    }
}

/// A name that no other file of this process has. Long names are shortened: systems allow 255 bytes.
fn new_name(name: &str) -> OsString {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    let short: String = name.chars().take(40).collect();
    format!(".{short}.{}-{}{UNFINISHED_ENDING}", std::process::id(), NEXT.fetch_add(1, Relaxed)).into()
}

/// Whose lock a file has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Lock {
    Own,
    Foreign,
    /// The file system has no locks.
    Unknown,
}

/// Tries to get the lock. Outside Unix a locked file could not be opened a second time to read it again.
fn lock(file: &File) -> Lock {
    if !cfg!(unix) {
        return Lock::Unknown;
    }
    match file.try_lock() {
        Ok(()) => Lock::Own,
        Err(TryLockError::WouldBlock) => Lock::Foreign,
        Err(TryLockError::Error(_)) => Lock::Unknown,
    }
}

/// Whether the open file is the one that stands at `path`.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    match (file.metadata(), fs::metadata(path)) {
        (Ok(a), Ok(b)) => (a.dev(), a.ino()) == (b.dev(), b.ino()),
        _ => false,
    }
}

#[cfg(not(unix))]
fn is_at(_: &File, _: &Path) -> bool {
    true
}

/// Removes the unfinished files of this run, and lets no further one begin. It is the last act before a signal or a lack of
/// memory ends the program.
///
/// With `wait` false it gives up where another thread is just about to begin, move or remove one.
pub fn remove_unfinished(wait: bool) {
    let held = match UNFINISHED_FILES.try_lock() {
        Ok(held) => held,
        Err(_) if !wait => return,
        Err(_) => held(),
    };
    for path in held.iter() {
        let _ = fs::remove_file(path);
    }
    std::mem::forget(held);
}

/// Unfinished files that killed runs left in a folder.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Leftovers {
    /// Files that nobody wrote any longer; they are gone now.
    pub removed: Vec<PathBuf>,
    /// Files that may still be written, as the file system has no locks; they are still there.
    pub kept: Vec<PathBuf>,
}

/// Removes the unfinished files that killed runs left in `folder`. Files that another run is writing stay.
///
/// Errors: none; what cannot be read or removed is passed over. Cost: one pass over the names in the folder.
pub fn remove_leftovers(folder: &Path) -> Leftovers {
    let own = held().clone();
    leftovers(folder, &own)
}

/// The same for a run that holds `own`.
fn leftovers(folder: &Path, own: &[PathBuf]) -> Leftovers {
    let mut found = Leftovers::default();
    let Ok(entries) = fs::read_dir(folder) else { return found };
    for entry in entries.flatten() {
        let path = entry.path();
        if !is_ours(&entry.file_name().to_string_lossy())
            || own.iter().any(|p| p.ends_with(entry.file_name()))
        {
            continue;
        }
        let Ok(file) = File::open(&path) else { continue };
        match lock(&file) {
            Lock::Own => {
                // One that is empty may have been made just now, by a run that has not come to lock it.
                let young = file.metadata().is_ok_and(|m| m.len() == 0);
                match if young { writer(&path) } else { Writer::Gone } {
                    Writer::Gone if fs::remove_file(&path).is_ok() => found.removed.push(path),
                    // It holds nothing, and a run that still needs it makes another: there is nothing to report.
                    Writer::Unknown => drop(fs::remove_file(&path)),
                    Writer::Gone | Writer::There => {}
                }
            }
            Lock::Unknown => found.kept.push(path),
            Lock::Foreign => {}
        }
    }
    found.removed.sort();
    found.kept.sort();
    found
}

/// The run whose number a name has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Writer {
    /// A process has this number; it may be another one.
    There,
    /// No process here has it.
    Gone,
    /// The system does not tell.
    Unknown,
}

/// Whether there is a process of the number in the name of a file. Processes of another machine are not known here, but the moment
/// between the making of a file and its lock is short.
fn writer(path: &Path) -> Writer {
    let processes = Path::new("/proc");
    let name = path.file_name().map(|n| n.to_string_lossy());
    match name.as_deref().and_then(process).filter(|_| processes.join("self").exists()) {
        None => Writer::Unknown,
        Some(number) if processes.join(number).exists() => Writer::There,
        Some(_) => Writer::Gone,
    }
}

/// The number of the process in a name that [`new_name`] makes.
fn process(name: &str) -> Option<&str> {
    let (_, marks) = name.strip_suffix(UNFINISHED_ENDING)?.rsplit_once('.')?;
    let (process, n) = marks.split_once('-')?;
    let number = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    (name.starts_with('.') && number(process) && number(n)).then_some(process)
}

/// Whether a name is one that [`new_name`] makes.
fn is_ours(name: &str) -> bool {
    process(name).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::write::scratch::Folder;

    #[test]
    fn names_tell_whose_they_are() {
        assert!(is_ours(&new_name("out.csv").to_string_lossy()));
        assert!(new_name(&"ä".repeat(300)).len() < 255);
        for other in
            [".out.csv.12-3.part", "out.csv.12-3.trueness.part", ".out.trueness.part", ".a.x-1.trueness.part"]
        {
            assert!(!is_ours(other), "{other}");
        }
    }

    /// Four runs make, write and give up files while another one clears the folder, which sees their locks alone.
    #[cfg(unix)]
    #[test]
    fn nobody_is_said_to_have_been_killed_who_was_not() {
        use crate::atomic_file::AtomicFile;
        use std::{io::Write, sync::atomic::AtomicBool};
        let folder = Folder::new();
        let (done, said) = (AtomicBool::new(false), Mutex::new(vec![]));
        std::thread::scope(|scope| {
            scope.spawn(|| {
                while !done.load(Relaxed) {
                    let found = leftovers(folder.path(), &[]);
                    said.lock().unwrap().extend(found.removed);
                }
            });
            let writers: Vec<_> = (0..4)
                .map(|n| {
                    let target = folder.path().join(format!("out{n}.txt"));
                    scope.spawn(move || {
                        for round in 0..500 {
                            let mut file = AtomicFile::create(&target).unwrap();
                            file.write_all(b"half").unwrap();
                            file.flush().unwrap();
                            if round % 2 == 0 {
                                file.commit().unwrap();
                            }
                        }
                    })
                })
                .collect();
            writers.into_iter().for_each(|w| w.join().unwrap());
            done.store(true, Relaxed);
        });
        assert_eq!(*said.lock().unwrap(), Vec::<PathBuf>::new());
        // A file that was made and not yet locked is empty: it stays while its run is there. No process has the other number.
        let name = |process: u32| folder.path().join(format!(".out.csv.{process}-77.trueness.part"));
        let (born, left) = (name(std::process::id()), name(999_999_999));
        fs::write(&born, "").unwrap();
        fs::write(&left, "").unwrap();
        if Path::new("/proc/self").exists() {
            assert_eq!(leftovers(folder.path(), &[]).removed, [left]);
            assert!(born.exists());
        }
    }

    #[cfg(unix)]
    #[test]
    fn what_is_being_written_stays_and_what_nobody_writes_goes() {
        let folder = Folder::new();
        let target = folder.path().join("out.csv");
        let (file, temporary) = Temporary::beside(&target).unwrap();
        // As another run sees it: it knows nothing of what this one holds.
        let left = folder.path().join(".out.csv.1-0.trueness.part");
        let written = folder.path().join(".out.csv.2-0.trueness.part");
        fs::write(&left, "half").unwrap();
        fs::write(&written, "half").unwrap();
        let writer = File::open(&written).unwrap();
        writer.try_lock().unwrap();
        let other = folder.path().join(".notes.part");
        fs::write(&other, "of another program").unwrap();
        let found = remove_leftovers(folder.path());
        assert_eq!(found, Leftovers { removed: vec![left.clone()], kept: vec![] });
        assert!(!left.exists() && written.exists() && other.exists() && temporary.path().exists());
        drop(writer);
        assert_eq!(remove_leftovers(folder.path()).removed, [written]);
        drop((file, temporary));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
