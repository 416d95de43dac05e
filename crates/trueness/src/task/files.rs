//! The files of a run, all of them known and tried before any work. What is read is never overwritten, and two outputs never share a
//! file. An output that cannot be written is found out at once and not after an hour.
//!
//! Every task lists its files here; nothing else opens an output for the first time.

use super::{TaskError, Watch};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use trueness_files::write::Writable;
use trueness_files::{AtomicFile, FileSources, Sources};

/// What a task reads and writes.
#[derive(Default)]
pub struct RunFiles {
    inputs: Vec<PathBuf>,
    outputs: Vec<Output>,
    in_place: bool,
}

struct Output {
    /// As the user knows it: `--json`.
    option: &'static str,
    path: PathBuf,
    /// What it holds, where its ending decides how.
    holds: Option<Writable>,
    /// Whether `-` is the standard output.
    on_stdout: bool,
    /// The endings that it may have, lower case, without dot; none: any.
    endings: &'static [&'static str],
}

impl RunFiles {
    /// Those that are read.
    pub fn of<'a>(inputs: impl IntoIterator<Item = &'a PathBuf>) -> RunFiles {
        RunFiles { inputs: inputs.into_iter().cloned().collect(), ..RunFiles::default() }
    }

    /// The document of `--json`, for which `-` is the standard output.
    pub fn document(self, path: Option<&PathBuf>) -> RunFiles {
        self.output("--json", path, None, true)
    }

    /// The report of `--html`.
    pub fn report(self, path: Option<&PathBuf>) -> RunFiles {
        self.output("--html", path, None, false)
    }

    /// A file of `--out` whose ending decides its format.
    pub fn out(self, path: Option<&PathBuf>, holds: Writable) -> RunFiles {
        self.output("--out", path, Some(holds), false)
    }

    /// Another file, of the option of this name.
    pub fn also(self, option: &'static str, path: Option<&PathBuf>) -> RunFiles {
        self.output(option, path, None, false)
    }

    /// Another file, of the option of this name, whose ending must be one of these, so that programs take it for what it is.
    pub fn ending(
        mut self,
        option: &'static str,
        path: Option<&PathBuf>,
        endings: &'static [&'static str],
    ) -> RunFiles {
        self = self.output(option, path, None, false);
        if let (Some(_), Some(last)) = (path, self.outputs.last_mut()) {
            last.endings = endings;
        }
        self
    }

    /// These, then those of the other: an error of one of these is found first.
    pub fn and(mut self, other: RunFiles) -> RunFiles {
        self.inputs.extend(other.inputs);
        self.outputs.extend(other.outputs);
        self.in_place |= other.in_place;
        self
    }

    /// Allows `--out` to replace the input.
    pub fn in_place(self, in_place: bool) -> RunFiles {
        RunFiles { in_place, ..self }
    }

    fn output(
        mut self,
        option: &'static str,
        path: Option<&PathBuf>,
        holds: Option<Writable>,
        on_stdout: bool,
    ) -> RunFiles {
        self.outputs.extend(path.map(|path| Output {
            option,
            path: path.clone(),
            holds,
            on_stdout,
            endings: &[],
        }));
        self
    }

    /// Refuses what cannot go well, before any work.
    ///
    /// # Errors
    /// Wrong usage: an empty name, an ending that no format has, an output that is an input or another output, a stream that would have
    /// to be read twice. Then what the system says: a missing folder, a protected file.
    pub fn check(&self, watch: &dyn Watch) -> Result<(), TaskError> {
        self.check_names()?;
        self.check_streams()?;
        for output in &self.outputs {
            if is_dash(&output.path) && !output.on_stdout {
                let option = output.option;
                return Err(TaskError::usage(format!(
                    "{option} -: only --json goes to the standard output; name a file (./- if it is to be called so)"
                )));
            }
            if let Some(holds) = output.holds {
                holds.check(&output.path)?;
            }
            output.check_ending()?;
        }
        self.check_overlaps()?;
        let files = || self.outputs.iter().map(|o| &o.path).filter(|path| !is_dash(path));
        files().try_for_each(|path| AtomicFile::try_out(path))?;
        remove_leftovers(files(), watch);
        Ok(())
    }

    /// An empty name is most often a variable of a script that was never set.
    fn check_names(&self) -> Result<(), TaskError> {
        let is_empty = |path: &Path| path.as_os_str().is_empty();
        if self.inputs.iter().any(|path| is_empty(path)) {
            return Err(TaskError::usage("the name of an input is empty; name a file"));
        }
        match self.outputs.iter().find(|output| is_empty(&output.path)) {
            Some(output) => Err(TaskError::usage(format!(
                "{}: the name of the file is empty; name a file",
                output.option
            ))),
            None => Ok(()),
        }
    }

    /// Standard input and pipes give their bytes once.
    fn check_streams(&self) -> Result<(), TaskError> {
        for (i, path) in self.inputs.iter().enumerate() {
            if is_stream(path) && self.inputs[..i].contains(path) {
                let shown = path.display();
                return Err(TaskError::usage(format!(
                    "{shown}: it can be read once only; save it in a file and name that twice"
                )));
            }
        }
        Ok(())
    }

    fn check_overlaps(&self) -> Result<(), TaskError> {
        let mut taken: Vec<(FileIdentity, &Output)> = vec![];
        let inputs: Vec<(FileIdentity, &PathBuf)> =
            self.inputs.iter().filter_map(|path| Some((FileIdentity::of_input(path)?, path))).collect();
        for output in &self.outputs {
            let Some(place) = FileIdentity::of_output(&output.path) else { continue };
            let (option, shown) = (output.option, output.path.display());
            if let Some((_, other)) = taken.iter().find(|(p, _)| *p == place) {
                let (first, there) = (other.option, other.path.display());
                return Err(TaskError::usage(format!(
                    "{option} {shown} and {first} {there} are the same file; give each its own"
                )));
            }
            let replaces = self.in_place && option == "--out";
            if let Some((_, input)) = inputs.iter().find(|(p, _)| *p == place && !replaces) {
                let input = input.display();
                let remedy = match output.holds {
                    Some(Writable::Mesh) => "write to another file, or add --in-place",
                    _ => "write to another file",
                };
                return Err(TaskError::usage(format!(
                    "{option} {shown} would overwrite the input {input}, which is the same file; {remedy}"
                )));
            }
            // A path of an input that does not exist is told where it is opened.
            if replaces && !inputs.is_empty() && inputs.iter().all(|(p, _)| *p != place) {
                return Err(TaskError::usage(format!(
                    "--in-place writes over the input, but {option} names another file, {shown}: leave one of the two out"
                )));
            }
            taken.push((place, output));
        }
        Ok(())
    }
}

