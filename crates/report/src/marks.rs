//! What is drawn over the part, always visible: defects, changes, touching points, outlines.

use super::object::ViewRole;
use trueness_document::scale::palette::Rgb;
use trueness_geom::space::{Point, Vector};

/// Marks that can be switched on and off together.
#[derive(Clone, Debug)]
pub struct Marks {
    /// What they show.
    pub role: ViewRole,
    /// For defects of a reference, its number in the result's `comparisons`; such marks are shown when asked for.
    pub comparison: Option<usize>,
    /// By kind.
    pub groups: Vec<MarkGroup>,
}

/// Marks of one color.
#[derive(Clone, Debug)]
pub struct MarkGroup {
    /// Key of its name in the table of words.
    pub key: String,
    /// Its color.
    pub color: Rgb,
    /// What is drawn; one each for a row of the list, if there are rows.
    pub items: Vec<Mark>,
}

/// One thing that is marked, millimeters. Coordinates that are not finite are left out.
#[derive(Clone, Debug, Default)]
pub struct Mark {
    /// Areas.
    pub triangles: Vec<[Point; 3]>,
    /// Lines.
    pub segments: Vec<[Point; 2]>,
    /// Dots.
    pub points: Vec<Point>,
    /// Which way the surface looks there.
    pub normal: Option<Vector>,
}

impl Marks {
    /// Whether the first view has them.
    pub fn shown(&self) -> bool {
        self.comparison.is_none() && !matches!(self.role, ViewRole::Net | ViewRole::ReflectionLines)
    }

    /// All marks, in the order of their numbers.
    pub fn items(&self) -> impl Iterator<Item = &Mark> {
        self.groups.iter().flat_map(|g| &g.items)
    }

    /// All marks of a page by their numbers.
    pub fn numbered(all: &[Marks]) -> Vec<&Mark> {
        all.iter().flat_map(Marks::items).collect()
    }

    /// All marks with their colors.
    pub fn colored(&self) -> impl Iterator<Item = (&Mark, Rgb)> {
        self.groups.iter().flat_map(|g| g.items.iter().map(|m| (m, g.color)))
    }
}

impl Mark {
    /// A line through points; back to the first where it is `closed`.
    pub fn add_line(&mut self, points: &[Point], closed: bool) {
        self.segments.extend(points.windows(2).map(|p| [p[0], p[1]]));
        if let (true, [first, .., last]) = (closed, points) {
            self.segments.push([*last, *first]);
        }
    }

    /// A triangle with its rim, which shows it when it is too small or has no area.
    pub fn add_facet(&mut self, corners: [Point; 3]) {
        self.triangles.push(corners);
        self.add_line(&corners, true);
    }

    /// Every place it is drawn through.
    pub fn places(&self) -> impl Iterator<Item = &Point> {
        let (t, s) = (self.triangles.iter().flatten(), self.segments.iter().flatten());
        t.chain(s).chain(&self.points)
    }

    /// Without what has a coordinate that is not finite.
    pub fn finite(mut self) -> Mark {
        let fine = |p: &Point| p.iter().all(|x| x.is_finite());
        self.triangles.retain(|t| t.iter().all(fine));
        self.segments.retain(|s| s.iter().all(fine));
        self.points.retain(fine);
        self
    }
}
