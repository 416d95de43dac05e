//! Knots from a file.

use anyhow::{Context, bail};
use serde::Deserialize;
use std::path::Path;
use trueness_geom::spline::basis::Knots;

/// Largest file that is taken for knots.
const LARGEST: u64 = 64 << 20;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct KnotsFile {
    u: Vec<f64>,
    v: Vec<f64>,
}

/// The knots of a file; their degrees are told by how often the first knot stands, and must be those asked for.
pub fn read(path: &Path, degree: Option<[usize; 2]>) -> anyhow::Result<[Knots; 2]> {
    let shown = path.display();
    let length = std::fs::metadata(path).with_context(|| format!("{shown}: the knots cannot be read"))?.len();
    if length > LARGEST {
        bail!("{shown}: {} MB are too large for knots", length >> 20);
    }
    let text = std::fs::read_to_string(path).with_context(|| format!("{shown}: the knots cannot be read"))?;
    let file: KnotsFile = serde_json::from_str(&text)
        .with_context(|| format!("{shown}: no knots; it must be {{\"u\": [numbers], \"v\": [numbers]}}"))?;
    let direction = |name: &str, values: Vec<f64>, asked: Option<usize>| {
        let ends = |t: Option<&f64>| values.iter().filter(|x| Some(*x) == t).count();
        let (first, last) = (ends(values.first()), ends(values.last()));
        if first != last || first < 2 {
            bail!(
                "{shown}: the knots of {name} are not clamped: the first stands {first} times, the last {last} times; both must stand degree + 1 times"
            );
        }
        if let Some(asked) = asked.filter(|d| d + 1 != first) {
            bail!("{shown}: the knots of {name} are of degree {}, --degree asks for {asked}", first - 1);
        }
        let knots = Knots::new(first - 1, values).with_context(|| format!("{shown}: knots of {name}"))?;
        if let Some((knot, times)) = knots.torn() {
            bail!(
                "{shown}: the knot {knot} of {name} stands {times} times and tears the surface apart: let it stand {} times at most",
                first - 1
            );
        }
        Ok(knots)
    };
    Ok([direction("u", file.u, degree.map(|d| d[0]))?, direction("v", file.v, degree.map(|d| d[1]))?])
}
