//! What is drawn: meshes and clouds with their values.

use super::no_value::NoValue;
use serde::Serialize;
use trueness_document::Role;
use trueness_document::scale::palette::Rgb;
use trueness_geom::mesh::Mesh;
use trueness_geom::scan::Scan;
use trueness_geom::space::Point;
use trueness_measure::drawn_faces::DrawnFaces;

/// What an object is to the reader: what it is called, its color, and what switches it on and off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ViewRole {
    /// Scan, points, the part as it is.
    Measured,
    /// Nominal.
    Reference,
    /// A mesh that is looked at by itself.
    Part,
    /// A mesh that was changed.
    After,
    /// The same before.
    Before,
    /// A surface fitted to points.
    Surface,
    /// Marks: lines of a surface.
    IsoLines,
    /// Marks: lines of a surface that show lamps far away; shown when asked for.
    ReflectionLines,
    /// Marks: the control points of a surface and the lines between them; shown when asked for.
    Net,
    /// A fitted element, drawn translucent.
    Element,
    /// Deviations, on a page that is about something else: shown in place of the part.
    Deviation,
    /// The faces that measured points are of, on a page of features: shown in place of the part.
    Partition,
    /// Marks: what is wrong.
    Defects,
    /// Marks: points that hold an element.
    Touching,
    /// Marks: lines between regions.
    Edges,
    /// Marks: what was changed.
    Changes,
}

impl From<Role> for ViewRole {
    fn from(role: Role) -> ViewRole {
        match role {
            Role::Measured => ViewRole::Measured,
            Role::Reference => ViewRole::Reference,
            Role::Mesh => ViewRole::Part,
        }
    }
}

impl ViewRole {
    /// Marks that are seen through the part: what is wrong or was changed must never be missed. Edges of the part itself
    /// are hidden by it.
    pub fn shows_through(self) -> bool {
        !matches!(self, ViewRole::Edges | ViewRole::IsoLines | ViewRole::ReflectionLines)
    }

    /// Color of what has no map: warm gray for what was measured, blue-gray for what it is compared with.
    pub fn color(self) -> Rgb {
        match self {
            ViewRole::Reference | ViewRole::Before | ViewRole::Surface => [0x8f, 0xa3, 0xbf],
            ViewRole::Element => [0x2f, 0x6f, 0xd6],
            _ => [0xb9, 0xb4, 0xaa],
        }
    }
}

/// A mesh or a cloud with its values.
pub struct ViewObject<'a> {
    /// Measured, reference, …
    pub role: ViewRole,
    /// Shown to the reader; any text at all.
    pub name: &'a str,
    /// Color of what has no map; the role's own where there is none.
    pub color: Option<Rgb>,
    /// For a reference, its number in the result's `comparisons`.
    pub comparison: Option<usize>,
    /// Places.
    pub geometry: Geometry<'a>,
    /// Deviations at the places. On a measured object: from each reference. On a reference: of the measured points near it.
    pub fields: Vec<ViewField<'a>>,
    /// Places that stay however much is left out, because the result names them; they rise.
    pub keep: &'a [u32],
    /// Set where a place shows the worst of several measured points near it and not a value of its own.
    pub gathered: Option<Gathered>,
    /// Set where facets are of faces of a CAD model.
    pub faces: Option<ObjectFaces<'a>>,
}

/// The faces that facets are of.
#[derive(Clone, Copy)]
pub struct ObjectFaces<'a> {
    /// The faces, and lines along edges.
    pub drawn: &'a DrawnFaces,
    /// The face of each facet of the object.
    pub of_facet: &'a [u32],
}

/// How an object shows points that are not its own places.
#[derive(Clone, Copy, Debug)]
pub struct Gathered {
    /// Farthest that a shown point can be, along the surface, from where it is shown, millimeters.
    pub reach: f64,
    /// Vertices of the surface before it was refined for drawing.
    pub vertices: usize,
}

/// Places, millimeters.
#[derive(Clone, Copy)]
pub enum Geometry<'a> {
    /// A cloud.
    Points(&'a [Point]),
    /// A surface.
    Mesh(&'a Mesh),
}

impl<'a> From<&'a Scan> for Geometry<'a> {
    fn from(scan: &'a Scan) -> Geometry<'a> {
        match scan {
            Scan::Mesh(mesh) => Geometry::Mesh(mesh),
            Scan::Cloud(points) => Geometry::Points(points),
        }
    }
}

/// One deviation a point or vertex.
pub struct ViewField<'a> {
    /// Number in the result's `comparisons`.
    pub comparison: usize,
    /// Millimeters, + outside; NaN where there is none.
    pub values: &'a [f64],
    /// Why there is none, place by place; where the list is too short the reason is unknown.
    pub reasons: &'a [NoValue],
}

impl ViewField<'_> {
    /// Deviation and, should it be NaN, the reason.
    pub(super) fn at(&self, i: usize) -> (f64, NoValue) {
        let value = self.values.get(i).copied().unwrap_or(f64::NAN);
        (value, self.reasons.get(i).copied().unwrap_or(NoValue::Unknown))
    }
}

impl<'a> ViewObject<'a> {
    /// A mesh or a cloud, in one color and without values.
    pub(crate) fn plain(role: ViewRole, name: &'a str, color: Option<Rgb>, scan: &'a Scan) -> ViewObject<'a> {
        ViewObject {
            role,
            name,
            color,
            comparison: None,
            geometry: scan.into(),
            fields: vec![],
            keep: &[],
            gathered: None,
            faces: None,
        }
    }

    /// Measured points without name or values.
    pub fn measured(places: &'a [Point]) -> ViewObject<'a> {
        ViewObject {
            role: ViewRole::Measured,
            name: "",
            color: None,
            comparison: None,
            geometry: Geometry::Points(places),
            fields: vec![],
            keep: &[],
            gathered: None,
            faces: None,
        }
    }

    pub(super) fn mesh(&self) -> Option<&'a Mesh> {
        match self.geometry {
            Geometry::Mesh(mesh) => Some(mesh),
            Geometry::Points(_) => None,
        }
    }

    pub(super) fn points(&self) -> Option<&'a [Point]> {
        match self.geometry {
            Geometry::Mesh(_) => None,
            Geometry::Points(points) => Some(points),
        }
    }

    pub(crate) fn places(&self) -> &'a [Point] {
        match self.geometry {
            Geometry::Mesh(mesh) => &mesh.positions,
            Geometry::Points(points) => points,
        }
    }

    pub(super) fn color(&self) -> Rgb {
        self.color.unwrap_or(self.role.color())
    }

    pub(super) fn field(&self, comparison: usize) -> Option<&ViewField<'a>> {
        self.fields.iter().find(|f| f.comparison == comparison)
    }
}

/// Points of a row, for a report: places in the plane of the section, the third coordinate 0.
pub fn flat(row: &[[f64; 2]]) -> Vec<Point> {
    row.iter().map(|p| [p[0], p[1], 0.0]).collect()
}
