//! Inputs are never overwritten, outputs are tried before the work, and nothing is left behind.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use crate::common::*;
use std::ffi::OsStr;

const POINTS: &str = "0 0 2\n1 1 3\n0.5 0.5 0.5\n";

fn run(words: &[&OsStr]) -> std::process::Output {
    trueness(words)
}

/// Runs and expects a refusal that says all of `words`, prints no table, and changes nothing in the folder.
fn refused(f: &Folder, words: &[&OsStr], want: i32, hints: &[&str]) {
    // A pipe would wait for its other end.
    let content = |name: &String| f.file(name).is_file().then(|| std::fs::read(f.file(name)).unwrap());
    let state = || f.names().into_iter().map(|n| (content(&n), n)).collect::<Vec<_>>();
    let before = state();
    let o = run(words);
    assert_eq!(status(&o), want, "{words:?}: {}", stderr(&o));
    for hint in hints {
        assert!(stderr(&o).contains(hint), "{words:?}: ‘{hint}’ is missing in {}", stderr(&o));
    }
    assert!(stdout(&o).is_empty(), "{words:?}: {}", stdout(&o));
    assert!(before == state(), "{words:?}: a file changed");
}

/// Another name of a file: a symbolic link to it, a hard link, and its path through its folder.
#[cfg(unix)]
fn other_names(f: &Folder, name: &str) -> Vec<std::path::PathBuf> {
    let (soft, hard) = (f.file(&format!("soft.{name}")), f.file(&format!("hard.{name}")));
    std::os::unix::fs::symlink(f.file(name), &soft).unwrap();
    std::fs::hard_link(f.file(name), &hard).unwrap();
    std::fs::create_dir_all(f.file("sub")).unwrap();
    vec![f.file(name), f.0.join(".").join(name), f.file("sub").join("..").join(name), soft, hard]
}

#[cfg(unix)]
#[test]
fn an_output_that_is_an_input_is_refused_by_every_command() {
    let f = Folder::new();
    let (p, c) = (f.write("p.xyz", POINTS), f.write("c.off", CUBE));
    let scale = f.write("s.json", "{}");
    let (p, c, scale) = (p.as_os_str(), c.as_os_str(), scale.as_os_str());
    let w = OsStr::new;
    for name in ["p.xyz", "c.off", "s.json"] {
        for other in other_names(&f, name) {
            let o = other.as_os_str();
            for option in ["--json", "--html", "--out"] {
                if option == "--out" && name != "p.xyz" {
                    continue;
                }
                let words = [w("compare"), p, c, w("--scale"), scale, w(option), o];
                refused(&f, &words, 2, &[option, "would overwrite the input", name]);
            }
            if name == "c.off" {
                refused(&f, &[w("check"), c, w("--json"), o], 2, &["would overwrite the input"]);
                refused(&f, &[w("check"), c, w("--html"), o], 2, &["would overwrite the input"]);
                refused(&f, &[w("segment"), c, w("--json"), o], 2, &["would overwrite the input"]);
                refused(&f, &[w("repair"), c, w("-o"), o], 2, &["would overwrite the input", "--in-place"]);
                refused(&f, &[w("repair"), c, w("-o"), w("/tmp/new.ply"), w("--json"), o], 2, &["overwrite"]);
            }
            if name == "p.xyz" {
                refused(&f, &[w("fit"), p, w("--shape"), w("plane"), w("--json"), o], 2, &["overwrite"]);
            }
        }
    }
    // The files of several references are numbered.
    let first = f.write("d.1.csv", POINTS);
    let d = f.file("d.csv");
    refused(&f, &[w("compare"), first.as_os_str(), c, c, w("--out"), d.as_os_str()], 2, &["d.1.csv"]);
    // What the standard input was redirected from is an input too.
    let script = "exec \"$0\" check - --json \"$1\" < \"$1\"";
    let mut bash = std::process::Command::new("bash");
    let o = bash.args(["-c", script, env!("CARGO_BIN_EXE_trueness")]).arg(c).output().unwrap();
    assert_eq!(status(&o), 2, "{}", stderr(&o));
    assert_eq!(std::fs::read_to_string(c).unwrap(), CUBE);
}

