//! The document in an E57 file: its scans, the columns of their records, their poses.

use super::{
    column::{Kind, Packed},
    pages::Pages,
};
use crate::error::{Fault, Result};
use roxmltree::Node;
use trueness_geom::space::Point;

/// What is in the file.
pub(super) struct Document {
    pub scans: Vec<ScanHead>,
    pub images: u64,
}

/// Where the coordinates of a record come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Coordinates {
    Cartesian,
    /// Range, azimuth and elevation.
    Spherical,
}

/// A scan as the document describes it.
pub(super) struct ScanHead {
    pub records: u64,
    /// The offset of its records in the file.
    pub offset: u64,
    pub coordinates: Coordinates,
    /// All columns, in the order of the packed bytes.
    pub columns: Vec<Packed>,
    /// Which of them are the coordinates, and which says that a record is invalid.
    pub places: [usize; 3],
    pub state: Option<usize>,
    /// Names of columns that are not read.
    pub unread: Vec<String>,
    /// Columns of the rotation, then the translation.
    pub pose: Option<[Point; 4]>,
}

/// A document is read up to this length.
const MAX_XML_BYTES: u64 = 1 << 26;
const CARTESIAN: [&str; 3] = ["cartesianX", "cartesianY", "cartesianZ"];
const SPHERICAL: [&str; 3] = ["sphericalRange", "sphericalAzimuth", "sphericalElevation"];

impl Document {
    pub fn read(pages: &mut Pages) -> Result<Document> {
        let head = pages.read(0, 48)?;
        let number = |at: usize| head[at..].first_chunk().map_or(0, |b| u64::from_le_bytes(*b));
        let (offset, length) = (number(24), number(32));
        let start = pages.content_at(offset);
        let Some(start) = start.filter(|start| length <= pages.length() - start) else {
            let what =
                format!("the document has offset {offset} and length {length}, beyond the end of the file");
            return Err(Fault::contradiction(what).at_byte(24));
        };
        if length > MAX_XML_BYTES {
            let (what, limit) = ("bytes of the document", MAX_XML_BYTES);
            return Err(Fault::TooMany { what, count: length, limit }.at_byte(32));
        }
        let text = pages.read(start, length as usize)?;
        let damaged = |e: &dyn std::fmt::Display| {
            Fault::contradiction(format!("the document cannot be read: {e}")).at_byte(offset)
        };
        let text = std::str::from_utf8(&text).map_err(|e| damaged(&e))?;
        // Entities, which may grow beyond all measure, are refused with the DTD that declares them.
        let document = roxmltree::Document::parse(text).map_err(|e| damaged(&e))?;
        let root = document.root_element();
        let scans = children(root, "data3D").filter(|n| child(*n, "points").is_some());
        let scans = scans.map(scan).collect::<std::result::Result<_, _>>();
        let images = children(root, "images2D").count() as u64;
        Ok(Document { scans: scans.map_err(|fault| fault.at_byte(offset))?, images })
    }
}

/// The child of this name.
fn child<'a, 'input>(node: Node<'a, 'input>, name: &str) -> Option<Node<'a, 'input>> {
    node.children().find(|n| n.is_element() && n.tag_name().name() == name)
}

/// The elements of a vector.
fn children<'a, 'input: 'a>(node: Node<'a, 'input>, name: &str) -> impl Iterator<Item = Node<'a, 'input>> {
    child(node, name).into_iter().flat_map(|n| n.children()).filter(Node::is_element)
}

/// A number of the document; an empty element is 0.
fn float(node: Node, name: &str) -> std::result::Result<f64, Fault> {
    let Some(node) = child(node, name) else {
        return Err(Fault::contradiction(format!("the pose of a scan has no {name}")));
    };
    match node.text().map_or("", str::trim) {
        "" => Ok(0.0),
        text => {
            text.parse().map_err(|_| Fault::unexpected("a number in the pose of a scan", text.as_bytes()))
        }
    }
}

/// The number of an attribute, or what stands for it where there is none.
fn attribute<T: std::str::FromStr>(node: Node, name: &str, or: T) -> std::result::Result<T, Fault> {
    match node.attribute(name) {
        None => Ok(or),
        Some(text) => text.trim().parse().map_err(|_| {
            Fault::unexpected(format!("a number as {name} of {}", node.tag_name().name()), text.as_bytes())
        }),
    }
}

