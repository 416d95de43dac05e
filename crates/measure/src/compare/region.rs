//! Parts of the reference with tolerances of their own.
//!
//! A point belongs to the region in which its place on the reference lies: the first of the list that has it. Points of a region
//! are judged by its tolerance alone, all others by the comparison's.

use trueness_document::tolerance::Tolerance;
use trueness_geom::closest::Tree;
use trueness_geom::mesh::Mesh;
use trueness_geom::progress::{Cancelled, Progress};
use trueness_geom::segment::{self, SegmentError};
use trueness_geom::space::Point;

/// A region as it is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionRule {
    /// Its name.
    pub id: String,
    /// What belongs to it.
    pub extent: Extent,
    /// What its points must keep.
    pub tolerance: Tolerance,
    /// Share of its points that must, 0 to 1.
    pub required_share: f64,
}

/// What belongs to a region. Places in the coordinates of the reference, millimeters.
#[derive(Clone, Debug, PartialEq)]
pub enum Extent {
    /// The plane, cylinder, cone or sphere of the reference around this place, as the segmentation finds it.
    Seed(Point),
    /// What lies between two corners.
    Between(Point, Point),
    /// These facets of the reference, ascending.
    Facets(Vec<u32>),
}

/// Why a region cannot be found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RegionError {
    /// Nothing is there.
    #[error("region \"{id}\": {what}")]
    Nowhere {
        /// Its name.
        id: String,
        /// What is missing.
        what: String,
    },
    /// The work was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Regions found on one reference.
#[derive(Clone, Debug)]
pub struct Regions {
    rules: Vec<RegionRule>,
    /// Of each facet the first region that has it, counted from 1; 0 for none.
    facets: Vec<u16>,
    boxes: Vec<(u16, Point, Point)>,
}

/// A seed farther from the reference than this share of its diagonal is none of its places.
const MAX_SEED_DISTANCE_SHARE: f64 = 0.02;

/// What is said of a seed so far from the reference that it must be meant for another part, unit or frame.
pub(crate) fn far_seed(distance: f64, nearest: Point, reference: &Mesh) -> Option<String> {
    let [x, y, z] = nearest.map(|x| (1e3 * x).round() / 1e3);
    (distance > MAX_SEED_DISTANCE_SHARE * reference.bounds().diagonal()).then(|| {
        format!(
            "the seed is {distance:.3} mm from the reference; give a place on it (the nearest is {x}, {y}, {z} mm)"
        )
    })
}

impl Regions {
    /// Finds them. `seed` is that of the segmentation's random choices, which is only made for seeds.
    ///
    /// # Errors
    /// [`RegionError`]: a seed where the reference has no plane, cylinder, cone or sphere; a region without any facet; cancelled.
    pub fn new(
        rules: &[RegionRule],
        mesh: &Mesh,
        tree: &Tree,
        seed: u64,
        progress: &dyn Progress,
    ) -> Result<Regions, RegionError> {
        let seeds = rules.iter().any(|r| matches!(r.extent, Extent::Seed(_)));
        let nowhere = |rule: &RegionRule, what: String| RegionError::Nowhere { id: rule.id.clone(), what };
        let options = segment::Options { seed, ..segment::Options::default() };
        let found = match rules.first().filter(|_| seeds) {
            None => None,
            Some(first) => Some(segment::mesh(mesh, &options, progress).map_err(|e| match e {
                SegmentError::Cancelled(e) => RegionError::Cancelled(e),
                e => nowhere(first, format!("the reference cannot be segmented: {e}")),
            })?),
        };
        let mut out = Regions { rules: rules.to_vec(), facets: vec![0; mesh.faces.len()], boxes: vec![] };
        for (number, rule) in (1..).zip(rules) {
            let facets = match &rule.extent {
                Extent::Between(low, high) => {
                    out.boxes.push((number, *low, *high));
                    continue;
                }
                Extent::Facets(facets) => facets.clone(),
                Extent::Seed(place) => {
                    let hit = tree.closest(place, f64::INFINITY).map_err(|e| nowhere(rule, e.to_string()))?;
                    if let Some(what) = hit.and_then(|hit| far_seed(hit.distance, hit.point, mesh)) {
                        return Err(nowhere(rule, what));
                    }
                    let labels = found.as_ref().map_or(&[][..], |f| &f.labels);
                    let label = hit.and_then(|hit| labels.get(hit.face as usize)).filter(|l| **l != u32::MAX);
                    let own =
                        |label: u32| (0..).zip(labels).filter(move |(_, l)| **l == label).map(|(f, _)| f);
                    label.map(|label| own(*label).collect()).unwrap_or_default()
                }
            };
            if facets.is_empty() {
                let what = match rule.extent {
                    Extent::Seed(_) => {
                        "there is no plane, cylinder, cone or sphere of the reference at the seed"
                    }
                    _ => "the reference has no facets there",
                };
                return Err(nowhere(rule, what.into()));
            }
            for f in facets {
                if let Some(of) = out.facets.get_mut(f as usize).filter(|of| **of == 0) {
                    *of = number;
                }
            }
        }
        Ok(out)
    }

    /// As asked for.
    pub fn rules(&self) -> &[RegionRule] {
        &self.rules
    }

    /// Number of the region, counted from 1, that has this place of facet `face`; 0 for none.
    pub fn of(&self, face: u32, place: &Point) -> u16 {
        let facet = self.facets.get(face as usize).copied().filter(|n| *n > 0);
        let inside =
            |(_, low, high): &&(u16, Point, Point)| (0..3).all(|k| low[k] <= place[k] && place[k] <= high[k]);
        let first = self.boxes.iter().find(inside).map(|b| b.0);
        facet.into_iter().chain(first).min().unwrap_or(0)
    }

    /// What a deviation may be at a place of facet `face`: as its region says, `else_where` where it is in none.
    pub fn allowed(&self, face: u32, place: &Point, else_where: Option<Tolerance>) -> Option<[f64; 2]> {
        let zone = self.zone(self.of(face, place)).or(else_where)?;
        Some([zone.lower, zone.upper])
    }

    /// The zone of a region by its number.
    pub fn zone(&self, number: u16) -> Option<Tolerance> {
        self.rules.get(usize::from(number).checked_sub(1)?).map(|r| r.tolerance)
    }
}