#[cfg(unix)]
#[test]
fn two_outputs_never_share_a_file() {
    let f = Folder::new();
    let (p, c) = (f.write("p.xyz", POINTS), f.write("c.off", CUBE));
    let (p, c, w) = (p.as_os_str(), c.as_os_str(), OsStr::new);
    std::fs::create_dir_all(f.file("sub")).unwrap();
    let (new, same) = (f.file("new.csv"), f.file("sub").join("..").join("new.csv"));
    let words = [w("compare"), p, c, w("--out"), new.as_os_str(), w("--json"), same.as_os_str()];
    refused(&f, &words, 2, &["are the same file", "--out", "--json"]);
    let words = [w("segment"), c, w("--html"), new.as_os_str(), w("--json"), same.as_os_str()];
    refused(&f, &words, 2, &["are the same file"]);
    // Devices take anything.
    let o = run(&[w("compare"), p, c, w("--html"), w("/dev/null"), w("--json"), w("/dev/null")]);
    assert_eq!(status(&o), 0, "{}", stderr(&o));
}

#[test]
fn a_mesh_is_repaired_in_place_where_that_is_said() {
    let f = Folder::new();
    let open = CUBE.replace("8 12 0", "8 11 0").replace("3 0 2 1\n", "");
    let (a, b) = (f.write("a.off", &open), f.write("b.off", &open));
    let w = OsStr::new;
    let o = run(&[w("repair"), a.as_os_str(), w("--in-place")]);
    assert_eq!(status(&o), 0, "{}", stderr(&o));
    let o = run(&[w("repair"), b.as_os_str(), w("--in-place"), w("-o"), b.as_os_str()]);
    assert_eq!(status(&o), 0, "{}", stderr(&o));
    for mended in [&a, &b] {
        assert_eq!(status(&run(&[w("check"), mended.as_os_str()])), 0);
    }
    refused(&f, &[w("repair"), a.as_os_str()], 2, &["--out"]);
}

#[test]
fn in_place_and_another_output_contradict_each_other() {
    let f = Folder::new();
    let open = CUBE.replace("8 12 0", "8 11 0").replace("3 0 2 1\n", "");
    let (a, other) = (f.write("a.off", &open), f.file("other.off"));
    let w = OsStr::new;
    let words = [w("repair"), a.as_os_str(), w("--in-place"), w("-o"), other.as_os_str()];
    refused(&f, &words, 2, &["--in-place", "other.off", "leave one of the two out"]);
    assert!(!other.exists());
    assert_eq!(std::fs::read_to_string(&a).unwrap(), open);
}

/// The input is a pipe that nobody writes to: a run that looked at it first would never end.
#[cfg(unix)]
#[test]
fn outputs_are_tried_before_anything_is_read() {
    let f = Folder::new();
    let cube = f.write("c.off", CUBE);
    let pipe = f.file("pipe");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let locked = f.write("locked.json", "{}");
    let mut rights = std::fs::metadata(&locked).unwrap().permissions();
    rights.set_readonly(true);
    std::fs::set_permissions(&locked, rights).unwrap();
    let w = OsStr::new;
    for (option, name, want, hint) in [
        ("--json", "no/such/a.json", 3, "the folder does not exist: make it first"),
        ("--html", "no/such/a.html", 3, "the folder does not exist: make it first"),
        ("--out", "no/such/a.csv", 3, "the folder does not exist: make it first"),
        ("--json", ".", 3, "this is a folder"),
        ("--json", "c.off/a.json", 3, "is not a folder"),
        ("--html", "locked.json", 3, "protected against writing"),
        ("--out", "a.foo", 2, ".ply .csv"),
        ("--html", "-", 2, "name a file"),
    ] {
        let target = if name == "-" { name.into() } else { f.file(name) };
        let words = [w("compare"), pipe.as_os_str(), cube.as_os_str(), w(option), target.as_os_str()];
        let o = run(&words);
        assert_eq!(status(&o), want, "{words:?}: {}", stderr(&o));
        assert!(stderr(&o).contains(hint), "{words:?}: {}", stderr(&o));
    }
    assert_eq!(f.names(), ["c.off", "locked.json", "pipe"]);
}

/// Everything that a run can be told to write is refused by the same list that the help shows.
#[test]
fn the_help_lists_the_endings_that_the_message_lists() {
    let f = Folder::new();
    let (p, c) = (f.write("p.xyz", POINTS), f.write("c.off", CUBE));
    let (p, c) = (p.to_str().unwrap(), c.to_str().unwrap());
    for words in [vec!["compare", p, c], vec!["segment", c], vec!["repair", c]] {
        let o = trueness(words.iter().copied().chain(["--out", "a.foo"]));
        assert_eq!(status(&o), 2, "{}", stderr(&o));
        let said = stderr(&o);
        let (_, list) = said.split_once("end it in one of ").unwrap();
        let list = list.split(';').next().unwrap();
        let help = stdout(&trueness([words[0], "--help"]));
        let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(help.contains(list), "{list} is missing in {help}");
    }
}