fn scan(node: Node) -> std::result::Result<ScanHead, Fault> {
    let points = child(node, "points").unwrap_or(node);
    let fields: Vec<Node> = children(points, "prototype").collect();
    let columns = fields.iter().map(|field| column(*field)).collect::<std::result::Result<Vec<_>, _>>()?;
    let at = |name: &str| fields.iter().position(|f| f.tag_name().name() == name);
    let all = |names: [&str; 3]| Some([at(names[0])?, at(names[1])?, at(names[2])?]);
    let (coordinates, places, state) = match (all(CARTESIAN), all(SPHERICAL)) {
        (Some(places), _) => (Coordinates::Cartesian, places, at("cartesianInvalidState")),
        (None, Some(places)) => (Coordinates::Spherical, places, at("sphericalInvalidState")),
        (None, None) => {
            let what = "a scan has neither Cartesian nor spherical coordinates".to_string();
            return Err(Fault::Unsupported { what, remedy: "export the points with their coordinates" });
        }
    };
    let is_read = |i: usize| places.contains(&i) || state == Some(i);
    let name = |f: &Node| match f.tag_name().namespace().and_then(|space| f.lookup_prefix(space)) {
        Some(prefix) if !prefix.is_empty() => format!("{prefix}:{}", f.tag_name().name()),
        _ => f.tag_name().name().to_string(),
    };
    let unread = fields.iter().enumerate().filter(|(i, _)| !is_read(*i)).map(|(_, f)| name(f)).collect();
    Ok(ScanHead {
        records: attribute(points, "recordCount", 0)?,
        offset: attribute(points, "fileOffset", 0)?,
        coordinates,
        columns,
        places,
        state,
        unread,
        pose: child(node, "pose").map(pose).transpose()?,
    })
}

fn column(node: Node) -> std::result::Result<Packed, Fault> {
    let (min, max) = (attribute(node, "minimum", i64::MIN), attribute(node, "maximum", i64::MAX));
    let name = node.tag_name().name();
    let range = || match (min?, max?) {
        (min, max) if min <= max => Ok((min, max)),
        (min, max) => {
            Err(Fault::contradiction(format!("column {name} has the minimum {min} above its maximum {max}")))
        }
    };
    match node.attribute("type") {
        Some("Float") if node.attribute("precision") == Some("single") => Ok(Packed::floating(Kind::Single)),
        Some("Float") => Ok(Packed::floating(Kind::Double)),
        Some("Integer") => Ok(Packed::integer(range()?, 1.0, 0.0)),
        Some("ScaledInteger") => {
            let (scale, offset) = (attribute(node, "scale", 1.0)?, attribute(node, "offset", 0.0)?);
            Ok(Packed::integer(range()?, scale, offset))
        }
        other => {
            let what = format!("column {name} is of type {}", other.unwrap_or("unknown"));
            Err(Fault::Unsupported { what, remedy: "export numbers alone" })
        }
    }
}

/// The axes of a scan in common axes, and its origin.
fn pose(node: Node) -> std::result::Result<[Point; 4], Fault> {
    let [w, x, y, z] = match child(node, "rotation") {
        Some(turn) => [float(turn, "w")?, float(turn, "x")?, float(turn, "y")?, float(turn, "z")?],
        None => [1.0, 0.0, 0.0, 0.0],
    };
    let shift = match child(node, "translation") {
        Some(shift) => [float(shift, "x")?, float(shift, "y")?, float(shift, "z")?],
        None => [0.0; 3],
    };
    let length = w * w + x * x + y * y + z * z;
    if !length.is_normal() || !shift.iter().all(|x| x.is_finite()) {
        let what = format!("the pose of a scan has the quaternion {w} {x} {y} {z}, which is no rotation");
        return Err(Fault::contradiction(what));
    }
    let s = 2.0 / length;
    Ok([
        [1.0 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)],
        [s * (x * y - w * z), 1.0 - s * (x * x + z * z), s * (y * z + w * x)],
        [s * (x * z + w * y), s * (y * z - w * x), 1.0 - s * (x * x + y * y)],
        shift,
    ])
}
