//! What the measuring programs share: their arguments, their inputs, and a stopwatch for wall and processor time.

pub mod shapes;

use cpu_time::ProcessTime;
use std::{error::Error, fs, io, path::Path, time::Instant};
use trueness_files::{Body, ReadOptions};
use trueness_geom::{mesh::Mesh, space::Point};

/// Anything that may go wrong in a measuring program; it is printed and ends the run.
pub type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// What is asked of every point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// The distance.
    Unsigned,
    /// The distance, negative inside.
    Signed,
    /// The winding number.
    Winding,
}

/// The one command line that all programs for this job understand:
/// `MESH POINTS.npy OUT.f64 THREADS REPEAT unsigned|signed|winding`.
pub struct Job {
    /// The mesh.
    pub mesh: Mesh,
    /// The points.
    pub points: Vec<Point>,
    /// Where the answers go: one little-endian `f64` a point, in the order of the points.
    pub out: String,
    /// How many times to answer all points.
    pub repeat: usize,
    /// What is asked.
    pub mode: Mode,
}

impl Job {
    /// Reads the command line and the files it names, and sets the number of threads.
    pub fn from_args() -> Result<Job> {
        let words: Vec<String> = std::env::args().skip(1).collect();
        let [mesh, points, out, threads, repeat, mode] = words.as_slice() else {
            return Err("usage: MESH POINTS.npy OUT.f64 THREADS REPEAT unsigned|signed|winding".into());
        };
        let mode = match mode.as_str() {
            "unsigned" => Mode::Unsigned,
            "signed" => Mode::Signed,
            "winding" => Mode::Winding,
            other => return Err(format!("{other}: expected unsigned, signed or winding").into()),
        };
        rayon::ThreadPoolBuilder::new().num_threads(threads.parse()?).build_global()?;
        Ok(Job {
            mesh: read_mesh(mesh)?,
            points: read_npy(points)?,
            out: out.clone(),
            repeat: repeat.parse()?,
            mode,
        })
    }

    /// Times `answer` as often as asked, writes what it gave last, and prints the line that the runner reads.
    pub fn report(&self, build: Lap, mut answer: impl FnMut() -> Result<Vec<f64>>) -> Result<()> {
        let (mut wall, mut cpu, mut last) = (vec![], vec![], vec![]);
        for _ in 0..self.repeat {
            // The answers before are freed first: a caller that keeps them pays for that, not we.
            drop(std::mem::take(&mut last));
            let (lap, answers) = timed(&mut answer);
            last = answers?;
            wall.push(lap.wall);
            cpu.push(lap.cpu);
        }
        let bytes: Vec<u8> = last.iter().flat_map(|x| x.to_le_bytes()).collect();
        fs::write(&self.out, bytes)?;
        let line = serde_json::json!({
            "build_s": build.wall, "build_cpu_s": build.cpu, "query_s": wall, "cpu_s": cpu,
        });
        println!("{line}");
        Ok(())
    }
}

/// Seconds that something took.
#[derive(Clone, Copy, Debug)]
pub struct Lap {
    /// By the clock on the wall.
    pub wall: f64,
    /// Processor time of all threads, which other programs on the machine disturb less.
    pub cpu: f64,
}

impl Lap {
    /// Both together.
    pub fn and(self, other: Lap) -> Lap {
        Lap { wall: self.wall + other.wall, cpu: self.cpu + other.cpu }
    }
}

/// Does it and says how long it took.
pub fn timed<T>(work: impl FnOnce() -> T) -> (Lap, T) {
    // Asking for the processor time is a system call: it is left out of the time by the clock.
    let cpu = ProcessTime::now();
    let wall = Instant::now();
    let result = work();
    let wall = wall.elapsed().as_secs_f64();
    (Lap { wall, cpu: cpu.elapsed().as_secs_f64() }, result)
}

/// The mesh of a file of any kind, welded.
pub fn read_mesh(path: impl AsRef<Path>) -> Result<Mesh> {
    match trueness_files::open(path.as_ref(), &ReadOptions::default())?.body {
        Body::Mesh(source) => Ok(source.mesh),
        Body::Points(_) | Body::Splines(_) | Body::Cad(_) | Body::Drawing(_) => Err("expected a mesh".into()),
    }
}

/// All points of a file of any kind.
pub fn read_points(path: impl AsRef<Path>) -> Result<Vec<Point>> {
    let mut stream = trueness_files::open(path.as_ref(), &ReadOptions::default())?.body.into_points();
    let (mut all, mut block) = (vec![], vec![]);
    loop {
        stream.next_block(&mut block)?;
        if block.is_empty() {
            return Ok(all);
        }
        all.extend_from_slice(&block);
    }
}

/// A NumPy file of `float64 (N, 3)` in C order, which is what every rival reads fastest.
pub fn read_npy(path: &str) -> Result<Vec<Point>> {
    use io::Read;
    let mut file = io::BufReader::with_capacity(1 << 20, fs::File::open(path)?);
    let mut head = [0u8; 10];
    file.read_exact(&mut head)?;
    let mut about = vec![0; usize::from(u16::from_le_bytes([head[8], head[9]]))];
    file.read_exact(&mut about)?;
    let about = String::from_utf8(about)?;
    if !about.contains("'<f8'") || !about.contains("'fortran_order': False") {
        return Err(format!("{path}: expected float64 (N, 3) in C order, found {about}").into());
    }
    let mut points = vec![];
    let mut bytes = [0; 24];
    loop {
        match file.read_exact(&mut bytes) {
            Ok(()) => points
                .push(std::array::from_fn(|k| f64::from_le_bytes(std::array::from_fn(|j| bytes[8 * k + j])))),
            Err(e) if e.kind() == io::ErrorKind::UnexpectedEof => return Ok(points),
            Err(e) => return Err(e.into()),
        }
    }
}
