//! Facets that agree about the outside, for questions about the side of the material alone.

use super::error::RepairError;
use super::options::Options;
use super::work::Work;
use super::{orient, outward};
use trueness_geom::deviation::sign_choice::MIN_SHEET_OPENNESS;
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::Progress;
use trueness_geom::space::{Point, Vector, cross, dot, minus, norm, plus, times};

/// A mesh whose facets were turned where they had to be.
#[derive(Clone, Debug)]
pub struct Faced {
    /// The same vertices; facets as they were, turned over, or gone because they are there twice.
    pub mesh: Mesh,
    /// Facets that are gone: others have the same three vertices.
    pub doubled: usize,
    /// Facets turned over to run the same way round as their neighbors.
    pub turned: usize,
    /// Facets of shells turned over that looked inwards.
    pub inverted: usize,
}

/// `mesh` with facets that run the same way round as their neighbors and look out of the material.
///
/// One facet of several at the same place stays, and the smaller part of each sheet is turned. Closed shells that
/// enclose no material are turned (exactly; cavities stay). With `open_too`, open shells are turned as well that nearly
/// enclose a volume and look into it, as the nominal of a comparison. The length of their vector area is at most a
/// quarter of their area. The scan of a cavity looks like that too. Nothing else is mended. Cost: linear, as finding
/// the edges; winding numbers where closed shells lie in each other.
///
/// # Errors
/// [`RepairError`]: vertices that are not there, or cancelled.
///
/// ```
/// use trueness_geom::{mesh::Mesh, progress::Silent};
/// use trueness_solid::repair::faced;
/// let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// // Three facets of a tetrahedron look outwards, the last one inwards.
/// let mesh = Mesh { positions, faces: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 3, 2]] };
/// let found = faced(&mesh, false, &Silent).unwrap();
/// assert_eq!((found.turned, found.mesh.faces[3]), (1, [1, 2, 3]));
/// ```
pub fn faced(mesh: &Mesh, open_too: bool, progress: &dyn Progress) -> Result<Faced, RepairError> {
    let options = Options::default();
    let mut work = Work::new(mesh.clone(), &options, progress)?;
    let doubled = once(&mut work)?;
    orient::run(&mut work)?;
    let turned = work.state.changes.iter().map(|c| c.facets).sum();
    outward::run(&mut work)?;
    let closed = work.state.changes.iter().map(|c| c.facets).sum::<usize>() - turned;
    let open = if open_too { turn_open(&mut work)? } else { 0 };
    Ok(Faced { mesh: work.into_mesh(), doubled, turned, inverted: closed + open })
}

/// Keeps the first of the facets with the same three vertices, whichever way it looks: that is seen to later.
fn once(work: &mut Work) -> Result<usize, RepairError> {
    let known = work.known()?;
    let again: Vec<u32> = known.topology.duplicate_facets.iter().map(|[_, again]| *again).collect();
    work.replace(&again, &[]);
    Ok(again.len())
}

/// Sums over the facets of a shell: corners' mean weighted by area, vector area, volume towards the origin.
#[derive(Clone, Copy, Default)]
struct Sum {
    area: f64,
    weighted: Point,
    vector: Vector,
    volume: f64,
}

impl Sum {
    /// The volume that the shell nearly encloses, as seen from its middle; `None` for a sheet.
    fn enclosed(&self) -> Option<f64> {
        let middle = times(1.0 / self.area, self.weighted);
        (self.area > 0.0 && norm(self.vector) <= MIN_SHEET_OPENNESS * self.area)
            .then(|| self.volume - dot(middle, self.vector) / 3.0)
    }
}

/// Turns open shells over that nearly enclose a volume and look into it.
fn turn_open(work: &mut Work) -> Result<usize, RepairError> {
    let known = work.known()?;
    let topology = &known.topology;
    let origin = known.properties.bounds.min;
    let mut sums: Vec<Option<Sum>> = vec![None; topology.shells];
    for edge in &topology.boundary_edges {
        sums[topology.shell_of[edge.facet as usize] as usize] = Some(Sum::default());
    }
    let counting = || (0u32..).zip(&topology.shell_of).filter(|(_, shell)| **shell != u32::MAX);
    for (facet, &shell) in counting() {
        let Some(sum) = &mut sums[shell as usize] else { continue };
        let [a, b, c] = work.corners(facet).map(|p| minus(p, origin));
        let vector = times(0.5, cross(minus(b, a), minus(c, a)));
        let (area, middle) = (norm(vector), times(1.0 / 3.0, plus(a, plus(b, c))));
        sum.area += area;
        sum.weighted = plus(sum.weighted, times(area, middle));
        sum.vector = plus(sum.vector, vector);
        sum.volume += dot(middle, vector) / 3.0;
    }
    let looks_inwards = |sum: &Option<Sum>| sum.and_then(|s| s.enclosed()).is_some_and(|v| v < 0.0);
    let wrong: Vec<bool> = sums.iter().map(looks_inwards).collect();
    let turned: Vec<u32> = counting().filter(|(_, shell)| wrong[**shell as usize]).map(|(f, _)| f).collect();
    let count = turned.len();
    if count > 0 {
        work.turn(turned);
    }
    Ok(count)
}

#[cfg(test)]
mod tests {
    use super::faced;
    use trueness_geom::mesh::Mesh;
    use trueness_geom::num::random::Random;
    use trueness_geom::progress::Silent;
    use trueness_geom::samples::block;

    /// The block as it should be, some of its facets turned, some there twice, or all turned; open at one side or not.
    #[test]
    fn however_facets_are_turned_they_look_outwards() {
        let random = &mut Random::new(7);
        for round in 0..200 {
            let whole = block(3, 2.0);
            let is_open = round % 2 == 0;
            // The block's center is not the origin, nor does it lie at its side.
            let kept =
                |face: &&[u32; 3]| !is_open || face.iter().any(|v| whole.positions[*v as usize][2] > 0.0);
            let mut faces: Vec<[u32; 3]> = whole.faces.iter().filter(kept).copied().collect();
            let expected = sorted(&faces);
            let share = [0.0, 0.1, 0.4, 1.0][random.below(4) as usize];
            faces.iter_mut().filter(|_| random.unit() < share).for_each(|face| face.swap(1, 2));
            for _ in 0..random.below(3) {
                let again = faces[random.below(faces.len() as u64) as usize];
                faces.push(if random.below(2) == 0 { again } else { [again[1], again[0], again[2]] });
            }
            let mesh = Mesh { positions: whole.positions.clone(), faces };
            let found = faced(&mesh, true, &Silent).unwrap();
            assert_eq!(sorted(&found.mesh.faces), expected, "round {round}, {share} turned");
            let changed = found.doubled + found.turned + found.inverted;
            assert_eq!(changed == 0, mesh.faces == found.mesh.faces);
            assert_eq!(found.doubled, mesh.faces.len() - found.mesh.faces.len());
            assert_eq!(found.mesh.positions, mesh.positions);
        }
    }

    /// Facets from their least vertex on, in order.
    fn sorted(faces: &[[u32; 3]]) -> Vec<[u32; 3]> {
        let least = |f: &[u32; 3]| (0..3).map(|k| [f[k], f[(k + 1) % 3], f[(k + 2) % 3]]).min().unwrap();
        let mut all: Vec<[u32; 3]> = faces.iter().map(least).collect();
        all.sort_unstable();
        all
    }
}
