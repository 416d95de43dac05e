//! Knots from a file.

use crate::task::{Meaning, TaskError};
use serde::Deserialize;
use std::path::Path;
use trueness_files::{Fault, ReadError, Sources};
use trueness_geom::spline::basis::Knots;

/// Largest file that is taken for knots.
const MAX_KNOT_BYTES: usize = 64 << 20;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct KnotsFile {
    u: Vec<f64>,
    v: Vec<f64>,
}

/// The knots of a file; their degrees are told by how often the first knot stands, and must be those asked for.
pub fn read(sources: &dyn Sources, path: &Path, degree: Option<[usize; 2]>) -> Result<[Knots; 2], TaskError> {
    let shown = path.display();
    let text = text(sources, path)?;
    let file: KnotsFile = serde_json::from_str(&text).meaning(|| {
        format!("{shown}: it holds no knots; give a JSON file {{\"u\": [numbers], \"v\": [numbers]}}")
    })?;
    let direction = |name: &str, values: Vec<f64>, asked: Option<usize>| {
        let ends = |t: Option<&f64>| values.iter().filter(|x| Some(*x) == t).count();
        let (first, last) = (ends(values.first()), ends(values.last()));
        if first != last || first < 2 {
            return Err(TaskError::unanswerable(format!(
                "{shown}: the knots of {name} are not clamped: the first stands {first} times, the last {last} times; both must stand degree + 1 times"
            )));
        }
        if let Some(asked) = asked.filter(|d| d + 1 != first) {
            let there = first - 1;
            let text = format!(
                "{shown}: the knots of {name} are of degree {there}, but --degree asks for {asked}; leave --degree out"
            );
            return Err(TaskError::unanswerable(text));
        }
        let knots = Knots::new(first - 1, values).meaning(|| format!("{shown}: knots of {name}"))?;
        if let Some((knot, times)) = knots.torn() {
            return Err(TaskError::unanswerable(format!(
                "{shown}: the knot {knot} of {name} stands {times} times and tears the surface apart: let it stand {} times at most",
                first - 1
            )));
        }
        Ok(knots)
    };
    Ok([direction("u", file.u, degree.map(|d| d[0]))?, direction("v", file.v, degree.map(|d| d[1]))?])
}

/// The text of a file of knots.
fn text(sources: &dyn Sources, path: &Path) -> Result<String, TaskError> {
    let shown = path.display();
    if let Some(length) = sources.length(path).filter(|length| *length > MAX_KNOT_BYTES as u64) {
        return Err(TaskError::unanswerable(format!(
            "{shown}: {} MB are too much for a file of knots; check the path",
            length >> 20
        )));
    }
    let cannot = || format!("{shown}: the knots cannot be read; check the path");
    match sources.text(path, MAX_KNOT_BYTES) {
        Err(ReadError { fault: Fault::Io(e), .. }) => Err(e).meaning(cannot),
        read => read.meaning(cannot),
    }
}
