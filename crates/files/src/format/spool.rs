//! Values that must stand behind others in a file, held until their turn comes.

use crate::{AtomicFile, temporary::Temporary};
use std::{
    fs::File,
    io::{self, Read, Seek, SeekFrom, Write},
    path::PathBuf,
};

/// Beyond this many bytes a temporary file is begun.
const MAX_SPOOL_MEMORY: usize = 32 << 20;

/// Bytes to be read again from the start, in memory or, when they grow, in a file beside the one being written.
pub(crate) struct Spool {
    memory: Vec<u8>,
    /// The file is removed before it is closed, which would free its lock.
    disk: Option<(Temporary, File)>,
    /// The file beside which one may be made.
    target: PathBuf,
    length: u64,
}

impl Spool {
    /// An empty spool for values of `file`.
    pub fn beside(file: &AtomicFile) -> Spool {
        Spool { memory: vec![], disk: None, target: file.target(), length: 0 }
    }

    /// Bytes held.
    pub fn len(&self) -> u64 {
        self.length
    }

    /// Adds bytes.
    pub fn write(&mut self, bytes: impl IntoIterator<Item = u8>) -> io::Result<()> {
        let before = self.memory.len();
        self.memory.extend(bytes);
        self.length += (self.memory.len() - before) as u64;
        if self.memory.len() >= MAX_SPOOL_MEMORY {
            let (_, file) = match &mut self.disk {
                Some(disk) => disk,
                none => {
                    let (file, temporary) = Temporary::beside(&self.target)?;
                    none.insert((temporary, file))
                }
            };
            file.write_all(&self.memory)?;
            self.memory.clear();
        }
        Ok(())
    }

    /// Hands all bytes to `out`, in order.
    pub fn play(&mut self, mut out: impl FnMut(&[u8]) -> io::Result<()>) -> io::Result<()> {
        if let Some((_, file)) = &mut self.disk {
            file.seek(SeekFrom::Start(0))?;
            let mut buffer = vec![0; 1 << 20];
            loop {
                match file.read(&mut buffer)? {
                    0 => break,
                    n => out(&buffer[..n])?,
                }
            }
        }
        out(&self.memory)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::write::scratch::Folder;

    #[test]
    fn what_outgrows_memory_comes_back_in_order_and_leaves_nothing() {
        let folder = Folder::new();
        let file = AtomicFile::create(&folder.path().join("out")).unwrap();
        let mut spool = Spool::beside(&file);
        let part: Vec<u8> = (0..1_000_003u32).map(|i| (i % 251) as u8).collect();
        for _ in 0..40 {
            spool.write(part.iter().copied()).unwrap();
        }
        assert!(spool.disk.is_some());
        let mut all = vec![];
        spool.play(|b| all.write_all(b)).unwrap();
        assert_eq!(all.len() as u64, spool.len());
        assert!(all.chunks(part.len()).all(|c| c == part));
        drop((spool, file));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