#[cfg(unix)]
#[test]
fn a_named_pipe_is_read_once() {
    let f = Folder::new();
    let cube = f.write("c.off", CUBE);
    let pipe = f.file("pipe");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let end = pipe.clone();
    let writer = std::thread::spawn(move || std::fs::write(end, POINTS).unwrap());
    let d = document(["compare".as_ref(), pipe.as_os_str(), cube.as_os_str()]);
    writer.join().unwrap();
    assert_eq!(d["measured"]["count"], 3);
    assert!(d["inputs"][0]["sha256"].is_null());
    assert_eq!(d["inputs"][0]["sha256_reason"], "read from a pipe or a device");
    let w = OsStr::new;
    refused(&f, &[w("compare"), w("-"), w("-")], 2, &["read once only"]);
    let o = run(&[w("compare"), pipe.as_os_str(), pipe.as_os_str()]);
    assert_eq!(status(&o), 2, "{}", stderr(&o));
}

#[cfg(target_os = "linux")]
#[test]
fn names_that_are_no_text_are_read() {
    use std::os::unix::ffi::OsStrExt;
    let f = Folder::new();
    let cube = f.write("c.off", CUBE);
    let odd = f.0.join(OsStr::from_bytes(b"n\xff\xfe.xyz"));
    std::fs::write(&odd, POINTS).unwrap();
    let out = f.0.join(OsStr::from_bytes(b"o\xff.csv"));
    let words = ["compare".as_ref(), odd.as_os_str(), cube.as_os_str(), "--out".as_ref(), out.as_os_str()];
    let d = document(words);
    assert_eq!(d["measured"]["count"], 3);
    assert!(d["inputs"][0]["sha256"].is_string());
    assert!(out.exists());
}

/// What a killed run left is removed by the next one beside it; what a living one writes, and what others left, is not.
#[cfg(unix)]
#[test]
fn the_next_run_clears_up_after_a_killed_one() {
    let f = Folder::new();
    let (cube, out) = (f.write("c.off", CUBE), f.file("out.csv"));
    let pipe = f.file("pipe");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let begin = || {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_trueness"));
        let mut child = command
            .args(["compare".as_ref(), pipe.as_os_str(), cube.as_os_str(), "--out".as_ref(), out.as_os_str()])
            .spawn()
            .unwrap();
        // The pipe gives a first block and stays open: the run has begun its file and waits for more.
        let mut end = std::fs::OpenOptions::new().write(true).open(&pipe).unwrap();
        std::io::Write::write_all(&mut end, "0 0 2\n".repeat(100_000).as_bytes()).unwrap();
        let parts = || f.names().iter().filter(|n| n.ends_with(".part")).count();
        for _ in 0..400 {
            if parts() > 0 {
                break;
            }
            std::thread::sleep(std::time::Duration::from_millis(25));
        }
        assert_eq!(parts(), 1, "{:?}", child.try_wait());
        (child, end)
    };
    let check =
        || run(&["check".as_ref(), cube.as_os_str(), "--json".as_ref(), f.file("c.json").as_os_str()]);
    let (mut child, end) = begin();
    let o = check();
    assert_eq!((status(&o), stderr(&o).as_str()), (0, ""), "one that is being written stays");
    child.kill().unwrap();
    child.wait().unwrap();
    drop(end);
    assert!(f.names().iter().any(|n| n.ends_with(".part")));
    f.write(".other.part", "of another program");
    let o = check();
    assert_eq!(status(&o), 0);
    assert!(stderr(&o).contains("an unfinished file of a run that was killed"), "{}", stderr(&o));
    assert_eq!(f.names(), [".other.part", "c.json", "c.off", "pipe"]);
}

