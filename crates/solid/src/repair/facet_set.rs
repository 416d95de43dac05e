//! Facets found by the places of their corners, in whichever order they run.

use trueness_geom::mesh::Mesh;
use trueness_geom::parallel::prelude::*;

/// The three places of a facet, sorted.
type Key = [[u64; 3]; 3];

/// No facet.
const NO_FACET: u32 = u32::MAX;

/// Facets of one mesh, to be found again in another.
///
/// An open-addressing table. A slot holds the number of a key, so that a question costs one look into the table and one
/// at the key.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct FacetSet {
    keys: Vec<Key>,
    slots: Vec<u32>,
}

impl FacetSet {
    /// The facets of `mesh` for which `counts` says yes, by number.
    pub fn of(mesh: &Mesh, counts: impl Fn(usize) -> bool + Sync) -> FacetSet {
        let counting = mesh.faces.par_iter().enumerate().filter(|(f, _)| counts(*f));
        let keys: Vec<Key> = counting.map(|(_, face)| key(mesh, face)).collect();
        let mut slots = vec![NO_FACET; (2 * keys.len()).next_power_of_two()];
        let starts: Vec<usize> = keys.par_iter().map(|key| start(key, slots.len())).collect();
        for (i, mut at) in (0..).zip(starts) {
            // A facet that is there several times takes one slot: copies would stand in the way of each other.
            while slots[at] != NO_FACET && keys[slots[at] as usize] != keys[i as usize] {
                at = (at + 1) & (slots.len() - 1);
            }
            slots[at] = i;
        }
        FacetSet { keys, slots }
    }

    /// Whether a facet of `mesh` is among them.
    pub fn holds(&self, mesh: &Mesh, face: &[u32; 3]) -> bool {
        let key = key(mesh, face);
        let mut at = if self.keys.is_empty() { return false } else { start(&key, self.slots.len()) };
        while self.slots[at] != NO_FACET {
            if self.keys[self.slots[at] as usize] == key {
                return true;
            }
            at = (at + 1) & (self.slots.len() - 1);
        }
        false
    }
}

fn key(mesh: &Mesh, face: &[u32; 3]) -> Key {
    let mut corners = face.map(|v| mesh.positions[v as usize].map(|x| (x + 0.0).to_bits()));
    corners.sort_unstable();
    corners
}

/// The slot where a key is looked for first: the highest bits of a product are mixed best.
fn start(key: &Key, slots: usize) -> usize {
    let mixed = key.as_flattened().iter().fold(0u64, |hash, bits| {
        let mixed = (hash ^ bits).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        mixed ^ (mixed >> 29)
    });
    (mixed.wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 32) as usize & (slots - 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use trueness_geom::samples::block;

    #[test]
    fn facets_are_found_by_their_places_alone() {
        let mesh = block(6, 3.0);
        let facets = mesh.faces.len();
        let same = FacetSet::of(&mesh, |f| f % 3 != 0);
        // The same facets with other numbers for their corners, the other way round.
        let last = mesh.positions.len() as u32 - 1;
        let mut other = mesh.clone();
        other.positions.reverse();
        other.faces.iter_mut().for_each(|f| *f = [last - f[2], last - f[1], last - f[0]]);
        for f in 0..facets {
            assert_eq!(same.holds(&other, &other.faces[f]), f % 3 != 0, "{f}");
        }
        other.positions[0][1] += 1e-9;
        let moved = |f: &&[u32; 3]| f.contains(&0);
        assert!(other.faces.iter().filter(moved).all(|f| !same.holds(&other, f)));
        assert!(!FacetSet::of(&mesh, |_| false).holds(&mesh, &mesh.faces[0]));
    }
}
