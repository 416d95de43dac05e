//! What is found.

use trueness_geom::space::{Point, Vector};

/// What the nearest place lies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum On {
    /// Within a face.
    Face(u32),
    /// On an edge, or on a side of a face that has none.
    Edge(u32),
    /// On a corner.
    Vertex(u32),
}

/// The place of a boundary nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Its distance; NaN for a boundary without faces.
    pub distance: f64,
    /// The place.
    pub place: Point,
    /// What it lies on. Edges beyond those of the boundary are sides of faces without edges.
    pub on: On,
    /// The face, of several that meet there the lowest.
    pub face: u32,
    /// Parameters within a face; on an edge its own parameter, twice; on a corner NaN.
    pub parameters: [f64; 2],
    /// On which side the point is.
    pub side: Side,
    /// The unit outward normal: of the face, or of all faces that meet there, weighted by their angles. `None` where they have none together.
    pub normal: Option<Vector>,
}

impl Nearest {
    /// The distance, below 0 inside; `None` where the side is not known.
    pub fn signed(&self) -> Option<f64> {
        match self.side {
            Side::Outside => Some(self.distance),
            Side::Inside => Some(-self.distance),
            Side::Open | Side::Unsure => None,
        }
    }
}

/// On which side of a boundary a point is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Where the normals look to, or on the boundary.
    Outside,
    /// Within the material.
    Inside,
    /// The boundary has an end there: an edge that only one face uses.
    Open,
    /// The faces that meet there do not tell.
    Unsure,
}

/// A place that may be the nearest.
#[derive(Clone, Copy)]
pub(super) struct Candidate {
    pub(super) distance: f64,
    pub(super) place: Point,
    pub(super) on: On,
    pub(super) parameters: [f64; 2],
    /// The shell of its face; `None` on edges and corners, and of a face alone.
    pub(super) shell: Option<u32>,
}

impl Candidate {
    /// Whether it is nearer, or as near and on what ties go to.
    pub(super) fn is_before(&self, other: &Candidate) -> bool {
        self.distance < other.distance || self.distance == other.distance && self.on < other.on
    }
}

/// The best candidate so far, and one within a face of another shell that is about as near: where parts touch, one has the point inside.
#[derive(Clone, Copy)]
pub(super) struct Best {
    pub(super) own: Candidate,
    pub(super) rival: Option<Candidate>,
    /// Distances are the same within this.
    same: f64,
}

impl Best {
    /// None so far.
    pub(super) fn none(same: f64) -> Best {
        let own = Candidate {
            distance: f64::INFINITY,
            place: [f64::NAN; 3],
            on: On::Vertex(u32::MAX),
            parameters: [f64::NAN; 2],
            shell: None,
        };
        Best { own, rival: None, same }
    }

    /// The distance beyond which nothing is of interest.
    pub(super) fn reach(&self) -> f64 {
        (self.own.distance + self.same).next_up()
    }

    /// The same for faces of a shell: only those of others are of interest where they are about as near.
    pub(super) fn reach_for(&self, shell: Option<u32>) -> f64 {
        if shell.is_some() && shell == self.own.shell { self.own.distance.next_up() } else { self.reach() }
    }

    /// The better of both; the other one is kept if it is a rival.
    pub(super) fn take(&mut self, other: Candidate) {
        let (first, second) = if other.is_before(&self.own) { (other, self.own) } else { (self.own, other) };
        let is_rival = |c: &Candidate| {
            c.distance - first.distance <= self.same && c.shell.is_some() && c.shell != first.shell
        };
        // Of several the lowest, whatever the order in which they come.
        let rivals = [self.rival, Some(second)].into_iter().flatten().filter(is_rival);
        self.rival = rivals.min_by_key(|c| c.on);
        self.own = first;
    }
}
