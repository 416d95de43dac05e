//! Running the program as a user does, in a folder of its own.
#![allow(
    dead_code,
    clippy::disallowed_methods,
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    missing_docs
)]

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::atomic::{AtomicU32, Ordering};

pub fn corpus(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus").join(name)
}

/// A folder that is removed at the end.
pub struct Folder(pub PathBuf);

impl Folder {
    pub fn new() -> Folder {
        static NUMBER: AtomicU32 = AtomicU32::new(0);
        let n = NUMBER.fetch_add(1, Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("trueness-cli-{}-{n}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Folder(path)
    }
    pub fn file(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }
    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.file(name);
        std::fs::write(&path, content).unwrap();
        path
    }
    /// Names of the files in it, sorted.
    pub fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(&self.0).unwrap();
        let mut names: Vec<String> =
            entries.map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Runs `trueness` with these words.
pub fn trueness<S: AsRef<std::ffi::OsStr>>(words: impl IntoIterator<Item = S>) -> Output {
    Command::new(env!("CARGO_BIN_EXE_trueness")).args(words).output().unwrap()
}

pub fn status(o: &Output) -> i32 {
    o.status.code().expect("ended by itself")
}
pub fn stdout(o: &Output) -> String {
    String::from_utf8(o.stdout.clone()).unwrap()
}
pub fn stderr(o: &Output) -> String {
    String::from_utf8(o.stderr.clone()).unwrap()
}

/// The document that a successful `compare … --json -` prints.
pub fn document<S: AsRef<std::ffi::OsStr>>(words: impl IntoIterator<Item = S>) -> Value {
    let all = words.into_iter().map(|w| w.as_ref().to_owned()).chain(["--json".into(), "-".into()]);
    let o = trueness(all.collect::<Vec<std::ffi::OsString>>());
    assert!(status(&o) <= 1, "status {}: {}", status(&o), stderr(&o));
    serde_json::from_slice(&o.stdout).unwrap()
}

/// Whether what is kept of this kind (`numbers`, `words`) shall be written anew: `TRUENESS_BLESS` names it, or is 1 for all.
pub fn is_blessed(kind: &str) -> bool {
    match std::env::var("TRUENESS_BLESS").as_deref() {
        Err(_) => false,
        Ok("1") => true,
        Ok(given @ ("numbers" | "words")) => given == kind,
        Ok(other) => panic!("TRUENESS_BLESS={other}: give numbers, words or 1 for both"),
    }
}

/// The unit cube as an OFF file, outward.
pub const CUBE: &str = "OFF\n8 12 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n\
3 0 2 1\n3 1 2 3\n3 4 5 6\n3 5 7 6\n3 0 1 4\n3 1 5 4\n3 2 6 3\n3 3 6 7\n3 0 4 2\n3 2 4 6\n3 1 3 5\n3 3 7 5\n";
