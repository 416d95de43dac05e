//! What the items of a representation are, by their keywords.

use super::super::part21::Entity;
use super::curve::is_curve;
use super::surface::is_surface;

/// What an item of a representation is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Item {
    Solid,
    Replica,
    /// Shells or sets of faces in a list.
    Model,
    Shell,
    Face,
    Set,
    Surface,
    /// A curve or a point, or several of these.
    Wire,
    /// A part that stands elsewhere.
    Mapped,
    Placement,
    /// Shapes that are not read and may have faces.
    Unknown,
    /// What has no shape.
    Other,
}

/// What an entity is as an item.
pub(super) fn item(entity: &Entity) -> Item {
    let of = |keyword: &str| match keyword {
        "MANIFOLD_SOLID_BREP" | "BREP_WITH_VOIDS" | "FACETED_BREP" => Item::Solid,
        "SOLID_REPLICA" => Item::Replica,
        "SHELL_BASED_SURFACE_MODEL" | "FACE_BASED_SURFACE_MODEL" => Item::Model,
        "OPEN_SHELL"
        | "CLOSED_SHELL"
        | "ORIENTED_CLOSED_SHELL"
        | "ORIENTED_OPEN_SHELL"
        | "CONNECTED_FACE_SET" => Item::Shell,
        "ADVANCED_FACE" | "FACE_SURFACE" | "ORIENTED_FACE" => Item::Face,
        "GEOMETRIC_SET" | "GEOMETRIC_CURVE_SET" => Item::Set,
        "MAPPED_ITEM" => Item::Mapped,
        "EDGE_BASED_WIREFRAME_MODEL"
        | "SHELL_BASED_WIREFRAME_MODEL"
        | "CARTESIAN_POINT"
        | "VERTEX_POINT"
        | "VERTEX_SHELL"
        | "WIRE_SHELL"
        | "CONNECTED_EDGE_SET"
        | "EDGE_CURVE" => Item::Wire,
        "AXIS2_PLACEMENT_3D" | "AXIS2_PLACEMENT_2D" | "AXIS1_PLACEMENT" => Item::Placement,
        keyword if is_surface(keyword) => Item::Surface,
        keyword if is_curve(keyword) => Item::Wire,
        keyword if HOLDERS.iter().any(|h| keyword.contains(h)) => Item::Unknown,
        _ => Item::Other,
    };
    // Of a complex instance the record that says most.
    let mut found = Item::Other;
    for record in entity.records() {
        let item = of(record.keyword);
        if found == Item::Other || found == Item::Unknown && item != Item::Other {
            found = item;
        }
    }
    found
}

/// Parts of keywords of shapes that may have faces.
const HOLDERS: [&str; 15] = [
    "SOLID",
    "BREP",
    "SHELL",
    "FACE",
    "SURFACE",
    "TESSELLATED",
    "TRIANGULATED",
    "BOOLEAN",
    "BLOCK",
    "CYLINDER",
    "CONE",
    "SPHERE",
    "TORUS",
    "WEDGE",
    "ELLIPSOID",
];