/// Interrupt, termination and hang-up, while the run waits for its input: heard within the time a person notices, with
/// the status that shells expect, and nothing stays.
#[cfg(unix)]
#[test]
fn signals_end_a_run_that_waits_and_leave_nothing() {
    // What this process ignores, as under `nohup` or in the background of a script, the program ignores too.
    let own = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = own.lines().find_map(|l| l.strip_prefix("SigIgn:")).map(str::trim);
    let ignored = mask.and_then(|m| u64::from_str_radix(m, 16).ok()).unwrap_or(0);
    for (signal, number, want) in [("INT", 2, 130), ("TERM", 15, 143), ("HUP", 1, 129)] {
        if ignored >> (number - 1) & 1 == 1 {
            continue;
        }
        let f = Folder::new();
        let (cube, out) = (f.write("c.off", CUBE), f.file("out.csv"));
        let pipe = f.file("pipe");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let child = std::process::Command::new(env!("CARGO_BIN_EXE_trueness"))
            .args(["compare".as_ref(), pipe.as_os_str(), cube.as_os_str(), "--out".as_ref(), out.as_os_str()])
            .stderr(std::process::Stdio::piped())
            .spawn()
            .unwrap();
        let mut end = std::fs::OpenOptions::new().write(true).open(&pipe).unwrap();
        std::io::Write::write_all(&mut end, "0 0 2\n".repeat(100_000).as_bytes()).unwrap();
        for _ in 0..400 {
            if f.names().iter().any(|n| n.ends_with(".part")) {
                break;
            }
            std::thread::sleep(std::time::Duration::from_millis(25));
        }
        let kill = |signal: &str| {
            let word = format!("-{signal}");
            std::process::Command::new("kill").args([word, child.id().to_string()]).status().unwrap();
        };
        kill(signal);
        let start = std::time::Instant::now();
        let o = child.wait_with_output().unwrap();
        // Its own patience is 0.06 s; the rest is for machines with much else to do.
        assert!(start.elapsed().as_secs_f64() < 2.0, "{signal}: {:?}", start.elapsed());
        assert_eq!(o.status.code(), Some(want), "{signal}");
        assert_eq!(f.names(), ["c.off", "pipe"], "{signal}");
        drop(end);
    }
}

/// A run under `nohup` outlives its terminal.
#[cfg(unix)]
#[test]
fn a_signal_that_was_to_be_ignored_is() {
    let f = Folder::new();
    let cube = f.write("c.off", CUBE);
    let script = "trap '' HUP; (sleep 0.3; cat) | \"$0\" check - & sleep 0.15; kill -HUP $!; wait $!";
    let mut bash = std::process::Command::new("bash");
    bash.args(["-c", script, env!("CARGO_BIN_EXE_trueness")]).stdin(std::fs::File::open(cube).unwrap());
    let o = bash.output().unwrap();
    assert_eq!(status(&o), 0, "{}", stderr(&o));
    assert!(stdout(&o).ends_with("\nsound\n"), "{}", stdout(&o));
}

#[cfg(target_os = "linux")]
#[test]
fn what_cannot_be_shown_is_an_error_and_a_closed_pipe_is_none() {
    let f = Folder::new();
    let (p, c) = (f.write("p.xyz", POINTS), f.write("c.off", CUBE));
    let bash = |script: &str| {
        let mut bash = std::process::Command::new("bash");
        bash.args(["-c", script, env!("CARGO_BIN_EXE_trueness")]).arg(&p).arg(&c).output().unwrap()
    };
    for words in
        ["compare \"$1\" \"$2\"", "compare \"$1\" \"$2\" --json -", "check \"$2\"", "--help", "check --help"]
    {
        let o = bash(&format!("exec \"$0\" {words} > /dev/full"));
        assert_eq!(status(&o), 3, "{words}: {}", stderr(&o));
        assert!(stderr(&o).contains("standard output"), "{words}: {}", stderr(&o));
        let o = bash(&format!("\"$0\" {words} | true; exit ${{PIPESTATUS[0]}}"));
        assert_eq!((status(&o), stderr(&o).as_str()), (0, ""), "{words}");
    }
    // Nobody can be told, but the status can.
    assert_eq!(status(&bash("exec \"$0\" check no/such/file 2> /dev/full")), 3);
}

#[test]
fn a_plan_is_never_replaced_and_finds_its_nominal() {
    let folder = Folder::new();
    let nominal = corpus("examples/plate").join("nominal.stl");
    let plan = folder.write("plate.toml", "# by hand\n");
    let words = ["plan".as_ref(), "init".as_ref(), nominal.as_os_str(), "--out".as_ref(), plan.as_os_str()];
    let o = trueness(words);
    assert_eq!(status(&o), 2, "{}", stderr(&o));
    assert!(stderr(&o).contains("the file exists"), "{}", stderr(&o));
    assert_eq!(std::fs::read_to_string(&plan).unwrap(), "# by hand\n");
    let fresh = folder.file("fresh.toml");
    let o = trueness([
        "plan".as_ref(),
        "init".as_ref(),
        nominal.as_os_str(),
        "--out".as_ref(),
        fresh.as_os_str(),
    ]);
    assert_eq!(status(&o), 0, "{}", stderr(&o));
    let text = std::fs::read_to_string(&fresh).unwrap();
    let line = text.lines().find(|l| l.starts_with("reference")).unwrap();
    let named = line.split('=').nth(1).unwrap().trim().trim_matches(['"', '\'']);
    assert!(folder.file(named).exists(), "{line}");
}