impl Output {
    fn check_ending(&self) -> Result<(), TaskError> {
        let ending = self.path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
        if self.endings.is_empty() || self.endings.contains(&&*ending) || is_stream(&self.path) {
            return Ok(());
        }
        let (option, shown) = (self.option, self.path.display());
        Err(TaskError::usage(format!("{option} {shown}: the ending must be .{}", self.endings.join(" or ."))))
    }
}

fn is_dash(path: &Path) -> bool {
    path == Path::new("-")
}

/// Whether a path stands for something that can be read once only.
pub fn is_stream(path: &Path) -> bool {
    FileSources.is_stream(path)
}

/// Which file a path stands for, whatever way it is spelled and through whichever links.
#[derive(PartialEq, Eq)]
enum FileIdentity {
    /// Device and number of a file that exists.
    #[cfg(unix)]
    Node(u64, u64),
    /// Full path: of a file that does not exist yet, or where files have no numbers.
    Path(PathBuf),
}

impl FileIdentity {
    /// Of what is read; `-` is what the standard input was redirected from. `None` for devices and pipes.
    fn of_input(path: &Path) -> Option<FileIdentity> {
        FileIdentity::existing(if is_dash(path) { Path::new("/dev/stdin") } else { path })
    }

    /// Of what is written; `-` is what the standard output was redirected to. `None` for devices, pipes, and files whose
    /// folder does not exist.
    fn of_output(path: &Path) -> Option<FileIdentity> {
        if is_dash(path) {
            return FileIdentity::existing(Path::new("/dev/stdout"));
        }
        if fs::metadata(path).is_ok() {
            return FileIdentity::existing(path);
        }
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Some(FileIdentity::Path(fs::canonicalize(folder).ok()?.join(path.file_name()?)))
    }

    fn existing(path: &Path) -> Option<FileIdentity> {
        let there = fs::metadata(path).ok().filter(fs::Metadata::is_file)?;
        FileIdentity::node(path, &there)
    }

    #[cfg(unix)]
    fn node(_: &Path, there: &fs::Metadata) -> Option<FileIdentity> {
        use std::os::unix::fs::MetadataExt;
        Some(FileIdentity::Node(there.dev(), there.ino()))
    }

    #[cfg(not(unix))]
    fn node(path: &Path, _: &fs::Metadata) -> Option<FileIdentity> {
        fs::canonicalize(path).ok().map(FileIdentity::Path)
    }
}

/// Clears the folders of the outputs of what killed runs left there, and says so.
fn remove_leftovers<'a>(outputs: impl Iterator<Item = &'a PathBuf>, watch: &dyn Watch) {
    let folders: BTreeSet<PathBuf> = outputs
        .filter_map(|path| path.parent())
        .map(|folder| if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder.into() })
        .collect();
    for folder in folders {
        let found = trueness_files::remove_leftovers(&folder);
        for path in found.removed {
            watch.note(&format!("removed {}: an unfinished file of a run that was killed", path.display()));
        }
        for path in found.kept {
            watch.note(&format!(
                "{}: unfinished, by a run that was killed or is still under way; remove it once none is",
                path.display()
            ));
        }
    }
}
